// SPDX-License-Identifier: GPL-3.0-or-later
// Making the BSP tree of a group of pieces, or one node of it. Each thread of
// common/trees/bsp.cc makes trees of its own.
//
// Same        a tree depends only on its group of pieces, and on how often
//             their faces were cut above it. So the tree is the same for any
//             number of threads.
// Loose       a piece is left out if its face has been cut too often on the way
//             from the root or in the same subtree. bsp.cc adds up the cuts of
//             all subtrees.
#ifndef HSR_COMMON_BSP_TREE_H
#define HSR_COMMON_BSP_TREE_H

#include "common/adapt/convex.h"
#include "common/base/share.h"
#include "common/trees/bsp.h"

#include <atomic>
#include <new>
#include <unordered_map>
#include <vector>

namespace hsr {

// The most cuts of a face that is not flat. The limit is needed since each part
// keeps all corners of the face, so that most later planes cut it again.
const uint32_t MOST_PARTS = 32;

// Thrown if there are too many pieces, or too much work.
struct Too_many {};

// The work of all trees: the numbers of pieces made, and of questions asked
// about sides of planes. Only the sums are limited. So whether the limit is
// passed does not depend on the order in which threads work.
class Bsp_budget {
public:
  explicit Bsp_budget(const hsr_bsp_rule &rule)
      : most_pieces_(rule.most_pieces ? rule.most_pieces
                                      : HSR_BSP_MOST_PIECES) {}
  // Adds to the sums. Throws Too_many if one is above its limit.
  void spend(uint64_t n_questions, uint64_t n_pieces) {
    const uint64_t questions = questions_ += n_questions;
    const uint64_t pieces = pieces_ += n_pieces;
    if (questions > MOST_QUESTIONS || pieces > most_pieces_)
      throw Too_many();
  }
  // Sets the number of pieces to 0, to begin again.
  void forget_pieces() { pieces_ = 0; }

private:
  static const uint64_t MOST_QUESTIONS = 2000000000;
  const uint64_t most_pieces_;
  std::atomic<uint64_t> questions_{0}, pieces_{0};
};

// How often each face that is not flat was cut. Each subtree counts for itself,
// beginning with the counts above it.
class Part_counts {
public:
  explicit Part_counts(const std::vector<uint32_t> &above) : above_(above) {}
  // Counts a cut of face f; false if it was cut too often.
  bool may_part(uint32_t f) { return above_[f] + own_[f]++ < MOST_PARTS; }
  void add_to(std::vector<uint32_t> &all) const {
    for (const auto &[f, n] : own_)
      all[f] += n;
  }

private:
  const std::vector<uint32_t> &above_;
  std::unordered_map<uint32_t, uint32_t> own_;
};

// The place of a corner, whose point has no number yet.
struct Placed {
  Point at;
  double error;
  uint32_t corner; // index into Bsp_part.corners
};

// Some nodes and their pieces. All indices are into the vectors of this part.
struct Bsp_part {
  std::vector<hsr_bsp_node> nodes; // the root is the first
  std::vector<hsr_bsp_piece> pieces;
  std::vector<hsr_bsp_corner> corners, cuts;
  std::vector<Placed> placed;
  uint32_t depth = 0; // nodes on the longest path
};

// Calls part(k, thread) for each k below n, as hsr_share does. If a call throws
// Too_many or std::bad_alloc, so does this function, after all threads ended.
template <class Part> void share(int threads, uint32_t n, const Part &part) {
  for (uint32_t k = 0; k < n && threads == 1; k++)
    part(k, 0);
  if (threads == 1)
    return;
  struct Shared {
    const Part &part;
    std::atomic<bool> is_too_many, has_no_memory;
  } shared = {part, {false}, {false}};
  hsr_share(
      threads, n,
      [](void *context, uint32_t k, int thread) {
        Shared *of = static_cast<Shared *>(context);
        try {
          of->part(k, thread);
        } catch (const Too_many &) {
          of->is_too_many = true;
        } catch (const std::bad_alloc &) {
          of->has_no_memory = true;
        }
      },
      &shared);
  if (shared.is_too_many)
    throw Too_many();
  if (shared.has_no_memory)
    throw std::bad_alloc();
}

// Returns n. Throws std::bad_alloc if 32 bits do not hold it.
uint32_t size_of(size_t n);

using Group = std::vector<uint32_t>; // indices of pieces, by ascending faces

// Makes trees. Several makers may work at once, each on pieces of its own.
// `shapes` guards what they share.
class Tree_maker {
public:
  // All arguments are borrowed. Pieces that are cut off are added to `pieces`.
  // `threads` threads find the sides on which the pieces of a large group lie.
  Tree_maker(const Convex_pieces &shapes, Bsp_budget &budget, int threads,
             std::vector<Convex> &pieces)
      : shapes_(shapes), budget_(budget), threads_(threads), pieces_(pieces) {}

  // Makes the tree of all pieces. There must be one at least.
  void make(Part_counts &counts, Bsp_part &part);

  // Chooses a plane for a group and adds a node with the pieces that lie in it.
  // Divides the others into the groups `front` and `behind`. The caller sets
  // the sides of the node.
  void split(const Group &group, Part_counts &counts, Bsp_part &part,
             Group &front, Group &behind);

private:
  const Convex_pieces &shapes_;
  Bsp_budget &budget_;
  const int threads_;
  std::vector<Convex> &pieces_;

  // The pieces of a group by which the cost of a plane is estimated.
  Convex_pieces::Columns tried_;
  size_t price_of(const Group &group, uint32_t plane, size_t enough);
  uint32_t choose_plane(const Group &group, uint64_t &questions);
  std::vector<unsigned char> where_; // by piece of a group: its sides
  void find_sides(const Group &group, uint32_t plane);
  void cut(uint32_t piece, uint32_t plane, Part_counts &counts, Group &front,
           Group &behind);
  void place(const Convex &piece, Bsp_part &part) const;
};

} // namespace hsr

#endif
