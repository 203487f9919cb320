/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a line of a drawing shows.
 *
 * Source      contour edges: Appel 1967; Sutherland et al. 1974, "Object-Space
 *             Algorithms". The other classes are those of drawing offices.
 *
 * Around a line lie faces, each on one side of it as the picture has it. The
 * nearest face on either side is what one sees beside the line, if nothing
 * hides it. docs/correct-drawing.md, "Classes", has the definition. */
#ifndef HSR_COMMON_PAPER_LINE_CLASS_H
#define HSR_COMMON_PAPER_LINE_CLASS_H

#ifdef __cplusplus
extern "C" {
#endif

/* In the order in which they win where lines lie on one another. */
enum hsr_line_class {
  HSR_LINE_SILHOUETTE,   /* faces on one side only, two or more: a contour
                            edge */
  HSR_LINE_BOUNDARY,     /* one face only */
  HSR_LINE_INTERSECTION, /* two faces penetrate there: an implied edge */
  HSR_LINE_CREASE,       /* the faces on its two sides make an angle */
  HSR_LINE_COLOUR,       /* they make none, and differ in colour or opacity */
  HSR_LINE_SEAM,         /* nor in that, but they belong to two objects */
  HSR_LINE_SMOOTH,       /* nor in that */
  HSR_N_LINE_CLASSES
};

/* "silhouette", "boundary" ...: static texts. */
const char *hsr_line_class_name(enum hsr_line_class line_class);

/* The class of that name, or HSR_N_LINE_CLASSES. */
enum hsr_line_class hsr_line_class_named(const char *name);

#ifdef __cplusplus
}
#endif
#endif
