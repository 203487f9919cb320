/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Romney's algorithm: the part of a line that shows the same as the last line
 * is not searched in depth; and faces that are not quite flat are drawn right
 * although they penetrate a little. */
#include "bench/modules/modules.h"
#include "common/exact/screen.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <stdlib.h>
#include <string.h>

enum { M = 80, N = 60, SCENES = 100, MOST_CROSSINGS = 400 };

/* --- Scenes --------------------------------------------------------------- */

struct picture {
  struct hsr_scene *scene;
  struct hsr_object *object;
  struct hsr_world world;
  struct hsr_view view;
};

static void picture_begin(struct picture *x) {
  x->scene = hsr_scene_new("toy");
  x->object = hsr_scene_object(x->scene, "toy");
}

static void picture_face(struct picture *x, const double (*corner)[3],
                         uint32_t n) {
  uint32_t first = x->object->n_vertices, vertex[4];
  for (uint32_t k = 0; k < n; k++) {
    hsr_object_vertex(x->object, corner[k][0], corner[k][1], corner[k][2],
                      NULL);
    vertex[k] = first + k;
  }
  hsr_object_face(x->object, vertex, n, NULL);
}

static void picture_finish(struct picture *x, const double eye[3],
                           const double at[3]) {
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_camera camera = {.up = {0, 1, 0}, .fov = 60};
  memcpy(camera.eye, eye, sizeof camera.eye);
  memcpy(camera.at, at, sizeof camera.at);
  if (hsr_scene_view(x->scene, &camera))
    bail("%s", err.text);
  must_finish(x->scene);
  must_world(&x->world, x->scene);
  must_view(&x->view, &camera, M, N);
}

static void picture_free(struct picture *x) {
  hsr_world_free(&x->world);
  hsr_scene_delete(x->scene);
}

static double draw(uint64_t *seed, double size) {
  return size * (double)draw_integer(seed, -1000000, 1000000) / 1e6;
}

/* Triangles in parallel planes, one behind another in any order. */
static void draw_layers(struct picture *x, uint64_t *seed) {
  picture_begin(x);
  for (int f = (int)draw_integer(seed, 2, 9); f--;) {
    double corner[3][3], depth = draw(seed, 1);
    for (int k = 0; k < 3; k++) {
      corner[k][0] = draw(seed, 6);
      corner[k][1] = draw(seed, 5);
      corner[k][2] = depth;
    }
    picture_face(x, (const double(*)[3])corner, 3);
  }
  picture_finish(x, (double[]){0, 0, 10}, (double[]){0.1, 0, 0});
}

/* Squares near one plane, each with a corner a little out of it; among them
 * triangles that cross the plane no farther out. */
static void draw_plates(struct picture *x, uint64_t *seed) {
  picture_begin(x);
  for (int f = (int)draw_integer(seed, 2, 8); f--;) {
    uint32_t n = (uint32_t)draw_integer(seed, 3, 4);
    double w = 2 + draw(seed, 1), a = draw(seed, 3), b = draw(seed, 3);
    double corner[4][3] = {{a - w, b - w, 0},
                           {a + w, b - w, 0},
                           {a + w, b + w, 0},
                           {a - w, b + w, 0}};
    for (uint32_t k = 0; k < n; k++)
      corner[k][2] = draw(seed, n == 4 ? 0.25 : 0.125);
    picture_face(x, (const double(*)[3])corner, n);
  }
  double eye[3] = {draw(seed, 8), draw(seed, 8), 1 + 4 * (1 + draw(seed, 1))};
  picture_finish(x, eye, (double[]){0, 0, 0});
}

/* --- Romney's picture, and what it took ----------------------------------- */

static int counter(const char *name) {
  return counter_of(hsr_algorithm_find("romney")->counting, name);
}

/* For each row the leftmost sample that was searched, or M. */
struct watch {
  int depth_search, first[N];
};

static void note(void *context, const struct hsr_event *event) {
  struct watch *watch = context;
  int *first = &watch->first[event->window.y0];
  if (event->counter == watch->depth_search && event->window.x0 < *first)
    *first = event->window.x0;
}

/* The number of samples that differ from the oracle's. */
static long draw_romney(const struct picture *x, struct hsr_tally *tally) {
  static uint32_t wanted[M * N], got[M * N];
  draw_plain("oracle", &x->world, &x->view, wanted);
  draw_plain("romney", &x->world, &x->view, got);
  long differences = count_differences(&x->view, got, wanted);
  draw_ids(hsr_algorithm_find("romney")->counting, &x->world, &x->view, got,
           tally);
  return differences + count_differences(&x->view, got, wanted);
}

/* --- Unchanged lines ------------------------------------------------------ */

struct crossing {
  int column;
  uint32_t face;
};

struct line {
  struct crossing crossing[MOST_CROSSINGS];
  int n;
};

static int by_column(const void *a, const void *b) {
  const struct crossing *c = a, *d = b;
  return c->column != d->column ? c->column - d->column
                                : (c->face > d->face) - (c->face < d->face);
}

/* The crossings of row j in the picture, and one where it ends. */
static void find_line(const struct hsr_screen *screen, int j,
                      struct line *line) {
  struct hsr_tally tally = {.out_of_memory = false};
  line->n = 0;
  for (uint32_t r = 0; r < screen->n_relevant; r++) {
    uint32_t f = screen->relevant[r];
    int columns[8], n = hsr_face_spans(screen, f, j, columns, &tally);
    for (int k = 0; k < n; k++)
      if (columns[k] < M)
        line->crossing[line->n++] = (struct crossing){columns[k], f};
  }
  line->crossing[line->n++] = (struct crossing){M, HSR_NO_ID};
  qsort(line->crossing, (size_t)line->n, sizeof *line->crossing, by_column);
}

/* How many crossings, from the left, a line has in common with the last line.
 * On both lines there is a sample between each of them and the next. */
static int common_part(const struct line *last, const struct line *line) {
  int n = 0;
  while (n + 1 < last->n && n + 1 < line->n &&
         last->crossing[n].face == line->crossing[n].face &&
         last->crossing[n].column < last->crossing[n + 1].column &&
         line->crossing[n].column < line->crossing[n + 1].column)
    n++;
  return n;
}

struct findings {
  long differences, lines, parts; /* unchanged lines; left parts of others */
  long wrong_lines, wrong_parts;  /* those of them that were searched */
  uint64_t lines_reused;
};

static void check_lines(const struct picture *x, struct findings *findings) {
  struct watch watch = {.depth_search = counter("depth search")};
  for (int j = 0; j < N; j++)
    watch.first[j] = M;
  struct hsr_trace trace = {.listen = note, .context = &watch};
  struct hsr_tally tally = {.trace = &trace};
  findings->differences += draw_romney(x, &tally);
  findings->lines_reused += tally.count[counter("lines reused")];

  struct hsr_arena arena = HSR_ARENA_EMPTY;
  struct hsr_tally own = {.out_of_memory = false};
  struct hsr_screen screen;
  struct hsr_error err = {.text = "out of memory"};
  if (hsr_screen_make(&screen, &x->world, &x->view, &arena, &own))
    bail("%s", err.text);
  static struct line line[2];
  find_line(&screen, 0, &line[0]);
  for (int j = 1; j < N; j++) {
    const struct line *last = &line[(j - 1) & 1];
    find_line(&screen, j, &line[j & 1]);
    int n = common_part(last, &line[j & 1]);
    bool whole = n == last->n - 1 && last->n == line[j & 1].n;
    bool searched = watch.first[j] < line[j & 1].crossing[n].column;
    if (n == 0)
      continue;
    *(whole ? &findings->lines : &findings->parts) += 1;
    *(whole ? &findings->wrong_lines : &findings->wrong_parts) += searched;
  }
  hsr_arena_free(&arena);
}

static void test_lines(struct tap *tap) {
  struct findings f = {.lines = 0};
  uint64_t seed = 3;
  for (int k = 0; k < SCENES; k++) {
    struct picture x;
    draw_layers(&x, &seed);
    check_lines(&x, &f);
    picture_free(&x);
  }
  ok(tap, !f.differences, "layers: %ld samples differ from the oracle's",
     f.differences);
  ok(tap, f.lines && !f.wrong_lines,
     "no depth search on an unchanged line: %ld of %ld have one", f.wrong_lines,
     f.lines);
  ok(tap, f.parts && !f.wrong_parts,
     "nor on an unchanged left part of a line: %ld of %ld have one",
     f.wrong_parts, f.parts);
  ok(tap, f.lines_reused >= (uint64_t)f.lines, "%lu lines counted as reused",
     (unsigned long)f.lines_reused);
}

/* --- Faces that are not flat ---------------------------------------------- */

static void test_thickness(struct tap *tap) {
  long differences = 0;
  struct hsr_tally tally = {.out_of_memory = false};
  uint64_t seed = 4;
  for (int k = 0; k < SCENES; k++) {
    struct picture x;
    draw_plates(&x, &seed);
    differences += draw_romney(&x, &tally);
    picture_free(&x);
  }
  ok(tap, !differences, "warped plates: %ld samples differ from the oracle's",
     differences);
  unsigned long checks = tally.count[counter("thickness checks")];
  unsigned long divisions = tally.count[counter("thickness divisions")];
  ok(tap, checks && divisions, "of %lu thickness checks, %lu divide a span",
     checks, divisions);
}

int main(void) {
  struct tap tap = plan(6);
  test_lines(&tap);
  test_thickness(&tap);
  return finish(&tap);
}
