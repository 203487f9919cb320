/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Outlines, and the faces that are laid out from them: the same, bit for bit,
 * as those that hsr_world_init lays out. */
#include "common/scene/world.h"
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Is face f of `few`, with its own vertices, the same as face g of `all`? */
static bool is_same(const struct hsr_world *few, uint32_t f,
                    const struct hsr_world *all, uint32_t g) {
  bool same = few->mesh.nx[f] == all->mesh.nx[g] &&
              few->mesh.ny[f] == all->mesh.ny[g] &&
              few->mesh.nz[f] == all->mesh.nz[g] &&
              few->mesh.n_error[f] == all->mesh.n_error[g] &&
              few->mesh.px[f] == all->mesh.px[g] &&
              few->mesh.py[f] == all->mesh.py[g] &&
              few->mesh.pz[f] == all->mesh.pz[g] &&
              few->mesh.anchor_error[f] == all->mesh.anchor_error[g] &&
              few->mesh.deviation[f] == all->mesh.deviation[g] &&
              few->mesh.object[f] == all->mesh.object[g] &&
              few->mesh.instance[f] == all->mesh.instance[g] &&
              few->mesh.one_sided[f] == all->mesh.one_sided[g] &&
              hsr_face_size(few, f) == hsr_face_size(all, g);
  for (uint32_t c = 0; same && c < hsr_face_size(few, f); c++) {
    uint32_t v = few->mesh.vertex[few->mesh.start[f] + c];
    uint32_t w = all->mesh.vertex[all->mesh.start[g] + c];
    same = v == few->mesh.start[f] + c && few->mesh.x[v] == all->mesh.x[w] &&
           few->mesh.y[v] == all->mesh.y[w] && few->mesh.z[v] == all->mesh.z[w];
  }
  return same;
}

/* Do two faces share a plane class in `few` if and only if they do in `all`? */
static bool is_classed(const struct hsr_world *few, const uint32_t *id,
                       const struct hsr_world *all) {
  uint32_t *class_of = malloc(few->mesh.n_planes * sizeof *class_of);
  uint32_t *seen = calloc(all->mesh.n_planes, sizeof *seen), n_seen = 0;
  bool good = class_of && seen;
  for (uint32_t p = 0; good && p < few->mesh.n_planes; p++)
    class_of[p] = UINT32_MAX;
  for (uint32_t f = 0; good && f < few->n_faces; f++) {
    uint32_t here = few->mesh.plane[f], there = all->mesh.plane[id[f]];
    if (class_of[here] == UINT32_MAX) {
      class_of[here] = there;
      n_seen += !seen[there]++;
    }
    good = class_of[here] == there;
  }
  good = good && n_seen == few->mesh.n_planes;
  free(class_of);
  free(seen);
  return good;
}

static bool extracts(const struct hsr_world *from, const struct hsr_world *all,
                     const uint32_t *id, uint32_t n) {
  struct hsr_world few;
  struct hsr_error err;
  if (hsr_world_extract(&few, from, id, n, &err))
    bail("extract: %s", err.text);
  bool good = few.n_faces == n && few.mesh.n_vertices == few.mesh.n_corners;
  bool all_triangles = true;
  for (uint32_t f = 0; f < n && good; f++) {
    good = is_same(&few, f, all, id[f]);
    all_triangles &= hsr_face_size(&few, f) == 3;
  }
  good = good && few.roster.all_triangles == all_triangles &&
         is_classed(&few, id, all) && few.id == id;
  hsr_world_free(&few);
  return good;
}

static void try_scene(struct tap *tap, const char *name, uint64_t *seed) {
  struct hsr_world all, outline, opened;
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_scene *scene = must_open(name);
  must_world(&all, scene);
  must_roster(&outline, scene);
  if (hsr_world_open(&opened, scene, 0, &err))
    bail("%s: %s", name, err.text);
  uint32_t n = all.n_faces, k = scene->n_instances;
  ok(tap,
     hsr_is_roster(&outline) && !hsr_is_roster(&all) &&
         hsr_is_roster(&opened) && outline.n_faces == n &&
         !outline.mesh.n_vertices && !outline.mesh.n_corners &&
         outline.roster.all_triangles == all.roster.all_triangles &&
         !memcmp(outline.roster.first, all.roster.first,
                 (k + 1) * sizeof *all.roster.first) &&
         all.roster.first[k] == n,
     "%s: the outline numbers %u faces of %u instances", name, (unsigned)n,
     (unsigned)k);
  long wrong = 0;
  for (uint32_t f = 0; f < n; f++)
    wrong += hsr_instance_of(&all.roster, f) != all.mesh.instance[f] ||
             hsr_instance_of(&outline.roster, f) != all.mesh.instance[f];
  ok(tap, !wrong, "%s: every face is of its instance", name);

  enum { MOST = 4000 };
  static uint32_t id[MOST];
  uint32_t n_id = n < MOST ? n : MOST;
  for (uint32_t f = 0; f < n_id; f++)
    id[f] = n <= MOST ? f : (uint32_t)draw_integer(seed, 0, n - 1);
  bool whole = extracts(&outline, &all, id, n_id);
  for (uint32_t f = 0; f < n_id; f++) /* in any order, some repeatedly */
    id[f] = (uint32_t)draw_integer(seed, 0, n - 1);
  ok(tap,
     whole && extracts(&outline, &all, id, n_id / 2 + 1) &&
         extracts(&all, &all, id, n_id / 3 + 1) &&
         extracts(&outline, &all, id, 0),
     "%s: faces that are extracted are those of the world", name);
  hsr_world_free(&all);
  hsr_world_free(&outline);
  hsr_world_free(&opened);
  hsr_scene_delete(scene);
}

/* Scenes above a certain size are not laid out, even if that is asked for. */
static void test_limit(struct tap *tap) {
  struct hsr_world world;
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_scene *scene = must_open("office:14");
  if (hsr_world_open(&world, scene, HSR_MOST_LAID_OUT, &err))
    bail("office:14: %s", err.text);
  uint32_t n = world.n_faces;
  bool good = hsr_is_roster(&world) && n > HSR_MOST_LAID_OUT &&
              world.roster.all_triangles &&
              hsr_instance_of(&world.roster, 0) == 0 &&
              hsr_instance_of(&world.roster, n - 1) == scene->n_instances - 1;
  ok(tap, good, "%u faces are not laid out", (unsigned)n);
  hsr_world_free(&world);
  hsr_scene_delete(scene);
}

/* Triangles of two parallel planes, so large, and some so thin, that rounding
 * takes much of their normals. */
static void test_classes(struct tap *tap, uint64_t *seed) {
  bool good = true;
  for (int round = 0; round < 40; round++) {
    struct hsr_scene *scene = hsr_scene_new("planes");
    struct hsr_object *object = hsr_scene_object(scene, "planes");
    struct hsr_world world;
    int64_t u[3], v[3];
    for (int k = 0; k < 3; k++) {
      u[k] = draw_integer(seed, -100000000, 100000000);
      v[k] = draw_integer(seed, -100000000, 100000000);
    }
    for (int f = 0; f < 40; f++) {
      uint32_t vertex[3];
      int64_t a = draw_integer(seed, -50, 50), b = draw_integer(seed, -50, 50);
      const int64_t by[3][2] = {
          {a, b}, {a + 89, b + 55}, {a + 144, b + 89 + f % 3}};
      for (int c = 0; c < 3; c++) {
        double p[3];
        for (int k = 0; k < 3; k++)
          p[k] = (double)(by[c][0] * u[k] + by[c][1] * v[k] +
                          (k == 2 ? f % 2 : 0));
        hsr_object_vertex(object, p[0], p[1], p[2], &vertex[c]);
      }
      hsr_object_face(object, vertex, 3, NULL);
    }
    must_finish(scene);
    must_world(&world, scene);
    good &= world.mesh.n_planes == 2;
    for (uint32_t f = 0; f < world.n_faces; f++)
      good &= world.mesh.plane[f] == world.mesh.plane[f % 2];
    hsr_world_free(&world);
    hsr_scene_delete(scene);
  }
  ok(tap, good, "large triangles of a plane are of one class");
}

/* Pentagons of small integers, in which all is exact: the deviation is that of
 * the vertex that is farthest out of the plane. */
static void test_deviation(struct tap *tap, uint64_t *seed) {
  enum { FACES = 200 };
  struct hsr_scene *scene = hsr_scene_new("pentagons");
  struct hsr_object *object = hsr_scene_object(scene, "pentagons");
  struct hsr_world world;
  while (object->n_faces < FACES) {
    static const int around[5][2] = {
        {4, 0}, {3, 3}, {-2, 4}, {-4, -1}, {1, -4}};
    uint32_t vertex[5];
    for (int c = 0; c < 5; c++)
      hsr_object_vertex(object, around[c][0], around[c][1],
                        (double)draw_integer(seed, -2, 2), &vertex[c]);
    hsr_object_face(object, vertex, 5, NULL);
  }
  must_finish(scene);
  must_world(&world, scene);
  bool good = true;
  for (uint32_t f = 0; f < FACES; f++) {
    double largest = 0;
    for (uint32_t k = world.mesh.start[f]; k < world.mesh.start[f + 1]; k++) {
      uint32_t v = world.mesh.vertex[k];
      double off = world.mesh.nx[f] * (world.mesh.x[v] - world.mesh.px[f]) +
                   world.mesh.ny[f] * (world.mesh.y[v] - world.mesh.py[f]) +
                   world.mesh.nz[f] * (world.mesh.z[v] - world.mesh.pz[f]);
      largest = fmax(largest, fabs(off));
    }
    double deviation = world.mesh.deviation[f];
    good &= deviation == 0 ? largest < 1e-9
                           : deviation >= largest && deviation < largest + 1e-9;
  }
  ok(tap, good, "a face deviates as its farthest vertex does");
  hsr_world_free(&world);
  hsr_scene_delete(scene);
}

/* A face of many corners has a span if it is flat: three of its corners, whose
 * plane has the same front and back as the face's. */
static void test_spans(struct tap *tap) {
  enum { CORNERS = 40, FACES = 4 };
  struct hsr_scene *scene = hsr_scene_new("rings");
  struct hsr_object *object = hsr_scene_object(scene, "rings");
  struct hsr_world world;
  for (int f = 0; f < FACES; f++) { /* the last one is not flat */
    uint32_t vertex[CORNERS];
    for (int c = 0; c < CORNERS; c++) {
      int k = f % 2 ? CORNERS - 1 - c : c; /* either way around */
      int x = k < CORNERS / 2 ? k : CORNERS - k,
          y = (k < CORNERS / 2 ? 1 : -1) * (3 + k % 2);
      double z = 2 * x + y + (f == FACES - 1 && c == 7 ? 0x1p-40 : 0);
      hsr_object_vertex(object, x, y, z, &vertex[c]);
    }
    hsr_object_face(object, vertex, CORNERS, NULL);
  }
  must_finish(scene);
  must_world(&world, scene);
  bool good = true, oom = false;
  for (uint32_t f = 0; f < FACES; f++) {
    struct hsr_loop face = hsr_face_loop(&world, f),
                    span = hsr_spanning_loop(&world, f);
    good &= span.n == (f == FACES - 1 ? CORNERS : 3);
    static const double aside[2][3] = {{5, 0, 10 + 0x1p-30},
                                       {5, 0, 10 - 0x1p-30}};
    for (int k = 0; k < 2; k++) {
      int side = hsr_exact_plane_side(span, aside[k], &oom);
      good &= side && side == hsr_exact_plane_side(face, aside[k], &oom);
    }
    for (uint32_t k = 0; k < CORNERS && f < FACES - 1; k++) {
      uint32_t v = face.vertex[k];
      const double at[3] = {face.x[v], face.y[v], face.z[v]};
      good &= !hsr_exact_plane_side(span, at, &oom);
    }
  }
  ok(tap, good && !oom, "three corners span the plane of a flat face of many");
  hsr_world_free(&world);
  hsr_scene_delete(scene);
}

/* What cannot be in a scene; what is there without being said; and how large a
 * scene may be to be laid out. */
static void test_scene(struct tap *tap) {
  static const double flat[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0};
  struct hsr_scene *scene = hsr_scene_new("scene");
  struct hsr_error err = {.text = ""};
  struct hsr_world world;
  uint32_t loop[20];
  for (int o = 0; o < 3; o++) {
    struct hsr_object *object = hsr_scene_object(scene, "object");
    for (uint32_t k = 0; k < 20; k++)
      hsr_object_vertex(object, o, k, k * k, &loop[k]);
    hsr_object_face(object, loop, 20, NULL);
  }
  struct hsr_object *first = &scene->objects[0];
  uint32_t beyond[] = {0, 1, 20};
  loop[19] = loop[0];
  ok(tap,
     hsr_object_face(first, loop, 20, NULL) == HSR_E_INPUT &&
         hsr_object_face(first, loop, 19, NULL) == HSR_OK &&
         hsr_object_face(first, beyond, 3, NULL) == HSR_E_INPUT,
     "no vertex follows itself, and there are only those that there are");
  ok(tap,
     !hsr_scene_instance(scene, 1, NULL) &&
         !hsr_scene_instance(scene, 1, NULL) &&
         hsr_scene_instance(scene, 0, NULL) == HSR_E_INPUT &&
         !hsr_scene_finish(scene, &err) && scene->n_instances == 4 &&
         scene->instances[0].object == 0 && scene->instances[1].object == 1 &&
         scene->instances[2].object == 1 && scene->instances[3].object == 2,
     "an object without instances has one, in its place: %s", err.text);
  bool laid_out = !hsr_world_open(&world, scene, 5, &err) &&
                  !hsr_is_roster(&world) && world.n_faces == 5;
  hsr_world_free(&world);
  ok(tap,
     laid_out && !hsr_world_open(&world, scene, 4, &err) &&
         hsr_is_roster(&world),
     "as many faces as may be are laid out, more are not");
  hsr_world_free(&world);
  memcpy(scene->instances[3].m, flat, sizeof flat);
  ok(tap, hsr_world_init(&world, scene, &err) == HSR_E_INPUT,
     "an instance may not leave a face without area: %s", err.text);
  hsr_world_free(&world);
  hsr_scene_delete(scene);
}

int main(void) {
  static const char *const scenes[] = {"house",        "twist:3",  "non-planar",
                                       "lattice:80:1", "coplanar", "office:2",
                                       "terrain:8:6",  "one-sided"};
  enum { SCENES = sizeof scenes / sizeof *scenes };
  struct tap tap = plan(3 * SCENES + 8);
  uint64_t seed = 3;
  for (int k = 0; k < SCENES; k++)
    try_scene(&tap, scenes[k], &seed);
  test_limit(&tap);
  test_classes(&tap, &seed);
  test_deviation(&tap, &seed);
  test_spans(&tap);
  test_scene(&tap);
  return finish(&tap);
}
