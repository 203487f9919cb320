/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The services of common/exact/screen.h against the exact predicates, on scenes
 * where the filters often cannot decide; services that need no screen against
 * those that do; and the arena that they use. */
#include "common/view/clip.h"
#include "common/exact/order.h"
#include "common/exact/predicates.h"
#include "common/exact/screen.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SCENES = 150, M = 19, N = 14, ZIGZAG = 40 };

struct fixture {
  struct hsr_scene *scene;
  struct hsr_world world;
  struct hsr_view view;
  struct hsr_screen screen;
  struct hsr_arena arena;
  struct hsr_tally tally;
};

/* Faces of 3 to 5 corners among small integers, planar or not, in front of the
 * eye and behind it. */
static void add_faces(uint64_t *seed, struct hsr_object *object) {
  int wanted = (int)draw_integer(seed, 2, 12);
  while (object->n_faces < (uint32_t)wanted) {
    uint32_t vertex[5], n = (uint32_t)draw_integer(seed, 3, 5);
    for (uint32_t k = 0; k < n; k++)
      hsr_object_vertex(object, (double)draw_integer(seed, -3, 3),
                        (double)draw_integer(seed, -3, 3),
                        (double)draw_integer(seed, -3, 3), &vertex[k]);
    struct hsr_loop loop = {object->xyz, object->xyz + 1, object->xyz + 2,
                            3,           vertex,          n};
    bool out_of_memory = false;
    if (hsr_exact_has_normal(loop, &out_of_memory))
      hsr_object_face(object, vertex, n, NULL);
  }
}

/* A face all of whose edges cross most rows, in one plane. */
static void add_zigzag(uint64_t *seed, struct hsr_object *object) {
  static const int coprime[] = {1, 3, 7, 9, 11, 13};
  int step = coprime[draw_integer(seed, 0, 5)];
  uint32_t vertex[ZIGZAG];
  for (int k = 0; k < ZIGZAG; k++)
    hsr_object_vertex(object, (k * step % ZIGZAG - ZIGZAG / 2) / 8.0,
                      k % 2 ? 3
                      : k   ? -3
                            : -2,
                      -2, &vertex[k]);
  if (hsr_object_face(object, vertex, ZIGZAG, NULL))
    bail("the zigzag is no face");
}

static struct fixture *set_up(uint64_t *seed) {
  struct fixture *x = calloc(1, sizeof *x);
  struct hsr_error err = {.text = "out of memory"};
  x->scene = hsr_scene_new("screen");
  struct hsr_object *object = hsr_scene_object(x->scene, "faces");
  object->one_sided = draw_integer(seed, 0, 1);
  add_faces(seed, object);
  if (!draw_integer(seed, 0, 3))
    add_zigzag(seed, object);
  struct hsr_camera camera = {.eye = {(double)draw_integer(seed, -1, 1),
                                      (double)draw_integer(seed, -1, 1),
                                      (double)draw_integer(seed, 0, 5)},
                              .up = {0, 1, 0},
                              .fov = 90,
                              .near = (double)draw_integer(seed, 0, 2) / 2};
  memcpy(camera.at, camera.eye, sizeof camera.at);
  camera.at[2] -= 1;
  must_finish(x->scene);
  must_world(&x->world, x->scene);
  must_view(&x->view, &camera, M, N);
  if (hsr_screen_make(&x->screen, &x->world, &x->view, &x->arena, &x->tally))
    bail("%s", err.text);
  return x;
}

static void tear_down(struct fixture *x) {
  hsr_arena_free(&x->arena);
  hsr_world_free(&x->world);
  hsr_scene_delete(x->scene);
  free(x);
}

static void vertex(const struct fixture *x, uint32_t v, double p[3]) {
  p[0] = x->world.mesh.x[v];
  p[1] = x->world.mesh.y[v];
  p[2] = x->world.mesh.z[v];
}

/* The number of wrong answers of each service. */
struct wrong {
  long row, first_row, edge, column, spans, nearer, vertex, in_front, culled,
      anywhere, loops, ranges, asked, rows, by_rows;
};

static void try_vertices(struct fixture *x, struct wrong *wrong) {
  bool out_of_memory = false;
  for (uint32_t v = 0; v < x->world.mesh.n_vertices; v++) {
    double p[3];
    int first = N;
    vertex(x, v, p);
    for (int j = N - 1; j >= 0; j--) {
      int side = hsr_exact_row_side(&x->view, p, hsr_sample_y(&x->view, j),
                                    &out_of_memory);
      wrong->row += side != hsr_row_side(&x->screen, v, j, &x->tally);
      first = side < 0 ? j : first;
      wrong->asked++;
    }
    if (x->screen.sx[v] == x->screen.sx[v])
      wrong->first_row += first != hsr_vertex_row(&x->screen, v, &x->tally);
  }
}

static void try_edge(struct fixture *x, bool whole, uint32_t a, uint32_t b,
                     struct wrong *wrong) {
  bool out_of_memory = false;
  double p[3], q[3];
  vertex(x, a, p);
  vertex(x, b, q);
  for (int j = 0; j < N; j++) {
    int first = M, left = 0;
    for (int i = M - 1; i >= 0; i--) {
      int side = hsr_exact_edge_side(&x->view, p, q, hsr_sample_x(&x->view, i),
                                     hsr_sample_y(&x->view, j), &out_of_memory);
      wrong->edge += side != hsr_edge_side(&x->screen, a, b, i, j, &x->tally);
      first = side <= 0 ? i : first;
      left += side > 0;
      wrong->asked++;
    }
    if (whole && hsr_row_side(&x->screen, a, j, &x->tally) < 0 &&
        hsr_row_side(&x->screen, b, j, &x->tally) > 0) {
      struct hsr_edge edge;
      hsr_edge_init(&edge, &x->screen, a, b);
      wrong->column += first != left || hsr_edge_column(&x->screen, &edge, j,
                                                        &x->tally) != first;
    }
  }
}

/* Spans against the surround test, sample by sample. Faces that the culls leave
 * out must cover no sample. */
static void try_face(struct fixture *x, uint32_t f, bool relevant,
                     struct wrong *wrong) {
  int columns[ZIGZAG + 4];
  if (!relevant) {
    if (!hsr_face_exists(&x->screen, f, &x->tally))
      return;
    x->screen.whole[f] = false; /* not known to be whole: ask everything */
  }
  const struct hsr_bounds *box = &x->screen.bounds[f];
  struct hsr_face_rows rows;
  hsr_face_rows_begin(&rows, &x->screen, f, &x->tally);
  for (int j = 0; j < N; j++) {
    int again[ZIGZAG + 4];
    int n = hsr_face_spans(&x->screen, f, j, columns, &x->tally);
    wrong->rows += hsr_face_rows_spans(&rows, j, again, &x->tally) != n ||
                   memcmp(columns, again, (size_t)n * sizeof *columns) != 0;
    wrong->by_rows += rows.n > 0;
    for (int i = 0; i < M; i++) {
      bool in_span = false;
      for (int k = 0; k < n; k += 2)
        in_span |= i >= columns[k] && i < columns[k + 1];
      bool covered = hsr_covers(&x->screen, f, i, j, &x->tally);
      bool in_box = relevant && i >= box->x0 && i < box->x1 && j >= box->y0 &&
                    j < box->y1;
      wrong->spans += covered != in_span;
      wrong->culled += covered && !in_box;
    }
  }
}

/* No sample is out of the depth range of its face. */
static void try_range(struct fixture *x, uint32_t f, struct wrong *wrong) {
  double nearest, farthest, lo = 0, hi = INFINITY;
  double error = x->screen.plane[f].error;
  hsr_depth_range(&x->screen, (struct hsr_polygon){.face = f}, &nearest,
                  &farthest);
  hsr_narrow_depth_range(&x->screen, f, &x->screen.bounds[f], &lo, &hi);
  for (int j = 0; j < N; j++)
    for (int i = 0; i < M; i++) {
      double q = hsr_depth(&x->screen, f, i, j);
      if (q > error && hsr_covers(&x->screen, f, i, j, &x->tally))
        wrong->ranges += !(fmax(nearest, lo) <= 1 / (q - error) &&
                           1 / (q + error) <= fmin(farthest, hi));
    }
}

static struct hsr_loop loop_of(const struct hsr_world *w, uint32_t f) {
  return (struct hsr_loop){w->mesh.x,
                           w->mesh.y,
                           w->mesh.z,
                           1,
                           w->mesh.vertex + w->mesh.start[f],
                           hsr_face_size(w, f)};
}

/* The surround test from corners alone. */
static void try_loop(struct fixture *x, uint32_t f, struct wrong *wrong) {
  struct hsr_loop loop = loop_of(&x->world, f);
  for (int j = 0; j < N; j += 2)
    for (int i = 0; i < M; i += 3) {
      double sx = hsr_sample_x(&x->view, i), sy = hsr_sample_y(&x->view, j);
      bool covers = hsr_loop_surrounds(&x->view, loop, sx, sy, &x->tally) &&
                    hsr_loop_beyond_near(&x->view, loop, sx, sy, &x->tally);
      wrong->loops += covers != hsr_covers(&x->screen, f, i, j, &x->tally);
    }
}

static void try_faces(struct fixture *x, struct wrong *wrong) {
  const struct hsr_world *w = &x->world;
  uint32_t next = 0;
  for (uint32_t f = 0; f < w->n_faces; f++) {
    bool relevant =
        next < x->screen.n_relevant && x->screen.relevant[next] == f;
    next += relevant;
    for (uint32_t k = w->mesh.start[f]; k < w->mesh.start[f + 1]; k++) {
      uint32_t a = w->mesh.vertex[k],
               b = w->mesh
                       .vertex[k + 1 < w->mesh.start[f + 1] ? k + 1
                                                            : w->mesh.start[f]];
      try_edge(x, relevant && x->screen.whole[f], a, b, wrong);
    }
    try_face(x, f, relevant, wrong);
    if (relevant)
      try_loop(x, f, wrong);
    if (relevant)
      try_range(x, f, wrong);
  }
}

static void try_pair(struct fixture *x, uint32_t f, uint32_t g,
                     struct wrong *wrong) {
  bool out_of_memory = false;
  for (int j = 0; j < N; j += 3)
    for (int i = 0; i < M; i += 2) {
      int exact = hsr_exact_nearer(
          &x->view, loop_of(&x->world, f), loop_of(&x->world, g),
          hsr_sample_x(&x->view, i), hsr_sample_y(&x->view, j), &out_of_memory);
      bool wanted = exact ? exact > 0 : f < g;
      wrong->nearer += wanted != hsr_nearer(&x->screen, f, g, i, j, &x->tally);
      wrong->nearer +=
          (exact == 0) != (x->world.mesh.plane[f] == x->world.mesh.plane[g]);
    }
  uint64_t seed = 64 * f + g;
  for (int k = 0; k < 20; k++) { /* anywhere in the picture, also on borders */
    double sx = (double)draw_integer(&seed, 0, 8 * M) / 8;
    double sy = (double)draw_integer(&seed, 0, 8 * N) / 8;
    int exact = hsr_exact_nearer(&x->view, loop_of(&x->world, f),
                                 loop_of(&x->world, g), sx, sy, &out_of_memory);
    bool wanted = exact ? exact > 0 : f < g;
    wrong->anywhere +=
        wanted != hsr_nearer_at(&x->screen, f, g, sx, sy, &x->tally);
    int side = hsr_loop_cut_side(&x->view, loop_of(&x->world, f),
                                 loop_of(&x->world, g), sx, sy, &x->tally);
    wrong->anywhere += exact == 0 && side != 0;
  }
}

/* At the vertices of f: against the exact predicate; and, if f is a triangle
 * and so has its vertices in its plane, against the sides of g's plane. */
static void try_pair_at_vertices(struct fixture *x, uint32_t f, uint32_t g,
                                 struct wrong *wrong) {
  const struct hsr_world *w = &x->world;
  bool out_of_memory = false, all_in_front = true;
  int eye = hsr_exact_plane_side(loop_of(w, g), x->view.E, &out_of_memory);
  for (uint32_t k = w->mesh.start[f]; k < w->mesh.start[f + 1]; k++) {
    double p[3];
    vertex(x, w->mesh.vertex[k], p);
    int got = hsr_vertex_nearer(&x->screen, f, g, w->mesh.vertex[k], &x->tally);
    wrong->vertex +=
        got != hsr_exact_nearer_towards(&x->view, loop_of(w, f), loop_of(w, g),
                                        p, &out_of_memory);
    if (hsr_face_size(w, f) == 3)
      wrong->vertex +=
          got != eye * hsr_exact_plane_side(loop_of(w, g), p, &out_of_memory);
    all_in_front &= got >= 0;
  }
  for (int j = 0; j < N && all_in_front && w->mesh.plane[f] != w->mesh.plane[g];
       j++)
    for (int i = 0; i < M; i++)
      wrong->in_front += hsr_covers(&x->screen, f, i, j, &x->tally) &&
                         !hsr_nearer(&x->screen, f, g, i, j, &x->tally);
}

static void try_services(struct tap *tap) {
  struct wrong wrong = {.asked = 0};
  uint64_t seed = 7, exact = 0;
  for (int k = 0; k < SCENES; k++) {
    struct fixture *x = set_up(&seed);
    try_vertices(x, &wrong);
    try_faces(x, &wrong);
    for (uint32_t r = 1; r < x->screen.n_relevant; r++)
      for (uint32_t s = 0; s < r; s++)
        try_pair(x, x->screen.relevant[r], x->screen.relevant[s], &wrong);
    for (uint32_t r = 0; r < x->screen.n_relevant; r++)
      for (uint32_t s = 0; s < x->screen.n_relevant; s++)
        if (r != s && x->screen.whole[x->screen.relevant[r]])
          try_pair_at_vertices(x, x->screen.relevant[r], x->screen.relevant[s],
                               &wrong);
    for (int q = 0; q < HSR_N_QUESTIONS; q++)
      exact += x->tally.exact[q];
    tear_down(x);
  }
  ok(tap, wrong.row == 0, "row sides: %ld wrong", wrong.row);
  ok(tap, wrong.first_row == 0, "first rows: %ld wrong", wrong.first_row);
  ok(tap, wrong.edge == 0, "edge sides: %ld wrong", wrong.edge);
  ok(tap, wrong.column == 0, "edge columns: %ld wrong", wrong.column);
  ok(tap, wrong.spans == 0, "face spans: %ld wrong", wrong.spans);
  ok(tap, wrong.rows == 0 && wrong.by_rows > 1000,
     "spans of a face's rows: %ld of %ld wrong", wrong.rows, wrong.by_rows);
  ok(tap, wrong.culled == 0, "culls: %ld covered samples lost", wrong.culled);
  ok(tap, wrong.nearer == 0, "nearer: %ld wrong", wrong.nearer);
  ok(tap, wrong.anywhere == 0, "nearer anywhere: %ld wrong", wrong.anywhere);
  ok(tap, wrong.loops == 0, "coverage by corners: %ld wrong", wrong.loops);
  ok(tap, wrong.ranges == 0, "depth ranges: %ld samples out of them",
     wrong.ranges);
  ok(tap, wrong.vertex == 0, "nearer at vertices: %ld wrong", wrong.vertex);
  ok(tap, wrong.in_front == 0,
     "in front at all vertices, so everywhere: %ld samples wrong",
     wrong.in_front);
  ok(tap, exact > 1000, "the exact path was taken: %llu times",
     (unsigned long long)exact);
}

/* --- Near ties ------------------------------------------------------------ */

/* All but a tie: vertices about a sample's row, edges about the sample, faces
 * about a point of its ray or about the eye. Doubles put each a few roundings
 * to either side. So every filter is asked where it is hard to tell. */
enum { NEAR_ROUNDS = 600, NEAR_ROWS = 6, NEAR_EDGES = 6, NEAR_FACES = 15 };

struct near {
  struct fixture f;
  int i, j;
  double t, point[3];           /* on the sample's ray */
  uint32_t row[NEAR_ROWS];      /* vertices */
  uint32_t edge[NEAR_EDGES][2]; /* their ends */
};

static double draw_real(uint64_t *seed, double lo, double hi) {
  return lo + (hi - lo) * ((double)draw_integer(seed, 0, 1ll << 52) * 0x1p-52);
}

/* Of any size between two powers of two, and of either sign. */
static double draw_size(uint64_t *seed, double lo, double hi) {
  double size = exp2(draw_real(seed, lo, hi));
  return draw_integer(seed, 0, 1) ? size : -size;
}

static void draw_vector(uint64_t *seed, double size, double v[3]) {
  for (int k = 0; k < 3; k++)
    v[k] = draw_real(seed, -size, size);
}

static void along_ray(const struct hsr_view *view, double sx, double sy,
                      double t, double p[3]) {
  for (int k = 0; k < 3; k++)
    p[k] = view->E[k] +
           t * (view->ray[0][k] + sx * view->ray[1][k] + sy * view->ray[2][k]);
}

static uint32_t near_vertex(struct near *x, const double p[3]) {
  uint32_t v = 0;
  hsr_object_vertex(&x->f.scene->objects[0], p[0], p[1], p[2], &v);
  return v;
}

static bool near_view(struct near *x, uint64_t *seed) {
  static const int sizes[][2] = {{3, 2}, {19, 14}, {512, 384}};
  static const double fovs[] = {20, 90, 150, 179.99};
  static const double far[] = {0, 1, 1000, 1e6};
  const int *size = sizes[draw_integer(seed, 0, 2)];
  struct hsr_camera camera = {.fov = fovs[draw_integer(seed, 0, 3)]};
  double towards[3];
  draw_vector(seed, far[draw_integer(seed, 0, 3)], camera.eye);
  draw_vector(seed, 1, towards);
  draw_vector(seed, 1, camera.up);
  for (int k = 0; k < 3; k++)
    camera.at[k] = camera.eye[k] + towards[k];
  return !hsr_view_init(&x->f.view, &camera, size[0], size[1], NULL);
}

static void near_rows(struct near *x, uint64_t *seed) {
  double sy = hsr_sample_y(&x->f.view, x->j);
  for (int k = 0; k < NEAR_ROWS; k++) {
    double p[3];
    along_ray(&x->f.view, draw_size(seed, 0, 15), sy,
              draw_integer(seed, 0, 3) ? fabs(draw_size(seed, -3, 3))
                                       : draw_size(seed, -3, 3),
              p);
    x->row[k] = near_vertex(x, p);
  }
}

static void near_edges(struct near *x, uint64_t *seed) {
  double sy = hsr_sample_y(&x->f.view, x->j);
  for (int k = 0; k < NEAR_EDGES; k++) {
    /* Of the row, or one beyond its ends. */
    double sx =
        hsr_sample_x(&x->f.view, (int)draw_integer(seed, -1, x->f.view.m));
    double dx = draw_size(seed, -8, 14), dy = draw_size(seed, -8, 14);
    bool behind = !draw_integer(seed, 0, 2);
    for (int end = 0; end < 2; end++) {
      double along = (end ? 1 : -1) * draw_real(seed, 0, 1), p[3];
      along_ray(&x->f.view, sx + along * dx, sy + along * dy,
                behind ? draw_size(seed, -3, 3) : fabs(draw_size(seed, -3, 3)),
                p);
      x->edge[k][end] = near_vertex(x, p);
    }
  }
}

/* A face of three or four corners in a plane about p: p + u, p + v and so on, p
 * within it or, to a rounding, a corner. */
static void near_face(struct near *x, uint64_t *seed, const double p[3],
                      const double u[3], const double v[3], bool is_corner) {
  uint32_t vertex[4], n = draw_integer(seed, 0, 2) ? 3 : 4;
  double a = draw_real(seed, .3, 1), b = draw_real(seed, .3, 1);
  for (uint32_t c = 0; c < n; c++) {
    double by_u = c == 0 ? 1 : c == 2 ? -a : 0;
    double by_v = c == 1 ? 1 : c == n - 1 ? -b : 0, corner[3];
    if (is_corner && c == 2)
      by_u = by_v = 0;
    if (is_corner && c == 3)
      by_u = a;
    for (int k = 0; k < 3; k++)
      corner[k] = p[k] + by_u * u[k] + by_v * v[k];
    vertex[c] = near_vertex(x, corner);
  }
  hsr_object_face(&x->f.scene->objects[0], vertex, n, NULL);
}

/* Across the view at depth t, as wide as `size`. */
static void near_across(struct near *x, uint64_t *seed, double t, double size) {
  const struct hsr_view *view = &x->f.view;
  double u[3], v[3], p[3];
  along_ray(view, hsr_sample_x(view, x->i), hsr_sample_y(view, x->j), t, p);
  double a = draw_size(seed, -3, 0), b = draw_size(seed, -3, 0);
  for (int k = 0; k < 3; k++) {
    u[k] = size * (a * view->R[k] + b * view->U[k]);
    v[k] = size * (-b * view->R[k] + a * view->U[k]);
  }
  near_face(x, seed, p, u, v, false);
}

/* Warped, and its plane nearer to the eye than its corners are to it. */
static void near_warped(struct near *x, uint64_t *seed) {
  double u[3], v[3], warp = exp2(draw_real(seed, -20, -2));
  uint32_t vertex[4];
  draw_vector(seed, 1, u);
  draw_vector(seed, 1, v);
  double n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                 u[0] * v[1] - u[1] * v[0]};
  double off = draw_real(seed, -1, 1) * warp;
  for (int c = 0; c < 4; c++) {
    double corner[3];
    for (int k = 0; k < 3; k++)
      corner[k] = x->f.view.E[k] + off * n[k] + (c % 2 ? warp : -warp) * n[k] +
                  (c < 2 ? 1 : -1) * (c % 2 ? v[k] : u[k]);
    vertex[c] = near_vertex(x, corner);
  }
  hsr_object_face(&x->f.scene->objects[0], vertex, 4, NULL);
}

static void near_faces(struct near *x, uint64_t *seed) {
  for (int k = 0; k < NEAR_FACES - 5; k++) {
    double u[3], v[3], size = fabs(draw_size(seed, -4, 2));
    draw_vector(seed, size, u);
    draw_vector(seed, size, v);
    if (k % 3 == 1) { /* thin: of its normal less is certain */
      double thin = exp2(draw_real(seed, -30, -4));
      for (int c = 0; c < 3; c++)
        v[c] = -.8 * u[c] + thin * v[c];
    }
    near_face(x, seed, k < 2 ? x->f.view.E : x->point, u, v, k >= 6);
  }
  near_across(x, seed, x->t, 1);
  near_across(x, seed, x->t, 1);
  near_across(x, seed, exp2(draw_real(seed, -14, -4)), 1);
  near_warped(x, seed);
  const struct hsr_object *object = &x->f.scene->objects[0];
  const uint32_t *first = object->vertex + object->start[2];
  const uint32_t turned[] = {first[2], first[1], first[0]};
  hsr_object_face(&x->f.scene->objects[0], turned, 3, NULL);
}

/* False if there is no such scene, a face being without area. */
static bool near_make(struct near *x, uint64_t *seed) {
  *x = (struct near){.f.scene = hsr_scene_new("near")};
  struct hsr_object *object = hsr_scene_object(x->f.scene, "faces");
  object->one_sided = draw_integer(seed, 0, 1);
  if (!near_view(x, seed))
    return false;
  x->i = (int)draw_integer(seed, 0, x->f.view.m - 1);
  x->j = (int)draw_integer(seed, 0, x->f.view.n - 1);
  x->t = exp2(draw_real(seed, -2, 3));
  along_ray(&x->f.view, hsr_sample_x(&x->f.view, x->i),
            hsr_sample_y(&x->f.view, x->j), x->t, x->point);
  if (draw_integer(seed, 0, 1))
    x->f.view.near = x->t;
  near_rows(x, seed);
  near_edges(x, seed);
  near_faces(x, seed);
  return !hsr_scene_finish(x->f.scene, NULL) &&
         !hsr_world_init(&x->f.world, x->f.scene, NULL) &&
         !hsr_screen_make(&x->f.screen, &x->f.world, &x->f.view, &x->f.arena,
                          &x->f.tally);
}

/* Wrong answers of each service, and how many were asked. */
struct near_wrong {
  long row, first_row, edge, column, facing, nearer, vertex, cut, order, plane;
  long flat, covers, asked, n_same;
};

/* The first row whose line is below the vertex or on it. */
static bool is_first_row(struct near *x, uint32_t v, int row) {
  bool out_of_memory = false;
  double p[3];
  vertex(&x->f, v, p);
  const struct hsr_view *view = &x->f.view;
  return (row == view->n || hsr_exact_row_side(view, p, hsr_sample_y(view, row),
                                               &out_of_memory) < 0) &&
         (row == 0 || hsr_exact_row_side(view, p, hsr_sample_y(view, row - 1),
                                         &out_of_memory) > 0);
}

static void try_near_edges(struct near *x, struct near_wrong *wrong) {
  struct fixture *f = &x->f;
  bool out_of_memory = false;
  for (int k = 0; k < NEAR_ROWS; k++) {
    double p[3];
    vertex(f, x->row[k], p);
    wrong->row += hsr_exact_row_side(&f->view, p, hsr_sample_y(&f->view, x->j),
                                     &out_of_memory) !=
                  hsr_row_side(&f->screen, x->row[k], x->j, &f->tally);
    if (!isnan(f->screen.sx[x->row[k]]))
      wrong->first_row += !is_first_row(
          x, x->row[k], hsr_vertex_row(&f->screen, x->row[k], &f->tally));
  }
  for (int k = 0; k < NEAR_EDGES; k++) {
    uint32_t a = x->edge[k][0], b = x->edge[k][1];
    double p[3], q[3], sy = hsr_sample_y(&f->view, x->j);
    int first = 0;
    vertex(f, a, p);
    vertex(f, b, q);
    for (int i = x->f.view.m - 1; i >= 0; i--) {
      int side = hsr_exact_edge_side(&f->view, p, q, hsr_sample_x(&f->view, i),
                                     sy, &out_of_memory);
      wrong->edge +=
          side != hsr_edge_side(&f->screen, a, b, i, x->j, &f->tally);
      first += side > 0;
    }
    if (isnan(f->screen.sx[a]) || isnan(f->screen.sx[b]) ||
        hsr_exact_row_side(&f->view, p, sy, &out_of_memory) > 0 ||
        hsr_exact_row_side(&f->view, q, sy, &out_of_memory) < 0)
      continue;
    struct hsr_edge edge;
    hsr_edge_init(&edge, &f->screen, a, b);
    wrong->column +=
        first != hsr_edge_column(&f->screen, &edge, x->j, &f->tally);
    wrong->asked++;
  }
}

/* Are all vertices of f on this side of the plane of g? They may touch it if
 * both are flat. */
static bool all_on_side(const struct fixture *x, uint32_t f, uint32_t g,
                        int side) {
  const struct hsr_world *w = &x->world;
  bool all = true, out_of_memory = false;
  for (uint32_t k = w->mesh.start[f]; k < w->mesh.start[f + 1]; k++) {
    double p[3];
    vertex(x, w->mesh.vertex[k], p);
    int at = side * hsr_exact_plane_side(loop_of(w, g), p, &out_of_memory);
    all &= at > 0 || (at == 0 && w->mesh.deviation[f] == 0);
  }
  return all;
}

static void try_near_pair(struct near *x, uint32_t g, uint32_t h,
                          struct near_wrong *wrong) {
  struct fixture *f = &x->f;
  const struct hsr_world *w = &f->world;
  struct hsr_loop at_g = loop_of(w, g), at_h = loop_of(w, h);
  bool out_of_memory = false, same = w->mesh.plane[g] == w->mesh.plane[h];
  double sx = hsr_sample_x(&f->view, x->i), sy = hsr_sample_y(&f->view, x->j);
  wrong->plane += same != hsr_exact_same_plane(at_g, at_h, &out_of_memory);
  if (same) {
    wrong->nearer +=
        hsr_nearer(&f->screen, g, h, x->i, x->j, &f->tally) != (g < h);
    wrong->n_same++;
    return;
  }
  int exact = hsr_exact_nearer(&f->view, at_g, at_h, sx, sy, &out_of_memory);
  wrong->nearer +=
      (exact > 0) != hsr_nearer(&f->screen, g, h, x->i, x->j, &f->tally);
  if (hsr_exact_ahead(&f->view, at_g, sx, sy, &out_of_memory) > 0)
    wrong->cut +=
        hsr_exact_cut_side(&f->view, at_g, at_h, sx, sy, &out_of_memory) !=
        hsr_cut_side(&f->screen, g, h, x->i, x->j, &f->tally);
  for (uint32_t k = w->mesh.start[g]; k < w->mesh.start[g + 1]; k++) {
    uint32_t v = w->mesh.vertex[k];
    double p[3];
    vertex(f, v, p);
    if (isnan(f->screen.sx[v]))
      continue;
    wrong->vertex +=
        hsr_vertex_nearer(&f->screen, g, h, v, &f->tally) !=
        hsr_exact_nearer_towards(&f->view, at_g, at_h, p, &out_of_memory);
  }
  int eye = hsr_exact_plane_side(at_h, f->view.E, &out_of_memory);
  for (int side = -1; side <= 1; side += 2) {
    struct hsr_polygon polygon = {.face = g};
    enum hsr_certainty is = side < 0
                                ? hsr_beyond(&f->screen, polygon, h, &f->tally)
                                : hsr_before(&f->screen, polygon, h, &f->tally);
    if (at_g.n > 3 || at_h.n > 3)
      wrong->order += is == HSR_YES && !all_on_side(f, g, h, side * eye);
    else
      wrong->order +=
          is != (all_on_side(f, g, h, side * eye) ? HSR_YES : HSR_NO);
  }
}

/* At the sample, which for some faces is about a corner; and of faces that are
 * about as far as near. */
static void try_near_cover(struct near *x, uint32_t g, bool relevant,
                           struct near_wrong *wrong) {
  struct fixture *f = &x->f;
  const struct hsr_bounds *b = &f->screen.bounds[g];
  int columns[16], n = 0;
  double sx = hsr_sample_x(&f->view, x->i), sy = hsr_sample_y(&f->view, x->j);
  bool in_span = false;
  bool is =
      hsr_loop_surrounds(&f->view, loop_of(&f->world, g), sx, sy, &f->tally) &&
      hsr_loop_beyond_near(&f->view, loop_of(&f->world, g), sx, sy, &f->tally);
  wrong->asked++;
  if (!relevant) {
    wrong->covers += is;
    return;
  }
  wrong->covers +=
      is && !(x->i >= b->x0 && x->i < b->x1 && x->j >= b->y0 && x->j < b->y1);
  wrong->covers += is != hsr_covers(&f->screen, g, x->i, x->j, &f->tally);
  n = hsr_face_spans(&f->screen, g, x->j, columns, &f->tally);
  for (int k = 0; k < n; k += 2)
    in_span |= x->i >= columns[k] && x->i < columns[k + 1];
  wrong->covers += is != in_span;
}

static void try_near_faces(struct near *x, struct near_wrong *wrong) {
  struct fixture *f = &x->f;
  const struct hsr_world *w = &f->world;
  bool out_of_memory = false, exists[NEAR_FACES];
  for (uint32_t g = 0; g < w->n_faces; g++) {
    int eye = hsr_exact_plane_side(loop_of(w, g), f->view.E, &out_of_memory);
    exists[g] = eye > 0 || (eye < 0 && !w->mesh.one_sided[g]);
    wrong->facing += (f->screen.facing[g] && f->screen.facing[g] != eye) ||
                     exists[g] != hsr_face_exists(&f->screen, g, &f->tally);
    wrong->flat += (w->mesh.deviation[g] == 0) !=
                   hsr_is_flat(loop_of(w, g), &out_of_memory);
  }
  uint32_t next = 0;
  for (uint32_t g = 0; g < w->n_faces; g++) {
    bool relevant =
        next < f->screen.n_relevant && f->screen.relevant[next] == g;
    next += relevant;
    if (exists[g])
      try_near_cover(x, g, relevant, wrong);
    for (uint32_t h = 0; h < w->n_faces; h++)
      if (g != h && exists[g] && exists[h])
        try_near_pair(x, g, h, wrong);
  }
}

static void try_near(struct tap *tap) {
  struct near_wrong wrong = {.asked = 0};
  uint64_t seed = 11, exact[HSR_N_QUESTIONS] = {0};
  int n_made = 0;
  for (int round = 0; round < NEAR_ROUNDS; round++) {
    struct near x;
    if (near_make(&x, &seed)) {
      n_made++;
      try_near_edges(&x, &wrong);
      try_near_faces(&x, &wrong);
    }
    for (int q = 0; q < HSR_N_QUESTIONS; q++)
      exact[q] += x.f.tally.exact[q];
    hsr_arena_free(&x.f.arena);
    hsr_world_free(&x.f.world);
    hsr_scene_delete(x.f.scene);
  }
  ok(tap, wrong.row == 0, "near ties: row sides: %ld wrong", wrong.row);
  ok(tap, wrong.first_row == 0, "near ties: first rows: %ld wrong",
     wrong.first_row);
  ok(tap, wrong.covers == 0, "near ties: coverage: %ld wrong", wrong.covers);
  ok(tap, wrong.edge == 0, "near ties: edge sides: %ld wrong", wrong.edge);
  ok(tap, wrong.column == 0 && wrong.asked > NEAR_ROUNDS,
     "near ties: edge columns: %ld of %ld wrong", wrong.column, wrong.asked);
  ok(tap, wrong.facing == 0, "near ties: facings: %ld wrong", wrong.facing);
  ok(tap, wrong.nearer == 0 && wrong.n_same > NEAR_ROUNDS / 4,
     "near ties: nearer: %ld wrong; of %ld pairs in one plane the lower id is",
     wrong.nearer, wrong.n_same);
  ok(tap, wrong.vertex == 0, "near ties: nearer at vertices: %ld wrong",
     wrong.vertex);
  ok(tap, wrong.cut == 0, "near ties: sides of cuts: %ld wrong", wrong.cut);
  ok(tap, wrong.order == 0, "near ties: before and beyond: %ld wrong",
     wrong.order);
  ok(tap, wrong.plane == 0, "near ties: equal planes: %ld wrong", wrong.plane);
  ok(tap, wrong.flat == 0, "near ties: flat or not: %ld wrong", wrong.flat);
  bool asked = n_made > NEAR_ROUNDS / 2;
  const int asks[] = {HSR_ASK_ROW,    HSR_ASK_EDGE,  HSR_ASK_FACING,
                      HSR_ASK_VERTEX, HSR_ASK_DEPTH, HSR_ASK_CUT};
  for (size_t k = 0; k < sizeof asks / sizeof *asks; k++)
    asked &= exact[asks[k]] > NEAR_ROUNDS;
  ok(tap, asked, "near ties: exact answers are asked for, in %d scenes",
     n_made);
}

/* Polygons of 3 to 5 corners in the plane x + 2 y + z = 4, one that is parallel
 * to it, and one that is warped. */
static void try_polygons(struct tap *tap) {
  static const double xyz[] = {4, 0, 0, 0, 2, 0, 0, 0, 4, 2, 1, 0, 1, 1, 1,
                               1, 0, 3, 2, 0, 2, 5, 0, 0, 0, 2, 1, 0, 0, 5};
  static const uint32_t a[] = {0, 1, 2}, b[] = {3, 4, 5, 6},
                        c[] = {0, 3, 1, 4, 2}, d[] = {7, 8, 9},
                        e[] = {0, 1, 2, 9}, f[] = {0, 6, 5, 2};
  static const struct {
    const uint32_t *vertex;
    uint32_t n;
    bool is_there, is_flat, has_normal;
  } all[] = {{a, 3, true, true, true},   {b, 4, true, true, true},
             {c, 5, true, true, true},   {d, 3, false, true, true},
             {e, 4, false, false, true}, {f, 4, false, true, false}};
  enum { ALL = sizeof all / sizeof *all };
  bool same = true, flat = true, out_of_memory = false;
  for (int k = 0; k < ALL; k++) {
    struct hsr_loop p = {xyz, xyz + 1, xyz + 2, 3, all[k].vertex, all[k].n};
    flat &= hsr_exact_has_normal(p, &out_of_memory) == all[k].has_normal;
    if (!all[k].has_normal)
      continue;
    flat &= hsr_is_flat(p, &out_of_memory) == all[k].is_flat;
    for (int l = 0; l < ALL; l++) {
      struct hsr_loop q = {xyz, xyz + 1, xyz + 2, 3, all[l].vertex, all[l].n};
      bool is = k == l || (all[k].is_there && all[l].is_there);
      if (all[l].has_normal)
        same &= hsr_exact_same_plane(p, q, &out_of_memory) == is;
    }
  }
  ok(tap, same, "polygons of any number of corners on one plane, or not");
  ok(tap, flat, "a warped one is not flat, and one without area has no normal");
}

/* A vertex beside the eye, along R, is on every row's plane: below it. */
static void try_beside(struct tap *tap) {
  struct hsr_camera camera = {
      .eye = {1, 2, 3}, .at = {1, 2, 0}, .up = {0, 1, 0}, .fov = 90};
  struct hsr_view view;
  bool out_of_memory = false;
  must_view(&view, &camera, M, M);
  const double right[3] = {2, 2, 3}, left[3] = {0, 2, 3};
  ok(tap,
     hsr_exact_row_side(&view, right, 2.5, &out_of_memory) == 1 &&
         hsr_exact_row_side(&view, left, 2.5, &out_of_memory) == 1,
     "a vertex beside the eye counts as below");
}

/* The filters must not be so cautious that they never decide. */
static void try_generic(struct tap *tap) {
  uint64_t seed = 3;
  struct fixture *x = set_up(&seed);
  struct hsr_camera camera = {.eye = {0.123, 7.77, 9.1},
                              .at = {0.2, 0.3, 0.1},
                              .up = {0, 1, 0},
                              .fov = 51};
  memset(&x->tally, 0, sizeof x->tally);
  hsr_arena_reset(&x->arena);
  must_view(&x->view, &camera, M, N);
  if (hsr_screen_make(&x->screen, &x->world, &x->view, &x->arena, &x->tally))
    bail("generic view");
  struct wrong wrong = {.asked = 0};
  try_vertices(x, &wrong);
  ok(tap, x->tally.exact[HSR_ASK_ROW] == 0 && wrong.asked > 100,
     "a generic view needs no exact path: %llu of %ld row sides",
     (unsigned long long)x->tally.exact[HSR_ASK_ROW], wrong.asked);
  tear_down(x);
}

/*   w = 1 plane; the square [0, 4] x [0, 4] clipped to x >= 1 keeps 4 corners
 *   and loses two:      +--|----+
 *                       |  |kept|
 *                       +--|----+      */
static void try_clip(struct tap *tap) {
  const double square[4][3] = {{0, 0, 1}, {4, 0, 1}, {4, 4, 1}, {0, 4, 1}};
  const double right_of_1[3] = {1, 0, -1}, right_of_5[3] = {1, 0, -5};
  double out[8][3], least = 9;
  int n = hsr_clip(square, 4, right_of_1, 0, out);
  for (int k = 0; k < n; k++)
    least = fmin(least, out[k][0] / out[k][2]);
  ok(tap, n == 4 && least == 1, "a square clipped: %d corners from x = %g", n,
     least);
  ok(tap, hsr_clip(square, 4, right_of_5, 0, out) == 0, "clipped away");
  const double upright[3][3] = {{4, 0, 1}, {4, 4, 1}, {4, 0, 2}};
  const double across[3] = {1, 0, 0}, right_of_4[3] = {-1, 0, 0};
  ok(tap,
     hsr_clip(upright, 3, across, -4, out) == 3 &&
         hsr_clip(upright, 3, right_of_4, 4, out) == 3,
     "what lies in the plane is kept on either side");
}

static void try_view(struct tap *tap) {
  struct hsr_camera camera = {.at = {0, 0, -1}, .up = {0, 1, 0}, .fov = 90};
  struct hsr_view view;
  bool right = !hsr_view_init(&view, &camera, M, M, NULL) && view.U[1] == 1 &&
               view.R[0] == 1 && view.F[2] == -1;
  ok(tap,
     right &&
         !hsr_view_init(&view, &camera, HSR_MAX_SIZE, HSR_MAX_SIZE, NULL) &&
         hsr_view_init(&view, &camera, HSR_MAX_SIZE + 1, 1, NULL) &&
         hsr_view_init(&view, &camera, 1, 0, NULL),
     "a right angle is exact, and the largest picture is no larger");
  camera.at[2] = -1e-200;
  camera.up[1] = 1e-200;
  ok(tap,
     !hsr_view_init(&view, &camera, M, M, NULL) && view.F[2] == -1 &&
         view.U[1] == 1,
     "a camera may look at what is very near");
}

static void try_arena(struct tap *tap) {
  struct hsr_arena arena = HSR_ARENA_EMPTY;
  bool aligned = true;
  for (size_t round = 0, blocks = 0; round < 3; round++) {
    for (size_t n = 1; n < 40000; n *= 3) {
      void *array = hsr_arena_array(&arena, n, 8);
      aligned &= array && (uintptr_t)array % 64 == 0;
      memset(array, 1, 8 * n);
    }
    hsr_arena_reset(&arena);
    if (round == 1)
      blocks = arena.n_blocks_taken;
    if (round == 2)
      ok(tap, aligned && arena.n_blocks_taken == blocks,
         "an arena that was reset takes no more memory");
  }
  bool zeroed = true;
  unsigned char *bytes = hsr_arena_zeroed(&arena, 1000, 8);
  for (int k = 0; k < 8000 && bytes; k++)
    zeroed &= !bytes[k];
  ok(tap, bytes && zeroed, "what is asked for zeroed is");
  ok(tap, !hsr_arena_array(&arena, SIZE_MAX / 2, 16), "an overflow is refused");
  hsr_arena_free(&arena);
}

int main(void) {
  struct tap tap = plan(39);
  try_services(&tap);
  try_near(&tap);
  try_polygons(&tap);
  try_beside(&tap);
  try_generic(&tap);
  try_clip(&tap);
  try_view(&tap);
  try_arena(&tap);
  return finish(&tap);
}
