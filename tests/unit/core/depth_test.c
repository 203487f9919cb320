/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Depth complexity and overlaps, against Table I and against all pairs of
 * faces; and what Sutherland et al. 1974 say of them.
 *
 * Closer      "Moving around in the environment does not change the depth
 *             complexity" (appendix A): from half the distance, D_c is within
 *             the factor of 2 in which the survey's figures are meant.
 * Directions  "Most environments of any great degree of complexity appear to be
 *             nearly isotropic": the same, of eyes all around.
 * Symmetry    Sancha's argument: the first steps of Newell (overlap in depth)
 *             and of Watkins (overlap in height) leave equally many faces if
 *             the environment is isotropic. This holds in the house. It does
 *             not in the harbor, although D_c varies little with the direction:
 *             seen across the water its faces are in a low band, so more than
 *             twice as many overlap in height as in depth. */
#include "common/exact/order.h"
#include "common/exact/screen.h"
#include "common/statistics/depth.h"
#include "common/statistics/statistics.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>

enum { M = 120, N = 100, AROUND = 12 };

static const char *const scenes[] = {"house", "harbor:500", "penetration",
                                     "near-plane", "cyclic-overlap"};
enum { N_SCENES = sizeof scenes / sizeof *scenes };

static struct hsr_table1 table_of(const struct both_worlds *w,
                                  const struct hsr_camera *camera,
                                  struct hsr_view *view) {
  struct hsr_table1 table;
  must_view(view, camera, M, N);
  if (hsr_statistics_measure(&w->world, view, NULL, &table, NULL))
    abort();
  return table;
}

/* --- Against Table I, and against all pairs ------------------------------- */

static void check_mean(struct tap *tap, const struct both_worlds *w,
                       const char *name) {
  static uint32_t depth[M * N];
  struct hsr_view view;
  double D_c = table_of(w, &w->scene->views[0], &view).D_c;
  uint64_t sum = 0;
  if (hsr_depth_complexity(&w->world, &view, depth, NULL))
    abort();
  for (int k = 0; k < M * N; k++)
    sum += depth[k];
  ok(tap, sum > 0 && (double)sum / ((double)M * N) == D_c,
     "%s: the mean over all samples is D_c, %g", name, D_c);
}

static void check_pairs(struct tap *tap, const struct both_worlds *w,
                        const char *name) {
  struct hsr_arena arena = HSR_ARENA_EMPTY;
  struct hsr_tally tally = {.out_of_memory = false};
  struct hsr_screen screen;
  struct hsr_view view;
  struct hsr_overlaps overlaps;
  double x = 0, y = 0, z = 0, pairs = 0;
  must_view(&view, &w->scene->views[0], M, N);
  if (hsr_screen_make(&screen, &w->world, &view, &arena, &tally) ||
      hsr_overlaps_measure(&w->world, &view, &overlaps, NULL))
    abort();
  for (uint32_t a = 0; a < screen.n_relevant; a++)
    for (uint32_t b = 0; b < a; b++) {
      uint32_t f = screen.relevant[a], g = screen.relevant[b];
      const struct hsr_bounds *p = &screen.bounds[f], *q = &screen.bounds[g];
      double near_f, far_f, near_g, far_g;
      hsr_depth_range(&screen, (struct hsr_polygon){.face = f}, &near_f,
                      &far_f);
      hsr_depth_range(&screen, (struct hsr_polygon){.face = g}, &near_g,
                      &far_g);
      x += p->x0 < q->x1 && q->x0 < p->x1;
      y += p->y0 < q->y1 && q->y0 < p->y1;
      z += near_f <= far_g && near_g <= far_f;
      pairs++;
    }
  bool same = fabs(overlaps.f_x - x / pairs) < 1e-12 &&
              fabs(overlaps.f_y - y / pairs) < 1e-12 &&
              fabs(overlaps.f_z - z / pairs) < 1e-12;
  ok(tap, same, "%s: of %g pairs %g overlap in X, %g in Y, %g in Z", name,
     pairs, x, y, z);
  hsr_arena_free(&arena);
}

/* --- What the survey says ------------------------------------------------- */

/* From the given part of the distance. */
static double depth_at(const struct both_worlds *w, double part) {
  struct hsr_camera camera = w->scene->views[0];
  struct hsr_view view;
  for (int k = 0; k < 3; k++)
    camera.eye[k] = camera.at[k] + part * (camera.eye[k] - camera.at[k]);
  return table_of(w, &camera, &view).D_c;
}

static void check_closer(struct tap *tap, const struct both_worlds *w,
                         const char *name) {
  double far = depth_at(w, 1), half = depth_at(w, 0.5);
  ok(tap, half < 2 * far && far < 2 * half,
     "%s: D_c is %.2f, and %.2f from half the distance", name, far, half);
}

static void check_directions(struct tap *tap, const struct both_worlds *w,
                             const char *name) {
  const struct hsr_camera *first = &w->scene->views[0];
  struct hsr_view view;
  double least = INFINITY, most = 0;
  double dx = first->eye[0] - first->at[0], dy = first->eye[1] - first->at[1],
         dz = first->eye[2] - first->at[2];
  bool z_up = fabs(first->up[2]) > fabs(first->up[1]);
  for (int k = 0; k < AROUND; k++) {
    struct hsr_camera camera = *first;
    double turn = 2 * acos(-1.0) * k / AROUND, other = z_up ? dy : dz;
    camera.eye[0] = first->at[0] + cos(turn) * dx - sin(turn) * other;
    camera.eye[z_up ? 1 : 2] =
        first->at[z_up ? 1 : 2] + sin(turn) * dx + cos(turn) * other;
    double D_c = table_of(w, &camera, &view).D_c;
    printf("# %s, %d degrees: D_c %.2f\n", name, 360 * k / AROUND, D_c);
    least = fmin(least, D_c);
    most = fmax(most, D_c);
  }
  ok(tap, most < 2 * least, "%s: D_c is %.2f to %.2f from all around", name,
     least, most);
}

static void check_symmetry(struct tap *tap, const struct both_worlds *w,
                           const char *name, bool borne_out) {
  struct hsr_view view;
  struct hsr_table1 table = table_of(w, &w->scene->views[0], &view);
  struct hsr_overlaps f;
  if (hsr_overlaps_measure(&w->world, &view, &f, NULL))
    abort();
  double least = fmin(f.f_x, fmin(f.f_y, f.f_z));
  double most = fmax(f.f_x, fmax(f.f_y, f.f_z));
  ok(tap, (most < 2 * least) == borne_out,
     "%s: the first step of Newell leaves %.1f %% of the faces, of Watkins "
     "%.1f "
     "%%, an overlap in X %.1f %%, by the rule %.1f %%",
     name, 100 * f.f_z, 100 * f.f_y, 100 * f.f_x, 200 * table.H_f / table.n);
}

int main(void) {
  struct tap tap = plan(2 * N_SCENES + 3 * 2);
  for (int s = 0; s < N_SCENES; s++) {
    struct both_worlds w;
    open_worlds(&w, scenes[s]);
    check_mean(&tap, &w, scenes[s]);
    check_pairs(&tap, &w, scenes[s]);
    close_worlds(&w);
  }
  for (int s = 0; s < 2; s++) {
    struct both_worlds w;
    const char *name = s ? "harbor" : "house";
    open_worlds(&w, name);
    check_closer(&tap, &w, name);
    check_directions(&tap, &w, name);
    check_symmetry(&tap, &w, name, !s);
    close_worlds(&w);
  }
  return finish(&tap);
}
