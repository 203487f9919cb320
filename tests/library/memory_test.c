/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every function of hsr.h when memory runs out. This program's malloc is the
 * library's, too. It fails once: at the first allocation of a piece of work, or
 * at a later one. The work must then be done all the same, or end with
 * HSR_E_NOMEM; it must leave nothing behind; and the same work must succeed
 * when it is done again.
 *
 *   memory_test [STEP]    STEP 1: every allocation fails once; standard: some
 *                         hundred of each piece of work */
#include "tests/library/public.h"

#include <errno.h>
#include <stdatomic.h>

void *__libc_malloc(size_t);
void *__libc_calloc(size_t, size_t);
void *__libc_realloc(void *, size_t);
void *__libc_memalign(size_t, size_t);
void __libc_free(void *);

/* --- Memory --------------------------------------------------------------- */

static atomic_long asked, fail_at, held;

static bool fails(void) {
  if (++asked != fail_at)
    return false;
  errno = ENOMEM;
  return true;
}

static void *hold(void *p) {
  held += p != NULL;
  return p;
}

/* The library finds these because they are visible. */
#pragma GCC visibility push(default)

void *malloc(size_t size) {
  return fails() ? NULL : hold(__libc_malloc(size));
}

void *calloc(size_t n, size_t size) {
  return fails() ? NULL : hold(__libc_calloc(n, size));
}

void *realloc(void *p, size_t size) {
  if (fails())
    return NULL;
  return p ? __libc_realloc(p, size) : hold(__libc_realloc(NULL, size));
}

void *aligned_alloc(size_t alignment, size_t size) {
  return fails() ? NULL : hold(__libc_memalign(alignment, size));
}

int posix_memalign(void **p, size_t alignment, size_t size) {
  *p = aligned_alloc(alignment, size);
  return *p ? 0 : ENOMEM;
}

void free(void *p) {
  held -= p != NULL;
  __libc_free(p);
}

#pragma GCC visibility pop

/* --- Work ----------------------------------------------------------------- */

enum { M = 12, N = 9 };

/* A piece of work, on a scene that is there; NULL: it opens its own. */
typedef enum hsr_status work(const struct hsr_scene *scene, const char *word);

static enum hsr_status open_by_name(const struct hsr_scene *scene,
                                    const char *word) {
  (void)scene;
  struct hsr_scene *own;
  enum hsr_status status = hsr_open(word, NULL, &own, NULL);
  hsr_close(own);
  return status;
}

static enum hsr_status open_by_arrays(const struct hsr_scene *scene,
                                      const char *word) {
  (void)scene, (void)word;
  static const double xyz[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  static const uint32_t vertex[] = {0, 1, 2, 0, 1, 3};
  static const float opacity[] = {1, 0.5f};
  static const double places[] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0,
                                  1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 1, 0};
  struct hsr_arrays arrays = {.size = sizeof arrays,
                              .xyz = xyz,
                              .n_vertices = 4,
                              .n_faces = 2,
                              .vertex = vertex,
                              .n_corners = 6,
                              .opacity = opacity,
                              .instance = places,
                              .n_instances = 2};
  struct hsr_scene *own;
  enum hsr_status status = hsr_open_arrays(&arrays, NULL, &own, NULL);
  struct hsr_geometry geometry = {.size = sizeof geometry};
  if (!status)
    status = hsr_get_geometry(own, &geometry, NULL);
  hsr_close(own);
  return status;
}

static enum hsr_status open_by_grid(const struct hsr_scene *scene,
                                    const char *word) {
  (void)scene, (void)word;
  static const float density[8] = {1, 0, 0, 1};
  struct hsr_grid_arrays grid = {.size = sizeof grid,
                                 .n = {2, 2, 2},
                                 .density = density,
                                 .least = 1,
                                 .most = 1};
  struct hsr_scene *own;
  enum hsr_status status = hsr_open_grid(&grid, NULL, &own, NULL);
  hsr_close(own);
  return status;
}

/* Draws by the algorithm that the word names. */
static enum hsr_status draw(const struct hsr_scene *scene, const char *word) {
  struct hsr_request request = request_of(word, M, N);
  struct hsr_answer *answer;
  enum hsr_status status = hsr_draw(scene, &request, &answer, NULL);
  hsr_free(answer);
  return status;
}

/* Makes it ready, draws a picture and another over it. */
static enum hsr_status redraw(const struct hsr_scene *scene, const char *word) {
  struct hsr_request request = request_of(word, M, N);
  struct hsr_drawer *drawer;
  struct hsr_answer *answer = NULL;
  enum hsr_status status = hsr_prepare(scene, &request, &drawer, NULL);
  if (!status)
    status = hsr_redraw(drawer, &request, &answer, NULL);
  if (!status)
    status = hsr_redraw(drawer, &request, &answer, NULL);
  hsr_free(answer);
  hsr_release(drawer);
  return status;
}

static enum hsr_status draw_by_threads(const struct hsr_scene *scene,
                                       const char *word) {
  struct hsr_request request = request_of(word, M, N);
  struct hsr_answer *answer;
  request.threads = 3;
  enum hsr_status status = hsr_draw(scene, &request, &answer, NULL);
  hsr_free(answer);
  return status;
}

static void ignore(void *context, const struct hsr_event *event) {
  (void)context, (void)event;
}

static enum hsr_status trace(const struct hsr_scene *scene, const char *word) {
  struct hsr_request request = request_of(word, M, N);
  struct hsr_answer *answer;
  enum hsr_status status =
      hsr_trace(scene, &request, ignore, NULL, &answer, NULL);
  hsr_free(answer);
  return status;
}

static enum hsr_status judge(const struct hsr_scene *scene, const char *word) {
  struct hsr_request request = request_of(word, M, N);
  struct hsr_verdict verdict = {.size = sizeof verdict};
  struct hsr_answer *answer;
  enum hsr_status status = hsr_draw(scene, &request, &answer, NULL);
  if (!status)
    status = hsr_judge(answer, &verdict, NULL);
  hsr_free(answer);
  return status ? status : verdict.differing ? HSR_E_DIFFERENCE : HSR_OK;
}

static enum hsr_status judge_ids(const struct hsr_scene *scene,
                                 const char *word) {
  (void)word;
  struct hsr_request request = request_of(NULL, M, N);
  struct hsr_verdict verdict = {.size = sizeof verdict};
  static const uint32_t ids[M * N];
  return hsr_judge_ids(scene, &request, ids, &verdict, NULL);
}

/* Reads all that an answer of the word's algorithm has. */
static enum hsr_status read_all(const struct hsr_scene *scene,
                                const char *word) {
  struct hsr_request request = request_of(word, M, N);
  struct hsr_answer *answer;
  float depth[M * N], rgb[3 * M * N];
  const struct hsr_segment *segment;
  struct hsr_polygon_arrays polygons = {.size = sizeof polygons};
  struct hsr_voxel_array voxels = {.size = sizeof voxels};
  const uint32_t *ids;
  const unsigned char *lit;
  const double *bounds;
  char text[200];
  size_t n;
  enum hsr_status status = hsr_draw(scene, &request, &answer, NULL), each[10];
  if (status)
    return status;
  each[0] = hsr_get_depths(answer, depth, M * N, NULL);
  each[1] = hsr_get_colours(answer, HSR_COLOUR_LAMBERT, rgb, 3 * M * N, NULL);
  each[2] = hsr_get_segments(answer, &segment, &n, NULL);
  each[3] = hsr_get_polygons(answer, &polygons, NULL);
  each[4] = hsr_get_voxels(answer, &voxels, NULL);
  each[5] = hsr_get_ids(answer, &ids, NULL);
  each[6] = hsr_get_lit(answer, &lit, NULL);
  each[7] = hsr_get_areas(answer, &bounds, NULL);
  each[8] = hsr_get_colours(answer, HSR_COLOUR_GOURAUD, rgb, 3 * M * N, NULL);
  each[9] = hsr_get_summary(answer, text, sizeof text, NULL);
  for (int k = 0; k < 10; k++)
    if (each[k] != HSR_OK && each[k] != HSR_E_USAGE)
      status = each[k];
  hsr_free(answer);
  return status;
}

/* --- Failures ------------------------------------------------------------- */

struct result {
  long tried, failed; /* allocations that failed; pieces of work that did */
  long wrong, left;   /* wrong statuses; pieces that left memory behind */
};

/* Does the work with the kth allocation failing, and checks it. Returns whether
 * there was a kth. */
static bool try_at(work *do_it, const struct hsr_scene *scene, const char *word,
                   long k, struct result *result) {
  long before = held;
  asked = 0;
  fail_at = k;
  enum hsr_status status = do_it(scene, word);
  bool reached = asked >= k;
  fail_at = 0;
  if (status && status != HSR_E_NOMEM && result->wrong++ < 5)
    printf("# allocation %ld: status %d\n", k, (int)status);
  long left = held - before;
  if (left > 0 && result->left++ < 5)
    printf("# allocation %ld: %ld blocks are left\n", k, left);
  result->tried += reached;
  result->failed += status == HSR_E_NOMEM;
  return reached;
}

static void test(struct tap *tap, work *do_it, const char *name,
                 const struct hsr_scene *scene, const char *word, long step) {
  /* What is loaded or made once is there after the first time. */
  struct result result = {.tried = 0};
  bool good = !do_it(scene, word);
  asked = 0;
  good = good && !do_it(scene, word);
  long all = asked;
  if (!step)
    step = all / 200 + 1;
  for (long k = 1; good && try_at(do_it, scene, word, k, &result);)
    k += step;
  enum hsr_status after = do_it(scene, word);
  ok(tap, good && !result.wrong && !result.left && !after && result.failed > 0,
     "%s %s: %ld of %ld allocations fail, %ld end it (%ld wrong, %ld leave "
     "something)",
     name, word, result.tried, all, result.failed, result.wrong, result.left);
}

int main(int argc, char **argv) {
  static const char *const algorithm[] = {
      "watkins",  "newell",  "warnock",    "zbuffer-fast",
      "hzbuffer", "tiling",  "bsp-front",  "raycast",
      "appel",    "roberts", "schumacker", "weiler-atherton"};
  enum { N_ALGORITHMS = sizeof algorithm / sizeof *algorithm };
  long step = argc > 1 ? atol(argv[1]) : 0;
  struct tap tap = plan(7 + N_ALGORITHMS + 10);
  struct hsr_scene *house = open_scene("t-junction"),
                   *grid = open_scene("grid:3");
  test(&tap, open_by_name, "open", NULL, "house", step);
  test(&tap, open_by_name, "open", NULL, "lattice:20:3", step);
  test(&tap, open_by_name, "open", NULL, "checker-cube:3", step);
  test(&tap, open_by_arrays, "open", NULL, "arrays", step);
  test(&tap, open_by_grid, "open", NULL, "a grid of arrays", step);
  test(&tap, draw_by_threads, "by threads", house, "watkins", step);
  test(&tap, draw, "draw", grid, "btf", step);
  for (int k = 0; k < N_ALGORITHMS; k++)
    test(&tap, draw, "draw", house, algorithm[k], step);
  test(&tap, redraw, "redraw", house, "newell-previous", step);
  test(&tap, redraw, "redraw", house, "appel", step);
  test(&tap, redraw, "redraw", house, "weiler-atherton", step);
  test(&tap, trace, "trace", house, "watkins", step);
  test(&tap, judge, "judge", house, "watkins", step);
  test(&tap, judge, "judge", house, "appel", step);
  test(&tap, judge_ids, "judge", house, "ids", step);
  test(&tap, read_all, "read", house, "watkins", step);
  test(&tap, read_all, "read", house, "appel", step);
  test(&tap, read_all, "read", house, "weiler-atherton", step);
  hsr_close(house);
  hsr_close(grid);
  return finish(&tap);
}
