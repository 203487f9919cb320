/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A window on the screen, VTK's: it shows a picture that somebody else draws, and
 * turns a camera by the mouse. VTK is in hsr-window.so, which is loaded when a
 * window is opened. Only bench/view includes this.
 *
 * Mouse       VTK's trackball: the left button turns, the middle one or shift
 *             shifts, the right one and the wheel come nearer, ctrl rolls
 * Pixels      8 bits a channel, sRGB, rows from the top, no padding; x to the
 *             right, y down from the top */
#ifndef HSR_BENCH_WINDOW_H
#define HSR_BENCH_WINDOW_H

#include "common/files/cells/cells.h"

#ifdef __cplusplus
extern "C" {
#endif

struct window;

/* What happens. Every function gets `context`. */
struct window_events {
  void *context;
  /* A key is pressed: X's name of it, "a", "A", "space", "Escape". */
  void (*key)(void *context, const char *name);
  /* The mouse has moved the camera: its eye, at, up and parallel are new. With
   * `moving`, more will follow; without, it has come to rest. */
  void (*turn)(void *context, const struct hsr_camera *camera, bool moving);
  /* The left button was pressed and released in one place. */
  void (*click)(void *context, int x, int y);
  void (*resize)(void *context, int m, int n);
  /* Some milliseconds have passed: see window_library.tick. */
  void (*tick)(void *context);
};

/* Shapes in space, as lines or surfaces of one colour, or each of its own. */
struct window_shape {
  struct hsr_cells cells;   /* borrowed for the call */
  const unsigned char *rgb; /* 3 a cell; NULL: `colour` */
  unsigned char colour[3];
  bool lines;     /* edges only */
  double opacity; /* 0..1 */
};

struct window_library {
  /* Opens a window of m x n pixels; `events` is borrowed until it is closed.
   * NULL: HSR_E_NOMEM, also if there is no display. */
  struct window *(*open)(const char *title, int m, int n,
                         const struct window_events *events,
                         struct hsr_error *err);
  void (*close)(struct window *window); /* NULL is allowed */

  void (*camera)(struct window *window, const struct hsr_camera *camera);
  /* A picture of the whole window. Copied. */
  void (*picture)(struct window *window, int m, int n,
                  const unsigned char *rgb);
  void (*panel)(struct window *window, const char *text); /* "": none */
  /* With n > 0, the shapes are shown in place of the picture. Copied. */
  void (*shapes)(struct window *window, const struct window_shape *shapes,
                 int n);
  /* Shows all of this. */
  void (*show)(struct window *window);
  void (*tick)(struct window *window, int milliseconds); /* 0: no more */
  /* What the window shows, m x n pixels. False if not all of it is on the
   * screen. */
  bool (*pixels)(struct window *window, int m, int n, unsigned char *rgb);

  /* Handles events until the window is closed or `stop` is called. */
  void (*run)(struct window *window);
  void (*stop)(struct window *window);

  /* As if by a user. Presses the key; presses a button, 1 to 3 from the left,
   * at one place and releases it at another, moving in `steps`; turns the wheel,
   * forward if `by` is positive; waits, and handles events. */
  void (*press)(struct window *window, const char *key);
  void (*drag)(struct window *window, int button, const int from[2],
               const int to[2], int steps);
  void (*wheel)(struct window *window, int by);
  void (*wait)(struct window *window, int milliseconds);
};

#ifdef __cplusplus
}
#endif
#endif
