/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Several drawings on one sheet. */
#ifndef HSR_COMMON_PAPER_SHEET_H
#define HSR_COMMON_PAPER_SHEET_H

#include "common/paper/plot.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Where the views of a sheet stand around the front (ISO 5456-2). Columns and
 * rows are numbered from the left and from the top. False if the name is none of
 * hsr_standard_views.
 *   third angle   what is seen from a side stands on that side;
 *   first angle   it stands on the opposite side, as if the part were rolled. */
enum { HSR_SHEET_COLUMNS = 4, HSR_SHEET_ROWS = 3 };
bool hsr_sheet_cell(const char *view, bool first_angle, int cell[2]);

/* Puts n plots onto one sheet of width x height pixels of the page. Place (x, y)
 * of part k lies at (offset[k][0] + x, offset[k][1] + y). Layers of one id, and
 * in them groups of equal pens, become one. The parts have no filled polygons.
 * *sheet is written in full, and is freed with hsr_plot_free also after a
 * failure; the parts stay. HSR_E_NOMEM. */
enum hsr_status hsr_plot_sheet(struct hsr_plot *sheet,
                               const struct hsr_plot *part, size_t n,
                               const double (*offset)[2], double width,
                               double height, struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
