/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Is a cube visible? IsCubeVisible of the thesis; with cubes=sides its sides
 * are scan-converted, too, and with cubes=entry as in 1993. A side is what the papers call a face of the
 * cube. See hzbuffer.c for the sources, and walk.h. */
#include "algorithms/hierarchical/hzbuffer/walk.h"

#include <math.h>

/* A cube that is tested. */
struct tested {
  const struct hsr_placing *placing;
  struct hsr_octree_box box;
  struct hsr_cube_image image;
  struct hsr_subject subject;
};

/* --- A side --------------------------------------------------------------- */

/* The part [*lo, *hi] of the line at height y that a side may cover. Its
 * corners are known within HSR_CUBE_MARGIN, and the part holds for every place
 * that they may have. False if the side does not reach that height. */
static bool row_of_side(const struct hsr_cube_image *image,
                        const unsigned char *corner, double y, double *lo,
                        double *hi) {
  double top = y - HSR_CUBE_MARGIN, bottom = y + HSR_CUBE_MARGIN;
  *lo = INFINITY;
  *hi = -INFINITY;
  for (int k = 0; k < 4; k++) {
    double ax = image->x[corner[k]], ay = image->y[corner[k]];
    double bx = image->x[corner[(k + 1) % 4]],
           by = image->y[corner[(k + 1) % 4]];
    if (fmin(ay, by) > bottom || fmax(ay, by) < top)
      continue;
    double from = fmin(fmax(fmin(ay, by), top), bottom);
    double to = fmin(fmax(fmax(ay, by), top), bottom);
    double slope = ay == by ? 0 : (bx - ax) / (by - ay);
    double p = ay == by ? ax : ax + slope * (from - ay);
    double q = ay == by ? bx : ax + slope * (to - ay);
    *lo = fmin(*lo, fmin(p, q));
    *hi = fmax(*hi, fmax(p, q));
  }
  *lo -= 2 * HSR_CUBE_MARGIN;
  *hi += 2 * HSR_CUBE_MARGIN;
  return *lo <= *hi;
}

/* Scan-converts a side, as in 1993, up to the first sample where it is not
 * hidden. True if there is one. */
static bool scan_side(struct hsr_hz_walk *w, const struct tested *c, int side,
                      const struct hsr_bounds *box) {
  const struct hsr_view *view = w->frame.job->view;
  const struct hsr_tiler *t = &w->frame.tiler;
  struct hsr_side_depth depth =
      hsr_cube_side_depth(&w->frame, c->placing, &c->box, &c->image, side);
  for (int j = box->y0; j < box->y1; j++) {
    double y = hsr_sample_y(view, j), lo, hi;
    if (!row_of_side(&c->image, hsr_cube_side[side], y, &lo, &hi))
      continue;
    const float *z = t->z + (size_t)(j - t->part.y0) * t->z_stride;
    for (int i = box->x0; i < box->x1; i++) {
      double x = hsr_sample_x(view, i);
      if (x < lo || x > hi)
        continue;
      HSR_TOUCH(w->tally, i, j);
      float q = (float)(depth.c + depth.a * x + depth.b * y);
      q = q < c->image.nearest ? q : c->image.nearest;
      q = q > 0 ? q : 0;
      bool visible = !(q * HSR_CLEAR < z[i - t->part.x0]);
      HSR_STEP(w->tally, HSR_HZ_SIDE_SAMPLES, c->subject, HSR_THE_WINDOW,
               HSR_AT(i, j), visible);
      if (visible)
        return true;
    }
  }
  return false;
}

/* The nearest of a side's corners. */
static float nearest_of(const struct hsr_cube_image *image,
                        const unsigned char *corner) {
  float q = image->q[corner[0]];
  for (int k = 1; k < 4; k++)
    q = image->q[corner[k]] > q ? image->q[corner[k]] : q;
  return q;
}

/* Does the pyramid hide a rectangle at depth q, that of a side or of a cube?
 * With pyramid=dual, the pyramid of the nearest depths may show at once that
 * the rectangle is visible. */
static bool is_rectangle_hidden(struct hsr_hz_walk *w, struct hsr_bounds box,
                                float q) {
  if (w->choice.pyramid == HSR_HZ_PYRAMID_OFF)
    return false;
  if (w->choice.pyramid == HSR_HZ_PYRAMID_DUAL && !hsr_hz_scans_sides(w) &&
      hsr_pyramid_before(&w->pyramid, box, q))
    return false;
  if (w->choice.cubes == HSR_HZ_CUBES_ENTRY && hsr_hz_has_pyramid(w))
    return hsr_pyramid_basic(&w->pyramid, box, q);
  return hsr_hz_hides(w, box, q);
}

/* May a front side be visible? False: it is hidden. */
static bool is_side_visible(struct hsr_hz_walk *w, const struct tested *c,
                            int side) {
  const unsigned char *corner = hsr_cube_side[side];
  struct hsr_bounds box;
  if (!hsr_cube_bounds(&w->frame, &c->image, corner, 4, &box) ||
      is_rectangle_hidden(w, box, nearest_of(&c->image, corner)))
    return false;
  if (!hsr_hz_scans_sides(w))
    return true;
  bool visible = scan_side(w, c, side, &box);
  HSR_STEP(w->tally, HSR_HZ_SIDES_SCANNED, c->subject, HSR_THE_WINDOW,
           hsr_window_make(box.x0, box.y0, box.x1, box.y1), visible);
  return visible;
}

/* --- A cube --------------------------------------------------------------- */

static bool is_any_side_visible(struct hsr_hz_walk *w, const struct tested *c) {
  for (int side = 0; side < 6; side++)
    if (c->image.front >> side & 1 && is_side_visible(w, c, side))
      return true;
  return false;
}

/* cubes=whole: tests the bounding rectangle of the cube, not of its sides. */
static bool is_whole_visible(struct hsr_hz_walk *w, const struct tested *c) {
  static const unsigned char all[8] = {0, 1, 2, 3, 4, 5, 6, 7};
  struct hsr_bounds box;
  return hsr_cube_bounds(&w->frame, &c->image, all, 8, &box) &&
         !is_rectangle_hidden(w, box, c->image.nearest);
}

/* If a cube lies wholly in the frustum, so do all cubes in it. */
bool hsr_hz_is_in_frustum(struct hsr_hz_walk *w,
                          const struct hsr_placing *placing,
                          const struct hsr_octree_box *cube,
                          struct hsr_subject subject, bool *inside) {
  HSR_STEP(w->tally, HSR_HZ_NODES, subject, HSR_NOTHING, HSR_NOWHERE, 0);
  if (*inside)
    return true;
  enum hsr_box_verdict verdict =
      hsr_cube_classify(&w->frame, placing, cube, subject);
  *inside = verdict == HSR_BOX_IN;
  if (verdict == HSR_BOX_OUT)
    HSR_STEP(w->tally, HSR_HZ_NODES_OUT, subject, HSR_THE_WINDOW, HSR_NOWHERE,
             0);
  return verdict != HSR_BOX_OUT;
}

bool hsr_hz_passes_pyramid(struct hsr_hz_walk *w,
                           const struct hsr_placing *placing,
                           struct hsr_octree_box cube,
                           struct hsr_subject subject) {
  struct tested c = {.placing = placing, .box = cube, .subject = subject};
  if (w->choice.pyramid == HSR_HZ_PYRAMID_MAPS && !hsr_hz_can_hide(w))
    return true; /* occluders are being tiled */
  if (!hsr_cube_project(&w->frame, placing, &cube, &c.image))
    return true; /* the eye may be inside, or the near plane meet it */
  hsr_hz_read_for(w, HSR_HZ_CUBE_READS, subject);
  bool visible = w->choice.cubes == HSR_HZ_CUBES_WHOLE
                     ? is_whole_visible(w, &c)
                     : is_any_side_visible(w, &c);
  HSR_STEP(w->tally, HSR_HZ_CUBES_TESTED, subject, HSR_NOTHING, HSR_NOWHERE,
           visible);
  if (!visible)
    HSR_STEP(w->tally, HSR_HZ_CUBES_CULLED, subject, HSR_NOTHING, HSR_NOWHERE,
             0);
  return visible;
}

bool hsr_hz_is_cube_visible(struct hsr_hz_walk *w,
                            const struct hsr_placing *placing,
                            struct hsr_octree_box cube,
                            struct hsr_subject subject, bool *inside) {
  return hsr_hz_is_in_frustum(w, placing, &cube, subject, inside) &&
         hsr_hz_passes_pyramid(w, placing, cube, subject);
}

/* --- Octants that are projected together ---------------------------------- */

bool hsr_hz_tests_together(const struct hsr_hz_walk *w) {
  return !HSR_COUNTING && w->choice.pyramid == HSR_HZ_PYRAMID_ON &&
         !hsr_hz_scans_sides(w) && !w->frame.job->view->parallel;
}

/* The rectangle of the whole cube is tested before those of its sides: what
 * hides it hides each of them. */
bool hsr_hz_octant_passes_pyramid(struct hsr_hz_walk *w,
                                  const struct hsr_octants *octants, int o) {
  if (!octants->has_image[o])
    return true;
  struct hsr_bounds box;
  if (!hsr_octant_bounds(octants, HSR_WHOLE_CUBE, o, &box) ||
      hsr_pyramid_hides(&w->pyramid, box, octants->q[HSR_WHOLE_CUBE][o]))
    return false;
  if (w->choice.cubes == HSR_HZ_CUBES_WHOLE)
    return true;
  for (int side = 0; side < 6; side++)
    if (octants->front[o] >> side & 1 &&
        hsr_octant_bounds(octants, side, o, &box) &&
        !hsr_pyramid_hides(&w->pyramid, box, octants->q[side][o]))
      return true;
  return false;
}
