/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Environments whose statistics can be set: crumpled sheets in a room.
 *
 * Source      Sutherland, Sproull and Schumacker 1974, appendix A: an environment
 *             is told by F_r, D_c, F_c and what follows from them. The sheets are
 *             ours.
 * Sheet       a cluster: one object. Its faces are parallelograms A(i) + B(j) of
 *             a lattice, so that each is flat to the last bit. Depths go up and
 *             down by turns, so that no two neighbours are in one plane. All faces
 *             are two-sided and look at the eye.
 * Room        x from -width/2 to width/2, y from -1/2 to 1/2, z from -depth to 0.
 *             The only view is along -z, in parallel projection: the room is the
 *             picture, as after the perspective transformation. No sheet reaches
 *             out of it. */
#ifndef HSR_SCENES_SHEETS_H
#define HSR_SCENES_SHEETS_H

#include "common/scene/scene.h"

struct hsr_sheets {
  uint32_t n_faces;     /* at least n_clusters */
  uint32_t n_clusters;  /* at least 1 */
  uint64_t n_contour;   /* contour edges: hsr_sheets_least to 4 n_faces. Those
                           of each sheet are even */
  uint64_t n_crossings; /* pairs of faces of two sheets that penetrate */
  double width;         /* of the picture, whose height is 1 */
  double side;          /* of a face, as seen in the picture */
  double stretch;       /* a face is so many times as wide as it is high */
  double depth;         /* of the room */
  uint64_t seed;
};

/* The least number of contour edges that so many faces in so many clusters have. */
uint64_t hsr_sheets_least(uint32_t n_faces, uint32_t n_clusters);

/* Fills an empty scene. *n_crossings becomes the number of pairs that do penetrate,
 * which may not be the one asked for, if sheets have no room. HSR_E_INPUT: a sheet
 * is larger than the room. HSR_E_NOMEM. */
enum hsr_status hsr_sheets_build(struct hsr_scene *scene,
                                 const struct hsr_sheets *sheets,
                                 uint64_t *n_crossings, struct hsr_error *err);

#endif
