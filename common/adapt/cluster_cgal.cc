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
// Frames      priorities may be kept from frame to frame: kept_priorities.h.
// Thick       A piece that is not certain to lie on one side of the plane of a
//             separator, or of another piece in its cluster, is in no cluster.
#include "common/scene/clusters.h"
#include "common/adapt/kept_priorities.h"

#include <algorithm>
#include <cmath>
#include <optional>
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
  // `kept`: what is kept from frame to frame, or NULL.
  void give_priorities(hsr_kept_priorities *kept);
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
  std::optional<Kept_frame> kept_;

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
  Ranking rank(const Group &group);
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

// Compares the faces of a group.
Ranking Tree::rank(const Group &group) {
  Priority_graph graph(world_, shapes_, pieces_, group, questions_);
  Ranking ranking;
  for (uint32_t k = 0; k < group.size(); k++)
    ranking.circuits.push_back(k);
  const bool compared = graph.compare(pair_tests_);
  const std::vector<uint32_t> order =
      compared ? graph.take_out(false) : std::vector<uint32_t>();
  ranking.has_order = compared && order.size() == graph.size();
  for (uint32_t number : order) {
    const Oriented &node = graph.node(number);
    if (ranking.has_order)
      (graph.is_thick(node.member) ? ranking.thick : ranking.order)
          .push_back(2 * node.member + !node.from_front);
  }
  if (compared && !ranking.has_order) {
    graph.take_out(true);
    ranking.circuits = graph.left_over();
  }
  if (kept_)
    kept_->keep(group, graph, ranking);
  return ranking;
}

// Makes a cluster of the group, with priorities. False if its graph has
// circuits; `circuits` are then the pieces to blame.
bool Tree::order(const Group &group, Place place, Group &circuits) {
  circuits = group;
  if (group.size() > LARGEST_CLUSTER)
    return false;
  Ranking ranking;
  if (!kept_ || !kept_->recall(group, ranking))
    ranking = rank(group);
  if (!ranking.has_order) {
    circuits.clear();
    for (uint32_t member : ranking.circuits)
      circuits.push_back(group[member]);
    return false;
  }
  Group cluster;
  for (uint32_t k : ranking.order)
    cluster.push_back(2 * group[k / 2] + k % 2);
  for (uint32_t k : ranking.thick)
    thick_.push_back(2 * group[k / 2] + k % 2);
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

void Tree::give_priorities(hsr_kept_priorities *kept) {
  start_at_clusters();
  if (kept)
    kept_.emplace(*kept, world_, shapes_, pieces_);
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
  if (kept_)
    kept_->end();
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
  c->n_kept = kept_ ? kept_->n_kept() : 0;
  c->close_tests = kept_ ? kept_->n_close() : 0;
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
  return keep_priorities(in, nullptr, out, changed, err);
}

hsr_status hsr::keep_priorities(const hsr_world *in, hsr_kept_priorities *kept,
                                hsr_world *out, bool *changed, hsr_error *err) {
  return guarded(err, [&]() -> hsr_status {
    *changed = false;
    Tree tree(*in);
    tree.give_priorities(kept);
    *changed = true;
    return tree.make(out, err);
  });
}
