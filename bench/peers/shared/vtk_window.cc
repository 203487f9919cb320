/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/peers/shared/vtk_window.h"
#include "bench/peers/shared/offscreen.h"
#include "common/scene/scene.h"

#include <vtkAutoInit.h>
#include <vtkCallbackCommand.h>
#include <vtkObjectFactory.h>
#include <vtkVersion.h>

#include <cstdio>
#include <cstring>

VTK_MODULE_INIT(vtkRenderingOpenGL2)

vtkStandardNewMacro(IdWindow);

void IdWindow::OpenGLInitContext() {
  if (this->Initialized)
    return;
  vtkObject::GlobalWarningDisplayOff();
  this->vtkGenericOpenGLRenderWindow::OpenGLInitContext();
  vtkObject::GlobalWarningDisplayOn();
  this->Initialized = this->GlewInitValid = true;
}

static void note_failure(vtkObject *, unsigned long, void *scene, void *) {
  static_cast<IdScene *>(scene)->failed = true;
}

void watch_errors(IdScene *scene, vtkObject *object) {
  vtkNew<vtkCallbackCommand> command;
  command->SetCallback(note_failure);
  command->SetClientData(scene);
  object->AddObserver(vtkCommand::ErrorEvent, command);
}

void open_ids(IdScene *scene, int m, int n) {
  scene->window->SetReadyForRendering(true);
  scene->window->SetIsCurrent(true);
  scene->window->SetSupportsOpenGL(1);
  scene->window->SetOwnContext(0);
  scene->window->SetMultiSamples(0);
  scene->window->SetFrameBlitModeToNoBlit();
  scene->window->SetSize(m, n);
  scene->renderer->SetBackground(1, 1, 1); /* VTK_MOST_IDS */
  scene->window->AddRenderer(scene->renderer);
  watch_errors(scene, scene->window);
  watch_errors(scene, scene->renderer);
}

void id_colour(uint32_t id, unsigned char colour[3]) {
  for (int k = 0; k < 3; k++)
    colour[k] = (unsigned char)(id >> 8 * k & 255);
}

/* VTK's first row is the lowest. */
void take_ids(IdScene *scene, int m, int n, uint32_t *ids) {
  scene->window->GetRGBACharPixelData(0, 0, m - 1, n - 1, 0, scene->pixels);
  const unsigned char *pixels = scene->pixels->GetPointer(0);
  size_t width = (size_t)m, height = (size_t)n;
  for (size_t j = 0; j < height; j++) {
    uint32_t *row = ids + j * width;
    memcpy(row, pixels + 4 * (height - 1 - j) * width, width * sizeof *row);
    for (size_t i = 0; i < width; i++) {
      uint32_t id = row[i] & 0xffffff;
      row[i] = id == VTK_MOST_IDS ? HSR_BACKGROUND : id;
    }
  }
}

void vtk_version_text(char *text, int size) {
  char mesa[40];
  offscreen_version(mesa, sizeof mesa);
  if (*mesa)
    snprintf(text, (size_t)size, "%.20s on %s", vtkVersion::GetVTKVersion(),
             mesa);
}
