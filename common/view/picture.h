/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is derived from a picture of face ids: depth and colour, in one pass
 * shared by all algorithms and outside every timed one. */
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
  const float *depth;  /* m * n: t of the hit, +infinity for none; or NULL */
  const float *rgb;    /* 3 * m * n, linear, 0..1; or NULL */
};

enum hsr_shading {
  HSR_SHADE_LAMBERT, /* the face's colour by N.L, light at the eye's shoulder */
  HSR_SHADE_FLAT,    /* the face's colour as it is */
  HSR_SHADE_IDS      /* a colour of its own for every face id */
};

/* depth[k] = t of the plane of ids[k] at sample k, +infinity for background.
 * Two arrays of view->m * view->n. */
void hsr_picture_depth(const struct hsr_world *world,
                       const struct hsr_view *view, const uint32_t *ids,
                       float *depth);

/* By N.L, with a light above the eye's left shoulder, of a face with this
 * normal, turned to the eye, through this point: 0..1. Half of it is ambient;
 * a face seen from behind is lit as well. */
float hsr_picture_light(const struct hsr_view *view, const double normal[3],
                        const double anchor[3]);

/* The colour of a face, the same all over it, or of the background. */
void hsr_picture_colour(const struct hsr_world *world,
                        const struct hsr_view *view, uint32_t id,
                        enum hsr_shading shading, float rgb[3]);

/* rgb[3k..] of every sample, linear. Background is a dark blue grey. */
void hsr_picture_shade(const struct hsr_world *world,
                       const struct hsr_view *view, const uint32_t *ids,
                       enum hsr_shading shading, float *rgb);

/* Both of these, unless depth or rgb is NULL, also of a world that is an
 * outline: the faces in the picture are laid out for it. HSR_E_NOMEM;
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
