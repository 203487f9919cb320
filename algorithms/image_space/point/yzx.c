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
 *             in a span are kept in an ordered list. Each enters it at the
 *             position that it had on the line before, and moves from there by
 *             a bubble sort. Where no edges have crossed, the visible segments
 *             are those of the line before.
 *
 * Decided here, and why
 *   Place     yzx_list.h: how the place in the priority list is found.
 *   Halves    A face that is divided after it has been shown on some lines is
 *             divided on those to come. Its halves are found anew on every line.
 *             They meet at the implied edge.
 *   Kept      A segment keeps the place that it had in the involved list on the
 *             line before, without a test, if no end of another segment has
 *             crossed its left end since, and no segment that covers its left
 *             end has come or gone. The paper asks this of visible edges only.
 *             But hidden segments must keep their places too, since they may
 *             come into view.
 *
 * Glass       The list of those involved is "an ordered set of surfaces" at each
 *             point. The paper would have it serve transparency, and shadows.
 *             From the first opaque segment of the list on, towards its front,
 *             segments are combined (docs/transparent-picture.md). This is done
 *             anew wherever the list changes. No shadows are drawn.
 *
 * What came of it
 *             After the Z sort no depth is compared, but for implied edges. The
 *             Z sort depends on the faces and hardly on the number of lines
 *             (surfaces/scan_line_test.c of the tests). But it compares each
 *             face that enters with all that are active, also with those that
 *             lie apart in X and with those that are never seen together.
 *
 * Options     implied=carried: two points of an implied edge give the whole
 *             ("Use of Coherence", implied-edge coherence). Its place on a row
 *             is extrapolated from those on two rows. Two comparisons, of the
 *             samples beside it, prove that it is there; they take the place of
 *             four. An edge that lies outside of a segment takes two as ever.
 *             bouknight_implied.c says what was measured.
 *
 * Notation    scan line -> row j; Y buckets of edges and X sort list ->
 *             scan_line.h; Z list -> yzx_list.h; segment -> struct segment,
 *             samples [x0, x1) of a piece; priority number -> number, less is
 *             nearer
 * Invariant   INVOLVED: the segments that cover the current column, in the order
 *             of their numbers
 * Ties        one plane: lower id; all else by hsr_nearer
 * Departures  those of scan_line.h and yzx_list.h
 * Cost        the paper gives none. A face that enters is compared in X with
 *             the active ones, whose mean number is that of segments of a line,
 *             S_l. Its f = 2 H_f/n is the chance that two faces overlap in one
 *             dimension (Newell special, appendix B). So F_r^2 f^2 / 2 pairs
 *             overlap on the screen, and the extents of each are compared once.
 *             A fraction f of them overlap in depth too: their vertices are
 *             compared with planes. Prices are those of Newell's tests: 1, and
 *             for tests 4 to 6 100 a pair, which has eight vertices */
#include "algorithms/engines/light/glass.h"
#include "algorithms/engines/scan_line/scan_line.h"
#include "algorithms/image_space/point/yzx_list.h"
#include "common/answers/kinds/transparent.h"
#include "common/base/numbers.h"

#include <string.h>

enum { IMPLIED }; /* options */
enum { CALCULATE, EXTRAPOLATE };
static const struct hsr_word edges[] = {
    [CALCULATE] = {"calculated", "they are found anew on each line", 0},
    [EXTRAPOLATE] = {"carried", "from two lines on, they are extrapolated", 0},
    {NULL}};
static const struct hsr_option options[] = {
    [IMPLIED] = {"implied", "edges where the halves of a face meet", edges, 0,
                 EXTRAPOLATE, CALCULATE},
    {NULL}};

/* f of the header. */
static double overlap_chance(const struct hsr_table1 *t) {
  return 2 * t->H_f / t->n;
}
/* Not on the line before; not divided. */
static const uint32_t NONE = HSR_NO_ID;

/* What a piece covers on a row, in one strip of its face. */
struct segment {
  const struct yzx_piece *piece;
  uint32_t strip;
  int row;    /* the last one on which it covered a sample; -1: none */
  int x0, x1; /* there */

  struct segment *near, *far; /* neighbours in INVOLVED */
  struct segment *place;      /* what it was put behind */
  uint32_t position;          /* how many were in front of it then */

  /* Ends of segments that are on this row and on the one before are numbered by
   * their order there. NONE: it was not there. */
  uint32_t was_left, was_right;
  bool was_under_gone; /* there, one that is gone covered its left end */

  struct segment *next; /* of its strip; or of those that are free */
};

/* Of a face: the k-th segments from the left of all rows. */
struct strip {
  uint32_t face;
  int row; /* the last one on which it covered a sample */
  int x0, x1;
  struct segment *segments; /* those it has at present */
};

/* A face's strips, and how many have been met on the row. */
struct strips {
  uint32_t first, n;
  int row;
  bool open; /* the n-th has been met, its right end has not */
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
  struct yzx_list list;  /* Z list */
  const struct hsr_screen *screen;
  struct hsr_tally *tally;
  int j;
  uint32_t *ids;           /* of the row */
  struct hsr_glass *glass; /* if the picture is transparent; else NULL */
  bool out_of_memory;
  bool extrapolates; /* implied=carried */

  struct strips *strips;     /* a face */
  struct strip *strip;       /* of all faces */
  struct crossing *crossing; /* of the row, by ascending keys */
  uint32_t n_crossings;

  struct line now, before; /* the row, and the one before */
  struct segment involved; /* where the list begins and ends */
  struct segment *free, *doomed;

  /* Of the ends passed on the row: */
  uint32_t n_known, latest; /* those with numbers, the greatest number + 1 */
  uint32_t n_new;           /* the others: left ends less right ends */
};

/* --- Memory --------------------------------------------------------------- */

static struct segment *new_segment(struct scan *s) {
  enum { AT_ONCE = 64 };
  if (!s->free) {
    struct segment *more =
        HSR_NEW(s->edges.job->scratch, struct segment, AT_ONCE);
    s->out_of_memory |= !more;
    for (int k = 0; more && k < AT_ONCE; k++) {
      more[k].next = s->free;
      s->free = &more[k];
    }
  }
  struct segment *segment = s->free;
  if (segment)
    s->free = segment->next;
  return segment;
}

/* Takes a segment from its strip. It is freed only once the line before, which
 * may name it, is done with. */
static void doom(struct scan *s, struct segment *segment) {
  struct segment **link = &s->strip[segment->strip].segments;
  while (*link != segment)
    link = &(*link)->next;
  *link = segment->next;
  segment->next = s->doomed;
  s->doomed = segment;
}

static void free_doomed(struct scan *s) {
  while (s->doomed) {
    struct segment *segment = s->doomed;
    s->doomed = segment->next;
    segment->next = s->free;
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

/* --- The involved list ---------------------------------------------------- */

static void insert_behind(struct segment *place, struct segment *segment) {
  segment->near = place;
  segment->far = place->far;
  place->far->near = segment;
  place->far = segment;
}

static void take_out(struct segment *segment) {
  segment->near->far = segment->far;
  segment->far->near = segment->near;
}

/* --- Segments of the row -------------------------------------------------- */

/* Pairs the edges of the X sort list: the first of a face opens a segment, the
 * second closes it. */
static void find_crossings(struct scan *s) {
  const struct hsr_window *w = s->edges.window;
  uint32_t n = 0;
  for (uint32_t k = 0; k < s->edges.n_list; k++) {
    const struct hsr_scan_edge *edge = &s->edges.edge[s->edges.list[k]];
    struct strips *strips = &s->strips[edge->face];
    if (strips->row != s->j) {
      strips->row = s->j;
      strips->n = 0;
    }
    uint32_t number = strips->first + strips->n;
    struct strip *strip = &s->strip[number];
    int column = hsr_max_int(w->x0, hsr_min_int(w->x1, edge->column));
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

static bool is_nearer(const struct scan *s, uint32_t f, uint32_t g, int i) {
  HSR_TOUCH(s->tally, i, s->j);
  bool nearer = hsr_nearer(s->screen, f, g, i, s->j, s->tally);
  HSR_STEP(s->tally, YZX_IMPLIED, HSR_FACE(f), HSR_FACE(g), HSR_AT(i, s->j),
           nearer);
  return nearer;
}

/* The first sample of [x0, x1) at which the planes of f and g are not in the
 * order of x0; x1 if there is none. *f_first: f is nearer at x0. */
static int search_implied_edge(const struct scan *s, uint32_t f, uint32_t g,
                               int x0, int x1, bool *f_first) {
  *f_first = is_nearer(s, f, g, x0);
  if (is_nearer(s, f, g, x1 - 1) == *f_first)
    return x1;
  return hsr_scan_crossing(&s->edges, f, g, *f_first, x0, x1, s->j,
                           YZX_IMPLIED);
}

/* Whether the planes of f and g meet between sample `column` and the one before.
 * *f_first: f is nearer there. */
static bool is_at(const struct scan *s, uint32_t f, uint32_t g, int column,
                  bool *f_first) {
  HSR_STEP(s->tally, YZX_VERIFIED, HSR_FACE(f), HSR_FACE(g),
           HSR_AT(column, s->j), 0);
  *f_first = is_nearer(s, f, g, column - 1);
  if (is_nearer(s, f, g, column) != *f_first)
    return true;
  HSR_STEP(s->tally, YZX_FAILED, HSR_FACE(f), HSR_FACE(g), HSR_AT(column, s->j),
           0);
  return false;
}

/* The same with implied=carried: where the edge is expected, the two samples
 * beside it are compared. If they have opposite orders, the edge is there, and
 * no others are compared. */
static int find_implied_edge(const struct scan *s, struct yzx_piece *piece,
                             int x0, int x1, bool *f_first) {
  uint32_t f = piece->face, g = piece->by;
  struct hsr_implied *implied = &piece->implied;
  if (!s->extrapolates)
    return search_implied_edge(s, f, g, x0, x1, f_first);
  if (implied->points == 2) {
    int column = hsr_implied_column(implied, &s->edges, s->j);
    bool inside = column > x0 && column < x1;
    HSR_STEP(s->tally, YZX_PREDICTED, HSR_FACE(f), HSR_FACE(g),
             HSR_ON(x0, x1, s->j), inside);
    if (inside && is_at(s, f, g, column, f_first))
      return column;
  }
  int middle = search_implied_edge(s, f, g, x0, x1, f_first);
  if (middle < x1 && hsr_implied_note(implied, &s->edges, f, g, s->j))
    HSR_STEP(s->tally, YZX_POINTS, HSR_FACE(f), HSR_FACE(g),
             HSR_ON(x0, x1, s->j), 0);
  return middle;
}

static void set_segment(struct scan *s, struct segment *segment, int x0,
                        int x1) {
  segment->row = s->j;
  segment->x0 = x0;
  segment->x1 = x1;
  segment->was_left = segment->was_right = NONE;
}

/* The segment of a piece in a strip; NULL if memory ran out. */
static struct segment *segment_of(struct scan *s, uint32_t number,
                                  const struct yzx_piece *piece) {
  struct strip *strip = &s->strip[number];
  struct segment *segment = strip->segments;
  while (segment && segment->piece != piece)
    segment = segment->next;
  if (!segment && (segment = new_segment(s))) {
    *segment = (struct segment){
        .piece = piece, .strip = number, .row = -1, .next = strip->segments};
    strip->segments = segment;
  }
  return segment;
}

/* Deals the samples [x0, x1) of a strip out to the halves of a piece. */
static void find_halves(struct scan *s, uint32_t number,
                        struct yzx_piece *piece, int x0, int x1) {
  if (s->out_of_memory)
    return;
  if (piece->by == NONE) {
    struct segment *segment = segment_of(s, number, piece);
    if (!segment)
      return;
    set_segment(s, segment, x0, x1);
    insert_end(s, segment, 2 * x0 + 1);
    insert_end(s, segment, 2 * x1);
    return;
  }
  bool in_front;
  int middle = find_implied_edge(s, piece, x0, x1, &in_front);
  find_halves(s, number, piece->half[!in_front], x0, middle);
  if (middle < x1)
    find_halves(s, number, piece->half[in_front], middle, x1);
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
    const struct yzx_piece *piece = s->list.root[strip->face];
    struct segment *segment;
    if (strip->x0 >= strip->x1)
      continue;
    if (piece->by != NONE) {
      divided = true;
      continue;
    }
    if (!(segment = segment_of(s, c->strip, piece)))
      return;
    if (c->key & 1)
      set_segment(s, segment, strip->x0, strip->x1);
    s->now.end[s->now.n++] = (struct end){c->key, segment};
  }
  for (uint32_t k = 0; divided && k < s->n_crossings; k++) {
    uint32_t number = s->crossing[k].strip;
    const struct strip *strip = &s->strip[number];
    struct yzx_piece *piece = s->list.root[strip->face];
    if (s->crossing[k].key & 1 && strip->x0 < strip->x1 && piece->by != NONE)
      find_halves(s, number, piece, strip->x0, strip->x1);
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
    if (!left)
      doom(s, segment);
  }
  free_doomed(s);
}

/* --- The place of a segment ----------------------------------------------- */

static bool is_in_front(const struct scan *s, const struct segment *a,
                        const struct segment *b) {
  bool in_front = a->piece->number < b->piece->number;
  HSR_STEP(s->tally, YZX_PRIORITY, HSR_FACE(a->piece->face),
           HSR_FACE(b->piece->face), HSR_AT(b->x0, s->j), in_front);
  return in_front;
}

/* What a segment is to be put behind. It begins at the position that it had when
 * it entered on the line before, and moves to the front or to the back. */
static struct segment *find_place(struct scan *s, struct segment *segment) {
  struct segment *end = &s->involved, *place = end;
  uint32_t position = 0;
  for (; position < segment->position && place->far != end; position++)
    place = place->far;
  bool moved = false;
  for (; place != end && !is_in_front(s, place, segment); position--) {
    place = place->near;
    moved = true;
  }
  for (; !moved && place->far != end && is_in_front(s, place->far, segment);
       position++)
    place = place->far;
  segment->position = position;
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
  HSR_STEP(s->tally, YZX_SEGMENTS, HSR_FACE(segment->piece->face),
           HSR_THE_WINDOW, HSR_ON(segment->x0, segment->x1, s->j), 0);
  if (place_is_kept(s, segment))
    HSR_STEP(s->tally, YZX_KEPT, HSR_FACE(segment->piece->face),
             HSR_FACE(segment->place->piece->face),
             HSR_ON(segment->x0, segment->x1, s->j), 0);
  else
    segment->place = find_place(s, segment);
  insert_behind(segment->place, segment);
}

/* --- X sort --------------------------------------------------------------- */

static void pass_end(struct scan *s, struct end end) {
  bool left = end.key & 1;
  if (left)
    enter(s, end.segment);
  else
    take_out(end.segment);

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
  HSR_STEP(s->tally, YZX_SPANS, HSR_FACE(id), HSR_THE_WINDOW,
           HSR_ON(left, right, s->j), 0);
  HSR_TOUCH_SPAN(s->tally, left, right, s->j);
  for (int i = left; i < right; i++)
    s->ids[i] = id;
}

/* The colour of the involved segments, from the first opaque one on. */
static void combine(struct scan *s, int left, int right, uint16_t rgb[3]) {
  const struct segment *a = s->involved.far;
  while (a != &s->involved && hsr_is_glass(s->glass, a->piece->face))
    a = a->far;
  if (a == &s->involved)
    hsr_glass_clear(s->glass, rgb);
  else
    hsr_glass_over(s->glass, a->piece->face, rgb);
  (void)left, (void)right; /* for the trace */
  for (a = a->near; a != &s->involved; a = a->near) {
    HSR_STEP(s->tally, YZX_COMBINED, HSR_FACE(a->piece->face), HSR_THE_WINDOW,
             HSR_ON(left, right, s->j), 0);
    hsr_glass_over(s->glass, a->piece->face, rgb);
  }
}

/* A span between two changes of the involved list. */
static void write_glass(struct scan *s, int left, int right) {
  uint16_t rgb[3] = {0};
  if (left == right)
    return;
  combine(s, left, right, rgb);
  HSR_ACCEPTED(s->tally, YZX_SPANS, HSR_FACE(s->involved.far->piece->face),
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
    uint32_t id = s->involved.far->piece->face;
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

/* Solves the row, when its ends are in order. */
static void scan_row(struct scan *s) {
  s->involved.near = s->involved.far = &s->involved;
  s->n_known = s->latest = s->n_new = 0;
  pass_ends(s);
}

/* --- The algorithm -------------------------------------------------------- */

/* What is seen where no segment is involved. */
static const struct yzx_piece background = {.face = HSR_BACKGROUND};

static enum hsr_status allocate(struct scan *s) {
  const struct hsr_world *world = s->edges.job->world;
  struct hsr_arena *arena = s->edges.job->scratch;
  size_t most_ends = s->edges.most_edges + 1;
  s->strips = HSR_NEW(arena, struct strips, world->n_faces);
  s->strip = HSR_NEW(arena, struct strip, most_ends / 2);
  s->crossing = HSR_NEW(arena, struct crossing, most_ends);
  s->now.end = HSR_NEW(arena, struct end, most_ends);
  s->before.end = HSR_NEW(arena, struct end, most_ends);
  s->now.room = s->before.room = most_ends;
  if (!s->strips || !s->strip || !s->crossing || !s->now.end || !s->before.end)
    return HSR_E_NOMEM;

  uint32_t n_strips = 0;
  for (uint32_t r = 0; r < s->screen->n_relevant; r++) {
    uint32_t f = s->screen->relevant[r];
    uint32_t n = hsr_face_size(world, f) / 2 + (s->screen->whole[f] ? 0 : 2);
    s->strips[f] = (struct strips){.first = n_strips, .row = -1};
    for (uint32_t k = 0; k < n; k++)
      s->strip[n_strips++] = (struct strip){.row = -1};
  }
  s->involved.piece = &background;
  return HSR_OK;
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct scan scan = {.screen = &scan.edges.screen,
                      .tally = job->tally,
                      .extrapolates = job->option[IMPLIED] == EXTRAPOLATE};
  struct hsr_glass glass;
  if (hsr_scan_begin(&scan.edges, job) ||
      yzx_list_begin(&scan.list, job, scan.screen) || allocate(&scan) ||
      (hsr_answer_colours_of(job->answer) && hsr_glass_begin(&glass, job)))
    return hsr_fail_nomem(err);
  scan.glass = hsr_answer_colours_of(job->answer) ? &glass : NULL;

  const struct hsr_window *w = &job->view->window;
  for (scan.j = w->y0; scan.j < w->y1; scan.j++) {
    if (job->answer->ids)
      scan.ids = hsr_job_row(job, scan.j);
    yzx_list_advance(&scan.list, scan.j);
    if (scan.list.out_of_memory)
      return hsr_fail_nomem(err);
    hsr_scan_advance(&scan.edges, scan.j);
    find_crossings(&scan);
    find_segments(&scan);
    if (scan.out_of_memory)
      return hsr_fail_nomem(err);
    compare_lines(&scan);
    scan_row(&scan);
  }
  return HSR_OK;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {{&hsr_scan_part}, {NULL}};

static const struct hsr_counter counters[] = {
    [YZX_FACES] = {"Y order", "faces put into Y buckets", HSR_SORT, HSR_OF_FACE,
                   HSR_OF_NOTHING},
    [YZX_MINIMAX] = {"minimax tests",
                     "tests 2 and 3: bounds of one that enters compared with "
                     "those of an active one, in X or in Y",
                     HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE,
                     "test 2: apart in X|test 2: overlap in X|test 3: apart in "
                     "Y|test 3: overlap in Y",
                     .outcome_keys = "boxes|boxes|boxes|boxes"},
    [YZX_Z_MINIMAX] = {"Z minimax",
                       "test 1: extents in depth compared, where the bounds "
                       "overlap",
                       HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE,
                       "overlap|nearer|farther",
                       .outcome_keys = "boxes|boxes|boxes"},
    [YZX_Z_SORT] =
        {"Z sort", "tests 4 and 5: vertices compared with another face's plane",
         HSR_COMPARE, HSR_OF_VERTEX, HSR_OF_FACE,
         "on the plane|in front|behind"},
    [YZX_PIECES] = {"piece tests",
                    "tests 4 and 5: what is left of a face compared with "
                    "another's plane",
                    HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE,
                    "not known|in front|behind"},
    [YZX_ROWS] = {"overlap rows",
                  "test 6: rows on which the samples of both are compared",
                  HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE, "apart|meet"},
    [YZX_MOVED] = {"interchanges", "active faces moved behind one that enters",
                   HSR_SORT, HSR_OF_FACE, HSR_OF_FACE},
    [YZX_DIVISIONS] = {"divisions", "faces divided by another's plane",
                       HSR_SPLIT, HSR_OF_FACE, HSR_OF_FACE,
                       .key = "face-division"},
    [YZX_CIRCLES] = {"circle search",
                     "planes tried to divide a face of a cyclic overlap",
                     HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE,
                     "does not pass through|passes through"},
    [YZX_IMPLIED] = {"implied edges",
                     "depths compared to find where the halves of a face meet "
                     "on a line",
                     HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE, "farther|nearer"},
    [YZX_POINTS] = {"penetrations",
                    "penetration points calculated of two planes", HSR_SAMPLE,
                    HSR_OF_FACE, HSR_OF_FACE},
    [YZX_PREDICTED] = {"extrapolations",
                       "penetration points extrapolated from two lines",
                       HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE,
                       "outside of the segment|inside"},
    [YZX_VERIFIED] = {"verifications",
                      "of these, points that samples beside them were to prove",
                      HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE},
    [YZX_FAILED] = {"failures", "of these, points that were not there",
                    HSR_REJECT, HSR_OF_FACE, HSR_OF_FACE},
    [YZX_SEGMENTS] = {"segments", "segments entered into the involved list",
                      HSR_ACTIVATE, HSR_OF_FACE, HSR_OF_WINDOW},
    [YZX_KEPT] =
        {"places kept",
         "of these, without a test, where they stood on the line before",
         HSR_SORT, HSR_OF_FACE, HSR_OF_FACE},
    [YZX_PRIORITY] = {"priority tests", "priority numbers compared",
                      HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE, "farther|nearer"},
    [YZX_COMBINED] = {"combined",
                      "transparent segments put over what is behind",
                      HSR_SAMPLE, HSR_OF_FACE, HSR_OF_WINDOW},
    [YZX_SPANS] = {"spans", "sample spans shown", HSR_ACCEPT, HSR_OF_FACE,
                   HSR_OF_WINDOW},
    {NULL}};

static const struct hsr_line outline[] = {
    {"put each face into the Y bucket of its first scan line",
     HSR_RAISES(YZX_FACES)},
    {"", .part = &hsr_scan_part},
    {"  Z list, before X: delete the faces that exit; for each that enters"},
    {"    for each active face: do they overlap in X, and in Y?",
     HSR_RAISES(YZX_MINIMAX)},
    {"      do their extents in depth overlap?", HSR_RAISES(YZX_Z_MINIMAX)},
    {"        vertices of one against the plane of the other",
     HSR_RAISES(YZX_Z_SORT, YZX_PIECES)},
    {"        have they a sample in common on the lines to come?",
     HSR_RAISES(YZX_ROWS)},
    {"          divide the face that ends sooner: its halves enter",
     HSR_RAISES(YZX_DIVISIONS)},
    {"    put it between those that it follows and those that it precedes"},
    {"      if these stand in the wrong order: move some behind it",
     HSR_RAISES(YZX_MOVED)},
    {"      if the order is cyclic: find a plane that passes through a face",
     HSR_RAISES(YZX_CIRCLES)},
    {"  number the active faces in the order of the Z list"},
    {"  pair the edges of each face into segments; find implied edges of those "
     "divided",
     HSR_RAISES(YZX_IMPLIED)},
    {"  for each end of a segment, from the left"},
    {"    a left end: enter the segment into the list of those involved",
     HSR_RAISES(YZX_SEGMENTS)},
    {"      the same ones as on the line before: it keeps its place",
     HSR_RAISES(YZX_KEPT)},
    {"      else from its position there, compare priority numbers: bubble "
     "sort",
     HSR_RAISES(YZX_PRIORITY)},
    {"    a right end: delete the segment from the list"},
    {"    put the transparent ones of those involved over the first opaque one",
     HSR_RAISES(YZX_COMBINED)},
    {"    show the first of those involved where another begins to be it",
     HSR_RAISES(YZX_SPANS)},
    {"  where implied edges are carried: calculate two points of each, and "
     "extrapolate",
     HSR_RAISES(YZX_POINTS, YZX_PREDICTED, YZX_VERIFIED, YZX_FAILED)},
    {NULL}};

static double predict_minimax(const struct hsr_table1 *t) {
  return t->F_r * t->S_l;
}

static double predict_z_minimax(const struct hsr_table1 *t) {
  return pow(t->F_r * overlap_chance(t), 2) / 2;
}

static double predict_z_sort(const struct hsr_table1 *t) {
  return 100 * overlap_chance(t) * predict_z_minimax(t);
}

static const struct hsr_step steps[] = {
    {"minimax tests", YZX_MINIMAX, HSR_KIND_BOX, "F_r S_l (ours)",
     predict_minimax},
    {"Z minimax", YZX_Z_MINIMAX, HSR_KIND_BOX,
     "F_r^2 f^2 / 2, f = 2 H_f/n (ours)", predict_z_minimax},
    {"Z sort",
     YZX_Z_SORT,
     HSR_KIND_CORNER_PLANE,
     "50 F_r^2 f^3, f = 2 H_f/n (ours)",
     predict_z_sort,
     {{YZX_PIECES, HSR_KIND_PIECE},
      {YZX_DIVISIONS, HSR_KIND_FACES},
      {YZX_MOVED, HSR_KIND_LIST}}},
    {"overlap on rows", YZX_ROWS, HSR_KIND_LINE},
    {"circle search", YZX_CIRCLES, HSR_KIND_PIECE},
    {"implied edges",
     YZX_IMPLIED,
     HSR_KIND_SPAN,
     NULL,
     NULL,
     {{YZX_PREDICTED, HSR_KIND_NUMBERS}}},
    {"priority tests", YZX_PRIORITY, HSR_KIND_NUMBERS},
    {NULL}};

static const struct hsr_sort sorts[] = {
    {"faces, edges", "Y", "bucket sort", "once a frame"},
    {"faces", "Z", "Newell's tests against the active ones", "as they enter"},
    {"faces", "Z", "insertion into the priority list", "as they enter"},
    {"edges", "X", "merge", "as they enter"},
    {"edges", "X", "bubble sort", "once a scan line"},
    {"segments", "X", "bubble sort by priority number", "once a scan line"},
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
    .options = options,
    .render = render};
