/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Random calls of every function of hsr.h, with arguments in and out of their
 * ranges. Each must return a status that hsr.h names; after a failure, a new
 * handle is NULL and the error has one line.
 *
 *   fuzz_test [CALLS [SEED]]     standard: 20000 1 */
#include "tests/library/public.h"

#include <math.h>
#include <unistd.h>

enum { MOST = 16 }; /* samples in a row and rows, of most pictures */

struct fuzz {
  uint64_t state;
  struct hsr_scene *scene;
  struct hsr_drawer *drawer;
  struct hsr_answer *answer, *redrawn; /* by hsr_redraw */
  struct hsr_error err;
  long calls, failed, wrong;
};

/* --- Chance --------------------------------------------------------------- */

/* S. Vigna, splitmix64. */
static uint64_t next(struct fuzz *f) {
  uint64_t z = f->state += 0x9e3779b97f4a7c15;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
  z = (z ^ z >> 27) * 0x94d049bb133111eb;
  return z ^ z >> 31;
}

static unsigned below(struct fuzz *f, unsigned n) {
  return (unsigned)(next(f) % n);
}

static bool one_in(struct fuzz *f, unsigned n) {
  return below(f, n) == 0;
}

/* Mostly 0 to n - 1; else beyond, or far beyond. */
static size_t number(struct fuzz *f, unsigned n) {
  static const size_t odd[] = {SIZE_MAX, 1u << 31, UINT32_MAX, 1000};
  return one_in(f, 12) ? odd[below(f, 4)] : below(f, n + 2);
}

static int whole(struct fuzz *f, int most) {
  static const int odd[] = {0, -1, INT32_MIN, INT32_MAX, 16385};
  return one_in(f, 15) ? odd[below(f, 5)] : 1 + (int)below(f, (unsigned)most);
}

static double real(struct fuzz *f) {
  static const double odd[] = {0,      NAN,    INFINITY, -INFINITY, 1e300,
                               5e-324, -1e-30, 1e31,     0x1p53,    -0.};
  return one_in(f, 8) ? odd[below(f, 10)]
                      : (double)(int64_t)next(f) / 0x1p63 * 10;
}

/* A size that a struct may be said to have. There is so much room for each. */
enum { ROOM = 512 };

static size_t size_of(struct fuzz *f, size_t right) {
  return one_in(f, 25) ? below(f, ROOM + 1) : right;
}

#define ROOMY(type, name)                                                      \
  union {                                                                      \
    struct type its;                                                           \
    char room[ROOM];                                                           \
  } name = {{.size = size_of(f, sizeof(struct type))}}

/* Sets all members but the size. */
#define FILL(name, ...)                                                        \
  do {                                                                         \
    size_t its_size = (name).its.size;                                         \
    (name).its = (__VA_ARGS__);                                                \
    (name).its.size = its_size;                                                \
  } while (0)

static const char *word(struct fuzz *f) {
  static const char *const words[] = {
      "watkins",
      "newell",
      "zbuffer-fast:filter=box:jitter=1",
      "appel",
      "tiling",
      "oracle",
      "line-oracle",
      "bouknight:mix=linear",
      "watkins:x-list=tree",
      "weiler-atherton",
      "bsp-front:shadows=cast",
      "error-bounded",
      "raycast:window=8",
      "btf",
      "splat",
      "tiling-solids",
      "null",
      "wat",
      "",
      ":",
      "watkins:",
      "watkins:x-list",
      "watkins:x-list=",
      "zbuffer-fast:jitter=99999999999999999999",
      "watkins:%s%n",
      "\xff\xfe",
      "watkins:filter=box:filter=box",
      "newell:special=groups"};
  return one_in(f, 40) ? NULL : words[below(f, sizeof words / sizeof *words)];
}

static const char *scene_name(struct fuzz *f) {
  static const char *const names[] = {
      "t-junction", "soup:20:3", "lattice:6:1", "grid:2",         "penetration",
      "cube",       "soup:-1:3", "soup:1e9",    "soup:::",        "none.off",
      "",           "/",         "@",           "house@fov=0",    "grid:2@",
      "coplanar",   "house",     "/dev/null",   "checker-cube:2", "soup:3:x"};
  return one_in(f, 40) ? NULL : names[below(f, sizeof names / sizeof *names)];
}

/* --- Checks --------------------------------------------------------------- */

static struct hsr_error *error_of(struct fuzz *f) {
  f->err.text[0] = '\0';
  return one_in(f, 5) ? NULL : &f->err;
}

static bool is_known(enum hsr_status status) {
  return status == HSR_OK || (status >= HSR_E_USAGE && status <= HSR_E_STOPPED);
}

static void check(struct fuzz *f, const char *function, enum hsr_status status,
                  const struct hsr_error *err) {
  f->calls++;
  f->failed += status != HSR_OK;
  bool good = is_known(status) && status != HSR_E_INTERNAL;
  if (err && status)
    good = good && err->status == status && *err->text &&
           !strpbrk(err->text, "\n\r\x1b");
  if (!good && f->wrong++ < 10)
    printf("# call %ld, %s: status %d: %s\n", f->calls, function, (int)status,
           err ? err->text : "");
}

static void check_handle(struct fuzz *f, const char *function,
                         enum hsr_status status, const void *handle) {
  if (!status != (handle != NULL) && f->wrong++ < 10)
    printf("# call %ld, %s: status %d, but the handle is %p\n", f->calls,
           function, (int)status, handle);
}

/* --- Calls ---------------------------------------------------------------- */

#define CALL(function, ...)                                                    \
  do {                                                                         \
    struct hsr_error *err = error_of(f);                                       \
    check(f, #function, function(__VA_ARGS__, err), err);                      \
  } while (0)

static void list(struct fuzz *f) {
  ROOMY(hsr_builtin_info, builtin);
  ROOMY(hsr_kind_info, kind);
  ROOMY(hsr_algorithm_info, algorithm);
  ROOMY(hsr_option_info, option);
  ROOMY(hsr_word_info, word_info);
  ROOMY(hsr_counter_info, counter);
  bool no = one_in(f, 30);
  size_t k;
  CALL(hsr_get_builtin, number(f, 90), no ? NULL : &builtin.its);
  CALL(hsr_get_kind, number(f, 12), no ? NULL : &kind.its);
  CALL(hsr_get_algorithm, number(f, 70), no ? NULL : &algorithm.its);
  CALL(hsr_find_algorithm, word(f), no ? NULL : &k);
  CALL(hsr_get_option, number(f, 70), number(f, 8), no ? NULL : &option.its);
  CALL(hsr_get_word, number(f, 70), number(f, 8), number(f, 6),
       no ? NULL : &word_info.its);
  CALL(hsr_get_counter, number(f, 70), number(f, 20), no ? NULL : &counter.its);
}

static void take_scene(struct fuzz *f, const char *function,
                       enum hsr_status status, struct hsr_scene *scene) {
  check_handle(f, function, status, scene);
  if (scene) {
    hsr_close(f->scene);
    f->scene = scene;
  }
}

static void open_name(struct fuzz *f) {
  ROOMY(hsr_open_options, options);
  FILL(options, (struct hsr_open_options){.threads = whole(f, 3),
                                          .strict = (int)below(f, 2),
                                          .two_sided = (int)below(f, 2),
                                          .weld = real(f)});
  struct hsr_scene *scene = NULL;
  struct hsr_error *err = error_of(f);
  enum hsr_status status =
      hsr_open(scene_name(f), one_in(f, 2) ? &options.its : NULL, &scene, err);
  check(f, "hsr_open", status, err);
  take_scene(f, "hsr_open", status, scene);
}

static void open_arrays(struct fuzz *f) {
  double xyz[3 * 8];
  uint32_t ring[4], vertex[16];
  float rgb[12], opacity[4];
  double places[2 * 12];
  for (int k = 0; k < 24; k++)
    places[k] = one_in(f, 200) ? real(f) : (double)below(f, 9) - 4;
  for (int k = 0; k < 24; k++)
    xyz[k] = one_in(f, 50) ? real(f) : (double)below(f, 100) / 16;
  for (int k = 0; k < 16; k++)
    vertex[k] = one_in(f, 60) ? (uint32_t)number(f, 8) : below(f, 8);
  for (int k = 0; k < 12; k++)
    rgb[k] = one_in(f, 50) ? (float)real(f) : (float)below(f, 5) / 4;
  for (int k = 0; k < 4; k++)
    opacity[k] = one_in(f, 50) ? (float)real(f) : (float)below(f, 5) / 4;
  size_t corners = 0, faces = 1 + below(f, 4);
  for (size_t k = 0; k < faces; k++)
    corners += ring[k] = one_in(f, 40) ? below(f, 3) : 3 + below(f, 2);
  ROOMY(hsr_arrays, arrays);
  FILL(arrays, (struct hsr_arrays){
                   .name = one_in(f, 2) ? NULL : "made",
                   .xyz = one_in(f, 40) ? NULL : xyz,
                   .n_vertices = one_in(f, 40) ? SIZE_MAX : 8,
                   .ring = one_in(f, 6) ? NULL : ring,
                   .n_faces = one_in(f, 40) ? UINT32_MAX : faces,
                   .vertex = one_in(f, 40) ? NULL : vertex,
                   .n_corners = corners,
                   .rgb = one_in(f, 2) ? NULL : rgb,
                   .opacity = one_in(f, 2) ? NULL : opacity,
                   .instance = one_in(f, 40) ? NULL : places,
                   .n_instances = one_in(f, 40) ? SIZE_MAX : below(f, 3)});
  /* What the caller says of lengths must be true, or be refused before it is
   * used. */
  if (!arrays.its.ring && 3 * arrays.its.n_faces > 16)
    arrays.its.ring = ring;
  struct hsr_scene *scene = NULL;
  struct hsr_error *err = error_of(f);
  enum hsr_status status = hsr_open_arrays(&arrays.its, NULL, &scene, err);
  check(f, "hsr_open_arrays", status, err);
  take_scene(f, "hsr_open_arrays", status, scene);
}

static void open_grid(struct fuzz *f) {
  double at[3];
  float density[27], rgb[81];
  for (int k = 0; k < 3; k++)
    at[k] = one_in(f, 30) ? real(f) : k + (double)below(f, 8) / 8;
  for (int k = 0; k < 27; k++)
    density[k] = one_in(f, 50) ? (float)real(f) : (float)below(f, 3);
  for (int k = 0; k < 81; k++)
    rgb[k] = one_in(f, 1000) ? (float)real(f) : (float)below(f, 5) / 4;
  ROOMY(hsr_grid_arrays, grid);
  FILL(grid, (struct hsr_grid_arrays){.name = one_in(f, 2) ? NULL : "made",
                                      .density = one_in(f, 40) ? NULL : density,
                                      .least = one_in(f, 20) ? real(f) : 1,
                                      .most = one_in(f, 20) ? real(f) : 2,
                                      .rgb = one_in(f, 2) ? NULL : rgb});
  for (int axis = 0; axis < 3; axis++) {
    grid.its.n[axis] = one_in(f, 60) ? UINT32_MAX : below(f, 4);
    grid.its.at[axis] = one_in(f, 2) ? NULL : at;
  }
  struct hsr_scene *scene = NULL;
  struct hsr_error *err = error_of(f);
  enum hsr_status status = hsr_open_grid(&grid.its, NULL, &scene, err);
  check(f, "hsr_open_grid", status, err);
  take_scene(f, "hsr_open_grid", status, scene);
}

static void ask_scene(struct fuzz *f) {
  ROOMY(hsr_scene_info, info);
  ROOMY(hsr_geometry, geometry);
  ROOMY(hsr_camera, camera);
  struct hsr_scene *scene = one_in(f, 30) ? NULL : f->scene;
  CALL(hsr_get_scene, scene, one_in(f, 30) ? NULL : &info.its);
  CALL(hsr_get_geometry, scene, one_in(f, 30) ? NULL : &geometry.its);
  CALL(hsr_get_camera, scene, (uint32_t)number(f, 9),
       one_in(f, 30) ? NULL : &camera.its);
}

/* A callback that stops the work now and then. */
static int tell(void *context, double share) {
  struct fuzz *f = context;
  return share >= 0 && share <= 1 && !one_in(f, 20);
}

static void ignore(void *context, const struct hsr_event *event) {
  *(uint64_t *)context += event->number;
}

static struct hsr_camera random_camera(struct fuzz *f) {
  struct hsr_camera c = {.size = sizeof c};
  for (int k = 0; k < 3; k++) {
    c.eye[k] = real(f);
    c.at[k] = real(f);
    c.up[k] = real(f);
  }
  c.fov = one_in(f, 4) ? real(f) : 40;
  c.near = one_in(f, 4) ? real(f) : .1;
  c.parallel = one_in(f, 4) ? real(f) : 0;
  for (int k = 0; k < 4; k++)
    c.light[k] = one_in(f, 4) ? real(f) : 0;
  return c;
}

static struct hsr_request random_request(struct fuzz *f,
                                         const struct hsr_camera *camera) {
  struct hsr_request r = {.size =
                              one_in(f, 25) ? below(f, sizeof r + 1) : sizeof r,
                          .algorithm = word(f),
                          .camera = one_in(f, 3) ? camera : NULL,
                          .view = (uint32_t)(one_in(f, 6) ? number(f, 8) : 0),
                          .m = whole(f, MOST),
                          .n = whole(f, MOST),
                          .threads = one_in(f, 6) ? whole(f, 3) : 0,
                          .counts = (int)below(f, 2),
                          .work = one_in(f, 4),
                          .progress = one_in(f, 3) ? tell : NULL,
                          .context = f,
                          .offset = {one_in(f, 8) ? real(f) / 16 : 0,
                                     one_in(f, 8) ? real(f) / 16 : 0}};
  if (r.m > MOST && r.n > 0 && r.n <= MOST)
    r.m = one_in(f, 2) ? 16385 : 16384; /* a wide one, of few rows */
  else if (r.m > MOST || r.n > MOST)
    r.m = r.n = 16385;
  if (r.m > MOST && r.algorithm && !strcmp(r.algorithm, "error-bounded"))
    r.m = MOST; /* exact areas of so many pixels take minutes and gigabytes */
  for (int k = 0; k < 4 && one_in(f, 3); k++)
    r.window[k] = whole(f, MOST);
  return r;
}

static void draw(struct fuzz *f) {
  struct hsr_camera camera = random_camera(f);
  struct hsr_request request = random_request(f, &camera);
  struct hsr_answer *answer = NULL;
  struct hsr_scene *scene = one_in(f, 40) ? NULL : f->scene;
  struct hsr_error *err = error_of(f);
  uint64_t sum = 0;
  bool traced = one_in(f, 4) && request.m <= MOST;
  enum hsr_status status =
      traced ? hsr_trace(scene, one_in(f, 40) ? NULL : &request, ignore, &sum,
                         &answer, err)
             : hsr_draw(scene, one_in(f, 40) ? NULL : &request, &answer, err);
  check(f, traced ? "hsr_trace" : "hsr_draw", status, err);
  check_handle(f, "hsr_draw", status, answer);
  if (answer) {
    hsr_free(f->answer);
    f->answer = answer;
  }
}

static void prepare(struct fuzz *f) {
  struct hsr_request request = random_request(f, NULL);
  struct hsr_drawer *drawer = NULL;
  struct hsr_error *err = error_of(f);
  enum hsr_status status =
      hsr_prepare(one_in(f, 40) ? NULL : f->scene,
                  one_in(f, 40) ? NULL : &request, &drawer, err);
  check(f, "hsr_prepare", status, err);
  check_handle(f, "hsr_prepare", status, drawer);
  if (drawer) {
    hsr_release(f->drawer);
    f->drawer = drawer;
  }
}

/* Over the last picture, over one of anybody, or anew. */
static void redraw(struct fuzz *f) {
  struct hsr_camera camera = random_camera(f);
  struct hsr_request request = random_request(f, &camera);
  struct hsr_answer *fresh = NULL, **answer = one_in(f, 3)    ? &fresh
                                              : one_in(f, 20) ? &f->answer
                                                              : &f->redrawn;
  struct hsr_answer_info info = {.size = sizeof info};
  if (one_in(f, 2) && !hsr_get_answer(f->redrawn, &info, NULL)) {
    request.m = info.m;
    request.n = info.n;
  }
  struct hsr_error *err = error_of(f);
  enum hsr_status status =
      hsr_redraw(one_in(f, 40) ? NULL : f->drawer,
                 one_in(f, 40) ? NULL : &request, answer, err);
  check(f, "hsr_redraw", status, err);
  if (fresh || !status)
    check_handle(f, "hsr_redraw", status, *answer);
  if (fresh) {
    hsr_free(f->redrawn);
    f->redrawn = fresh;
  }
}

static size_t places(const struct hsr_answer *answer) {
  struct hsr_answer_info info = {.size = sizeof info};
  return hsr_get_answer(answer, &info, NULL) ? 1
                                             : (size_t)info.m * (size_t)info.n;
}

static void read_answer(struct fuzz *f) {
  static float values[3 * 16384 * MOST];
  ROOMY(hsr_answer_info, info);
  ROOMY(hsr_polygon_arrays, polygons);
  ROOMY(hsr_voxel_array, voxels);
  const struct hsr_answer *a = one_in(f, 40)  ? NULL
                               : one_in(f, 4) ? f->redrawn
                                              : f->answer;
  const struct hsr_segment *segment;
  const uint32_t *ids;
  const unsigned char *lit;
  char line[200];
  const double *bounds;
  const uint16_t *rgba;
  const uint64_t *count;
  const float *work;
  size_t n = places(a) + (one_in(f, 20) ? 1 : 0);
  int channels;
  bool no = one_in(f, 40);
  CALL(hsr_get_answer, a, no ? NULL : &info.its);
  CALL(hsr_get_ids, a, no ? NULL : &ids);
  CALL(hsr_get_lit, a, no ? NULL : &lit);
  CALL(hsr_get_summary, a, no ? NULL : line, below(f, sizeof line + 1));
  CALL(hsr_get_depths, a, no ? NULL : values, n);
  CALL(hsr_get_colours, a, (enum hsr_shading_choice)below(f, 6),
       no ? NULL : values, 3 * n);
  CALL(hsr_get_segments, a, no ? NULL : &segment, &n);
  CALL(hsr_get_polygons, a, no ? NULL : &polygons.its);
  CALL(hsr_get_areas, a, no ? NULL : &bounds);
  CALL(hsr_get_sums, a, no ? NULL : &ids);
  CALL(hsr_get_rgba, a, no ? NULL : &rgba, &channels);
  CALL(hsr_get_voxels, a, no ? NULL : &voxels.its);
  CALL(hsr_get_counts, a, no ? NULL : &count, &n);
  CALL(hsr_get_work, a, no ? NULL : &work);
}

static void judge(struct fuzz *f) {
  static uint32_t ids[16384 * MOST];
  uint32_t place[8];
  struct hsr_camera camera = random_camera(f);
  struct hsr_request request = random_request(f, &camera);
  ROOMY(hsr_verdict, verdict);
  FILL(verdict, (struct hsr_verdict){.place = one_in(f, 2) ? place : NULL,
                                     .room = below(f, 9)});
  for (size_t k = 0; k < MOST * MOST; k++)
    ids[k] = one_in(f, 9) ? (uint32_t)number(f, 30) : HSR_NO_FACE;
  if (!verdict.its.place)
    verdict.its.room = 0;
  CALL(hsr_judge, one_in(f, 4) ? f->redrawn : f->answer,
       one_in(f, 40) ? NULL : &verdict.its);
  CALL(hsr_judge_ids, one_in(f, 40) ? NULL : f->scene, &request,
       one_in(f, 40) ? NULL : ids, &verdict.its);
}

static void write_file(struct fuzz *f) {
  static const char *const names[] = {"a.png", "a.exr",       "a.svg",  "a.pdf",
                                      "a.vtp", "a.vti",       "a.json", "a",
                                      "",      "/none/a.png", "a.xyz"};
  static const char *const styles[] = {NULL, "iso", "plotter", "", "no.json"};
  ROOMY(hsr_style, style);
  FILL(style,
       (struct hsr_style){.shading = (enum hsr_shading_choice)below(f, 5),
                          .hidden = (enum hsr_hidden_lines)below(f, 5),
                          .crease = one_in(f, 3) ? real(f) : 0,
                          .style = styles[below(f, 5)]});
  const char *name = names[below(f, sizeof names / sizeof *names)];
  CALL(hsr_write, one_in(f, 40) ? NULL : f->answer, name,
       one_in(f, 2) ? &style.its : NULL);
  unlink(name);
}

/* --- All ------------------------------------------------------------------ */

static void call_one(struct fuzz *f) {
  unsigned what = below(f, 1000);
  if (what < 250)
    list(f);
  else if (what < 270)
    open_name(f);
  else if (what < 310)
    open_arrays(f);
  else if (what < 350)
    open_grid(f);
  else if (what < 450)
    ask_scene(f);
  else if (what < 470)
    prepare(f);
  else if (what < 520)
    redraw(f);
  else if (what < 600)
    draw(f);
  else if (what < 960)
    read_answer(f);
  else if (what < 995)
    judge(f);
  else
    write_file(f);
}

int main(int argc, char **argv) {
  static struct fuzz f;
  char folder[] = "/tmp/hsr-fuzz-XXXXXX";
  long calls = argc > 1 ? atol(argv[1]) : 20000;
  struct tap tap = plan(1);
  f.state = argc > 2 ? strtoull(argv[2], NULL, 10) : 1;
  if (!mkdtemp(folder) || chdir(folder))
    bail("no folder");
  f.scene = open_scene("t-junction");
  f.answer = draw_by(f.scene, "watkins", 12, 9);
  while (f.calls < calls)
    call_one(&f);
  hsr_free(f.redrawn);
  hsr_release(f.drawer);
  hsr_free(f.answer);
  hsr_close(f.scene);
  ok(&tap, !f.wrong && f.failed < f.calls, "%ld calls, %ld refused, %ld wrong",
     f.calls, f.failed, f.wrong);
  if (chdir("/") || rmdir(folder))
    printf("# files are left in %s\n", folder);
  return finish(&tap);
}
