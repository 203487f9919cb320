/* SPDX-License-Identifier: GPL-3.0-or-later */
/* For the tests of what judges lines: a square of side 2 hangs before a strip
 * of 6 x 1, so that the middle thirds of the strip's long edges are hidden.
 * Eight units are the height of the picture. */
#ifndef HSR_TESTS_UNIT_PEERS_STRIP_H
#define HSR_TESTS_UNIT_PEERS_STRIP_H

#include "bench/peers/lines/lines.h"
#include "tests/tap.h"

struct strip {
  struct hsr_scene *scene;
  struct hsr_world world;
  struct hsr_view view;
  struct hsr_edges edges;
  struct hsr_drawing right;
};

/* A rectangle at a height z, whose middle is above (0, y). */
static inline bool add_rectangle(struct hsr_scene *scene, double half_x,
                                 double half_y, double y, double z) {
  static const uint32_t corner[4] = {0, 1, 2, 3};
  struct hsr_object *object = hsr_scene_object(scene, "rectangle");
  return object && !hsr_object_vertex(object, -half_x, y - half_y, z, NULL) &&
         !hsr_object_vertex(object, half_x, y - half_y, z, NULL) &&
         !hsr_object_vertex(object, half_x, y + half_y, z, NULL) &&
         !hsr_object_vertex(object, -half_x, y + half_y, z, NULL) &&
         !hsr_object_face(object, corner, 4, NULL);
}

/* In a picture of so many pixels a side. The strip is as much higher up. */
static inline void open_strip(struct strip *s, int size, double higher) {
  const struct hsr_camera camera = {
      .eye = {0, 0, 5}, .up = {0, 1, 0}, .fov = 45, .parallel = 8};
  struct hsr_error err;
  *s = (struct strip){.scene = hsr_scene_new("strip")};
  if (!s->scene || !add_rectangle(s->scene, 1, 1, 0, 1) ||
      !add_rectangle(s->scene, 3, .5, higher, 0) ||
      hsr_scene_finish(s->scene, &err) ||
      hsr_world_init(&s->world, s->scene, &err) ||
      hsr_view_init(&s->view, &camera, size, size, &err) ||
      hsr_edges_init(&s->edges, &s->world, &err) ||
      lines_draw_right(&s->world, &s->view, &s->right, &err))
    bail("no drawing");
}

static inline void close_strip(struct strip *s) {
  hsr_drawing_free(&s->right);
  hsr_edges_free(&s->edges);
  hsr_world_free(&s->world);
  hsr_scene_delete(s->scene);
}

#endif
