/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The volumetric buffer: what splats give to a range of depths is added in each
 * pixel, and the ranges are composited from back to front. In the model slab it is
 * what the samples measured that is added (slab.h).
 *
 * Source      proposed by L. Westover, "Footprint Evaluation for Volume
 *             Rendering", 1990; described by J. E. Swan II, PhD thesis, Ohio
 *             State University, 1998, 1.2.2, and built by neither
 * Notation    the buckets and lambda of docs/composited-picture.md
 * Slices      the samples are sorted by the last bucket that they can reach, and
 *             visited from the back. So a bucket is complete after its slice, and is
 *             put over the picture. Only as many buckets are kept as a splat can
 *             reach. With blur all are: how far a splat reaches depends on its way.
 * Strips      the buckets are of a strip of the picture, so that they are not
 *             larger than MOST_BYTES. The grid is visited once for each strip.
 * Exact       lambda is found in doubles with a bound of its error, else exactly
 * Cost        as splats.h, times the buckets that a splat reaches; and all
 *             buckets of all pixels
 *
 * Invariant, ties, further departures are those of splats.h. */
#include "algorithms/volume/splats/slab.h"
#include "common/answers/kinds/composited.h"

#include <math.h>

enum { MOST_BYTES = 1 << 25, PARTS = HSR_FOOTPRINT_PARTS };

/* A tile's. Bucket b is at the place b mod depths.kept. */
struct model {
  struct hsr_splat_picture picture;
  struct hsr_splat_picture *bucket; /* NULL in the model slab */
  struct hsr_slab *slab;            /* NULL in the model volume */
  struct hsr_window *drawn;         /* of each bucket that is kept */
  int next;                         /* the bucket that is complete next */
};

struct depths {
  int n;               /* buckets */
  int kept;            /* of them at a time */
  double from, each;   /* the first begins there, and they are so deep */
  double per_each;     /* 1 / each; 0 if there is one */
  double off;          /* how far an end may be off */
  double lo[3], hi[3]; /* of all samples */
  double F[3];         /* the change of depth along each axis */
};

/* --- Depths --------------------------------------------------------------- */

/* One bucket, if all of the grid is in one depth or before near. */
static void find_depths(struct hsr_splats *s, struct depths *m) {
  const struct hsr_view *v = s->view;
  double from = INFINITY, to = -INFINITY;
  for (int a = 0; a < 3; a++) {
    m->lo[a] = s->grid->at[a][0];
    m->hi[a] = s->grid->at[a][s->grid->n[a] - 1];
  }
  for (int corner = 0; corner < 8; corner++) {
    double t = 0;
    for (int a = 0; a < 3; a++)
      t += s->term[a][3][corner >> a & 1 ? s->grid->n[a] - 1 : 0];
    from = fmin(from, t);
    to = fmax(to, t);
  }
  m->from = fmax(from, v->near);
  m->off = 0x1p-46 * (s->most[3] + v->near);
  m->n = s->splatting.buckets;
  if (!(to - m->from > m->off) &&
      !hsr_exact_is_deep(v, m->lo, m->hi, &s->tally->out_of_memory))
    m->n = 1;
  m->each = (to - m->from) / m->n;
  m->per_each = m->n > 1 ? 1 / m->each : 0;
}

/* --- Slices --------------------------------------------------------------- */

/* How depth changes along each axis: its product with P - E is t. */
static void find_slope(const struct hsr_view *v, double slope[3]) {
  double by = 0;
  for (int a = 0; a < 3; a++) {
    int b = (a + 1) % 3, c = (a + 2) % 3;
    slope[a] = v->R[b] * v->U[c] - v->R[c] * v->U[b];
    by += v->F[a] * slope[a];
  }
  for (int a = 0; a < 3; a++)
    slope[a] /= by;
}

/* The first and the last bucket that the splat of a sample can reach. It is in
 * pixels whose rays pass its middle within g r cells, and there for g r cells to
 * either side: within sqrt(2) g r cells of the middle. g is at most what a splat
 * that is so far away is widened by; a little is added for rounding. */
struct span {
  int first, last;
};

static struct span reached(const struct hsr_splats *s, const uint32_t at[3]) {
  const struct depths *m = s->common;
  const double root_2 = 1.4142135623730951, more = 1 + 0x1p-30;
  double t = 0, deep = 0;
  for (int a = 0; a < 3; a++) {
    t += s->term[a][HSR_TERM_DEPTH][at[a]];
    double cell = m->F[a] / s->per_size[a][at[a]];
    deep += cell * cell;
  }
  double apart = s->apart * (s->view->parallel ? 1 : t * t);
  double g = s->splatting.width * sqrt(hsr_max(1, apart));
  double reach = root_2 * g * s->reach * sqrt(deep) * more + 16 * m->off;
  double first = floor((t - reach - m->from) / m->each) - 1,
         last = floor((t + reach - m->from) / m->each) + 1;
  return (struct span){(int)hsr_min(hsr_max(first, 0), m->n - 1),
                       (int)hsr_min(hsr_max(last, 0), m->n - 1)};
}

static uint32_t slice_of(const struct hsr_splats *s, const uint32_t at[3]) {
  return (uint32_t)reached(s, at).last;
}

/* How many buckets must be kept at a time. */
static int most_reached(const struct hsr_splats *s) {
  const struct hsr_grid *g = s->grid;
  int most = 1;
  for (uint32_t row = 0; row < g->n[1] * g->n[2]; row++)
    for (uint32_t c = g->row[row]; c < g->row[row + 1]; c++) {
      const uint32_t at[3] = {g->x[c], row % g->n[1], row / g->n[1]};
      struct span span = reached(s, at);
      int here = span.last - span.first + 1;
      most = here > most ? here : most;
    }
  return most;
}

/* If all buckets are kept, all samples are in the last slice. */
static uint32_t last_slice(const struct hsr_splats *s, const uint32_t at[3]) {
  (void)at;
  return (uint32_t)((const struct depths *)s->common)->n - 1;
}

static enum hsr_status open_slices(struct hsr_splats *s, struct depths *m) {
  find_slope(s->view, m->F);
  bool is_narrow = !s->splatting.blur && m->n > 1 && m->each > 0;
  m->kept = is_narrow ? most_reached(s) : m->n;
  return hsr_splats_open_lists(s, (uint32_t)m->n,
                               m->kept < m->n ? slice_of : last_slice);
}

/* --- Splats --------------------------------------------------------------- */

/* The ray of a pixel, by depth. */
struct passage {
  double nearest; /* t*, the depth nearest to the middle of the kernel */
  double parts;   /* 32 / (g r) |D'|: lambda grows so by depth */
  double off;     /* how far t* may be off */
  double rough;   /* the relative error of lambda */
};

static struct passage passage_of(const struct hsr_splats *s,
                                 const struct hsr_placed *p, int i, int j) {
  struct hsr_splat_ray r = hsr_splats_ray(s, p, i, j);
  double moved = p->is_blurred ? hsr_splats_move(s, p, i, j, r.V) : 0;
  double VD = 0, DD = 0, vd = 0, dd = 0;
  for (int a = 0; a < 3; a++) {
    VD += r.V[a] * r.D[a];
    DD += r.D[a] * r.D[a];
    vd += r.v[a] * r.d[a];
    dd += r.d[a] * r.d[a];
  }
  /* the rounding of 1 / DD is within the margins of both numbers */
  double per = 1 / DD;
  double off = 0x1p-46 * (vd + fabs(VD) * (dd * per)) * per;
  if (moved > 0)
    off += 1.1 * moved / sqrt(DD);
  return (struct passage){VD * per, sqrt(p->scale * DD), off,
                          8 * p->rough + 0x1p-40};
}

/* lambda at the end of bucket b. */
static int part_before(struct hsr_splats *s, const struct hsr_placed *p, int i,
                       int j, const struct passage *ray, int b) {
  const struct depths *m = s->common;
  double past = m->from + (b + 1) * m->each - ray->nearest;
  double parts = fabs(past) * ray->parts;
  double error = (m->off + ray->off) * ray->parts + parts * ray->rough;
  int sign = past < 0 ? -1 : 1;
  if (parts - error >= PARTS)
    return sign * PARTS;
  /* both are below PARTS + 1, or the exact path is taken */
  int lo = parts > error ? (int)(parts - error) : 0,
      hi = (int)hsr_min(parts + error, 2 * PARTS);
  if (lo == hi)
    return sign * lo;
  s->tally->exact[HSR_ASK_FOOTPRINT]++;
  struct hsr_splat splat = hsr_splats_exact(s, p->at);
  return hsr_exact_footprint_part(&splat, i, j, m->lo, m->hi, b, m->n,
                                  &s->tally->out_of_memory);
}

/* The first bucket that the kernel may reach along this ray, or the last. */
static int bucket_at(const struct depths *m, double depth) {
  double b = (depth - m->from) * m->per_each;
  return b > 0 ? b < m->n - 1 ? (int)b : m->n - 1 : 0;
}

/* Adds a part of the splat to a bucket. */
static void add_part(struct hsr_splats *s, struct model *model,
                     const struct hsr_placed *p,
                     const struct hsr_slab_sample *sample, int b, int i, int j,
                     uint32_t weight) {
  const struct depths *depths = s->common;
  int at = b % depths->kept;
  hsr_splats_widen(&model->drawn[at], &p->box);
  if (model->slab)
    hsr_slab_add(&model->slab[at], hsr_splats_at(&model->picture, i, j), sample,
                 weight);
  else
    hsr_splats_add(s, p, &model->bucket[at], i, j, weight);
}

/* Puts the splat into the buckets of a pixel. */
static void draw_pixel(struct hsr_splats *s, struct model *model,
                       const struct hsr_placed *p,
                       const struct hsr_slab_sample *sample, int i, int j,
                       int kappa) {
  const struct depths *m = s->common;
  const struct passage ray = passage_of(s, p, i, j);
  double reach = (PARTS + 1) / ray.parts + ray.off + m->off;
  int b = m->n > 1 ? bucket_at(m, ray.nearest - reach) : 0;
  uint32_t before = 0;
  for (bool more = true; more && b < m->n; b++) {
    int part = b < m->n - 1 ? part_before(s, p, i, j, &ray, b) : PARTS;
    uint32_t here = hsr_splats_between(s->before[part + PARTS], kappa);
    if (here > before)
      add_part(s, model, p, sample, b, i, j, here - before);
    before = here;
    more = part < PARTS;
  }
}

static void draw(struct hsr_splats *s, struct hsr_splat_tile *tile,
                 const struct hsr_placed *p) {
  struct model *m = tile->model;
  struct hsr_slab_sample sample = {{0}};
  int32_t index[HSR_SPLAT_LANES];
  if (m->slab)
    sample = hsr_slab_sample(s, p);
  HSR_STEP(s->tally, HSR_SPLAT_SPLATS, HSR_CELL(p->cell, 0, 0), HSR_THE_WINDOW,
           p->box, 2);
  for (int j = p->box.y0; j < p->box.y1; j++)
    for (int x = p->box.x0; x < p->box.x1; x += HSR_SPLAT_LANES) {
      hsr_splats_find(s, p, x, j, index);
      for (int l = 0; l < HSR_SPLAT_LANES; l++)
        if (index[l] < HSR_FOOTPRINT) {
          HSR_STEP(s->tally, HSR_SPLAT_UPDATES, HSR_CELL(p->cell, 0, 0),
                   HSR_THE_WINDOW, HSR_AT(x + l, j), 0);
          HSR_TOUCH(s->tally, x + l, j);
          draw_pixel(s, m, p, &sample, x + l, j, index[l]);
        }
    }
}

/* --- A frame -------------------------------------------------------------- */

static enum hsr_status open_parts(struct hsr_splats *s) {
  for (int part = 0; part <= 2 * PARTS; part++) {
    s->before[part] = HSR_NEW(s->job->scratch, uint16_t, HSR_SPLAT_KNOTS + 1);
    if (!s->before[part])
      return HSR_E_NOMEM;
  }
  hsr_splats_fill_parts(s);
  return HSR_OK;
}

/* The buffers of a strip of the window, which s->window is from here on. */
static void choose_strip(struct hsr_splats *s, const struct depths *depths) {
  struct hsr_window *w = &s->window;
  const struct hsr_splat_picture *none = NULL;
  const struct hsr_slab *slab = NULL;
  const size_t pixel = s->splatting.model == HSR_SLAB ? sizeof *slab->sum
                       : s->splatting.per_length
                           ? sizeof *none->sum + sizeof *none->weight
                           : sizeof *none->rgba;
  int64_t row = (int64_t)(w->x1 - w->x0 + HSR_SPLAT_LANES) * depths->kept *
                (int64_t)pixel;
  int64_t rows = MOST_BYTES / row > 0 ? MOST_BYTES / row : 1;
  if (rows < w->y1 - w->y0)
    w->y1 = w->y0 + (int)rows;
}

static enum hsr_status open_slabs(struct hsr_splats *s, struct model *m,
                                  size_t n) {
  m->slab = HSR_NEW(s->job->scratch, struct hsr_slab, n);
  for (size_t b = 0; m->slab && b < n; b++)
    if (hsr_slab_open(s, &m->picture, &m->slab[b]))
      return HSR_E_NOMEM;
  return m->slab ? HSR_OK : HSR_E_NOMEM;
}

static enum hsr_status open_buckets(struct hsr_splats *s,
                                    struct hsr_splat_tile *tile,
                                    struct model *m, size_t n) {
  m->bucket = HSR_NEW(s->job->scratch, struct hsr_splat_picture, n);
  for (size_t b = 0; m->bucket && b < n; b++)
    if (hsr_splats_open_sums(s, tile, &m->bucket[b]))
      return HSR_E_NOMEM;
  return m->bucket ? HSR_OK : HSR_E_NOMEM;
}

static void begin_strip(struct hsr_splats *s, struct hsr_splat_tile *tile) {
  struct model *m = tile->model;
  const struct depths *depths = s->common;
  m->next = depths->n - 1;
  for (int b = 0; b < depths->kept; b++)
    m->drawn[b] = hsr_splats_none(&tile->window);
}

static enum hsr_status open(struct hsr_splats *s, struct hsr_splat_tile *tile) {
  struct model *m = tile->model;
  size_t n = (size_t)((const struct depths *)s->common)->kept;
  m->drawn = HSR_NEW(s->job->scratch, struct hsr_window, n);
  if (!m->drawn || hsr_splats_open(s, tile, &m->picture))
    return HSR_E_NOMEM;
  return s->splatting.model == HSR_SLAB ? open_slabs(s, m, n)
                                        : open_buckets(s, tile, m, n);
}

/* The bucket that is complete goes over the picture. */
static void fold(struct hsr_splats *s, struct hsr_splat_tile *tile) {
  struct model *m = tile->model;
  int at = m->next-- % ((const struct depths *)s->common)->kept;
  if (m->slab)
    hsr_slab_fold(s, &m->slab[at], &m->drawn[at], &m->picture);
  else
    hsr_splats_fold(s, &m->bucket[at], &m->drawn[at], &m->picture);
  m->drawn[at] = hsr_splats_none(&tile->window);
}

static const struct hsr_splats_module how = {
    .size = sizeof(struct model), .open = open, .draw = draw, .fold = fold};

static void finish(struct hsr_splats *s, struct hsr_splat_tile *tile) {
  struct model *m = tile->model;
  hsr_splats_finish(s, &m->picture);
  hsr_splats_clear(&m->picture);
}

static enum hsr_status draw_frame(const struct hsr_job *job,
                                  struct hsr_error *err) {
  struct hsr_splats s;
  struct depths depths;
  const struct hsr_window *all = &job->view->window;
  if (hsr_splats_begin(&s, job) || open_parts(&s))
    return hsr_fail_nomem(err);
  find_depths(&s, &depths);
  s.common = &depths;
  if (open_slices(&s, &depths))
    return hsr_fail_nomem(err);
  choose_strip(&s, &depths);
  if (hsr_splats_divide(&s, &how))
    return hsr_fail_nomem(err);
  enum hsr_status status = HSR_OK;
  int rows = s.window.y1 - s.window.y0;
  s.visits = (all->y1 - all->y0 + rows - 1) / rows;
  for (int y = all->y0; y < all->y1 && !status; y += rows) {
    s.window.y0 = y;
    s.window.y1 = y + rows < all->y1 ? y + rows : all->y1;
    hsr_splats_lay(&s);
    hsr_splats_each(&s, begin_strip);
    uint32_t n = (uint32_t)depths.n;
    status = hsr_splats_visit_slices(&s, 0, n - 1, n, -1, err);
    hsr_splats_each(&s, finish);
  }
  return status;
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  return hsr_splats_accumulate(job, draw_frame, err);
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {
    {&hsr_splats_part}, {&hsr_folds_part}, {NULL}};

static const struct hsr_line outline[] = {
    {"for each row of samples; is its box out of the window? leave it",
     HSR_RAISES(HSR_SPLAT_ROWS)},
    {"  sort its samples by the last bucket that they can reach"},
    {"for each bucket, from the last to the first"},
    {"  for each of its samples", HSR_RAISES(HSR_SPLAT_CELLS)},
    {"      find its footprint; is it out of sight? leave it",
     HSR_RAISES(HSR_SPLAT_SPLATS)},
    {"    for each pixel of the footprint", HSR_RAISES(HSR_SPLAT_UPDATES)},
    {"      add the parts of the kernel, times colour, to the buckets that "
     "they are in"},
    {"  put the bucket over the picture", HSR_RAISES(HSR_SPLAT_FOLDS)},
    {"write the pixels that are not empty", HSR_RAISES(HSR_SPLAT_WRITES)},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(splat_volume) = {
    .name = "splat-volume",
    .title = "Splatting with a volumetric buffer",
    .authors = "L. Westover",
    .year = 1990,
    .source = "Westover, Footprint Evaluation for Volume Rendering, SIGGRAPH "
              "1990; Swan, Object-Order Rendering of Discrete Objects, PhD "
              "thesis, Ohio State University, 1998",
    .sort_order = "(XY)Z",
    .taxonomy = HSR_VOLUME_SPACE,
    .coherence = "object",
    .subjects = 1 << HSR_GRID,
    .makes = {{HSR_COMPOSITED, 1 << HSR_VOLUME | 1 << HSR_SLAB}},
    .flags = HSR_INSTANCED | HSR_OWN_TILES,
    .parts = uses,
    .outline = outline,
    .render = render};
