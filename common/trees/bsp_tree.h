// SPDX-License-Identifier: GPL-3.0-or-later
// The BSP tree of a group of pieces, or one node of it: what the threads of
// common/trees/bsp.cc make beside one another.
//
// Same        what is made of a group depends on the group, and on how often its
//             faces were cut above it. So a tree that is made of subtrees, by any
//             number of threads, is always the same.
// Loose       a piece of a face that has been cut too often on its way from the
//             root, or in the same subtree, is left out. bsp.cc adds up what the
//             subtrees cut.
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

// The most parts of a face that is not flat. Its parts keep all its corners, so
// more planes would cut each of them.
const uint32_t MOST_PARTS = 32;

struct Too_many {};

// What may be spent on all trees: pieces; questions about sides of planes.
// Whether that is too much is known by the sum alone, which does not depend on
// who spends it when.
class Bsp_budget {
public:
  explicit Bsp_budget(const hsr_bsp_rule &rule)
      : most_pieces_(rule.most_pieces ? rule.most_pieces
                                      : HSR_BSP_MOST_PIECES) {}
  // Throws Too_many once too much is spent.
  void spend(uint64_t n_questions, uint64_t n_pieces) {
    const uint64_t questions = questions_ += n_questions;
    const uint64_t pieces = pieces_ += n_pieces;
    if (questions > MOST_QUESTIONS || pieces > most_pieces_)
      throw Too_many();
  }
  // Gives back what was made of pieces, to begin again.
  void forget_pieces() { pieces_ = 0; }

private:
  static const uint64_t MOST_QUESTIONS = 2000000000;
  const uint64_t most_pieces_;
  std::atomic<uint64_t> questions_{0}, pieces_{0};
};

// How often each face that is not flat was cut. Subtrees count on their own,
// from what was counted above them.
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

struct Placed { // a corner that is handed over
  Point at;
  double error;
  uint32_t corner;
};

// Nodes and what lies in their planes. All numbers begin here.
struct Bsp_part {
  std::vector<hsr_bsp_node> nodes; // the root is the first
  std::vector<hsr_bsp_piece> pieces;
  std::vector<hsr_bsp_corner> corners, cuts;
  std::vector<Placed> placed;
  uint32_t depth = 0; // nodes on the longest path
};

// Calls part(k, thread) for each k below n, as hsr_share does. What it throws is
// thrown once no thread is at work.
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

// The number of things in a vector. std::bad_alloc if 32 bits do not hold it.
uint32_t size_of(size_t n);

using Group = std::vector<uint32_t>; // numbers of pieces, by ascending faces

// Several may work at once, on pieces of their own. What they share of `shapes`
// is guarded there.
class Tree_maker {
public:
  // All are borrowed; pieces that are cut off are added to `pieces`. So many
  // threads tell where the pieces of a large group lie.
  Tree_maker(const Convex_pieces &shapes, Bsp_budget &budget, int threads,
             std::vector<Convex> &pieces)
      : shapes_(shapes), budget_(budget), threads_(threads), pieces_(pieces) {}

  // The tree of all pieces, of which there is one at least.
  void make(Part_counts &counts, Bsp_part &part);

  // Adds a node of the group's pieces that lie in the plane it chooses, and
  // divides the rest. Neither side of the node is set.
  void split(const Group &group, Part_counts &counts, Bsp_part &part,
             Group &front, Group &behind);

private:
  const Convex_pieces &shapes_;
  Bsp_budget &budget_;
  const int threads_;
  std::vector<Convex> &pieces_;

  // The pieces of a group with which planes are tried.
  Convex_pieces::Columns tried_;
  size_t price_of(const Group &group, uint32_t plane, size_t enough);
  uint32_t choose_plane(const Group &group, uint64_t &questions);
  std::vector<unsigned char> where_; // a piece of a group
  void find_sides(const Group &group, uint32_t plane);
  void cut(uint32_t piece, uint32_t plane, Part_counts &counts, Group &front,
           Group &behind);
  void place(const Convex &piece, Bsp_part &part) const;
};

} // namespace hsr

#endif
