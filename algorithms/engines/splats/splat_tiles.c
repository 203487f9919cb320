/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Splats are handed out to the tiles of the window.
 *
 * One tile     a batch of samples is placed, shaded and drawn at once.
 * Several      Batches are collected for a round. Then threads take batches, and
 *              place and shade their splats. One thread lists the splats of each
 *              tile, in sequence. Then threads take tiles, and draw their lists.
 *              A large splat is in the lists of many tiles. So a list may be
 *              full before all of the round is listed; what is listed is drawn
 *              then, and the lists begin anew.
 * Slices       the end of a slice is an entry of every list */
#include "algorithms/engines/splats/splats.h"
#include "common/base/share.h"

#include <string.h>

enum {
  SIDE = 128,        /* pixels of a tile for several threads */
  BATCHES = 512,     /* of a round */
  ENTRIES = 1 << 19, /* of all lists together */
  TELL = 64          /* batches between two calls of who watches */
};
#define FOLD UINT32_MAX /* an entry: a slice ends */

/* The tiles that a splat meets: columns [x0, x1) and rows [y0, y1) of them. Lists
 * are made from these small records, since to read whole splats takes longer. */
struct tiles {
  uint16_t x0, y0, x1, y1;
};

struct hsr_splat_round {
  struct hsr_splat_samples samples[BATCHES];
  bool folds[BATCHES]; /* a slice ends after the batch */
  int n_placed[BATCHES];
  int n, until_told;

  /* If there are several tiles. Of each thread: a frame, a tally and a batch. */
  int threads;
  struct hsr_splats *hand;
  struct hsr_tally *tally;

  struct hsr_placed *placed; /* of each batch, HSR_SPLAT_BATCH at most */
  struct tiles *tiles;       /* of each of these splats */
  uint32_t *entry; /* a splat's batch and place in it, as one number; or FOLD */
  uint32_t n_entries;
  uint32_t *first; /* by tile: its first entry; and the end of all */
  void (*part)(struct hsr_splats *, struct hsr_splat_tile *);
};

/* --- Beginning ------------------------------------------------------------ */

static uint32_t tiles_along(int pixels, int side) {
  return (uint32_t)((pixels + side - 1) / side);
}

static int threads_of(const struct hsr_splats *s) {
  return HSR_COUNTING ? 1 : hsr_threads(s->job->threads);
}

/* Chooses the size of tiles. The counting build has one thread, and so the tiles
 * of one, so that it counts what that one does. */
static void choose_size(struct hsr_splats *s) {
  int columns = s->window.x1 - s->window.x0, rows = s->window.y1 - s->window.y0;
  int most = columns > rows ? columns : rows;
  int side = s->job->tile ? s->job->tile : threads_of(s) > 1 ? SIDE : most;
  s->width = side < columns ? side : columns;
  s->height = side < rows ? side : rows;
}

void hsr_splats_lay(struct hsr_splats *s) {
  const struct hsr_window *w = &s->window;
  uint32_t down = tiles_along(w->y1 - w->y0, s->height);
  s->across = (int)tiles_along(w->x1 - w->x0, s->width);
  s->n_tiles = (uint32_t)s->across * down;
  for (uint32_t t = 0; t < s->n_tiles; t++) {
    struct hsr_window *tile = &s->tile[t].window;
    tile->x0 = w->x0 + (int)(t % (uint32_t)s->across) * s->width;
    tile->y0 = w->y0 + (int)(t / (uint32_t)s->across) * s->height;
    tile->x1 = tile->x0 + s->width < w->x1 ? tile->x0 + s->width : w->x1;
    tile->y1 = tile->y0 + s->height < w->y1 ? tile->y0 + s->height : w->y1;
  }
}

static enum hsr_status open_tiles(struct hsr_splats *s) {
  struct hsr_arena *arena = s->job->scratch;
  const struct hsr_window *w = &s->window;
  size_t n = (size_t)tiles_along(w->x1 - w->x0, s->width) *
             tiles_along(w->y1 - w->y0, s->height);
  s->tile = HSR_NEW(arena, struct hsr_splat_tile, n);
  if (!s->tile)
    return HSR_E_NOMEM;
  hsr_splats_lay(s);
  for (size_t t = 0; t < n; t++) {
    s->tile[t].model = hsr_arena_zeroed(arena, 1, s->how->size);
    if (!s->tile[t].model || s->how->open(s, &s->tile[t]))
      return HSR_E_NOMEM;
  }
  return HSR_OK;
}

/* What several tiles take. */
static enum hsr_status open_lists(struct hsr_splats *s) {
  struct hsr_arena *arena = s->job->scratch;
  struct hsr_splat_round *r = s->round;
  size_t n = (size_t)r->threads;
  r->hand = HSR_NEW(arena, struct hsr_splats, n);
  r->tally = HSR_NEW(arena, struct hsr_tally, n);
  r->placed = HSR_NEW(arena, struct hsr_placed, BATCHES * HSR_SPLAT_BATCH);
  /* A splat, or the end of a slice, may need an entry in every list. */
  r->n_entries = s->n_tiles > ENTRIES ? s->n_tiles : ENTRIES;
  r->tiles = HSR_NEW(arena, struct tiles, BATCHES * HSR_SPLAT_BATCH);
  r->entry = HSR_NEW(arena, uint32_t, r->n_entries);
  r->first = HSR_NEW(arena, uint32_t, (size_t)s->n_tiles + 2);
  struct hsr_splat_batch *batch = HSR_NEW(arena, struct hsr_splat_batch, n);
  if (!r->hand || !r->tally || !r->placed || !r->tiles || !r->entry ||
      !r->first || !batch)
    return HSR_E_NOMEM;
  for (size_t k = 0; k < n; k++)
    r->hand[k] = (struct hsr_splats){.batch = &batch[k]};
  return HSR_OK;
}

enum hsr_status hsr_splats_divide(struct hsr_splats *s,
                                  const struct hsr_splats_module *how) {
  struct hsr_arena *arena = s->job->scratch;
  s->how = how;
  s->batch = HSR_NEW(arena, struct hsr_splat_batch, 1);
  s->round = HSR_NEW(arena, struct hsr_splat_round, 1);
  if (!s->batch || !s->round)
    return HSR_E_NOMEM;
  s->round->n = s->round->until_told = s->round->samples[0].n = 0;
  s->round->threads = threads_of(s);
  choose_size(s);
  if (open_tiles(s))
    return HSR_E_NOMEM;
  if (s->n_tiles > 1)
    return open_lists(s);
  s->round->placed = HSR_NEW(arena, struct hsr_placed, HSR_SPLAT_BATCH);
  return s->round->placed ? HSR_OK : HSR_E_NOMEM;
}

/* --- On the threads ------------------------------------------------------- */

/* Calls part(s, k, thread) for k below n, on the threads, each of which has a
 * frame of its own that is like *s. */
static void share(struct hsr_splats *s, uint32_t n,
                  void (*part)(void *context, uint32_t k, int thread)) {
  struct hsr_splat_round *r = s->round;
  for (int k = 0; k < r->threads; k++) {
    struct hsr_splat_batch *batch = r->hand[k].batch;
    struct hsr_splats_energy last = r->hand[k].last;
    r->hand[k] = *s;
    r->hand[k].batch = batch;
    r->hand[k].last = last;
    r->hand[k].tally = &r->tally[k];
    r->tally[k] = (struct hsr_tally){.work = s->tally->work,
                                     .work_stride = s->tally->work_stride,
                                     .trace = s->tally->trace};
    memcpy(r->tally[k].base, s->tally->base, sizeof s->tally->base);
  }
  hsr_share(r->threads, n, part, s);
  for (int k = 0; k < r->threads; k++)
    hsr_tally_add(s->tally, &r->tally[k]);
}

static void do_part(void *context, uint32_t t, int thread) {
  struct hsr_splats *s = context;
  s->round->part(&s->round->hand[thread], &s->tile[t]);
}

void hsr_splats_each(struct hsr_splats *s,
                     void (*part)(struct hsr_splats *,
                                  struct hsr_splat_tile *)) {
  s->round->part = part;
  if (s->n_tiles == 1)
    part(s, &s->tile[0]);
  else
    share(s, s->n_tiles, do_part);
}

/* --- One tile ------------------------------------------------------------- */

static void draw_at_once(struct hsr_splats *s, bool folds) {
  struct hsr_splat_samples *samples = &s->round->samples[0];
  struct hsr_placed *placed = s->round->placed;
  int n = samples->n ? hsr_splats_place(s, samples, placed) : 0;
  for (int k = 0; k < n; k++)
    s->how->draw(s, &s->tile[0], &placed[k]);
  if (folds)
    s->how->fold(s, &s->tile[0]);
  samples->n = 0;
}

/* --- Lists ---------------------------------------------------------------- */

/* The tiles that a box meets. */
static struct tiles tiles_of(const struct hsr_splats *s,
                             const struct hsr_window *box) {
  int x = s->window.x0, y = s->window.y0;
  return (struct tiles){(uint16_t)((box->x0 - x) / s->width),
                        (uint16_t)((box->y0 - y) / s->height),
                        (uint16_t)((box->x1 - 1 - x) / s->width + 1),
                        (uint16_t)((box->y1 - 1 - y) / s->height + 1)};
}

static void place(void *context, uint32_t k, int thread) {
  struct hsr_splats *s = context;
  struct hsr_splat_round *r = s->round;
  struct hsr_placed *placed = &r->placed[k * HSR_SPLAT_BATCH];
  int n = hsr_splats_place(&r->hand[thread], &r->samples[k], placed);
  for (int i = 0; i < n; i++)
    r->tiles[k * HSR_SPLAT_BATCH + (uint32_t)i] = tiles_of(s, &placed[i].box);
  r->n_placed[k] = n;
}

/* Where the listing of a round is: a batch, and a splat of it; after the splats
 * of a batch comes the end of its slice, if it ends there. */
struct place {
  int batch, splat;
};

/* Finds what is listed at a place, *entry, and the tiles that list it. False if
 * nothing is listed there: the batch has ended, and no slice with it. */
static bool entry_at(const struct hsr_splats *s, const struct place *at,
                     struct tiles *tiles, uint32_t *entry) {
  const struct hsr_splat_round *r = s->round;
  if (at->splat == r->n_placed[at->batch]) {
    *tiles = tiles_of(s, &s->window);
    *entry = FOLD;
    return r->folds[at->batch];
  }
  *entry = (uint32_t)(at->batch * HSR_SPLAT_BATCH + at->splat);
  *tiles = r->tiles[*entry];
  return true;
}

static void go_on(const struct hsr_splat_round *r, struct place *at) {
  if (at->splat++ == r->n_placed[at->batch])
    *at = (struct place){at->batch + 1, 0};
}

/* Counts the entries of each tile from a place on, until the lists would be full:
 * first[t + 2]. Returns that place. */
static struct place count(struct hsr_splats *s, struct place at) {
  struct hsr_splat_round *r = s->round;
  uint32_t all = 0;
  memset(r->first, 0, ((size_t)s->n_tiles + 2) * sizeof *r->first);
  for (; at.batch < r->n; go_on(r, &at)) {
    struct tiles w;
    uint32_t entry;
    if (!entry_at(s, &at, &w, &entry))
      continue;
    all += (uint32_t)((w.x1 - w.x0) * (w.y1 - w.y0));
    if (all > r->n_entries)
      break;
    for (int y = w.y0; y < w.y1; y++)
      for (int x = w.x0; x < w.x1; x++)
        r->first[y * s->across + x + 2]++;
  }
  return at;
}

/* Lists the entries from a place on. Returns the place where that ended. */
static struct place list(struct hsr_splats *s, struct place at) {
  struct hsr_splat_round *r = s->round;
  const struct place end = count(s, at);
  for (uint32_t t = 0; t < s->n_tiles; t++)
    r->first[t + 2] += r->first[t + 1];
  for (; at.batch != end.batch || at.splat != end.splat; go_on(r, &at)) {
    struct tiles w;
    uint32_t entry;
    if (!entry_at(s, &at, &w, &entry))
      continue;
    for (int y = w.y0; y < w.y1; y++)
      for (int x = w.x0; x < w.x1; x++)
        r->entry[r->first[y * s->across + x + 1]++] = entry;
  }
  return end;
}

/* Draws the part of a splat that is in a tile. What is hidden by now is left out. */
static void draw_in_tile(struct hsr_splats *s, struct hsr_splat_tile *tile,
                         const struct hsr_placed *placed) {
  struct hsr_placed clipped;
  const struct hsr_window *box = &placed->box, *w = &tile->window;
  if (box->x0 < w->x0 || box->y0 < w->y0 || box->x1 > w->x1 ||
      box->y1 > w->y1) {
    if (!hsr_splats_clip(s, placed, w, &clipped))
      return;
    placed = &clipped;
  }
  if (s->how->is_hidden &&
      s->how->is_hidden(s, tile, placed->opacity, placed->energy, &placed->box))
    HSR_STEP(s->tally, HSR_SPLAT_SPLATS, HSR_CELL(placed->cell, 0, 0),
             HSR_THE_WINDOW, placed->box, 1);
  else
    s->how->draw(s, tile, placed);
}

static void draw_list(void *context, uint32_t t, int thread) {
  const struct hsr_splats *frame = context;
  const struct hsr_splat_round *r = frame->round;
  struct hsr_splats *s = &r->hand[thread];
  struct hsr_splat_tile *tile = &frame->tile[t];
  for (uint32_t k = r->first[t]; k < r->first[t + 1]; k++)
    if (r->entry[k] == FOLD)
      s->how->fold(s, tile);
    else
      draw_in_tile(s, tile, &r->placed[r->entry[k]]);
}

static void draw_round(struct hsr_splats *s) {
  struct hsr_splat_round *r = s->round;
  share(s, (uint32_t)r->n, place);
  for (struct place at = {0, 0}; at.batch < r->n;) {
    at = list(s, at);
    share(s, s->n_tiles, draw_list);
  }
  r->n = 0;
  r->samples[0].n = 0;
}

/* --- What samples do ------------------------------------------------------ */

static void tell(struct hsr_splats *s) {
  const struct hsr_watch *watch = s->job->watch;
  if (!watch || s->round->until_told--)
    return;
  s->round->until_told = TELL;
  double here = (double)s->visited / s->grid->n_cells;
  s->stopped |= !watch->tell(watch->whom, (s->visit + here) / s->visits);
}

struct hsr_splat_samples *hsr_splats_samples(const struct hsr_splats *s) {
  return &s->round->samples[s->round->n];
}

void hsr_splats_close_batch(struct hsr_splats *s, bool folds) {
  struct hsr_splat_round *r = s->round;
  if (!r->samples[r->n].n && !folds)
    return;
  tell(s);
  if (s->n_tiles == 1) {
    draw_at_once(s, folds);
    return;
  }
  r->folds[r->n++] = folds;
  if (r->n == BATCHES)
    draw_round(s);
  else
    r->samples[r->n].n = 0;
}

void hsr_splats_flush(struct hsr_splats *s) {
  if (s->n_tiles > 1 && s->round->n)
    draw_round(s);
}

bool hsr_splats_is_hidden(const struct hsr_splats *s, uint32_t opacity,
                          uint32_t energy, const struct hsr_window *box) {
  if (!s->how->is_hidden)
    return false;
  const struct tiles tiles = tiles_of(s, box);
  for (int y = tiles.y0; y < tiles.y1; y++)
    for (int x = tiles.x0; x < tiles.x1; x++) {
      const struct hsr_splat_tile *tile = &s->tile[y * s->across + x];
      struct hsr_window w = hsr_window_meet(box, &tile->window);
      if (!s->how->is_hidden(s, tile, opacity, energy, &w))
        return false;
    }
  return true;
}
