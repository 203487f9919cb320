/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The masked depth buffer, in windows of any size and place: whatever is put in,
 * its layers are never nearer than what is there, and what it hides is hidden
 * sample by sample. Its rule of when to drop a layer is tried by hand. */
#define HSR_COUNTING 1
#include "algorithms/counting-names.h" /* the functions of that build */
#include "algorithms/engines/pyramid/masked.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <string.h>

enum { M = 90, N = 70, WINDOWS = 60, READS = 3, UPDATES = 4 };

/* What was put in, sample by sample: the nearest depth. */
struct memory {
  struct hsr_masked masked;
  struct hsr_tally tally;
  struct hsr_entry_count count;
  struct hsr_arena arena;
  struct hsr_tiler tiler; /* z and ids of the window */
  float z[M * N], truth[M * N];
  uint32_t ids[M * N];
  long hidden, wrong;
};

static void begin(struct memory *m, struct hsr_window window) {
  memset(m, 0, sizeof *m);
  m->arena = (struct hsr_arena)HSR_ARENA_EMPTY;
  if (hsr_masked_init(&m->masked, &window, &m->arena))
    bail("out of memory");
  m->count = (struct hsr_entry_count){.tally = &m->tally, .reads = READS};
  m->masked.count = &m->count;
  m->masked.updates = UPDATES;
  m->tiler.part = window;
  m->tiler.z = m->z;
  m->tiler.ids = m->ids;
  m->tiler.z_stride = m->tiler.ids_stride = M;
}

static size_t place(const struct memory *m, int i, int j) {
  const struct hsr_window *w = &m->masked.window;
  return (size_t)(j - w->y0) * M + (size_t)(i - w->x0);
}

static struct hsr_window random_window(int k, uint64_t *seed) {
  static const struct hsr_window some[] = {
      {0, 0, 1, 1}, {7, 9, 15, 17}, {3, 0, 4, 64}, {0, 0, 64, 64}};
  if (k < (int)(sizeof some / sizeof *some))
    return some[k];
  int x = (int)draw_integer(seed, 0, M - 1),
      y = (int)draw_integer(seed, 0, N - 1);
  return (struct hsr_window){x, y, (int)draw_integer(seed, x + 1, M),
                             (int)draw_integer(seed, y + 1, N)};
}

static struct hsr_bounds random_box(const struct hsr_window *w,
                                    uint64_t *seed) {
  int x = (int)draw_integer(seed, w->x0, w->x1 - 1),
      y = (int)draw_integer(seed, w->y0, w->y1 - 1);
  return (struct hsr_bounds){x, y, (int)draw_integer(seed, x + 1, w->x1),
                             (int)draw_integer(seed, y + 1, w->y1)};
}

static float random_depth(uint64_t *seed) {
  return (float)draw_integer(seed, 1, 1000) / 1000;
}

/* --- What must hold ------------------------------------------------------- */

/* The layers are not nearer than what is there, within HSR_RHO. */
static void check_layers(struct memory *m) {
  const struct hsr_window *w = &m->masked.window;
  for (int j = w->y0; j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++) {
      int x = i - w->x0, y = j - w->y0;
      const struct hsr_masked_tile *t =
          &m->masked.tile[(size_t)(y / 8) * (size_t)m->masked.columns +
                          (size_t)(x / 8)];
      float most = m->truth[place(m, i, j)] * (1 + HSR_RHO);
      bool in_working = t->in_working >> (8 * (y % 8) + x % 8) & 1;
      m->wrong += t->reference > most || (in_working && t->working > most);
    }
}

/* What a test hides is behind all samples of a box. */
static void check_box(struct memory *m, struct hsr_bounds box, float q) {
  uint64_t reads = m->tally.count[READS];
  bool hidden = hsr_masked_hides(&m->masked, box, q);
  m->wrong += m->tally.count[READS] == reads;
  m->hidden += hidden;
  for (int j = box.y0; j < box.y1 && hidden; j++)
    for (int i = box.x0; i < box.x1; i++)
      m->wrong += !(q < m->truth[place(m, i, j)]);
}

/* --- Faces as a z-buffer shows them --------------------------------------- */

/* Face `id` is written to most samples of a box. Some depths are unknown. */
static void write_face(struct memory *m, uint32_t id, struct hsr_bounds box,
                       uint64_t *seed) {
  float q = random_depth(seed), slope = random_depth(seed) / 1000;
  for (int j = box.y0; j < box.y1; j++)
    for (int i = box.x0; i < box.x1; i++) {
      size_t at = place(m, i, j);
      float here = q + slope * (float)(i - box.x0);
      int64_t kind = draw_integer(seed, 0, 199);
      if (here <= m->truth[at] || !kind)
        continue;
      m->ids[at] = id;
      m->z[at] = kind == 1 ? NAN : here;
      m->truth[at] = kind == 1 ? m->truth[at] : here;
    }
  hsr_masked_put_shown(&m->masked, &m->tiler, id, box);
}

static void test_shown(struct tap *tap, uint64_t *seed) {
  static struct memory m;
  long wrong = 0, hidden = 0;
  for (int k = 0; k < WINDOWS; k++) {
    struct hsr_window w = random_window(k, seed);
    begin(&m, w);
    for (uint32_t id = 1; id < 60; id++) {
      write_face(&m, id, random_box(&w, seed), seed);
      check_layers(&m);
      for (int n = 0; n < 8; n++)
        check_box(&m, random_box(&w, seed), random_depth(seed) / 2);
    }
    wrong += m.wrong;
    hidden += m.hidden;
    hsr_arena_free(&m.arena);
  }
  ok(tap, !wrong && hidden > 2000,
     "faces as a z-buffer shows them: %ld boxes hidden, %ld wrong", hidden,
     wrong);
}

/* --- Triangles ------------------------------------------------------------ */

/* A triangle around most of a box: its edge functions are positive inside. */
static struct hsr_triangle random_triangle(struct hsr_bounds box, uint32_t id,
                                           uint64_t *seed) {
  float width = (float)(box.x1 - box.x0), height = (float)(box.y1 - box.y0);
  float cut = width * height * random_depth(seed) * 1.9f + 1;
  return (struct hsr_triangle){.e0 = 0.5f,
                               .ex0 = height,
                               .e1 = 0.5f,
                               .ey1 = width,
                               .e2 = cut,
                               .ex2 = -height,
                               .ey2 = -width,
                               .bound = random_depth(seed),
                               .q = 0.1f + random_depth(seed),
                               .qx = (random_depth(seed) - 0.5f) / 2000,
                               .qy = (random_depth(seed) - 0.5f) / 2000,
                               .x0 = box.x0,
                               .y0 = box.y0,
                               .x1 = box.x1,
                               .y1 = box.y1,
                               .id = id};
}

struct at {
  bool maybe, sure;
  float q;
};

static struct at look_at(const struct hsr_triangle *t, int i, int j) {
  float x = (float)(i - t->x0), y = (float)(j - t->y0);
  float d = fminf(
      fminf(t->e0 + t->ey0 * y + t->ex0 * x, t->e1 + t->ey1 * y + t->ex1 * x),
      t->e2 + t->ey2 * y + t->ex2 * x);
  return (struct at){d >= -t->bound, d > t->bound,
                     t->q + t->qy * y + t->qx * x};
}

/* The definitive test: what it hides is behind at each sample that it may
 * cover. */
static void check_triangle(struct memory *m, const struct hsr_triangle *t) {
  bool hidden = hsr_masked_hides_triangle(&m->masked, t);
  m->hidden += hidden;
  for (int j = t->y0; j < t->y1 && hidden; j++)
    for (int i = t->x0; i < t->x1; i++) {
      struct at at = look_at(t, i, j);
      m->wrong += at.maybe && !(at.q < m->truth[place(m, i, j)]);
    }
}

static void put_triangle(struct memory *m, const struct hsr_triangle *t) {
  const struct hsr_bounds box = {t->x0, t->y0, t->x1, t->y1};
  float farthest = HUGE_VALF;
  for (int j = box.y0; j < box.y1; j++)
    for (int i = box.x0; i < box.x1; i++) {
      struct at at = look_at(t, i, j);
      float *truth = &m->truth[place(m, i, j)];
      if (at.sure)
        *truth = fmaxf(*truth, at.q);
      farthest = at.sure ? fminf(farthest, at.q) : farthest;
    }
  hsr_masked_put(&m->masked, t, farthest < HUGE_VALF ? farthest : 0);
}

static void test_triangles(struct tap *tap, uint64_t *seed) {
  static struct memory m;
  long wrong = 0, hidden = 0;
  uint64_t updates = 0;
  for (int k = 0; k < WINDOWS; k++) {
    struct hsr_window w = random_window(k, seed);
    begin(&m, w);
    for (uint32_t id = 1; id < 80; id++) {
      struct hsr_triangle t = random_triangle(random_box(&w, seed), id, seed);
      check_triangle(&m, &t);
      put_triangle(&m, &t);
      check_layers(&m);
      for (int n = 0; n < 4; n++)
        check_box(&m, random_box(&w, seed), random_depth(seed) / 2);
    }
    wrong += m.wrong;
    hidden += m.hidden;
    updates += m.tally.count[UPDATES];
    hsr_arena_free(&m.arena);
  }
  ok(tap, !wrong && hidden > 2000 && updates > 5000,
     "triangles: %llu updates, %ld boxes and triangles hidden, %ld wrong",
     (unsigned long long)updates, hidden, wrong);
}

/* --- One tile by hand ----------------------------------------------------- */

/* A face of one depth in some columns of the first tile. */
static const struct hsr_masked_tile *put_columns(struct memory *m, uint32_t id,
                                                 int x0, int x1, float q) {
  struct hsr_bounds box = {x0, 0, x1, 8};
  for (int j = 0; j < 8; j++)
    for (int i = x0; i < x1; i++) {
      m->ids[place(m, i, j)] = id;
      m->z[place(m, i, j)] = q;
    }
  hsr_masked_put_shown(&m->masked, &m->tiler, id, box);
  return m->masked.tile;
}

static void test_by_hand(struct tap *tap) {
  static struct memory m;
  const struct hsr_masked_tile *t;
  const struct hsr_bounds all = {0, 0, 8, 8}, left = {0, 0, 4, 8};
  begin(&m, (struct hsr_window){0, 0, 8, 8});
  t = put_columns(&m, 1, 0, 8, 0.25f);
  ok(tap, t->reference == 0.25f && !t->in_working, /* by one face */
     "a full tile: its working layer becomes the reference layer");
  t = put_columns(&m, 2, 0, 4, 0.5f);
  ok(tap,
     t->reference == 0.25f && t->working == 0.5f &&
         t->in_working == UINT64_C(0x0f0f0f0f0f0f0f0f),
     "half a tile is in the working layer");
  ok(tap, !hsr_masked_hides(&m.masked, left, 0.4f),
     "a test asks the reference layer only");
  t = put_columns(&m, 3, 4, 5, 0.7f);
  ok(tap, t->working == 0.5f && t->in_working == UINT64_C(0x1f1f1f1f1f1f1f1f),
     "the working layer has the depth of its farthest face");
  t = put_columns(&m, 4, 0, 2, 0.8f);
  ok(tap, t->working == 0.8f && t->in_working == UINT64_C(0x0303030303030303),
     "a face much nearer than the working layer takes its place");
  t = put_columns(&m, 5, 4, 6, 0.2f);
  ok(tap, t->working == 0.8f && t->in_working == UINT64_C(0x0303030303030303),
     "a face behind the reference layer changes nothing");
  t = put_columns(&m, 6, 2, 8, 0.6f);
  ok(tap, t->reference == 0.6f && !t->in_working && isinf(t->working),
     "two faces that fill the tile: the reference layer is the farther one");
  ok(tap,
     hsr_masked_hides(&m.masked, all, 0.5f) &&
         !hsr_masked_hides(&m.masked, all, 0.6f),
     "it hides what is behind it, and not what is as near");
  hsr_arena_free(&m.arena);
}

/* The work picture sums up to the tiles read and updated. */
static void test_work(struct tap *tap, uint64_t *seed) {
  static struct memory m;
  static float work[M * N];
  struct hsr_window w = {0, 0, 64, 48};
  double sum = 0;
  begin(&m, w);
  m.tally.work = work;
  m.tally.work_stride = M;
  for (uint32_t id = 1; id < 40; id++) {
    write_face(&m, id, random_box(&w, seed), seed);
    check_box(&m, random_box(&w, seed), random_depth(seed) / 2);
  }
  for (int k = 0; k < M * N; k++)
    sum += (double)work[k];
  double tiles = (double)(m.tally.count[READS] + m.tally.count[UPDATES]);
  ok(tap, tiles > 200 && fabs(sum - tiles) < 0.01,
     "the work picture sums up to the %.0f tiles read and updated", tiles);
  hsr_arena_free(&m.arena);
}

int main(void) {
  struct tap tap = plan(11);
  uint64_t seed = 2016;
  test_by_hand(&tap);
  test_shown(&tap, &seed);
  test_triangles(&tap, &seed);
  test_work(&tap, &seed);
  return finish(&tap);
}
