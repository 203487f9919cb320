/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Table I against figures derived by hand, and against counts without a grid or
 * boxes.
 *
 * By hand the eye is the origin and looks along -z with a field of 90 degrees,
 * so that in a picture of 32 x 32 the point at depth d seen at the pixel (x, y)
 * is ((x - 16) d/16, (16 - y) d/16, -d); `at` computes it. Pixels are given as
 * integers and samples lie in their middles, so a rectangle from (x0, y0) to
 * (x1, y1) covers (x1 - x0)(y1 - y0) samples and none lies on its border. */
#include "common/exact/predicates.h"
#include "common/exact/screen.h"
#include "common/statistics/statistics.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* ---- TAP ---- */

static int n_tests, n_failed;

static void ok(bool good, const char *what) {
  printf("%s %d - %s\n", good ? "ok" : "not ok", ++n_tests, what);
  n_failed += !good;
}

/* Equal except for the rounding of projections. */
static void is(double got, double expected, const char *what) {
  bool good = fabs(got - expected) <= 1e-9 * (1 + fabs(expected));
  ok(good, what);
  if (!good)
    printf("# got %.17g, expected %.17g\n", got, expected);
}

/* Equal within a part of the expected value. */
static void is_about(double got, double expected, double part,
                     const char *what) {
  bool good = fabs(got - expected) <= part * expected;
  ok(good, what);
  if (!good)
    printf("# got %.17g, expected about %.17g\n", got, expected);
}

static void must(bool good) {
  if (good)
    return;
  printf("Bail out! a scene could not be set up\n");
  exit(1);
}

/* ---- Scenes ---- */

struct point {
  double x, y, z;
};

static struct point at(double x, double y, double depth) {
  return (struct point){(x - 16) * depth / 16, (16 - y) * depth / 16, -depth};
}

static struct hsr_scene *new_scene(void) {
  struct hsr_scene *scene = hsr_scene_new("by hand");
  must(scene && hsr_scene_object(scene, "object"));
  return scene;
}

static uint32_t vertex(struct hsr_scene *scene, struct point p) {
  uint32_t v;
  must(!hsr_object_vertex(scene->objects, p.x, p.y, p.z, &v));
  return v;
}

static void face(struct hsr_scene *scene, const uint32_t *vertices, size_t n) {
  must(!hsr_object_face(scene->objects, vertices, n, NULL));
}

/* A face with vertices of its own. */
static void polygon(struct hsr_scene *scene, const struct point *p, size_t n) {
  uint32_t v[16];
  for (size_t k = 0; k < n; k++)
    v[k] = vertex(scene, p[k]);
  face(scene, v, n);
}

/* Its front faces the eye: it is counter-clockwise in the picture. */
static void rectangle(struct hsr_scene *scene, double x0, double y0, double x1,
                      double y1, double depth) {
  const struct point p[4] = {at(x0, y1, depth), at(x1, y1, depth),
                             at(x1, y0, depth), at(x0, y0, depth)};
  polygon(scene, p, 4);
}

/* A box of 6 faces with their fronts outside. */
static void box(struct hsr_scene *scene, struct point lo, struct point hi) {
  static const uint32_t loops[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6},
                                       {0, 1, 5, 4}, {2, 6, 7, 3},
                                       {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (int k = 0; k < 8; k++)
    vertex(scene, (struct point){k & 1 ? hi.x : lo.x, k & 2 ? hi.y : lo.y,
                                 k & 4 ? hi.z : lo.z});
  for (int k = 0; k < 6; k++)
    face(scene, loops[k], 4);
}

/* ---- Measuring ---- */

static const struct hsr_camera from_origin = {
    .at = {0, 0, -1}, .up = {0, 1, 0}, .fov = 90};

/* The correct picture, by asking for every face at every sample. */
static uint32_t *picture(const struct hsr_world *world,
                         const struct hsr_view *view) {
  struct hsr_arena arena = HSR_ARENA_EMPTY;
  struct hsr_tally tally = {0};
  struct hsr_screen screen;
  size_t m = (size_t)view->m, n = (size_t)view->n;
  uint32_t *ids = malloc(m * n * sizeof *ids);
  must(ids && !hsr_screen_make(&screen, world, view, &arena, &tally));
  for (size_t k = 0; k < m * n; k++) {
    int i = (int)(k % m), j = (int)(k / m);
    ids[k] = HSR_BACKGROUND;
    for (uint32_t r = 0; r < screen.n_relevant; r++) {
      uint32_t f = screen.relevant[r];
      if (hsr_covers(&screen, f, i, j, &tally) &&
          (ids[k] == HSR_BACKGROUND ||
           hsr_nearer(&screen, f, ids[k], i, j, &tally)))
        ids[k] = f;
    }
  }
  hsr_arena_free(&arena);
  return ids;
}

/* Measures the scene and deletes it. */
static struct hsr_table1 measure(struct hsr_scene *scene,
                                 const struct hsr_camera *camera, int size) {
  struct hsr_world world;
  struct hsr_view view;
  struct hsr_table1 table;
  must(!hsr_scene_finish(scene, NULL) && !hsr_world_init(&world, scene, NULL) &&
       !hsr_view_init(&view, camera, size, size, NULL));
  uint32_t *ids = picture(&world, &view);
  view.window = (struct hsr_window){3, 4, 5, 6}; /* must have no effect */
  must(!hsr_statistics_measure(&world, &view, ids, &table, NULL));
  free(ids);
  hsr_world_free(&world);
  hsr_scene_delete(scene);
  return table;
}

static struct hsr_table1 look(struct hsr_scene *scene) {
  return measure(scene, &from_origin, 32);
}

/* ---- A box seen face-on ---- */

/* The box -1 <= x, y <= 1 between the depths 2 and 4. Its front is the square
 * from pixel 8 to pixel 24, its back from 12 to 20. */
static struct hsr_scene *box_ahead(bool one_sided) {
  struct hsr_scene *scene = new_scene();
  box(scene, (struct point){-1, -1, -4}, (struct point){1, 1, -2});
  scene->objects->one_sided = one_sided;
  return scene;
}

/* One-sided, only the front exists: the eye is behind all other planes. */
static void test_box_front(void) {
  struct hsr_table1 t = look(box_ahead(true));
  is(t.n, 32, "box: n");
  is(t.m, 32, "box: m");
  is(t.F_t, 6, "box: F_t");
  is(t.F_r, 1, "box: F_r, the front");
  is(t.C_t, 1, "box: C_t");
  is(t.C_r, 1, "box: C_r");
  is(t.F_c, 6, "box: F_c");
  is(t.E_t, 24, "box: E_t, 6 faces of 4");
  is(t.E_r, 4, "box: E_r");
  is(t.E_s, 4, "box: E_s");
  is(t.E_c, 4, "box: E_c, the other face of each does not exist");
  is(t.D_c, 16 * 16 / 1024.0, "box: D_c");
  is(t.H_f, 16, "box: H_f");
  is(t.S_f, 16, "box: S_f, one a row");
  is(t.S_l, 0.5, "box: S_l, 16 on 32 lines");
  is(t.S_v, 0.5, "box: S_v");
  is(t.L_v, 64, "box: L_v, the square's four sides");
  is(t.X_r, 0, "box: X_r");
  is(t.X_v, 0, "box: X_v");
  is(t.X_f, 0, "box: X_f");
}

/* Two-sided, all faces exist. The four sides appear as trapezoids between the
 * front's square and the back's.
 * E_c  The front is seen from its front, all others from their backs: the folds
 *      are the four edges of the front.
 * D_c  The front covers 16^2 samples, the back 8^2, the sides the ring between
 *      the two, 16^2 - 8^2.
 * H_f  front 16, back 8, left and right 16, top and bottom 4.
 * S_f  front 16, back 8, top and bottom 4 each. Left and right extend over 16
 *      rows. Their diagonals from the corners go through samples, which count
 *      as a little to the right and, much less, below. So the right side has
 *      the samples on its diagonals inside: 16 rows. The left side has them
 *      outside, and its first and last row have no other samples: 14 rows.
 * L_v  Only the front is visible. */
static void test_box_all(void) {
  struct hsr_table1 t = look(box_ahead(false));
  is(t.F_r, 6, "two-sided box: F_r");
  is(t.E_r, 24, "two-sided box: E_r");
  is(t.E_s, 12, "two-sided box: E_s");
  is(t.E_c, 4, "two-sided box: E_c");
  is(t.D_c, 512 / 1024.0, "two-sided box: D_c");
  is(t.H_f, 64 / 6.0, "two-sided box: H_f");
  is(t.S_f, 16 + 8 + 4 + 4 + 16 + 14, "two-sided box: S_f");
  is(t.S_v, 0.5, "two-sided box: S_v");
  is(t.L_v, 64, "two-sided box: L_v");
  is(t.X_r, 0, "two-sided box: X_r");
}

/* ---- A cube seen from a corner ---- */

/* Three front faces around the near corner with 9 edges, 6 of which are the
 * hexagon of the outline. With the back faces there are also the three edges of
 * the far corner. The far corner appears within one of the front faces. One of
 * its edges leads to that face's corner on the hexagon and crosses nothing.
 * Each of the two others crosses one edge of the near corner, which is nearer
 * and visible. The hexagon remains the only fold. */
static void test_corner(void) {
  const struct hsr_camera camera = {
      .eye = {5, 4, 3}, .at = {0, 0, 0}, .up = {0, 1, 0}, .fov = 40};
  for (int one_sided = 0; one_sided < 2; one_sided++) {
    struct hsr_scene *scene = new_scene();
    box(scene, (struct point){-1, -1, -1}, (struct point){1, 1, 1});
    scene->objects->one_sided = one_sided;
    struct hsr_table1 t = measure(scene, &camera, 64);
    is(t.F_r, one_sided ? 3 : 6, "corner: F_r");
    is(t.E_r, one_sided ? 12 : 24, "corner: E_r");
    is(t.E_s, one_sided ? 9 : 12, "corner: E_s");
    is(t.E_c, 6, "corner: E_c");
    is(t.X_r, one_sided ? 0 : 2, "corner: X_r");
    is(t.X_v, one_sided ? 0 : 2, "corner: X_v");
    is(t.X_f, 0, "corner: X_f");
  }
}

/* ---- Rectangles before one another ---- */

/* A lies in front of B like the bar of a cross in front of its post: the two
 * long sides of each cross those of the other. A shows all of its outline; B
 * loses twice the height of A. B is narrower, so the rows of A show only A. */
static void cross(struct hsr_scene *scene) {
  rectangle(scene, 4, 8, 20, 16, 2);
  rectangle(scene, 8, 4, 14, 24, 4);
}

static void test_cross(void) {
  struct hsr_scene *scene = new_scene();
  cross(scene);
  struct hsr_table1 t = look(scene);
  is(t.F_r, 2, "cross: F_r");
  is(t.E_c, 8, "cross: E_c, a face alone is bordered by its edges");
  is(t.D_c, (16 * 8 + 6 * 20) / 1024.0, "cross: D_c");
  is(t.H_f, (8 + 20) / 2.0, "cross: H_f");
  is(t.S_f, 8 + 20, "cross: S_f");
  is(t.S_v, (8 + 20 - 8) / 32.0, "cross: S_v");
  is(t.X_r, 4, "cross: X_r");
  is(t.X_v, 4, "cross: X_v");
  is(t.L_v, 48 + 52 - 16, "cross: L_v");
  is(t.X_f, 0, "cross: X_f");
}

/* C is nearest and lies over the corner of A and B at (8, 8), from (6, 6) to
 * (10, 10). Its two upright sides cross the top of A, its two level sides the
 * left side of B; the crossing at (8, 8) is hidden. C hides 4 of A's outline,
 * and 2 of B's, from 6 to 8, where A did not hide it. Rows 6 and 7 show C and
 * B, one more than before; rows 8 and 9 show A, C and A, two more. */
static void test_hidden_crossing(void) {
  struct hsr_scene *scene = new_scene();
  cross(scene);
  rectangle(scene, 6, 6, 10, 10, 1);
  struct hsr_table1 t = look(scene);
  is(t.X_r, 8, "hidden crossing: X_r");
  is(t.X_v, 7, "hidden crossing: X_v");
  is(t.L_v, 84 - 4 - 2 + 16, "hidden crossing: L_v");
  is(t.S_v, (20 + 2 * 1 + 2 * 2) / 32.0, "hidden crossing: S_v");
}

/* Edges that only touch do not cross: a small rectangle that stands with a side
 * on the upper side of a large one, or with a corner. Nor do two rectangles
 * with one outline; both of these are visible if they are in one plane. */
static void test_touching(void) {
  struct hsr_scene *scene = new_scene();
  rectangle(scene, 4, 16, 28, 24, 4);
  rectangle(scene, 8, 8, 12, 16, 4);
  const struct point p[3] = {at(20, 16, 2), at(24, 8, 2), at(16, 8, 2)};
  polygon(scene, p, 3);
  struct hsr_table1 t = look(scene);
  is(t.X_r, 0, "touching: X_r");
  is(t.X_f, 0, "touching: X_f");
  is(t.L_v, 64 + 24 + 8 + 2 * sqrt(80), "touching: L_v");

  scene = new_scene();
  rectangle(scene, 4, 16, 28, 24, 4);
  rectangle(scene, 4, 16, 28, 24, 4);
  t = look(scene);
  is(t.D_c, 2 * 24 * 8 / 1024.0, "doubled: D_c");
  is(t.X_r, 0, "doubled: X_r");
  is(t.X_f, 0, "doubled: X_f");
  is(t.L_v, 2 * 64, "doubled: L_v");
  is(t.S_v, 8 / 32.0, "doubled: S_v");
}

/* Below the picture, and touching its border with a side, or not. */
static void test_border(void) {
  struct hsr_scene *scene = new_scene();
  rectangle(scene, 4, 32, 28, 40, 4);
  rectangle(scene, 4, 33, 28, 40, 4);
  rectangle(scene, 4, 31, 28, 40, 4);
  struct hsr_table1 t = look(scene);
  is(t.F_r, 2, "border: F_r");
  is(t.H_f, 0.5, "border: H_f");
}

/* ---- Faces too small to be seen ---- */

/* A ball of 24 x 48 faces, many of which cover no sample. All relevant edges of
 * a convex solid are visible at any resolution, so L_v grows with it. */
static struct hsr_scene *ball(void) {
  enum { BELTS = 24, SECTORS = 48 };
  const double pi = 3.14159265358979;
  struct hsr_scene *scene = new_scene();
  uint32_t ring[BELTS + 1][SECTORS];
  for (int b = 0; b <= BELTS; b++)
    for (int s = 0; s < SECTORS; s++) {
      bool pole = b == 0 || b == BELTS;
      double up = cos(b * pi / BELTS), out = pole ? 0 : sin(b * pi / BELTS);
      double turn = 2 * pi * s / SECTORS;
      ring[b][s] = pole && s ? ring[b][0]
                             : vertex(scene, (struct point){out * cos(turn), up,
                                                            out * sin(turn)});
    }
  for (int b = 0; b < BELTS; b++)
    for (int s = 0; s < SECTORS; s++) {
      int next = (s + 1) % SECTORS;
      const uint32_t upper[3] = {ring[b][s], ring[b][next], ring[b + 1][next]};
      const uint32_t lower[3] = {ring[b][s], ring[b + 1][next], ring[b + 1][s]};
      if (b)
        face(scene, upper, 3);
      if (b + 1 < BELTS)
        face(scene, lower, 3);
    }
  scene->objects->one_sided = true;
  return scene;
}

static void test_ball(void) {
  const struct hsr_camera camera = {
      .eye = {3, 2, 1.5}, .at = {0, 0, 0}, .up = {0, 1, 0}, .fov = 35};
  struct hsr_table1 small = measure(ball(), &camera, 24);
  struct hsr_table1 large = measure(ball(), &camera, 96);
  is(small.F_r, large.F_r, "ball: F_r");
  is(small.X_r, 0, "ball: X_r");
  is(4 * small.L_v, large.L_v, "ball: L_v");
  is(4 * small.H_f, large.H_f, "ball: H_f");
  ok(small.F_r > 24 * 24, "ball: more faces than samples");
}

/* ---- Clipping ---- */

/* A floor one unit below the eye. It extends far to both sides and behind the
 * eye, and ends at depth 4, row 16 + 16/4; that is its only edge in the
 * picture. With near = 2 it begins at row 16 + 16/2. */
static void test_floor(void) {
  const struct point p[4] = {
      {-90, -1, 9}, {90, -1, 9}, {90, -1, -4}, {-90, -1, -4}};
  for (int near = 0; near < 3; near += 2) {
    struct hsr_scene *scene = new_scene();
    struct hsr_camera camera = from_origin;
    camera.near = near;
    polygon(scene, p, 4);
    struct hsr_table1 t = measure(scene, &camera, 32);
    int rows = near ? 4 : 12;
    is(t.F_r, 1, "floor: F_r");
    is(t.H_f, rows, "floor: H_f");
    is(t.D_c, rows / 32.0, "floor: D_c");
    is(t.E_t, 4, "floor: E_t");
    is(t.E_r, 1, "floor: E_r");
    is(t.E_c, 1, "floor: E_c");
    is(t.L_v, 32, "floor: L_v");
  }
}

/* Four faces: half out of the picture; wholly out; behind the eye; too small
 * for a sample. The first and the last are relevant, with 3 and 4 edges. A
 * length of 16 + 16 + 10 of the first is in the picture. */
static void test_out(void) {
  struct hsr_scene *scene = new_scene();
  rectangle(scene, 16, 4, 48, 14, 3);
  rectangle(scene, 33, 4, 48, 14, 3);
  rectangle(scene, 8, 8, 24, 24, -3);
  rectangle(scene, 4.6, 4.6, 4.8, 4.9, 3);
  struct hsr_table1 t = look(scene);
  is(t.F_t, 4, "out: F_t");
  is(t.F_r, 2, "out: F_r");
  is(t.E_r, 7, "out: E_r");
  is(t.H_f, (10 + 0.3) / 2, "out: H_f");
  is(t.S_f, 10, "out: S_f");
  is(t.D_c, 160 / 1024.0, "out: D_c");
  is(t.L_v, 42 + 1, "out: L_v");
}

/* An object three times: ahead, behind the eye, out of the picture. */
static void test_clusters(void) {
  const double m[3][12] = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0},
                           {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 9},
                           {1, 0, 0, 99, 0, 1, 0, 0, 0, 0, 1, 0}};
  struct hsr_scene *scene = box_ahead(true);
  for (int k = 0; k < 3; k++)
    must(!hsr_scene_instance(scene, 0, m[k]));
  struct hsr_table1 t = look(scene);
  is(t.F_t, 18, "clusters: F_t");
  is(t.C_t, 3, "clusters: C_t");
  is(t.C_r, 1, "clusters: C_r");
  is(t.F_c, 6, "clusters: F_c");
}

/* ---- Contour edges ---- */

/* Two rectangles share the upright edge at pixel 16. The second one continues
 * to pixel 24, or folds back to pixel 10, farther away; it may be wound either
 * way. The six other edges are borders. The shared edge is a contour edge if
 * the second rectangle folds back, or if there is a third face: then a ray
 * meets more faces on one side of it than on the other. */
static void test_contour(void) {
  for (int k = 0; k < 8; k++) {
    bool fold = k & 1, reversed = k & 2, third = k & 4;
    struct hsr_scene *scene = new_scene();
    double x = fold ? 10 : 24;
    uint32_t top = vertex(scene, at(16, 8, 4));
    uint32_t bottom = vertex(scene, at(16, 24, 4));
    uint32_t a[4] = {vertex(scene, at(8, 8, 4)), vertex(scene, at(8, 24, 4)),
                     bottom, top};
    uint32_t b[4] = {top, bottom, vertex(scene, at(x, 24, 6)),
                     vertex(scene, at(x, 8, 6))};
    uint32_t b_reversed[4] = {b[3], b[2], b[1], b[0]};
    face(scene, a, 4);
    face(scene, reversed ? b_reversed : b, 4);
    if (third) {
      uint32_t c[3] = {top, bottom, vertex(scene, at(20, 20, 3))};
      face(scene, c, 3);
    }
    struct hsr_table1 t = look(scene);
    is(t.E_s, third ? 9 : 7, "contour: E_s");
    is(t.E_c, third ? 9 : fold ? 7 : 6, "contour: E_c");
  }
}

/* ---- Penetration ---- */

/* X_f of faces about the origin. */
static double penetrations(struct hsr_scene *scene) {
  const struct hsr_camera camera = {
      .eye = {3, 5, 20}, .at = {0, 0, 0}, .up = {0, 1, 0}, .fov = 60};
  return measure(scene, &camera, 8).X_f;
}

static double penetrate(const struct point *f, size_t nf, const struct point *g,
                        size_t ng, struct point shift) {
  struct hsr_scene *scene = new_scene();
  struct point shifted[16];
  for (size_t k = 0; k < ng; k++)
    shifted[k] =
        (struct point){g[k].x + shift.x, g[k].y + shift.y, g[k].z + shift.z};
  polygon(scene, f, nf);
  polygon(scene, shifted, ng);
  return penetrations(scene);
}

static const struct point stay = {0, 0, 0};

/* In the plane z = 0 a large triangle f; the edge of g from (0, 0, -1) to (1/2,
 * 0, 1) meets it inside, in (1/4, 0, 0). */
static void test_triangles(void) {
  const struct point f[3] = {{-2, -2, 0}, {2, -2, 0}, {0, 2, 0}};
  const struct point g[3] = {{0, 0, -1}, {0.5, 0, 1}, {0, 3, 1}};
  const struct point on_f[3] = {{0.25, 0, 0}, {0.5, 0, 1}, {0, 3, 1}};
  const struct point flat[3] = {{-1, -1, 0}, {3, -1, 0}, {1, 3, 0}};
  is(penetrate(f, 3, g, 3, stay), 1, "penetrating triangles");
  is(penetrate(g, 3, f, 3, stay), 1, "penetrating triangles, the other way");
  is(penetrate(f, 3, g, 3, (struct point){5, 0, 0}), 0, "one past the other");
  is(penetrate(f, 3, g, 3, (struct point){0, 0, 1}), 0, "a corner on a face");
  is(penetrate(f, 3, on_f, 3, stay), 0, "a corner on a face, obliquely");
  is(penetrate(f, 3, flat, 3, stay), 0, "overlapping in one plane");

  struct hsr_scene *scene = new_scene();
  polygon(scene, f, 3);
  uint32_t fan[3] = {0, vertex(scene, (struct point){0, 0, -1}),
                     vertex(scene, (struct point){0.5, 0, 1})};
  face(scene, fan, 3);
  is(penetrations(scene), 0, "faces that share a vertex are not asked about");
}

/* The tip of a triangle is on the plane x = y, in a face of that plane; and
 * then through it by the least that doubles can represent. */
static void test_tip(void) {
  const struct point f[3] = {{-2, -2, -2}, {2, 2, -2}, {0, 0, 2}};
  struct point g[3] = {{0.3, 0.3, 0}, {2, -1, 0.1}, {2, -1.5, -0.1}};
  is(penetrate(f, 3, g, 3, stay), 0, "a tip on a face");
  g[0].y = nextafter(0.3, 1);
  is(penetrate(f, 3, g, 3, stay), 1, "a tip a little through a face");
}

/* Equal rectangles across each other: their edges meet but pierce nothing. Then
 * one is moved along their common line, half as far as would separate them, and
 * just as far; then it stands on the other. */
static void test_paddle_wheel(void) {
  const struct point f[4] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  const struct point g[4] = {{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}};
  is(penetrate(f, 4, g, 4, stay), 1, "blades of a paddle wheel");
  is(penetrate(f, 4, g, 4, (struct point){1, 0, 0}), 1, "half apart");
  is(penetrate(f, 4, g, 4, (struct point){2, 0, 0}), 0, "end to end");
  is(penetrate(f, 4, g, 4, (struct point){0, 0, 1}), 0, "a wall on a floor");
  is(penetrate(f, 4, g, 4, (struct point){0, 1, 0}), 0, "edge through an edge");
}

/* A U in the plane z = 0 has the arms -3 <= x <= -1 and 1 <= x <= 3. The
 * triangle meets that plane for -1/4 <= x <= 1/4, at y = 5/4; the wide one for
 * |x| <= 5/2. */
static void test_notch(void) {
  const struct point u[8] = {{-3, -3, 0}, {3, -3, 0},  {3, 3, 0},  {1, 3, 0},
                             {1, -1, 0},  {-1, -1, 0}, {-1, 3, 0}, {-3, 3, 0}};
  const struct point g[3] = {{-0.5, 1, -1}, {0.5, 1, -1}, {0, 1.5, 1}};
  const struct point wide[3] = {{-5, 1, -1}, {5, 1, -1}, {0, 1.5, 1}};
  is(penetrate(u, 8, g, 3, stay), 0, "through a notch");
  is(penetrate(u, 8, g, 3, (struct point){2, 0, 0}), 1, "through an arm");
  is(penetrate(u, 8, g, 3, (struct point){4, 0, 0}), 0, "past an arm");
  is(penetrate(u, 8, g, 3, (struct point){0.75, 0, 0}), 0, "at an arm's edge");
  is(penetrate(u, 8, wide, 3, stay), 1, "through both arms, not the notch");
}

/* An L in the plane y = 0 that stands with a foot on the plane z = 0, 0 <= x <=
 * 2, and reaches through it for -2 <= x <= 0. */
static void test_foot(void) {
  const struct point l[6] = {{0, 0, 0},  {2, 0, 0},   {2, 0, 2},
                             {-2, 0, 2}, {-2, 0, -2}, {0, 0, -2}};
  const struct point floor[4] = {
      {-0.5, -1, 0}, {0.5, -1, 0}, {0.5, 1, 0}, {-0.5, 1, 0}};
  is(penetrate(l, 6, floor, 4, (struct point){1, 0, 0}), 0, "under a foot");
  is(penetrate(l, 6, floor, 4, (struct point){0.5, 0, 0}), 0,
     "under a foot, at its end");
  is(penetrate(l, 6, floor, 4, stay), 1, "under a foot and beyond");
  is(penetrate(l, 6, floor, 4, (struct point){-1, 0, 0}), 1, "across a leg");
  is(penetrate(l, 6, floor, 4, (struct point){-2.5, 0, 0}), 0, "past a leg");
}

/* ---- Without grid or boxes ---- */

enum { N_TRIANGLES = 120, SIZE = 160 };

struct soup {
  struct point p[N_TRIANGLES][3];      /* in the world */
  struct point screen[N_TRIANGLES][3]; /* x, y in pixels, z = 1/depth */
};

static uint64_t state;
static double random_between(double lo, double hi) {
  state = state * 6364136223846793005u + 1442695040888963407u;
  return lo + (hi - lo) * (double)(state >> 11) * 0x1p-53;
}

static struct hsr_scene *make_soup(struct soup *soup) {
  struct hsr_scene *scene = new_scene();
  for (int f = 0; f < N_TRIANGLES; f++) {
    double x = random_between(4, 28), y = random_between(4, 28);
    double depth = random_between(4, 8);
    for (int k = 0; k < 3; k++) {
      double px = x + random_between(-4, 4), py = y + random_between(-4, 4);
      double d = depth + random_between(-1, 1);
      soup->p[f][k] = at(px, py, d);
      soup->screen[f][k] =
          (struct point){px * SIZE / 32, py * SIZE / 32, 1 / d};
    }
    polygon(scene, soup->p[f], 3);
  }
  return scene;
}

/* Twice the area of a, b, c on the screen. */
static double area(struct point a, struct point b, struct point c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

static struct point along(struct point a, struct point b, double t) {
  return (struct point){a.x + t * (b.x - a.x), a.y + t * (b.y - a.y),
                        a.z + t * (b.z - a.z)};
}

/* Whether no triangle but f hides a point of the screen, at 1/depth p.z. */
static bool unhidden(const struct soup *soup, int f, struct point p) {
  for (int g = 0; g < N_TRIANGLES; g++) {
    const struct point *t = soup->screen[g];
    double a = area(t[1], t[2], p), b = area(t[2], t[0], p);
    double c = area(t[0], t[1], p), all = a + b + c;
    if (g != f && a * all > 0 && b * all > 0 && c * all > 0 &&
        (a * t[0].z + b * t[1].z + c * t[2].z) / all > p.z)
      return false;
  }
  return true;
}

static double visible_length(const struct soup *soup) {
  double sum = 0;
  for (int f = 0; f < N_TRIANGLES; f++)
    for (int k = 0; k < 3; k++) {
      struct point a = soup->screen[f][k], b = soup->screen[f][(k + 1) % 3];
      int n_steps = 1000, n_visible = 0;
      for (int step = 0; step < n_steps; step++)
        n_visible += unhidden(soup, f, along(a, b, (step + 0.5) / n_steps));
      sum += hypot(b.x - a.x, b.y - a.y) * n_visible / n_steps;
    }
  return sum;
}

static void count_crossings(const struct soup *soup, int *n, int *n_visible) {
  *n = *n_visible = 0;
  for (int e = 0; e < 3 * N_TRIANGLES; e++)
    for (int f = e / 3 * 3 + 3; f < 3 * N_TRIANGLES; f++) {
      struct point a = soup->screen[e / 3][e % 3];
      struct point b = soup->screen[e / 3][(e + 1) % 3];
      struct point c = soup->screen[f / 3][f % 3];
      struct point d = soup->screen[f / 3][(f + 1) % 3];
      double ac = area(c, d, a), bc = area(c, d, b);
      double ca = area(a, b, c), da = area(a, b, d);
      if (ac * bc >= 0 || ca * da >= 0)
        continue;
      struct point p = along(a, b, ac / (ac - bc));
      struct point q = along(c, d, ca / (ca - da));
      ++*n;
      *n_visible +=
          p.z > q.z ? unhidden(soup, e / 3, p) : unhidden(soup, f / 3, q);
    }
}

/* The side of d against the plane of a, b, c. */
static int orientation(struct point a, struct point b, struct point c,
                       struct point d) {
  static const uint32_t three[3] = {0, 1, 2};
  const double x[3] = {a.x, b.x, c.x}, y[3] = {a.y, b.y, c.y},
               z[3] = {a.z, b.z, c.z}, p[3] = {d.x, d.y, d.z};
  bool out_of_memory = false;
  return hsr_exact_plane_side((struct hsr_loop){x, y, z, 1, three, 3}, p,
                              &out_of_memory);
}

static bool an_edge_pierces(const struct point *f, const struct point *g) {
  for (int k = 0; k < 3; k++) {
    struct point a = f[k], b = f[(k + 1) % 3];
    int turn = orientation(a, b, g[0], g[1]);
    if (orientation(g[0], g[1], g[2], a) != orientation(g[0], g[1], g[2], b) &&
        turn == orientation(a, b, g[1], g[2]) &&
        turn == orientation(a, b, g[2], g[0]))
      return true;
  }
  return false;
}

static int count_penetrations(const struct soup *soup) {
  int n = 0;
  for (int f = 0; f < N_TRIANGLES; f++)
    for (int g = f + 1; g < N_TRIANGLES; g++)
      n += an_edge_pierces(soup->p[f], soup->p[g]) ||
           an_edge_pierces(soup->p[g], soup->p[f]);
  return n;
}

/* Counts agree exactly. Estimates from the picture agree within a few per cent.
 */
static void test_soup(void) {
  for (uint64_t seed = 1; seed <= 3; seed++) {
    struct soup soup;
    int n_crossings, n_visible;
    state = seed;
    struct hsr_table1 t = measure(make_soup(&soup), &from_origin, SIZE);
    count_crossings(&soup, &n_crossings, &n_visible);
    is(t.F_r, N_TRIANGLES, "soup: F_r");
    is(t.E_c, 3 * N_TRIANGLES, "soup: E_c");
    is(t.X_r, n_crossings, "soup: X_r");
    is(t.X_f, count_penetrations(&soup), "soup: X_f");
    is_about(t.X_v, n_visible, 0.05, "soup: X_v");
    is_about(t.L_v, visible_length(&soup), 0.02, "soup: L_v");
  }
}

/* ---- What is not measured ---- */

static void test_nothing(void) {
  struct hsr_scene *scene = new_scene();
  rectangle(scene, 8, 8, 24, 24, -3);
  struct hsr_table1 t = look(scene);
  is(t.F_r, 0, "nothing: F_r");
  is(t.C_r, 0, "nothing: C_r");
  is(t.E_s, 0, "nothing: E_s");
  is(t.D_c, 0, "nothing: D_c");
  is(t.X_r, 0, "nothing: X_r");
  is(t.X_f, 0, "nothing: X_f");
  is(t.L_v, 0, "nothing: L_v");
  ok(isnan(t.H_f), "nothing: H_f is the mean of nothing");
}

static void test_pictures(void) {
  struct hsr_scene *scene = new_scene();
  struct hsr_world world;
  struct hsr_view view;
  struct hsr_table1 t;
  struct hsr_error err;
  rectangle(scene, 8, 8, 24, 24, 3);
  must(!hsr_scene_finish(scene, NULL) && !hsr_world_init(&world, scene, NULL) &&
       !hsr_view_init(&view, &from_origin, 32, 32, NULL));
  ok(hsr_statistics_measure(&world, &view, NULL, &t, &err) == HSR_OK,
     "without a picture");
  ok(isnan(t.S_v) && isnan(t.L_v) && isnan(t.X_v),
     "without a picture: no S_v, L_v, X_v");
  is(t.X_r, 0, "without a picture: X_r");
  is(t.S_l, 0.5, "without a picture: S_l");

  uint32_t *ids = picture(&world, &view);
  ids[32 * 31 + 31] = 1;
  ok(hsr_statistics_measure(&world, &view, ids, &t, &err) == HSR_E_USAGE,
     "a picture of another world is refused");
  free(ids);
  hsr_world_free(&world);
  hsr_scene_delete(scene);
}

/* ---- Table II ---- */

/* The paper's three columns. They are rounded down or to the nearest, to one
 * digit or two. */
static void test_rules(void) {
  static const struct hsr_table1 table2[3] = {{.F_r = 100,
                                               .F_c = 10,
                                               .F_t = 200,
                                               .C_t = 20,
                                               .E_t = 800,
                                               .E_r = 400,
                                               .E_c = 180,
                                               .E_s = 290,
                                               .X_r = 200,
                                               .X_v = 70,
                                               .H_f = 86,
                                               .S_l = 17,
                                               .S_v = 5,
                                               .L_v = 5000},
                                              {.F_r = 2500,
                                               .F_c = 25,
                                               .F_t = 5000,
                                               .C_t = 200,
                                               .E_t = 20000,
                                               .E_r = 10000,
                                               .E_c = 2800,
                                               .E_s = 6400,
                                               .X_r = 5000,
                                               .X_v = 1700,
                                               .H_f = 17,
                                               .S_l = 87,
                                               .S_v = 29,
                                               .L_v = 29000},
                                              {.F_r = 60000,
                                               .F_c = 200,
                                               .F_t = 120000,
                                               .C_t = 600,
                                               .E_t = 480000,
                                               .E_r = 240000,
                                               .E_c = 24000,
                                               .E_s = 130000,
                                               .X_r = 120000,
                                               .X_v = 40000,
                                               .H_f = 4,
                                               .S_l = 420,
                                               .S_v = 140,
                                               .L_v = 140000}};
  for (int k = 0; k < 3; k++) {
    const struct hsr_table1 *paper = &table2[k];
    struct hsr_table1 r = {
        .n = 500, .m = 500, .F_r = paper->F_r, .F_c = paper->F_c, .D_c = 3};
    hsr_statistics_rules(&r, &r);
    is(r.F_t, paper->F_t, "Table II: F_t");
    is(r.C_t, paper->C_t, "Table II: C_t");
    is(r.E_t, paper->E_t, "Table II: E_t");
    is(r.E_r, paper->E_r, "Table II: E_r");
    is_about(r.E_c, paper->E_c, 0.03, "Table II: E_c");
    is_about(r.E_s, paper->E_s, 0.03, "Table II: E_s");
    is(r.X_r, paper->X_r, "Table II: X_r");
    is_about(r.X_v, paper->X_v, 0.06, "Table II: X_v");
    is_about(r.H_f, paper->H_f, 0.13, "Table II: H_f");
    is_about(r.S_l, paper->S_l, 0.03, "Table II: S_l");
    is_about(r.S_v, paper->S_v, 0.16, "Table II: S_v");
    is_about(r.L_v, paper->L_v, 0.16, "Table II: L_v");
    is(r.S_f, 500 * r.S_l, "Table II: S_f");
    ok(isnan(r.C_r) && isnan(r.X_f), "Table II: no rule for C_r and X_f");
  }
  struct hsr_table1 thin = {.n = 500, .m = 500, .F_r = 9, .F_c = 2, .D_c = 0.5};
  hsr_statistics_rules(&thin, &thin);
  is(thin.X_r, 0, "a picture not filled: X_r");
  is(thin.S_v, thin.S_l, "a picture not filled: S_v");
}

int main(void) {
  test_box_front();
  test_box_all();
  test_corner();
  test_cross();
  test_hidden_crossing();
  test_touching();
  test_border();
  test_ball();
  test_floor();
  test_out();
  test_clusters();
  test_contour();
  test_triangles();
  test_tip();
  test_paddle_wheel();
  test_notch();
  test_foot();
  test_soup();
  test_nothing();
  test_pictures();
  test_rules();
  printf("1..%d\n", n_tests);
  return n_failed != 0;
}
