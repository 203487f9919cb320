/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The lines of small exact scenes: where they are, of which class, how hidden,
 * and into how many strokes they join.
 *
 * The eye looks along -z in parallel projection. A picture of 128 x 128 pixels is
 * 16 units high: a unit is 8 pixels, and (0, 0) is in the middle. */
#include "bench/modules/modules.h"
#include "common/paper/lines/lines.h"
#include "common/paper/strokes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>

#define UNIT 8.

/* ---- Scenes ---- */

static void must(bool good) {
  if (!good)
    bail("a scene could not be set up");
}

static struct hsr_object *object_of(struct hsr_scene *scene, const char *name,
                                    bool one_sided) {
  struct hsr_object *object = hsr_scene_object(scene, name);
  must(object);
  object->one_sided = one_sided;
  return object;
}

static void add_points(struct hsr_object *object, const double (*at)[3],
                       size_t n) {
  for (size_t k = 0; k < n; k++)
    must(!hsr_object_vertex(object, at[k][0], at[k][1], at[k][2], NULL));
}

static void add_face(struct hsr_object *object, const uint32_t *corner,
                     size_t n, const float *rgb) {
  must(!hsr_object_face(object, corner, n, rgb));
}
#define FACE(object, ...)                                                      \
  add_face(object, (const uint32_t[]){__VA_ARGS__},                            \
           sizeof(uint32_t[]){__VA_ARGS__} / sizeof(uint32_t), NULL)

/* A rectangle across the view. */
static void add_sheet(struct hsr_scene *scene, double x0, double y0, double x1,
                      double y1, double z) {
  struct hsr_object *object = object_of(scene, "sheet", false);
  const double at[4][3] = {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
  add_points(object, at, 4);
  FACE(object, 0, 1, 2, 3);
}

static void add_box(struct hsr_scene *scene, const double low[3],
                    const double high[3], bool one_sided) {
  struct hsr_object *object = object_of(scene, "box", one_sided);
  for (int k = 0; k < 8; k++)
    must(!hsr_object_vertex(object, k & 1 ? high[0] : low[0],
                            k & 2 ? high[1] : low[1], k & 4 ? high[2] : low[2],
                            NULL));
  FACE(object, 0, 2, 3, 1);
  FACE(object, 4, 5, 7, 6);
  FACE(object, 0, 1, 5, 4);
  FACE(object, 2, 6, 7, 3);
  FACE(object, 0, 4, 6, 2);
  FACE(object, 1, 3, 7, 5);
}

/* ---- Lines ---- */

struct found {
  double ink[HSR_N_LINE_CLASSES][2]; /* units; [1]: hidden */
  size_t strokes[2];                 /* of visible lines, and of hidden ones */
  size_t closed;                     /* of them all */
  size_t intersections;              /* strokes of intersections */
  bool ring; /* the only one of these is closed, of four places */
};

static void join(const struct hsr_paper_lines *lines, bool by_class,
                 struct hsr_strokes *strokes) {
  struct hsr_pen_line *span = malloc((lines->n + 1) * sizeof *span);
  must(span);
  for (size_t k = 0; k < lines->n; k++) {
    const struct hsr_paper_line *line = &lines->line[k];
    span[k] = (struct hsr_pen_line){by_class ? line->line_class
                                             : line->invisibility > 0,
                                    line->from, line->to, line->straight};
  }
  must(!hsr_strokes_join(strokes, span, lines->n,
                         (const double(*)[2])lines->node, NULL));
  free(span);
}

static struct found look(const struct hsr_paper_lines *lines) {
  struct found found = {.closed = 0};
  struct hsr_strokes strokes;
  for (size_t k = 0; k < lines->n; k++) {
    const struct hsr_paper_line *line = &lines->line[k];
    const double *p = lines->node[line->from], *q = lines->node[line->to];
    found.ink[line->line_class][line->invisibility > 0] +=
        hypot(q[0] - p[0], q[1] - p[1]) / UNIT;
  }
  join(lines, false, &strokes);
  for (size_t k = 0; k < strokes.n; k++) {
    found.strokes[strokes.stroke[k].group]++;
    found.closed += strokes.stroke[k].closed;
  }
  hsr_strokes_free(&strokes);
  join(lines, true, &strokes);
  for (size_t k = 0; k < strokes.n; k++)
    if (strokes.stroke[k].group == HSR_LINE_INTERSECTION) {
      found.intersections++;
      found.ring = strokes.stroke[k].closed && strokes.stroke[k].n == 4;
    }
  hsr_strokes_free(&strokes);
  return found;
}

/* Draws the scene, which is freed. crease < 0: in the style "screen". */
static struct found draw(struct hsr_scene *scene, double crease) {
  const struct hsr_camera camera = {
      .eye = {0, 0, 50}, .up = {0, 1, 0}, .parallel = 16};
  struct hsr_world world;
  struct hsr_view view;
  struct hsr_drawing drawing = {.n = 0};
  struct hsr_line_style style;
  struct hsr_line_pens pens;
  struct hsr_paper_lines lines;
  must(!hsr_scene_view(scene, &camera));
  must_finish(scene);
  must_world(&world, scene);
  must_view(&view, &camera, 128, 128);
  draw_lines(hsr_algorithm_find("line-oracle")->plain, &world, &view, &drawing,
             NULL);
  hsr_line_style_plain(&style, HSR_HIDDEN_DASHED);
  must(crease < 0 || !hsr_line_style_crease(&style, crease, NULL));
  must(!hsr_line_pens_init(&pens, &style, scene, NULL));
  must(!hsr_lines_find(&lines, &drawing, &world, &view, style.crease, &pens,
                       NULL));
  const struct found found = look(&lines);
  hsr_lines_free(&lines);
  hsr_line_pens_free(&pens);
  hsr_drawing_free(&drawing);
  hsr_world_free(&world);
  hsr_scene_delete(scene);
  return found;
}

static struct hsr_scene *scene_new(void) {
  struct hsr_scene *scene = hsr_scene_new("lines");
  must(scene);
  return scene;
}

/* Whether there is so much ink of a class, and none of others but `also`. */
static bool is_ink(const struct found *found, bool hidden, int line_class,
                   double units, int also) {
  bool good = fabs(found->ink[line_class][hidden] - units) < 1e-9;
  for (int k = 0; k < HSR_N_LINE_CLASSES; k++)
    if (k != line_class && k != also)
      good = good && found->ink[k][hidden] == 0;
  return good;
}

static double ink_of(const struct found *found, bool hidden) {
  double sum = 0;
  for (int k = 0; k < HSR_N_LINE_CLASSES; k++)
    sum += found->ink[k][hidden];
  return sum;
}

/* ---- Each line once ---- */

static struct hsr_scene *two_boxes(bool one_sided) {
  struct hsr_scene *scene = scene_new();
  add_box(scene, (const double[]){-2, -1, -1}, (const double[]){0, 1, 1},
          one_sided);
  add_box(scene, (const double[]){0, -1, -3}, (const double[]){2, 1, 1},
          one_sided);
  return scene;
}

static void try_overlaid(struct tap *t) {
  for (int one_sided = 0; one_sided < 2; one_sided++) {
    struct found f = draw(two_boxes(one_sided), -1);
    ok(t,
       is_ink(&f, false, HSR_LINE_SILHOUETTE, 12, HSR_LINE_SEAM) &&
           fabs(f.ink[HSR_LINE_SEAM][0] - 2) < 1e-9 && ink_of(&f, true) == 0,
       "boxes that touch, %s-sided: an outline, a seam, nothing hidden",
       one_sided ? "one" : "two");
    ok(t, f.strokes[0] == 1 && f.strokes[1] == 0, "in %zu stroke",
       f.strokes[0]);
    f = draw(two_boxes(one_sided), 0);
    ok(t,
       is_ink(&f, false, HSR_LINE_SILHOUETTE, 12, -1) && f.closed == 1 &&
           f.strokes[0] == 1,
       "with --crease only the outline is left, closed");
  }
}

static void try_square_under(struct tap *t) {
  struct hsr_scene *scene = scene_new();
  add_sheet(scene, 0, 0, 4, 4, 0);
  add_sheet(scene, 1, 1, 5, 3, -1);
  struct found f = draw(scene, -1);
  ok(t,
     is_ink(&f, false, HSR_LINE_BOUNDARY, 16 + 4, -1) &&
         is_ink(&f, true, HSR_LINE_BOUNDARY, 8, -1),
     "a sheet half under another: %g and %g units", ink_of(&f, false),
     ink_of(&f, true));
  ok(t, f.strokes[0] == 2 && f.strokes[1] == 1 && f.closed == 1,
     "a closed stroke, an open one, and a hidden one");
  scene = scene_new();
  add_sheet(scene, 0, 0, 4, 4, 0);
  add_sheet(scene, 0, 0, 4, 4, -1);
  add_sheet(scene, 1, 0, 3, 4, -2);
  f = draw(scene, -1);
  ok(t,
     is_ink(&f, false, HSR_LINE_BOUNDARY, 16, -1) &&
         is_ink(&f, true, HSR_LINE_BOUNDARY, 8, -1),
     "a hidden line is not drawn under a visible one, nor twice: %g",
     ink_of(&f, true));
}

/* The long side of a triangle passes behind a sheet, from corner to corner, or a
 * little beside the corners. */
static void try_corners(struct tap *t) {
  static const double at[][3] = {{-4, -4, -1}, {4, -4, -1}, {4, 4, -1}};
  for (int beside = 0; beside < 2; beside++) {
    const double up = beside ? 1e-9 : 0;
    struct hsr_scene *scene = scene_new();
    add_sheet(scene, 0, up, 3, 3 + up, 0);
    struct hsr_object *object = object_of(scene, "triangle", false);
    add_points(object, at, 3);
    FACE(object, 0, 1, 2);
    const struct found f = draw(scene, -1);
    ok(t, f.strokes[0] == (beside ? 2 : 1) && f.strokes[1] == 1,
       "a line that is hidden from %s corner on: %zu strokes",
       beside ? "beside a" : "a", f.strokes[0]);
  }
}

/* Above the side from a to b lies one face, and below it two, from a to m and
 * from m to b. */
static void try_t_junction(struct tap *t) {
  for (int own = 0; own < 2; own++) {
    static const double at[][3] = {{-4, 0, 0}, {0, 0, 0},  {4, 0, 0},
                                   {4, 2, 0},  {-4, 2, 0}, {-4, -2, 0},
                                   {0, -2, 0}, {4, -2, 0}};
    struct hsr_scene *scene = scene_new();
    struct hsr_object *object = object_of(scene, "top", false);
    add_points(object, at, 8);
    FACE(object, 0, 2, 3, 4);
    if (own) {
      add_points(object, at, 8);
      FACE(object, 13, 14, 9, 8);
      FACE(object, 14, 15, 10, 9);
    } else {
      FACE(object, 5, 6, 1, 0);
      FACE(object, 6, 7, 2, 1);
    }
    const struct found f = draw(scene, 0);
    ok(t,
       is_ink(&f, false, HSR_LINE_BOUNDARY, 24, -1) && f.strokes[0] == 1 &&
           f.closed == 1,
       "one side along two, with %s vertices: the border alone is drawn, %g",
       own ? "their own" : "common", ink_of(&f, false));
  }
}

/* A spike out of the front of a box. */
static void try_chain(struct tap *t) {
  struct hsr_scene *scene = scene_new();
  add_box(scene, (const double[]){-4, -4, -4}, (const double[]){4, 4, 1}, true);
  static const double at[][3] = {
      {0, 0, 3}, {-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}};
  struct hsr_object *spike = object_of(scene, "spike", true);
  add_points(spike, at, 5);
  FACE(spike, 0, 1, 2);
  FACE(spike, 0, 2, 3);
  FACE(spike, 0, 3, 4);
  FACE(spike, 0, 4, 1);
  FACE(spike, 4, 3, 2, 1);
  const struct found f = draw(scene, -1);
  ok(t, fabs(f.ink[HSR_LINE_INTERSECTION][0] - 16) < 1e-9,
     "a spike through a side: an intersection all around, %g",
     f.ink[HSR_LINE_INTERSECTION][0]);
  ok(t, f.intersections == 1 && f.ring, "which is one closed stroke");
}

/* ---- Classes ---- */

/* Two faces at the line from (0, -2) to (0, 2), 2 units wide, each of which falls
 * by so much. */
static struct found roof(double fall, bool turned, double crease) {
  const double at[][3] = {{0, -2, 0},      {0, 2, 0},      {-2, 2, -fall},
                          {-2, -2, -fall}, {2, -2, -fall}, {2, 2, -fall}};
  struct hsr_scene *scene = scene_new();
  struct hsr_object *object = object_of(scene, "roof", false);
  add_points(object, at, 6);
  FACE(object, 0, 1, 2, 3);
  if (turned)
    FACE(object, 0, 1, 5, 4);
  else
    FACE(object, 1, 0, 4, 5);
  return draw(scene, crease);
}

static void try_creases(struct tap *t) {
  const double fall = 2 * tan(20 * 3.14159265358979323846 / 180);
  for (int turned = 0; turned < 2; turned++) {
    struct found f = roof(fall, turned, 39);
    ok(t, fabs(f.ink[HSR_LINE_CREASE][0] - 4) < 1e-9,
       "a ridge of 40 degrees is a crease of 39, turned %d", turned);
    f = roof(fall, turned, 41);
    ok(t, is_ink(&f, false, HSR_LINE_BOUNDARY, 16, -1), "but none of 41");
    f = roof(-fall, turned, 39);
    ok(t, fabs(f.ink[HSR_LINE_CREASE][0] - 4) < 1e-9, "so is a valley");
  }
  const struct found f = roof(0, false, -1);
  ok(t, fabs(f.ink[HSR_LINE_SMOOTH][0] - 4) < 1e-9,
     "in one plane a line is smooth");
}

/* Three faces at one line: two of one plane, and a fin over or under the right
 * one. What one sees beside the line is the nearest face. */
static void try_fins(struct tap *t) {
  for (int order = 0; order < 2; order++)
    for (int over = 0; over < 2; over++) {
      const double at[][3] = {{0, -2, 0},
                              {0, 2, 0},
                              {-2, 2, 0},
                              {-2, -2, 0},
                              {2, -2, 0},
                              {2, 2, 0},
                              {2, 2, over ? 2 : -2},
                              {2, -2, over ? 2 : -2}};
      struct hsr_scene *scene = scene_new();
      struct hsr_object *object = object_of(scene, "fin", false);
      add_points(object, at, 8);
      if (order)
        FACE(object, 0, 1, 6, 7);
      FACE(object, 0, 1, 2, 3);
      FACE(object, 0, 1, 5, 4);
      if (!order)
        FACE(object, 7, 6, 1, 0);
      const struct found f = draw(scene, -1);
      ok(t,
         fabs(f.ink[over ? HSR_LINE_CREASE : HSR_LINE_SMOOTH][0] - 4) < 1e-9 &&
             f.ink[over ? HSR_LINE_SMOOTH : HSR_LINE_CREASE][0] == 0,
         "a fin %s a plane, number %d, %s", over ? "over" : "under",
         order ? 0 : 2, over ? "makes a crease" : "makes none");
    }
}

/* Two faces of one plane, of two colours or opacities, or of two objects. */
static void try_flat(struct tap *t) {
  static const float red[3] = {1, 0, 0}, green[3] = {0, 1, 0};
  static const double at[][3] = {{-2, 0, 0}, {0, 0, 0}, {2, 0, 0},
                                 {2, 2, 0},  {0, 2, 0}, {-2, 2, 0}};
  static const uint32_t face[2][4] = {{0, 1, 4, 5}, {1, 2, 3, 4}};
  for (int by_opacity = 0; by_opacity < 2; by_opacity++) {
    struct hsr_scene *scene = scene_new();
    struct hsr_object *object = object_of(scene, "flat", false);
    add_points(object, at, 6);
    add_face(object, face[0], 4, red);
    add_face(object, face[1], 4, by_opacity ? red : green);
    if (by_opacity)
      must(!hsr_object_set_opacity(object, 1, .5f));
    const struct found f = draw(scene, 90);
    ok(t, fabs(f.ink[HSR_LINE_COLOUR][0] - 2) < 1e-9,
       "between two %s there is a line of colours",
       by_opacity ? "opacities" : "colours");
  }
  struct hsr_scene *scene = scene_new();
  add_sheet(scene, -2, 0, 0, 2, 0);
  add_sheet(scene, 0, 0, 2, 2, 0);
  struct found f = draw(scene, -1);
  ok(t,
     fabs(f.ink[HSR_LINE_SEAM][0] - 2) < 1e-9 &&
         fabs(f.ink[HSR_LINE_BOUNDARY][0] - 12) < 1e-9,
     "between two objects of one plane there is a seam");
  scene = scene_new();
  add_sheet(scene, -2, 0, 0, 2, 0);
  add_sheet(scene, 0, 0, 2, 2, -1);
  f = draw(scene, -1);
  ok(t, is_ink(&f, false, HSR_LINE_BOUNDARY, 14, -1),
     "but none where one lies deeper");
}

static void try_contours(struct tap *t) {
  /* The eye sees the first face, and behind it the second, folded under it. */
  static const double at[][3] = {{0, 0, 0},  {0, 2, 0},   {-2, 2, 0},
                                 {-2, 0, 0}, {-2, 0, -1}, {-2, 2, -1}};
  struct hsr_scene *scene = scene_new();
  struct hsr_object *object = object_of(scene, "wedge", false);
  add_points(object, at, 6);
  FACE(object, 0, 1, 2, 3);
  FACE(object, 1, 0, 4, 5);
  struct found f = draw(scene, 180);
  ok(t, is_ink(&f, false, HSR_LINE_SILHOUETTE, 2, HSR_LINE_BOUNDARY),
     "where a surface turns back there is a silhouette");
  scene = scene_new();
  add_box(scene, (const double[]){-1, -1, -1}, (const double[]){1, 1, 1}, true);
  f = draw(scene, 180);
  ok(t, is_ink(&f, false, HSR_LINE_SILHOUETTE, 8, -1),
     "beside a face that does not exist, too");
  scene = scene_new();
  object = object_of(scene, "one", true);
  add_points(object, at, 4);
  FACE(object, 3, 0, 1, 2);
  f = draw(scene, 180);
  ok(t, is_ink(&f, false, HSR_LINE_BOUNDARY, 8, -1),
     "a one-sided face alone has boundaries");
}

int main(void) {
  struct tap t = plan(33);
  try_overlaid(&t);
  try_square_under(&t);
  try_corners(&t);
  try_t_junction(&t);
  try_chain(&t);
  try_creases(&t);
  try_fins(&t);
  try_flat(&t);
  try_contours(&t);
  return finish(&t);
}
