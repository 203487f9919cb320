/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A view as OpenGL wants it. */
#ifndef HSR_BENCH_PEERS_PROJECTION_H
#define HSR_BENCH_PEERS_PROJECTION_H

#include "common/view/view.h"
#include "common/scene/world.h"

#ifdef __cplusplus
extern "C" {
#endif

struct box {
  double low[3], high[3];
};

/* Of the world's vertices. */
struct box box_of_world(const struct hsr_world *world);

/* The least and the greatest depth t between which OpenGL shall resolve: those
 * of the box's corners, as far as they lie before the eye and the view's near;
 * *nearest at least a thousandth of *farthest, which is VTK's rule too. What is
 * nearer is lost. */
void box_depths(const struct box *box, const struct hsr_view *view,
                double *nearest, double *farthest);

/* World to clip coordinates, by columns. OpenGL's first row of pixels is the
 * lowest; here it is the top one, so that ids need not be turned over. Seen
 * so, fronts run clockwise. */
void clip_matrix(const struct hsr_view *view, double nearest, double farthest,
                 double matrix[16]);

#ifdef __cplusplus
}
#endif
#endif
