// SPDX-License-Identifier: GPL-3.0-or-later
// Whether an object is closed, consistently oriented and outward.
#include "common/base/exact.h"
#include "common/base/share.h"
#include "common/files/mesh/exchange.h"

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <new>
#include <vector>

namespace {

constexpr uint32_t RANGE = 4096; /* faces or vertices for a thread at a time */

/* Whether a vertex has one corner. Then no face leads back along the edge that
 * leaves it: the object is open. Of loose triangles all are so, and much need
 * not be asked. */
bool has_lone_corner(const struct hsr_object &object) {
  std::vector<unsigned char> corners(object.n_vertices);
  for (uint32_t c = 0; c < object.start[object.n_faces]; c++) {
    unsigned char &n = corners[object.vertex[c]];
    n = static_cast<unsigned char>(n < 2 ? n + 1 : 2);
  }
  return std::find(corners.begin(), corners.end(), 1) != corners.end();
}

/* Whether every edge is run exactly once in each direction. end[at[v] .. at[v +
 * 1]) holds the ends of the edges that leave v. It is enough to ask for each
 * edge how often its reverse is run: an edge that is run twice is found when
 * its reverse is looked at. */
class Edges {
public:
  explicit Edges(const struct hsr_object &object);
  bool are_closed_and_oriented(int threads);

private:
  using Look = uint32_t(void *, uint32_t, uint32_t);
  static Look sort, find_open;
  size_t runs(uint32_t a, uint32_t b) const;

  uint32_t n_vertices_;
  std::vector<uint32_t> at_, end_;
};

Edges::Edges(const struct hsr_object &object)
    : n_vertices_(object.n_vertices), at_(size_t{object.n_vertices} + 2),
      end_(object.start[object.n_faces]) {
  const uint32_t *vertex = object.vertex;
  for (size_t c = 0; c < end_.size(); c++)
    at_[size_t{vertex[c]} + 2]++;
  for (size_t v = 2; v < at_.size(); v++)
    at_[v] += at_[v - 1];
  for (uint32_t f = 0; f < object.n_faces; f++)
    for (uint32_t c = object.start[f], last = object.start[f + 1]; c < last;
         c++)
      end_[at_[size_t{vertex[c]} + 1]++] =
          vertex[c + 1 < last ? c + 1 : object.start[f]];
}

uint32_t Edges::sort(void *context, uint32_t from, uint32_t to) {
  Edges &edges = *static_cast<Edges *>(context);
  for (uint32_t v = from; v < to; v++)
    std::sort(edges.end_.begin() + edges.at_[v],
              edges.end_.begin() + edges.at_[v + 1]);
  return to;
}

/* How often the edge from a to b is run. */
size_t Edges::runs(uint32_t a, uint32_t b) const {
  const auto range =
      std::equal_range(end_.begin() + at_[a], end_.begin() + at_[a + 1], b);
  return static_cast<size_t>(range.second - range.first);
}

/* The first vertex with an edge to another vertex from which not exactly one
 * edge leads back. */
uint32_t Edges::find_open(void *context, uint32_t from, uint32_t to) {
  const Edges &edges = *static_cast<const Edges *>(context);
  for (uint32_t v = from; v < to; v++)
    for (uint32_t e = edges.at_[v]; e < edges.at_[v + 1]; e++)
      if (edges.runs(edges.end_[e], v) != 1)
        return v;
  return to;
}

bool Edges::are_closed_and_oriented(int threads) {
  hsr_share_search(threads, n_vertices_, RANGE, sort, this);
  return hsr_share_search(threads, n_vertices_, RANGE, find_open, this) ==
         n_vertices_;
}

template <class Number> struct Volume {
  Number sum = 0;       /* six times the volume */
  Number magnitude = 0; /* the products that were added, all made positive */
};

/* Of faces from .. to - 1 of a closed object: the sum, over the triangles a b c
 * of a fan in each face, of det(a - o, b - o, c - o). Over all faces it does
 * not depend on o. */
template <class Number, class Size>
Volume<Number> volume(const struct hsr_object &object, uint32_t from,
                      uint32_t to, Size size) {
  Volume<Number> result;
  std::array<Number, 3> corner[3];
  const double *origin = object.xyz + 3 * size_t{object.vertex[0]};
  const auto take = [&](std::array<Number, 3> &place, uint32_t v) {
    for (size_t k = 0; k < 3; k++)
      place[k] = Number(object.xyz[3 * size_t{v} + k]) - Number(origin[k]);
  };
  for (uint32_t f = from; f < to; f++) {
    const uint32_t *face = object.vertex + object.start[f];
    const uint32_t n = object.start[f + 1] - object.start[f];
    take(corner[0], face[0]);
    take(corner[2], face[1]);
    for (uint32_t i = 2; i < n; i++) {
      corner[1] = corner[2];
      take(corner[2], face[i]);
      for (size_t k = 0; k < 3; k++) {
        const size_t l = (k + 1) % 3, m = (k + 2) % 3;
        const Number left = corner[0][k] * corner[1][l] * corner[2][m];
        const Number right = corner[0][k] * corner[1][m] * corner[2][l];
        result.sum += left - right;
        result.magnitude += size(left) + size(right);
      }
    }
  }
  return result;
}

/* In doubles: of ranges, which are added in their order. */
struct Rough_volume {
  const struct hsr_object &object;
  std::vector<Volume<double>> ranges;

  static void part(void *context, uint32_t k, int) {
    Rough_volume &rough = *static_cast<Rough_volume *>(context);
    const struct hsr_range range = hsr_range_of(rough.object.n_faces, RANGE, k);
    rough.ranges[k] = volume<double>(rough.object, range.from, range.to,
                                     [](double x) { return std::fabs(x); });
  }
};

Volume<double> rough_volume(const struct hsr_object &object, int threads) {
  const uint32_t n = hsr_n_ranges(object.n_faces, RANGE);
  Rough_volume rough{object, std::vector<Volume<double>>(n)};
  Volume<double> all;
  hsr_share(threads, n, Rough_volume::part, &rough);
  for (const Volume<double> &range : rough.ranges) {
    all.sum += range.sum;
    all.magnitude += range.magnitude;
  }
  return all;
}

/* In doubles if they can tell the sign, else exactly. A product has a relative
 * error of less than 6 u (three differences, two multiplications). The sum of n
 * differences of products adds n + 1 times u, relative to the magnitude. Taking
 * 2 u = DBL_EPSILON for u leaves room for the higher orders, and for the
 * rounding of the magnitude itself. */
bool is_outward(const struct hsr_object &object, int threads) {
  const Volume<double> rough = rough_volume(object, threads);
  const double n = 3.0 * object.start[object.n_faces];
  const double bound = (n + 8) * DBL_EPSILON * rough.magnitude;
  const bool in_range = rough.magnitude < DBL_MAX && bound > n * DBL_MIN;
  if (in_range && std::fabs(rough.sum) > bound)
    return rough.sum > 0;
  using hsr::Exact;
  return volume<Exact>(object, 0, object.n_faces, [](const Exact &) {
           return Exact(0);
         }).sum > Exact(0);
}

} // namespace

enum hsr_status hsr_object_is_solid(const struct hsr_object *object,
                                    int threads, bool *answer) {
  try {
    *answer = object->n_faces && !has_lone_corner(*object) &&
              Edges(*object).are_closed_and_oriented(threads) &&
              is_outward(*object, threads);
    return HSR_OK;
  } catch (const std::bad_alloc &) {
    return HSR_E_NOMEM;
  }
}
