// SPDX-License-Identifier: GPL-3.0-or-later
// The window through VTK: all of hsr-window.so.
//
// Pictures    are put on the window's pixels as they are, by X: that takes a
//             fifth of the time of OpenGL, which draws on a processor here and
//             there. Where the pixels have another form, OpenGL draws them.
// Shapes      are drawn by OpenGL.
// Text        is drawn by cairo (window_text.h), as a picture.
#include "bench/view/window.h"
#include "bench/view/window_text.h"

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
#include <vtkUnsignedCharArray.h>

#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string>
#include <thread>
#include <vector>

VTK_MODULE_INIT(vtkRenderingOpenGL2)
VTK_MODULE_INIT(vtkRenderingUI)

struct window {
  const window_events *events;
  vtkNew<vtkRenderWindow> frame;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkRenderWindowInteractor> interactor;
  vtkNew<vtkImageData> image;
  vtkNew<vtkImageMapper> mapper;
  vtkNew<vtkActor2D> picture;
  vtkNew<vtkImageData> panel_image; /* of OpenGL */
  vtkNew<vtkImageMapper> panel_mapper;
  vtkNew<vtkActor2D> panel;
  vtkNew<vtkCallbackCommand> listener;
  std::vector<vtkSmartPointer<vtkActor>> shapes;
  bool moving = false, moved = false, left = false;

  /* Of pictures that X puts. */
  Display *display = nullptr; /* ours, and VTK's */
  Window id = 0;
  XImage *ximage = nullptr; /* NULL: OpenGL draws pictures */
  std::vector<uint32_t> pixels;
  int m = 0, n = 0;
  std::string panel_text;
  int panel_size[2] = {0, 0}; /* of the window then */
  window_text text = {};      /* that text, drawn */
  int timer = -1, period = 0; /* milliseconds */
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

void show(window *w);

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
      show(&w); /* the window was covered */
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

void free_ximage(window &w) {
  if (!w.ximage)
    return;
  w.ximage->data = nullptr; /* ours */
  XDestroyImage(w.ximage);
  w.ximage = nullptr;
}

/* Until it is on the screen, what X puts on it is lost. */
void wait_for_window(window &w) {
  const Window id = reinterpret_cast<Window>(w.frame->GetGenericWindowId());
  XWindowAttributes state;
  for (int k = 0; k < 1000; k++) {
    if (!XGetWindowAttributes(w.display, id, &state) ||
        state.map_state == IsViewable)
      return;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

/* VTK's pixels run from 0 to 255. */
void set_mapper(vtkImageMapper *mapper, vtkImageData *image,
                vtkActor2D *actor) {
  mapper->SetColorWindow(255);
  mapper->SetColorLevel(127.5);
  mapper->SetInputData(image);
  actor->SetMapper(mapper);
  actor->SetVisibility(false);
}

void build(window &w, const char *title, int m, int n) {
  w.frame->SetDisplayId(w.display);
  w.frame->SetMultiSamples(0);
  w.frame->SetSize(m, n);
  w.frame->SetWindowName(title);
  w.frame->AddRenderer(w.renderer);
  w.renderer->SetBackground(0.09, 0.11, 0.15);
  set_mapper(w.mapper, w.image, w.picture);
  w.renderer->AddActor2D(w.picture);
  set_mapper(w.panel_mapper, w.panel_image, w.panel);
  w.renderer->AddActor2D(w.panel);
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

/* The display goes last. */
void destroy(window *w) {
  Display *display = w ? w->display : nullptr;
  delete w;
  if (display)
    XCloseDisplay(display);
}

struct window *open(const char *title, int m, int n,
                    const window_events *events, struct hsr_error *err) {
  window *w = nullptr;
  try {
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    vtkObject::GlobalWarningDisplayOff();
    w = new window;
    w->events = events;
    w->display = XOpenDisplay(nullptr);
    if (!w->display) {
      hsr_fail(err, HSR_E_NOMEM,
               "view: there is no display: DISPLAY does not name an X server "
               "that answers");
      destroy(w);
      return nullptr;
    }
    build(*w, title, m, n);
    wait_for_window(*w);
    return w;
  } catch (const std::bad_alloc &) {
    hsr_fail_nomem(err);
  } catch (...) {
    hsr_fail(err, HSR_E_INTERNAL, "VTK: failed");
  }
  destroy(w);
  return nullptr;
}

void close(window *w) {
  if (!w)
    return;
  w->interactor->RemoveAllObservers();
  free_ximage(*w);
  window_text_free(&w->text);
  w->frame->Finalize();
  destroy(w);
}

/* ---- Pictures that X puts ---- */

/* An image of 32 bits a pixel, 8 for each colour. False if the window's pixels
 * have another form. */
bool make_ximage(window &w, int m, int n) {
  if (w.ximage && w.m == m && w.n == n)
    return true;
  XWindowAttributes window;
  w.id = reinterpret_cast<Window>(w.frame->GetGenericWindowId());
  if (!XGetWindowAttributes(w.display, w.id, &window) || window.depth < 24 ||
      window.visual->red_mask != 0xff0000 ||
      window.visual->green_mask != 0xff00 || window.visual->blue_mask != 0xff)
    return false;
  free_ximage(w);
  w.m = m;
  w.n = n;
  w.pixels.assign(static_cast<size_t>(m) * static_cast<size_t>(n), 0);
  w.ximage = XCreateImage(
      w.display, window.visual, static_cast<unsigned>(window.depth), ZPixmap, 0,
      reinterpret_cast<char *>(w.pixels.data()), static_cast<unsigned>(m),
      static_cast<unsigned>(n), 32, 0);
  const uint32_t one = 1;
  if (w.ximage)
    w.ximage->byte_order =
        *reinterpret_cast<const char *>(&one) ? LSBFirst : MSBFirst;
  return w.ximage && w.ximage->bits_per_pixel == 32;
}

/* ---- The panel ---- */

constexpr int edge = 8; /* pixels between it and those of the window */

/* How many pixels the screen has an inch, as its user has set them. */
double dots(window &w) {
  const char *set = XGetDefault(w.display, "Xft", "dpi");
  return set ? std::atof(set) : 0;
}

/* For OpenGL, whose colours are not multiplied by the opacity. */
void make_panel_image(window &w) {
  w.panel_image->SetDimensions(w.text.m, w.text.n, 1);
  w.panel_image->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  auto *to = static_cast<unsigned char *>(w.panel_image->GetScalarPointer());
  for (int j = w.text.n - 1; j >= 0; j--)
    for (int i = 0; i < w.text.m; i++) {
      const uint32_t pixel =
          w.text.pixel[static_cast<size_t>(j) * static_cast<size_t>(w.text.m) +
                       static_cast<size_t>(i)];
      const uint32_t opacity = std::max(pixel >> 24, uint32_t{1});
      for (int shift = 16; shift >= 0; shift -= 8)
        *to++ =
            static_cast<unsigned char>((pixel >> shift & 255) * 255 / opacity);
      *to++ = static_cast<unsigned char>(pixel >> 24);
    }
  w.panel_image->Modified();
}

void draw_panel(window &w, const char *text) {
  const int *size = w.frame->GetSize();
  w.panel_text = text;
  w.panel_size[0] = size[0];
  w.panel_size[1] = size[1];
  window_text_draw(&w.text, text, dots(w), size[0] - 2 * edge,
                   size[1] - 2 * edge);
  w.panel->SetVisibility(w.text.pixel != nullptr);
  if (w.text.pixel)
    make_panel_image(w);
  w.panel->SetDisplayPosition(edge, size[1] - edge - w.text.n);
}

uint32_t blend(uint32_t over, uint32_t under) {
  const uint32_t rest = 255 - (over >> 24);
  uint32_t sum = 0;
  for (int shift = 0; shift < 24; shift += 8)
    sum |= ((over >> shift & 255) + (under >> shift & 255) * rest / 255)
           << shift;
  return sum;
}

/* The picture stays as it is under the panel, for the next one. */
void put_picture(window &w) {
  std::vector<uint32_t> under;
  const auto each = [&](const auto &act) {
    size_t k = 0;
    for (int j = 0; j < w.text.n; j++)
      for (int i = 0; i < w.text.m; i++, k++)
        if (i + edge < w.m && j + edge < w.n)
          act(w.pixels[static_cast<size_t>(j + edge) *
                           static_cast<size_t>(w.m) +
                       static_cast<size_t>(i + edge)],
              k);
  };
  under.resize(static_cast<size_t>(w.text.m) * static_cast<size_t>(w.text.n));
  each([&](uint32_t &pixel, size_t k) {
    under[k] = pixel;
    pixel = blend(w.text.pixel[k], pixel);
  });
  XPutImage(w.display, w.id, DefaultGC(w.display, DefaultScreen(w.display)),
            w.ximage, 0, 0, 0, 0, static_cast<unsigned>(w.m),
            static_cast<unsigned>(w.n));
  XSync(w.display, False);
  each([&](uint32_t &pixel, size_t k) { pixel = under[k]; });
}

int ignore(Display *, XErrorEvent *) {
  return 0;
}

/* What is on the screen. False if not all of the window is there. */
bool grab(window &w, int m, int n, unsigned char *rgb) {
  int (*before)(Display *, XErrorEvent *) = XSetErrorHandler(ignore);
  XImage *got = XGetImage(w.display, w.id, 0, 0, static_cast<unsigned>(m),
                          static_cast<unsigned>(n), AllPlanes, ZPixmap);
  XSync(w.display, False);
  XSetErrorHandler(before);
  for (int j = 0; got && j < n; j++)
    for (int i = 0; i < m; i++)
      for (int shift = 16; shift >= 0; shift -= 8)
        *rgb++ =
            static_cast<unsigned char>(XGetPixel(got, i, j) >> shift & 255);
  if (got)
    XDestroyImage(got);
  return got;
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
void set_image(window *w, int m, int n, const unsigned char *rgb) {
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

void set_picture(window *w, int m, int n, const unsigned char *rgb) {
  if (!make_ximage(*w, m, n)) {
    set_image(w, m, n, rgb);
    return;
  }
  for (uint32_t &pixel : w->pixels) {
    pixel = uint32_t{rgb[0]} << 16 | uint32_t{rgb[1]} << 8 | rgb[2];
    rgb += 3;
  }
}

/* The text is drawn again where the window has another size. */
void set_panel(window *w, const char *text) {
  const int *size = w->frame->GetSize();
  if (w->panel_text != text || w->panel_size[0] != size[0] ||
      w->panel_size[1] != size[1])
    draw_panel(*w, text);
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
  if (w->ximage && w->shapes.empty()) {
    put_picture(*w);
    return;
  }
  if (!w->shapes.empty())
    w->renderer->ResetCameraClippingRange();
  w->frame->Render();
}

void set_tick(window *w, int milliseconds) {
  w->period = milliseconds;
  if (w->timer >= 0)
    w->interactor->DestroyTimer(w->timer);
  w->timer = milliseconds ? w->interactor->CreateRepeatingTimer(
                                static_cast<unsigned long>(milliseconds))
                          : -1;
}

bool get_pixels(window *w, int m, int n, unsigned char *rgb) {
  if (w->ximage && w->shapes.empty())
    return grab(*w, m, n, rgb);
  vtkNew<vtkUnsignedCharArray> array;
  w->frame->GetPixelData(0, 0, m - 1, n - 1, 0, array);
  const size_t row = 3 * static_cast<size_t>(m);
  for (int j = 0; j < n; j++)
    std::memcpy(rgb + row * static_cast<size_t>(j),
                array->GetPointer(0) + row * static_cast<size_t>(n - 1 - j),
                row);
  return true;
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

/* VTK's timers only run in its own loop. */
void wait(window *w, int milliseconds) {
  using clock = std::chrono::steady_clock;
  const std::chrono::milliseconds period(w->period);
  const auto end = clock::now() + std::chrono::milliseconds(milliseconds);
  auto next = clock::now() + period;
  while (clock::now() < end) {
    w->interactor->ProcessEvents();
    if (w->period && clock::now() >= next) {
      w->events->tick(w->events->context);
      next = clock::now() + period;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

} // namespace

extern "C" {
extern const struct window_library hsr_window;
const struct window_library hsr_window = {
    open,       close, set_camera, set_picture, set_panel,
    set_shapes, show,  set_tick,   get_pixels,  run,
    stop,       press, drag,       wheel,       wait};
}
