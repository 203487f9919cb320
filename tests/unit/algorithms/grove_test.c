/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Groves (algorithms/image_space/area/tiling/grove.h): the order of instances
 * for any eye, against rays from the eye through their boxes; which scenes are
 * put in order, become one tree, or are refused; and the pictures of all of
 * them. */
#include "bench/modules/variant.h"
#include "algorithms/image_space/area/tiling/grove.h"
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { M = 61, N = 47, MOST_INSTANCES = 400 };

/* --- Scenes --------------------------------------------------------------- */

struct box {
  double lo[3], hi[3];
};

/* The sides of a box, counter-clockwise from outside. If bit k of a corner's
 * number is set, the corner is at the upper end of coordinate k. */
static const unsigned SIDE[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                    {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

/* Adds the sides of a box whose bits are set. */
static struct hsr_object *add_box(struct hsr_scene *scene, struct box box,
                                  unsigned sides, bool one_sided) {
  struct hsr_object *object = hsr_scene_object(scene, "box");
  uint32_t v[8];
  object->one_sided = one_sided;
  for (int k = 0; k < 8; k++)
    hsr_object_vertex(object, k & 1 ? box.hi[0] : box.lo[0],
                      k & 2 ? box.hi[1] : box.lo[1],
                      k & 4 ? box.hi[2] : box.lo[2], &v[k]);
  for (int s = 0; s < 6; s++)
    if (sides >> s & 1) {
      uint32_t corner[4];
      for (int k = 0; k < 4; k++)
        corner[k] = v[SIDE[s][k]];
      hsr_object_face(object, corner, 4, NULL);
    }
  return object;
}

enum { ALL_SIDES = 63 };

static void move_to(struct hsr_scene *scene, double x, double y, double z) {
  const double m[12] = {1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z};
  if (hsr_scene_instance(scene, scene->n_objects - 1, m))
    bail("%s: out of memory", scene->name);
}

static void look(struct hsr_scene *scene, double x, double y, double z,
                 double at_x, double at_y, double at_z) {
  struct hsr_camera camera = {{x, y, z}, {at_x, at_y, at_z}, {0, 0, 1}, 70, 0};
  if (camera.at[0] == x && camera.at[1] == y)
    camera.up[0] = 1;
  if (hsr_scene_view(scene, &camera))
    bail("%s: a camera is refused", scene->name);
}

struct stage {
  struct hsr_scene *scene;
  struct hsr_world world, outline;
};

static void open_stage(struct stage *s, struct hsr_scene *scene) {
  s->scene = scene;
  must_finish(scene);
  must_world(&s->world, scene);
  must_roster(&s->outline, scene);
}

static void close_stage(struct stage *s) {
  hsr_world_free(&s->world);
  hsr_world_free(&s->outline);
  hsr_scene_delete(s->scene);
}

/* --- Order ---------------------------------------------------------------- */

struct order {
  uint32_t place[MOST_INSTANCES]; /* of each instance in the order */
  uint32_t n;
};

/* Walks through the grove from front to back. */
static void put_in_order(const struct hsr_grove *grove, uint32_t number,
                         const double eye[3], struct order *order) {
  const struct hsr_grove_node *node = &grove->node[number];
  if (node->axis < 0) {
    order->place[node->instance] = order->n++;
    return;
  }
  bool above = eye[node->axis] > node->at;
  put_in_order(grove, above ? node->above : node->below, eye, order);
  put_in_order(grove, above ? node->below : node->above, eye, order);
}

/* Where a ray from the eye enters a box; negative if it misses it. */
static double enter(const struct box *box, const double eye[3],
                    const double along[3]) {
  double from = 0, to = INFINITY;
  for (int k = 0; k < 3; k++) {
    if (along[k] == 0) {
      if (eye[k] <= box->lo[k] || eye[k] >= box->hi[k])
        return -1;
      continue;
    }
    double a = (box->lo[k] - eye[k]) / along[k],
           b = (box->hi[k] - eye[k]) / along[k];
    from = fmax(from, fmin(a, b));
    to = fmin(to, fmax(a, b));
  }
  return from + 1e-9 < to ? from : -1;
}

/* Boxes that a ray meets before others that are earlier in the order. */
struct looked {
  long rays, met, wrong;
};

static void shoot(const struct box *box, uint32_t n, const struct order *order,
                  const double eye[3], const double along[3],
                  struct looked *looked) {
  double at[MOST_INSTANCES];
  uint32_t met[MOST_INSTANCES], n_met = 0;
  for (uint32_t k = 0; k < n; k++) {
    at[k] = enter(&box[k], eye, along);
    if (at[k] >= 0)
      met[n_met++] = k;
  }
  for (uint32_t a = 0; a < n_met; a++)
    for (uint32_t b = 0; b < n_met; b++)
      looked->wrong += at[met[a]] + 1e-9 < at[met[b]] &&
                       order->place[met[a]] > order->place[met[b]];
  looked->rays++;
  looked->met += n_met;
}

static void look_around(const struct hsr_grove *grove, const struct box *box,
                        uint32_t n, uint64_t *seed, struct looked *looked) {
  for (int e = 0; e < 30; e++) {
    double eye[3];
    struct order order = {{0}, 0};
    for (int k = 0; k < 3; k++)
      eye[k] = (double)draw_integer(seed, -20, 140) / (e & 1 ? 1 : 2);
    put_in_order(grove, 0, eye, &order);
    looked->wrong += order.n != n;
    for (int r = 0; r < 60; r++) {
      const struct box *to = &box[draw_integer(seed, 0, n - 1)];
      double along[3];
      for (int k = 0; k < 3; k++)
        along[k] =
            to->lo[k] +
            (to->hi[k] - to->lo[k]) * (double)draw_integer(seed, 0, 8) / 8 -
            eye[k];
      shoot(box, n, &order, eye, along, looked);
    }
  }
}

/* Divides a box by planes into small ones, and shrinks each by `gap`. */
static uint32_t divide(struct box whole, int depth, double gap,
                       struct box *into, uint64_t *seed) {
  int axis = (int)draw_integer(seed, 0, 2);
  double extent = whole.hi[axis] - whole.lo[axis];
  if (!depth || extent < 4) {
    for (int k = 0; k < 3; k++) {
      whole.lo[k] += gap;
      whole.hi[k] -= gap;
    }
    into[0] = whole;
    return 1;
  }
  double at = whole.lo[axis] + (double)draw_integer(seed, 2, (int)extent - 2);
  struct box below = whole, above = whole;
  below.hi[axis] = at;
  above.lo[axis] = at;
  uint32_t n = divide(below, depth - 1, gap, into, seed);
  return n + divide(above, depth - 1, gap, into + n, seed);
}

/* A grid of n x n x n cells, with boxes of a few kinds in them. */
static uint32_t make_grid(int n, int gap, struct box *into, uint64_t *seed) {
  uint32_t count = 0;
  for (int k = 0; k < n * n * n; k++) {
    if (draw_integer(seed, 0, 5) == 0)
      continue;
    const int cell[3] = {k % n, k / n % n, k / n / n};
    for (int c = 0; c < 3; c++) {
      into[count].lo[c] = 16 * cell[c] + gap * (int)draw_integer(seed, 0, 3);
      into[count].hi[c] =
          16 * (cell[c] + 1) - gap * (int)draw_integer(seed, 1, 3);
    }
    count++;
  }
  return count;
}

/* An object and an instance for each box; its place is in the object or in the
 * instance. */
static struct hsr_scene *scene_of(const struct box *box, uint32_t n,
                                  bool one_sided) {
  struct hsr_scene *scene = hsr_scene_new("boxes");
  for (uint32_t k = 0; k < n; k++) {
    struct box local = box[k];
    for (int c = 0; c < 3; c++) {
      local.lo[c] -= box[k].lo[c] * (k & 1);
      local.hi[c] -= box[k].lo[c] * (k & 1);
    }
    add_box(scene, local, ALL_SIDES, one_sided);
    if (k & 1)
      move_to(scene, box[k].lo[0], box[k].lo[1], box[k].lo[2]);
    else
      move_to(scene, 0, 0, 0);
  }
  look(scene, -30, -50, 40, 60, 50, 30);
  return scene;
}

static void test_order(struct tap *tap, const char *name, int kind) {
  static struct box box[MOST_INSTANCES];
  struct looked looked = {0, 0, 0};
  uint64_t seed = 1 + (uint64_t)kind;
  long in_order = 0;
  enum { SCENES = 12 };
  for (int k = 0; k < SCENES; k++) {
    const struct box all = {{0, 0, 0}, {128, 128, 128}};
    uint32_t n = kind == 0 ? make_grid(2 + k % 5, 0, box, &seed)
                 : kind == 1
                     ? make_grid(2 + k % 5, 1, box, &seed)
                     : divide(all, 3 + k % 5, 0.5 * (kind - 2), box, &seed);
    struct hsr_error err = {.text = "out of memory"};
    struct hsr_bsp_rule rule = {.most = 30};
    struct hsr_grove grove;
    struct stage stage;
    open_stage(&stage, scene_of(box, n, kind % 2 == 0));
    enum hsr_status status =
        hsr_grove_init(&grove, &stage.outline, &rule, &err);
    in_order += !status && !grove.is_whole && grove.n_nodes == 2 * n - 1;
    if (!status)
      look_around(&grove, box, n, &seed, &looked);
    hsr_grove_free(&grove);
    close_stage(&stage);
  }
  ok(tap, in_order == SCENES && !looked.wrong && looked.met > 2 * looked.rays,
     "%s: %ld rays through %ld boxes, %ld in the wrong order", name,
     looked.rays, looked.met, looked.wrong);
}

/* --- Pictures ------------------------------------------------------------- */

enum fit { IN_ORDER, ONE_TREE };

/* The number of wrong samples in all views of a world of the scene; -1, and the
 * text, if it is refused. */
static long count_wrong(const struct stage *s, const struct hsr_world *world,
                        const char *algorithm, const char *name, char *text) {
  static uint32_t wanted[M * N], got[M * N];
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_arena scratch = HSR_ARENA_EMPTY;
  struct hsr_variant variant;
  struct hsr_setup setup;
  long wrong = 0;
  if (hsr_variant_parse(algorithm, &variant, &err))
    bail("%s: %s", algorithm, err.text);
  enum hsr_status status = hsr_setup_init(&setup, variant.listed->plain,
                                          &variant.choice, world, &err);
  if (status && status != HSR_E_REFUSED)
    bail("%s: %s", name, err.text);
  snprintf(text, sizeof err.text, "%s", status ? err.text : "");
  for (uint32_t v = 0; v < s->scene->n_views && !status; v++) {
    struct hsr_view view;
    struct hsr_tally tally = {.out_of_memory = false};
    struct hsr_answer answer = hsr_answer_of_ids(got, M, N);
    struct hsr_job job = {
        .view = &view, .scratch = &scratch, .tally = &tally, .answer = &answer};
    must_view(&view, &s->scene->views[v], M, N);
    hsr_arena_reset(&scratch);
    if (hsr_setup_render(&setup, &job, &err))
      bail("%s: %s", name, err.text);
    draw_plain("oracle", &s->world, &view, wanted);
    wrong += count_differences(&view, got, wanted);
  }
  hsr_setup_free(&setup);
  hsr_arena_free(&scratch);
  return status ? -1 : wrong;
}

static long count_seen(const struct stage *s) {
  static uint32_t ids[M * N];
  long seen = 0;
  for (uint32_t v = 0; v < s->scene->n_views; v++) {
    struct hsr_view view;
    must_view(&view, &s->scene->views[v], M, N);
    draw_plain("zbuffer-fast", &s->world, &view, ids);
    for (int k = 0; k < M * N; k++)
      seen += ids[k] != HSR_BACKGROUND;
  }
  return seen;
}

/* A scene that can be ordered is drawn right, laid out or not. Any other
 * becomes one tree, or is refused in one clear line. */
static void test_picture(struct tap *tap, struct hsr_scene *scene,
                         const char *name, enum fit fit) {
  char text[sizeof((struct hsr_error *)0)->text];
  struct stage s;
  struct hsr_grove grove;
  struct hsr_bsp_rule rule = {.most = 30};
  struct hsr_error err = {.text = "out of memory"};
  open_stage(&s, scene);
  if (hsr_grove_init(&grove, &s.world, &rule, &err))
    bail("%s: %s", name, err.text);
  bool as_wanted = grove.is_whole == (fit == ONE_TREE);
  hsr_grove_free(&grove);
  long wrong = count_wrong(&s, &s.world, "tiling", name, text) +
               count_wrong(&s, &s.world, "tiling:leaf=1", name, text);
  long seen = count_seen(&s);
  ok(tap, as_wanted && !wrong && seen > M * N / 20,
     "%s: %s, of %ld samples %ld are wrong", name,
     grove.is_whole ? "one tree" : "in order", seen, wrong);
  if (fit == IN_ORDER) {
    wrong = count_wrong(&s, &s.outline, "tiling", name, text) |
            count_wrong(&s, &s.outline, "tiling:leaf=1", name, text);
    ok(tap, !wrong, "%s: as an outline, %ld are wrong", name, wrong);
  } else {
    long refused = count_wrong(&s, &s.outline, "tiling", name, text);
    ok(tap, refused == -1 && strlen(text) > 20 && !strchr(text, '\n'),
       "%s: an outline is refused: %s", name, text);
  }
  close_stage(&s);
}

static void look_about(struct hsr_scene *scene) {
  look(scene, -4, -6, 5, 4, 4, 2);
  look(scene, 14, 12, 9, 4, 4, 2);
  look(scene, 4, 4, 20, 4, 4, 0);
  look(scene, 4, 4.5, 2, 9, 7, 2);
  look(scene, 4, -9, -6, 4, 4, 2);
}

/* Four boxes around a fifth: no plane separates them.
 *
 *       a a a b
 *       d   . b
 *       d . . b
 *       d c c c                                                            */
static struct hsr_scene *make_pinwheel(void) {
  struct hsr_scene *scene = hsr_scene_new("pinwheel");
  add_box(scene, (struct box){{0, 0, 0}, {6, 2, 4}}, ALL_SIDES, true);
  move_to(scene, 0, 6, 0);
  move_to(scene, 2, 0, 0);
  add_box(scene, (struct box){{0, 0, 0}, {2, 6, 4}}, ALL_SIDES, true);
  move_to(scene, 0, 0, 0);
  move_to(scene, 6, 2, 0);
  look_about(scene);
  return scene;
}

/* Boxes in a row that touch. */
static struct hsr_scene *make_row(bool one_sided) {
  struct hsr_scene *scene = hsr_scene_new("row");
  add_box(scene, (struct box){{0, 0, 0}, {2, 4, 4}}, ALL_SIDES, one_sided);
  for (int k = 3; k >= 0; k--)
    move_to(scene, 2 * k, k % 2, 0);
  look_about(scene);
  return scene;
}

/* Sheets in the planes of the sides of boxes. They overlap the sides, and face
 * down or up. */
enum { LOW = 1 << 4, HIGH = 1 << 5 };

static struct hsr_scene *make_sheets(unsigned side, bool one_sided,
                                     bool sheets_first) {
  struct hsr_scene *scene = hsr_scene_new("sheets");
  for (int pass = 0; pass < 2; pass++)
    if (sheets_first == !pass) {
      add_box(scene, (struct box){{0, 0, 0}, {5, 5, 0}}, side, one_sided);
      move_to(scene, 1, 1, 0);
      move_to(scene, 2, 0, 0);
      move_to(scene, 3, 3, 4);
    } else {
      add_box(scene, (struct box){{0, 0, 0}, {4, 4, 4}}, ALL_SIDES, true);
      move_to(scene, 0, 0, 0);
      move_to(scene, 4, 4, 0);
    }
  look_about(scene);
  return scene;
}

/* Boxes that are apart, each moved by m. */
static struct hsr_scene *make_moved(const double m[12], bool moves) {
  struct hsr_scene *scene = hsr_scene_new("moved");
  static const uint32_t corner[4][3] = {
      {0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  struct hsr_object *object = hsr_scene_object(scene, "tetrahedron");
  object->moves = moves;
  hsr_object_vertex(object, 0, 0, 0, NULL);
  hsr_object_vertex(object, 3, 0, 0, NULL);
  hsr_object_vertex(object, 0, 3, 0, NULL);
  hsr_object_vertex(object, 1, 1, 3, NULL);
  for (int f = 0; f < 4; f++)
    hsr_object_face(object, corner[f], 3, NULL);
  for (int k = 0; k < 4; k++) {
    double moved[12];
    memcpy(moved, m, sizeof moved);
    moved[3] += 5 * (k % 2);
    moved[7] += 5 * (k / 2);
    if (hsr_scene_instance(scene, 0, moved))
      bail("moved: out of memory");
  }
  look_about(scene);
  return scene;
}

static struct hsr_scene *make_not_flat(void) {
  struct hsr_scene *scene = hsr_scene_new("not flat");
  struct hsr_object *object = hsr_scene_object(scene, "bent");
  static const uint32_t corner[4] = {0, 1, 2, 3};
  hsr_object_vertex(object, 0, 0, 0, NULL);
  hsr_object_vertex(object, 3, 0, 1, NULL);
  hsr_object_vertex(object, 3, 3, 0, NULL);
  hsr_object_vertex(object, 0, 3, 1, NULL);
  hsr_object_face(object, corner, 4, NULL);
  move_to(scene, 0, 0, 0);
  move_to(scene, 5, 5, 1);
  look_about(scene);
  return scene;
}

/* Two stars of triangles through one another: they are cut at places that are
 * not doubles. They are far out, so these places are rounded when they are
 * moved. */
static struct hsr_scene *make_far(double far) {
  struct hsr_scene *scene = hsr_scene_new("far");
  struct hsr_object *object = hsr_scene_object(scene, "star");
  static const double vertex[9][3] = {{0, 0, 0}, {7, 1, 2}, {2, 7, 3},
                                      {7, 6, 0}, {1, 5, 7}, {0, 2, 3},
                                      {5, 0, 7}, {7, 7, 5}, {1, 1, 6}};
  for (int v = 0; v < 9; v++)
    hsr_object_vertex(object, vertex[v][0], vertex[v][1], vertex[v][2], NULL);
  for (uint32_t f = 0; f < 9; f++) {
    const uint32_t corner[3] = {f, (f + 1 + f % 2) % 9, (f + 4) % 9};
    hsr_object_face(object, corner, 3, NULL);
  }
  for (int k = 0; k < 2; k++)
    move_to(scene, far + 8 * k, far, far);
  for (int v = 0; v < 6; v++)
    look(scene, far + 20 - 5 * v, far - 12 + v, far + 9 - v, far + 6, far + 4,
         far + 3);
  return scene;
}

int main(void) {
  static const double still[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  static const double tenth[12] = {1, 0, 0, 0.1, 0, 1, 0, 0.1, 0, 0, 1, 0.1};
  static const double turned[12] = {0, -1, 0, 3, 1, 0, 0, 0, 0, 0, 1, 0};
  static const double oblique[12] = {0.6, -0.8, 0, 1, 0.8, 0.6,
                                     0,   0,    0, 0, 1,   0};
  enum { ONE_SIDED = true, TWO_SIDED = false };
  struct tap tap = plan(4 + 2 * 15);
  test_order(&tap, "a grid of boxes that touch", 0);
  test_order(&tap, "a grid of boxes apart", 1);
  test_order(&tap, "a partition, of boxes that touch", 2);
  test_order(&tap, "a partition, of boxes apart", 3);
  test_picture(&tap, make_pinwheel(), "pinwheel", ONE_TREE);
  test_picture(&tap, make_row(ONE_SIDED), "boxes that touch", IN_ORDER);
  test_picture(&tap, make_row(TWO_SIDED), "boxes that touch, two-sided",
               ONE_TREE);
  test_picture(&tap, make_sheets(LOW, ONE_SIDED, true), "sheets before boxes",
               ONE_TREE);
  test_picture(&tap, make_sheets(LOW, ONE_SIDED, false), "boxes before sheets",
               ONE_TREE);
  test_picture(&tap, make_sheets(HIGH, ONE_SIDED, true), "sheets that look up",
               ONE_TREE);
  test_picture(&tap, make_sheets(LOW, TWO_SIDED, true), "two-sided sheets",
               ONE_TREE);
  test_picture(&tap, make_moved(still, false), "exact places", IN_ORDER);
  test_picture(&tap, make_moved(tenth, false), "places that are rounded",
               ONE_TREE);
  test_picture(&tap, make_moved(turned, false), "turned", ONE_TREE);
  test_picture(&tap, make_moved(oblique, false), "turned obliquely", ONE_TREE);
  test_picture(&tap, make_moved(still, true), "on the move", ONE_TREE);
  test_picture(&tap, make_not_flat(), "faces that are not flat", ONE_TREE);
  test_picture(&tap, make_far(0), "cut faces", IN_ORDER);
  test_picture(&tap, make_far(0x1p45), "cut faces, far out", IN_ORDER);
  return finish(&tap);
}
