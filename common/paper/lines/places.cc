// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/paper/lines/places.h"

namespace hsr {

namespace {

Safe_interval rough_of(const Exact &x) {
  const Interval held = interval_of(x);
  return {held.inf(), held.sup()};
}

template <class T>
T minor2(const std::array<T, 4> &a, const std::array<T, 4> &b, int i, int j) {
  return a[size_t(i)] * b[size_t(j)] - a[size_t(j)] * b[size_t(i)];
}

// By Laplace, along the first two rows.
template <class T>
T determinant(const std::array<T, 4> &a, const std::array<T, 4> &b,
              const std::array<T, 4> &c, const std::array<T, 4> &d) {
  return minor2(a, b, 0, 1) * minor2(c, d, 2, 3) -
         minor2(a, b, 0, 2) * minor2(c, d, 1, 3) +
         minor2(a, b, 0, 3) * minor2(c, d, 1, 2) +
         minor2(a, b, 1, 2) * minor2(c, d, 0, 3) -
         minor2(a, b, 1, 3) * minor2(c, d, 0, 2) +
         minor2(a, b, 2, 3) * minor2(c, d, 0, 1);
}

} // namespace

Place::Place(const Row &row)
    : exact(row), rough{rough_of(row[0]), rough_of(row[1]), rough_of(row[2]),
                        rough_of(row[3])} {}

Place Place::vertex(const hsr_world *world, uint32_t v) {
  return Place({Exact(world->mesh.x[v]), Exact(world->mesh.y[v]),
                Exact(world->mesh.z[v]), Exact(1)});
}

Place Place::of(const Exact_point &point) {
  return Place({point.at[0], point.at[1], point.at[2], point.denominator});
}

Place Place::between(const Place &a, const Place &b, double t) {
  const Exact wa = a.exact[3], wb = b.exact[3], s = Exact(1) - Exact(t);
  Row row;
  for (size_t k = 0; k < 3; k++)
    row[k] = a.exact[k] * wb * s + b.exact[k] * wa * Exact(t);
  row[3] = wa * wb;
  Place place(row);
  place.named = false;
  return place;
}

Rough_row Place::rough_between(const Place &a, const Place &b, double lo,
                               double hi) {
  const Safe_interval t(lo, hi), wa = a.rough[3], wb = b.rough[3];
  const Safe_interval from = wb * (Safe_interval(1) - t), to = wa * t;
  return {a.rough[0] * from + b.rough[0] * to,
          a.rough[1] * from + b.rough[1] * to,
          a.rough[2] * from + b.rough[2] * to, wa * wb};
}

Place Place::axis(int k) {
  Row row{Exact(0), Exact(0), Exact(0), Exact(0)};
  row[size_t(k)] = Exact(1);
  return Place(row);
}

Place eye_of(const hsr_view *view) {
  const double *at = view->parallel ? view->F : view->E;
  return Place({Exact(at[0]), Exact(at[1]), Exact(at[2]),
                Exact(view->parallel ? 0 : 1)});
}

int side_of(const Place &a, const Place &b, const Place &c, const Place &d) {
  const Safe_interval rough = determinant(a.rough, b.rough, c.rough, d.rough);
  if (rough.inf() > 0)
    return 1;
  if (rough.sup() < 0)
    return -1;
  return CGAL::sign(determinant(a.exact, b.exact, c.exact, d.exact));
}

bool at_one_image(const Place &a, const Place &b, const Place &eye) {
  for (int k = 0; k < 3; k++)
    if (side_of(a, b, eye, Place::axis(k)))
      return false;
  return true;
}

// The screen matrix is rounded, to 2^-52 of each entry: view.h.
Screen::Screen(const hsr_view *view) {
  const auto entry = [](double x) {
    return Safe_interval(1 - 0x1p-51, 1 + 0x1p-51) * Safe_interval(x);
  };
  for (int r = 0; r < 3; r++) {
    origin_[r] = entry(view->origin[r]);
    eye_[r] = view->E[r];
    for (int k = 0; k < 3; k++)
      row_[r][k] = entry(view->screen[r][k]);
  }
}

bool Screen::find(const Rough_row &p, Safe_interval at[2]) const {
  Safe_interval from_eye[3], image[3];
  for (size_t k = 0; k < 3; k++)
    from_eye[k] = p[k] - eye_[k] * p[3];
  for (int r = 0; r < 3; r++)
    image[r] = origin_[r] * p[3] + row_[r][0] * from_eye[0] +
               row_[r][1] * from_eye[1] + row_[r][2] * from_eye[2];
  if (!(image[2].inf() > 0))
    return false;
  at[0] = image[0] / image[2];
  at[1] = image[1] / image[2];
  return std::isfinite(at[0].inf()) && std::isfinite(at[0].sup()) &&
         std::isfinite(at[1].inf()) && std::isfinite(at[1].sup());
}

} // namespace hsr
