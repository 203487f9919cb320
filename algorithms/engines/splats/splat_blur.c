/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Motion blur: a splat is stretched over the way that it went since the view
 * before. All is found in doubles with a bound of the error, else exactly.
 *
 * Source      J. E. Swan II, PhD thesis, Ohio State University, 1998, chapter 4
 * Notation    Y, Q, l and s of docs/composited-picture.md
 * Frames      in a frame of an accumulation buffer s is given, and the energy is
 *             that of a splat which does not move. Such frames are not exact.
 * Errors      an `off` bounds how far a vector is from its exact value. With
 *             A >= |V'|, B >= |D'| and their offs a >= 2^-50 A, b >= 2^-50 B, the
 *             products V'.D', V'.V', D'.D' err by less than 4 (A b + B a), 8 A a,
 *             8 B b. The distance of Y from the way errs by no more than Y and Q
 *             do, wherever s is on the way: it is the distance from a segment,
 *             whose points move no farther than its end. */
#include "algorithms/engines/splats/splats.h"
#include "common/base/numbers.h"
#include "common/base/vector.h"
#include "common/grids/splatting.h"

#include <math.h>
#include <string.h>

/* --- The point of a ray that gives rho ------------------------------------ */

/* What is the same for all rays that are asked for a splat. */
struct lens {
  bool parallel;
  double V[3], D[3];                 /* the parts that are the same for all */
  double start[3], by_x[3], by_y[3]; /* xR + yU, in perspective with F */
  double A, B, a, b;                 /* greatest lengths, and offs */
};

static double length_of(const double v[3]) {
  return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* For rays of screen points that are at most x and y from (0, 0), and may be off
 * by so much. */
static struct lens lens_of(const struct hsr_splats *s,
                           const struct hsr_placed *p, double x, double y,
                           double off) {
  const struct hsr_view *v = s->view;
  struct lens lens = {.parallel = v->parallel};
  double far[3], F[3];
  for (int a = 0; a < 3; a++) {
    double per_size = s->per_size[a][p->at[a]];
    far[a] = s->far[a][p->at[a]] * per_size;
    F[a] = v->F[a] * per_size;
    lens.V[a] = far[a];
    lens.D[a] = v->parallel ? F[a] : 0;
    lens.start[a] = v->ray[0][a] * per_size;
    lens.by_x[a] = v->ray[1][a] * per_size;
    lens.by_y[a] = v->ray[2][a] * per_size;
  }
  double step = length_of(lens.by_x) + length_of(lens.by_y);
  double across = length_of(lens.start) + (x + off) * length_of(lens.by_x) +
                  (y + off) * length_of(lens.by_y);
  lens.A = length_of(far) + (v->parallel ? across : 0);
  lens.B = v->parallel ? length_of(F) : across;
  lens.a = 0x1p-50 * lens.A + (v->parallel ? off * step : 0);
  lens.b = 0x1p-50 * lens.B + (v->parallel ? 0 : off * step);
  return lens;
}

/* Where the ray of a screen point passes the splat. */
struct passing {
  double Y[3];
  double off;   /* of Y; infinite if it cannot be told */
  bool is_away; /* for certain, the ray goes away from the splat */
};

static inline struct passing pass(const struct lens *lens, double x, double y) {
  struct passing r;
  double V[3], D[3], VV = 0, VD = 0, DD = 0;
  for (int a = 0; a < 3; a++) {
    double across = lens->start[a] + x * lens->by_x[a] + y * lens->by_y[a];
    V[a] = lens->parallel ? lens->V[a] - across : lens->V[a];
    D[a] = lens->parallel ? lens->D[a] : across;
    VV += V[a] * V[a];
    VD += V[a] * D[a];
    DD += D[a] * D[a];
  }
  double VD_off = 4 * (lens->A * lens->b + lens->B * lens->a);
  double over = lens->parallel ? VD : VV, under = lens->parallel ? DD : VD;
  double over_off = lens->parallel ? VD_off : 8 * lens->A * lens->a,
         under_off = lens->parallel ? 8 * lens->B * lens->b : VD_off;
  double k = over / under;
  double k_off = 1.1 * (over_off + fabs(k) * under_off) / under;
  for (int a = 0; a < 3; a++)
    r.Y[a] = k * D[a] - V[a];
  r.off = under > 32 * under_off
              ? 1.1 * (k_off * lens->B + fabs(k) * lens->b + lens->a)
              : INFINITY;
  r.is_away = under < -under_off;
  return r;
}

/* --- The way of a splat --------------------------------------------------- */

/* Where the sample was on the screen in the view before, and how far that may
 * be off. 1, 0, -1: it was before the eye, or not, or cannot be told. */
static int seen_before(const struct hsr_splats *s, const struct hsr_placed *p,
                       double *x, double *y, double *off) {
  const struct hsr_view_before *b = &s->view->before;
  double sum[4], size[4];
  const double *const row[4] = {b->screen[0], b->screen[1], b->screen[2],
                                b->depth};
  for (int c = 0; c < 4; c++) {
    sum[c] = size[c] = 0;
    for (int a = 0; a < 3; a++) {
      double term = row[c][a] * (s->grid->at[a][p->at[a]] - b->E[a]);
      sum[c] += term;
      size[c] += fabs(term);
    }
    if (c < 3) {
      sum[c] += b->origin[c];
      size[c] += fabs(b->origin[c]);
    }
  }
  double past = sum[3] - b->near, past_off = 0x1p-49 * (size[3] + b->near);
  if (!(fabs(past) > past_off))
    return -1;
  if (past < 0)
    return 0;
  if (!(sum[2] > 0x1p-20 * size[2]))
    return -1;
  *x = sum[0] / sum[2];
  *y = sum[1] / sum[2];
  *off =
      0x1p-47 * (size[0] + size[1] + (fabs(*x) + fabs(*y)) * size[2]) / sum[2];
  return 1;
}

/* Finds Q, l and whether the splat is blurred. */
static void find_way(struct hsr_splats *s, struct hsr_placed *p, double *x,
                     double *y) {
  double off = 0;
  int seen = seen_before(s, p, x, y, &off);
  if (seen == 0)
    return;
  double threshold = s->splatting.threshold;
  p->way_off = INFINITY;
  p->way_length = p->way[0] = p->way[1] = p->way[2] = 0;
  if (seen > 0) {
    struct lens lens = lens_of(s, p, fabs(*x), fabs(*y), off);
    struct passing r = pass(&lens, *x, *y);
    if (r.is_away && !s->view->parallel)
      return;
    for (int a = 0; a < 3; a++)
      p->way[a] = r.Y[a];
    p->way_off = r.off;
    p->way_length = length_of(r.Y);
  }
  double apart = fabs(p->way_length - threshold);
  if (apart > p->way_off + 0x1p-40 * (threshold + p->way_length)) {
    p->is_blurred = p->way_length > threshold;
    return;
  }
  s->tally->exact[HSR_ASK_FOOTPRINT]++;
  struct hsr_splat splat = hsr_splats_exact(s, p->at);
  p->is_blurred = hsr_exact_is_blurred(&splat, &s->tally->out_of_memory);
}

/* e = 65536 / (g^2 + c g l). */
static uint32_t energy_of(struct hsr_splats *s, const struct hsr_placed *p,
                          double apart) {
  const struct hsr_splatting *how = &s->splatting;
  double c = 1e-6 * hsr_blur_factor[how->blur][how->kernel];
  double g = how->width * (how->antialias ? sqrt(fmax(1, apart)) : 1);
  double longer = g * g + c * g * p->way_length;
  double off = longer * (8 * p->rough + 0x1p-40) + c * g * p->way_off;
  double lo = floor(65536 / (longer + off)), hi = floor(65536 / (longer - off));
  if (off < longer / 2 && lo == hi)
    return (uint32_t)lo;
  s->tally->exact[HSR_ASK_FOOTPRINT]++;
  struct hsr_splat splat = hsr_splats_exact(s, p->at);
  return hsr_exact_energy(&splat, &s->tally->out_of_memory);
}

/* --- The box around it ---------------------------------------------------- */

/* The pixels of [from, to) whose middles are from lo to hi. */
static void clip(double lo, double hi, double middle, int *from, int *to) {
  double first = ceil(lo - middle), last = floor(hi - middle) + 1;
  *from = first > *from ? (first < *to ? (int)first : *to) : *from;
  *to = last < *to ? (last > *from ? (int)last : *from) : *to;
}

/* Finds the box, and the numbers by which floats tell kappa.
 *
 * Box         (dx, dy) / w, with w = 1 + p dx + q dy, are coordinates of the
 *             splat's plane (splat_place.c). There the capsule is within two
 *             ellipses of half sides 32 side, one around the middle and one
 *             around where the splat was before, and what is between them. So
 *             far from the middle, w is from 1 - eta to 1 + eta.
 * Floats      v = 2^-24. These coordinates, and their distances from the way, err
 *             by less than 16 v of their greatest values. kappa is at most 1100,
 *             and its root at most 33.2. So kappa errs by less than 2 33.2 times
 *             that, times sqrt(xx) and sqrt(yy); and by what it errs without
 *             motion. */
static void find_box(const struct hsr_splats *s, struct hsr_placed *p, double x,
                     double y) {
  bool was_small = p->is_small;
  double xx = (double)p->xx, xy = (double)p->xy, yy = (double)p->yy,
         px = (double)p->p, qy = (double)p->q;
  p->box = s->window;
  p->is_small = false;
  if (!was_small || !(p->way_off < 0x1p-20))
    return;
  double det = xx * yy - xy * xy;
  double side_x = 1.01 * sqrt(yy / det), side_y = 1.01 * sqrt(xx / det);
  double dx = x - p->x, dy = y - p->y, w = 1 + px * dx + qy * dy;
  double far = 1.01 * p->way_length * sqrt(p->scale) / 32;
  double eta = 48 * (1 + far) * (fabs(px) * side_x + fabs(qy) * side_y);
  if (!(eta <= 0.5) || !(w > 0.25))
    return;
  double slack = 0x1p-10 + 0x1p-20 * (fabs(dx) + fabs(dy));
  dx /= w;
  dy /= w;
  clip(p->x + (1 + eta) * (fmin(0, dx) - 32 * side_x) - slack,
       p->x + (1 + eta) * (fmax(0, dx) + 32 * side_x) + slack,
       hsr_sample_x(s->view, 0), &p->box.x0, &p->box.x1);
  clip(p->y + (1 + eta) * (fmin(0, dy) - 32 * side_y) - slack,
       p->y + (1 + eta) * (fmax(0, dy) + 32 * side_y) + slack,
       hsr_sample_y(s->view, 0), &p->box.y0, &p->box.y1);
  p->dx = (float)(hsr_sample_x(s->view, p->box.x0) - p->x);
  p->dy = (float)(hsr_sample_y(s->view, p->box.y0) - p->y);

  double square = xx * dx * dx + 2 * xy * dx * dy + yy * dy * dy;
  p->way_x = (float)dx;
  p->way_y = (float)dy;
  p->s_x = (float)((xx * dx + xy * dy) / square);
  p->s_y = (float)((xy * dx + yy * dy) / square);
  double length =
      sqrt(xx) * (33 * side_x + fabs(dx)) + sqrt(yy) * (33 * side_y + fabs(dy));
  double error = (double)p->error + 0x1p-24 * 67 * 16 * length +
                 74 * sqrt(p->scale) * p->way_off;
  p->way_error = (float)error;
  p->is_small = square > 0x1p-60 && error < 0.25;
}

void hsr_splats_stretch(struct hsr_splats *s, struct hsr_placed *p,
                        double apart) {
  double x = 0, y = 0;
  find_way(s, p, &x, &y);
  if (!p->is_blurred)
    return;
  find_box(s, p, x, y);
  p->energy = energy_of(s, p, apart);
}

/* --- Weights -------------------------------------------------------------- */

/* What all pixels of a splat have in common. */
struct capsule {
  struct lens lens;
  double Q[3], per_QQ, length, off, scale, rough;
};

static struct capsule capsule_of(const struct hsr_splats *s,
                                 const struct hsr_placed *p) {
  const struct hsr_view *v = s->view;
  struct capsule c = {.lens = lens_of(s, p, v->m, v->n, 0),
                      .Q = {p->way[0], p->way[1], p->way[2]},
                      .length = p->way_length,
                      .off = p->way_off,
                      .scale = p->scale,
                      .rough = 8 * p->rough + 0x1p-40};
  c.per_QQ = 1 / (p->way_length * p->way_length);
  return c;
}

/* s. */
static inline double share_of_way(const struct capsule *c, const double Y[3]) {
  double along = (Y[0] * c->Q[0] + Y[1] * c->Q[1] + Y[2] * c->Q[2]) * c->per_QQ;
  return hsr_min(hsr_max(along, 0), 1);
}

/* kappa of pixels beside one another, and how far it may be off. */
HSR_VECTOR
static void find_kappas(const struct capsule *c, double x, double y,
                        double kappa[HSR_SPLAT_LANES],
                        double error[HSR_SPLAT_LANES]) {
  const struct capsule here = *c;
  for (int l = 0; l < HSR_SPLAT_LANES; l++) {
    struct passing r = pass(&here.lens, x + l, y);
    double t = share_of_way(&here, r.Y), square = 0;
    for (int a = 0; a < 3; a++) {
      double Z = r.Y[a] - t * here.Q[a];
      square += Z * Z;
    }
    double off = r.off + here.off + 0x1p-40 * here.length;
    double k = here.scale * square;
    double e = here.scale * off * (2 * sqrt(square) + off) + k * here.rough;
    bool away = r.is_away & !here.lens.parallel;
    kappa[l] = away ? INFINITY : k;
    error[l] = away ? 0 : e;
  }
}

/* The same in floats, BEYOND being beyond all footprints. */
#define BEYOND (HSR_FOOTPRINT + 0.5f)
HSR_VECTOR
static void find_in_floats(const struct hsr_placed *p, float dx, float dy,
                           float kappas[HSR_SPLAT_LANES]) {
  const float xx = p->xx, xy = 2 * p->xy, yy = p->yy, px = p->p,
              qy = 1 + p->q * dy;
  const float way_x = p->way_x, way_y = p->way_y, s_x = p->s_x, s_y = p->s_y;
  for (int l = 0; l < HSR_SPLAT_LANES; l++) {
    float x = dx + (float)l, w = qy + px * x;
    float X = x / w, Y = dy / w;
    float s = s_x * X + s_y * Y;
    s = s > 0 ? s : 0;
    s = s < 1 ? s : 1;
    X -= s * way_x;
    Y -= s * way_y;
    float kappa = (xx * X + xy * Y) * X + yy * Y * Y;
    kappas[l] = kappa < BEYOND ? kappa : BEYOND;
  }
}

/* An index in doubles, or exactly. */
static int32_t settle(const struct hsr_splats *s, const struct hsr_placed *p,
                      int i, int j, double kappa, double error) {
  if (kappa - error >= HSR_FOOTPRINT)
    return HSR_FOOTPRINT;
  double lo = floor(fmax(0, kappa - error)), hi = floor(kappa + error);
  if (lo == hi)
    return (int32_t)hsr_min(lo, HSR_FOOTPRINT);
  s->tally->exact[HSR_ASK_FOOTPRINT]++;
  struct hsr_splat splat = hsr_splats_exact(s, p->at);
  return hsr_exact_footprint(&splat, i, j, &s->tally->out_of_memory);
}

/* Whether floats tell all indices. */
static bool tell(const struct hsr_placed *p,
                 const float kappas[HSR_SPLAT_LANES],
                 int32_t index[HSR_SPLAT_LANES]) {
  bool all = true;
  for (int l = 0; l < HSR_SPLAT_LANES; l++) {
    index[l] = (int32_t)kappas[l];
    float part = kappas[l] - (float)index[l];
    bool one = part >= p->way_error && part <= 1 - p->way_error;
    index[l] = one ? index[l] : -1;
    all &= one;
  }
  return all;
}

void hsr_splats_find_blurred(const struct hsr_splats *s,
                             const struct hsr_placed *p, int x, int j,
                             int32_t index[HSR_SPLAT_LANES]) {
  int n = p->box.x1 - x < HSR_SPLAT_LANES ? p->box.x1 - x : HSR_SPLAT_LANES;
  double sx = hsr_sample_x(s->view, x), sy = hsr_sample_y(s->view, j);
  float about[HSR_SPLAT_LANES];
  memset(index, -1, HSR_SPLAT_LANES * sizeof *index);
  if (p->is_small)
    find_in_floats(p, (float)(sx - p->x), (float)(sy - p->y), about);
  if (!p->is_small || !tell(p, about, index)) {
    const struct capsule c = capsule_of(s, p);
    double kappa[HSR_SPLAT_LANES], error[HSR_SPLAT_LANES];
    find_kappas(&c, sx, sy, kappa, error);
    for (int l = 0; l < n; l++)
      if (index[l] < 0)
        index[l] = settle(s, p, x + l, j, kappa[l], error[l]);
  }
  for (int l = n; l < HSR_SPLAT_LANES; l++)
    index[l] = HSR_FOOTPRINT;
}

/* s Q errs by no more than Y and Q, turned by what Q errs; and never by more
 * than twice its greatest length. */
double hsr_splats_move(const struct hsr_splats *s, const struct hsr_placed *p,
                       int i, int j, double V[3]) {
  const struct capsule c = capsule_of(s, p);
  const struct passing r =
      pass(&c.lens, hsr_sample_x(s->view, i), hsr_sample_y(s->view, j));
  double t = share_of_way(&c, r.Y);
  if (c.off == INFINITY || r.off == INFINITY)
    return INFINITY;
  for (int a = 0; a < 3; a++)
    V[a] += t * c.Q[a];
  double turned = 4 * length_of(r.Y) * c.off / c.length;
  return fmin(2 * (c.length + c.off),
              1.1 * (r.off + turned + 2 * c.off) +
                  0x1p-40 * (c.length + length_of(r.Y)));
}
