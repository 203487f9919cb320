/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where splats are: a batch at once.
 *
 * Formula     A and B are what D' changes by a pixel to the right and down. At the
 *             middle the ray's direction is V'/t. With a pixel (dx, dy) from the
 *             middle, p = t V'.A / V'.V', q = t V'.B / V'.V', and a and b, which
 *             are A and B without their parts along V':
 *               rho^2 = t^2 |dx a + dy b|^2 / (1 + p dx + q dy)^2.
 *             In parallel V is F, and t = 1, p = q = 0.
 * Terms       all products are sums of three terms, one for each axis. Along a row
 *             of samples one of them changes. So a.a = A.A - (V'.A)^2 / V'.V'.
 * Errors      u = 2^-53. A row of the view's matrices has a relative error of 2
 *             u, a distance from E of u, their product of u: a sum of three or
 *             four terms errs by less than 8 u times the greatest sum of their
 *             sizes, `most`. So w has the relative error rough = 2^-48 most/w
 *             with room to spare, and the middle an error of 2^-49 (most_x + |x|
 *             most_w) / w + 2^-51 |x| pixels.
 *             A splat is placed only if rough < 2^-28; if p and q change the
 *             denominator by eta <= 1/2 within reach; if a and b are at least
 *             1/32 as long as A and B; and if the cosine between them is at most
 *             sqrt(.8). A.A errs by less than 8 u of it, V'.A by 8 u |V'| |A|, so
 *             a.a by less than 32 u A.A, which is at most 2^-38 of a.a; and the
 *             coefficients of the square have relative errors below 2 rough +
 *             2^-37.
 * Floats      v = 2^-24. M = xx dx^2 + 2 |xy dx dy| + yy dy^2 is at most cond
 *             kappa (1 + eta)^2. Each product and sum adds v, so the square errs
 *             by less than 9 v M, and the denominator, which is at least 1 -
 *             eta, by (6 eta + 1) v. With spread = cond ((1 + eta) / (1 -
 *             eta))^2, kappa errs by less than v kappa (9 spread + 2 (6 eta + 1)
 *             / (1 - eta) + 5), for kappa up to 1100, and by 12000 v spread for
 *             what dx and dy err near the middle: by 2 v of their greatest
 *             values.
 * Fused       with fused products the square errs by less than 4 v M, the
 *             denominator by (8 eta + 2) v, and the quotient by 4 v more. What
 *             dx and dy err, by 2 v of the half sides below, changes the square
 *             S by less than 2 sqrt(S) (sqrt(xx) 2 v side_x + sqrt(yy) 2 v
 *             side_y) = 8 v 32 (1 + eta) sqrt(S) / sin, by Cauchy and Schwarz,
 *             sin being the sine between A and B; and 2 sqrt(kappa) < kappa / 33
 *             + 33.
 * Reach       kappa < 1024 (1 + eta)^2 within the square's ellipse, whose box
 *             has half sides 32 (1 + eta) sqrt(yy / det), sqrt(xx / det). As
 *             eta <= 1/2 in the box with 48 for 32 (1 + eta), no pixel outside
 *             it is covered: along a line from the middle, kappa grows until the
 *             denominator vanishes.
 */
#include "algorithms/engines/splats/splats.h"
#include "common/base/numbers.h"
#include "common/base/vector.h"

#include <math.h>

/* --- Rows ----------------------------------------------------------------- */

/* What the lanes of a batch are computed from: the sums of the terms of y and z, and
 * of x the distance from E, V and 1 / size. What is behind the lanes is to spare. */
struct lanes {
  double row[HSR_TERMS][HSR_SPLAT_BATCH + HSR_SPLAT_LANES];
  double far[HSR_SPLAT_BATCH], V[HSR_SPLAT_BATCH], per_size[HSR_SPLAT_BATCH];
};

/* Gives n lanes, and some behind them, the sums of a row. */
static void spread_row(const double sum[HSR_TERMS], int at, int n,
                       struct lanes *l) {
  for (int t = 0; t < HSR_TERMS; t++)
    for (int k = 0; k < n; k += HSR_SPLAT_LANES)
      for (int lane = 0; lane < HSR_SPLAT_LANES; lane++)
        l->row[t][at + k + lane] = sum[t];
}

/* The samples of a batch come in rows. The lanes behind the last sample get its
 * numbers: what they compute is not used, but it must not come from memory that
 * nobody has written. */
static void gather(const struct hsr_splats *s, struct lanes *l) {
  const struct hsr_splat_samples *b = s->batch->of;
  const struct hsr_view *v = s->view;
  const uint32_t *j = b->at[1], *k = b->at[2];
  for (int at = 0, end; at < b->n; at = end) {
    double sum[HSR_TERMS];
    for (int t = 0; t < HSR_TERMS; t++)
      sum[t] = s->term[1][t][j[at]] + s->term[2][t][k[at]];
    sum[HSR_TERM_X] += v->origin[0];
    sum[HSR_TERM_Y] += v->origin[1];
    sum[HSR_TERM_W] += v->parallel ? 1 : 0;
    for (end = at + 1; end < b->n && j[end] == j[at] && k[end] == k[at];)
      end++;
    spread_row(sum, at, (end < b->n ? end : HSR_SPLAT_BATCH) - at, l);
  }
  for (int n = 0; n < HSR_SPLAT_BATCH; n++) {
    uint32_t i = b->at[0][n < b->n ? n : b->n - 1];
    l->far[n] = s->far[0][i];
    l->V[n] = v->parallel ? v->F[0] : s->far[0][i];
    l->per_size[n] = s->per_size[0][i];
  }
}

/* --- Places --------------------------------------------------------------- */

/* What bounds the errors of a batch: of splats that floats may tell, 1 by the
 * square of the sine between A and B; eta; the greater of xx and yy, times the
 * square of how far the middle may be off; and rough. 0 of other splats. */
enum { PER_SINE2, ETA, MOVED, ROUGH, MOST };

HSR_VECTOR
static void place(const struct hsr_splats *restrict s,
                  const struct lanes *restrict l,
                  struct hsr_splat_batch *restrict b,
                  double most[restrict MOST][HSR_SPLAT_BATCH]) {
  const struct hsr_view *v = s->view;
  const double most_x = hsr_max(s->most[0], s->most[1]), most_w = s->most[2];
  const double width = s->splatting.width * s->splatting.width;
  const double full = HSR_FOOTPRINT / (s->reach * s->reach * width),
               all_energy = 65536 / width;
  const double left = hsr_sample_x(v, 0), top = hsr_sample_y(v, 0);
  const double near = v->near,
               depth_off = 0x1p-49 * s->most[3] + 0x1p-52 * near;
  const struct hsr_window window = s->window;
  const int32_t plain_energy = (int32_t)s->plain_energy;
  const int n = b->of->n;
  const double perspective = v->parallel ? 0 : 1,
               antialias = s->splatting.antialias ? 1 : 0;
  const double by_far[4] = {v->screen[0][0], v->screen[1][0],
                            v->parallel ? 0 : v->screen[2][0], v->depth[0]};
  const double A = v->ray[1][0], B = v->ray[2][0];
  const double U = v->U[0] / v->whole_n, R = v->R[0] / v->whole_m,
               UR = 2 * (U * U + R * R);
  for (int k = 0; k < HSR_SPLAT_BATCH; k++) {
    double far = l->far[k], V = l->V[k],
           square = l->per_size[k] * l->per_size[k];
    double w = by_far[HSR_TERM_W] * far + l->row[HSR_TERM_W][k],
           inverse = 1 / w, t2 = w * w;
    double x = (by_far[HSR_TERM_X] * far + l->row[HSR_TERM_X][k]) * inverse,
           y = (by_far[HSR_TERM_Y] * far + l->row[HSR_TERM_Y][k]) * inverse,
           depth = by_far[HSR_TERM_DEPTH] * far + l->row[HSR_TERM_DEPTH][k];
    double VV = V * V * square + l->row[HSR_TERM_VV][k], per_VV = 1 / VV;
    double VA = V * A * square + l->row[HSR_TERM_VA][k],
           VB = V * B * square + l->row[HSR_TERM_VB][k];
    double AA = A * A * square + l->row[HSR_TERM_AA][k],
           AB = A * B * square + l->row[HSR_TERM_AB][k],
           BB = B * B * square + l->row[HSR_TERM_BB][k];
    double p = VA * per_VV, q = VB * per_VV;
    double aa = AA - p * VA, ab = AB - p * VB, bb = BB - q * VB;
    p *= w, q *= w;

    double apart = t2 * (UR * square + l->row[HSR_TERM_APART][k]),
           per_apart = 1 / hsr_max(1, antialias * apart);
    double scale = full * per_apart;

    double f = scale * t2, xx = f * aa, xy = f * ab, yy = f * bb;
    double det = xx * yy - xy * xy, per_det = 1 / det;
    double per_sine2 = xx * yy * per_det;
    double side_x = sqrt(yy * per_det), side_y = sqrt(xx * per_det);
    double eta = 48 * perspective * (fabs(p) * side_x + fabs(q) * side_y);
    double rough = 0x1p-48 * most_w * fabs(inverse) + 0x1p-40;
    double off =
        0x1p-49 * (most_x + hsr_max(fabs(x), fabs(y)) * most_w) * inverse +
        0x1p-51 * hsr_max(fabs(x), fabs(y));
    double reach = 32 * (1 + eta) * (1 + 0x1p-20);
    bool good = (w > 0) & (rough < 0x1p-28) & (eta <= 0.5) & (aa * 1024 >= AA) &
                (bb * 1024 >= BB) & (per_sine2 > 0) & (per_sine2 <= 5) &
                (xx < 0x1p60) & (yy < 0x1p60) & (xx > 0x1p-60) &
                (yy > 0x1p-60) & (off < 0x1p-10) &
                (VV * 0x1p20 >=
                 2304 * t2 * (AA * side_x * side_x + BB * side_y * side_y));
    double reach_x = good ? reach * side_x + off : HSR_MAX_SIZE,
           reach_y = good ? reach * side_y + off : HSR_MAX_SIZE;
    double middle_x = good ? x : 0, middle_y = good ? y : 0;
    b->x0[k] =
        hsr_splats_first_pixel(middle_x - reach_x - left, window.x0, window.x1);
    b->x1[k] =
        hsr_splats_end_pixel(middle_x + reach_x - left, window.x0, window.x1);
    b->y0[k] =
        hsr_splats_first_pixel(middle_y - reach_y - top, window.y0, window.y1);
    b->y1[k] =
        hsr_splats_end_pixel(middle_y + reach_y - top, window.y0, window.y1);
    b->is_small[k] = good;
    bool counts = good & (k < n);
    most[PER_SINE2][k] = counts ? per_sine2 : 0;
    most[ETA][k] = counts ? eta : 0;
    most[MOVED][k] = counts ? hsr_max(xx, yy) * (off * off) : 0;
    most[ROUGH][k] = counts ? rough : 0;

    double loose = 8 * rough + 0x1p-40;
    double energy = all_energy * per_apart;
    double most_energy = energy * (1 + loose);
    /* The limits differ, so that an energy beyond them is not taken for a whole
     * one. The exact path decides it. */
    double least_energy = hsr_max(energy * (1 - loose), -1);
    int32_t least_whole = (int32_t)hsr_min(least_energy, 70001),
            most_whole = (int32_t)hsr_min(most_energy, 70000);
    bool is_plain = (antialias == 0) | (apart < 1 - loose);
    bool is_whole = (least_whole == most_whole) & (loose < 0x1p-20);
    b->energy[k] = is_plain ? plain_energy : is_whole ? least_whole : -1;
    b->is_beyond[k] = depth - near > depth_off;

    b->depth[k] = depth;
    b->x[k] = x;
    b->y[k] = y;
    b->dx[k] = (float)(b->x0[k] + left - x);
    b->dy[k] = (float)(b->y0[k] + top - y);
    b->xx[k] = (float)xx;
    b->xy[k] = (float)xy;
    b->yy[k] = (float)yy;
    b->p[k] = (float)(perspective * p);
    b->q[k] = (float)(perspective * q);
    b->apart[k] = apart;
    b->scale[k] = scale;
    b->rough[k] = rough;
  }
}

/* The greatest of each row moves to its first place. */
HSR_VECTOR
static void find_most(double row[MOST][HSR_SPLAT_BATCH]) {
  for (int half = HSR_SPLAT_BATCH / 2; half; half /= 2)
    for (int r = 0; r < MOST; r++)
      for (int k = 0; k < half; k++)
        row[r][k] = hsr_max(row[r][k], row[r][k + half]);
}

/* How far kappa may be off. What is worst in the batch bounds it for all splats
 * of the batch: roots and quotients for each of them take longer than the few
 * pixels more that must be decided in doubles. */
static void bound_errors(double most[MOST][HSR_SPLAT_BATCH],
                         struct hsr_splat_batch *b) {
  find_most(most);
  const double sine2 = 1 / hsr_max(1, most[PER_SINE2][0]), eta = most[ETA][0],
               cosine = sqrt(1 - sine2 + 0x1p-40),
               cond = (1 + cosine) / (1 - cosine),
               ratio = (1 + eta) / (1 - eta), spread = cond * ratio * ratio;
  const double in_float =
      0x1p-24 *
      (1100 * (12 * spread + (12 * eta + 2) / (1 - eta) + 6) + 12000 * spread);
  const double in_doubles =
      800 * sqrt(most[MOVED][0]) + 36000 * (most[ROUGH][0] + 0x1p-37);
  const double moved = 128 * (1 + eta) / ((1 - eta) * sqrt(sine2));
  b->error = (float)(in_float + in_doubles);
  b->constant = (float)(0x1p-24 * 33 * moved + in_doubles);
  b->slope = (float)(1 + 0x1p-24 * (4 * spread + (16 * eta + 4) / (1 - eta) +
                                    8 + moved / 33));
}

static void place_batch(struct hsr_splats *s) {
  struct lanes lanes;
  double most[MOST][HSR_SPLAT_BATCH];
  gather(s, &lanes);
  place(s, &lanes, s->batch, most);
  bound_errors(most, s->batch);
}

/* --- Single splats -------------------------------------------------------- */

struct hsr_splat hsr_splats_exact(const struct hsr_splats *s,
                                  const uint32_t at[3]) {
  struct hsr_splat splat = {.view = s->view,
                            .width = s->splatting.width,
                            .antialias = s->splatting.antialias,
                            .kernel = s->splatting.kernel,
                            .blur = s->splatting.blur,
                            .threshold = s->splatting.threshold};
  for (int a = 0; a < 3; a++) {
    const double *bound = s->grid->bound[a] + at[a];
    splat.at[a] = s->grid->at[a][at[a]];
    splat.size[a] = bound[1] - bound[0];
  }
  return splat;
}

static bool is_beyond_near(struct hsr_splats *s, int k, const uint32_t at[3]) {
  double depth = s->batch->depth[k], near = s->view->near;
  double error = 0x1p-49 * s->most[3] + 0x1p-52 * near;
  if (s->batch->is_beyond[k] || depth - near < -error)
    return s->batch->is_beyond[k];
  s->tally->exact[HSR_ASK_FOOTPRINT]++;
  struct hsr_splat splat = hsr_splats_exact(s, at);
  return hsr_exact_is_beyond_near(&splat, &s->tally->out_of_memory);
}

/* e. In parallel projection it is that of the last splat if their cells have the
 * same sizes. */
static uint32_t energy_of(struct hsr_splats *s, int k, const uint32_t at[3]) {
  if (s->batch->energy[k] >= 0)
    return (uint32_t)s->batch->energy[k];
  struct hsr_splat splat = hsr_splats_exact(s, at);
  struct hsr_splats_energy *last = &s->last;
  bool same = s->view->parallel;
  for (int a = 0; a < 3; a++) {
    same &= last->size[a] == splat.size[a];
    last->size[a] = splat.size[a];
  }
  if (!same) {
    s->tally->exact[HSR_ASK_FOOTPRINT]++;
    last->energy = hsr_exact_energy(&splat, &s->tally->out_of_memory);
  }
  return last->energy;
}

static bool leave(struct hsr_splats *s, uint32_t cell) {
  HSR_STEP(s->tally, HSR_SPLAT_SPLATS, HSR_CELL(cell, 0, 0), HSR_NOTHING,
           HSR_NOWHERE, 0);
  return false;
}

static bool leave_hidden(struct hsr_splats *s, const struct hsr_placed *p) {
  HSR_STEP(s->tally, HSR_SPLAT_SPLATS, HSR_CELL(p->cell, 0, 0), HSR_THE_WINDOW,
           p->box, 1);
  return false;
}

/* --- The box of a splat that floats cannot tell --------------------------- */

/* Does a splat lie wholly on one side of the rays of a column x (axis 0) or row y
 * (axis 1): on the side of greater coordinates, or of smaller ones?
 *   These rays are in one plane. Its normal is N; N' has the components of N
 * times the cell's sizes. At the middle of the splat the plane's function has the
 * value X - x w.
 *   In parallel projection the splat covers the rays that pass the middle within
 * g r. So it is on one side if the value exceeds |N'| g r.
 *   In perspective it covers a cone of rays about V', and the sine of the cone's
 * half angle is g r / sqrt(|V'|^2 + (g r)^2). So it is on one side if the value
 * exceeds |N'| g r |V'| / sqrt(|V'|^2 + (g r)^2).
 *   Rounding changes less than 2^-40 of the sizes of the terms. */
static bool is_past(const struct hsr_splats *s, const struct hsr_placed *p,
                    int axis, double at, bool greater) {
  const struct hsr_view *v = s->view;
  double value = v->origin[axis] - at * v->origin[2],
         size = fabs(v->origin[axis]) + fabs(at * v->origin[2]);
  double NN = 0, VV = 0, terms = 0;
  for (int a = 0; a < 3; a++) {
    double far = s->far[a][p->at[a]], per_size = s->per_size[a][p->at[a]];
    double N = v->screen[axis][a] - at * v->screen[2][a],
           sizes = fabs(v->screen[axis][a]) + fabs(at * v->screen[2][a]);
    value += N * far;
    size += sizes * fabs(far);
    NN += N / per_size * (N / per_size);
    terms += sizes / per_size;
    VV += far * per_size * (far * per_size);
  }
  double reach2 = HSR_FOOTPRINT / p->scale,
         cosine = v->parallel ? 1 : sqrt(VV / (VV + reach2));
  double least =
      (sqrt(NN) + 0x1p-40 * terms) * sqrt(reach2) * cosine * (1 + 0x1p-16) +
      0x1p-40 * size;
  return greater ? value > least : -value > least;
}

/* How many pixels of [from, to) the splat leaves free: from `from` on if it is on
 * the side of greater coordinates, else before `to`. By bisection. */
static int32_t count_past(const struct hsr_splats *s,
                          const struct hsr_placed *p, int axis, int32_t from,
                          int32_t to, bool greater) {
  int32_t least = 0, most = to - from;
  while (least < most) {
    int32_t n = most - (most - least) / 2, k = greater ? from + n - 1 : to - n;
    double at = axis ? hsr_sample_y(s->view, k) : hsr_sample_x(s->view, k);
    if (is_past(s, p, axis, at, greater))
      least = n;
    else
      most = n - 1;
  }
  return least;
}

static void tighten(const struct hsr_splats *s, struct hsr_placed *p) {
  struct hsr_window *box = &p->box;
  if (!(p->rough < 0x1p-20))
    return;
  box->x0 += count_past(s, p, 0, box->x0, box->x1, true);
  box->x1 -= count_past(s, p, 0, box->x0, box->x1, false);
  box->y0 += count_past(s, p, 1, box->y0, box->y1, true);
  box->y1 -= count_past(s, p, 1, box->y0, box->y1, false);
}

/* --- A splat of the batch ------------------------------------------------- */

/* Copies splat k. Some members are of blurred splats alone, and
 * hsr_splats_stretch fills them. They are not set to 0 here, since that would take
 * longer than all of the rest. */
static void fill(const struct hsr_splat_batch *b, int k, struct hsr_placed *p) {
  p->cell = b->of->cell[k];
  for (int a = 0; a < 3; a++)
    p->at[a] = b->of->at[a][k];
  p->opacity = b->of->opacity[k];
  p->x = b->x[k];
  p->y = b->y[k];
  p->scale = b->scale[k];
  p->rough = b->rough[k];
  p->xx = b->xx[k];
  p->xy = b->xy[k];
  p->yy = b->yy[k];
  p->p = b->p[k];
  p->q = b->q[k];
  p->dx = b->dx[k];
  p->dy = b->dy[k];
  p->error = b->error;
  p->constant = b->constant;
  p->slope = b->slope;
  p->is_small = b->is_small[k];
  p->is_blurred = false;
  p->way_x = p->way_y = p->s_x = p->s_y = p->way_error = 0;
  p->box = (struct hsr_window){b->x0[k], b->y0[k], b->x1[k], b->y1[k]};
}

/* Makes *p of splat k of the batch, but for its colour. False if by the definition
 * there is no such splat, or it is not in the window, or hidden. */
static bool take(struct hsr_splats *s, int k, struct hsr_placed *p) {
  const struct hsr_splat_batch *b = s->batch;
  bool may_move = s->splatting.blur && s->view->before.exists;
  if (!may_move && (b->x0[k] >= b->x1[k] || b->y0[k] >= b->y1[k]))
    return leave(s, b->of->cell[k]);
  fill(b, k, p);
  if (!is_beyond_near(s, k, p->at))
    return leave(s, p->cell);
  if (may_move)
    hsr_splats_stretch(s, p, b->apart[k]);
  if (!p->is_small && !p->is_blurred)
    tighten(s, p);
  if (p->box.x0 >= p->box.x1 || p->box.y0 >= p->box.y1)
    return leave(s, p->cell);
  if (!p->is_blurred)
    p->energy = energy_of(s, k, p->at);
  if (hsr_splats_is_hidden(s, p->opacity, p->energy, &p->box))
    return leave_hidden(s, p);
  return true;
}

int hsr_splats_place(struct hsr_splats *s,
                     const struct hsr_splat_samples *samples,
                     struct hsr_placed placed[HSR_SPLAT_BATCH]) {
  int n = 0;
  s->batch->of = samples;
  place_batch(s);
  for (int k = 0; k < samples->n; k++)
    n += take(s, k, &placed[n]);
  hsr_splats_shade(s, placed, n);
  return n;
}

bool hsr_splats_clip(const struct hsr_splats *s, const struct hsr_placed *p,
                     const struct hsr_window *w, struct hsr_placed *clipped) {
  struct hsr_window box = hsr_window_meet(&p->box, w);
  if (box.x0 >= box.x1 || box.y0 >= box.y1)
    return false;
  *clipped = *p;
  clipped->box = box;
  clipped->dx = (float)(hsr_sample_x(s->view, box.x0) - p->x);
  clipped->dy = (float)(hsr_sample_y(s->view, box.y0) - p->y);
  return true;
}
