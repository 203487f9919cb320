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
  const struct trace_run *run;
  struct hsr_edges edges;
  struct hsr_volumes volumes;
  struct hsr_sight sight;
  struct hsr_arena arena;
  json_t *body, *volume; /* lists of faces */
  json_t *side; /* of each face of a volume: where the volume is, 1 before it */
  json_t *part; /* of concave solids: [volume, images of its sides] */
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

/* --- The parts of a concave solid ------------------------------------------ */

struct polygon {
  int n;
  double at[LESSON_MOST_POINTS][3];
};

/* The plane of number i, its normal away from the volume. */
static struct lesson_plane outward(const struct found *found, uint32_t i) {
  struct lesson_plane p =
      lesson_plane_of_face(&found->world->mesh, found->volumes.plane[i].face);
  for (int c = 0; c < 3 && found->volumes.plane[i].side > 0; c++)
    p.normal[c] = -p.normal[c];
  if (found->volumes.plane[i].side > 0)
    p.offset = -p.offset;
  return p;
}

static double beyond(const struct lesson_plane *p, const double at[3]) {
  return p->normal[0] * at[0] + p->normal[1] * at[1] + p->normal[2] * at[2] -
         p->offset;
}

/* Keeps what of a polygon lies behind a plane. Too many corners: it stays. */
static void keep_behind(struct polygon *polygon, const struct lesson_plane *p) {
  struct polygon out = {.n = 0};
  for (int k = 0; k < polygon->n; k++) {
    const double *a = polygon->at[k], *b = polygon->at[(k + 1) % polygon->n];
    double s = beyond(p, a), t = beyond(p, b);
    if (out.n + 2 > LESSON_MOST_POINTS)
      return;
    if (s <= 0)
      memcpy(out.at[out.n++], a, sizeof out.at[0]);
    if ((s < 0 && t > 0) || (s > 0 && t < 0)) {
      for (int c = 0; c < 3; c++)
        out.at[out.n][c] = a[c] + (b[c] - a[c]) * s / (s - t);
      out.n++;
    }
  }
  *polygon = out;
}

/* The sides of a part, also those that no face bounds: each plane, as far as it lies
 * behind the others. */
static json_t *sides_json(const struct found *found, uint32_t v) {
  json_t *sides = json_array();
  uint32_t first = found->volumes.plane_start[v],
           end = found->volumes.plane_start[v + 1];
  for (uint32_t i = first; i < end; i++) {
    struct lesson_plane plane = outward(found, i), other;
    struct polygon side;
    side.n = lesson_plane_in_box(&found->run->laid_out.mesh, &plane, side.at);
    for (uint32_t j = first; j < end; j++)
      if (j != i) {
        other = outward(found, j);
        keep_behind(&side, &other);
      }
    if (side.n > 2)
      hsr_json_append(&sides,
                      lesson_image_json(&found->run->view,
                                        (const double(*)[3])side.at, side.n));
  }
  return sides;
}

/* --- Bodies --------------------------------------------------------------- */

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
  for (uint32_t v = first; is_solid && v < end; v++) {
    if (end - first > 1)
      hsr_json_append(&found->part,
                      json_pack("[Io]",
                                (json_int_t)json_array_size(found->volume),
                                sides_json(found, v)));
    add_volume(found, v);
  }
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
  return setup->algorithm->numbered == HSR_NUMBERED_SOLIDS;
}

bool lesson_has_volumes(const struct hsr_setup *setup) {
  return setup->algorithm->numbered == HSR_NUMBERED_VOLUMES ||
         numbers_solids(setup);
}

bool lesson_add_volumes(json_t *to, const struct trace_run *run) {
  struct found found = {.world = run->setup.world,
                        .run = run,
                        .part = json_array(),
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
    json_array_clear(found.part);
    found.volume = json_copy(found.body);
    good &=
        found.volume && !json_array_insert_new(found.volume, 0, json_array());
  }
  good &= !json_object_set_new(to, "bodies", found.body);
  good &= !json_object_set_new(to, "sides", found.side);
  good &= !json_object_set_new(to, "parts", found.part);
  return !json_object_set_new(to, "volumes", found.volume) && good;
}
