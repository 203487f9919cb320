/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Depth and colour, derived from a picture of face ids. All algorithms share
 * this pass, and no time of theirs includes it. */
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
  const uint32_t *ids; /* m * n; HSR_BACKGROUND for none */
  const float *depth;  /* m * n: t of the hit, +infinity: none; may be NULL */
  const float *rgb;    /* 3 * m * n, linear, 0..1; may be NULL */
};

enum hsr_shading {
  HSR_SHADE_LAMBERT, /* the face's colour, lit by hsr_picture_light */
  HSR_SHADE_FLAT,    /* the face's colour as it is */
  HSR_SHADE_IDS,     /* a colour of its own for every face id */
  HSR_SHADE_GOURAUD  /* by hsr_picture_light_of at its corners, interpolated
                        (gouraud.h); of cells of a grid, as LAMBERT */
};

/* depth[k] = t of the plane of face ids[k] at sample k, +infinity for
 * background. Both arrays have view->m * view->n elements. */
void hsr_picture_depth(const struct hsr_world *world,
                       const struct hsr_view *view, const uint32_t *ids,
                       float *depth);

/* How brightly a face is lit, 0.25 .. 1: a quarter is ambient light, the rest
 * is N.L with the view's lamp. The face has this normal, of any length, and its
 * plane passes through `anchor`. The normal is turned to the eye, so a face seen
 * from behind is lit as well. */
float hsr_picture_light(const struct hsr_view *view, const double normal[3],
                        const double anchor[3]);

/* The same of a normal, of any length, that is turned to the other side if
 * `turned`. */
float hsr_picture_light_of(const struct hsr_view *view, const double normal[3],
                           bool turned);

/* The colour of a face, which is the same all over it, or of the background.
 * Linear, 0..1. HSR_SHADE_GOURAUD has no such colour: it is that of LAMBERT. */
void hsr_picture_colour(const struct hsr_world *world,
                        const struct hsr_view *view, uint32_t id,
                        enum hsr_shading shading, float rgb[3]);

/* Fills rgb[3k .. 3k+2], linear, for every sample k. The background is a dark
 * blue grey. */
void hsr_picture_shade(const struct hsr_world *world,
                       const struct hsr_view *view, const uint32_t *ids,
                       enum hsr_shading shading, float *rgb);

/* Fills depth and rgb as above, each unless it is NULL. The world may be an
 * outline: then the faces in the picture are laid out for this. HSR_E_NOMEM;
 * HSR_E_INPUT as hsr_world_extract. */
enum hsr_status hsr_picture_finish(const struct hsr_world *world,
                                   const struct hsr_view *view,
                                   const uint32_t *ids,
                                   enum hsr_shading shading, float *depth,
                                   float *rgb, struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
