/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The bounds of q in a cell (depth_in); u = 2^-53. On the plane of a face q is
 * affine. At the samples of a square it differs from its value in the middle by
 * at most |a| half + |b| half, half being half the square's side. The computed
 * a sx + b sy + c is within the plane's error of q (common/exact/screen.h). The
 * computed middle and reach are off by roundings, at most five, each u times
 * the sizes of the terms; 8 u times these are added. If a face is safely before
 * the eye, its q is also between the extremes at its vertices. Nothing is seen
 * behind the eye, so q = 1/t is not negative. */
#include "algorithms/image_space/area/tiling/lazy_pyramid.h"
#include "common/base/numbers.h"
#include "common/base/bits.h"

#include <float.h>

static const uint64_t ALL = UINT64_MAX;
static const double U = DBL_EPSILON / 2;

/* --- Depth ---------------------------------------------------------------- */

static const struct hsr_lazy_depth NOTHING = {INFINITY, -INFINITY};

/* The q of what is infinitely far. */
static double farthest(const struct hsr_view *view) {
  return view->parallel ? -INFINITY : 0;
}

static void include(struct hsr_lazy_depth *depth, struct hsr_lazy_depth more) {
  depth->far = hsr_min(depth->far, more.far);
  depth->near = hsr_max(depth->near, more.near);
}

static bool is_behind(struct hsr_lazy_depth a, struct hsr_lazy_depth b) {
  return a.near < b.far;
}

/* Bounds of q over all that is seen of a face. */
static struct hsr_lazy_depth depth_at_vertices(const struct hsr_screen *s,
                                               uint32_t f) {
  const struct hsr_world *world = s->world;
  struct hsr_lazy_depth depth = NOTHING;
  double error = hsr_vertex_error(s, f);
  for (uint32_t k = world->mesh.start[f]; k < world->mesh.start[f + 1]; k++) {
    double q = hsr_vertex_depth(s, f, world->mesh.vertex[k]);
    if (!(q - error < INFINITY)) /* not safely before the eye */
      return (struct hsr_lazy_depth){farthest(s->view), INFINITY};
    include(&depth, (struct hsr_lazy_depth){q - error, q + error});
  }
  depth.far = hsr_max(depth.far, farthest(s->view));
  return depth;
}

void hsr_lazy_face(struct hsr_lazy_pyramid *p, uint32_t f) {
  if (p->known[f])
    return;
  p->known[f] = true;
  hsr_screen_plane(&p->screen, f);
  p->depth[f] = depth_at_vertices(&p->screen, f);
}

/* A pixel as the subject of a step; and its samples in the window. */
static struct hsr_subject subject_of(const struct hsr_lazy_pyramid *p,
                                     const struct hsr_mask_cell *cell) {
  const struct hsr_window *w = &p->masks->window;
  return HSR_CELL(cell->level, (cell->x - w->x0) / cell->size,
                  (cell->y - w->y0) / cell->size);
}

static struct hsr_window samples_in(const struct hsr_lazy_pyramid *p,
                                    const struct hsr_mask_cell *cell) {
  const struct hsr_window *w = &p->masks->window;
  int x1 = cell->x + cell->size, y1 = cell->y + cell->size;
  return hsr_window_make(cell->x, cell->y, x1 < w->x1 ? x1 : w->x1,
                         y1 < w->y1 ? y1 : w->y1);
}

/* Bounds of q of face f in a cell: see the head. */
static struct hsr_lazy_depth depth_in(const struct hsr_lazy_pyramid *p,
                                      uint32_t f,
                                      const struct hsr_mask_cell *cell) {
  const struct hsr_depth_plane *plane = &p->screen.plane[f];
  struct hsr_lazy_depth depth = p->depth[f];
  double half = 0.5 * cell->size, x = cell->x + half, y = cell->y + half;
  double a = fabs(plane->a), b = fabs(plane->b);
  double middle = plane->a * x + plane->b * y + plane->c;
  double reach = (a + b) * half;
  reach += plane->error + 8 * U * (a * x + b * y + fabs(plane->c) + reach);
  depth.far = hsr_max(depth.far, middle - reach);
  depth.near = hsr_min(depth.near, middle + reach);
  return depth;
}

/* Is the face that is being tiled nearer than face g at sample `bit` of a
 * pixel? Both cover the sample. */
static bool is_nearer(struct hsr_lazy_pyramid *p, uint32_t g,
                      const struct hsr_mask_cell *cell, int bit) {
  const struct hsr_mask_places *places =
      &p->masks->places[hsr_masks_pattern(p->masks, cell)];
  bool nearer = hsr_nearer_at(&p->screen, p->face, g, cell->x + places->x[bit],
                              cell->y + places->y[bit], p->tally);
  HSR_STEP(p->tally, HSR_LAZY_COMPARED, HSR_FACE(p->face), HSR_FACE(g),
           HSR_AT(cell->x + bit % 8, cell->y + bit / 8), nearer);
  return nearer;
}

/* --- Fragments ------------------------------------------------------------ */

static struct hsr_lazy_fragment *fragment(const struct hsr_lazy_pyramid *p,
                                          uint32_t index) {
  return (struct hsr_lazy_fragment *)p->fragment.items + (index - 1);
}

static struct hsr_lazy_samples *samples_of(const struct hsr_lazy_pyramid *p,
                                           const struct hsr_lazy_pixel *pixel) {
  return (struct hsr_lazy_samples *)p->samples.items + (pixel->samples - 1);
}

/* Leaves a pixel's fragments to be reused. */
static void discard_fragments(struct hsr_lazy_pyramid *p,
                              struct hsr_lazy_pixel *pixel) {
  if (!pixel->fragments)
    return;
  struct hsr_lazy_fragment *last = fragment(p, pixel->fragments);
  while (last->next)
    last = fragment(p, last->next);
  last->next = p->vacant_fragment;
  p->vacant_fragment = pixel->fragments;
  pixel->fragments = 0;
}

static void cache_fragment(struct hsr_lazy_pyramid *p,
                           const struct hsr_mask_cell *cell, uint32_t face,
                           uint64_t mask) {
  struct hsr_lazy_pixel *pixel = &p->pixel[cell->number];
  uint32_t index = p->vacant_fragment;
  HSR_STEP(p->tally, HSR_LAZY_FRAGMENTS, HSR_FACE(face), subject_of(p, cell),
           samples_in(p, cell), 0);
  if (!index) {
    if (p->fragment.n == UINT32_MAX ||
        !hsr_arena_grow(p->arena, &p->fragment,
                        sizeof(struct hsr_lazy_fragment))) {
      p->out_of_memory = true;
      return;
    }
    index = (uint32_t)p->fragment.n;
    fragment(p, index)->next = 0;
  }
  p->vacant_fragment = fragment(p, index)->next;
  *fragment(p, index) =
      (struct hsr_lazy_fragment){mask, face, pixel->fragments};
  pixel->fragments = index;
}

/* --- Pixels --------------------------------------------------------------- */

/* Makes a pixel vacant. Samples outside of the window count as covered. */
static void clear_pixel(struct hsr_lazy_pyramid *p,
                        const struct hsr_mask_cell *cell) {
  struct hsr_lazy_pixel *pixel = &p->pixel[cell->number];
  discard_fragments(p, pixel);
  pixel->depth = NOTHING;
  pixel->z_buffered = false;
  p->masks->finest[cell->number] = ~hsr_masks_in_window(p->masks, cell);
}

/* Tiles a fragment of a face, which covers the samples of the mask, into a
 * pixel. */
static void tile_pixel(struct hsr_lazy_pyramid *p,
                       const struct hsr_mask_cell *cell, uint32_t face,
                       uint64_t mask) {
  struct hsr_lazy_pixel *pixel = &p->pixel[cell->number];
  cache_fragment(p, cell, face, mask);
  p->masks->finest[cell->number] |= mask;
  include(&pixel->depth, depth_in(p, face, cell));
}

/* Is the face that is being tiled behind the pixel's fragments, at all samples
 * of the mask that they cover? */
static bool is_behind_fragments(struct hsr_lazy_pyramid *p,
                                const struct hsr_mask_cell *cell,
                                uint64_t mask) {
  uint32_t index = p->pixel[cell->number].fragments;
  for (; index; index = fragment(p, index)->next) {
    uint32_t face = fragment(p, index)->face;
    uint64_t shared = mask & fragment(p, index)->mask;
    for (; shared; shared &= shared - 1)
      if (is_nearer(p, face, cell, hsr_first_bit(shared)))
        return false;
  }
  return true;
}

/* Changes a pixel from tiling to ordinary z-buffering, by its fragments. */
static void demote(struct hsr_lazy_pyramid *p,
                   const struct hsr_mask_cell *cell) {
  struct hsr_lazy_pixel *pixel = &p->pixel[cell->number];
  HSR_STEP(p->tally, HSR_LAZY_DEMOTED, subject_of(p, cell), HSR_FACE(p->face),
           samples_in(p, cell), 0);
  if (!pixel->samples) {
    if (!hsr_arena_grow(p->arena, &p->samples,
                        sizeof(struct hsr_lazy_samples))) {
      p->out_of_memory = true;
      return;
    }
    pixel->samples = (uint32_t)p->samples.n;
  }
  uint32_t *face = samples_of(p, pixel)->face;
  for (int bit = 0; bit < 64; bit++)
    face[bit] = HSR_BACKGROUND;
  for (uint32_t k = pixel->fragments; k; k = fragment(p, k)->next)
    for (uint64_t mask = fragment(p, k)->mask; mask; mask &= mask - 1)
      face[hsr_first_bit(mask)] = fragment(p, k)->face;
  discard_fragments(p, pixel);
  pixel->z_buffered = true;
}

/* The samples of the mask that show the same face as its first sample. */
static uint64_t same_face(const uint32_t face[64], uint64_t mask) {
  uint32_t wanted = face[hsr_first_bit(mask)];
  uint64_t same = 0;
  for (int bit = 0; bit < 64; bit++)
    same |= (uint64_t)(face[bit] == wanted) << bit;
  return same & mask;
}

/* Tiles the face, which covers the samples of the mask, into a z-buffered
 * pixel. */
static void z_buffer(struct hsr_lazy_pyramid *p,
                     const struct hsr_mask_cell *cell, uint64_t mask) {
  struct hsr_lazy_pixel *pixel = &p->pixel[cell->number];
  uint32_t *face = samples_of(p, pixel)->face;
  uint64_t *covered = &p->masks->finest[cell->number];
  uint64_t in_window = hsr_masks_in_window(p->masks, cell);
  for (uint64_t ask = mask & *covered; ask; ask &= ask - 1) {
    int bit = hsr_first_bit(ask);
    if (is_nearer(p, face[bit], cell, bit))
      face[bit] = p->face;
  }
  for (uint64_t put = mask & ~*covered; put; put &= put - 1)
    face[hsr_first_bit(put)] = p->face;
  *covered |= mask;
  pixel->depth = NOTHING;
  for (uint64_t rest = *covered & in_window, same; rest; rest &= ~same) {
    same = same_face(face, rest);
    include(&pixel->depth, depth_in(p, face[hsr_first_bit(rest)], cell));
  }
}

/* --- Cells ---------------------------------------------------------------- */

static bool is_finest(const struct hsr_lazy_pyramid *p,
                      const struct hsr_mask_cell *cell) {
  return cell->level == p->masks->n_levels - 1;
}

/* Makes a cell vacant. */
static void clear(struct hsr_lazy_pyramid *p,
                  const struct hsr_mask_cell *cell) {
  uint64_t vacant = hsr_masks_in_window(p->masks, cell);
  if (is_finest(p, cell)) {
    clear_pixel(p, cell);
    return;
  }
  p->masks->coarse[cell->level][cell->number] =
      (struct hsr_triage){~vacant, vacant};
  p->cell[cell->level][cell->number] = (struct hsr_lazy_cell){.depth = NOTHING};
}

/* A face covers a cell and hides all that was there: the cell shows it
 * alone. */
static void make_whole(struct hsr_lazy_pyramid *p,
                       const struct hsr_mask_cell *cell, uint32_t face) {
  uint64_t all = hsr_masks_in_window(p->masks, cell);
  if (is_finest(p, cell)) {
    clear_pixel(p, cell);
    tile_pixel(p, cell, face, all);
    return;
  }
  p->masks->coarse[cell->level][cell->number] = (struct hsr_triage){ALL, 0};
  p->cell[cell->level][cell->number] =
      (struct hsr_lazy_cell){depth_in(p, face, cell), all, face};
}

/* The depth of a subcell that is not vacant. */
static struct hsr_lazy_depth depth_of(const struct hsr_lazy_pyramid *p,
                                      const struct hsr_lazy_cell *parent,
                                      const struct hsr_mask_cell *sub) {
  if (parent->whole >> (sub->number & 63) & 1)
    return depth_in(p, parent->face, sub);
  return is_finest(p, sub) ? p->pixel[sub->number].depth
                           : p->cell[sub->level][sub->number].depth;
}

/* Makes a subcell ready to be entered: if it is vacant or whole, what is kept
 * of it is stale, and is made anew. */
static void open(struct hsr_lazy_pyramid *p, const struct hsr_triage *mask,
                 struct hsr_lazy_cell *parent,
                 const struct hsr_mask_cell *sub) {
  uint64_t bit = (uint64_t)1 << (sub->number & 63);
  if (mask->v & bit)
    clear(p, sub);
  else if (parent->whole & bit) {
    make_whole(p, sub, parent->face);
    parent->whole &= ~bit;
  }
}

/* Finds the depth bounds of a cell from those of its subcells. */
static void find_depth(const struct hsr_lazy_pyramid *p,
                       const struct hsr_mask_cell *cell) {
  const struct hsr_triage *mask = &p->masks->coarse[cell->level][cell->number];
  struct hsr_lazy_cell *own = &p->cell[cell->level][cell->number];
  uint64_t some = hsr_masks_in_window(p->masks, cell) & ~mask->v & ~own->whole;
  own->depth = own->whole ? depth_in(p, own->face, cell) : NOTHING;
  for (; some; some &= some - 1) {
    struct hsr_mask_cell sub = hsr_masks_subcell(cell, hsr_first_bit(some));
    include(&own->depth, depth_of(p, own, &sub));
  }
}

/* --- How a frame begins --------------------------------------------------- */

enum hsr_status
hsr_lazy_begin(struct hsr_lazy_pyramid *p, struct hsr_masks *masks,
               const struct hsr_world *world, const struct hsr_view *view,
               struct hsr_tally *tally, struct hsr_arena *arena) {
  int finest = masks->n_levels - 1;
  *p =
      (struct hsr_lazy_pyramid){.masks = masks, .arena = arena, .tally = tally};
  for (int level = 0; level < finest; level++) {
    p->cell[level] = HSR_NEW_ZEROED(arena, struct hsr_lazy_cell,
                                    hsr_masks_cells(masks, level));
    if (!p->cell[level])
      return HSR_E_NOMEM;
  }
  p->pixel = HSR_NEW_ZEROED(arena, struct hsr_lazy_pixel,
                            hsr_masks_cells(masks, finest));
  p->depth = HSR_NEW(arena, struct hsr_lazy_depth, world->n_faces);
  p->known = HSR_NEW_ZEROED(arena, bool, world->n_faces);
  if (!p->pixel || !p->depth || !p->known ||
      hsr_screen_init(&p->screen, world, view, arena))
    return HSR_E_NOMEM;
  hsr_screen_vertices(&p->screen);
  struct hsr_mask_cell root = hsr_masks_root(masks);
  clear(p, &root);
  return HSR_OK;
}

/* --- Tiling --------------------------------------------------------------- */

/* Returns the samples of a pixel to ask about: if the polygon is behind all
 * that is there, those that are not covered, otherwise all in the window. */
static uint64_t enter_pixel(struct hsr_lazy_pyramid *p,
                            const struct hsr_mask_cell *cell) {
  p->own = depth_in(p, p->face, cell);
  if (is_behind(p->own, p->pixel[cell->number].depth))
    return ~p->masks->finest[cell->number];
  return hsr_masks_in_window(p->masks, cell);
}

/* The polygon comes to a cell: leaves out the subcells where it is hidden,
 * makes whole those that it covers and hides, and returns the others, to be
 * entered. */
static uint64_t enter(void *context, const struct hsr_mask_cell *cell,
                      struct hsr_triage polygon) {
  struct hsr_lazy_pyramid *p = context;
  if (is_finest(p, cell))
    return enter_pixel(p, cell);
  struct hsr_triage *mask = &p->masks->coarse[cell->level][cell->number];
  struct hsr_lazy_cell *own = &p->cell[cell->level][cell->number];
  uint64_t entered = 0;
  uint64_t ask = hsr_masks_in_window(p->masks, cell) & ~polygon.v;
  p->changed[cell->level] = false;
  for (; ask; ask &= ask - 1) {
    uint64_t bit = ask & (~ask + 1);
    struct hsr_mask_cell sub = hsr_masks_subcell(cell, hsr_first_bit(ask));
    bool hides = polygon.c & bit;
    if (!(mask->v & bit)) {
      struct hsr_lazy_depth here = depth_in(p, p->face, &sub);
      struct hsr_lazy_depth there = depth_of(p, own, &sub);
      if (mask->c & bit && is_behind(here, there))
        continue;
      hides = hides && is_behind(there, here);
    }
    if (hides) {
      make_whole(p, &sub, p->face);
      mask->c |= bit;
      mask->v &= ~bit;
      own->whole &= ~bit;
      p->changed[cell->level] = true;
    } else {
      open(p, mask, own, &sub);
      entered |= bit;
    }
  }
  return entered;
}

/* The polygon covers these samples of a pixel: tiles it if that is legal,
 * otherwise z-buffers it. */
static void take_samples(void *context, const struct hsr_mask_cell *cell,
                         uint64_t mask) {
  struct hsr_lazy_pyramid *p = context;
  struct hsr_lazy_pixel *pixel = &p->pixel[cell->number];
  uint64_t covered = p->masks->finest[cell->number];
  uint64_t all = hsr_masks_in_window(p->masks, cell);
  if (mask == all && is_behind(pixel->depth, p->own))
    make_whole(p, cell, p->face);
  else if (!pixel->z_buffered && is_behind_fragments(p, cell, mask & covered)) {
    if (!(mask & ~covered))
      return;
    tile_pixel(p, cell, p->face, mask & ~covered);
  } else {
    if (!pixel->z_buffered)
      demote(p, cell);
    if (pixel->z_buffered)
      z_buffer(p, cell, mask);
  }
  if (cell->level)
    p->changed[cell->level - 1] = true;
}

/* The polygon leaves a cell: propagates what changed below to its masks and
 * depth bounds. */
static void leave(void *context, const struct hsr_mask_cell *cell,
                  uint64_t entered) {
  struct hsr_lazy_pyramid *p = context;
  struct hsr_triage *mask = &p->masks->coarse[cell->level][cell->number];
  if (!p->changed[cell->level])
    return;
  for (; entered; entered &= entered - 1) {
    uint64_t bit = entered & (~entered + 1), covered;
    struct hsr_mask_cell sub = hsr_masks_subcell(cell, hsr_first_bit(entered));
    uint64_t in = hsr_masks_in_window(p->masks, &sub);
    bool vacant;
    if (is_finest(p, &sub)) {
      covered = p->masks->finest[sub.number];
      vacant = !(covered & in);
    } else {
      covered = p->masks->coarse[sub.level][sub.number].c;
      vacant = p->masks->coarse[sub.level][sub.number].v == in;
    }
    if (covered == ALL)
      mask->c |= bit;
    if (!vacant)
      mask->v &= ~bit;
  }
  find_depth(p, cell);
  if (cell->level)
    p->changed[cell->level - 1] = true;
}

bool hsr_lazy_tile(struct hsr_lazy_pyramid *p, uint32_t face,
                   const struct hsr_mask_polygon *polygon,
                   struct hsr_bounds box) {
  struct hsr_mask_visitor visitor = {enter, take_samples, leave, p};
  hsr_lazy_face(p, face);
  p->face = face;
  return hsr_masks_visit(p->masks, polygon, box, &visitor);
}

/* --- Would anything show? (hsr_lazy_shows) -------------------------------- */

/* The visitor that only looks. It may make subcells ready to be entered, but
 * changes nothing that shows. */

static uint64_t look(void *context, const struct hsr_mask_cell *cell,
                     struct hsr_triage polygon) {
  struct hsr_lazy_pyramid *p = context;
  struct hsr_lazy_depth box = {farthest(p->screen.view), p->nearest};
  uint64_t entered = 0;
  if (p->shows)
    return 0;
  uint64_t ask = hsr_masks_in_window(p->masks, cell) & ~polygon.v;
  if (is_finest(p, cell))
    return is_behind(box, p->pixel[cell->number].depth)
               ? ~p->masks->finest[cell->number]
               : ask;
  struct hsr_triage *mask = &p->masks->coarse[cell->level][cell->number];
  struct hsr_lazy_cell *own = &p->cell[cell->level][cell->number];
  p->shows = ask & polygon.c & mask->v;
  for (; ask && !p->shows; ask &= ask - 1) {
    uint64_t bit = ask & (~ask + 1);
    struct hsr_mask_cell sub = hsr_masks_subcell(cell, hsr_first_bit(ask));
    if (mask->c & bit && is_behind(box, depth_of(p, own, &sub)))
      continue;
    open(p, mask, own, &sub);
    entered |= bit;
  }
  return p->shows ? 0 : entered;
}

static void see_samples(void *context, const struct hsr_mask_cell *cell,
                        uint64_t mask) {
  struct hsr_lazy_pyramid *p = context;
  (void)cell;
  p->shows = p->shows || mask;
}

static void go_on(void *context, const struct hsr_mask_cell *cell,
                  uint64_t entered) {
  (void)context;
  (void)cell;
  (void)entered;
}

bool hsr_lazy_shows(struct hsr_lazy_pyramid *p,
                    const struct hsr_mask_polygon *polygon,
                    struct hsr_bounds box, double nearest) {
  struct hsr_mask_visitor visitor = {look, see_samples, go_on, p};
  p->shows = false;
  p->nearest = nearest;
  hsr_masks_visit(p->masks, polygon, box, &visitor);
  return p->shows;
}

/* --- The picture ---------------------------------------------------------- */

struct resolving {
  struct hsr_lazy_pyramid *pyramid;
  const struct hsr_mask_sink *sink;
  void *context;
  void (*take)(void *context, uint32_t face);
};

/* Tells the sink samples of a pixel that show a face. */
static void tell_samples(const struct resolving *r,
                         const struct hsr_mask_cell *cell, uint32_t face,
                         uint64_t mask) {
  r->take(r->context, face);
  r->sink->samples(r->sink->context, cell->x, cell->y, mask);
}

static void resolve_pixel(const struct resolving *r,
                          const struct hsr_mask_cell *cell) {
  struct hsr_lazy_pyramid *p = r->pyramid;
  const struct hsr_lazy_pixel *pixel = &p->pixel[cell->number];
  uint64_t in_window = hsr_masks_in_window(p->masks, cell);
  uint64_t covered = p->masks->finest[cell->number] & in_window;
  HSR_STEP(p->tally, HSR_LAZY_ENTERED, subject_of(p, cell), HSR_THE_WINDOW,
           samples_in(p, cell), pixel->z_buffered);
  if (pixel->z_buffered)
    HSR_STEP(p->tally, HSR_LAZY_Z_BUFFERED, subject_of(p, cell), HSR_THE_WINDOW,
             samples_in(p, cell), 0);
  if (pixel->z_buffered) {
    const uint32_t *face = samples_of(p, pixel)->face;
    for (uint64_t rest = covered, same; rest; rest &= ~same) {
      same = same_face(face, rest);
      tell_samples(r, cell, face[hsr_first_bit(rest)], same);
    }
  }
  for (uint32_t k = pixel->fragments; k; k = fragment(p, k)->next)
    tell_samples(r, cell, fragment(p, k)->face, fragment(p, k)->mask);
  if (covered != in_window)
    tell_samples(r, cell, HSR_BACKGROUND, in_window & ~covered);
}

static void resolve(const struct resolving *r,
                    const struct hsr_mask_cell *cell) {
  const struct hsr_lazy_pyramid *p = r->pyramid;
  if (is_finest(p, cell)) {
    resolve_pixel(r, cell);
    return;
  }
  const struct hsr_triage *mask = &p->masks->coarse[cell->level][cell->number];
  const struct hsr_lazy_cell *own = &p->cell[cell->level][cell->number];
  uint64_t all = hsr_masks_in_window(p->masks, cell);
  for (; all; all &= all - 1) {
    int bit = hsr_first_bit(all);
    struct hsr_mask_cell sub = hsr_masks_subcell(cell, bit);
    bool vacant = mask->v >> bit & 1, whole = own->whole >> bit & 1;
    if (vacant || whole) {
      r->take(r->context, vacant ? HSR_BACKGROUND : own->face);
      r->sink->square(r->sink->context, sub.x, sub.y, sub.size);
    } else {
      resolve(r, &sub);
    }
  }
}

void hsr_lazy_resolve(struct hsr_lazy_pyramid *p,
                      const struct hsr_mask_sink *sink, void *context,
                      void (*take)(void *context, uint32_t face)) {
  struct resolving resolving = {p, sink, context, take};
  struct hsr_mask_cell root = hsr_masks_root(p->masks);
  resolve(&resolving, &root);
}

/* --- What it counts ------------------------------------------------------- */

static const struct hsr_counter counters[] = {
    {"fragments", "of polygons, cached in pixels", HSR_ACTIVATE, HSR_OF_FACE,
     HSR_OF_CELL},
    {"pixels demoted", "from tiling to z-buffering", HSR_SUBDIVIDE, HSR_OF_CELL,
     HSR_OF_FACE},
    {"samples compared", "by depth", HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE,
     "farther|nearer"},
    {"pixels entered",
     "that in the end are not of one face as all about "
     "them, or vacant",
     HSR_SUBDIVIDE, HSR_OF_CELL, HSR_OF_WINDOW, "tiled|z-buffered"},
    {"pixels z-buffered", "of these, in the end", HSR_SUBDIVIDE, HSR_OF_CELL,
     HSR_OF_WINDOW},
    {NULL}};

static const struct hsr_line pixel_lines[] = {
    {"    if it is not behind all of a pixel's fragments where they meet: "
     "compare",
     HSR_RAISES(HSR_LAZY_COMPARED)},
    {"      tiling is legal: cache a fragment", HSR_RAISES(HSR_LAZY_FRAGMENTS)},
    {"      else change the pixel to ordinary z-buffering",
     HSR_RAISES(HSR_LAZY_DEMOTED)},
    {NULL}};

static const struct hsr_line end_lines[] = {
    {"for each pixel that is not of one face or vacant: shade its fragments",
     HSR_RAISES(HSR_LAZY_ENTERED)},
    {"  or the faces of its z-buffer", HSR_RAISES(HSR_LAZY_Z_BUFFERED)},
    {NULL}};

const struct hsr_part hsr_lazy_part = {
    HSR_PART_LAZY, counters, NULL, NULL, {pixel_lines, end_lines}};
