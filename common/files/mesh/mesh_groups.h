// SPDX-License-Identifier: GPL-3.0-or-later
// Groups of the faces of a mesh, which become objects. Only for
// common/files/mesh.
#ifndef HSR_COMMON_MESH_GROUPS_H
#define HSR_COMMON_MESH_GROUPS_H

#include "common/files/mesh/mesh_file.h"

#include <memory>

namespace hsr {

/* Frees a scene. */
struct Scene_deleter {
  void operator()(struct hsr_scene *scene) const { hsr_scene_delete(scene); }
};
using Divided = std::unique_ptr<struct hsr_scene, Scene_deleter>;

/* Makes an object of each group that has faces. They share vertices (hsr_group)
 * and are one-sided as the mesh is. Returns a scene of these objects alone.
 * Empty: the mesh stays one object. If it has one group, it gets its name.
 * Throws std::bad_alloc. */
Divided divide_mesh(struct hsr_object &mesh, const Groups &groups);

} // namespace hsr

#endif
