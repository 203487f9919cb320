// SPDX-License-Identifier: GPL-3.0-or-later
// The colours of .mtl files, for mesh_obj.cc.
#ifndef HSR_COMMON_MESH_MATERIALS_H
#define HSR_COMMON_MESH_MATERIALS_H

#include <array>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace hsr {

using Rgb = std::array<float, 3>; /* linear, 0..1 */

/* Decodes a colour of a file, which is sRGB-encoded. Values outside of 0..1 are
 * clamped. */
Rgb rgb_of_file(const double encoded[3]);

/* The diffuse colours (Kd) of materials, by name.
 *
 * Source      Wavefront Advanced Visualizer manual, appendix B1 and "Material
 *             library file"
 * Departures  Kd is taken as sRGB, since most programs write it so. Spectral
 *             and CIE XYZ colours, and all other statements, are ignored. */
class Materials {
public:
  /* Reads the files that a mtllib statement names. Their paths are relative to
   * that of the .obj file. A file that does not exist is only noted, since
   * meshes are often passed on without it. Throws Refused for a malformed
   * file. */
  void read(const char *obj_path, const std::string &names);

  /* Returns the colour of a material. NULL: there is no such material, which is
   * noted, or it has no colour. */
  const Rgb *find(const std::string &name);

  /* Lines about missing files and about missing materials. */
  std::vector<std::string> notes() const;

private:
  void read_file(const std::string &path);

  std::map<std::string, Rgb, std::less<>> colours_;
  std::set<std::string> defined_, missing_files_;
  std::vector<std::string> unknown_; /* materials, in the order of their use */
};

} // namespace hsr

#endif
