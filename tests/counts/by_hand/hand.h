/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pictures whose counts are derived by hand.
 *
 * The eye is at the origin and looks along -z with an angle of 90 degrees. The
 * picture is m wide and n high; pixel (0, 0) is its upper left corner, and
 * sample (i, j) is at (i + 0.5, j + 0.5). So whole numbers lie between samples,
 * and the column of an upright edge at x is x. 1 / depth is linear over the
 * picture on a flat face. */
#ifndef HSR_TESTS_COUNTS_HAND_H
#define HSR_TESTS_COUNTS_HAND_H

#include "tests/draw.h"
#include "tests/tap.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* A vertex: pixels, and its distance in z from the eye. */
struct hand_vertex {
  double x, y, depth;
};

struct hand_picture {
  struct hsr_scene *scene;
  struct hsr_world world;
  struct hsr_view view;
};

/* Appends a vertex of a picture of m x n to an object. */
static inline uint32_t hand_add(struct hsr_object *object,
                                const struct hand_vertex *at, int m, int n) {
  double pixel = at->depth / (n / 2.0); /* its size at that depth */
  uint32_t v = 0;
  hsr_object_vertex(object, (at->x - m / 2.0) * pixel,
                    (n / 2.0 - at->y) * pixel, -at->depth, &v);
  return v;
}

/* Completes a picture whose scene has its objects. */
static inline void hand_finish(struct hand_picture *p, int m, int n) {
  struct hsr_error err = {.text = "out of memory"};
  const struct hsr_camera camera = {
      .at = {0, 0, -1}, .up = {0, 1, 0}, .fov = 90};
  if (hsr_scene_view(p->scene, &camera))
    bail("%s", err.text);
  must_finish(p->scene);
  must_world(&p->world, p->scene);
  must_view(&p->view, &camera, m, n);
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
  bail("%s", outcome);
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

/* Draws the picture by an algorithm, or a variant of proposals.def. Prints the
 * counters that differ from the derived values; true if there are none. If
 * `all`, a counter that is not listed must be 0. */
static inline bool hand_compare(const struct hand_picture *p, const char *name,
                                const struct hand_count *derived, bool all) {
  const struct hsr_algorithm *a = find_counting(name);
  struct hand_heard heard = {.n = {{0}}};
  struct hsr_trace trace = {.listen = hand_listen, .context = &heard};
  struct hsr_tally tally = {.trace = &trace};
  struct hsr_answer answer;
  bool good = draw_answer(a, &p->world, &p->view, &answer, &tally);
  hsr_answer_free(&answer);
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
    if (!found && all && tally.count[k]) {
      printf("# %s: %s: counted %" PRIu64 ", not derived\n", name,
             a->counters[k].name, tally.count[k]);
      good = false;
    }
  }
  return good && n_found == n_derived;
}

#endif
