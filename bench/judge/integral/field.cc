/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/judge/integral/field.h"
#include "bench/judge/samples.h"

#include <algorithm>
#include <cmath>

namespace integral {

field::field(const hsr_grid &grid, const hsr_view &view, integral_field which)
    : palette(grid.palette), kind(which),
      own(which == INTEGRAL_POST && grid.rgb && grid.palette.own_colours) {
  parts = which != INTEGRAL_POST ? 4 : own ? MOST_PARTS : int(POST_OWN);
  place_planes(grid);
  fill(grid, view);
  mark_clear();
}

/* The planes at the ends are beyond the outermost samples by twice the distance of
 * these from the bounds of their cells. */
void field::place_planes(const hsr_grid &grid) {
  for (size_t a = 0; a < 3; a++) {
    const uint32_t last = grid.n[a] - 1;
    std::vector<double> &p = plane[a];
    n[a] = int(grid.n[a]) + 2;
    p.push_back(2 * grid.bound[a][0] - grid.at[a][0]);
    p.insert(p.end(), grid.at[a], grid.at[a] + grid.n[a]);
    p.push_back(2 * grid.bound[a][last + 1] - grid.at[a][last]);
    p.front() = std::min(p.front(), std::nextafter(p[1], -HUGE_VAL));
    p.back() = std::max(p.back(), std::nextafter(p[p.size() - 2], HUGE_VAL));
  }
}

void field::fill(const hsr_grid &grid, const hsr_view &view) {
  judge::whole_vec V;
  for (size_t a = 0; a < 3; a++)
    V[a] = -int64_t(std::llrint(1024 * view.F[a]));
  sample.assign(size_t(parts) * size_t(n[0]) * size_t(n[1]) * size_t(n[2]), 0);
  const size_t rows = size_t(grid.n[1]) * grid.n[2];
  for (size_t row = 0; row < rows; row++)
    for (uint32_t cell = grid.row[row]; cell < grid.row[row + 1]; cell++) {
      uint16_t *to = &sample[size_t(parts) * place({int(grid.x[cell]) + 1,
                                                    int(row % grid.n[1]) + 1,
                                                    int(row / grid.n[1]) + 1})];
      if (kind != INTEGRAL_POST) {
        const auto colour = judge::looks_of(grid, cell, V, 65536).C;
        std::copy(colour.begin(), colour.end(), to);
        continue;
      }
      const judge::light light(palette, grid.normal[cell], V);
      to[POST_KEPT] = 1;
      to[POST_LEVEL] = grid.level[cell];
      to[POST_STEEP] = grid.steep[cell];
      to[POST_BRIGHT] = uint16_t(std::min<uint64_t>(
          65535,
          palette.ambient + palette.diffuse * uint64_t(light.diffuse) / 8192));
      to[POST_SHINE] =
          uint16_t(palette.specular * uint64_t(light.specular) / 8192);
      for (size_t c = 0; own && c < 3; c++)
        to[POST_OWN + c] = uint16_t(65535u * grid.rgb[cell][c] *
                                    uint64_t(grid.rgb[cell][c]) / 65025);
    }
}

/* PRE: without opacity there is no colour either. */
void field::mark_clear() {
  clear.assign(sample.size() / size_t(parts), 0);
  const size_t shown = kind == INTEGRAL_POST ? size_t(POST_KEPT) : 3;
  for (int z = 0; z + 1 < n[2]; z++)
    for (int y = 0; y + 1 < n[1]; y++)
      for (int x = 0; x + 1 < n[0]; x++) {
        const uint16_t *corner[8];
        corners({x, y, z}, corner);
        clear[place({x, y, z})] = std::all_of(
            corner, corner + 8, [&](const uint16_t *c) { return !c[shown]; });
      }
}

} // namespace integral
