/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Error-bounded rendering against the area oracle, pass by pass; and the areas of
 * visible polygons, as Weiler and Atherton's algorithm finds them, which has one
 * pass.
 *
 * Held        after every pass, every interval of every pixel holds the exact
 *             value.
 * Narrower    no interval becomes wider from one pass to the next.
 * Tolerance   at the end each interval is at most eps wide, and its middle
 *             within eps/2 of the exact value.
 * Shaded      under a shader the judge knows the value within bounds. No
 *             interval is apart from these. It is counted how many hold all of
 *             them.
 * Stopped     a run that may not refine, or not for long, still holds the
 *             value.
 *
 * usage: bounded_test [MxN] [SCENE...]  instead of the usual ones, in all views,
 *                                       in pictures of MxN (standard: 48x33)
 *        bounded_test [MxN] shaders     these alone
 *        bounded_test [MxN] stopped     the same */
#include "bench/modules/variant.h"
#include "tests/draw.h"
#include "tests/tap.h"
#include "common/answers/kinds/area.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { VIEWS = 2 };

/* The pictures: pixels a row, rows, and channels in all; and what the last pass
 * knew of them. */
static int m = 48, n = 33, channels;
static struct hsr_area_bounds *last;

static const char *const scenes[] = {
    "house",          "lattice",      "penetration",   "coplanar",
    "cyclic-overlap", "non-convex",   "non-planar",    "sliver",
    "t-junction",     "shared-edges", "near-plane",    "behind-eye",
    "one-sided",      "soup:60:3",    "sub-pixel-gap", "huge-and-tiny",
    "color-cube:3",   "harbor:400"};
enum { N_SCENES = sizeof scenes / sizeof *scenes };

static const char *const variants[] = {
    "error-bounded:eps=.125",
    "error-bounded",
    "error-bounded:eps=.0078125",
    "error-bounded:refine=levels",
    "error-bounded:exact=2:eps=.125",
    "error-bounded:exact=0:refine=levels:eps=.125",
    "error-bounded:window=20:limit=0",
    "error-bounded:order=strict",
    "error-bounded:order=strict:exact=2:refine=levels:eps=.125",
    "error-bounded:filter=tent",
    "error-bounded:filter=quadratic:refine=levels",
    "error-bounded:filter=cubic:eps=.125",
    "error-bounded:order=strict:filter=tent:window=20",
    "error-bounded:filter=cubic:window=20:eps=.0625",
    "weiler-atherton:eps=1e-9"};
enum { N_VARIANTS = sizeof variants / sizeof *variants };

struct watch {
  const struct hsr_area_bounds *wanted;
  int passes;
  long outside, wider; /* intervals, in all passes */
};

static bool holds(struct hsr_area_bounds got, struct hsr_area_bounds wanted) {
  return got.lo <= wanted.lo && got.hi >= wanted.hi;
}

static void look(void *whom, const struct hsr_answer *answer, int pass) {
  struct watch *watch = whom;
  const struct hsr_area_bounds *got = hsr_answer_areas_of(answer);
  for (int k = 0; k < channels; k++) {
    watch->outside += !holds(got[k], watch->wanted[k]);
    watch->wider +=
        pass > 0 && !(got[k].lo >= last[k].lo && got[k].hi <= last[k].hi);
    last[k] = got[k];
  }
  watch->passes++;
}

static enum hsr_area_filter filter_of(const char *name) {
  struct hsr_variant variant;
  struct hsr_error err;
  if (hsr_variant_parse(name, &variant, &err))
    bail("%s: %s", name, err.text);
  return hsr_form_area(&variant.choice.form).filter;
}

/* Draws the view by a variant, in its windows, and shows its passes if there is
 * one window; `passes` may be NULL. False if it refuses the scene, for its faces
 * that are not convex. */
static bool draw(const char *name, const struct hsr_world *world,
                 const struct hsr_view *view, struct hsr_answer *answer,
                 const struct hsr_passes *passes) {
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_arena scratch = HSR_ARENA_EMPTY;
  struct hsr_tally tally = {.trace = NULL};
  struct hsr_setup setup;
  struct hsr_variant variant;
  if (hsr_variant_parse(name, &variant, &err))
    bail("%s: %s", name, err.text);
  enum hsr_status status = hsr_setup_init(&setup, variant.listed->plain,
                                          &variant.choice, world, &err);
  if (status == HSR_E_REFUSED && !strncmp(err.text, "CF:", 3)) {
    hsr_setup_free(&setup);
    return false;
  }
  if (status ||
      hsr_answer_make(answer, &variant.choice.form, view, false, &err))
    bail("%s: %s", name, err.text);
  int side = variant.choice.window ? (int)variant.choice.window : m;
  for (int y = 0; y < n; y += side)
    for (int x = 0; x < m; x += side) {
      struct hsr_view part = *view;
      part.window = hsr_window_make(x, y, x + side < m ? x + side : m,
                                    y + side < n ? y + side : n);
      struct hsr_job job = {.view = &part,
                            .scratch = &scratch,
                            .tally = &tally,
                            .answer = answer,
                            .passes = side == m ? passes : NULL};
      hsr_arena_reset(&scratch);
      if (hsr_setup_render(&setup, &job, &err))
        bail("%s: %s", name, err.text);
    }
  hsr_setup_free(&setup);
  hsr_arena_free(&scratch);
  return true;
}

/* What is right, by filter. */
struct truth {
  struct hsr_answer answer[HSR_AREA_CUBIC + 1];
};

static void find_truth(struct truth *truth, const struct hsr_world *world,
                       const struct hsr_view *view) {
  static const char *const oracles[] = {
      [HSR_AREA_BOX] = "area-oracle:filter=box",
      [HSR_AREA_TENT] = "area-oracle:filter=tent",
      [HSR_AREA_QUADRATIC] = "area-oracle:filter=quadratic",
      [HSR_AREA_CUBIC] = "area-oracle:filter=cubic"};
  for (int f = 0; f <= HSR_AREA_CUBIC; f++)
    draw(oracles[f], world, view, &truth->answer[f], NULL);
}

static void forget_truth(struct truth *truth) {
  for (int f = 0; f <= HSR_AREA_CUBIC; f++)
    hsr_answer_free(&truth->answer[f]);
}

/* Has the scene faces that are not convex? */
static bool is_divided(const char *scene) {
  static const char *const divided[] = {"lattice", "coplanar", "cyclic-overlap",
                                        "non-convex"};
  for (size_t k = 0; k < sizeof divided / sizeof *divided; k++)
    if (!strcmp(scene, divided[k]))
      return true;
  return false;
}

static void check_variant(struct tap *tap, const char *scene, int number,
                          const char *variant, const struct hsr_world *world,
                          const struct hsr_view *view,
                          const struct truth *truth) {
  static struct watch watch;
  struct hsr_answer got;
  long outside = 0, wide = 0, far = 0;
  watch.wanted = hsr_answer_areas_of(&truth->answer[filter_of(variant)]);
  watch.passes = 0;
  watch.outside = watch.wider = 0;
  if (!draw(variant, world, view, &got, &(struct hsr_passes){look, &watch})) {
    ok(tap, strstr(variant, "order=strict") && is_divided(scene),
       "%s, %s: refused", scene, variant);
    return;
  }
  const struct hsr_area_bounds *b = hsr_answer_areas_of(&got);
  double eps = hsr_form_area(&got.form).eps;
  for (int k = 0; k < channels; k++) {
    struct hsr_area_bounds w = watch.wanted[k];
    double middle = b[k].lo + (b[k].hi - b[k].lo) / 2;
    outside += !holds(b[k], w);
    wide += !(b[k].hi - b[k].lo <= eps);
    /* 2^-52: the rounding of the middle. */
    far +=
        !(fmax(fabs(middle - w.lo), fabs(middle - w.hi)) <= eps / 2 + 0x1p-52);
  }
  ok(tap, !(outside || wide || far || watch.outside || watch.wider),
     "%s, view %d, %s: %d passes; outside %ld + %ld, too wide %ld, too far "
     "%ld, wider than before %ld",
     scene, number + 1, variant, watch.passes, watch.outside, outside, wide,
     far, watch.wider);
  hsr_answer_free(&got);
}

/* Does it take a scene laid out only, no outline? */
static bool needs_faces(const char *variant) {
  return !strncmp(variant, "weiler-atherton", 15);
}

static void check_view(struct tap *tap, const char *scene,
                       const struct both_worlds *worlds,
                       const struct hsr_view *view, int number) {
  struct truth truth;
  find_truth(&truth, &worlds->world, view);
  for (int v = 0; v < N_VARIANTS; v++)
    check_variant(tap, scene, number, variants[v],
                  v % 2 || needs_faces(variants[v]) ? &worlds->world
                                                    : &worlds->roster,
                  view, &truth);
  forget_truth(&truth);
}

/* It cannot reach eps = 0; what it reaches holds the value. Where there is no time
 * to tile anything, nothing is known of most pixels. */
static const struct {
  const char *scene, *variant;
  double least_unknown; /* share of the channels */
} stopped[] = {
    {"house", "error-bounded:eps=0:exact=0:depth=3", 0},
    {"house", "error-bounded:eps=0:depth=0", 0},
    {"house", "error-bounded:eps=0:exact=0:seconds=.05", 0},
    {"house", "error-bounded:eps=0:depth=6", 0},
    {"house", "error-bounded:eps=0:seconds=.000001", .5},
    {"house", "error-bounded:eps=0:seconds=.000001:filter=cubic", .5},
    {"house", "error-bounded:eps=0:seconds=.000001:order=strict", .5},
    {"penetration", "error-bounded:eps=0:seconds=.000001:window=20", 0},
    {"non-planar", "error-bounded:eps=0:seconds=.000001:order=strict", 0},
    {"near-plane", "error-bounded:eps=0:seconds=.000001", 0},
    {"harbor:400", "error-bounded:eps=0:seconds=.0005", 0},
    {"harbor:400", "error-bounded:eps=0:seconds=.001", 0},
    {"harbor:400", "error-bounded:eps=0:seconds=.002", 0},
    {"harbor:400", "error-bounded:eps=0:seconds=.004", 0},
    {"harbor:400", "error-bounded:eps=0:seconds=.002:order=strict", 0},
    {"harbor:400", "error-bounded:eps=0:seconds=.004:order=strict", 0},
    {"harbor:400", "error-bounded:eps=0:seconds=.004:filter=tent", 0},
    {"harbor:400", "error-bounded:eps=0:seconds=.008:filter=tent", 0}};
enum { N_STOPPED = sizeof stopped / sizeof *stopped };

static void check_stopped(struct tap *tap, const char *scene,
                          const char *variant, double least_unknown) {
  static struct watch watch;
  struct both_worlds worlds;
  struct hsr_view view;
  struct hsr_answer wanted, got;
  char judge[60];
  long outside = 0, wide = 0, unknown = 0;
  snprintf(judge, sizeof judge, "area-oracle:filter=%s",
           hsr_area_filters[filter_of(variant)].name);
  open_worlds(&worlds, scene);
  if (hsr_view_init_of(&view, worlds.scene, 0, m, n, NULL))
    exit(99);
  draw(judge, &worlds.world, &view, &wanted, NULL);
  watch = (struct watch){.wanted = hsr_answer_areas_of(&wanted)};
  draw(variant, &worlds.world, &view, &got, &(struct hsr_passes){look, &watch});
  const struct hsr_area_bounds *b = hsr_answer_areas_of(&got);
  for (int k = 0; k < channels; k++) {
    outside += !holds(b[k], watch.wanted[k]);
    wide += b[k].hi > b[k].lo;
    unknown += b[k].lo < 0x1p-40 && b[k].hi > 1 - 0x1p-40;
  }
  ok(tap,
     !outside && !watch.outside && !watch.wider && wide &&
         (double)unknown >= least_unknown * channels,
     "%s, %s: outside %ld + %ld; %ld intervals have a width, and %ld are "
     "unknown",
     scene, variant, watch.outside, outside, wide, unknown);
  hsr_answer_free(&got);
  hsr_answer_free(&wanted);
  close_worlds(&worlds);
}

/* --- Shaders -------------------------------------------------------------- */

static const struct {
  const char *scene, *form;
} shaded[] = {{"sphere", "shader=gouraud:eps=.0625"},
              {"sphere", "shader=phong:eps=.0625"},
              {"sphere", "shader=sky:refine=levels:eps=.0625"},
              {"house", "shader=gouraud:filter=tent:eps=.125"},
              {"penetration", "shader=checker:side=24:eps=.0625"},
              {"penetration", "shader=bumps:side=48:eps=.125"},
              {"penetration", "shader=water:side=48:eps=.125"},
              {"near-plane", "shader=sky:eps=.125"},
              {"non-planar", "shader=phong:filter=quadratic:eps=.125"}};
enum { N_SHADED = sizeof shaded / sizeof *shaded };

struct shaded_watch {
  const struct hsr_area_bounds *wanted;
  long apart, wider, certain;
};

static void look_at_shaded(void *whom, const struct hsr_answer *answer,
                           int pass) {
  struct shaded_watch *watch = whom;
  const struct hsr_area_bounds *got = hsr_answer_areas_of(answer);
  watch->certain = 0;
  for (int k = 0; k < channels; k++) {
    struct hsr_area_bounds w = watch->wanted[k];
    watch->apart += !(got[k].lo <= w.hi && got[k].hi >= w.lo);
    watch->certain +=
        got[k].lo - 0x1p-20 <= w.lo && got[k].hi + 0x1p-20 >= w.hi;
    watch->wider +=
        pass > 0 && !(got[k].lo >= last[k].lo && got[k].hi <= last[k].hi);
    last[k] = got[k];
  }
}

/* The judge's form has no options of error-bounded's own. */
static void judge_form(const char *form, char *name, size_t size) {
  const char *own = strstr(form, "refine=levels:");
  size_t before = own ? (size_t)(own - form) : strlen(form);
  snprintf(name, size, "area-oracle:%.*s%s", (int)before, form,
           own ? own + strlen("refine=levels:") : "");
}

static void check_shaded(struct tap *tap, const char *scene, const char *form) {
  static struct shaded_watch watch;
  const struct hsr_passes passes = {look_at_shaded, &watch};
  struct both_worlds worlds;
  struct hsr_view view;
  struct hsr_answer wanted, got;
  char name[80], judge[80];
  long wide = 0;
  open_worlds(&worlds, scene);
  snprintf(name, sizeof name, "error-bounded:%s", form);
  judge_form(form, judge, sizeof judge);
  if (hsr_view_init_of(&view, worlds.scene, 0, m, n, NULL))
    exit(99);
  draw(judge, &worlds.world, &view, &wanted, NULL);
  watch = (struct shaded_watch){.wanted = hsr_answer_areas_of(&wanted)};
  draw(name, &worlds.world, &view, &got, &passes);
  const struct hsr_area_bounds *b = hsr_answer_areas_of(&got);
  double eps = hsr_form_area(&got.form).eps;
  for (int k = 0; k < channels; k++)
    wide += !(b[k].hi - b[k].lo <= eps);
  ok(tap, !(watch.apart || watch.wider || wide) && watch.certain > 0,
     "%s, %s: apart %ld, too wide %ld, wider than before %ld; %ld of %d hold "
     "all of the judge's bounds",
     scene, form, watch.apart, wide, watch.wider, watch.certain, channels);
  hsr_answer_free(&wanted);
  hsr_answer_free(&got);
  close_worlds(&worlds);
}

/* Views from `first` on, before `end`. */
static void check_scene(struct tap *tap, const char *scene, uint32_t first,
                        uint32_t end) {
  struct both_worlds worlds;
  open_worlds(&worlds, scene);
  for (uint32_t v = first; v < end && v < worlds.scene->n_views; v++) {
    struct hsr_view view;
    if (hsr_view_init_of(&view, worlds.scene, v, m, n, NULL))
      exit(99);
    check_view(tap, scene, &worlds, &view, (int)v);
  }
  close_worlds(&worlds);
}

/* Takes an argument MxN as the size of the pictures; false if it is none. */
static bool take_size(const char *text) {
  int width, height, length = 0;
  if (sscanf(text, "%dx%d%n", &width, &height, &length) < 2 || text[length] ||
      width < 1 || height < 1)
    return false;
  m = width;
  n = height;
  return true;
}

static void make_room(void) {
  channels = 3 * m * n;
  last = malloc((size_t)channels * sizeof *last);
  if (!last)
    bail("out of memory");
}

static void check_usual_scenes(struct tap *tap) {
  for (int k = 0; k < N_SCENES; k++)
    check_scene(tap, scenes[k], 0, VIEWS);
  /* `near` cuts planes that the eye is almost in. */
  check_scene(tap, "huge-and-tiny", 8, 9);
}

static void check_all_stopped(struct tap *tap) {
  for (int k = 0; k < N_STOPPED; k++)
    check_stopped(tap, stopped[k].scene, stopped[k].variant,
                  stopped[k].least_unknown);
}

static void check_all_shaded(struct tap *tap) {
  for (int k = 0; k < N_SHADED; k++)
    check_shaded(tap, shaded[k].scene, shaded[k].form);
}

int main(int argc, char **argv) {
  struct tap tap = {0};
  int first = argc > 1 && take_size(argv[1]) ? 2 : 1;
  const char *only = first == argc - 1 ? argv[first] : "";
  int planned = 0;
  make_room();
  if (first == argc) {
    planned = (N_SCENES * VIEWS + 1) * N_VARIANTS + N_STOPPED + N_SHADED;
    check_usual_scenes(&tap);
    check_all_stopped(&tap);
    check_all_shaded(&tap);
  } else if (!strcmp(only, "shaders")) {
    check_all_shaded(&tap);
  } else if (!strcmp(only, "stopped")) {
    check_all_stopped(&tap);
  } else {
    for (int k = first; k < argc; k++)
      check_scene(&tap, argv[k], 0, UINT32_MAX);
  }
  free(last);
  tap.planned = planned ? planned : tap.run;
  printf("1..%d\n", tap.planned);
  return finish(&tap);
}
