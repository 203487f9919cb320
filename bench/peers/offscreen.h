/* SPDX-License-Identifier: GPL-3.0-or-later */
/* OpenGL by llvmpipe, Mesa's software renderer, without a window or a display:
 * EGL's surfaceless platform.
 *
 * OSMesa, the older way to llvmpipe, takes the same time, but its library
 * brings OpenGL's functions itself and so cannot share a program with VTK,
 * which asks the system's; Mesa 25.1 has it no more. */
#ifndef HSR_BENCH_PEERS_OFFSCREEN_H
#define HSR_BENCH_PEERS_OFFSCREEN_H

#include "common/base/status.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

struct offscreen {
  void *display, *context; /* EGL's; NULL until there is one */
};

/* A context, current from now on: of OpenGL 3.3's core or, if `compatible`,
 * with all that OpenGL ever had. Rasterised on so many threads. To be closed
 * also after a failure. HSR_E_INTERNAL, HSR_E_NOMEM. */
enum hsr_status offscreen_open(struct offscreen *offscreen, bool compatible,
                               long threads, struct hsr_error *err);

/* Makes m x n pixels of four bytes, with 24 bits of depth, to draw on and to
 * read from. They go with the context. HSR_E_INTERNAL. */
enum hsr_status offscreen_raster(int m, int n, struct hsr_error *err);

void offscreen_close(struct offscreen *offscreen);

/* "Mesa 22.3.6"; empty if no context can be had. The text holds `size`. */
void offscreen_version(char *text, int size);

#ifdef __cplusplus
}
#endif
#endif
