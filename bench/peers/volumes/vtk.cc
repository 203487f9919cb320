/* SPDX-License-Identifier: GPL-3.0-or-later */
/* VTK's fixed-point ray caster on the samples of a grid, what is over what.
 *
 * Volume      A voxel has four bytes: the lit colour that it has as a splat in
 *             the view for which it is set up, and its opacity for a length of
 *             one cell. VTK takes them as they are, linear between voxels, and
 *             does not shade.
 * Cells       of unequal sides: the length is that of a cell along the view's
 *             middle. */
#include "bench/peers/shared/vtk.h"
#include "bench/peers/volumes/volumes.h"
#include "bench/peers/shared/vtk_cast.h"

#include <vtkPiecewiseFunction.h>
#include <vtkVersion.h>
#include <vtkVolumeProperty.h>

#include <algorithm>
#include <cstdio>
#include <cstring>

namespace {

constexpr float MOST = 32767; /* of 15 bits */

void choose_looks(vtkVolume *volume, double length) {
  vtkNew<vtkPiecewiseFunction> opacity;
  opacity->AddPoint(0, 0);
  opacity->AddPoint(255, 1);
  vtkVolumeProperty *property = volume->GetProperty();
  property->IndependentComponentsOff();
  property->SetInterpolationTypeToLinear();
  property->ShadeOff();
  property->SetScalarOpacity(opacity);
  property->SetScalarOpacityUnitDistance(length);
}

struct box box_of(const struct samples *samples) {
  struct box box;
  for (int k = 0; k < 3; k++) {
    box.low[k] = samples->first[k];
    box.high[k] = samples->first[k] + (samples->n[k] - 1) * samples->spacing[k];
  }
  return box;
}

enum hsr_status over_setup(const struct volume_peer *peer,
                           const struct samples *samples,
                           const struct hsr_view *view, void **out,
                           struct hsr_error *err) try {
  forbid_pieces();
  Cast *cast = new Cast;
  *out = cast;
  double length = 1 / samples_cells_per_length(samples, view);
  cast->box = box_of(samples);
  place_image(cast, samples->n, samples->first, samples->spacing);
  memcpy(cast->image->GetScalarPointer(), samples->rgba, 4 * samples->count);
  choose_looks(cast->volume, length);
  connect_cast(cast, view->m, view->n, length / peer->steps, 1);
  return HSR_OK;
} catch (...) {
  return vtk_fail(err);
}

enum hsr_status over_draw(void *state, const struct hsr_view *view,
                          struct hsr_error *err) try {
  cast_rays(static_cast<Cast *>(state), view);
  return HSR_OK;
} catch (...) {
  return vtk_fail(err);
}

void over_take(const void *state, const struct hsr_view *view, float *rgba) {
  std::fill_n(rgba, 4 * (size_t)view->m * (size_t)view->n, 0.0f);
  take_pixels(static_cast<const Cast *>(state), view->m, view->n,
              [rgba](size_t at, const unsigned short *pixel) {
                for (int c = 0; c < 4; c++)
                  rgba[4 * at + (size_t)c] = (float)pixel[c] / MOST;
              });
}

void over_release(void *state) {
  delete static_cast<Cast *>(state);
}

void over_version(char *text) {
  snprintf(text, VOLUME_VERSION, "%.20s", vtkVersion::GetVTKVersion());
}

struct volume_peer over_peer(const char *name, const char *title,
                             double steps) {
  struct volume_peer peer = {};
  peer.name = name;
  peer.title = title;
  peer.what = "Voxels in the splats' own lit colours and opacities, per length "
              "of a cell, linear between voxels; VTK does not shade. Set-up "
              "makes the volume and, in a first frame, finds the blocks of it "
              "that are clear. No texture is made.";
  peer.steps = steps;
  peer.version = over_version;
  peer.setup = over_setup;
  peer.draw = over_draw;
  peer.take = over_take;
  peer.release = over_release;
  return peer;
}

} // namespace

const struct volume_peer volume_vtk = over_peer(
    "vtk-over", "VTK's fixed-point ray caster, steps of half a cell", 2);
const struct volume_peer volume_vtk_coarse = over_peer(
    "vtk-over-coarse", "VTK's fixed-point ray caster, steps of a cell", 1);
