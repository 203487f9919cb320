/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes whose counts can be derived by hand: objects whose vertices are given
 * in pixels of the picture, each with a depth.
 *
 * The eye is at the origin and looks along -z with an angle of 90 degrees. The
 * picture is 16 wide and 8 high; pixel (0, 0) is its upper left corner, and
 * sample (i, j) is at (i + 0.5, j + 0.5). So an upright edge at a whole x lies
 * between samples. 1 / depth is linear over the picture on a flat face. */
#ifndef HSR_TESTS_COUNTS_OBJECTS_H
#define HSR_TESTS_COUNTS_OBJECTS_H

#include "tests/draw.h"
#include "tests/tap.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

enum { OBJECTS_M = 16, OBJECTS_N = 8 };

struct hand_vertex {
  double x, y, depth;
};

struct hand_face {
  int n;
  int vertex[4]; /* of its object */
};

struct hand_object {
  int n_vertices, n_faces;
  struct hand_vertex vertex[8];
  struct hand_face face[6];
};

/* An object that is one rectangle at one depth. Its vertices are numbered
 * clockwise from the upper left corner. */
#define HAND_RECTANGLE(x0, y0, x1, y1, depth)                                  \
  {                                                                            \
    4, 1,                                                                      \
        {{x0, y0, depth}, {x1, y0, depth}, {x1, y1, depth}, {x0, y1, depth}},  \
    {                                                                          \
      {                                                                        \
        4, {                                                                   \
          0, 1, 2, 3                                                           \
        }                                                                      \
      }                                                                        \
    }                                                                          \
  }

/* The same, at one depth on its left and at another on its right. */
#define HAND_SLANT(x0, y0, x1, y1, left, right)                                \
  {                                                                            \
    4, 1, {{x0, y0, left}, {x1, y0, right}, {x1, y1, right}, {x0, y1, left}},  \
    {                                                                          \
      {                                                                        \
        4, {                                                                   \
          0, 1, 2, 3                                                           \
        }                                                                      \
      }                                                                        \
    }                                                                          \
  }

struct hand_picture {
  struct hsr_scene *scene;
  struct hsr_world world;
  struct hsr_view view;
};

static inline void hand_stop(const char *text) {
  printf("Bail out! %s\n", text);
  exit(99);
}

static inline void hand_open(struct hand_picture *p,
                             const struct hand_object *object, int n) {
  struct hsr_error err = {.text = "out of memory"};
  p->scene = hsr_scene_new("by hand");
  for (int k = 0; k < n; k++) {
    struct hsr_object *made = hsr_scene_object(p->scene, "object");
    uint32_t v[8], corner[4];
    for (int i = 0; i < object[k].n_vertices; i++) {
      const struct hand_vertex *at = &object[k].vertex[i];
      double pixel = at->depth / (OBJECTS_N / 2.0); /* its size at that depth */
      hsr_object_vertex(made, (at->x - OBJECTS_M / 2.0) * pixel,
                        (OBJECTS_N / 2.0 - at->y) * pixel, -at->depth, &v[i]);
    }
    for (int f = 0; f < object[k].n_faces; f++) {
      const struct hand_face *face = &object[k].face[f];
      for (int i = 0; i < face->n; i++)
        corner[i] = v[face->vertex[i]];
      hsr_object_face(made, corner, (size_t)face->n, NULL);
    }
  }
  const struct hsr_camera camera = {
      .at = {0, 0, -1}, .up = {0, 1, 0}, .fov = 90};
  if (hsr_scene_view(p->scene, &camera) || hsr_scene_finish(p->scene, &err) ||
      hsr_world_init(&p->world, p->scene, &err) ||
      hsr_view_init(&p->view, &camera, OBJECTS_M, OBJECTS_N, &err))
    hand_stop(err.text);
}

static inline void hand_close(struct hand_picture *p) {
  hsr_world_free(&p->world);
  hsr_scene_delete(p->scene);
}

/* What a counter must be; or how many of its events must have an outcome. */
struct hand_count {
  const char *counter;
  uint64_t derived;
  const char *outcome; /* NULL: all */
};

enum { HAND_OUTCOMES = 10 };

struct hand_heard {
  uint64_t n[HSR_MAX_COUNTERS][HAND_OUTCOMES];
};

static inline void hand_listen(void *context, const struct hsr_event *event) {
  struct hand_heard *heard = context;
  heard->n[event->counter][event->outcome]++;
}

/* The number of an outcome, which must be among the counter's. */
static inline int hand_outcome(const struct hsr_counter *counter,
                               const char *outcome) {
  const char *at = counter->outcomes;
  size_t length = strlen(outcome);
  for (int k = 0; at; k++) {
    const char *end = strchr(at, '|');
    if (!strncmp(at, outcome, length) && (at[length] == '|' || !at[length]))
      return k;
    at = end ? end + 1 : NULL;
  }
  hand_stop(outcome);
  return 0;
}

static inline bool hand_check_one(const struct hsr_algorithm *a, int k,
                                  const struct hsr_tally *tally,
                                  const struct hand_heard *heard,
                                  const struct hand_count *d) {
  uint64_t counted =
      d->outcome ? heard->n[k][hand_outcome(&a->counters[k], d->outcome)]
                 : tally->count[k];
  if (counted == d->derived)
    return true;
  printf("# %s: %s: %s: counted %" PRIu64 ", derived %" PRIu64 "\n", a->name,
         d->counter, d->outcome ? d->outcome : "all", counted, d->derived);
  return false;
}

/* Draws the objects. Prints the counters that differ from the derived values,
 * or have none; true if there are no such counters. */
static inline bool hand_check(const char *name,
                              const struct hand_object *object, int n,
                              const struct hand_count *derived) {
  const struct hsr_algorithm *a = hsr_algorithm_find(name)->counting;
  struct hand_picture p;
  struct hand_heard heard = {.n = {{0}}};
  struct hsr_trace trace = {.listen = hand_listen, .context = &heard};
  struct hsr_tally tally = {.trace = &trace};
  struct hsr_drawing drawing = {.n = 0};
  uint32_t ids[OBJECTS_M * OBJECTS_N];
  hand_open(&p, object, n);
  if (a->kind == HSR_SEGMENTS)
    draw_lines(a, &p.world, &p.view, &drawing, &tally);
  else
    draw_ids(a, &p.world, &p.view, ids, &tally);
  hsr_drawing_free(&drawing);
  hand_close(&p);
  bool good = true;
  int n_derived = 0, n_found = 0;
  while (derived[n_derived].counter)
    n_derived++;
  for (int k = 0; a->counters[k].name; k++) {
    bool found = false;
    for (const struct hand_count *d = derived; d->counter; d++)
      if (!strcmp(d->counter, a->counters[k].name)) {
        n_found++;
        found |= !d->outcome;
        good &= hand_check_one(a, k, &tally, &heard, d);
      }
    if (!found) {
      printf("# %s: %s: not derived\n", name, a->counters[k].name);
      good = false;
    }
  }
  return good && n_found == n_derived;
}

#endif
