// SPDX-License-Identifier: GPL-3.0-or-later
// Making clusters, planes that separate them, and priorities within them.
//
// Source      Sutherland et al. 1974, "List-Priority Algorithms". There
//             clusters were split by hand; here they are split in the order in
//             which it costs least.
// Clusters    are the environment's own instances, where planes pass between
//             them. At first all pieces are one group. A group is divided by a
//             plane x, y or z = c between instances; or else by the plane of
//             one of its largest pieces, if that leaves instances on either
//             side and passes through few. A group that cannot be divided so is
//             a cluster.
// Groups      To give priorities, groups are taken one by one; the clusters
//             come first. A group stays a cluster if its priority graph has no
//             circuit. Else it is divided by a plane x, y or z = c between
//             pieces; or by a piece's own plane, chosen to cut few and to leave
//             about as many on either side.
// Division    A piece that the plane passes through is cut. All pieces that lie
//             in the plane go to one side.
// Priority    of oriented faces: common/scene/clusters.h. Two faces that each
//             reach to both sides of the other's plane are a circuit by
//             themselves; faces of one plane are not.
// End         A division leaves fewer faces, or parts of them, in each group,
//             and no piece is cut by a plane twice.
// Thick       A piece that is not certain to lie on one side of the plane of a
//             separator, or of another piece in its cluster, is in no cluster.
#include "common/scene/clusters.h"
#include "common/adapt/convex.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace {

using namespace hsr;

// Limits, beyond which it is of no use or takes too long: pieces; faces that
// are compared with one another; questions about sides of planes.
const size_t MOST_PIECES = 1000000, LARGEST_CLUSTER = 4096;
const uint64_t MOST_QUESTIONS = 400000000;

// How many planes are tried for a division; the price of a cut, in pieces.
const size_t TRIED_PLANES = 32, PRICE_OF_CUT = 5;

const size_t PROHIBITIVE = SIZE_MAX;

const unsigned BOTH = FRONT | BEHIND;

using Group = std::vector<uint32_t>; // pieces, by ascending faces

// --- The priority graph of a group ------------------------------------------

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

  // Repeatedly takes out nodes that no other has priority over; or, if
  // `lowest`, that have priority over no other. Returns them in that order.
  std::vector<uint32_t> take_out(bool lowest) {
    const uint32_t n = uint32_t(nodes_.size());
    std::vector<uint32_t> degree(n), order;
    taken_.resize(n);
    const auto precedes = [&](uint32_t a, uint32_t b) {
      return lowest ? can_hide(b, a) : can_hide(a, b);
    };
    for (uint32_t a = 0; a < n; a++)
      for (uint32_t b = 0; b < n && !taken_[a]; b++)
        degree[b] += !taken_[b] && precedes(a, b);
    for (uint32_t a = 0; a < n; a++)
      if (!taken_[a] && !degree[a])
        order.push_back(a);
    for (uint32_t a : order)
      taken_[a] = true;
    for (size_t k = 0; k < order.size(); k++)
      for (uint32_t b = 0; b < n; b++)
        if (!taken_[b] && precedes(order[k], b) && !--degree[b]) {
          taken_[b] = true;
          order.push_back(b);
        }
    return order;
  }

  size_t size() const { return nodes_.size(); }
  const Oriented &node(uint32_t number) const { return nodes_[number]; }

  // The pieces of the nodes that are left: they lie on circuits, or between
  // two.
  Group left_over() const {
    Group left;
    for (size_t a = 0; a < nodes_.size(); a++)
      if (!taken_[a])
        left.push_back(group_[nodes_[a].member]);
    return left;
  }

  // Whether member k is not certain to be on one side of another's plane.
  bool is_thick(size_t k) {
    for (size_t l = 0; l < group_.size(); l++)
      if (l != k && about(k, l) & UNSURE)
        return true;
    return false;
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

  // Whether a can hide b from some viewpoint.
  bool can_hide(uint32_t a, uint32_t b) {
    const Oriented &f = nodes_[a], &g = nodes_[b];
    if (own_plane_[f.member] == own_plane_[g.member])
      return f.side == g.side && pieces_[group_[f.member]].parent <
                                     pieces_[group_[g.member]].parent;
    return (about(g.member, f.member) & (f.side > 0 ? BEHIND : FRONT)) &&
           (about(f.member, g.member) & (g.side > 0 ? FRONT : BEHIND));
  }
};

// --- Planes through gaps ----------------------------------------------------

// The extent of some pieces along an axis. flat_lo, flat_hi: if some pieces lie
// at that end, in a plane across the axis, the sides from which these are seen.
struct Extent {
  double lo, hi;
  unsigned flat_lo, flat_hi;
  size_t n_pieces;
  uint32_t owner; // the pieces' instance, or the piece

  void add(const Extent &other) {
    flat_lo =
        (lo <= other.lo ? flat_lo : 0) | (other.lo <= lo ? other.flat_lo : 0);
    flat_hi =
        (hi >= other.hi ? flat_hi : 0) | (other.hi >= hi ? other.flat_hi : 0);
    lo = std::fmin(lo, other.lo);
    hi = std::fmax(hi, other.hi);
    n_pieces += other.n_pieces;
  }
};

// The sides of its plane from which a face across an axis is seen.
unsigned seen_from(const hsr_world &world, uint32_t f, size_t axis) {
  const double *const n[3] = {world.mesh.nx, world.mesh.ny, world.mesh.nz};
  if (!world.mesh.one_sided[f] ||
      !(std::fabs(n[axis][f]) > world.mesh.n_error[f]))
    return BOTH;
  return n[axis][f] > 0 ? FRONT : BEHIND;
}

Extent extent_of(const hsr_world &world, const Convex &piece, size_t axis,
                 uint32_t owner) {
  double lo = INFINITY, hi = -INFINITY;
  for (const Corner &c : piece.corners) {
    const double x = c.at[axis];
    const bool exact = c.error == 0;
    lo = std::fmin(lo, exact ? x : std::nextafter(x - c.error, -INFINITY));
    hi = std::fmax(hi, exact ? x : std::nextafter(x + c.error, INFINITY));
  }
  const unsigned flat = lo == hi ? seen_from(world, piece.from, axis) : 0;
  return {lo, hi, flat, flat, 1, owner};
}

// A plane axis = at, and the owners behind it. score: the number of pieces on
// the smaller side.
struct Gap {
  size_t axis = 0, score = 0;
  double at = 0;
  std::vector<uint32_t> behind;
};

// The gap among these extents that divides them best, if better than `best`.
void find_gap(std::vector<Extent> &extents, size_t axis, size_t n_pieces,
              Gap &best) {
  std::sort(
      extents.begin(), extents.end(), [](const Extent &a, const Extent &b) {
        return std::tie(a.lo, a.hi, a.owner) < std::tie(b.lo, b.hi, b.owner);
      });
  if (extents.empty())
    return;
  size_t best_end = 0;
  Extent behind = extents[0];
  for (size_t k = 1; k < extents.size(); k++) {
    const double next = extents[k].lo;
    unsigned flat = 0; // what lies in the plane, on the other side
    for (size_t l = k;
         behind.flat_hi && l < extents.size() && extents[l].lo == behind.hi;
         l++)
      flat |= extents[l].flat_lo;
    const size_t score = std::min(behind.n_pieces, n_pieces - behind.n_pieces);
    if (behind.hi <= next && !(behind.flat_hi & flat) && score > best.score) {
      best_end = k;
      best.axis = axis;
      best.score = score;
      best.at = behind.hi + (next - behind.hi) / 2;
    }
    behind.add(extents[k]);
  }
  if (best_end) {
    best.behind.clear();
    for (size_t k = 0; k < best_end; k++)
      best.behind.push_back(extents[k].owner);
    std::sort(best.behind.begin(), best.behind.end());
  }
}

// --- The tree ---------------------------------------------------------------

// Where a group's separator or cluster will hang in the tree.
struct Place {
  uint32_t separator; // HSR_IS_CLUSTER: at the root
  bool in_front;
};

class Tree {
public:
  explicit Tree(const hsr_world &world) : world_(world), shapes_(world) {}
  void make_clusters();
  void give_priorities();
  hsr_status make(hsr_world *out, hsr_error *err) const;

private:
  const hsr_world &world_;
  const Convex_pieces shapes_;
  std::vector<Convex> pieces_;
  std::vector<hsr_separator> separators_; // their faces are planes' first ones
  std::vector<Group> clusters_;           // as hsr_clusters.order, of pieces
  Group thick_;                           // likewise
  uint32_t root_ = HSR_IS_CLUSTER;
  uint64_t pair_tests_ = 0, questions_ = 0;

  struct Open {
    Group group;
    Place place;
  };
  std::vector<Open> open_;

  void put(Place place, uint32_t what);
  void put_cluster(Place place, Group &&oriented);
  void separate(const hsr_separator &separator, Place place, Group &&front,
                Group &&behind);
  bool split_at_gap(const Group &group, Place place, bool between_instances);
  bool order(const Group &group, Place place, Group &circuits);
  size_t price_of(const Group &group, uint32_t plane);
  uint32_t choose_plane(const Group &group, const Group &candidates);
  void split_by_plane(const Group &group, Place place, uint32_t plane);
  void add_oriented(uint32_t piece, Group &to) const;
  void cut(uint32_t piece, uint32_t plane, Group &front, Group &behind);
  size_t price_between(const Group &group, uint32_t plane);
  bool find_plane(const Group &group, uint32_t &plane);
  void add_piece(uint32_t f, Group &to);
  void start_at_clusters();
  void list_pieces(List &list, std::vector<uint32_t> &number) const;
  bool fill(hsr_world *out, const std::vector<uint32_t> &number) const;
};

void Tree::put(Place place, uint32_t what) {
  if (place.separator == HSR_IS_CLUSTER)
    root_ = what;
  else if (place.in_front)
    separators_[place.separator].front = what;
  else
    separators_[place.separator].behind = what;
}

void Tree::put_cluster(Place place, Group &&oriented) {
  put(place, HSR_IS_CLUSTER | uint32_t(clusters_.size()));
  clusters_.push_back(std::move(oriented));
}

void Tree::separate(const hsr_separator &separator, Place place, Group &&front,
                    Group &&behind) {
  const uint32_t number = uint32_t(separators_.size());
  put(place, number);
  separators_.push_back(separator);
  open_.push_back({std::move(behind), {number, false}});
  open_.push_back({std::move(front), {number, true}});
}

bool Tree::split_at_gap(const Group &group, Place place,
                        bool between_instances) {
  const auto owner = [&](uint32_t p) {
    return between_instances ? world_.mesh.instance[pieces_[p].from] : p;
  };
  Gap gap;
  std::vector<Extent> extents;
  for (size_t axis = 0; axis < 3; axis++) {
    extents.clear();
    for (uint32_t p : group) {
      const Extent extent = extent_of(world_, pieces_[p], axis, owner(p));
      if (extents.empty() || extents.back().owner != extent.owner)
        extents.push_back(extent);
      else
        extents.back().add(extent);
    }
    questions_ += group.size();
    find_gap(extents, axis, group.size(), gap);
  }
  if (!gap.score)
    return false;
  Group front, behind;
  for (uint32_t p : group)
    (std::binary_search(gap.behind.begin(), gap.behind.end(), owner(p)) ? behind
                                                                        : front)
        .push_back(p);
  separate({HSR_NO_FACE, int(gap.axis), gap.at, 0, 0}, place, std::move(front),
           std::move(behind));
  return true;
}

// Makes a cluster of the group, with priorities. False if its graph has
// circuits; `circuits` are then the pieces to blame.
bool Tree::order(const Group &group, Place place, Group &circuits) {
  circuits = group;
  if (group.size() > LARGEST_CLUSTER)
    return false;
  Priority_graph graph(world_, shapes_, pieces_, group, questions_);
  if (!graph.compare(pair_tests_))
    return false;
  const std::vector<uint32_t> order = graph.take_out(false);
  if (order.size() < graph.size()) {
    graph.take_out(true);
    circuits = graph.left_over();
    return false;
  }
  Group cluster;
  for (uint32_t number : order) {
    const Oriented &node = graph.node(number);
    (graph.is_thick(node.member) ? thick_ : cluster)
        .push_back(2 * group[node.member] + !node.from_front);
  }
  put_cluster(place, std::move(cluster));
  return true;
}

// The price of dividing a group by a plane; PROHIBITIVE if all of it lies in
// the plane.
size_t Tree::price_of(const Group &group, uint32_t plane) {
  size_t n[4] = {0};
  for (uint32_t p : group) {
    const unsigned about = shapes_.about(pieces_[p], plane);
    n[about & UNSURE ? BOTH : about]++;
  }
  questions_ += group.size();
  if (n[0] == group.size())
    return PROHIBITIVE;
  const size_t fewer = std::min(n[FRONT], n[BEHIND]) + n[0];
  const size_t more = std::max(n[FRONT], n[BEHIND]);
  return PRICE_OF_CUT * n[BOTH] + std::max(fewer, more);
}

// The plane that divides the group best, among the planes of some candidates;
// or of all candidates, if none of those divides it.
uint32_t Tree::choose_plane(const Group &group, const Group &candidates) {
  std::vector<uint32_t> planes;
  for (uint32_t p : candidates)
    planes.push_back(pieces_[p].plane);
  std::sort(planes.begin(), planes.end());
  planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
  size_t step = std::max<size_t>(1, planes.size() / TRIED_PLANES);
  for (;; step = 1) {
    size_t least = PROHIBITIVE;
    uint32_t best = 0;
    for (size_t k = step / 2; k < planes.size(); k += step) {
      const size_t price = price_of(group, planes[k]);
      if (price < least) {
        least = price;
        best = planes[k];
      }
    }
    if (least < PROHIBITIVE)
      return best;
    if (step == 1)
      throw Not_adapted{HSR_LS, pieces_[group[0]].parent,
                        "lies in one plane with too many others"};
  }
}

// The price of dividing a group of instances by a plane; PROHIBITIVE unless it
// leaves whole instances on either side.
size_t Tree::price_between(const Group &group, uint32_t plane) {
  size_t n[4] = {0};
  for (size_t k = 0; k < group.size();) {
    const uint32_t instance = world_.mesh.instance[pieces_[group[k]].from];
    unsigned about = 0;
    for (; k < group.size() &&
           world_.mesh.instance[pieces_[group[k]].from] == instance;
         k++)
      about |= shapes_.about(pieces_[group[k]], plane);
    n[about & UNSURE ? BOTH : about]++;
  }
  questions_ += group.size();
  return n[FRONT] && n[BEHIND]
             ? PRICE_OF_CUT * n[BOTH] + std::max(n[FRONT], n[BEHIND])
             : PROHIBITIVE;
}

// Finds the plane that divides a group of instances best, among the planes of
// its largest pieces. False if none does.
bool Tree::find_plane(const Group &group, uint32_t &plane) {
  if (questions_ > MOST_QUESTIONS)
    return false;
  std::vector<std::pair<double, uint32_t>> largest;
  for (uint32_t p : group) {
    double size = 0;
    for (size_t axis = 0; axis < 3; axis++) {
      const Extent extent = extent_of(world_, pieces_[p], axis, p);
      size = std::fmax(size, extent.hi - extent.lo);
    }
    largest.push_back({-size, pieces_[p].plane});
  }
  const size_t n = std::min(largest.size(), TRIED_PLANES);
  std::partial_sort(largest.begin(), largest.begin() + std::ptrdiff_t(n),
                    largest.end());
  size_t least = PROHIBITIVE;
  for (size_t k = 0; k < n; k++) {
    const size_t price = price_between(group, largest[k].second);
    if (price < least) {
      least = price;
      plane = largest[k].second;
    }
  }
  return least < PROHIBITIVE;
}

// Appends a piece as seen from its front, and from behind unless it is
// one-sided.
void Tree::add_oriented(uint32_t piece, Group &to) const {
  to.push_back(2 * piece);
  if (!world_.mesh.one_sided[pieces_[piece].from])
    to.push_back(2 * piece + 1);
}

void Tree::cut(uint32_t piece, uint32_t plane, Group &front, Group &behind) {
  if (pieces_.size() >= MOST_PIECES)
    throw Not_adapted{HSR_LS, pieces_[piece].parent,
                      "is one of too many that must be divided"};
  Convex other = shapes_.part(pieces_[piece], plane, -1);
  pieces_[piece] = shapes_.part(pieces_[piece], plane, +1);
  front.push_back(piece);
  behind.push_back(uint32_t(pieces_.size()));
  pieces_.push_back(std::move(other));
}

void Tree::split_by_plane(const Group &group, Place place, uint32_t plane) {
  std::vector<unsigned> about;
  size_t n_front = 0, n_behind = 0;
  for (uint32_t p : group) {
    about.push_back(shapes_.about(pieces_[p], plane));
    n_front += (about.back() & FRONT) != 0;
    n_behind += (about.back() & BEHIND) != 0;
  }
  // What lies in the plane goes to the smaller side, or is one itself.
  const bool on_is_front = !n_front || (n_behind && n_front < n_behind);
  Group front, behind;
  for (size_t k = 0; k < group.size(); k++) {
    const uint32_t p = group[k];
    if (about[k] & UNSURE)
      add_oriented(p, thick_);
    else if (about[k] == BOTH)
      cut(p, plane, front, behind);
    else
      (about[k] == FRONT || (!about[k] && on_is_front) ? front : behind)
          .push_back(p);
  }
  separate({shapes_.face_of(plane), 0, 0, 0, 0}, place, std::move(front),
           std::move(behind));
}

// Appends face f as a piece, if it has any point.
void Tree::add_piece(uint32_t f, Group &to) {
  Convex piece;
  if (pieces_.size() >= MOST_PIECES)
    throw Not_adapted{HSR_LS, hsr_world_parent(&world_, f),
                      "is one of too many"};
  if (!shapes_.make(f, piece))
    return;
  to.push_back(uint32_t(pieces_.size()));
  pieces_.push_back(std::move(piece));
}

void Tree::make_clusters() {
  Group all;
  for (uint32_t f = 0; f < world_.n_faces; f++)
    add_piece(f, all);
  open_.push_back({std::move(all), {HSR_IS_CLUSTER, false}});
  while (!open_.empty()) {
    const Open next = std::move(open_.back());
    open_.pop_back();
    uint32_t plane;
    if (split_at_gap(next.group, next.place, true))
      continue;
    if (find_plane(next.group, plane)) {
      split_by_plane(next.group, next.place, plane);
      continue;
    }
    Group oriented;
    for (uint32_t p : next.group)
      add_oriented(p, oriented);
    put_cluster(next.place, std::move(oriented));
  }
}

// Begins with the tree of the world's clusters; all of these are open groups.
void Tree::start_at_clusters() {
  const hsr_clusters &given = *world_.clusters;
  const auto take = [&](const uint32_t *from, const uint32_t *to) {
    Group group;
    for (; from < to; from++)
      if (*from % 2 == 0)
        add_piece(*from / 2, group);
    return group;
  };
  const auto open = [&](uint32_t what, Place place) {
    const uint32_t c = what & ~HSR_IS_CLUSTER;
    if (what & HSR_IS_CLUSTER)
      open_.push_back(
          {take(given.order + given.start[c], given.order + given.start[c + 1]),
           place});
  };
  for (uint32_t p : take(given.thick, given.thick + given.n_thick))
    add_oriented(p, thick_);
  separators_.assign(given.separator, given.separator + given.n_separators);
  for (hsr_separator &separator : separators_)
    if (separator.face != HSR_NO_FACE)
      separator.face = hsr_world_parent(&world_, separator.face);
  root_ = given.root;
  open(given.root, {HSR_IS_CLUSTER, false});
  for (uint32_t s = 0; s < given.n_separators; s++) {
    open(given.separator[s].behind, {s, false});
    open(given.separator[s].front, {s, true});
  }
}

void Tree::give_priorities() {
  start_at_clusters();
  while (!open_.empty()) {
    const Open next = std::move(open_.back());
    const Group &group = next.group;
    open_.pop_back();
    Group circuits;
    if (!group.empty() && questions_ > MOST_QUESTIONS)
      throw Not_adapted{HSR_LS, pieces_[group[0]].parent,
                        "is one of too many that are hard to separate"};
    if (!order(group, next.place, circuits) &&
        !split_at_gap(group, next.place, false))
      split_by_plane(group, next.place, choose_plane(group, circuits));
  }
}

// --- The new world ----------------------------------------------------------

// Lists the pieces by their faces. number[p] is set to the new face that p is.
void Tree::list_pieces(List &list, std::vector<uint32_t> &number) const {
  std::vector<uint32_t> order(pieces_.size());
  for (uint32_t p = 0; p < order.size(); p++)
    order[p] = p;
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    return pieces_[a].from < pieces_[b].from;
  });
  number.resize(pieces_.size());
  size_t k = 0, listed = 0;
  for (uint32_t f = 0; f < world_.n_faces; f++) {
    const uint32_t parent = hsr_world_parent(&world_, f);
    if (!f || hsr_world_parent(&world_, f - 1) != parent)
      listed = list.size();
    for (; k < order.size() && pieces_[order[k]].from == f; k++) {
      bool with_outline;
      const Piece piece = shapes_.finished(pieces_[order[k]], with_outline);
      number[order[k]] = uint32_t(list.size());
      list.add(piece, with_outline);
    }
    // A face without any point must still have a piece.
    const bool last =
        f + 1 == world_.n_faces || hsr_world_parent(&world_, f + 1) != parent;
    if (last && list.size() == listed)
      list.add(piece_of(world_, f), false);
  }
}

bool Tree::fill(hsr_world *out, const std::vector<uint32_t> &number) const {
  hsr_arena *arena = &out->arena;
  size_t n_oriented = 0;
  for (const Group &cluster : clusters_)
    n_oriented += cluster.size();
  hsr_clusters *c = HSR_NEW_ZEROED(arena, hsr_clusters, 1);
  if (!c)
    return false;
  c->n_clusters = uint32_t(clusters_.size());
  c->n_separators = uint32_t(separators_.size());
  c->separator = HSR_NEW(arena, hsr_separator, separators_.size());
  c->root = root_;
  c->start = HSR_NEW(arena, uint32_t, clusters_.size() + 1);
  c->order = HSR_NEW(arena, uint32_t, n_oriented);
  c->thick = HSR_NEW(arena, uint32_t, thick_.size());
  c->n_thick = uint32_t(thick_.size());
  c->reach = HSR_NEW(arena, double, out->n_faces);
  c->pair_tests = pair_tests_;
  if (!c->separator || !c->start || !c->order || !c->thick || !c->reach)
    return false;

  std::copy(separators_.begin(), separators_.end(), c->separator);
  for (uint32_t s = 0; s < c->n_separators; s++)
    if (c->separator[s].face != HSR_NO_FACE)
      c->separator[s].face = out->pieces->first[c->separator[s].face];
  const auto renumber = [&](uint32_t oriented) {
    return 2 * number[oriented / 2] + oriented % 2;
  };
  uint32_t *order = c->order;
  for (uint32_t k = 0; k < c->n_clusters; k++) {
    c->start[k] = uint32_t(order - c->order);
    order = std::transform(clusters_[k].begin(), clusters_[k].end(), order,
                           renumber);
  }
  c->start[c->n_clusters] = uint32_t(order - c->order);
  std::transform(thick_.begin(), thick_.end(), c->thick, renumber);
  for (uint32_t f = 0; f < out->n_faces; f++)
    c->reach[f] = shapes_.reach(out->pieces->parent[f]);
  out->clusters = c;
  return true;
}

hsr_status Tree::make(hsr_world *out, hsr_error *err) const {
  List list;
  std::vector<uint32_t> number;
  list_pieces(list, number);
  const hsr_status status = list.make(out, whole_of(world_), err);
  if (status)
    return status;
  return fill(out, number) ? HSR_OK : hsr_fail_nomem(err);
}

} // namespace

hsr_status hsr::cluster(const hsr_world *in, hsr_world *out, bool *changed,
                        hsr_error *err) {
  return guarded(err, [&]() -> hsr_status {
    *changed = false;
    Tree tree(*in);
    tree.make_clusters();
    *changed = true;
    return tree.make(out, err);
  });
}

hsr_status hsr::give_priorities(const hsr_world *in, hsr_world *out,
                                bool *changed, hsr_error *err) {
  return guarded(err, [&]() -> hsr_status {
    *changed = false;
    Tree tree(*in);
    tree.give_priorities();
    *changed = true;
    return tree.make(out, err);
  });
}
