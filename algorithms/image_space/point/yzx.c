/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sorting order that had not been tried: Y, then Z, then X.
 *
 * Source      Sutherland et al. 1974, "An Untried Sorting Order", and what "New
 *             Uses of Coherence" says of scan lines and depth: a proposal of a
 *             page, no algorithm. As far as we know nobody has published one,
 *             so the year is 0.
 *
 * The paper's
 *   Y         A bucket sort gives the faces in order of appearance.
 *   Z         The active faces stand in a priority list that is kept from line
 *             to line. A face that enters finds its place in it by a method
 *             similar to Newell's. Conflicts of penetration are resolved there,
 *             for entire faces.
 *   X         Intercepts are kept in order by a bubble sort. Where depth is
 *             asked for, priority numbers are compared. The segments involved
 *             in a span are kept in a list. Each enters it at the place that it
 *             had on the line before. Where no edges have crossed, the visible
 *             segments are those of the line before.
 *
 * Decided here, and why
 *   List      The Z list orders the segments of the line. Whole faces can
 *             overlap cyclically, and then Newell must divide them. Segments of
 *             one line cannot, unless they penetrate. To see this, take them by
 *             their left ends. When a segment enters, the segments that it
 *             meets all cover its first sample. They have an order in depth
 *             there, and it has a place in that order. Segments that ended
 *             before do not matter.
 *   When      Two faces are compared in depth when they begin to overlap on a
 *             line, not when one of them enters. So the X list answers Newell's
 *             tests 2, 3 and 6, whether two faces overlap on the screen. Two
 *             faces that never overlap are never compared.
 *   Tests     Newell's test 1 compares the extents in depth, his tests 4 and 5
 *             the vertices of one face with the plane of the other. They tell
 *             the order of two faces for all lines to come.
 *   Division  If they do not, each face has vertices on both sides of the
 *             other's plane, or one is cut by the near plane. Then, as with
 *             Newell, one face is divided by the plane of the other. It is the
 *             face that ends sooner, so that no division lasts longer than it
 *             is needed. The parts are found anew on every line. They meet at
 *             the implied edge.
 *   Kept      A segment keeps the place that it had in the involved list on the
 *             line before, without a test, if no end of another segment has
 *             crossed its left end since, and no segment that covers its left
 *             end has come or gone. The paper asks this of visible edges only.
 *             But hidden segments must keep their places too, since they may
 *             come into view.
 *   One pass  The place of a segment depends on the segments that it overlaps.
 *             So one pass over the line, from left to right, both finds what is
 *             visible and makes the new Z list out of the old one. For segments
 *             that overlapped on the line before, the old numbers decide.
 *
 * Glass       The paper: the involved list makes available an ordered set of
 *             surfaces at each point, and thus transparency. From the first
 *             opaque segment of the list on, towards its front, segments are
 *             combined (docs/transparent-picture.md). This is done anew
 *             wherever the list changes.
 *
 * What came of it
 *             Depths are not compared line by line, but for implied edges: the
 *             comparisons of the Z sort depend on the faces and hardly on the
 *             number of lines (surfaces/scan_line_test.c of the tests). That
 *             pays where faces are many lines tall. Where most faces are one or
 *             two lines tall, as in the big harbor, Watkins compares less.
 *
 * Notation    scan line -> row j; Y buckets and X sort list -> scan_line.h;
 *             segment -> struct segment, samples [x0, x1) of a face or of a
 *             part; priority number -> number, less is nearer
 * Invariants  Z_LIST: of two segments that share a sample of the row the nearer
 *             one comes first; INVOLVED: the segments that cover the current
 *             column, in that order
 * Ties        one plane: lower id; all else by hsr_nearer
 * Departures  those of scan_line.h
 * Cost        the paper gives none. Its f = 2 H_f/n is the chance that two
 *             faces overlap in one dimension (Newell special, appendix B). So
 *             F_r^2 f^2 / 2 pairs overlap on the screen, and the extents of
 *             each are compared once. A fraction f of them overlap in depth
 *             too, and take at most the eight vertices of two rectangles */
#include "algorithms/engines/light/glass.h"
#include "algorithms/engines/scan_line/scan_line.h"
#include "common/answers/kinds/transparent.h"

#include <string.h>

enum {
  MINIMAX,
  Z_SORT,
  DIVISIONS,
  IMPLIED,
  SEGMENTS,
  KEPT,
  PRIORITY,
  COMBINED,
  SPANS
};

/* f of the header. */
static double overlap_chance(const struct hsr_table1 *t) {
  return 2 * t->H_f / t->n;
}
/* Not on the line before; not divided. */
static const uint32_t NONE = UINT32_MAX;

/* The lists that a segment of the row is in. */
enum list { Z_LIST, INVOLVED };

/* What a face, or a part of it, covers on a row. A segment that has been
 * divided into two parts is in no list itself. */
struct segment {
  uint32_t face, strip;
  int row;    /* the last one on which it covered a sample; -1: none */
  int x0, x1; /* there */

  struct segment *near[2], *far[2]; /* neighbours in each list */
  struct segment *place;            /* what it was put behind in INVOLVED */
  uint32_t number;                  /* in the last Z list */

  /* Ends of segments that are on this row and on the one before are numbered by
   * their order there. NONE: it was not there. */
  uint32_t was_left, was_right;
  bool was_under_gone; /* there, one that is gone covered its left end */

  struct segment *whole;   /* of which it is a part; NULL: of none */
  uint32_t by;             /* divided by this face's plane; NONE: not divided */
  struct segment *part[2]; /* then: what is in front of the plane, and behind */
  struct segment *next_free;
};

/* Of a face: the k-th segments from the left of all rows. */
struct strip {
  uint32_t face;
  int row; /* the last one on which it covered a sample */
  int x0, x1;
  struct segment *segment; /* whole; NULL: none at present */
};

/* A face's strips, and how many have been met on the row. */
struct strips {
  uint32_t first, n;
  int row;
  bool open; /* the n-th has been met, its right end has not */
};

/* The extent in depth of a face, as q = 1/t: no sample of it is nearer than
 * `nearest` or farther than `farthest`. */
struct extent {
  double nearest, farthest;
};

/* An edge of a strip. The key is 2 column, and 1 more for a left edge: so of
 * one column, right edges come first. */
struct crossing {
  int key;
  uint32_t strip;
};

/* An end of a segment; the key likewise. */
struct end {
  int key;
  struct segment *segment;
};

struct line {
  struct end *end; /* by ascending keys */
  size_t n, room;
};

struct scan {
  struct hsr_scan edges; /* Y buckets and X sort list */
  const struct hsr_screen *screen;
  struct hsr_tally *tally;
  int j;
  uint32_t *ids;           /* of the row */
  struct hsr_glass *glass; /* if the picture is transparent; else NULL */
  bool out_of_memory;

  struct strips *strips;     /* a face */
  struct extent *extent;     /* a face */
  struct strip *strip;       /* of all faces */
  struct crossing *crossing; /* of the row, by ascending keys */
  uint32_t n_crossings;

  struct line now, before; /* the row, and the one before */
  struct segment lists;    /* where both lists begin and end */
  struct segment *free, *doomed;

  /* Of the ends passed on the row: */
  uint32_t n_known, latest; /* those with numbers, the greatest number + 1 */
  uint32_t n_new;           /* the others: left ends less right ends */
};

static int least(int a, int b) {
  return a < b ? a : b;
}
static int most(int a, int b) {
  return a > b ? a : b;
}

/* --- Memory --------------------------------------------------------------- */

static struct segment *new_segment(struct scan *s) {
  enum { AT_ONCE = 64 };
  if (!s->free) {
    struct segment *more =
        HSR_NEW(s->edges.job->scratch, struct segment, AT_ONCE);
    s->out_of_memory |= !more;
    for (int k = 0; more && k < AT_ONCE; k++) {
      more[k].next_free = s->free;
      s->free = &more[k];
    }
  }
  struct segment *segment = s->free;
  if (segment)
    s->free = segment->next_free;
  return segment;
}

/* Frees a segment and its parts, but only once the line before, which may name
 * them, is done with. */
static void doom(struct scan *s, struct segment *segment) {
  for (int k = 0; k < 2 && segment->by != NONE; k++)
    doom(s, segment->part[k]);
  segment->next_free = s->doomed;
  s->doomed = segment;
}

static void free_doomed(struct scan *s) {
  while (s->doomed) {
    struct segment *segment = s->doomed;
    s->doomed = segment->next_free;
    segment->next_free = s->free;
    s->free = segment;
  }
}

/* Puts an end into the row, which takes twice the room when it is full. */
static void insert_end(struct scan *s, struct segment *segment, int key) {
  struct line *line = &s->now;
  if (line->n == line->room) {
    struct end *more =
        HSR_NEW(s->edges.job->scratch, struct end, 2 * line->room);
    if (!more) {
      s->out_of_memory = true;
      return;
    }
    memcpy(more, line->end, line->n * sizeof *more);
    line->end = more;
    line->room *= 2;
  }
  size_t k = line->n++;
  for (; k && line->end[k - 1].key > key; k--)
    line->end[k] = line->end[k - 1];
  line->end[k] = (struct end){key, segment};
}

/* --- The two lists -------------------------------------------------------- */

static void empty_lists(struct scan *s) {
  for (int list = 0; list < 2; list++)
    s->lists.near[list] = s->lists.far[list] = &s->lists;
}

static void insert_behind(struct segment *place, struct segment *segment,
                          enum list list) {
  segment->near[list] = place;
  segment->far[list] = place->far[list];
  place->far[list]->near[list] = segment;
  place->far[list] = segment;
}

static void take_out(struct segment *segment, enum list list) {
  segment->near[list]->far[list] = segment->far[list];
  segment->far[list]->near[list] = segment->near[list];
}

/* --- Segments of the row -------------------------------------------------- */

/* Pairs the edges of the X sort list: the first of a face opens a segment, the
 * second closes it. */
static void find_crossings(struct scan *s) {
  const struct hsr_window *w = s->edges.window;
  uint32_t n = 0;
  for (uint32_t k = 0; k < s->edges.n_list; k++) {
    const struct hsr_scan_edge *edge = &s->edges.edge[s->edges.list[k]];
    if (edge->column == HSR_NO_COLUMN)
      break;
    struct strips *strips = &s->strips[edge->face];
    if (strips->row != s->j) {
      strips->row = s->j;
      strips->n = 0;
    }
    uint32_t number = strips->first + strips->n;
    struct strip *strip = &s->strip[number];
    int column = most(w->x0, least(w->x1, edge->column));
    strips->open = !strips->open;
    strip->face = edge->face;
    if (strips->open) {
      strip->x0 = column;
    } else {
      strip->x1 = column;
      strips->n++;
    }
    struct crossing crossing = {2 * column + strips->open, number};
    uint32_t at = n++;
    for (; at && s->crossing[at - 1].key > crossing.key; at--)
      s->crossing[at] = s->crossing[at - 1];
    s->crossing[at] = crossing;
  }
  s->n_crossings = n;
}

static inline struct hsr_window the_row(const struct scan *s) {
  return HSR_ON(s->edges.window->x0, s->edges.window->x1, s->j);
}

static bool is_nearer(const struct scan *s, uint32_t f, uint32_t g, int i) {
  HSR_TOUCH(s->tally, i, s->j);
  bool nearer = hsr_nearer(s->screen, f, g, i, s->j, s->tally);
  HSR_STEP(s->tally, IMPLIED, HSR_FACE(f), HSR_FACE(g), HSR_AT(i, s->j),
           nearer);
  return nearer;
}

/* The first sample of [x0, x1) at which the planes of f and g are not in the
 * order of x0; x1 if there is none. *f_first: f is nearer at x0. */
static int find_implied_edge(const struct scan *s, uint32_t f, uint32_t g,
                             int x0, int x1, bool *f_first) {
  *f_first = is_nearer(s, f, g, x0);
  if (is_nearer(s, f, g, x1 - 1) == *f_first)
    return x1;
  return hsr_scan_crossing(&s->edges, f, g, *f_first, x0, x1, s->j, IMPLIED);
}

static void set_segment(struct scan *s, struct segment *segment, int x0,
                        int x1) {
  segment->row = s->j;
  segment->x0 = x0;
  segment->x1 = x1;
  segment->was_left = segment->was_right = NONE;
}

/* Deals the samples [x0, x1) out to the parts. */
static void find_parts(struct scan *s, struct segment *segment, int x0,
                       int x1) {
  if (segment->by == NONE) {
    set_segment(s, segment, x0, x1);
    insert_end(s, segment, 2 * x0 + 1);
    insert_end(s, segment, 2 * x1);
    return;
  }
  bool in_front;
  int middle =
      find_implied_edge(s, segment->face, segment->by, x0, x1, &in_front);
  find_parts(s, segment->part[!in_front], x0, middle);
  if (middle < x1)
    find_parts(s, segment->part[in_front], middle, x1);
}

/* What covers the samples of a strip; NULL if memory ran out. */
static struct segment *segment_of(struct scan *s, uint32_t number) {
  struct strip *strip = &s->strip[number];
  if (!strip->segment) {
    strip->segment = new_segment(s);
    if (strip->segment)
      *strip->segment = (struct segment){
          .face = strip->face, .strip = number, .row = -1, .by = NONE};
  }
  return strip->segment;
}

/* Finds the ends of all segments. Those of divided ones are inserted last. */
static void find_segments(struct scan *s) {
  struct line line = s->before;
  s->before = s->now;
  s->now = line;
  s->now.n = 0;
  bool divided = false;
  for (uint32_t k = 0; k < s->n_crossings; k++) {
    const struct crossing *c = &s->crossing[k];
    struct strip *strip = &s->strip[c->strip];
    struct segment *segment;
    if (strip->x0 >= strip->x1 || !(segment = segment_of(s, c->strip)))
      continue;
    strip->row = s->j;
    if (segment->by != NONE) {
      divided = true;
      continue;
    }
    if (c->key & 1)
      set_segment(s, segment, strip->x0, strip->x1);
    s->now.end[s->now.n++] = (struct end){c->key, segment};
  }
  for (uint32_t k = 0; divided && k < s->n_crossings; k++) {
    const struct strip *strip = &s->strip[s->crossing[k].strip];
    if (s->crossing[k].key & 1 && strip->row == s->j &&
        strip->segment->by != NONE)
      find_parts(s, strip->segment, strip->x0, strip->x1);
  }
}

/* Numbers the ends of the segments that are on both lines, and frees the
 * segments that are gone. */
static void compare_lines(struct scan *s) {
  uint32_t n = 0, n_gone = 0;
  for (size_t k = 0; k < s->before.n; k++) {
    struct segment *segment = s->before.end[k].segment;
    bool left = s->before.end[k].key & 1;
    if (segment->row == s->j) {
      *(left ? &segment->was_left : &segment->was_right) = n++;
      if (left)
        segment->was_under_gone = n_gone;
      continue;
    }
    n_gone = left ? n_gone + 1 : n_gone - 1;
    struct strip *strip = &s->strip[segment->strip];
    if (strip->row != s->j && strip->segment) {
      doom(s, strip->segment);
      strip->segment = NULL;
    }
  }
  free_doomed(s);
}

/* --- Z sort: the order of two faces --------------------------------------- */

static void include_depth(struct extent *extent, double q) {
  if (extent->nearest < q)
    extent->nearest = q;
  if (extent->farthest > q)
    extent->farthest = q;
}

/* The samples of a whole face lie between its vertices, those of a cut face
 * within its bounds. */
static struct extent find_extent(const struct scan *s, uint32_t f) {
  const struct hsr_world *world = s->edges.job->world;
  const struct hsr_bounds *b = &s->screen->bounds[f];
  struct extent extent = {-INFINITY, INFINITY};
  if (s->screen->whole[f])
    for (uint32_t k = world->mesh.start[f]; k < world->mesh.start[f + 1]; k++)
      include_depth(&extent,
                    hsr_vertex_depth(s->screen, f, world->mesh.vertex[k]));
  else
    for (int corner = 0; corner < 4; corner++)
      include_depth(&extent,
                    hsr_depth(s->screen, f, corner & 1 ? b->x1 - 1 : b->x0,
                              corner & 2 ? b->y1 - 1 : b->y0));
  double error = hsr_vertex_error(s->screen, f);
  return (struct extent){extent.nearest + error, extent.farthest - error};
}

/* The outcomes overlap, nearer, farther; and on the plane, in front, behind. */
static inline int outcome_of(int side) {
  return side < 0 ? 2 : side;
}

/* Newell's test 1: +1 if all of f is nearer than all of g, -1 if all of g than
 * all of f, else 0. */
static int compare_extents(const struct scan *s, uint32_t f, uint32_t g) {
  int side = (s->extent[f].farthest > s->extent[g].nearest) -
             (s->extent[g].farthest > s->extent[f].nearest);
  HSR_STEP(s->tally, MINIMAX, HSR_FACE(f), HSR_FACE(g), the_row(s),
           outcome_of(side));
  return side;
}

/* Newell's tests 4 and 5: +1 if all of f lies in front of g's plane, -1 if all
 * of it behind, else 0; also if f is cut. */
static int side_of_plane(const struct scan *s, uint32_t f, uint32_t g) {
  if (!s->screen->whole[f])
    return 0;
  const struct hsr_world *world = s->edges.job->world;
  bool in_front = true, behind = true;
  for (uint32_t k = world->mesh.start[f];
       k < world->mesh.start[f + 1] && (in_front || behind); k++) {
    int nearer =
        hsr_vertex_nearer(s->screen, f, g, world->mesh.vertex[k], s->tally);
    HSR_STEP(s->tally, Z_SORT, HSR_VERTEX(world->mesh.vertex[k]), HSR_FACE(g),
             the_row(s), outcome_of(nearer));
    in_front &= nearer >= 0;
    behind &= nearer <= 0;
  }
  return in_front - behind;
}

/* Has `a` been divided by the plane of b before? +1 if it belongs to the part
 * in front of that plane, -1 if to the part behind, 0 if it was not divided. */
static int side_by_division(const struct scan *s, const struct segment *a,
                            const struct segment *b) {
  const uint32_t *plane = s->edges.job->world->mesh.plane;
  for (const struct segment *part = a; part->whole; part = part->whole)
    if (plane[part->whole->by] == plane[b->face])
      return part->whole->part[0] == part ? 1 : -1;
  return 0;
}

static bool ends_sooner(const struct scan *s, const struct segment *a,
                        const struct segment *b) {
  const struct hsr_bounds *bounds = s->screen->bounds;
  return bounds[a->face].y1 < bounds[b->face].y1;
}

/* The order of two segments on all lines to come: +1 if a is in front, -1 if b
 * is, 0 if the tests do not tell. The face that ends sooner is tested first: it
 * is smaller, and so more likely to lie on one side. */
static int settle(const struct scan *s, const struct segment *a,
                  const struct segment *b) {
  uint32_t f = a->face, g = b->face;
  const uint32_t *plane = s->edges.job->world->mesh.plane;
  if (plane[f] == plane[g])
    return f < g ? 1 : -1;
  int side = side_by_division(s, a, b);
  if (!side)
    side = -side_by_division(s, b, a);
  if (!side)
    side = compare_extents(s, f, g);
  bool a_sooner = ends_sooner(s, a, b);
  if (!side)
    side = a_sooner ? side_of_plane(s, f, g) : -side_of_plane(s, g, f);
  if (!side)
    side = a_sooner ? -side_of_plane(s, g, f) : side_of_plane(s, f, g);
  return side;
}

/* Divides a segment by the plane of a face. The segment keeps the samples up to
 * `middle`, which are in front of the plane or behind it, and becomes one part.
 * The samples from `middle` on become the other. */
static void divide(struct scan *s, struct segment *segment, uint32_t by,
                   int middle, bool in_front) {
  HSR_STEP(s->tally, DIVISIONS, HSR_FACE(segment->face), HSR_FACE(by),
           HSR_ON(segment->x0, segment->x1, s->j), 0);
  struct segment *whole = new_segment(s), *rest = new_segment(s);
  if (!whole || !rest)
    return;
  *whole = *rest = *segment;
  if (whole->whole)
    whole->whole->part[whole->whole->part[1] == segment] = whole;
  else
    s->strip[whole->strip].segment = whole;
  whole->by = by;
  whole->part[!in_front] = segment;
  whole->part[in_front] = rest;
  segment->whole = rest->whole = whole;

  rest->row = -1;
  if (middle == segment->x1)
    return;
  set_segment(s, rest, middle, segment->x1);
  size_t k = s->now.n - 1;
  while (s->now.end[k].segment != segment)
    k--;
  s->now.end[k].segment = rest;
  segment->x1 = middle;
  insert_end(s, segment, 2 * middle);
  insert_end(s, rest, 2 * middle + 1);
}

/* Is the involved segment in front of the entering one, which overlaps it for
 * the first time? If their order cannot be settled for all lines to come, the
 * face that ends sooner is divided by the plane of the other. An involved
 * segment is divided from the first sample of the entering one on. Its samples
 * to the left stay in the first part, even if they lie on the other side of the
 * plane: the two segments do not overlap there. */
static bool is_in_front(struct scan *s, struct segment *involved,
                        struct segment *entering) {
  int side = settle(s, involved, entering);
  if (side)
    return side > 0;
  bool sooner = ends_sooner(s, involved, entering);
  struct segment *divided = sooner ? involved : entering;
  uint32_t by = sooner ? entering->face : involved->face;
  bool in_front;
  int middle = find_implied_edge(s, divided->face, by, entering->x0,
                                 divided->x1, &in_front);
  divide(s, divided, by, middle, in_front);
  return in_front == sooner;
}

/* --- Z sort: the place of a segment --------------------------------------- */

/* Did they overlap on the line before? */
static bool met_before(const struct segment *a, const struct segment *b) {
  return a->was_left != NONE && b->was_left != NONE &&
         a->was_left < b->was_right && b->was_left < a->was_right;
}

/* The last of the involved segments that are in front of the entering one. All
 * of them cover its first sample, so those in front come before those behind.
 */
static struct segment *find_place(struct scan *s, struct segment *segment) {
  struct segment *place = &s->lists;
  bool behind = false;
  for (struct segment *a = s->lists.far[INVOLVED]; a != &s->lists;
       a = a->far[INVOLVED]) {
    if (!met_before(a, segment)) {
      behind = !is_in_front(s, a, segment);
    } else if (!behind) {
      behind = a->number > segment->number;
      HSR_STEP(s->tally, PRIORITY, HSR_FACE(a->face), HSR_FACE(segment->face),
               HSR_AT(segment->x0, s->j), !behind);
    }
    if (!behind)
      place = a;
  }
  return place;
}

/* Are the same segments involved as when it entered on the line before? They
 * are if three things hold: of the ends with numbers, exactly those before its
 * own have been passed; no segment that is new on this line covers its left
 * end; and none that is gone covered it there. All of them overlapped on the
 * line before, so their order is the same too. */
static bool place_is_kept(const struct scan *s, const struct segment *segment) {
  return segment->was_left != NONE && s->n_known == segment->was_left &&
         s->latest == segment->was_left && !s->n_new &&
         !segment->was_under_gone;
}

static void enter(struct scan *s, struct segment *segment) {
  HSR_STEP(s->tally, SEGMENTS, HSR_FACE(segment->face), HSR_THE_WINDOW,
           HSR_ON(segment->x0, segment->x1, s->j), 0);
  if (place_is_kept(s, segment))
    HSR_STEP(s->tally, KEPT, HSR_FACE(segment->face),
             HSR_FACE(segment->place->face),
             HSR_ON(segment->x0, segment->x1, s->j), 0);
  else
    segment->place = find_place(s, segment);

  struct segment *place = segment->place;
  if (place == &s->lists) /* in front of the first that is involved */
    place = s->lists.far[INVOLVED]->near[Z_LIST];
  insert_behind(place, segment, Z_LIST);
  insert_behind(segment->place, segment, INVOLVED);
}

/* --- X sort --------------------------------------------------------------- */

static void pass_end(struct scan *s, struct end end) {
  bool left = end.key & 1;
  if (left)
    enter(s, end.segment);
  else
    take_out(end.segment, INVOLVED);

  uint32_t was = left ? end.segment->was_left : end.segment->was_right;
  if (was == NONE) {
    s->n_new = left ? s->n_new + 1 : s->n_new - 1;
  } else {
    s->n_known++;
    if (s->latest <= was)
      s->latest = was + 1;
  }
}

static void write_span(struct scan *s, uint32_t id, int left, int right) {
  HSR_STEP(s->tally, SPANS, HSR_FACE(id), HSR_THE_WINDOW,
           HSR_ON(left, right, s->j), 0);
  HSR_TOUCH_SPAN(s->tally, left, right, s->j);
  for (int i = left; i < right; i++)
    s->ids[i] = id;
}

/* The colour of the involved segments, from the first opaque one on. */
static void combine(struct scan *s, int left, int right, uint16_t rgb[3]) {
  const struct segment *a = s->lists.far[INVOLVED];
  while (a != &s->lists && hsr_is_glass(s->glass, a->face))
    a = a->far[INVOLVED];
  if (a == &s->lists)
    hsr_glass_clear(s->glass, rgb);
  else
    hsr_glass_over(s->glass, a->face, rgb);
  (void)left, (void)right; /* for the trace */
  for (a = a->near[INVOLVED]; a != &s->lists; a = a->near[INVOLVED]) {
    HSR_STEP(s->tally, COMBINED, HSR_FACE(a->face), HSR_THE_WINDOW,
             HSR_ON(left, right, s->j), 0);
    hsr_glass_over(s->glass, a->face, rgb);
  }
}

/* A span between two changes of the involved list. */
static void write_glass(struct scan *s, int left, int right) {
  uint16_t rgb[3] = {0};
  if (left == right)
    return;
  combine(s, left, right, rgb);
  HSR_ACCEPTED(s->tally, SPANS, HSR_FACE(s->lists.far[INVOLVED]->face),
               HSR_THE_WINDOW, HSR_ON(left, right, s->j), rgb);
  HSR_TOUCH_SPAN(s->tally, left, right, s->j);
  hsr_glass_show(s->glass, rgb, left, right, s->j);
}

/* Where the span ends: at the end of a segment that comes next, number k. */
static int span_end(const struct scan *s, size_t k) {
  return k < s->now.n ? s->now.end[k].key >> 1 : s->edges.window->x1;
}

/* Passes the ends from left to right. Between two of them the first of the
 * involved segments is visible. */
static void pass_ends(struct scan *s) {
  const struct hsr_window *w = s->edges.window;
  int left = w->x0;
  uint32_t visible = HSR_BACKGROUND;
  size_t k = 0;
  for (int column = w->x0, end; column < w->x1; column = end) {
    for (; k < s->now.n && s->now.end[k].key >> 1 <= column; k++)
      pass_end(s, s->now.end[k]);
    end = span_end(s, k);
    uint32_t id = s->lists.far[INVOLVED]->face;
    if (s->glass) {
      write_glass(s, column, end);
    } else if (id != visible && left < column) {
      write_span(s, visible, left, column);
      left = column;
    }
    visible = id;
  }
  if (!s->glass)
    write_span(s, visible, left, w->x1);
}

/* Passes the ends of the row. In the end the Z list is numbered. */
static void scan_row(struct scan *s) {
  empty_lists(s);
  s->n_known = s->latest = s->n_new = 0;
  pass_ends(s);
  uint32_t number = 0;
  for (struct segment *z = s->lists.far[Z_LIST]; z != &s->lists;
       z = z->far[Z_LIST])
    z->number = number++;
}

/* --- The algorithm -------------------------------------------------------- */

static enum hsr_status allocate(struct scan *s) {
  const struct hsr_world *world = s->edges.job->world;
  struct hsr_arena *arena = s->edges.job->scratch;
  size_t most_ends = s->edges.most_edges + 1;
  s->strips = HSR_NEW(arena, struct strips, world->n_faces);
  s->extent = HSR_NEW(arena, struct extent, world->n_faces);
  s->strip = HSR_NEW(arena, struct strip, most_ends / 2);
  s->crossing = HSR_NEW(arena, struct crossing, most_ends);
  s->now.end = HSR_NEW(arena, struct end, most_ends);
  s->before.end = HSR_NEW(arena, struct end, most_ends);
  s->now.room = s->before.room = most_ends;
  if (!s->strips || !s->extent || !s->strip || !s->crossing || !s->now.end ||
      !s->before.end)
    return HSR_E_NOMEM;

  uint32_t n_strips = 0;
  for (uint32_t r = 0; r < s->screen->n_relevant; r++) {
    uint32_t f = s->screen->relevant[r];
    uint32_t n = hsr_face_size(world, f) / 2 + (s->screen->whole[f] ? 0 : 2);
    s->strips[f] = (struct strips){.first = n_strips, .row = -1};
    s->extent[f] = find_extent(s, f);
    for (uint32_t k = 0; k < n; k++)
      s->strip[n_strips++] = (struct strip){.row = -1};
  }
  s->lists.face = HSR_BACKGROUND;
  return HSR_OK;
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct scan scan = {.screen = &scan.edges.screen, .tally = job->tally};
  struct hsr_glass glass;
  if (hsr_scan_begin(&scan.edges, job) || allocate(&scan) ||
      (hsr_answer_colours_of(job->answer) && hsr_glass_begin(&glass, job)))
    return hsr_fail_nomem(err);
  scan.glass = hsr_answer_colours_of(job->answer) ? &glass : NULL;

  const struct hsr_window *w = &job->view->window;
  for (scan.j = w->y0; scan.j < w->y1; scan.j++) {
    if (job->answer->ids)
      scan.ids = hsr_job_row(job, scan.j);
    hsr_scan_advance(&scan.edges, scan.j);
    find_crossings(&scan);
    find_segments(&scan);
    compare_lines(&scan);
    if (!scan.out_of_memory)
      scan_row(&scan);
    if (scan.out_of_memory)
      return hsr_fail_nomem(err);
  }
  return HSR_OK;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {{&hsr_scan_part}, {NULL}};

static const struct hsr_counter counters[] = {
    [MINIMAX] = {"Z minimax",
                 "extents in depth compared, of faces that begin to overlap",
                 HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE,
                 "overlap|nearer|farther"},
    [Z_SORT] = {"Z sort", "vertices compared with another face's plane",
                HSR_COMPARE, HSR_OF_VERTEX, HSR_OF_FACE,
                "on the plane|in front|behind"},
    [DIVISIONS] = {"divisions", "faces divided by another's plane", HSR_SPLIT,
                   HSR_OF_FACE, HSR_OF_FACE},
    [IMPLIED] = {"implied edges",
                 "depths compared to find where the parts of a face meet on a "
                 "line",
                 HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE, "farther|nearer"},
    [SEGMENTS] = {"segments", "segments entered into the involved list",
                  HSR_ACTIVATE, HSR_OF_FACE, HSR_OF_WINDOW},
    [KEPT] = {"places kept",
              "of these, without a test, where they stood on the line before",
              HSR_SORT, HSR_OF_FACE, HSR_OF_FACE},
    [PRIORITY] = {"priority tests", "priority numbers compared", HSR_COMPARE,
                  HSR_OF_FACE, HSR_OF_FACE, "farther|nearer"},
    [COMBINED] = {"combined", "transparent segments put over what is behind",
                  HSR_SAMPLE, HSR_OF_FACE, HSR_OF_WINDOW},
    [SPANS] = {"spans", "sample spans shown", HSR_ACCEPT, HSR_OF_FACE,
               HSR_OF_WINDOW},
    {NULL}};

static const struct hsr_line outline[] = {
    {"", .part = &hsr_scan_part},
    {"  pair the edges of each face into segments; find implied edges of those "
     "divided",
     HSR_RAISES(IMPLIED)},
    {"  for each end of a segment, from the left"},
    {"    a left end: enter the segment into the list of those involved",
     HSR_RAISES(SEGMENTS)},
    {"      the same ones as on the line before: it keeps its place",
     HSR_RAISES(KEPT)},
    {"      else for each of them: overlapped before? compare priority numbers",
     HSR_RAISES(PRIORITY)},
    {"        if not: do the extents in depth overlap?", HSR_RAISES(MINIMAX)},
    {"          if so: vertices of one against the plane of the other",
     HSR_RAISES(Z_SORT)},
    {"            if none tells: divide the face that ends sooner",
     HSR_RAISES(DIVISIONS)},
    {"    a right end: delete the segment from the list"},
    {"    put the transparent ones of those involved over the first opaque one",
     HSR_RAISES(COMBINED)},
    {"    show the first of those involved where another begins to be it",
     HSR_RAISES(SPANS)},
    {"  number the segments in the order of the Z list"},
    {NULL}};

static double predict_minimax(const struct hsr_table1 *t) {
  return pow(t->F_r * overlap_chance(t), 2) / 2;
}

static double predict_z_sort(const struct hsr_table1 *t) {
  return 8 * overlap_chance(t) * predict_minimax(t);
}

static const struct hsr_step steps[] = {
    {"Z minimax", MINIMAX, HSR_KIND_BOX, "F_r^2 f^2 / 2, f = 2 H_f/n (ours)",
     predict_minimax},
    {"Z sort",
     Z_SORT,
     HSR_KIND_PLANE,
     "4 F_r^2 f^3, f = 2 H_f/n (ours)",
     predict_z_sort,
     {{DIVISIONS, HSR_KIND_FACES}}},
    {"implied edges", IMPLIED, HSR_KIND_SPAN},
    {"priority tests",
     PRIORITY,
     HSR_KIND_NUMBERS,
     NULL,
     NULL,
     {{SEGMENTS, HSR_KIND_LINK}}},
    {NULL}};

static const struct hsr_sort sorts[] = {
    {"edges", "Y", "bucket sort", "once a frame"},
    {"faces", "Z", "Newell's tests 1, 4, 5", "as two begin to overlap"},
    {"segments", "Z", "insertion by priority number", "once a scan line"},
    {"edges", "X", "merge", "as they enter"},
    {"edges", "X", "bubble sort", "once a scan line"},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(yzx) = {
    .name = "yzx",
    .title = "The untried sorting order, Y Z X",
    .authors = "Sutherland, Sproull and Schumacker",
    .year = 0, /* proposed in 1974 */
    .source = "proposed by Sutherland et al., Computing Surveys 6(1), 1974, "
              "\"An Untried Sorting Order\"",
    .taxonomy = HSR_IMAGE_SPACE_POINT,
    .sort_order = "YZX",
    .coherence = "depth from line to line; scan line; edge",
    .restrictions = 0,
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_IDS}, {HSR_TRANSPARENT}},
    .sorts = sorts,
    .parts = uses,
    .counters = counters,
    .steps = steps,
    .outline = outline,
    .render = render};
