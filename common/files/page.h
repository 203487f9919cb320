/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef HSR_COMMON_PAGE_H
#define HSR_COMMON_PAGE_H

/* How large a page of .svg or .pdf is. Its shape is that of the picture, and its
 * pens are as wide as on any other. */
struct hsr_page {
  double width;     /* 0: a pixel of 1/96 inch for each of the picture */
  const char *unit; /* of the width, as .svg files write it: "mm" */
  double pixels;    /* a unit, at 96 an inch */
};

#endif
