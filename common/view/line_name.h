/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lines of the picture plane, named by what of the scene they are the image of.
 * docs/visible-polygons.md defines them, and a function for each. */
#ifndef HSR_COMMON_LINE_NAME_H
#define HSR_COMMON_LINE_NAME_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum hsr_line_kind {
  HSR_LINE_EDGE,    /* a: face; b: index in it of the edge's first corner */
  HSR_LINE_MEETING, /* a < b: faces */
  HSR_LINE_NEAR,    /* a: face; b: 0 */
  HSR_LINE_HORIZON, /* a: face; b: 0 */
  HSR_LINE_BORDER,  /* a: enum hsr_border; b: 0 */
  HSR_LINE_ROW      /* a: face; b: index in it of a corner */
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
