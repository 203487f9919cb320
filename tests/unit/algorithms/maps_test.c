/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hierarchical occlusion maps, in windows of any size and place: entries are
 * sums of what is covered, and the test's answer is that of a look at every
 * sample and every estimate. */
#define HSR_COUNTING 1
#include "algorithms/counting-names.h" /* the functions of that build */
#include "algorithms/engines/pyramid/maps.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <string.h>

enum { M = 90, N = 70, WINDOWS = 60, BOXES = 200, READS = 3 };

struct memory {
  struct hsr_maps maps;
  struct hsr_tally tally;
  struct hsr_entry_count count;
  struct hsr_arena arena;
  struct hsr_tiler tiler; /* ids of the window */
  uint32_t ids[M * N];
  float farthest[M * N]; /* of the occluders whose boxes hold the sample */
};

static void begin(struct memory *m, struct hsr_window window) {
  memset(m, 0, sizeof *m);
  m->arena = (struct hsr_arena)HSR_ARENA_EMPTY;
  if (hsr_maps_init(&m->maps, &window, &m->arena))
    bail("out of memory");
  m->count = (struct hsr_entry_count){.tally = &m->tally, .reads = READS};
  m->maps.count = &m->count;
  m->tiler.ids = m->ids;
  m->tiler.ids_stride = M;
  for (int k = 0; k < M * N; k++) {
    m->ids[k] = HSR_BACKGROUND;
    m->farthest[k] = HUGE_VALF;
  }
}

static size_t place(const struct memory *m, int i, int j) {
  return (size_t)(j - m->maps.window.y0) * M + (size_t)(i - m->maps.window.x0);
}

static struct hsr_window random_window(uint64_t *seed) {
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

/* An occluder, which shows at most samples of its box. */
static void add_occluder(struct memory *m, uint32_t id, uint64_t *seed) {
  struct hsr_bounds box = random_box(&m->maps.window, seed);
  float q = id % 8 ? random_depth(seed) : 0;
  for (int j = box.y0; j < box.y1; j++)
    for (int i = box.x0; i < box.x1; i++) {
      size_t at = place(m, i, j);
      m->farthest[at] = fminf(m->farthest[at], q);
      if (draw_integer(seed, 0, 499))
        m->ids[at] = id;
    }
  hsr_maps_note(&m->maps, box, q);
  hsr_maps_note(&m->maps, (struct hsr_bounds){box.x0, box.y0, box.x0, box.y1},
                0); /* an empty box is no occluder */
}

/* The entries that are not the number of covered samples in them. */
static long count_wrong(const struct memory *m) {
  const struct hsr_window *w = &m->maps.window;
  long wrong = 0;
  for (int level = 0; level < m->maps.n_levels; level++) {
    int side = 1 << (m->maps.n_levels - 1 - level);
    for (int y = 0; y < side; y++)
      for (int x = 0; x < side; x++) {
        uint32_t n = 0;
        for (int k = 0; k < 1 << 2 * level; k++) {
          int i = w->x0 + (x << level) + k % (1 << level),
              j = w->y0 + (y << level) + (k >> level);
          n += i >= w->x1 || j >= w->y1 ||
               m->ids[place(m, i, j)] != HSR_BACKGROUND;
        }
        wrong += m->maps.covered[level][y * side + x] != n;
      }
  }
  return wrong;
}

/* Is a box hidden, sample by sample? Estimates are of 8 x 8 samples, so those
 * around the box count as well. */
static bool is_hidden(const struct memory *m, struct hsr_bounds box, float q) {
  const struct hsr_window *w = &m->maps.window;
  for (int j = box.y0; j < box.y1; j++)
    for (int i = box.x0; i < box.x1; i++)
      if (m->ids[place(m, i, j)] == HSR_BACKGROUND)
        return false;
  int x0 = w->x0 + (box.x0 - w->x0) / 8 * 8,
      x1 = w->x0 + ((box.x1 - 1 - w->x0) / 8 + 1) * 8;
  int y0 = w->y0 + (box.y0 - w->y0) / 8 * 8,
      y1 = w->y0 + ((box.y1 - 1 - w->y0) / 8 + 1) * 8;
  for (int j = y0; j < y1 && j < w->y1; j++)
    for (int i = x0; i < x1 && i < w->x1; i++)
      if (!(q * HSR_CLEAR < m->farthest[place(m, i, j)]))
        return false;
  return true;
}

static void test_boxes(struct tap *tap, uint64_t *seed) {
  static struct memory m;
  long entries = 0, wrong = 0, hidden = 0, early = 0;
  for (int k = 0; k < WINDOWS; k++) {
    struct hsr_window w = random_window(seed);
    begin(&m, w);
    for (uint32_t id = 1; id < 12; id++)
      add_occluder(&m, id, seed);
    for (int n = 0; n < 10; n++)
      early += hsr_maps_hides(&m.maps, random_box(&w, seed), 0.001f);
    hsr_maps_make(&m.maps, &m.tiler);
    entries += count_wrong(&m);
    for (int n = 0; n < BOXES; n++) {
      struct hsr_bounds box = random_box(&w, seed);
      if (n % 2) {
        box.x1 = box.x1 > box.x0 + 4 ? box.x0 + 4 : box.x1;
        box.y1 = box.y1 > box.y0 + 4 ? box.y0 + 4 : box.y1;
      }
      float q = random_depth(seed) / 4;
      bool hides = hsr_maps_hides(&m.maps, box, q);
      hidden += hides;
      wrong += hides != is_hidden(&m, box, q);
    }
    hsr_arena_free(&m.arena);
  }
  ok(tap, !entries, "entries are sums: %ld are not", entries);
  ok(tap, !early, "before the maps are made nothing is hidden");
  ok(tap, !wrong && hidden > 200, "%d boxes, %ld hidden: %ld wrong",
     WINDOWS * BOXES, hidden, wrong);
}

/* The work picture sums up to the entries and estimates read. */
static void test_work(struct tap *tap, uint64_t *seed) {
  static struct memory m;
  static float work[M * N];
  struct hsr_window w = {0, 0, 64, 64};
  double sum = 0;
  begin(&m, w);
  m.tally.work = work;
  m.tally.work_stride = M;
  for (uint32_t id = 1; id < 12; id++)
    add_occluder(&m, id, seed);
  hsr_maps_make(&m.maps, &m.tiler);
  for (int k = 0; k < 300; k++)
    hsr_maps_hides(&m.maps, random_box(&w, seed), random_depth(seed) / 4);
  for (int k = 0; k < M * N; k++)
    sum += (double)work[k];
  double reads = (double)m.tally.count[READS];
  ok(tap, reads > 300 && fabs(sum - reads) < 0.01,
     "the work picture sums up to the %.0f entries read", reads);
  hsr_arena_free(&m.arena);
}

int main(void) {
  struct tap tap = plan(4);
  uint64_t seed = 1997;
  test_boxes(&tap, &seed);
  test_work(&tap, &seed);
  return finish(&tap);
}
