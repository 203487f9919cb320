/* SPDX-License-Identifier: GPL-3.0-or-later */
/* See regions.h. */
#include "algorithms/image_space/area/warnock/regions.h"

#include <stdlib.h>
#include <string.h>

/* --- The regions ---------------------------------------------------------- */

/* The bounds of 2^level parts of [from, to), halved again and again as Warnock's
 * windows are. Where [from, to) is short, some parts are empty. */
static void divide(int from, int to, int level, int *bound) {
  bound[0] = from;
  bound[1 << level] = to;
  for (int step = 1 << level; step > 1; step /= 2)
    for (int k = 0; k < 1 << level; k += step)
      bound[k + step / 2] = bound[k] + (bound[k + step] - bound[k] + 1) / 2;
}

/* The parts that [from, to) reaches, as [*first, *end). */
static void reach(const int *bound, int level, int from, int to, uint8_t *first,
                  uint8_t *end) {
  int k = 0;
  while (k < 1 << level && bound[k + 1] <= from)
    k++;
  *first = (uint8_t)k;
  while (k < 1 << level && bound[k] < to)
    k++;
  *end = (uint8_t)k;
}

static struct hsr_region_range find_range(const struct hsr_regions *regions,
                                          const struct hsr_bounds *b) {
  struct hsr_region_range range;
  reach(regions->column, regions->level, b->x0, b->x1, &range.c0, &range.c1);
  reach(regions->row, regions->level, b->y0, b->y1, &range.r0, &range.r1);
  bool none = range.c0 >= range.c1 || range.r0 >= range.r1;
  return none ? (struct hsr_region_range){0} : range;
}

static bool holds(const struct hsr_region_range *range, int c, int r) {
  return c >= range->c0 && c < range->c1 && r >= range->r0 && r < range->r1;
}

/* --- Changes -------------------------------------------------------------- */

/* Adds face f to the lists of the regions in `now` that are not in `before`. */
static bool enter(struct hsr_regions *regions, uint32_t f,
                  const struct hsr_region_range *before,
                  const struct hsr_region_range *now, struct hsr_tally *tally,
                  int counter) {
  for (int r = now->r0; r < now->r1; r++)
    for (int c = now->c0; c < now->c1; c++) {
      if (holds(before, c, r))
        continue;
      HSR_STEP(tally, counter, HSR_FACE(f), HSR_THE_WINDOW,
               hsr_region_window(regions, c, r), 0);
      struct hsr_growing *list = &regions->list[(r << regions->level) + c];
      if (!hsr_arena_grow(&regions->arena, list, sizeof(uint32_t)))
        return false;
      ((uint32_t *)list->items)[list->n - 1] = f;
    }
  return true;
}

/* Compares each face's range with that of the last frame. */
static bool change(struct hsr_regions *regions, const struct hsr_job *job,
                   const struct hsr_screen *screen,
                   struct hsr_region_range *now,
                   const struct hsr_region_counters *counters) {
  for (uint32_t r = 0; r < screen->n_relevant; r++) {
    uint32_t f = screen->relevant[r];
    now[f] = find_range(regions, &screen->bounds[f]);
    bool same = !memcmp(&now[f], &regions->range[f], sizeof *now);
    HSR_STEP(job->tally, counters->ranges, HSR_FACE(f), HSR_NOTHING,
             hsr_window_make(screen->bounds[f].x0, screen->bounds[f].y0,
                             screen->bounds[f].x1, screen->bounds[f].y1),
             same);
    if (!same && !enter(regions, f, &regions->range[f], &now[f], job->tally,
                        counters->enter))
      return false;
  }
  return true;
}

/* Takes the faces from a region's list whose ranges no longer hold it. */
static void leave(struct hsr_regions *regions, int c, int r,
                  struct hsr_tally *tally, int counter) {
  struct hsr_growing *list = &regions->list[(r << regions->level) + c];
  uint32_t *faces = list->items;
  size_t n_kept = 0;
  for (size_t k = 0; k < list->n; k++) {
    if (holds(&regions->range[faces[k]], c, r))
      faces[n_kept++] = faces[k];
    else
      HSR_STEP(tally, counter, HSR_FACE(faces[k]), HSR_THE_WINDOW,
               hsr_region_window(regions, c, r), 0);
  }
  list->n = n_kept;
}

/* --- Z sort --------------------------------------------------------------- */

/* What a sort needs. */
struct sort {
  const uint32_t *key;
  uint32_t *aside;
  struct hsr_tally *tally;
  int counter;
  struct hsr_window window;
};

/* Is face b before face a, though it stands behind it? */
static bool swapped(const struct sort *s, uint32_t a, uint32_t b) {
  bool before = s->key[b] > s->key[a];
  HSR_STEP(s->tally, s->counter, HSR_FACE(a), HSR_FACE(b), s->window, before);
  return before;
}

/* The end of the run in order that begins at faces[k]. */
static size_t run_end(const struct sort *s, const uint32_t *faces, size_t k,
                      size_t n) {
  for (k++; k < n && !swapped(s, faces[k - 1], faces[k]);)
    k++;
  return k;
}

/* Merges the runs [from, middle) and [middle, to). */
static void merge(const struct sort *s, uint32_t *faces, size_t from,
                  size_t middle, size_t to) {
  size_t n = middle - from, a = 0, b = middle, at = from;
  memcpy(s->aside, faces + from, n * sizeof *faces);
  while (a < n && b < to)
    faces[at++] =
        swapped(s, s->aside[a], faces[b]) ? faces[b++] : s->aside[a++];
  memcpy(faces + at, s->aside + a, (n - a) * sizeof *faces);
}

/* A natural merge sort: pairs of runs that are in order are merged, until there
 * is one. A list that has kept its order is one run. */
static void sort_list(const struct sort *s, uint32_t *faces, size_t n) {
  size_t from = 0;
  while (from < n) {
    size_t middle = run_end(s, faces, from, n);
    if (from == 0 && middle == n)
      return;
    size_t to = middle < n ? run_end(s, faces, middle, n) : n;
    if (middle < n)
      merge(s, faces, from, middle, to);
    from = to == n ? 0 : to;
  }
}

/* --- From frame to frame -------------------------------------------------- */

struct hsr_regions *hsr_regions_new(int level, uint32_t n_faces) {
  struct hsr_regions *regions = calloc(1, sizeof *regions);
  if (!regions)
    return NULL;
  regions->level = level;
  regions->range = calloc(n_faces + 1, sizeof *regions->range);
  if (!regions->range) {
    free(regions);
    return NULL;
  }
  return regions;
}

void hsr_regions_free(struct hsr_regions *regions) {
  if (!regions)
    return;
  hsr_arena_free(&regions->arena);
  free(regions->range);
  free(regions);
}

/* Forgets what was kept. */
static void forget(struct hsr_regions *regions, uint32_t n_faces) {
  memset(regions->list, 0, sizeof regions->list);
  memset(regions->range, 0, n_faces * sizeof *regions->range);
  hsr_arena_free(&regions->arena);
}

enum hsr_status hsr_regions_update(struct hsr_regions *regions,
                                   const struct hsr_job *job,
                                   const struct hsr_screen *screen,
                                   const uint32_t *key,
                                   const struct hsr_region_counters *counters) {
  uint32_t n_faces = job->world->n_faces;
  const struct hsr_window *picture = &job->view->window;
  divide(picture->x0, picture->x1, regions->level, regions->column);
  divide(picture->y0, picture->y1, regions->level, regions->row);
  struct hsr_region_range *now =
      HSR_NEW_ZEROED(job->scratch, struct hsr_region_range, n_faces);
  uint32_t *aside = HSR_NEW(job->scratch, uint32_t, n_faces);
  if (!now || !aside || !change(regions, job, screen, now, counters)) {
    forget(regions, n_faces);
    return HSR_E_NOMEM;
  }
  memcpy(regions->range, now, n_faces * sizeof *now);
  for (int r = 0; r < 1 << regions->level; r++)
    for (int c = 0; c < 1 << regions->level; c++) {
      struct hsr_growing *list = &regions->list[(r << regions->level) + c];
      leave(regions, c, r, job->tally, counters->leave);
      struct sort sort = {key, aside, job->tally, counters->sort,
                          hsr_region_window(regions, c, r)};
      sort_list(&sort, list->items, list->n);
    }
  return HSR_OK;
}
