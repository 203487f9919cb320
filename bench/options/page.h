/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Options of pages of paper. */
#ifndef HSR_BENCH_OPTIONS_PAGE_H
#define HSR_BENCH_OPTIONS_PAGE_H

#include "bench/options/parser.h"
#include "common/paper/page.h"

/* A length on paper with its unit, as 85mm: mm, cm, in, pt or px. Sets *mm. */
bool parse_length(const char *text, double *mm);

enum {
  PAGE_WIDTH = 0x640,
  PAGE_HEIGHT,
  PAGE_SCALE,
  PAGE_UNIT,
  PAGE_CROP,
  PAGE_MARGIN
};
#define PAGE_ARGP_OPTIONS(group)                                               \
  {"width",                                                                    \
   PAGE_WIDTH,                                                                 \
   "LENGTH",                                                                   \
   0,                                                                          \
   "how wide the page of .svg, .pdf, .eps and .dxf files is, as 85mm (or cm, " \
   "in, pt, px); lines are as wide as on any other page (standard: a pixel, "  \
   "1/96 in, for each sample)",                                                \
   group},                                                                     \
      {"height", PAGE_HEIGHT, "LENGTH", 0, "how high it is", group},           \
      {"scale",                                                                \
       PAGE_SCALE,                                                             \
       "A:B",                                                                  \
       0,                                                                      \
       "draw to scale, as 1:20, in parallel projection",                       \
       group},                                                                 \
      {"unit",                                                                 \
       PAGE_UNIT,                                                              \
       "LENGTH",                                                               \
       0,                                                                      \
       "how long one unit of the scene is, for --scale, as 1m or 25.4mm "      \
       "(standard: 1mm)",                                                      \
       group},                                                                 \
      {"crop", PAGE_CROP, NULL, 0, "the page is as large as what is drawn",    \
       group},                                                                 \
  {                                                                            \
    "margin", PAGE_MARGIN, "LENGTH", 0, "leave so much paper on each side",    \
        group                                                                  \
  }
/* ARGP_ERR_UNKNOWN if `key` is none of them. *page is all zero at first. */
error_t parse_page_option(struct hsr_page *page, int key, char *arg,
                          struct option_base *base);

#endif
