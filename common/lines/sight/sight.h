/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Edges against faces, as one eye sees them: the exact services by which the
 * hidden-line algorithms make their comparisons.
 *
 * Source      Sutherland et al. 1974, "Edge Intersections", "Object-Space
 *             Algorithms"; docs/correct-drawing.md.
 * Displaced   the edge that may be hidden is displaced as a whole, by the
 *             infinitesimal of the definition: P' is point P displaced, A'B'
 *             the edge. The faces and edges that hide it stay where they are.
 *             So two images never touch, and there are no special cases: where
 *             figure 17 shows one, the next sign of the same determinant
 *             decides.
 * Together    events are compared by their places on AB. Events at one place of
 *             AB happen at once, even if their places on A'B' differ.
 * Exact       a filter in doubles decides, with a bound that is proved in
 *             sight.c; else intervals; else exact numbers, which tally->exact
 *             counts.
 * Regular     a face that exists, is simple (common/lines/edges.h) and lies
 *             wholly beyond near. The images of its edges and its plane tell
 *             all about it. Any other face that exists is loose: hsr_sight_face
 *             handles it, for one edge at a time.
 *
 * A sight belongs to one view and one thread, and does not move in memory. */
#ifndef HSR_COMMON_SIGHT_H
#define HSR_COMMON_SIGHT_H

#include "common/base/count.h"
#include "common/lines/edges.h"
#include "common/exact/screen.h"
#include "common/view/view.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A line of the scene: through points a and b or, if of_planes, where the
 * planes of faces a and b meet. */
struct hsr_sight_line {
  bool of_planes;
  uint32_t a, b;
};

struct hsr_sight {
  const struct hsr_edges *edges;
  const struct hsr_world *world;
  const struct hsr_view *view;
  struct hsr_tally *tally;

  const struct hsr_sight_line *line; /* of HSR_AT_LINE; borrowed, or NULL */

  /* Points. */
  double *sx,
      *sy;   /* as in common/exact/screen.h; NaN where not known so well */
  double *q; /* 1/w, within 2^-42 of itself where sx is not NaN; in parallel -t,
                  within q_error */
  double q_error;
  bool *ahead; /* w > near */

  /* Faces. */
  bool *exists;
  signed char *facing; /* +1 the eye is in front, -1 behind; 0: the face does
                          not exist, or its plane holds the eye, so that it
                          hides nothing */
  bool *regular;
  uint32_t *faces, n_faces; /* the regular ones */
  uint32_t *loose, n_loose;

  struct hsr_sight_numbers *numbers; /* of the exact services */
};

/* Sets up all of the above, with arrays in the arena. Freed with
 * hsr_sight_free, also after a failure. `edges`, `view` and `tally` are
 * borrowed until then. HSR_E_NOMEM. */
enum hsr_status hsr_sight_init(struct hsr_sight *sight,
                               const struct hsr_edges *edges,
                               const struct hsr_view *view,
                               struct hsr_arena *arena,
                               struct hsr_tally *tally);
void hsr_sight_free(struct hsr_sight *sight);

/* Edge e and point p as subjects of a step. An edge of faces is named without a
 * face. An end of an implied edge is no vertex: it is HSR_NOTHING. */
static inline struct hsr_subject hsr_edge_subject(const struct hsr_edges *edges,
                                                  uint32_t e) {
  const struct hsr_edge_name *name = &edges->name[e];
  return name->implied ? HSR_IMPLIED(name->a, name->b, name->part)
                       : HSR_EDGE(edges->a[e], edges->b[e], HSR_NO_ID);
}
static inline struct hsr_subject
hsr_point_subject(const struct hsr_edges *edges, uint32_t p) {
  return p < edges->world->mesh.n_vertices ? HSR_VERTEX(p) : HSR_NOTHING;
}

/* --- Where images lie ----------------------------------------------------- */

/* What the filters below fall back to; call the filters instead. */
int hsr_sight_side_exact(const struct hsr_sight *sight, uint32_t c, uint32_t d,
                         uint32_t p);
int hsr_sight_line_side_exact(const struct hsr_sight *sight, uint32_t a,
                              uint32_t b, uint32_t p);
int hsr_sight_row_side_exact(const struct hsr_sight *sight, uint32_t p,
                             uint32_t q);

/* The side of the line c d that point p is on, on the screen: a determinant,
 * and in *bound a bound of its error. NaN if not all three points are known. */
static inline double hsr_sight_turn(const struct hsr_sight *sight, uint32_t c,
                                    uint32_t d, uint32_t p, double *bound) {
  double dx = sight->sx[d] - sight->sx[c], dy = sight->sy[d] - sight->sy[c];
  double hx = sight->sx[p] - sight->sx[c], hy = sight->sy[p] - sight->sy[c];
  *bound = 4 * HSR_DELTA * (fabs(dx) + fabs(dy) + fabs(hx) + fabs(hy)) +
           16 * HSR_DELTA * HSR_DELTA;
  return dx * hy - dy * hx;
}

/* The side of the line from point c to point d that P' is on: the sign of
 * det(C - E, D - E, P' - E). 0 only if c, d and the eye are on a line. */
static inline int hsr_sight_side(const struct hsr_sight *sight, uint32_t c,
                                 uint32_t d, uint32_t p) {
  double bound, turn = hsr_sight_turn(sight, c, d, p, &bound);
  if (turn > bound)
    return 1;
  if (turn < -bound)
    return -1;
  return hsr_sight_side_exact(sight, c, d, p);
}

/* The side of the displaced line from A' to B' that point P is on: the sign of
 * det(A' - E, B' - E, P - E). 0 only if a, b and the eye are on a line. */
static inline int hsr_sight_line_side(const struct hsr_sight *sight, uint32_t a,
                                      uint32_t b, uint32_t p) {
  double bound, turn = hsr_sight_turn(sight, a, b, p, &bound);
  if (turn > bound)
    return 1;
  if (turn < -bound)
    return -1;
  return hsr_sight_line_side_exact(sight, a, b, p);
}

/* On the screen, is point q below P' (+1) or above (-1)? Both are ahead. */
static inline int hsr_sight_row_side(const struct hsr_sight *sight, uint32_t p,
                                     uint32_t q) {
  double below = sight->sy[q] - sight->sy[p];
  if (below > 2 * HSR_DELTA)
    return 1;
  if (below < -2 * HSR_DELTA)
    return -1;
  return hsr_sight_row_side_exact(sight, p, q);
}

/* Bounds of the image of a box, in pixels, and of q in the box. They are
 * unlimited where the image is not known. hsr_sight_enclose: lo and hi are
 * opposite corners of the box. */
struct hsr_extent {
  double x0, y0, x1, y1;
  double farthest, nearest;
};
struct hsr_extent hsr_sight_enclose(const struct hsr_sight *sight,
                                    const double lo[3], const double hi[3]);

/* --- What lies before what ------------------------------------------------ */

/* Is P' strictly beyond the plane of face f, as the eye sees it? f can hide. */
bool hsr_sight_behind(const struct hsr_sight *sight, uint32_t f, uint32_t p);

/* Does regular face f cover the direction of P'? p is ahead. */
bool hsr_sight_covers(const struct hsr_sight *sight, uint32_t f, uint32_t p);

/* Is edge c strictly nearer than A'B', the displaced edge e, where their images
 * cross? They do cross. */
bool hsr_sight_nearer(const struct hsr_sight *sight, uint32_t e, uint32_t c);

/* A corner of a regular face is at the end p of edge e, which is not a side of
 * the face. Does the face hide e, both taken close to p? If e lies in the plane
 * of the face, its displacement puts it before the face or behind. */
bool hsr_sight_corner_hides(const struct hsr_sight *sight, uint32_t e,
                            uint32_t p, struct hsr_corner corner);

/* --- Events along an edge ------------------------------------------------- */

enum hsr_event_at {
  HSR_AT_START, /* t = 0 */
  HSR_AT_END,   /* t = 1 */
  HSR_AT_EDGE,  /* crosses the image of edge `subject` */
  HSR_AT_SIDE,  /* crosses the image of the side of a face that ends in corner
                   `subject` of world->vertex */
  HSR_AT_LINE,  /* crosses the image of line `subject` of sight->line */
  HSR_AT_ROW,   /* is at the height of the image of vertex `subject` */
  HSR_AT_PLANE, /* meets the plane of face `subject` */
  HSR_AT_NEAR,  /* is where the plane of face `subject` meets that of near */
  HSR_AT_BORDER /* is at border `subject` of what is in the picture */
};

/* Something that happens at a place of an edge. */
struct hsr_sight_event {
  double t;     /* in [0, 1] */
  double error; /* of t, at most; 1e-13 of it or less */
  enum hsr_event_at at;
  uint32_t subject;
  int change;    /* of the number of hiding faces, as t grows */
  uint32_t face; /* that begins or ceases to hide the edge, if it is one face:
                    by hsr_sight_face or hsr_sight_pierces */
};

/* Fills t and error of an event, whose place is on edge e. */
void hsr_sight_locate(const struct hsr_sight *sight, uint32_t e,
                      struct hsr_sight_event *event);

/* The order of two events along edge e: -1, 0 (one place) or +1. */
int hsr_sight_compare(const struct hsr_sight *sight, uint32_t e,
                      const struct hsr_sight_event *a,
                      const struct hsr_sight_event *b);

/* Finds the part of edge e that is in the picture, between *from and *to. False
 * if there is none, or e has no image. */
bool hsr_sight_picture(const struct hsr_sight *sight, uint32_t e,
                       struct hsr_sight_event *from,
                       struct hsr_sight_event *to);

/* Does the plane of face f hold edge e? */
bool hsr_sight_in_plane(const struct hsr_sight *sight, uint32_t e, uint32_t f);

/* The side of the plane of face f that the eye is on: +1 in front, -1 behind, 0
 * on it. The face need not exist. */
int hsr_sight_eye_side(const struct hsr_sight *sight, uint32_t f);

/* Narrows the part of edge e between *from and *to, which is in the picture, to
 * one side of a plane or of a line's image: in front of it (+1) or behind it
 * (-1). False if nothing is left.
 *
 * HSR_AT_PLANE: the plane of face `subject`. An edge in that plane is on
 * neither side of it.
 * HSR_AT_LINE: the image of line `subject`. The side of a line through two
 * points is that of hsr_sight_side. The side of the line in which the planes of
 * faces a and b meet is the sign of h_a(E) s_b(P) - h_b(E) s_a(P), where h is
 * the height of the eye above a plane and s is the height of P minus that of
 * the eye. An edge whose image lies on that of the line is displaced, and so is
 * on one side. */
bool hsr_sight_narrow(const struct hsr_sight *sight, uint32_t e,
                      enum hsr_event_at at, uint32_t subject, int side,
                      struct hsr_sight_event *from, struct hsr_sight_event *to);

/* Finds where A'B', the displaced edge e, pierces regular face f. False if it
 * does not. e may touch f, but is no side of f, and neither end is a corner of
 * f. */
bool hsr_sight_pierces(const struct hsr_sight *sight, uint32_t e, uint32_t f,
                       struct hsr_sight_event *event);

/* Where does face f hide edge e? f is any face that can hide: e may be a side
 * of it or lie in its plane. Sets *hidden to whether f hides e where e begins
 * to be ahead. Appends the events where that changes, with changes +1 and -1,
 * to `events`, an array of struct hsr_sight_event in the arena. HSR_E_NOMEM. */
enum hsr_status hsr_sight_face(const struct hsr_sight *sight, uint32_t e,
                               uint32_t f, struct hsr_arena *arena,
                               struct hsr_growing *events, bool *hidden);

#ifdef __cplusplus
}
#endif
#endif
