/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The boxes that a step compares, over the picture: as looks/boxes.js of the page
 * draws them. */
#include "bench/lesson/frames.h"

#include <math.h>

struct box {
  double x0, y0, x1, y1;
};

static const struct box empty = {INFINITY, INFINITY, -INFINITY, -INFINITY};

static void widen(struct box *box, const json_t *point) {
  if (!json_is_array(point))
    return;
  double x = json_number_value(json_array_get(point, 0)),
         y = json_number_value(json_array_get(point, 1));
  box->x0 = fmin(box->x0, x);
  box->y0 = fmin(box->y0, y);
  box->x1 = fmax(box->x1, x);
  box->y1 = fmax(box->y1, y);
}

static void widen_by_all(struct box *box, const json_t *polygon) {
  size_t k;
  const json_t *point;
  json_array_foreach(polygon, k, point) widen(box, point);
}

/* Around the image of a subject; empty if it is not known. */
static struct box box_of(const struct frames *f, const struct hsr_event *event,
                         const struct hsr_subject *s) {
  const json_t *vertices = json_object_get(f->header, "vertices");
  struct box box = empty;
  size_t k;
  const json_t *face;
  if (s->kind == HSR_OF_EDGE) {
    widen(&box, json_array_get(vertices, s->id[0]));
    widen(&box, json_array_get(vertices, s->id[1]));
  } else if (s->kind == HSR_OF_FACE || s->kind == HSR_OF_PIECE) {
    const json_t *left = frames_outline(f, event, s);
    widen_by_all(&box, left ? left : frames_image(f, s->id[0]));
  } else if (s->kind == HSR_OF_VOLUME) {
    json_array_foreach(frames_faces_of_volume(f, event, s), k, face)
        widen_by_all(&box, frames_image(f, (uint32_t)json_integer_value(face)));
  }
  return box;
}

void frames_mark_boxes(struct frames *f, const struct hsr_event *event) {
  const struct hsr_subject *both[] = {&event->a, &event->b};
  if (!frames_has_outcome(f, event, "boxes"))
    return;
  for (int k = 0; k < 2; k++) {
    struct box box = box_of(f, event, both[k]);
    if (box.x0 > box.x1)
      continue;
    cairo_rectangle(f->cairo, box.x0, box.y0, box.x1 - box.x0, box.y1 - box.y0);
    frames_stroke(f, FRAME_INK, 1.2, k ? FRAME_DASHED : FRAME_SOLID);
  }
}
