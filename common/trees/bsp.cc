// SPDX-License-Identifier: GPL-3.0-or-later
// Source      as in bsp.h. A few tried planes are enough to find a good one: H.
//             Fuchs, G. Abram and E. Grant, "Near Real-Time Shaded Display of
//             Rigid Objects", SIGGRAPH 1983.
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
// Splitters   are planes of pieces. A few are tried, each with all pieces of
//             the group or with some. The price of a plane is the pieces that
//             it cuts, and those on its larger side.
// Loose       faces are found while the trees are made. The trees are then made
//             again without them.
// No stack    is as deep as a tree may be: the work that is left is in a list.
#include "common/trees/bsp.h"
#include "common/adapt/convex.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace {

using namespace hsr;

const int MOST_DEPTH = 20;
const double MOST_GROWTH = 16;

// Limits, beyond which it is of no use: pieces; questions about sides of
// planes.
const size_t MOST_PIECES = 1 << 22;
const uint64_t MOST_QUESTIONS = 2000000000;

// How many planes are tried for a group; with how many pieces each; and the
// price of a cut, in pieces on the larger side. A cut piece is one more in
// every picture; a deep tree costs only while it is made.
const size_t TRIED_PLANES = 12, WEIGHED_PIECES = 128;
const size_t PRICE_OF_CUT = 8;

// The most parts of a face that is not flat. Its parts keep all its corners, so
// more planes would cut each of them.
const uint32_t MOST_PARTS = 32;

const unsigned BOTH = FRONT | BEHIND;

using Group = std::vector<uint32_t>; // pieces, by ascending faces

struct Too_many {};

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
  Maker(const hsr_world &world, uint32_t most)
      : world_(world), most_(most), shapes_(world), parts_(world.n_faces) {
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
  Convex_pieces shapes_;
  uint64_t questions_ = 0;
  uint32_t n_new_loose_ = 0;
  size_t n_open_ = 0;           // pieces in open cubes
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
  bool make_cubes();
  bool is_loose(uint32_t f) const { return parts_[f] > MOST_PARTS; }
  void add_cube(const double centre[3], double half);
  void make_root(const std::vector<Convex> &pieces);
  uint32_t median(size_t axis, double at);
  bool helps(const Open_cube &open, const uint32_t planes[3], double &growth);
  bool divide(Open_cube &open);
  void hand_out(Convex &&piece, const uint32_t planes[3], size_t axis,
                size_t octant, std::vector<Convex> *into);
  void find_tight_boxes();

  // --- The tree of a leaf
  struct Open_group {
    Group group;
    uint32_t parent; // a node; HSR_NO_BSP: the leaf
    bool in_front;
    uint32_t depth;
  };
  std::vector<Open_group> open_groups_;
  std::vector<Convex> pieces_; // of the leaf
  struct Placed {              // a corner that is handed over
    Point at;
    double error;
    uint32_t corner;
  };
  std::vector<Placed> placed_;

  void make_leaf(uint32_t cube, std::vector<Convex> &&pieces);
  unsigned about(const Convex &piece, uint32_t plane);
  size_t price_of(const Group &group, uint32_t plane);
  uint32_t choose_plane(const Group &group);
  void link(const Open_group &open, uint32_t cube);
  void split(const Group &group, Open_group &front, Open_group &behind);
  void cut(uint32_t piece, uint32_t plane, Group &front, Group &behind);
  void place(const Convex &piece);
  void place_points(hsr_bsp_cube &leaf);
  bool may_part(const Convex &piece);
  void check_size(size_t n_more) const;
};

uint32_t size_of(size_t n) {
  if (n >= UINT32_MAX)
    throw std::bad_alloc();
  return uint32_t(n);
}

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
    n_open_ += into[octant].size();
    check_size(0);
    open_.push_back({child, open.depth + 1, growth, std::move(into[octant])});
  }
  return true;
}

void Maker::make() {
  while (!make_cubes())
    start_again();
  find_tight_boxes();
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
  for (uint32_t &parts : parts_)
    parts = parts > MOST_PARTS ? parts : 0;
}

// Makes all cubes. False if a face turned out to be loose.
bool Maker::make_cubes() {
  std::vector<Convex> all;
  for (uint32_t f = 0; f < world_.n_faces; f++) {
    Convex piece;
    if (!is_loose(f) && shapes_.make(f, piece))
      all.push_back(std::move(piece));
  }
  make_root(all);
  n_open_ = all.size();
  n_new_loose_ = 0;
  open_.push_back({0, 0, 1, std::move(all)});
  while (!open_.empty()) {
    Open_cube next = std::move(open_.back());
    open_.pop_back();
    n_open_ -= next.pieces.size();
    if (!divide(next))
      make_leaf(next.cube, std::move(next.pieces));
  }
  return !n_new_loose_;
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

// --- The tree of a leaf -----------------------------------------------------

void Maker::check_size(size_t n_more) const {
  if (made_.size() + n_open_ + n_more > MOST_PIECES ||
      questions_ > MOST_QUESTIONS)
    throw Too_many();
}

// Counts the division of a piece; false if its face is loose.
bool Maker::may_part(const Convex &piece) {
  if (shapes_.is_flat(piece))
    return true;
  n_new_loose_ += parts_[piece.from] == MOST_PARTS;
  return parts_[piece.from]++ < MOST_PARTS;
}

unsigned Maker::about(const Convex &piece, uint32_t plane) {
  questions_++;
  return shapes_.about(piece, plane);
}

// The price of dividing a group by a plane, judged by some of its pieces.
size_t Maker::price_of(const Group &group, uint32_t plane) {
  const size_t step = std::max<size_t>(1, group.size() / WEIGHED_PIECES);
  size_t n[4] = {0};
  for (size_t k = 0; k < group.size(); k += step) {
    const unsigned where = about(pieces_[group[k]], plane);
    n[where & UNSURE ? BOTH : where]++;
  }
  return PRICE_OF_CUT * n[BOTH] + std::max(n[FRONT], n[BEHIND]);
}

uint32_t Maker::choose_plane(const Group &group) {
  const size_t step = std::max<size_t>(1, group.size() / TRIED_PLANES);
  uint32_t best = pieces_[group[0]].plane;
  if (group.size() == 1)
    return best;
  size_t least = SIZE_MAX;
  for (size_t k = step / 2; k < group.size(); k += step) {
    const uint32_t plane = pieces_[group[k]].plane;
    const size_t price = price_of(group, plane);
    if (price < least) {
      least = price;
      best = plane;
    }
  }
  return best;
}

void Maker::cut(uint32_t piece, uint32_t plane, Group &front, Group &behind) {
  check_size(pieces_.size());
  if (!may_part(pieces_[piece]))
    return;
  Convex other = shapes_.part(pieces_[piece], plane, -1);
  pieces_[piece] = shapes_.part(pieces_[piece], plane, +1);
  front.push_back(piece);
  behind.push_back(uint32_t(pieces_.size()));
  pieces_.push_back(std::move(other));
}

void Maker::link(const Open_group &open, uint32_t cube) {
  const uint32_t node = size_of(nodes_.size());
  if (open.parent == HSR_NO_BSP)
    cubes_[cube].root = node;
  else if (open.in_front)
    nodes_[open.parent].front = node;
  else
    nodes_[open.parent].behind = node;
}

// Makes a node of the group's pieces that lie in the plane, and divides the
// rest into the groups on either side.
void Maker::split(const Group &group, Open_group &front, Open_group &behind) {
  const uint32_t plane = choose_plane(group), node = size_of(nodes_.size());
  const uint32_t first = size_of(made_.size());
  for (uint32_t p : group) {
    const unsigned where =
        pieces_[p].plane == plane ? 0 : about(pieces_[p], plane);
    if (pieces_[p].plane == plane) {
      place(pieces_[p]);
      pieces_[p] = {};
    } else if (where == BOTH || where & UNSURE)
      cut(p, plane, front.group, behind.group);
    else
      (where == BEHIND ? behind : front).group.push_back(p);
  }
  front.parent = behind.parent = node;
  nodes_.push_back(
      {plane, HSR_NO_BSP, HSR_NO_BSP, first, size_of(made_.size()) - first});
}

void Maker::make_leaf(uint32_t cube, std::vector<Convex> &&pieces) {
  const size_t first = made_.size();
  pieces_ = std::move(pieces);
  Group all(pieces_.size());
  for (uint32_t p = 0; p < all.size(); p++)
    all[p] = p;
  if (!all.empty())
    open_groups_.push_back({std::move(all), HSR_NO_BSP, false, 1});
  while (!open_groups_.empty()) {
    const Open_group next = std::move(open_groups_.back());
    open_groups_.pop_back();
    most_depth_ = std::max(most_depth_, next.depth);
    Open_group front = {{}, 0, true, next.depth + 1};
    Open_group behind = {{}, 0, false, next.depth + 1};
    link(next, cube);
    split(next.group, front, behind);
    if (!behind.group.empty())
      open_groups_.push_back(std::move(behind));
    if (!front.group.empty())
      open_groups_.push_back(std::move(front));
  }
  for (size_t k = first; k < made_.size(); k++)
    cubes_[cube].most_corners =
        std::max(cubes_[cube].most_corners, made_[k].n_corners);
  place_points(cubes_[cube]);
}

// --- The result -------------------------------------------------------------

// The side of a plane on which a piece was kept when the plane cut it.
int kept_side(const Convex &piece, uint32_t plane) {
  const auto cut =
      std::find_if(piece.cuts.begin(), piece.cuts.end(),
                   [&](const hsr_cut &c) { return c.face == plane; });
  return cut->side;
}

void Maker::place(const Convex &piece) {
  hsr_bsp_piece made = {piece.from, size_of(corners_.size()),
                        size_of(piece.corners.size()), size_of(cuts_.size()),
                        0};
  const auto side_of = [](int side) {
    return side > 0 ? HSR_BSP_FRONT : HSR_BSP_BEHIND;
  };
  for (const Corner &c : piece.corners) {
    placed_.push_back({c.at, c.error, size_of(corners_.size())});
    corners_.push_back(
        {0, c.a, c.b == NO_VERTEX ? side_of(kept_side(piece, c.a)) : c.b});
  }
  if (!shapes_.is_flat(piece)) {
    for (const hsr_cut &cut : piece.cuts)
      cuts_.push_back({0, cut.face, side_of(cut.side)});
    made.n_cuts = size_of(piece.cuts.size());
  }
  made_.push_back(made);
}

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
  out->level = HSR_NEW(arena, hsr_bsp_level, world_.mesh.n_planes);
  out->turned = HSR_NEW(arena, signed char, n);
  out->reach = HSR_NEW(arena, double, n);
  if (!out->face_of || !out->level || !out->turned || !out->reach)
    return false;
  for (uint32_t p = 0; p < world_.mesh.n_planes; p++) {
    const uint32_t f = shapes_.face_of(p);
    const Level &level = shapes_.level(p);
    out->face_of[p] = world_.pieces ? world_.pieces->first[f] : f;
    out->level[p] = {level.at, static_cast<signed char>(level.axis),
                     static_cast<signed char>(level.front)};
  }
  for (uint32_t f = 0; f < n; f++) {
    const uint32_t parent = hsr_world_parent(&world_, f);
    out->turned[f] = static_cast<signed char>(shapes_.turned(parent));
    out->reach[f] = shapes_.reach(parent);
  }
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
  return guarded(err, [&]() -> hsr_status {
    Maker maker(*world, rule->most);
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
