// SPDX-License-Identifier: GPL-3.0-or-later
// Source      A few tried planes are enough to find a good one: H. Fuchs, G.
//             Abram and E. Grant, "Near Real-Time Shaded Display of Rigid
//             Objects", SIGGRAPH 1983.
// Splitters   are planes of pieces. A few are tried, each with all pieces of
//             the group or with some. The price of a plane is the pieces that
//             it cuts, and those on its larger side.
// No stack    is as deep as a tree may be: the work that is left is in a list.
#include "common/trees/bsp_tree.h"

#include <algorithm>
#include <numeric>

namespace {

using namespace hsr;

// How many planes are tried for a group; with how many pieces each; and the
// price of a cut, in pieces on the larger side. A cut piece is one more in
// every picture; a deep tree costs only while it is made.
const size_t TRIED_PLANES = 12, WEIGHED_PIECES = 128;
const size_t PRICE_OF_CUT = 8;

// Several threads look at a group of more pieces, each at so many pieces.
// Starting a thread takes as long as looking at some thousand pieces.
const uint32_t RANGE = 16384;

// The side of a plane on which a piece was kept when the plane cut it.
int kept_side(const Convex &piece, uint32_t plane) {
  const auto cut =
      std::find_if(piece.cuts.begin(), piece.cuts.end(),
                   [&](const hsr_cut &c) { return c.face == plane; });
  return cut->side;
}

} // namespace

namespace hsr {

uint32_t size_of(size_t n) {
  if (n >= UINT32_MAX)
    throw std::bad_alloc();
  return uint32_t(n);
}

// --- Choosing a plane -------------------------------------------------------

static size_t step_of(size_t n, size_t wanted) {
  return std::max<size_t>(1, n / wanted);
}

// The cost of dividing a group by a plane, estimated by some of its pieces. If
// it is above `enough`, the result is some number of at least `enough`.
size_t Tree_maker::price_of(const Group &group, uint32_t plane, size_t enough) {
  const size_t step = step_of(group.size(), WEIGHED_PIECES);
  size_t n[4] = {0}, price = 0;
  shapes_.look(tried_, plane);
  for (size_t k = 0, at = 0; k < group.size() && price < enough;
       k += step, at++) {
    const unsigned where = shapes_.about(pieces_[group[k]], tried_, at, plane);
    n[where & UNSURE ? BOTH : where]++;
    price = PRICE_OF_CUT * n[BOTH] + std::max(n[FRONT], n[BEHIND]);
  }
  return price;
}

uint32_t Tree_maker::choose_plane(const Group &group, uint64_t &questions) {
  const size_t n = group.size(), step = step_of(n, TRIED_PLANES);
  uint32_t best = pieces_[group[0]].plane;
  if (n == 1)
    return best;
  const size_t weighed = step_of(n, WEIGHED_PIECES);
  shapes_.clear(tried_);
  for (size_t k = 0; k < n; k += weighed)
    shapes_.add(pieces_[group[k]], tried_);
  size_t least = SIZE_MAX;
  for (size_t k = step / 2; k < n; k += step) {
    const uint32_t plane = pieces_[group[k]].plane;
    const size_t price = price_of(group, plane, least);
    questions += (n + weighed - 1) / weighed;
    if (price < least) {
      least = price;
      best = plane;
    }
  }
  return best;
}

// --- Dividing a group -------------------------------------------------------

// On which side of the plane each piece lies.
void Tree_maker::find_sides(const Group &group, uint32_t plane) {
  const uint32_t n = size_of(group.size());
  const bool all_tried = n > 1 && step_of(n, WEIGHED_PIECES) == 1;
  where_.resize(n);
  if (all_tried)
    shapes_.look(tried_, plane);
  const auto look = [&](uint32_t part, int) {
    const hsr_range range = hsr_range_of(n, RANGE, part);
    for (uint32_t k = range.from; k < range.to; k++) {
      const Convex &piece = pieces_[group[k]];
      where_[k] = static_cast<unsigned char>(
          all_tried ? shapes_.about(piece, tried_, k, plane)
                    : shapes_.about(piece, plane));
    }
  };
  share(threads_, hsr_n_ranges(n, RANGE), look);
}

void Tree_maker::cut(uint32_t piece, uint32_t plane, Part_counts &counts,
                     Group &front, Group &behind) {
  const Convex &whole = pieces_[piece];
  if (!shapes_.is_flat(whole) && !counts.may_part(whole.from))
    return;
  budget_.spend(0, 1);
  Convex other = shapes_.part(whole, plane, -1);
  pieces_[piece] = shapes_.part(whole, plane, +1);
  front.push_back(piece);
  behind.push_back(size_of(pieces_.size()));
  pieces_.push_back(std::move(other));
}

void Tree_maker::split(const Group &group, Part_counts &counts, Bsp_part &part,
                       Group &front, Group &behind) {
  uint64_t questions = group.size();
  const uint32_t plane = choose_plane(group, questions);
  const uint32_t first = size_of(part.pieces.size());
  budget_.spend(questions, 0);
  find_sides(group, plane);
  for (size_t k = 0; k < group.size(); k++) {
    const uint32_t p = group[k];
    if (pieces_[p].plane == plane) {
      place(pieces_[p], part);
      pieces_[p] = {};
    } else if (where_[k] == BOTH || where_[k] & UNSURE)
      cut(p, plane, counts, front, behind);
    else
      (where_[k] == BEHIND ? behind : front).push_back(p);
  }
  part.nodes.push_back({plane, HSR_NO_BSP, HSR_NO_BSP, first,
                        size_of(part.pieces.size()) - first, 0, 0, 0});
}

void Tree_maker::make(Part_counts &counts, Bsp_part &part) {
  struct Open {
    Group group;
    uint32_t parent; // a node; HSR_NO_BSP: there is none
    bool in_front;
    uint32_t depth;
  };
  std::vector<Open> open;
  part.nodes.reserve(pieces_.size());
  part.pieces.reserve(pieces_.size());
  Group all(pieces_.size());
  std::iota(all.begin(), all.end(), 0u);
  open.push_back({std::move(all), HSR_NO_BSP, false, 1});
  while (!open.empty()) {
    const Open next = std::move(open.back());
    open.pop_back();
    const uint32_t node = size_of(part.nodes.size());
    if (next.parent != HSR_NO_BSP)
      (next.in_front ? part.nodes[next.parent].front
                     : part.nodes[next.parent].behind) = node;
    part.depth = std::max(part.depth, next.depth);
    Open front = {{}, node, true, next.depth + 1};
    Open behind = {{}, node, false, next.depth + 1};
    split(next.group, counts, part, front.group, behind.group);
    if (!behind.group.empty())
      open.push_back(std::move(behind));
    if (!front.group.empty())
      open.push_back(std::move(front));
  }
}

// --- What lies in a plane ---------------------------------------------------

void Tree_maker::place(const Convex &piece, Bsp_part &part) const {
  hsr_bsp_piece made = {piece.from,
                        size_of(part.corners.size()),
                        size_of(piece.corners.size()),
                        size_of(part.cuts.size()),
                        0,
                        0,
                        0};
  const auto side_of = [](int side) {
    return side > 0 ? HSR_BSP_FRONT : HSR_BSP_BEHIND;
  };
  for (const Corner &c : piece.corners) {
    part.placed.push_back({c.at, c.error, size_of(part.corners.size())});
    part.corners.push_back(
        {0, c.a, c.b == NO_VERTEX ? side_of(kept_side(piece, c.a)) : c.b});
  }
  if (!shapes_.is_flat(piece)) {
    for (const hsr_cut &cut : piece.cuts)
      part.cuts.push_back({0, cut.face, side_of(cut.side)});
    made.n_cuts = size_of(piece.cuts.size());
  }
  part.pieces.push_back(made);
}

} // namespace hsr
