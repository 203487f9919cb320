/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Direct convolution: every texel that the pixel's filter reaches is read.
 *
 * Source      E. A. Feibush, M. Levoy and R. L. Cook, "Synthetic Texturing Using
 *             Digital Filters", SIGGRAPH 1980; P. S. Heckbert, "Fundamentals of
 *             Texture Mapping and Image Warping", 1989: elliptical weighted
 *             averages
 * Footprint   (shape=footprint) the weight of a texel is that of its splat in the
 *             pixel, as in docs/composited-picture.md with antialias: the filter of
 *             the forward map, read from the other side.
 * Preimage    (shape=preimage) the kernel is round on the screen, its cell being a
 *             pixel. On the layer it is an ellipse. By rho^2 = d (J J^T + 1)^-1 d,
 *             J being the derivatives and d the way in texels, it reaches no
 *             fewer texels than the kernel does: Heckbert's sum of two Gaussians.
 * Brute force all texels of the box around the filter are tried.
 * Departures  a splat of which the pixel's ray misses the layer gives nothing.
 * Cost        texels of the boxes, of which a part is read
 *
 * Notation, invariant, ties and the rest are those of textures.h. */
#include "algorithms/volume/textures/textures.h"
#include "common/answers/kinds/composited.h"

#include <math.h>

enum { CHANNELS = HSR_TEXTURE_CHANNELS };
enum { TRIES }; /* counter */
enum { FOOTPRINT, PREIMAGE };

static const struct hsr_word shapes[] = {
    [FOOTPRINT] = {"footprint", "the texel's splat reaches the pixel", 0},
    [PREIMAGE] = {"preimage", "round on the screen, an ellipse on the layer",
                  0},
    {NULL}};
static const struct hsr_option options[] = {
    {"shape", "how the filter is formed", shapes, 0, PREIMAGE, FOOTPRINT},
    {NULL}};

struct model {
  double reach;   /* of the kernel, times width */
  double size[3]; /* of cells; of all, if is_even */
  bool is_even;
  double ellipse[3]; /* of the current pixel: (J J^T + 1)^-1: pp, pq, qq */
};

/* --- Footprints ----------------------------------------------------------- */

static double cell_size(const struct hsr_grid *g, int a, int k) {
  return g->bound[a][k + 1] - g->bound[a][k];
}

static void measure_cells(const struct hsr_texture *x, struct model *m) {
  m->is_even = true;
  for (int a = 0; a < 3; a++) {
    m->size[a] = cell_size(x->grid, a, 0);
    for (int k = 1; k < (int)x->grid->n[a]; k++)
      m->is_even &=
          fabs(cell_size(x->grid, a, k) - m->size[a]) <= 1e-6 * m->size[a];
  }
}

/* How far apart pixels are at t = 1, in cells. */
static double apart(const struct hsr_view *v, const double size[3]) {
  double sum = 0;
  for (int a = 0; a < 3; a++) {
    double u = v->U[a] / size[a] / v->whole_n,
           r = v->R[a] / size[a] / v->whole_m;
    sum += 2 * (u * u + r * r);
  }
  return sqrt(sum);
}

/* How far from where the ray meets the layer a splat may be that covers the
 * pixel, in cells. It is within g r of the ray, that is within g r / sine along
 * the layer; and g grows with t, which grows by `steep` a cell at most. */
static double far_of_splats(const struct hsr_texture *x, const struct model *m,
                            const struct hsr_preimage *pre) {
  const struct hsr_view *v = x->view;
  double way[3], steep = 0, length = 0, g = apart(v, m->size);
  for (int a = 0; a < 3; a++) {
    way[a] = pre->way[a] / m->size[a];
    length += way[a] * way[a];
    double slope = v->depth[a] * m->size[a];
    steep += a == x->across ? 0 : slope * slope;
  }
  double sine = fabs(way[x->across]) / sqrt(length);
  if (!m->is_even)
    return INFINITY;
  if (v->parallel)
    return m->reach * fmax(1, g) / sine;
  double left = sine - m->reach * g * sqrt(steep);
  return left <= 0 ? INFINITY
                   : fmax(m->reach / sine, m->reach * g * pre->t / left);
}

/* The weight of a texel's splat in a pixel; 0: it does not cover the pixel. */
static double weight_of_splat(const struct hsr_texture *x,
                              const struct hsr_preimage *pre, int p, int q) {
  const struct hsr_view *v = x->view;
  const struct hsr_grid *g = x->grid;
  const struct model *m = x->model;
  int at[3] = {0};
  at[x->axis[0]] = p;
  at[x->axis[1]] = q;
  double size[3], t = 0, VV = 0, VD = 0, DD = 0;
  for (int a = 0; a < 3; a++) {
    double P = g->at[a][at[a]], D = pre->way[a], V = P - pre->from[a];
    size[a] = cell_size(g, a, at[a]);
    t += v->depth[a] * (P - v->E[a]);
    VV += V * V / (size[a] * size[a]);
    VD += V * D / (size[a] * size[a]);
    DD += D * D / (size[a] * size[a]);
  }
  if (!(t > v->near) || !(v->parallel || VD > 0))
    return 0;
  double across = VV - VD * VD / DD; /* of the ray, squared */
  double rho2 = v->parallel ? across : across * VV * DD / (VD * VD);
  double wide = apart(v, size) * (v->parallel ? 1 : t),
         g2 = fmax(1, wide * wide),
         kappa = HSR_FOOTPRINT * rho2 / (g2 * m->reach * m->reach);
  return kappa < HSR_FOOTPRINT ? x->splats.weight[(int)fmax(kappa, 0)] / g2 : 0;
}

/* --- Ellipses ------------------------------------------------------------- */

/* Finds the ellipse, and how far it reaches along both axes. */
static void find_ellipse(struct model *m, const struct hsr_preimage *pre,
                         double far[2]) {
  const double *dx = pre->dx, *dy = pre->dy;
  double pp = dx[0] * dx[0] + dy[0] * dy[0] + 1,
         qq = dx[1] * dx[1] + dy[1] * dy[1] + 1,
         pq = dx[0] * dx[1] + dy[0] * dy[1], area = pp * qq - pq * pq;
  m->ellipse[0] = qq / area;
  m->ellipse[1] = -pq / area;
  m->ellipse[2] = pp / area;
  far[0] = m->reach * sqrt(pp);
  far[1] = m->reach * sqrt(qq);
}

static double weight_of_ellipse(const struct hsr_texture *x,
                                const struct hsr_preimage *pre, int p, int q) {
  const struct model *m = x->model;
  const double *e = m->ellipse;
  double dp = p + 0.5 - pre->at[0], dq = q + 0.5 - pre->at[1];
  double rho2 = e[0] * dp * dp + 2 * e[1] * dp * dq + e[2] * dq * dq,
         kappa = HSR_FOOTPRINT * rho2 / (m->reach * m->reach);
  return kappa < HSR_FOOTPRINT ? x->splats.weight[(int)fmax(kappa, 0)] : 0;
}

/* --- Pixels --------------------------------------------------------------- */

typedef double weight_of(const struct hsr_texture *,
                         const struct hsr_preimage *, int p, int q);

/* The texels of a box that reaches so far along both axes. */
static struct hsr_window box_of(const struct hsr_texture *x,
                                const struct hsr_preimage *pre,
                                const double far[2]) {
  int from[2], to[2];
  for (int a = 0; a < 2; a++) {
    from[a] = (int)fmax(0, floor(pre->at[a] - far[a] - 1));
    to[a] = (int)fmin(x->n[a], ceil(pre->at[a] + far[a] + 1));
  }
  return hsr_window_make(from[0], from[1], to[0], to[1]);
}

/* The mean by the weights of all texels of a box. */
static void convolve(struct hsr_texture *x, const struct hsr_preimage *pre,
                     const double far[2], weight_of *weigh,
                     double mean[CHANNELS]) {
  struct hsr_window box = box_of(x, pre, far);
  double all = 0;
  for (int q = box.y0; q < box.y1; q++)
    for (int p = box.x0; p < box.x1; p++) {
      double weight = weigh(x, pre, p, q);
      HSR_STEP(x->tally, TRIES, HSR_CELL(0, p, q), HSR_THE_WINDOW,
               HSR_AT(pre->i, pre->j), weight > 0);
      if (weight <= 0)
        continue;
      HSR_STEP(x->tally, HSR_TEXTURE_TEXELS, HSR_CELL(0, p, q), HSR_THE_WINDOW,
               HSR_AT(pre->i, pre->j), 0);
      const uint16_t *texel = x->texel[(size_t)q * (size_t)x->n[0] + (size_t)p];
      for (int c = 0; c < CHANNELS; c++)
        mean[c] += weight * texel[c];
      all += weight;
    }
  for (int c = 0; c < CHANNELS && all > 0; c++)
    mean[c] /= all;
}

static void filter_by_splats(struct hsr_texture *x,
                             const struct hsr_preimage *pre,
                             double mean[CHANNELS]) {
  double far = far_of_splats(x, x->model, pre);
  convolve(x, pre, (double[2]){far, far}, weight_of_splat, mean);
}

static void filter_by_ellipse(struct hsr_texture *x,
                              const struct hsr_preimage *pre,
                              double mean[CHANNELS]) {
  double far[2];
  find_ellipse(x->model, pre, far);
  convolve(x, pre, far, weight_of_ellipse, mean);
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct hsr_texture x;
  struct model m;
  if (hsr_textures_begin(&x, job))
    return hsr_fail_nomem(err);
  measure_cells(&x, &m);
  m.reach = x.splats.reach * x.splats.splatting.width;
  x.model = &m;
  x.filter = job->option[0] == PREIMAGE ? filter_by_ellipse : filter_by_splats;
  hsr_textures_draw(&x, job);
  return HSR_OK;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {{&hsr_textures_part}, {NULL}};

static const struct hsr_counter counters[] = {
    [TRIES] = {"tries", "texels in boxes around filters", HSR_COMPARE,
               HSR_OF_CELL, HSR_OF_WINDOW, "outside|inside"},
    {NULL}};

static const struct hsr_line outline[] = {
    {"for each pixel: does its ray meet the layer?",
     HSR_RAISES(HSR_TEXTURE_RAYS)},
    {"  if so, for each texel of the box around the filter", HSR_RAISES(TRIES)},
    {"    if the filter reaches it, read it and add weight times colour",
     HSR_RAISES(HSR_TEXTURE_TEXELS)},
    {"  write the mean, if it is not empty", HSR_RAISES(HSR_TEXTURE_WRITES)},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(texture_convolve) = {
    .name = "texture-convolve",
    .numbered = HSR_NUMBERED_TEXELS,
    .title = "Texture mapping by direct convolution",
    .authors = "E. A. Feibush, M. Levoy and R. L. Cook; P. S. Heckbert",
    .year = 1980,
    .source = "Feibush, Levoy and Cook, Synthetic Texturing Using Digital "
              "Filters, SIGGRAPH 1980; Heckbert, Fundamentals of Texture "
              "Mapping and Image Warping, 1989",
    .options = options,
    .taxonomy = HSR_VOLUME_SPACE,
    .subjects = 1 << HSR_GRID,
    .makes = {{HSR_COMPOSITED, 1 << HSR_XRAY}},
    .flags = HSR_INSTANCED | HSR_KNOWN_WRONG,
    .prepare = hsr_textures_prepare,
    .release = hsr_textures_release,
    .parts = uses,
    .counters = counters,
    .outline = outline,
    .render = render};
