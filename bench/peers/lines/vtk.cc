/* SPDX-License-Identifier: GPL-3.0-or-later */
/* VTK's hidden lines: a renderer that is told to remove them
 * (UseHiddenLineRemoval, vtkHiddenLineRemovalPass) and draws one actor as
 * wires. It draws the faces to the z-buffer alone, and then the wires in front.
 *
 * Input       Faces that exist, as they are; VTK divides them for the z-buffer,
 *             and draws their sides.
 * Pixels      A side has the colour of its face, whose number it is. Where two
 *             faces share a side, the one that is drawn last wins. */
#include "bench/peers/lines/line_pixels.h"
#include "bench/peers/lines/lines.h"
#include "bench/peers/shared/offscreen.h"
#include "bench/peers/shared/peers.h"
#include "bench/peers/shared/vtk.h"
#include "bench/peers/shared/vtk_window.h"
#include "common/answers/kinds/segments.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <new>
#include <vector>

namespace {

struct Scene : IdScene {
  vtkNew<vtkPoints> points;
  vtkNew<vtkPolyData> mesh;
  vtkNew<vtkPolyDataMapper> mapper;
  vtkNew<vtkActor> actor;
};

struct State {
  struct offscreen offscreen = {nullptr, nullptr};
  const struct hsr_world *world;
  struct hsr_edges edges = {};
  struct box box;
  std::vector<uint32_t> pixel;
  Scene *scene = nullptr; /* goes before the context does */
};

void connect(Scene *scene, const struct hsr_world *world) {
  scene->points->SetDataTypeToDouble();
  for (uint32_t v = 0; v < world->mesh.n_vertices; v++)
    scene->points->InsertNextPoint(world->mesh.x[v], world->mesh.y[v],
                                   world->mesh.z[v]);
  scene->mesh->SetPoints(scene->points);
  scene->mapper->SetInputData(scene->mesh);
  scene->mapper->SetScalarModeToUseCellData();
  scene->mapper->SetColorModeToDirectScalars();
  scene->actor->SetMapper(scene->mapper);
  scene->actor->GetProperty()->LightingOff();
  scene->actor->GetProperty()->SetRepresentationToWireframe();
  scene->renderer->UseHiddenLineRemovalOn();
  scene->renderer->AddActor(scene->actor);
  watch_errors(scene, scene->mapper);
}

void fill(const State *state, const struct hsr_view *view) {
  const struct hsr_mesh &mesh = state->world->mesh;
  vtkNew<vtkCellArray> faces;
  vtkNew<vtkUnsignedCharArray> ids;
  ids->SetNumberOfComponents(3);
  for (uint32_t f = 0; f < state->world->n_faces; f++) {
    if (!lines_face_exists(state->world, view, f))
      continue;
    unsigned char colour[3];
    id_colour(f, colour);
    ids->InsertNextTypedTuple(colour);
    faces->InsertNextCell(int(mesh.start[f + 1] - mesh.start[f]));
    for (uint32_t k = mesh.start[f]; k < mesh.start[f + 1]; k++)
      faces->InsertCellPoint(mesh.vertex[k]);
  }
  state->scene->mesh->SetPolys(faces);
  state->scene->mesh->GetCellData()->SetScalars(ids);
}

enum hsr_status lines_setup(const struct peer *peer,
                            const struct peer_canvas *canvas, void **out,
                            struct hsr_error *err) try {
  (void)peer;
  State *state = new (std::nothrow) State;
  *out = state;
  if (!state)
    return hsr_fail_nomem(err);
  state->world = canvas->setup->world;
  if (state->world->n_faces >= VTK_MOST_IDS)
    return hsr_fail(err, HSR_E_REFUSED, "vtk: more faces than colours");
  state->box = box_of_world(state->world);
  state->pixel.resize(size_t(canvas->m) * size_t(canvas->n));
  enum hsr_status status = hsr_edges_init(&state->edges, state->world, err);
  if (!status)
    status = offscreen_open(&state->offscreen, false, 1, err);
  if (status)
    return status;
  state->scene = new Scene;
  open_ids(state->scene, canvas->m, canvas->n);
  connect(state->scene, state->world);
  return HSR_OK;
} catch (...) {
  return vtk_fail(err);
}

enum hsr_status lines_draw(void *opaque, const struct hsr_view *view,
                           struct hsr_error *err) try {
  State *state = static_cast<State *>(opaque);
  vtk_aim(state->scene->renderer, &state->box, view);
  fill(state, view);
  state->scene->window->Render();
  take_ids(state->scene, view->m, view->n, state->pixel.data());
  return state->scene->failed
             ? hsr_fail(err, HSR_E_INTERNAL, "vtk: drawing failed")
             : HSR_OK;
} catch (...) {
  return vtk_fail(err);
}

enum hsr_status lines_judge(void *opaque, const struct hsr_view *view,
                            json_t **answer, struct hsr_error *err) {
  State *state = static_cast<State *>(opaque);
  struct hsr_drawing right = {};
  struct pixels_verdict verdict;
  enum hsr_status status = lines_draw_right(state->world, view, &right, err);
  if (!status)
    status = line_pixels_compare(&state->edges, view, state->pixel.data(),
                                 &right, &verdict, err);
  if (!status)
    *answer = line_pixels_json(&verdict);
  hsr_drawing_free(&right);
  return status;
}

void lines_release(void *opaque) {
  State *state = static_cast<State *>(opaque);
  if (!state)
    return;
  delete state->scene;
  offscreen_close(&state->offscreen);
  hsr_edges_free(&state->edges);
  delete state;
}

void lines_version(char *text) {
  vtk_version_text(text, PEER_VERSION);
}

struct hsr_algorithm any_faces() {
  struct hsr_algorithm demands = {};
  demands.name = "faces";
  demands.subjects = 1 << HSR_FACES;
  demands.makes[0].kind = HSR_SEGMENTS;
  return demands;
}
const struct hsr_algorithm takes_faces = any_faces();

struct peer lines_peer() {
  struct peer peer = {};
  peer.name = "vtk-lines";
  peer.title = "VTK's hidden-line removal, on Mesa's llvmpipe";
  peer.source = "W. Schroeder, K. Martin and B. Lorensen, The Visualization "
                "Toolkit, 4th edition, Kitware 2006";
  peer.what =
      "vtkHiddenLineRemovalPass: wires in front of a z-buffer. A frame makes "
      "the mesh of all faces that exist, brings it to buffers, renders it "
      "twice "
      "and copies the pixels to memory. Set-up, which is not part of a frame, "
      "makes the context and finds the edges. Mismatches are edges of which a "
      "pixel is shown where none of its face's edges is visible, or of which a "
      "pixel's length is visible but shown by no line; all to within 1.5 "
      "pixels. Lines in which faces penetrate are not looked for, and not "
      "judged.";
  peer.kind = "segments";
  peer.demands = &takes_faces;
  peer.version = lines_version;
  peer.setup = lines_setup;
  peer.draw = lines_draw;
  peer.judge = lines_judge;
  peer.release = lines_release;
  return peer;
}

} // namespace

const struct peer peer_vtk_lines = lines_peer();
