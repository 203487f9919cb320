/* SPDX-License-Identifier: GPL-3.0-or-later */
/* OpenGL by llvmpipe, Mesa's software renderer, on EGL's surfaceless platform:
 * without a window or a display.
 *
 * OSMesa, the older way to llvmpipe, takes the same time. But its library
 * defines OpenGL's functions itself, so it cannot share a program with VTK,
 * which uses the system's. Mesa 25.1 no longer has it. */
#ifndef HSR_BENCH_PEERS_SHARED_OFFSCREEN_H
#define HSR_BENCH_PEERS_SHARED_OFFSCREEN_H

#include "common/base/status.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

struct offscreen {
  void *display, *context; /* EGL's; NULL until there is one */
};

/* Makes a context and makes it current: OpenGL 3.3's core profile or, if
 * `compatible`, the compatibility profile. It rasterises on `threads` threads.
 * To be closed also after a failure. HSR_E_INTERNAL, HSR_E_NOMEM. */
enum hsr_status offscreen_open(struct offscreen *offscreen, bool compatible,
                               long threads, struct hsr_error *err);

/* Makes m x n pixels of four bytes, with 24 bits of depth, to draw on and to
 * read from. They are freed with the context. HSR_E_INTERNAL. */
enum hsr_status offscreen_raster(int m, int n, struct hsr_error *err);

void offscreen_close(struct offscreen *offscreen);

/* Writes "Mesa 22.3.6" into `text`, which holds `size` bytes; or an empty text
 * if no context can be made. */
void offscreen_version(char *text, int size);

#ifdef __cplusplus
}
#endif
#endif
