/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The bodies and volumes of an algorithm that puts edges to volumes, for the
 * page. They are found again from the world, and numbered as the algorithm
 * numbers them in a view. */
#include "bench/lesson/lesson.h"
#include "common/files/json/json.h"
#include "common/lines/volumes.h"

#include <string.h>

struct found {
  const struct hsr_world *world;
  struct hsr_edges edges;
  struct hsr_volumes volumes;
  struct hsr_sight sight;
  struct hsr_arena arena;
  json_t *body, *volume; /* lists of faces */
  json_t *side; /* of each face of a volume: where the volume is, 1 before it */
};

static json_int_t parent(const struct found *found, uint32_t face) {
  return (json_int_t)hsr_world_parent(found->world, face);
}

/* Adds volume v as the faces of its planes, and the sides of these. */
static void add_volume(struct found *found, uint32_t v) {
  const struct hsr_volumes *all = &found->volumes;
  json_t *faces = json_array(), *sides = json_array();
  for (uint32_t i = all->plane_start[v]; i < all->plane_start[v + 1]; i++) {
    hsr_json_append(&faces, json_integer(parent(found, all->plane[i].face)));
    hsr_json_append(&sides, json_integer(all->plane[i].side));
  }
  hsr_json_append(&found->volume, faces);
  hsr_json_append(&found->side, sides);
}

/* Whether all corners of body b lie before the eye. */
static bool is_ahead(const struct found *found, uint32_t b) {
  const struct hsr_volumes *all = &found->volumes;
  for (uint32_t k = all->corner_start[b]; k < all->corner_start[b + 1]; k++)
    if (!found->sight.ahead[all->corner[k]])
      return false;
  return true;
}

/* A solid before the eye is its volumes; any other body is its faces. */
static void add_body(struct found *found, uint32_t b) {
  const struct hsr_volumes *all = &found->volumes;
  uint32_t first = all->solid_start[b], end = all->solid_start[b + 1];
  bool is_solid = first < end && is_ahead(found, b);
  json_t *faces = json_array();
  for (uint32_t v = first; is_solid && v < end; v++)
    add_volume(found, v);
  for (uint32_t k = all->face_start[b]; k < all->face_start[b + 1]; k++) {
    uint32_t f = all->face[k];
    hsr_json_append(&faces, json_integer(parent(found, f)));
    bool alone = !is_solid && found->sight.regular[f];
    for (uint32_t v = all->flat[f]; alone && v < all->flat[f + 1]; v++)
      add_volume(found, v);
  }
  hsr_json_append(&found->body, faces);
}

static enum hsr_status find(struct found *found, const struct hsr_view *view) {
  struct hsr_error err;
  struct hsr_tally tally = {.trace = NULL};
  enum hsr_status status = hsr_edges_init(&found->edges, found->world, &err);
  if (!status)
    status = hsr_volumes_init(&found->volumes, &found->edges, &err);
  if (!status)
    status = hsr_sight_init(&found->sight, &found->edges, view, &found->arena,
                            &tally);
  for (uint32_t b = 0; !status && b < found->volumes.n_bodies; b++)
    add_body(found, b);
  return status;
}

static bool numbers_solids(const struct hsr_setup *setup) {
  return strcmp(setup->algorithm->name, "tiling-solids") == 0;
}

bool lesson_has_volumes(const struct hsr_setup *setup) {
  return strcmp(setup->algorithm->name, "roberts") == 0 ||
         numbers_solids(setup);
}

bool lesson_add_volumes(json_t *to, const struct trace_run *run) {
  struct found found = {.world = run->setup.world,
                        .body = json_array(),
                        .volume = json_array(),
                        .side = json_array()};
  bool good = !find(&found, &run->view);
  hsr_sight_free(&found.sight);
  hsr_volumes_free(&found.volumes);
  hsr_edges_free(&found.edges);
  hsr_arena_free(&found.arena);
  if (numbers_solids(&run->setup)) { /* from 1: of each, its faces */
    json_decref(found.volume);
    json_array_clear(found.side);
    found.volume = json_copy(found.body);
    good &=
        found.volume && !json_array_insert_new(found.volume, 0, json_array());
  }
  good &= !json_object_set_new(to, "bodies", found.body);
  good &= !json_object_set_new(to, "sides", found.side);
  return !json_object_set_new(to, "volumes", found.volume) && good;
}
