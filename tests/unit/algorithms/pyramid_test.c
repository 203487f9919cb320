/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The z-pyramid, in windows of any size and place: after any writes it equals a
 * rebuilt one, and its tests agree with a look at every sample. */
#define HSR_COUNTING 1
#include "algorithms/counting-names.h" /* the functions of that build */
#include "algorithms/engines/pyramid/pyramid.h"
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { M = 150, N = 140, WINDOWS = 40 };

static float random_depth(uint64_t *seed) {
  return (float)draw_integer(seed, 1, 1000) / 1000;
}

/* A box in the window, not empty. */
static struct hsr_bounds random_box(const struct hsr_window *w,
                                    uint64_t *seed) {
  int x0 = (int)draw_integer(seed, w->x0, w->x1 - 1);
  int y0 = (int)draw_integer(seed, w->y0, w->y1 - 1);
  bool small = draw_integer(seed, 0, 2) > 0;
  int x1 = (int)draw_integer(seed, x0 + 1, w->x1);
  int y1 = (int)draw_integer(seed, y0 + 1, w->y1);
  if (small && x1 > x0 + 5)
    x1 = x0 + 5;
  if (small && y1 > y0 + 5)
    y1 = y0 + 5;
  return (struct hsr_bounds){x0, y0, x1, y1};
}

static struct hsr_window random_window(int k, uint64_t *seed) {
  static const struct hsr_window some[] = {
      {0, 0, 1, 1},     {7, 9, 8, 10}, {3, 0, 4, 64},     {0, 0, 64, 64},
      {0, 0, 128, 128}, {5, 6, 70, 8}, {149, 0, 150, 140}};
  if (k < (int)(sizeof some / sizeof *some))
    return some[k];
  struct hsr_window all = {0, 0, M, N};
  struct hsr_bounds b = random_box(&all, seed);
  return (struct hsr_window){b.x0, b.y0, b.x1, b.y1};
}

/* --- A pyramid by its definition ------------------------------------------ */

/* The depth recorded at a sample of the window. */
static float depth_at(const struct hsr_pyramid *p, int i, int j) {
  const struct hsr_window *w = &p->window;
  return p->far[0][((size_t)(j - w->y0) << (p->n_levels - 1)) +
                   (size_t)(i - w->x0)];
}

/* The extremes of the samples in a box, found one by one; and whether all of it
 * is in the window. Samples outside hide nothing that is inside. */
struct extremes {
  float far, near;
  bool inside;
};

static struct extremes extremes_in(const struct hsr_pyramid *p,
                                   struct hsr_bounds box) {
  const struct hsr_window *w = &p->window;
  struct extremes e = {HUGE_VALF, 0, box.x1 <= w->x1 && box.y1 <= w->y1};
  for (int j = box.y0; j < box.y1 && j < w->y1; j++)
    for (int i = box.x0; i < box.x1 && i < w->x1; i++) {
      float z = depth_at(p, i, j);
      e.far = fminf(e.far, isnan(z) ? 0 : z);
      e.near = fmaxf(e.near, isnan(z) ? HUGE_VALF : z);
    }
  return e;
}

static struct hsr_bounds entry_box(const struct hsr_pyramid *p, int level,
                                   int x, int y) {
  int size = 1 << level, x0 = p->window.x0 + x * size,
      y0 = p->window.y0 + y * size;
  return (struct hsr_bounds){x0, y0, x0 + size, y0 + size};
}

/* Is it the nearest depth? An entry that reaches beyond the window may be
 * nearer. */
static bool is_near(float near, const struct extremes *e) {
  return near == e->near || (!e->inside && near > e->near);
}

/* The number of entries that are not the extremes of their samples. */
static long count_wrong(const struct hsr_pyramid *p) {
  long wrong = 0;
  for (int level = 1; level < p->n_levels; level++) {
    int side = 1 << (p->n_levels - 1 - level);
    for (int y = 0; y < side; y++)
      for (int x = 0; x < side; x++) {
        struct extremes e = extremes_in(p, entry_box(p, level, x, y));
        size_t cell = (size_t)y * (size_t)side + (size_t)x;
        wrong += p->far[level][cell] != e.far;
        wrong += p->near[level] && !is_near(p->near[level][cell], &e);
      }
  }
  return wrong;
}

/* --- Writing and updating ------------------------------------------------- */

struct memory {
  struct hsr_pyramid pyramid;
  struct hsr_tally tally; /* of entries read: counter READS */
  struct hsr_entry_count count;
  size_t stride;
  struct hsr_arena arena;
};

enum { READS = 3 };

static uint64_t reads_of(const struct hsr_pyramid *p) {
  return p->count->tally->count[READS];
}

static void begin(struct memory *m, const struct hsr_window *window,
                  bool near) {
  m->arena = (struct hsr_arena)HSR_ARENA_EMPTY;
  m->tally = (struct hsr_tally){.trace = NULL};
  if (hsr_pyramid_init(&m->pyramid, window, near, &m->stride, &m->arena))
    bail("out of memory");
  m->count = (struct hsr_entry_count){.tally = &m->tally, .reads = READS};
  m->pyramid.count = &m->count;
  hsr_pyramid_clear(&m->pyramid);
}

static float *sample_of(struct memory *m, int i, int j) {
  const struct hsr_window *w = &m->pyramid.window;
  return &m->pyramid
              .far[0][(size_t)(j - w->y0) * m->stride + (size_t)(i - w->x0)];
}

/* Writes into some samples of a box: mostly nearer depths, or unknown ones, or
 * completes them. */
static void write_some(struct memory *m, struct hsr_bounds box,
                       uint64_t *seed) {
  for (int j = box.y0; j < box.y1; j++)
    for (int i = box.x0; i < box.x1; i++) {
      int64_t kind = draw_integer(seed, 0, 39);
      float *z = sample_of(m, i, j), q = random_depth(seed);
      if (kind < 30)
        *z = q > *z || kind < 4 ? q : *z;
      else if (kind == 38)
        *z = NAN;
      else if (kind == 39)
        *z = HUGE_VALF;
    }
}

static void test_updates(struct tap *tap, bool near, uint64_t *seed) {
  long wrong = 0, looked = 0;
  for (int k = 0; k < WINDOWS; k++) {
    struct hsr_window window = random_window(k, seed);
    struct memory m;
    begin(&m, &window, near);
    wrong += count_wrong(&m.pyramid);
    for (int writes = 0; writes < 25; writes++) {
      struct hsr_bounds box[3];
      int n = (int)draw_integer(seed, 1, 3);
      for (int b = 0; b < n; b++)
        write_some(&m, box[b] = random_box(&window, seed), seed);
      for (int b = 0; b < n; b++)
        hsr_pyramid_update(&m.pyramid, box[b]);
      wrong += count_wrong(&m.pyramid);
      looked++;
    }
    hsr_arena_free(&m.arena);
  }
  ok(tap, !wrong, "after %ld updates every entry is as rebuilt%s: %ld are not",
     looked, near ? ", with the nearest" : "", wrong);
}

/* An update goes up no farther than it must: nothing above an entry that did
 * not change is written. */
static void test_early_stop(struct tap *tap) {
  struct hsr_window window = {0, 0, 64, 64};
  struct hsr_bounds box = {0, 0, 1, 1};
  struct memory m;
  begin(&m, &window, false);
  m.pyramid.far[6][0] = 0.25f; /* no update would give this */
  *sample_of(&m, 0, 0) = 0.5f;
  hsr_pyramid_update(&m.pyramid, box);
  ok(tap, m.pyramid.far[6][0] == 0.25f,
     "an update stops where it changes nothing");
  hsr_arena_free(&m.arena);
}

/* --- Tests of boxes ------------------------------------------------------- */

/* The smallest entry that encloses a box. */
static struct hsr_bounds enclosing(const struct hsr_pyramid *p,
                                   struct hsr_bounds box) {
  for (int level = 0;; level++) {
    int x = (box.x0 - p->window.x0) >> level,
        y = (box.y0 - p->window.y0) >> level;
    struct hsr_bounds e = entry_box(p, level, x, y);
    if (box.x1 <= e.x1 && box.y1 <= e.y1)
      return e;
  }
}

struct said {
  long hidden, basic, before, in_doubt, wrong, reads;
};

static void ask(struct hsr_pyramid *p, struct hsr_bounds box, float q,
                struct said *s) {
  struct extremes in = extremes_in(p, box),
                  around = extremes_in(p, enclosing(p, box));
  uint64_t reads = reads_of(p),
           area = (uint64_t)(box.x1 - box.x0) * (uint64_t)(box.y1 - box.y0);
  bool hidden = hsr_pyramid_hides(p, box, q);
  s->wrong += reads_of(p) == reads ||
              reads_of(p) > reads + 8 * (uint64_t)p->n_levels + 2 * area;
  reads = reads_of(p);
  bool basic = hsr_pyramid_basic(p, box, q);
  s->wrong += reads_of(p) != reads + 1;
  s->wrong += hidden != (q * HSR_CLEAR < in.far);
  s->wrong += basic != (q * HSR_CLEAR < around.far) || (basic && !hidden);
  s->in_doubt += q < in.far && !hidden;
  s->hidden += hidden;
  s->basic += basic;
  if (!p->near[0])
    return;
  bool before = hsr_pyramid_before(p, box, q);
  bool truly = q > HSR_CLEAR * around.near;
  s->wrong += reads_of(p) != reads + 2 || (before && !truly) ||
              (around.inside && before != truly);
  s->before += before;
}

static void test_boxes(struct tap *tap, uint64_t *seed) {
  struct said s = {0, 0, 0, 0, 0, 0};
  for (int k = 0; k < WINDOWS; k++) {
    struct hsr_window w = random_window(k, seed);
    struct hsr_bounds all = {w.x0, w.y0, w.x1, w.y1};
    struct memory m;
    begin(&m, &w, k % 2);
    for (int n = 0; n < 400; n++) {
      struct hsr_bounds box = random_box(&w, seed);
      float q = random_depth(seed);
      if (n % 4 == 0) { /* most of the window, so that something is hidden */
        for (int j = box.y0; j < box.y1; j++)
          for (int i = box.x0; i < box.x1; i++)
            *sample_of(&m, i, j) = q;
        *sample_of(&m, box.x0, box.y0) = n % 32 ? q : NAN;
        hsr_pyramid_update(&m.pyramid, box);
      }
      struct hsr_bounds look = random_box(&w, seed);
      float near = extremes_in(&m.pyramid, look).far;
      ask(&m.pyramid, look, random_depth(seed) * q, &s);
      if (near > 0 && near < HUGE_VALF) { /* just in front, and just behind */
        ask(&m.pyramid, look, near * (1 - 0x1p-15f), &s);
        ask(&m.pyramid, look, near * (1 - 0x1p-16f), &s);
        ask(&m.pyramid, look, near, &s);
      }
    }
    hsr_pyramid_update(&m.pyramid, all);
    s.wrong += count_wrong(&m.pyramid);
    hsr_arena_free(&m.arena);
  }
  ok(tap,
     !s.wrong && s.basic > 1000 && s.hidden > s.basic && s.before > 100 &&
         s.in_doubt > 500,
     "boxes: %ld hidden (%ld by the basic test), %ld before all, %ld too close "
     "to tell; %ld wrong",
     s.hidden, s.basic, s.before, s.in_doubt, s.wrong);
}

/* The work picture: every entry read touches each of its samples by its share.
 */
static void test_work(struct tap *tap, uint64_t *seed) {
  static float work[64 * 64];
  struct hsr_window window = {0, 0, 64, 64};
  struct memory m;
  double sum = 0;
  begin(&m, &window, false);
  memset(work, 0, sizeof work);
  m.tally.work = work;
  m.tally.work_stride = 64;
  for (int k = 0; k < 200; k++) {
    struct hsr_bounds box = random_box(&window, seed);
    write_some(&m, box, seed);
    hsr_pyramid_update(&m.pyramid, box);
    hsr_pyramid_hides(&m.pyramid, random_box(&window, seed),
                      random_depth(seed));
  }
  for (int k = 0; k < 64 * 64; k++)
    sum += (double)work[k];
  ok(tap,
     reads_of(&m.pyramid) > 500 &&
         fabs(sum - (double)reads_of(&m.pyramid)) < 0.01,
     "the work picture sums up to the %llu entries read",
     (unsigned long long)reads_of(&m.pyramid));
  hsr_arena_free(&m.arena);
}

/* --- The definitive test -------------------------------------------------- */

struct definitive {
  struct hsr_world world;
  struct hsr_view view;
  struct hsr_tiler tiler;
  struct memory memory;
  struct hsr_tally tally;
  uint32_t *ids;
  long asked, hidden, fast, wrong;
};

static void begin_definitive(struct definitive *d) {
  struct hsr_arena *arena = &d->memory.arena;
  struct hsr_tiler *t = &d->tiler;
  struct hsr_job job = {.view = &d->view, .tally = &d->tally};
  begin(&d->memory, &d->view.window, true);
  hsr_tiler_begin(t, &job);
  t->corner = HSR_NEW(arena, struct hsr_corner, d->world.mesh.n_vertices);
  t->columns = HSR_NEW(arena, int, 8);
  t->z = d->memory.pyramid.far[0];
  t->z_stride = d->memory.stride;
  d->ids = t->ids = HSR_NEW(arena, uint32_t, M * N);
  t->ids_stride = M;
  if (!t->corner || !t->columns || !t->ids ||
      hsr_screen_make(&t->screen, &d->world, &d->view, arena, &d->tally))
    bail("out of memory");
  hsr_tiler_snap(t);
  hsr_tiler_begin_part(t, d->view.window);
  hsr_pyramid_clear(&d->memory.pyramid);
}

/* Would the face be written to any sample, exactly? */
static bool is_hidden(struct definitive *d, uint32_t f,
                      const struct hsr_triangle *tri) {
  const struct hsr_window *w = &d->view.window;
  const struct hsr_screen *screen = &d->tiler.screen;
  for (int j = tri->y0; j < tri->y1; j++)
    for (int i = tri->x0; i < tri->x1; i++) {
      uint32_t held = d->ids[(j - w->y0) * M + i - w->x0];
      if (hsr_covers(screen, f, i, j, &d->tally) &&
          (held == HSR_BACKGROUND ||
           hsr_nearer(screen, f, held, i, j, &d->tally)))
        return false;
    }
  return true;
}

/* Makes some depths unknown, as they are where faces are seen edge-on. */
static void forget_some(struct definitive *d, uint64_t *seed) {
  struct hsr_bounds box = random_box(&d->view.window, seed);
  *sample_of(&d->memory, box.x0, box.y0) = NAN;
  hsr_pyramid_update(
      &d->memory.pyramid,
      (struct hsr_bounds){box.x0, box.y0, box.x0 + 1, box.y0 + 1});
}

static void try_triangle(struct definitive *d, const struct hsr_batch *batch,
                         int k) {
  struct hsr_pyramid *p = &d->memory.pyramid;
  const struct hsr_corners *r = &batch->corners;
  struct hsr_triangle tri = hsr_tiler_take(&d->tiler, batch, k);
  struct hsr_bounds box = {tri.x0, tri.y0, tri.x1, tri.y1};
  float q = fmaxf(r->qa[k], fmaxf(r->qb[k], r->qc[k]));
  bool fast = hsr_pyramid_hides(p, box, q);
  bool hidden = hsr_pyramid_hides_triangle(p, &d->tiler, &tri);
  d->asked++;
  d->fast += fast;
  d->hidden += hidden;
  d->wrong += (fast && !hidden) || hidden != is_hidden(d, tri.face, &tri);
  if (d->asked % 3)
    return; /* if all were tiled, all hidden faces would be behind */
  hsr_tiler_tile(&d->tiler, &tri);
  hsr_pyramid_update(p, box);
}

static void try_batch(struct definitive *d, uint32_t first, int n,
                      uint64_t *seed) {
  static struct hsr_batch batch;
  hsr_tiler_look(&d->tiler, &batch, first, n);
  hsr_tiler_set_up(&d->tiler, &batch);
  for (int k = 0; k < batch.n_fast; k++) {
    if (!batch.good[k])
      continue;
    try_triangle(d, &batch, k);
    if (draw_integer(seed, 0, 5) == 0)
      forget_some(d, seed);
  }
}

/* A scene of triangles, in windows of it. */
static void test_definitive(struct tap *tap, const char *name, uint64_t *seed) {
  static struct definitive d;
  memset(&d, 0, sizeof d);
  struct hsr_scene *scene = must_open(name);
  must_world(&d.world, scene);
  for (int k = 0; k < 12; k++) {
    uint32_t view = (uint32_t)k % scene->n_views;
    must_view(&d.view, &scene->views[view], M, N);
    d.view.window = random_window(k + 3, seed);
    begin_definitive(&d);
    uint32_t n = d.world.n_faces;
    for (uint32_t f = 0; f < n; f += HSR_BATCH)
      try_batch(&d, f, n - f < HSR_BATCH ? (int)(n - f) : HSR_BATCH, seed);
    d.wrong += count_wrong(&d.memory.pyramid);
    hsr_arena_free(&d.memory.arena);
  }
  ok(tap,
     !d.wrong && d.hidden > 100 && d.fast <= d.hidden &&
         d.asked > d.hidden + 100,
     "%s: of %ld triangles %ld are hidden, by every sample and by the "
     "definitive test (%ld by the fast one): %ld wrong",
     name, d.asked, d.hidden, d.fast, d.wrong);
  hsr_world_free(&d.world);
  hsr_scene_delete(scene);
}

int main(void) {
  static const char *const scenes[] = {"soup:3000:3", "terrain:40:0",
                                       "sphere:4000", "office:1"};
  enum { SCENES = sizeof scenes / sizeof *scenes };
  struct tap tap = plan(5 + SCENES);
  uint64_t seed = 93;
  test_updates(&tap, false, &seed);
  test_updates(&tap, true, &seed);
  test_early_stop(&tap);
  test_boxes(&tap, &seed);
  test_work(&tap, &seed);
  for (int k = 0; k < SCENES; k++)
    test_definitive(&tap, scenes[k], &seed);
  return finish(&tap);
}
