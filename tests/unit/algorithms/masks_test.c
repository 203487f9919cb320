/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The mask pyramid alone (algorithms/engines/masks/masks.h):
 * random convex polygons with corners on a fine grid, tiled from front to back,
 * against a loop over all samples; everything in integers.
 *
 * Once        A sample is written when the first polygon covers it, and never
 *             again. With the background every sample is written exactly once.
 * Cells       On all paths of active subcells, a subcell is covered if all of
 *             its samples are, and vacant if none is.
 * Cases       The nine of table 4.1 of Greene's thesis.
 * Hidden      The test whether any of a polygon is visible is right. A polygon
 *             behind an occluder costs one cell.
 *
 * These mutants of masks.c were tried and found: descend() without its look at
 * covered subcells on the way, or without clearing; A of listing 1 with the
 * polygon's covered subcells instead of the screen's, as the thesis prints it;
 * tile() and shows() without clearing, or with samples outside the window
 * vacant; no propagate() on the way up, or half of it; look_up() that does not
 * exchange C and V, or complements them; choose() that loses lines; classify()
 * and the finest level without the error of lines; tables without the slack;
 * jittered samples taken as others; shows() that forgets what is active, or
 * covered. choose() may keep lines that are inside: that only costs time.
 */
#include "algorithms/engines/masks/masks.h"
#include "tests/draw.h"
#include "tests/tap.h"
#include "common/answers/filter.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The counting build, which has no vectors. */
enum hsr_status hsr_masks_init_counting(struct hsr_masks *,
                                        const struct hsr_window *, uint32_t,
                                        struct hsr_arena *);
bool hsr_masks_tile_counting(struct hsr_masks *,
                             const struct hsr_mask_polygon *, struct hsr_bounds,
                             const struct hsr_mask_sink *);
void hsr_masks_tile_root_counting(struct hsr_masks *,
                                  const struct hsr_mask_polygon *,
                                  const struct hsr_mask_sink *);
bool hsr_masks_show_counting(struct hsr_masks *,
                             const struct hsr_mask_polygon *,
                             struct hsr_bounds);

static const struct build {
  const char *name;
  enum hsr_status (*init)(struct hsr_masks *, const struct hsr_window *,
                          uint32_t, struct hsr_arena *);
  bool (*tile)(struct hsr_masks *, const struct hsr_mask_polygon *,
               struct hsr_bounds, const struct hsr_mask_sink *);
  void (*tile_root)(struct hsr_masks *, const struct hsr_mask_polygon *,
                    const struct hsr_mask_sink *);
  bool (*show)(struct hsr_masks *, const struct hsr_mask_polygon *,
               struct hsr_bounds);
} builds[] = {
    {"counting", hsr_masks_init_counting, hsr_masks_tile_counting,
     hsr_masks_tile_root_counting, hsr_masks_show_counting},
    {"plain", hsr_masks_init, hsr_masks_tile, hsr_masks_tile_root,
     hsr_masks_show},
};

/* The counters that the masks raise. */
enum { CELLS, FINEST, PIXEL_CELLS, UNSURE };

enum {
  UNIT = 32, /* grid units a sample; jitter is an odd number of them */
  MOST_LINES = 12,
  LARGEST = 640,
  EXTENT = 4096, /* samples along a side of the largest root */
  PATTERNS = 3
};

/* --- Polygons ------------------------------------------------------------- */

struct point {
  int64_t x, y;
};

/* How the lines are given: exactly; off by less than their error; or not at
 * all. */
enum telling { SURE, OFF, UNKNOWN };

struct polygon {
  int n;
  struct point corner[MOST_LINES];
  int64_t a[MOST_LINES], b[MOST_LINES], c[MOST_LINES];
  enum telling telling;
  int64_t near; /* the covered part ends at this x + y; or INT64_MAX */
  struct hsr_mask_line line[MOST_LINES];
  struct hsr_mask_polygon told;
};

static int64_t turn(struct point p, struct point q, struct point r) {
  return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
}

static int compare_points(const void *a, const void *b) {
  const struct point *p = a, *q = b;
  if (p->x != q->x)
    return p->x < q->x ? -1 : 1;
  return (p->y > q->y) - (p->y < q->y);
}

/* Andrew's monotone chain: the convex hull of n points. It lies to the left of
 * its sides. */
static int find_hull(struct point *p, int n, struct point *hull) {
  int h = 0;
  qsort(p, (size_t)n, sizeof *p, compare_points);
  for (int pass = 0; pass < 2; pass++) {
    int least = h + 2;
    for (int k = 0; k < n; k++) {
      struct point next = p[pass ? n - 1 - k : k];
      while (h >= least && turn(hull[h - 2], hull[h - 1], next) <= 0)
        h--;
      hull[h++] = next;
    }
    h--;
  }
  return h;
}

/* f of line k. */
static int64_t height(const struct polygon *p, int k, int64_t x, int64_t y) {
  return p->a[k] * x + p->b[k] * y + p->c[k];
}

/* Whether a point, displaced a little to the right and less down, is inside
 * line k. */
static bool is_inside(const struct polygon *p, int k, int64_t x, int64_t y) {
  int64_t f = height(p, k, x, y);
  return f ? f > 0 : p->a[k] ? p->a[k] > 0 : p->b[k] > 0;
}

static bool within_lines(const struct polygon *p, int64_t x, int64_t y) {
  for (int k = 0; k < p->n; k++)
    if (!is_inside(p, k, x, y))
      return false;
  return true;
}

static bool within_closed(const struct polygon *p, int64_t x, int64_t y) {
  for (int k = 0; k < p->n; k++)
    if (height(p, k, x, y) < 0)
      return false;
  return true;
}

static bool inside(void *context, uint32_t k, double sx, double sy) {
  return is_inside(context, (int)k, (int64_t)(UNIT * sx), (int64_t)(UNIT * sy));
}

static bool covers(void *context, double sx, double sy) {
  const struct polygon *p = context;
  return UNIT * (sx + sy) < (double)p->near;
}

/* A number of either sign, less than 1 in size. */
static double random_part(uint64_t *seed) {
  return (double)draw_integer(seed, -999, 999) / 1000;
}

static void tell_line(struct polygon *p, int k, uint64_t *seed) {
  double a = (double)(UNIT * p->a[k]), b = (double)(UNIT * p->b[k]);
  double c = (double)p->c[k], error = 0x1p-20;
  if (p->telling == OFF) {
    error = ldexp(1, (int)draw_integer(seed, -10, 22));
    c += 0.9 * error * random_part(seed);
    a += 0.04 * error / EXTENT * random_part(seed);
    b += 0.04 * error / EXTENT * random_part(seed);
  } else if (p->telling == UNKNOWN) {
    error = draw_integer(seed, 0, 1) ? INFINITY : NAN;
    a = draw_integer(seed, 0, 1) ? NAN : a;
  }
  p->line[k] =
      (struct hsr_mask_line){a, b, c, error, fabs(a) + fabs(b), 1 / a, 1 / b};
}

/* Sets the lines from the corners. */
static void set_polygon(struct polygon *p, uint64_t *seed) {
  for (int k = 0; k < p->n; k++) {
    struct point q = p->corner[k], r = p->corner[k + 1 < p->n ? k + 1 : 0];
    p->a[k] = q.y - r.y;
    p->b[k] = r.x - q.x;
    p->c[k] = -p->a[k] * q.x - p->b[k] * q.y;
    tell_line(p, k, seed);
  }
  p->told = (struct hsr_mask_polygon){p->line, (uint32_t)p->n, inside,
                                      p->near < INT64_MAX ? covers : NULL, p};
}

/* A rectangle whose sides are on borders of cells, or within a sample of them.
 */
static void random_rectangle(struct polygon *p, const struct hsr_window *w,
                             uint64_t *seed) {
  int64_t at[2][2];
  for (int c = 0; c < 2; c++) {
    int64_t x0 = c ? w->y0 : w->x0, n = ((c ? w->y1 : w->x1) - x0) / 8 + 1;
    at[c][0] = draw_integer(seed, -1, n);
    at[c][1] = draw_integer(seed, at[c][0] + 1, n + 1);
    for (int k = 0; k < 2; k++)
      at[c][k] = UNIT * (x0 + 8 * at[c][k]) + draw_integer(seed, -UNIT, UNIT);
  }
  p->n = 4;
  p->corner[0] = (struct point){at[0][0], at[1][0]};
  p->corner[1] = (struct point){at[0][1], at[1][0]};
  p->corner[2] = (struct point){at[0][1], at[1][1]};
  p->corner[3] = (struct point){at[0][0], at[1][1]};
}

static void random_polygon(struct polygon *p, const struct hsr_window *w,
                           uint64_t *seed) {
  static const int64_t steps[] = {1, 16, 32, 256};
  int64_t step = steps[draw_integer(seed, 0, 3)];
  int64_t largest =
      w->x1 - w->x0 > w->y1 - w->y0 ? w->x1 - w->x0 : w->y1 - w->y0;
  bool small = draw_integer(seed, 0, 19) > 0;
  int64_t size = UNIT * largest >> draw_integer(seed, small ? 2 : 0, 7);
  int64_t x = UNIT * draw_integer(seed, w->x0, w->x1) - size / 2;
  int64_t y = UNIT * draw_integer(seed, w->y0, w->y1) - size / 2;
  bool thin = draw_integer(seed, 0, 4) == 0;
  *p = (struct polygon){.near = INT64_MAX};
  do {
    struct point some[8], hull[MOST_LINES + 8];
    int n = (int)draw_integer(seed, 3, 8);
    for (int k = 0; k < n; k++) {
      some[k].x = x + draw_integer(seed, 0, size + 2 * step);
      some[k].y = thin ? y + (some[k].x - x) / 3 +
                             draw_integer(seed, 0, 2 * step + UNIT)
                       : y + draw_integer(seed, 0, size + 2 * step);
      some[k].x -= some[k].x % step;
      some[k].y -= some[k].y % step;
    }
    p->n = find_hull(some, n, hull);
    memcpy(p->corner, hull, (size_t)p->n * sizeof *hull);
  } while (p->n < 3);
  if (draw_integer(seed, 0, 5) == 0)
    random_rectangle(p, w, seed);
  int64_t kind = draw_integer(seed, 0, 19);
  p->telling = kind == 0 ? UNKNOWN : kind < 6 ? OFF : SURE;
  if (kind == 19)
    p->near = x + y + size;
  set_polygon(p, seed);
}

/* Clips [*lo, *hi). */
static void clip(int *lo, int *hi, int least, int most) {
  *lo = *lo < least ? least : *lo;
  *hi = *hi > most ? most : *hi;
}

/* The samples of the window that may be within. */
static struct hsr_bounds box_of(const struct polygon *p,
                                const struct hsr_window *w, bool anywhere) {
  int64_t lo[2] = {INT64_MAX, INT64_MAX}, hi[2] = {INT64_MIN, INT64_MIN};
  for (int k = 0; k < p->n; k++)
    for (int c = 0; c < 2; c++) {
      int64_t at = c ? p->corner[k].y : p->corner[k].x;
      lo[c] = at < lo[c] ? at : lo[c];
      hi[c] = at > hi[c] ? at : hi[c];
    }
  double before = anywhere ? 1 : 0.5, after = anywhere ? 0 : 0.5;
  struct hsr_bounds box = {(int)ceil((double)lo[0] / UNIT - before),
                           (int)ceil((double)lo[1] / UNIT - before),
                           (int)floor((double)hi[0] / UNIT - after) + 1,
                           (int)floor((double)hi[1] / UNIT - after) + 1};
  clip(&box.x0, &box.x1, w->x0, w->x1);
  clip(&box.y0, &box.y1, w->y0, w->y1);
  return box;
}

/* --- A picture of both kinds ---------------------------------------------- */

struct picture {
  const struct build *build;
  struct hsr_masks masks;
  struct hsr_tally tally;
  struct hsr_filtering filtering;
  struct hsr_mask_places places[PATTERNS];
  struct hsr_triage_tables tables;
  struct hsr_arena arena;
  struct hsr_window window;
  uint32_t ids[LARGEST * LARGEST], wanted[LARGEST * LARGEST], id;
  long twice, outside, written;
};

static uint32_t *place(uint32_t *ids, int i, int j) {
  return &ids[(size_t)j * LARGEST + (size_t)i];
}

static void put(struct picture *p, int i, int j) {
  const struct hsr_window *w = &p->window;
  if (i < w->x0 || i >= w->x1 || j < w->y0 || j >= w->y1) {
    p->outside++;
    return;
  }
  p->twice += *place(p->ids, i, j) != UNWRITTEN;
  *place(p->ids, i, j) = p->id;
  p->written++;
}

static void put_samples(void *context, int x, int y, uint64_t mask) {
  for (int bit = 0; bit < 64; bit++)
    if (mask >> bit & 1)
      put(context, x + bit % 8, y + bit / 8);
}

static void put_square(void *context, int x, int y, int size) {
  const struct picture *p = context;
  for (int j = y; j < y + size && j < p->window.y1; j++)
    for (int i = x; i < x + size && i < p->window.x1; i++)
      put(context, i, j);
}

/* Fills memory with old cells. */
static void dirty(struct hsr_arena *arena, size_t size) {
  void *old = hsr_arena_array(arena, size, 1);
  if (!old)
    bail("out of memory");
  memset(old, 0xa5, size);
  hsr_arena_reset(arena);
}

static void begin(struct picture *p, const struct build *build,
                  struct hsr_window window, int intervals, int patterns) {
  struct hsr_error err;
  p->build = build;
  p->window = window;
  p->tally = (struct hsr_tally){.trace = NULL};
  p->twice = p->outside = p->written = 0;
  p->filtering = (struct hsr_filtering){HSR_FILTER_BOX, patterns};
  for (int k = 0; k < PATTERNS; k++) {
    struct hsr_jitter jitter = {{0}, {0}};
    if (patterns)
      hsr_jitter_init(&jitter, k);
    for (int bit = 0; bit < 64; bit++) {
      p->places[k].x[bit] = bit % 8 + 0.5 + jitter.x[bit];
      p->places[k].y[bit] = bit / 8 + 0.5 + jitter.y[bit];
    }
  }
  p->masks = (struct hsr_masks){.tables = &p->tables,
                                .places = p->places,
                                .filtering = patterns ? &p->filtering : NULL,
                                .anywhere = patterns > 0,
                                .count = {.tally = &p->tally,
                                          .cells = CELLS,
                                          .finest = FINEST,
                                          .pixels = PIXEL_CELLS,
                                          .unsure = UNSURE,
                                          .whom = HSR_NOTHING},
                                .pixel = 8};
  p->arena = (struct hsr_arena)HSR_ARENA_EMPTY;
  dirty(&p->arena, 4 << 20);
  memset(p->ids, 0xfe, sizeof p->ids);
  memset(p->wanted, 0xfe, sizeof p->wanted);
  if (hsr_triage_init(&p->tables, intervals, &err) ||
      build->init(&p->masks, &p->window, MOST_LINES, &p->arena))
    bail("out of memory");
}

static void end(struct picture *p) {
  hsr_triage_free(&p->tables);
  hsr_arena_free(&p->arena);
}

static void tile(struct picture *p, const struct polygon *polygon,
                 bool from_root, bool *hidden) {
  struct hsr_mask_sink sink = {put_samples, put_square, p};
  struct hsr_bounds box = box_of(polygon, &p->window, p->masks.anywhere);
  *hidden = false;
  if (from_root)
    p->build->tile_root(&p->masks, &polygon->told, &sink);
  else if (box.x0 < box.x1 && box.y0 < box.y1)
    *hidden = !p->build->tile(&p->masks, &polygon->told, box, &sink);
}

static void tile_background(struct picture *p) {
  struct hsr_mask_polygon all = {NULL, 0, NULL, NULL, NULL};
  struct hsr_mask_sink sink = {put_samples, put_square, p};
  p->build->tile_root(&p->masks, &all, &sink);
}

/* Where a sample is, in grid units. */
static struct point sample_at(const struct picture *p, int i, int j) {
  int x = i - p->window.x0, y = j - p->window.y0;
  int bit = y % 8 * 8 + x % 8, pattern = 0;
  if (p->masks.filtering)
    pattern = hsr_jitter_pattern(&p->filtering, i / 8, j / 8);
  const struct hsr_mask_places *places = &p->places[pattern];
  return (struct point){(int64_t)(UNIT * (i - x % 8 + places->x[bit])),
                        (int64_t)(UNIT * (j - y % 8 + places->y[bit]))};
}

/* The result of a loop over all samples: whether any sample inside the lines
 * was not covered yet, in the interior, or in the whole. */
struct seen {
  bool within, closed;
};

static struct seen want(struct picture *p, const struct polygon *polygon) {
  struct hsr_bounds box = box_of(polygon, &p->window, p->masks.anywhere);
  struct seen seen = {false, false};
  for (int j = box.y0; j < box.y1; j++)
    for (int i = box.x0; i < box.x1; i++) {
      struct point s = sample_at(p, i, j);
      uint32_t *id = place(p->wanted, i, j);
      if (*id != UNWRITTEN || !within_closed(polygon, s.x, s.y))
        continue;
      seen.closed = true;
      if (!within_lines(polygon, s.x, s.y))
        continue;
      seen.within = true;
      if (s.x + s.y < polygon->near)
        *id = p->id;
    }
  return seen;
}

static void want_background(struct picture *p) {
  for (int j = p->window.y0; j < p->window.y1; j++)
    for (int i = p->window.x0; i < p->window.x1; i++)
      if (*place(p->wanted, i, j) == UNWRITTEN)
        *place(p->wanted, i, j) = p->id;
}

static long count_wrong(const struct picture *p) {
  long wrong = 0;
  for (size_t k = 0; k < (size_t)LARGEST * LARGEST; k++)
    wrong += p->ids[k] != p->wanted[k];
  return wrong;
}

/* --- Cells ---------------------------------------------------------------- */

/* The samples of a square that are in the window, and those that are covered.
 */
struct census {
  long all, covered;
};

static struct census count_square(const struct picture *p, int x, int y,
                                  int size) {
  struct census c = {0, 0};
  for (int j = y; j < y + size && j < p->window.y1; j++)
    for (int i = x; i < x + size && i < p->window.x1; i++) {
      c.all++;
      c.covered += p->ids[(size_t)j * LARGEST + (size_t)i] != UNWRITTEN;
    }
  return c;
}

/* Whether the bits of a square are right. Samples outside the window count as
 * covered once their cell has been entered. */
static bool is_right(struct census c, int size, bool covered, bool vacant) {
  long size_2 = (long)size * size;
  if (covered && vacant)
    return false;
  if (vacant)
    return c.all > 0 && !c.covered;
  return covered == (c.covered == c.all) &&
         (covered || c.covered || c.all < size_2);
}

struct path {
  long cells, wrong;
};

static void follow(const struct picture *p, struct path *path, int level,
                   uint32_t number, int x, int y, int size) {
  const struct hsr_masks *m = &p->masks;
  if (level == HSR_MASK_LEVELS)
    bail("there are too many levels");
  path->cells++;
  for (int bit = 0; bit < 64; bit++) {
    int sub = size / 8, sx = x + bit % 8 * sub, sy = y + bit / 8 * sub;
    struct census c = count_square(p, sx, sy, sub);
    if (level == m->n_levels - 1) {
      path->wrong +=
          (m->finest[number] >> bit & 1) != (uint64_t)(c.covered == c.all);
      continue;
    }
    const struct hsr_triage *mask = &m->coarse[level][number];
    bool covered = mask->c >> bit & 1, vacant = mask->v >> bit & 1;
    path->wrong += !is_right(c, sub, covered, vacant);
    if (!covered && !vacant)
      follow(p, path, level + 1, 64 * number + (uint32_t)bit, sx, sy, sub);
  }
}

static void follow_all(const struct picture *p, struct path *path) {
  int size = 1;
  for (int k = 0; k < p->masks.n_levels; k++)
    size *= 8;
  follow(p, path, 0, 0, p->window.x0, p->window.y0, size);
}

/* --- Sequences ------------------------------------------------------------ */

struct sequence {
  long differ, twice, outside, said_wrong, unseen_said_seen, hidden, unsure,
      polygons, seen, unwritten;
  struct path path;
  uint64_t cells;
};

static void ask(struct picture *p, const struct polygon *polygon,
                struct seen seen, struct sequence *s) {
  struct hsr_bounds box = box_of(polygon, &p->window, p->masks.anywhere);
  struct hsr_tally before = p->tally;
  if (box.x0 >= box.x1 || box.y0 >= box.y1)
    return;
  bool shows = p->build->show(&p->masks, &polygon->told, box);
  p->tally = before;
  s->seen += shows;
  s->said_wrong += !shows && seen.within;
  s->unseen_said_seen += polygon->telling == SURE && shows && !seen.closed;
}

static void tile_sequence(struct picture *p, int n, bool from_root,
                          uint64_t seed, struct sequence *s) {
  for (int k = 0; k < n; k++) {
    struct polygon polygon;
    bool hidden;
    random_polygon(&polygon, &p->window, &seed);
    p->id = (uint32_t)k;
    struct seen seen = want(p, &polygon);
    ask(p, &polygon, seen, s);
    tile(p, &polygon, from_root, &hidden);
    s->said_wrong += hidden && seen.within;
    s->hidden += hidden;
    if (k % 8 == 0)
      follow_all(p, &s->path);
  }
  follow_all(p, &s->path);
  p->id = HSR_BACKGROUND;
  want_background(p);
  tile_background(p);
  follow_all(p, &s->path);
  s->polygons += n;
  s->differ += count_wrong(p);
  s->twice += p->twice;
  s->outside += p->outside;
  s->unwritten +=
      (long)(p->window.x1 - p->window.x0) * (p->window.y1 - p->window.y0) -
      p->written;
  s->unsure += (long)p->tally.count[UNSURE];
  s->cells += p->tally.count[CELLS];
}

/* When every sample of the window is covered, nothing is visible. */
static bool hides_all(struct picture *p, uint64_t seed) {
  for (int k = 0; k < 50; k++) {
    struct polygon polygon;
    random_polygon(&polygon, &p->window, &seed);
    struct hsr_bounds box = box_of(&polygon, &p->window, p->masks.anywhere);
    if (box.x0 < box.x1 && box.y0 < box.y1 &&
        p->build->show(&p->masks, &polygon.told, box))
      return false;
  }
  return true;
}

static void test_sequences(struct tap *tap, struct picture *p,
                           struct hsr_window window, int patterns) {
  static const int intervals[] = {64, 4, 16, 128};
  struct sequence all = {.differ = 0};
  uint64_t cells[2] = {0, 0};
  bool hides = true;
  for (int k = 0; k < 16; k++) {
    struct sequence s = {.differ = 0};
    bool from_root = k & 1;
    const struct build *build = &builds[k >> 1 & 1];
    begin(p, build, window, intervals[k >> 2], patterns);
    tile_sequence(p, k < 8 ? 60 : 250, from_root, (uint64_t)(k >> 1), &s);
    hides &= hides_all(p, (uint64_t)k);
    cells[from_root] += s.cells;
    all.differ += s.differ;
    all.twice += s.twice;
    all.outside += s.outside;
    all.unwritten += s.unwritten;
    all.said_wrong += s.said_wrong;
    all.unseen_said_seen += s.unseen_said_seen;
    all.hidden += s.hidden;
    all.seen += s.seen;
    all.unsure += s.unsure;
    all.polygons += s.polygons;
    all.path.cells += s.path.cells;
    all.path.wrong += s.path.wrong;
    end(p);
  }
  char name[64];
  snprintf(name, sizeof name, "%d x %d at (%d, %d)%s", window.x1 - window.x0,
           window.y1 - window.y0, window.x0, window.y0,
           patterns ? ", jittered" : "");
  ok(tap, !all.differ && all.unsure,
     "%s: %ld polygons as by all samples, %ld differ (%ld samples were unsure)",
     name, all.polygons, all.differ, all.unsure);
  ok(tap, !all.twice && !all.outside && !all.unwritten,
     "%s: each sample is written once; %ld twice, %ld outside, %ld never", name,
     all.twice, all.outside, all.unwritten);
  ok(tap, !all.path.wrong && all.path.cells > 100,
     "%s: of %ld cells on paths that are active, %ld subcells are wrong", name,
     all.path.cells, all.path.wrong);
  ok(tap, !all.said_wrong && all.hidden && all.seen,
     "%s: %ld boxes are hidden, %ld polygons are seen, %ld wrongly not", name,
     all.hidden, all.seen, all.said_wrong);
  ok(tap, !all.unseen_said_seen && hides,
     "%s: polygons that are known are seen only where a sample is: %ld are not",
     name, all.unseen_said_seen);
  ok(tap, cells[0] < cells[1],
     "%s: %llu cells from the box on, %llu from the root on", name,
     (unsigned long long)cells[0], (unsigned long long)cells[1]);
}

/* --- The nine cases ------------------------------------------------------- */

/* The part x < at, or y < at, of the window of 64 x 64. */
static struct polygon half(bool of_rows, int64_t at) {
  struct polygon p = {.n = 4, .near = INT64_MAX};
  int64_t x1 = of_rows ? 100 : at, y1 = of_rows ? at : 100;
  const struct point corner[4] = {
      {-100, -100}, {x1, -100}, {x1, y1}, {-100, y1}};
  for (int k = 0; k < 4; k++)
    p.corner[k] = (struct point){UNIT * corner[k].x, UNIT * corner[k].y};
  return p;
}

static uint64_t columns(int c0, int c1) {
  return (uint64_t)((1 << c1) - (1 << c0)) * 0x0101010101010101u;
}

static uint64_t rows(int r0, int r1) {
  uint64_t mask = 0;
  for (int row = r0; row < r1; row++)
    mask |= (uint64_t)255 << (8 * row);
  return mask;
}

/* The screen is covered in columns 0 to 2, active in column 3 and vacant
 * beyond; the polygon covers rows 0 to 2, leaves row 3 active and those beyond
 * vacant.
 */
static void test_cases(struct tap *tap, struct picture *p) {
  struct polygon screen = half(false, 28), polygon = half(true, 28);
  uint64_t seed = 1;
  bool hidden;
  begin(p, &builds[0], (struct hsr_window){0, 0, 64, 64}, 64, 0);
  set_polygon(&screen, &seed);
  set_polygon(&polygon, &seed);
  p->id = 1;
  want(p, &screen);
  tile(p, &screen, true, &hidden);
  struct hsr_triage before = p->masks.coarse[0][0];
  long written = p->written;
  p->tally = (struct hsr_tally){.trace = NULL};
  p->id = 2;
  want(p, &polygon);
  tile(p, &polygon, true, &hidden);
  struct hsr_triage after = p->masks.coarse[0][0];
  ok(tap, before.c == columns(0, 3) && before.v == columns(4, 8),
     "the nine cases: a screen of covered, active and vacant columns");
  ok(tap,
     p->tally.count[CELLS] == 1 + 3 + 1 + 4 && p->tally.count[FINEST] == 8 &&
         p->written - written == (64 - 28) * 28,
     "cases 4, 5 and 8 visit a cell each: %llu; %ld samples",
     (unsigned long long)p->tally.count[CELLS], p->written - written);
  ok(tap,
     after.c == (columns(0, 3) | (columns(0, 8) & rows(0, 3))) &&
         after.v == (columns(4, 8) & rows(4, 8)) && !count_wrong(p) &&
         !p->twice,
     "what is covered by either is, what is vacant in both is: %016llx, "
     "%016llx",
     (unsigned long long)after.c, (unsigned long long)after.v);
  end(p);
}

/* --- Costs ---------------------------------------------------------------- */

/* Polygons behind one that fills the window. */
static void test_occluder(struct tap *tap, struct picture *p) {
  enum { BEHIND = 300 };
  struct polygon all = half(true, 600);
  uint64_t seed = 5, right = 0, outside = 0;
  bool hidden;
  begin(p, &builds[0], (struct hsr_window){0, 0, 600, 300}, 64, 0);
  all.corner[1].x = all.corner[2].x = 700 * UNIT;
  set_polygon(&all, &seed);
  p->id = 1;
  tile(p, &all, true, &hidden);
  bool filled = p->written == 600 * 300 && p->tally.count[FINEST] == 0;
  for (int k = 0; k < BEHIND; k++) {
    struct polygon polygon;
    random_polygon(&polygon, &p->window, &seed);
    struct hsr_bounds box = box_of(&polygon, &p->window, false);
    p->tally = (struct hsr_tally){.trace = NULL};
    tile(p, &polygon, k & 1, &hidden);
    bool in = k & 1 || (box.x0 < box.x1 && box.y0 < box.y1);
    outside += !in;
    right += p->tally.count[CELLS] == (uint64_t)in &&
             p->tally.count[FINEST] == 0 && hidden == (in && !(k & 1));
  }
  ok(tap, filled && p->written == 600 * 300,
     "an occluder of the window takes no finest cell, and what is behind it no "
     "sample");
  ok(tap, right == BEHIND && outside < BEHIND / 4,
     "each of %d polygons behind it costs the root and no more: %llu", BEHIND,
     (unsigned long long)right);
  end(p);
}

/* Bits a sample, without those that align the arrays: from 1 1/32 to 1 2/63. */
static void test_memory(struct tap *tap) {
  bool good = true;
  double bits = 0;
  for (int levels = 2; levels <= 4; levels++) {
    struct hsr_arena arena = HSR_ARENA_EMPTY;
    struct hsr_masks masks = {.pixel = 1};
    int side = 1 << (3 * levels);
    struct hsr_window window = {0, 0, side, side};
    if (hsr_masks_init_counting(&masks, &window, 0, &arena))
      bail("out of memory");
    double samples = (double)side * side, pad = 8 * 64 * (4 * levels + 1);
    bits = 8 * (double)arena.used_bytes / samples;
    good &= masks.n_levels == levels && bits >= 1 + 1 / 32.0 &&
            bits - pad / samples < 1 + 2 / 63.0 &&
            hsr_masks_extent(&masks) == side;
    hsr_arena_free(&arena);
  }
  ok(tap, good, "memory: %.4f bits a sample of 4096 x 4096", bits);
}

/* The number of the cell that holds a sample, on the level whose cells have
 * `size` samples a side. Each level adds a digit of base 64. */
static size_t number_of(int x, int y, int root, int size) {
  size_t number = 0;
  for (int side = root / 8; side >= size; side /= 8)
    number = 64 * number + (size_t)(y / side % 8 * 8 + x / side % 8);
  return number;
}

/* No cell of a window is beyond its arrays, and the last one is there. */
static void test_cells(struct tap *tap) {
  static const int windows[][2] = {{8, 8},   {9, 1},    {1, 65},  {65, 64},
                                   {97, 61}, {513, 90}, {600, 7}, {512, 512}};
  int good = 0;
  for (int w = 0; w < 8; w++) {
    struct hsr_arena arena = HSR_ARENA_EMPTY;
    struct hsr_masks masks = {.pixel = 1};
    struct hsr_window window = {16, 5, 16 + windows[w][0], 5 + windows[w][1]};
    if (hsr_masks_init_counting(&masks, &window, 0, &arena))
      bail("out of memory");
    int root = hsr_masks_extent(&masks), size = root;
    for (int level = 0; level < masks.n_levels; level++, size /= 8) {
      size_t most = 0;
      for (int y = 0; y < windows[w][1]; y++)
        for (int x = 0; x < windows[w][0]; x++) {
          size_t number = number_of(x, y, root, size);
          most = number > most ? number : most;
        }
      good += hsr_masks_cells(&masks, level) == most + 1;
    }
    hsr_arena_free(&arena);
  }
  ok(tap, good == 1 + 2 + 3 + 3 + 3 + 4 + 4 + 3,
     "the cells of windows, as many as are needed: %d", good);
}

/* Filtered pictures: all 64 samples of each pixel are reported, once. */
struct popcounts {
  int of[64][64];
  int m;
};

static void add_samples(void *context, int x, int y, uint64_t mask) {
  struct popcounts *p = context;
  for (; mask; mask &= mask - 1)
    p->of[y / 8][x / 8]++;
}

static void add_square(void *context, int x, int y, int size) {
  struct popcounts *p = context;
  for (int j = y / 8; j < (y + size) / 8 && j < p->m; j++)
    for (int i = x / 8; i < (x + size) / 8 && i < p->m; i++)
      p->of[j][i] += 64;
}

static void test_popcounts(struct tap *tap, struct picture *p) {
  static struct popcounts counts;
  long good = 0;
  enum { PIXELS = 40 };
  for (int patterns = 0; patterns <= PATTERNS; patterns += PATTERNS) {
    uint64_t seed = 8;
    struct hsr_mask_sink sink = {add_samples, add_square, &counts};
    struct hsr_mask_polygon all = {NULL, 0, NULL, NULL, NULL};
    begin(p, &builds[0], (struct hsr_window){0, 0, 8 * PIXELS, 8 * PIXELS}, 64,
          patterns);
    counts = (struct popcounts){.m = PIXELS};
    for (int k = 0; k < 300; k++) {
      struct polygon polygon;
      random_polygon(&polygon, &p->window, &seed);
      p->build->tile_root(&p->masks, &polygon.told, &sink);
    }
    p->build->tile_root(&p->masks, &all, &sink);
    for (int k = 0; k < PIXELS * PIXELS; k++)
      good += counts.of[k / PIXELS][k % PIXELS] == 64;
    end(p);
  }
  ok(tap, good == 2 * PIXELS * PIXELS,
     "of each pixel 64 samples are counted: of %ld, with and without jitter",
     good);
}

int main(void) {
  static const struct hsr_window windows[] = {{0, 0, 8, 8},
                                              {0, 0, 97, 61},
                                              {13, 7, 110, 68},
                                              {0, 0, 512, 512},
                                              {0, 0, 600, 300}};
  enum { WINDOWS = sizeof windows / sizeof *windows };
  struct picture *p = malloc(sizeof *p);
  struct tap tap = plan(6 * (WINDOWS + 1) + 8);
  if (!p)
    bail("out of memory");
  for (int k = 0; k < WINDOWS; k++)
    test_sequences(&tap, p, windows[k], 0);
  test_sequences(&tap, p, (struct hsr_window){0, 0, 160, 104}, PATTERNS);
  test_cases(&tap, p);
  test_occluder(&tap, p);
  test_memory(&tap);
  test_cells(&tap);
  test_popcounts(&tap, p);
  free(p);
  return finish(&tap);
}
