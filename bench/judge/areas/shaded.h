/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Enclosures of a pixel's value where a shader varies the colours.
 *
 * Method      the cells of one visible face (cells.h) are cut into triangles.
 *             On a triangle of centroid g the mean of a function lies between
 *             the least and the greatest of it; and, if it is smooth there, it
 *             is the value at g, but for Fxx Mxx / 2 + Fxy Mxy + Fyy Myy / 2,
 *             with second derivatives of somewhere in the triangle and the
 *             second moments M about g. Of all triangles of a pixel the most
 *             uncertain one is halved until the sum is narrow enough.
 * Corners     are rounded to doubles in the frame of an atom (moments.h), where
 *             the triangle is of at most 1 in size. A corner that moves by d
 *             sweeps an area of less than 2d at each of the sides that meet
 *             there: `slack` counts that. */
#ifndef HSR_BENCH_JUDGE_AREAS_SHADED_H
#define HSR_BENCH_JUDGE_AREAS_SHADED_H

#include "bench/judge/areas/cells.h"
#include "bench/judge/areas/jets.h"
#include "bench/judge/areas/shading.h"

namespace areas {

/* A face's plane, seen from the eye: N·(S/k - E). */
struct shaded_face {
  surface_of_shader surface;
  vec<Interval> normal;
  Interval height;
};

/* A part of an atom that shows one face. */
struct patch {
  const shaded_face *face;  /* NULL: the background */
  std::vector<double> x, y; /* in the atom's frame */
};

class shaded_pixel {
public:
  shaded_pixel(const stage &on, const hsr_shades &shading, int degree,
               const double background[3])
      : on_(on), shading_(shading), degree_(degree), background_(background) {}

  void begin() { all_.clear(), slack_ = 0; }
  /* What a patch gives, as piece k across and l down of the filter. */
  void add(const patch &p, int atom_x, int atom_y, int k, int l);
  void add_slack(double by) { slack_ += by; }
  /* Bounds of the integral, no wider than `width` if that can be had with so
   * many triangles. */
  void enclose(double width, size_t most, Interval sum[3]);

private:
  struct triangle {
    double x[3], y[3];
    const shaded_face *face;
    int atom_x, atom_y, k, l;
    Interval part[3];
    double uncertainty;
    bool operator<(const triangle &t) const {
      return uncertainty < t.uncertainty;
    }
  };

  const stage &on_;
  const hsr_shades &shading_;
  const int degree_;
  const double *background_;
  std::vector<triangle> all_;
  double slack_ = 0;

  void bound(triangle *t) const;
  template <int O>
  void look(const triangle &t, const Interval &x, const Interval &y,
            jet<O> rgb[3]) const;
};

} // namespace areas

#endif
