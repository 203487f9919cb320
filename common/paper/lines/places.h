// SPDX-License-Identifier: GPL-3.0-or-later
// Named places of a drawing, exact, and how their images lie. For the C++ files
// of this folder.
//
// A place is a point of space in homogeneous coordinates. The eye C is (E, 1),
// or in parallel projection (F, 0): view.h. Images of points P and Q lie on one
// line of the picture with that of A and B if P, Q, A, B, C are in one plane.
// All questions are signs of determinants of four such rows.
#ifndef HSR_COMMON_PAPER_PLACES_H
#define HSR_COMMON_PAPER_PLACES_H

#include "common/base/exact.h"
#include "common/exact/exact_plane.h"
#include "common/statistics/penetration.h"
#include "common/view/view.h"

#include <array>

namespace hsr {

// Parameters of changes of visibility have a relative error of 1e-12:
// docs/correct-drawing.md. Twice that is room for the two products.
constexpr double CHANGE_ERROR = 2e-12;

using Row = std::array<Exact, 4>;
using Rough_row = std::array<Safe_interval, 4>;

// Exact numbers, and intervals that hold them.
struct Place {
  Row exact;
  Rough_row rough;
  bool named = true; // a vertex or the end of an implied edge

  explicit Place(const Row &row);
  static Place vertex(const hsr_world *world, uint32_t v);
  static Place of(const Exact_point &point);
  // The place at t of the way from a to b.
  static Place between(const Place &a, const Place &b, double t);
  // Rows that hold the places from lo to hi of the way.
  static Rough_row rough_between(const Place &a, const Place &b, double lo,
                                 double hi);
  // The direction of an axis.
  static Place axis(int k);
};

// The eye.
Place eye_of(const hsr_view *view);

// The sign of the determinant of four rows.
int side_of(const Place &a, const Place &b, const Place &c, const Place &d);

// Whether the images of a and b are one.
bool at_one_image(const Place &a, const Place &b, const Place &eye);

// Finds images on the screen of a view.
class Screen {
public:
  explicit Screen(const hsr_view *view);
  // The image, as two intervals, in pixels; false if they are not bounded.
  bool find(const Rough_row &place, Safe_interval at[2]) const;

private:
  Safe_interval row_[3][3], origin_[3], eye_[3];
};

} // namespace hsr

#endif
