/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/peers/shared/vtk_cast.h"
#include "bench/peers/shared/vtk.h"

#include <vtkAutoInit.h>
#include <vtkMultiThreader.h>
#include <vtkThreadedImageAlgorithm.h>

VTK_MODULE_INIT(vtkRenderingOpenGL2)
VTK_MODULE_INIT(vtkRenderingVolumeOpenGL2)

void forbid_pieces() {
  vtkMultiThreader::SetGlobalDefaultNumberOfThreads(1);
  vtkThreadedImageAlgorithm::SetGlobalDefaultEnableSMP(false);
}

void place_image(Cast *cast, const int n[3], const double corner[3],
                 const double size[3]) {
  cast->image->SetDimensions(n);
  cast->image->SetOrigin(corner);
  cast->image->SetSpacing(size);
  cast->image->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
}

static void choose_rays(vtkFixedPointVolumeRayCastMapper *mapper, double step,
                        int threads) {
  mapper->SetNumberOfThreads(threads);
  mapper->SetBlendModeToComposite();
  mapper->AutoAdjustSampleDistancesOff();
  mapper->LockSampleDistanceToInputSpacingOff();
  mapper->IntermixIntersectingGeometryOff();
  mapper->SetImageSampleDistance(1);
  mapper->SetSampleDistance((float)step);
}

void connect_cast(Cast *cast, int m, int n, double step, int threads) {
  choose_rays(cast->mapper, step, threads);
  cast->mapper->SetInputData(cast->image);
  cast->volume->SetMapper(cast->mapper);
  cast->window->SetSize(m, n);
  cast->window->AddRenderer(cast->renderer);
  cast->renderer->AddVolume(cast->volume);
}

void cast_rays(Cast *cast, const struct hsr_view *view) {
  double nowhere[3] = {0, 0, 0};
  int nothing[6] = {0, 0, 0, 0, 0, 0};
  vtk_aim(cast->renderer, &cast->box, view);
  cast->mapper->PerImageInitialization(cast->renderer, cast->volume, 0, nowhere,
                                       nowhere, nothing);
  cast->mapper->PerVolumeInitialization(cast->renderer, cast->volume);
  cast->mapper->PerSubVolumeInitialization(cast->renderer, cast->volume, 0);
  cast->mapper->RenderSubVolume();
}
