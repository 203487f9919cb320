/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Judges a drawing of lines that is made of pixels, each with the number of a
 * face one of whose edges it shows.
 *
 * Line        as wide as a pixel, so what it shows is known to within a pixel
 *             or so.
 * Wrong       A pixel is wrongly visible if no visible part of its face's edges
 *             is near: not within LINE_PIXELS_NEAR of its middle. It counts for
 *             the nearest edge of the face.
 *             Every visible part is gone through in steps of a pixel, but for
 *             LINE_PIXELS_NEAR at its ends. A step is wrongly hidden if neither
 *             the pixel there nor one of the eight around it shows any line. */
#ifndef HSR_BENCH_PEERS_LINES_LINE_PIXELS_H
#define HSR_BENCH_PEERS_LINES_LINE_PIXELS_H

#include "common/lines/edges.h"
#include "common/view/view.h"

#include <jansson.h>

#ifdef __cplusplus
extern "C" {
#endif

#define LINE_PIXELS_NEAR 1.5 /* pixels */

struct pixels_verdict {
  size_t edges;                 /* of faces, and in the picture */
  size_t wrong;                 /* of them, in any way */
  size_t visible, hidden;       /* those that are wrongly so */
  size_t visible_px, hidden_px; /* pixels; steps */
  size_t shown_px, walked_px;   /* all pixels that show lines; all steps */
  size_t implied;               /* visible implied edges, not judged */
};

/* Compares m * n pixels with the right drawing. A pixel is HSR_BACKGROUND or a
 * face of the edges' world. HSR_E_NOMEM. */
enum hsr_status
line_pixels_compare(const struct hsr_edges *edges, const struct hsr_view *view,
                    const uint32_t *pixel, const struct hsr_drawing *right,
                    struct pixels_verdict *verdict, struct hsr_error *err);

/* As hsr-peers judge prints it; NULL for lack of memory. */
json_t *line_pixels_json(const struct pixels_verdict *verdict);

#ifdef __cplusplus
}
#endif
#endif
