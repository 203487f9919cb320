/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A face against a rectangle of samples: see area.h.
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
 * row sides and edge sides of the definition. An edge in line with the eye
 * never crosses a row, though its ends may be on different sides of some. So
 * parity changes where the row passes an end, and H must not hold such a row.
 * On H the plane lies past near if it does at the corners, both conditions, q >
 * 0 and near q < 1, being linear in the depth q; and nowhere if one of them
 * fails at all corners. */
#include "algorithms/engines/windows/area.h"

struct hsr_area hsr_area_make(const struct hsr_view *view,
                              struct hsr_window samples) {
  struct hsr_area w = {
      .x0 = samples.x0, .y0 = samples.y0, .x1 = samples.x1, .y1 = samples.y1};
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

/* Corner 0, 1, 2, 3 of a window: a sample. */
static int corner_column(const struct hsr_area *w, int corner) {
  return corner & 1 ? w->x1 - 1 : w->x0;
}
static int corner_row(const struct hsr_area *w, int corner) {
  return corner & 2 ? w->y1 - 1 : w->y0;
}

/* Both ends of the edge lie above the window, or both below. */
static bool passes_by_rows(const struct hsr_screen *screen, uint32_t a,
                           uint32_t b, const struct hsr_area *w,
                           struct hsr_tally *tally) {
  int side = hsr_row_side(screen, a, w->y0, tally);
  return side == hsr_row_side(screen, b, w->y0, tally) &&
         side == hsr_row_side(screen, a, w->y1 - 1, tally) &&
         side == hsr_row_side(screen, b, w->y1 - 1, tally);
}

/* Vertex v is above all rows of the window, or below all. */
static bool keeps_side(const struct hsr_screen *screen, uint32_t v,
                       const struct hsr_area *w, struct hsr_tally *tally) {
  return hsr_row_side(screen, v, w->y0, tally) ==
         hsr_row_side(screen, v, w->y1 - 1, tally);
}

/* All corners of the window lie on one side of the edge's line. An edge that is
 * in line with the eye has no sides, and crosses no row: there the row sides of
 * its ends must be the same in all of the window. */
static bool corners_agree(const struct hsr_screen *screen, uint32_t a,
                          uint32_t b, const struct hsr_area *w,
                          struct hsr_tally *tally) {
  int side = hsr_edge_side(screen, a, b, w->x0, w->y0, tally);
  if (!side)
    return keeps_side(screen, a, w, tally) && keeps_side(screen, b, w, tally);
  for (int corner = 1; corner < 4; corner++)
    if (hsr_edge_side(screen, a, b, corner_column(w, corner),
                      corner_row(w, corner), tally) != side)
      return false;
  return true;
}

/* The edge certainly has no point among the samples of the window, nor between
 * them. */
static bool passes_by(const struct hsr_screen *screen, uint32_t a, uint32_t b,
                      const struct hsr_area *w, struct hsr_tally *tally) {
  const double *sx = screen->sx, *sy = screen->sy;
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
  return passes_by_rows(screen, a, b, w, tally) ||
         corners_agree(screen, a, b, w, tally);
}

/* Some edge of the face may meet the window. */
static bool edges_meet(const struct hsr_screen *screen, uint32_t f,
                       const struct hsr_area *w, struct hsr_tally *tally) {
  const struct hsr_world *world = screen->world;
  const uint32_t *vertex = world->mesh.vertex + world->mesh.start[f];
  uint32_t n = hsr_face_size(world, f);
  for (uint32_t k = 0, last = n - 1; k < n; last = k++)
    if (!passes_by(screen, vertex[last], vertex[k], w, tally))
      return true;
  return false;
}

/* The relation of a cut face of which no edge meets the window. Twice the error
 * of its depths leaves room for rounding here. */
static enum hsr_relation relate_cut(const struct hsr_screen *screen, uint32_t f,
                                    const struct hsr_area *w,
                                    struct hsr_tally *tally) {
  const struct hsr_view *view = screen->view;
  double near = view->near, error = 2 * screen->plane[f].error;
  int n_behind = 0, n_before_near = 0, n_covered = 0;
  for (int corner = 0; corner < 4; corner++) {
    int i = corner_column(w, corner), j = corner_row(w, corner);
    double q = hsr_depth(screen, f, i, j);
    bool covered = hsr_covers(screen, f, i, j, tally);
    /* Past near but not covered: so the parity is even, in all of H. */
    if (!covered && (view->parallel ? q + error < -near
                                    : q > error && near * (q + error) < 1))
      return HSR_DISJOINT;
    n_covered += covered;
    n_behind += !view->parallel && q < -error;
    n_before_near +=
        view->parallel ? q - error > -near : near * (q - error) > 1;
  }
  if (n_behind == 4 || n_before_near == 4)
    return HSR_DISJOINT;
  return n_covered == 4 ? HSR_SURROUNDER : HSR_INTERSECTER;
}

enum hsr_relation hsr_area_relate_but_surround(const struct hsr_screen *screen,
                                               uint32_t f,
                                               const struct hsr_area *w,
                                               bool reaches_over, bool *asks,
                                               struct hsr_tally *tally) {
  if (!hsr_area_is_sample(w)) {
    if (edges_meet(screen, f, w, tally))
      return HSR_INTERSECTER;
    if (!reaches_over)
      return HSR_DISJOINT;
    if (!screen->whole[f])
      return relate_cut(screen, f, w, tally);
  }
  if (screen->whole[f])
    *asks = true;
  else if (hsr_covers(screen, f, w->x0, w->y0, tally))
    return HSR_SURROUNDER;
  return HSR_DISJOINT;
}

enum hsr_relation hsr_area_relate_edges(const struct hsr_screen *screen,
                                        uint32_t f, const struct hsr_area *w,
                                        bool reaches_over,
                                        struct hsr_tally *tally) {
  bool asks = false;
  enum hsr_relation relation =
      hsr_area_relate_but_surround(screen, f, w, reaches_over, &asks, tally);
  return asks && hsr_covers(screen, f, w->x0, w->y0, tally) ? HSR_SURROUNDER
                                                            : relation;
}
