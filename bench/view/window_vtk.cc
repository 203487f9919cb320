// SPDX-License-Identifier: GPL-3.0-or-later
// The window through VTK: all of hsr-window.so.
#include "bench/view/window.h"

#include <vtkActor.h>
#include <vtkActor2D.h>
#include <vtkAutoInit.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkImageData.h>
#include <vtkImageMapper.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>

#include <X11/Xlib.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string>
#include <thread>
#include <vector>

VTK_MODULE_INIT(vtkRenderingOpenGL2)
VTK_MODULE_INIT(vtkRenderingUI)
VTK_MODULE_INIT(vtkRenderingFreeType)

struct window {
  const window_events *events;
  vtkNew<vtkRenderWindow> frame;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkRenderWindowInteractor> interactor;
  vtkNew<vtkImageData> image;
  vtkNew<vtkImageMapper> mapper;
  vtkNew<vtkActor2D> picture;
  vtkNew<vtkTextActor> text;
  vtkNew<vtkCallbackCommand> listener;
  std::vector<vtkSmartPointer<vtkActor>> shapes;
  bool moving = false, moved = false, left = false;
  int timer = -1;
};

namespace {

/* The keys of VTK's own style do nothing. */
class Style final : public vtkInteractorStyleTrackballCamera {
public:
  static Style *New();
  vtkTypeMacro(Style, vtkInteractorStyleTrackballCamera);
  void OnChar() override {}
};
vtkStandardNewMacro(Style);

/* ---- Events ---- */

void tell_turn(window &w) {
  vtkCamera *from = w.renderer->GetActiveCamera();
  hsr_camera camera{};
  from->GetPosition(camera.eye);
  from->GetFocalPoint(camera.at);
  from->GetViewUp(camera.up);
  if (from->GetParallelProjection())
    camera.parallel = 2 * from->GetParallelScale();
  w.events->turn(w.events->context, &camera, w.moving);
}

void tell_click(window &w) {
  int x, y;
  w.interactor->GetEventPosition(x, y);
  w.events->click(w.events->context, x, w.frame->GetSize()[1] - 1 - y);
}

/* The style keeps the release of a button to itself. */
void hear(vtkObject *, unsigned long event, void *data, void *) {
  window &w = *static_cast<window *>(data);
  const int *size = w.frame->GetSize();
  switch (event) {
  case vtkCommand::KeyPressEvent:
    if (w.interactor->GetKeySym())
      w.events->key(w.events->context, w.interactor->GetKeySym());
    break;
  case vtkCommand::LeftButtonPressEvent:
    w.left = true;
    break;
  case vtkCommand::StartInteractionEvent:
    w.moving = true;
    w.moved = false;
    break;
  case vtkCommand::RenderEvent:
    w.moved = true;
    if (w.moving)
      tell_turn(w);
    else
      w.frame->Render(); /* the window was covered */
    break;
  case vtkCommand::EndInteractionEvent:
    w.moving = false;
    if (w.moved)
      tell_turn(w);
    else if (w.left)
      tell_click(w);
    w.left = false;
    break;
  case vtkCommand::ConfigureEvent:
    w.events->resize(w.events->context, size[0], size[1]);
    break;
  case vtkCommand::TimerEvent:
    w.events->tick(w.events->context);
    break;
  default:
    break;
  }
}

/* ---- Opening ---- */

bool has_display() {
  Display *display = XOpenDisplay(nullptr);
  if (display)
    XCloseDisplay(display);
  return display;
}

void set_text(window &w) {
  vtkTextProperty *property = w.text->GetTextProperty();
  property->SetFontFamilyToCourier();
  property->SetFontSize(13);
  property->SetColor(1, 1, 1);
  property->SetBackgroundColor(0.05, 0.05, 0.1);
  property->SetBackgroundOpacity(0.75);
  property->SetVerticalJustificationToTop();
  w.text->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  w.text->SetPosition(0.008, 0.988);
  w.text->SetVisibility(false);
}

void build(window &w, const char *title, int m, int n) {
  w.frame->SetMultiSamples(0);
  w.frame->SetSize(m, n);
  w.frame->SetWindowName(title);
  w.frame->AddRenderer(w.renderer);
  w.renderer->SetBackground(0.09, 0.11, 0.15);
  w.mapper->SetColorWindow(255);
  w.mapper->SetColorLevel(127.5);
  w.mapper->SetInputData(w.image);
  w.picture->SetMapper(w.mapper);
  w.picture->SetVisibility(false);
  w.renderer->AddActor2D(w.picture);
  set_text(w);
  w.renderer->AddActor2D(w.text);
  w.interactor->SetRenderWindow(w.frame);
  w.interactor->EnableRenderOff(); /* the listener draws */
  vtkNew<Style> style;
  style->SetDefaultRenderer(w.renderer);
  w.interactor->SetInteractorStyle(style);
  w.listener->SetClientData(&w);
  w.listener->SetCallback(hear);
  for (unsigned long event :
       {vtkCommand::KeyPressEvent, vtkCommand::LeftButtonPressEvent,
        vtkCommand::RenderEvent, vtkCommand::ConfigureEvent,
        vtkCommand::TimerEvent})
    w.interactor->AddObserver(event, w.listener, 1);
  style->AddObserver(vtkCommand::StartInteractionEvent, w.listener);
  style->AddObserver(vtkCommand::EndInteractionEvent, w.listener);
  w.interactor->Initialize();
}

struct window *open(const char *title, int m, int n,
                    const window_events *events, struct hsr_error *err) {
  window *w = nullptr;
  try {
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    vtkObject::GlobalWarningDisplayOff();
    if (!has_display()) {
      hsr_fail(err, HSR_E_NOMEM,
               "view: there is no display: DISPLAY does not name an X server "
               "that answers");
      return nullptr;
    }
    w = new window;
    w->events = events;
    build(*w, title, m, n);
    return w;
  } catch (const std::bad_alloc &) {
    hsr_fail_nomem(err);
  } catch (...) {
    hsr_fail(err, HSR_E_INTERNAL, "VTK: failed");
  }
  delete w;
  return nullptr;
}

void close(window *w) {
  if (!w)
    return;
  w->interactor->RemoveAllObservers();
  w->frame->Finalize();
  delete w;
}

/* ---- What is shown ---- */

void set_camera(window *w, const hsr_camera *camera) {
  vtkCamera *to = w->renderer->GetActiveCamera();
  to->SetPosition(camera->eye);
  to->SetFocalPoint(camera->at);
  to->SetViewUp(camera->up);
  to->SetParallelProjection(camera->parallel > 0);
  if (camera->parallel > 0)
    to->SetParallelScale(camera->parallel / 2);
  else
    to->SetViewAngle(camera->fov);
}

/* VTK has its rows from the bottom. */
void set_picture(window *w, int m, int n, const unsigned char *rgb) {
  const int *size = w->image->GetDimensions();
  if (size[0] != m || size[1] != n) {
    w->image->SetDimensions(m, n, 1);
    w->image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  }
  unsigned char *to =
      static_cast<unsigned char *>(w->image->GetScalarPointer());
  const size_t row = 3 * static_cast<size_t>(m);
  for (int j = 0; j < n; j++)
    std::memcpy(to + row * static_cast<size_t>(n - 1 - j),
                rgb + row * static_cast<size_t>(j), row);
  w->image->Modified();
  w->picture->SetVisibility(w->shapes.empty());
}

void set_panel(window *w, const char *text) {
  w->text->SetInput(text);
  w->text->SetVisibility(*text != '\0');
}

vtkSmartPointer<vtkPolyData> poly_data(const window_shape &shape) {
  const hsr_cells &cells = shape.cells;
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> polygons;
  std::vector<vtkIdType> ids;
  for (uint32_t v = 0; v < cells.n_points; v++)
    points->InsertNextPoint(cells.xyz + 3 * size_t{v});
  for (uint32_t k = 0; k < cells.n; k++) {
    ids.assign(cells.point + cells.start[k], cells.point + cells.start[k + 1]);
    polygons->InsertNextCell(static_cast<vtkIdType>(ids.size()), ids.data());
  }
  data->SetPoints(points);
  data->SetPolys(polygons);
  if (shape.rgb) {
    vtkNew<vtkUnsignedCharArray> colours;
    colours->SetNumberOfComponents(3);
    colours->SetNumberOfTuples(static_cast<vtkIdType>(cells.n));
    std::memcpy(colours->GetPointer(0), shape.rgb, 3 * size_t{cells.n});
    data->GetCellData()->SetScalars(colours);
  }
  return data;
}

void set_shapes(window *w, const window_shape *shapes, int n) {
  for (const auto &actor : w->shapes)
    w->renderer->RemoveActor(actor);
  w->shapes.clear();
  for (int k = 0; k < n; k++) {
    const window_shape &shape = shapes[k];
    vtkNew<vtkPolyDataMapper> mapper;
    vtkNew<vtkActor> actor;
    mapper->SetInputData(poly_data(shape));
    mapper->SetScalarVisibility(shape.rgb != nullptr);
    actor->SetMapper(mapper);
    vtkProperty *property = actor->GetProperty();
    property->SetColor(shape.colour[0] / 255.0, shape.colour[1] / 255.0,
                       shape.colour[2] / 255.0);
    property->SetLighting(false);
    property->SetOpacity(shape.opacity);
    if (shape.lines)
      property->SetRepresentationToWireframe();
    w->renderer->AddActor(actor);
    w->shapes.emplace_back(actor.Get());
  }
  w->picture->SetVisibility(n == 0);
}

void show(window *w) {
  if (!w->shapes.empty())
    w->renderer->ResetCameraClippingRange();
  w->frame->Render();
}

void set_tick(window *w, int milliseconds) {
  if (w->timer >= 0)
    w->interactor->DestroyTimer(w->timer);
  w->timer = milliseconds ? w->interactor->CreateRepeatingTimer(
                                static_cast<unsigned long>(milliseconds))
                          : -1;
}

void get_pixels(window *w, int m, int n, unsigned char *rgb) {
  vtkNew<vtkUnsignedCharArray> array;
  w->frame->GetPixelData(0, 0, m - 1, n - 1, 0, array);
  const size_t row = 3 * static_cast<size_t>(m);
  for (int j = 0; j < n; j++)
    std::memcpy(rgb + row * static_cast<size_t>(j),
                array->GetPointer(0) + row * static_cast<size_t>(n - 1 - j),
                row);
}

/* ---- The user, and one who plays the user ---- */

void run(window *w) {
  w->interactor->Start();
}

void stop(window *w) {
  w->interactor->TerminateApp();
}

void press(window *w, const char *key) {
  w->interactor->SetKeyEventInformation(0, 0, 0, 1, key);
  w->interactor->InvokeEvent(vtkCommand::KeyPressEvent, nullptr);
  w->interactor->InvokeEvent(vtkCommand::KeyReleaseEvent, nullptr);
}

void move_to(window *w, int x, int y) {
  w->interactor->SetEventInformationFlipY(x, y, 0, 0);
}

void drag(window *w, int button, const int from[2], const int to[2],
          int steps) {
  static const unsigned long down[] = {vtkCommand::LeftButtonPressEvent,
                                       vtkCommand::MiddleButtonPressEvent,
                                       vtkCommand::RightButtonPressEvent},
                             up[] = {vtkCommand::LeftButtonReleaseEvent,
                                     vtkCommand::MiddleButtonReleaseEvent,
                                     vtkCommand::RightButtonReleaseEvent};
  move_to(w, from[0], from[1]);
  w->interactor->InvokeEvent(down[button - 1], nullptr);
  for (int k = 1; k <= steps; k++) {
    move_to(w, from[0] + (to[0] - from[0]) * k / steps,
            from[1] + (to[1] - from[1]) * k / steps);
    w->interactor->InvokeEvent(vtkCommand::MouseMoveEvent, nullptr);
  }
  w->interactor->InvokeEvent(up[button - 1], nullptr);
}

void wheel(window *w, int by) {
  const int *size = w->frame->GetSize();
  move_to(w, size[0] / 2, size[1] / 2);
  for (int k = 0; k < std::abs(by); k++)
    w->interactor->InvokeEvent(by > 0 ? vtkCommand::MouseWheelForwardEvent
                                      : vtkCommand::MouseWheelBackwardEvent,
                               nullptr);
}

void wait(window *w, int milliseconds) {
  using namespace std::chrono;
  const auto end =
      steady_clock::now() + std::chrono::milliseconds(milliseconds);
  do {
    w->interactor->ProcessEvents();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  } while (steady_clock::now() < end);
}

} // namespace

extern "C" {
extern const struct window_library hsr_window;
const struct window_library hsr_window = {
    open,       close, set_camera, set_picture, set_panel,
    set_shapes, show,  set_tick,   get_pixels,  run,
    stop,       press, drag,       wheel,       wait};
}
