/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes whose counts can be derived by hand: faces whose corners are given in
 * pixels of the picture, each with a depth.
 *
 * The eye is at the origin and looks along -z with an angle of 90 degrees. The
 * picture is m wide and n high; pixel (0, 0) is its upper left corner, and
 * sample (i, j) is at (i + 0.5, j + 0.5). So whole numbers lie between samples,
 * and the column of an upright edge at x is x. */
#ifndef HSR_TESTS_COUNTS_PIXELS_H
#define HSR_TESTS_COUNTS_PIXELS_H

#include "tests/draw.h"
#include "tests/tap.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* A corner: pixels, and its distance in z from the eye. */
struct pixel_corner {
  double x, y, depth;
};

struct pixel_face {
  int n; /* corners */
  struct pixel_corner corner[4];
};

/* A rectangle at one depth: left, then right edge, clockwise from the upper
 * left corner. */
#define PIXEL_RECTANGLE(x0, y0, x1, y1, depth)                                 \
  {                                                                            \
    4, {                                                                       \
      {x0, y0, depth}, {x1, y0, depth}, {x1, y1, depth}, {                     \
        x0, y1, depth                                                          \
      }                                                                        \
    }                                                                          \
  }

struct pixel_picture {
  struct hsr_scene *scene;
  struct hsr_world world;
  struct hsr_view view;
};

static inline void pixel_stop(const char *text) {
  printf("Bail out! %s\n", text);
  exit(99);
}

static inline void pixel_open(struct pixel_picture *p,
                              const struct pixel_face *face, int n_faces, int m,
                              int n) {
  struct hsr_error err = {.text = "out of memory"};
  p->scene = hsr_scene_new("by hand");
  struct hsr_object *object = hsr_scene_object(p->scene, "faces");
  for (int f = 0; f < n_faces; f++) {
    uint32_t v[4];
    for (int k = 0; k < face[f].n; k++) {
      const struct pixel_corner *c = &face[f].corner[k];
      double unit = c->depth / (n / 2.0); /* a pixel at that depth */
      hsr_object_vertex(object, (c->x - m / 2.0) * unit,
                        (n / 2.0 - c->y) * unit, -c->depth, &v[k]);
    }
    hsr_object_face(object, v, (size_t)face[f].n, NULL);
  }
  const struct hsr_camera camera = {
      .at = {0, 0, -1}, .up = {0, 1, 0}, .fov = 90};
  if (hsr_scene_view(p->scene, &camera) || hsr_scene_finish(p->scene, &err) ||
      hsr_world_init(&p->world, p->scene, &err) ||
      hsr_view_init(&p->view, &camera, m, n, &err))
    pixel_stop(err.text);
}

static inline void pixel_close(struct pixel_picture *p) {
  hsr_world_free(&p->world);
  hsr_scene_delete(p->scene);
}

/* What a counter must be; or how many of its events must have an outcome. */
struct pixel_count {
  const char *counter;
  uint64_t derived;
  const char *outcome; /* NULL: all */
};

enum { PIXEL_OUTCOMES = 8 };

struct pixel_heard {
  uint64_t n[HSR_MAX_COUNTERS][PIXEL_OUTCOMES];
};

static inline void pixel_listen(void *context, const struct hsr_event *event) {
  struct pixel_heard *heard = context;
  heard->n[event->counter][event->outcome]++;
}

/* The number of an outcome among a counter's; it must be there. */
static inline int pixel_outcome(const struct hsr_counter *counter,
                                const char *outcome) {
  const char *at = counter->outcomes;
  size_t length = strlen(outcome);
  for (int k = 0; at; k++) {
    const char *end = strchr(at, '|');
    if (strlen(at) >= length && !strncmp(at, outcome, length) &&
        (at[length] == '|' || !at[length]))
      return k;
    at = end ? end + 1 : NULL;
  }
  pixel_stop(outcome);
  return 0;
}

static inline bool pixel_check_one(const struct hsr_algorithm *a, int k,
                                   const struct hsr_tally *tally,
                                   const struct pixel_heard *heard,
                                   const struct pixel_count *d) {
  uint64_t counted =
      d->outcome ? heard->n[k][pixel_outcome(&a->counters[k], d->outcome)]
                 : tally->count[k];
  if (counted == d->derived)
    return true;
  printf("# %s: %s: %s: counted %" PRIu64 ", derived %" PRIu64 "\n", a->name,
         d->counter, d->outcome ? d->outcome : "all", counted, d->derived);
  return false;
}

/* Draws the picture. Prints the counters that differ from the derived values
 * and, if `all`, those that have none; true if there are no such counters. */
static inline bool pixel_check(const struct pixel_picture *p, const char *name,
                               const struct pixel_count *derived, bool all) {
  const struct hsr_algorithm *a = hsr_algorithm_find(name)->counting;
  struct pixel_heard heard = {.n = {{0}}};
  struct hsr_trace trace = {.listen = pixel_listen, .context = &heard};
  struct hsr_tally tally = {.trace = &trace};
  uint32_t *ids = calloc((size_t)(p->view.m * p->view.n), sizeof *ids);
  if (!ids)
    pixel_stop("out of memory");
  draw_ids(a, &p->world, &p->view, ids, &tally);
  free(ids);
  bool good = true;
  int n_derived = 0, n_found = 0;
  while (derived[n_derived].counter)
    n_derived++;
  for (int k = 0; a->counters[k].name; k++) {
    bool found = false;
    for (const struct pixel_count *d = derived; d->counter; d++)
      if (!strcmp(d->counter, a->counters[k].name)) {
        n_found++;
        found |= !d->outcome;
        good &= pixel_check_one(a, k, &tally, &heard, d);
      }
    if (!found && all) {
      printf("# %s: %s: not derived\n", name, a->counters[k].name);
      good = false;
    }
  }
  return good && n_found == n_derived;
}

#endif
