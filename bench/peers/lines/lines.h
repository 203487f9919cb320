/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What peers that draw lines share: which faces exist, the right drawing, and
 * the comparison with it.
 *
 * Edge        by its number in an hsr_edges. Only edges of faces are judged: no
 *             peer here looks for the lines in which faces penetrate.
 * Part        a stretch of an edge that a peer shows or hides, between two
 *             parameters of docs/correct-drawing.md.
 * Wrong       a point of the right drawing is wrongly visible if the peer shows
 *             it and it is hidden, wrongly hidden if the peer hides it and it
 *             is visible, and missing if the peer does neither. The lengths
 *             are in pixels. A peer's parameters are rounded, and no drawing
 *             shows the hundredth of a pixel: an edge is wrong in one of these
 *             ways if it is so for more than that.
 * Disputed    An edge whose image lies on that of another face's border is
 *             visible if it is moved to one side, and hidden if to the other.
 *             The definition moves it to the right, so it has a right answer. A
 *             peer does not know that, and is told apart if it is wrong only in
 *             such places. These are found in doubles. */
#ifndef HSR_BENCH_PEERS_LINES_LINES_H
#define HSR_BENCH_PEERS_LINES_LINES_H

#include "common/lines/edges.h"
#include "common/view/view.h"

#include <jansson.h>

#ifdef __cplusplus
extern "C" {
#endif

#define LINES_LEAST_WRONG .01 /* pixels */

struct drawn_part {
  uint32_t edge;
  bool visible;
  double t0, t1; /* in this order */
};

enum { WRONGLY_VISIBLE, WRONGLY_HIDDEN, LINES_MISSING, N_LINE_ERRORS };

struct lines_verdict {
  size_t edges;    /* of faces, and in the picture */
  size_t wrong;    /* of them, in any way */
  size_t disputed; /* of the wrong ones: only where they are disputed */
  size_t count[N_LINE_ERRORS];
  double length[N_LINE_ERRORS]; /* also of those that are not counted */
  double visible;               /* length of what is visible */
  size_t implied; /* visible implied edges, which are not judged */
};

/* Whether face f exists in this view. Decided in doubles: a face that the eye
 * is in the plane of has no image, so it does not matter. */
bool lines_face_exists(const struct hsr_world *world,
                       const struct hsr_view *view, uint32_t f);

/* Draws what the line oracle draws. The caller frees *drawing, also after a
 * failure. HSR_E_NOMEM. */
enum hsr_status lines_draw_right(const struct hsr_world *world,
                                 const struct hsr_view *view,
                                 struct hsr_drawing *drawing,
                                 struct hsr_error *err);

/* How long a stretch of an edge is in the picture, in pixels. */
double lines_length(const struct hsr_view *view, const double from[3],
                    const double to[3]);

/* The edge of this name; UINT32_MAX if there is none among those of faces. */
uint32_t lines_find(const struct hsr_edges *edges,
                    const struct hsr_edge_name *name);

/* Compares what a peer has drawn with the right drawing. Sorts the parts, of
 * which those of an edge may overlap: what is shown once is shown. HSR_E_NOMEM.
 */
enum hsr_status lines_compare(const struct hsr_edges *edges,
                              const struct hsr_view *view,
                              struct drawn_part *part, size_t n_parts,
                              const struct hsr_drawing *right,
                              struct lines_verdict *verdict,
                              struct hsr_error *err);

/* A drawing as a plain .svg file holds it: each part is a path of one segment, in
 * the order that it comes in. */
struct lines_plain {
  size_t strokes, bytes; /* without the file's frame */
  double pen_up, at[2];  /* pixels; where the pen is */
};
void lines_plain_add(struct lines_plain *plain, const struct hsr_view *view,
                     const double from[3], const double to[3]);

/* {"strokes", "bytes", "pen_up_px"}; NULL for lack of memory. */
json_t *lines_plain_json(const struct lines_plain *plain);

/* As hsr-peers judge prints it; NULL for lack of memory. */
json_t *lines_verdict_json(const struct lines_verdict *verdict);

#ifdef __cplusplus
}
#endif
#endif
