/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The screen coordinates of one view, and the exact services that every
 * algorithm uses for its comparisons.
 *
 * Source      Sutherland et al. 1974, "The Perspective Transformation",
 *             "Minimax Tests", "Surrounding Polygons", "Uses of Plane
 *             Equations", "Segment Comparisons".
 * Coordinates sx, sy in pixels, y down (common/view/view.h); depth as q = 1/t,
 *             or in parallel projection q = -t, which is linear on the screen:
 *             q = a sx + b sy + c on the plane of a face. Greater q is nearer.
 * Exact       every service answers for the input as given, not for these
 *             rounded coordinates. A filter in doubles decides if its proved
 *             error bound allows it. Otherwise a predicate of
 *             common/exact/predicates.h decides, and tally->exact counts that.
 * Errors      a service fails only if memory runs out. Then
 *             tally->out_of_memory is set and the result is meaningless.
 * Safe        a vertex is safely before the eye if its screen coordinates can
 *             be computed well enough. Those of other vertices are NaN. In
 *             parallel projection, only vertices far outside the picture are
 *             not safe; their depth does not matter.
 * Whole       a face is whole if all its vertices are safely before the eye, it
 *             has no cuts and its plane needs no test against near. The samples
 *             of a whole face are found from its edges on the screen alone.
 *             hsr_face_spans and hsr_covers handle other faces too.
 * Exists      a face exists in a view unless it is a back face of a one-sided
 *             object, or its plane holds the eye (hsr_face_exists).
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
#pragma GCC visibility push(protected) /* for modules: hsr-module.h */

/* A stored screen coordinate that is not NaN is within HSR_DELTA pixels of the
 * exact one, and is at most HSR_GUARD pixels in size. */
#define HSR_DELTA 0x1p-26
#define HSR_GUARD 0x1p15

/* q on a face's plane: |a sx + b sy + c - q| <= error anywhere in the picture,
 * if it is computed in doubles in this order. error is +infinity if the
 * coefficients are of no use. */
struct hsr_depth_plane {
  double a, b, c, error;
};

/* The samples that a face may cover: columns [x0, x1), rows [y0, y1). */
struct hsr_bounds {
  int x0, y0, x1, y1;
};

struct hsr_screen {
  const struct hsr_world *world; /* borrowed */
  const struct hsr_view *view;   /* borrowed */

  /* By vertex. */
  double *sx, *sy; /* pixels; NaN if not safely before the eye */
  double *q;       /* 1/w, with a relative error of 2^-42 if sx is not NaN; 1 in
                      parallel projection */

  /* By face. */
  struct hsr_depth_plane *plane;
  signed char *facing; /* +1: the eye is in front of the face; -1: it is behind.
                          In perspective it is then also farther from the face's
                          plane than every vertex of the face. 0: not certain */

  double reach[3]; /* bounds of the components of |D| in the picture or, in
                      parallel projection, of |P - E| */
  double outside;  /* at a vertex safely before the eye, perhaps outside of the
                      picture, the error of q is at most this times the plane's
                      `error` */

  /* The relevant faces, by ascending number. They are those that exist and have
   * a sample of the window in their bounds. */
  uint32_t *relevant;
  uint32_t n_relevant;
  struct hsr_bounds *bounds; /* by face; set for relevant faces only */
  bool *whole;               /* by face; set for relevant faces only */
};

/* Allocates the arrays of *screen in the arena. The functions below fill them.
 * `world`, which is laid out, and `view` are borrowed and must outlive *screen.
 * HSR_E_NOMEM. */
enum hsr_status hsr_screen_init(struct hsr_screen *screen,
                                const struct hsr_world *world,
                                const struct hsr_view *view,
                                struct hsr_arena *arena);

/* Transforms all vertices to the screen: fills sx, sy, q. */
void hsr_screen_vertices(struct hsr_screen *screen);

/* The same for the vertices of face f alone; and for n points in arrays of the
 * caller, x, y, z in world units, with results in arrays of the caller. */
void hsr_screen_corners(struct hsr_screen *screen, uint32_t f);
void hsr_screen_points(const struct hsr_screen *screen, size_t n,
                       const double *x, const double *y, const double *z,
                       double *sx, double *sy, double *q);

/* Finds the depth planes of all faces, or of face f: fills plane and facing. */
void hsr_screen_planes(struct hsr_screen *screen);
void hsr_screen_plane(struct hsr_screen *screen, uint32_t f);

/* Culls one face, whose vertices and plane are filled in. False if the face
 * does not exist or no sample of the window is in its bounds. If true, the face
 * is relevant, and its bounds and `whole` are filled in. If false, the tally says
 * why. */
bool hsr_screen_place(struct hsr_screen *screen, uint32_t f,
                      struct hsr_tally *tally);

/* Culls all faces: fills relevant, bounds and whole. Most algorithms begin with
 * this. */
void hsr_screen_cull(struct hsr_screen *screen, struct hsr_tally *tally);

/* Calls hsr_screen_init, _vertices, _planes and _cull. HSR_E_NOMEM. */
enum hsr_status hsr_screen_make(struct hsr_screen *screen,
                                const struct hsr_world *world,
                                const struct hsr_view *view,
                                struct hsr_arena *arena,
                                struct hsr_tally *tally);

/* Whether the face exists in this view. It does unless it is a back face of a
 * one-sided object, or its plane holds the eye. */
bool hsr_face_exists(const struct hsr_screen *screen, uint32_t f,
                     struct hsr_tally *tally);

/* The exact parts of the filters below, which call them if in doubt. Call the
 * filters instead. */
bool hsr_nearer_exact(const struct hsr_screen *screen, uint32_t f, uint32_t g,
                      double sx, double sy, struct hsr_tally *tally);
int hsr_vertex_nearer_exact(const struct hsr_screen *screen, uint32_t f,
                            uint32_t g, uint32_t v, struct hsr_tally *tally);
int hsr_edge_side_exact(const struct hsr_screen *screen, uint32_t a, uint32_t b,
                        int i, int j, struct hsr_tally *tally);
int hsr_row_side_exact(const struct hsr_screen *screen, uint32_t v, int j,
                       struct hsr_tally *tally);

/* Return q of the plane of face f at a point (sx, sy) of the picture, or at
 * sample (i, j), with an error of at most plane[f].error. */
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

/* Whether the plane of f is nearer than the plane of g on the ray of a sample
 * at (sx, sy), or of sample (i, j). This is the order that the correct picture
 * has, ties included. Both faces exist, and f != g. (sx, sy) is any point with
 * 0 <= sx <= m and 0 <= sy <= n; there the error bounds of the planes are
 * proved. If a ray meets a plane behind the eye, its q, which is negative
 * there, is compared all the same. So the order of two planes changes at most
 * once along a row.
 *
 * hsr_nearer_by is for a caller who has the depths of hsr_depth_at already.
 * `by` is the q of f minus the q of g. */
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

/* Returns q of the plane of face f at vertex v, which is safely before the eye,
 * with an error of at most hsr_vertex_error. If f is whole, q at its samples
 * lies between the least and the greatest q at its vertices. */
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

/* Compares the planes of f and g on the ray through vertex v, which is safely
 * before the eye. Returns +1 if that of f is nearer, -1 if that of g is nearer,
 * 0 if they meet there. The ray is not perturbed. Both faces exist. Let f be
 * whole and the result be +1 or 0 at all of its vertices. Then hsr_nearer says
 * that f is nearer at every sample that f covers, or both faces are on one
 * plane. */
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

/* Returns the side of the line of sample row j that vertex v lies on: +1 below
 * it, -1 above it or on it. For a vertex behind the eye, this is the sign of
 * row(v) in docs/correct-picture.md. */
static inline int hsr_row_side(const struct hsr_screen *screen, uint32_t v,
                               int j, struct hsr_tally *tally) {
  double below = screen->sy[v] - hsr_sample_y(screen->view, j);
  if (below > HSR_DELTA)
    return 1;
  if (below < -HSR_DELTA)
    return -1;
  return hsr_row_side_exact(screen, v, j, tally);
}

/* Returns the sign of edge(a, b) in docs/correct-picture.md at sample (i, j).
 * For an edge from vertex a, above, down to vertex b, both before the eye, it
 * is +1 if the sample is to the left of the edge. */
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

/* Whether face f covers sample (i, j). f is relevant. */
bool hsr_covers(const struct hsr_screen *screen, uint32_t f, int i, int j,
                struct hsr_tally *tally);

/* Returns a place, in pixels from the first sample, brought into [-1/2, n -
 * 1/2], the range of n rows or columns. */
static inline double hsr_within(double place, int n) {
  place = place > -0.5 ? place : -0.5;
  return place < n - 0.5 ? place : n - 0.5;
}

/* Returns the least integer that is not less than such a place. Unlike ceil, it
 * is never compiled to a call. */
static inline int hsr_round_up(double place) {
  int towards_zero = (int)place;
  return towards_zero + (towards_zero < place);
}

/* Returns the first row, in [0, n], whose line lies below vertex v or passes
 * through it. v is safely before the eye. An edge of a whole face, from vertex
 * a down to b, crosses exactly the rows [hsr_vertex_row(a),
 * hsr_vertex_row(b)). */
int hsr_vertex_row(const struct hsr_screen *screen, uint32_t v,
                   struct hsr_tally *tally);

/* Sets row[v] to hsr_vertex_row of every vertex v of the world, in an array of
 * the caller. It is HSR_ROW_UNKNOWN if the filter does not decide;
 * hsr_vertex_row does. For a vertex that is not safely before the eye it is
 * meaningless. */
enum { HSR_ROW_UNKNOWN = -1 };
void hsr_vertex_rows(const struct hsr_screen *screen, int *row);

/* An edge of a whole face on the screen, to be followed from row to row. It
 * crosses the row at sy within `tolerance` pixels of x + slope * sy. */
struct hsr_edge {
  uint32_t a, b; /* vertices, a above b */
  double x, slope, tolerance;
};

/* Sets up the edge from vertex a down to vertex b. */
void hsr_edge_init(struct hsr_edge *edge, const struct hsr_screen *screen,
                   uint32_t a, uint32_t b);

/* The exact part of hsr_edge_column. Call that instead. */
int hsr_edge_column_exact(const struct hsr_screen *screen,
                          const struct hsr_edge *edge, int j,
                          struct hsr_tally *tally);

/* A row of samples: the screen coordinates of its first sample, in pixels, and
 * how many samples it has. */
struct hsr_row {
  double x, y;
  int m;
};
static inline struct hsr_row hsr_row_of(const struct hsr_view *view, int j) {
  struct hsr_row row = {hsr_sample_x(view, 0), hsr_sample_y(view, j), view->m};
  return row;
}

/* Return the first column, in [0, m], whose sample in row j lies to the right
 * of the edge or on it. The edge must cross row j. A convex whole face covers
 * the samples of a row from the column of one of its edges to the column before
 * that of another. hsr_edge_column_on is for a caller that has *row, hsr_row_of
 * row j, already. */
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

/* The same for edge[0 .. n-1], each of which crosses row j. The columns are
 * written to column[0 .. n-1]. */
void hsr_edge_columns(const struct hsr_screen *screen,
                      const struct hsr_edge *edge, uint32_t n, int j,
                      int *column, struct hsr_tally *tally);

/* Finds the samples of row j that face f covers. Writes columns c[0] <= c[1] <=
 * ... to `columns`: the face covers [c[0], c[1]), [c[2], c[3]) and so on.
 * Returns the number of columns, which is even. `columns` is an array of the
 * caller with room for hsr_face_size + 4. f is relevant. */
int hsr_face_spans(const struct hsr_screen *screen, uint32_t f, int j,
                   int *columns, struct hsr_tally *tally);

/* The edges of a face, for a caller that asks about one row after another. They
 * are found once for all rows. n is 0 if no edge crosses a row, if the face is
 * not whole, or if it has more than HSR_MOST_ROW_EDGES corners. hsr_face_spans
 * is used then. */
enum { HSR_MOST_ROW_EDGES = 8 };
struct hsr_face_rows {
  const struct hsr_screen *screen; /* borrowed */
  uint32_t face;
  int n; /* edges */
  struct hsr_row_edge {
    int begin, end; /* it crosses the rows [begin, end) */
    struct hsr_edge line;
  } edge[HSR_MOST_ROW_EDGES];
};

/* Sets up *rows for face f, which is relevant. */
void hsr_face_rows_begin(struct hsr_face_rows *rows,
                         const struct hsr_screen *screen, uint32_t f,
                         struct hsr_tally *tally);

/* hsr_face_spans for the face of *rows: the same result, with the same room. */
int hsr_face_rows_spans(const struct hsr_face_rows *rows, int j, int *columns,
                        struct hsr_tally *tally);

/* Whether two lists of spans, as the functions above give them, have a sample in
 * common in the columns [x0, x1). */
static inline bool hsr_spans_meet(const int *a, int n_a, const int *b, int n_b,
                                  int x0, int x1) {
  for (int k = 0, l = 0; k < n_a && l < n_b;) {
    int begin = a[k] > b[l] ? a[k] : b[l];
    int end = a[k + 1] < b[l + 1] ? a[k + 1] : b[l + 1];
    if (begin < end && begin < x1 && end > x0)
      return true;
    if (a[k + 1] < b[l + 1])
      k += 2;
    else
      l += 2;
  }
  return false;
}

/* --- Cut faces (common/scene/pieces.h) ------------------------------------ */

/* The part of a face that n_cuts cuts leave. All its samples are in
 * `bounds`. */
struct hsr_piece {
  uint32_t face, n_cuts;
  const struct hsr_cut *cuts; /* borrowed; NULL if there are none */
  struct hsr_bounds bounds;
};

/* Returns the piece that is all of face f, which is relevant. */
static inline struct hsr_piece hsr_uncut_face(const struct hsr_screen *screen,
                                              uint32_t f) {
  struct hsr_piece piece = {f, 0, NULL, screen->bounds[f]};
  return piece;
}

/* Takes the point at which the ray of sample (i, j) meets the plane of f, and
 * returns the side of the plane of g that it is on: +1 in front, -1 behind. f
 * exists, the ray meets its plane in front of the eye, and f and g are not on
 * one plane. The plane of g may hold the eye. Both planes must be filled in
 * (hsr_screen_plane). So before a divided face is asked about, the planes of
 * all faces that cut it must be filled in. */
int hsr_cut_side(const struct hsr_screen *screen, uint32_t f, uint32_t g, int i,
                 int j, struct hsr_tally *tally);

/* hsr_covers for the part of f that the cuts cut[0 .. n-1] leave. */
bool hsr_piece_covers(const struct hsr_screen *screen, uint32_t f,
                      const struct hsr_cut *cut, size_t n, int i, int j,
                      struct hsr_tally *tally);

/* hsr_face_spans for the part of f that the cuts leave. */
int hsr_piece_spans(const struct hsr_screen *screen, uint32_t f,
                    const struct hsr_cut *cut, size_t n, int j, int *columns,
                    struct hsr_tally *tally);

/* hsr_face_rows_spans for the part of the face that the cuts leave. */
int hsr_piece_rows_spans(const struct hsr_face_rows *rows,
                         const struct hsr_cut *cut, size_t n, int j,
                         int *columns, struct hsr_tally *tally);

/* --- Polygons that are in no screen --------------------------------------- */

/* The same questions about polygons that are given by their corners, in world
 * units, at any screen point (sx, sy), in pixels. They serve faces that move
 * with their instance, and planes across an axis. These functions have no
 * filter: tally->exact counts each call. A caller has a filter of its own and
 * calls them only if that is in doubt. */

/* hsr_edge_side for the points a and b. */
int hsr_loop_edge_side(const struct hsr_view *view, const double a[3],
                       const double b[3], double sx, double sy,
                       struct hsr_tally *tally);

/* hsr_cut_side for the planes of two polygons. */
int hsr_loop_cut_side(const struct hsr_view *view, struct hsr_loop f,
                      struct hsr_loop g, double sx, double sy,
                      struct hsr_tally *tally);

/* hsr_loop_past_near: whether q of the plane is less than 1/near or, in
 * parallel projection, less than -near. If the ray meets the plane in front of
 * the eye, that means t > near. hsr_loop_beyond_near: whether the ray meets the
 * plane in front of the eye, with t > near. */
bool hsr_loop_past_near(const struct hsr_view *view, struct hsr_loop plane,
                        double sx, double sy, struct hsr_tally *tally);
bool hsr_loop_beyond_near(const struct hsr_view *view, struct hsr_loop plane,
                          double sx, double sy, struct hsr_tally *tally);

/* Whether the polygon surrounds (sx, sy), by the parity of its edges that cross
 * to the right (docs/correct-picture.md). */
bool hsr_loop_surrounds(const struct hsr_view *view, struct hsr_loop polygon,
                        double sx, double sy, struct hsr_tally *tally);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif
#endif
