/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tiling in strict order: see strict.h. */
#include "algorithms/hierarchical/bounded/strict.h"
#include "algorithms/engines/bsp/bsp_walk.h"
#include "common/exact/order.h"

/* --- Once ----------------------------------------------------------------- */

static enum hsr_status check_convex(const struct hsr_world *world,
                                    struct hsr_error *err) {
  const struct hsr_adapter *a = hsr_adapters;
  struct hsr_world parts;
  bool divided = false;
  while (a->name && a->mends != HSR_CF)
    a++;
  enum hsr_status status =
      a->name ? a->adapt(world, &parts, &divided, err) : HSR_OK;
  if (divided)
    hsr_world_free(&parts);
  return divided ? hsr_fail(err, HSR_E_REFUSED,
                            "CF: strict order is only of convex faces")
                 : status;
}

static enum hsr_status lay_out(struct hsr_strict *s,
                               const struct hsr_world *world,
                               struct hsr_error *err) {
  s->world = world;
  if (!hsr_is_roster(world))
    return HSR_OK;
  if (world->n_faces > HSR_RATHER_MOST)
    return hsr_fail(err, HSR_E_REFUSED,
                    "strict order is of no more than %u faces, and these are "
                    "%u",
                    HSR_RATHER_MOST, world->n_faces);
  s->scene = *world->roster.scene;
  s->world = &s->own;
  return hsr_world_init(&s->own, &s->scene, err);
}

/* The pieces of a BSP tree. */
static uint64_t count_tree(const struct hsr_bsp *bsp, uint32_t root,
                           uint32_t *waiting) {
  uint64_t n = 0;
  uint32_t top = 0;
  if (root != HSR_NO_BSP)
    waiting[top++] = root;
  while (top) {
    const struct hsr_bsp_node *node = &bsp->node[waiting[--top]];
    n += node->n_pieces;
    if (node->front != HSR_NO_BSP)
      waiting[top++] = node->front;
    if (node->behind != HSR_NO_BSP)
      waiting[top++] = node->behind;
  }
  return n;
}

/* Children come after their parents. */
static bool count_within(struct hsr_strict *s) {
  const struct hsr_bsp *bsp = &s->bsp;
  uint32_t *waiting =
      HSR_NEW(&s->arena, uint32_t, hsr_bsp_most_waiting(bsp->most_depth));
  s->within = HSR_NEW(&s->arena, uint64_t, bsp->n_cubes);
  if (!waiting || !s->within)
    return false;
  for (uint32_t k = bsp->n_cubes; k-- > 0;) {
    const struct hsr_bsp_cube *cube = &bsp->cube[k];
    s->within[k] = count_tree(bsp, cube->root, waiting);
    for (int o = 0; o < 8; o++)
      if (cube->child[o] != HSR_NO_BSP)
        s->within[k] += s->within[cube->child[o]];
  }
  return true;
}

enum hsr_status hsr_strict_init(struct hsr_strict *s,
                                const struct hsr_world *world,
                                struct hsr_error *err) {
  static const struct hsr_bsp_rule rule = {.most = 30}; /* as of tiling */
  *s = (struct hsr_strict){.world = NULL};
  enum hsr_status status = lay_out(s, world, err);
  if (!status)
    status = check_convex(s->world, err);
  if (!status)
    status = hsr_bsp_init(&s->bsp, s->world, &rule, err);
  if (!status && !count_within(s))
    return hsr_fail_nomem(err);
  return status;
}

void hsr_strict_free(struct hsr_strict *s) {
  hsr_bsp_free(&s->bsp);
  hsr_world_free(&s->own);
  hsr_arena_free(&s->arena);
}

/* --- Pieces --------------------------------------------------------------- */

static struct hsr_shape_cut plane_of(const struct hsr_mesh *mesh, uint32_t f) {
  return (struct hsr_shape_cut){.plane = mesh->plane[f],
                                .face = f,
                                .side = 1,
                                .N = {mesh->nx[f], mesh->ny[f], mesh->nz[f]},
                                .P = {mesh->px[f], mesh->py[f], mesh->pz[f]},
                                .N_error = mesh->n_error[f],
                                .P_error = mesh->anchor_error[f]};
}

/* The plane of a side or of a cut, which says on which side of it the piece is.
 */
static struct hsr_shape_cut cut_of(const struct hsr_bsp *bsp,
                                   const struct hsr_bsp_corner *by) {
  const struct hsr_mesh *mesh = &bsp->world->mesh;
  struct hsr_shape_cut cut = {.plane = by->a, .face = HSR_NO_ID};
  if (by->a < mesh->n_planes) {
    cut = plane_of(mesh, bsp->face_of[by->a]);
  } else {
    const struct hsr_bsp_median *median = &bsp->median[by->a - mesh->n_planes];
    cut.N[median->axis] = 1;
    cut.P[median->axis] = median->at;
  }
  cut.side = by->b == HSR_BSP_FRONT ? 1 : -1;
  return cut;
}

static bool is_cut(const struct hsr_bsp_corner *side) {
  return side->b == HSR_BSP_FRONT || side->b == HSR_BSP_BEHIND;
}

/* The planes that cut a piece, which its sides tell if it is flat. */
static struct hsr_shape_cut *cuts_of(const struct hsr_bsp *bsp,
                                     const struct hsr_bsp_piece *piece,
                                     struct hsr_arena *arena, uint32_t *n) {
  const struct hsr_bsp_corner *by = piece->n_cuts
                                        ? bsp->cut + piece->first_cut
                                        : bsp->corner + piece->first_corner;
  uint32_t most = piece->n_cuts ? piece->n_cuts : piece->n_corners;
  struct hsr_shape_cut *cut = HSR_NEW(arena, struct hsr_shape_cut, most);
  *n = 0;
  for (uint32_t k = 0; cut && k < most; k++)
    if (is_cut(&by[k]))
      cut[(*n)++] = cut_of(bsp, &by[k]);
  return cut;
}

static void tile_piece(void *context, const struct hsr_bsp_piece *piece,
                       int facing) {
  struct hsr_strict_walk *w = context;
  struct hsr_tally *tally = w->tree->tally;
  uint32_t f = piece->face, n;
  (void)facing;
  if (w->failed || w->is_loose[f])
    return;
  HSR_STEP(tally, HSR_BOUNDED_FACES, HSR_FACE(f), w->cube, HSR_NOWHERE, 0);
  hsr_screen_plane(&w->screen, f);
  const struct hsr_shape_cut *cut =
      cuts_of(&w->strict->bsp, piece, w->tree->job->scratch, &n);
  const struct hsr_shape_cut own = plane_of(&w->strict->world->mesh, f);
  w->failed =
      !cut || !hsr_bounded_add_piece(w->tree, &w->screen, f, f, &own, cut, n);
}

static bool enter_cube(void *context, const struct hsr_bsp_cube *cube) {
  struct hsr_strict_walk *w = context;
  const struct hsr_octree_box box = {
      {cube->centre[0], cube->centre[1], cube->centre[2]},
      {cube->half, cube->half, cube->half}};
  uint32_t number = (uint32_t)(cube - w->strict->bsp.cube);
  if (hsr_bounded_is_late(w->tree)) {
    w->failed = w->failed || !w->leave(w->context, &box);
    return false;
  }
  w->cube = HSR_CELL(number, HSR_NO_ID, 0);
  return !w->failed && w->could_be_visible(w->context, &box,
                                           w->strict->within[number], w->cube);
}

/* --- A frame -------------------------------------------------------------- */

static bool add_loose(struct hsr_strict_walk *w, uint32_t f) {
  struct hsr_tally *tally = w->tree->tally;
  w->is_loose[f] = true;
  HSR_STEP(tally, HSR_BOUNDED_FACES, HSR_FACE(f), HSR_CELL(0, HSR_NO_ID, 0),
           HSR_NOWHERE, 0);
  return !hsr_face_exists(&w->screen, f, tally) ||
         hsr_bounded_add(w->tree, &w->screen, f, f);
}

/* Faces that are in no tree; and of those that are not flat, what the eye
 * grazes. */
static bool add_all_loose(struct hsr_strict_walk *w) {
  const struct hsr_bsp *bsp = &w->strict->bsp;
  for (uint32_t k = 0; k < bsp->n_loose; k++) {
    if (hsr_bounded_is_late(w->tree))
      break;
    hsr_screen_plane(&w->screen, bsp->loose[k]);
    if (!add_loose(w, bsp->loose[k]))
      return false;
  }
  for (uint32_t f = 0; f < bsp->world->n_faces; f++) {
    if (hsr_bounded_is_late(w->tree))
      break;
    if (!(bsp->reach[f] > 0) || w->is_loose[f])
      continue;
    hsr_screen_plane(&w->screen, f);
    if (hsr_grazes(&w->screen, f, bsp->reach[f]) && !add_loose(w, f))
      return false;
  }
  return true;
}

enum hsr_status hsr_strict_tile(struct hsr_strict_walk *w) {
  static const double still[3] = {0, 0, 0};
  const struct hsr_strict *s = w->strict;
  const struct hsr_job *job = w->tree->job;
  struct hsr_bsp_walk walk = {
      .bsp = &s->bsp,
      .view = job->view,
      .shift = still,
      .tally = job->tally,
      .waiting = HSR_NEW(job->scratch, struct hsr_bsp_waiting,
                         hsr_bsp_most_waiting(s->bsp.most_depth)),
      .context = w,
      .enter = enter_cube,
      .piece = tile_piece};
  w->is_loose = HSR_NEW_ZEROED(job->scratch, bool, s->world->n_faces);
  if (!walk.waiting || !w->is_loose ||
      hsr_screen_init(&w->screen, s->world, job->view, job->scratch))
    return HSR_E_NOMEM;
  hsr_screen_vertices(&w->screen);
  if (!add_all_loose(w))
    return HSR_E_NOMEM;
  if (w->tree->late) {
    hsr_bounded_leave_all(w->tree);
    return HSR_OK;
  }
  w->tree->in_order = (uint32_t)w->tree->shapes.n;
  hsr_bsp_walk_tree(&walk);
  return w->failed ? HSR_E_NOMEM : HSR_OK;
}
