/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/view/view.h"

#include "common/exact/screen.h"

#include <stdarg.h>
#include <string.h>

__attribute__((format(printf, 2, 3))) static void add(struct viewer *v,
                                                      const char *format, ...) {
  size_t n = strlen(v->picked);
  va_list args;
  va_start(args, format);
  vsnprintf(v->picked + n, sizeof v->picked - n, format, args);
  va_end(args);
}

static void add_face(struct viewer *v, const struct hsr_world *world,
                     uint32_t id, double depth) {
  const struct hsr_place place = hsr_place_of(world, id);
  add(v, "  face %u, object %s, instance %u, t = %.6g\n", id,
      place.object->name, place.instance, depth);
}

/* The plane of a face. False: it is that of a grid, which is not laid out. */
static bool find_plane(const struct hsr_world *world, uint32_t id,
                       double normal[3], double anchor[3]) {
  const struct hsr_mesh *mesh = &world->mesh;
  if (!hsr_is_roster(world)) {
    memcpy(normal, (double[]){mesh->nx[id], mesh->ny[id], mesh->nz[id]},
           3 * sizeof *normal);
    memcpy(anchor, (double[]){mesh->px[id], mesh->py[id], mesh->pz[id]},
           3 * sizeof *anchor);
    return true;
  }
  if (hsr_scene_lacks_faces(world->roster.scene))
    return false;
  hsr_place_plane(world, hsr_place_of(world, id), normal, anchor);
  return true;
}

/* Where the ray of sample (i, j) meets the plane of a face. */
static void add_point(struct viewer *v, const struct hsr_world *world,
                      const struct hsr_view *view, uint32_t id, int i, int j) {
  double normal[3], anchor[3], at[3], height = 0, slope = 0;
  const double sx = hsr_sample_x(view, i), sy = hsr_sample_y(view, j);
  if (!find_plane(world, id, normal, anchor))
    return;
  for (int k = 0; k < 3; k++) {
    at[k] = view->ray[0][k] + sx * view->ray[1][k] + sy * view->ray[2][k];
    slope += normal[k] * (view->parallel ? view->F[k] : at[k]);
    height += normal[k] * (anchor[k] - view->E[k]);
    height -= view->parallel ? normal[k] * at[k] : 0;
  }
  for (int k = 0; k < 3; k++)
    at[k] = view->E[k] + (view->parallel ? at[k] + height / slope * view->F[k]
                                         : height / slope * at[k]);
  add(v, "  the point (%.6g, %.6g, %.6g)\n", at[0], at[1], at[2]);
}

/* The faces that cover sample (i, j), from front to back; how many. */
static uint32_t find_faces(const struct hsr_screen *screen, int i, int j,
                           uint32_t *face, struct hsr_tally *tally) {
  uint32_t n = 0;
  for (uint32_t r = 0; r < screen->n_relevant; r++) {
    const uint32_t f = screen->relevant[r];
    if (!hsr_covers(screen, f, i, j, tally))
      continue;
    uint32_t k = n++;
    for (; k > 0 && hsr_nearer(screen, f, face[k - 1], i, j, tally); k--)
      face[k] = face[k - 1];
    face[k] = f;
  }
  return n;
}

static enum hsr_status add_faces(struct viewer *v,
                                 const struct hsr_world *world,
                                 const struct hsr_view *view, int i, int j,
                                 struct hsr_error *err) {
  struct hsr_arena arena = HSR_ARENA_EMPTY;
  struct hsr_tally tally = {.out_of_memory = false};
  struct hsr_screen screen;
  enum hsr_status status = HSR_OK;
  uint32_t *face = HSR_NEW(&arena, uint32_t, world->n_faces);
  if (!face || hsr_screen_make(&screen, world, view, &arena, &tally))
    status = hsr_fail_nomem(err);
  uint32_t n = status ? 0 : find_faces(&screen, i, j, face, &tally);
  if (n)
    add_point(v, world, view, face[0], i, j);
  for (uint32_t k = 0; k < n; k++)
    add_face(v, world, face[k],
             hsr_view_depth(view, hsr_depth(&screen, face[k], i, j)));
  if (!n && !status)
    add(v, "  no face\n");
  if (tally.out_of_memory)
    status = hsr_fail_nomem(err);
  hsr_arena_free(&arena);
  return status;
}

/* Of a scene that is not laid out, only the visible face is known. */
static void add_visible(struct viewer *v, const struct hsr_view *view, int i,
                        int j) {
  const struct player *p = v->player[0];
  const uint32_t *ids = player_ids(p);
  if (!ids || p->render.view.m != view->m || p->render.view.n != view->n)
    return;
  const uint32_t id = ids[(size_t)j * (size_t)view->m + (size_t)i];
  if (id == HSR_BACKGROUND) {
    add(v, "  no face\n");
    return;
  }
  const struct hsr_place place = hsr_place_of(&p->render.world, id);
  add_point(v, &p->render.world, view, id, i, j);
  add(v,
      "  face %u, object %s, instance %u; others are not known of so many "
      "faces\n",
      id, place.object->name, place.instance);
}

void pick(struct viewer *v, int x, int y) {
  struct hsr_error err = {HSR_OK, ""};
  struct hsr_view view;
  const struct hsr_world *world = &v->player[0]->render.world;
  const bool sides = v->comparison == COMPARE_SIDES;
  const int half = v->m / 2, width = !sides     ? v->m
                                     : x < half ? half
                                                : v->m - half;
  *v->picked = '\0';
  enum hsr_status status = viewer_view(v, width, v->coarse, &view, &err);
  int i = (sides && x >= half ? x - half : x) / v->coarse, j = y / v->coarse;
  if (status || x < 0 || y < 0 || i >= view.m || j >= view.n)
    return;
  view.window = (struct hsr_window){i, j, i + 1, j + 1};
  add(v, "sample (%d, %d), from front to back; t: depth along the view\n", i,
      j);
  if (hsr_is_roster(world))
    add_visible(v, &view, i, j);
  else
    status = add_faces(v, world, &view, i, j, &err);
  if (status)
    add(v, "%s\n", err.text);
  fputs(v->picked, stdout);
  fflush(stdout);
}
