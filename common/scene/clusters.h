/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Clusters of faces, the planes that separate them, and priorities in them.
 *
 * Source      R. A. Schumacker, B. Brand, M. Gilliland, W. Sharp, "Study for
 *             applying computer-generated images to visual simulation",
 *             AFHRL-TR-69-14, 1969; as described by Sutherland et al. 1974,
 *             "List-Priority Algorithms", figures 18 and 19.
 * Cluster     a set of faces with no other face among them. If the algorithm
 *             has the restriction HSR_TP (common/adapt/adapt.h), the faces of a
 *             cluster have fixed priority numbers, which hold from every
 *             viewpoint once the back faces are removed. A two-sided face is
 *             two oriented faces, of which a view uses one.
 * Separator   a plane with clusters in front of it and clusters behind it. An
 *             eye in front of the plane sees the clusters in front of it first.
 *             From an eye on the plane, no ray meets clusters of both sides, so
 *             either order is right.
 *
 * Why the order holds from every eye E. Let E be in front of the faces A and B.
 * (A face that is seen from behind is the same face, turned round.) Let a ray
 * meet A at the point a and after that B at the point b. Beyond a, the ray is
 * behind A's plane. Before b, it is in front of B's plane. So A does not hide B
 * if no point of B lies behind A's plane, or if no point of A lies in front of
 * B's plane. Faces behind a separator do not hide faces in front of it either:
 * the ray would run from E, which is in front, to behind the plane and to the
 * front again.
 * Most faces that touch a plane touch it only at points that no sample meets,
 * since samples are displaced infinitesimally (common/view/view.h). The others
 * lie in the plane. All faces in the plane of a separator are on one side of
 * it. Those of them that are seen from the same side are in the order of their
 * ids.
 *
 * Thickness   a face that is not flat is drawn on its plane, near the hull of
 *             its vertices. Every drawn point is within the distance `reach` of
 *             the hull, unless the eye grazes the plane (hsr_grazes,
 *             common/exact/order.h). A face is thick if its points, out to that
 *             distance, may lie on both sides of another face's plane. A thick
 *             face has no priority. */
#ifndef HSR_COMMON_CLUSTERS_H
#define HSR_COMMON_CLUSTERS_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Each side of a separator has one number. It is that of another separator or,
 * with this bit set, that of a cluster. */
#define HSR_IS_CLUSTER 0x80000000u

/* A separator is the plane of a face, or a plane across an axis. */
struct hsr_separator {
  uint32_t face; /* the face whose plane it is. HSR_NO_FACE: it is the plane
                    where coordinate `axis` equals `at` */
  int axis;      /* 0, 1, 2 for x, y, z */
  double at;     /* world units */
  uint32_t front, behind; /* what is on each side. The front of an axis plane is
                             where the coordinate is above `at` */
};
#define HSR_NO_FACE UINT32_MAX

/* The arrays are in the arena of the world that has these faces. */
struct hsr_clusters {
  uint32_t n_clusters, n_separators;
  struct hsr_separator *separator;
  uint32_t root; /* encoded as `front` is */

  /* Cluster c has the oriented faces order[start[c]], ...,
   * order[start[c+1] - 1]. The number 2 f is face f as seen from its front, and
   * 2 f + 1 is face f as seen from behind. The faces of a cluster are in order
   * of descending priority if the algorithm has the restriction HSR_TP, else in
   * order of ascending ids. A piece without any point is in no cluster. A
   * cluster may be empty. */
  uint32_t *start, *order;

  /* The thick oriented faces, which are in no cluster. */
  uint32_t n_thick, *thick;
  double *reach; /* of each face, world units; 0 if it is flat */

  uint64_t pair_tests; /* pairs of faces compared to find the priorities */
  uint64_t
      n_kept; /* oriented faces whose priorities are those of another frame,
                      or of another instance */
  uint64_t close_tests; /* for these: pairs of faces compared in this frame, as
                           they touch */
};

#ifdef __cplusplus
}
#endif
#endif
