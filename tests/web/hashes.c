/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Prints what is drawn of the built-in scenes by every algorithm, a line each:
 *
 *   SCENE  ALGORITHM  the hash of the answer (bench/web/hash.h), or the error
 *                     what it counts, by the build that counts: numbers with
 *                     commas
 *
 * with tabs. tests/web/equal.mjs draws the same in WebAssembly and compares.
 *
 * usage: hashes [SIZE [SCENE...]]        (standard: 128, all that need no package
 *                                         and have fewer than 20,000 faces) */
#include "bench/web/hash.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_FACES = 20000 };

static int size = 128;

static void print_counts(const struct lib_scene *scene,
                         struct hsr_request request) {
  struct lib_answer *answer = NULL;
  const uint64_t *count;
  size_t n = 0;
  request.counts = 1;
  if (!hsr_draw(scene, &request, &answer, NULL) &&
      !hsr_get_counts(answer, &count, &n, NULL))
    for (size_t k = 0; k < n; k++)
      printf("%s%llu", k ? "," : "", (unsigned long long)count[k]);
  hsr_free(answer);
}

/* Draws, and prints the line. */
static void draw(const struct lib_scene *scene, const char *name,
                 const char *algorithm) {
  const struct hsr_request request = {
      .size = sizeof request, .algorithm = algorithm, .m = size, .n = size};
  struct lib_answer *answer = NULL;
  struct hsr_error err;
  char text[HASH_TEXT];
  printf("%s\t%s\t", name, algorithm);
  if (hsr_draw(scene, &request, &answer, &err)) {
    printf("%d: %s\t\n", (int)err.status, err.text);
  } else {
    hash_answer(answer, text);
    printf("%s\t", text);
    print_counts(scene, request);
    printf("\n");
  }
  fflush(stdout);
  hsr_free(answer);
}

/* Whether a kind is drawn, too. Filtered pictures are folded from many others in
 * one way for all algorithms: one is enough. */
static bool is_wanted(const struct hsr_option_info *option,
                      const char *algorithm) {
  return option->standard < 0 && (strcmp(option->kind, "filtered") ||
                                  !strcmp(algorithm, "zbuffer-fast"));
}

/* An algorithm as it is, and for each kind that one of its options asks for. */
static void draw_all(const struct lib_scene *scene, const char *name,
                     size_t algorithm, const char *called) {
  struct hsr_option_info o = {.size = sizeof o};
  struct hsr_word_info w = {.size = sizeof w};
  char text[200];
  draw(scene, name, called);
  for (size_t k = 0; !hsr_get_option(algorithm, k, &o, NULL); k++)
    for (size_t l = 0;
         is_wanted(&o, called) && !hsr_get_word(algorithm, k, l, &w, NULL);
         l++) {
      snprintf(text, sizeof text, "%s:%s=%s", called, o.name, w.name);
      draw(scene, name, text);
    }
}

/* The oracle of polygons is left out: it may cut them up in any way. */
static void draw_scene(const char *name) {
  struct hsr_scene_info info = {.size = sizeof info};
  struct hsr_algorithm_info a = {.size = sizeof a};
  struct lib_scene *scene = NULL;
  struct hsr_error err;
  if (hsr_open(name, NULL, &scene, &err)) {
    printf("%s\t\t%d: %s\n", name, (int)err.status, err.text);
    return;
  }
  hsr_get_scene(scene, &info, NULL);
  for (size_t k = 0;
       info.n_faces < MOST_FACES && !hsr_get_algorithm(k, &a, NULL); k++)
    if (a.is_oracle && strcmp(a.name, "polygon-oracle"))
      draw(scene, name, a.name); /* other kinds take long */
    else if (!a.is_oracle && !a.draws_nothing)
      draw_all(scene, name, k, a.name);
  hsr_close(scene);
}

int main(int argc, char **argv) {
  struct hsr_builtin_info b = {.size = sizeof b};
  if (argc > 1)
    size = atoi(argv[1]);
  for (int k = 2; k < argc; k++)
    draw_scene(argv[k]);
  for (size_t k = 0; argc < 3 && !hsr_get_builtin(k, &b, NULL); k++)
    if (!b.package)
      draw_scene(b.name);
  return 0;
}
