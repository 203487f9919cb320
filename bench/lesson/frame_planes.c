/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The planes that a step asks about, over the picture: as looks/solids.js and
 * looks/tests.js of the page draw them. */
#include "bench/lesson/frames.h"

#include <string.h>

static void mark_plane(struct frames *f, const struct lesson_plane *plane,
                       const struct frame_look *look) {
  double at[LESSON_MOST_CORNERS][3];
  int n = lesson_plane_in_box(&f->run->laid_out.mesh, plane, at);
  if (n < 3)
    return;
  json_t *image = lesson_image_json(&f->run->view, (const double(*)[3])at, n);
  frames_add_polygon(f, image);
  frames_set_colour(f->cairo, look->colour, look->fill);
  cairo_fill_preserve(f->cairo);
  frames_stroke(f, look->colour, look->width, look->dash);
  json_decref(image);
}

void frames_mark_plane_of(struct frames *f, json_int_t face,
                          const struct frame_look *look) {
  if (face < 0 || face >= f->run->laid_out.n_faces)
    return;
  struct lesson_plane plane =
      lesson_plane_of_face(&f->run->laid_out.mesh, (uint32_t)face);
  mark_plane(f, &plane, look);
}

/* The plane of a separator between clusters. */
static void mark_separator(struct frames *f, uint32_t node,
                           const struct frame_look *look) {
  const json_t *s =
      json_array_get(json_object_get(f->structure, "separators"), node);
  if (!s)
    return;
  if (json_is_integer(json_array_get(s, 0))) {
    frames_mark_plane_of(f, json_integer_value(json_array_get(s, 0)), look);
    return;
  }
  struct lesson_plane plane = {{0}, json_number_value(json_array_get(s, 2))};
  plane.normal[json_integer_value(json_array_get(s, 1)) % 3] = 1;
  mark_plane(f, &plane, look);
}

/* The plane of the node that holds a piece of a BSP tree. */
static void mark_node_of(struct frames *f, const struct hsr_subject *piece) {
  static const struct frame_look look = {FRAME_INK, .08, 1.2, FRAME_DASHED};
  json_int_t at = frames_place_of_piece(f, piece);
  size_t k;
  const json_t *node;
  json_array_foreach(json_object_get(f->structure, "nodes"), k, node) {
    json_int_t first = json_integer_value(json_array_get(node, 3)),
               many = json_integer_value(json_array_get(node, 4));
    if (first <= at && at < first + many) {
      frames_mark_plane_of(f, json_integer_value(json_array_get(node, 0)),
                           &look);
      return;
    }
  }
}

void frames_mark_planes(struct frames *f, const struct hsr_event *event,
                        unsigned colour) {
  const struct hsr_counter *c =
      &f->run->setup.algorithm->counters[event->counter];
  const struct hsr_subject *both[] = {&event->b, &event->a};
  if (hsr_has_key(c, "inter-cluster"))
    for (int k = 0; k < 2; k++)
      if (both[k]->kind == HSR_OF_CELL)
        mark_separator(f, both[k]->id[0],
                       &(struct frame_look){colour, k ? .3 : .18, 2,
                                            k ? FRAME_SOLID : FRAME_DASHED});
  if (hsr_has_key(c, "piece") && event->a.kind == HSR_OF_PIECE)
    mark_node_of(f, &event->a);
}
