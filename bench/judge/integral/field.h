/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The samples of a grid as a ray meets them: between the planes of samples are
 * boxes, and at each of a box's eight corners is a sample. One more plane lies
 * before the first along each axis, and one after the last, where all samples are
 * clear (docs/integral.md). */
#ifndef HSR_BENCH_JUDGE_INTEGRAL_FIELD_H
#define HSR_BENCH_JUDGE_INTEGRAL_FIELD_H

#include "bench/judge/integral/integral.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace integral {

/* Of a sample, what is interpolated, in integers. Clear samples have only zeros.
 * PRE, SUMS   premultiplied red, green, blue; opacity: of 65535.
 * POST        1; the level of density; that of the gradient; two parts of the
 *             light, of 65535: how bright, and the shine; and, if samples have
 *             colours of their own, these three. */
constexpr int MOST_PARTS = 8;
enum { POST_KEPT, POST_LEVEL, POST_STEEP, POST_BRIGHT, POST_SHINE, POST_OWN };

struct field {
  const hsr_palette &palette;
  integral_field kind;
  int parts;            /* a sample */
  bool own;             /* POST: samples have their own colours */
  std::array<int, 3> n; /* planes along each axis */
  std::array<std::vector<double>, 3> plane; /* their places, ascending */
  std::vector<uint16_t> sample;             /* by z, y, x, part */
  std::vector<uint8_t>
      clear; /* by z, y, x of a box's lowest corner: whether all
                                 its corners are clear */

  /* For the light in this view. Doubles are rounded to nearest here. */
  field(const hsr_grid &grid, const hsr_view &view, integral_field which);

  size_t place(const std::array<int, 3> &at) const {
    return (size_t(at[2]) * size_t(n[1]) + size_t(at[1])) * size_t(n[0]) +
           size_t(at[0]);
  }
  /* The samples at the corners of box at[]; bit a of a corner's number is set if
   * it is the upper one along axis a. */
  void corners(const std::array<int, 3> &at, const uint16_t *corner[8]) const {
    for (int c = 0; c < 8; c++)
      corner[c] =
          &sample[size_t(parts) * place({at[0] + (c & 1), at[1] + (c >> 1 & 1),
                                         at[2] + (c >> 2)})];
  }

private:
  void place_planes(const hsr_grid &grid);
  void fill(const hsr_grid &grid, const hsr_view &view);
  void mark_clear();
};

} // namespace integral

#endif
