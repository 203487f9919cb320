/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The size of a page. */
#ifndef HSR_COMMON_PAGE_H
#define HSR_COMMON_PAGE_H

/* The size of a page of .svg or .pdf. Its shape is that of the picture. The
 * width of pens does not depend on it. */
struct hsr_page {
  double width;     /* in `unit`; 0: each pixel of the picture is 1/96 inch */
  const char *unit; /* as .svg files write it: "mm" */
  double pixels;    /* how many pixels of 1/96 inch a unit has */
};

#endif
