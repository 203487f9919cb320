/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Weiler and Atherton's visible polygons, sampled exactly, show at every sample
 * the face that the oracle sees there: of built-in scenes, in perspective and in
 * parallel. And what Greene 1995, pp. 10-11, says of the work: every polygon is
 * considered at least once, many of them many times; the first sort is not
 * essential, but makes it less. Without the sort the picture is divided in other
 * ways, and the answers must agree all the same.
 *
 * usage: weiler_atherton_test [SCENE...] */
#include "bench/modules/variant.h"
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"
#include "common/answers/kinds/polygons.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { M = 64, N = 48 };

static const char *const standard[] = {"house",         "color-cube:3",
                                       "twist:3",       "soup:40",
                                       "lattice:60",    "grid:3",
                                       "sphere:200",    "cyclic-overlap",
                                       "penetration",   "coplanar",
                                       "nested-solids", "one-sided",
                                       "deep-stack",    "t-junction",
                                       "shared-edges",  "collinear-edges",
                                       "sliver",        "sub-pixel-gap",
                                       "needle-fan",    "non-convex",
                                       "non-planar",    "huge-and-tiny",
                                       "behind-eye",    "near-plane",
                                       "eye-in-plane",  NULL};

static const struct hsr_listed *find(const char *name) {
  const struct hsr_listed *found = hsr_algorithm_find(name);
  if (found)
    return found;
  bail("no %s", name);
}

/* How often each face was taken for a clip polygon or examined against one, and
 * which have polygons in the picture. */
struct watch {
  int sorted, clip, examined;
  bool *is_there;
  long *times;
};

static void listen(void *context, const struct hsr_event *event) {
  struct watch *watch = context;
  if (event->counter == watch->sorted)
    watch->is_there[event->a.id[0]] = true;
  if (event->counter == watch->clip || event->counter == watch->examined)
    watch->times[event->a.id[0]]++;
}

/* --- One view ------------------------------------------------------------- */

struct found {
  long differing, views, never, polygons, times, refused, divided, unlike;
  long astray; /* corners in space that are not in the plane of their face */
  long examined[2]; /* sorted, and not */
};

static void draw(const struct hsr_world *world, const struct hsr_view *view,
                 const char *name, struct hsr_answer *answer,
                 struct hsr_tally *tally) {
  struct hsr_arena scratch = HSR_ARENA_EMPTY;
  struct hsr_error err = {.text = ""};
  struct hsr_variant variant;
  struct hsr_setup setup = {.prepared = NULL};
  struct hsr_job job = {
      .view = view, .scratch = &scratch, .tally = tally, .answer = answer};
  enum hsr_status status = hsr_variant_parse(name, &variant, &err);
  if (!status)
    status = hsr_answer_make(answer, &variant.choice.form, view, false, &err);
  if (!status)
    status = hsr_setup_init(&setup, variant.listed->counting, &variant.choice,
                            world, &err);
  if (!status)
    status = hsr_setup_render(&setup, &job, &err);
  if (status)
    bail("%s: %s", name, err.text);
  hsr_setup_free(&setup);
  hsr_arena_free(&scratch);
}

/* The answer without the sort, and one that is wrong. */
static void compare(const struct hsr_world *world, const struct hsr_view *view,
                    struct found *found) {
  const char *const name[2] = {"weiler-atherton",
                               "weiler-atherton:sort=none:clips=1000"};
  struct hsr_answer answer[2];
  struct hsr_polygons *p[2];
  struct hsr_polygons_difference difference;
  struct hsr_error err;
  int examined = counter_of(find(name[0])->counting, "examinations");
  for (int k = 0; k < 2; k++) {
    struct hsr_tally tally = {.out_of_memory = false};
    draw(world, view, name[k], &answer[k], &tally);
    found->examined[k] += (long)tally.count[examined];
    p[k] = hsr_answer_polygons_of(&answer[k]);
  }
  found->divided += p[0]->n_sides != p[1]->n_sides;
  found->unlike += hsr_polygons_compare(p[0], p[1], view, &difference, &err) ||
                   difference.differing;
  if (p[1]->n_regions) {
    uint32_t last = p[1]->region[--p[1]->n_regions].face;
    found->unlike +=
        hsr_polygons_compare(p[0], p[1], view, &difference, &err) ||
        difference.differing != 1 || difference.first != last;
  }
  for (int k = 0; k < 2; k++)
    hsr_answer_free(&answer[k]);
}

/* How far a point is from a face's plane, which is rounded. */
static double height_over(const struct hsr_mesh *mesh, uint32_t f,
                          const double point[3]) {
  return mesh->nx[f] * (point[0] - mesh->px[f]) +
         mesh->ny[f] * (point[1] - mesh->py[f]) +
         mesh->nz[f] * (point[2] - mesh->pz[f]);
}

/* A corner of a region is a point of the face, so it is no farther from the
 * rounded plane than the face's own corners are; but for the rounding of numbers as
 * large as the places of the eye, the point and the plane. */
static bool is_in_plane(const struct hsr_mesh *mesh, uint32_t f,
                        const double eye[3], const double point[3]) {
  double most = 0, size = 0;
  for (uint32_t k = mesh->start[f]; k < mesh->start[f + 1]; k++) {
    uint32_t v = mesh->vertex[k];
    most = fmax(most, fabs(height_over(mesh, f,
                                       (const double[]){mesh->x[v], mesh->y[v],
                                                        mesh->z[v]})));
  }
  const double anchor[3] = {mesh->px[f], mesh->py[f], mesh->pz[f]};
  for (int k = 0; k < 3; k++)
    size += fabs(point[k]) + fabs(anchor[k]) + fabs(eye[k]);
  double length = fabs(mesh->nx[f]) + fabs(mesh->ny[f]) + fabs(mesh->nz[f]);
  return fabs(height_over(mesh, f, point)) <= most + 1e-9 * length * size;
}

/* How many corners of the regions are not in the planes of their faces. */
static long count_astray(const struct hsr_world *world,
                         const struct hsr_view *view,
                         const struct hsr_polygons *p) {
  long astray = 0;
  double *point = calloc(p->n_sides + 1, 3 * sizeof(double));
  hsr_polygon_points(p, view, point);
  for (size_t r = 0; r < p->n_regions; r++)
    for (size_t c = 0; c < p->region[r].n; c++) {
      const struct hsr_polygon_cycle *cycle = &p->cycle[p->region[r].first + c];
      for (size_t k = cycle->first; k < cycle->first + cycle->n; k++)
        astray += !is_in_plane(&world->mesh, p->region[r].face, view->E,
                               point + 3 * k);
    }
  free(point);
  return astray;
}

static void check_view(const struct hsr_world *world,
                       const struct hsr_view *view, const char *scene,
                       struct found *found) {
  const struct hsr_listed *wa = find("weiler-atherton");
  static uint32_t wanted[M * N], got[M * N];
  struct watch watch = {counter_of(wa->counting, "polygons"),
                        counter_of(wa->counting, "clip polygons"),
                        counter_of(wa->counting, "examinations"),
                        calloc(world->n_faces, sizeof(bool)),
                        calloc(world->n_faces, sizeof(long))};
  struct hsr_trace trace = {.listen = listen, .context = &watch};
  struct hsr_tally tally = {.trace = &trace};
  draw_ids(find("oracle")->plain, world, view, wanted, NULL);
  for (int build = 0; build < 2; build++) {
    struct hsr_answer answer;
    struct hsr_error err;
    if (!draw_answer(build ? wa->counting : wa->plain, world, view, &answer,
                     build ? &tally : NULL)) {
      found->refused++;
      hsr_answer_free(&answer);
      continue;
    }
    if (hsr_polygons_ids(hsr_answer_polygons_of(&answer), view, got, &err))
      bail("%s: %s", scene, err.text);
    found->astray += count_astray(world, view, hsr_answer_polygons_of(&answer));
    long differing = count_differences(view, got, wanted);
    if (differing && !found->differing)
      for (int k = 0; k < M * N; k++)
        if (got[k] != wanted[k]) {
          printf("# %s, view %ld: (%d, %d): face %d, not %d; %ld differ\n",
                 scene, found->views, k % M, k / M, (int)got[k], (int)wanted[k],
                 differing);
          break;
        }
    found->differing += differing;
    hsr_answer_free(&answer);
  }
  if (strcmp(scene, "needle-fan")) /* it takes minutes if it is not sorted */
    compare(world, view, found);
  found->views++;
  for (uint32_t f = 0; f < world->n_faces; f++) {
    found->never += watch.is_there[f] && !watch.times[f];
    found->polygons += watch.is_there[f];
    found->times += watch.times[f];
  }
  free(watch.is_there);
  free(watch.times);
}

/* --- A scene -------------------------------------------------------------- */

static long examined[2]; /* in all scenes, sorted and not */

static void check_scene(struct tap *t, const char *name) {
  struct both_worlds worlds;
  struct found found = {0};
  open_worlds(&worlds, name);
  for (uint32_t v = 0; v < worlds.scene->n_views; v++) {
    struct hsr_view view;
    struct hsr_camera camera = worlds.scene->views[v];
    struct hsr_error err;
    for (int parallel = 0; parallel < 2; parallel++) {
      if (parallel) {
        double apart = 0;
        for (int k = 0; k < 3; k++)
          apart +=
              (camera.at[k] - camera.eye[k]) * (camera.at[k] - camera.eye[k]);
        camera.parallel = 0.5 * sqrt(apart);
      }
      if (!hsr_view_init(&view, &camera, M, N, &err))
        check_view(&worlds.world, &view, name, &found);
    }
  }
  ok(t, found.views && !found.differing && !found.refused && !found.astray,
     "%s: the oracle's ids in %ld views; %ld corners are not in their planes",
     name, found.views, found.astray);
  ok(t, !found.never && found.times >= found.polygons,
     "%s: %ld polygons, each considered, %.1f times in the mean", name,
     found.polygons,
     found.polygons ? (double)found.times / (double)found.polygons : 0);
  ok(t, !found.unlike,
     "%s: the same without the sort, divided otherwise in %ld views; a region "
     "that is missing is found",
     name, found.divided);
  close_worlds(&worlds);
  examined[0] += found.examined[0];
  examined[1] += found.examined[1];
}

int main(int argc, char **argv) {
  int n = argc - 1;
  while (argc == 1 && standard[n])
    n++;
  struct tap t = plan(3 * n + 1);
  for (int k = 0; k < n; k++)
    check_scene(&t, argc > 1 ? argv[1 + k] : standard[k]);
  ok(&t, examined[0] < examined[1], "sorted, %ld examinations; not sorted, %ld",
     examined[0], examined[1]);
  return finish(&t);
}
