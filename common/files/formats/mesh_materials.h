// SPDX-License-Identifier: GPL-3.0-or-later
// The colours of .mtl files, for mesh_obj.cc.
#ifndef HSR_COMMON_MESH_MATERIALS_H
#define HSR_COMMON_MESH_MATERIALS_H

#include "common/files/mesh/mesh_colours.h"

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace hsr {

/* Its diffuse colour (Kd), if it has one, and its opacity. */
struct Material {
  bool has_colour = false, has_opacity = false; /* Kd; d or Tr */
  bool has_d = false;
  Rgba look{0, 0, 0, 1};
};

/* The materials of .mtl files, by name.
 *
 * Source      Wavefront Advanced Visualizer manual, appendix B1 and "Material
 *             library file"
 * Opacity     d; or, where there is no d, 1 - Tr. Programs disagree about Tr.
 * Departures  Kd is taken as sRGB, since most programs write it so. Spectral
 *             and CIE XYZ colours and pictures (map_Kd, map_d) are not read,
 *             which is noted; nor is the halo of d. All other statements are
 *             passed over. */
class Materials {
public:
  /* Reads the files that a mtllib statement names. Their paths are relative to
   * that of the .obj file. They may be those of another system: with backslashes,
   * with a drive, in other letter case. A file is looked for as it is named, then
   * in other letter case, and then by its last part beside the .obj file. One
   * that is not found is only noted, since meshes are often passed on without
   * it. Throws Refused for a malformed file. */
  void read(const char *obj_path, const std::string &names);

  /* Returns a material. NULL: there is none of this name, which is noted. */
  const Material *find(const std::string &name);

  /* Lines about missing files, missing materials, and what was not read. */
  std::vector<std::string> notes() const;

private:
  void read_file(const std::string &path);

  std::map<std::string, Material, std::less<>> materials_;
  std::set<std::string> missing_files_;
  size_t n_pictures_ = 0;            /* statements that name one */
  std::vector<std::string> unknown_; /* materials, in the order of their use */
};

} // namespace hsr

#endif
