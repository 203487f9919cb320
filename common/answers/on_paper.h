/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Answers as drawings on paper. */
#ifndef HSR_COMMON_ANSWERS_ON_PAPER_H
#define HSR_COMMON_ANSWERS_ON_PAPER_H

#include "common/answers/answer.h"
#include "common/lines/polygons.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Writes lines, faces, or lines over faces to a file, as `showing` says: .svg
 * .pdf .eps .dxf, or the pixels of the picture. Either of `drawing` and
 * `polygons` may be NULL. Lines and hatches have a sheet of paper behind them
 * only in pixels, or if there is a background; filled faces always have one. Sets
 * showing->drawn. HSR_E_USAGE if the page is none (hsr_page_lay_out); HSR_E_INPUT
 * if the file cannot be written; HSR_E_NOMEM. */
enum hsr_status hsr_show_on_paper(const struct hsr_showing *showing,
                                  const struct hsr_drawing *drawing,
                                  const struct hsr_polygons *polygons,
                                  const char *path, struct hsr_error *err);

/* The same to n files of .svg .pdf .eps .dxf. What they show is found once. */
enum hsr_status hsr_write_on_paper(const struct hsr_showing *showing,
                                   const struct hsr_drawing *drawing,
                                   const struct hsr_polygons *polygons,
                                   const char *const *path, size_t n,
                                   struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
