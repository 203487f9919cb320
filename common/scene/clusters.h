/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Clusters of faces, the planes that separate them, and priorities in them.
 *
 * Source      R. A. Schumacker, B. Brand, M. Gilliland, W. Sharp, "Study for
 *             applying computer-generated images to visual simulation",
 *             AFHRL-TR-69-14, 1969; as described by Sutherland et al. 1974,
 *             "List-Priority Algorithms", figures 18 and 19.
 * Cluster     a set of faces that no other is among; where HSR_TP is demanded,
 *             with fixed priority numbers, that hold from every viewpoint once
 *             the back faces are removed. A face of two sides is two oriented
 *             faces, of which a view takes one.
 * Separator   a plane with clusters in front of it and clusters behind. An eye
 *             in front of it sees the former before the latter; to an eye
 *             on it, one or the other are not to be seen.
 *
 * Why the order holds, from every eye E. Let a ray meet face A at a and then B
 * at b, E being in front of both (a face seen from behind is the same face,
 * turned round). Beyond a the ray is behind A's plane, and before b it is in
 * front of B's. So if no point of B lies behind A's plane, or no point of A in
 * front of B's, then A does not hide B. If the first faces of a plane's front
 * were hidden by those behind it, the ray would go from E, in front, to behind
 * and to the front again. Faces that touch a plane do so in points that no
 * sample meets, since samples are understood as displaced; unless they lie in
 * it: then all those of one plane are on one side of the separator, and faces
 * of one plane that are seen from one side are in the order of their ids.
 *
 * Thickness   what is seen of a face that is not flat lies on its plane, near
 *             the hull of its vertices; how near, depends on the eye. It is
 *             within `reach` of it unless the eye grazes the plane (hsr_grazes,
 *             common/exact/order.h). A face that may be on either side of another's
 *             plane within that is thick: no priority holds for it. */
#ifndef HSR_COMMON_CLUSTERS_H
#define HSR_COMMON_CLUSTERS_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What a separator has on either side: another separator, or a cluster with
 * this bit. */
#define HSR_IS_CLUSTER 0x80000000u

struct hsr_separator {
  uint32_t face; /* its plane; or HSR_NO_FACE: the plane x|y|z = at */
  int axis;
  double at;
  uint32_t front, behind; /* front: where x|y|z > at */
};
#define HSR_NO_FACE UINT32_MAX

/* In the memory of the world whose faces they are. */
struct hsr_clusters {
  uint32_t n_clusters, n_separators;
  struct hsr_separator *separator;
  uint32_t root; /* as `front` */

  /* Cluster c: oriented faces order[start[c]], ... up to the next one's; 2 f is
   * face f as seen from its front, 2 f + 1 from behind. Of descending priority,
   * where HSR_TP is demanded; else of ascending ids. Faces without any point
   * are in none, and a cluster may be empty. */
  uint32_t *start, *order;

  /* Oriented faces that are in no cluster: see Thickness. */
  uint32_t n_thick, *thick;
  double *reach; /* a face; 0 if it is flat */

  uint64_t pair_tests; /* pairs of faces compared to find the priorities */
};

#ifdef __cplusplus
}
#endif
#endif
