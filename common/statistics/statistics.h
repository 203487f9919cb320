/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The statistics of Table I of Sutherland et al. 1974, measured, and the rules
 * of thumb of Table II.
 *
 * The statistics are measured from a world and a view. No algorithm takes part.
 * The exact meaning of each is in statistics.c, beside the code that measures
 * it.
 */
#ifndef HSR_COMMON_STATISTICS_H
#define HSR_COMMON_STATISTICS_H

#include "common/view/view.h"
#include "common/scene/world.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(protected) /* for modules: hsr-module.h */

/* X(field, symbol, meaning): each is a row of Table I. */
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

/* The statistics by their symbols. NAN: not measured. */
struct hsr_table1 {
#define X(field, symbol, meaning) double field;
  HSR_TABLE1(X)
#undef X
};

/* Measures the whole picture of the view, whatever its window. The world is
 * laid out. `ids` is the correct picture, with sample (i, j) at ids[j * m + i].
 * If it is NULL, the statistics of visible things, S_v, L_v and X_v, are NAN.
 * H_f is NAN if there is no relevant face. *table is defined on HSR_OK only.
 * HSR_E_NOMEM; HSR_E_USAGE if an entry of ids is neither a face nor
 * HSR_BACKGROUND. */
enum hsr_status hsr_statistics_measure(const struct hsr_world *world,
                                       const struct hsr_view *view,
                                       const uint32_t *ids,
                                       struct hsr_table1 *table,
                                       struct hsr_error *err);

/* Computes the statistics that the rules of thumb of Table II predict from n,
 * m, F_r, F_c and D_c of `given`. C_r and X_f have no rule and are NAN. `rules`
 * may be equal to `given`. */
void hsr_statistics_rules(const struct hsr_table1 *given,
                          struct hsr_table1 *rules);

/* Counts X_f, the pairs that penetrate among the faces faces[0 .. n-1], which
 * are all different. *n_pairs is written on HSR_OK only. HSR_E_NOMEM. */
enum hsr_status hsr_count_penetrations(const struct hsr_world *world,
                                       const uint32_t *faces, size_t n,
                                       uint64_t *n_pairs,
                                       struct hsr_error *err);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif
#endif
