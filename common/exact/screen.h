/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The screen coordinate system of one view, and the exact services by which
 * every algorithm makes its comparisons.
 *
 * Source      Sutherland et al. 1974, "The Perspective Transformation",
 *             "Minimax Tests", "Surrounding Polygons", "Uses of Plane
 *             Equations", "Segment Comparisons".
 * Coordinates sx, sy in pixels, y down (common/view/view.h); depth as q = 1/t,
 *             or in parallel projection q = -t, which is linear on the screen:
 *             q = a sx + b sy + c on the plane of a face. Greater q is nearer.
 * Exact       every service answers for the input as given, not for these
 *             rounded coordinates. A filter in doubles decides where its proved
 *             error bound lets it; else a predicate of
 *             common/exact/predicates.h decides, and tally->exact counts that.
 * Safe        a vertex is safely before the eye if its screen coordinates can
 *             be computed well enough; else they are NaN. In parallel, all but
 *             those far outside the picture are safe, wherever they lie in
 *             depth.
 * Whole       a face is whole if all its vertices are safely before the eye, it
 *             has no cuts and its plane needs no test against near. Then its
 *             edges on the screen tell all about it. Any other face is cut;
 *             hsr_face_spans and hsr_covers handle both.
 *
 * The proofs of the bounds are in screen.c. */
#ifndef HSR_COMMON_SCREEN_H
#define HSR_COMMON_SCREEN_H

#include "common/base/arena.h"
#include "common/base/count.h"
#include "common/polygon/polygon.h"
#include "common/scene/pieces.h"
#include "common/view/view.h"
#include "common/scene/world.h"

#include <math.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Every screen coordinate that is not NaN is within HSR_DELTA pixels of the
 * true one, and at most HSR_GUARD pixels in size. */
#define HSR_DELTA 0x1p-26
#define HSR_GUARD 0x1p15

/* q on a face's plane: |a sx + b sy + c - q| <= error anywhere in the
 * picture, if computed in doubles in this order. error is +infinity where the
 * coefficients say nothing. */
struct hsr_depth_plane {
  double a, b, c, error;
};

/* Samples that a face may cover: columns [x0, x1), rows [y0, y1). */
struct hsr_bounds {
  int x0, y0, x1, y1;
};

struct hsr_screen {
  const struct hsr_world *world; /* borrowed */
  const struct hsr_view *view;   /* borrowed */

  double *sx, *sy; /* a vertex; NaN if not safely before the eye */
  double *q;       /* a vertex: 1/w, relative error 2^-42 where sx is not NaN;
                      in parallel 1 */
  struct hsr_depth_plane *plane; /* a face */
  signed char *facing; /* a face: +1 the eye is in front of it, -1 behind, and
                          no vertex is as far from its plane as the eye; 0: not
                          certain */

  double reach[3]; /* the components of |D|, or in parallel of |P - E|, in the
                      picture are at most this */
  double outside;  /* at a vertex safely before the eye, a plane's error is at
                      most this times its `error` */

  /* The relevant faces, by ascending number: they exist, and a sample of the
   * window is in their bounds. */
  uint32_t *relevant;
  uint32_t n_relevant;
  struct hsr_bounds *bounds; /* a face; set for relevant ones only */
  bool *whole;               /* a face; set for relevant ones only */
};

/* Allocates what the functions below fill, in the arena. `world` and `view` are
 * borrowed and must outlive *screen. HSR_E_NOMEM. */
enum hsr_status hsr_screen_init(struct hsr_screen *screen,
                                const struct hsr_world *world,
                                const struct hsr_view *view,
                                struct hsr_arena *arena);

/* The perspective transform of all vertices: fills sx, sy, q. */
void hsr_screen_vertices(struct hsr_screen *screen);

/* The same of the corners of face f alone; and of n points of whatever kind,
 * for arrays of the caller. */
void hsr_screen_corners(struct hsr_screen *screen, uint32_t f);
void hsr_screen_points(const struct hsr_screen *screen, size_t n,
                       const double *x, const double *y, const double *z,
                       double *sx, double *sy, double *q);

/* The depth planes of all faces, or of face f: fills plane and facing. */
void hsr_screen_planes(struct hsr_screen *screen);
void hsr_screen_plane(struct hsr_screen *screen, uint32_t f);

/* The culls of one face, whose plane is filled in. False if the face does not
 * exist, or no sample of the window is in its bounds; else fills bounds and
 * whole. */
bool hsr_screen_place(struct hsr_screen *screen, uint32_t f,
                      struct hsr_tally *tally);

/* Culls all faces, as every algorithm does first: fills relevant, bounds and
 * whole. */
void hsr_screen_cull(struct hsr_screen *screen, struct hsr_tally *tally);

/* All of the above, in their order. HSR_E_NOMEM. */
enum hsr_status hsr_screen_make(struct hsr_screen *screen,
                                const struct hsr_world *world,
                                const struct hsr_view *view,
                                struct hsr_arena *arena,
                                struct hsr_tally *tally);

/* Does the face exist in this view? It does unless it is a back face of a
 * one-sided object, or its plane holds the eye. */
bool hsr_face_exists(const struct hsr_screen *screen, uint32_t f,
                     struct hsr_tally *tally);

/* What the filters below fall back to; call the filters instead. */
bool hsr_nearer_exact(const struct hsr_screen *screen, uint32_t f, uint32_t g,
                      double sx, double sy, struct hsr_tally *tally);
int hsr_vertex_nearer_exact(const struct hsr_screen *screen, uint32_t f,
                            uint32_t g, uint32_t v, struct hsr_tally *tally);
int hsr_edge_side_exact(const struct hsr_screen *screen, uint32_t a, uint32_t b,
                        int i, int j, struct hsr_tally *tally);
int hsr_row_side_exact(const struct hsr_screen *screen, uint32_t v, int j,
                       struct hsr_tally *tally);

/* q of face f at a point (sx, sy) of the picture, and at sample (i, j): within
 * plane[f].error. */
static inline double hsr_depth_at(const struct hsr_screen *screen, uint32_t f,
                                  double sx, double sy) {
  const struct hsr_depth_plane *p = &screen->plane[f];
  return p->a * sx + p->b * sy + p->c;
}
static inline double hsr_depth(const struct hsr_screen *screen, uint32_t f,
                               int i, int j) {
  return hsr_depth_at(screen, f, hsr_sample_x(screen->view, i),
                      hsr_sample_y(screen->view, j));
}

/* Is the plane of f nearer than that of g on the ray of a sample at (sx, sy),
 * or of sample (i, j)? This is the order of the picture, ties included. Both
 * exist; f != g. (sx, sy) is any point of the picture, 0 <= sx <= m and 0 <= sy
 * <= n: there the bound of the planes' errors is proved. Where a plane is met
 * behind the eye its q is compared all the same; 1/t is negative there. So the
 * order of two planes changes at most once along a row.
 *
 * hsr_nearer_by is for those who know the depths, as hsr_depth gives them: `by` is
 * that of f less that of g. */
static inline bool hsr_nearer_by(const struct hsr_screen *screen, uint32_t f,
                                 uint32_t g, double by, double sx, double sy,
                                 struct hsr_tally *tally) {
  HSR_COUNT_DEPTHS(tally, 1);
  if (screen->world->mesh.plane[f] == screen->world->mesh.plane[g])
    return f < g;
  double bound = screen->plane[f].error + screen->plane[g].error;
  if (by > bound)
    return true;
  if (by < -bound)
    return false;
  return hsr_nearer_exact(screen, f, g, sx, sy, tally);
}
static inline bool hsr_nearer_at(const struct hsr_screen *screen, uint32_t f,
                                 uint32_t g, double sx, double sy,
                                 struct hsr_tally *tally) {
  double by = hsr_depth_at(screen, f, sx, sy) - hsr_depth_at(screen, g, sx, sy);
  return hsr_nearer_by(screen, f, g, by, sx, sy, tally);
}
static inline bool hsr_nearer(const struct hsr_screen *screen, uint32_t f,
                              uint32_t g, int i, int j,
                              struct hsr_tally *tally) {
  return hsr_nearer_at(screen, f, g, hsr_sample_x(screen->view, i),
                       hsr_sample_y(screen->view, j), tally);
}

/* q of face f's plane at vertex v, which is safely before the eye, within
 * hsr_vertex_error. If f is whole, q at its samples lies between the least and
 * the greatest of these at its vertices. */
static inline double hsr_vertex_depth(const struct hsr_screen *screen,
                                      uint32_t f, uint32_t v) {
  const struct hsr_depth_plane *p = &screen->plane[f];
  return p->a * screen->sx[v] + p->b * screen->sy[v] + p->c;
}
static inline double hsr_vertex_error(const struct hsr_screen *screen,
                                      uint32_t f) {
  const struct hsr_depth_plane *p = &screen->plane[f];
  return screen->outside * p->error + 2 * HSR_DELTA * (fabs(p->a) + fabs(p->b));
}

/* Which of the planes of f and g is nearer on the ray through vertex v, which
 * is safely before the eye: +1 that of f, -1 that of g, 0 if they meet there.
 * Nothing is perturbed. Both exist. If f is whole and the answer is +1 or 0 at
 * all of its vertices, then either hsr_nearer says that f is nearer at every
 * sample that it covers, or both are on one plane. */
static inline int hsr_vertex_nearer(const struct hsr_screen *screen, uint32_t f,
                                    uint32_t g, uint32_t v,
                                    struct hsr_tally *tally) {
  const struct hsr_depth_plane *p = &screen->plane[f], *q = &screen->plane[g];
  double bound = screen->outside * (p->error + q->error) +
                 2 * HSR_DELTA * (fabs(p->a - q->a) + fabs(p->b - q->b));
  double by = hsr_vertex_depth(screen, f, v) - hsr_vertex_depth(screen, g, v);
  if (by > bound)
    return 1;
  if (by < -bound)
    return -1;
  return hsr_vertex_nearer_exact(screen, f, g, v, tally);
}

/* The side of sample row j that vertex v lies on: -1 above the line or on it,
 * +1 below. For a vertex behind the eye this is the sign of row(v) in
 * docs/correct-picture.md. */
static inline int hsr_row_side(const struct hsr_screen *screen, uint32_t v,
                               int j, struct hsr_tally *tally) {
  double below = screen->sy[v] - hsr_sample_y(screen->view, j);
  if (below > HSR_DELTA)
    return 1;
  if (below < -HSR_DELTA)
    return -1;
  return hsr_row_side_exact(screen, v, j, tally);
}

/* The sign of edge(a, b) at sample (i, j): for an edge from a, above, to b,
 * below, both before the eye, +1 if the sample is left of it. */
static inline int hsr_edge_side(const struct hsr_screen *screen, uint32_t a,
                                uint32_t b, int i, int j,
                                struct hsr_tally *tally) {
  double ax = screen->sx[a], ay = screen->sy[a];
  double dx = screen->sx[b] - ax, dy = screen->sy[b] - ay;
  double hx = hsr_sample_x(screen->view, i) - ax;
  double hy = hsr_sample_y(screen->view, j) - ay;
  double e = dx * hy - dy * hx;
  double bound = 4 * HSR_DELTA * (fabs(dx) + fabs(dy) + fabs(hx) + fabs(hy)) +
                 8 * HSR_DELTA * HSR_DELTA;
  if (e > bound)
    return 1;
  if (e < -bound)
    return -1;
  return hsr_edge_side_exact(screen, a, b, i, j, tally);
}

/* Does face f cover sample (i, j)? */
bool hsr_covers(const struct hsr_screen *screen, uint32_t f, int i, int j,
                struct hsr_tally *tally);

/* A place among n rows or columns; beyond the first or the last, half a pixel
 * beyond it. */
static inline double hsr_within(double place, int n) {
  place = place > -0.5 ? place : -0.5;
  return place < n - 0.5 ? place : n - 0.5;
}

/* The least integer that is not less than such a place, without a call. */
static inline int hsr_round_up(double place) {
  int towards_zero = (int)place;
  return towards_zero + (towards_zero < place);
}

/* The first row, in [0, n], whose line lies below vertex v or passes through
 * it. v is safely before the eye. An edge from vertex a down to b, of a whole
 * face, crosses exactly the rows [hsr_vertex_row(a), hsr_vertex_row(b)). */
int hsr_vertex_row(const struct hsr_screen *screen, uint32_t v,
                   struct hsr_tally *tally);

/* The same of all vertices at once, in row[0 .. n_vertices): HSR_ROW_UNKNOWN
 * where hsr_vertex_row is to be asked, anything for a vertex that is not safely
 * before the eye. */
enum { HSR_ROW_UNKNOWN = -1 };
void hsr_vertex_rows(const struct hsr_screen *screen, int *row);

/* An edge of a whole face on the screen, to be followed from row to row. It
 * crosses the row at sy within `tolerance` pixels of x + slope * sy. */
struct hsr_edge {
  uint32_t a, b; /* vertices, a above b */
  double x, slope, tolerance;
};
void hsr_edge_init(struct hsr_edge *edge, const struct hsr_screen *screen,
                   uint32_t a, uint32_t b);
/* What hsr_edge_column is when the tolerance leaves a doubt. */
int hsr_edge_column_exact(const struct hsr_screen *screen,
                          const struct hsr_edge *edge, int j,
                          struct hsr_tally *tally);

/* Where a row of samples is: its first sample, and how many there are. */
struct hsr_row {
  double x, y;
  int m;
};
static inline struct hsr_row hsr_row_of(const struct hsr_view *view, int j) {
  struct hsr_row row = {hsr_sample_x(view, 0), hsr_sample_y(view, j), view->m};
  return row;
}

/* The first column, in [0, m], whose sample in row j lies right of the edge or
 * on it. The edge crosses row j. A convex whole face covers the samples of a
 * row from the column of one of its edges up to, not including, that of
 * another. `row` is hsr_row_of row j. */
static inline int hsr_edge_column_on(const struct hsr_screen *screen,
                                     const struct hsr_edge *edge, int j,
                                     const struct hsr_row *row,
                                     struct hsr_tally *tally) {
  double x = edge->x + edge->slope * row->y;
  double column = hsr_within(x - row->x, row->m);
  int next = hsr_round_up(column);
  if (!(next - column > edge->tolerance && column - next + 1 > edge->tolerance))
    return hsr_edge_column_exact(screen, edge, j, tally);
  return next;
}
static inline int hsr_edge_column(const struct hsr_screen *screen,
                                  const struct hsr_edge *edge, int j,
                                  struct hsr_tally *tally) {
  struct hsr_row row = hsr_row_of(screen->view, j);
  return hsr_edge_column_on(screen, edge, j, &row, tally);
}

/* The same of n edges, each of which crosses row j, in column[0 .. n). */
void hsr_edge_columns(const struct hsr_screen *screen,
                      const struct hsr_edge *edge, uint32_t n, int j,
                      int *column, struct hsr_tally *tally);

/* The samples of row j that face f covers, as columns c[0] <= c[1] <= ...: it
 * covers [c[0], c[1]), [c[2], c[3]) and so on. Returns the number of columns,
 * which is even; `columns` has room for the face's size + 4. */
int hsr_face_spans(const struct hsr_screen *screen, uint32_t f, int j,
                   int *columns, struct hsr_tally *tally);

/* A face that is asked about row by row. The edges of a whole face are found
 * once, for all its rows. n is 0 if no edge crosses a row, if the face is not
 * whole or if it has more than HSR_MOST_ROW_EDGES corners: then hsr_face_spans
 * answers. Borrows the screen. */
enum { HSR_MOST_ROW_EDGES = 8 };
struct hsr_face_rows {
  const struct hsr_screen *screen;
  uint32_t face;
  int n;
  struct hsr_row_edge {
    int begin, end; /* the rows that it crosses */
    struct hsr_edge line;
  } edge[HSR_MOST_ROW_EDGES];
};
void hsr_face_rows_begin(struct hsr_face_rows *rows,
                         const struct hsr_screen *screen, uint32_t f,
                         struct hsr_tally *tally);

/* The same columns as hsr_face_spans of the face, with the same room. */
int hsr_face_rows_spans(const struct hsr_face_rows *rows, int j, int *columns,
                        struct hsr_tally *tally);

/* --- Cut faces (common/scene/pieces.h) ------------------------------------ */

/* The part of a face that n_cuts cuts leave; all its samples are in `bounds`.
 */
struct hsr_piece {
  uint32_t face, n_cuts;
  const struct hsr_cut *cuts; /* borrowed; NULL if there are none */
  struct hsr_bounds bounds;
};

/* A relevant face, not cut. */
static inline struct hsr_piece hsr_uncut_face(const struct hsr_screen *screen,
                                              uint32_t f) {
  struct hsr_piece piece = {f, 0, NULL, screen->bounds[f]};
  return piece;
}

/* The side of the plane of g on which the ray of sample (i, j) meets the plane
 * of f: +1 in front, -1 behind. f exists and its plane is ahead of the eye
 * there; f and g do not lie on one plane. The plane of g may hold the eye. Both
 * planes are filled in (hsr_screen_plane): before a divided face is asked
 * about, the planes of all faces that cut it must be. */
int hsr_cut_side(const struct hsr_screen *screen, uint32_t f, uint32_t g, int i,
                 int j, struct hsr_tally *tally);

/* hsr_covers for the piece that n cuts leave of f. */
bool hsr_piece_covers(const struct hsr_screen *screen, uint32_t f,
                      const struct hsr_cut *cut, size_t n, int i, int j,
                      struct hsr_tally *tally);

/* hsr_face_spans for the piece that n cuts leave of f. */
int hsr_piece_spans(const struct hsr_screen *screen, uint32_t f,
                    const struct hsr_cut *cut, size_t n, int j, int *columns,
                    struct hsr_tally *tally);

/* hsr_face_rows_spans for the piece that n cuts leave of the face. */
int hsr_piece_rows_spans(const struct hsr_face_rows *rows,
                         const struct hsr_cut *cut, size_t n, int j,
                         int *columns, struct hsr_tally *tally);

/* --- Polygons that are in no screen --------------------------------------- */

/* The same questions about polygons given by their corners, at any (sx, sy):
 * for faces that move with their instance, and for planes across an axis. There
 * is no filter here. The caller has one, and asks only what it leaves open.
 * tally->exact counts each question. */

/* The sign of edge(a, b), as hsr_edge_side gives it. */
int hsr_loop_edge_side(const struct hsr_view *view, const double a[3],
                       const double b[3], double sx, double sy,
                       struct hsr_tally *tally);

/* hsr_cut_side for the planes of two polygons. */
int hsr_loop_cut_side(const struct hsr_view *view, struct hsr_loop f,
                      struct hsr_loop g, double sx, double sy,
                      struct hsr_tally *tally);

/* hsr_loop_past_near: is q of the plane less than 1/near, or in parallel than
 * -near? Where the plane is met in front of the eye, that means t > near.
 * hsr_loop_beyond_near: is the plane met in front of the eye, and with t >
 * near? */
bool hsr_loop_past_near(const struct hsr_view *view, struct hsr_loop plane,
                        double sx, double sy, struct hsr_tally *tally);
bool hsr_loop_beyond_near(const struct hsr_view *view, struct hsr_loop plane,
                          double sx, double sy, struct hsr_tally *tally);

/* Is (sx, sy) within the polygon, by the parity of its edges that cross to the
 * right (docs/correct-picture.md)? */
bool hsr_loop_surrounds(const struct hsr_view *view, struct hsr_loop polygon,
                        double sx, double sy, struct hsr_tally *tally);

#ifdef __cplusplus
}
#endif
#endif
