/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A view in the form that OpenGL needs. */
#ifndef HSR_BENCH_PEERS_SHARED_PROJECTION_H
#define HSR_BENCH_PEERS_SHARED_PROJECTION_H

#include "common/view/view.h"
#include "common/scene/world.h"

#ifdef __cplusplus
extern "C" {
#endif

struct box {
  double low[3], high[3];
};

/* The bounding box of the world's vertices. */
struct box box_of_world(const struct hsr_world *world);

/* The least depth t of any point of a box. */
double box_nearest(const struct box *box, const struct hsr_view *view);

/* The least and greatest depth t that OpenGL resolves: those of the box's
 * corners, if they lie in front of the eye and beyond the view's near. *nearest
 * is at least a thousandth of *farthest, which is VTK's rule too. Whatever is
 * nearer is lost. */
void box_depths(const struct box *box, const struct hsr_view *view,
                double *nearest, double *farthest);

/* The matrix from world to clip coordinates, by columns. OpenGL's first row of
 * pixels is the lowest. Here it is the top one, so that ids need not be turned
 * over; front faces therefore run clockwise. */
void clip_matrix(const struct hsr_view *view, double nearest, double farthest,
                 double matrix[16]);

#ifdef __cplusplus
}
#endif
#endif
