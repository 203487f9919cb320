/* SPDX-License-Identifier: GPL-3.0-or-later */
/* VolPack: the shear-warp factorisation of P. Lacroute and M. Levoy, 1994.
 *
 * Volume      A voxel has its opacity in a byte, which VolPack's classification
 *             takes as it is, for a length of one cell, and a colour of 16
 *             bits: 5 of red, 6 of green, 5 of blue. It stands for the mean of
 *             all colours that are rounded to it. Set-up classifies the volume,
 *             which codes it by runs, for all three axes.
 * Rays        end at an opacity of .95, as in VolPack's own example.
 * Projection  parallel: VolPack 1.0 draws no perspective of such volumes.
 * Picture     8 bits a channel. */
#include "bench/peers/volumes/volumes.h"

#include <volpack.h>

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define LEAST_OPACITY (0.5 / 255)
#define FULL_OPACITY 0.95

enum { COLOURS = 1 << 16, LEVELS = 256 };

struct voxel {
  uint16_t colour;
  uint8_t opacity;
};

struct state {
  vpContext *context;
  struct voxel *voxel;
  float *colour; /* 3 of each code */
  float opacity[LEVELS];
  unsigned char *rgba;
  vpMatrix4 from_cube; /* the cube of the volume, to the world */
};

static enum hsr_status volpack_fail(const struct state *state,
                                    struct hsr_error *err) {
  return hsr_fail(err, HSR_E_INTERNAL, "volpack: %.60s",
                  vpGetErrorString(vpGetError(state->context)));
}

/* --- The volume ----------------------------------------------------------- */

static uint16_t code_of(const uint8_t rgba[4]) {
  return (uint16_t)(rgba[0] >> 3 << 11 | rgba[1] >> 2 << 5 | rgba[2] >> 3);
}

static void fill_voxels(struct state *state, const struct samples *samples) {
  for (size_t k = 0; k < samples->count; k++) {
    state->voxel[k].colour = code_of(samples->rgba[k]);
    state->voxel[k].opacity = samples->rgba[k][3];
  }
}

/* False for lack of memory. */
static bool fill_colours(struct state *state, const struct samples *samples) {
  uint32_t *count = calloc(COLOURS, sizeof *count);
  for (size_t k = 0; count && k < samples->count; k++) {
    size_t code = state->voxel[k].colour;
    count[code] += samples->rgba[k][3] > 0;
    for (size_t c = 0; c < 3 && samples->rgba[k][3]; c++)
      state->colour[3 * code + c] += samples->rgba[k][c];
  }
  for (size_t k = 0; count && k < 3 * COLOURS; k++)
    state->colour[k] /= count[k / 3] ? (float)count[k / 3] : 1;
  free(count);
  return count;
}

static bool describe(struct state *state, const struct samples *samples) {
  vpContext *vpc = state->context;
  const int *n = samples->n;
  int size = sizeof *state->voxel;
  for (int k = 0; k < LEVELS; k++)
    state->opacity[k] = (float)k / (LEVELS - 1);
  return vpSetVolumeSize(vpc, n[0], n[1], n[2]) == VP_OK &&
         vpSetVoxelSize(vpc, size, 2, 1, 1) == VP_OK &&
         vpSetVoxelField(vpc, 0, 2, offsetof(struct voxel, colour),
                         COLOURS - 1) == VP_OK &&
         vpSetVoxelField(vpc, 1, 1, offsetof(struct voxel, opacity),
                         LEVELS - 1) == VP_OK &&
         vpSetRawVoxels(vpc, state->voxel, (int)samples->count * size, size,
                        n[0] * size, n[0] * n[1] * size) == VP_OK &&
         vpSetClassifierTable(vpc, 0, 1, state->opacity,
                              sizeof state->opacity) == VP_OK &&
         vpSetd(vpc, VP_MIN_VOXEL_OPACITY, LEAST_OPACITY) == VP_OK &&
         vpSetd(vpc, VP_MAX_RAY_OPACITY, FULL_OPACITY) == VP_OK &&
         vpClassifyVolume(vpc) == VP_OK &&
         vpSetLookupShader(vpc, 3, 1, 0, state->colour,
                           3 * COLOURS * sizeof *state->colour, 0, NULL,
                           0) == VP_OK;
}

/* VolPack's cube is 1 wide, around the origin. The longest side of the volume
 * fills it; voxel i of n is (i - n/2) / longest from the middle. */
static void place_cube(struct state *state, const struct samples *samples) {
  int longest = 0;
  for (int k = 0; k < 3; k++)
    longest = samples->n[k] > longest ? samples->n[k] : longest;
  for (int k = 0; k < 3; k++) {
    double spacing = samples->spacing[k];
    state->from_cube[k][k] = longest * spacing;
    state->from_cube[k][3] = samples->first[k] + samples->n[k] * spacing / 2;
  }
  state->from_cube[3][3] = 1;
}

static enum hsr_status allocate(struct state *state,
                                const struct samples *samples,
                                const struct hsr_view *view,
                                struct hsr_error *err) {
  state->voxel = calloc(samples->count, sizeof *state->voxel);
  state->colour = calloc(3 * COLOURS, sizeof *state->colour);
  state->rgba = calloc((size_t)view->m * (size_t)view->n, 4);
  state->context = vpCreateContext();
  bool all = state->voxel && state->colour && state->rgba && state->context;
  return all ? HSR_OK : hsr_fail_nomem(err);
}

/* VolPack clips nothing that is behind the eye. */
static bool is_in_front(const struct samples *samples,
                        const struct hsr_view *view) {
  double least = 0;
  for (int k = 0; k < 3; k++) {
    double low = samples->first[k] + SAMPLES_AROUND * samples->spacing[k];
    double width =
        (samples->n[k] - 1 - 2 * SAMPLES_AROUND) * samples->spacing[k];
    double t = view->depth[k] * width;
    least += view->depth[k] * (low - view->E[k]) + (t < 0 ? t : 0);
  }
  return least > view->near;
}

static enum hsr_status check(const struct samples *samples,
                             const struct hsr_view *view,
                             struct hsr_error *err) {
  if (samples->count > INT_MAX / sizeof(struct voxel))
    return hsr_fail(err, HSR_E_REFUSED, "volpack: too many voxels");
  for (int k = 0; k < 3; k++)
    if (samples->n[k] > VP_MAX_VOLUME_DIM)
      return hsr_fail(err, HSR_E_REFUSED, "volpack: more than %d voxels a side",
                      VP_MAX_VOLUME_DIM);
  return is_in_front(samples, view)
             ? HSR_OK
             : hsr_fail(err, HSR_E_REFUSED,
                        "volpack: the grid reaches behind the eye");
}

static enum hsr_status set_up(const struct volume_peer *peer,
                              const struct samples *samples,
                              const struct hsr_view *view, void **out,
                              struct hsr_error *err) {
  (void)peer;
  enum hsr_status status = check(samples, view, err);
  if (status)
    return status;
  struct state *state = calloc(1, sizeof *state);
  *out = state;
  status = state ? allocate(state, samples, view, err) : hsr_fail_nomem(err);
  if (status)
    return status;
  fill_voxels(state, samples);
  if (!fill_colours(state, samples))
    return hsr_fail_nomem(err);
  place_cube(state, samples);
  return describe(state, samples) ? HSR_OK : volpack_fail(state, err);
}

/* --- A frame -------------------------------------------------------------- */

/* From the world to where VolPack clips nothing: x to the right and y up are 1
 * at the picture's edges, but for half a pixel: VolPack's pixels have their
 * middles at whole numbers. z goes away from the eye. VolPack finds the axis
 * along which it looks by angles in pixels, so z is in the same units. */
static void clip_of(const struct hsr_view *view, vpMatrix4 clip) {
  double pixels = 0;
  memset(clip, 0, sizeof(vpMatrix4));
  for (int k = 0; k < 3; k++) {
    clip[0][k] = 2 * view->screen[0][k] / view->m;
    clip[1][k] = -2 * view->screen[1][k] / view->n;
    pixels += view->screen[0][k] * view->screen[0][k];
  }
  for (int k = 0; k < 3; k++)
    clip[2][k] = 2 * sqrt(pixels) * view->depth[k];
  clip[0][3] = -1.0 / view->m;
  clip[1][3] = -1.0 / view->n;
  for (int r = 0; r < 3; r++)
    for (int k = 0; k < 3; k++)
      clip[r][3] -= clip[r][k] * view->E[k];
  clip[3][3] = 1;
}

static void set_camera(struct state *state, const struct hsr_view *view) {
  vpMatrix4 clip;
  clip_of(view, clip);
  vpCurrentMatrix(state->context, VP_MODEL);
  vpSetMatrix(state->context, state->from_cube);
  vpCurrentMatrix(state->context, VP_VIEW);
  vpIdentityMatrix(state->context);
  vpCurrentMatrix(state->context, VP_PROJECT);
  vpSetMatrix(state->context, clip);
}

static enum hsr_status draw(void *opaque, const struct hsr_view *view,
                            struct hsr_error *err) {
  struct state *state = opaque;
  set_camera(state, view);
  bool good = vpSetImage(state->context, state->rgba, view->m, view->n,
                         4 * view->m, VP_RGBA) == VP_OK &&
              vpRenderClassifiedVolume(state->context) == VP_OK;
  return good ? HSR_OK : volpack_fail(state, err);
}

/* VolPack's first row is the lowest. */
static void take(const void *opaque, const struct hsr_view *view, float *rgba) {
  const struct state *state = opaque;
  size_t row = 4 * (size_t)view->m;
  for (size_t j = 0; j < (size_t)view->n; j++)
    for (size_t k = 0; k < row; k++)
      rgba[j * row + k] =
          (float)state->rgba[((size_t)view->n - 1 - j) * row + k] / 255;
}

static void release(void *opaque) {
  struct state *state = opaque;
  if (!state)
    return;
  if (state->context)
    vpDestroyContext(state->context);
  free(state->voxel);
  free(state->colour);
  free(state->rgba);
  free(state);
}

static void version(char *text) {
  snprintf(text, VOLUME_VERSION, "%s", VP_VERSION);
}

const struct volume_peer volume_volpack = {
    .name = "volpack",
    .title = "VolPack's shear-warp factorisation",
    .what = "Voxels in the splats' own lit colours and opacities, per length "
            "of a cell, composited by slices that are sheared, and warped. "
            "Parallel projection alone. Set-up classifies the volume and codes "
            "it by runs.",
    .parallel = true,
    .version = version,
    .setup = set_up,
    .draw = draw,
    .take = take,
    .release = release};
