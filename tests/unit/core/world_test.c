/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Outlines, and what is laid out of them: the same faces that hsr_world_init
 * lays out, bit for bit. */
#include "common/scene/world.h"
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <stdlib.h>
#include <string.h>

static void stop(const char *name, const char *text) {
  printf("Bail out! %s: %s\n", name, text);
  exit(99);
}

/* Is face f of `few` the same as face g of `all`, with vertices of its own? */
static bool is_same(const struct hsr_world *few, uint32_t f,
                    const struct hsr_world *all, uint32_t g) {
  bool same = few->nx[f] == all->nx[g] && few->ny[f] == all->ny[g] &&
              few->nz[f] == all->nz[g] && few->n_error[f] == all->n_error[g] &&
              few->px[f] == all->px[g] && few->py[f] == all->py[g] &&
              few->pz[f] == all->pz[g] &&
              few->anchor_error[f] == all->anchor_error[g] &&
              few->deviation[f] == all->deviation[g] &&
              few->object[f] == all->object[g] &&
              few->instance[f] == all->instance[g] &&
              few->one_sided[f] == all->one_sided[g] &&
              hsr_face_size(few, f) == hsr_face_size(all, g);
  for (uint32_t c = 0; same && c < hsr_face_size(few, f); c++) {
    uint32_t v = few->vertex[few->start[f] + c];
    uint32_t w = all->vertex[all->start[g] + c];
    same = v == few->start[f] + c && few->x[v] == all->x[w] &&
           few->y[v] == all->y[w] && few->z[v] == all->z[w];
  }
  return same;
}

/* Do two faces share a plane class here if and only if they do there? */
static bool is_classed(const struct hsr_world *few, const uint32_t *id,
                       const struct hsr_world *all) {
  uint32_t *class_of = malloc(few->n_planes * sizeof *class_of);
  uint32_t *seen = calloc(all->n_planes, sizeof *seen), n_seen = 0;
  bool good = class_of && seen;
  for (uint32_t p = 0; good && p < few->n_planes; p++)
    class_of[p] = UINT32_MAX;
  for (uint32_t f = 0; good && f < few->n_faces; f++) {
    uint32_t here = few->plane[f], there = all->plane[id[f]];
    if (class_of[here] == UINT32_MAX) {
      class_of[here] = there;
      n_seen += !seen[there]++;
    }
    good = class_of[here] == there;
  }
  good = good && n_seen == few->n_planes;
  free(class_of);
  free(seen);
  return good;
}

static bool extracts(const struct hsr_world *from, const struct hsr_world *all,
                     const uint32_t *id, uint32_t n) {
  struct hsr_world few;
  struct hsr_error err;
  if (hsr_world_extract(&few, from, id, n, &err))
    stop("extract", err.text);
  bool good = few.n_faces == n && few.n_vertices == few.n_corners;
  bool all_triangles = true;
  for (uint32_t f = 0; f < n && good; f++) {
    good = is_same(&few, f, all, id[f]);
    all_triangles &= hsr_face_size(&few, f) == 3;
  }
  good = good && few.all_triangles == all_triangles &&
         is_classed(&few, id, all) && few.id == id;
  hsr_world_free(&few);
  return good;
}

static void try_scene(struct tap *tap, const char *name, uint64_t *seed) {
  struct hsr_scene *scene;
  struct hsr_world all, outline, opened;
  struct hsr_error err = {.text = "out of memory"};
  if (hsr_scene_open(name, NULL, &scene, &err) ||
      hsr_world_init(&all, scene, &err) ||
      hsr_world_outline(&outline, scene, &err) ||
      hsr_world_open(&opened, scene, 0, &err))
    stop(name, err.text);
  uint32_t n = all.n_faces, k = scene->n_instances;
  ok(tap,
     hsr_is_outline(&outline) && !hsr_is_outline(&all) &&
         hsr_is_outline(&opened) && outline.n_faces == n &&
         !outline.n_vertices && !outline.n_corners &&
         outline.all_triangles == all.all_triangles &&
         !memcmp(outline.first, all.first, (k + 1) * sizeof *all.first) &&
         all.first[k] == n,
     "%s: the outline numbers %u faces of %u instances", name, (unsigned)n,
     (unsigned)k);
  long wrong = 0;
  for (uint32_t f = 0; f < n; f++)
    wrong += hsr_instance_of(&all, f) != all.instance[f] ||
             hsr_instance_of(&outline, f) != all.instance[f];
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

/* Above a size scenes are not laid out even if asked for. */
static void test_limit(struct tap *tap) {
  struct hsr_scene *scene;
  struct hsr_world world;
  struct hsr_error err = {.text = "out of memory"};
  if (hsr_scene_open("office:14", NULL, &scene, &err) ||
      hsr_world_open(&world, scene, HSR_MOST_LAID_OUT, &err))
    stop("office:14", err.text);
  uint32_t n = world.n_faces;
  bool good = hsr_is_outline(&world) && n > HSR_MOST_LAID_OUT &&
              world.all_triangles && hsr_instance_of(&world, 0) == 0 &&
              hsr_instance_of(&world, n - 1) == scene->n_instances - 1;
  ok(tap, good, "%u faces are not laid out", (unsigned)n);
  hsr_world_free(&world);
  hsr_scene_delete(scene);
}

int main(void) {
  static const char *const scenes[] = {"house",        "twist:3",  "non-planar",
                                       "lattice:80:1", "coplanar", "office:2",
                                       "terrain:8:6",  "one-sided"};
  enum { SCENES = sizeof scenes / sizeof *scenes };
  struct tap tap = plan(3 * SCENES + 1);
  uint64_t seed = 3;
  for (int k = 0; k < SCENES; k++)
    try_scene(&tap, scenes[k], &seed);
  test_limit(&tap);
  return finish(&tap);
}
