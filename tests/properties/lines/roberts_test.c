/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What Sutherland et al. 1974 say about Roberts' algorithm:
 *
 * Outcomes    An edge/volume test has one of four outcomes: the edge is wholly
 *             hidden, or not hidden at all, or one piece of it is left, or two
 *             are. Only the last outcome adds a fragment.
 * Convex      A single convex solid takes no test for the edges that it shows,
 *             and one for each edge behind it.
 * Concave     A concave solid is divided into convex ones. The walls in between
 *             draw nothing. The drawing equals that of an algorithm without
 *             volumes.
 * Union       An edge is hidden where several volumes together hide it.
 * Solids      Random cubes of a lattice, seen from eyes for which edges, planes
 *             and the eye coincide.
 */
#include "bench/modules/modules.h"
#include "common/answers/kinds/segments.h"
#include "common/lines/volumes.h"
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <stdlib.h>
#include <string.h>

enum { M = 97, N = 61 };

/* --- Drawings ------------------------------------------------------------- */

struct fixture {
  struct hsr_scene *scene;
  struct hsr_world world;
  struct hsr_setup roberts, appel, oracle;
  struct hsr_drawing got, wanted;
  struct hsr_arena scratch;
  uint32_t n_solids, n_parts, n_convex;
};

static void setup(struct hsr_setup *setup, const struct hsr_world *world,
                  const char *name, bool counting) {
  const struct hsr_listed *listed = hsr_algorithm_find(name);
  must_setup(setup, counting ? listed->counting : listed->plain, NULL, world);
}

static void prepare(struct fixture *x, struct hsr_scene *scene) {
  struct hsr_error err = {.text = ""};
  struct hsr_edges edges;
  struct hsr_volumes volumes;
  *x = (struct fixture){.scene = scene, .scratch = HSR_ARENA_EMPTY};
  must_world(&x->world, scene);
  if (hsr_edges_init(&edges, &x->world, &err) ||
      hsr_volumes_init(&volumes, &edges, &err))
    bail("%s", err.text);
  x->n_solids = volumes.n_solids;
  x->n_convex = volumes.n_convex;
  x->n_parts = volumes.n_parts;
  hsr_volumes_free(&volumes);
  hsr_edges_free(&edges);
  setup(&x->roberts, &x->world, "roberts", true);
  setup(&x->appel, &x->world, "appel-visible", false);
  setup(&x->oracle, &x->world, "line-oracle", false);
}

static void release(struct fixture *x) {
  hsr_setup_free(&x->oracle);
  hsr_setup_free(&x->appel);
  hsr_setup_free(&x->roberts);
  hsr_world_free(&x->world);
  hsr_scene_delete(x->scene);
  hsr_drawing_free(&x->got);
  hsr_drawing_free(&x->wanted);
  hsr_arena_free(&x->scratch);
}

static void draw(struct fixture *x, const struct hsr_setup *setup,
                 const struct hsr_view *view, struct hsr_drawing *drawing,
                 struct hsr_tally *tally) {
  struct hsr_error err = {.text = ""};
  struct hsr_answer answer = hsr_answer_of_drawing(drawing, view->m, view->n);
  struct hsr_job job = {
      .view = view, .scratch = &x->scratch, .tally = tally, .answer = &answer};
  hsr_arena_reset(&x->scratch);
  hsr_drawing_clear(drawing);
  if (hsr_setup_render(setup, &job, &err))
    bail("%s", err.text);
}

/* Draws a view by Roberts, and adds its counts to *tally. */
static void draw_view(struct fixture *x, const struct hsr_camera *camera,
                      struct hsr_view *view, struct hsr_tally *tally) {
  must_view(view, camera, M, N);
  draw(x, &x->roberts, view, &x->got, tally);
}

/* The number of edges of the last drawing that are wrong. */
static uint64_t differing(struct fixture *x, const struct hsr_setup *judge,
                          const struct hsr_view *view) {
  struct hsr_tally ignored = {.out_of_memory = false};
  struct hsr_drawing_difference difference;
  draw(x, judge, view, &x->wanted, &ignored);
  hsr_drawing_compare(&x->got, &x->wanted, true, &difference);
  return difference.differing;
}

static uint64_t of(const struct hsr_tally *tally, const char *name) {
  return counted(hsr_algorithm_find("roberts")->counting, tally, name);
}

static uint64_t edges_drawn(const struct hsr_drawing *drawing) {
  uint64_t n = 0;
  for (size_t k = 0; k < drawing->n; k++)
    n += !k || hsr_edge_name_compare(&drawing->segment[k - 1].edge,
                                     &drawing->segment[k].edge);
  return n;
}

static struct hsr_camera camera_at(double x, double y, double z) {
  return (struct hsr_camera){
      .eye = {x, y, z}, .at = {1, 1, 1}, .up = {0, 0, 1}, .fov = 60};
}

/* --- Solids --------------------------------------------------------------- */

/* Unit cubes of a lattice, SIDE of them a side; their surface, in squares. */
enum { SIDE = 4 };
struct cubes {
  bool is[SIDE][SIDE][SIDE];
};

static bool has(const struct cubes *cubes, const int c[3]) {
  for (int k = 0; k < 3; k++)
    if (c[k] < 0 || c[k] >= SIDE)
      return false;
  return cubes->is[c[0]][c[1]][c[2]];
}

/* The square between a cube and the next one along an axis, seen from there. */
static void add_square(struct hsr_object *object, uint32_t *number,
                       const int c[3], int axis, int way) {
  uint32_t corner[4];
  int u = (axis + 1) % 3, v = (axis + 2) % 3;
  for (int k = 0; k < 4; k++) {
    int p[3] = {c[0], c[1], c[2]};
    p[axis] += way > 0;
    p[u] += k == 1 || k == 2;
    p[v] += k >= 2;
    uint32_t *at = &number[(p[0] * (SIDE + 1) + p[1]) * (SIDE + 1) + p[2]];
    if (*at == UINT32_MAX)
      hsr_object_vertex(object, p[0], p[1], p[2], at);
    corner[way > 0 ? k : 3 - k] = *at;
  }
  hsr_object_face(object, corner, 4, NULL);
}

static void add_cubes(struct hsr_scene *scene, const struct cubes *cubes,
                      bool one_sided) {
  uint32_t number[(SIDE + 1) * (SIDE + 1) * (SIDE + 1)];
  memset(number, 0xff, sizeof number);
  struct hsr_object *object = hsr_scene_object(scene, "cubes");
  object->one_sided = one_sided;
  int c[3];
  for (c[0] = 0; c[0] < SIDE; c[0]++)
    for (c[1] = 0; c[1] < SIDE; c[1]++)
      for (c[2] = 0; c[2] < SIDE; c[2]++)
        for (int k = 0; k < 6 && has(cubes, c); k++) {
          int way = k % 2 ? 1 : -1;
          int beyond[3] = {c[0], c[1], c[2]};
          beyond[k / 2] += way;
          if (!has(cubes, beyond))
            add_square(object, number, c, k / 2, way);
        }
}

static struct hsr_scene *finished(struct hsr_scene *scene) {
  must_finish(scene);
  return scene;
}

/* A prism over a polygon; its bottom and its top are one face each. */
static void add_prism(struct hsr_scene *scene, const double (*at)[2],
                      uint32_t n, bool one_sided) {
  struct hsr_object *object = hsr_scene_object(scene, "prism");
  uint32_t bottom[16], top[16];
  object->one_sided = one_sided;
  for (uint32_t k = 0; k < n; k++) {
    hsr_object_vertex(object, at[k][0], at[k][1], 0, NULL);
    hsr_object_vertex(object, at[k][0], at[k][1], 1, NULL);
    top[k] = 2 * k + 1;
    bottom[n - 1 - k] = 2 * k;
  }
  hsr_object_face(object, bottom, n, NULL);
  hsr_object_face(object, top, n, NULL);
  for (uint32_t k = 0; k < n; k++) {
    uint32_t l = (k + 1) % n;
    uint32_t wall[4] = {2 * k, 2 * l, 2 * l + 1, 2 * k + 1};
    hsr_object_face(object, wall, 4, NULL);
  }
}

/* --- The claims ----------------------------------------------------------- */

static void try_outcomes(struct tap *t) {
  static const char *const scenes[] = {"house", "color-cube:4", "penetration",
                                       "soup:200:1", "near-plane"};
  uint64_t drawn = 0;
  struct hsr_tally tally = {.out_of_memory = false};
  for (size_t s = 0; s < sizeof scenes / sizeof *scenes; s++) {
    struct fixture x;
    struct hsr_view view;
    struct hsr_scene *scene = must_open(scenes[s]);
    prepare(&x, scene);
    for (uint32_t v = 0; v < scene->n_views; v++) {
      draw_view(&x, &scene->views[v], &view, &tally);
      drawn += edges_drawn(&x.got);
    }
    release(&x);
  }
  uint64_t whole = of(&tally, "hidden whole"),
           untouched = of(&tally, "untouched"),
           one = of(&tally, "one piece left"),
           two = of(&tally, "two pieces left");
  ok(t,
     whole && untouched && one && two &&
         whole + untouched + one + two == of(&tally, "edge/volume test"),
     "a test has one of four outcomes: %llu, %llu, %llu, %llu",
     (unsigned long long)whole, (unsigned long long)untouched,
     (unsigned long long)one, (unsigned long long)two);
  ok(t, of(&tally, "fragments") == drawn + two,
     "every edge is a fragment, and two pieces are one more");
}

static void try_convex(struct tap *t) {
  for (int kind = 0; kind < 3; kind++) {
    static const double mirror[12] = {-1, 0, 0, 3, 0, 1, 0, 0, 0, 0, 1, 0};
    bool one_sided = kind == 1;
    struct cubes cubes = {{{{false}}}};
    cubes.is[1][1][1] = true;
    struct hsr_scene *scene = hsr_scene_new("cube");
    add_cubes(scene, &cubes, one_sided);
    if (kind == 2)
      hsr_scene_instance(scene, 0, mirror);
    struct fixture x;
    struct hsr_view view;
    struct hsr_tally tally = {.out_of_memory = false};
    prepare(&x, finished(scene));
    struct hsr_camera camera = camera_at(7, 6, 5);
    draw_view(&x, &camera, &view, &tally);
    ok(t,
       of(&tally, "edge/volume test") == (one_sided ? 0 : 3) &&
           of(&tally, "hidden whole") == (one_sided ? 0 : 3) &&
           of(&tally, "own volumes") == 9 && !differing(&x, &x.oracle, &view),
       "a %s cube: nothing is tested but what is behind it",
       kind == 0   ? "two-sided"
       : kind == 1 ? "one-sided"
                   : "mirrored");
    release(&x);
  }
}

static void try_concave(struct tap *t) {
  static const double ell[6][2] = {{0, 0}, {3, 0}, {3, 1},
                                   {1, 1}, {1, 3}, {0, 3}};
  for (int one_sided = 0; one_sided < 2; one_sided++) {
    struct hsr_scene *scene = hsr_scene_new("L");
    add_prism(scene, ell, 6, one_sided);
    struct fixture x;
    struct hsr_tally tally = {.out_of_memory = false};
    prepare(&x, finished(scene));
    uint64_t wrong = 0, drawn = 0, most = 0;
    for (uint32_t v = 0; v < scene->n_views; v++) {
      struct hsr_view view;
      draw_view(&x, &scene->views[v], &view, &tally);
      wrong += differing(&x, &x.appel, &view);
      drawn = edges_drawn(&x.got);
      most = drawn > most ? drawn : most;
    }
    ok(t,
       x.n_solids == 1 && x.n_parts == 2 && !of(&tally, "bodies apart") &&
           !wrong && most <= 18,
       "a %s L is two volumes, and draws at most the 18 edges it has: %llu",
       one_sided ? "one-sided" : "two-sided", (unsigned long long)most);
    release(&x);
  }
}

/* Two cubes that touch, and a rod behind both of them. */
static void try_union(struct tap *t) {
  struct hsr_scene *scene = hsr_scene_new("union");
  for (int k = 0; k < 2; k++) {
    struct cubes cubes = {{{{false}}}};
    cubes.is[1 + k][2][1] = true;
    add_cubes(scene, &cubes, true);
  }
  struct hsr_object *rod = hsr_scene_object(scene, "rod");
  uint32_t corner[3];
  hsr_object_vertex(rod, 1.25, 4, 1.25, &corner[0]);
  hsr_object_vertex(rod, 2.75, 4, 1.25, &corner[1]);
  hsr_object_vertex(rod, 2.75, 4, 1.5, &corner[2]);
  hsr_object_face(rod, corner, 3, NULL);
  struct fixture x;
  struct hsr_view view;
  struct hsr_tally tally = {.out_of_memory = false};
  prepare(&x, finished(scene));
  struct hsr_camera camera = {
      .eye = {2, -40, 1.4}, .at = {2, 4, 1.4}, .up = {0, 0, 1}, .fov = 10};
  draw_view(&x, &camera, &view, &tally);
  bool hidden = true;
  for (size_t k = 0; k < x.got.n; k++)
    if (x.got.segment[k].edge.a >= 16)
      hidden = hidden && x.got.segment[k].invisibility;
  ok(t,
     hidden && of(&tally, "one piece left") >= 2 &&
         !differing(&x, &x.oracle, &view),
     "a rod behind two cubes that touch is hidden whole, piece by piece");
  release(&x);
}

/* Whether two of the four cubes about some edge of the lattice meet in it only,
 * so that their surface would touch itself. */
static bool touches_itself(const struct cubes *cubes) {
  int c[3];
  for (c[0] = -1; c[0] < SIDE; c[0]++)
    for (c[1] = -1; c[1] < SIDE; c[1]++)
      for (c[2] = -1; c[2] < SIDE; c[2]++)
        for (int axis = 0; axis < 3; axis++) {
          bool is[4];
          for (int k = 0; k < 4; k++) {
            int p[3] = {c[0], c[1], c[2]};
            p[(axis + 1) % 3] += k & 1;
            p[(axis + 2) % 3] += k >> 1;
            is[k] = has(cubes, p);
          }
          if (is[0] == is[3] && is[1] == is[2] && is[0] != is[1])
            return true;
        }
  return false;
}

/* Adds n cubes, or fewer if too many trials fail. */
static void grow(struct cubes *cubes, uint64_t *seed, int n) {
  cubes->is[1][1][1] = true;
  for (int trial = 0; trial < 400 && n > 1; trial++) {
    int c[3], beside[3], k = (int)draw_integer(seed, 0, 5);
    for (int i = 0; i < 3; i++)
      beside[i] = c[i] = (int)draw_integer(seed, 0, SIDE - 1);
    beside[k / 2] += k % 2 ? 1 : -1;
    if (has(cubes, c) || !has(cubes, beside))
      continue;
    cubes->is[c[0]][c[1]][c[2]] = true;
    if (touches_itself(cubes))
      cubes->is[c[0]][c[1]][c[2]] = false;
    else
      n--;
  }
}

/* Adds a skewed instance. It may be mirrored; then its fronts are inside. */
static void skew(struct hsr_scene *scene, uint64_t *seed) {
  double m[12], det;
  do {
    for (int k = 0; k < 12; k++)
      m[k] = (double)draw_integer(seed, -2, 4) / 2;
    det = m[0] * (m[5] * m[10] - m[6] * m[9]) -
          m[1] * (m[4] * m[10] - m[6] * m[8]) +
          m[2] * (m[4] * m[9] - m[5] * m[8]);
  } while (det == 0);
  hsr_scene_instance(scene, 0, m);
}

static struct hsr_camera draw_camera(uint64_t *seed) {
  struct hsr_camera camera = {.up = {0, 0, 1}};
  int half = draw_integer(seed, 0, 1) ? 1 : 2;
  do
    for (int k = 0; k < 3; k++) {
      camera.eye[k] = (double)draw_integer(seed, -3 * half, 8 * half) / half;
      camera.at[k] = (double)draw_integer(seed, 0, SIDE);
    }
  while (camera.eye[0] == camera.at[0] && camera.eye[1] == camera.at[1]);
  camera.fov = draw_integer(seed, 0, 1) ? 90 : 50;
  camera.near = draw_integer(seed, 0, 3) ? 0 : 1;
  return camera;
}

static void try_cubes(struct tap *t, int scenes, uint64_t seed) {
  uint64_t wrong = 0, views = 0, solids = 0, parts = 0;
  struct hsr_tally tally = {.out_of_memory = false};
  for (int s = 0; s < scenes; s++) {
    struct cubes cubes = {{{{false}}}};
    grow(&cubes, &seed, (int)draw_integer(&seed, 2, 24));
    struct hsr_scene *scene = hsr_scene_new("cubes");
    add_cubes(scene, &cubes, draw_integer(&seed, 0, 1));
    if (draw_integer(&seed, 0, 1))
      skew(scene, &seed);
    struct fixture x;
    prepare(&x, finished(scene));
    solids += x.n_solids;
    parts += x.n_parts;
    for (int v = 0; v < 6; v++) {
      struct hsr_camera camera = draw_camera(&seed);
      struct hsr_view view;
      draw_view(&x, &camera, &view, &tally);
      uint64_t here = differing(&x, &x.oracle, &view);
      if (here)
        printf("# scene %d, eye %g,%g,%g at %g,%g,%g: %llu edges\n", s,
               camera.eye[0], camera.eye[1], camera.eye[2], camera.at[0],
               camera.at[1], camera.at[2], (unsigned long long)here);
      wrong += here;
      views++;
    }
    release(&x);
  }
  ok(t, !wrong && parts > 3 * solids && 2 * solids > (uint64_t)scenes,
     "%llu edges of random solids differ in %llu views; %llu solids in %llu "
     "parts",
     (unsigned long long)wrong, (unsigned long long)views,
     (unsigned long long)solids, (unsigned long long)parts);
}

static void vertex(const struct hsr_world *w, uint64_t *seed, double at[3]) {
  size_t v = (size_t)draw_integer(seed, 0, w->mesh.n_vertices - 1);
  at[0] = w->mesh.x[v];
  at[1] = w->mesh.y[v];
  at[2] = w->mesh.z[v];
}

/* Looks from between two vertices to another one: from inside solids, from
 * their planes, and with much behind the eye. */
static void try_inside(struct tap *t, int views, uint64_t seed) {
  static const char *const scenes[] = {"house", "harbor:100", "nested-solids",
                                       "sphere:200", "non-planar"};
  uint64_t wrong = 0, drawn = 0;
  struct hsr_tally tally = {.out_of_memory = false};
  for (size_t s = 0; s < sizeof scenes / sizeof *scenes; s++) {
    struct fixture x;
    struct hsr_scene *scene = must_open(scenes[s]);
    prepare(&x, scene);
    for (int v = 0; v < views; v++) {
      struct hsr_camera camera = {.up = {0.25, 1, 0.5}, .fov = 80};
      struct hsr_view view;
      double other[3];
      vertex(&x.world, &seed, camera.eye);
      vertex(&x.world, &seed, other);
      vertex(&x.world, &seed, camera.at);
      for (int k = 0; k < 3; k++)
        camera.eye[k] += (other[k] - camera.eye[k]) / 2;
      if (hsr_camera_check(&camera, NULL))
        continue;
      draw_view(&x, &camera, &view, &tally);
      wrong += differing(&x, &x.oracle, &view);
      drawn += edges_drawn(&x.got);
    }
    release(&x);
  }
  ok(t, !wrong && drawn && of(&tally, "faces apart"),
     "%llu of %llu edges differ in views from within",
     (unsigned long long)wrong, (unsigned long long)drawn);
}

/* usage: roberts_test [SCENES [SEED]]      standard: 40 scenes, seed 1963 */
int main(int argc, char **argv) {
  struct tap t = plan(10);
  try_outcomes(&t);
  try_convex(&t);
  try_concave(&t);
  try_union(&t);
  try_cubes(&t, argc > 1 ? atoi(argv[1]) : 40,
            argc > 2 ? strtoull(argv[2], NULL, 10) : 1963);
  try_inside(&t, 12, 1963);
  return finish(&t);
}
