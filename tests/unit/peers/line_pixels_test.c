/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The judge of lines that are drawn as pixels, by pictures that are wrong in
 * known ways.
 *
 * In 48 x 48 pixels, 6 of which are one unit, a square of side 2 hangs before a
 * strip of 6 x 1, and hides the middle third of it. The square's sides are at
 * 18 and 30; the strip's ends at 6 and 42, its long sides at 21 and 27. */
#include "bench/peers/lines/line_pixels.h"
#include "bench/peers/lines/lines.h"

#include "tests/tap.h"

#include <stdlib.h>

enum { SIZE = 48, SQUARE = 0, STRIP = 1 };

struct bench {
  struct hsr_scene *scene;
  struct hsr_world world;
  struct hsr_view view;
  struct hsr_edges edges;
  struct hsr_drawing right;
  uint32_t pixel[SIZE * SIZE];
};

static bool add_rectangle(struct hsr_scene *scene, double half_x, double half_y,
                          double z) {
  static const uint32_t corner[4] = {0, 1, 2, 3};
  struct hsr_object *object = hsr_scene_object(scene, "rectangle");
  return object && !hsr_object_vertex(object, -half_x, -half_y, z, NULL) &&
         !hsr_object_vertex(object, half_x, -half_y, z, NULL) &&
         !hsr_object_vertex(object, half_x, half_y, z, NULL) &&
         !hsr_object_vertex(object, -half_x, half_y, z, NULL) &&
         !hsr_object_face(object, corner, 4, NULL);
}

static void open_bench(struct bench *b) {
  const struct hsr_camera camera = {
      .eye = {0, 0, 5}, .up = {0, 1, 0}, .fov = 45, .parallel = 8};
  struct hsr_error err;
  *b = (struct bench){.scene = hsr_scene_new("strip")};
  if (!b->scene || !add_rectangle(b->scene, 1, 1, 1) ||
      !add_rectangle(b->scene, 3, .5, 0) || hsr_scene_finish(b->scene, &err) ||
      hsr_world_init(&b->world, b->scene, &err) ||
      hsr_view_init(&b->view, &camera, SIZE, SIZE, &err) ||
      hsr_edges_init(&b->edges, &b->world, &err) ||
      lines_draw_right(&b->world, &b->view, &b->right, &err)) {
    printf("Bail out! no drawing\n");
    exit(99);
  }
}

static void close_bench(struct bench *b) {
  hsr_drawing_free(&b->right);
  hsr_edges_free(&b->edges);
  hsr_world_free(&b->world);
  hsr_scene_delete(b->scene);
}

/* Pixels [x0, x1] x [y0, y1]. */
static void put(struct bench *b, uint32_t face, int x0, int x1, int y0,
                int y1) {
  for (int y = y0; y <= y1; y++)
    for (int x = x0; x <= x1; x++)
      b->pixel[y * SIZE + x] = face;
}

static void put_right(struct bench *b) {
  put(b, HSR_BACKGROUND, 0, SIZE - 1, 0, SIZE - 1);
  for (int side = 0; side < 2; side++) {
    put(b, STRIP, 6, 17, side ? 27 : 21, side ? 27 : 21);
    put(b, STRIP, 30, 41, side ? 27 : 21, side ? 27 : 21);
    put(b, STRIP, side ? 42 : 6, side ? 42 : 6, 21, 27);
    put(b, SQUARE, 18, 29, side ? 30 : 18, side ? 30 : 18);
    put(b, SQUARE, side ? 30 : 18, side ? 30 : 18, 18, 30);
  }
}

/* Whether so many edges are wrong in each way, by so many pixels. */
static bool says(struct bench *b, size_t visible, size_t visible_px,
                 size_t hidden, size_t hidden_px) {
  struct pixels_verdict v;
  struct hsr_error err;
  if (line_pixels_compare(&b->edges, &b->view, b->pixel, &b->right, &v, &err))
    return false;
  bool good = v.edges == 8 && v.visible == visible &&
              v.visible_px == visible_px && v.hidden == hidden &&
              v.hidden_px == hidden_px;
  if (!good)
    printf("# %zu edges, %zu by %zu shown, %zu by %zu hidden\n", v.edges,
           v.visible, v.visible_px, v.hidden, v.hidden_px);
  return good;
}

int main(void) {
  struct tap tap = plan(8);
  struct bench b;
  open_bench(&b);
  put_right(&b);
  ok(&tap, says(&b, 0, 0, 0, 0), "the right picture has no error");

  put(&b, STRIP, 17, 30, 21, 21);
  ok(&tap, says(&b, 1, 10, 0, 0),
     "a hidden third is shown: 12 pixels, less one and a bit at either end");

  put_right(&b);
  put(&b, HSR_BACKGROUND, 6, 17, 27, 27);
  ok(&tap, says(&b, 0, 0, 1, 9),
     "a visible third is not: 10 steps, of which one is beside the strip's "
     "end");

  put_right(&b);
  put(&b, HSR_BACKGROUND, 10, 10, 21, 21);
  ok(&tap, says(&b, 0, 0, 0, 0), "a gap of one pixel is none");
  put(&b, HSR_BACKGROUND, 10, 12, 21, 21);
  ok(&tap, says(&b, 0, 0, 1, 1), "a gap of three pixels is one");

  put_right(&b);
  put(&b, STRIP, 2, 2, 24, 24);
  ok(&tap, says(&b, 1, 1, 0, 0), "a pixel that lies apart from its face");

  put_right(&b);
  put(&b, STRIP, 18, 29, 18, 18);
  ok(&tap, says(&b, 1, 12, 0, 0), "the square's side in the strip's colour");

  put_right(&b);
  put(&b, SQUARE, 6, 15, 21, 21);
  ok(&tap, says(&b, 1, 10, 0, 0),
     "one edge covers another: it is wrong there, the other one is not");
  close_bench(&b);
  return finish(&tap);
}
