/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Clusters of faces, the planes that separate them, and priorities in them.
 *
 * Source      R. A. Schumacker, B. Brand, M. Gilliland, W. Sharp, "Study for
 *             applying computer-generated images to visual simulation",
 *             AFHRL-TR-69-14, 1969; as described by Sutherland et al. 1974,
 *             "List-Priority Algorithms", figures 18 and 19.
 * Cluster     a set of faces with no other face among them. Where HSR_TP is
 *             demanded, its faces have fixed priority numbers, which hold from
 *             every viewpoint once the back faces are removed. A face of two
 *             sides is two oriented faces; a view takes one of them.
 * Separator   a plane with clusters in front of it and clusters behind. An eye
 *             in front of it sees the former before the latter. From an eye on
 *             the plane no ray meets both, so either order is right.
 *
 * Why the order holds, from every eye E. Let E be in front of the faces A and B
 * (a face seen from behind is the same face, turned round), and let a ray meet
 * A at a and then B at b. Beyond a the ray is behind A's plane; before b it is
 * in front of B's. So A does not hide B if no point of B lies behind A's plane,
 * or no point of A in front of B's. Nor do faces behind a separator hide faces
 * in front of it: the ray would go from E, in front, to behind and then to the
 * front again. Most faces that touch a plane do so only in points that no
 * sample meets, since samples are understood as displaced. The others lie in
 * the plane: all of these are on one side of the separator, and those that are
 * seen from one side are in the order of their ids.
 *
 * Thickness   a face that is not flat is seen on its plane, near the hull of
 *             its vertices. How near depends on the eye: within `reach` of the
 *             hull, unless the eye grazes the plane (hsr_grazes,
 *             common/exact/order.h). A face is thick if within that distance it
 *             may be on either side of another face's plane: no priority holds
 *             for it. */
#ifndef HSR_COMMON_CLUSTERS_H
#define HSR_COMMON_CLUSTERS_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A side of a separator holds the number of another separator, or that of a
 * cluster with this bit set. */
#define HSR_IS_CLUSTER 0x80000000u

struct hsr_separator {
  uint32_t face; /* whose plane it is; HSR_NO_FACE: the plane x|y|z = at */
  int axis;      /* 0, 1, 2 for x, y, z */
  double at;     /* world units */
  uint32_t front, behind; /* front: where x|y|z > at */
};
#define HSR_NO_FACE UINT32_MAX

/* The arrays are in the arena of the world whose faces these are. */
struct hsr_clusters {
  uint32_t n_clusters, n_separators;
  struct hsr_separator *separator;
  uint32_t root; /* encoded as `front` is */

  /* Cluster c has the oriented faces order[start[c]], ...,
   * order[start[c+1] - 1]: 2 f is face f as seen from its front, 2 f + 1 from
   * behind. They are in order of descending priority where HSR_TP is demanded,
   * else of ascending ids. A face without any point is in no cluster. A cluster
   * may be empty. */
  uint32_t *start, *order;

  /* Oriented faces that are in no cluster: see Thickness. */
  uint32_t n_thick, *thick;
  double *reach; /* of each face, world units; 0 if it is flat */

  uint64_t pair_tests; /* pairs of faces compared to find the priorities */
};

#ifdef __cplusplus
}
#endif
#endif
