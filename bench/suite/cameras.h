/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A camera in the words of those who draw. */
#ifndef HSR_BENCH_SUITE_CAMERAS_H
#define HSR_BENCH_SUITE_CAMERAS_H

#include "common/scene/world.h"
#include "common/view/view.h"

#include <jansson.h>

/* Adds the members camera, rays, opengl and vulkan to an object. `depth` are
 * the depths of the right picture: nothing visible is before the near plane of
 * the matrices. False if memory ran out. */
bool add_camera(json_t *to, const struct hsr_world *world,
                const struct hsr_view *view, const double *depth);

#endif
