/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How a picture lies on a page of paper. */
#ifndef HSR_COMMON_PAPER_PAGE_H
#define HSR_COMMON_PAPER_PAGE_H

#include "common/base/status.h"
#include "common/view/view.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What is asked for. All zero: a pixel of the picture is 1/96 inch, and the page
 * is as large as the picture. Lengths are millimetres. The width of pens does
 * not depend on it. */
struct hsr_page {
  double width, height; /* of the page; 0: it follows from the other, and the
                           picture's shape */
  double scale;     /* millimetres on paper for one of the scene, in parallel
                           projection; 0: it follows from the page */
  double unit;      /* what a unit of the scene has, in millimetres; 0: 1 */
  bool crop;        /* the page is as large as what is drawn, with its ink */
  double margin;    /* around what is drawn, or around the picture */
  const char *word; /* how .svg files write the size: "mm"; NULL: in pixels
                           of 1/96 inch */
  double word_size; /* millimetres a unit of `word` has */
};

/* Where it lies. A place (x, y) of the picture, in pixels, is on the page at
 * (left + scale * x, top + scale * y), in pixels of 1/96 inch. */
struct hsr_layout {
  double scale, left, top;
  double width, height; /* of the page, in pixels of 1/96 inch */
};
#define HSR_PIXELS_PER_MM (96 / 25.4)

/* Lays out what is drawn in a view: a box of the picture, low[0] <= x <=
 * high[0], in pixels. HSR_E_USAGE if a scale is asked for in perspective, if a
 * scale and a size are asked for, if margins leave no room, or if the page would
 * be larger than 10 m. */
enum hsr_status hsr_page_lay_out(const struct hsr_page *page,
                                 const struct hsr_view *view,
                                 const double low[2], const double high[2],
                                 struct hsr_layout *layout,
                                 struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
