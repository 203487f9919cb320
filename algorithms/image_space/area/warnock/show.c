/* SPDX-License-Identifier: GPL-3.0-or-later */
/* See show.h. */
#include "algorithms/image_space/area/warnock/show.h"

#include <string.h>

/* --- At once -------------------------------------------------------------- */

static void paint(const struct hsr_show *show, const struct hsr_window *w,
                  uint32_t id) {
  for (int j = w->y0; j < w->y1; j++) {
    uint32_t *row = hsr_job_row(show->job, j);
    for (int i = w->x0; i < w->x1; i++)
      row[i] = id;
  }
}

/* What of face f lies in the window. */
static void paint_face(const struct hsr_show *show, const struct hsr_window *w,
                       uint32_t f) {
  struct hsr_tally *tally = show->job->tally;
  const struct hsr_bounds *bounds = &show->screen->bounds[f];
  int first = bounds->y0 > w->y0 ? bounds->y0 : w->y0;
  int end = bounds->y1 < w->y1 ? bounds->y1 : w->y1;
  for (int j = first; j < end; j++) {
    uint32_t *row = hsr_job_row(show->job, j);
    int n = hsr_face_spans(show->screen, f, j, show->columns, tally);
    for (int k = 0; k < n; k += 2) {
      int x0 = show->columns[k] > w->x0 ? show->columns[k] : w->x0;
      int x1 = show->columns[k + 1] < w->x1 ? show->columns[k + 1] : w->x1;
      if (x0 >= x1)
        continue;
      HSR_STEP(tally, show->run, HSR_FACE(f), HSR_THE_WINDOW, HSR_ON(x0, x1, j),
               0);
      for (int i = x0; i < x1; i++)
        row[i] = f;
    }
  }
}

static void paint_decided(const struct hsr_show *show,
                          const struct hsr_window *w, uint32_t id,
                          uint32_t front) {
  paint(show, w, id);
  if (front != HSR_BACKGROUND)
    paint_face(show, w, front);
}

enum hsr_status hsr_show_init(struct hsr_show *show, const struct hsr_job *job,
                              const struct hsr_screen *screen, int run,
                              bool later) {
  uint32_t largest = 0;
  for (uint32_t r = 0; r < screen->n_relevant; r++) {
    uint32_t size = hsr_face_size(job->world, screen->relevant[r]);
    largest = size > largest ? size : largest;
  }
  *show = (struct hsr_show){
      .job = job, .screen = screen, .run = run, .later = later};
  show->columns = HSR_NEW(job->scratch, int, largest + 4);
  return show->columns ? HSR_OK : HSR_E_NOMEM;
}

void hsr_show_window(struct hsr_show *show, struct hsr_window window,
                     uint32_t id, uint32_t front) {
  if (!show->later) {
    paint_decided(show, &window, id, front);
  } else if (hsr_arena_grow(show->job->scratch, &show->list,
                            sizeof(struct hsr_decided))) {
    struct hsr_decided *items = show->list.items;
    items[show->list.n - 1] = (struct hsr_decided){window, id, front};
  } else {
    show->out_of_memory = true;
  }
}

/* --- As a raster ---------------------------------------------------------- */

/* One pass of the sort: into a bucket for each row, or each column, by where a
 * window begins. start[] has room for one more than the buckets. */
static void sort_by(struct hsr_show *show, const struct hsr_decided *in,
                    struct hsr_decided *out, bool by_row, size_t *start,
                    size_t n_buckets, int counter) {
  const struct hsr_window *picture = &show->job->view->window;
  int from = by_row ? picture->y0 : picture->x0;
  memset(start, 0, (n_buckets + 1) * sizeof *start);
  for (size_t k = 0; k < show->list.n; k++)
    start[(by_row ? in[k].window.y0 : in[k].window.x0) - from + 1]++;
  for (size_t b = 0; b < n_buckets; b++)
    start[b + 1] += start[b];
  for (size_t k = 0; k < show->list.n; k++) {
    out[start[(by_row ? in[k].window.y0 : in[k].window.x0) - from]++] = in[k];
    HSR_STEP(show->job->tally, counter, HSR_THE_WINDOW, HSR_NOTHING,
             in[k].window, by_row);
  }
}

/* The windows of one row, from left to right: those that go on from the row
 * above, n in `active`, and those from *next on that begin here. */
static size_t merge_row(struct hsr_show *show, int j, size_t *next, size_t n,
                        const uint32_t *active, uint32_t *merged,
                        const struct hsr_raster_counters *counters) {
  const struct hsr_decided *items = show->list.items;
  size_t n_merged = 0, k = 0;
  for (;;) {
    while (k < n && items[active[k]].window.y1 == j)
      k++;
    bool begins = *next < show->list.n && items[*next].window.y0 == j;
    if (k == n && !begins)
      return n_merged;
    bool is_next = begins;
    if (k < n && begins) {
      is_next = items[*next].window.x0 < items[active[k]].window.x0;
      HSR_STEP(show->job->tally, counters->merge, HSR_THE_WINDOW,
               HSR_THE_WINDOW, items[*next].window, is_next);
    }
    merged[n_merged++] = is_next ? (uint32_t)(*next)++ : active[k++];
  }
}

static void put_out_row(struct hsr_show *show, int j, const uint32_t *row,
                        size_t n, int counter) {
  const struct hsr_decided *items = show->list.items;
  for (size_t k = 0; k < n; k++) {
    const struct hsr_decided *d = &items[row[k]];
    struct hsr_window part = HSR_ON(d->window.x0, d->window.x1, j);
    HSR_STEP(show->job->tally, counter, HSR_THE_WINDOW, HSR_NOTHING, part, 0);
    paint_decided(show, &part, d->id, d->front);
  }
}

enum hsr_status hsr_show_raster(struct hsr_show *show,
                                const struct hsr_raster_counters *counters) {
  const struct hsr_window *picture = &show->job->view->window;
  struct hsr_arena *arena = show->job->scratch;
  size_t width = (size_t)(picture->x1 - picture->x0);
  size_t height = (size_t)(picture->y1 - picture->y0);
  size_t longest = width > height ? width : height;
  struct hsr_decided *aside = HSR_NEW(arena, struct hsr_decided, show->list.n);
  size_t *start = HSR_NEW(arena, size_t, longest + 1);
  uint32_t *active = HSR_NEW(arena, uint32_t, width);
  uint32_t *merged = HSR_NEW(arena, uint32_t, width);
  if (!aside || !start || !active || !merged)
    return HSR_E_NOMEM;

  sort_by(show, show->list.items, aside, false, start, width, counters->sort);
  sort_by(show, aside, show->list.items, true, start, height, counters->sort);
  size_t next = 0, n = 0;
  for (int j = picture->y0; j < picture->y1; j++) {
    n = merge_row(show, j, &next, n, active, merged, counters);
    put_out_row(show, j, merged, n, counters->rows);
    uint32_t *old = active;
    active = merged;
    merged = old;
  }
  return HSR_OK;
}
