/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Drawing, reading, tracing and writing, through hsr.h alone. */
#include "tests/library/public.h"

#include <math.h>

enum { M = 24, N = 18 };

/* --- Requests ------------------------------------------------------------- */

/* The status of drawing; the answer must be NULL just after a failure. */
static enum hsr_status status_of(const struct hsr_scene *scene,
                                 const struct hsr_request *request,
                                 struct hsr_error *err) {
  struct hsr_answer *answer = (struct hsr_answer *)err;
  enum hsr_status status = hsr_draw(scene, request, &answer, err);
  if (!status != !!answer)
    status = HSR_E_INTERNAL;
  hsr_free(answer);
  return status;
}

static void test_usage(struct tap *tap, const struct hsr_scene *scene) {
  static const char *const wrong[] = {"watkinz", "watkins:no=1",
                                      "watkins:window=0",
                                      "zbuffer-fast:jitter=4", ""};
  struct hsr_error err = {.text = ""};
  for (int k = 0; k < 5; k++) {
    struct hsr_request request = request_of(wrong[k], M, N);
    ok(tap, status_of(scene, &request, &err) == HSR_E_USAGE, "'%s': %s",
       wrong[k], err.text);
  }
  struct hsr_request request = request_of("watkins", 0, N);
  ok(tap, status_of(scene, &request, &err) == HSR_E_USAGE, "%s", err.text);
  request = request_of("watkins", M, 16385);
  ok(tap, status_of(scene, &request, &err) == HSR_E_USAGE, "%s", err.text);
  request = request_of("watkins", M, N);
  request.view = 1000;
  ok(tap, status_of(scene, &request, &err) == HSR_E_USAGE, "%s", err.text);
  request = request_of("watkins", M, N);
  request.threads = -1;
  ok(tap, status_of(scene, &request, &err) == HSR_E_USAGE, "%s", err.text);
  request = request_of("watkins", M, N);
  request.size = 4;
  ok(tap, status_of(scene, &request, &err) == HSR_E_USAGE, "%s", err.text);
  request = request_of(NULL, M, N);
  struct hsr_answer *answer = NULL;
  ok(tap,
     status_of(scene, &request, NULL) == HSR_E_USAGE &&
         status_of(scene, NULL, NULL) == HSR_E_USAGE &&
         hsr_draw(NULL, &request, &answer, NULL) == HSR_E_USAGE &&
         hsr_draw(scene, &request, NULL, NULL) == HSR_E_USAGE,
     "NULL is refused");
}

static void test_refused(struct tap *tap, const struct hsr_scene *scene) {
  struct hsr_camera camera = {.size = sizeof camera, .fov = 50};
  struct hsr_error err = {.text = ""};
  struct hsr_request request = request_of("watkins", M, N);
  request.camera = &camera;
  ok(tap, status_of(scene, &request, &err) == HSR_E_INPUT, "%s", err.text);
  camera.size = 3;
  ok(tap, status_of(scene, &request, &err) == HSR_E_USAGE, "%s", err.text);
  request = request_of("btf", M, N);
  ok(tap, status_of(scene, &request, &err) == HSR_E_REFUSED, "%s", err.text);
}

static void test_windows(struct tap *tap, const struct hsr_scene *scene) {
  static const int wrong[][4] = {
      {5, 5, 5, 9}, {-1, 0, 4, 4}, {0, 0, M + 1, N}, {9, 9, 3, 12}};
  struct hsr_request request = request_of("watkins", M, N);
  struct hsr_answer *whole = draw_by(scene, "watkins", M, N), *part = NULL;
  const uint32_t *a = NULL, *b = NULL;
  int refused = 0, good = 0;
  for (int k = 0; k < 4; k++) {
    memcpy(request.window, wrong[k], sizeof request.window);
    refused += status_of(scene, &request, NULL) == HSR_E_USAGE;
  }
  ok(tap, refused == 4, "windows that are not in the picture are refused");
  memcpy(request.window, (const int[]){3, 2, 20, 11}, sizeof request.window);
  if (!hsr_draw(scene, &request, &part, NULL) && whole &&
      !hsr_get_ids(whole, &a, NULL) && !hsr_get_ids(part, &b, NULL))
    for (int j = 0; j < N; j++)
      for (int i = 0; i < M; i++) {
        bool in = i >= 3 && i < 20 && j >= 2 && j < 11;
        good += b[j * M + i] == (in ? a[j * M + i] : HSR_NO_FACE);
      }
  ok(tap, good == M * N, "a window has what the picture has there");
  struct hsr_verdict verdict = {.size = sizeof verdict};
  ok(tap,
     !hsr_judge(part, &verdict, NULL) && verdict.compared == 17 * 9 &&
         !verdict.differing,
     "and only that is judged");
  request.algorithm = "appel";
  ok(tap, status_of(scene, &request, NULL) == HSR_E_USAGE,
     "line drawings have no windows");
  hsr_free(whole);
  hsr_free(part);
}

/* --- Progress ------------------------------------------------------------- */

struct progress {
  double last;
  int calls, most;
  bool falls;
};

static int tell(void *context, double share) {
  struct progress *p = context;
  p->falls = p->falls || share < p->last;
  p->last = share;
  return ++p->calls <= p->most;
}

static void test_progress(struct tap *tap, const struct hsr_scene *scene) {
  struct progress p = {.most = 1000};
  struct hsr_error err = {.text = ""};
  struct hsr_request request = request_of("watkins", 64, 64);
  request.progress = tell;
  request.context = &p;
  enum hsr_status status = status_of(scene, &request, NULL);
  ok(tap, !status && p.calls > 10 && !p.falls && p.last == 1,
     "a drawing tells %d times how far it is", p.calls);
  p = (struct progress){.most = 5};
  ok(tap,
     status_of(scene, &request, &err) == HSR_E_STOPPED && p.calls == 6 &&
         p.last < 1,
     "and is stopped: %s", err.text);
  p = (struct progress){.most = 5};
  request.threads = 2;
  ok(tap, status_of(scene, &request, &err) == HSR_E_STOPPED && p.calls == 6,
     "two threads are stopped too");
  p = (struct progress){.most = 1000};
  request = request_of("watkins:filter=box", 8, 8);
  request.progress = tell;
  request.context = &p;
  status = status_of(scene, &request, NULL);
  ok(tap, !status && p.calls > 5 && !p.falls && p.last == 1,
     "so does one that is folded, %d times", p.calls);
}

/* --- Answers -------------------------------------------------------------- */

static void test_ids(struct tap *tap, const struct hsr_scene *scene) {
  struct hsr_answer *answer = draw_by(scene, "watkins", M, N);
  struct hsr_answer_info info = {.size = sizeof info};
  float depth[M * N], rgb[3 * M * N];
  const uint32_t *ids = NULL;
  int good = 0;
  ok(tap,
     !hsr_get_answer(answer, &info, NULL) && info.m == M && info.n == N &&
         info.window[2] == M && info.window[3] == N &&
         !strcmp(info.kind_name, "ids") && !strcmp(info.algorithm, "watkins") &&
         info.draw_seconds > 0,
     "an answer says what it is");
  hsr_get_ids(answer, &ids, NULL);
  bool got = !hsr_get_depths(answer, depth, M * N, NULL) && ids;
  for (int k = 0; got && k < M * N; k++)
    good += ids[k] == HSR_NO_FACE ? isinf(depth[k]) : depth[k] > 0;
  ok(tap, good == M * N, "it has ids and depths");
  good = 0;
  for (int shading = 0; shading < 4; shading++)
    good += !hsr_get_colours(answer, (enum hsr_shading_choice)shading, rgb,
                             3 * M * N, NULL) &&
            rgb[3 * (M * N / 2)] >= 0 && rgb[3 * (M * N / 2)] <= 1;
  ok(tap, good == 4, "and colours, of four sorts");
  struct hsr_error err = {.text = ""};
  ok(tap, hsr_get_depths(answer, depth, M, &err) == HSR_E_USAGE, "%s",
     err.text);
  ok(tap,
     hsr_get_colours(answer, HSR_COLOUR_FLAT, rgb, M * N, &err) == HSR_E_USAGE,
     "%s", err.text);
  ok(tap,
     hsr_get_colours(answer, (enum hsr_shading_choice)9, rgb, 3 * M * N,
                     &err) == HSR_E_USAGE,
     "%s", err.text);
  hsr_free(answer);
}

/* What an answer of ids has not. */
static void test_has_not(struct tap *tap, const struct hsr_scene *scene) {
  struct hsr_answer *answer = draw_by(scene, "zbuffer", M, N),
                    *lines = draw_by(scene, "appel", M, N);
  struct hsr_polygon_arrays polygons = {.size = sizeof polygons};
  struct hsr_voxel_array voxels = {.size = sizeof voxels};
  const struct hsr_segment *segment;
  const unsigned char *lit;
  const double *bounds;
  const uint32_t *sum;
  const uint64_t *count;
  const uint16_t *rgba;
  const float *work;
  float x[3 * M * N];
  size_t n;
  int channels;
  ok(tap,
     hsr_get_segments(answer, &segment, &n, NULL) == HSR_E_USAGE &&
         hsr_get_lit(answer, &lit, NULL) == HSR_E_USAGE &&
         hsr_get_areas(answer, &bounds, NULL) == HSR_E_USAGE &&
         hsr_get_sums(answer, &sum, NULL) == HSR_E_USAGE &&
         hsr_get_counts(answer, &count, &n, NULL) == HSR_E_USAGE &&
         hsr_get_work(answer, &work, NULL) == HSR_E_USAGE &&
         hsr_get_rgba(answer, &rgba, &channels, NULL) == HSR_E_USAGE &&
         hsr_get_polygons(answer, &polygons, NULL) == HSR_E_USAGE &&
         hsr_get_voxels(answer, &voxels, NULL) == HSR_E_USAGE,
     "what an answer has not is refused");
  ok(tap,
     hsr_get_ids(lines, &sum, NULL) == HSR_E_USAGE &&
         hsr_get_depths(lines, x, M * N, NULL) == HSR_E_USAGE &&
         hsr_get_colours(lines, HSR_COLOUR_LAMBERT, x, 3 * M * N, NULL) ==
             HSR_E_USAGE,
     "a line drawing has no ids, depths and colours");
  hsr_free(answer);
  hsr_free(lines);
  hsr_free(NULL);
}

static void test_null(struct tap *tap, const struct hsr_scene *scene) {
  struct hsr_answer *a = draw_by(scene, "zbuffer", M, N);
  struct hsr_answer_info info = {.size = sizeof info};
  struct hsr_polygon_arrays polygons = {.size = sizeof polygons};
  struct hsr_voxel_array voxels = {.size = sizeof voxels};
  struct hsr_verdict verdict = {.size = sizeof verdict};
  const void *to = NULL;
  char text[200];
  size_t n;
  int c;
  float x[3];
  const enum hsr_status without[] = {
      hsr_get_answer(NULL, &info, NULL),
      hsr_get_ids(NULL, (const uint32_t **)&to, NULL),
      hsr_get_lit(NULL, (const unsigned char **)&to, NULL),
      hsr_get_depths(NULL, x, 3, NULL),
      hsr_get_colours(NULL, HSR_COLOUR_FLAT, x, 3, NULL),
      hsr_get_segments(NULL, (const struct hsr_segment **)&to, &n, NULL),
      hsr_get_polygons(NULL, &polygons, NULL),
      hsr_get_areas(NULL, (const double **)&to, NULL),
      hsr_get_sums(NULL, (const uint32_t **)&to, NULL),
      hsr_get_rgba(NULL, (const uint16_t **)&to, &c, NULL),
      hsr_get_voxels(NULL, &voxels, NULL),
      hsr_get_counts(NULL, (const uint64_t **)&to, &n, NULL),
      hsr_get_work(NULL, (const float **)&to, NULL),
      hsr_get_work(a, NULL, NULL),
      hsr_get_summary(NULL, text, sizeof text, NULL),
      hsr_get_summary(a, NULL, sizeof text, NULL),
      hsr_judge(NULL, &verdict, NULL),
      hsr_write(NULL, "x.png", NULL, NULL),
      hsr_get_answer(a, NULL, NULL),
      hsr_get_ids(a, NULL, NULL),
      hsr_get_lit(a, NULL, NULL),
      hsr_get_depths(a, NULL, M * N, NULL),
      hsr_get_colours(a, HSR_COLOUR_FLAT, NULL, 3 * M * N, NULL),
      hsr_get_segments(a, NULL, &n, NULL),
      hsr_get_segments(a, (const struct hsr_segment **)&to, NULL, NULL),
      hsr_get_polygons(a, NULL, NULL),
      hsr_get_areas(a, NULL, NULL),
      hsr_get_sums(a, NULL, NULL),
      hsr_get_rgba(a, NULL, &c, NULL),
      hsr_get_rgba(a, (const uint16_t **)&to, NULL, NULL),
      hsr_get_voxels(a, NULL, NULL),
      hsr_get_counts(a, NULL, &n, NULL),
      hsr_get_counts(a, (const uint64_t **)&to, NULL, NULL),
      hsr_judge(a, NULL, NULL),
      hsr_write(a, NULL, NULL, NULL)};
  size_t all = sizeof without / sizeof *without, refused = 0;
  for (size_t k = 0; k < all; k++)
    refused += without[k] == HSR_E_USAGE;
  ok(tap, refused == all && !to, "%zu of %zu times NULL is refused", refused,
     all);
  hsr_free(a);
}

static void test_segments(struct tap *tap, const struct hsr_scene *scene) {
  struct hsr_answer *answer = draw_by(scene, "appel", M, N);
  const struct hsr_segment *s = NULL;
  size_t n = 0, good = 0, visible = 0;
  enum hsr_status status = hsr_get_segments(answer, &s, &n, NULL);
  for (size_t k = 0; !status && k < n; k++) {
    good += s[k].is_implied <= 1 && s[k].a < s[k].b && s[k].t0 >= 0 &&
            s[k].t0 <= s[k].t1 && s[k].t1 <= 1;
    visible += !s[k].invisibility;
  }
  ok(tap, n > 100 && good == n && visible > 0 && visible < n,
     "a drawing has %zu segments, and %zu are visible", n, visible);
  hsr_free(answer);
}

/* The area of cycle c, in pixels, positive if its inside is to the right. */
static double area_of(const struct hsr_polygon_arrays *p, size_t c) {
  size_t first = p->point[c], end = p->point[c + 1];
  double area = 0;
  for (size_t k = first; k < end; k++) {
    const double *a = &p->xy[2 * k],
                 *b = &p->xy[2 * (k + 1 < end ? k + 1 : first)];
    area += (a[0] * b[1] - b[0] * a[1]) / 2;
  }
  return fabs(area);
}

static void test_polygons(struct tap *tap, const struct hsr_scene *scene) {
  struct hsr_answer *answer = draw_by(scene, "weiler-atherton", M, N);
  struct hsr_polygon_arrays p = {.size = sizeof p};
  double covered = 0;
  bool ordered = true;
  enum hsr_status status = hsr_get_polygons(answer, &p, NULL);
  for (size_t r = 0; !status && r < p.n_regions; r++) {
    ordered = ordered && (!r || p.face[r - 1] <= p.face[r]);
    for (size_t c = p.cycle[r]; c < p.cycle[r + 1]; c++)
      covered += c == p.cycle[r] ? area_of(&p, c) : -area_of(&p, c);
  }
  ok(tap,
     p.n_regions > 20 && ordered && p.cycle[p.n_regions] == p.n_cycles &&
         p.point[p.n_cycles] == p.n_points && covered > 0 &&
         covered <= M * N + 1e-6,
     "%zu regions cover %.3f of %d pixels", p.n_regions, covered, M * N);
  float depth[M * N];
  ok(tap, !hsr_get_depths(answer, depth, M * N, NULL) && depth[M * N / 2] > 0,
     "they have depths");
  hsr_free(answer);
}

static void test_pixels(struct tap *tap, const struct hsr_scene *scene) {
  struct hsr_answer *areas = draw_by(scene, "error-bounded", 6, 4),
                    *sums = draw_by(scene, "zbuffer-fast:filter=box", 6, 4);
  const double *bounds = NULL;
  const uint32_t *sum = NULL;
  float rgb[72];
  int good = 0;
  if (areas && !hsr_get_areas(areas, &bounds, NULL))
    for (int k = 0; k < 72; k++)
      good += bounds[2 * k] <= bounds[2 * k + 1] && bounds[2 * k] >= -1e-9 &&
              bounds[2 * k + 1] <= 1 + 1e-9;
  ok(tap, good == 72, "areas are intervals of 0 to 1");
  good = 0;
  if (sums && !hsr_get_sums(sums, &sum, NULL) &&
      !hsr_get_colours(sums, HSR_COLOUR_LAMBERT, rgb, 72, NULL))
    for (int k = 0; k < 72; k++)
      good += (sum[k] > 0) == (rgb[k] > 0);
  ok(tap, good == 72, "sums are those of colours");
  ok(tap,
     sums &&
         hsr_get_colours(sums, HSR_COLOUR_IDS, rgb, 72, NULL) == HSR_E_USAGE,
     "which have no other shading");
  hsr_free(areas);
  hsr_free(sums);
}

static void test_channels(struct tap *tap) {
  struct hsr_scene *glass = open_scene("greenhouse"),
                   *grid = open_scene("grid:3");
  struct hsr_answer *three = draw_by(glass, "newell:mix=linear", M, N),
                    *four = draw_by(grid, "splat", M, N);
  struct hsr_scene_info info = {.size = sizeof info};
  const uint16_t *rgba = NULL;
  int channels = 0;
  ok(tap, !hsr_get_scene(glass, &info, NULL) && info.is_transparent,
     "a greenhouse is transparent");
  ok(tap, !hsr_get_rgba(three, &rgba, &channels, NULL) && rgba && channels == 3,
     "a transparent picture has three channels");
  ok(tap, !hsr_get_scene(grid, &info, NULL) && info.is_grid, "a grid is one");
  ok(tap, !hsr_get_rgba(four, &rgba, &channels, NULL) && channels == 4,
     "splats have four");
  hsr_free(three);
  hsr_free(four);
  hsr_close(glass);
  hsr_close(grid);
}

static void test_others(struct tap *tap, const struct hsr_scene *scene) {
  struct hsr_answer *shadows = draw_by(scene, "raycast:shadows=cast", M, N),
                    *solids = draw_by(scene, "tiling-solids:side=16", M, N);
  struct hsr_voxel_array v = {.size = sizeof v};
  const unsigned char *lit = NULL;
  const uint32_t *ids = NULL;
  int n[3] = {0, 0, 0};
  if (shadows && !hsr_get_lit(shadows, &lit, NULL) &&
      !hsr_get_ids(shadows, &ids, NULL))
    for (int k = 0; k < M * N; k++)
      n[lit[k] > 1 ? 2 : lit[k]]++;
  ok(tap, n[0] && n[1] && !n[2], "%d samples are lit and %d are not", n[1],
     n[0]);
  uint64_t inside = 0;
  if (!hsr_get_voxels(solids, &v, NULL))
    for (int k = 0; k < v.n[0] * v.n[1] * v.n[2]; k++)
      inside += v.solid[k] > 0;
  ok(tap, v.n[0] == 16 && v.side > 0 && inside > 0,
     "%llu of %d x %d x %d voxels are in solids", (unsigned long long)inside,
     v.n[0], v.n[1], v.n[2]);
  hsr_free(shadows);
  hsr_free(solids);
}

/* --- Counts and traces ---------------------------------------------------- */

enum { MOST_COUNTERS = 64 };
struct heard {
  uint64_t n, count[MOST_COUNTERS];
  bool wrong;
  uint32_t ids[M * N];
};

static void listen(void *context, const struct hsr_event *event) {
  struct heard *heard = context;
  const int *w = event->window;
  if (event->size < sizeof *event || event->number != heard->n++ ||
      event->counter >= MOST_COUNTERS || !event->a.kind || !event->b.kind) {
    heard->wrong = true;
    return;
  }
  heard->count[event->counter]++;
  for (int j = w[1]; !strcmp(event->step, "accept") && j < w[3]; j++)
    for (int i = w[0]; i < w[2]; i++)
      heard->ids[j * M + i] = event->a.id[0];
}

static bool counts_agree(const struct heard *heard, const uint64_t *count,
                         size_t n) {
  struct hsr_counter_info info = {.size = sizeof info};
  size_t algorithm = 0;
  hsr_find_algorithm("watkins", &algorithm, NULL);
  for (size_t k = 0; k < n; k++)
    if (hsr_get_counter(algorithm, k, &info, NULL) ||
        (!info.is_computed && heard->count[k] != count[k]))
      return false;
  return n > 5;
}

static void test_trace(struct tap *tap, const struct hsr_scene *scene) {
  static struct heard heard;
  struct hsr_request request = request_of("watkins", M, N);
  struct hsr_answer *traced = NULL, *counted = NULL;
  const uint64_t *a = NULL, *b = NULL;
  const uint32_t *ids = NULL;
  size_t n = 0, same = 0;
  memset(heard.ids, 0xff, sizeof heard.ids);
  enum hsr_status status =
      hsr_trace(scene, &request, listen, &heard, &traced, NULL);
  ok(tap, !status && heard.n > 100 && !heard.wrong, "%llu steps are heard",
     (unsigned long long)heard.n);
  ok(tap,
     !hsr_get_ids(traced, &ids, NULL) &&
         !memcmp(ids, heard.ids, sizeof heard.ids),
     "those that accept rebuild the answer");
  ok(tap, !hsr_get_counts(traced, &a, &n, NULL) && counts_agree(&heard, a, n),
     "as many are heard as are counted");
  request.counts = 1;
  if (!hsr_draw(scene, &request, &counted, NULL) &&
      !hsr_get_counts(counted, &b, &same, NULL))
    same = same == n && !memcmp(a, b, n * sizeof *a);
  ok(tap, same == 1, "without a listener the counts are the same");
  hsr_free(traced);
  hsr_free(counted);
}

/* The z-buffer looks at a sample once for each face that covers it. */
static void test_work(struct tap *tap, const struct hsr_scene *scene) {
  struct hsr_request request = request_of("zbuffer", M, N);
  struct hsr_answer *answer = NULL, *lines = NULL, *part = NULL;
  const uint64_t *count = NULL;
  const float *work = NULL, *some = NULL;
  size_t n = 0, wrong = 0;
  double sum = 0;
  request.work = 1;
  request.threads = 2;
  if (!hsr_draw(scene, &request, &answer, NULL) &&
      !hsr_get_work(answer, &work, NULL))
    for (int k = 0; k < M * N; k++)
      sum += (double)work[k];
  ok(tap,
     sum > 0 && !hsr_get_counts(answer, &count, &n, NULL) &&
         sum == (double)count[0],
     "the work of the samples adds up: %.0f", sum);
  request.window[2] = 5;
  request.window[3] = N;
  if (!hsr_draw(scene, &request, &part, NULL) &&
      !hsr_get_work(part, &some, NULL))
    for (int k = 0; k < M * N; k++)
      wrong += some[k] != (k % M < 5 ? work[k] : 0);
  ok(tap, some && !wrong, "in a window it is the same, and elsewhere 0");
  request = request_of("roberts", M, N);
  request.work = 1;
  ok(tap, hsr_draw(scene, &request, &lines, NULL) == HSR_E_USAGE && !lines,
     "lines have no work at samples");
  struct hsr_scene *grid = NULL;
  struct hsr_error err = {0};
  if (!hsr_open("checker-cube", NULL, &grid, NULL))
    hsr_draw(grid, &request, &lines, &err);
  ok(tap, !lines && strstr(err.text, "work is only for"),
     "that is said before the algorithm meets the scene: %s", err.text);
  hsr_close(grid);
  hsr_free(answer);
  hsr_free(part);
}

static void test_no_trace(struct tap *tap, const struct hsr_scene *scene) {
  static const char *const untold[] = {"oracle", "null", "zbuffer:filter=box"};
  struct hsr_answer *answer = NULL;
  struct hsr_error err = {.text = ""};
  struct hsr_request request;
  for (int k = 0; k < 3; k++) {
    request = request_of(untold[k], M, N);
    ok(tap,
       hsr_trace(scene, &request, listen, NULL, &answer, &err) == HSR_E_USAGE &&
           !answer,
       "%s", err.text);
  }
  request = request_of("watkins", M, N);
  ok(tap,
     hsr_trace(NULL, &request, listen, NULL, &answer, NULL) == HSR_E_USAGE &&
         hsr_trace(scene, NULL, listen, NULL, &answer, NULL) == HSR_E_USAGE &&
         hsr_trace(scene, &request, NULL, NULL, &answer, NULL) == HSR_E_USAGE &&
         hsr_trace(scene, &request, listen, NULL, NULL, NULL) == HSR_E_USAGE,
     "NULL is refused");
}

/* --- Files ---------------------------------------------------------------- */

/* Whether there is such a file, which is removed. */
static bool is_written(const char *path) {
  FILE *file = fopen(path, "rb");
  bool full = file && fgetc(file) != EOF;
  if (file)
    fclose(file);
  remove(path);
  return full;
}

/* Whether a text is in a file, which is removed. */
static bool holds(const char *path, const char *text) {
  static char all[1 << 16];
  FILE *file = fopen(path, "r");
  const size_t n = file ? fread(all, 1, sizeof all - 1, file) : 0;
  if (file)
    fclose(file);
  remove(path);
  all[n] = '\0';
  return strstr(all, text);
}

static void test_line_style(struct tap *tap, const struct hsr_scene *scene) {
  struct hsr_answer *answer = draw_by(scene, "zbuffer", M, N),
                    *lines = draw_by(scene, "appel", M, N);
  struct hsr_style style = {.size = sizeof style, .style = "iso"};
  struct hsr_error err = {.text = ""};
  const char *path = "library-style.svg", *json = "library-style.json";
  const char *visible = "stroke-width=\"1.89\"", /* .5 mm */
      *dashed = "stroke-dasharray";
  ok(tap, !hsr_write(lines, path, &style, NULL) && holds(path, visible),
     "lines are drawn in the style iso");
  ok(tap, !hsr_write(lines, path, &style, NULL) && !holds(path, dashed),
     "without hidden ones");
  style.hidden = HSR_LINES_DASHED;
  ok(tap, !hsr_write(lines, path, &style, NULL) && holds(path, dashed),
     "or with hidden ones, by its pen");
  FILE *file = fopen(json, "w");
  fputs("{\"schema\": \"hsr-style/1\", \"rules\": [{\"colour\": "
        "\"#123456\"}]}",
        file);
  fclose(file);
  style.style = json;
  ok(tap,
     !hsr_write(lines, path, &style, NULL) && holds(path, "stroke=\"#123456\""),
     "or in that of a file");
  remove(json);
  ok(tap, hsr_write(lines, path, &style, &err) == HSR_E_INPUT, "%s", err.text);
  style.style = "fine";
  ok(tap, hsr_write(lines, path, &style, &err) == HSR_E_USAGE, "%s", err.text);
  style = (struct hsr_style){.size = sizeof style, .style = "iso"};
  ok(tap, hsr_write(answer, "x.ppm", &style, &err) == HSR_E_USAGE, "%s",
     err.text);
  hsr_free(answer);
  hsr_free(lines);
}

static void test_files(struct tap *tap, const struct hsr_scene *scene) {
  static const float blue[3] = {0, 0, 1}, wrong[3] = {0, 0, 2};
  struct hsr_answer *answer = draw_by(scene, "zbuffer", M, N),
                    *lines = draw_by(scene, "appel", M, N);
  struct hsr_style style = {
      .size = sizeof style, .shading = HSR_COLOUR_IDS, .background = blue};
  struct hsr_style of_lines = {
      .size = sizeof of_lines, .hidden = HSR_LINES_DASHED, .crease = 20};
  struct hsr_error err = {.text = ""};
  size_t before = 0, after = 0;
  const struct hsr_segment *segment;
  ok(tap,
     !hsr_write(answer, "library-draw.ppm", &style, NULL) &&
         is_written("library-draw.ppm"),
     "a picture is written");
  hsr_get_segments(lines, &segment, &before, NULL);
  ok(tap,
     !hsr_write(lines, "library-draw.svg", &of_lines, NULL) &&
         is_written("library-draw.svg"),
     "and a drawing");
  hsr_get_segments(lines, &segment, &after, NULL);
  ok(tap, before == after && before, "which stays as it was");
  ok(tap,
     !hsr_write(answer, "library-draw.npy", NULL, NULL) &&
         is_written("library-draw.npy") &&
         !hsr_write(lines, "library-draw.json", NULL, NULL) &&
         is_written("library-draw.json"),
     "ids as an array, and a drawing as JSON, too");
  ok(tap,
     hsr_write(answer, "library-draw.json", NULL, NULL) == HSR_E_USAGE &&
         hsr_write(lines, "library-draw.npy", NULL, NULL) == HSR_E_USAGE,
     "but not the other way");
  ok(tap, hsr_write(answer, "library-draw.svg", NULL, &err) == HSR_E_USAGE,
     "%s", err.text);
  ok(tap, hsr_write(answer, "no/such/folder.ppm", NULL, &err) == HSR_E_INPUT,
     "%s", err.text);
  ok(tap, hsr_write(lines, "library-draw.svg", &style, &err) == HSR_E_USAGE,
     "%s", err.text);
  ok(tap, hsr_write(answer, "x.ppm", &of_lines, &err) == HSR_E_USAGE, "%s",
     err.text);
  style.background = wrong;
  ok(tap, hsr_write(answer, "x.ppm", &style, &err) == HSR_E_USAGE, "%s",
     err.text);
  of_lines.crease = -1;
  ok(tap, hsr_write(lines, "x.svg", &of_lines, &err) == HSR_E_USAGE, "%s",
     err.text);
  of_lines = (struct hsr_style){.size = sizeof of_lines,
                                .hidden = (enum hsr_hidden_lines)7};
  ok(tap, hsr_write(lines, "x.svg", &of_lines, &err) == HSR_E_USAGE, "%s",
     err.text);
  hsr_free(answer);
  hsr_free(lines);
}

/* An answer outlives the handle of its scene. */
static void test_life(struct tap *tap) {
  struct hsr_scene *scene = open_scene("soup:50:3");
  struct hsr_answer *answer = draw_by(scene, "watkins", M, N);
  struct hsr_verdict verdict = {.size = sizeof verdict};
  float depth[M * N];
  hsr_close(scene);
  ok(tap,
     !hsr_get_depths(answer, depth, M * N, NULL) &&
         !hsr_judge(answer, &verdict, NULL) && !verdict.differing,
     "an answer stays valid when its scene is closed");
  hsr_free(answer);
}

int main(void) {
  struct tap tap = plan(75);
  struct hsr_scene *scene = open_scene("house");
  test_usage(&tap, scene);
  test_refused(&tap, scene);
  test_windows(&tap, scene);
  test_progress(&tap, scene);
  test_ids(&tap, scene);
  test_has_not(&tap, scene);
  test_null(&tap, scene);
  test_segments(&tap, scene);
  test_polygons(&tap, scene);
  test_pixels(&tap, scene);
  test_channels(&tap);
  test_others(&tap, scene);
  test_trace(&tap, scene);
  test_work(&tap, scene);
  test_no_trace(&tap, scene);
  test_files(&tap, scene);
  test_line_style(&tap, scene);
  test_life(&tap);
  hsr_close(scene);
  return finish(&tap);
}
