/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The colour and the opacity of a sample as a splat, in the integers of
 * docs/composited-picture.md, for judges. */
#ifndef HSR_BENCH_JUDGE_SAMPLES_H
#define HSR_BENCH_JUDGE_SAMPLES_H

#include "common/grids/grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace judge {

/* The greatest integer whose square is at most x. */
inline int64_t root(int64_t x) {
  int64_t r = int64_t(std::sqrt(double(x)));
  while (r * r > x)
    r--;
  while ((r + 1) * (r + 1) <= x)
    r++;
  return r;
}

using whole_vec = std::array<int64_t, 3>;

inline int64_t dot(const whole_vec &a, const whole_vec &b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The vector N of a code below 4096. */
inline whole_vec normal(int code) {
  const int64_t x = 2 * (code % 64) - 63, y = 2 * (code / 64) - 63;
  const int64_t across = std::abs(x), up = std::abs(y), z = 63 - across - up;
  if (z >= 0)
    return {x, y, z};
  return {x < 0 ? up - 63 : 63 - up, y < 0 ? across - 63 : 63 - across, z};
}

/* The part floor(8192 a / b), at least 0, at most 8192; 0 if b is 0. */
inline int64_t light_part(int64_t a, int64_t b) {
  return b == 0 || a <= 0 ? 0 : std::min<int64_t>(8192 * a / b, 8192);
}

/* What of the light a sample sends to the eye: c and s_n. |F| is about 1, so
 * that all stays below 2^63. */
struct light {
  int64_t diffuse = 8192, specular = 0;

  light(const hsr_palette &p, int code, const whole_vec &V) {
    if (code >= 4096)
      return;
    const whole_vec N = normal(code),
                    L = p.eye_light
                            ? V
                            : whole_vec{p.light[0], p.light[1], p.light[2]};
    const int64_t NN = dot(N, N), LL = dot(L, L);
    diffuse = light_part(dot(N, L), root(NN * LL));
    const int64_t x = 2 * dot(N, L) * dot(N, V) - dot(L, V) * NN;
    const int64_t s = diffuse ? light_part(x, NN * root(LL * dot(V, V))) : 0;
    specular = s;
    for (int k = 1; k < p.exponent; k++)
      specular = specular * s / 8192;
  }
};

/* A kept sample, of 65535: its lit colour, its opacity, and its premultiplied
 * colour with the opacity. */
struct looks {
  std::array<uint64_t, 3> lit;
  uint64_t A;
  std::array<uint64_t, 4> C;
};

inline looks looks_of(const hsr_grid &grid, uint32_t cell, const whole_vec &V,
                      uint64_t attenuate) {
  const hsr_palette &p = grid.palette;
  const uint64_t O = p.opacity[grid.level[cell]],
                 G = p.gradient[grid.steep[cell]];
  const uint64_t A = O * G / 65535 * attenuate / 65536;
  const light l(p, grid.normal[cell], V);
  const uint64_t bright = p.ambient + p.diffuse * uint64_t(l.diffuse) / 8192;
  const uint64_t shine = p.specular * uint64_t(l.specular) / 8192;
  looks found = {{}, A, {}};
  for (size_t c = 0; c < 3; c++) {
    uint64_t B = p.rgb[grid.level[cell]][c];
    if (grid.rgb && p.own_colours) {
      const uint64_t byte = grid.rgb[cell][c];
      B = 65535 * byte * byte / 65025;
    }
    const uint64_t lit = std::min<uint64_t>(65535, B * bright / 65535 + shine);
    found.lit[c] = lit;
    found.C[c] = lit * A / 65535;
  }
  found.C[3] = A;
  return found;
}

} // namespace judge

#endif
