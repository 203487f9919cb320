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

/* A colour of a file. Files hold sRGB, 0..1; what is beyond is clamped. */
Rgb rgb_of_file(const double encoded[3]);

/* The diffuse colours (Kd) of materials, by name.
 *
 * Source      Wavefront Advanced Visualizer manual, appendix B1 and "Material
 *             library file"
 * Departures  Kd is taken for sRGB, as it is written by most programs. Spectral
 *             and CIE XYZ colours, and all else, are passed over. */
class Materials {
public:
  /* Reads the files that a mtllib statement names; their paths are relative to
   * that of the .obj file. A file that is not there is passed over: meshes are
   * often handed on without. Throws Refused for one that is malformed. */
  void read(const char *obj_path, const std::string &names);

  /* NULL: there is no such material, or it has no colour. */
  const Rgb *find(const std::string &name);

  /* What is missing, a line for each sort. */
  std::vector<std::string> notes() const;

private:
  void read_file(const std::string &path);

  std::map<std::string, Rgb, std::less<>> colours_;
  std::set<std::string> defined_, missing_files_;
  std::vector<std::string> unknown_; /* materials, in the order of their use */
};

} // namespace hsr

#endif
