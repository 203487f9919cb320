/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Names of lines of the picture plane: of what in the scene a line is the
 * image. docs/visible-polygons.md defines each kind of line and its function,
 * which is 0 on the line. */
#ifndef HSR_COMMON_LINE_NAME_H
#define HSR_COMMON_LINE_NAME_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The kinds of lines, and what the numbers a and b of each mean. */
enum hsr_line_kind {
  HSR_LINE_EDGE,    /* the line of an edge. a: face; b: index in the face of the
                       edge's first corner */
  HSR_LINE_MEETING, /* where the planes of two faces meet. a < b: the faces */
  HSR_LINE_NEAR,    /* where a face's plane has depth near. a: face; b: 0 */
  HSR_LINE_HORIZON, /* the horizon of a face's plane. a: face; b: 0 */
  HSR_LINE_BORDER,  /* a side of the picture. a: enum hsr_border; b: 0 */
  HSR_LINE_ROW      /* the horizontal line through a corner's image. a: face; b:
                       index in the face of the corner */
};

enum hsr_border { HSR_LEFT, HSR_TOP, HSR_RIGHT, HSR_BOTTOM, HSR_N_BORDERS };

struct hsr_line_name {
  enum hsr_line_kind kind;
  uint32_t a, b;
};

#ifdef __cplusplus
}
#endif
#endif
