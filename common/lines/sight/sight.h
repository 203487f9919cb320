/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Edges against faces in one view: the exact services that the hidden-line
 * algorithms use for their comparisons.
 *
 * Source      Sutherland et al. 1974, "Edge Intersections", "Object-Space
 *             Algorithms"; docs/correct-drawing.md.
 * Displaced   the edge that may be hidden is displaced as a whole, by the
 *             infinitesimal of the definition. P' is the displaced point P, and
 *             A'B' the displaced edge AB. The faces and edges that may hide it
 *             are not displaced. So two images never touch, and there are no
 *             special cases. Where figure 17 shows a special case, the next
 *             sign of the same determinant decides.
 * Together    events are compared by their places on AB. Events at one place of
 *             AB happen at once, even if their places on A'B' differ.
 * Exact       a filter in doubles decides first, with an error bound that is
 *             proved in sight.c. Intervals are next. Exact numbers decide the
 *             rest, which tally->exact counts.
 * Regular     a face is regular if it exists, is simple (common/lines/edges.h)
 *             and lies wholly beyond near. The images of its edges and its
 *             plane are then enough to answer every question about it. Any
 *             other face that exists is loose. hsr_sight_face handles it, for
 *             one edge at a time.
 * Errors      if memory runs out, tally->out_of_memory is set and the result is
 *             meaningless.
 *
 * A sight is for one view and one thread. It must not be copied or moved. */
#ifndef HSR_COMMON_SIGHT_H
#define HSR_COMMON_SIGHT_H

#include "common/base/count.h"
#include "common/lines/edges.h"
#include "common/exact/screen.h"
#include "common/view/view.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A line of the scene. It passes through points a and b or, if of_planes, it is
 * the line where the planes of faces a and b meet. */
struct hsr_sight_line {
  bool of_planes;
  uint32_t a, b;
};

struct hsr_sight {
  const struct hsr_edges *edges; /* borrowed, as the next three */
  const struct hsr_world *world;
  const struct hsr_view *view;
  struct hsr_tally *tally;

  const struct hsr_sight_line *line; /* the lines of HSR_AT_LINE, set by the
                                        caller; borrowed; NULL: none */

  /* By point of `edges`. */
  double *sx, *sy; /* as in common/exact/screen.h: pixels; NaN if not known well
                      enough */
  double *q;       /* 1/w, with a relative error of 2^-42 if sx is not NaN; in
                      parallel projection -t, with an error of q_error */
  double q_error;
  bool *ahead; /* the depth of the point is above near */

  /* By face. */
  bool *exists;
  signed char *facing; /* +1: the eye is in front; -1: behind; 0: the face does
                          not exist, or its plane holds the eye. Then it hides
                          nothing */
  bool *regular;

  uint32_t *faces, n_faces; /* the regular faces, ascending */
  uint32_t *loose, n_loose; /* the loose faces, ascending */

  struct hsr_sight_numbers *numbers; /* for the exact services; owned */
};

/* Sets up a sight for all edges and faces. Its arrays are in the arena.
 * `edges`, `view`, `tally` and the arena are borrowed and must outlive it. It
 * is freed with hsr_sight_free also after a failure. HSR_E_NOMEM. */
enum hsr_status hsr_sight_init(struct hsr_sight *sight,
                               const struct hsr_edges *edges,
                               const struct hsr_view *view,
                               struct hsr_arena *arena,
                               struct hsr_tally *tally);

/* Frees what is not in the arena. */
void hsr_sight_free(struct hsr_sight *sight);

/* Return edge e or point p as a subject of a step (common/base/count.h). The
 * subject of an edge of faces has no face. The end of an implied edge is not a
 * vertex, so its subject is HSR_NOTHING. */
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

/* The exact parts of the filters below, which call them if in doubt. Call the
 * filters instead. */
int hsr_sight_side_exact(const struct hsr_sight *sight, uint32_t c, uint32_t d,
                         uint32_t p);
int hsr_sight_line_side_exact(const struct hsr_sight *sight, uint32_t a,
                              uint32_t b, uint32_t p);
int hsr_sight_row_side_exact(const struct hsr_sight *sight, uint32_t p,
                             uint32_t q);

/* Returns a determinant whose sign is the side of the line from c to d on which
 * point p lies on the screen. *bound becomes a bound of its error. Both are NaN
 * if one of the three points has no screen coordinates. */
static inline double hsr_sight_turn(const struct hsr_sight *sight, uint32_t c,
                                    uint32_t d, uint32_t p, double *bound) {
  double dx = sight->sx[d] - sight->sx[c], dy = sight->sy[d] - sight->sy[c];
  double hx = sight->sx[p] - sight->sx[c], hy = sight->sy[p] - sight->sy[c];
  *bound = 4 * HSR_DELTA * (fabs(dx) + fabs(dy) + fabs(hx) + fabs(hy)) +
           16 * HSR_DELTA * HSR_DELTA;
  return dx * hy - dy * hx;
}

/* Returns the side of the line from point c to point d on which P' lies: the
 * sign of det(C - E, D - E, P' - E). 0 only if c, d and the eye are on one
 * line. */
static inline int hsr_sight_side(const struct hsr_sight *sight, uint32_t c,
                                 uint32_t d, uint32_t p) {
  double bound, turn = hsr_sight_turn(sight, c, d, p, &bound);
  if (turn > bound)
    return 1;
  if (turn < -bound)
    return -1;
  return hsr_sight_side_exact(sight, c, d, p);
}

/* Returns the side of the displaced line from A' to B' on which point P lies:
 * the sign of det(A' - E, B' - E, P - E). 0 only if a, b and the eye are on one
 * line. */
static inline int hsr_sight_line_side(const struct hsr_sight *sight, uint32_t a,
                                      uint32_t b, uint32_t p) {
  double bound, turn = hsr_sight_turn(sight, a, b, p, &bound);
  if (turn > bound)
    return 1;
  if (turn < -bound)
    return -1;
  return hsr_sight_line_side_exact(sight, a, b, p);
}

/* Returns +1 if point q is below P' on the screen, -1 if it is above. Both are
 * ahead. */
static inline int hsr_sight_row_side(const struct hsr_sight *sight, uint32_t p,
                                     uint32_t q) {
  double below = sight->sy[q] - sight->sy[p];
  if (below > 2 * HSR_DELTA)
    return 1;
  if (below < -2 * HSR_DELTA)
    return -1;
  return hsr_sight_row_side_exact(sight, p, q);
}

/* Bounds of the image of a box, in pixels, and of q in it. They are infinite if
 * the image is not known. */
struct hsr_extent {
  double x0, y0, x1, y1;
  double farthest, nearest; /* the least and the greatest q */
};

/* Returns the bounds of the box with the corners lo and hi, in world units. */
struct hsr_extent hsr_sight_enclose(const struct hsr_sight *sight,
                                    const double lo[3], const double hi[3]);

/* --- What lies before what ------------------------------------------------ */

/* Whether P' is strictly on the far side of the plane of face f, as seen from
 * the eye. The facing of f is not 0. */
bool hsr_sight_behind(const struct hsr_sight *sight, uint32_t f, uint32_t p);

/* Whether regular face f covers the direction of P'. p is ahead. */
bool hsr_sight_covers(const struct hsr_sight *sight, uint32_t f, uint32_t p);

/* Whether edge c is strictly nearer than A'B', the displaced edge e, where
 * their images cross. The images must cross. */
bool hsr_sight_nearer(const struct hsr_sight *sight, uint32_t e, uint32_t c);

/* Whether a face hides edge e close to the end p of e. `corner` is a corner of
 * the face at p. The face is regular and not a side of e. If e lies in the
 * plane of the face, its displacement puts it before or behind the face. */
bool hsr_sight_corner_hides(const struct hsr_sight *sight, uint32_t e,
                            uint32_t p, struct hsr_corner corner);

/* --- Events along an edge ------------------------------------------------- */

/* What defines the place of an event along an edge. */
enum hsr_event_at {
  HSR_AT_START, /* the edge begins, t = 0 */
  HSR_AT_END,   /* the edge ends, t = 1 */
  HSR_AT_EDGE,  /* the edge crosses the image of edge `subject` */
  HSR_AT_SIDE,  /* it crosses the image of a face's edge, the one that ends in
                   corner `subject`, an index into world->mesh.vertex */
  HSR_AT_LINE,  /* it crosses the image of line[subject] of the sight */
  HSR_AT_ROW,   /* it is at the height of the image of vertex `subject` */
  HSR_AT_PLANE, /* it meets the plane of face `subject` */
  HSR_AT_NEAR,  /* the plane of face `subject` has depth near there */
  HSR_AT_BORDER /* it crosses border `subject` of the visible space: near or a
                   side of the picture (sight_numbers.h) */
};

/* Something that happens at a place of an edge. */
struct hsr_sight_event {
  double t;     /* the place, in [0, 1] */
  double error; /* a bound of the error of t; at most 1e-13 t, unless
                   hsr_sight_find_half found the place */
  enum hsr_event_at at;
  uint32_t subject;
  int change;    /* of the number of hiding faces, as t grows */
  uint32_t face; /* the face that begins or ceases to hide the edge. Set by
                    hsr_sight_face and hsr_sight_pierces only */
};

/* Fills t and error of an event on edge e from its `at` and `subject`. */
void hsr_sight_locate(const struct hsr_sight *sight, uint32_t e,
                      struct hsr_sight_event *event);

/* Compares the places of two events along edge e. Returns -1 if a comes first,
 * 0 if both are at one place, +1 if b comes first. */
int hsr_sight_compare(const struct hsr_sight *sight, uint32_t e,
                      const struct hsr_sight_event *a,
                      const struct hsr_sight_event *b);

/* Finds the part of edge e that is in the picture, and sets *from and *to to
 * its ends. False if no part is, or if the eye is on the line of e, so that e
 * has no image. */
bool hsr_sight_picture(const struct hsr_sight *sight, uint32_t e,
                       struct hsr_sight_event *from,
                       struct hsr_sight_event *to);

/* Whether edge e lies in the plane of face f. */
bool hsr_sight_in_plane(const struct hsr_sight *sight, uint32_t e, uint32_t f);

/* Returns the side of the plane of face f that the eye is on: +1 in front, -1
 * behind, 0 on it. The face need not exist. */
int hsr_sight_eye_side(const struct hsr_sight *sight, uint32_t f);

/* The part of an edge that is on one side of a plane or of the image of a line:
 * none of it, all of it, what follows `at`, or what precedes `at`. */
struct hsr_sight_half {
  enum { HSR_HALF_NONE, HSR_HALF_ALL, HSR_HALF_AFTER, HSR_HALF_BEFORE } part;
  struct hsr_sight_event at; /* of AFTER and BEFORE. Its t may be rough, since
                   most of what is found here is narrowed again:
                   hsr_sight_locate makes it good */
};

/* Finds the part of edge e that is on one side of a plane or of the image of a
 * line: +1 or -1.
 *
 * HSR_AT_PLANE: the plane of face `subject`; +1 is in front of it. An edge in
 * the plane is on neither side.
 * HSR_AT_LINE: the image of line `subject`. If the line passes through two
 * points, the side is that of hsr_sight_side. If it is where the planes of
 * faces a and b meet, the side is the sign of h_a(E) s_b(P) - h_b(E) s_a(P).
 * Here h is the height of the eye above a plane, and s is the height of P minus
 * that of the eye. An edge whose image lies on that of the line is on one side,
 * since it is displaced. */
struct hsr_sight_half hsr_sight_find_half(const struct hsr_sight *sight,
                                          uint32_t e, enum hsr_event_at at,
                                          uint32_t subject, int side);

/* Narrows the part of edge e between *from and *to, which is in the picture, to
 * a half of e. False if nothing is left; *from and *to are then
 * meaningless. */
bool hsr_sight_narrow(const struct hsr_sight *sight, uint32_t e,
                      const struct hsr_sight_half *half,
                      struct hsr_sight_event *from, struct hsr_sight_event *to);

/* Whether doubles make it certain that hsr_sight_find_half would find that none
 * of edge e is on that side. */
bool hsr_sight_excludes(const struct hsr_sight *sight, uint32_t e,
                        enum hsr_event_at at, uint32_t subject, int side);

/* Finds where A'B', the displaced edge e, pierces regular face f. False if it
 * does not. e may touch f, but f must not be a side of e, and neither end of e
 * may be a corner of f. */
bool hsr_sight_pierces(const struct hsr_sight *sight, uint32_t e, uint32_t f,
                       struct hsr_sight_event *event);

/* Finds where face f hides edge e. f is any face whose facing is not 0; it may
 * be a side of e, and e may lie in its plane. Sets *hidden to whether f hides e
 * at the place where e begins to be ahead. Appends the events at which that
 * changes, with changes +1 and -1, to `events`, an array of struct
 * hsr_sight_event in the arena. HSR_E_NOMEM. */
enum hsr_status hsr_sight_face(const struct hsr_sight *sight, uint32_t e,
                               uint32_t f, struct hsr_arena *arena,
                               struct hsr_growing *events, bool *hidden);

#ifdef __cplusplus
}
#endif
#endif
