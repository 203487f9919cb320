/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The polygons of a cube, by batches: tested, then tiled. See walk.h.
 *
 * Only triangles are tested by the pyramid. The tiler sorts those of a batch
 * into the fast ones, which it tiles together, and the others, which go the
 * general way, one by one and untested (tiler.h). So do faces of more
 * corners. */
#include "algorithms/hierarchical/hzbuffer/walk.h"

/* Is there a pyramid, and is it in use? It is not in the first pass of
 * coherence. */
static bool uses_pyramid(const struct hsr_hz_walk *w) {
  return w->choice.pyramid != HSR_HZ_PYRAMID_OFF && !w->plain;
}

/* The scene's id of face f of a tiler's world: a cell, or the loose faces. */
static uint32_t id_of(const struct hsr_tiler *t, uint32_t f) {
  return t->id ? t->first_id + t->id[f] : f;
}

/* The box of the k-th of a batch's triangles. */
static struct hsr_bounds box_of(const struct hsr_corners *r, int k) {
  struct hsr_bounds box = {r->x0[k], r->y0[k], r->x1[k], r->y1[k]};
  return box;
}

static struct hsr_window window_of(struct hsr_bounds box) {
  return hsr_window_make(box.x0, box.y0, box.x1, box.y1);
}

/* Marks face f of the current cell as met in this frame. Returns true if it had
 * been met before, in another cube. */
static bool meet_again(struct hsr_hz_walk *w, uint32_t f) {
  uint32_t *met = &w->met[w->frame.tiler.id[f]];
  if (*met != w->visit) {
    *met = w->visit;
    return false;
  }
  HSR_STEP(w->tally, HSR_HZ_FACES_REPEATED, HSR_FACE(id_of(&w->frame.tiler, f)),
           HSR_NOTHING, HSR_NOWHERE, 0);
  return true;
}

/* Of a batch's triangles that go the general way, leaves out those met
 * before. */
static void drop_repeated(struct hsr_hz_walk *w, struct hsr_batch *b) {
  for (int k = 0; k < b->n && b->general; k++)
    if (b->fate[k] == HSR_GENERALLY && meet_again(w, b->first + (uint32_t)k))
      b->fate[k] = HSR_DROP;
}

/* Which of the fast triangles does the pyramid hide? Basic or fast test. */
static void find_hidden(struct hsr_hz_walk *w, const struct hsr_batch *b,
                        int *hidden) {
  const struct hsr_corners *r = &b->corners;
  if (w->choice.polygons != HSR_HZ_POLYGONS_BASIC) {
    hsr_pyramid_hides_triangles(&w->pyramid, b->n_fast, r, hidden);
    return;
  }
  for (int k = 0; k < b->n_fast; k++) {
    hsr_hz_read_for(w, HSR_HZ_FACE_READS, HSR_FACE(r->id[k]));
    hidden[k] =
        hsr_pyramid_basic(&w->pyramid, box_of(r, k), hsr_nearest_corner(r, k));
  }
}

static void count_tested(const struct hsr_hz_walk *w,
                         const struct hsr_corners *r, int k, bool hidden) {
  HSR_STEP(w->tally, HSR_HZ_FACES_TESTED, HSR_FACE(r->id[k]), HSR_THE_WINDOW,
           window_of(box_of(r, k)), !hidden);
  if (hidden)
    HSR_STEP(w->tally, HSR_HZ_FACES_CULLED, HSR_FACE(r->id[k]), HSR_THE_WINDOW,
             window_of(box_of(r, k)), 0);
}

/* Of a batch's fast triangles, leaves out those met before and those that the
 * pyramid hides. */
static void leave_out_hidden(struct hsr_hz_walk *w, struct hsr_batch *b) {
  int drop[HSR_BATCH];
  for (int k = 0; k < b->n_fast; k++)
    drop[k] = meet_again(w, b->first + (uint32_t)b->place[k]);
  hsr_tiler_drop(b, drop);
  if (!uses_pyramid(w) || w->choice.polygons == HSR_HZ_POLYGONS_NONE)
    return;
  hsr_hz_read_for(w, HSR_HZ_FACE_READS, HSR_NOTHING);
  find_hidden(w, b, drop);
  for (int k = 0; HSR_COUNTING && k < b->n_fast; k++)
    count_tested(w, &b->corners, k, drop[k]);
  hsr_tiler_drop(b, drop);
}

void hsr_hz_refresh(struct hsr_hz_walk *w) {
  if (w->stale.x0 < w->stale.x1)
    hsr_pyramid_update(&w->pyramid, w->stale);
  w->stale = (struct hsr_bounds){0, 0, 0, 0};
}

static long area_of_box(const struct hsr_bounds *b) {
  return (long)(b->x1 - b->x0) * (b->y1 - b->y0);
}

static int lesser(int a, int b) {
  return a < b ? a : b;
}
static int greater(int a, int b) {
  return a > b ? a : b;
}

/* Something was tiled in a box, so the pyramid above it is not up to date. To
 * save updates, boxes are gathered in one box around them, as long as that has
 * no more samples than they have. Otherwise the pyramid is updated for those
 * gathered so far. */
static void make_stale(struct hsr_hz_walk *w, struct hsr_bounds box) {
  const struct hsr_bounds *s = &w->stale;
  struct hsr_bounds both = {lesser(s->x0, box.x0), lesser(s->y0, box.y0),
                            greater(s->x1, box.x1), greater(s->y1, box.y1)};
  if (area_of_box(&both) > area_of_box(s) + area_of_box(&box)) {
    hsr_hz_refresh(w);
    both = box;
  }
  w->stale = both;
}

void hsr_hz_tile_face(struct hsr_hz_walk *w, struct hsr_tiler *t, uint32_t f) {
  HSR_STEP(w->tally, HSR_HZ_FACES_TILED, HSR_FACE(id_of(t, f)), HSR_THE_WINDOW,
           window_of(t->screen.bounds[f]), 0);
  hsr_tiler_tile_generally(t, f);
  if (uses_pyramid(w))
    make_stale(w, t->screen.bounds[f]);
}

/* Tiles face f of the current cell the general way, if it has a sample. */
static void tile_generally(struct hsr_hz_walk *w, uint32_t f) {
  if (hsr_tiler_place(&w->frame.tiler, f))
    hsr_hz_tile_face(w, &w->frame.tiler, f);
}

/* polygons=definitive: tests the triangles that the fast test has left. */
static void leave_out_definitively(struct hsr_hz_walk *w, struct hsr_batch *b) {
  for (int k = 0; k < b->n_fast; k++) {
    struct hsr_triangle triangle = hsr_tiler_take(&w->frame.tiler, b, k);
    struct hsr_subject face = HSR_FACE(b->corners.id[k]);
    hsr_hz_read_for(w, HSR_HZ_FACE_READS, face);
    if (b->good[k] &&
        hsr_pyramid_hides_triangle(&w->pyramid, &w->frame.tiler, &triangle)) {
      HSR_STEP(w->tally, HSR_HZ_FACES_CULLED, face, HSR_THE_WINDOW,
               window_of(box_of(&b->corners, k)), 0);
      b->good[k] = 0;
    }
  }
}

/* pyramid=dual: tiles, without comparing depths, each triangle all of which is
 * nearer than the nearest depth of the entry around its box. */
static void tile_before_all(struct hsr_hz_walk *w, struct hsr_batch *b) {
  const struct hsr_corners *r = &b->corners;
  for (int k = 0; k < b->n_fast; k++) {
    struct hsr_bounds box = box_of(r, k);
    struct hsr_subject face = HSR_FACE(r->id[k]);
    hsr_hz_read_for(w, HSR_HZ_FACE_READS, face);
    float q = r->qa[k] < r->qb[k] ? r->qa[k] : r->qb[k];
    q = r->qc[k] < q ? r->qc[k] : q;
    if (!b->good[k] || !hsr_pyramid_before(&w->pyramid, box, q))
      continue;
    struct hsr_triangle triangle = hsr_tiler_take(&w->frame.tiler, b, k);
    hsr_tiler_tile_before(&w->frame.tiler, &triangle);
    hsr_pyramid_update(&w->pyramid, box);
    HSR_STEP(w->tally, HSR_HZ_FACES_TILED, face, HSR_THE_WINDOW, window_of(box),
             0);
    HSR_STEP(w->tally, HSR_HZ_FACES_BEFORE, face, HSR_THE_WINDOW,
             window_of(box), 0);
    b->good[k] = 0;
  }
}

/* Tiles what is left of a batch: fast triangles together, then the others. */
static void tile_batch(struct hsr_hz_walk *w, struct hsr_batch *b) {
  const struct hsr_corners *r = &b->corners;
  bool tests = uses_pyramid(w);
  if (tests && w->choice.polygons == HSR_HZ_POLYGONS_DEFINITIVE)
    leave_out_definitively(w, b);
  if (tests && w->choice.pyramid == HSR_HZ_PYRAMID_DUAL)
    tile_before_all(w, b);
  hsr_tiler_tile_batch(&w->frame.tiler, b);
  for (int k = 0; k < b->n_fast; k++) {
    if (!b->good[k])
      continue;
    HSR_STEP(w->tally, HSR_HZ_FACES_TILED, HSR_FACE(r->id[k]), HSR_THE_WINDOW,
             window_of(box_of(r, k)), 0);
    if (tests)
      make_stale(w, box_of(r, k));
  }
  for (int k = 0; k < b->n && b->general; k++)
    if (b->fate[k] == HSR_GENERALLY)
      tile_generally(w, b->first + (uint32_t)k);
  hsr_hz_refresh(w);
}

void hsr_hz_tile_cell(struct hsr_hz_walk *w, uint32_t k) {
  if (!w->frame.object->cell[k].n_faces)
    return;
  const struct hsr_cell *cell = hsr_cube_cell(&w->frame, k);
  struct hsr_tiler *t = &w->frame.tiler;
  uint32_t n = t->on_grid ? cell->n_triangles : 0;
  struct hsr_batch batch;
  struct hsr_subject cube = hsr_cube_subject(w->frame.instance, k);
  for (uint32_t f = 0; HSR_COUNTING && f < cell->n_faces; f++)
    HSR_STEP(w->tally, HSR_HZ_FACES_MET, HSR_FACE(id_of(t, f)), cube,
             HSR_NOWHERE, 0);
  for (uint32_t f = 0; f < n; f += HSR_BATCH) {
    hsr_tiler_look(t, &batch, f, n - f < HSR_BATCH ? (int)(n - f) : HSR_BATCH);
    drop_repeated(w, &batch);
    leave_out_hidden(w, &batch);
    hsr_tiler_set_up(t, &batch);
    tile_batch(w, &batch);
  }
  for (uint32_t f = n; f < cell->n_faces; f++)
    if (!meet_again(w, f))
      tile_generally(w, f);
  hsr_hz_refresh(w);
}
