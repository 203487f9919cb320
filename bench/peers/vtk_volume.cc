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
 * Blocks      VTK notes which blocks of the volume are clear, and rays leap
 *             over them. Its filter does that in pieces, on several threads.
 *             With bytes as colours, VTK 9.1 reads the wrong voxels for all
 *             pieces but the first, so that rays leap over kept cells: at 256 x
 *             256 samples of tubules, 4,583 of the 7,534 that show a cell
 *             showed none. So the filter is given one piece.
 * Compared    The picture names cells, not their sides. It is compared with the
 *             cells that the oracle's faces belong to.
 * Context     There is none: rays are cast by the processor to memory. The
 *             texture in which VTK would bring the picture to a window is not
 *             made. */
#include "bench/peers/peers.h"
#include "bench/peers/projection.h"

#include <vtkAutoInit.h>
#include <vtkCamera.h>
#include <vtkFixedPointRayCastImage.h>
#include <vtkFixedPointVolumeRayCastMapper.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkImageData.h>
#include <vtkMultiThreader.h>
#include <vtkNew.h>
#include <vtkPiecewiseFunction.h>
#include <vtkRenderer.h>
#include <vtkThreadedImageAlgorithm.h>
#include <vtkVersion.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <new>

VTK_MODULE_INIT(vtkRenderingOpenGL2)
VTK_MODULE_INIT(vtkRenderingVolumeOpenGL2)

namespace {

constexpr uint32_t MOST_CELLS = 1u << 24; /* a number has three bytes */
constexpr double SAME_SIZE = 1e-9;        /* of cells, relative */
constexpr int BEFORE = 1, AROUND = 3;     /* clear voxels, of each axis */

struct Scene {
  vtkNew<vtkGenericOpenGLRenderWindow> window; /* has a size, draws nothing */
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkImageData> image;
  vtkNew<vtkFixedPointVolumeRayCastMapper> mapper;
  vtkNew<vtkVolume> volume;
};

struct State {
  struct box box;
  uint32_t *cells; /* of the samples; the canvas' */
  Scene scene;
};

enum hsr_status volume_fail(struct hsr_error *err) {
  try {
    throw;
  } catch (const std::bad_alloc &) {
    return hsr_fail_nomem(err);
  } catch (...) {
    return hsr_fail(err, HSR_E_INTERNAL, "vtk: an exception");
  }
}

/* --- The volume ----------------------------------------------------------- */

double size_along(const struct hsr_grid *grid, int axis) {
  return (grid->bound[axis][grid->n[axis]] - grid->bound[axis][0]) /
         grid->n[axis];
}

bool is_even(const struct hsr_grid *grid) {
  for (int axis = 0; axis < 3; axis++) {
    double size = size_along(grid, axis);
    for (uint32_t k = 0; k < grid->n[axis]; k++) {
      double own = grid->bound[axis][k + 1] - grid->bound[axis][k];
      if (std::fabs(own - size) > SAME_SIZE * size)
        return false;
    }
  }
  return true;
}

enum hsr_status check_grid(const struct hsr_grid *grid, struct hsr_error *err) {
  if (grid->n_cells > MOST_CELLS)
    return hsr_fail(err, HSR_E_REFUSED, "vtk: more cells than colours");
  if (!is_even(grid))
    return hsr_fail(err, HSR_E_REFUSED,
                    "vtk: the grid's cells are not all of one size");
  return HSR_OK;
}

void place_image(vtkImageData *image, const struct hsr_grid *grid) {
  int n[3];
  double corner[3], size[3];
  for (int axis = 0; axis < 3; axis++) {
    n[axis] = (int)grid->n[axis] + AROUND;
    size[axis] = size_along(grid, axis);
    corner[axis] = grid->bound[axis][0] - BEFORE * size[axis];
  }
  image->SetDimensions(n);
  image->SetOrigin(corner);
  image->SetSpacing(size);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
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

/* A ray for each sample, and steps of this length, in world units. */
void choose_rays(vtkFixedPointVolumeRayCastMapper *mapper, double step,
                 long threads) {
  mapper->SetNumberOfThreads((int)threads);
  mapper->SetBlendModeToComposite();
  mapper->AutoAdjustSampleDistancesOff();
  mapper->LockSampleDistanceToInputSpacingOff();
  mapper->IntermixIntersectingGeometryOff();
  mapper->SetImageSampleDistance(1);
  mapper->SetSampleDistance((float)step);
}

void connect(Scene *scene, const struct peer_canvas *canvas) {
  scene->mapper->SetInputData(scene->image);
  scene->volume->SetMapper(scene->mapper);
  scene->window->SetSize(canvas->m, canvas->n);
  scene->window->AddRenderer(scene->renderer);
  scene->renderer->AddVolume(scene->volume);
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
      {size_along(grid, 0), size_along(grid, 1), size_along(grid, 2)});
}

/* Makes filters that are made from now on work in one piece. */
void forbid_pieces() {
  vtkMultiThreader::SetGlobalDefaultNumberOfThreads(1);
  vtkThreadedImageAlgorithm::SetGlobalDefaultEnableSMP(false);
}

enum hsr_status volume_setup(const struct peer *peer,
                             const struct peer_canvas *canvas, void **out,
                             struct hsr_error *err) try {
  const struct hsr_grid *grid = canvas->setup->world->outline.scene->grid;
  *out = nullptr;
  enum hsr_status status = check_grid(grid, err);
  if (status)
    return status;
  forbid_pieces();
  State *state = new State;
  *out = state;
  state->box = box_of_grid(grid);
  state->cells = canvas->ids;
  Scene *scene = &state->scene;
  place_image(scene->image, grid);
  fill_image(scene->image, grid);
  choose_looks(scene->volume);
  int steps = *static_cast<const int *>(peer->flavour);
  choose_rays(scene->mapper, shortest_side(grid) / steps, canvas->threads);
  connect(scene, canvas);
  return HSR_OK;
} catch (...) {
  return volume_fail(err);
}

/* --- A frame -------------------------------------------------------------- */

void set_camera(State *state, const struct hsr_view *view) {
  vtkCamera *camera = state->scene.renderer->GetActiveCamera();
  double nearest, farthest;
  box_depths(&state->box, view, &nearest, &farthest);
  camera->SetPosition(view->camera.eye);
  camera->SetFocalPoint(view->camera.at);
  camera->SetViewUp(view->camera.up);
  camera->SetParallelProjection(view->parallel);
  if (view->parallel)
    camera->SetParallelScale(view->camera.parallel / 2);
  else
    camera->SetViewAngle(view->camera.fov);
  camera->SetClippingRange(nearest, farthest);
}

/* What the mapper does when it renders, without the texture at the end. */
void cast_rays(Scene *scene) {
  double nowhere[3] = {0, 0, 0};
  int nothing[6] = {0, 0, 0, 0, 0, 0};
  scene->mapper->PerImageInitialization(scene->renderer, scene->volume, 0,
                                        nowhere, nowhere, nothing);
  scene->mapper->PerVolumeInitialization(scene->renderer, scene->volume);
  scene->mapper->PerSubVolumeInitialization(scene->renderer, scene->volume, 0);
  scene->mapper->RenderSubVolume();
}

/* A colour has 15 bits, of which the lowest are rounded. */
uint32_t cell_of_pixel(const unsigned short *pixel) {
  uint32_t cell = 0;
  if (!pixel[3])
    return HSR_BACKGROUND;
  for (int byte = 0; byte < 3; byte++)
    cell |= ((uint32_t)pixel[byte] + 64) >> 7 << 8 * byte;
  return cell;
}

/* VTK's picture is of the part of the window that the volume may cover. Its
 * first row is the lowest. */
void take_cells(const State *state, const struct hsr_view *view) {
  vtkFixedPointRayCastImage *image = state->scene.mapper->GetRayCastImage();
  int corner[2], size[2], room[2];
  image->GetImageOrigin(corner);
  image->GetImageInUseSize(size);
  image->GetImageMemorySize(room);
  std::fill_n(state->cells, (size_t)view->m * (size_t)view->n, HSR_BACKGROUND);
  for (int j = 0; j < size[1]; j++) {
    const unsigned short *from =
        image->GetImage() + 4 * (size_t)j * (size_t)room[0];
    uint32_t *to = state->cells + corner[0] +
                   (size_t)(view->n - 1 - corner[1] - j) * (size_t)view->m;
    for (int i = 0; i < size[0]; i++)
      to[i] = cell_of_pixel(from + 4 * i);
  }
}

enum hsr_status volume_draw(void *opaque, const struct hsr_view *view,
                            struct hsr_error *err) try {
  State *state = static_cast<State *>(opaque);
  set_camera(state, view);
  cast_rays(&state->scene);
  take_cells(state, view);
  return HSR_OK;
} catch (...) {
  return volume_fail(err);
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
  demands.kind = HSR_IDS;
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
