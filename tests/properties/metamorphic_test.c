/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Changes of a scene that must not change its picture, or must change it in a
 * known way: for every algorithm, without the oracle.
 *
 * usage: metamorphic_test [SCENES], of each change. The standard is 15. */
#include "common/exact/predicates.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { M = 40, N = 33, MOST_FACES = 200, MOST_CORNERS = 1000 };

/* A small scene in plain arrays, easy to change. Face f has the corners from
 * start[f] up to start[f+1] in corner[]; each corner has its own point. */
struct toy {
  int n_faces, start[MOST_FACES + 1];
  double corner[MOST_CORNERS][3];
  int parent[MOST_FACES]; /* the face of the unchanged scene */
  bool one_sided;
  struct hsr_camera camera;
};

static int toy_size(const struct toy *toy, int f) {
  return toy->start[f + 1] - toy->start[f];
}

/* Appends a face of n corners; false, and no face, if it has no area. */
static bool toy_add(struct toy *toy, double (*corner)[3], int n, int parent) {
  static const uint32_t number[] = {0, 1, 2, 3, 4, 5, 6, 7};
  struct hsr_loop loop = {corner[0], corner[0] + 1, corner[0] + 2,
                          3,         number,        (uint32_t)n};
  bool out_of_memory = false;
  if (!hsr_exact_has_normal(loop, &out_of_memory))
    return false;
  int at = toy->start[toy->n_faces];
  memcpy(toy->corner[at], corner, (size_t)n * sizeof toy->corner[0]);
  toy->parent[toy->n_faces] = parent;
  toy->start[++toy->n_faces] = at + n;
  return true;
}

/* Triangles and parallelograms, exactly planar, on small integers; or, if
 * `generic`, triangles of arbitrary doubles. */
static struct toy toy_make(uint64_t *seed, bool generic) {
  struct toy toy = {.n_faces = 0};
  int wanted = (int)draw_integer(seed, 4, 30);
  toy.one_sided = !draw_integer(seed, 0, 2);
  while (toy.n_faces < wanted) {
    double c[4][3];
    for (int i = 0; i < 3; i++)
      for (int k = 0; k < 3; k++)
        c[i][k] = generic ? (double)draw_integer(seed, -1000000, 1000000) / 3e5
                          : (double)draw_integer(seed, -4, 4);
    for (int k = 0; k < 3; k++)
      c[3][k] = c[0][k] + c[2][k] - c[1][k];
    toy_add(&toy, c, generic ? 3 : (int)draw_integer(seed, 3, 4), toy.n_faces);
  }
  toy.camera = (struct hsr_camera){.eye = {(double)draw_integer(seed, -2, 2),
                                           (double)draw_integer(seed, -2, 2),
                                           (double)draw_integer(seed, 2, 6)},
                                   .up = {0, 1, 0},
                                   .fov = draw_integer(seed, 0, 2) ? 90 : 60,
                                   .near = draw_integer(seed, 0, 2) ? 0 : 0.5};
  memcpy(toy.camera.at, toy.camera.eye, sizeof toy.camera.at);
  toy.camera.at[2] -= 2;
  if (generic)
    toy.camera.at[0] += 0.37;
  return toy;
}

static void toy_draw(const struct hsr_algorithm *algorithm,
                     const struct toy *toy, uint32_t *ids, uint32_t *planes) {
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_scene *scene = hsr_scene_new("toy");
  struct hsr_object *object = hsr_scene_object(scene, "toy");
  object->one_sided = toy->one_sided;
  for (int c = 0; c < toy->start[toy->n_faces]; c++)
    hsr_object_vertex(object, toy->corner[c][0], toy->corner[c][1],
                      toy->corner[c][2], NULL);
  for (int f = 0; f < toy->n_faces; f++) {
    uint32_t vertex[8];
    for (int k = 0; k < toy_size(toy, f); k++)
      vertex[k] = (uint32_t)(toy->start[f] + k);
    hsr_object_face(object, vertex, (size_t)toy_size(toy, f), NULL);
  }
  struct hsr_world world;
  struct hsr_view view;
  if (hsr_scene_view(scene, &toy->camera))
    bail("%s", err.text);
  must_finish(scene);
  must_world(&world, scene);
  must_view(&view, &toy->camera, M, N);
  draw_ids(algorithm, &world, &view, ids, NULL);
  for (int f = 0; planes && f < toy->n_faces; f++)
    planes[f] = world.mesh.plane[f];
  hsr_world_free(&world);
  hsr_scene_delete(scene);
}

/* --- The changes ---------------------------------------------------------- */

/* Each function makes `to` from `from`, and does not change `from`. */

static void permute(uint64_t *seed, const struct toy *from, struct toy *to) {
  int order[MOST_FACES];
  for (int f = 0; f < from->n_faces; f++)
    order[f] = f;
  for (int f = from->n_faces - 1; f > 0; f--) {
    int g = (int)draw_integer(seed, 0, f), kept = order[f];
    order[f] = order[g];
    order[g] = kept;
  }
  *to = *from;
  to->n_faces = 0;
  for (int f = 0; f < from->n_faces; f++) {
    double corner[8][3];
    int g = order[f], n = toy_size(from, g);
    memcpy(corner, from->corner[from->start[g]], (size_t)n * sizeof corner[0]);
    toy_add(to, corner, n, g);
  }
}

static void rotate(uint64_t *seed, const struct toy *from, struct toy *to) {
  *to = *from;
  for (int f = 0; f < from->n_faces; f++) {
    int n = toy_size(from, f), by = (int)draw_integer(seed, 0, n - 1);
    for (int k = 0; k < n; k++)
      memcpy(to->corner[from->start[f] + k],
             from->corner[from->start[f] + (k + by) % n], sizeof to->corner[0]);
  }
}

/* Winding does not matter where faces are two-sided. */
static void reverse(uint64_t *seed, const struct toy *from, struct toy *to) {
  (void)seed;
  *to = *from;
  for (int f = 0; f < from->n_faces && !from->one_sided; f++)
    for (int k = 0, n = toy_size(from, f); k < n; k++)
      memcpy(to->corner[from->start[f] + k],
             from->corner[from->start[f] + n - 1 - k], sizeof to->corner[0]);
}

/* point = factor * point + by, for faces and camera. */
static void move(struct toy *toy, double factor, const double by[3]) {
  for (int k = 0; k < 3; k++) {
    for (int c = 0; c < toy->start[toy->n_faces]; c++)
      toy->corner[c][k] = factor * toy->corner[c][k] + by[k];
    toy->camera.eye[k] = factor * toy->camera.eye[k] + by[k];
    toy->camera.at[k] = factor * toy->camera.at[k] + by[k];
  }
  toy->camera.near *= factor;
}

static void translate(uint64_t *seed, const struct toy *from, struct toy *to) {
  *to = *from;
  double by[3];
  for (int k = 0; k < 3; k++)
    by[k] = (double)draw_integer(seed, -1000, 1000);
  move(to, 1, by);
}

static void scale(uint64_t *seed, const struct toy *from, struct toy *to) {
  *to = *from;
  move(to, ldexp(1, (int)draw_integer(seed, -20, 20)), (double[3]){0, 0, 0});
}

/* Mirrored in x, wound the other way round: the picture is mirrored. */
static void mirror(uint64_t *seed, const struct toy *from, struct toy *to) {
  (void)seed;
  *to = *from;
  for (int f = 0; f < from->n_faces; f++)
    for (int k = 0, n = toy_size(from, f); k < n; k++) {
      double *corner = to->corner[from->start[f] + k];
      memcpy(corner, from->corner[from->start[f] + n - 1 - k],
             sizeof to->corner[0]);
      corner[0] = -corner[0];
    }
  to->camera.eye[0] = -to->camera.eye[0];
  to->camera.at[0] = -to->camera.at[0];
}

/* Divides every face at the midpoint of its first side, an exact point. */
static void divide(uint64_t *seed, const struct toy *from, struct toy *to) {
  (void)seed;
  *to = *from;
  to->n_faces = 0;
  for (int f = 0; f < from->n_faces; f++) {
    const double(*c)[3] = &from->corner[from->start[f]];
    int n = toy_size(from, f);
    for (int k = 1; k < n; k++) {
      double part[3][3];
      for (int x = 0; x < 3; x++) {
        part[0][x] = (c[0][x] + c[1][x]) / 2;
        part[1][x] = c[k][x];
        part[2][x] = c[(k + 1) % n][x];
      }
      toy_add(to, part, 3, f);
    }
  }
}

/* Adds the image of a face at twice the distance from the eye: the face hides
 * it. */
static void add_hidden(uint64_t *seed, const struct toy *from, struct toy *to) {
  *to = *from;
  int f = (int)draw_integer(seed, 0, from->n_faces - 1), n = toy_size(from, f);
  double corner[8][3];
  for (int k = 0; k < n; k++)
    for (int x = 0; x < 3; x++)
      corner[k][x] =
          2 * from->corner[from->start[f] + k][x] - from->camera.eye[x];
  /* With near > 0 the original may not exist while its image does. */
  to->camera.near = 0;
  toy_add(to, corner, n, MOST_FACES);
}

/* --- The comparison ------------------------------------------------------- */

struct property {
  const char *name;
  void (*change)(uint64_t *seed, const struct toy *from, struct toy *to);
  bool generic;  /* on scenes without ties */
  bool by_plane; /* faces of one plane count as equal */
  bool mirrored;
  bool no_near;
};

static const struct property properties[] = {
    {"faces permuted", permute, .by_plane = true},
    {"corners rotated", rotate, .by_plane = false},
    {"winding reversed", reverse, .by_plane = false},
    {"translated by integers", translate, .by_plane = false},
    {"scaled by a power of two", scale, .by_plane = false},
    {"mirrored", mirror, .generic = true, .mirrored = true},
    {"faces divided at exact points", divide, .by_plane = false},
    {"a hidden face added", add_hidden, .no_near = true}};
enum { N_PROPERTIES = sizeof properties / sizeof properties[0] };

struct trial {
  const struct property *property;
  const struct toy *from, *to;
  long differences, visible;
};

static void try_algorithm(const struct hsr_algorithm *algorithm,
                          void *context) {
  static uint32_t before[M * N], after[M * N], planes[MOST_FACES];
  struct trial *trial = context;
  toy_draw(algorithm, trial->from, before, planes);
  toy_draw(algorithm, trial->to, after, NULL);
  for (int k = 0; k < M * N; k++) {
    int image = trial->property->mirrored ? k / M * M + M - 1 - k % M : k;
    uint32_t a = before[k], b = after[image];
    trial->visible += a != HSR_BACKGROUND;
    if (b != HSR_BACKGROUND)
      b = (uint32_t)trial->to->parent[b];
    bool same = a == b;
    if (!same && trial->property->by_plane && a < MOST_FACES && b < MOST_FACES)
      same = planes[a] == planes[b];
    trial->differences += !same;
  }
}

int main(int argc, char **argv) {
  const long scenes = argc > 1 ? atol(argv[1]) : 15;
  struct tap tap = plan(N_PROPERTIES);
  uint64_t seed = 20;
  for (int p = 0; p < N_PROPERTIES; p++) {
    struct trial trial = {.property = &properties[p]};
    for (long k = 0; k < scenes; k++) {
      struct toy from = toy_make(&seed, properties[p].generic), to;
      if (properties[p].no_near)
        from.camera.near = 0;
      properties[p].change(&seed, &from, &to);
      trial.from = &from;
      trial.to = &to;
      for_each_judged(try_algorithm, &trial);
    }
    ok(&tap, trial.differences == 0 && trial.visible > 0,
       "%s: %ld differences in %ld visible samples", properties[p].name,
       trial.differences, trial.visible);
  }
  return finish(&tap);
}
