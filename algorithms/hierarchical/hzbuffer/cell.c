/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The polygons of a cube, by batches: tested, then tiled. See walk.h.
 *
 * A batch is of triangles, or of convex faces as fans of them (cube_frame.h).
 * The tiler sorts its triangles into the fast ones, which it tiles together, and
 * the others, whose faces go the general way, one by one (tiler.h). So do faces
 * that are not convex. Each face is tested by the pyramid once, by the box of
 * its samples and its nearest corner, before its plane is asked for.
 *
 * Notation    Run: the fast triangles of one face, from the k-th of a batch up
 *             to `end`. */
#include "algorithms/hierarchical/hzbuffer/walk.h"
#include "common/base/numbers.h"

/* Can a face be tested? In the first pass of coherence none is. */
static bool can_test(const struct hsr_hz_walk *w) {
  return hsr_hz_can_hide(w) && !w->plain;
}

static bool is_masked(const struct hsr_hz_walk *w) {
  return w->choice.pyramid == HSR_HZ_PYRAMID_MASKED;
}

static bool has_maps(const struct hsr_hz_walk *w) {
  return w->choice.pyramid == HSR_HZ_PYRAMID_MAPS;
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

/* A run as one corner set: its box, and its nearest depth. */
static void put_run(const struct hsr_corners *r, int k, int end,
                    struct hsr_corners *runs, int to) {
  struct hsr_bounds box = box_of(r, k);
  float nearest = hsr_nearest_corner(r, k);
  runs->id[to] = r->id[k];
  for (k++; k < end; k++) {
    float q = hsr_nearest_corner(r, k);
    nearest = q > nearest ? q : nearest;
    box.x0 = hsr_min_int(box.x0, r->x0[k]);
    box.y0 = hsr_min_int(box.y0, r->y0[k]);
    box.x1 = hsr_max_int(box.x1, r->x1[k]);
    box.y1 = hsr_max_int(box.y1, r->y1[k]);
  }
  runs->x0[to] = box.x0;
  runs->y0[to] = box.y0;
  runs->x1[to] = box.x1;
  runs->y1[to] = box.y1;
  runs->qa[to] = runs->qb[to] = runs->qc[to] = nearest;
}

static void count_tested(const struct hsr_hz_walk *w, uint32_t id,
                         struct hsr_bounds box, bool hidden) {
  HSR_STEP(w->tally, HSR_HZ_FACES_TESTED, HSR_FACE(id), HSR_THE_WINDOW,
           window_of(box), !hidden);
  if (hidden)
    HSR_STEP(w->tally, HSR_HZ_FACES_CULLED, HSR_FACE(id), HSR_THE_WINDOW,
             window_of(box), 0);
}

/* Is a face hidden, by its box and its nearest corner? The pyramid has a basic
 * test, too. */
static bool is_hidden(struct hsr_hz_walk *w, struct hsr_bounds box, float q,
                      uint32_t id) {
  hsr_hz_read_for(w, HSR_HZ_FACE_READS, HSR_FACE(id));
  return w->choice.polygons == HSR_HZ_POLYGONS_BASIC && hsr_hz_has_pyramid(w)
             ? hsr_pyramid_basic(&w->pyramid, box, q)
             : hsr_hz_hides(w, box, q);
}

/* Which of n faces are hidden? The pyramid's fast test takes them together. */
static void find_hidden(struct hsr_hz_walk *w, int n,
                        const struct hsr_corners *r, int *hidden) {
  bool together =
      w->choice.polygons != HSR_HZ_POLYGONS_BASIC && hsr_hz_has_pyramid(w);
  hsr_hz_read_for(w, HSR_HZ_FACE_READS, HSR_NOTHING);
  if (together)
    hsr_pyramid_hides_triangles(&w->pyramid, n, r, hidden);
  for (int k = 0; k < n && !together; k++)
    hidden[k] = is_hidden(w, box_of(r, k), hsr_nearest_corner(r, k), r->id[k]);
  for (int k = 0; HSR_COUNTING && k < n; k++)
    count_tested(w, r->id[k], box_of(r, k), hidden[k]);
}

/* Of a batch's triangles, which are faces, leaves out those that the pyramid
 * hides. */
static void leave_out_triangles(struct hsr_hz_walk *w, struct hsr_batch *b) {
  int drop[HSR_BATCH];
  find_hidden(w, b->n_fast, &b->corners, drop);
  hsr_tiler_drop(b, drop);
}

/* The same of fans. */
static void leave_out_fans(struct hsr_hz_walk *w, struct hsr_batch *b) {
  struct hsr_corners runs;
  int drop[HSR_BATCH], hidden[HSR_BATCH], n = 0;
  for (int k = 0, end; k < b->n_fast; k = end) {
    end = hsr_cube_fan_end(b, k);
    put_run(&b->corners, k, end, &runs, n++);
  }
  find_hidden(w, n, &runs, hidden);
  n = 0;
  for (int k = 0, end; k < b->n_fast; k = end, n++) {
    end = hsr_cube_fan_end(b, k);
    for (int l = k; l < end; l++)
      drop[l] = hidden[n];
  }
  hsr_tiler_drop(b, drop);
}

/* Of a batch, leaves out the faces that have been met before. */
static void leave_out_repeated(struct hsr_hz_walk *w, struct hsr_batch *b) {
  const struct hsr_tiler *t = &w->frame.tiler;
  int drop[HSR_BATCH];
  for (int k = 0; k < b->n && b->general; k++)
    if (b->fate[k] == HSR_GENERALLY && meet_again(w, hsr_tiler_face(t, b, k)))
      b->fate[k] = HSR_DROP;
  for (int k = 0, end; k < b->n_fast; k = end) {
    end = hsr_cube_fan_end(b, k);
    drop[k] = meet_again(w, hsr_tiler_face(t, b, b->place[k]));
    for (int l = k + 1; l < end; l++)
      drop[l] = drop[k];
  }
  hsr_tiler_drop(b, drop);
}

static bool tests_faces(const struct hsr_hz_walk *w) {
  return can_test(w) && w->choice.polygons != HSR_HZ_POLYGONS_NONE;
}

/* Has face f of the current cell, which goes the general way, no sample, or does
 * the pyramid hide it? */
static bool is_out(struct hsr_hz_walk *w, uint32_t f) {
  const struct hsr_tiler *t = &w->frame.tiler;
  struct hsr_bounds box;
  float q, farthest;
  if (!hsr_tiler_bound(t, f, &box, &q, &farthest))
    return false;
  if (box.x0 >= box.x1 || box.y0 >= box.y1)
    return true;
  if (!tests_faces(w))
    return false;
  bool hidden = is_hidden(w, box, q, id_of(t, f));
  count_tested(w, id_of(t, f), box, hidden);
  return hidden;
}

/* Of a batch, leaves out the faces that the pyramid hides. */
static void leave_out_hidden(struct hsr_hz_walk *w, struct hsr_batch *b) {
  const struct hsr_tiler *t = &w->frame.tiler;
  for (int k = 0; k < b->n && b->general; k++)
    if (b->fate[k] == HSR_GENERALLY && is_out(w, hsr_tiler_face(t, b, k)))
      b->fate[k] = HSR_DROP;
  if (!tests_faces(w))
    return;
  if (t->list)
    leave_out_fans(w, b);
  else
    leave_out_triangles(w, b);
}

void hsr_hz_refresh(struct hsr_hz_walk *w) {
  if (has_maps(w) && !w->maps.made && w->occluders >= w->choice.occluders)
    hsr_maps_make(&w->maps, &w->frame.tiler);
  if (w->stale.x0 < w->stale.x1)
    hsr_pyramid_update(&w->pyramid, w->stale);
  w->stale = (struct hsr_bounds){0, 0, 0, 0};
}

static long area_of_box(const struct hsr_bounds *b) {
  return (long)(b->x1 - b->x0) * (b->y1 - b->y0);
}

/* Something was tiled in a box, so the pyramid above it is not up to date. To
 * save updates, boxes are gathered in one box around them, as long as that has
 * no more samples than they have. Otherwise the pyramid is updated for those
 * gathered so far. In the first pass of coherence it is not updated. */
static void make_stale(struct hsr_hz_walk *w, struct hsr_bounds box) {
  if (!hsr_hz_has_pyramid(w) || w->plain)
    return;
  const struct hsr_bounds *s = &w->stale;
  struct hsr_bounds both = {
      hsr_min_int(s->x0, box.x0), hsr_min_int(s->y0, box.y0),
      hsr_max_int(s->x1, box.x1), hsr_max_int(s->y1, box.y1)};
  if (area_of_box(&both) > area_of_box(s) + area_of_box(&box)) {
    hsr_hz_refresh(w);
    both = box;
  }
  w->stale = both;
}

/* Face `id` is tiled. Until the maps are made, it is an occluder. */
static void count_tiled(struct hsr_hz_walk *w, uint32_t id,
                        struct hsr_bounds box) {
  HSR_STEP(w->tally, HSR_HZ_FACES_TILED, HSR_FACE(id), HSR_THE_WINDOW,
           window_of(box), 0);
  if (!has_maps(w) || w->maps.made)
    return;
  w->occluders++;
  HSR_STEP(w->tally, HSR_HZ_OCCLUDERS, HSR_FACE(id), HSR_THE_WINDOW,
           window_of(box), 0);
}

/* Nothing of face f is farther than that. 0: its corners do not tell, or it is
 * not of the current cell. */
static float farthest_of(const struct hsr_hz_walk *w, const struct hsr_tiler *t,
                         uint32_t f) {
  struct hsr_bounds box;
  float nearest, farthest;
  return t == &w->frame.tiler &&
                 hsr_tiler_bound(t, f, &box, &nearest, &farthest)
             ? farthest
             : 0;
}

void hsr_hz_tile_face(struct hsr_hz_walk *w, struct hsr_tiler *t, uint32_t f) {
  struct hsr_bounds box = t->screen.bounds[f];
  count_tiled(w, id_of(t, f), box);
  hsr_tiler_tile_generally(t, f);
  if (is_masked(w))
    hsr_masked_put_shown(&w->masked, t, id_of(t, f), box);
  if (has_maps(w) && !w->maps.made)
    hsr_maps_note(&w->maps, box, farthest_of(w, t, f));
  make_stale(w, box);
}

/* Tiles face f of the current cell the general way, if it has a sample. */
static void tile_generally(struct hsr_hz_walk *w, uint32_t f) {
  if (hsr_tiler_place(&w->frame.tiler, f))
    hsr_hz_tile_face(w, &w->frame.tiler, f);
}

/* polygons=definitive: tests the faces that the fast test has left, by their
 * triangles. */
static void leave_out_definitively(struct hsr_hz_walk *w, struct hsr_batch *b) {
  for (int k = 0, end; k < b->n_fast; k = end) {
    end = hsr_cube_fan_end(b, k);
    struct hsr_subject face = HSR_FACE(b->corners.id[k]);
    hsr_hz_read_for(w, HSR_HZ_FACE_READS, face);
    bool hidden = b->good[k];
    for (int l = k; l < end && hidden; l++) {
      struct hsr_triangle triangle = hsr_tiler_take(&w->frame.tiler, b, l);
      hidden = is_masked(w) ? hsr_masked_hides_triangle(&w->masked, &triangle)
                            : hsr_pyramid_hides_triangle(
                                  &w->pyramid, &w->frame.tiler, &triangle);
    }
    if (!hidden)
      continue;
    HSR_STEP(w->tally, HSR_HZ_FACES_CULLED, face, HSR_THE_WINDOW,
             window_of(box_of(&b->corners, k)), 0);
    for (int l = k; l < end; l++)
      b->good[l] = 0;
  }
}

static float farthest_corner(const struct hsr_corners *r, int k) {
  float q = r->qa[k] < r->qb[k] ? r->qa[k] : r->qb[k];
  return r->qc[k] < q ? r->qc[k] : q;
}

/* Are all triangles of a run nearer than the nearest depth of the entry around
 * their box? */
static bool is_before(struct hsr_hz_walk *w, const struct hsr_corners *r, int k,
                      int end) {
  for (; k < end; k++) {
    if (!hsr_pyramid_before(&w->pyramid, box_of(r, k), farthest_corner(r, k)))
      return false;
  }
  return true;
}

/* pyramid=dual: tiles, without comparing depths, each face all of which is
 * nearer than what is there. */
static void tile_before_all(struct hsr_hz_walk *w, struct hsr_batch *b) {
  const struct hsr_corners *r = &b->corners;
  for (int k = 0, end; k < b->n_fast; k = end) {
    end = hsr_cube_fan_end(b, k);
    struct hsr_subject face = HSR_FACE(r->id[k]);
    hsr_hz_read_for(w, HSR_HZ_FACE_READS, face);
    if (!b->good[k] || !is_before(w, r, k, end))
      continue;
    for (int l = k; l < end; l++) {
      struct hsr_triangle triangle = hsr_tiler_take(&w->frame.tiler, b, l);
      hsr_tiler_tile_before(&w->frame.tiler, &triangle);
      b->good[l] = 0;
    }
    for (int l = k; l < end; l++)
      hsr_pyramid_update(&w->pyramid, box_of(r, l));
    struct hsr_window window = window_of(box_of(r, k));
    HSR_STEP(w->tally, HSR_HZ_FACES_TILED, face, HSR_THE_WINDOW, window, 0);
    HSR_STEP(w->tally, HSR_HZ_FACES_BEFORE, face, HSR_THE_WINDOW, window, 0);
  }
}

/* The fast triangle k has been tiled. Whatever tests what follows hears of it. */
static void note_tiled(struct hsr_hz_walk *w, const struct hsr_batch *b,
                       int k) {
  const struct hsr_corners *r = &b->corners;
  if (is_masked(w)) {
    struct hsr_triangle triangle = hsr_tiler_take(&w->frame.tiler, b, k);
    hsr_masked_put(&w->masked, &triangle, farthest_corner(r, k));
  }
  if (has_maps(w) && !w->maps.made)
    hsr_maps_note(&w->maps, box_of(r, k), farthest_corner(r, k));
  make_stale(w, box_of(r, k));
}

/* Tiles what is left of a batch: fast triangles together, then the others. */
static void tile_batch(struct hsr_hz_walk *w, struct hsr_batch *b) {
  const struct hsr_corners *r = &b->corners;
  bool tests = can_test(w);
  if (tests && w->choice.polygons == HSR_HZ_POLYGONS_DEFINITIVE && !has_maps(w))
    leave_out_definitively(w, b);
  if (tests && w->choice.pyramid == HSR_HZ_PYRAMID_DUAL)
    tile_before_all(w, b);
  hsr_tiler_tile_batch(&w->frame.tiler, b);
  for (int k = 0; k < b->n_fast; k++) {
    if (!b->good[k])
      continue;
    if (!k || r->id[k] != r->id[k - 1])
      count_tiled(w, r->id[k], box_of(r, k));
    note_tiled(w, b, k);
  }
  for (int k = 0; k < b->n && b->general; k++)
    if (b->fate[k] == HSR_GENERALLY)
      tile_generally(w, hsr_tiler_face(&w->frame.tiler, b, k));
  hsr_hz_refresh(w);
}

/* The triangles or fans that the batch's tiler is to look at: tests and tiles
 * them. */
static void do_batch(struct hsr_hz_walk *w, uint32_t first, int n) {
  struct hsr_tiler *t = &w->frame.tiler;
  struct hsr_batch batch;
  hsr_tiler_look(t, &batch, first, n);
  if (t->list)
    hsr_cube_join_looked_at(t, &batch);
  leave_out_repeated(w, &batch);
  leave_out_hidden(w, &batch);
  hsr_tiler_set_up(t, &batch);
  if (t->list)
    hsr_cube_join_set_up(&batch);
  tile_batch(w, &batch);
}

static void do_fans(struct hsr_hz_walk *w, uint32_t f, uint32_t end) {
  struct hsr_cube_fans fans;
  for (int n; f < end;) {
    f = hsr_cube_fans(&w->frame, &fans, f, end, &n);
    do_batch(w, 0, n);
  }
  w->frame.tiler.list = NULL;
}

void hsr_hz_tile_cell(struct hsr_hz_walk *w, uint32_t k) {
  if (!w->frame.object->cell[k].n_faces)
    return;
  const struct hsr_cell *cell = hsr_cube_cell(&w->frame, k);
  struct hsr_tiler *t = &w->frame.tiler;
  uint32_t triangles = t->on_grid ? cell->n_triangles : 0;
  uint32_t fans = t->on_grid ? triangles + cell->n_convex : 0;
  struct hsr_subject cube = hsr_cube_subject(w->frame.instance, k);
  for (uint32_t f = 0; HSR_COUNTING && f < cell->n_faces; f++)
    HSR_STEP(w->tally, HSR_HZ_FACES_MET, HSR_FACE(id_of(t, f)), cube,
             HSR_NOWHERE, 0);
  for (uint32_t f = 0; f < triangles; f += HSR_BATCH)
    do_batch(w, f, hsr_min_int((int)(triangles - f), HSR_BATCH));
  if (triangles < fans)
    do_fans(w, triangles, fans);
  for (uint32_t f = fans; f < cell->n_faces; f++)
    if (!meet_again(w, f)) {
      hsr_hz_refresh(w);
      if (!is_out(w, f))
        tile_generally(w, f);
    }
  hsr_hz_refresh(w);
}
