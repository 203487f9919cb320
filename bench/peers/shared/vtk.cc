/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/peers/shared/vtk.h"

#include <vtkCamera.h>

#include <new>

void vtk_aim(vtkRenderer *renderer, const struct box *box,
             const struct hsr_view *view) {
  vtkCamera *camera = renderer->GetActiveCamera();
  double nearest, farthest;
  box_depths(box, view, &nearest, &farthest);
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

enum hsr_status vtk_fail(struct hsr_error *err) {
  try {
    throw;
  } catch (const std::bad_alloc &) {
    return hsr_fail_nomem(err);
  } catch (...) {
    return hsr_fail(err, HSR_E_INTERNAL, "vtk: an exception");
  }
}
