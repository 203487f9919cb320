/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reading mesh files: .off .obj .ply .stl .vtp .gltf .glb. Writing line drawings
 * and polygons (.vtp) and voxels (.vti), through VTK.
 *
 * Faces       polygons are kept as polygons.
 * Sides       a mesh that is closed and consistently oriented outward becomes a
 *             one-sided object. Any other becomes two-sided. With
 *             hsr_import.two_sided, all become two-sided. A .ply file may say
 *             it itself: faces have a property one_sided, as those of hsr suite.
 * Colours     the colour of a face is the first of these that the file has: its
 *             own (.off .ply, and .vtp of hsr export); that of its material
 *             (.obj with its .mtl); the mean of its vertices' colours (.ply
 *             .obj); the object's. */
#ifndef HSR_COMMON_EXCHANGE_H
#define HSR_COMMON_EXCHANGE_H

#include "common/lines/drawing.h"
#include "common/lines/polygons.h"
#include "common/scene/scene.h"
#include "common/voxels/voxels.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How meshes are imported, and what was left out. */
struct hsr_import {
  bool strict;      /* a file that has faces without area is refused; else they
                         are left out and counted, since they cover no sample */
  bool two_sided;   /* all objects are two-sided, even closed ones */
  const char *path; /* where the file of a scene is, if its name is not its
                         path; or NULL. hsr_scene_open takes notice of it */
  double
      weld; /* vertices no farther from one another than this are joined, in the
                 file\'s unit; 0: none are */
  int threads;        /* how many threads import a file; 0 means 1. A scene that
                         is opened with this gets the same number */
  uint64_t n_dropped; /* out: how many faces were left out */
  char notes[1000]; /* out: what else was ignored. Lines are appended; one that
                         does not fit is left out. "" before the first call */
};

/* Whether a file of this name is read as a mesh, by its suffix. */
bool hsr_is_mesh_name(const char *path);

/* Appends what is in `path` to the scene. A .gltf or .glb file has objects with
 * their instances, and may have views. An .obj file has an object of each of its
 * groups, which share vertices (hsr_group). Any other file is one object, named
 * after the file. None of these has an instance. The format is that of the suffix, in
 * upper or lower case; docs/files.md tells what is read of each. Behind it may be
 * .gz. Memory is at most a small multiple of the file's size, whatever counts it
 * claims; of a compressed file, of the size of what was compressed. `import` may
 * be NULL: all is standard. A vertex of a face that is the same as the one before
 * it is left out. After a failure the scene is as it was, and *err names the
 * file, the line or element, and the fault. HSR_E_INPUT: the file is unreadable,
 * malformed or truncated, or has an unknown suffix; a coordinate is not finite;
 * an index is out of range; no face has an area. If it is strict, also if a face
 * has fewer than 3 vertices, the same vertex twice in succession, or no area.
 * HSR_E_NOMEM. */
enum hsr_status hsr_mesh_read(struct hsr_scene *scene, const char *path,
                              struct hsr_import *import, struct hsr_error *err);

/* Finds whether an object is closed, consistently oriented and outward. That
 * is: every edge has exactly two faces, they run along it in opposite
 * directions, and the signed volume is positive. `threads` threads find it.
 * *answer is written on HSR_OK only. HSR_E_NOMEM. */
enum hsr_status hsr_object_is_solid(const struct hsr_object *object,
                                    int threads, bool *answer);

/* Writes a drawing as lines in world units, one for each interval, in the
 * drawing's order. The cell data are invisibility, edge_a, edge_b, edge_part
 * and implied, as in hsr_segment. With facts, which may be NULL, they are class and
 * object as well, and the names of these are field data. HSR_E_INPUT if the file cannot be written or
 * this build has no VTK; HSR_E_NOMEM; HSR_E_INTERNAL if VTK fails. */
enum hsr_status hsr_drawing_write_vtp(const struct hsr_drawing *drawing,
                                      const struct hsr_drawing_facts *facts,
                                      const char *path, struct hsr_error *err);

/* Writes visible polygons in world units, on the planes of their faces. Each
 * cycle is a closed line. The cell data are face, region (its number) and hole
 * (0 or 1). Points are rounded. Errors as above. */
enum hsr_status hsr_polygons_write_vtp(const struct hsr_polygons *polygons,
                                       const struct hsr_view *view,
                                       const char *path, struct hsr_error *err);

/* Writes voxels as an image with one cell for each voxel. The cell data "solid"
 * are the numbers of their solids. Errors as above. */
struct hsr_solid_voxels;
enum hsr_status hsr_voxels_write_vti(const struct hsr_solid_voxels *voxels,
                                     const char *path, struct hsr_error *err);

/* Whether this build reads .vtp and volumes, and writes .vtp and .vti. */
bool hsr_exchange_has_vtk(void);

#ifdef __cplusplus
}
#endif
#endif
