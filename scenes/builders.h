/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The builders behind the table of scenes/registry.c. */
#ifndef HSR_SCENES_BUILDERS_H
#define HSR_SCENES_BUILDERS_H

#include "scenes/scenes.h"

/* Each fills an empty scene; see hsr_builtin.build. */
typedef enum hsr_status hsr_build(struct hsr_scene *scene,
                                  const long long *parameter);
typedef enum hsr_status hsr_build_part(struct hsr_scene *scene,
                                       const long long *parameter,
                                       struct hsr_scene_part *part);

/* Fills it with a part; see hsr_builtin.build_part. */
hsr_build_part hsr_build_soup_part;

hsr_build hsr_build_house, hsr_build_harbor, hsr_build_big_harbor;
hsr_build hsr_build_color_cube, hsr_build_color_sides, hsr_build_sphere,
    hsr_build_terrain, hsr_build_twist, hsr_build_office, hsr_build_traffic,
    hsr_build_tower, hsr_build_bare_tower, hsr_build_soup, hsr_build_lattice,
    hsr_build_rooms, hsr_build_greenhouse, hsr_build_panes;

/* worlds/cells.c */
hsr_build hsr_build_checker_cube, hsr_build_grid;

/* worlds/volumes.c; and the files of packages that it reads. */
#define HSR_COLORADO_FILE "/usr/share/dx/samples/data/colorado_elev.vit"
#define HSR_BRAIN_FILE "/usr/share/doc/libvolpack1-dev/examples/brainsmall.den"
#define HSR_COLIN27_FILE "/usr/share/mricron/templates/ch2.nii.gz"
hsr_build hsr_build_checker_plane, hsr_build_heights, hsr_build_colorado,
    hsr_build_tubules, hsr_build_brain, hsr_build_colin27;

/* failures/order.c */
hsr_build hsr_build_cyclic_overlap, hsr_build_penetration, hsr_build_coplanar,
    hsr_build_nested_solids, hsr_build_one_sided, hsr_build_deep_stack;

/* failures/edges.c */
hsr_build hsr_build_t_junction, hsr_build_shared_edges,
    hsr_build_collinear_edges, hsr_build_sliver, hsr_build_sub_pixel_gap,
    hsr_build_needle_fan, hsr_build_non_convex;

/* failures/holes.c */
hsr_build hsr_build_keyholes;

/* failures/eye.c */
hsr_build hsr_build_behind_eye, hsr_build_near_plane, hsr_build_eye_in_plane,
    hsr_build_non_planar, hsr_build_huge_and_tiny;

#endif
