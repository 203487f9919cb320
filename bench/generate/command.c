/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr generate: a scene whose statistics are those asked for. It makes sheets
 * (scenes/sheets/sheets.h), measures them, and mends what they were made from,
 * until each statistic is what it is to be. */
#include "bench/options/command.h"
#include "bench/options/scene.h"
#include "bench/options/streams.h"
#include "bench/options/words.h"
#include "bench/terminal/terminal.h"
#include "common/files/json/scene_json.h"
#include "common/files/suffix.h"
#include "common/scene/world.h"
#include "common/statistics/depth.h"
#include "common/statistics/statistics.h"
#include "scenes/sheets/sheets.h"

#include <math.h>
#include <string.h>

/* What can be asked for. */
enum { FACES, DEPTH, CLUSTER, CONTOUR, CROSSINGS, Y_TO_X, Z_TO_X, N_DIALS };
static const struct {
  const char *symbol;
  double least, most;
  bool whole;
} dials[N_DIALS] = {
    [FACES] = {"F_r", 1, 1e6, true},
    [DEPTH] = {"D_c", 1e-3, 1e3, false},
    [CLUSTER] = {"F_c", 1, 1e6, false},
    [CONTOUR] = {"E_c", 4, 4e6, true},
    [CROSSINGS] = {"X_f", 0, 1e9, true},
    [Y_TO_X] = {"f_y/f_x", 0.01, 100, false},
    [Z_TO_X] = {"f_z/f_x", 0.01, 100, false},
};

/* The first rounds are of the same sheets. If there are few sheets, chance makes
 * more of a difference than a round mends; so the other rounds throw new ones, and
 * mend by half. */
enum { ROUNDS = 20, SAME = 6 };
enum { ANOTHER = 1000003 };        /* added to a seed */
static const double CLOSE = 0.01;  /* no more rounds */
static const double ENOUGH = 0.05; /* what a statistic may be off */

struct options {
  struct option_base base;
  double asked[N_DIALS]; /* NAN: a standard */
  int m, n;
  long seed;
  const char *output;
};

static error_t set_dial(struct options *o, const char *word) {
  for (int k = 0; k < N_DIALS; k++) {
    const size_t size = strlen(dials[k].symbol);
    double value;
    if (strncmp(word, dials[k].symbol, size) || word[size] != '=')
      continue;
    if (!parse_number(word + size + 1, &value) || value < dials[k].least ||
        value > dials[k].most || (dials[k].whole && value != floor(value)))
      return option_fail(&o->base, "%s: must be a%s number from %g to %.7g",
                         word, dials[k].whole ? " whole" : "", dials[k].least,
                         dials[k].most);
    o->asked[k] = value;
    return 0;
  }
  return option_fail(&o->base,
                     "%s: must be F_r=N, D_c=N, F_c=N, E_c=N, X_f=N, "
                     "f_y/f_x=N or f_z/f_x=N",
                     word);
}

enum { SEED = 0x200 };

static error_t parse(int key, char *arg, struct argp_state *state) {
  struct options *o = state->input;
  switch (key) {
  case 's':
    if (!parse_size(arg, &o->m, &o->n))
      return option_fail(&o->base, "--size %s: must be MxN samples", arg);
    return 0;
  case SEED:
    if (!parse_count(arg, 0, 1000000000, &o->seed))
      return option_fail(&o->base, "--seed %s: must be 0 to 1000000000", arg);
    return 0;
  case 'o':
    if (o->output)
      return option_fail(&o->base, "generate: one output file");
    return parse_output(arg, ".scene.json", "generate", &o->base, &o->output);
  case ARGP_KEY_ARG:
    return set_dial(o, arg);
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static const struct argp argp = {
    (const struct argp_option[]){
        {"output", 'o', "FILE", 0, "the scene, a .scene.json file", 0},
        {"size", 's', "MxN", 0,
         "samples a row x rows at which it is measured (standard: 512x512)", 0},
        {"seed", SEED, "N", 0, "another scene with these statistics", 0},
        {0}},
    parse,
    "[SYMBOL=NUMBER...]",
    "Makes a scene with statistics that are chosen, and measures them as `hsr "
    "stats' does. Each is met within 5 %, or nothing is written. The scene is "
    "crumpled sheets of parallelograms, seen in parallel projection.\n"
    "  F_r      relevant faces, which are all (standard: 600)\n"
    "  D_c      depth complexity (2)\n"
    "  F_c      faces a cluster (12)\n"
    "  E_c      contour edges (as Table II has it: 4 F_r / sqrt(F_c / 2))\n"
    "  X_f      pairs of faces that penetrate (0)\n"
    "  f_y/f_x  two faces overlap in Y so many times as often as in X (1)\n"
    "  f_z/f_x  the same of Z (1): with both 1, space is isotropic\v"
    "  hsr generate F_r=2000 D_c=4 -o deep.scene.json\n"
    "  hsr generate F_r=600 f_z/f_x=0.2 X_f=40 -o flat.scene.json",
    NULL,
    NULL,
    NULL};

/* --- One round ------------------------------------------------------------ */

struct round {
  struct hsr_sheets sheets;
  struct hsr_scene *scene;
  double hit[N_DIALS];
};

/* What a statistic is off, as a part of what it is to be. */
static double off(double hit, double asked) {
  return asked > 0 ? fabs(hit / asked - 1) : hit > 0 ? INFINITY : 0;
}

static double worst(const struct options *o, const double hit[N_DIALS]) {
  double most = 0;
  for (int k = 0; k < N_DIALS; k++)
    most = fmax(most, off(hit[k], o->asked[k]));
  return most;
}

static void set_standards(struct options *o) {
  static const double standard[N_DIALS] = {
      [FACES] = 600, [DEPTH] = 2, [CLUSTER] = 12, [Y_TO_X] = 1, [Z_TO_X] = 1};
  double *asked = o->asked;
  for (int k = 0; k < N_DIALS; k++)
    if (isnan(asked[k]) && k != CONTOUR)
      asked[k] = standard[k];
  if (isnan(asked[CONTOUR])) {
    const double rule = 4 * asked[FACES] / sqrt(asked[CLUSTER] / 2);
    asked[CONTOUR] = nearbyint(fmin(rule, 4 * asked[FACES]));
  }
}

static enum hsr_status first_sheets(const struct options *o,
                                    struct hsr_sheets *sheets,
                                    struct hsr_error *err) {
  const double *asked = o->asked;
  *sheets = (struct hsr_sheets){
      .n_faces = (uint32_t)asked[FACES],
      .n_clusters = (uint32_t)fmax(1, nearbyint(asked[FACES] / asked[CLUSTER])),
      .n_contour = (uint64_t)asked[CONTOUR],
      .n_crossings = (uint64_t)asked[CROSSINGS],
      .width = (double)o->m / o->n,
      .seed = (uint64_t)o->seed};
  sheets->side = sqrt(asked[DEPTH] * sheets->width / asked[FACES]);
  sheets->stretch = sheets->width / asked[Y_TO_X];
  sheets->depth = fmax(1 / asked[Z_TO_X], 4 * sheets->side);
  const uint64_t least = hsr_sheets_least(sheets->n_faces, sheets->n_clusters);
  if (asked[CLUSTER] > asked[FACES])
    return hsr_fail(err, HSR_E_USAGE, "F_c=%g: there are only %g faces",
                    asked[CLUSTER], asked[FACES]);
  if (asked[CONTOUR] < (1 - ENOUGH) * (double)least ||
      asked[CONTOUR] > 4 * asked[FACES])
    return hsr_fail(err, HSR_E_USAGE,
                    "E_c=%.0f: so many faces in such clusters have %lu to %.0f "
                    "contour edges",
                    asked[CONTOUR], (unsigned long)least, 4 * asked[FACES]);
  return HSR_OK;
}

static enum hsr_status measure(const struct options *o, struct round *round,
                               struct hsr_error *err) {
  struct hsr_world world;
  struct hsr_view view;
  struct hsr_table1 table;
  struct hsr_overlaps overlaps;
  enum hsr_status status = hsr_world_init(&world, round->scene, err);
  if (!status)
    status = hsr_view_init(&view, round->scene->views, o->m, o->n, err);
  if (!status)
    status = hsr_statistics_measure(&world, &view, NULL, &table, err);
  if (!status)
    status = hsr_overlaps_measure(&world, &view, &overlaps, err);
  if (!status) {
    round->hit[FACES] = table.F_r;
    round->hit[DEPTH] = table.D_c;
    round->hit[CLUSTER] = table.F_c;
    round->hit[CONTOUR] = table.E_c;
    round->hit[CROSSINGS] = table.X_f;
    round->hit[Y_TO_X] = overlaps.f_y / overlaps.f_x;
    round->hit[Z_TO_X] = overlaps.f_z / overlaps.f_x;
  }
  hsr_world_free(&world);
  return status;
}

static enum hsr_status make(const struct options *o, struct round *round,
                            struct hsr_error *err) {
  uint64_t n_crossings;
  round->scene = hsr_scene_new("generated");
  enum hsr_status status = round->scene ? HSR_OK : hsr_fail_nomem(err);
  if (!status)
    status = hsr_sheets_build(round->scene, &round->sheets, &n_crossings, err);
  if (!status)
    status = hsr_scene_finish(round->scene, err);
  return status ? status : measure(o, round, err);
}

/* Mends what a statistic depends on most, in proportion to a power of what it is
 * off. */
static void mend(const struct options *o, double power, struct round *round) {
  struct hsr_sheets *sheets = &round->sheets;
  const double *asked = o->asked, *hit = round->hit;
  sheets->side *= sqrt(asked[DEPTH] / hit[DEPTH]);
  sheets->stretch *= pow(hit[Y_TO_X] / asked[Y_TO_X], power);
  sheets->depth = fmax(sheets->depth * pow(hit[Z_TO_X] / asked[Z_TO_X], power),
                       1.3 * sheets->side);
}

/* --- All rounds ----------------------------------------------------------- */

/* Makes scene after scene, and leaves the best one in *best. */
static enum hsr_status search(const struct options *o, struct round *best,
                              struct hsr_error *err) {
  struct progress progress = progress_begin(stderr);
  struct round round = {.scene = NULL};
  enum hsr_status status = first_sheets(o, &round.sheets, err);
  for (int k = 0; k < ROUNDS && !status; k++) {
    progress_tell(&progress, (size_t)k, ROUNDS, "rounds", "sheets");
    status = make(o, &round, err);
    const bool is_best =
        !status && (!best->scene || worst(o, round.hit) < worst(o, best->hit));
    if (is_best) {
      hsr_scene_delete(best->scene);
      *best = round;
    } else
      hsr_scene_delete(round.scene);
    if (best->scene && worst(o, best->hit) <= CLOSE)
      break;
    if (!status)
      mend(o, k < SAME ? 1 : 0.5, &round);
    round.sheets.seed += k >= SAME ? ANOTHER : 0;
  }
  progress_end(&progress);
  return status;
}

static void print_round(const struct options *o, const struct round *round) {
  printf("%-8s %10s %10s %8s\n", "", "asked", "measured", "off");
  for (int k = 0; k < N_DIALS; k++) {
    const double asked = o->asked[k], hit = round->hit[k];
    printf("%-8s %10.6g %10.6g", dials[k].symbol, asked, hit);
    if (asked > 0)
      printf(" %+7.1f %%\n", 100 * (hit / asked - 1));
    else
      printf(" %8s\n", hit > 0 ? "-" : "0");
  }
}

static enum hsr_status finish(const struct options *o,
                              const struct round *round,
                              struct hsr_error *err) {
  char told[TERMINAL_NAME];
  print_round(o, round);
  if (worst(o, round->hit) > ENOUGH) {
    printf("not within 5 %%, so nothing was written\n");
    return HSR_E_DIFFERENCE;
  }
  enum hsr_status status = hsr_scene_json_write(round->scene, o->output, err);
  if (!status)
    printf("%s: %s in %u clusters\n",
           streams_tell(o->output, told, sizeof told),
           terminal_number(round->sheets.n_faces, "faces",
                           (char[TERMINAL_NUMBER]){0}),
           round->sheets.n_clusters);
  return status;
}

enum hsr_status command_generate(int argc, char **argv, struct hsr_error *err) {
  struct options options = {.m = 512, .n = 512, .seed = 1};
  for (int k = 0; k < N_DIALS; k++)
    options.asked[k] = NAN;
  struct round best = {.scene = NULL};
  enum hsr_status status = parse_options(&argp, argc, argv, &options, err);
  if (status)
    return status;
  if (!options.output)
    return hsr_fail(err, HSR_E_USAGE, "generate: -o FILE is missing");
  if (!hsr_ends_in(options.output, ".scene.json"))
    return hsr_fail(err, HSR_E_USAGE, "%.200s: must end in .scene.json",
                    options.output);
  set_standards(&options);
  status = search(&options, &best, err);
  if (!status)
    status = finish(&options, &best, err);
  hsr_scene_delete(best.scene);
  return status;
}
