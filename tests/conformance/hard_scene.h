/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Random scenes that are hard on floating point numbers: coordinates from
 * denormal to 1e20 in one scene, neighbours by nextafter, integers near 2^52 and
 * their halves, quadrilaterals that are not flat, eyes and near planes on
 * vertices, very wide and very narrow views, instances that mirror and shear. */
#ifndef HSR_TESTS_CONFORMANCE_HARD_SCENE_H
#define HSR_TESTS_CONFORMANCE_HARD_SCENE_H

#include "common/scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

enum hard_scale {
  SMALL,      /* integers from -8 to 8 */
  POWER,      /* these times one power of two, from 2^-1070 to 2^90 */
  VERTICES,   /* these times a power of two for each vertex */
  MIXED,      /* these times a power of ten for each coordinate */
  LARGE,      /* integers near 2^52, and their halves */
  NEIGHBOURS, /* integers and the doubles next to them */
  LATTICE,    /* from -1 to 1 in steps of a half */
  REAL,       /* doubles from -4 to 4 */
  N_SCALES
};
extern const char *const hard_scale_name[N_SCALES];

/* The scene of a seed, with one view, whose camera becomes *camera. The caller
 * deletes it. NULL if it is not valid. */
struct hsr_scene *hard_scene(uint64_t seed, struct hsr_camera *camera,
                             enum hard_scale *scale);

#ifdef __cplusplus
}
#endif
#endif
