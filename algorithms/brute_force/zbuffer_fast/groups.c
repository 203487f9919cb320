/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The proof that nothing is left out that can be seen.
 *
 * Notation    u = 2^-53; a hat marks a computed value; N the exact normal of a
 *             triangle, n = N/|N|, V a vertex of it; e its n_error, so that N^
 *             is within e of N in every component; A, P, s2 what is stored: axis,
 *             apex and sine2; s = sin a. Everything is in doubles, rounded to
 *             nearest, nothing contracted.
 *
 * Turned away. A one-sided triangle does not exist if the eye is not in front of
 * its plane: if N.(V - E) >= 0, or in parallel N.F >= 0. Let n.A >= |A| cos a
 * for every n of the group, a <= 90 degrees, and n.(V - P) >= 0. If d = P - E
 * has A.d >= |A| |d| s, the angles between A and d, and between A and n, add up
 * to at most 90 degrees. So n.d >= 0, and n.(V - E) = n.(V - P) + n.d >= 0. In
 * parallel d is F, and P is not needed.
 *
 * Axis and angle. A is a mean of normals, divided by its length: |A| is within
 * 4u of 1. n is within 2 |N - N^| / |N^| <= 2 sqrt(3) e / |N^| of the direction
 * of N^. Its cosine with A, N^.A / |N^|, is computed within 16u. So c, the least
 * of the computed ones, less 4 e / |N^| and 2^-40 each, is at most cos a. There
 * is no cone unless c >= 1/16. s is at most sqrt(1 - c^2), and s2 is (sqrt(1 -
 * c^2) + 2^-40)^2.
 *
 * Apex. P is C - t A, C the middle of the box. n.(V - P) >= 0 if t N.A >=
 * -N.(V - C). With r = V - C, one rounding a component, N.r is within 2 e |r|_1
 * + 16u sum |N_k r_k| + 2^-960 of what is computed, and N.A likewise; t is at
 * least the quotient of their worse ends, times 1 + 2^-40. P is rounded by at
 * most 2^-51 (|C|inf + t) in every component, which takes less than 2^-50 (|C|inf
 * + t) from n.(V - P). 2^-45 |C|inf and a part of the 2^-40 t more make up for
 * it, since n.A >= 1/16. In the plane of a triangle all V are alike.
 *
 * In a frame. d^ is within u of d in every component; A.d^ is off by at most 5u
 * |A| |d|, and the sum of squares by 6u of itself. (A.d)^2 > s2 |d|^2 + 2^-960,
 * and A.d > 0, then give A.d > (s + 2^-41) |d| (1 - 8u) - 6u |d|, which is more
 * than |A| |d| s. A.d is above 2^-480 then: so what underflows, 2^-1074 a
 * product, does not matter. What overflows is infinite or not a number, and no
 * such comparison holds.
 *
 * Outside. The box holds the vertices, and so the triangles, exactly. It is
 * compared with the half spaces around the window's frustum as in
 * common/trees/box.c, with the same doubt for the largest of all coordinates. */
#include "algorithms/brute_force/zbuffer_fast/groups.h"
#include "common/base/numbers.h"
#include "common/base/vector.h"

#include <string.h>

static const double TINY = 0x1p-960;

/* Which groups turn away. In parallel d is F: w is 0 and `f` is F. Otherwise w
 * is 1 and `f` is 0, and both change nothing. */
HSR_VECTOR static void find_away(size_t n, double *const apex[3],
                                 double *const axis[3],
                                 const double *restrict sine2,
                                 const double E[3], double w, const double f[3],
                                 int *restrict verdict) {
  const double *restrict px = apex[0], *restrict py = apex[1],
                         *restrict pz = apex[2];
  const double *restrict ax = axis[0], *restrict ay = axis[1],
                         *restrict az = axis[2];
  const double e0 = E[0], e1 = E[1], e2 = E[2], f0 = f[0], f1 = f[1], f2 = f[2];
  for (size_t g = 0; g < n; g++) {
    double dx = w * (px[g] - e0) + f0, dy = w * (py[g] - e1) + f1,
           dz = w * (pz[g] - e2) + f2;
    double along = ax[g] * dx + ay[g] * dy + az[g] * dz;
    double square = dx * dx + dy * dy + dz * dz;
    int away = (along > 0) & (along * along > sine2[g] * square + TINY);
    verdict[g] = away ? HSR_GROUP_AWAY : HSR_GROUP_KEPT;
  }
}

/* Which of the others lie outside of a half space: beyond `limit`, at the corners
 * that lie farthest against its normal. */
HSR_VECTOR static void find_out(size_t n, const double *restrict x,
                                const double *restrict y,
                                const double *restrict z,
                                const double normal[3], double limit,
                                int *restrict verdict) {
  const double n0 = normal[0], n1 = normal[1], n2 = normal[2];
  for (size_t g = 0; g < n; g++) {
    int out = n0 * x[g] + n1 * y[g] + n2 * z[g] > limit;
    verdict[g] =
        (out & (verdict[g] == HSR_GROUP_KEPT)) ? HSR_GROUP_OUT : verdict[g];
  }
}

/* How far away, in units of |D| > F, the farthest point of a box is, and more. */
static double farthest(const struct hsr_view *view, const struct hsr_box *box) {
  double far = 1;
  for (int k = 0; k < 3; k++)
    far +=
        hsr_max(fabs(box->lo[k] - view->E[k]), fabs(box->hi[k] - view->E[k]));
  return 2 * far + 2 * view->near;
}

void hsr_groups_look(const struct hsr_groups *g, const struct hsr_view *view,
                     int *verdict) {
  static const double none[3] = {0};
  struct hsr_polyhedron frustum;
  find_away(g->n, g->apex, g->axis, g->sine2, view->E, view->parallel ? 0 : 1,
            view->parallel ? view->F : none, verdict);
  hsr_frustum_init(&frustum, view, farthest(view, &g->bounds));
  double size = frustum.size;
  for (int a = 0; a < 3; a++)
    size = hsr_max(size, hsr_max(-g->bounds.lo[a], g->bounds.hi[a]));
  for (int p = 0; p < frustum.n_planes; p++) {
    const struct hsr_half_space *h = &frustum.plane[p];
    double *const *const side[2] = {g->lo, g->hi};
    find_out(g->n, side[h->n[0]][0], side[h->n[1]][1], side[h->n[2]][2],
             h->normal, h->outer + (h->doubt * size + TINY), verdict);
  }
}

void hsr_groups_snap(const struct hsr_groups *g, const int *verdict,
                     bool *needed, struct hsr_tiler *tiler) {
  memset(needed, 0, g->n * sizeof *needed);
  for (uint32_t k = 0; k < g->n; k++) {
    if (verdict[k] != HSR_GROUP_KEPT)
      continue;
    needed[k] = true;
    for (uint32_t i = g->first_near[k]; i < g->first_near[k + 1]; i++)
      needed[g->near[i]] = true;
  }
  for (uint32_t k = 0, end; k < g->n; k = end) {
    for (end = k + 1; end < g->n && needed[end] == needed[k];)
      end++;
    uint32_t first = g->first_vertex[k];
    if (needed[k])
      hsr_tiler_snap_points(tiler, first, g->first_vertex[end] - first,
                            g->x + first, g->y + first, g->z + first);
  }
}

void hsr_groups_free(struct hsr_groups *g) {
  hsr_arena_free(&g->arena);
}
