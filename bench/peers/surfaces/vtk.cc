/* SPDX-License-Identifier: GPL-3.0-or-later */
/* VTK's renderer, as a program without a display would use it.
 *
 * Ids         Ids are colours of points; each triangle has three points of its
 *             own. Without light and smoothing a pixel holds the id exactly, in
 *             24 bits. Colours of cells, with shared points, take as long or,
 *             on some meshes, half as long again.
 * Painter     vtkDepthSortPolyData sorts from back to front by the centres of
 *             the triangles' boxes. Then the same renderer draws every pixel
 *             that comes, without a depth test.
 * Sides       One-sided faces and the others are two actors. The painter needs
 *             all faces in one order, so it culls only if all are one-sided. */
#include "bench/peers/shared/offscreen.h"
#include "bench/peers/shared/peers.h"
#include "bench/peers/shared/vtk.h"
#include "bench/peers/shared/vtk_window.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkDepthSortPolyData.h>
#include <vtkOpenGLState.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>

#include <GL/gl.h>
#include <new>

namespace {

/* Faces that are culled alike. */
struct Part {
  vtkNew<vtkPolyData> mesh;
  vtkNew<vtkDepthSortPolyData> sorter;
  vtkNew<vtkPolyDataMapper> mapper;
  vtkNew<vtkActor> actor;
};

struct Scene : IdScene {
  Part part[2]; /* two-sided, one-sided */
};

struct State {
  struct offscreen offscreen = {nullptr, nullptr};
  struct box box;
  bool painter;
  uint32_t *ids;
  Scene *scene = nullptr; /* goes before the context does */
};

/* --- Setting up ----------------------------------------------------------- */

void add_triangle(const struct hsr_world *world, uint32_t f, vtkPoints *points,
                  vtkCellArray *triangles, vtkUnsignedCharArray *ids) {
  uint32_t id = hsr_world_parent(world, f);
  unsigned char colour[3];
  id_colour(id, colour);
  triangles->InsertNextCell(3);
  for (uint32_t k = world->mesh.start[f]; k < world->mesh.start[f + 1]; k++) {
    uint32_t v = world->mesh.vertex[k];
    triangles->InsertCellPoint(points->InsertNextPoint(
        world->mesh.x[v], world->mesh.y[v], world->mesh.z[v]));
    ids->InsertNextTypedTuple(colour);
  }
}

/* Takes the faces that are one-sided, those that are not, or all. */
void fill_part(Part &part, const struct hsr_world *world, bool all,
               bool one_sided) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> triangles;
  vtkNew<vtkUnsignedCharArray> ids;
  points->SetDataTypeToDouble();
  ids->SetNumberOfComponents(3);
  for (uint32_t f = 0; f < world->n_faces; f++)
    if (all || world->mesh.one_sided[f] == one_sided)
      add_triangle(world, f, points, triangles, ids);
  part.mesh->SetPoints(points);
  part.mesh->SetPolys(triangles);
  part.mesh->GetPointData()->SetScalars(ids);
  part.actor->GetProperty()->SetBackfaceCulling(one_sided);
}

/* Connects the filters from the mesh to the picture. */
void connect_part(State *state, Part &part) {
  if (state->painter) {
    part.sorter->SetInputData(part.mesh);
    part.sorter->SetDirectionToBackToFront();
    part.sorter->SetDepthSortModeToBoundsCenter();
    part.sorter->SetCamera(state->scene->renderer->GetActiveCamera());
    part.mapper->SetInputConnection(part.sorter->GetOutputPort());
  } else {
    part.mapper->SetInputData(part.mesh);
  }
  part.mapper->SetScalarModeToUsePointData();
  part.mapper->SetColorModeToDirectScalars();
  part.actor->SetMapper(part.mapper);
  part.actor->GetProperty()->LightingOff();
  state->scene->renderer->AddActor(part.actor);
  watch_errors(state->scene, part.mapper);
}

void add_world(State *state, const struct hsr_world *world) {
  uint32_t n_one_sided = 0;
  for (uint32_t f = 0; f < world->n_faces; f++)
    n_one_sided += world->mesh.one_sided[f];
  bool mixed = n_one_sided > 0 && n_one_sided < world->n_faces;
  bool all = state->painter && mixed;
  for (bool one_sided : {false, true}) {
    if (all ? one_sided : !mixed && one_sided != (n_one_sided > 0))
      continue;
    Part &part = state->scene->part[one_sided];
    fill_part(part, world, all, one_sided);
    connect_part(state, part);
  }
}

enum hsr_status vtk_setup(const struct peer *peer,
                          const struct peer_canvas *canvas, void **out,
                          struct hsr_error *err) try {
  State *state = new (std::nothrow) State;
  *out = state;
  if (!state)
    return hsr_fail_nomem(err);
  const struct hsr_world *world = canvas->setup->world;
  if (world->n_faces >= VTK_MOST_IDS)
    return hsr_fail(err, HSR_E_REFUSED, "vtk: more faces than colours");
  state->painter = peer == &peer_vtk_painter;
  state->box = box_of_world(world);
  state->ids = canvas->ids;
  enum hsr_status status =
      offscreen_open(&state->offscreen, false, canvas->threads, err);
  if (status)
    return status;
  state->scene = new Scene;
  open_ids(state->scene, canvas->m, canvas->n);
  add_world(state, world);
  return HSR_OK;
} catch (...) {
  return vtk_fail(err);
}

/* --- A frame -------------------------------------------------------------- */

enum hsr_status vtk_draw(void *opaque, const struct hsr_view *view,
                         struct hsr_error *err) try {
  State *state = static_cast<State *>(opaque);
  Scene *scene = state->scene;
  vtk_aim(scene->renderer, &state->box, view);
  if (state->painter) {
    for (Part &part : scene->part)
      part.sorter->Modified(); /* otherwise it sorts only once */
    scene->window->GetState()->vtkglDepthFunc(GL_ALWAYS);
  }
  scene->window->Render();
  take_ids(scene, view->m, view->n, state->ids);
  return scene->failed ? hsr_fail(err, HSR_E_INTERNAL, "vtk: drawing failed")
                       : HSR_OK;
} catch (...) {
  return vtk_fail(err);
}

void vtk_release(void *opaque) {
  State *state = static_cast<State *>(opaque);
  if (!state)
    return;
  delete state->scene;
  offscreen_close(&state->offscreen);
  delete state;
}

/* --- The peers ------------------------------------------------------------ */

void vtk_version(char *text) {
  vtk_version_text(text, PEER_VERSION);
}

struct peer vtk_peer(const char *name, const char *title, const char *what) {
  struct peer peer = {};
  peer.name = name;
  peer.title = title;
  peer.source = "W. Schroeder, K. Martin and B. Lorensen, The Visualization "
                "Toolkit, 4th edition, Kitware 2006";
  peer.what = what;
  peer.kind = "ids";
  peer.many_threads = true;
  peer.demands = &takes_triangles;
  peer.version = vtk_version;
  peer.setup = vtk_setup;
  peer.draw = vtk_draw;
  peer.release = vtk_release;
  return peer;
}

} // namespace

const struct peer peer_vtk =
    vtk_peer("vtk", "VTK's renderer, on Mesa's llvmpipe",
             "vtkPolyDataMapper and a z-buffer. A frame renders the scene and "
             "copies the pixels to memory as ids. Set-up, which is not part of "
             "a frame, makes the context and the meshes and, in a first frame, "
             "brings them to buffers.");
const struct peer peer_vtk_painter = vtk_peer(
    "vtk-painter", "VTK's depth-sorted painter, on Mesa's llvmpipe",
    "vtkDepthSortPolyData and no z-buffer: known to be wrong, as painters are. "
    "A frame sorts all triangles by depth, brings them to buffers, renders "
    "them and copies the pixels to memory as ids. Set-up, which is not part of "
    "a frame, makes the context and the meshes.");
