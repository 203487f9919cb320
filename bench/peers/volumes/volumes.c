/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr-volumes: see volumes.h. */
#include "config.h"

#include "bench/peers/volumes/volumes.h"

#include "bench/modules/variant.h"
#include "bench/options/words.h"
#include "bench/results/json.h"
#include "bench/run/crew.h"
#include "bench/run/stage.h"
#include "bench/run/terminate.h"
#include "common/answers/kinds/composited.h"
#include "common/base/clock.h"
#include "common/files/image.h"
#include "common/files/json/json.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const struct volume_peer *const peers[] = {
#if HSR_HAVE_VTK_RENDERER
    &volume_vtk,     &volume_vtk_coarse,
#endif
#if HSR_HAVE_VOLPACK
    &volume_volpack,
#endif
#if HSR_HAVE_TEEM
    &volume_teem,    &volume_teem_coarse,
#endif
};
enum { N_PEERS = sizeof peers / sizeof *peers };

#define USAGE "hsr-volumes: list, or NAME SCENE VIEW WxH [FRAMES [PREFIX]]"

/* Our picture: from front to back, as rays go. Splats are not widened for pixels,
 * which no peer does. In X-ray
 * mode the exposure is such that the brightest pixel has nearly the most. */
#define UNDER "splat:model=under:antialias=off"
#define XRAY "splat-xray:kernel=gaussian:antialias=off:exposure=%.6g"
#define FIRST_EXPOSURE (1.0 / 256)
#define BRIGHTEST (60000.0 / 65535)

enum { MOST_FRAMES = 1000, BRIGHTER = 8 };

static enum hsr_status find_peer(const char *name,
                                 const struct volume_peer **peer,
                                 struct hsr_error *err) {
  for (int k = 0; k < N_PEERS; k++) {
    *peer = peers[k];
    if (!strcmp(peers[k]->name, name))
      return HSR_OK;
  }
  return hsr_fail(err, HSR_E_USAGE, "no such renderer: %.100s (see list)",
                  name);
}

/* --- hsr-volumes list ----------------------------------------------------- */

static json_t *peer_json(const struct volume_peer *peer) {
  char version[VOLUME_VERSION] = "";
  peer->version(version);
  return json_pack("{ss ss ss ss ss}", "name", peer->name, "title", peer->title,
                   "version", version, "beside",
                   peer->sums ? "splat-xray" : "splat", "what", peer->what);
}

static enum hsr_status list_peers(struct hsr_error *err) {
  json_t *all = json_array();
  for (int k = 0; k < N_PEERS; k++)
    hsr_json_append(&all, peer_json(peers[k]));
  return json_print(all, err);
}

/* --- Both renderers ------------------------------------------------------- */

struct request {
  const struct volume_peer *peer;
  const char *scene, *prefix; /* prefix: or NULL */
  long view, frames;
  int m, n;
};

struct run {
  struct request request;
  struct stage stage;
  struct hsr_variant variant; /* of ours */
  struct hsr_setup setup;
  struct hsr_answer answer;
  struct crew *crew;
  struct samples samples;
  void *state;          /* the peer's */
  float *ours, *theirs; /* 4 a pixel */
  double *own, *other;  /* seconds, a frame */
  double exposure;
};

static size_t pixels(const struct run *run) {
  return (size_t)run->request.m * (size_t)run->request.n;
}

static enum hsr_status open_ours(struct run *run, struct hsr_error *err) {
  char text[sizeof XRAY + 32];
  if (run->request.peer->sums)
    snprintf(text, sizeof text, XRAY, run->exposure);
  else
    snprintf(text, sizeof text, UNDER);
  enum hsr_status status = hsr_variant_parse(text, &run->variant, err);
  if (!status)
    status = hsr_setup_init(&run->setup, run->variant.listed->plain,
                            &run->variant.choice, &run->stage.world, err);
  if (!status)
    status = answer_init(&run->answer, &run->setup, &run->stage.view, err);
  return status;
}

static void close_ours(struct run *run) {
  if (run->answer.form.type)
    hsr_answer_free(&run->answer);
  if (run->setup.algorithm)
    hsr_setup_free(&run->setup);
  run->answer = (struct hsr_answer){.body = NULL};
  run->setup = (struct hsr_setup){.algorithm = NULL};
}

static enum hsr_status draw_ours(struct run *run, struct hsr_error *err) {
  struct hsr_tally tally = {.work = NULL};
  return crew_render(run->crew, &run->setup, &run->stage.view, &run->answer,
                     &tally, err);
}

static enum hsr_status draw_theirs(struct run *run, struct hsr_error *err) {
  return run->request.peer->draw(run->state, &run->stage.view, err);
}

static void take_pictures(struct run *run) {
  const uint16_t *rgba = hsr_answer_rgba_of(&run->answer);
  for (size_t k = 0; k < 4 * pixels(run); k++)
    run->ours[k] = (float)rgba[k] / 65535;
  run->request.peer->take(run->state, &run->stage.view, run->theirs);
}

/* Finds the exposure by a first picture. */
static enum hsr_status expose(struct run *run, struct hsr_error *err) {
  uint16_t most = 1;
  run->exposure = FIRST_EXPOSURE;
  enum hsr_status status = open_ours(run, err);
  if (!status)
    status = draw_ours(run, err);
  if (!status) {
    const uint16_t *rgba = hsr_answer_rgba_of(&run->answer);
    for (size_t k = 3; k < 4 * pixels(run); k += 4)
      most = rgba[k] > most ? rgba[k] : most;
    run->exposure *= BRIGHTEST * 65535 / most;
  }
  close_ours(run);
  return status;
}

static enum hsr_status allocate(struct run *run, struct hsr_error *err) {
  run->ours = calloc(4 * pixels(run), sizeof *run->ours);
  run->theirs = calloc(4 * pixels(run), sizeof *run->theirs);
  run->own = calloc((size_t)run->request.frames, sizeof *run->own);
  run->other = calloc((size_t)run->request.frames, sizeof *run->other);
  run->crew = crew_new(1);
  bool all = run->ours && run->theirs && run->own && run->other && run->crew;
  return all ? HSR_OK : hsr_fail_nomem(err);
}

static enum hsr_status set_up(struct run *run, struct hsr_error *err) {
  const struct volume_peer *peer = run->request.peer;
  const struct hsr_view *view = &run->stage.view;
  enum hsr_status status = allocate(run, err);
  if (!status && !run->stage.world.roster.scene->grid)
    status = hsr_fail(err, HSR_E_REFUSED, "%s: not a grid", peer->name);
  if (!status && peer->parallel && !view->parallel)
    status = hsr_fail(err, HSR_E_REFUSED,
                      "%s draws in parallel projection alone", peer->name);
  if (!status && peer->sums)
    status = expose(run, err);
  if (!status)
    status = open_ours(run, err);
  if (!status)
    status = samples_init(&run->samples, &run->setup, view, &run->answer, err);
  if (!status)
    status = peer->setup(peer, &run->samples, view, &run->state, err);
  return status;
}

static enum hsr_status time_frame(struct run *run, double *seconds,
                                  enum hsr_status (*draw)(struct run *,
                                                          struct hsr_error *),
                                  struct hsr_error *err) {
  double begin = hsr_seconds_now();
  enum hsr_status status = draw(run, err);
  *seconds = hsr_seconds_now() - begin;
  return status;
}

/* A frame of each that is not timed, and then all frames, in turn. */
static enum hsr_status time_frames(struct run *run, struct hsr_error *err) {
  double unused;
  enum hsr_status status = time_frame(run, &unused, draw_ours, err);
  if (!status)
    status = time_frame(run, &unused, draw_theirs, err);
  for (long k = 0; k < run->request.frames && !status; k++) {
    status = time_frame(run, &run->own[k], draw_ours, err);
    if (!status)
      status = time_frame(run, &run->other[k], draw_theirs, err);
  }
  return status;
}

/* --- Comparing ------------------------------------------------------------ */

/* The channels that are compared: colours, or of sums the opacity. */
static int first_channel(const struct run *run) {
  return run->request.peer->sums ? 3 : 0;
}
static int end_channel(const struct run *run) {
  return run->request.peer->sums ? 4 : 3;
}

/* Sums are in other units: multiplies theirs by the factor that leaves the
 * least squares of differences. */
static double fit(struct run *run) {
  double both = 0, square = 0;
  if (!run->request.peer->sums)
    return 1;
  for (size_t k = 3; k < 4 * pixels(run); k += 4) {
    both += (double)run->ours[k] * (double)run->theirs[k];
    square += (double)run->theirs[k] * (double)run->theirs[k];
  }
  double factor = square > 0 ? both / square : 1;
  for (size_t k = 0; k < 4 * pixels(run); k++)
    run->theirs[k] = (float)(factor * (double)run->theirs[k]);
  return factor;
}

static double mean_square_root(const struct run *run) {
  double sum = 0;
  int first = first_channel(run), end = end_channel(run);
  for (size_t k = 0; k < pixels(run); k++)
    for (int c = first; c < end; c++) {
      double d = (double)run->ours[4 * k + (size_t)c] -
                 (double)run->theirs[4 * k + (size_t)c];
      sum += d * d;
    }
  return sqrt(sum / (double)pixels(run) / (end - first));
}

/* The share of pixels in which either picture shows anything. */
static double covered(const struct run *run) {
  size_t n = 0;
  for (size_t k = 3; k < 4 * pixels(run); k += 4)
    n += run->ours[k] > 0 || run->theirs[k] > 0;
  return (double)n / (double)pixels(run);
}

/* Of our pixels and theirs at (dx, dy) from there. */
static double correlation(const struct run *run, int dx, int dy) {
  int m = run->request.m, n = run->request.n;
  double count = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;
  for (int j = abs(dy); j < n - abs(dy); j++)
    for (int i = abs(dx); i < m - abs(dx); i++)
      for (int c = first_channel(run); c < end_channel(run); c++) {
        double x = (double)run->ours[4 * (j * m + i) + c];
        double y = (double)run->theirs[4 * ((j + dy) * m + i + dx) + c];
        count++, a += x, b += y, aa += x * x, bb += y * y, ab += x * y;
      }
  double spread = (count * aa - a * a) * (count * bb - b * b);
  return spread > 0 ? (count * ab - a * b) / sqrt(spread) : 0;
}

/* Where a parabola through three values, one apart, is greatest. */
static double summit(double before, double middle, double after) {
  double bend = before - 2 * middle + after;
  return bend < 0 ? (before - after) / (2 * bend) : (double)NAN;
}

static json_t *shift_json(const struct run *run, double middle) {
  double x = summit(correlation(run, -1, 0), middle, correlation(run, 1, 0));
  double y = summit(correlation(run, 0, -1), middle, correlation(run, 0, 1));
  return isfinite(x) && isfinite(y) ? json_pack("[ff]", x, y) : json_null();
}

static int by_size(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static json_t *seconds_json(double *seconds, long n) {
  qsort(seconds, (size_t)n, sizeof *seconds, by_size);
  return json_pack("{sf sf}", "least", seconds[0], "median", seconds[n / 2]);
}

static enum hsr_status report(struct run *run, double factor,
                              struct hsr_error *err) {
  const struct request *request = &run->request;
  double middle = correlation(run, 0, 0);
  json_t *verdict = json_pack(
      "{ss ss si s[ii] si ss so so}", "name", request->peer->name, "scene",
      request->scene, "view", (int)request->view, "size", request->m,
      request->n, "frames", (int)request->frames, "beside", run->variant.name,
      "seconds", seconds_json(run->other, request->frames), "our_seconds",
      seconds_json(run->own, request->frames));
  json_t *apart =
      json_pack("{sf sf sf sf so}", "factor", factor, "covered", covered(run),
                "rms", mean_square_root(run), "correlation", middle, "shift",
                shift_json(run, middle));
  if (verdict && apart)
    json_object_update(verdict, apart);
  json_decref(apart);
  return json_print(verdict, err);
}

/* --- Pictures ------------------------------------------------------------- */

/* Sums are shown in grey. */
static enum hsr_status write_one(const struct run *run, const char *what,
                                 const float *rgba, struct hsr_error *err) {
  char path[1024];
  float *rgb = malloc(3 * pixels(run) * sizeof *rgb);
  if (!rgb)
    return hsr_fail_nomem(err);
  for (size_t k = 0; k < pixels(run); k++)
    for (size_t c = 0; c < 3; c++)
      rgb[3 * k + c] =
          fminf(1, rgba[4 * k + (run->request.peer->sums ? 3 : c)]);
  struct hsr_picture picture = {
      .m = run->request.m, .n = run->request.n, .rgb = rgb};
  snprintf(path, sizeof path, "%.900s-%.60s.png", run->request.prefix, what);
  enum hsr_status status = hsr_image_write(path, &picture, NULL, err);
  free(rgb);
  return status;
}

/* The difference takes the place of their picture. */
static enum hsr_status write_pictures(struct run *run, struct hsr_error *err) {
  enum hsr_status status = write_one(run, "ours", run->ours, err);
  if (!status)
    status = write_one(run, run->request.peer->name, run->theirs, err);
  for (size_t k = 0; k < 4 * pixels(run); k++)
    run->theirs[k] = BRIGHTER * fabsf(run->ours[k] - run->theirs[k]);
  return status ? status : write_one(run, "difference", run->theirs, err);
}

/* Their picture as numbers, as hsr errors reads it: red, green, blue and opacity.
 * A sum of opacity stands in all four. */
static enum hsr_status write_numbers(struct run *run, struct hsr_error *err) {
  char path[1024];
  for (size_t k = 0; run->request.peer->sums && k < 4 * pixels(run); k++)
    run->theirs[k] = run->theirs[k | 3];
  const struct hsr_npy array = {
      .kind = 'f',
      .bytes = 4,
      .n_dimensions = 3,
      .size = {(uint64_t)run->request.n, (uint64_t)run->request.m, 4},
      .data = run->theirs};
  snprintf(path, sizeof path, "%.900s-%.60s.npy", run->request.prefix,
           run->request.peer->name);
  return hsr_npy_write(path, &array, err);
}

/* --- The program ---------------------------------------------------------- */

static enum hsr_status compare(struct run *run, struct hsr_error *err) {
  enum hsr_status status = set_up(run, err);
  if (!status)
    status = time_frames(run, err);
  if (status)
    return status;
  take_pictures(run);
  if (run->request.prefix)
    status = write_numbers(run, err);
  if (status)
    return status;
  double factor = fit(run);
  status = report(run, factor, err);
  if (!status && run->request.prefix)
    status = write_pictures(run, err);
  return status;
}

static void close_run(struct run *run) {
  run->request.peer->release(run->state);
  samples_free(&run->samples);
  close_ours(run);
  crew_free(run->crew);
  free(run->ours);
  free(run->theirs);
  free(run->own);
  free(run->other);
  stage_close(&run->stage);
}

/* No faces of a grid are laid out, which none of these renderers needs. */
static enum hsr_status run_request(const struct request *request,
                                   struct hsr_error *err) {
  struct run run = {.request = *request};
  enum hsr_status status =
      stage_open(&run.stage, request->scene, 0, request->view, request->m,
                 request->n, 1, err);
  if (!status)
    status = compare(&run, err);
  close_run(&run);
  return status;
}

static enum hsr_status parse(int argc, char **argv, struct request *request,
                             struct hsr_error *err) {
  *request = (struct request){.frames = 5};
  if (argc < 5 || argc > 7 || !parse_count(argv[3], 1, 1000, &request->view) ||
      !parse_size(argv[4], &request->m, &request->n) ||
      (argc > 5 && !parse_count(argv[5], 1, MOST_FRAMES, &request->frames)))
    return hsr_fail(err, HSR_E_USAGE, USAGE);
  request->scene = argv[2];
  request->prefix = argv[6 < argc ? 6 : argc]; /* argv[argc] is NULL */
  return find_peer(argv[1], &request->peer, err);
}

static enum hsr_status run_command(int argc, char **argv,
                                   struct hsr_error *err) {
  if (argc == 2 && !strcmp(argv[1], "list"))
    return list_peers(err);
  struct request request;
  enum hsr_status status = parse(argc, argv, &request, err);
  return status ? status : run_request(&request, err);
}

int main(int argc, char **argv) {
  end_in_one_line();
  struct hsr_error err = {.text = "unexplained failure"};
  enum hsr_status status = run_command(argc, argv, &err);
  if ((fflush(stdout) || ferror(stdout)) && !status)
    status = hsr_fail(&err, HSR_E_INPUT, "standard output: cannot be written");
  if (status)
    fprintf(stderr, "hsr: %s\n", err.text);
  if (status == HSR_E_NOMEM)
    end_process((int)status);
  return (int)status;
}
