/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The culling camera, seen from elsewhere: its frustum, what it sees, and what
 * the algorithm did with the cubes of its octree, or its tree of planes. VTK
 * draws all of this. */
#include "bench/view/view.h"

#include "bench/shapes/shapes.h"
#include "common/trees/bsp.h"

#include <stdlib.h>
#include <string.h>

enum { SURFACE, FRUSTUM, TREE, N_PARTS, MOST_FROZEN = 500000 };

struct frozen {
  struct viewer *viewer;
  struct player player;   /* the counting build */
  struct hsr_world world; /* laid out */
  struct hsr_arena arena;
  struct cell_list list[N_PARTS];
  unsigned char *rgb[N_PARTS]; /* of its cells, in the arena; or NULL */
};

static unsigned char *new_colours(struct frozen *f, int part) {
  size_t n = f->list[part].start.n;
  f->rgb[part] = HSR_NEW(&f->arena, unsigned char, 3 * (n + 1));
  return f->rgb[part];
}

/* The faces that are visible in their colours, all others dark. */
static enum hsr_status make_surface(struct frozen *f,
                                    const struct hsr_view *view,
                                    struct hsr_error *err) {
  const struct hsr_world *world = &f->world;
  const uint32_t *ids = player_ids(&f->player);
  struct cell_list *list = &f->list[SURFACE];
  const struct hsr_mesh *mesh = &world->mesh;
  for (uint32_t v = 0; v < mesh->n_vertices; v++) {
    const double p[3] = {mesh->x[v], mesh->y[v], mesh->z[v]};
    cell_list_point(list, p);
  }
  for (uint32_t k = 0; k < world->n_faces; k++) {
    for (uint32_t c = mesh->start[k]; c < mesh->start[k + 1]; c++)
      cell_list_number(list, mesh->vertex[c]);
    cell_list_end(list);
  }
  unsigned char *rgb = new_colours(f, SURFACE);
  if (list->out_of_memory || !rgb)
    return hsr_fail_nomem(err);
  memset(rgb, 45, 3 * (size_t)world->n_faces);
  for (size_t k = 0; ids && k < (size_t)view->m * (size_t)view->n; k++)
    if (ids[k] != HSR_BACKGROUND && rgb[3 * (size_t)ids[k]] == 45)
      player_colour(world, view, ids[k], rgb + 3 * (size_t)ids[k]);
  return HSR_OK;
}

/* Cubes: visited green, outside of the frustum red, hidden orange. Planes: the
 * earlier the traversal comes to one, the brighter. */
static enum hsr_status make_tree(struct frozen *f,
                                 const struct shape_source *source,
                                 struct hsr_error *err) {
  static const unsigned char of_state[][3] = {
      {60, 60, 70}, {60, 220, 90}, {235, 70, 60}, {255, 165, 40}};
  struct cell_list *list = &f->list[TREE];
  const struct hsr_setup *setup = source->setup;
  bool bsp = hsr_setup_show(setup).bsp;
  bool planes = bsp || setup->world->clusters;
  enum hsr_status status = bsp ? shape_bsp(source, list, err)
                           : setup->world->clusters
                               ? shape_separators(source, list, err)
                               : shape_octree(source, list, err);
  unsigned char *rgb = status ? NULL : new_colours(f, TREE);
  if (!status && (!rgb || list->out_of_memory))
    status = hsr_fail_nomem(err);
  const size_t n = status || !list->start.n ? 0 : list->start.n - 1;
  const uint32_t *value =
      list->data[list->n_data ? list->n_data - 1 : 0].value.items;
  for (size_t k = 0; k < n; k++) {
    if (!planes)
      memcpy(rgb + 3 * k, of_state[value[k]], 3);
    for (size_t c = 0; c < 3 && planes; c++)
      rgb[3 * k + c] = (unsigned char)(255 - (c + 1) * 75 * value[k] / n);
  }
  return status;
}

/* The algorithm, or one that has a tree to show. */
static enum hsr_status open_with_tree(struct frozen *f, struct hsr_error *err) {
  const struct viewer *v = f->viewer;
  const struct hsr_setup *setup = &f->player.render.setup;
  enum hsr_status status = player_open(&f->player, v->player[0]->variant.name,
                                       PLAYER_COUNTS, v, err);
  if (status)
    return status;
  const struct hsr_shown shown = hsr_setup_show(setup);
  bool has_tree = shown.cubes || (shown.bsp && shown.bsp->n_cubes == 1) ||
                  setup->world->clusters;
  return has_tree && setup->choice.form.type->by_faces
             ? HSR_OK
             : player_open(&f->player, "hzbuffer", PLAYER_COUNTS, v, err);
}

static enum hsr_status make(struct frozen *f, struct hsr_error *err) {
  struct viewer *v = f->viewer;
  enum hsr_status status = viewer_view(v, v->m, v->coarse, &v->culled, err);
  if (!status)
    status = open_with_tree(f, err);
  if (!status)
    status = hsr_world_open(&f->world, v->scene, MOST_FROZEN, err);
  if (!status && hsr_is_roster(&f->world))
    status = hsr_fail(err, HSR_E_REFUSED,
                      "a scene of so many faces cannot be frozen");
  if (!status)
    status = player_draw(&f->player, &v->culled, v->other, err);
  if (!status)
    status = make_surface(f, &v->culled, err);
  const struct shape_source source = {&f->player.render.setup, &v->culled,
                                      &f->world};
  if (!status)
    status = shape_frustum(&source, &f->list[FRUSTUM], err);
  if (!status)
    status = make_tree(f, &source, err);
  return status;
}

static enum hsr_status show(struct frozen *f, struct hsr_error *err) {
  struct window_shape shape[N_PARTS] = {
      [SURFACE] = {.opacity = 1},
      [FRUSTUM] = {.opacity = 1, .lines = true, .colour = {255, 235, 60}},
      [TREE] = {.opacity = 1, .lines = true}};
  enum hsr_status status = HSR_OK;
  for (int k = 0; k < N_PARTS && !status; k++) {
    shape[k].rgb = f->rgb[k];
    status = cell_list_cells(&f->list[k], &shape[k].cells, err);
  }
  if (!status)
    f->viewer->library->shapes(f->viewer->window, shape, N_PARTS);
  return status;
}

void frozen_begin(struct viewer *v) {
  struct hsr_error err = {HSR_OK, ""};
  struct frozen f = {.viewer = v};
  enum hsr_status status = make(&f, &err);
  if (!status)
    status = show(&f, &err);
  v->frozen = !status;
  if (status)
    viewer_say(v, "%s", err.text);
  for (int k = 0; k < N_PARTS; k++)
    cell_list_free(&f.list[k]);
  hsr_arena_free(&f.arena);
  hsr_world_free(&f.world);
  player_close(&f.player);
}

void frozen_end(struct viewer *v) {
  v->frozen = false;
  v->library->shapes(v->window, NULL, 0);
  v->library->camera(v->window, &v->camera);
}
