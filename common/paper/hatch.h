/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Faces hatched by light, for pens.
 *
 * A region is covered by parallel lines, clipped to it. The darker the face, the
 * nearer they lie: of a pen of width d at a distance s, d/s of the paper is
 * black. Lines of one direction and distance lie on one grid of the page, so
 * that faces which meet are hatched through. A face that is turned from the
 * light more gets a second direction. Clipped at the rounded visible polygons,
 * which are exact: docs/visible-polygons.md. */
#ifndef HSR_COMMON_PAPER_HATCH_H
#define HSR_COMMON_PAPER_HATCH_H

#include "common/paper/plot.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Appends the hatches of the subject's polygons to a plot that is laid out, as
 * strokes of a layer "hatch", below all others. Of the pen, the width and the
 * colour count. HSR_E_NOMEM. */
enum hsr_status hsr_plot_hatch(struct hsr_plot *plot,
                               const struct hsr_plot_subject *subject,
                               const struct hsr_line_pen *pen,
                               struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
