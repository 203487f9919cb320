/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The ZZ-buffer: lists of faces for cells of the screen, and then rays.
 *
 * Source      D. Salesin and J. Stolfi, "The ZZ-buffer: a simple and efficient
 *             rendering algorithm with reliable antialiasing", PIXIM 1989; as
 *             told by N. Greene, PhD thesis, UC Santa Cruz, 1995, 2.1.4.
 * Notation    primitive -> face; cell -> a square of `cell` samples a side, at
 *             the foot of a pyramid of windows; surrounder, intersecter,
 *             disjoint -> enum hsr_relation (area.h)
 * Invariants  A face that is visible at a sample is in the list of one window
 *             of the pyramid that holds the sample. A face listed above the
 *             cells surrounds its window. The surrounder kept for a window is
 *             before every surrounder kept there earlier.
 * Ties        over a window by hsr_area_order, at a sample by hsr_nearer
 * Departures  A surrounder is listed once for its window, and not in each of
 *             its cells. A cell collects the lists above it when its rays are
 *             cast, and drops what its nearest surrounder hides. Rays go
 *             through the samples.
 * Cost        Every face of the picture is compared with windows, visible or
 *             not: the tiling pass. Then each sample looks at the list of its
 *             cell: the rendering pass. */
#include "algorithms/engines/windows/area.h"

enum {
  FACES,
  HIDDEN,
  RELATIONS,
  SUBDIVISIONS,
  LISTED,
  SURROUNDERS,
  CELLS,
  DROPPED,
  KEPT,
  TESTS,
  DEPTHS,
  SHOWN
};

enum option { CELL };
static const struct hsr_option options[] = {
    [CELL] = {"cell", "samples a side of a cell", NULL, 1, 256, 8}, {NULL}};

enum { LEVELS = 16 };
#define NO_ENTRY UINT32_MAX

/* A face in the list of a window. */
struct entry {
  uint32_t face;
  uint32_t next; /* NO_ENTRY: the last */
  bool surrounds;
};

struct node {
  uint32_t first;      /* of its list */
  uint32_t surrounder; /* HSR_BACKGROUND: none */
};

struct zz {
  const struct hsr_job *job;
  struct hsr_tally *tally;
  struct hsr_screen screen;
  const struct hsr_window *window;
  int cell, n_levels;        /* level 0: the cells */
  int across[LEVELS];        /* windows a row of each level, */
  int down[LEVELS];          /* and rows */
  struct node *node[LEVELS]; /* row by row */
  struct hsr_growing entry;
  bool out_of_memory;
  struct entry *list; /* of the current cell */
  uint32_t n;
};

static struct node *node_at(const struct zz *z, int level, int x, int y) {
  return &z->node[level][(size_t)y * (size_t)z->across[level] + (size_t)x];
}

static struct hsr_area area_at(const struct zz *z, int level, int x, int y) {
  const struct hsr_window *w = z->window;
  int side = z->cell << level;
  struct hsr_window s = {w->x0 + x * side, w->y0 + y * side, w->x1, w->y1};
  s.x1 = w->x1 - s.x0 > side ? s.x0 + side : w->x1;
  s.y1 = w->y1 - s.y0 > side ? s.y0 + side : w->y1;
  return hsr_area_make(z->job->view, s);
}

static bool is_behind(struct zz *z, uint32_t f, uint32_t surrounder,
                      const struct hsr_area *area) {
  struct hsr_area_depths a = hsr_area_depths(&z->screen, surrounder, area);
  struct hsr_area_depths b = hsr_area_depths(&z->screen, f, area);
  bool behind = hsr_area_order(&z->screen, &a, &b) > 0;
  HSR_STEP(z->tally, HIDDEN, HSR_FACE(f), HSR_FACE(surrounder),
           hsr_area_samples(area), behind);
  return behind;
}

/* --- The tiling pass ------------------------------------------------------ */

static void list_face(struct zz *z, struct node *node, uint32_t f,
                      bool surrounds, const struct hsr_area *area) {
  if (!hsr_arena_grow(z->job->scratch, &z->entry, sizeof(struct entry))) {
    z->out_of_memory = true;
    return;
  }
  uint32_t k = (uint32_t)z->entry.n - 1;
  ((struct entry *)z->entry.items)[k] =
      (struct entry){f, node->first, surrounds};
  node->first = k;
  HSR_STEP(z->tally, LISTED, HSR_FACE(f), HSR_THE_WINDOW,
           hsr_area_samples(area), 0);
}

/* A surrounder is kept for its window if it is before the one that is kept. */
static void keep_surrounder(struct zz *z, struct node *node, uint32_t f,
                            const struct hsr_area *area) {
  if (node->surrounder != HSR_BACKGROUND &&
      !is_behind(z, node->surrounder, f, area))
    return;
  node->surrounder = f;
  HSR_STEP(z->tally, SURROUNDERS, HSR_FACE(f), HSR_THE_WINDOW,
           hsr_area_samples(area), 0);
}

static void insert(struct zz *z, uint32_t f, int level, int x, int y) {
  if (x >= z->across[level] || y >= z->down[level])
    return;
  struct node *node = node_at(z, level, x, y);
  struct hsr_area area = area_at(z, level, x, y);
  struct hsr_window samples = hsr_area_samples(&area);
  if (node->surrounder != HSR_BACKGROUND &&
      is_behind(z, f, node->surrounder, &area))
    return;
  bool by_box;
  enum hsr_relation relation = hsr_area_relate(
      &z->screen, f, z->screen.bounds[f], &area, &by_box, z->tally);
  HSR_STEP(z->tally, RELATIONS, HSR_FACE(f), HSR_THE_WINDOW, samples, relation);
  if (relation == HSR_DISJOINT)
    return;
  if (relation == HSR_SURROUNDER) {
    keep_surrounder(z, node, f, &area);
    list_face(z, node, f, true, &area);
  } else if (!level) {
    list_face(z, node, f, false, &area);
  } else {
    HSR_STEP(z->tally, SUBDIVISIONS, HSR_FACE(f), HSR_THE_WINDOW, samples, 0);
    for (int q = 0; q < 4; q++)
      insert(z, f, level - 1, 2 * x + q % 2, 2 * y + q / 2);
  }
}

/* --- The rendering pass --------------------------------------------------- */

/* The nearest surrounder of the cell, as far as its first sample tells. */
static uint32_t nearest_surrounder(struct zz *z, int x, int y,
                                   const struct hsr_area *area) {
  uint32_t nearest = HSR_BACKGROUND;
  for (int level = 0; level < z->n_levels; level++) {
    uint32_t f = node_at(z, level, x >> level, y >> level)->surrounder;
    if (f != HSR_BACKGROUND &&
        (nearest == HSR_BACKGROUND ||
         hsr_nearer(&z->screen, f, nearest, area->x0, area->y0, z->tally)))
      nearest = f;
  }
  return nearest;
}

/* Collects the faces listed for a cell. No face is in two lists above it. */
static void collect(struct zz *z, int x, int y, const struct hsr_area *area) {
  struct hsr_window samples = hsr_area_samples(area);
  uint32_t surrounder = nearest_surrounder(z, x, y, area);
  const struct entry *entry = z->entry.items;
  z->n = 0;
  for (int level = 0; level < z->n_levels; level++) {
    uint32_t k = node_at(z, level, x >> level, y >> level)->first;
    for (; k != NO_ENTRY; k = entry[k].next) {
      uint32_t f = entry[k].face;
      if (surrounder != HSR_BACKGROUND && f != surrounder &&
          is_behind(z, f, surrounder, area)) {
        HSR_STEP(z->tally, DROPPED, HSR_FACE(f), HSR_THE_WINDOW, samples, 0);
        continue;
      }
      HSR_STEP(z->tally, KEPT, HSR_FACE(f), HSR_THE_WINDOW, samples, 0);
      z->list[z->n++] = entry[k];
    }
  }
}

static uint32_t cast(struct zz *z, int i, int j) {
  uint32_t nearest = HSR_BACKGROUND;
  for (uint32_t k = 0; k < z->n; k++) {
    uint32_t f = z->list[k].face;
    HSR_TOUCH(z->tally, i, j);
    if (!z->list[k].surrounds) {
      bool hit = hsr_covers(&z->screen, f, i, j, z->tally);
      HSR_STEP(z->tally, TESTS, HSR_FACE(f), HSR_THE_WINDOW, HSR_AT(i, j), hit);
      if (!hit)
        continue;
    }
    if (nearest != HSR_BACKGROUND) {
      bool nearer = hsr_nearer(&z->screen, f, nearest, i, j, z->tally);
      HSR_STEP(z->tally, DEPTHS, HSR_FACE(f), HSR_FACE(nearest), HSR_AT(i, j),
               nearer);
      if (!nearer)
        continue;
    }
    nearest = f;
  }
  if (nearest != HSR_BACKGROUND)
    HSR_STEP(z->tally, SHOWN, HSR_FACE(nearest), HSR_THE_WINDOW, HSR_AT(i, j),
             0);
  return nearest;
}

static void render_cell(struct zz *z, int x, int y) {
  struct hsr_area area = area_at(z, 0, x, y);
  HSR_STEP(z->tally, CELLS, HSR_THE_WINDOW, HSR_NOTHING,
           hsr_area_samples(&area), 0);
  collect(z, x, y, &area);
  for (int j = area.y0; j < area.y1; j++)
    for (int i = area.x0; i < area.x1; i++)
      hsr_job_row(z->job, j)[i] = cast(z, i, j);
}

/* --- The algorithm -------------------------------------------------------- */

/* A pyramid whose apex holds the window. */
static enum hsr_status make_pyramid(struct zz *z) {
  const struct hsr_window *w = z->window;
  int across = (w->x1 - w->x0 + z->cell - 1) / z->cell;
  int down = (w->y1 - w->y0 + z->cell - 1) / z->cell;
  for (int level = 0;; level++) {
    size_t n = (size_t)across * (size_t)down;
    z->n_levels = level + 1;
    z->across[level] = across;
    z->down[level] = down;
    z->node[level] = HSR_NEW(z->job->scratch, struct node, n);
    if (!z->node[level])
      return HSR_E_NOMEM;
    for (size_t k = 0; k < n; k++)
      z->node[level][k] = (struct node){NO_ENTRY, HSR_BACKGROUND};
    if (n == 1)
      return HSR_OK;
    across = (across + 1) / 2;
    down = (down + 1) / 2;
  }
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct zz z = {.job = job,
                 .tally = job->tally,
                 .window = &job->view->window,
                 .cell = (int)job->option[CELL]};
  if (hsr_screen_make(&z.screen, job->world, job->view, job->scratch,
                      job->tally) ||
      make_pyramid(&z))
    return hsr_fail_nomem(err);
  z.list = HSR_NEW(job->scratch, struct entry, z.screen.n_relevant);
  if (!z.list)
    return hsr_fail_nomem(err);
  for (uint32_t r = 0; r < z.screen.n_relevant; r++) {
    uint32_t f = z.screen.relevant[r];
    HSR_STEP(z.tally, FACES, HSR_FACE(f), HSR_NOTHING, HSR_NOWHERE, 0);
    insert(&z, f, z.n_levels - 1, 0, 0);
  }
  if (z.out_of_memory)
    return hsr_fail_nomem(err);
  for (int y = 0; y < z.down[0]; y++)
    for (int x = 0; x < z.across[0]; x++)
      render_cell(&z, x, y);
  return HSR_OK;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_counter counters[] = {
    [FACES] = {"faces", "faces put into the pyramid", HSR_ACTIVATE, HSR_OF_FACE,
               HSR_OF_NOTHING},
    [HIDDEN] = {"depth search", "faces compared with a window's surrounder",
                HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE, "visible|hidden"},
    [RELATIONS] = {"Warnock special", "faces compared with a window",
                   HSR_COMPARE, HSR_OF_FACE, HSR_OF_WINDOW,
                   "disjoint|intersecter|surrounder"},
    [SUBDIVISIONS] = {"subdivisions", "windows divided for a face",
                      HSR_SUBDIVIDE, HSR_OF_FACE, HSR_OF_WINDOW},
    [LISTED] = {"listed", "faces put into the list of a window", HSR_SORT,
                HSR_OF_FACE, HSR_OF_WINDOW},
    [SURROUNDERS] = {"surrounders",
                     "faces that hide all behind them in a "
                     "window",
                     HSR_ACTIVATE, HSR_OF_FACE, HSR_OF_WINDOW},
    [CELLS] = {"cells", "cells rendered", HSR_ACTIVATE, HSR_OF_WINDOW,
               HSR_OF_NOTHING},
    [DROPPED] = {"dropped",
                 "faces in the lists above a cell that are hidden "
                 "in it",
                 HSR_REJECT, HSR_OF_FACE, HSR_OF_WINDOW},
    [KEPT] = {"list length", "faces in the lists of all cells", HSR_ACTIVATE,
              HSR_OF_FACE, HSR_OF_WINDOW},
    [TESTS] = {"ray tests", "rays tested against faces that are no surrounders",
               HSR_SAMPLE, HSR_OF_FACE, HSR_OF_WINDOW, "missed|hit"},
    [DEPTHS] = {"depth tests", "hits of one ray compared in depth", HSR_COMPARE,
                HSR_OF_FACE, HSR_OF_FACE, "farther|nearer"},
    [SHOWN] = {"samples shown", "samples at which a face is visible",
               HSR_ACCEPT, HSR_OF_FACE, HSR_OF_WINDOW},
    {NULL}};

static const struct hsr_line outline[] = {
    {"tiling pass: for each face, from the window of the picture down",
     HSR_RAISES(FACES)},
    {"  leave it if a surrounder of the window hides it", HSR_RAISES(HIDDEN)},
    {"  disjoint, an intersecter, a surrounder?", HSR_RAISES(RELATIONS)},
    {"  a surrounder may be what hides all others", HSR_RAISES(SURROUNDERS)},
    {"  list a surrounder, or an intersecter of a cell", HSR_RAISES(LISTED)},
    {"  else divide the window into four", HSR_RAISES(SUBDIVISIONS)},
    {"rendering pass: for each cell", HSR_RAISES(CELLS)},
    {"  for each face listed for it", HSR_RAISES(KEPT)},
    {"    drop it if the nearest surrounder hides it", HSR_RAISES(DROPPED)},
    {"  for each ray: does it hit a face of the list?", HSR_RAISES(TESTS)},
    {"    is it nearer than the nearest hit so far?", HSR_RAISES(DEPTHS)},
    {"    show the nearest hit", HSR_RAISES(SHOWN)},
    {NULL}};

static const struct hsr_sort sorts[] = {
    {"faces", "(XY)", "radix 4 Quicksort: subdivision down to cells",
     "once a frame"},
    {"hits", "Z", "exhaustive search", "once a ray"},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(zz_buffer) = {
    .name = "zz-buffer",
    .title = "The ZZ-buffer: lists of faces for cells of the screen, then rays",
    .authors = "D. Salesin and J. Stolfi",
    .year = 1989,
    .source = "Salesin and Stolfi, PIXIM 1989; Greene, PhD thesis, UC Santa "
              "Cruz, 1995, 2.1.4",
    .taxonomy = HSR_IMAGE_SPACE_AREA,
    .sort_order = "(XY)Z",
    .coherence = "area",
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_IDS}},
    .sorts = sorts,
    .counters = counters,
    .outline = outline,
    .options = options,
    .render = render};
