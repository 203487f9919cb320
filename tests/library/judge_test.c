/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Judging, and drawing on several threads, through hsr.h alone. */
#include "tests/library/public.h"

#include <pthread.h>

enum { M = 40, N = 30, ALL = M * N };

/* --- All algorithms ------------------------------------------------------- */

struct found {
  int right, refused, wrong;
};

static void judge_one(const struct hsr_scene *scene, const char *algorithm,
                      struct found *found) {
  struct hsr_request request = request_of(algorithm, M, N);
  struct hsr_verdict verdict = {.size = sizeof verdict};
  struct hsr_answer *answer = NULL;
  struct hsr_error err = {.text = ""};
  enum hsr_status status = hsr_draw(scene, &request, &answer, &err);
  if (!status)
    status = hsr_judge(answer, &verdict, &err);
  if (status == HSR_E_REFUSED) {
    found->refused++;
  } else if (status || verdict.differing || verdict.compared != ALL) {
    found->wrong++;
    printf("# %s: %s%s\n", algorithm, err.text, verdict.first);
  } else {
    found->right++;
  }
  hsr_free(answer);
}

static struct found judge_all(const char *name) {
  struct hsr_scene *scene = open_scene(name);
  struct hsr_algorithm_info a = {.size = sizeof a};
  struct hsr_kind_info kind = {.size = sizeof kind};
  struct found found = {0};
  for (size_t k = 0; !hsr_get_algorithm(k, &a, NULL); k++) {
    bool is_ids =
        !hsr_get_kind(a.kind, &kind, NULL) && !strcmp(kind.name, "ids");
    if (is_ids && !a.draws_nothing && !a.is_known_wrong)
      judge_one(scene, a.name, &found);
  }
  hsr_close(scene);
  return found;
}

/* Answers of the other kinds. */
static void test_kinds(struct tap *tap) {
  static const char *const what[][2] = {{"house", "appel"},
                                        {"house", "weiler-atherton"},
                                        {"house", "error-bounded"},
                                        {"house", "zbuffer-fast:filter=box"},
                                        {"greenhouse", "newell:mix=linear"},
                                        {"house", "raycast:shadows=cast"},
                                        {"grid:3", "splat"},
                                        {"house", "tiling-solids:side=12"}};
  for (int k = 0; k < 8; k++) {
    struct hsr_scene *scene = open_scene(what[k][0]);
    struct hsr_answer *answer = draw_by(scene, what[k][1], 12, 9);
    struct hsr_verdict v = {.size = sizeof v};
    struct hsr_error err = {.text = ""};
    ok(tap, !hsr_judge(answer, &v, &err) && v.compared && !v.differing,
       "%s, %s: %llu compared, %llu differ %s%s", what[k][0], what[k][1],
       (unsigned long long)v.compared, (unsigned long long)v.differing, v.first,
       err.text);
    hsr_free(answer);
    hsr_close(scene);
  }
}

/* --- A stranger's ids ----------------------------------------------------- */

static void test_stranger(struct tap *tap) {
  struct hsr_scene *scene = open_scene("house");
  struct hsr_answer *answer = draw_by(scene, "watkins", M, N);
  struct hsr_request request = {.size = sizeof request, .m = M, .n = N};
  uint32_t copy[ALL], place[4] = {9, 9, 9, 9};
  const uint32_t *ids = NULL;
  struct hsr_verdict v = {.size = sizeof v, .place = place, .room = 4};
  if (!hsr_get_ids(answer, &ids, NULL))
    memcpy(copy, ids, sizeof copy);
  ok(tap,
     !hsr_judge_ids(scene, &request, copy, &v, NULL) && v.compared == ALL &&
         !v.differing && !v.n_places && !*v.first && place[0] == 9,
     "a stranger who is right is found right");
  copy[7 * M + 11] = 1000000;
  ok(tap,
     !hsr_judge_ids(scene, &request, copy, &v, NULL) && v.compared == ALL &&
         v.differing == 1 && v.n_places == 1 && place[0] == 7 * M + 11 &&
         place[1] == 9 && !strncmp(v.first, "(11, 7): face 1000000", 21),
     "one sample is changed, and one differs: %s", v.first);
  for (int k = 100; k < 110; k++)
    copy[k] = 1000000;
  ok(tap,
     !hsr_judge_ids(scene, &request, copy, &v, NULL) && v.differing == 11 &&
         v.n_places == 4 && place[0] == 100 && place[3] == 103,
     "the first places are told, as many as there is room for");
  memcpy(request.window, (const int[]){11, 7, 13, 9}, sizeof request.window);
  ok(tap,
     !hsr_judge_ids(scene, &request, copy, &v, NULL) && v.compared == 4 &&
         v.differing == 1 && place[0] == 7 * M + 11,
     "only the window is compared");
  v.place = NULL;
  ok(tap,
     !hsr_judge_ids(scene, &request, copy, &v, NULL) && v.differing == 1 &&
         !v.n_places,
     "places need not be asked for");
  hsr_free(answer);
  hsr_close(scene);
}

static void test_errors(struct tap *tap) {
  struct hsr_scene *scene = open_scene("house");
  struct hsr_answer *nothing = draw_by(scene, "null", M, N);
  struct hsr_request request = {.size = sizeof request, .m = M, .n = N};
  struct hsr_verdict v = {.size = sizeof v}, small = {.size = 8};
  uint32_t ids[ALL] = {0};
  struct hsr_error err = {.text = ""};
  ok(tap, hsr_judge(nothing, &v, &err) == HSR_E_REFUSED, "%s", err.text);
  ok(tap, hsr_judge(nothing, &small, &err) == HSR_E_USAGE, "%s", err.text);
  ok(tap,
     hsr_judge_ids(NULL, &request, ids, &v, NULL) == HSR_E_USAGE &&
         hsr_judge_ids(scene, NULL, ids, &v, NULL) == HSR_E_USAGE &&
         hsr_judge_ids(scene, &request, NULL, &v, NULL) == HSR_E_USAGE &&
         hsr_judge_ids(scene, &request, ids, NULL, NULL) == HSR_E_USAGE,
     "NULL is refused");
  request.n = 0;
  ok(tap, hsr_judge_ids(scene, &request, ids, &v, &err) == HSR_E_USAGE, "%s",
     err.text);
  request.n = N;
  request.view = 99;
  ok(tap, hsr_judge_ids(scene, &request, ids, &v, &err) == HSR_E_USAGE, "%s",
     err.text);
  hsr_free(nothing);
  hsr_close(scene);
}

/* --- Threads -------------------------------------------------------------- */

/* What a thread draws: the scene is its own, or that of all. */
struct task {
  const struct hsr_scene *shared;
  const char *scene, *algorithm;
  int threads;
  uint64_t differing;
  enum hsr_status status;
};

static void *run(void *context) {
  struct task *t = context;
  struct hsr_scene *own = t->shared ? NULL : open_scene(t->scene);
  struct hsr_request request = request_of(t->algorithm, M, N);
  struct hsr_verdict v = {.size = sizeof v};
  request.threads = t->threads;
  for (int k = 0; k < 3 && !t->status; k++) {
    struct hsr_answer *answer = NULL;
    t->status = hsr_draw(t->shared ? t->shared : own, &request, &answer, NULL);
    if (!t->status)
      t->status = hsr_judge(answer, &v, NULL);
    t->differing += v.differing;
    hsr_free(answer);
  }
  hsr_close(own);
  return NULL;
}

static bool run_together(struct task *task, int n) {
  pthread_t thread[8];
  bool good = true;
  for (int k = 0; k < n; k++)
    pthread_create(&thread[k], NULL, run, &task[k]);
  for (int k = 0; k < n; k++)
    pthread_join(thread[k], NULL);
  for (int k = 0; k < n; k++)
    good = good && !task[k].status && !task[k].differing;
  return good;
}

static void test_threads(struct tap *tap) {
  static const char *const scene[] = {
      "house",  "soup:100:2",   "penetration", "lattice:40:3",
      "grid:3", "color-cube:2", "coplanar",    "sphere:100"};
  static const char *const algorithm[] = {"watkins", "newell",    "zbuffer",
                                          "warnock", "bsp-front", "tiling",
                                          "raycast", "hzbuffer"};
  struct task task[8];
  memset(task, 0, sizeof task);
  for (int k = 0; k < 8; k++) {
    task[k].scene = scene[k];
    task[k].algorithm = algorithm[k];
    task[k].threads = 1 + k % 2;
  }
  ok(tap, run_together(task, 2), "two threads draw two scenes at once");
  ok(tap, run_together(task, 8), "eight threads draw eight scenes at once");
  struct hsr_scene *house = open_scene("house"), *grid = open_scene("grid:3");
  for (int k = 0; k < 8; k++)
    task[k].shared = house;
  ok(tap, run_together(task, 8), "eight threads draw one scene at once");
  /* Some take the grid, and some its faces, which are made for them. */
  for (int k = 0; k < 8; k++) {
    task[k].shared = grid;
    task[k].algorithm = k % 2 ? "btf" : "watkins";
  }
  ok(tap, run_together(task, 8), "or one grid");
  hsr_close(house);
  hsr_close(grid);
}

int main(void) {
  struct tap tap = plan(24);
  struct found found = judge_all("house");
  ok(&tap, !found.wrong && found.right > 25,
     "the house: %d algorithms are right, %d refuse", found.right,
     found.refused);
  found = judge_all("grid:3");
  ok(&tap, !found.wrong && found.right > 30,
     "a grid: %d algorithms are right, %d refuse", found.right, found.refused);
  test_kinds(&tap);
  test_stranger(&tap);
  test_errors(&tap);
  test_threads(&tap);
  return finish(&tap);
}
