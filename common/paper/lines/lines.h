/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The lines of a drawing, each once, and what they show: the step from an
 * answer, which lists edges, to paper. docs/correct-drawing.md, "On paper", has
 * the definition.
 *
 * Straight    edges whose images lie on one line of the picture are found
 *             exactly. Their intervals are laid over one another. Where several
 *             lie, one line is drawn: the most visible, and among equals the
 *             first of enum hsr_line_class.
 * Class       edges that lie on one another in space share their faces. So the
 *             border of one face along another's is no border on paper.
 * Nodes       are the ends of lines. Ends at one place of the picture are one
 *             node if that place has a name: a vertex, the end of an implied
 *             edge, or a change of visibility on one edge. Places of names are
 *             compared exactly. A change of visibility is known to 1e-12 of its
 *             parameter. If a vertex or the end of an implied edge has its image
 *             there on the same line, the change is at that. Two ends on one
 *             line of the picture are one if their bounds overlap and their
 *             images are within 2^-20 pixels. */
#ifndef HSR_COMMON_PAPER_LINES_H
#define HSR_COMMON_PAPER_LINES_H

#include "common/lines/drawing.h"
#include "common/paper/lines/line_class.h"
#include "common/paper/lines/line_style.h"
#include "common/scene/world.h"
#include "common/view/view.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_paper_line {
  uint32_t from, to; /* nodes */
  uint32_t straight; /* lines of one number lie on one line of the picture */
  uint32_t object;   /* of the scene: that of its edge's first face */
  uint32_t invisibility;
  uint32_t pen; /* of the pens */
  enum hsr_line_class line_class;
};

struct hsr_paper_lines {
  struct hsr_paper_line *line;
  size_t n;
  /* Places in the picture, in pixels, as of view.h; rounded, and clamped to the
   * picture. */
  double (*node)[2];
  size_t n_nodes;
};

/* Finds the lines of a drawing of the whole view, which is in the order of the
 * definition. Those without a pen are left out before they are laid over one
 * another. *lines is written in full, and is freed with hsr_lines_free also
 * after a failure. HSR_E_NOMEM; HSR_E_INTERNAL. */
enum hsr_status hsr_lines_find(struct hsr_paper_lines *lines,
                               const struct hsr_drawing *drawing,
                               const struct hsr_world *world,
                               const struct hsr_view *view, double crease,
                               const struct hsr_line_pens *pens,
                               struct hsr_error *err);
void hsr_lines_free(struct hsr_paper_lines *lines);

/* Finds the class of each interval's edge, enum hsr_line_class, by the edge's own
 * faces; and its object, that of the edge's first face. Both arrays hold
 * drawing->n, of the caller. HSR_E_NOMEM; HSR_E_INTERNAL. */
enum hsr_status hsr_lines_classify(const struct hsr_drawing *drawing,
                                   const struct hsr_world *world,
                                   const struct hsr_view *view, double crease,
                                   unsigned char *line_class, uint32_t *object,
                                   struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
