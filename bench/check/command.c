/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr check: compares every algorithm's picture with the oracle's, and every
 * algorithm's line drawing with the line oracle's.
 *
 * A group is one scene, view, size and kind of algorithm. Algorithms that keep
 * a state from frame to frame form a group with all views in a row. Each group
 * is judged in its own process (bench/judge/judge.c), several at a time.
 * Several ranks take groups from one queue. */
#include "bench/modules/variant.h"
#include "bench/programs/module.h"
#include "bench/check/check.h"
#include "bench/options/command.h"
#include "bench/options/scene.h"
#include "bench/options/words.h"
#include "bench/ranks/ranks.h"
#include "bench/run/crew.h"

#include <errno.h>
#include <fnmatch.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>

enum { ORDER = 0x200, SAMPLES, MATRIX, DIFFERENCES, SORT_LAST, FRAMES };

/* --- Options -------------------------------------------------------------- */

static error_t add_sizes(struct check_options *o, char *arg) {
  for (char *size = strtok(arg, ","); size; size = strtok(NULL, ",")) {
    if (o->n_sizes == MOST_SIZES)
      return option_fail(&o->base, "check: at most %d sizes", (int)MOST_SIZES);
    if (!parse_size(size, &o->m[o->n_sizes], &o->n[o->n_sizes]))
      return option_fail(&o->base, "--size %s: must be MxN or N, each 1 to %d",
                         size, HSR_MAX_SIZE);
    o->n_sizes++;
  }
  return 0;
}

static error_t add_algorithm(struct check_options *o,
                             const struct hsr_variant *variant) {
  if (o->n_algorithms == MOST_ALGORITHMS)
    return option_fail(&o->base, "check: at most %d algorithms",
                       (int)MOST_ALGORITHMS);
  o->algorithm[o->n_algorithms++] = *variant;
  return 0;
}

/* Whether it takes part without being named. */
static bool is_judged(const struct hsr_algorithm *a) {
  return oracle_of(hsr_own_kind(a)) &&
         !(a->flags & (HSR_JUDGE | HSR_NO_PICTURE));
}

/* One algorithm, with its options, or a program. */
static enum hsr_status add_named(void *options, const char *name,
                                 struct hsr_error *err) {
  struct check_options *o = options;
  struct hsr_variant variant;
  enum hsr_status status = program_variant_parse(name, &variant, err);
  if (status)
    return status;
  if (variant.listed->plain->flags & HSR_NO_PICTURE ||
      !oracle_of(variant.choice.form.type))
    return hsr_fail(err, HSR_E_USAGE, "check: %s draws nothing to compare",
                    name);
  return add_algorithm(o, &variant) ? HSR_E_USAGE : HSR_OK;
}

/* Those whose names match a pattern; or else the one that is named so. */
static error_t add_matching(struct check_options *o, const char *pattern) {
  bool found = false;
  error_t failed = 0;
  for (const struct hsr_listed *a = hsr_algorithms(); a->plain && !failed; a++)
    if (is_judged(a->plain) && !fnmatch(pattern, a->plain->name, 0)) {
      struct hsr_variant variant = hsr_variant_standard(a);
      found = true;
      failed = add_algorithm(o, &variant);
    }
  if (failed || found || !program_each(pattern, add_named, o, o->base.err))
    return failed;
  o->base.failed = true;
  return EINVAL;
}

static error_t add_algorithms(struct check_options *o, char *arg) {
  error_t failed = 0;
  for (char *name = strtok(arg, ","); name && !failed; name = strtok(NULL, ","))
    failed = add_matching(o, name);
  return failed;
}

/* Lists the views to judge, in their order. */
static error_t list_views(struct check_options *o) {
  char *end = NULL;
  for (const char *at = o->order; at; at = *end ? end + 1 : NULL) {
    long view = strtol(at, &end, 10);
    if (end == at || (*end && *end != ',') || view < 1 || view > MOST_VIEWS)
      return option_fail(&o->base,
                         "--order %s: must be reverse, shuffle or K,..., each "
                         "1 to %d",
                         o->order, (int)MOST_VIEWS);
    if (o->n_views == MOST_VIEWS)
      return option_fail(&o->base, "--order: at most %d views",
                         (int)MOST_VIEWS);
    o->view[o->n_views++] = (int)view - 1;
  }
  return o->first_views
             ? option_fail(&o->base,
                           "--order %s: names the views, so not also --views",
                           o->order)
             : 0;
}

static void swap_views(struct check_options *o, int a, int b) {
  int kept = o->view[a];
  o->view[a] = o->view[b];
  o->view[b] = kept;
}

/* The frames to judge, as views. */
static error_t list_frames(struct check_options *o) {
  if (o->order)
    return option_fail(&o->base, "--order does not go with --frames");
  if (o->last_frame - o->first_frame >= MOST_VIEWS)
    return option_fail(&o->base, "--frames: at most %d frames",
                       (int)MOST_VIEWS);
  o->n_views = (int)(o->last_frame - o->first_frame + 1);
  for (int k = 0; k < o->n_views; k++)
    o->view[k] = (int)o->first_frame + k - 1;
  return 0;
}

static error_t order_views(struct check_options *o) {
  if (o->frames)
    return list_frames(o);
  bool reverse = o->order && !strcmp(o->order, "reverse");
  bool shuffle = o->order && !strcmp(o->order, "shuffle");
  if (o->order && !reverse && !shuffle)
    return list_views(o);
  long n_views = o->first_views;
  if (!n_views &&
      count_views(&o->camera, 8, MOST_VIEWS, &n_views, o->base.err)) {
    o->base.failed = true;
    return EINVAL;
  }
  o->n_views = (int)n_views;
  for (int k = 0; k < o->n_views; k++)
    o->view[k] = reverse ? o->n_views - 1 - k : k;
  unsigned short random[3] = {(unsigned short)o->n_views};
  for (int k = o->n_views - 1; shuffle && k > 0; k--)
    swap_views(o, k, (int)(erand48(random) * (k + 1)));
  return 0;
}

static error_t parse(int key, char *arg, struct argp_state *state) {
  struct check_options *o = state->input;
  switch (key) {
  case 'a':
    return add_algorithms(o, arg);
  case 's':
    return add_sizes(o, arg);
  case 'n':
    if (!parse_count(arg, 1, MOST_VIEWS, &o->first_views))
      return option_fail(&o->base, "--views %s: must be 1 to %d", arg,
                         (int)MOST_VIEWS);
    return 0;
  case ORDER:
    o->order = arg;
    return 0;
  case FRAMES:
    o->frames = true;
    if (!parse_range(arg, 0, &o->first_frame, &o->last_frame))
      return option_fail(
          &o->base, "--frames %s: must be A-B, each 0 or more, A <= B", arg);
    return 0;
  case SAMPLES:
    if (!parse_count(arg, 1, MOST_SAMPLES, &o->samples))
      return option_fail(&o->base, "--samples %s: must be 1 to %d", arg,
                         (int)MOST_SAMPLES);
    return 0;
  case 'J':
    if (!parse_count(arg, 1, 256, &o->jobs))
      return option_fail(&o->base, "--jobs %s: must be 1 to 256", arg);
    return 0;
  case 't':
    if (!parse_count(arg, 1, 100000, &o->timeout))
      return option_fail(&o->base, "--timeout %s: must be 1 to 100000", arg);
    return 0;
  case 'j':
    o->json = true;
    return 0;
  case 'f':
    o->failures_only = true;
    return 0;
  case MATRIX:
    o->matrix = true;
    return 0;
  case DIFFERENCES:
    o->differences = arg;
    return 0;
  case SORT_LAST:
    o->sort_last = true;
    if (arg && !parse_count(arg, 1, MOST_PARTS, &o->parts))
      return option_fail(&o->base, "--sort-last=%s: must be 1 to %d", arg,
                         (int)MOST_PARTS);
    return 0;
  case ARGP_KEY_ARG:
    if (o->n_scenes == MOST_SCENES)
      return option_fail(&o->base, "check: at most %d scenes",
                         (int)MOST_SCENES);
    o->scene[o->n_scenes++] = arg;
    return 0;
  case ARGP_KEY_END:
    return order_views(o);
  default: {
    error_t error = parse_import_option(&o->import, key, arg, &o->base);
    return error == ARGP_ERR_UNKNOWN
               ? parse_camera_option(&o->camera, key, arg, &o->base)
               : error;
  }
  }
}

static const struct argp argp = {
    (const struct argp_option[]){
        {"algorithms", 'a', "A,B,...", 0,
         "judge these, patterns allowed; a name with a slash is a program in "
         "any language (standard: all that draw, but for the oracles; those "
         "that "
         "draw transparent faces or shadows once more, as variants with "
         "mix=linear or shadows=cast)",
         0},
        {"size", 's', "MxN,...", 0, "samples (standard: 97x61)", 0},
        {"views", 'n', "N", 0,
         "the first N views of each scene; more are made up if it has fewer "
         "(standard: 8; those of --camera; 1 if --eye or the like is given)",
         0},
        {"order", ORDER, "ORDER", 0,
         "the order in which an algorithm that keeps a state from frame to "
         "frame draws the views: reverse; shuffle, the same in every run; or "
         "K,..., which also chooses the views",
         0},
        {"frames", FRAMES, "A-B", 0,
         "judge these frames, in order: SCENE has %d in the place of the "
         "number, as in traffic:20:%d. Algorithms that take the scene as an "
         "outline, or keep an order or lists of faces, keep what they have "
         "prepared from frame to frame, where its objects move. With --views "
         "N, the frames are seen from the first N "
         "views in turn (standard: 1)",
         0},
        {"samples", SAMPLES, "N", 0,
         "compare N random samples of each picture, or pixels of a filtered "
         "one, the same in every run: "
         "those that Knuth's algorithm S selects by erand48() from the state "
         "{view, columns, rows} (standard: all, but 20000 samples and 312 "
         "pixels of scenes of over 33 million faces)",
         0},
        {"failure-cases", 'f', NULL, 0,
         "if no scene is named: only the failure cases", 0},
        {"jobs", 'J', "N", 0, "processes at a time (standard: one a processor)",
         0},
        {"timeout", 't', "SECONDS", 0,
         "the most that one picture may take (standard: 60); an algorithm that "
         "is known to need more for a view is refused, and so is every line "
         "drawing if the line oracle takes longer",
         0},
        IMPORT_ARGP_OPTIONS,
        {"differences", DIFFERENCES, "DIR", 0,
         "write a picture of what differs, or both line drawings, into this "
         "folder",
         0},
        {"sort-last", SORT_LAST, "PARTS", OPTION_ARG_OPTIONAL,
         "judge what algorithms that draw faces, or filtered pixels of them, "
         "or that add up splats, make of a scene in so many parts, as hsr "
         "render --sort-last does",
         0},
        {"matrix", MATRIX, NULL, 0,
         "print a wide table instead: a column for each algorithm", 0},
        JSON_ARGP_OPTION,
        CAMERA_ARGP_OPTIONS,
        {0}},
    parse,
    "[SCENE...]",
    "Compares every algorithm's picture with the oracle's, sample for sample, "
    "and every line drawing with the line oracle's, edge by edge. "
    "Without SCENE, all built-in scenes but office, traffic, tower and "
    "tower-bare, with their standard parameters.\v"
    "Exit status 0: no sample and no edge differs. 1: one does, or an "
    "algorithm crashed or took too long.\n\n"
    "  hsr check\n"
    "  hsr check house mesh:elephant -a watkins --size 97x61,512x512\n"
    "  hsr check house -a ./mine\n"
    "  hsr check traffic:20:%d --frames 0-9 -a hzbuffer-moving:movers=update",
    NULL,
    NULL,
    NULL};

/* Whether it can be judged in the way that was asked for; without regard to what
 * is summed, which has to be asked for by name. */
static bool is_fit(const struct check_options *o, const struct hsr_variant *v) {
  return !o->sort_last || hsr_choice_composes(v->listed->plain, &v->choice);
}

static enum hsr_status check_fit(const struct check_options *o,
                                 struct hsr_error *err) {
  if (o->sort_last && (o->differences || o->frames))
    return hsr_fail(err, HSR_E_USAGE, "--sort-last does not go with %s",
                    o->frames ? "--frames" : "--differences");
  if (o->frames && !o->n_scenes)
    return hsr_fail(err, HSR_E_USAGE, "--frames needs a SCENE");
  for (int k = 0; k < o->n_algorithms; k++)
    if (!is_fit(o, &o->algorithm[k]) && !is_summed(o, k))
      return hsr_fail(
          err, HSR_E_USAGE, "--sort-last is not for %s, which %s draws",
          o->algorithm[k].choice.form.type->draws, o->algorithm[k].name);
  return HSR_OK;
}

static void add_standard(struct check_options *o, struct hsr_variant variant) {
  if (is_fit(o, &variant))
    o->algorithm[o->n_algorithms++] = variant;
}

static void set_standards(struct check_options *o) {
  if (!o->n_scenes)
    for (const struct hsr_builtin *b = hsr_builtins;
         b->name && o->n_scenes < MOST_SCENES; b++)
      if (b->failure_case || !(o->failures_only || b->only_by_name))
        o->scene[o->n_scenes++] = b->name;
  if (!o->n_sizes) {
    o->m[0] = 97;
    o->n[0] = 61;
    o->n_sizes = 1;
  }
  o->all_algorithms = !o->n_algorithms;
  if (o->all_algorithms)
    for (const struct hsr_listed *a = hsr_algorithms(); a->plain; a++) {
      if (is_judged(a->plain))
        add_standard(o, hsr_variant_standard(a));
      for (int k = 0; is_judged(a->plain) && hsr_makes_besides(a->plain, k);
           k++)
        add_standard(o, hsr_variant_also(a, k));
    }
}

static enum hsr_status make_folder(const char *path, struct hsr_error *err) {
  if (!path || !mkdir(path, 0777) || errno == EEXIST)
    return HSR_OK;
  return hsr_fail(err, HSR_E_INPUT, "%s: %s", path, strerror(errno));
}

enum hsr_status command_check(int argc, char **argv, struct hsr_error *err) {
  struct check_options *o = calloc(1, sizeof *o);
  if (!o)
    return hsr_fail_nomem(err);
  o->jobs = processors();
  o->timeout = 60;
  struct totals totals = {.mismatches = 0};
  enum hsr_status status = parse_options(&argp, argc, argv, o, err);
  program_set_limit((double)o->timeout);
  o->turns = shared_memory(sizeof *o->turns);
  if (!status && (!o->turns || sem_init(o->turns, 1, (unsigned)o->jobs)))
    status = hsr_fail_nomem(err);
  if (!status) {
    status = check_fit(o, err);
    set_standards(o);
  }
  if (!status) {
    status = make_folder(o->differences, err);
  }
  if (!status)
    report_begin(o, &totals);
  if (!status)
    status = check_scenes(o, &totals, err);
  if (!status)
    status = report_end(o, &totals, err);
  else
    report_abandon(&totals);
  if (!status && (totals.mismatches || totals.failures) && !ranks_own())
    status = HSR_E_DIFFERENCE;
  if (o->turns)
    munmap(o->turns, sizeof *o->turns);
  free(o);
  return status;
}
