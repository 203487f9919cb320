// SPDX-License-Identifier: GPL-3.0-or-later
// What the two readers of .obj files share: mesh_scan_obj.cc, which checks any,
// and mesh_obj_plain.cc.
#ifndef HSR_COMMON_MESH_OBJ_H
#define HSR_COMMON_MESH_OBJ_H

#include "common/files/mesh/mesh_materials.h"
#include "common/files/mesh/mesh_text.h"

namespace hsr {

/* Statements that are passed over. */
struct Passed_over {
  size_t n_lines = 0, n_points = 0, n_free_forms = 0;

  /* Whether a statement is one; if so, it is counted. */
  bool takes(Word name);
  void add(const Passed_over &more);
  /* Appends what was passed over, a line for each sort. */
  void note(std::vector<std::string> &notes) const;
};

/* Colours as they stand behind vertices, 0..1 or 0..255, made linear. Empty if not
 * all of n vertices have one. */
std::vector<float> obj_colours(const std::vector<double> &rgb, size_t n);

/* Reads a file whose lines are all plain, by the builder's threads, and resolves its
 * materials. If a line is not, or needs a word, returns false, and nothing is given.
 * Throws Refused for a file of materials; std::bad_alloc. */
bool obj_read_plain(const Mesh_file &file, Mesh_builder &builder);

} // namespace hsr

#endif
