// SPDX-License-Identifier: GPL-3.0-or-later
// The grammar of .obj files.
//
// Source      Wavefront Advanced Visualizer manual, appendix B1
// Departures  of geometry only vertices and faces are read; free-form surfaces,
//             lines, points and groups are passed over. Of materials only the
//             colours are read. Vertices may have a colour, "v x y z r g b", as
//             many programs write it: 0..1, or 0..255 if any is above 1.
#include "common/files/mesh/mesh_obj.h"

#include <utility>

namespace hsr {
namespace {

class Obj_scan {
public:
  Obj_scan(Mesh_file &file, bool drop)
      : file_(file), lines_(file, {'#', true}), checker_(drop) {}
  Mesh_extent scan();

private:
  void statement();
  void vertex();
  void face();
  size_t corner(Word word);
  void check_parts(Word word, Word parts) const;

  Mesh_file &file_;
  Lines lines_;
  Face_checker checker_;
  Mesh_extent extent_;
  Materials materials_;
  Passed_over passed_over_;
  const Rgb *material_ = nullptr;  /* of the faces that follow */
  std::vector<double> vertex_rgb_; /* of the first vertices, as they stand */
  /* Faces may name vertices that follow them: the highest number, and where it
   * stood. */
  struct {
    long long vertex = 0;
    size_t face = 0, line = 0;
  } highest_;
};

void Obj_scan::vertex() {
  size_t n = 0;
  double value[7];
  for (Word word = lines_.word(); !word.empty(); word = lines_.word(), n++) {
    const double number = lines_.real(word, "vertex", extent_.n_vertices + 1);
    if (n < 7)
      value[n] = number;
  }
  /* With a weight, with a colour, or with both. */
  if (n != 3 && n != 4 && n != 6 && n != 7)
    lines_.refuse("vertex %zu has %zu numbers, not 3", extent_.n_vertices + 1,
                  n);
  if (n >= 6 && vertex_rgb_.size() == 3 * extent_.n_vertices)
    vertex_rgb_.insert(vertex_rgb_.end(), value + n - 3, value + n);
  extent_.n_vertices++;
}

/* The texture and normal of a corner: "/t", "//n" or "/t/n". */
void Obj_scan::check_parts(Word word, Word parts) const {
  size_t n = 0;
  while (!parts.empty()) {
    parts.remove_prefix(1);
    const Word part = parts.substr(0, parts.find('/'));
    long long number;
    if (++n > 2 || (!part.empty() && !read_integer(part, number)))
      lines_.refuse("face %zu: '%s' is not a corner", extent_.n_faces,
                    shown_word(word).c_str());
    parts.remove_prefix(part.size());
  }
}

/* The vertex of a corner, counted from 0. */
size_t Obj_scan::corner(Word word) {
  const Word first = word.substr(0, word.find('/'));
  long long v;
  if (!read_integer(first, v))
    lines_.refuse("face %zu: '%s' is not a corner", extent_.n_faces,
                  shown_word(word).c_str());
  check_parts(word, word.substr(first.size()));
  Lines::blank(word.substr(first.size()));
  const long long n = static_cast<long long>(extent_.n_vertices);
  if (v == 0 || v < -n || v > MOST_ELEMENTS)
    lines_.refuse("face %zu names vertex %lld of %lld", extent_.n_faces, v, n);
  if (v > highest_.vertex)
    highest_ = {v, extent_.n_faces, lines_.number()};
  return static_cast<size_t>(v > 0 ? v - 1 : n + v);
}

void Obj_scan::face() {
  checker_.start();
  for (Word word = lines_.word(); !word.empty(); word = lines_.word()) {
    checker_.add(corner(word));
    extent_.n_corners++;
  }
  if (const char *fault = checker_.fault())
    lines_.refuse("face %zu %s", extent_.n_faces, fault);
  if (material_ && extent_.rgb.empty())
    extent_.rgb.assign(3 * extent_.n_faces, Mesh_extent::NO_COLOUR);
  if (material_)
    extent_.rgb.insert(extent_.rgb.end(), material_->begin(), material_->end());
  else if (!extent_.rgb.empty())
    extent_.rgb.insert(extent_.rgb.end(), 3, Mesh_extent::NO_COLOUR);
  extent_.n_faces++;
}

void Obj_scan::statement() {
  const Word name = lines_.word();
  if (name == "v") {
    vertex();
  } else if (name == "f") {
    face();
  } else if (name == "mtllib" || name == "usemtl") {
    if (name == "mtllib")
      materials_.read(file_.path, lines_.rest());
    else
      material_ = materials_.find(lines_.rest());
    Lines::blank(name);
    lines_.blank_rest();
  } else {
    if (!passed_over_.takes(name))
      lines_.refuse("'%s' is not a statement", shown_word(name).c_str());
    Lines::blank(name);
    lines_.blank_rest();
  }
}

Mesh_extent Obj_scan::scan() {
  while (lines_.next_line())
    statement();
  if (!lines_.number())
    file_.refuse(0, "holds nothing");
  if (extent_.n_vertices > static_cast<size_t>(MOST_ELEMENTS) ||
      extent_.n_faces > static_cast<size_t>(MOST_ELEMENTS))
    file_.refuse(0, "%zu vertices and %zu faces are more than can be read",
                 extent_.n_vertices, extent_.n_faces);
  if (highest_.vertex > static_cast<long long>(extent_.n_vertices))
    file_.refuse(highest_.line, "face %zu names vertex %lld of %zu",
                 highest_.face, highest_.vertex, extent_.n_vertices);
  extent_.vertex_rgb = obj_colours(vertex_rgb_, extent_.n_vertices);
  extent_.notes = materials_.notes();
  passed_over_.note(extent_.notes);
  return std::move(extent_);
}

} // namespace

Mesh_extent scan_obj(Mesh_file &file, bool drop) {
  skip_byte_order_mark(file);
  return Obj_scan(file, drop).scan();
}

} // namespace hsr
