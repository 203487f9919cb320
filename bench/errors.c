/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr errors: how far pictures are from the exact area integrals
 * (docs/area-picture.md), which are the limit of ever more samples. For grids see
 * errors_of_grid.c.
 *
 * The error of a pixel is the greatest difference of its three channels, which
 * are linear, from 0 to 1. A picture of one sample a place can be asked for
 * with N x N samples a pixel: it is then the mean of N x N pictures, whose
 * colours are rounded to the nearest 65535th as in the definition. */
#include "bench/errors.h"
#include "bench/modules/variant.h"
#include "bench/options/picture.h"
#include "bench/results/json.h"
#include "bench/terminal/terminal.h"
#include "common/files/image.h"
#include "common/files/json/json.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_SIDE = 256 };
enum { WHERE = 0x200, FIELD, WIDTH, PICTURES };

static error_t add_algorithms(struct errors_options *o, char *arg) {
  for (char *word = strtok(arg, ","); word; word = strtok(NULL, ",")) {
    if (o->n_algorithms == MOST_ALGORITHMS)
      return option_fail(&o->base, "errors: at most %d algorithms",
                         (int)MOST_ALGORITHMS);
    o->algorithm[o->n_algorithms++] = word;
  }
  return 0;
}

static error_t add_sides(struct errors_options *o, char *arg) {
  for (char *word = strtok(arg, ","); word; word = strtok(NULL, ",")) {
    if (o->n_sides == MOST_SIDES ||
        !parse_count(word, 1, MOST_SIDE, &o->side[o->n_sides]))
      return option_fail(&o->base,
                         "--supersample %s: must be 1 to %d, and at most %d "
                         "of them",
                         word, (int)MOST_SIDE, (int)MOST_SIDES);
    o->n_sides++;
  }
  return 0;
}

static error_t add_pictures(struct errors_options *o, char *arg) {
  for (char *word = strtok(arg, ","); word; word = strtok(NULL, ",")) {
    if (o->n_pictures == MOST_PICTURES)
      return option_fail(&o->base, "errors: at most %d pictures",
                         (int)MOST_PICTURES);
    o->picture[o->n_pictures++] = word;
  }
  return 0;
}

static error_t parse_field(struct errors_options *o, const char *arg) {
  for (int k = 0; k < N_INTEGRAL_FIELDS; k++)
    if (!strcmp(arg, integral_fields[k].name)) {
      o->field = (enum integral_field)k;
      o->has_field = true;
      return 0;
    }
  return option_fail(&o->base, "--field %s: must be pre, post or sums", arg);
}

static error_t parse_width(struct errors_options *o, const char *arg) {
  char *end;
  o->width = strtod(arg, &end);
  if (end == arg || *end || !(o->width >= 1e-12 && o->width <= 1))
    return option_fail(&o->base, "--width %s: must be 1e-12 to 1", arg);
  return 0;
}

static error_t parse(int key, char *arg, struct argp_state *state) {
  struct errors_options *o = state->input;
  switch (key) {
  case 'a':
    return add_algorithms(o, arg);
  case 'S':
    return add_sides(o, arg);
  case 'f':
    o->has_filter = true;
    return parse_area_filter(&o->filter, arg, &o->base);
  case FIELD:
    return parse_field(o, arg);
  case WIDTH:
    return parse_width(o, arg);
  case PICTURES:
    return add_pictures(o, arg);
  case 'j':
    o->json = true;
    return 0;
  case 'J':
    return parse_threads(&o->scene, &o->threads, arg, &o->base);
  case WHERE:
    o->where = arg;
    return 0;
  default:
    return parse_place_option(&o->scene, &o->view, key, arg, "errors",
                              &o->base);
  }
}

static const struct argp argp = {
    (const struct argp_option[]){
        {"algorithms", 'a', "A,B,...", 0,
         "of these pictures (standard: every filter of the z-buffer, the "
         "A-buffer, and error-bounded; of a grid the models of splats)",
         0},
        {"supersample", 'S', "N,...", 0,
         "N x N samples a pixel, of algorithms that draw samples, for each of "
         "these N (standard: 1)",
         0},
        {"filter", 'f', "box|tent|quadratic|cubic", 0,
         "against the integral weighed by a B-spline: box, tent, quadratic, "
         "cubic (standard: box, the pixel itself)",
         0},
        {"field", FIELD, "F", 0,
         "of a grid: the field whose integral the pictures are measured by: "
         "pre, "
         "classified and then interpolated; post, interpolated and then "
         "classified; sums, as pre without absorption (standard: pre, and sums "
         "for splat-xray)",
         0},
        {"width", WIDTH, "W", 0,
         "of a grid: the width of the intervals that hold the integrals, 1e-12 "
         "to 1 (standard: 0.001)",
         0},
        {"pictures", PICTURES, "FILE,...", 0,
         "of a grid: measure these pictures of the same view too: .exr or .npy "
         "of red, green, blue and opacity, premultiplied and linear; whole "
         "numbers are parts of their greatest",
         0},
        {"where", WHERE, "FILE", 0,
         "write a picture of where the errors are; of several, FILE has %d in "
         "the place of the number. Black: at most 2^-16, brightest: 1, "
         "logarithmic between",
         0},
        JSON_ARGP_OPTION,
        THREADS_ARGP_OPTION,
        SCENE_ARGP_OPTIONS,
        VIEW_ARGP_OPTIONS_OF("512x512"),
        {0}},
    parse,
    "SCENE",
    "Tells how far pictures are from the exact area integrals: the mean and "
    "the greatest error of a pixel, linear, from 0 to 1, in its worst channel; "
    "the pixel of the greatest; and the share of pixels that are wrong by more "
    "than 1/256. If SCENE is a grid it tells how far pictures of splats are "
    "from "
    "the integral of emission and absorption along the rays of the pixels, by "
    "intervals that hold it; also what 99 % of the pixels do not exceed, and "
    "the "
    "mean of what the opacity is too great.\v"
    "  hsr errors house\n"
    "  hsr errors harbor -s 256x256 -a zbuffer-fast -S 1,2,4,8,16,32\n"
    "  hsr errors house -a zbuffer-fast:filter=cosine --filter quadratic \\\n"
    "    --where where.png\n"
    "  hsr errors house --where 'house-%d.png' --json >house.json\n"
    "  hsr errors brain --palette tissue -s 256x256 -J 2 --where "
    "'brain-%d.png'\n"
    "  hsr errors colin27 -a splat --field post --pictures vtk.exr\n"
    "  hsr report results.ndjson --errors house.json -o report",
    NULL,
    NULL,
    NULL};

/* --- Pictures ------------------------------------------------------------- */

/* The scene, and the exact values of the pixels. */
struct comparison {
  const struct errors_options *options;
  struct lib_scene *scene;
  struct lib_answer *exact;
  const double (*bounds)[2]; /* of 3 m n channels */
  float *share;              /* m n: what the picture of errors shows */
  float *rgb;                /* 3 m n: of one drawing */
};

/* One picture, from an algorithm and N of N x N. */
struct made {
  const char *name;
  long side;                  /* 0: the algorithm makes pixels */
  double *rgb;                /* 3 m n */
  double mean, largest, over; /* over: the share of pixels */
  int x, y;                   /* of the largest */
  char where[MOST_FILE_NAME]; /* the picture of its errors; "": none */
};

static size_t n_pixels(const struct comparison *c) {
  return (size_t)c->options->view.m * (size_t)c->options->view.n;
}

static struct hsr_request request_by(const struct comparison *c,
                                     const char *algorithm) {
  struct hsr_request request = client_request(&c->options->view, algorithm, 1);
  request.threads = (int)c->options->threads;
  return request;
}

/* Draws into *answer, and its colours into c->rgb. */
static enum hsr_status draw(const struct comparison *c,
                            struct hsr_drawer *drawer,
                            const struct hsr_request *request,
                            struct lib_answer **answer, struct hsr_error *err) {
  enum hsr_status status = hsr_redraw(drawer, request, answer, err);
  return status ? status
                : hsr_get_colours(*answer, HSR_COLOUR_LAMBERT, c->rgb,
                                  3 * n_pixels(c), err);
}

/* Adds each sample of the N x N in each pixel. */
static enum hsr_status add_samples(const struct comparison *c,
                                   struct hsr_drawer *drawer,
                                   struct lib_answer **answer,
                                   struct made *made, struct hsr_error *err) {
  struct hsr_request request = request_by(c, made->name);
  struct progress progress = progress_begin(stderr);
  const size_t side = (size_t)made->side, n = side * side;
  enum hsr_status status = HSR_OK;
  for (size_t k = 0; k < n && !status; k++) {
    progress_tell(&progress, k, n, "samples", made->name);
    request.offset[0] = ((double)(k % side) + .5) / (double)side - .5;
    request.offset[1] = ((double)(k / side) + .5) / (double)side - .5;
    status = draw(c, drawer, &request, answer, err);
    for (size_t p = 0; !status && p < 3 * n_pixels(c); p++)
      made->rgb[p] += rint(65535 * (double)c->rgb[p]); /* exact */
  }
  progress_end(&progress);
  for (size_t k = 0; k < 3 * n_pixels(c); k++)
    made->rgb[k] /= 65535 * (double)n;
  return status;
}

static enum hsr_status take_pixels(const struct comparison *c,
                                   struct hsr_drawer *drawer,
                                   struct lib_answer **answer,
                                   struct made *made, struct hsr_error *err) {
  struct hsr_request request = request_by(c, made->name);
  enum hsr_status status = draw(c, drawer, &request, answer, err);
  for (size_t k = 0; !status && k < 3 * n_pixels(c); k++)
    made->rgb[k] = (double)c->rgb[k];
  return status;
}

static enum hsr_status make(const struct comparison *c, struct made *made,
                            struct hsr_error *err) {
  const struct hsr_request request = request_by(c, made->name);
  struct hsr_drawer *drawer = NULL;
  struct lib_answer *answer = NULL;
  made->rgb = calloc(3 * n_pixels(c), sizeof *made->rgb);
  enum hsr_status status = made->rgb
                               ? hsr_prepare(c->scene, &request, &drawer, err)
                               : hsr_fail_nomem(err);
  if (!status)
    status = made->side ? add_samples(c, drawer, &answer, made, err)
                        : take_pixels(c, drawer, &answer, made, err);
  hsr_free(answer);
  hsr_release(drawer);
  return status;
}

/* --- Errors --------------------------------------------------------------- */

static double error_of(const double *got, const double (*exact)[2]) {
  double worst = 0;
  for (int c = 0; c < 3; c++)
    worst = fmax(worst, fabs(got[c] - (exact[c][0] + exact[c][1]) / 2));
  return worst;
}

static void measure(const struct comparison *c, struct made *made) {
  size_t n = n_pixels(c), m = (size_t)c->options->view.m, over = 0;
  double sum = 0;
  for (size_t k = 0; k < n; k++) {
    double error = error_of(made->rgb + 3 * k, c->bounds + 3 * k);
    sum += error;
    over += error > errors_much;
    c->share[k] = errors_shown(error);
    if (error > made->largest) {
      made->largest = error;
      made->x = (int)(k % m);
      made->y = (int)(k / m);
    }
  }
  made->mean = sum / (double)n;
  made->over = (double)over / (double)n;
}

float errors_shown(double error) {
  return (float)fmin(1, fmax(0, 1 + log2(error) / 16));
}

enum hsr_status errors_write_where(const struct errors_options *o, long number,
                                   const float *shown, char to[MOST_FILE_NAME],
                                   struct hsr_error *err) {
  if (!o->where)
    return HSR_OK;
  if (!series_name(o->where, number, to))
    snprintf(to, MOST_FILE_NAME, "%s", o->where);
  return hsr_image_write_ramp(to, o->view.m, o->view.n, shown, err);
}

/* --- Output --------------------------------------------------------------- */

static void print_head(const struct comparison *c) {
  char name[TERMINAL_NAME];
  printf("%s, view %ld, %d x %d pixels, against the exact integrals, %s\n\n"
         "    mean    largest  at           over 1/256  picture\n",
         terminal_plain(c->options->scene.name, name, sizeof name),
         c->options->view.view, c->options->view.m, c->options->view.n,
         hsr_area_filters[c->options->filter].name);
}

static void print_made(const struct made *made) {
  char at[30];
  snprintf(at, sizeof at, "(%d, %d)", made->x, made->y);
  printf("%8.6f %10.6f  %-13s %8.2f %%  %s", made->mean, made->largest, at,
         100 * made->over, made->name);
  if (made->side > 1)
    printf(", %ld x %ld", made->side, made->side);
  putchar('\n');
}

static json_t *made_json(const struct made *made) {
  return json_pack(
      "{ss so sf sf si si sf so}", "picture", made->name, "samples",
      made->side ? json_integer(made->side) : json_null(), "mean", made->mean,
      "largest", made->largest, "x", made->x, "y", made->y, "over", made->over,
      "where", *made->where ? json_string(made->where) : json_null());
}

static json_t *all_json(const struct comparison *c, json_t *pictures) {
  return json_pack("{ss ss si si si ss so}", "schema", "hsr-errors/1", "scene",
                   c->options->scene.name, "view", (int)c->options->view.view,
                   "width", c->options->view.m, "height", c->options->view.n,
                   "filter", hsr_area_filters[c->options->filter].name,
                   "pictures", pictures);
}

/* --- The command ---------------------------------------------------------- */

struct told {
  json_t *pictures; /* with --json */
  long number;
};

static enum hsr_status tell(struct comparison *c, const char *algorithm,
                            long side, struct told *told,
                            struct hsr_error *err) {
  struct made made = {.name = algorithm, .side = side};
  enum hsr_status status = make(c, &made, err);
  if (!status) {
    measure(c, &made);
    status = errors_write_where(c->options, ++told->number, c->share,
                                made.where, err);
    if (told->pictures)
      hsr_json_append(&told->pictures, made_json(&made));
    else
      print_made(&made);
    fflush(stdout);
  }
  free(made.rgb);
  return status;
}

/* An algorithm, with each number of samples a pixel if it draws samples. */
static enum hsr_status tell_all(struct comparison *c, const char *algorithm,
                                struct told *told, struct hsr_error *err) {
  static const long one = 1;
  const struct errors_options *o = c->options;
  struct hsr_variant variant;
  enum hsr_status status = hsr_variant_parse(algorithm, &variant, err);
  if (status)
    return status;
  if (!variant.choice.form.type->shade)
    return hsr_fail(err, HSR_E_USAGE, "errors: %s draws %s, not pixels",
                    algorithm, variant.choice.form.type->draws);
  if (!(variant.choice.form.type->takes & 1u << HSR_SUPERSAMPLES))
    return tell(c, algorithm, 0, told, err);
  const long *side = o->n_sides ? o->side : &one;
  for (int k = 0; k < (o->n_sides ? o->n_sides : 1) && !status; k++)
    status = tell(c, algorithm, side[k], told, err);
  return status;
}

static enum hsr_status find_exact(struct comparison *c, struct hsr_error *err) {
  char name[40];
  const double *bounds = NULL;
  snprintf(name, sizeof name, "area-oracle:filter=%s",
           hsr_area_filters[c->options->filter].name);
  const struct hsr_request request = request_by(c, name);
  enum hsr_status status = hsr_draw(c->scene, &request, &c->exact, err);
  if (!status)
    status = hsr_get_areas(c->exact, &bounds, err);
  c->bounds = (const double(*)[2])bounds;
  return status;
}

static enum hsr_status find(struct comparison *c, struct hsr_error *err) {
  static const char *const usual[] = {"zbuffer-fast",
                                      "zbuffer-fast:filter=box4x4",
                                      "zbuffer-fast:filter=box4x8",
                                      "zbuffer-fast:filter=box",
                                      "zbuffer-fast:filter=box:jitter=8",
                                      "zbuffer-fast:filter=cosine",
                                      "zbuffer-fast:filter=cosine:jitter=8",
                                      "zbuffer-fast:filter=field",
                                      "a-buffer",
                                      "error-bounded"};
  const struct errors_options *o = c->options;
  const char *const *algorithm = o->n_algorithms ? o->algorithm : usual;
  int n =
      o->n_algorithms ? o->n_algorithms : (int)(sizeof usual / sizeof *usual);
  struct told told = {.pictures = o->json ? json_array() : NULL};
  c->share = malloc(n_pixels(c) * sizeof *c->share);
  c->rgb = malloc(3 * n_pixels(c) * sizeof *c->rgb);
  enum hsr_status status = c->share && c->rgb && (!o->json || told.pictures)
                               ? find_exact(c, err)
                               : hsr_fail_nomem(err);
  if (!status && !o->json)
    print_head(c);
  for (int k = 0; k < n && !status; k++)
    status = tell_all(c, algorithm[k], &told, err);
  if (!status && o->json)
    return json_print(all_json(c, told.pictures), err);
  json_decref(told.pictures);
  return status;
}

/* Several pictures need several names. */
static enum hsr_status check_where(const struct errors_options *o,
                                   struct hsr_error *err) {
  char name[MOST_FILE_NAME];
  if (!o->where ||
      (o->n_algorithms == 1 && o->n_sides <= 1 && !o->n_pictures) ||
      series_name(o->where, 1, name))
    return HSR_OK;
  return hsr_fail(err, HSR_E_USAGE,
                  "%.200s: a name must have one %%d in the place of the "
                  "picture's number, as in w%%d.png",
                  o->where);
}

static enum hsr_status check_subject(const struct errors_options *o,
                                     bool is_grid, struct hsr_error *err) {
  if (is_grid && (o->n_sides || o->has_filter))
    return hsr_fail(err, HSR_E_USAGE,
                    "errors: of a grid the integral along a pixel's ray is "
                    "taken: no --supersample, no --filter");
  if (!is_grid && (o->n_pictures || o->has_field || o->width > 0))
    return hsr_fail(err, HSR_E_USAGE,
                    "errors: --field, --width and --pictures are for grids");
  return HSR_OK;
}

enum hsr_status command_errors(int argc, char **argv, struct hsr_error *err) {
  struct errors_options options = {.view = VIEW_OPTIONS_STANDARD, .threads = 1};
  enum hsr_status status = parse_options(&argp, argc, argv, &options, err);
  if (!status)
    status = check_where(&options, err);
  if (status)
    return status;
  struct comparison c = {.options = &options};
  struct hsr_scene_info info = {.size = sizeof info};
  status = aim_scene(&options.scene, &options.view, err);
  if (!status)
    status = client_open(&options.scene, &options.view, &c.scene, err);
  if (!status)
    status = hsr_get_scene(c.scene, &info, err);
  if (!status)
    status = check_subject(&options, info.is_grid, err);
  if (!status)
    status =
        info.is_grid ? errors_of_grid(&options, c.scene, err) : find(&c, err);
  hsr_free(c.exact);
  free(c.share);
  free(c.rgb);
  hsr_close(c.scene);
  return status;
}
