/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Groups of triangles that a frame leaves out together.
 *
 * Source      L. A. Shirman and S. S. Abi-Ezzi, "The Cone of Normals Technique
 *             for Fast Processing of Curved Patches", Computer Graphics Forum
 *             12(3), 1993; groups of triangles with such cones: S. Kumar, D.
 *             Manocha, W. Garrett and M. Lin, "Hierarchical Back-Face
 *             Computation", Eurographics Workshop on Rendering, 1996. A volume
 *             for each cluster of a surface, to be tested against the frustum:
 *             J. H. Clark, Communications of the ACM 19(10), 1976.
 * Notation    axis A, and half-angle a: every normal of the group is within a
 *             of A; apex P: behind no triangle's plane, seen along its normal.
 *             So all triangles turn away from an eye E with A.(P - E) >= |P -
 *             E| sin a.
 * Left out    a group is left out only if none of its triangles exists in the
 *             view (common/exact/screen.h), or none has a point in the window.
 *             The proof is in groups.c.
 *
 * The triangles are put into groups by place and normal, and their vertices in
 * the order of the groups. A group owns the vertices that no group before it
 * has. So the vertices of what is not left out are runs of those of all. */
#ifndef HSR_ALGORITHMS_GROUPS_H
#define HSR_ALGORITHMS_GROUPS_H

#include "algorithms/engines/tiler/tiler.h"
#include "common/trees/box.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_groups {
  uint32_t n;
  uint32_t *first;        /* n + 1: the group's first triangle, */
  uint32_t *first_vertex; /* n + 1: and the first vertex that it owns */
  uint32_t *first_near;   /* n + 1: the groups before it, of which it has */
  uint32_t *near;         /* vertices, are near[first_near[g]] and so on */
  double *lo[3], *hi[3];  /* a box that just holds the group */
  double *apex[3], *axis[3];
  double *sine2; /* of a, squared and rounded up; infinite: there is no cone */
  struct hsr_box bounds; /* of all */

  struct hsr_triangle_list list; /* all triangles, group after group */
  double *x, *y, *z;             /* their vertices, in their order */
  struct hsr_arena arena;
};

/* Puts the triangles of a world, which has nothing else, into groups. The world
 * is not kept. Freed with hsr_groups_free also after a failure. HSR_E_NOMEM. */
enum hsr_status hsr_groups_make(struct hsr_groups *groups,
                                const struct hsr_world *world);
void hsr_groups_free(struct hsr_groups *groups);

/* What becomes of a group. */
enum { HSR_GROUP_KEPT, HSR_GROUP_AWAY, HSR_GROUP_OUT };

/* Fills verdict[g]: whether group g turns away, or is outside of the window. */
void hsr_groups_look(const struct hsr_groups *groups,
                     const struct hsr_view *view, int *verdict);

/* Snaps the vertices of the groups that are kept. `needed` has room for a mark a
 * group. */
void hsr_groups_snap(const struct hsr_groups *groups, const int *verdict,
                     bool *needed, struct hsr_tiler *tiler);

#ifdef __cplusplus
}
#endif
#endif
