/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/brute_force/zbuffer_fast/stream.h"
#include "common/base/numbers.h"
#include "common/base/vector.h"

#include <string.h>

enum { BLOCK = 256 }; /* vertices that are taken to the world together */

/* Vertices in the world. */
struct block {
  size_t n;
  double x[BLOCK], y[BLOCK], z[BLOCK];
};

/* hsr_instance_vertex of many, rounded alike. */
HSR_VECTOR static void to_world(size_t n, const double *restrict m,
                                const double *restrict xyz, double *restrict x,
                                double *restrict y, double *restrict z) {
  for (size_t v = 0; v < n; v++) {
    double a = xyz[3 * v], b = xyz[3 * v + 1], c = xyz[3 * v + 2];
    x[v] = ((m[0] * a + m[1] * b) + m[2] * c) + m[3];
    y[v] = ((m[4] * a + m[5] * b) + m[6] * c) + m[7];
    z[v] = ((m[8] * a + m[9] * b) + m[10] * c) + m[11];
  }
}

/* The vertices of an instance from number v on: a block of them, or what is
 * left. */
static void take_block(const struct hsr_scene *scene, uint32_t i, uint32_t v,
                       struct block *block) {
  const struct hsr_instance *instance = &scene->instances[i];
  const struct hsr_object *object = &scene->objects[instance->object];
  uint32_t left = object->n_vertices - v;
  block->n = left < BLOCK ? left : BLOCK;
  to_world(block->n, instance->m, object->xyz + 3 * (size_t)v, block->x,
           block->y, block->z);
}

/* --- Depths in parallel --------------------------------------------------- */

/* How far vertices lie along F. */
struct range {
  double nearest, farthest, size;
};

static void add_block(struct range *range, const struct hsr_view *view,
                      const struct block *block) {
  const double *E = view->E, *d = view->depth;
  for (size_t v = 0; v < block->n; v++) {
    double x = d[0] * (block->x[v] - E[0]), y = d[1] * (block->y[v] - E[1]),
           z = d[2] * (block->z[v] - E[2]);
    double t = x + y + z;
    range->nearest = hsr_min(range->nearest, t);
    range->farthest = hsr_max(range->farthest, t);
    range->size = hsr_max(range->size, fabs(x) + fabs(y) + fabs(z));
  }
}

static void set_range(const struct hsr_scene *scene, struct hsr_tiler *tiler) {
  struct range range = {INFINITY, -INFINITY, 0};
  struct block block;
  for (uint32_t i = 0; i < scene->n_instances; i++) {
    uint32_t n = scene->objects[scene->instances[i].object].n_vertices;
    for (uint32_t v = 0; v < n; v += BLOCK) {
      take_block(scene, i, v, &block);
      add_block(&range, tiler->view, &block);
    }
  }
  hsr_tiler_set_range(tiler, range.nearest, range.farthest, range.size);
}

/* --- For whoever tiles ---------------------------------------------------- */

enum hsr_status hsr_stream_begin(struct hsr_stream *stream,
                                 const struct hsr_job *job,
                                 struct hsr_tiler *tiler) {
  const struct hsr_scene *scene = job->world->roster.scene;
  struct hsr_arena *arena = job->scratch;
  uint32_t n_vertices = 0, n_faces = 0;
  for (uint32_t o = 0; o < scene->n_objects; o++) {
    const struct hsr_object *object = &scene->objects[o];
    n_vertices =
        object->n_vertices > n_vertices ? object->n_vertices : n_vertices;
    n_faces = object->n_faces > n_faces ? object->n_faces : n_faces;
  }
  stream->scene = job->world;
  stream->world = (struct hsr_world){.roster = job->world->roster};
  stream->one_sided = HSR_NEW(arena, bool, n_faces);
  tiler->corner = HSR_NEW(arena, struct hsr_corner, n_vertices);
  tiler->columns = HSR_NEW(arena, int, (size_t)hsr_largest_face(scene) + 4);
  if (!stream->one_sided || !tiler->corner || !tiler->columns ||
      hsr_alone_init(&stream->alone, job->world, job->view, arena) ||
      hsr_pair_init(&stream->pair, job->world, job->view, arena))
    return HSR_E_NOMEM;
  stream->world.mesh.one_sided = stream->one_sided;
  tiler->screen =
      (struct hsr_screen){.world = &stream->world, .view = job->view};
  tiler->alone = &stream->alone;
  tiler->pair = &stream->pair;
  if (job->view->parallel)
    set_range(scene, tiler);
  return HSR_OK;
}

uint32_t hsr_stream_instance(struct hsr_stream *stream, struct hsr_tiler *tiler,
                             uint32_t i, bool snap) {
  const struct hsr_scene *scene = stream->scene->roster.scene;
  const struct hsr_object *object = &scene->objects[scene->instances[i].object];
  struct block block;
  stream->world.n_faces = object->n_faces;
  stream->world.mesh.vertex = object->vertex;
  memset(stream->one_sided, object->one_sided, object->n_faces);
  tiler->first_id = stream->scene->roster.first[i];
  for (uint32_t v = 0; v < object->n_vertices && snap; v += BLOCK) {
    take_block(scene, i, v, &block);
    hsr_tiler_snap_points(tiler, v, block.n, block.x, block.y, block.z);
  }
  return object->n_faces;
}

void hsr_stream_tile_generally(struct hsr_stream *stream,
                               const struct hsr_tiler *tiler, uint32_t f) {
  struct hsr_tiler one = *tiler;
  hsr_alone_take(&stream->alone, tiler->first_id + f);
  one.screen = stream->alone.screen;
  one.few = &stream->alone.world;
  one.id = &stream->alone.id;
  one.first_id = 0;
  if (hsr_tiler_place(&one, 0))
    hsr_tiler_tile_generally(&one, 0);
}
