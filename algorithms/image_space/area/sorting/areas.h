/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Areas of the picture plane: polygons with holes, convex or not, whose sides
 * lie on named lines. They are what the Weiler-Atherton algorithm clips.
 *
 * Source      K. Weiler and P. Atherton, "Hidden surface removal using polygon
 *             area sorting", SIGGRAPH 1977, as described by Greene 1995, "The
 *             Weiler-Atherton Algorithm", pp. 10-11.
 * Notation    area -> struct hsr_area; its border -> cycles of struct
 *             hsr_border_edge. An edge is directed: it runs along its line with
 *             the area on the side where sign times the line's function is
 *             positive, which is on the right for one who looks at the picture.
 * Invariants  the interior of an area is connected. Its border does not cross
 *             itself. It may touch itself in points; each such point is an end
 *             of the edges that meet there. Then the border runs on as close to
 *             the interior as it can, so that no hole touches the outer cycle
 *             or another hole: they would be one cycle.
 *             Two edges that follow one another are on different lines.
 * Exact       lines and points are equal if their numbers are. Every comparison
 *             is made by common/exact/named_lines.h. */
#ifndef HSR_ALGORITHMS_AREAS_H
#define HSR_ALGORITHMS_AREAS_H

#include "algorithms/algorithm.h"
#include "common/exact/named_lines.h"

struct hsr_border_edge {
  uint32_t line;
  int sign;          /* +1 or -1 */
  uint32_t from, to; /* points */
  double at[2][2];   /* where they are, rounded */
};

/* Cycle c is edge[start[c]], ..., edge[start[c + 1] - 1]; cycle 0 is the outer
 * one. */
struct hsr_area {
  struct hsr_area *next; /* in a list */
  uint32_t face, n_cycles, n_edges;
  double nearest; /* the depth of the nearest vertex of its face, roughly */
  uint32_t *start;
  struct hsr_border_edge *edge;
  double lo[2], hi[2]; /* its box, in pixels, a little too large */
  int size_class;      /* of its memory */
};

struct hsr_area_list {
  struct hsr_area *first, *last;
};

void hsr_areas_push(struct hsr_area_list *list, struct hsr_area *area);
struct hsr_area *hsr_areas_pop(struct hsr_area_list *list); /* NULL: empty */
/* Moves all of `more` to the end of the list. */
void hsr_areas_join(struct hsr_area_list *list, struct hsr_area_list *more);

/* A part of an edge of one of two polygons, that the other one's border meets
 * at its ends only; and where it lies: inside the other one, outside, or on its
 * border, which runs there in the same direction or in the opposite one. */
enum hsr_where { HSR_INSIDE, HSR_OUTSIDE, HSR_ALONG, HSR_AGAINST };
struct hsr_strand {
  struct hsr_border_edge edge;
  enum hsr_where where;
  uint32_t leaving, entering; /* next in the list of the knot; 0: none */
};

/* What meets in a point: of either polygon, the strands that leave it and those
 * that enter it, as 1 and their index; 0: none. Valid in its round only. */
struct hsr_knot {
  uint32_t round, leaving[2], entering[2];
};

/* Where an edge of a polygon is to be divided. */
struct hsr_division {
  uint32_t polygon, edge, point;
};

/* An edge of a border whose cycles are not known yet. */
struct hsr_loose_edge {
  struct hsr_border_edge edge;
  uint32_t next; /* that leaves the same point: 1 and its index; 0: none */
  bool taken;
};

struct hsr_traced_cycle {
  uint32_t first, n; /* in `cycled` */
  bool outer;
  uint32_t owner; /* of a hole: the cycle that it is in */
  double lo[2], hi[2];
};

enum { HSR_AREA_CLASSES = 33 };

/* What the clipper works with. All memory is the arena's. All 0 but for what is
 * borrowed at the start. */
struct hsr_clipper {
  struct hsr_named_lines *lines; /* borrowed */
  struct hsr_arena *arena;       /* borrowed */
  bool failed;                   /* memory ran out */
  bool faulty;                   /* a border did not close: never so */

  struct hsr_area *kept[HSR_AREA_CLASSES]; /* areas that were given back */
  struct hsr_growing divisions, strands[2], ends[2], knots;
  struct hsr_growing border, path, cycled, cycles;
  uint32_t round;
  uint64_t crossings; /* points in which borders crossed, so far */
};

/* --- Borders (border.c) --------------------------------------------------- */

/* Item k of an array that grows; and a new one, or NULL: then `failed` is set. */
#define HSR_ITEM(type, array, k) (((type *)(array).items)[k])
void *hsr_clipper_item(struct hsr_clipper *c, struct hsr_growing *array,
                       size_t size);
#define HSR_CLIPPER_NEW(c, array, type)                                        \
  ((type *)hsr_clipper_item((c), (array), sizeof(type)))

/* The knot of a point in this round, empty if it is new; NULL if memory ran
 * out. */
struct hsr_knot *hsr_clipper_knot(struct hsr_clipper *c, uint32_t point);

struct hsr_border_edge hsr_border_make(const struct hsr_clipper *c,
                                       uint32_t line, int sign, uint32_t from,
                                       uint32_t to);

/* Whether direction a is met before b by one who turns from direction `from`,
 * counter-clockwise in (sx, sy) if `hand` is +1, clockwise if -1. A direction is
 * that of an edge, times its `way`, +1 or -1. `from` itself comes last. */
struct hsr_heading {
  uint32_t line;
  int sign;
};
bool hsr_border_precedes(struct hsr_clipper *c, struct hsr_heading from,
                         struct hsr_heading a, struct hsr_heading b, int hand);

/* Of a point p on the line of an edge: whether it lies between the edge's ends,
 * and is neither of them. */
bool hsr_border_between(struct hsr_clipper *c, const struct hsr_border_edge *e,
                        uint32_t p);

/* Notes where two edges must be divided, edges k and l of polygons 0 and `of`:
 * in each point that is inside one of them and on the other. */
void hsr_border_cut(struct hsr_clipper *c, const struct hsr_border_edge *a,
                    uint32_t k, const struct hsr_border_edge *b, uint32_t l,
                    uint32_t of);

/* Divides the edges of polygon `of`, whose divisions are noted, into strands,
 * cycle after cycle. */
void hsr_border_divide(struct hsr_clipper *c,
                       const struct hsr_border_edge *edge,
                       const uint32_t *start, uint32_t n_cycles, uint32_t of);

/* Whether a polygon has point p inside it, or, if p is on its border, the points
 * next to p in the direction of `heading`, which is none of its edges. */
bool hsr_border_is_within(struct hsr_clipper *c,
                          const struct hsr_border_edge *edge, uint32_t n,
                          uint32_t p, struct hsr_heading heading);

/* --- Areas (trace.c) ------------------------------------------------------ */

/* Adds an edge to the border that is being gathered. */
void hsr_border_add(struct hsr_clipper *c, const struct hsr_border_edge *edge);

/* Makes areas of the border gathered, and appends them to the list. The border
 * is empty afterwards. */
void hsr_areas_of_border(struct hsr_clipper *c, uint32_t face, double nearest,
                         struct hsr_area_list *list);
void hsr_area_free(struct hsr_clipper *c, struct hsr_area *area);

/* --- Clipping (clipper.c) ------------------------------------------------- */

/* Whether the boxes of two areas have nothing in common. */
bool hsr_areas_apart(const struct hsr_area *a, const struct hsr_area *b);

/* Clips area a to area `by`. False if they have no area in common. Else a is
 * given back, and its parts inside and outside are appended to the lists. */
bool hsr_areas_clip(struct hsr_clipper *c, struct hsr_area *a,
                    const struct hsr_area *by, struct hsr_area_list *inside,
                    struct hsr_area_list *outside);

/* The part of the picture on the side of a line where sign times its function
 * is positive; the whole picture if the line is HSR_NO_LINE. NULL if there is
 * none. */
struct hsr_area *hsr_area_of_half(struct hsr_clipper *c, uint32_t line,
                                  int sign);

/* --- Faces (face_area.c) -------------------------------------------------- */

/* The areas of the picture that a face covers, where its points exist. */
void hsr_areas_of_face(struct hsr_clipper *c, const struct hsr_world *world,
                       const struct hsr_view *view, uint32_t face,
                       double nearest, struct hsr_area_list *list);

#endif
