/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cutting a rectangle of the picture plane into cells, each of which shows one
 * face, or the background.
 *
 * Method      a convex cell and the faces that may be seen in it. An edge whose
 *             boundary meets the inside of the cell cuts it. Where no boundary
 *             meets the inside, the parity of an inner point is that of all.
 *             Then the lines cut where a face's plane is hit at the eye or at
 *             near. A face that covers all of a cell drops what is not nearer
 *             anywhere in it; two such faces are cut where they are equally
 *             near. When one face is left, and it covers the cell, it is seen.
 * Invariants  a cell is strictly convex: every side is on a line of its own. Its
 *             inside is open and not empty, and a cut leaves two such cells.
 * Progress    every cut takes an edge, a bound or a pair of faces off the list
 *             of both parts: no line cuts a cell twice. */
#ifndef HSR_BENCH_JUDGE_AREAS_CELLS_H
#define HSR_BENCH_JUDGE_AREAS_CELLS_H

#include "bench/judge/areas/shapes.h"

#include <deque>

namespace areas {

/* Side i runs from corner i to corner i + 1. Around it sx turns to sy. */
struct cell {
  std::vector<line *> side;
  std::vector<point *> corner;
};

/* From (x0/2, y0/2) to (x1/2, y1/2). Its sides are above, to the right, below and
 * to the left, k from 0 to 3 of a GRID_LINE. */
struct halves {
  int x0, y0, x1, y1;
};

/* Takes the cells one by one. */
struct sink {
  virtual ~sink() = default;
  /* What is seen in it; NULL: the background. */
  virtual void take(const cell &part, const shape *seen) = 0;
};

/* `faces`: all that may be seen in the rectangle. */
void cut(const halves &rectangle, const std::vector<shape *> &faces, sink &to);

/* What is known of a face in a rectangle, by intervals alone. */
enum cover { NOT_THERE, MAYBE, COVERS };
enum cover cover_of(shape &f, const halves &rectangle);

/* Whether f is certain to be nearer than g all over the rectangle. */
bool is_nearer_in(const shape &f, const shape &g, const halves &rectangle);

} // namespace areas

#endif
