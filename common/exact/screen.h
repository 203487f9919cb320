/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The screen coordinate system of one view, and the exact services by which
 * every algorithm makes its comparisons.
 *
 * Source      Sutherland et al. 1974, "The Perspective Transformation",
 *             "Minimax Tests", "Surrounding Polygons", "Uses of Plane
 *             Equations", "Segment Comparisons".
 * Coordinates sx, sy in pixels, y down (common/view/view.h); depth as q = 1/t,
 *             which is linear on the screen: q = a sx + b sy + c on the plane
 *             of a face. Greater q is nearer.
 * Exact       every service answers for the input as given, not for these
 *             rounded coordinates: a filter in doubles decides when its proved
 *             error bound lets it, else the predicate of common/exact/predicates.h
 *             does, and tally->exact counts that.
 * Whole       a face is whole if it lies safely before the eye and its plane
 *             needs no test against near: then its edges on the screen are all
 *             there is to know. Any other face is cut, and is asked about by
 *             hsr_face_spans or hsr_covers, which handle both.
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

/* Every screen coordinate that is not NaN is within this of the true one, in
 * pixels, and at most HSR_GUARD in size. */
#define HSR_DELTA 0x1p-26
#define HSR_GUARD 0x1p15

/* 1/t on a face's plane: |a sx + b sy + c - q| <= error as computed in doubles
 * in this order, anywhere in the picture. error is +infinity where the
 * coefficients say nothing. */
struct hsr_depth_plane {
  double a, b, c, error;
};

/* Samples that a face may cover: columns [x0, x1), rows [y0, y1). */
struct hsr_bounds {
  int x0, y0, x1, y1;
};

struct hsr_screen {
  const struct hsr_world *world;
  const struct hsr_view *view;

  double *sx, *sy; /* a vertex; NaN if not safely before the eye */
  double *q; /* a vertex: 1/w, within 2^-42 of itself where sx is not NaN */
  struct hsr_depth_plane *plane; /* a face */
  signed char *facing; /* a face: +1 the eye is in front of it, -1 behind, and
                          no vertex is as far out of its plane as the eye; 0:
                          not certain */

  double reach[3]; /* no |D| in the picture is larger, by components */
  double outside;  /* a plane's error at any vertex that is safely before the
                      eye is at most this times its `error` */

  /* The relevant faces: existing, and with a sample of the window in their
   * bounds; ascending ids. */
  uint32_t *relevant;
  uint32_t n_relevant;
  struct hsr_bounds *bounds; /* a face; of the relevant ones only */
  bool *whole;               /* a face; of the relevant ones only */
};

/* Allocates what the functions below fill. HSR_E_NOMEM. */
enum hsr_status hsr_screen_init(struct hsr_screen *screen,
                                const struct hsr_world *world,
                                const struct hsr_view *view,
                                struct hsr_arena *arena);

/* The perspective transform of all vertices: fills sx, sy, q. */
void hsr_screen_vertices(struct hsr_screen *screen);

/* The depth planes of all faces, or of one: fills plane and facing. */
void hsr_screen_planes(struct hsr_screen *screen);
void hsr_screen_plane(struct hsr_screen *screen, uint32_t f);

/* The culls of one face, whose plane is filled in: false if it does not exist,
 * or has no sample of the window in its bounds; else fills bounds and whole. */
bool hsr_screen_place(struct hsr_screen *screen, uint32_t f,
                      struct hsr_tally *tally);

/* The culls that every algorithm begins with, of all faces: fills relevant,
 * bounds and whole. */
void hsr_screen_cull(struct hsr_screen *screen, struct hsr_tally *tally);

/* All of these. HSR_E_NOMEM. */
enum hsr_status hsr_screen_make(struct hsr_screen *screen,
                                const struct hsr_world *world,
                                const struct hsr_view *view,
                                struct hsr_arena *arena,
                                struct hsr_tally *tally);

/* Does the face exist for this view: not a back face of a one-sided object, and
 * its plane does not hold the eye. */
bool hsr_face_exists(const struct hsr_screen *screen, uint32_t f,
                     struct hsr_tally *tally);

/* The exact ends of the filters below; call those. */
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

/* Is f nearer than g on the ray of a sample at (sx, sy), or of sample (i, j),
 * by their planes: the order of the picture, ties included. Both exist; f != g.
 * (sx, sy) is any point of the picture, 0 <= sx <= m and 0 <= sy <= n, for all
 * of which the bound of the planes' errors is proved. Where a plane is met
 * behind the eye its 1/t is negative, and compared as that: so the order of two
 * planes changes at most at one place of a row. */
static inline bool hsr_nearer_at(const struct hsr_screen *screen, uint32_t f,
                                 uint32_t g, double sx, double sy,
                                 struct hsr_tally *tally) {
  HSR_COUNT_DEPTHS(tally, 1);
  if (screen->world->mesh.plane[f] == screen->world->mesh.plane[g])
    return f < g;
  double bound = screen->plane[f].error + screen->plane[g].error;
  double by = hsr_depth_at(screen, f, sx, sy) - hsr_depth_at(screen, g, sx, sy);
  if (by > bound)
    return true;
  if (by < -bound)
    return false;
  return hsr_nearer_exact(screen, f, g, sx, sy, tally);
}
static inline bool hsr_nearer(const struct hsr_screen *screen, uint32_t f,
                              uint32_t g, int i, int j,
                              struct hsr_tally *tally) {
  return hsr_nearer_at(screen, f, g, hsr_sample_x(screen->view, i),
                       hsr_sample_y(screen->view, j), tally);
}

/* q of face f's plane at vertex v, which is safely before the eye, within
 * hsr_vertex_error. Where a face is whole, these are the extremes of what it
 * has in its samples. */
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
 * is safely before the eye: +1 f's, -1 g's, 0 if they meet there; nothing is
 * perturbed. If f is whole and this is +1 or 0 at all of its vertices, then f
 * is nearer, by hsr_nearer, at every sample that it covers; or both are on one
 * plane. Both exist. */
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

/* On which side of sample row j vertex v lies: -1 above the line, or on it;
 * +1 below. For a vertex behind the eye the sides are those of the
 * definition. */
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

/* The first row, in [0, n], whose line lies below vertex v or on it. v is
 * safely before the eye. An edge between vertices a and b of a whole face
 * crosses just the rows [first(a), first(b)). */
int hsr_vertex_row(const struct hsr_screen *screen, uint32_t v,
                   struct hsr_tally *tally);

/* An edge of a whole face on the screen, to be followed from row to row. */
struct hsr_edge {
  uint32_t a, b;              /* vertices, a above b */
  double x, slope, tolerance; /* crossing of row j: x + slope * sy, within */
};
void hsr_edge_init(struct hsr_edge *edge, const struct hsr_screen *screen,
                   uint32_t a, uint32_t b);
int hsr_edge_column_exact(const struct hsr_screen *screen,
                          const struct hsr_edge *edge, int j,
                          struct hsr_tally *tally);

/* The first column, in [0, m], whose sample lies right of the edge, or on it,
 * in row j, which the edge crosses. So a convex whole face covers the samples
 * from one of its edges' columns up to the other's. */
static inline int hsr_edge_column(const struct hsr_screen *screen,
                                  const struct hsr_edge *edge, int j,
                                  struct hsr_tally *tally) {
  double x = edge->x + edge->slope * hsr_sample_y(screen->view, j);
  double column = x - hsr_sample_x(screen->view, 0);
  double next = ceil(column);
  if (!(next - column > edge->tolerance && column - next + 1 > edge->tolerance))
    return hsr_edge_column_exact(screen, edge, j, tally);
  int m = screen->view->m;
  return next <= 0 ? 0 : next >= m ? m : (int)next;
}

/* The samples of row j that face f covers, as columns c[0] <= c[1] <= ...: it
 * covers [c[0], c[1]), [c[2], c[3]) and so on. Returns how many columns, an
 * even number; `columns` has room for the face's size + 4. */
int hsr_face_spans(const struct hsr_screen *screen, uint32_t f, int j,
                   int *columns, struct hsr_tally *tally);

/* --- Cut faces (common/scene/pieces.h) ------------------------------------ */

/* What n_cuts cuts leave of a face; no sample of it is out of its bounds. */
struct hsr_piece {
  uint32_t face, n_cuts;
  const struct hsr_cut *cuts; /* NULL if there are none */
  struct hsr_bounds bounds;
};

/* A relevant face, not cut. */
static inline struct hsr_piece hsr_uncut_face(const struct hsr_screen *screen,
                                              uint32_t f) {
  struct hsr_piece piece = {f, 0, NULL, screen->bounds[f]};
  return piece;
}

/* On which side of the plane of g does the ray of sample (i, j) meet the plane
 * of f: +1 in front of it, -1 behind. f exists and is ahead there; f and g do
 * not lie on one plane. The plane of g may hold the eye; both are filled in, as
 * those of all cutting faces must be by the time that a divided one is asked
 * about. */
int hsr_cut_side(const struct hsr_screen *screen, uint32_t f, uint32_t g, int i,
                 int j, struct hsr_tally *tally);

/* hsr_covers for the piece of f that n cuts leave. */
bool hsr_piece_covers(const struct hsr_screen *screen, uint32_t f,
                      const struct hsr_cut *cut, size_t n, int i, int j,
                      struct hsr_tally *tally);

/* hsr_face_spans for the piece of f that n cuts leave. */
int hsr_piece_spans(const struct hsr_screen *screen, uint32_t f,
                    const struct hsr_cut *cut, size_t n, int j, int *columns,
                    struct hsr_tally *tally);

/* --- Polygons that are in no screen --------------------------------------- */

/* The same questions about polygons given by their corners, at any (sx, sy):
 * faces that move with their instance, and planes across an axis. There is no
 * filter: whoever asks has one of his own, and asks about what that leaves
 * open. tally->exact counts each. */

/* The sign of edge(a, b), as of hsr_edge_side. */
int hsr_loop_edge_side(const struct hsr_view *view, const double a[3],
                       const double b[3], double sx, double sy,
                       struct hsr_tally *tally);

/* hsr_cut_side, of two planes. */
int hsr_loop_cut_side(const struct hsr_view *view, struct hsr_loop f,
                      struct hsr_loop g, double sx, double sy,
                      struct hsr_tally *tally);

/* Is 1/t of the plane less than 1/near? That is t > near where the plane is met
 * before the eye. And: is it met before the eye, and beyond near? */
bool hsr_loop_past_near(const struct hsr_view *view, struct hsr_loop plane,
                        double sx, double sy, struct hsr_tally *tally);
bool hsr_loop_beyond_near(const struct hsr_view *view, struct hsr_loop plane,
                          double sx, double sy, struct hsr_tally *tally);

/* Is (sx, sy) within the polygon: the parity of its edges that cross the row to
 * the right (docs/correct-picture.md)? */
bool hsr_loop_surrounds(const struct hsr_view *view, struct hsr_loop polygon,
                        double sx, double sy, struct hsr_tally *tally);

#ifdef __cplusplus
}
#endif
#endif
