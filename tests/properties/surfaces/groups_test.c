/* SPDX-License-Identifier: GPL-3.0-or-later */
/* zbuffer-fast:groups=cones draws what zbuffer-fast draws, and leaves out
 * nothing that exists.
 *
 * Wedges      two triangles that meet in an edge. The eye is moved from where
 *             both turn away to where one does not, along the plane where the
 *             cone leaves no room, until two neighbouring numbers are between
 *             them.
 * Eyes        far away, close to the surface, at vertices, so that it is in the
 *             planes of all triangles around, and in the plane of one; parallel
 *             projection along edges. What turns away with its group is asked
 *             for the side of the eye exactly.
 * Pictures    of real meshes and spheres, in whole and in windows of two
 *             threads.
 * Counts      the same triangles are tiled; and of a sphere about half of all
 *             are left out. */
#include "algorithms/brute_force/zbuffer_fast/groups.h"
#include "bench/modules/variant.h"
#include "common/exact/predicates.h"
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A scene, and its groups. */
struct mesh {
  struct hsr_scene *scene;
  struct hsr_world world;
  struct hsr_groups groups;
  int *verdict;
};

static void open_mesh(struct mesh *m, struct hsr_scene *scene) {
  struct hsr_error err = {.text = "out of memory"};
  m->scene = scene;
  must_world(&m->world, scene);
  if (hsr_groups_make(&m->groups, &m->world))
    bail("%s: %s", scene->name, err.text);
  m->verdict = malloc(m->groups.n * sizeof *m->verdict);
  if (!m->verdict)
    bail("%s: out of memory", scene->name);
}

static void open_named(struct mesh *m, const char *name) {
  struct hsr_scene *scene = must_open(name);
  open_mesh(m, scene);
}

static void close_mesh(struct mesh *m) {
  free(m->verdict);
  hsr_groups_free(&m->groups);
  hsr_world_free(&m->world);
  hsr_scene_delete(m->scene);
}

static double draw_unit(uint64_t *seed) {
  return (double)draw_integer(seed, -1000000, 1000000) / 1e6;
}

/* --- What turns away ------------------------------------------------------ */

/* The triangles of group g that are left out although they exist. */
static long count_wrong_in(const struct mesh *m, const struct hsr_view *view,
                           uint32_t g) {
  long wrong = 0;
  bool out_of_memory = false;
  for (uint32_t k = m->groups.first[g]; k < m->groups.first[g + 1]; k++) {
    uint32_t f = m->groups.list.face[k];
    wrong += !m->world.mesh.one_sided[f] ||
             hsr_exact_eye_side(view, hsr_face_loop(&m->world, f),
                                &out_of_memory) > 0;
  }
  return wrong + out_of_memory;
}

/* The same of all groups that turn away, whose number is added to *away. */
static long count_wrong(const struct mesh *m, const struct hsr_view *view,
                        long *away) {
  long wrong = 0;
  hsr_groups_look(&m->groups, view, m->verdict);
  for (uint32_t g = 0; g < m->groups.n; g++)
    if (m->verdict[g] == HSR_GROUP_AWAY) {
      ++*away;
      wrong += count_wrong_in(m, view, g);
    }
  return wrong;
}

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void normalise(double a[3]) {
  double length = sqrt(dot(a, a));
  for (int k = 0; k < 3; k++)
    a[k] /= length;
}

/* --- Wedges --------------------------------------------------------------- */

/* Two triangles with one edge, their normals by less than a right angle apart.
 */
static struct hsr_scene *wedge(uint64_t *seed) {
  struct hsr_scene *scene = hsr_scene_new("wedge");
  struct hsr_object *object = scene ? hsr_scene_object(scene, "wedge") : NULL;
  struct hsr_error err = {.text = "out of memory"};
  double angle = 0.05 + 0.7 * fabs(draw_unit(seed));
  const double corner[4][3] = {
      {draw_unit(seed), -3, 0.01 * draw_unit(seed)},
      {draw_unit(seed), 3, 0.01 * draw_unit(seed)},
      {-5 * cos(angle), draw_unit(seed), -5 * sin(angle)},
      {5 * cos(angle), draw_unit(seed), -5 * sin(angle)}};
  double turn = 3 * draw_unit(seed), at = 100 * draw_unit(seed);
  double c = cos(turn), s = sin(turn);
  if (!object)
    bail("wedge: %s", err.text);
  object->one_sided = true;
  for (int k = 0; k < 4; k++)
    hsr_object_vertex(object, c * corner[k][0] - s * corner[k][1] + at,
                      s * corner[k][0] + c * corner[k][1], corner[k][2], NULL);
  if (hsr_object_face(object, (uint32_t[]){0, 1, 2}, 3, NULL) ||
      hsr_object_face(object, (uint32_t[]){1, 0, 3}, 3, NULL))
    bail("wedge: %s", err.text);
  must_finish(scene);
  return scene;
}

/* Does the wedge turn away from an eye? *wrong counts when it must not. */
static bool is_away(const struct mesh *m, const double eye[3], bool parallel,
                    long *wrong) {
  struct hsr_view view;
  struct hsr_camera camera = {.up = {0.3, 0.5, 0.7}, .fov = 40};
  for (int k = 0; k < 3; k++) {
    camera.eye[k] = parallel ? 0 : eye[k];
    camera.at[k] = parallel ? eye[k] : eye[k] + (k == 0);
  }
  camera.parallel = parallel ? 10 : 0;
  must_view(&view, &camera, 8, 8);
  hsr_groups_look(&m->groups, &view, m->verdict);
  if (m->verdict[0] != HSR_GROUP_AWAY)
    return false;
  *wrong += count_wrong_in(m, &view, 0);
  return true;
}

/* Looks for the border between `in`, where the wedge turns away, and `out`. */
static bool find_border(const struct mesh *m, double in[3], double out[3],
                        bool parallel, long *wrong) {
  if (!is_away(m, in, parallel, wrong) || is_away(m, out, parallel, wrong))
    return false;
  for (int step = 0; step < 70; step++) {
    double middle[3];
    for (int k = 0; k < 3; k++)
      middle[k] = in[k] / 2 + out[k] / 2;
    bool away = is_away(m, middle, parallel, wrong);
    memcpy(away ? in : out, middle, sizeof middle);
  }
  return true;
}

static void test_wedges(struct tap *tap) {
  uint64_t seed = 1;
  long wrong = 0, borders = 0;
  enum { WEDGES = 400 };
  for (int w = 0; w < WEDGES; w++) {
    struct mesh m;
    open_mesh(&m, wedge(&seed));
    const struct hsr_mesh *mesh = &m.world.mesh;
    int f = w % 2;
    bool parallel = w / 2 % 2;
    double n[3] = {mesh->nx[f], mesh->ny[f], mesh->nz[f]},
           other[3] = {mesh->nx[!f], mesh->ny[!f], mesh->nz[!f]}, in[3], out[3];
    normalise(n);
    normalise(other);
    double along = dot(n, other), reach = 1 + 20 * fabs(draw_unit(&seed));
    for (int k = 0; k < 3; k++) { /* in the plane of f, and behind the other */
      double d = (other[k] - along * n[k]) * reach,
             from = parallel ? -d : m.groups.apex[k][0] - d;
      in[k] = parallel ? d + 0.5 * n[k] : from - 0.5 * n[k];
      out[k] = parallel ? d - 0.5 * n[k] : from + 0.5 * n[k];
    }
    borders += find_border(&m, in, out, parallel, &wrong);
    close_mesh(&m);
  }
  ok(tap, !wrong && borders > WEDGES * 9 / 10,
     "%ld borders of wedges: %ld triangles left out that exist", borders,
     wrong);
}

/* --- Eyes ----------------------------------------------------------------- */

/* One of four ways to place the eye, by k; half of all are parallel. */
static struct hsr_camera place_camera(const struct mesh *m, int k,
                                      uint64_t *seed) {
  const struct hsr_mesh *mesh = &m->world.mesh;
  const struct hsr_box *box = &m->groups.bounds;
  uint32_t f = (uint32_t)draw_integer(seed, 0, m->world.n_faces - 1);
  const uint32_t *v = mesh->vertex + mesh->start[f];
  const double *const at[3] = {mesh->x, mesh->y, mesh->z};
  double n[3] = {mesh->nx[f], mesh->ny[f], mesh->nz[f]}, size = 0;
  double aside = 1.5 * draw_unit(seed), more = 1.5 * draw_unit(seed);
  double off = ldexp(draw_unit(seed), -(int)draw_integer(seed, 1, 30));
  struct hsr_camera camera = {.fov = 70, .near = k % 3 ? 0 : 1e-4};
  normalise(n);
  for (int a = 0; a < 3; a++)
    size = fmax(size, box->hi[a] - box->lo[a]);
  for (int a = 0; a < 3; a++) {
    double p = at[a][v[0]], q = at[a][v[1]] - p, r = at[a][v[2]] - p;
    double middle = box->lo[a] / 2 + box->hi[a] / 2;
    camera.up[a] = 0.1 + fabs(draw_unit(seed));
    camera.eye[a] = k % 4 == 0   ? middle + 2 * size * draw_unit(seed)
                    : k % 4 == 1 ? p + (q + r) / 3 + off * size * n[a]
                    : k % 4 == 2 ? p
                                 : p + aside * q + more * r;
    camera.at[a] = k % 4 == 0 ? middle : camera.eye[a] + draw_unit(seed);
    if (k / 4 % 2) /* along an edge, or anywhere */
      camera.at[a] = camera.eye[a] + (k % 4 == 2 ? q : draw_unit(seed));
  }
  camera.parallel = k / 4 % 2 ? size * fabs(draw_unit(seed)) + size / 64 : 0;
  return camera;
}

static void test_eyes(struct tap *tap, const char *name, int eyes) {
  struct mesh m;
  struct hsr_error err;
  uint64_t seed = 7;
  long wrong = 0, away = 0;
  open_named(&m, name);
  for (int k = 0; k < eyes; k++) {
    struct hsr_camera camera = place_camera(&m, k, &seed);
    struct hsr_view view;
    if (hsr_view_init(&view, &camera, 64, 48, &err))
      continue; /* up along the view */
    wrong += count_wrong(&m, &view, &away);
  }
  ok(tap, !wrong && away,
     "%s: %d eyes, %ld groups away, %ld triangles left out that exist", name,
     eyes, away, wrong);
  close_mesh(&m);
}

/* --- Pictures ------------------------------------------------------------- */

/* A picture of so many samples, by both: the samples that differ. */
static long compare_pictures(const struct mesh *m,
                             const struct hsr_setup *setup,
                             const struct hsr_camera *camera, int width,
                             int height) {
  struct hsr_view view;
  struct hsr_error err;
  size_t n = (size_t)width * (size_t)height;
  uint32_t *right = malloc(n * sizeof *right), *ids = malloc(n * sizeof *ids);
  long differ = 0;
  if (!right || !ids)
    bail("pictures: out of memory");
  if (!hsr_view_init(&view, camera, width, height, &err)) {
    draw_plain("zbuffer-fast", &m->world, &view, right);
    draw_in_windows(setup, &view, 1 << 14, 1, ids);
    differ += count_differences(&view, ids, right);
    draw_in_windows(setup, &view, width / 3 + 1, 2, ids);
    differ += count_differences(&view, ids, right);
  }
  free(right);
  free(ids);
  return differ;
}

static struct hsr_variant parse(const char *text) {
  struct hsr_variant variant;
  struct hsr_error err;
  if (hsr_variant_parse(text, &variant, &err))
    bail("%s: %s", text, err.text);
  return variant;
}

static void test_pictures(struct tap *tap, const char *name, int pictures,
                          bool large) {
  static const int sizes[3][2] = {{61, 47}, {320, 200}, {1040, 1030}};
  struct mesh m;
  struct hsr_setup setup;
  struct hsr_variant with = parse("zbuffer-fast:groups=cones");
  uint64_t seed = 11;
  long differ = 0;
  open_named(&m, name);
  must_setup(&setup, with.listed->plain, &with.choice, &m.world);
  for (int k = 0; k < pictures; k++) {
    struct hsr_camera camera =
        k < 2 ? m.scene->views[(uint32_t)k % m.scene->n_views]
              : place_camera(&m, k, &seed);
    const int *size = sizes[large && k % 4 == 0 ? 2 : k % 2];
    long bad = compare_pictures(&m, &setup, &camera, size[0], size[1]);
    if (bad)
      printf("# %s, picture %d: %ld samples differ\n", name, k, bad);
    differ += bad;
  }
  ok(tap, !differ, "%s: %d pictures, %ld samples differ", name, pictures,
     differ);
  hsr_setup_free(&setup);
  close_mesh(&m);
}

/* --- Counts --------------------------------------------------------------- */

static uint64_t count_of(const struct hsr_algorithm *a,
                         const struct hsr_tally *tally, const char *name) {
  for (int k = 0; a->counters[k].name; k++)
    if (!strcmp(a->counters[k].name, name))
      return tally->count[k];
  bail("%s: %s", a->name, name);
  return 0;
}

static void count(const struct mesh *m, const struct hsr_variant *variant,
                  const struct hsr_view *view, struct hsr_tally *tally) {
  struct hsr_answer answer;
  *tally = (struct hsr_tally){.trace = NULL};
  if (!draw_chosen(variant->listed->counting, &variant->choice, &m->world, view,
                   &answer, tally))
    bail("%s: it was refused", variant->name);
  hsr_answer_free(&answer);
}

static void test_counts(struct tap *tap) {
  static const char *const same[] = {"fast triangles", "general faces",
                                     "depth tests", "unsure covers"};
  struct mesh m;
  struct hsr_view view;
  struct hsr_tally with, without;
  struct hsr_variant cones = parse("zbuffer-fast:groups=cones"),
                     none = parse("zbuffer-fast");
  const struct hsr_algorithm *a = none.listed->counting;
  open_named(&m, "sphere:40000");
  must_view(&view, &m.scene->views[0], 200, 150);
  view.window = (struct hsr_window){0, 0, 200, 60};
  count(&m, &cones, &view, &with);
  count(&m, &none, &view, &without);
  int alike = 0;
  for (int k = 0; k < 4; k++) {
    uint64_t one = count_of(a, &with, same[k]),
             other = count_of(a, &without, same[k]);
    printf("# %s: %lu, without groups %lu\n", same[k], (unsigned long)one,
           (unsigned long)other);
    alike += one == other;
  }
  ok(tap, alike == 4 && count_of(a, &with, "fast triangles") > 3000,
     "a sphere: the same triangles are tiled");
  uint64_t tested = count_of(a, &with, "groups tested"),
           away = count_of(a, &with, "groups away"),
           out = count_of(a, &with, "groups out"),
           left = count_of(a, &with, "triangles left out"), in = 0;
  hsr_groups_look(&m.groups, &view, m.verdict);
  for (uint32_t g = 0; g < m.groups.n; g++)
    if (m.verdict[g] != HSR_GROUP_KEPT)
      in += m.groups.first[g + 1] - m.groups.first[g];
  ok(tap,
     tested == m.groups.n && left == in && away > tested * 45 / 100 &&
         out > tested / 10 && left > m.world.n_faces * 3 / 5,
     "a sphere: %lu groups, %lu away, %lu out, %lu triangles left out",
     (unsigned long)tested, (unsigned long)away, (unsigned long)out,
     (unsigned long)left);
  close_mesh(&m);
}

int main(void) {
  static const char *const meshes[] = {
      "mesh:elephant", "mesh:cow",      "mesh:anchor_dense", "mesh:lion-head",
      "mesh:camel",    "mesh:bull",     "mesh:fandisk",      "mesh:knot1",
      "sphere:3000",   "sphere:100000", "lattice:60:2",      "soup:500:3"};
  enum { N = sizeof meshes / sizeof *meshes };
  struct tap tap = plan(1 + 4 + N + 2 + 2);
  test_wedges(&tap);
  test_eyes(&tap, "sphere:3000", 64);
  test_eyes(&tap, "mesh:elephant", 64);
  test_eyes(&tap, "mesh:fandisk", 64);
  test_eyes(&tap, "sphere:800000", 4);
  for (int k = 0; k < N; k++)
    test_pictures(&tap, meshes[k], 10, k % 4 == 0);
  test_pictures(&tap, "mesh:refined_elephant", 3, true);
  test_pictures(&tap, "sphere:800000", 1, true);
  test_counts(&tap);
  return finish(&tap);
}
