/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Table I of Sutherland et al. 1974, measured, and Table II's rules of thumb.
 *
 * Measured by the core from a world and a view, independently of any
 * algorithm. */
#ifndef HSR_COMMON_STATISTICS_H
#define HSR_COMMON_STATISTICS_H

#include "common/view.h"
#include "common/world.h"

#ifdef __cplusplus
extern "C" {
#endif

/* X(field, symbol, meaning): one row of Table I each. */
#define HSR_TABLE1(X)                                                          \
  X(n, "n", "vertical resolution, scan lines")                                 \
  X(m, "m", "horizontal resolution, elements a line")                          \
  X(F_t, "F_t", "faces in all")                                                \
  X(F_r, "F_r", "relevant faces")                                              \
  X(D_c, "D_c", "depth complexity, mean faces pierced by a ray")               \
  X(C_t, "C_t", "clusters in all")                                             \
  X(C_r, "C_r", "relevant clusters")                                           \
  X(F_c, "F_c", "faces per cluster, mean")                                     \
  X(E_t, "E_t", "edges in all, each face counting its own")                    \
  X(E_r, "E_r", "relevant edges")                                              \
  X(E_s, "E_s", "relevant edges, shared ones once")                            \
  X(E_c, "E_c", "contour edges")                                               \
  X(X_r, "X_r", "edge crossings in the picture")                               \
  X(X_v, "X_v", "crossings of visible edges")                                  \
  X(X_f, "X_f", "face intersections")                                          \
  X(H_f, "H_f", "mean height of a relevant face, scan lines")                  \
  X(S_f, "S_f", "segments in all, visible or not")                             \
  X(S_l, "S_l", "segments on a scan line, mean")                               \
  X(S_v, "S_v", "visible segments on a scan line, mean")                       \
  X(L_v, "L_v", "length of visible edges, resolution units")

struct hsr_table1 {
#define X(field, symbol, meaning) double field;
  HSR_TABLE1(X)
#undef X
};

#ifdef __cplusplus
}
#endif
#endif
