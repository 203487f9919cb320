/* SPDX-License-Identifier: GPL-3.0-or-later */
/* VTK's ray caster for volumes, vtkFixedPointVolumeRayCastMapper, on the cells
 * of a grid.
 *
 * Volume      A voxel has four bytes: the cell's number, and whether it is
 *             kept. The voxels of kept cells are opaque, the others are clear.
 *             VTK takes the bytes as colour and opacity. So a ray brings back
 *             the number of the first kept cell that one of its steps lies in.
 *             VTK holds only volumes whose cells are all of one size.
 * Places      To the nearest neighbour, VTK rounds a position down: voxel k is
 *             what lies between the points k and k + 1. So the points are the
 *             lower corners of the cells. Voxels that are clear surround them.
 * Steps       A ray looks at the volume in equal steps, and misses whatever
 *             lies between two of them: corners and edges of cells. Shorter
 *             steps take more time and miss less. But positions have 15 binary
 *             places and are added up, so that very short steps drift.
 * Compared    The picture names cells, not their sides. It is compared with the
 *             cells that the oracle's faces belong to. */
#include "bench/peers/shared/peers.h"
#include "bench/peers/shared/samples.h"
#include "bench/peers/shared/vtk.h"
#include "bench/peers/shared/vtk_cast.h"

#include <vtkPiecewiseFunction.h>
#include <vtkVersion.h>
#include <vtkVolumeProperty.h>

#include <algorithm>
#include <cstdio>

namespace {

constexpr uint32_t MOST_CELLS = 1u << 24; /* a number has three bytes */
constexpr int BEFORE = 1, AROUND = 3;     /* clear voxels, of each axis */

struct State {
  uint32_t *cells; /* of the samples; the canvas' */
  Cast cast;
};

/* --- The volume ----------------------------------------------------------- */

enum hsr_status check_grid(const struct hsr_grid *grid, struct hsr_error *err) {
  if (grid->n_cells > MOST_CELLS)
    return hsr_fail(err, HSR_E_REFUSED, "vtk: more cells than colours");
  if (!grid_is_even(grid))
    return hsr_fail(err, HSR_E_REFUSED,
                    "vtk: the grid's cells are not all of one size");
  return HSR_OK;
}

void place_cells(Cast *cast, const struct hsr_grid *grid) {
  int n[3];
  double corner[3], size[3];
  for (int axis = 0; axis < 3; axis++) {
    n[axis] = (int)grid->n[axis] + AROUND;
    size[axis] = grid_spacing(grid, axis);
    corner[axis] = grid->bound[axis][0] - BEFORE * size[axis];
  }
  place_image(cast, n, corner, size);
}

void fill_image(vtkImageData *image, const struct hsr_grid *grid) {
  auto *first = static_cast<unsigned char *>(image->GetScalarPointer());
  std::fill_n(first, 4 * (size_t)image->GetNumberOfPoints(), 0);
  for (uint32_t cell = 0; cell < grid->n_cells; cell++) {
    uint32_t at[3];
    hsr_grid_place(grid, cell, at);
    auto *voxel = static_cast<unsigned char *>(image->GetScalarPointer(
        (int)at[0] + BEFORE, (int)at[1] + BEFORE, (int)at[2] + BEFORE));
    for (int byte = 0; byte < 3; byte++)
      voxel[byte] = (unsigned char)(cell >> 8 * byte & 255);
    voxel[3] = 255;
  }
}

/* --- Setting up ----------------------------------------------------------- */

void choose_looks(vtkVolume *volume) {
  vtkNew<vtkPiecewiseFunction> opacity;
  opacity->AddPoint(0, 0);
  opacity->AddPoint(254, 0);
  opacity->AddPoint(255, 1);
  vtkVolumeProperty *property = volume->GetProperty();
  property->IndependentComponentsOff();
  property->SetInterpolationTypeToNearest();
  property->ShadeOff();
  property->SetScalarOpacity(opacity);
}

struct box box_of_grid(const struct hsr_grid *grid) {
  struct box box;
  for (int axis = 0; axis < 3; axis++) {
    box.low[axis] = grid->bound[axis][0];
    box.high[axis] = grid->bound[axis][grid->n[axis]];
  }
  return box;
}

double shortest_side(const struct hsr_grid *grid) {
  return std::min(
      {grid_spacing(grid, 0), grid_spacing(grid, 1), grid_spacing(grid, 2)});
}

enum hsr_status volume_setup(const struct peer *peer,
                             const struct peer_canvas *canvas, void **out,
                             struct hsr_error *err) try {
  const struct hsr_grid *grid = canvas->setup->world->roster.scene->grid;
  *out = nullptr;
  enum hsr_status status = check_grid(grid, err);
  if (status)
    return status;
  forbid_pieces();
  State *state = new State;
  *out = state;
  state->cells = canvas->ids;
  Cast *cast = &state->cast;
  cast->box = box_of_grid(grid);
  place_cells(cast, grid);
  fill_image(cast->image, grid);
  choose_looks(cast->volume);
  int steps = *static_cast<const int *>(peer->flavour);
  connect_cast(cast, canvas->m, canvas->n, shortest_side(grid) / steps,
               (int)canvas->threads);
  return HSR_OK;
} catch (...) {
  return vtk_fail(err);
}

/* --- A frame -------------------------------------------------------------- */

/* A colour has 15 bits, of which the lowest are rounded. */
uint32_t cell_of_pixel(const unsigned short *pixel) {
  uint32_t cell = 0;
  if (!pixel[3])
    return HSR_BACKGROUND;
  for (int byte = 0; byte < 3; byte++)
    cell |= ((uint32_t)pixel[byte] + 64) >> 7 << 8 * byte;
  return cell;
}

void take_cells(const State *state, const struct hsr_view *view) {
  uint32_t *cells = state->cells;
  std::fill_n(cells, (size_t)view->m * (size_t)view->n, HSR_BACKGROUND);
  take_pixels(&state->cast, view->m, view->n,
              [cells](size_t at, const unsigned short *pixel) {
                cells[at] = cell_of_pixel(pixel);
              });
}

enum hsr_status volume_draw(void *opaque, const struct hsr_view *view,
                            struct hsr_error *err) try {
  State *state = static_cast<State *>(opaque);
  cast_rays(&state->cast, view);
  take_cells(state, view);
  return HSR_OK;
} catch (...) {
  return vtk_fail(err);
}

void volume_release(void *opaque) {
  delete static_cast<State *>(opaque);
}

/* --- The peers ------------------------------------------------------------ */

void volume_version(char *text) {
  snprintf(text, PEER_VERSION, "%.20s", vtkVersion::GetVTKVersion());
}

struct hsr_algorithm grids_alone() {
  struct hsr_algorithm demands = {};
  demands.name = "grids";
  demands.subjects = 1 << HSR_GRID;
  demands.makes[0].kind = HSR_IDS;
  demands.flags = HSR_INSTANCED; /* no faces are needed */
  return demands;
}

const struct hsr_algorithm takes_grids = grids_alone();

struct peer volume_peer(const char *name, const char *title, const int *steps,
                        const char *what) {
  struct peer peer = {};
  peer.name = name;
  peer.title = title;
  peer.source = "vtkFixedPointVolumeRayCastMapper, of W. Schroeder, K. Martin "
                "and B. Lorensen, The Visualization Toolkit, 4th edition, "
                "Kitware 2006";
  peer.what = what;
  peer.kind = "cells";
  peer.many_threads = true;
  peer.flavour = steps;
  peer.demands = &takes_grids;
  peer.version = volume_version;
  peer.setup = volume_setup;
  peer.draw = volume_draw;
  peer.release = volume_release;
  return peer;
}

const int coarse = 2, fine = 16;

#define WHAT                                                                   \
  " Grids alone, whose cells are all of one size. What is compared is the "    \
  "cell that each sample shows, not the side of the cell. A frame casts the "  \
  "rays and writes the cells' numbers; it makes no texture of them. Set-up, "  \
  "which is not part of a frame, makes the volume and, in a first frame, "     \
  "finds the blocks of it that are clear."

} // namespace

const struct peer peer_vtk_volume = volume_peer(
    "vtk-volume", "VTK's fixed-point ray caster, steps of half a cell", &coarse,
    "Rays that look at the nearest cell at every half of a cell's shortest "
    "side." WHAT);
const struct peer peer_vtk_volume_fine = volume_peer(
    "vtk-volume-fine", "VTK's fixed-point ray caster, steps of 1/16 cell",
    &fine,
    "Rays that look at the nearest cell at every 16th of a cell's shortest "
    "side." WHAT);
