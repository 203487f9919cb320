/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The z-buffer for those who want the picture soon: triangles in batches and in
 * floats, with transparent faces and shadows. zbuffer.c is the textbook's.
 *
 * Source      Sutherland, Sproull and Schumacker 1974, appendix B, "Brute-Force
 *             Image-Space"; E. Catmull, PhD thesis, University of Utah, 1974.
 * Notation    that of tiler.h, which does the tiling
 * Invariant   that of tiler.h
 * Ties        those of tiler.h
 * Glass       transparent faces in layers, over the opaque ones: peel.h
 * Shadows     by a second view, from the light: light_view.h
 * Departures  none in what is compared: the culls that the paper calls
 *             universally applicable come first. With groups=cones many back
 *             faces, and faces outside of the picture, are culled together
 *             (groups.h): where the scene has triangles only, the samples lie
 *             on the tiler's grid, and the answer is ids alone, without glass
 *             and light
 * Cost        10 H_f^2 F_r predicted
 *
 * A large picture is cut into parts, which are tiled one after the other in one
 * small memory of depths and ids. The triangles are set up once and sorted into
 * the parts.
 *
 * A scene of very many faces comes as a roster, to save memory. Its instances
 * are tiled one after the other (stream.h), in one part. */
#include "algorithms/brute_force/zbuffer_fast/groups.h"
#include "algorithms/brute_force/zbuffer_fast/light_view.h"
#include "algorithms/brute_force/zbuffer_fast/peel.h"
#include "algorithms/brute_force/zbuffer_fast/stream.h"
#include "common/answers/kinds/shadowed.h"
#include "common/answers/kinds/transparent.h"

#include <stdlib.h>

enum { GROUPS, AWAY, OUT, LEFT_OUT };

enum { NO_GROUPS, CONES };
static const struct hsr_word groupings[] = {
    {"none", "each face is looked at", 0},
    {"cones", "those that cannot be seen are left out together",
     HSR_NEEDS_LAID_OUT},
    {NULL}};
static const struct hsr_option options[] = {
    {"groups", "of triangles, made beforehand", groupings, 0, 1, NO_GROUPS},
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
  const struct hsr_groups *groups; /* NULL: all faces are looked at */
  int *verdict;                    /* a group */
  struct hsr_stream *stream; /* of a roster; NULL: the world is laid out */
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
      t->kept[t->n_kept++] = hsr_tiler_take(&t->tiler, b, k);
  for (int k = 0; k < b->n; k++) {
    uint32_t f = hsr_tiler_face(&t->tiler, b, k);
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

/* --- The memory ----------------------------------------------------------- */

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
  if (!t->fast || t->stream || width * height <= ONE_PART) {
    tiler->z_stride = width;
    tiler->z = HSR_NEW(arena, float, width *height);
    tiler->ids_stride = (size_t)job->answer->m;
    tiler->ids = hsr_job_row(job, w->y0) + (size_t)w->x0;
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

/* --- Groups --------------------------------------------------------------- */

static void tell_group(const struct frame *t, uint32_t g) {
  struct hsr_tally *tally = t->job->tally;
  struct hsr_subject group = HSR_CELL(g, HSR_NO_ID, 0);
  const struct hsr_window *window = &t->tiler.window;
  int verdict = t->verdict[g];
  HSR_STEP(tally, GROUPS, group, HSR_THE_WINDOW, *window, verdict);
  if (verdict == HSR_GROUP_AWAY)
    HSR_STEP(tally, AWAY, group, HSR_NOTHING, HSR_NOWHERE, 0);
  if (verdict == HSR_GROUP_OUT)
    HSR_STEP(tally, OUT, group, HSR_THE_WINDOW, *window, 0);
  for (uint32_t k = t->groups->first[g];
       verdict != HSR_GROUP_KEPT && k < t->groups->first[g + 1]; k++)
    HSR_STEP(tally, LEFT_OUT, HSR_FACE(t->groups->list.face[k]), group,
             HSR_NOWHERE, 0);
}

/* In parallel: how far the groups lie along F, by the box around all. */
static void find_range_of_groups(struct frame *t) {
  const struct hsr_view *view = t->job->view;
  const struct hsr_box *box = &t->groups->bounds;
  double nearest = 0, farthest = 0, size = 0;
  for (int k = 0; k < 3; k++) {
    double lo = view->depth[k] * (box->lo[k] - view->E[k]),
           hi = view->depth[k] * (box->hi[k] - view->E[k]);
    nearest += fmin(lo, hi);
    farthest += fmax(lo, hi);
    size += fmax(fabs(lo), fabs(hi));
  }
  hsr_tiler_set_range(&t->tiler, nearest, farthest, size);
}

/* Looks at the groups, and snaps the vertices of those that are kept. */
static enum hsr_status look_at_groups(struct frame *t) {
  const struct hsr_groups *groups = t->groups;
  struct hsr_arena *arena = t->job->scratch;
  t->verdict = HSR_NEW(arena, int, groups->n);
  bool *needed = HSR_NEW(arena, bool, groups->n);
  if (!t->verdict || !needed)
    return HSR_E_NOMEM;
  hsr_groups_look(groups, t->job->view, t->verdict);
  for (uint32_t g = 0; HSR_COUNTING && g < groups->n; g++)
    tell_group(t, g);
  if (t->job->view->parallel)
    find_range_of_groups(t);
  t->tiler.list = &groups->list;
  hsr_groups_snap(groups, t->verdict, needed, &t->tiler);
  return HSR_OK;
}

/* --- The vertices --------------------------------------------------------- */

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

/* --- The algorithm -------------------------------------------------------- */

static enum hsr_status begin_roster(struct frame *t) {
  const struct hsr_job *job = t->job;
  hsr_tiler_begin(&t->tiler, job);
  t->fast = t->tiler.on_grid && job->world->roster.all_triangles;
  t->stream = HSR_NEW(job->scratch, struct hsr_stream, 1);
  return t->stream && !make_memory(t) &&
                 !hsr_stream_begin(t->stream, job, &t->tiler)
             ? HSR_OK
             : HSR_E_NOMEM;
}

static enum hsr_status begin_frame(struct frame *t) {
  const struct hsr_job *job = t->job;
  const struct hsr_world *world = job->world;
  struct hsr_tiler *tiler = &t->tiler;
  struct hsr_arena *arena = job->scratch;
  if (hsr_is_roster(world))
    return begin_roster(t);
  hsr_tiler_begin(tiler, job);
  tiler->glass = t->glass;
  t->fast = tiler->on_grid && world->roster.all_triangles;
  tiler->corner = HSR_NEW(arena, struct hsr_corner, world->mesh.n_vertices);
  size_t largest = world->roster.all_triangles ? 3 : hsr_most_corners(world);
  tiler->columns = HSR_NEW(arena, int, largest + 4);
  if (!tiler->corner || !tiler->columns || make_memory(t) ||
      hsr_screen_init(&tiler->screen, world, job->view, arena))
    return HSR_E_NOMEM;
  if (t->fast && !t->glass && !hsr_answer_lit_of(job->answer))
    t->groups = job->prepared;
  if (t->groups)
    return look_at_groups(t);
  hsr_screen_vertices(&tiler->screen);
  if (job->view->parallel)
    find_range(tiler, &world->mesh);
  hsr_tiler_snap(tiler);
  return HSR_OK;
}

static void tile_face_generally(struct frame *t, uint32_t f) {
  if (t->stream)
    hsr_stream_tile_generally(t->stream, &t->tiler, f);
  else if (hsr_tiler_place(&t->tiler, f))
    hsr_tiler_tile_generally(&t->tiler, f);
}

static void tile_batch(struct frame *t, const struct hsr_batch *b) {
  hsr_tiler_tile_batch(&t->tiler, b);
  for (int k = 0; k < b->n && b->general; k++)
    if (b->fate[k] == HSR_GENERALLY)
      tile_face_generally(t, hsr_tiler_face(&t->tiler, b, k));
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

/* The triangles from `first` up to `end`, of the world or of the list. */
static void tile_from(struct frame *t, uint32_t first, uint32_t end) {
  struct hsr_batch batch;
  for (uint32_t f = first; f < end; f += HSR_BATCH) {
    hsr_tiler_look(&t->tiler, &batch, f,
                   end - f < HSR_BATCH ? (int)(end - f) : HSR_BATCH);
    if (t->glass)
      leave_out_glass(t->glass, &batch);
    hsr_tiler_set_up(&t->tiler, &batch);
    if (t->kept)
      keep_batch(t, &batch);
    else
      tile_batch(t, &batch);
  }
}

/* Groups that follow each other are taken together. */
static void tile_groups(struct frame *t) {
  const struct hsr_groups *groups = t->groups;
  for (uint32_t g = 0, end; g < groups->n; g = end) {
    for (end = g + 1; end < groups->n && t->verdict[end] == t->verdict[g];)
      end++;
    if (t->verdict[g] == HSR_GROUP_KEPT)
      tile_from(t, groups->first[g], groups->first[end]);
  }
}

static enum hsr_status tile_triangles(struct frame *t) {
  if (t->groups)
    tile_groups(t);
  else
    tile_from(t, 0, t->job->world->n_faces);
  return t->kept ? tile_parts(t) : HSR_OK;
}

/* Instance after instance. */
static void tile_roster(struct frame *t) {
  for (uint32_t i = 0; i < t->job->world->roster.scene->n_instances; i++) {
    uint32_t n = hsr_stream_instance(t->stream, &t->tiler, i, t->fast);
    if (t->fast)
      tile_from(t, 0, n);
    for (uint32_t f = 0; f < n && !t->fast; f++)
      tile_face_generally(t, f);
  }
}

static enum hsr_status tile(struct frame *t) {
  if (!t->kept)
    hsr_tiler_begin_part(&t->tiler, t->tiler.window);
  if (t->stream) {
    tile_roster(t);
    return HSR_OK;
  }
  if (t->fast)
    return tile_triangles(t);
  for (uint32_t f = 0; f < t->job->world->n_faces; f++)
    if (!t->glass || !hsr_is_glass(t->glass, f))
      tile_face_generally(t, f);
  return HSR_OK;
}

/* The light, which sees all faces, asks for the planes of those, too, that the
 * tiler has dropped. */
static enum hsr_status cast_shadows(struct frame *t) {
  struct hsr_light_view view;
  hsr_screen_planes(&t->tiler.screen);
  if (hsr_light_view_begin(&view, t->job, &t->tiler.screen))
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
  if (hsr_answer_colours_of(job->answer) && hsr_glass_begin(&glass, job))
    return hsr_fail_nomem(err);
  t.glass = hsr_answer_colours_of(job->answer) ? &glass : NULL;
  if (begin_frame(&t) || tile(&t) || (t.glass && show_glass(&t)) ||
      (hsr_answer_lit_of(job->answer) && cast_shadows(&t)))
    return hsr_fail_nomem(err);
  return HSR_OK;
}

static enum hsr_status prepare(const struct hsr_world *world,
                               const long *option, void **prepared,
                               struct hsr_error *err) {
  if (option[0] == NO_GROUPS || !world->roster.all_triangles || !world->n_faces)
    return HSR_OK;
  struct hsr_groups *groups = malloc(sizeof *groups);
  *prepared = groups;
  return groups && !hsr_groups_make(groups, world) ? HSR_OK
                                                   : hsr_fail_nomem(err);
}

static void release(void *prepared) {
  hsr_groups_free(prepared);
  free(prepared);
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {{&hsr_tiler_part},
                                      {&hsr_peel_part},
                                      {&hsr_shadow_part},
                                      {&hsr_light_view_part},
                                      {NULL}};

static const struct hsr_counter counters[] = {
    [GROUPS] = {"groups tested", "of triangles: may one of them be seen?",
                HSR_COMPARE, HSR_OF_CELL, HSR_OF_WINDOW,
                "kept|turned away|outside"},
    [AWAY] = {"groups away", "by the cone of their normals", HSR_REJECT,
              HSR_OF_CELL, HSR_OF_NOTHING},
    [OUT] = {"groups out", "outside of the frustum", HSR_REJECT, HSR_OF_CELL,
             HSR_OF_WINDOW},
    [LEFT_OUT] = {"triangles left out", "with their groups", HSR_REJECT,
                  HSR_OF_FACE, HSR_OF_CELL},
    {NULL}};

static const struct hsr_line outline[] = {
    {"clear the memory: at each raster element, no face"},
    {"by groups: may a triangle of the group be seen?", HSR_RAISES(GROUPS)},
    {"  if all turn away, or are outside of the frustum: leave them out",
     HSR_RAISES(AWAY, OUT, LEFT_OUT)},
    {"for each face"},
    {"  ", .part = &hsr_tiler_part},
    {"", .part = &hsr_peel_part},
    {"show the recorded ids"},
    {"", .part = &hsr_light_view_part},
    {NULL}};

static double predict_tiling(const struct hsr_table1 *t) {
  return 10 * t->H_f * t->H_f * t->F_r;
}

static const struct hsr_step steps[] = {{"depth comparison", HSR_DEPTH_TESTS,
                                         HSR_KIND_SAMPLE, "10 H_f^2 F_r",
                                         predict_tiling},
                                        {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(zbuffer_fast) = {
    .name = "zbuffer-fast",
    .title = "The z-buffer, fast: triangles in batches and in floats",
    .authors = "E. Catmull; Sutherland, Sproull and Schumacker",
    .year = 1974,
    .source = "Catmull, PhD thesis, University of Utah, 1974; Sutherland et "
              "al., Computing Surveys 6(1), 1974, appendix B",
    .taxonomy = HSR_BRUTE_FORCE,
    .sort_order = "Z(XY)",
    .subjects = 1 << HSR_FACES,
    .flags = HSR_INSTANCED | HSR_LAID_OUT_UNLESS_LARGE,
    .makes = {{HSR_IDS}, {HSR_TRANSPARENT}, {HSR_SHADOWED}},
    .parts = uses,
    .counters = counters,
    .steps = steps,
    .outline = outline,
    .options = options,
    .prepare = prepare,
    .render = render,
    .release = release};
