// SPDX-License-Identifier: GPL-3.0-or-later
// The exact points of common/lines/edges.h that are not vertices, for the
// core's own C++ files.
#ifndef HSR_COMMON_EXACT_POINTS_H
#define HSR_COMMON_EXACT_POINTS_H

#include "common/lines/edges.h"
#include "common/statistics/penetration.h"

#include <vector>

struct hsr_exact_points {
  // points[k] is point n_vertices + k of hsr_edges.
  std::vector<hsr::Exact_point> points;

  // Intervals that hold the numerators and the denominators of the points.
  struct Rough {
    hsr::Interval at[3], denominator;
  };
  std::vector<Rough> rough;

  // Appends a point. May throw std::bad_alloc.
  void add(const hsr::Exact_point &point) {
    points.push_back(point);
    rough.push_back(
        {{hsr::interval_of(point.at[0]), hsr::interval_of(point.at[1]),
          hsr::interval_of(point.at[2])},
         hsr::interval_of(point.denominator)});
  }

  // Returns a coordinate of a point, with a relative error of at most 2^-50.
  static double rounded(const hsr::Exact_point &point, int axis);
};

#endif
