/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Brute force with a large memory: the z-buffer.
 *
 * Source      Sutherland, Sproull and Schumacker 1974, appendix B, "Brute-Force
 *             Image-Space"; E. Catmull, PhD thesis, University of Utah, 1974.
 * Notation    that of tiler.h, which does the tiling
 * Invariant   that of tiler.h
 * Ties        those of tiler.h
 * Glass       transparent faces in layers, over the opaque ones: peel.h
 * Shadows     by a second view, from the light: light_view.h
 * Departures  none in what is compared: the culls that the paper calls
 *             universally applicable come first
 * Cost        10 H_f^2 F_r predicted
 *
 * A large picture is cut into parts, which are tiled one after the other in one
 * small memory of depths and ids. The triangles are set up once and sorted into
 * the parts. */
#include "algorithms/brute_force/light_view.h"
#include "algorithms/brute_force/peel.h"

enum { SHADOWS = HSR_PEEL_SHOWN + 1 };

static const struct hsr_counter counters[] = {
    HSR_TILER_COUNTERS, HSR_PEEL_COUNTERS, HSR_LIGHT_VIEW_COUNTERS, {NULL}};

static const struct hsr_line outline[] = {
    {"clear the memory: at each raster element, no face"},
    {"for each face"},
    HSR_TILER_LINES("  "),
    HSR_PEEL_LINES,
    {"show the recorded ids"},
    HSR_LIGHT_VIEW_LINES(SHADOWS, ""),
    {NULL}};

static double predict_tiling(const struct hsr_table1 *t) {
  return 10 * t->H_f * t->H_f * t->F_r;
}

static const struct hsr_step steps[] = {
    {"depth comparison", HSR_DEPTH_TESTS, 10, "10 H_f^2 F_r", predict_tiling},
    {NULL}};

enum {
  ONE_PART = 1 << 20, /* samples of a picture that is not cut into parts */
  PART_WIDTH = 512,   /* samples; depths and ids of a part stay in the second */
  PART_HEIGHT = 64,   /* level cache, few triangles lie in two of them */
  PAD = 16 /* floats: rows of a part do not meet in the same cache sets */
};

struct frame {
  const struct hsr_job *job;
  struct hsr_tiler tiler;
  struct hsr_glass *glass; /* if the picture is transparent; else NULL */
  bool fast;               /* triangles only, and samples on the grid */
  int parts_across, parts_down;
  struct hsr_triangle
      *kept; /* set up, for all parts; NULL if there is but one */
  size_t n_kept;
};

/* --- Parts ---------------------------------------------------------------- */

/* Keeps what a batch has to be tiled. */
static void keep_batch(struct frame *t, const struct hsr_batch *b) {
  for (int k = 0; k < b->n_fast; k++)
    if (b->good[k])
      t->kept[t->n_kept++] = hsr_tiler_take(b, k);
  for (int k = 0; k < b->n; k++) {
    uint32_t f = b->first + (uint32_t)k;
    if (b->fate[k] != HSR_GENERALLY || !hsr_tiler_place(&t->tiler, f))
      continue;
    const struct hsr_bounds *box = &t->tiler.screen.bounds[f];
    t->kept[t->n_kept++] = (struct hsr_triangle){.x0 = box->x0,
                                                 .y0 = box->y0,
                                                 .x1 = box->x1,
                                                 .y1 = box->y1,
                                                 .face = f,
                                                 .generally = true};
  }
}

/* The parts that a triangle's box meets: columns [x0, x1), rows [y0, y1) of
 * them. */
static struct hsr_window parts_of(const struct frame *t,
                                  const struct hsr_triangle *tri) {
  const struct hsr_window *w = &t->tiler.window;
  int x0 = tri->x0 < w->x0 ? w->x0 : tri->x0;
  int y0 = tri->y0 < w->y0 ? w->y0 : tri->y0;
  int x1 = tri->x1 > w->x1 ? w->x1 : tri->x1;
  int y1 = tri->y1 > w->y1 ? w->y1 : tri->y1;
  return (struct hsr_window){
      (x0 - w->x0) / PART_WIDTH, (y0 - w->y0) / PART_HEIGHT,
      (x1 - 1 - w->x0) / PART_WIDTH + 1, (y1 - 1 - w->y0) / PART_HEIGHT + 1};
}

/* Counting sort: those of part p are kept[order[start[p]]] to
 * kept[order[start[p + 1] - 1]], in the order in which they were kept. */
static enum hsr_status sort_into_parts(const struct frame *t, size_t **start,
                                       uint32_t **order) {
  struct hsr_arena *arena = t->job->scratch;
  size_t n_parts = (size_t)t->parts_across * (size_t)t->parts_down;
  size_t *end = HSR_NEW_ZEROED(arena, size_t, n_parts + 2);
  if (!end)
    return HSR_E_NOMEM;
  for (size_t k = 0; k < t->n_kept; k++) {
    struct hsr_window parts = parts_of(t, &t->kept[k]);
    for (int y = parts.y0; y < parts.y1; y++)
      for (int x = parts.x0; x < parts.x1; x++)
        end[y * t->parts_across + x + 2]++;
  }
  for (size_t p = 0; p < n_parts; p++)
    end[p + 2] += end[p + 1];
  *start = end; /* in the end, end[p] is where part p - 1 ends */
  *order = HSR_NEW(arena, uint32_t, end[n_parts + 1] + 1);
  if (!*order)
    return HSR_E_NOMEM;
  for (size_t k = 0; k < t->n_kept; k++) {
    struct hsr_window parts = parts_of(t, &t->kept[k]);
    for (int y = parts.y0; y < parts.y1; y++)
      for (int x = parts.x0; x < parts.x1; x++)
        (*order)[end[y * t->parts_across + x + 1]++] = (uint32_t)k;
  }
  return HSR_OK;
}

static struct hsr_window part_at(const struct frame *t, int x, int y) {
  const struct hsr_window *w = &t->tiler.window;
  int x0 = w->x0 + x * PART_WIDTH, y0 = w->y0 + y * PART_HEIGHT;
  return (struct hsr_window){
      x0, y0, w->x1 - x0 < PART_WIDTH ? w->x1 : x0 + PART_WIDTH,
      w->y1 - y0 < PART_HEIGHT ? w->y1 : y0 + PART_HEIGHT};
}

/* Tiles what was kept, part by part. */
static enum hsr_status tile_parts(struct frame *t) {
  size_t *start;
  uint32_t *order;
  if (sort_into_parts(t, &start, &order))
    return HSR_E_NOMEM;
  for (int p = 0; p < t->parts_across * t->parts_down; p++) {
    hsr_tiler_begin_part(&t->tiler,
                         part_at(t, p % t->parts_across, p / t->parts_across));
    for (size_t k = start[p]; k < start[p + 1]; k++) {
      const struct hsr_triangle *triangle = &t->kept[order[k]];
      if (triangle->generally)
        hsr_tiler_tile_generally(&t->tiler, triangle->face);
      else
        hsr_tiler_tile(&t->tiler, triangle);
    }
    hsr_tiler_write_back(&t->tiler, t->job);
  }
  return HSR_OK;
}

/* --- The algorithm -------------------------------------------------------- */

/* The memory of depths, of the picture; or of depths and ids, of a part. */
static enum hsr_status make_memory(struct frame *t) {
  const struct hsr_job *job = t->job;
  struct hsr_tiler *tiler = &t->tiler;
  struct hsr_arena *arena = job->scratch;
  const struct hsr_window *w = &tiler->window;
  size_t width = (size_t)(w->x1 - w->x0), height = (size_t)(w->y1 - w->y0);
  if (t->glass) {
    tiler->z_stride = tiler->ids_stride = width;
    tiler->z = HSR_NEW(arena, float, width *height);
    tiler->ids = HSR_NEW(arena, uint32_t, width * height);
    return tiler->z && tiler->ids ? HSR_OK : HSR_E_NOMEM;
  }
  if (!t->fast || width * height <= ONE_PART) {
    tiler->z_stride = width;
    tiler->z = HSR_NEW(arena, float, width *height);
    tiler->ids_stride = job->ids_stride;
    tiler->ids = job->ids + (size_t)w->y0 * job->ids_stride + (size_t)w->x0;
    return tiler->z ? HSR_OK : HSR_E_NOMEM;
  }
  tiler->z_stride = tiler->ids_stride = PART_WIDTH + PAD;
  tiler->z = HSR_NEW(arena, float, PART_HEIGHT * tiler->z_stride);
  tiler->ids = HSR_NEW(arena, uint32_t, PART_HEIGHT * tiler->ids_stride);
  t->kept = HSR_NEW(arena, struct hsr_triangle, job->world->n_faces);
  t->parts_across = (int)((width + PART_WIDTH - 1) / PART_WIDTH);
  t->parts_down = (int)((height + PART_HEIGHT - 1) / PART_HEIGHT);
  return tiler->z && tiler->ids && t->kept ? HSR_OK : HSR_E_NOMEM;
}

/* In parallel: how far the vertices lie along F. */
static void find_range(struct hsr_tiler *tiler, const struct hsr_mesh *mesh) {
  const double *E = tiler->view->E, *d = tiler->view->depth;
  double nearest = INFINITY, farthest = -INFINITY, size = 0;
  for (size_t v = 0; v < mesh->n_vertices; v++) {
    double x = d[0] * (mesh->x[v] - E[0]), y = d[1] * (mesh->y[v] - E[1]),
           z = d[2] * (mesh->z[v] - E[2]);
    double t = x + y + z, sizes = fabs(x) + fabs(y) + fabs(z);
    nearest = t < nearest ? t : nearest;
    farthest = t > farthest ? t : farthest;
    size = sizes > size ? sizes : size;
  }
  hsr_tiler_set_range(tiler, nearest, farthest, size);
}

static enum hsr_status begin_frame(struct frame *t) {
  const struct hsr_job *job = t->job;
  const struct hsr_world *world = job->world;
  struct hsr_tiler *tiler = &t->tiler;
  struct hsr_arena *arena = job->scratch;
  size_t largest = 3;
  if (!world->outline.all_triangles)
    for (uint32_t f = 0; f < world->n_faces; f++)
      if (largest < hsr_face_size(world, f))
        largest = hsr_face_size(world, f);

  hsr_tiler_begin(tiler, job);
  tiler->glass = t->glass;
  t->fast = tiler->on_grid && world->outline.all_triangles;
  tiler->corner = HSR_NEW(arena, struct hsr_corner, world->mesh.n_vertices);
  tiler->columns = HSR_NEW(arena, int, largest + 4);
  if (!tiler->corner || !tiler->columns || make_memory(t) ||
      hsr_screen_init(&tiler->screen, world, job->view, arena))
    return HSR_E_NOMEM;
  hsr_screen_vertices(&tiler->screen);
  if (job->view->parallel)
    find_range(tiler, &world->mesh);
  hsr_tiler_snap(tiler);
  return HSR_OK;
}

static void tile_face_generally(struct hsr_tiler *tiler, uint32_t f) {
  if (hsr_tiler_place(tiler, f))
    hsr_tiler_tile_generally(tiler, f);
}

static void tile_batch(struct hsr_tiler *tiler, const struct hsr_batch *b) {
  hsr_tiler_tile_batch(tiler, b);
  for (int k = 0; k < b->n && b->general; k++)
    if (b->fate[k] == HSR_GENERALLY)
      tile_face_generally(tiler, b->first + (uint32_t)k);
}

/* Drops the transparent faces of a batch. */
static void leave_out_glass(struct hsr_glass *glass, struct hsr_batch *b) {
  int drop[HSR_BATCH];
  for (int k = 0; k < b->n_fast; k++)
    drop[k] = hsr_is_glass(glass, b->first + (uint32_t)b->place[k]);
  hsr_tiler_drop(b, drop);
  for (int k = 0; k < b->n; k++)
    if (hsr_is_glass(glass, b->first + (uint32_t)k))
      b->fate[k] = HSR_DROP;
}

static enum hsr_status tile_triangles(struct frame *t) {
  uint32_t n = t->job->world->n_faces;
  struct hsr_batch batch;
  for (uint32_t f = 0; f < n; f += HSR_BATCH) {
    hsr_tiler_look(&t->tiler, &batch, f,
                   n - f < HSR_BATCH ? (int)(n - f) : HSR_BATCH);
    if (t->glass)
      leave_out_glass(t->glass, &batch);
    hsr_tiler_set_up(&t->tiler, &batch);
    if (t->kept)
      keep_batch(t, &batch);
    else
      tile_batch(&t->tiler, &batch);
  }
  return t->kept ? tile_parts(t) : HSR_OK;
}

static enum hsr_status tile(struct frame *t) {
  if (!t->kept)
    hsr_tiler_begin_part(&t->tiler, t->tiler.window);
  if (t->fast)
    return tile_triangles(t);
  for (uint32_t f = 0; f < t->job->world->n_faces; f++)
    if (!t->glass || !hsr_is_glass(t->glass, f))
      tile_face_generally(&t->tiler, f);
  return HSR_OK;
}

/* The light, which sees all faces, asks for the planes of those, too, that the
 * tiler has dropped. */
static enum hsr_status cast_shadows(struct frame *t) {
  struct hsr_light_view view;
  hsr_screen_planes(&t->tiler.screen);
  if (hsr_light_view_begin(&view, t->job, &t->tiler.screen, SHADOWS))
    return HSR_E_NOMEM;
  hsr_light_view_show(&view);
  return HSR_OK;
}

/* Puts the transparent faces over the opaque ones. It compares them in depth with
 * faces, too, that were tiled in floats, without their planes. */
static enum hsr_status show_glass(struct frame *t) {
  hsr_screen_planes(&t->tiler.screen);
  return hsr_peel(t->glass, &t->tiler);
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct frame t = {.job = job};
  struct hsr_glass glass;
  if (job->colours && hsr_glass_begin(&glass, job))
    return hsr_fail_nomem(err);
  t.glass = job->colours ? &glass : NULL;
  if (begin_frame(&t) || tile(&t) || (t.glass && show_glass(&t)) ||
      (job->lit && cast_shadows(&t)))
    return hsr_fail_nomem(err);
  return HSR_OK;
}

const struct hsr_algorithm HSR_ALGORITHM(zbuffer) = {
    .name = "zbuffer",
    .title = "Brute force with a large memory: the z-buffer",
    .authors = "E. Catmull; Sutherland, Sproull and Schumacker",
    .year = 1974,
    .source = "Catmull, PhD thesis, University of Utah, 1974; Sutherland et "
              "al., Computing Surveys 6(1), 1974, appendix B",
    .taxonomy = HSR_BRUTE_FORCE,
    .sort_order = "Z(XY)",
    .subjects = 1 << HSR_FACES,
    .kind = HSR_IDS,
    .also = {HSR_TRANSPARENT, HSR_SHADOWED},
    .counters = counters,
    .steps = steps,
    .outline = outline,
    .render = render};
