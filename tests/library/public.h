/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the tests of the library share. They use hsr.h, and nothing of hsr
 * else. */
#ifndef HSR_TESTS_LIBRARY_PUBLIC_H
#define HSR_TESTS_LIBRARY_PUBLIC_H

#include <hsr.h>

#include "tests/tap.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A scene that can be opened. */
static inline struct hsr_scene *open_scene(const char *name) {
  struct hsr_scene *scene = NULL;
  struct hsr_error err;
  if (hsr_open(name, NULL, &scene, &err))
    printf("# %s: %s\n", name, err.text);
  return scene;
}

/* A request for the scene's first view. */
static inline struct hsr_request request_of(const char *algorithm, int m,
                                            int n) {
  struct hsr_request request = {
      .size = sizeof request, .algorithm = algorithm, .m = m, .n = n};
  return request;
}

/* The first view of a scene by an algorithm; NULL: it cannot be drawn. */
static inline struct hsr_answer *draw_by(const struct hsr_scene *scene,
                                         const char *algorithm, int m, int n) {
  struct hsr_request request = request_of(algorithm, m, n);
  struct hsr_answer *answer = NULL;
  struct hsr_error err;
  if (hsr_draw(scene, &request, &answer, &err))
    printf("# %s: %s\n", algorithm, err.text);
  return answer;
}

#endif
