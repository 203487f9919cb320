// SPDX-License-Identifier: GPL-3.0-or-later
// The edges of a drawing with their exact places, those of them that lie on one
// line of the picture, and the nodes in which lines end. For the C++ files of
// this folder. lines.h tells what these are.
#ifndef HSR_COMMON_PAPER_NODES_H
#define HSR_COMMON_PAPER_NODES_H

#include "common/lines/drawing.h"
#include "common/paper/lines/cells.h"
#include "common/paper/lines/places.h"

namespace hsr {

constexpr uint32_t NONE = 0xffffffffu;

// An edge of the drawing, with its intervals.
struct Edge {
  hsr_edge_name name;
  uint32_t a, b; // its ends: numbers of places; NONE: not of this world
  size_t first, n;
};

// The edges of a drawing, and their ends.
struct Drawn_edges {
  // May throw std::bad_alloc, as all else here.
  Drawn_edges(const hsr_world *world, const hsr_drawing *drawing);
  std::vector<Edge> edge;
  std::vector<Place> place; // of vertices, then of ends of implied edges

  const Place &a(uint32_t e) const { return place[edge[e].a]; }
  const Place &b(uint32_t e) const { return place[edge[e].b]; }

private:
  uint32_t of_vertex(const hsr_world *world, uint32_t v);
  void find_implied(const hsr_world *world);
  std::vector<uint32_t> of_;
};

// Sorts edges by the planes that they span with one place, the centre. If the
// centre is the eye, edges of one plane lie on one line of the picture. It may
// also be a place beside such a plane. Then those edges of it that lie on one
// line of space come together.
// The plane of a very short edge is not known to 2^-14 in doubles; such an edge is
// put together with no other.
class Planes {
public:
  Planes(const Drawn_edges &edges, const Place &centre);
  void add(uint32_t e);
  std::vector<std::vector<uint32_t>> edges; // of each plane

private:
  bool is_in(uint32_t e, uint32_t plane) const;
  const Drawn_edges &all_;
  const Place &centre_;
  Cells cells_{0x1p-20};
};

// Nodes, which are places of the picture.
class Nodes {
public:
  Nodes(const Drawn_edges &edges, const Place &eye, const hsr_view *view);
  std::vector<std::array<double, 2>> at; // pixels

  // The node of a named place.
  uint32_t of_named(uint32_t place);
  // The image of a point of the world, in pixels.
  std::array<double, 2> image_of(const double point[3]) const;
  // The node of a change of visibility on an edge, at t or a little before or
  // after it. If a named place has its image on the edge there, it is the node of
  // that place; else it is a new one.
  uint32_t of_change(uint32_t e, double t, const double point[3]);
  // The same between two places of the line of the picture on which the edge is.
  uint32_t of_change(uint32_t e, const Place &lo, const Place &hi,
                     const double point[3]);

private:
  uint32_t add(const std::array<double, 2> &image);
  std::vector<uint32_t> find_named(uint32_t e,
                                   const Safe_interval box[2]) const;
  const Drawn_edges &edges_;
  const Place &eye_;
  const hsr_view *view_;
  const Screen screen_;
  std::vector<uint32_t> of_;
  Cells cells_{0x1p-20}; // of named places, by their images
};

} // namespace hsr

#endif
