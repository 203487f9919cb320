/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/brute_force/zbuffer_fast/peel.h"

struct peel {
  struct hsr_glass *glass;
  struct hsr_tiler *tiler;
  struct hsr_tally *tally;
  uint32_t *face, n_faces; /* the transparent ones in the picture */
  uint32_t *next; /* a sample, as tiler->ids, which is behind[] of the header */
};

static size_t place_of(const struct peel *p, int i, int j) {
  const struct hsr_window *w = &p->tiler->window;
  return (size_t)(j - w->y0) * p->tiler->ids_stride + (size_t)(i - w->x0);
}

static bool is_nearer(const struct peel *p, uint32_t f, uint32_t g, int i,
                      int j) {
  HSR_TOUCH(p->tally, i, j);
  return hsr_nearer(&p->tiler->screen, f, g, i, j, p->tally);
}

/* Is f of the layer at a sample, as far as is known? */
static void look(struct peel *p, uint32_t f, int i, int j) {
  uint32_t behind = p->tiler->ids[place_of(p, i, j)];
  uint32_t *next = &p->next[place_of(p, i, j)];
  if (behind == f)
    return;
  if (behind != HSR_BACKGROUND) {
    bool nearer = is_nearer(p, f, behind, i, j);
    HSR_STEP(p->tally, HSR_PEEL_BEHIND, HSR_FACE(f), HSR_FACE(behind),
             HSR_AT(i, j), nearer);
    if (!nearer)
      return;
  }
  if (*next != HSR_BACKGROUND) {
    bool farther = is_nearer(p, *next, f, i, j);
    HSR_STEP(p->tally, HSR_PEEL_FARTHEST, HSR_FACE(f), HSR_FACE(*next),
             HSR_AT(i, j), farther);
    if (!farther)
      return;
  }
  *next = f;
}

static void look_at_face(struct peel *p, uint32_t f) {
  const struct hsr_bounds *b = &p->tiler->screen.bounds[f];
  int *columns = p->tiler->columns;
  struct hsr_face_rows rows;
  hsr_face_rows_begin(&rows, &p->tiler->screen, f, p->tally);
  for (int j = b->y0; j < b->y1; j++) {
    int n = hsr_face_rows_spans(&rows, j, columns, p->tally);
    for (int c = 0; c < n; c += 2) {
      int x0 = columns[c] > b->x0 ? columns[c] : b->x0;
      int x1 = columns[c + 1] < b->x1 ? columns[c + 1] : b->x1;
      for (int i = x0; i < x1; i++)
        look(p, f, i, j);
    }
  }
}

static void show_opaque(struct peel *p) {
  const struct hsr_window *w = &p->tiler->window;
  for (int j = w->y0; j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++) {
      uint32_t f = p->tiler->ids[place_of(p, i, j)];
      if (f != HSR_BACKGROUND)
        hsr_glass_over(p->glass, f, hsr_glass_at(p->glass, i, j));
    }
}

static void show(struct peel *p, uint32_t f, int i, int j) {
  uint16_t *rgb = hsr_glass_at(p->glass, i, j);
  hsr_glass_over(p->glass, f, rgb);
  HSR_ACCEPTED(p->tally, HSR_PEEL_SHOWN, HSR_FACE(f), HSR_THE_WINDOW,
               HSR_AT(i, j), rgb);
  p->tiler->ids[place_of(p, i, j)] = f;
}

/* Puts the layer over what is combined; it is what is behind the next one.
 * False if it is empty. */
static bool show_layer(struct peel *p) {
  const struct hsr_window *w = &p->tiler->window;
  bool any = false;
  for (int j = w->y0; j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++) {
      uint32_t f = p->next[place_of(p, i, j)];
      if (f == HSR_BACKGROUND)
        continue;
      any = true;
      show(p, f, i, j);
    }
  return any;
}

static void find_layer(struct peel *p) {
  const struct hsr_window *w = &p->tiler->window;
  HSR_STEP(p->tally, HSR_PEEL_LAYERS, HSR_THE_WINDOW, HSR_NOTHING, *w, 0);
  for (int j = w->y0; j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++)
      p->next[place_of(p, i, j)] = HSR_BACKGROUND;
  for (uint32_t k = 0; k < p->n_faces; k++)
    look_at_face(p, p->face[k]);
}

static enum hsr_status list_faces(struct peel *p, struct hsr_arena *arena) {
  uint32_t n = p->glass->job->world->n_faces;
  p->face = HSR_NEW(arena, uint32_t, n);
  for (uint32_t f = 0; p->face && f < n; f++)
    if (hsr_is_glass(p->glass, f) && hsr_tiler_place(p->tiler, f))
      p->face[p->n_faces++] = f;
  return p->face ? HSR_OK : HSR_E_NOMEM;
}

enum hsr_status hsr_peel(struct hsr_glass *glass, struct hsr_tiler *tiler) {
  const struct hsr_window *w = &tiler->window;
  struct hsr_arena *arena = glass->job->scratch;
  struct peel p = {.glass = glass, .tiler = tiler, .tally = tiler->tally};
  p.next =
      HSR_NEW(arena, uint32_t, tiler->ids_stride * (size_t)(w->y1 - w->y0));
  if (!p.next || list_faces(&p, arena))
    return HSR_E_NOMEM;
  show_opaque(&p);
  do
    find_layer(&p);
  while (show_layer(&p));
  return HSR_OK;
}

/* --- What it counts ------------------------------------------------------- */

static const struct hsr_counter counters[] = {
    {"layer tests",
     "transparent faces compared in depth with what is "
     "combined at a sample",
     HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE, "farther|nearer"},
    {"farthest tests",
     "transparent faces compared in depth with the "
     "farthest of the layer so far",
     HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE, "nearer|farther"},
    {"layers", "passes over the transparent faces", HSR_ACTIVATE,
     HSR_OF_WINDOW},
    {"combined",
     "colours shown at samples: of opaque faces, and then of "
     "layers over them",
     HSR_ACCEPT, HSR_OF_FACE, HSR_OF_WINDOW},
    {NULL}};

static const struct hsr_line lines[] = {
    {"for each layer of transparent faces", HSR_RAISES(HSR_PEEL_LAYERS)},
    {"  for each of these, at each sample: nearer than what is combined?",
     HSR_RAISES(HSR_PEEL_BEHIND)},
    {"    and farther than what the layer has there so far? Keep it",
     HSR_RAISES(HSR_PEEL_FARTHEST)},
    {"  put the layer over what is combined", HSR_RAISES(HSR_PEEL_SHOWN)},
    {NULL}};

const struct hsr_part hsr_peel_part = {
    HSR_PART_PEEL, counters, NULL, NULL, {lines}};
