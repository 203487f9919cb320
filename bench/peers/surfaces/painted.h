/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Paints the polygons of a Sketch drawing at the samples of a picture. */
#ifndef HSR_BENCH_PEERS_SURFACES_PAINTED_H
#define HSR_BENCH_PEERS_SURFACES_PAINTED_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* So many of the drawing's units are a pixel. */
enum { PAINTED_UNITS = 100 };

/* Reads \pspolygon[fillcolor=fID,...](x,y)..., one a line. Coordinates have at
 * most three digits after the point. y is upwards, and 0 at the picture's upper
 * border. Each polygon is painted over those before it, by parity. ids[j * m +
 * i] becomes that of the last polygon that has sample (i, j), or
 * HSR_BACKGROUND. All other lines are passed over. Throws std::bad_alloc. */
void paint_drawing(const char *text, int m, int n, uint32_t *ids);

#ifdef __cplusplus
}
#endif
#endif
