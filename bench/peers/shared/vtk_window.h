/* SPDX-License-Identifier: GPL-3.0-or-later */
/* VTK drawing ids as colours, in our own context of OpenGL.
 *
 * Context     VTK draws in our context, of EGL and llvmpipe, by way of
 *             vtkGenericOpenGLRenderWindow. Debian's VTK can make a context of
 *             its own only on an X server.
 * Ids         Without light and smoothing a pixel holds its colour exactly: 24
 *             bits. */
#ifndef HSR_BENCH_PEERS_SHARED_VTK_WINDOW_H
#define HSR_BENCH_PEERS_SHARED_VTK_WINDOW_H

#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

constexpr uint32_t VTK_MOST_IDS = 0xffffff; /* the background's colour */

/* VTK uses GLEW to find OpenGL's functions. In every frame GLEW finds them and
 * then fails, because there is no X server. This lets it do so only once. */
class IdWindow : public vtkGenericOpenGLRenderWindow {
public:
  static IdWindow *New();
  vtkTypeMacro(IdWindow, vtkGenericOpenGLRenderWindow);
  void OpenGLInitContext() override;
};

struct IdScene {
  vtkNew<IdWindow> window;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkUnsignedCharArray> pixels;
  bool failed = false; /* once VTK has reported an error */
};

/* Prepares for pictures of m x n. A context is current. */
void open_ids(IdScene *scene, int m, int n);

/* Notes errors that the object reports. */
void watch_errors(IdScene *scene, vtkObject *object);

void id_colour(uint32_t id, unsigned char colour[3]);

/* Copies the pixels to ids, which has m * n. */
void take_ids(IdScene *scene, int m, int n, uint32_t *ids);

/* "9.1.0 on Mesa 22.3.6"; empty if there is no context. */
void vtk_version_text(char *text, int size);

#endif
