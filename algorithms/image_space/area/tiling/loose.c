/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/image_space/area/tiling/loose.h"
#include "common/exact/order.h"

#include <string.h>

/* Is any face of the tree not flat? */
static bool has_any(const struct hsr_bsp *bsp) {
  for (uint32_t f = 0; f < bsp->world->n_faces; f++)
    if (bsp->reach[f] > 0)
      return true;
  return bsp->n_loose > 0;
}

enum hsr_status hsr_loose_begin(struct hsr_loose *l, const struct hsr_bsp *bsp,
                                const struct hsr_view *view,
                                struct hsr_tally *tally,
                                struct hsr_arena *arena) {
  uint32_t n = bsp->world->n_faces;
  *l = (struct hsr_loose){.tally = tally};
  if (!has_any(bsp))
    return HSR_OK;
  l->is_loose = HSR_NEW_ZEROED(arena, bool, n);
  l->has_plane = HSR_NEW_ZEROED(arena, bool, n);
  l->face = HSR_NEW(arena, uint32_t, n);
  if (!l->is_loose || !l->has_plane || !l->face ||
      hsr_screen_init(&l->screen, bsp->world, view, arena))
    return HSR_E_NOMEM;
  for (uint32_t k = 0; k < bsp->n_loose; k++)
    l->is_loose[bsp->loose[k]] = true;
  for (uint32_t f = 0; f < n; f++) {
    l->is_loose[f] |=
        bsp->reach[f] > 0 && hsr_grazes(&l->screen, f, bsp->reach[f]);
    if (l->is_loose[f])
      l->face[l->n++] = f;
  }
  if (l->n)
    hsr_screen_vertices(&l->screen);
  return HSR_OK;
}

enum hsr_status hsr_loose_refuse(const struct hsr_loose *l,
                                 const struct hsr_world *world,
                                 struct hsr_error *err) {
  return hsr_fail(err, HSR_E_REFUSED,
                  "PF: face id %u is not flat, and its place in the order is "
                  "not certain, as a filtered picture needs it",
                  hsr_world_parent(world, l->face[0]));
}

/* Makes sure that the plane of face f is known. */
static void find_plane(struct hsr_loose *l, uint32_t f) {
  if (!l->has_plane[f])
    hsr_screen_plane(&l->screen, f);
  l->has_plane[f] = true;
}

/* The plane of a face, and if it is a piece of another face the planes that
 * cut it. */
static void find_planes(struct hsr_loose *l, uint32_t f) {
  const struct hsr_pieces *pieces = l->screen.world->pieces;
  find_plane(l, f);
  for (uint32_t c = pieces ? pieces->cut_start[f] : 0;
       pieces && c < pieces->cut_start[f + 1]; c++)
    find_plane(l, pieces->cut[c].face);
}

static bool is_nearer(struct hsr_loose *l, uint32_t f, uint32_t g, int i,
                      int j) {
  if (g == HSR_BACKGROUND)
    return true;
  find_plane(l, g);
  bool nearer = hsr_nearer(&l->screen, f, g, i, j, l->tally);
  HSR_STEP(l->tally, HSR_LOOSE_COMPARED, HSR_FACE(f), HSR_FACE(g), HSR_AT(i, j),
           nearer);
  return nearer;
}

void hsr_loose_draw(struct hsr_loose *l, uint32_t *ids, size_t stride) {
  for (uint32_t k = 0; k < l->n; k++) {
    uint32_t f = l->face[k];
    find_planes(l, f);
    if (!hsr_screen_place(&l->screen, f, l->tally))
      continue;
    const struct hsr_bounds *b = &l->screen.bounds[f];
    for (int j = b->y0; j < b->y1; j++)
      for (int i = b->x0; i < b->x1; i++) {
        uint32_t *id = &ids[(size_t)j * stride + (size_t)i];
        if (*id != f && hsr_covers(&l->screen, f, i, j, l->tally) &&
            is_nearer(l, f, *id, i, j)) {
          HSR_STEP(l->tally, HSR_LOOSE_SHOWN, HSR_FACE(f), HSR_THE_WINDOW,
                   HSR_AT(i, j), 0);
          *id = f;
        }
      }
  }
}

/* --- What it counts ------------------------------------------------------- */

static const struct hsr_counter counters[] = {
    {"thickness checks",
     "comparisons in depth with faces that are not flat and have "
     "no place in the trees",
     HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE, "farther|nearer"},
    {"loose samples", "where such a face is the nearest so far: written",
     HSR_ACCEPT, HSR_OF_FACE, HSR_OF_WINDOW},
    {NULL}};

static const struct hsr_line lines[] = {
    {"for each face that is not flat and has no place in the trees"},
    {"  at each sample: is it nearer than the face there?",
     HSR_RAISES(HSR_LOOSE_COMPARED)},
    {"    display it", HSR_RAISES(HSR_LOOSE_SHOWN)},
    {NULL}};

const struct hsr_part hsr_loose_part = {
    HSR_PART_LOOSE, counters, NULL, NULL, {lines}};
