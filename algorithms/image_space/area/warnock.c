/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Warnock's area subdivision: a window that is not homogeneous is divided into
 * four.
 *
 * Source      J. E. Warnock, "A hidden-surface algorithm for computer-generated
 *             halftone pictures", University of Utah, TR 4-15, 1969; as
 *             described by Sutherland et al. 1974, "J. E. Warnock", figures 25
 *             and 26, and appendix B. The early end of the search in Z order is
 *             theirs too, under "Sorting".
 * Notation    window -> struct window, a rectangle of samples, whose corners
 *             are samples; surrounder, intersecter, disjoint -> enum relation;
 *             ancestral information -> struct listed, and the window's part of
 *             list[]; critical surround -> struct depths
 * Invariants  when examine() begins, and when it ends, list[0, n) holds in Z
 *             order the faces that the enclosing window leaves open: they are
 *             neither disjoint from it nor hidden by one of its surrounders. A
 *             face of these surrounds an enclosing window if and only if its
 *             `since` is less than the level of the window examined.
 * Ties        by hsr_nearer at a sample; over a window, faces of one plane by
 *             the lower id, all else by depths farther apart than their errors
 * Departures  the corners of a window are samples, and the raster element is a
 *             sample, since the picture is one of samples;
 *             a face that is behind a surrounder is hidden in all sub-windows
 *             too: it is left out of them, as a disjoint one is;
 *             a window one sample wide or high is divided into two
 * Cost        Z sort 2 F_r, Warnock special 100 L_v D_c, depth search L_v D_c
 *
 * A relation is proved for all samples of the window. If it cannot be proved,
 * the face is taken for an intersecter, which costs a subdivision and no more.
 * Let H be the rectangle of the window's corner samples. If no edge of a face
 * meets H then H lies wholly inside the face or wholly outside, and one corner
 * tells which. An edge does not meet H if both its ends lie beyond the same
 * side of H, or if all corners lie on one side of its line.
 *
 * Edges in doubles, delta = HSR_DELTA: measured from the centre of H, the ends
 * a and b of an edge are within delta + 2^-37 of the true ones (screen.c). With
 * d = b - a, and hw, hh half the width and height of H, dx hy - dy hx is at a
 * corner within r = |dx| hh + |dy| hw of its value e at the centre. The
 * reasoning of screen.c for edge sides, with |h| <= |a| + (hw, hh) at every
 * corner, bounds the error of e, and of e +- r, by 2.1 delta (|dx| + |dy| +
 * |ax| + |ay| + hw + hh) + 4.2 delta^2, the few roundings more of the centre,
 * of hw, hh and r included, each no more than 2^-8 delta of that; the filter
 * takes 4 and 8.
 *
 * A face that is cut by the eye or the near plane covers a sample if the parity
 * of its edges says so and its plane lies past near there. The parity is that
 * of the lines through the eye that meet the polygon. It, too, is constant on H
 * if no edge has a point on such a line. The same two tests prove this, by the
 * row sides and edge sides of the definition. An edge in line with the eye never
 * crosses a row, though its ends may be on different sides of some. So parity
 * changes where the row passes an end, and H must not hold such a row. On H the plane lies past near if
 * it does at the corners, both conditions, q > 0 and near q < 1, being linear
 * in the depth q; and nowhere if one of them fails at all corners. */
#include "algorithms/image_space/area/warnock.h"

#include <float.h>
#include <string.h>

/* Of the variant that divides at vertices. */
enum { AT_VERTEX = HSR_N_WARNOCK_COUNTERS };

static const struct hsr_counter counters[] = {HSR_WARNOCK_COUNTERS, {NULL}};

static const struct hsr_line outline[] = {HSR_WARNOCK_LINES, {NULL}};

static const struct hsr_counter counters_at_vertices[] = {
    HSR_WARNOCK_COUNTERS,
    [AT_VERTEX] = {"at vertices", "windows divided at a vertex", HSR_SUBDIVIDE,
                   HSR_OF_WINDOW, HSR_OF_VERTEX},
    {NULL}};

static const struct hsr_line outline_at_vertices[] = {
    HSR_WARNOCK_LINES,
    {"    at the vertex nearest to its centre, if one is in the window",
     HSR_RAISES(AT_VERTEX)},
    {NULL}};

static const struct hsr_step steps[] = {HSR_WARNOCK_STEPS, {NULL}};

static const struct hsr_sort sorts[] = {HSR_WARNOCK_SORTS, {NULL}};

/* The Z sort: two passes of 9 bits. */
enum { DIGIT_BITS = 9, RADIX = 1 << DIGIT_BITS };

/* No more than 14 subdivisions at the centre lead down to a sample. At vertices
 * they may do worse, and so end at a level. */
enum { LAST_VERTEX_LEVEL = 28, NEVER = 255 };

_Static_assert(HSR_MAX_SIZE <= INT16_MAX, "bounds of struct listed");

/* Figure 26; and a face that lies behind a surrounder. */
enum relation { DISJOINT, INTERSECTER, SURROUNDER, HIDDEN };

/* A face in the list of a window. */
struct listed {
  uint32_t id;
  uint32_t z;             /* no sample of the face is nearer, as z_key() */
  int16_t x0, y0, x1, y1; /* its bounds */
  uint8_t relation;       /* to the window examined last */
  uint8_t since;          /* level of the largest window it is known to
                             surround; NEVER */
};

struct window {
  int x0, y0, x1, y1; /* columns [x0, x1), rows [y0, y1) */
  int level;          /* of subdivision, 0 the picture */
  /* On the screen: of the first and the last column and row; the centre. */
  double sx[2], sy[2], centre_x, centre_y, half_width, half_height;
};

struct state {
  const struct hsr_job *job;
  struct hsr_tally *tally;
  const struct hsr_screen *screen;
  bool at_vertices;                    /* subdivide at vertices */
  const struct hsr_finisher *finisher; /* NULL: there is none */

  struct listed *list;  /* the relevant faces */
  struct listed *aside; /* as many, for sorting and setting aside */
  uint32_t *open;       /* the finisher's: ids of a window's faces */
  int *columns;         /* room for the spans of the largest face */
  uint32_t n_disjoint;  /* faces left out of list[0, n), being disjoint */
  uint32_t n_hidden;    /* or hidden */
};

/* --- Z sort --------------------------------------------------------------- */

/* q as a number of 18 bits, whose order it keeps: of 1/t from 0 up, and in
 * parallel of -t down from 0. */
static uint32_t z_key(const struct hsr_view *view, double q) {
  double size = view->parallel ? -q : q;
  float value = size > 0 ? (float)fmin(size, FLT_MAX) : 0;
  uint32_t bits;
  memcpy(&bits, &value, sizeof bits);
  bits >>= 31 - 2 * DIGIT_BITS;
  return view->parallel ? (1u << 2 * DIGIT_BITS) - 1 - bits : bits;
}

static struct listed list_face(const struct hsr_screen *screen, uint32_t f) {
  const struct hsr_bounds *b = &screen->bounds[f];
  double nearest = -INFINITY;
  for (int corner = 0; corner < 4; corner++) {
    double q = hsr_depth(screen, f, corner & 1 ? b->x1 - 1 : b->x0,
                         corner & 2 ? b->y1 - 1 : b->y0);
    nearest = q > nearest ? q : nearest;
  }
  return (struct listed){
      .id = f,
      .z = z_key(screen->view, nearest + 2 * screen->plane[f].error),
      .x0 = (int16_t)b->x0,
      .y0 = (int16_t)b->y0,
      .x1 = (int16_t)b->x1,
      .y1 = (int16_t)b->y1,
      .since = NEVER};
}

/* One pass of the sort: by one digit of z, the greatest first. */
static void sort_by_digit(struct state *s, const struct listed *from,
                          struct listed *to, int shift) {
  uint32_t n = s->screen->n_relevant, start[RADIX + 1] = {0};
  for (uint32_t k = 0; k < n; k++)
    start[RADIX - (from[k].z >> shift) % RADIX]++;
  for (int digit = 0; digit < RADIX; digit++)
    start[digit + 1] += start[digit];
  for (uint32_t k = 0; k < n; k++) {
    to[start[RADIX - 1 - (from[k].z >> shift) % RADIX]++] = from[k];
    HSR_STEP(s->tally, HSR_WARNOCK_Z_SORT, HSR_FACE(from[k].id), HSR_NOTHING,
             hsr_window_make(from[k].x0, from[k].y0, from[k].x1, from[k].y1),
             0);
  }
}

static void sort_z(struct state *s) {
  for (uint32_t r = 0; r < s->screen->n_relevant; r++)
    s->list[r] = list_face(s->screen, s->screen->relevant[r]);
  sort_by_digit(s, s->list, s->aside, 0);
  sort_by_digit(s, s->aside, s->list, DIGIT_BITS);
}

/* --- Warnock special: a face against a window ----------------------------- */

static struct window make_window(const struct state *s,
                                 struct hsr_window samples, int level) {
  const struct hsr_view *view = s->job->view;
  struct window w = {.x0 = samples.x0,
                     .y0 = samples.y0,
                     .x1 = samples.x1,
                     .y1 = samples.y1,
                     .level = level};
  w.sx[0] = hsr_sample_x(view, w.x0);
  w.sx[1] = hsr_sample_x(view, w.x1 - 1);
  w.sy[0] = hsr_sample_y(view, w.y0);
  w.sy[1] = hsr_sample_y(view, w.y1 - 1);
  w.centre_x = (w.sx[0] + w.sx[1]) / 2;
  w.centre_y = (w.sy[0] + w.sy[1]) / 2;
  w.half_width = (w.sx[1] - w.sx[0]) / 2;
  w.half_height = (w.sy[1] - w.sy[0]) / 2;
  return w;
}

static bool is_sample(const struct window *w) {
  return w->x1 - w->x0 == 1 && w->y1 - w->y0 == 1;
}

static inline struct hsr_window samples_of(const struct window *w) {
  return hsr_window_make(w->x0, w->y0, w->x1, w->y1);
}

/* Corner 0, 1, 2, 3 of a window: a sample. */
static int corner_column(const struct window *w, int corner) {
  return corner & 1 ? w->x1 - 1 : w->x0;
}
static int corner_row(const struct window *w, int corner) {
  return corner & 2 ? w->y1 - 1 : w->y0;
}

/* Both ends of the edge lie above the window, or both below. */
static bool passes_by_rows(const struct state *s, uint32_t a, uint32_t b,
                           const struct window *w) {
  int side = hsr_row_side(s->screen, a, w->y0, s->tally);
  return side == hsr_row_side(s->screen, b, w->y0, s->tally) &&
         side == hsr_row_side(s->screen, a, w->y1 - 1, s->tally) &&
         side == hsr_row_side(s->screen, b, w->y1 - 1, s->tally);
}

/* Vertex v is above all rows of the window, or below all. */
static bool keeps_side(const struct state *s, uint32_t v,
                       const struct window *w) {
  return hsr_row_side(s->screen, v, w->y0, s->tally) ==
         hsr_row_side(s->screen, v, w->y1 - 1, s->tally);
}

/* All corners of the window lie on one side of the edge's line. An edge that is
 * in line with the eye has no sides, and crosses no row: there the row sides of
 * its ends must be the same in all of the window. */
static bool corners_agree(const struct state *s, uint32_t a, uint32_t b,
                          const struct window *w) {
  int side = hsr_edge_side(s->screen, a, b, w->x0, w->y0, s->tally);
  if (!side)
    return keeps_side(s, a, w) && keeps_side(s, b, w);
  for (int corner = 1; corner < 4; corner++)
    if (hsr_edge_side(s->screen, a, b, corner_column(w, corner),
                      corner_row(w, corner), s->tally) != side)
      return false;
  return true;
}

/* The edge certainly has no point among the samples of the window, nor between
 * them. */
static bool passes_by(const struct state *s, uint32_t a, uint32_t b,
                      const struct window *w) {
  const double *sx = s->screen->sx, *sy = s->screen->sy;
  double ax = sx[a] - w->centre_x, ay = sy[a] - w->centre_y;
  double bx = sx[b] - w->centre_x, by = sy[b] - w->centre_y;
  double right = w->half_width + 2 * HSR_DELTA;
  double below = w->half_height + 2 * HSR_DELTA;
  if ((ax > right && bx > right) || (ax < -right && bx < -right) ||
      (ay > below && by > below) || (ay < -below && by < -below))
    return true;

  double dx = bx - ax, dy = by - ay;
  double e = fabs(dy * ax - dx * ay);
  double r = fabs(dx) * w->half_height + fabs(dy) * w->half_width;
  double bound = 4 * HSR_DELTA *
                     (fabs(dx) + fabs(dy) + fabs(ax) + fabs(ay) +
                      w->half_width + w->half_height) +
                 8 * HSR_DELTA * HSR_DELTA;
  if (e > r + bound)
    return true;
  if (e < r - bound)
    return false;
  return passes_by_rows(s, a, b, w) || corners_agree(s, a, b, w);
}

/* Some edge of the face may meet the window. */
static bool edges_meet(const struct state *s, uint32_t f,
                       const struct window *w) {
  const struct hsr_world *world = s->job->world;
  const uint32_t *vertex = world->mesh.vertex + world->mesh.start[f];
  uint32_t n = hsr_face_size(world, f);
  for (uint32_t k = 0, last = n - 1; k < n; last = k++)
    if (!passes_by(s, vertex[last], vertex[k], w))
      return true;
  return false;
}

/* The relation of a cut face of which no edge meets the window. Twice the error
 * of its depths leaves room for rounding here. */
static enum relation relate_cut(const struct state *s, uint32_t f,
                                const struct window *w) {
  const struct hsr_screen *screen = s->screen;
  const struct hsr_view *view = s->job->view;
  double near = view->near, error = 2 * screen->plane[f].error;
  int n_behind = 0, n_before_near = 0, n_covered = 0;
  for (int corner = 0; corner < 4; corner++) {
    int i = corner_column(w, corner), j = corner_row(w, corner);
    double q = hsr_depth(screen, f, i, j);
    bool covered = hsr_covers(screen, f, i, j, s->tally);
    /* Past near but not covered: so the parity is even, in all of H. */
    if (!covered && (view->parallel ? q + error < -near
                                    : q > error && near * (q + error) < 1))
      return DISJOINT;
    n_covered += covered;
    n_behind += !view->parallel && q < -error;
    n_before_near +=
        view->parallel ? q - error > -near : near * (q - error) > 1;
  }
  if (n_behind == 4 || n_before_near == 4)
    return DISJOINT;
  return n_covered == 4 ? SURROUNDER : INTERSECTER;
}

static enum relation relate(const struct state *s, const struct listed *f,
                            const struct window *w) {
  bool apart =
      f->x1 <= w->x0 || f->x0 >= w->x1 || f->y1 <= w->y0 || f->y0 >= w->y1;
  bool reaches_over =
      f->x0 <= w->x0 && f->x1 >= w->x1 && f->y0 <= w->y0 && f->y1 >= w->y1;
  bool contained =
      f->x0 >= w->x0 && f->x1 <= w->x1 && f->y0 >= w->y0 && f->y1 <= w->y1;
  if (apart || (contained && !reaches_over)) {
    enum relation relation = apart ? DISJOINT : INTERSECTER;
    HSR_STEP(s->tally, HSR_WARNOCK_MINIMAX, HSR_FACE(f->id), HSR_THE_WINDOW,
             samples_of(w), (int)relation);
    return relation;
  }
  if (!is_sample(w)) {
    if (edges_meet(s, f->id, w))
      return INTERSECTER;
    if (!reaches_over)
      return DISJOINT;
    if (!s->screen->whole[f->id])
      return relate_cut(s, f->id, w);
  }
  return hsr_covers(s->screen, f->id, w->x0, w->y0, s->tally) ? SURROUNDER
                                                              : DISJOINT;
}

/* The depths of a face's plane at the corners of a window, as hsr_depth. */
struct depths {
  uint32_t id;
  double q[4], error;
};

static struct depths depths_of(const struct state *s, uint32_t f,
                               const struct window *w) {
  const struct hsr_depth_plane *p = &s->screen->plane[f];
  struct depths depths = {.id = f, .error = p->error};
  for (int corner = 0; corner < 4; corner++)
    depths.q[corner] =
        p->a * w->sx[corner & 1] + p->b * w->sy[corner / 2] + p->c;
  return depths;
}

/* The z_key of the farthest sample of surrounder f in the window. */
static uint32_t farthest(const struct state *s, uint32_t f,
                         const struct window *w) {
  struct depths depths = depths_of(s, f, w);
  double q = depths.q[0];
  for (int corner = 1; corner < 4; corner++)
    q = depths.q[corner] < q ? depths.q[corner] : q;
  return z_key(s->job->view, q - 2 * depths.error);
}

/* Finds the relations of the faces in list[0, n) to the window. Stops at the
 * first face in Z order that is behind all of a surrounder, since all later
 * ones are too. Returns the place of that face, or n. */
static uint32_t cull(struct state *s, const struct window *w, uint32_t n) {
  uint32_t z_end = 0, k;
  for (k = 0; k < n && s->list[k].z >= z_end; k++) {
    struct listed *f = &s->list[k];
    if (f->since < w->level) {
      HSR_STEP(s->tally, HSR_WARNOCK_OLD_SURROUNDERS, HSR_FACE(f->id),
               HSR_THE_WINDOW, samples_of(w), 0);
      f->relation = SURROUNDER;
    } else {
      f->relation = (uint8_t)relate(s, f, w);
      f->since = f->relation == SURROUNDER ? (uint8_t)w->level : NEVER;
      HSR_STEP(s->tally, HSR_WARNOCK_SPECIAL, HSR_FACE(f->id), HSR_THE_WINDOW,
               samples_of(w), f->relation);
    }
    if (f->relation == SURROUNDER) {
      uint32_t z = farthest(s, f->id, w);
      z_end = z > z_end ? z : z_end;
    }
  }
  HSR_COMPUTED(s->tally, HSR_WARNOCK_OLD_DISJOINTS, s->n_disjoint);
  HSR_COMPUTED(s->tally, HSR_WARNOCK_HIDDEN_FACES, s->n_hidden + n - k);
  return k;
}

/* --- Depth search --------------------------------------------------------- */

/* Outcomes of a comparison in depth with a surrounder, as
 * HSR_WARNOCK_DEPTH_SEARCH names them. */
enum { UNDECIDED, BEHIND, IN_FRONT };

/* The surrounder that is nearest at the first corner: no other can be the
 * critical one. NULL: there is none. */
static struct listed *nearest_surrounder(struct state *s,
                                         const struct window *w, uint32_t n) {
  struct listed *nearest = NULL;
  for (uint32_t k = 0; k < n; k++) {
    struct listed *f = &s->list[k];
    if (f->relation != SURROUNDER)
      continue;
    if (nearest) {
      bool nearer =
          hsr_nearer(s->screen, f->id, nearest->id, w->x0, w->y0, s->tally);
      HSR_STEP(s->tally, HSR_WARNOCK_DEPTH_SEARCH, HSR_FACE(f->id),
               HSR_FACE(nearest->id), samples_of(w),
               nearer ? IN_FRONT : BEHIND);
      if (!nearer)
        continue;
    }
    nearest = f;
  }
  return nearest;
}

/* +1 if f is nearer than g at all corners of the window, and so between them,
 * -1 if g is, 0 if neither or not certain. */
static int order_in_depth(const struct state *s, const struct depths *f,
                          const struct depths *g) {
  const uint32_t *plane = s->job->world->mesh.plane;
  if (plane[f->id] == plane[g->id])
    return f->id < g->id ? 1 : -1;
  double bound = f->error + g->error;
  int n_nearer = 0, n_farther = 0;
  for (int corner = 0; corner < 4; corner++) {
    double by = f->q[corner] - g->q[corner];
    n_nearer += by > bound;
    n_farther += by < -bound;
  }
  return n_nearer == 4 ? 1 : n_farther == 4 ? -1 : 0;
}

/* Which of a window's faces may be visible. */
struct remains {
  const struct listed *surrounder; /* the nearest; NULL: none */
  const struct listed *other;      /* one of the others; NULL: none */
  uint32_t n_others;               /* not hidden by the surrounder */
  int order;                       /* of surrounder and `other`, in depth */
};

static struct remains search_depth(struct state *s, const struct window *w,
                                   uint32_t n) {
  struct remains remains = {.surrounder = nearest_surrounder(s, w, n)};
  struct depths critical = {.id = HSR_BACKGROUND};
  if (remains.surrounder)
    critical = depths_of(s, remains.surrounder->id, w);
  for (uint32_t k = 0; k < n; k++) {
    struct listed *f = &s->list[k];
    if (f->relation == DISJOINT || f == remains.surrounder)
      continue;
    int order = -1;
    if (remains.surrounder) {
      struct depths depths = depths_of(s, f->id, w);
      order = order_in_depth(s, &critical, &depths);
      HSR_STEP(s->tally, HSR_WARNOCK_DEPTH_SEARCH, HSR_FACE(f->id),
               HSR_FACE(critical.id), samples_of(w),
               order > 0   ? BEHIND
               : order < 0 ? IN_FRONT
                           : UNDECIDED);
    }
    if (order > 0) {
      f->relation = HIDDEN;
      continue;
    }
    remains.other = f;
    remains.order = order;
    remains.n_others++;
  }
  return remains;
}

/* --- Painting ------------------------------------------------------------- */

static void paint(struct state *s, const struct window *w, uint32_t id) {
  for (int j = w->y0; j < w->y1; j++) {
    uint32_t *row = s->job->ids + (size_t)j * s->job->ids_stride;
    for (int i = w->x0; i < w->x1; i++)
      row[i] = id;
  }
}

/* What of face f lies in the window. */
static void paint_face(struct state *s, const struct window *w, uint32_t f) {
  const struct hsr_bounds *bounds = &s->screen->bounds[f];
  int first = bounds->y0 > w->y0 ? bounds->y0 : w->y0;
  int end = bounds->y1 < w->y1 ? bounds->y1 : w->y1;
  for (int j = first; j < end; j++) {
    uint32_t *row = s->job->ids + (size_t)j * s->job->ids_stride;
    int n = hsr_face_spans(s->screen, f, j, s->columns, s->tally);
    for (int k = 0; k < n; k += 2) {
      int x0 = s->columns[k] > w->x0 ? s->columns[k] : w->x0;
      int x1 = s->columns[k + 1] < w->x1 ? s->columns[k + 1] : w->x1;
      if (x0 >= x1)
        continue;
      HSR_STEP(s->tally, HSR_WARNOCK_RUNS, HSR_FACE(f), HSR_THE_WINDOW,
               HSR_ON(x0, x1, j), 0);
      for (int i = x0; i < x1; i++)
        row[i] = f;
    }
  }
}

/* Work picture: n faces were looked at in the window. Each of its samples gets
 * an equal share. */
static void touch(struct state *s, const struct window *w, uint32_t n) {
  float *work = s->tally->work;
  if (!HSR_COUNTING || !work)
    return;
  float share = (float)n / ((float)(w->x1 - w->x0) * (float)(w->y1 - w->y0));
  for (int j = w->y0; j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++)
      work[(size_t)j * s->tally->work_stride + (size_t)i] += share;
}

/* Paints the window if it is homogeneous, or if one intersecter is left, alone
 * or in front of the critical surround. A window of one sample has no
 * intersecters and so is always homogeneous. */
static bool decide(struct state *s, const struct window *w,
                   const struct remains *remains) {
  uint32_t id = remains->surrounder ? remains->surrounder->id : HSR_BACKGROUND;
  bool one = remains->n_others == 1 && remains->order < 0 &&
             remains->other->relation == INTERSECTER;
  int counter;
  if (is_sample(w))
    counter = HSR_WARNOCK_SAMPLES;
  else if (!remains->n_others)
    counter = remains->surrounder ? HSR_WARNOCK_HOMOGENEOUS : HSR_WARNOCK_EMPTY;
  else if (one)
    counter =
        remains->surrounder ? HSR_WARNOCK_ONE_IN_FRONT : HSR_WARNOCK_ONE_FACE;
  else
    return false;
  HSR_STEP(s->tally, counter, HSR_FACE(id),
           one ? HSR_FACE(remains->other->id) : HSR_THE_WINDOW, samples_of(w),
           0);
  paint(s, w, id);
  if (one)
    paint_face(s, w, remains->other->id);
  return true;
}

/* --- Subdivision ---------------------------------------------------------- */

/* Moves the faces of list[0, n) that stay open to the front, in order, and the
 * others behind them, in order too. Returns how many stay. */
static uint32_t set_aside(struct state *s, uint32_t n) {
  uint32_t n_kept = 0, n_aside = 0;
  for (uint32_t k = 0; k < n; k++) {
    const struct listed *f = &s->list[k];
    s->n_disjoint += f->relation == DISJOINT;
    s->n_hidden += f->relation == HIDDEN;
    if (f->relation == DISJOINT || f->relation == HIDDEN)
      s->aside[n_aside++] = *f;
    else
      s->list[n_kept++] = *f;
  }
  memcpy(s->list + n_kept, s->aside, n_aside * sizeof *s->aside);
  return n_kept;
}

/* Undoes set_aside: merges the two parts of list[0, n) by Z. */
static void take_back(struct state *s, uint32_t n_kept, uint32_t n) {
  uint32_t n_aside = n - n_kept;
  memcpy(s->aside, s->list + n_kept, n_aside * sizeof *s->aside);
  for (uint32_t to = n; n_aside;) {
    const struct listed *f = &s->aside[n_aside - 1];
    if (n_kept && s->list[n_kept - 1].z < f->z) {
      s->list[--to] = s->list[--n_kept];
      continue;
    }
    s->n_disjoint -= f->relation == DISJOINT;
    s->n_hidden -= f->relation == HIDDEN;
    s->list[--to] = *f;
    n_aside--;
  }
}

/* A division of a window: `column` and `row` are the first of its right and
 * lower parts. */
struct division {
  int column, row;
  uint32_t vertex; /* where it is divided; HSR_NO_ID: at the centre */
};

static struct division at_centre(const struct window *w) {
  return (struct division){w->x0 + (w->x1 - w->x0 + 1) / 2,
                           w->y0 + (w->y1 - w->y0 + 1) / 2, HSR_NO_ID};
}

/* Finds the vertex of list[0, n) among the window's samples that is nearest to
 * the centre. False if there is none. (To take the first in Z order instead
 * makes a quarter more windows in house and harbor, in twice the levels.) */
static bool at_vertex(const struct state *s, const struct window *w, uint32_t n,
                      struct division *at) {
  const struct hsr_world *world = s->job->world;
  double first_x = hsr_sample_x(s->job->view, 0);
  double first_y = hsr_sample_y(s->job->view, 0);
  struct division centre = at_centre(w);
  double least = INFINITY;
  for (uint32_t k = 0; k < n; k++) {
    uint32_t f = s->list[k].id;
    for (uint32_t c = world->mesh.start[f]; c < world->mesh.start[f + 1]; c++) {
      double column = ceil(s->screen->sx[world->mesh.vertex[c]] - first_x);
      double row = ceil(s->screen->sy[world->mesh.vertex[c]] - first_y);
      if (!(column > w->x0 && column < w->x1 && row > w->y0 && row < w->y1))
        continue;
      double away = fmax(fabs(column - centre.column), fabs(row - centre.row));
      if (away < least) {
        least = away;
        *at = (struct division){(int)column, (int)row, world->mesh.vertex[c]};
      }
    }
  }
  return least < INFINITY;
}

static void examine(struct state *s, struct hsr_window samples, int level,
                    uint32_t n);

/* Divides a window into four, or into two if it is one sample wide or high. */
static void subdivide(struct state *s, const struct window *w, uint32_t n) {
  struct division at = at_centre(w);
  if (s->at_vertices && w->level < LAST_VERTEX_LEVEL && at_vertex(s, w, n, &at))
    HSR_STEP(s->tally, AT_VERTEX, HSR_THE_WINDOW, HSR_VERTEX(at.vertex),
             samples_of(w), 0);
  HSR_STEP(s->tally, HSR_WARNOCK_SUBDIVISIONS, HSR_THE_WINDOW, HSR_NOTHING,
           samples_of(w), 0);
  for (int quarter = 0; quarter < 4; quarter++) {
    struct hsr_window part = {w->x0, w->y0, w->x1, w->y1};
    *(quarter & 1 ? &part.x0 : &part.x1) = at.column;
    *(quarter & 2 ? &part.y0 : &part.y1) = at.row;
    if (part.x0 < part.x1 && part.y0 < part.y1)
      examine(s, part, w->level + 1, n);
  }
}

/* Does the finisher have room for list[0, n)? */
static bool are_few(const struct state *s, uint32_t n) {
  const struct hsr_finisher *finisher = s->finisher;
  if (!finisher || n > finisher->most_faces)
    return false;
  uint32_t n_corners = 0;
  for (uint32_t k = 0; k < n; k++)
    n_corners += hsr_face_size(s->job->world, s->list[k].id);
  return n_corners <= finisher->most_corners;
}

static void finish(struct state *s, const struct window *w, uint32_t n) {
  struct hsr_window window = samples_of(w);
  HSR_STEP(s->tally, HSR_WARNOCK_FINISHED, HSR_THE_WINDOW, HSR_NOTHING, window,
           0);
  for (uint32_t k = 0; k < n; k++)
    s->open[k] = s->list[k].id;
  s->tally->first = HSR_WARNOCK_FINISHER;
  s->finisher->finish(s->finisher->context, &window, s->open, n);
  s->tally->first = 0;
}

/* A window that is neither homogeneous nor simple, and whose surrounders and
 * intersecters are list[0, n), in Z order. */
static void solve(struct state *s, const struct window *w, uint32_t n) {
  if (are_few(s, n))
    finish(s, w, n);
  else
    subdivide(s, w, n);
}

/* One window. list[0, n): the faces that the enclosing window leaves open. */
static void examine(struct state *s, struct hsr_window samples, int level,
                    uint32_t n) {
  HSR_STEP(s->tally, HSR_WARNOCK_WINDOWS, HSR_THE_WINDOW, HSR_NOTHING, samples,
           0);
  struct window w = make_window(s, samples, level);
  uint32_t n_reached = cull(s, &w, n);
  touch(s, &w, n_reached);
  struct remains remains = search_depth(s, &w, n_reached);
  if (decide(s, &w, &remains))
    return;

  s->n_hidden += n - n_reached;
  uint32_t n_kept = set_aside(s, n_reached);
  solve(s, &w, n_kept);
  take_back(s, n_kept, n_reached);
  s->n_hidden -= n - n_reached;
}

/* --- The algorithm -------------------------------------------------------- */

static enum hsr_status allocate(struct state *s) {
  struct hsr_arena *arena = s->job->scratch;
  uint32_t n = s->screen->n_relevant, largest = 0;
  for (uint32_t r = 0; r < n; r++) {
    uint32_t size = hsr_face_size(s->job->world, s->screen->relevant[r]);
    largest = size > largest ? size : largest;
  }
  s->list = HSR_NEW(arena, struct listed, n);
  s->aside = HSR_NEW(arena, struct listed, n);
  s->open = HSR_NEW(arena, uint32_t, s->finisher ? s->finisher->most_faces : 0);
  s->columns = HSR_NEW(arena, int, largest + 4);
  return s->list && s->aside && s->open && s->columns ? HSR_OK : HSR_E_NOMEM;
}

static enum hsr_status run(const struct hsr_job *job,
                           const struct hsr_screen *screen, bool at_vertices,
                           const struct hsr_finisher *finisher) {
  struct state s = {.job = job,
                    .tally = job->tally,
                    .screen = screen,
                    .at_vertices = at_vertices,
                    .finisher = finisher};
  if (allocate(&s))
    return HSR_E_NOMEM;
  sort_z(&s);
  examine(&s, job->view->window, 0, screen->n_relevant);
  return HSR_OK;
}

enum hsr_status hsr_warnock_run(const struct hsr_job *job,
                                const struct hsr_screen *screen,
                                const struct hsr_finisher *finisher) {
  return run(job, screen, false, finisher);
}

static enum hsr_status render_alone(const struct hsr_job *job, bool at_vertices,
                                    struct hsr_error *err) {
  struct hsr_screen screen;
  if (hsr_screen_make(&screen, job->world, job->view, job->scratch,
                      job->tally) ||
      run(job, &screen, at_vertices, NULL))
    return hsr_fail_nomem(err);
  return HSR_OK;
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  return render_alone(job, false, err);
}

static enum hsr_status render_at_vertices(const struct hsr_job *job,
                                          struct hsr_error *err) {
  return render_alone(job, true, err);
}

/* Figure 29b is lost: the restrictions are reconstructed from the text. */
#define DESCRIPTION                                                            \
  .authors = "J. E. Warnock", .year = 1969,                                    \
  .source = "TR 4-15, University of Utah, 1969; Sutherland et al., Computing " \
            "Surveys 6(1), 1974, \"J. E. Warnock\"",                           \
  .taxonomy = HSR_IMAGE_SPACE_AREA, .sort_order = "(XY)Z",                     \
  .coherence = "area", .restrictions = 0, .subjects = 1 << HSR_FACES,          \
  .kind = HSR_IDS, .sorts = sorts, .steps = steps

const struct hsr_algorithm HSR_ALGORITHM(warnock) = {
    .name = "warnock",
    .title = "Warnock's area subdivision",
    .counters = counters,
    .outline = outline,
    .render = render,
    DESCRIPTION};

const struct hsr_algorithm HSR_ALGORITHM(warnock_vertices) = {
    .name = "warnock-vertices",
    .title = "Warnock's area subdivision, at vertices",
    .counters = counters_at_vertices,
    .outline = outline_at_vertices,
    .render = render_at_vertices,
    DESCRIPTION};
