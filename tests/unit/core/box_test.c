/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Boxes against polyhedra and polygons: each stage of the test on its own
 * example, with its cost. tests/properties/hierarchical/boxes_test.cc has
 * random ones. */
#include "common/trees/box.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>

static struct hsr_box box(double x0, double y0, double z0, double x1, double y1,
                          double z1) {
  return (struct hsr_box){{x0, y0, z0}, {x1, y1, z1}};
}

static enum hsr_box_verdict classify(const struct hsr_polyhedron *poly,
                                     struct hsr_box b, unsigned *cut,
                                     unsigned *deciding) {
  struct hsr_box_work work = {0, 0};
  enum hsr_box_verdict verdict = hsr_box_classify(poly, &b, cut, &work);
  *deciding = work.deciding;
  return verdict;
}

/* A tetrahedron of four vertices; face f does not have vertex f. */
static struct hsr_polyhedron tetrahedron(const double *xyz) {
  static const int start[] = {0, 3, 6, 9, 12};
  static const int faces[] = {1, 2, 3, 0, 2, 3, 0, 1, 3, 0, 1, 2};
  struct hsr_polyhedron poly;
  hsr_polyhedron_init(&poly, 4, xyz, NULL, 4, start, faces);
  return poly;
}

/* x, y, z >= 0, x + y + z <= 4. */
static const double corner[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4};

static void test_boxes(struct tap *tap) {
  struct hsr_box unit = box(0, 0, 0, 1, 1, 1), next = box(1, 1, 1, 2, 3, 4),
                 apart = box(-1, -1, -2, 2, 2, -.5),
                 point = box(1, 0, 1, 1, 0, 1);
  ok(tap, hsr_boxes_meet(&unit, &next) && hsr_boxes_meet(&next, &unit),
     "boxes that share a corner meet");
  ok(tap, !hsr_boxes_meet(&unit, &apart) && !hsr_boxes_meet(&apart, &unit),
     "boxes one below the other do not");
  ok(tap,
     hsr_box_holds(&unit, &point) && hsr_box_holds(&unit, &unit) &&
         !hsr_box_holds(&unit, &next) && !hsr_box_holds(&point, &unit),
     "a box holds its corners and itself");
}

/* The inequalities that refine: whether the box holds the bounds, and the
 * p-vertices. */
static void test_refining(struct tap *tap) {
  struct hsr_polyhedron poly = tetrahedron(corner);
  struct hsr_box_work all = {0, 0}, some = {0, 0}, none = {0, 0};
  struct hsr_box bounds = box(0, 0, 0, 4, 4, 4), half = box(0, 0, 1, 4, 4, 5),
                 apart = box(0, 0, 5, 1, 1, 6);
  hsr_box_classify(&poly, &bounds, NULL, &all);
  hsr_box_classify(&poly, &half, NULL, &some);
  hsr_box_classify(&poly, &apart, NULL, &none);
  ok(tap, all.refining == 6 && some.refining == 5 + 4 && !none.refining,
     "6, 5 + 4 and 0 inequalities refine: %u, %u, %u", all.refining,
     some.refining, none.refining);
}

static void test_verdicts(struct tap *tap) {
  struct hsr_polyhedron poly = tetrahedron(corner);
  unsigned cut = 0, n;
  ok(tap, poly.n_planes == 4 && poly.n_lines == 9,
     "a tetrahedron has 4 planes and, here, 3 edge-lines in each view");
  ok(tap,
     classify(&poly, box(5, 0, 0, 6, 1, 1), &cut, &n) == HSR_BOX_OUT && n == 1,
     "out by the first inequality");
  ok(tap,
     classify(&poly, box(.1, .2, .3, 1, 1, 1.5), &cut, &n) == HSR_BOX_IN &&
         !cut && n == 6 + 4,
     "in, and no plane is cut");
  ok(tap,
     classify(&poly, box(.1, .2, .3, 1, 2, 1), &cut, &n) == HSR_BOX_PARTIAL &&
         cut == 1 && n == 6 + 4 + 9,
     "touched from inside, the sloping plane is cut");
  ok(tap,
     classify(&poly, box(0, .1, .2, 1, 1, 1), &cut, &n) == HSR_BOX_PARTIAL &&
         cut == 2,
     "so is the plane x = 0");
  ok(tap,
     classify(&poly, box(1, 1, 2, 5, 5, 5), &cut, &n) == HSR_BOX_PARTIAL &&
         cut == 1,
     "touched from outside, it is met");
  ok(tap,
     classify(&poly, box(-1, -1, -1, 4, 4, 4), &cut, &n) == HSR_BOX_PARTIAL &&
         cut == 15 && n == 6,
     "a box that holds it cuts all planes");
  struct hsr_box b = box(1, 1, 2.5, 5, 5, 5);
  ok(tap, hsr_box_classify(&poly, &b, NULL, NULL) == HSR_BOX_OUT,
     "nothing need be asked for beside the verdict");
}

/* Figure A.3: the projections meet in all three views, the solids do not. */
static void test_views_alone(struct tap *tap) {
  struct hsr_polyhedron poly = tetrahedron(corner);
  struct hsr_box b = box(1.5, 1.5, 1.5, 3, 3, 3);
  unsigned n;
  ok(tap, classify(&poly, b, NULL, &n) == HSR_BOX_OUT && n == 6 + 1,
     "a box beyond the sloping plane is out");
  for (int f = 0; f < poly.n_planes; f++)
    poly.plane[f].outer = INFINITY;
  ok(tap, classify(&poly, b, NULL, &n) == HSR_BOX_PARTIAL && n == 6 + 4 + 9,
     "by the three views alone it would be taken to meet");
}

/* An edge that passes an upright edge of the box, with planes on both sides
 * that cut the box. */
static void test_edge_lines(struct tap *tap) {
  static const double wedge[] = {4.1, -1.9, 4, -1.9, 4.1, -3,
                                 7,   7,    5, 7,    7,   -4};
  struct hsr_polyhedron poly = tetrahedron(wedge);
  struct hsr_box b = box(0, 0, 0, 1, 1, 1);
  unsigned n;
  ok(tap, classify(&poly, b, NULL, &n) == HSR_BOX_OUT && n > 6 + 4,
     "a box before an edge is out by an edge-line");
  poly.n_lines = 0;
  ok(tap, classify(&poly, b, NULL, &n) == HSR_BOX_PARTIAL && n == 6 + 4,
     "by the planes alone it would be taken to meet");
}

/* A triangle, and three triangles around a point of it: a flat solid. All
 * normals are (1, 1, 1), so the half spaces alone would also hold everything
 * below. */
static void test_flat(struct tap *tap) {
  static const double xyz[] = {4, 0, 0, 0, 4, 0, 0, 0, 4, 2, 1, 1};
  static const int start[] = {0, 3, 6, 9, 12};
  static const int faces[] = {1, 2, 3, 2, 0, 3, 0, 1, 3, 0, 1, 2};
  struct hsr_polyhedron poly;
  unsigned n, cut;
  hsr_polyhedron_init(&poly, 4, xyz, NULL, 4, start, faces);
  ok(tap,
     classify(&poly, box(.5, .5, .5, 1, 1, 1), &cut, &n) != HSR_BOX_IN &&
         cut == 15,
     "nothing is in a flat polyhedron");
  ok(tap,
     classify(&poly, box(1, 1, 2, 1, 1, 2), &cut, &n) == HSR_BOX_PARTIAL &&
         classify(&poly, box(2, 2, 2, 3, 3, 3), &cut, &n) == HSR_BOX_OUT,
     "but it is met, and what is above it is out");
}

/* Eye at the origin, looking along -z, 90 degrees: |x|, |y| <= -z. */
static struct hsr_view view(double near) {
  struct hsr_camera camera = {.at = {0, 0, -1}, .up = {0, 1, 0}, .fov = 90};
  struct hsr_view view;
  struct hsr_error err;
  camera.near = near;
  if (hsr_view_init(&view, &camera, 8, 8, &err))
    bail("%s", err.text);
  return view;
}

static void test_frustum(struct tap *tap) {
  struct hsr_view v = view(1);
  struct hsr_polyhedron poly;
  unsigned cut, n;
  hsr_frustum_init(&poly, &v, 8);
  ok(tap, poly.n_planes == 6 && poly.n_lines == 4 + 4 + 4,
     "a frustum has 6 planes and, along the axes, 4 edge-lines in each view");
  ok(tap, classify(&poly, box(-1, -1, -4, 1, 1, -2), &cut, &n) == HSR_BOX_IN,
     "a box amid the frustum is in");
  ok(tap,
     classify(&poly, box(-1, -1, -.5, 1, 1, 1), &cut, &n) == HSR_BOX_OUT &&
         classify(&poly, box(-1, -1, -11, 1, 1, -8.1), &cut, &n) == HSR_BOX_OUT,
     "before near and beyond far is out");
  struct {
    double x, y;
    enum hsr_frustum_plane plane;
  } sides[] = {{0, 4, HSR_FRUSTUM_TOP},
               {4, 0, HSR_FRUSTUM_RIGHT},
               {0, -4, HSR_FRUSTUM_BOTTOM},
               {-4, 0, HSR_FRUSTUM_LEFT}};
  bool right = true;
  for (int s = 0; s < 4; s++) {
    double x = sides[s].x, y = sides[s].y;
    right &= classify(&poly, box(x - 1, y - 1, -5, x + 1, y + 1, -4), &cut,
                      &n) == HSR_BOX_PARTIAL &&
             cut == 1u << sides[s].plane;
  }
  ok(tap, right, "a box at each side cuts just that side's plane");
  ok(tap,
     classify(&poly, box(0, 0, -2, 0, 0, -.5), &cut, &n) == HSR_BOX_PARTIAL &&
         cut == 1u << HSR_FRUSTUM_NEAR &&
         classify(&poly, box(0, 0, -9, 0, 0, -2), &cut, &n) ==
             HSR_BOX_PARTIAL &&
         cut == 1u << HSR_FRUSTUM_FAR,
     "so do those at near and far");
}

static void test_pyramid(struct tap *tap) {
  struct hsr_view v = view(0);
  struct hsr_polyhedron poly;
  unsigned cut, n;
  hsr_frustum_init(&poly, &v, 8);
  ok(tap, poly.n_planes == 5 && poly.n_lines == 4 + 3 + 3,
     "with near 0 it is a pyramid");
  ok(tap,
     classify(&poly, box(-1, -1, 0, 1, 1, 1), &cut, &n) == HSR_BOX_PARTIAL &&
         cut == 15,
     "the eye is part of it");
  ok(tap,
     classify(&poly, box(-1, -1, 0x1p-40, 1, 1, 1), &cut, &n) == HSR_BOX_OUT,
     "what is behind it is not");
  ok(tap,
     classify(&poly, box(-0x1p-22, 0, -0x1p-20, 0, 0x1p-22, -0x1p-20), &cut,
              &n) == HSR_BOX_IN,
     "very near the eye a box may be in");
}

/* Sample 3, 2 of 8 x 8 looks through (-1/8, 3/8, -1), its neighbours a quarter
 * of a unit from there. */
static void test_window(struct tap *tap) {
  struct hsr_view v = view(0);
  struct hsr_polyhedron poly;
  unsigned n, cut;
  v.window = (struct hsr_window){3, 2, 4, 3};
  hsr_frustum_init(&poly, &v, 8);
  struct hsr_box seen = box(-.125, .375, -1, -.125, .375, -1);
  ok(tap, classify(&poly, seen, &cut, &n) == HSR_BOX_IN,
     "what its one sample sees is in a window's frustum");
  bool others = true;
  for (int i = 0; i < 8; i++)
    for (int j = 0; j < 8; j++) {
      double x = (2 * i - 7) / 8., y = (7 - 2 * j) / 8.;
      others &= (i == 3 && j == 2) || classify(&poly, box(x, y, -1, x, y, -1),
                                               &cut, &n) == HSR_BOX_OUT;
    }
  ok(tap, others, "what any other sample sees is out");
}

/* The least box of doubles that is sure to hold the point at depth t on the ray
 * of a sample. */
static struct hsr_box point_seen(const struct hsr_view *v, int i, int j,
                                 double t) {
  struct hsr_box b;
  for (int k = 0; k < 3; k++) {
    double p = v->E[k] + t * (v->ray[0][k] + hsr_sample_x(v, i) * v->ray[1][k] +
                              hsr_sample_y(v, j) * v->ray[2][k]);
    b.lo[k] = nextafter(p, -INFINITY);
    b.hi[k] = nextafter(p, INFINITY);
  }
  return b;
}

/* A camera so far from the origin that the corners of a sample's frustum are
 * rounded by more than the distance between samples. */
static void test_far_from_origin(struct tap *tap) {
  struct hsr_camera camera = {.eye = {1e15, 1e15, 1e15},
                              .at = {1e15 + 3, 1e15 + 2, 1e15 - 8},
                              .up = {0, 1, 0},
                              .fov = 90,
                              .near = .25};
  struct hsr_view v;
  struct hsr_error err;
  struct hsr_polyhedron poly;
  unsigned n, cut;
  bool kept = !hsr_view_init(&v, &camera, 512, 512, &err), behind = true;
  for (int i = 0; i < 512; i += 7)
    for (int t = 1; t < 64; t += 3) {
      int j = 511 - i;
      v.window = (struct hsr_window){i, j, i + 1, j + 1};
      hsr_frustum_init(&poly, &v, 64);
      kept &=
          classify(&poly, point_seen(&v, i, j, t), &cut, &n) == HSR_BOX_PARTIAL;
      behind &=
          classify(&poly, point_seen(&v, i, j, -t), &cut, &n) == HSR_BOX_OUT;
    }
  ok(tap, kept, "far from the origin nothing that is seen is out");
  ok(tap, behind, "but what is behind is");
}

/* --- Polygons ------------------------------------------------------------- */

static bool meets(struct hsr_box b, const double *xyz, uint32_t n_corners,
                  double slack) {
  static const uint32_t in_turn[] = {0, 1, 2, 3};
  static const double normal[] = {1, 1, 1};
  struct hsr_loop loop = {xyz, xyz + 1, xyz + 2, 3, in_turn, n_corners};
  struct hsr_eight_boxes boxes;
  for (int o = 0; o < 8; o++) { /* all others are far away */
    struct hsr_box away = box(90, 90, 90, 99, 99, 99);
    hsr_put_box(&boxes, o, o == 5 ? &b : &away);
  }
  return hsr_boxes_that_meet_polygon(&boxes, loop, normal, slack) == 1u << 5;
}

static void test_polygon(struct tap *tap) {
  /* x + y + z = 4 */
  static const double face[] = {4, 0, 0, 0, 4, 0, 0, 0, 4};
  ok(tap, meets(box(1, 1, 1, 2, 2, 2), face, 3, 0),
     "a box on both sides of a triangle meets it");
  ok(tap,
     meets(box(1, 1, 2, 5, 5, 5), face, 3, 0) &&
         meets(box(0, 0, 0, 1, 1, 2), face, 3, 0) &&
         meets(box(0, 4, 0, 0, 4, 0), face, 3, 0) &&
         meets(box(-1, -1, -1, 2, 2, 0), face, 3, 0),
     "touching it by a corner, from either side, or an edge, is meeting");
  ok(tap,
     !meets(box(1.5, 1.5, 1.5, 3, 3, 3), face, 3, 0) &&
         !meets(box(0, 0, 0, 1, 1, 1), face, 3, 0),
     "a box beyond its plane, or before it, does not, though all views do");
  ok(tap, !meets(box(2.5, 2.5, -2, 3.5, 3.5, 1), face, 3, 0),
     "nor one that is on the plane but, in a view, outside an edge");
  ok(tap,
     meets(box(1.5, 1.5, 1.5, 3, 3, 3), face, 3, .25) &&
         !meets(box(1.5, 1.5, 1.5, 3, 3, 3), face, 3, .125),
     "slack moves the plane");
  static const double edge_on[] = {2, 2, 0, 2, 2, 4, 1, 3, 4, 1, 3, 0};
  ok(tap,
     meets(box(0, 0, 1, 2, 2, 2), edge_on, 4, 0) &&
         !meets(box(0, 0, 1, 1.9, 2, 2), edge_on, 4, 0),
     "a polygon that is seen edge-on");
}

int main(void) {
  struct tap tap = plan(37);
  test_boxes(&tap);
  test_refining(&tap);
  test_verdicts(&tap);
  test_views_alone(&tap);
  test_edge_lines(&tap);
  test_flat(&tap);
  test_frustum(&tap);
  test_pyramid(&tap);
  test_window(&tap);
  test_far_from_origin(&tap);
  test_polygon(&tap);
  return finish(&tap);
}
