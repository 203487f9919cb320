/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How hsr puts a scene into the frame of a glTF file. The reader does it again
 * with what it reads, and so knows whether a file is still as hsr wrote it. Only
 * for common/files/gltf. */
#ifndef HSR_COMMON_GLB_FRAME_H
#define HSR_COMMON_GLB_FRAME_H

#include "common/files/cells/cells.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The `generator` of files that hsr writes. */
#define HSR_GLB_GENERATOR "hsr"
/* How many numbers the file's `extras` have of a view. */
enum { HSR_GLB_VIEW = 16 };

/* Computes the matrix of a node, by columns: the place m of an instance, in the
 * frame of the file. The mesh of the node has coordinates that are less by
 * `offset`. */
void hsr_glb_place(const struct hsr_glb_frame *frame, const double m[12],
                   const double offset[3], double matrix[16]);

/* Whether a place mirrors: its determinant is negative. */
bool hsr_glb_mirrors(const double m[12]);

/* A camera of glTF and the matrix of its node, by columns. It looks along -z,
 * with y up. */
struct hsr_glb_camera {
  double matrix[16];
  bool is_parallel;
  double size;      /* half the height of the picture, or the angle of view in
                       radians */
  double near, far; /* far: of a parallel one */
};

/* Computes it. False: hsr_camera_check refuses the camera. */
bool hsr_glb_find_camera(const struct hsr_glb_frame *frame,
                         const struct hsr_camera *camera,
                         struct hsr_glb_camera *out);

#ifdef __cplusplus
}
#endif
#endif
