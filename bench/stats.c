/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr stats: Table I of Sutherland et al. 1974, measured, depths, and the
 * densities of a volume. */
#include "bench/densities.h"
#include "bench/options/command.h"
#include "bench/options/place.h"
#include "bench/results/json.h"
#include "bench/run/table1.h"
#include "bench/terminal/terminal.h"
#include "common/files/image.h"
#include "common/files/json/json.h"
#include "common/statistics/depth.h"
#include "common/statistics/statistics.h"

#include <math.h>
#include <stdlib.h>

struct options {
  struct option_base base;
  struct view_options view;
  struct scene_options scene;
  bool json;
  const char *depth; /* where the picture of the depths goes, or NULL */
};

static error_t parse(int key, char *arg, struct argp_state *state) {
  struct options *o = state->input;
  switch (key) {
  case 'j':
    o->json = true;
    return 0;
  case 'd':
    o->depth = arg;
    return 0;
  default:
    return parse_place_option(&o->scene, &o->view, key, arg, "stats", &o->base);
  }
}

static const struct argp argp = {
    (const struct argp_option[]){
        JSON_ARGP_OPTION,
        {"depth", 'd', "FILE", 0,
         "also write a picture of the depth complexity: the faces over each "
         "sample, through a logarithmic ramp",
         0},
        SCENE_ARGP_OPTIONS,
        VIEW_ARGP_OPTIONS,
        {0}},
    parse,
    "SCENE",
    "Measures Table I of Sutherland, Sproull and Schumacker for a scene and a "
    "view, and prints Table II's rules of thumb beside it, computed from the "
    "measured n, m, F_r, F_c and D_c. Then it says over how many samples how "
    "many faces lie, and with which probability two faces overlap in X, in Y "
    "and in Z. Of a volume it first prints the densities of all samples: their "
    "range, percentiles, the standard threshold and a histogram.\v"
    "  hsr stats harbor --size 500x500\n"
    "  hsr stats head.nii.gz",
    NULL,
    NULL,
    NULL};

/* X(field, symbol, meaning) */
static const struct {
  const char *symbol, *meaning;
  size_t offset;
} rows[] = {
#define X(field, symbol, meaning)                                              \
  {symbol, meaning, offsetof(struct hsr_table1, field)},
    HSR_TABLE1(X)
#undef X
};
enum { N_ROWS = sizeof rows / sizeof rows[0] };

static double cell(const struct hsr_table1 *table, int row) {
  return *(const double *)((const char *)table + rows[row].offset);
}

/* Faces over samples: how many samples have how many. */
struct depths {
  uint32_t most;
  size_t *samples;          /* [0, most] */
  double share_of_a_sample; /* of the picture */
  struct hsr_overlaps overlaps;
  double rule; /* 2 H_f / n */
};

static enum hsr_status
print_json(const struct options *o, const struct hsr_table1 *measured,
           const struct hsr_table1 *rules, const struct depths *depths,
           const struct hsr_densities *densities, struct hsr_error *err) {
  json_t *samples = json_array();
  for (uint32_t k = 0; k <= depths->most; k++)
    hsr_json_append(&samples, json_integer((json_int_t)depths->samples[k]));
  json_t *table = json_array();
  for (int k = 0; k < N_ROWS; k++)
    hsr_json_append(&table, json_pack("{ss ss so so}", "symbol", rows[k].symbol,
                                      "meaning", rows[k].meaning, "measured",
                                      number_or_null(cell(measured, k)), "rule",
                                      number_or_null(cell(rules, k))));
  json_t *all = json_pack("{ss ss si si si so so s{so so so so}}", "schema",
                          "hsr-stats/1", "scene", o->scene.name, "view",
                          (int)o->view.view, "width", o->view.m, "height",
                          o->view.n, "table", table, "depths", samples,
                          "overlaps", "x", number_or_null(depths->overlaps.f_x),
                          "y", number_or_null(depths->overlaps.f_y), "z",
                          number_or_null(depths->overlaps.f_z), "rule",
                          number_or_null(depths->rule));
  if (all && densities &&
      json_object_set_new(all, "densities", densities_json(densities))) {
    json_decref(all);
    all = NULL;
  }
  return json_print(all, err);
}

static void print_number(double x) {
  if (isnan(x))
    printf(" %12s", "-");
  else if (fabs(x - nearbyint(x)) < 1e-9 && fabs(x) < 1e9)
    printf(" %12.0f", x);
  else
    printf(" %12.4g", x);
}

static void print_text(const struct options *o,
                       const struct hsr_table1 *measured,
                       const struct hsr_table1 *rules) {
  char name[TERMINAL_NAME];
  printf("%s, view %ld, %d x %d\n\n",
         terminal_plain(o->scene.name, name, sizeof name), o->view.view,
         o->view.m, o->view.n);
  printf("%-4s %12s %12s %8s  %s\n", "", "measured", "rule", "ratio",
         "Table I of the 1974 survey");
  for (int k = 0; k < N_ROWS; k++) {
    double a = cell(measured, k), b = cell(rules, k);
    printf("%-4s", rows[k].symbol);
    print_number(a);
    print_number(b);
    if (a > 0 && b > 0)
      printf(" %8.3g", a / b);
    else
      printf(" %8s", "-");
    fputs("  ", stdout);
    terminal_wrap(stdout, 41, 41, rows[k].meaning);
  }
}

enum { DEPTH_ROWS = 12, BAR = 40 };

static void print_depth(const char *faces, size_t samples,
                        const struct depths *d) {
  double share = (double)samples * d->share_of_a_sample;
  printf("%8s %12zu %8.1f %%  ", faces, samples, 100 * share);
  for (int k = 0; k < (int)(BAR * share + 0.5); k++)
    putchar('#');
  putchar('\n');
}

/* The deepest ones share the last row. */
static void print_depths(const struct depths *d) {
  char faces[24];
  size_t deeper = 0;
  printf("\n%8s %12s %10s  Faces over a sample: at most %u\n", "faces",
         "samples", "share", d->most);
  for (uint32_t k = 0; k <= d->most; k++) {
    snprintf(faces, sizeof faces, "%u", k);
    if (k < DEPTH_ROWS)
      print_depth(faces, d->samples[k], d);
    else
      deeper += d->samples[k];
  }
  if (deeper)
    print_depth("more", deeper, d);
  printf(
      "\nOf two relevant faces the part that overlaps: in X %.3f, in Y %.3f, "
      "in Z %.3f\n(rule, f = 2 H_f / n: %.3f)\n",
      d->overlaps.f_x, d->overlaps.f_y, d->overlaps.f_z, d->rule);
}

static void free_depths(struct depths *d) {
  free(d->samples);
}

/* Counts a picture's samples by the faces over them, and writes it if a file is
 * asked for. */
static enum hsr_status count_depths(const struct options *o,
                                    const struct hsr_view *view,
                                    const uint32_t *depth, struct depths *d,
                                    struct hsr_error *err) {
  size_t n = (size_t)view->m * (size_t)view->n;
  for (size_t k = 0; k < n; k++)
    d->most = depth[k] > d->most ? depth[k] : d->most;
  d->samples = calloc((size_t)d->most + 1, sizeof *d->samples);
  float *picture = malloc(n * sizeof *picture);
  enum hsr_status status = d->samples && picture ? HSR_OK : hsr_fail_nomem(err);
  for (size_t k = 0; !status && k < n; k++) {
    d->samples[depth[k]]++;
    picture[k] = (float)depth[k];
  }
  d->share_of_a_sample = 1 / (double)n;
  if (!status && o->depth)
    status = hsr_image_write_work(o->depth, view->m, view->n, picture, err);
  free(picture);
  return status;
}

static enum hsr_status measure_depths(const struct options *o,
                                      const struct hsr_world *world,
                                      const struct hsr_view *view,
                                      const struct hsr_table1 *measured,
                                      struct depths *d, struct hsr_error *err) {
  uint32_t *depth = malloc((size_t)view->m * (size_t)view->n * sizeof *depth);
  enum hsr_status status = depth ? HSR_OK : hsr_fail_nomem(err);
  if (!status)
    status = hsr_depth_complexity(world, view, depth, err);
  if (!status)
    status = count_depths(o, view, depth, d, err);
  if (!status)
    status = hsr_overlaps_measure(world, view, &d->overlaps, err);
  d->rule = 2 * measured->H_f / measured->n;
  free(depth);
  return status;
}

static enum hsr_status measure(const struct options *o,
                               const struct hsr_world *world,
                               const struct hsr_view *view,
                               const struct hsr_densities *densities,
                               struct hsr_error *err) {
  struct hsr_table1 measured, rules;
  if (densities && !o->json)
    print_densities(densities);
  enum hsr_status status = measure_table1(world, view, &measured, err);
  if (status)
    return status;
  hsr_statistics_rules(&measured, &rules);
  struct depths depths = {.samples = NULL};
  status = measure_depths(o, world, view, &measured, &depths, err);
  if (!status && o->json)
    status = print_json(o, &measured, &rules, &depths, densities, err);
  else if (!status) {
    print_text(o, &measured, &rules);
    print_depths(&depths);
  }
  free_depths(&depths);
  return status;
}

enum hsr_status command_stats(int argc, char **argv, struct hsr_error *err) {
  struct options options = {.view = VIEW_OPTIONS_STANDARD};
  struct place place;
  enum hsr_status status = parse_options(&argp, argc, argv, &options, err);
  if (status)
    return status;
  status = place_open(&place, &options.scene, &options.view, "stats", err);
  if (!status)
    status =
        measure(&options, &place.world, &place.view,
                place.scene->grid ? place.scene->grid->densities : NULL, err);
  place_close(&place);
  return status;
}
