// SPDX-License-Identifier: GPL-3.0-or-later
// Source      as in bsp.h
// Medians     The root's side is a power of two, 2^s; its corner is a multiple
//             of 2^(s-3); and 2^s is at least 2^-30 times the largest
//             coordinate. So the centre of a cube that is divided, at most 19
//             levels down, is a multiple of 2^(s-20), by a number below 2^52:
//             exact. If coordinates are multiples of some power of two, so are
//             medians, as long as they can be.
// Division    makes more pieces out of those that a median plane passes
//             through. Let s_k be the factor by which a division multiplies
//             their number: the product s_1 s_2 ... down to a cube is never
//             more than 16, so there are at most 16 times as many in all. A
//             cube that holds a vertex of many faces is not divided either: one
//             octant would have them all, and others some.
// Threads     cubes are divided until there are some leaves. Their groups of
//             more than FEW pieces are divided one after the other; several
//             threads look at the pieces of a large one. What is left is
//             subtrees, in the order in which a single thread would reach them.
//             Each is made by one thread in memory of its own, with exact
//             numbers of its own. Then they are joined in that order.
// Loose       faces are found while the trees are made. The trees are then made
//             again without them.
#include "common/base/share.h"
#include "common/trees/bsp_tree.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

namespace {

using namespace hsr;

const int MOST_DEPTH = 20;
const double MOST_GROWTH = 16;

// A larger group is divided before the threads take subtrees.
const size_t FEW = 512;

// The subtrees are begun when leaves with more pieces in all are waiting. A
// larger number would take more memory.
const size_t BATCH = 16384;

const hsr_box EMPTY = {{INFINITY, INFINITY, INFINITY},
                       {-INFINITY, -INFINITY, -INFINITY}};

// Widens the box to hold all within `error` of a point.
void grow(hsr_box &box, const Point &at, double error) {
  for (size_t c = 0; c < 3; c++) {
    const double lo = at[c] - error, hi = at[c] + error;
    box.lo[c] =
        std::fmin(box.lo[c], error > 0 ? std::nextafter(lo, -INFINITY) : lo);
    box.hi[c] =
        std::fmax(box.hi[c], error > 0 ? std::nextafter(hi, INFINITY) : hi);
  }
}

class Maker {
public:
  Maker(const hsr_world &world, const hsr_bsp_rule &rule)
      : world_(world), most_(rule.most),
        threads_(hsr_threads(world.roster.scene->threads)), shapes_(world),
        budget_(rule), parts_(world.n_faces), own_shapes_(size_t(threads_)) {
    // What is seen of such a face may be anywhere: it is loose from the start.
    for (uint32_t f = 0; f < world.n_faces; f++)
      if (!std::isfinite(shapes_.reach(hsr_world_parent(&world, f))))
        parts_[f] = MOST_PARTS + 1;
  }
  void make();
  bool fill(hsr_bsp *out) const;

private:
  const hsr_world &world_;
  const uint32_t most_;
  const int threads_;
  Convex_pieces shapes_;
  Bsp_budget budget_;
  uint64_t questions_ = 0;      // not yet spent
  std::vector<uint32_t> parts_; // a face that is not flat; more than there may
                                // be: it is loose

  // What will be handed over.
  std::vector<hsr_bsp_cube> cubes_;
  std::vector<hsr_bsp_node> nodes_;
  std::vector<hsr_bsp_piece> made_;
  std::vector<hsr_bsp_corner> corners_, cuts_;
  std::vector<double> x_, y_, z_, error_;
  std::vector<hsr_bsp_median> medians_;
  uint32_t most_depth_ = 0;

  // --- Cubes
  struct Open_cube {
    uint32_t cube;
    int depth;
    double growth;
    std::vector<Convex> pieces;
  };
  std::vector<Open_cube> open_;
  std::map<std::pair<size_t, double>, uint32_t> median_;

  void start_again();
  bool make_all();
  size_t count_loose() const;
  bool is_loose(uint32_t f) const { return parts_[f] > MOST_PARTS; }
  void add_cube(const double centre[3], double half);
  void make_root(const std::vector<Convex> &pieces);
  uint32_t median(size_t axis, double at);
  bool helps(const Open_cube &open, const uint32_t planes[3], double &growth);
  bool divide(Open_cube &open);
  void hand_out(Convex &&piece, const uint32_t planes[3], size_t axis,
                size_t octant, std::vector<Convex> *into);
  void find_tight_boxes();
  void note_sides();

  // --- The trees of leaves
  struct Item {     // a node of a large group, or a subtree
    uint32_t cube;  // the leaf
    uint32_t above; // the item of the node above it; HSR_NO_BSP: none
    bool in_front, is_subtree;
    uint32_t depth;
    std::vector<Convex> pieces; // of a subtree
    Bsp_part part;
    Part_counts counts;
  };
  std::vector<Item> items_;
  size_t n_waiting_ = 0;                                   // pieces of items
  std::vector<std::unique_ptr<Convex_pieces>> own_shapes_; // of a thread

  unsigned about(const Convex &piece, uint32_t plane);
  bool may_part(const Convex &piece);
  void divide_leaf(uint32_t cube, std::vector<Convex> &&pieces);
  void make_subtrees();
  void make_items();
  void append(Item &item, std::vector<uint32_t> &root);
  void place_points(hsr_bsp_cube &leaf);
  std::vector<Placed> placed_; // of a leaf
};

// --- Cubes ------------------------------------------------------------------

void Maker::add_cube(const double centre[3], double half) {
  hsr_bsp_cube cube = {
      {centre[0], centre[1], centre[2]}, half, EMPTY, {}, HSR_NO_BSP, 0, 0, 0};
  std::fill(cube.child, cube.child + 8, HSR_NO_BSP);
  cubes_.push_back(cube);
}

void Maker::make_root(const std::vector<Convex> &pieces) {
  hsr_box box = EMPTY;
  for (const Convex &piece : pieces)
    for (const Corner &corner : piece.corners)
      grow(box, corner.at, corner.error);
  double extent = 0x1p-900, largest = 0;
  for (size_t c = 0; c < 3 && !pieces.empty(); c++) {
    extent = std::fmax(extent, box.hi[c] - box.lo[c]);
    largest = std::fmax(largest, std::fmax(-box.lo[c], box.hi[c]));
  }
  double side = std::exp2(std::ilogb(std::fmax(extent, largest * 0x1p-30)));
  double lo[3] = {0, 0, 0};
  for (bool holds = pieces.empty(); !holds;) {
    side *= 2;
    holds = true;
    for (size_t c = 0; c < 3; c++) {
      lo[c] = std::floor(box.lo[c] / (side / 8)) * (side / 8);
      holds &= box.hi[c] <= lo[c] + side;
    }
  }
  const double centre[3] = {lo[0] + side / 2, lo[1] + side / 2,
                            lo[2] + side / 2};
  add_cube(centre, side / 2);
}

uint32_t Maker::median(size_t axis, double at) {
  const auto place = median_.insert({{axis, at}, 0});
  if (place.second) {
    place.first->second = shapes_.add_level(axis, at);
    medians_.push_back({int(axis), at});
  }
  return place.first->second;
}

// Whether dividing the cube helps; and the most by which the pieces may grow.
bool Maker::helps(const Open_cube &open, const uint32_t planes[3],
                  double &growth) {
  size_t n[8] = {0}, n_pieces = open.pieces.size();
  for (const Convex &piece : open.pieces) {
    unsigned where[3];
    for (size_t axis = 0; axis < 3; axis++) {
      where[axis] = about(piece, planes[axis]);
      where[axis] = where[axis] & UNSURE ? BOTH
                    : where[axis]        ? where[axis]
                                         : unsigned(BEHIND);
    }
    for (size_t octant = 0; octant < 8; octant++) {
      bool is_in = true;
      for (size_t axis = 0; axis < 3; axis++)
        is_in &= (where[axis] & (octant >> axis & 1 ? FRONT : BEHIND)) != 0;
      n[octant] += is_in;
    }
  }
  size_t largest = 0, sum = 0;
  for (size_t octant = 0; octant < 8; octant++) {
    largest = std::max(largest, n[octant]);
    sum += n[octant];
  }
  growth = open.growth * double(sum) / double(n_pieces);
  return growth <= MOST_GROWTH && (largest < n_pieces || sum <= 2 * n_pieces);
}

void Maker::hand_out(Convex &&piece, const uint32_t planes[3], size_t axis,
                     size_t octant, std::vector<Convex> *into) {
  if (axis == 3) {
    into[octant].push_back(std::move(piece));
    return;
  }
  if (is_loose(piece.from))
    return;
  const unsigned where = about(piece, planes[axis]);
  const size_t above = octant | size_t(1) << axis;
  if (where == BOTH || where & UNSURE) {
    if (!may_part(piece))
      return;
    hand_out(shapes_.part(piece, planes[axis], +1), planes, axis + 1, above,
             into);
    hand_out(shapes_.part(piece, planes[axis], -1), planes, axis + 1, octant,
             into);
  } else {
    hand_out(std::move(piece), planes, axis + 1,
             where == FRONT ? above : octant, into);
  }
}

// Divides a cube. False if it is to be a leaf.
bool Maker::divide(Open_cube &open) {
  const hsr_bsp_cube cube = cubes_[open.cube];
  if (!most_ || open.pieces.size() <= most_ || open.depth == MOST_DEPTH)
    return false;
  uint32_t planes[3];
  for (size_t axis = 0; axis < 3; axis++)
    planes[axis] = median(axis, cube.centre[axis]);
  double growth;
  if (!helps(open, planes, growth))
    return false;
  std::vector<Convex> into[8];
  for (Convex &piece : open.pieces)
    hand_out(std::move(piece), planes, 0, 0, into);
  size_t n = 0;
  for (const std::vector<Convex> &pieces : into)
    n += pieces.size();
  budget_.spend(questions_,
                n > open.pieces.size() ? n - open.pieces.size() : 0);
  questions_ = 0;
  for (size_t octant = 0; octant < 8; octant++) {
    if (into[octant].empty())
      continue;
    double centre[3];
    for (size_t axis = 0; axis < 3; axis++)
      centre[axis] = cube.centre[axis] +
                     (octant >> axis & 1 ? cube.half / 2 : -cube.half / 2);
    const uint32_t child = size_of(cubes_.size());
    cubes_[open.cube].child[octant] = child;
    add_cube(centre, cube.half / 2);
    open_.push_back({child, open.depth + 1, growth, std::move(into[octant])});
  }
  return true;
}

void Maker::make() {
  while (!make_all())
    start_again();
  find_tight_boxes();
  note_sides();
}

void Maker::start_again() {
  cubes_.clear();
  nodes_.clear();
  made_.clear();
  corners_.clear();
  cuts_.clear();
  for (std::vector<double> *c : {&x_, &y_, &z_, &error_})
    c->clear();
  most_depth_ = 0;
  items_.clear();
  n_waiting_ = 0;
  budget_.forget_pieces();
  for (uint32_t &parts : parts_)
    parts = parts > MOST_PARTS ? parts : 0;
}

// Makes all cubes and trees. False if a face turned out to be loose.
bool Maker::make_all() {
  std::vector<Convex> all;
  for (uint32_t f = 0; f < world_.n_faces; f++) {
    Convex piece;
    if (!is_loose(f) && shapes_.make(f, piece))
      all.push_back(std::move(piece));
  }
  make_root(all);
  budget_.spend(0, all.size());
  const size_t n_loose = count_loose();
  open_.push_back({0, 0, 1, std::move(all)});
  while (!open_.empty()) {
    Open_cube next = std::move(open_.back());
    open_.pop_back();
    if (divide(next) || next.pieces.empty())
      continue;
    n_waiting_ += next.pieces.size();
    divide_leaf(next.cube, std::move(next.pieces));
    if (n_waiting_ > BATCH)
      make_items();
  }
  make_items();
  return count_loose() == n_loose;
}

size_t Maker::count_loose() const {
  size_t n = 0;
  for (uint32_t parts : parts_)
    n += parts > MOST_PARTS;
  return n;
}

// Finds the tight boxes of cubes that are no leaves. Children come after
// parents.
void Maker::find_tight_boxes() {
  for (size_t k = cubes_.size(); k-- > 0;)
    for (uint32_t child : cubes_[k].child)
      for (size_t c = 0; c < 3 && child != HSR_NO_BSP; c++) {
        hsr_box &tight = cubes_[k].tight;
        tight.lo[c] = std::fmin(tight.lo[c], cubes_[child].tight.lo[c]);
        tight.hi[c] = std::fmax(tight.hi[c], cubes_[child].tight.hi[c]);
      }
}

// Notes with nodes and pieces what tells on which side of them the eye is.
void Maker::note_sides() {
  for (hsr_bsp_node &node : nodes_) {
    const Level &level = shapes_.level(node.plane);
    node.axis = static_cast<int16_t>(level.axis);
    node.level = static_cast<int16_t>(level.front);
    node.at = level.at;
  }
  for (hsr_bsp_piece &piece : made_) {
    const uint32_t parent = hsr_world_parent(&world_, piece.face);
    piece.turned = static_cast<int16_t>(shapes_.turned(parent));
    piece.one_sided = world_.mesh.one_sided[piece.face];
  }
}

// --- The trees of leaves ----------------------------------------------------

// Counts the division of a piece; false if its face is loose.
bool Maker::may_part(const Convex &piece) {
  return shapes_.is_flat(piece) || parts_[piece.from]++ < MOST_PARTS;
}

unsigned Maker::about(const Convex &piece, uint32_t plane) {
  questions_++;
  return shapes_.about(piece, plane);
}

// Divides what is too large for a subtree, and lists what is left.
void Maker::divide_leaf(uint32_t cube, std::vector<Convex> &&pieces) {
  if (pieces.size() <= FEW) {
    items_.push_back({cube,
                      HSR_NO_BSP,
                      false,
                      true,
                      1,
                      std::move(pieces),
                      {},
                      Part_counts(parts_)});
    return;
  }
  struct Open {
    uint32_t above;
    bool in_front;
    uint32_t depth;
    Group group;
  };
  std::vector<Open> open;
  Tree_maker maker(shapes_, budget_, threads_, pieces);
  Group all(pieces.size());
  std::iota(all.begin(), all.end(), 0u);
  open.push_back({HSR_NO_BSP, false, 1, std::move(all)});
  while (!open.empty()) {
    const Open next = std::move(open.back());
    open.pop_back();
    const uint32_t number = size_of(items_.size());
    const bool is_subtree = next.group.size() <= FEW;
    items_.push_back({cube,
                      next.above,
                      next.in_front,
                      is_subtree,
                      next.depth,
                      {},
                      {},
                      Part_counts(parts_)});
    Item &item = items_.back();
    if (is_subtree) {
      item.pieces.reserve(next.group.size());
      for (uint32_t p : next.group)
        item.pieces.push_back(std::move(pieces[p]));
      continue;
    }
    Open front = {number, true, next.depth + 1, {}};
    Open behind = {number, false, next.depth + 1, {}};
    item.part.depth = 1;
    maker.split(next.group, item.counts, item.part, front.group, behind.group);
    item.counts.add_to(parts_);
    if (!behind.group.empty())
      open.push_back(std::move(behind));
    if (!front.group.empty())
      open.push_back(std::move(front));
  }
}

// Each thread has planes of its own; and the pieces of a subtree share no exact
// corner with those of another.
void Maker::make_subtrees() {
  std::vector<Item *> subtrees;
  for (Item &item : items_)
    if (item.is_subtree) {
      for (Convex &piece : item.pieces)
        for (Corner &corner : piece.corners)
          corner.exact.reset();
      subtrees.push_back(&item);
    }
  share(threads_, size_of(subtrees.size()), [&](uint32_t k, int thread) {
    Item &item = *subtrees[k];
    std::unique_ptr<Convex_pieces> &own = own_shapes_[size_t(thread)];
    if (!own)
      own = std::make_unique<Convex_pieces>(shapes_);
    Tree_maker(*own, budget_, 1, item.pieces).make(item.counts, item.part);
    item.pieces = {};
  });
  for (const Item *item : subtrees)
    item->counts.add_to(parts_);
}

template <class T>
void add_all(std::vector<T> &to, const std::vector<T> &from) {
  to.insert(to.end(), from.begin(), from.end());
}

// Puts an item after what there is. root[k] is the node where item k begins.
void Maker::append(Item &item, std::vector<uint32_t> &root) {
  Bsp_part &part = item.part;
  const uint32_t node = size_of(nodes_.size()), piece = size_of(made_.size()),
                 corner = size_of(corners_.size()), cut = size_of(cuts_.size());
  root.push_back(node);
  if (item.above == HSR_NO_BSP)
    cubes_[item.cube].root = node;
  else
    (item.in_front ? nodes_[root[item.above]].front
                   : nodes_[root[item.above]].behind) = node;
  for (hsr_bsp_node &made : part.nodes) {
    for (uint32_t *child : {&made.front, &made.behind})
      *child = *child == HSR_NO_BSP ? HSR_NO_BSP : *child + node;
    made.first_piece += piece;
  }
  for (hsr_bsp_piece &made : part.pieces) {
    made.first_corner += corner;
    made.first_cut += cut;
    uint32_t &most = cubes_[item.cube].most_corners;
    most = std::max(most, made.n_corners);
  }
  for (Placed &placed : part.placed)
    placed.corner += corner;
  add_all(nodes_, part.nodes);
  add_all(made_, part.pieces);
  add_all(corners_, part.corners);
  add_all(cuts_, part.cuts);
  add_all(placed_, part.placed);
  most_depth_ = std::max(most_depth_, item.depth - 1 + part.depth);
  part = {};
}

// Makes what waits, and puts it after what there is.
void Maker::make_items() {
  std::vector<uint32_t> root;
  make_subtrees();
  for (size_t k = 0; k < items_.size(); k++) {
    append(items_[k], root);
    if (k + 1 == items_.size() || items_[k + 1].cube != items_[k].cube)
      place_points(cubes_[items_[k].cube]);
  }
  items_.clear();
  n_waiting_ = 0;
}

// --- The result -------------------------------------------------------------

// The points of a leaf's corners, each once.
void Maker::place_points(hsr_bsp_cube &leaf) {
  const auto key = [](const Placed &p) { return std::tie(p.at, p.error); };
  std::sort(placed_.begin(), placed_.end(),
            [&](const Placed &a, const Placed &b) {
              return std::tie(a.at, a.error, a.corner) <
                     std::tie(b.at, b.error, b.corner);
            });
  leaf.first_point = size_of(x_.size());
  for (size_t k = 0; k < placed_.size(); k++) {
    const Placed &p = placed_[k];
    if (!k || key(placed_[k - 1]) != key(p)) {
      x_.push_back(p.at[0]);
      y_.push_back(p.at[1]);
      z_.push_back(p.at[2]);
      error_.push_back(p.error);
      grow(leaf.tight, p.at, p.error);
    }
    corners_[p.corner].point = size_of(x_.size() - 1);
  }
  placed_.clear();
  leaf.n_points = size_of(x_.size()) - leaf.first_point;
  for (size_t c = 0; c < 3 && leaf.n_points; c++) {
    leaf.tight.lo[c] = std::fmax(leaf.tight.lo[c], leaf.centre[c] - leaf.half);
    leaf.tight.hi[c] = std::fmin(leaf.tight.hi[c], leaf.centre[c] + leaf.half);
  }
}

template <class T>
bool hand_over(hsr_arena *arena, const std::vector<T> &from, T *&to,
               uint32_t &n) {
  n = size_of(from.size());
  to = HSR_NEW(arena, T, from.size());
  if (to)
    std::copy(from.begin(), from.end(), to);
  return to;
}

bool Maker::fill(hsr_bsp *out) const {
  hsr_arena *arena = &out->arena;
  const uint32_t n = world_.n_faces;
  out->face_of = HSR_NEW(arena, uint32_t, world_.mesh.n_planes);
  out->reach = HSR_NEW(arena, double, n);
  if (!out->face_of || !out->reach)
    return false;
  for (uint32_t p = 0; p < world_.mesh.n_planes; p++) {
    const uint32_t f = shapes_.face_of(p);
    out->face_of[p] = world_.pieces ? world_.pieces->first[f] : f;
  }
  for (uint32_t f = 0; f < n; f++)
    out->reach[f] = shapes_.reach(hsr_world_parent(&world_, f));
  std::vector<uint32_t> loose;
  for (uint32_t f = 0; f < n; f++)
    if (is_loose(f))
      loose.push_back(f);
  out->most_depth = most_depth_;
  return hand_over(arena, cubes_, out->cube, out->n_cubes) &&
         hand_over(arena, nodes_, out->node, out->n_nodes) &&
         hand_over(arena, made_, out->piece, out->n_pieces) &&
         hand_over(arena, corners_, out->corner, out->n_corners) &&
         hand_over(arena, cuts_, out->cut, out->n_cuts) &&
         hand_over(arena, x_, out->x, out->n_points) &&
         hand_over(arena, y_, out->y, out->n_points) &&
         hand_over(arena, z_, out->z, out->n_points) &&
         hand_over(arena, error_, out->error, out->n_points) &&
         hand_over(arena, medians_, out->median, out->n_medians) &&
         hand_over(arena, loose, out->loose, out->n_loose);
}

} // namespace

hsr_status hsr_bsp_init(struct hsr_bsp *bsp, const struct hsr_world *world,
                        const struct hsr_bsp_rule *rule,
                        struct hsr_error *err) {
  *bsp = {};
  bsp->world = world;
  bsp->is_octree = rule->most > 0;
  return guarded(err, [&]() -> hsr_status {
    Maker maker(*world, *rule);
    try {
      maker.make();
    } catch (const Too_many &) {
      return hsr_fail(err, HSR_E_REFUSED,
                      "the BSP trees of %u faces would be too large",
                      world->n_faces);
    }
    return maker.fill(bsp) ? HSR_OK : hsr_fail_nomem(err);
  });
}

void hsr_bsp_free(struct hsr_bsp *bsp) {
  hsr_arena_free(&bsp->arena);
}
