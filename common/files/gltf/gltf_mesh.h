// SPDX-License-Identifier: GPL-3.0-or-later
// The meshes of a glTF file as objects. Only for common/files/gltf.
//
// Source      "glTF 2.0 Specification", 3.7.2 and 3.9
// Vertices    corners of an object at the same place are one vertex: files have
//             a vertex several times where normals or textures differ
// Colours     of a face: the material's factor times the mean of COLOR_0 at its
//             corners. Both are linear.
// Opacity     the alpha of the same product where the material's alphaMode is
//             BLEND; else 1. With MASK, a face below the cutoff is left out.
// Sides       a material that is not doubleSided makes one-sided faces. A mesh
//             that has both kinds becomes two objects.
// Mirrors     where a node's matrix mirrors, faces are wound the other way
//             (3.7.4): one-sided faces of such a node are an object of their
//             own, with turned rings.
// Polygons    in a file that is as hsr wrote it, the corners of a face follow one
//             another, and have its number in _FACE. If its triangles have
//             together the edges of that ring, the ring is the face.
#ifndef HSR_COMMON_GLTF_MESH_H
#define HSR_COMMON_GLTF_MESH_H

#include "common/files/gltf/gltf_accessor.h"
#include "common/files/mesh/mesh_scene.h"

namespace hsr {

struct Gltf_material {
  double factor[4] = {1, 1, 1, 1}; /* linear, and alpha */
  enum Alpha { IS_OPAQUE, IS_MASKED, IS_BLENDED } alpha = IS_OPAQUE;
  double cutoff = 0.5;
  bool is_double_sided = false;
};

/* Which faces of a mesh an object has. */
struct Gltf_part {
  bool is_double_sided;
  bool is_mirrored; /* the rings are turned */
};

class Gltf_meshes {
public:
  /* `as_written`: the file is as hsr wrote it. */
  Gltf_meshes(Gltf_file &file, Mesh_scene &scene, bool as_written)
      : file_(file), scene_(scene), accessors_(file), as_written_(as_written) {}
  /* Whether a mesh has primitives of one kind: sides[0] one-sided, sides[1]
   * double-sided. */
  void find_sides(size_t mesh, bool sides[2]);
  /* Makes an object of a part of a mesh. `name` is for a mesh without one.
   * Returns its number, or Mesh_scene::NONE. */
  uint32_t object(size_t mesh, Gltf_part part, const std::string &name);
  /* Adds notes about all that was left out. */
  void add_notes();

private:
  const Gltf_material &material(const Gltf_value &reference);
  const Gltf_material &material_of(const Gltf_value &primitive);
  void find_textures(const Gltf_value &material);

  Gltf_file &file_;
  Mesh_scene &scene_;
  Gltf_accessors accessors_;
  const bool as_written_;
  std::map<size_t, Gltf_material> materials_;
  const Gltf_material plain_{};
  struct Left_out { /* how many */
    size_t lines = 0, points = 0, placeless = 0, incomplete = 0, masked = 0,
           morphs = 0, textured = 0;
  } left_out_;
  friend class Gltf_mesh_reader;
};

} // namespace hsr

#endif
