/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The shaders of docs/area-picture.md, formula by formula, for numbers of any
 * sort that have root, square, positive, slope and squares: jets, and in tests
 * plain long doubles. */
#ifndef HSR_BENCH_JUDGE_AREAS_SHADING_H
#define HSR_BENCH_JUDGE_AREAS_SHADING_H

#include "bench/judge/vectors.h"
#include "common/answers/shader.h"

namespace areas {

using judge::vec;

/* A face as its shader sees it. */
struct surface_of_shader {
  struct hsr_shaded_face face;
  double corner[3][3]; /* of a triangle, if face.by_corners */
};

template <class T> const T &along(const vec<T> &a, int axis) {
  return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}

template <class T> vec<T> unit(const vec<T> &a) {
  return T(T(1) / root(T(square(a.x) + square(a.y) + square(a.z)))) * a;
}

template <class T> vec<T> axis(int k) {
  return {T(k == 0), T(k == 1), T(k == 2)};
}

/* The share that a triangle's corner k has at P. */
template <class T>
T share_of(const surface_of_shader &on, int k, const vec<T> &P) {
  const int u = on.face.u, v = on.face.v;
  const double *a = on.corner[(k + 1) % 3], *b = on.corner[(k + 2) % 3],
               *c = on.corner[k];
  const T across = T(b[u]) - T(a[u]), down = T(b[v]) - T(a[v]);
  const T here =
      across * (along(P, v) - T(a[v])) - down * (along(P, u) - T(a[u]));
  return here / (across * (T(c[v]) - T(a[v])) - down * (T(c[u]) - T(a[u])));
}

/* The colour at P; `to_eye` leads from there to the eye. */
template <class T>
void shade(const hsr_shades &s, const surface_of_shader &on, const vec<T> &P,
           const vec<T> &to_eye, T rgb[3]) {
  const hsr_shaded_face &f = on.face;
  const T one(1), side(s.side);
  for (int c = 0; c < 3; c++)
    rgb[c] = T(f.rgb[c]) / T(65535);
  if (f.by_corners)
    for (int c = 0; c < 3; c++) {
      T sum(0);
      for (int k = 0; k < 3; k++)
        sum = sum + share_of(on, k, P) * T(f.corner[k][c]);
      rgb[c] = sum / T(65535);
    }
  if (!(s.parts & ~unsigned(HSR_PART_CORNERS)))
    return;
  const vec<T> n = judge::lift<T>(f.normal), V = unit(to_eye);
  vec<T> m = n, Q = P;
  if (s.parts & HSR_PART_BUMPS) {
    const T wave = T(HSR_SHADER_WAVE) * side, tilt(HSR_SHADER_TILT);
    m = unit(vec<T>(n -
                    T(tilt * slope(T(along(P, f.u) / wave))) * axis<T>(f.u) -
                    T(tilt * slope(T(along(P, f.v) / wave))) * axis<T>(f.v)));
    const T eta(HSR_SHADER_INDEX), k = positive(dot(m, V));
    const T bend = root(T(one - square(eta) * (one - square(k))));
    const vec<T> down = eta * vec<T>(k * m - V) - bend * m;
    Q = P + T(T(HSR_SHADER_DEPTH) * side / (T(0) - dot(down, n))) * down;
  }
  if (s.parts & HSR_PART_BOARD) {
    const T square_there = squares(T(along(Q, f.u) / side),
                                   T(along(Q, f.v) / side), HSR_SHADER_DARK);
    for (int c = 0; c < 3; c++)
      rgb[c] = square_there * rgb[c];
  }
  const vec<T> r = T(T(2) * dot(m, V)) * m - V;
  if (s.parts & HSR_PART_SKY) {
    const T up = positive(r.y), share(HSR_SHADER_REFLECTION);
    for (int c = 0; c < 3; c++) {
      const T low(hsr_sky_low[c]), high(hsr_sky_high[c]);
      rgb[c] = (one - share) * rgb[c] + share * (low + up * (high - low));
    }
  }
  if (s.parts & HSR_PART_HIGHLIGHT) {
    T shine = positive(dot(r, judge::lift<T>(s.light)));
    for (int k = 0; k < HSR_SHADER_GLOSS; k++)
      shine = square(shine);
    for (int c = 0; c < 3; c++)
      rgb[c] = rgb[c] + (one - rgb[c]) * shine * T(HSR_SHADER_HIGHLIGHT);
  }
}

} // namespace areas

#endif
