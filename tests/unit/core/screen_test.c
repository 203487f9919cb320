/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The services of common/exact/screen.h against the exact predicates, on scenes
 * where the filters often cannot decide; services that need no screen against
 * those that do; and the arena that they use. */
#include "common/view/clip.h"
#include "common/exact/predicates.h"
#include "common/exact/screen.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SCENES = 150, M = 19, N = 14 };

struct fixture {
  struct hsr_scene *scene;
  struct hsr_world world;
  struct hsr_view view;
  struct hsr_screen screen;
  struct hsr_arena arena;
  struct hsr_tally tally;
};

static void fail(const char *text) {
  printf("Bail out! %s\n", text);
  exit(99);
}

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

static struct fixture *set_up(uint64_t *seed) {
  struct fixture *x = calloc(1, sizeof *x);
  struct hsr_error err = {.text = "out of memory"};
  x->scene = hsr_scene_new("screen");
  struct hsr_object *object = hsr_scene_object(x->scene, "faces");
  object->one_sided = draw_integer(seed, 0, 1);
  add_faces(seed, object);
  struct hsr_camera camera = {.eye = {(double)draw_integer(seed, -1, 1),
                                      (double)draw_integer(seed, -1, 1),
                                      (double)draw_integer(seed, 0, 5)},
                              .up = {0, 1, 0},
                              .fov = 90,
                              .near = (double)draw_integer(seed, 0, 2) / 2};
  memcpy(camera.at, camera.eye, sizeof camera.at);
  camera.at[2] -= 1;
  if (hsr_scene_finish(x->scene, &err) ||
      hsr_world_init(&x->world, x->scene, &err) ||
      hsr_view_init(&x->view, &camera, M, N, &err) ||
      hsr_screen_make(&x->screen, &x->world, &x->view, &x->arena, &x->tally))
    fail(err.text);
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
      anywhere, loops, asked;
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
  int columns[16];
  if (!relevant) {
    if (!hsr_face_exists(&x->screen, f, &x->tally))
      return;
    x->screen.whole[f] = false; /* not known to be whole: ask everything */
  }
  const struct hsr_bounds *box = &x->screen.bounds[f];
  for (int j = 0; j < N; j++) {
    int n = hsr_face_spans(&x->screen, f, j, columns, &x->tally);
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
  ok(tap, wrong.culled == 0, "culls: %ld covered samples lost", wrong.culled);
  ok(tap, wrong.nearer == 0, "nearer: %ld wrong", wrong.nearer);
  ok(tap, wrong.anywhere == 0, "nearer anywhere: %ld wrong", wrong.anywhere);
  ok(tap, wrong.loops == 0, "coverage by corners: %ld wrong", wrong.loops);
  ok(tap, wrong.vertex == 0, "nearer at vertices: %ld wrong", wrong.vertex);
  ok(tap, wrong.in_front == 0,
     "in front at all vertices, so everywhere: %ld samples wrong",
     wrong.in_front);
  ok(tap, exact > 1000, "the exact path was taken: %llu times",
     (unsigned long long)exact);
}

/* The filters must not be so cautious that they never decide. */
static void try_generic(struct tap *tap) {
  uint64_t seed = 3;
  struct fixture *x = set_up(&seed);
  struct hsr_camera camera = {.eye = {0.123, 7.77, 9.1},
                              .at = {0.2, 0.3, 0.1},
                              .up = {0, 1, 0},
                              .fov = 51};
  struct hsr_error err;
  memset(&x->tally, 0, sizeof x->tally);
  hsr_arena_reset(&x->arena);
  if (hsr_view_init(&x->view, &camera, M, N, &err) ||
      hsr_screen_make(&x->screen, &x->world, &x->view, &x->arena, &x->tally))
    fail("generic view");
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
  ok(tap, !hsr_arena_array(&arena, SIZE_MAX / 2, 16), "an overflow is refused");
  hsr_arena_free(&arena);
}

int main(void) {
  struct tap tap = plan(17);
  try_services(&tap);
  try_generic(&tap);
  try_clip(&tap);
  try_arena(&tap);
  return finish(&tap);
}
