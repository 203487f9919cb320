/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The faces of a view, as functions on its picture plane.
 *
 * Source      docs/correct-picture.md. All that it compares is affine in sx and
 *             sy: row(v), edge(a, b), kN·D, and in parallel N·(S - kP).
 * Frame       D, or in parallel P - E, is taken mn times: O + sx X + sy Y.
 * Boundary    the parity of a face changes where D is in the plane of an edge
 *             ab and between a and b, as directions: D = αa + βb with αβ > 0.
 *             Along R, row(v) tells the same: αβ > 0 if row(a) and row(b) have
 *             different signs. This holds unless row(a) and row(b) are
 *             proportional, for a horizontal edge. Then det(D, U, v), the
 *             column, is put in its place. If columns are proportional, too,
 *             the edge is in the eye's plane, or on a line through the eye. The
 *             first is no boundary on the picture. In parallel projection it is
 *             the same, with det(F, R, V - P) and det(F, U, V - P).
 * Eye         an edge on a line through the eye is skipped, says the definition.
 *             Where the eye is one of its ends or between them, a and b flip
 *             their rows where the other edges there are crossed on different
 *             sides of the sample. So the parity may change along all of the
 *             row's line. (The face is not planar then, or it covers nothing.)
 * Sides       s and c are taken times the sign of c. So c > 0, and the greater
 *             s/c is nearer. A face is hit where s > 0, in parallel everywhere,
 *             and beyond near where `near` > 0. */
#ifndef HSR_BENCH_JUDGE_AREAS_SHAPES_H
#define HSR_BENCH_JUDGE_AREAS_SHAPES_H

#include "bench/judge/areas/numbers.h"
#include "bench/judge/vectors.h"
#include "common/scene/world.h"
#include "common/view/view.h"

#include <array>
#include <memory>
#include <vector>

namespace areas {

using judge::vec;

template <class T> struct frame {
  bool parallel;
  vec<T> E, F, R, U;
  vec<T> O, X, Y;
  T mn, near;
};

/* What is the same for all faces. Borrows the world and the view. */
struct stage {
  const hsr_world &world;
  const hsr_view &view;
  frame<Interval> rough;
  frame<Exact> exact;

  stage(const hsr_world &w, const hsr_view &v);
};

/* A face's functions in exact numbers. By corner k: the row and the column of
 * its vertex, the edge from there to the next. */
struct exact_shape {
  std::vector<affine<Exact>> row, column, edge;
  affine<Exact> s, near;
  Exact c;
};

/* How an edge's boundary is found; the last two: it is the line of the row of a,
 * or of b. */
enum meeting : char {
  BY_ROWS,
  BY_COLUMNS,
  NO_BOUNDARY,
  ALL_OF_ROW,
  ALL_OF_NEXT_ROW
};

struct box {
  double x0, x1, y0, y1;
};

/* A face that exists and whose plane the eye is not in. Not copied: its lines
 * refer to it. */
struct shape {
  const stage &on;
  uint32_t id;
  uint32_t n; /* corners */
  int side;   /* the sign of c, before it was made positive */
  std::vector<line> row, column, edge;
  std::vector<meeting> by;
  line s, near;
  Interval c;
  std::vector<box> edge_box; /* of the boundary at each edge; infinite if a or b
                                may be in the eye's plane or both differ */
  box bounds;
  mutable std::unique_ptr<exact_shape> known;

  shape(const stage &on, uint32_t id, int side);
  shape(const shape &) = delete;
  shape &operator=(const shape &) = delete;

  const exact_shape &exactly() const;

  uint32_t next(uint32_t k) const { return k + 1 == n ? 0 : k + 1; }
  /* The line on which the boundary of edge k is. */
  line &boundary(uint32_t k) {
    return by[k] == ALL_OF_ROW        ? row[k]
           : by[k] == ALL_OF_NEXT_ROW ? row[next(k)]
                                      : edge[k];
  }
  /* The two functions of edge k that have different signs on its boundary. */
  line &from(uint32_t k) { return by[k] == BY_ROWS ? row[k] : column[k]; }
  line &to(uint32_t k) {
    return by[k] == BY_ROWS ? row[next(k)] : column[next(k)];
  }

  /* Whether an odd number of edges crosses to the right at a point that is on no
   * boundary. */
  bool is_odd_at(point &at);
};

/* The shape of face f; NULL if the face covers nothing. */
std::unique_ptr<shape> make_shape(const stage &on, uint32_t f);

/* s/c of f less that of g. *made is not to be used before, and refers to both. */
void compare_depths(const shape &f, const shape &g, line *made);

/* Where the image of face f is certain to be, from the view alone. */
box bounds_of(const stage &on, uint32_t f);

} // namespace areas

#endif
