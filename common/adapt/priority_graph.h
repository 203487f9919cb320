// SPDX-License-Identifier: GPL-3.0-or-later
// Which faces of a group can hide which others, from some viewpoint: Schumacker's
// priority graph (common/scene/clusters.h). For cluster_cgal.cc.
#ifndef HSR_COMMON_PRIORITY_GRAPH_H
#define HSR_COMMON_PRIORITY_GRAPH_H

#include "common/adapt/convex.h"

#include <algorithm>
#include <utility>

namespace hsr {

using Group = std::vector<uint32_t>; // pieces, by ascending faces

// Repeatedly takes out nodes, of which taken[] are out already, that no other has
// priority over; or, if `lowest`, that have priority over no other. Returns them
// in that order. `precedes` tells whether a node has priority over another.
template <class Precedes>
std::vector<uint32_t> take_out(std::vector<bool> &taken, bool lowest,
                               const Precedes &precedes) {
  const uint32_t n = uint32_t(taken.size());
  std::vector<uint32_t> degree(n), order;
  const auto is_first = [&](uint32_t a, uint32_t b) {
    return lowest ? precedes(b, a) : precedes(a, b);
  };
  for (uint32_t a = 0; a < n; a++)
    for (uint32_t b = 0; b < n && !taken[a]; b++)
      degree[b] += !taken[b] && is_first(a, b);
  for (uint32_t a = 0; a < n; a++)
    if (!taken[a] && !degree[a])
      order.push_back(a);
  for (uint32_t a : order)
    taken[a] = true;
  for (size_t k = 0; k < order.size(); k++)
    for (uint32_t b = 0; b < n; b++)
      if (!taken[b] && is_first(order[k], b) && !--degree[b]) {
        taken[b] = true;
        order.push_back(b);
      }
  return order;
}

// A piece as seen from one side of its plane.
struct Oriented {
  uint32_t member; // of the group
  int side;        // of the plane as the planes are turned
  bool from_front; // of its face
};

class Priority_graph {
public:
  Priority_graph(const hsr_world &world, const Convex_pieces &shapes,
                 const std::vector<Convex> &pieces, const Group &group,
                 uint64_t &questions)
      : shapes_(shapes), pieces_(pieces), group_(group), questions_(questions) {
    for (uint32_t p : group)
      planes_.push_back(pieces[p].plane);
    std::sort(planes_.begin(), planes_.end());
    planes_.erase(std::unique(planes_.begin(), planes_.end()), planes_.end());
    for (uint32_t k = 0; k < group.size(); k++) {
      const Convex &piece = pieces[group[k]];
      const int side = shapes.turned(piece.parent);
      own_plane_.push_back(
          size_t(std::lower_bound(planes_.begin(), planes_.end(), piece.plane) -
                 planes_.begin()));
      nodes_.push_back({k, side, true});
      if (!world.mesh.one_sided[piece.from])
        nodes_.push_back({k, -side, false});
    }
    about_.assign(group.size() * planes_.size(), UNKNOWN);
    taken_.assign(nodes_.size(), false);
  }

  // Compares every face with every other. False if two hide one another.
  bool compare(uint64_t &pair_tests) {
    for (size_t k = 0; k < group_.size(); k++)
      for (size_t l = 0; l < k; l++) {
        pair_tests++;
        if ((about(k, l) & BOTH) == BOTH && (about(l, k) & BOTH) == BOTH)
          return false;
      }
    return true;
  }

  // Takes out nodes by what can_hide tells: see above.
  std::vector<uint32_t> take_out(bool lowest) {
    return hsr::take_out(
        taken_, lowest, [&](uint32_t a, uint32_t b) { return can_hide(a, b); });
  }

  size_t size() const { return nodes_.size(); }
  const Oriented &node(uint32_t number) const { return nodes_[number]; }

  // The members of the nodes that are left: they lie on circuits, or between
  // two.
  std::vector<uint32_t> left_over() const {
    std::vector<uint32_t> left;
    for (size_t a = 0; a < nodes_.size(); a++)
      if (!taken_[a])
        left.push_back(nodes_[a].member);
    return left;
  }

  // Whether member k is not certain to be on one side of another's plane.
  bool is_thick(size_t k) {
    for (size_t l = 0; l < group_.size(); l++)
      if (l != k && about(k, l) & UNSURE)
        return true;
    return false;
  }

  // Whether a can hide b from some viewpoint.
  bool can_hide(uint32_t a, uint32_t b) {
    const Oriented &f = nodes_[a], &g = nodes_[b];
    if (own_plane_[f.member] == own_plane_[g.member])
      return f.side == g.side && pieces_[group_[f.member]].parent <
                                     pieces_[group_[g.member]].parent;
    return (about(g.member, f.member) & (f.side > 0 ? BEHIND : FRONT)) &&
           (about(f.member, g.member) & (g.side > 0 ? FRONT : BEHIND));
  }

private:
  const Convex_pieces &shapes_;
  const std::vector<Convex> &pieces_;
  const Group &group_;
  uint64_t &questions_;
  std::vector<uint32_t> planes_;
  std::vector<size_t> own_plane_; // a member: its place in planes_
  std::vector<Oriented> nodes_;
  std::vector<bool> taken_;
  static constexpr uint8_t UNKNOWN = 0xff;
  std::vector<uint8_t> about_; // a member and a plane

  // Where member k lies about the plane of member l.
  unsigned about(size_t k, size_t l) {
    uint8_t &where = about_[k * planes_.size() + own_plane_[l]];
    if (where == UNKNOWN) {
      questions_++;
      where =
          uint8_t(shapes_.about(pieces_[group_[k]], planes_[own_plane_[l]]));
    }
    return where;
  }
};

} // namespace hsr

#endif
