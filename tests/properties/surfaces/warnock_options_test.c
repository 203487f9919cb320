/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the options of Warnock's algorithm promise, checked in its trace: a raster
 * is put out in order and whole; the lists of regions are those that a first
 * frame would make; and the three surround tests agree, each at its own cost. */
#include "bench/modules/variant.h"
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <stdlib.h>
#include <string.h>

enum { M = 97, N = 61, FRAMES = 8 };

static const char *const scene_names[] = {
    "house",      "harbor",        "soup",       "lattice",    "cyclic-overlap",
    "deep-stack", "penetration",   "behind-eye", "near-plane", "non-convex",
    "terrain",    "nested-solids", "office:1"};
enum { N_SCENES = sizeof scene_names / sizeof scene_names[0] };

/* A scene, laid out. */
struct stage {
  struct hsr_scene *scene;
  struct hsr_world world;
};

static void open_stage(struct stage *s, const char *name) {
  s->scene = must_open(name);
  must_world(&s->world, s->scene);
}

static void close_stage(struct stage *s) {
  hsr_world_free(&s->world);
  hsr_scene_delete(s->scene);
}

static struct hsr_view view_of(const struct stage *s, int k, int m, int n) {
  struct hsr_view view;
  must_view(&view, &s->scene->views[(uint32_t)k % s->scene->n_views], m, n);
  return view;
}

/* --- As a raster ---------------------------------------------------------- */

/* Where the next sample has to be put out. */
struct raster {
  int counter, x, y;
  long n_amiss;
};

static void watch_rows(void *context, const struct hsr_event *event) {
  struct raster *r = context;
  if (event->counter != r->counter)
    return;
  const struct hsr_window *w = &event->window;
  r->n_amiss += w->x0 != r->x || w->y0 != r->y || w->y1 != r->y + 1 ||
                w->x1 <= w->x0 || w->x1 > M;
  r->x = w->x1 == M ? 0 : w->x1;
  r->y += w->x1 == M;
}

static void test_raster(struct tap *tap) {
  static uint32_t ids[M * N], right[M * N];
  const struct hsr_algorithm *algorithm =
      find_counting("warnock:output=raster");
  const struct hsr_algorithm *other = find_counting("zbuffer-fast");
  long n_amiss = 0, n_wrong = 0, n_rows = 0;
  for (int k = 0; k < N_SCENES; k++) {
    struct stage stage;
    open_stage(&stage, scene_names[k]);
    struct raster r = {.counter = counter_of(algorithm, "raster rows")};
    struct hsr_trace trace = {.listen = watch_rows, .context = &r};
    struct hsr_tally tally = {.trace = &trace};
    struct hsr_view view = view_of(&stage, 0, M, N);
    draw_ids(algorithm, &stage.world, &view, ids, &tally);
    draw_ids(other, &stage.world, &view, right, NULL);
    n_wrong += count_differences(&view, ids, right);
    n_amiss += r.n_amiss + (r.x != 0 || r.y != N);
    n_rows += (long)tally.count[r.counter];
    close_stage(&stage);
  }
  ok(tap, n_amiss == 0 && n_rows > N_SCENES * N,
     "windows are put out row by row, from left to right, each sample once: "
     "%ld of %ld parts are not",
     n_amiss, n_rows);
  ok(tap, n_wrong == 0, "%ld samples are wrong", n_wrong);
}

/* --- From frame to frame -------------------------------------------------- */

/* A variant that is prepared once and draws frame after frame. */
struct film {
  const struct hsr_algorithm *algorithm;
  struct hsr_setup setup;
  struct hsr_arena scratch;
  struct hsr_tally tally; /* of the last frame */
  uint32_t ids[M * N];
};

static void begin(struct film *film, const struct hsr_algorithm *algorithm,
                  const struct stage *stage) {
  *film = (struct film){.algorithm = algorithm};
  must_setup(&film->setup, algorithm, NULL, &stage->world);
}

static void end(struct film *film) {
  hsr_setup_free(&film->setup);
  hsr_arena_free(&film->scratch);
}

static void draw_frame(struct film *film, const struct hsr_view *view) {
  struct hsr_error err;
  film->tally = (struct hsr_tally){.out_of_memory = false};
  hsr_arena_reset(&film->scratch);
  struct hsr_answer answer = hsr_answer_of_ids(film->ids, view->m, view->n);
  struct hsr_job job = {.view = view,
                        .tally = &film->tally,
                        .scratch = &film->scratch,
                        .answer = &answer};
  if (hsr_setup_render(&film->setup, &job, &err))
    bail("%s: %s", film->algorithm->name, err.text);
}

static long count(const struct film *film, const char *name) {
  return (long)counted(film->algorithm, &film->tally, name);
}

struct findings {
  long n_frames, n_wrong;
  long
      n_apart; /* frames whose lists have not as many faces as a first frame's */
  long
      n_spoilt; /* frames drawn twice, whose lists changed, or were not in order */
  long n_entered,
      n_first; /* faces that entered; and would have, from nothing */
};

/* A walk. Every other frame is another size, and each is drawn twice. */
static void walk(const struct hsr_algorithm *algorithm, const char *name,
                 struct findings *f) {
  static struct film film, fresh, other;
  struct stage stage;
  open_stage(&stage, name);
  begin(&film, algorithm, &stage);
  begin(&other, find_counting("zbuffer-fast"), &stage);
  long n_listed = 0;
  for (int k = 0; k < FRAMES; k++) {
    struct hsr_view view =
        k % 2 ? view_of(&stage, k / 2, 33, 5) : view_of(&stage, k / 2, M, N);
    draw_frame(&other, &view);
    begin(&fresh, algorithm, &stage);
    draw_frame(&fresh, &view);
    end(&fresh);
    draw_frame(&film, &view);
    f->n_wrong += count_differences(&view, film.ids, other.ids) +
                  count_differences(&view, fresh.ids, other.ids);
    n_listed += count(&film, "entered") - count(&film, "left");
    f->n_apart += n_listed != count(&fresh, "entered");
    f->n_entered += count(&film, "entered");
    f->n_first += count(&fresh, "entered");

    long special = count(&film, "Warnock special");
    draw_frame(&film, &view);
    f->n_spoilt += count(&film, "entered") != 0 || count(&film, "left") != 0 ||
                   count(&film, "region sort") > n_listed ||
                   count(&film, "Warnock special") != special;
    f->n_wrong += count_differences(&view, film.ids, other.ids);
    f->n_frames++;
  }
  end(&film);
  end(&other);
  close_stage(&stage);
}

static void test_regions(struct tap *tap, const char *name) {
  struct findings f = {0};
  for (int k = 0; k < N_SCENES; k++)
    walk(find_counting(name), scene_names[k], &f);
  ok(tap, f.n_wrong == 0, "%s: %ld samples are wrong, of %ld frames", name,
     f.n_wrong, f.n_frames);
  ok(tap, f.n_apart == 0,
     "%s: the lists are those of a first frame; in %ld frames they are not",
     name, f.n_apart);
  ok(tap, f.n_spoilt == 0,
     "%s: a frame drawn again changes no list; %ld change", name, f.n_spoilt);
  ok(tap, f.n_entered < f.n_first,
     "%s: faces that enter a region are %ld, not %ld", name, f.n_entered,
     f.n_first);
}

/* --- The surround tests --------------------------------------------------- */

/* Scenes of which vertices and edges meet samples, or faces are not convex, are
 * among these. */
static const char *const surround_scenes[] = {
    "house",        "lattice:60:5", "coplanar", "keyholes",     "non-convex",
    "shared-edges", "non-planar",   "sliver",   "eye-in-plane", "harbor:100"};
enum { N_SURROUND = sizeof surround_scenes / sizeof *surround_scenes };
enum { SIDES, CROSSINGS, ANGLES, WAYS };
static const char *const ways[WAYS] = {"warnock:surround=sides",
                                       "warnock:surround=crossings",
                                       "warnock:surround=angles"};

static void test_surround(struct tap *tap) {
  static struct film film[WAYS], other;
  long n_wrong = 0, n_tests = 0, n_other = 0, n_edges = 0, n_amiss = 0;
  long n_few = 0, n_fallen = 0;
  for (int s = 0; s < N_SURROUND; s++) {
    struct stage stage;
    open_stage(&stage, surround_scenes[s]);
    begin(&other, find_counting("warnock"), &stage);
    for (int w = 0; w < WAYS; w++)
      begin(&film[w], find_counting(ways[w]), &stage);
    for (int k = 0; k < 4; k++) {
      struct hsr_view view = view_of(&stage, k, M, N);
      draw_frame(&other, &view);
      for (int w = 0; w < WAYS; w++) {
        draw_frame(&film[w], &view);
        n_wrong += count_differences(&view, film[w].ids, other.ids);
        n_other += count(&film[w], "surround tests") !=
                       count(&film[0], "surround tests") ||
                   count(&film[w], "Warnock special") !=
                       count(&other, "Warnock special");
      }
      long edges = count(&film[CROSSINGS], "surround: rows");
      long fallen = count(&film[SIDES], "surround: rows");
      n_tests += count(&film[0], "surround tests");
      n_edges += edges;
      n_amiss += count(&film[ANGLES], "surround: quadrants") != edges ||
                 count(&film[CROSSINGS], "surround: crossings") > edges ||
                 count(&film[SIDES], "surround: sides") + fallen > edges;
      n_few += count(&film[SIDES], "surround: sides");
      n_fallen += fallen;
    }
    for (int w = 0; w < WAYS; w++)
      end(&film[w]);
    end(&other);
    close_stage(&stage);
  }
  ok(tap, n_wrong == 0, "surround=: %ld samples are wrong", n_wrong);
  ok(tap, n_other == 0 && n_tests > 1000,
     "each makes the same %ld surround tests; in %ld frames it does not",
     n_tests, n_other);
  ok(tap, n_amiss == 0, "no edge is looked at twice; in %ld frames it is",
     n_amiss);
  ok(tap, n_few + n_fallen < n_edges && n_few && n_fallen,
     "by sides, %ld of %ld edges, and %ld of faces that may not be convex",
     n_few, n_edges, n_fallen);
}

int main(void) {
  struct tap tap = plan(14);
  test_raster(&tap);
  test_surround(&tap);
  test_regions(&tap, "warnock:regions=64");
  test_regions(&tap, "warnock:regions=256");
  return finish(&tap);
}
