/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Drawers: one that has drawn other pictures draws what hsr_draw draws. Through
 * hsr.h alone. */
#include "tests/library/public.h"

#include <pthread.h>

enum { M = 24, N = 18, N_VIEWS = 3, N_PLACES = M * N };

/* Whether two answers of ids have the same. */
static bool same_ids(const struct hsr_answer *a, const struct hsr_answer *b) {
  const uint32_t *f = NULL, *g = NULL;
  return !hsr_get_ids(a, &f, NULL) && !hsr_get_ids(b, &g, NULL) &&
         !memcmp(f, g, N_PLACES * sizeof *f);
}

static bool is_same_segment(const struct hsr_segment *f,
                            const struct hsr_segment *g) {
  return f->is_implied == g->is_implied && f->a == g->a && f->b == g->b &&
         f->part == g->part && f->invisibility == g->invisibility &&
         f->t0 == g->t0 && f->t1 == g->t1 &&
         !memcmp(f->from, g->from, sizeof f->from) &&
         !memcmp(f->to, g->to, sizeof f->to);
}

static bool same_segments(const struct hsr_answer *a,
                          const struct hsr_answer *b) {
  const struct hsr_segment *f = NULL, *g = NULL;
  size_t n = 0, k = 0;
  if (hsr_get_segments(a, &f, &n, NULL) || hsr_get_segments(b, &g, &k, NULL) ||
      !n || n != k)
    return false;
  for (size_t i = 0; i < n; i++)
    if (!is_same_segment(&f[i], &g[i]))
      return false;
  return true;
}

static bool same_polygons(const struct hsr_answer *a,
                          const struct hsr_answer *b) {
  struct hsr_polygon_arrays f = {.size = sizeof f}, g = {.size = sizeof g};
  return !hsr_get_polygons(a, &f, NULL) && !hsr_get_polygons(b, &g, NULL) &&
         f.n_regions && f.n_regions == g.n_regions &&
         f.n_points == g.n_points &&
         !memcmp(f.face, g.face, f.n_regions * sizeof *f.face) &&
         !memcmp(f.xy, g.xy, 2 * f.n_points * sizeof *f.xy);
}

static bool same_colours(const struct hsr_answer *a,
                         const struct hsr_answer *b) {
  float f[3 * N_PLACES], g[3 * N_PLACES];
  return !hsr_get_colours(a, HSR_COLOUR_LAMBERT, f, 3 * N_PLACES, NULL) &&
         !hsr_get_colours(b, HSR_COLOUR_LAMBERT, g, 3 * N_PLACES, NULL) &&
         !memcmp(f, g, sizeof f);
}

static const struct subject {
  const char *scene, *algorithm;
  bool (*same)(const struct hsr_answer *, const struct hsr_answer *);
} subjects[] = {
    {"house", "watkins", same_ids},
    {"house", "newell-previous", same_ids}, /* it keeps its list of faces */
    {"office:1", "hzbuffer", same_ids},
    {"house", "zbuffer-fast:filter=box", same_colours},
    {"house", "zbuffer-fast:shadows=cast", same_ids},
    {"greenhouse", "bsp-painter:mix=linear", same_colours},
    {"house", "appel", same_segments},
    {"house", "weiler-atherton", same_polygons},
    {"house", "error-bounded", same_colours},
    {"grid:3", "btf", same_ids},
};
enum { N_SUBJECTS = sizeof subjects / sizeof *subjects };

/* --- The same ------------------------------------------------------------- */

/* Whether view v, drawn new or over *over, is what hsr_draw draws, and right. */
static bool is_same(const struct subject *s, const struct hsr_scene *scene,
                    struct hsr_drawer *drawer, uint32_t v,
                    struct hsr_answer **over) {
  struct hsr_request request = request_of(s->algorithm, M, N);
  struct hsr_answer *once = NULL;
  struct hsr_verdict verdict = {.size = sizeof verdict};
  struct hsr_error err = {.text = "it differs"};
  request.view = v;
  bool good = !hsr_draw(scene, &request, &once, &err) &&
              !hsr_redraw(drawer, &request, over, &err) &&
              s->same(*over, once) && !hsr_judge(*over, &verdict, &err) &&
              verdict.compared && !verdict.differing;
  if (!good)
    printf("# view %u: %s %s\n", v, err.text, verdict.first);
  hsr_free(once);
  return good;
}

static void test_subject(struct tap *tap, const struct subject *s) {
  struct hsr_scene *scene = open_scene(s->scene);
  struct hsr_request request = request_of(s->algorithm, 0, 0);
  struct hsr_drawer *drawer = NULL;
  struct hsr_answer *over = NULL, *new[N_VIEWS] = {NULL};
  bool good = !hsr_prepare(scene, &request, &drawer, NULL);
  for (uint32_t v = 0; good && v < N_VIEWS; v++)
    good = is_same(s, scene, drawer, v, &new[v]) &&
           is_same(s, scene, drawer, v, &over);
  ok(tap, good, "%s by %s: each view as if it were alone", s->scene,
     s->algorithm);
  good = good && s->same(over, new[N_VIEWS - 1]);
  hsr_release(drawer);
  hsr_close(scene);
  struct hsr_verdict verdict = {.size = sizeof verdict};
  ok(tap,
     good && !hsr_judge(new[0], &verdict, NULL) && verdict.compared &&
         !verdict.differing,
     "and its answers outlive it");
  hsr_free(over);
  for (int v = 0; v < N_VIEWS; v++)
    hsr_free(new[v]);
}

/* --- Sizes and windows ---------------------------------------------------- */

/* Whether a picture of another size is right. */
static bool is_right(struct hsr_drawer *drawer, int m, int n) {
  struct hsr_request request = request_of(NULL, m, n);
  struct hsr_answer *answer = NULL;
  struct hsr_verdict verdict = {.size = sizeof verdict};
  bool right = !hsr_redraw(drawer, &request, &answer, NULL) &&
               !hsr_judge(answer, &verdict, NULL) &&
               verdict.compared == (uint64_t)m * (uint64_t)n &&
               !verdict.differing;
  hsr_free(answer);
  return right;
}

static void test_sizes(struct tap *tap, const char *algorithm) {
  struct hsr_scene *scene = open_scene("house");
  struct hsr_request request = request_of(algorithm, 0, 0);
  struct hsr_drawer *drawer = NULL;
  ok(tap,
     !hsr_prepare(scene, &request, &drawer, NULL) && is_right(drawer, 20, 10) &&
         is_right(drawer, 31, 33) && is_right(drawer, 20, 10),
     "%s draws pictures of several sizes", algorithm);
  hsr_release(drawer);
  hsr_close(scene);
}

/* A window; then all of the picture over it; counts are of the last. */
static void test_window(struct tap *tap) {
  struct hsr_scene *scene = open_scene("house");
  struct hsr_request request = request_of("watkins", M, N);
  struct hsr_drawer *drawer = NULL;
  struct hsr_answer *answer = NULL, *once = NULL;
  const uint64_t *some = NULL, *all = NULL;
  size_t n = 0;
  request.counts = 1;
  request.threads = 2;
  request.window[2] = 5;
  request.window[3] = 4;
  struct hsr_verdict verdict = {.size = sizeof verdict};
  ok(tap,
     !hsr_prepare(scene, &request, &drawer, NULL) &&
         !hsr_redraw(drawer, &request, &answer, NULL) &&
         !hsr_judge(answer, &verdict, NULL) && verdict.compared == 20 &&
         !verdict.differing,
     "a window of 5 x 4 samples is right");
  memset(request.window, 0, sizeof request.window);
  bool drawn = !hsr_redraw(drawer, &request, &answer, NULL) &&
               !hsr_draw(scene, &request, &once, NULL) &&
               !hsr_get_counts(answer, &some, &n, NULL) &&
               !hsr_get_counts(once, &all, &n, NULL);
  ok(tap, drawn && same_ids(answer, once), "all of it, drawn over the window");
  ok(tap, drawn && n && !memcmp(some, all, n * sizeof *all),
     "its counts are its own");
  const float *work = NULL;
  request.work = 1;
  drawn = !hsr_redraw(drawer, &request, &answer, NULL) &&
          !hsr_get_work(answer, &work, NULL);
  ok(tap, drawn && work, "its work is there when it is asked for");
  request.work = 0;
  drawn = !hsr_redraw(drawer, &request, &answer, NULL);
  ok(tap, drawn && hsr_get_work(answer, &work, NULL) == HSR_E_USAGE,
     "and then no more");
  hsr_free(answer);
  hsr_free(once);
  hsr_release(drawer);
  hsr_close(scene);
}

/* Samples that are not in the middle of their places, judged in both ways. */
static void test_offset(struct tap *tap) {
  struct hsr_scene *scene = open_scene("house");
  struct hsr_request request = request_of("watkins", M, N);
  struct hsr_answer *answer = NULL, *middle = draw_by(scene, "watkins", M, N);
  struct hsr_verdict own = {.size = sizeof own}, both = own, none = own;
  struct hsr_error err = {.text = ""};
  const uint32_t *ids = NULL;
  request.offset[0] = -0.375;
  request.offset[1] = 0x1.fffffffffffffp-2;
  ok(tap,
     !hsr_draw(scene, &request, &answer, NULL) &&
         !hsr_judge(answer, &own, NULL) && own.compared && !own.differing &&
         !hsr_get_ids(answer, &ids, NULL) &&
         !hsr_judge_ids(scene, &request, ids, &both, NULL) && !both.differing &&
         !same_ids(answer, middle),
     "samples that are displaced are right");
  memset(request.offset, 0, sizeof request.offset);
  ok(tap,
     ids && !hsr_judge_ids(scene, &request, ids, &none, NULL) && none.differing,
     "they are not those in the middle: %s", none.first);
  hsr_free(answer);
  request.offset[1] = 0.5;
  ok(tap, hsr_draw(scene, &request, &answer, &err) == HSR_E_USAGE, "%s",
     err.text);
  request.offset[1] = 0.25;
  request.algorithm = "appel";
  ok(tap, hsr_draw(scene, &request, &answer, &err) == HSR_E_USAGE, "%s",
     err.text);
  hsr_free(middle);
  hsr_close(scene);
}

/* --- What is wrong -------------------------------------------------------- */

static int stop(void *context, double share) {
  (void)context;
  return share < 0.5;
}

static void test_wrong(struct tap *tap) {
  struct hsr_scene *scene = open_scene("house");
  struct hsr_request request = request_of("watkins", M, N);
  struct hsr_drawer *drawer = NULL, *other = NULL, *none = (void *)&request;
  struct hsr_answer *answer = NULL;
  struct hsr_error err = {.text = ""};
  bool ready = !hsr_prepare(scene, &request, &drawer, NULL) &&
               !hsr_prepare(scene, &request, &other, NULL) &&
               !hsr_redraw(drawer, &request, &answer, NULL);
  ok(tap, ready && hsr_redraw(other, &request, &answer, &err) == HSR_E_USAGE,
     "%s", err.text);
  request.m = M + 1;
  ok(tap, hsr_redraw(drawer, &request, &answer, &err) == HSR_E_USAGE, "%s",
     err.text);
  request.m = M;
  request.progress = stop;
  bool stopped = hsr_redraw(drawer, &request, &answer, NULL) == HSR_E_STOPPED;
  request.progress = NULL;
  ok(tap,
     stopped && !answer && !hsr_redraw(drawer, &request, &answer, NULL) &&
         is_right(drawer, M, N),
     "what was stopped is freed, and the drawer goes on");
  request.view = 1000;
  ok(tap, hsr_redraw(drawer, &request, &answer, &err) == HSR_E_USAGE, "%s",
     err.text);
  ok(tap,
     hsr_redraw(NULL, &request, &answer, NULL) == HSR_E_USAGE &&
         hsr_redraw(drawer, NULL, &answer, NULL) == HSR_E_USAGE &&
         hsr_redraw(drawer, &request, NULL, NULL) == HSR_E_USAGE &&
         hsr_prepare(NULL, &request, &none, NULL) == HSR_E_USAGE && !none &&
         hsr_prepare(scene, NULL, &none, NULL) == HSR_E_USAGE &&
         hsr_prepare(scene, &request, NULL, NULL) == HSR_E_USAGE,
     "NULL is refused");
  request.algorithm = "btf";
  ok(tap, hsr_prepare(scene, &request, &none, &err) == HSR_E_REFUSED && !none,
     "%s", err.text);
  hsr_free(answer);
  hsr_release(drawer);
  hsr_release(other);
  hsr_release(NULL);
  hsr_close(scene);
}

/* --- Threads -------------------------------------------------------------- */

static void *draw_often(void *shared) {
  struct hsr_drawer *drawer = shared;
  bool good = true;
  for (int k = 0; k < 20 && good; k++)
    good = is_right(drawer, 10 + k, 10);
  return good ? drawer : NULL;
}

static void test_threads(struct tap *tap) {
  struct hsr_scene *scene = open_scene("house");
  struct hsr_request request = request_of("newell-previous", 0, 0);
  struct hsr_drawer *drawer = NULL;
  pthread_t one, two;
  void *first = NULL, *second = NULL;
  if (!hsr_prepare(scene, &request, &drawer, NULL)) {
    pthread_create(&one, NULL, draw_often, drawer);
    pthread_create(&two, NULL, draw_often, drawer);
    pthread_join(one, &first);
    pthread_join(two, &second);
  }
  ok(tap, first && second, "two threads take turns");
  hsr_release(drawer);
  hsr_close(scene);
}

int main(void) {
  struct tap tap = plan(2 * N_SUBJECTS + 18);
  for (int k = 0; k < N_SUBJECTS; k++)
    test_subject(&tap, &subjects[k]);
  test_sizes(&tap, "watkins");
  test_sizes(&tap, "newell-previous");
  test_window(&tap);
  test_offset(&tap);
  test_wrong(&tap);
  test_threads(&tap);
  return finish(&tap);
}
