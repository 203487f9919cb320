// SPDX-License-Identifier: GPL-3.0-or-later
// The faces along the edges of a world, and what a line among them shows. For
// the C++ files of this folder.
#ifndef HSR_COMMON_PAPER_LINE_FACES_H
#define HSR_COMMON_PAPER_LINE_FACES_H

#include "common/exact/exact_plane.h"
#include "common/lines/drawing.h"
#include "common/paper/lines/line_class.h"
#include "common/view/view.h"

#include <vector>

namespace hsr {

// A face along the edge from vertex a to vertex b, a < b.
struct Side {
  uint32_t a, b, face;
  int along;  // +1 if the face runs from a to b, else -1
  int facing; // +1 if the eye is in front of the face, -1 if it is behind, 0 if
              // the face does not exist in the view
};

// The sides of all edges.
class Sides {
public:
  // May throw std::bad_alloc.
  Sides(const hsr_world *world, const hsr_view *view);

  // Those of the edge of vertices a < b.
  std::pair<const Side *, const Side *> of(uint32_t a, uint32_t b) const;

private:
  std::vector<Side> side_; // by a, b, face
};

// Finds the class of a line from the faces beside it.
class Line_faces {
public:
  Line_faces(const hsr_world *world, double crease);

  void clear() { side_.clear(), n_absent_ = 0; }
  // Adds a side of an edge that runs along the line (+1) or against it (-1).
  void add(const Side &side, int along);

  // The class; d is the direction of the line, of any length.
  hsr_line_class find(const Vector3<Exact> &d) const;

private:
  struct Beside {
    uint32_t face;
    int facing, along;
    bool left() const { return facing * along > 0; }
  };
  const Beside *nearest(bool left, const Vector3<Exact> &d) const;
  bool is_behind(const Beside &f, const Beside &g,
                 const Vector3<Exact> &d) const;
  hsr_line_class between(const Beside &f, const Beside &g) const;

  const hsr_world *world_;
  double least_cosine_;
  std::vector<Beside> side_;
  size_t n_absent_ = 0; // sides that do not exist
};

} // namespace hsr

#endif
