/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Groups of triangles, each of which a frame may leave out as a whole.
 *
 * Source      L. A. Shirman and S. S. Abi-Ezzi, "The Cone of Normals Technique
 *             for Fast Processing of Curved Patches", Computer Graphics Forum
 *             12(3), 1993; groups of triangles with such cones: S. Kumar, D.
 *             Manocha, W. Garrett and M. Lin, "Hierarchical Back-Face
 *             Computation", Eurographics Workshop on Rendering, 1996. A volume
 *             for each cluster of a surface, to be tested against the frustum:
 *             J. H. Clark, Communications of the ACM 19(10), 1976.
 * Notation    A group has a cone of normals with axis A and half-angle a: every
 *             triangle's normal is within the angle a of A. Its apex P is
 *             behind no triangle's plane, behind being against the normal. So
 *             all triangles turn away from an eye E with A.(P - E) >= |P - E|
 * sin a. Left out    A group is left out only if none of its triangles exists
 *             in the view (common/exact/screen.h), or none has a point in the
 *             window. The proof is in groups.c.
 *
 * Triangles are put into groups by place and normal, and their vertices into
 * the order of the groups. A group owns those of its vertices that no group
 * before it has. So the vertices that a frame needs are runs of consecutive
 * ones. */
#ifndef HSR_ALGORITHMS_GROUPS_H
#define HSR_ALGORITHMS_GROUPS_H

#include "algorithms/engines/tiler/tiler.h"
#include "common/trees/box.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_groups {
  uint32_t n;

  /* By group, and one more at the end: its first triangle; the first vertex
   * that it owns; and where the list of its neighbours begins in near[]. These
   * are the groups before it whose vertices it has, too. */
  uint32_t *first;
  uint32_t *first_vertex;
  uint32_t *first_near;
  uint32_t *near;

  /* By group: the smallest box that holds it, in the world; the apex and the
   * axis of its cone; and the square of sin a, rounded up. Infinite: there is
   * no cone. */
  double *lo[3], *hi[3];
  double *apex[3], *axis[3];
  double *sine2;
  struct hsr_box bounds; /* of all groups */

  struct hsr_triangle_list list; /* all triangles, group after group */
  double *x, *y, *z;             /* their vertices, in their order */
  struct hsr_arena arena;
};

/* Makes the groups of a world all of whose faces are triangles; it is not kept.
 * *groups is freed with hsr_groups_free, also after a failure. HSR_E_NOMEM. */
enum hsr_status hsr_groups_make(struct hsr_groups *groups,
                                const struct hsr_world *world);
void hsr_groups_free(struct hsr_groups *groups);

/* What becomes of a group in a view: it is kept; all of it turns away; or all
 * of it is outside of the window. */
enum { HSR_GROUP_KEPT, HSR_GROUP_AWAY, HSR_GROUP_OUT };

/* Fills verdict[g] for each group g. */
void hsr_groups_look(const struct hsr_groups *groups,
                     const struct hsr_view *view, int *verdict);

/* Snaps the vertices of the groups that are kept, for a tiler that has
 * groups->list as its list. `needed` is room for a mark by group. */
void hsr_groups_snap(const struct hsr_groups *groups, const int *verdict,
                     bool *needed, struct hsr_tiler *tiler);

#ifdef __cplusplus
}
#endif
#endif
