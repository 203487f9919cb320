/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mesh files: .off .obj .ply .stl .vtp, each with one reader. Line drawings and
 * polygons (.vtp) and voxels (.vti), written through VTK.
 *
 * Polygons are kept as polygons. A mesh that is closed and consistently
 * oriented outward becomes a one-sided object, any other a two-sided one;
 * with hsr_import.two_sided, all become two-sided ones.
 *
 * A face has its own colour (.off .ply, and .vtp of hsr export), or that of its
 * material (.obj with its .mtl), or the mean of its vertices' (.ply .obj), or
 * else the object's. */
#ifndef HSR_COMMON_EXCHANGE_H
#define HSR_COMMON_EXCHANGE_H

#include "common/lines/drawing.h"
#include "common/lines/polygons.h"
#include "common/scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_import {
  bool drop_degenerate; /* leave out, and count, faces that cannot be used,
                           rather than refuse the file */
  bool two_sided;       /* a mesh has the faces that turn their backs to the eye
                           even if it is closed */
  int threads;          /* by so many, which the scene gets, too; 0 as 1 */
  uint64_t n_dropped;   /* out: how many were left out */
  char notes[1000];     /* out: what else was passed over, a line for each sort;
                           what has no room is left out */
};

/* Appends the mesh in `path` to the scene as one object named after the file,
 * without an instance. The format is that of the suffix, in upper or lower
 * case. Never takes more memory than a small multiple of the file's size,
 * whatever counts the file claims (for a compressed .vtp file: of the size of
 * its inflated data). `import` may be NULL: nothing is dropped. On failure the
 * scene has no new object, and *err says file, line or element, and what is
 * wrong.
 * HSR_E_INPUT: unreadable, wrong suffix, malformed, truncated, a coordinate
 * not finite, an index out of range, a face with fewer than 3 vertices, a
 * repeated one, or of no area; no face at all. HSR_E_NOMEM. */
enum hsr_status hsr_mesh_read(struct hsr_scene *scene, const char *path,
                              struct hsr_import *import, struct hsr_error *err);

/* Whether an object is closed (every edge has exactly two faces), consistently
 * oriented (they run along it in opposite directions) and outward (its signed
 * volume is positive), as so many threads find. *answer is written on HSR_OK
 * only. HSR_E_NOMEM. */
enum hsr_status hsr_object_is_solid(const struct hsr_object *object,
                                    int threads, bool *answer);

/* Writes a drawing in world space as lines, one for each interval, in the
 * drawing's order. The cell data are invisibility, edge_a, edge_b, edge_part
 * and implied, as in hsr_segment. HSR_E_INPUT: it cannot be written, or this
 * build has no VTK; HSR_E_NOMEM; HSR_E_INTERNAL: VTK failed. */
enum hsr_status hsr_drawing_write_vtp(const struct hsr_drawing *drawing,
                                      const char *path, struct hsr_error *err);

/* Writes visible polygons in world space, where they lie on the planes of their
 * faces: each cycle is a closed line. The cell data are face, region (its
 * number) and hole (0 or 1). Points are rounded. Fails as above. */
enum hsr_status hsr_polygons_write_vtp(const struct hsr_polygons *polygons,
                                       const struct hsr_view *view,
                                       const char *path, struct hsr_error *err);

/* Writes voxels as an image, one cell for each, with the solid's number as cell
 * data "solid". Fails as above. */
struct hsr_solid_voxels;
enum hsr_status hsr_voxels_write_vti(const struct hsr_solid_voxels *voxels,
                                     const char *path, struct hsr_error *err);

/* Whether this build reads .vtp and volumes, and writes .vtp and .vti. */
bool hsr_exchange_has_vtk(void);

#ifdef __cplusplus
}
#endif
#endif
