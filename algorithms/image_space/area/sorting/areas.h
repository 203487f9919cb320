/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Areas of the picture plane: polygons with holes, convex or not, whose sides
 * lie on named lines. They are what the Weiler-Atherton algorithm clips.
 *
 * Source      K. Weiler and P. Atherton, "Hidden surface removal using polygon
 *             area sorting", SIGGRAPH 1977, as described by Greene 1995, "The
 *             Weiler-Atherton Algorithm", pp. 10-11.
 * Notation    Area, polygon -> struct hsr_area. Its border is one or more
 *             cycles of struct hsr_border_edge: the outer cycle and its holes.
 *             Named line -> a line known by a number
 *             (common/exact/named_lines.h). An edge is directed: it runs along
 *             its line with the area on the side where sign times the line's
 *             function is positive. In the picture that is its right-hand side.
 * Invariants  - The interior of an area is connected.
 *             - Its border does not cross itself. It may touch itself in a
 *             point, which is then an end of all edges that meet there. From
 *             such a point the border runs on as close to the interior as it
 *             can. So no hole touches the outer cycle or another hole: they
 *             would be one cycle.
 *             - Two consecutive edges are on different lines.
 * Exact       Lines, and points, are equal if and only if their numbers are.
 *             Every comparison is made by common/exact/named_lines.h.
 * Files       border.c, trace.c, clipper.c, face_area.c: as the sections
 *             below */
#ifndef HSR_ALGORITHMS_AREAS_H
#define HSR_ALGORITHMS_AREAS_H

#include "algorithms/algorithm.h"
#include "common/exact/named_lines.h"

struct hsr_border_edge {
  uint32_t line;
  int sign;          /* +1 or -1: see Notation */
  uint32_t from, to; /* points, by their numbers */
  double at[2][2];   /* where these are, in pixels, rounded */
};

/* Cycle c is edge[start[c]], ..., edge[start[c + 1] - 1]; cycle 0 is the outer
 * one. */
struct hsr_area {
  struct hsr_area *next; /* in a list */
  uint32_t face, n_cycles, n_edges;
  double nearest; /* about the depth of the nearest vertex of its face */
  uint32_t *start;
  struct hsr_border_edge *edge;
  double lo[2], hi[2]; /* its box, in pixels, a little too large */
  int size_class;      /* of its memory: an index of hsr_clipper.kept[] */
};

struct hsr_area_list {
  struct hsr_area *first, *last;
};

/* Adds an area at the end of a list. */
void hsr_areas_push(struct hsr_area_list *list, struct hsr_area *area);
/* Takes the first area out of a list. NULL: it is empty. */
struct hsr_area *hsr_areas_pop(struct hsr_area_list *list);
/* Moves all of `more` to the end of the list. */
void hsr_areas_join(struct hsr_area_list *list, struct hsr_area_list *more);

/* A strand: a part of an edge of one of two polygons which the other one's
 * border meets only at its ends. Where it lies: inside the other polygon;
 * outside; along its border, which runs in the same direction there; or against
 * it, in the opposite direction. */
enum hsr_where { HSR_INSIDE, HSR_OUTSIDE, HSR_ALONG, HSR_AGAINST };
struct hsr_strand {
  struct hsr_border_edge edge;
  enum hsr_where where;
  /* 1 + the next strand in the list of the knot that it leaves, and in that of
   * the knot that it enters; 0: none. */
  uint32_t leaving, entering;
};

/* A knot: a point in which strands meet. For either polygon, the lists of the
 * strands that leave it and of those that enter it: 1 + the index of the first;
 * 0: none. It counts only if `round` is the clipper's present one. */
struct hsr_knot {
  uint32_t round, leaving[2], entering[2];
};

/* Where an edge of a polygon is to be divided. */
struct hsr_division {
  uint32_t polygon, edge, point;
};

/* An edge of a border that is being gathered: its cycles are not known yet. */
struct hsr_loose_edge {
  struct hsr_border_edge edge;
  uint32_t next; /* 1 + the next edge that leaves the same point; 0: none */
  bool taken;    /* it is in a cycle already */
};

/* A cycle that has been found. */
struct hsr_traced_cycle {
  uint32_t first, n; /* its edges, in hsr_clipper.cycled */
  bool outer;        /* an outer cycle; else a hole */
  uint32_t owner;    /* of a hole: the outer cycle around it */
  double lo[2], hi[2];
};

enum { HSR_AREA_CLASSES = 33 };

/* The clipper's memory, which is the arena's. All zero at first, but for what
 * is borrowed. */
struct hsr_clipper {
  struct hsr_named_lines *lines; /* borrowed */
  struct hsr_arena *arena;       /* borrowed */
  bool failed;                   /* memory ran out */
  bool faulty;                   /* a border did not close, which cannot be */

  struct hsr_area *kept[HSR_AREA_CLASSES]; /* freed areas, by class of size */
  struct hsr_growing divisions, strands[2], ends[2], knots;
  struct hsr_growing border, path, cycled, cycles;
  uint32_t round;
  uint64_t crossings; /* points in which borders crossed, so far */
};

/* --- Borders (border.c) --------------------------------------------------- */

/* HSR_ITEM: item k of an array that grows. HSR_CLIPPER_NEW: a new item at its
 * end; NULL: out of memory, and c->failed is set. */
#define HSR_ITEM(type, array, k) (((type *)(array).items)[k])
void *hsr_clipper_item(struct hsr_clipper *c, struct hsr_growing *array,
                       size_t size);
#define HSR_CLIPPER_NEW(c, array, type)                                        \
  ((type *)hsr_clipper_item((c), (array), sizeof(type)))

/* The knot of a point in this round; an empty one if there is none yet. NULL:
 * out of memory. */
struct hsr_knot *hsr_clipper_knot(struct hsr_clipper *c, uint32_t point);

/* An edge, with its ends' places filled in. */
struct hsr_border_edge hsr_border_make(const struct hsr_clipper *c,
                                       uint32_t line, int sign, uint32_t from,
                                       uint32_t to);

/* A direction in the picture: that in which an edge of this line and sign
 * runs. */
struct hsr_heading {
  uint32_t line;
  int sign;
};

/* Turning from direction `from`, is direction a met before b? The turn is
 * counter-clockwise in (sx, sy) if `hand` is +1, clockwise if it is -1. `from`
 * itself is met last. */
bool hsr_border_precedes(struct hsr_clipper *c, struct hsr_heading from,
                         struct hsr_heading a, struct hsr_heading b, int hand);

/* Does point p, which is on the line of an edge, lie between the edge's ends,
 * and is it neither of them? */
bool hsr_border_between(struct hsr_clipper *c, const struct hsr_border_edge *e,
                        uint32_t p);

/* Notes in c->divisions where edge a, which is number k of polygon 0, and edge
 * b, which is number l of polygon `of`, must be divided: at each point that is
 * inside one of the edges and on the other. */
void hsr_border_cut(struct hsr_clipper *c, const struct hsr_border_edge *a,
                    uint32_t k, const struct hsr_border_edge *b, uint32_t l,
                    uint32_t of);

/* Divides the edges of polygon `of`, whose divisions have been noted, into
 * strands, cycle after cycle. */
void hsr_border_divide(struct hsr_clipper *c,
                       const struct hsr_border_edge *edge,
                       const uint32_t *start, uint32_t n_cycles, uint32_t of);

/* Is point p inside a polygon? If p is on its border: are the points next to p,
 * in the direction `heading`, inside? No edge of the polygon runs in that
 * direction there. */
bool hsr_border_is_within(struct hsr_clipper *c,
                          const struct hsr_border_edge *edge, uint32_t n,
                          uint32_t p, struct hsr_heading heading);

/* --- Areas (trace.c) ------------------------------------------------------ */

/* Adds an edge to the border that is being gathered. */
void hsr_border_add(struct hsr_clipper *c, const struct hsr_border_edge *edge);

/* Makes areas of the border that has been gathered, and appends them to the
 * list. The border is empty afterwards. */
void hsr_areas_of_border(struct hsr_clipper *c, uint32_t face, double nearest,
                         struct hsr_area_list *list);

/* Gives an area back to the clipper. */
void hsr_area_free(struct hsr_clipper *c, struct hsr_area *area);

/* --- Clipping (clipper.c) ------------------------------------------------- */

/* Do the boxes of two areas have no point in common? */
bool hsr_areas_apart(const struct hsr_area *a, const struct hsr_area *b);

/* Does a line along an edge of an area of few edges certainly have the two
 * areas on different sides? Then clipping would find nothing in common. It is
 * asked in doubles with a bound of their errors, so that two areas that touch
 * may be found beside each other or not. */
bool hsr_areas_beside(const struct hsr_area *a, const struct hsr_area *b);

/* Clips area a to the clip polygon `by`. If they have no area in common,
 * returns false, and a stays. Otherwise a is given back to the clipper, and its
 * parts inside and outside of `by` are appended to the two lists. */
bool hsr_areas_clip(struct hsr_clipper *c, struct hsr_area *a,
                    const struct hsr_area *by, struct hsr_area_list *inside,
                    struct hsr_area_list *outside);

/* A new area: the part of the picture on the side of a line where sign times
 * its function is positive; or the whole picture if the line is HSR_NO_LINE.
 * NULL: there is no such part, or c->failed. */
struct hsr_area *hsr_area_of_half(struct hsr_clipper *c, uint32_t line,
                                  int sign);

/* --- Faces (face_area.c) -------------------------------------------------- */

/* Appends to the list the areas of the picture that a face covers: where its
 * points exist in the view. */
void hsr_areas_of_face(struct hsr_clipper *c, const struct hsr_world *world,
                       const struct hsr_view *view, uint32_t face,
                       double nearest, struct hsr_area_list *list);

#endif
