/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Teem's ray casting of sums, by its libraries hoover, which casts the rays,
 * and gage, which convolves the samples: what its program mrender does with
 * `-m sum`, but in this process, so that a frame does not contain the reading
 * of a file.
 *
 * Kernel      Teem's Gaussian of deviation .6 of a cell along each axis, cut
 *             off at 2 cells: of a cube of 4 x 4 x 4 samples each has a weight.
 * Steps       equal, in cells; a sum is multiplied by their length. */
#include "bench/peers/shared/projection.h"
#include "bench/peers/volumes/volumes.h"

#include <teem/gage.h>
#include <teem/hoover.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define DEVIATION 0.6
#define CUT 3.3333 /* deviations: a trifle less than 2 cells */

struct state {
  struct box box;
  double steps; /* in a cell */
  int m;
  Nrrd *volume; /* its data is borrowed */
  gageContext *gage;
  const double *value; /* what gage found last */
  hooverContext *hoover;
  float *sums;

  /* Of the ray that is cast. */
  size_t pixel;
  double sum, step; /* the step as hoover counts */
};

/* --- The volume ----------------------------------------------------------- */

static bool wrap(struct state *state, const struct samples *samples) {
  state->volume = nrrdNew();
  Nrrd *volume = state->volume;
  if (!volume ||
      nrrdWrap_va(volume, samples->opacity, nrrdTypeFloat, 3,
                  (size_t)samples->n[0], (size_t)samples->n[1],
                  (size_t)samples->n[2]) ||
      nrrdSpaceDimensionSet(volume, 3) ||
      nrrdSpaceOriginSet(volume, samples->first))
    return false;
  for (int axis = 0; axis < 3; axis++) {
    for (int k = 0; k < 3; k++)
      volume->axis[axis].spaceDirection[k] =
          k == axis ? samples->spacing[axis] : 0;
    volume->axis[axis].center = nrrdCenterCell;
  }
  return true;
}

static bool convolve(struct state *state) {
  const double kernel[NRRD_KERNEL_PARMS_NUM] = {DEVIATION, CUT};
  state->gage = gageContextNew();
  if (!state->gage)
    return false;
  gageParmSet(state->gage, gageParmRenormalize, 0);
  gagePerVolume *volume =
      gagePerVolumeNew(state->gage, state->volume, gageKindScl);
  if (!volume || gagePerVolumeAttach(state->gage, volume) ||
      gageKernelSet(state->gage, gageKernel00, nrrdKernelGaussian, kernel) ||
      gageQueryItemOn(state->gage, volume, gageSclValue) ||
      gageUpdate(state->gage))
    return false;
  state->value = gageAnswerPointer(state->gage, volume, gageSclValue);
  return true;
}

/* --- Rays ----------------------------------------------------------------- */

static int begin_ray(void *thread, void *render, void *user, int i, int j,
                     double length, double from[3], double index[3],
                     double direction[3], double across[3]) {
  struct state *state = user;
  (void)thread, (void)render, (void)length, (void)from, (void)index;
  (void)direction;
  double cells = sqrt(across[0] * across[0] + across[1] * across[1] +
                      across[2] * across[2]);
  state->step = 1 / (cells * state->steps);
  state->pixel = (size_t)j * (size_t)state->m + (size_t)i;
  state->sum = 0;
  return 0;
}

static double sample_ray(void *thread, void *render, void *user, int number,
                         double t, int inside, double world[3],
                         double index[3]) {
  struct state *state = user;
  (void)thread, (void)render, (void)number, (void)t, (void)world;
  if (inside && !gageProbe(state->gage, index[0], index[1], index[2]))
    state->sum += *state->value;
  return state->step;
}

static int end_ray(void *thread, void *render, void *user) {
  struct state *state = user;
  (void)thread, (void)render;
  state->sums[state->pixel] = (float)(state->sum / state->steps);
  return 0;
}

static bool choose_rays(struct state *state, const struct hsr_view *view) {
  state->hoover = hooverContextNew();
  if (!state->hoover)
    return false;
  hooverContext *hoover = state->hoover;
  hoover->shape = state->gage->shape;
  hoover->imgSize[0] = view->m;
  hoover->imgSize[1] = view->n;
  hoover->imgCentering = nrrdCenterCell;
  hoover->user = state;
  hoover->numThreads = 1;
  hoover->rayBegin = begin_ray;
  hoover->sample = sample_ray;
  hoover->rayEnd = end_ray;
  return true;
}

static struct box box_of(const struct samples *samples) {
  struct box box;
  for (int k = 0; k < 3; k++) {
    box.low[k] = samples->first[k];
    box.high[k] = box.low[k] + (samples->n[k] - 1) * samples->spacing[k];
  }
  return box;
}

static enum hsr_status set_up(const struct volume_peer *peer,
                              const struct samples *samples,
                              const struct hsr_view *view, void **out,
                              struct hsr_error *err) {
  struct state *state = calloc(1, sizeof *state);
  *out = state;
  if (!state)
    return hsr_fail_nomem(err);
  state->box = box_of(samples);
  state->steps = peer->steps;
  state->m = view->m;
  state->sums = calloc((size_t)view->m * (size_t)view->n, sizeof *state->sums);
  if (!state->sums)
    return hsr_fail_nomem(err);
  if (!wrap(state, samples) || !convolve(state) || !choose_rays(state, view))
    return hsr_fail(err, HSR_E_INTERNAL, "teem: cannot be set up");
  return HSR_OK;
}

/* --- A frame -------------------------------------------------------------- */

static double size_of(const double v[3]) {
  return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* Teem wants all depths to be positive: in parallel the eye moves back. */
static void set_camera(const struct state *state, const struct hsr_view *view) {
  limnCamera *camera = state->hoover->cam;
  double nearest, farthest, up = size_of(view->U), right = size_of(view->R);
  box_depths(&state->box, view, &nearest, &farthest);
  double back = view->parallel ? farthest - 2 * nearest : 0;
  back = back > 0 ? back : 0;
  for (int k = 0; k < 3; k++) {
    camera->from[k] = view->E[k] - back * view->F[k];
    camera->at[k] = camera->from[k] + view->F[k];
    camera->up[k] = view->U[k] / up;
  }
  camera->uRange[0] = -right;
  camera->uRange[1] = right;
  camera->vRange[0] = -up;
  camera->vRange[1] = up;
  camera->fov = camera->aspect = (double)NAN;
  camera->neer = nearest + back;
  camera->faar = farthest + back;
  camera->dist = 1;
  camera->atRelative = 0;
  camera->orthographic = view->parallel;
  camera->rightHanded = 1;
}

static enum hsr_status draw(void *opaque, const struct hsr_view *view,
                            struct hsr_error *err) {
  struct state *state = opaque;
  int code, thread;
  set_camera(state, view);
  if (hooverRender(state->hoover, &code, &thread) == hooverErrNone)
    return HSR_OK;
  char *why = biffGetDone(HOOVER);
  enum hsr_status status = hsr_fail(err, HSR_E_INTERNAL, "teem: %.100s",
                                    why ? strtok(why, "\n") : "no rays");
  free(why);
  return status;
}

static void take(const void *opaque, const struct hsr_view *view, float *rgba) {
  const struct state *state = opaque;
  size_t n = (size_t)view->m * (size_t)view->n;
  for (size_t k = 0; k < 4 * n; k++)
    rgba[k] = state->sums[k / 4];
}

static void release(void *opaque) {
  struct state *state = opaque;
  if (!state)
    return;
  if (state->hoover)
    hooverContextNix(state->hoover);
  if (state->gage)
    gageContextNix(state->gage);
  if (state->volume)
    nrrdNix(state->volume);
  free(state->sums);
  free(state);
}

static void version(char *text) {
  snprintf(text, VOLUME_VERSION, "%.20s", airTeemVersion);
}

#define WHAT                                                                   \
  "Sums of opacity along rays, by the libraries hoover and gage as mrender "   \
  "uses them, with a Gaussian of the same deviation and radius. Set-up wraps " \
  "the samples. "

const struct volume_peer volume_teem = {
    .name = "teem-xray",
    .title = "Teem's ray caster, sums, steps of half a cell",
    .what = WHAT,
    .sums = true,
    .steps = 2,
    .version = version,
    .setup = set_up,
    .draw = draw,
    .take = take,
    .release = release};

const struct volume_peer volume_teem_coarse = {
    .name = "teem-xray-coarse",
    .title = "Teem's ray caster, sums, steps of a cell",
    .what = WHAT,
    .sums = true,
    .steps = 1,
    .version = version,
    .setup = set_up,
    .draw = draw,
    .take = take,
    .release = release};
