/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Depth and colour, derived from a picture of face ids. All algorithms share
 * this pass, and the time of an algorithm does not include it. */
#ifndef HSR_COMMON_PICTURE_H
#define HSR_COMMON_PICTURE_H

#include "common/view/view.h"
#include "common/scene/world.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A finished picture, m x n, rows from the top, no padding: pixel (i, j) at
 * [j * m + i]. Owned by the caller. */
struct hsr_picture {
  int m, n;
  const uint32_t *ids; /* m * n; HSR_BACKGROUND where no face is seen */
  const float *depth;  /* m * n: depth t of the face, world units, or +infinity
                          of the background; may be NULL */
  const float *rgb;    /* 3 * m * n, linear, 0..1; may be NULL */
  const float *alpha;  /* m * n: how much of each pixel is covered, 0..1, by
                          which rgb is multiplied; NULL: all is covered */
};

enum hsr_shading {
  HSR_SHADE_LAMBERT, /* the face's colour times hsr_picture_light */
  HSR_SHADE_FLAT,    /* the face's colour as it is */
  HSR_SHADE_IDS,     /* a colour derived from the face's id */
  HSR_SHADE_GOURAUD  /* the face's colour times hsr_picture_light_of at its
                        corners, interpolated (gouraud.h). Of a grid whose faces
                        are not made, as HSR_SHADE_LAMBERT */
};

/* Sets depth[k] to t of the plane of face ids[k] at sample k, in world units,
 * or to +infinity for the background. It is good to float precision. Both
 * arrays have view->m * view->n elements. ids are face numbers of the world,
 * which must be laid out. */
void hsr_picture_depth(const struct hsr_world *world,
                       const struct hsr_view *view, const uint32_t *ids,
                       float *depth);

/* Returns the brightness of a face, 0.25 .. 1. A quarter is ambient light, and
 * the rest is N.L, with the direction of view->lamp as L. The face has the
 * normal `normal`, of any length, and its plane passes through `anchor`. A
 * normal that points away from the eye is turned round, so a face seen from
 * behind is lit too. */
float hsr_picture_light(const struct hsr_view *view, const double normal[3],
                        const double anchor[3]);

/* Returns the brightness for a normal of any length. The normal is turned round
 * if `turned`. */
float hsr_picture_light_of(const struct hsr_view *view, const double normal[3],
                           bool turned);

/* Sets rgb, linear, 0..1, to the one colour of a face, or to that of the
 * background. `id` is a face number of the world, which must be laid out.
 * HSR_SHADE_GOURAUD has no single colour; the result is then that of
 * HSR_SHADE_LAMBERT. */
void hsr_picture_colour(const struct hsr_world *world,
                        const struct hsr_view *view, uint32_t id,
                        enum hsr_shading shading, float rgb[3]);

/* Fills rgb[3k .. 3k+2], linear, 0..1, for every sample k, with the colours of
 * hsr_picture_colour. The background is a dark blue grey. */
void hsr_picture_shade(const struct hsr_world *world,
                       const struct hsr_view *view, const uint32_t *ids,
                       enum hsr_shading shading, float *rgb);

/* Fills depth and rgb as above, and shades by HSR_SHADE_GOURAUD too. Either
 * array may be NULL. The world may be a roster. The faces in the picture are
 * then laid out in a temporary world. HSR_E_NOMEM; HSR_E_INPUT as
 * hsr_world_extract. */
enum hsr_status hsr_picture_finish(const struct hsr_world *world,
                                   const struct hsr_view *view,
                                   const uint32_t *ids,
                                   enum hsr_shading shading, float *depth,
                                   float *rgb, struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
