// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/adapt/kept_priorities.h"
#include "common/base/exact.h"

#include <cmath>
#include <cstring>
#include <iterator>
#include <new>

namespace {

using namespace hsr;

// So far may a vertex be off, as a part of the size of its group.
const double SLACK = 0x1p-40;

// So many frames is a group kept that is not of use.
const uint64_t MOST_IDLE = 16;

// --- Triangles of an object -------------------------------------------------

struct Triangle {
  const double *corner[3];
};

bool same_point(const double *p, const double *q) {
  return p[0] == q[0] && p[1] == q[1] && p[2] == q[2];
}

bool has_corner(const Triangle &t, const double *p) {
  return same_point(t.corner[0], p) || same_point(t.corner[1], p) ||
         same_point(t.corner[2], p);
}

// Whether an edge of one runs against an edge of the other.
bool share_edge(const Triangle &s, const Triangle &t) {
  for (size_t k = 0; k < 3; k++)
    for (size_t l = 0; l < 3; l++)
      if (same_point(s.corner[k], t.corner[(l + 1) % 3]) &&
          same_point(s.corner[(k + 1) % 3], t.corner[l]))
        return true;
  return false;
}

double size_of(const std::vector<Triangle> &triangles) {
  double size = 0;
  for (size_t axis = 0; axis < 3; axis++) {
    double lo = INFINITY, hi = -INFINITY;
    for (const Triangle &t : triangles)
      for (const double *p : t.corner) {
        lo = std::fmin(lo, p[axis]);
        hi = std::fmax(hi, p[axis]);
      }
    size = std::fmax(size, std::nextafter(hi - lo, INFINITY));
  }
  return size;
}

// FRONT, BEHIND: a corner of s is steadily on that side of the plane of t. CLOSE:
// one may be on either side. EDGE: they share an edge.
const unsigned CLOSE = 4, EDGE = 8;

unsigned steadily_about(const Triangle &s, const Triangle &t, double least) {
  const auto vector = [](const double *p) {
    return Vector3<Interval>(p[0], p[1], p[2]);
  };
  const Vector3<Interval> origin = vector(t.corner[0]);
  const Vector3<Interval> normal = CGAL::cross_product(
      vector(t.corner[1]) - origin, vector(t.corner[2]) - origin);
  unsigned where = share_edge(s, t) ? EDGE : 0;
  for (const double *p : s.corner) {
    if (has_corner(t, p))
      continue;
    const Interval height = normal * (vector(p) - origin);
    where |= height.inf() > least    ? FRONT
             : height.sup() < -least ? unsigned(BEHIND)
                                     : CLOSE;
  }
  return where;
}

// Where each triangle lies about the plane of each other one.
std::vector<uint8_t> all_steadily_about(const std::vector<Triangle> &triangles,
                                        double size) {
  const size_t n = triangles.size();
  std::vector<uint8_t> about(n * n);
  CGAL::Protect_FPU_rounding<true> upwards;
  const double least = 37 * (SLACK * size) * (size * size);
  for (size_t k = 0; k < n; k++)
    for (size_t l = 0; l < n; l++)
      if (k != l)
        about[k * n + l] =
            uint8_t(steadily_about(triangles[k], triangles[l], least));
  return about;
}

// --- Relations of a group ---------------------------------------------------

using Own = hsr_kept_priorities::Own;

// Whether a may hide b, or certainly hides it from somewhere, wherever they are
// placed.
bool may_hide(const Own &own, uint32_t a, uint32_t b, unsigned close = CLOSE) {
  const size_t n = size_t(std::sqrt(double(own.about.size())) + 0.5);
  const unsigned b_about = own.about[b / 2 * n + a / 2],
                 a_about = own.about[a / 2 * n + b / 2];
  return a / 2 != b / 2 && !(a % 2 == b % 2 && a_about & EDGE) &&
         b_about & (close | (a % 2 ? FRONT : BEHIND)) &&
         a_about & (close | (b % 2 ? BEHIND : FRONT));
}

bool surely_hides(const Own &own, uint32_t a, uint32_t b) {
  return may_hide(own, a, b, 0);
}

void list_close(Own &own) {
  own.close.clear();
  for (size_t k = 0; k < own.order.size(); k++)
    for (size_t l = 0; l < k; l++)
      if (may_hide(own, own.order[k], own.order[l]))
        own.close.push_back({own.order[k], own.order[l]});
}

// Sorts a group. `hides` compares two that are close. Of equally right orders
// one is preferred in which few close pairs need to be compared again. Returns
// false if there is a circuit; `circuits` are then the members to blame.
template <class Hides>
bool sort(Own &own, const Hides &hides, std::vector<uint32_t> &circuits) {
  const auto node = [&](uint32_t k) { return own.nodes[k]; };
  for (const bool steady : {true, false}) {
    std::vector<bool> taken(own.nodes.size());
    const auto precedes = [&](uint32_t k, uint32_t l) {
      const uint32_t a = node(k), b = node(l);
      return surely_hides(own, a, b) ||
             (may_hide(own, a, b) &&
              ((steady && !may_hide(own, b, a)) || hides(a, b)));
    };
    own.order.clear();
    for (uint32_t k : take_out(taken, false, precedes))
      own.order.push_back(node(k));
    if (own.order.size() == own.nodes.size())
      break;
    own.order.clear();
    circuits.clear();
    take_out(taken, true, precedes);
    for (uint32_t k = 0; k < own.nodes.size(); k++)
      if (!taken[k])
        circuits.push_back(node(k) / 2);
  }
  list_close(own);
  return own.nodes.empty() || !own.order.empty();
}

// --- Places -----------------------------------------------------------------

// A bound of the greatest sum of a row of |1 / m|; infinite unless the
// determinant is positive.
double inverse_of(const double m[12]) {
  const auto at = [&](size_t row, size_t column) {
    return Interval(m[4 * (row % 3) + column % 3]);
  };
  const auto minor = [&](size_t row, size_t column) {
    return at(row + 1, column + 1) * at(row + 2, column + 2) -
           at(row + 1, column + 2) * at(row + 2, column + 1);
  };
  Interval determinant = 0, largest = 0;
  for (size_t k = 0; k < 3; k++)
    determinant += at(0, k) * minor(0, k);
  if (!(determinant.inf() > 0))
    return INFINITY;
  for (size_t k = 0; k < 3; k++)
    largest =
        CGAL::max(largest, CGAL::abs(minor(0, k)) + CGAL::abs(minor(1, k)) +
                               CGAL::abs(minor(2, k)));
  return (largest / determinant).sup();
}

// A bound of the rounding error of a coordinate of a placed vertex.
double error_of(const double m[12], const double p[3], const double placed[3]) {
  double error = 0;
  for (size_t row = 0; row < 3; row++, m += 4) {
    const Interval exact = Interval(m[0]) * p[0] + Interval(m[1]) * p[1] +
                           Interval(m[2]) * p[2] + m[3];
    const Interval off = CGAL::abs(exact - placed[row]);
    error = std::fmax(error, off.sup());
  }
  return error;
}

const double *place_of(const hsr_world &whole, uint32_t instance) {
  return whole.roster.scene->instances[instance].m;
}

const hsr_object &object_of(const hsr_world &whole, uint32_t instance) {
  const hsr_scene *scene = whole.roster.scene;
  return scene->objects[scene->instances[instance].object];
}

} // namespace

namespace hsr {

Kept_frame::Kept_frame(hsr_kept_priorities &kept, const hsr_world &world,
                       const Convex_pieces &shapes,
                       const std::vector<Convex> &pieces)
    : kept_(kept), world_(world), whole_(whole_of(world)), shapes_(shapes),
      pieces_(pieces) {
  const hsr_scene *scene = whole_.roster.scene;
  const size_t n = scene->n_instances;
  if (kept_.n_faces != whole_.n_faces || kept_.places.size() != 12 * n)
    kept_ = hsr_kept_priorities();
  slack_.assign(n, -1);
  moved_.assign(n, true);
  for (uint32_t i = 0; i < n && !kept_.places.empty(); i++)
    moved_[i] = std::memcmp(&kept_.places[12 * size_t(i)], place_of(whole_, i),
                            12 * sizeof(double)) != 0;
}

void Kept_frame::end() {
  for (auto at = kept_.own.begin(); at != kept_.own.end();)
    at = kept_.frame - at->second.used > MOST_IDLE ? kept_.own.erase(at)
                                                   : std::next(at);
  kept_.frame++;
  kept_.last = std::move(kept_.now);
  kept_.now.clear();
  kept_.places.clear();
  for (uint32_t i = 0; i < slack_.size(); i++)
    kept_.places.insert(kept_.places.end(), place_of(whole_, i),
                        place_of(whole_, i) + 12);
  kept_.n_faces = whole_.n_faces;
}

// --- Keys -------------------------------------------------------------------

// The pieces, in the numbers of the scene laid out.
Key Kept_frame::key_of(const Group &group) const {
  Key key;
  for (uint32_t p : group) {
    const Convex &piece = pieces_[p];
    const uint32_t *from = world_.mesh.vertex + world_.mesh.start[piece.from];
    const uint32_t n = hsr_face_size(&world_, piece.from);
    key.push_back(piece.parent);
    key.push_back(n);
    key.insert(key.end(), from, from + n);
    key.push_back(uint32_t(piece.cuts.size()));
    for (const hsr_cut &cut : piece.cuts) {
      key.push_back(shapes_.face_of(cut.face));
      key.push_back(uint32_t(cut.side > 0));
    }
  }
  return key;
}

// The object, and its faces.
Key Kept_frame::own_key_of(const Group &group) const {
  const uint32_t instance = instance_of(pieces_[group[0]].parent);
  Key key = {whole_.roster.scene->instances[instance].object};
  for (uint32_t p : group)
    key.push_back(pieces_[p].parent - whole_.roster.first[instance]);
  return key;
}

// Whether these are whole triangles of one instance, whose object moves.
bool Kept_frame::may_move(const Group &group) const {
  const uint32_t instance = instance_of(pieces_[group[0]].parent);
  bool may = object_of(whole_, instance).moves;
  for (size_t k = 0; k < group.size() && may; k++) {
    const Convex &piece = pieces_[group[k]];
    may = instance_of(piece.parent) == instance && piece.cuts.empty() &&
          piece.corners.size() == 3;
  }
  return may;
}

bool Kept_frame::has_moved(const Group &group) const {
  for (uint32_t p : group) {
    if (moved_[instance_of(pieces_[p].parent)])
      return true;
    for (const hsr_cut &cut : pieces_[p].cuts)
      if (moved_[instance_of(shapes_.face_of(cut.face))])
        return true;
  }
  return false;
}

// --- What is known ----------------------------------------------------------

// How far the vertices of an instance are off, in the units of its object.
double Kept_frame::slack_of(uint32_t instance) {
  if (slack_[instance] >= 0)
    return slack_[instance];
  const hsr_object &object = object_of(whole_, instance);
  const double *m = place_of(whole_, instance);
  std::vector<double> placed(3 * size_t(object.n_vertices));
  for (size_t v = 0; v < object.n_vertices; v++)
    hsr_instance_vertex(m, object.xyz + 3 * v, &placed[3 * v]);
  CGAL::Protect_FPU_rounding<true> upwards;
  double error = 0;
  for (size_t v = 0; v < object.n_vertices; v++)
    error = std::fmax(error, error_of(m, object.xyz + 3 * v, &placed[3 * v]));
  const double inverse = inverse_of(m);
  const bool known = inverse < INFINITY && error < INFINITY;
  slack_[instance] =
      known ? (Interval(error) * Interval(inverse)).sup() : INFINITY;
  return slack_[instance];
}

// Whether oriented member a can hide b, in this frame.
bool Kept_frame::hides(const Group &group, uint32_t a, uint32_t b) const {
  const Convex &f = pieces_[group[a / 2]], &g = pieces_[group[b / 2]];
  const int f_side = shapes_.turned(f.parent) * (a % 2 ? -1 : 1);
  const int g_side = shapes_.turned(g.parent) * (b % 2 ? -1 : 1);
  if (f.plane == g.plane)
    return f_side == g_side && f.parent < g.parent;
  return (shapes_.about(g, f.plane) & (f_side > 0 ? BEHIND : FRONT)) &&
         (shapes_.about(f, g.plane) & (g_side > 0 ? FRONT : BEHIND));
}

bool Kept_frame::recall_own(const Group &group, Ranking &ranking) {
  const auto found = kept_.own.find(own_key_of(group));
  if (found == kept_.own.end())
    return false;
  Own &own = found->second;
  own.used = kept_.frame;
  const double slack = slack_of(instance_of(pieces_[group[0]].parent));
  if (!(slack <= SLACK * own.size))
    return false;
  std::map<std::pair<uint32_t, uint32_t>, bool> compared;
  const auto compare = [&](uint32_t a, uint32_t b) {
    const auto [at, is_new] = compared.insert({{a, b}, false});
    if (is_new) {
      n_close_++;
      at->second = hides(group, a, b);
    }
    return at->second;
  };
  bool holds = !own.order.empty();
  const bool is_known = slack == 0 && own.is_exact;
  for (size_t k = 0; k < own.close.size() && holds && !is_known; k++)
    holds = !compare(own.close[k].first, own.close[k].second);
  if (holds)
    n_kept_ += own.order.size();
  own.is_exact = (own.is_exact && holds) || slack == 0;
  ranking.has_order = holds || sort(own, compare, ranking.circuits);
  ranking.order = own.order;
  return true;
}

bool Kept_frame::recall(const Group &group, Ranking &ranking) {
  if (group.empty())
    return false;
  Key key = key_of(group);
  const auto last = kept_.last.find(key);
  if (last != kept_.last.end() && !has_moved(group)) {
    ranking = std::move(last->second);
    kept_.last.erase(last);
    n_kept_ += ranking.order.size() + ranking.thick.size();
  } else if (!may_move(group) || !recall_own(group, ranking)) {
    return false;
  }
  kept_.now[std::move(key)] = ranking;
  return true;
}

// --- What is to be kept -----------------------------------------------------

// Finds what is steady in a group, which may move. False if it is not placed so
// that this would hold.
bool Kept_frame::know(const Group &group, Own &own) {
  const uint32_t instance = instance_of(pieces_[group[0]].parent);
  const hsr_object &object = object_of(whole_, instance);
  std::vector<Triangle> triangles;
  for (uint32_t p : group) {
    const uint32_t f = pieces_[p].parent - whole_.roster.first[instance];
    Triangle t;
    for (size_t k = 0; k < 3; k++)
      t.corner[k] = object.xyz + 3 * size_t(object.vertex[object.start[f] + k]);
    triangles.push_back(t);
  }
  own.size = size_of(triangles);
  own.about = all_steadily_about(triangles, own.size);
  return slack_of(instance) <= SLACK * own.size;
}

void Kept_frame::keep(const Group &group, Priority_graph &graph,
                      Ranking &ranking) {
  if (group.empty())
    return;
  Own own;
  if (may_move(group) && know(group, own)) {
    std::vector<uint32_t> place(2 * group.size()), circuits;
    for (uint32_t k = 0; k < graph.size(); k++) {
      const Oriented &node = graph.node(k);
      own.nodes.push_back(2 * node.member + !node.from_front);
      place[own.nodes.back()] = k;
    }
    const auto hides = [&](uint32_t a, uint32_t b) {
      return graph.can_hide(place[a], place[b]);
    };
    if (sort(own, hides, circuits) && ranking.has_order)
      ranking.order = own.order;
    own.is_exact = slack_of(instance_of(pieces_[group[0]].parent)) == 0;
    own.used = kept_.frame;
    kept_.own[own_key_of(group)] = std::move(own);
  }
  kept_.now[key_of(group)] = ranking;
}

} // namespace hsr

hsr_kept_priorities *hsr_kept_priorities_new() {
  return new (std::nothrow) hsr_kept_priorities();
}

void hsr_kept_priorities_free(hsr_kept_priorities *kept) {
  delete kept;
}
