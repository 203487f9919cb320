// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/adapt/convex.h"
#include "common/exact/exact_plane.h"
#include "common/exact/predicates.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace {

using namespace hsr;

const double TINY = 0x1p-960;

double largest_normal(const hsr_world &w, uint32_t f) {
  return std::fmax(std::fabs(w.mesh.nx[f]),
                   std::fmax(std::fabs(w.mesh.ny[f]), std::fabs(w.mesh.nz[f])));
}

// Whether the normals of two faces of one plane point one way.
bool same_way(const hsr_world &w, uint32_t f, uint32_t g) {
  const double a[3] = {w.mesh.nx[f], w.mesh.ny[f], w.mesh.nz[f]};
  const double b[3] = {w.mesh.nx[g], w.mesh.ny[g], w.mesh.nz[g]};
  for (size_t c = 0; c < 3; c++)
    if (std::fabs(a[c]) > w.mesh.n_error[f] &&
        std::fabs(b[c]) > w.mesh.n_error[g])
      return (a[c] > 0) == (b[c] > 0);
  const Exact product =
      FacePlane<Exact>(&w, f).normal * FacePlane<Exact>(&w, g).normal;
  return product > Exact(0);
}

// The widest extent of a face.
double size_of(const hsr_world &w, uint32_t f) {
  double size = 0;
  for (const double *x : {w.mesh.x, w.mesh.y, w.mesh.z}) {
    double lo = INFINITY, hi = -INFINITY;
    for (uint32_t k = w.mesh.start[f]; k < w.mesh.start[f + 1]; k++) {
      lo = std::fmin(lo, x[w.mesh.vertex[k]]);
      hi = std::fmax(hi, x[w.mesh.vertex[k]]);
    }
    size = std::fmax(size, hi - lo);
  }
  return size;
}

// The plane of face f, if it lies across an axis.
Level level_of(const hsr_world &w, uint32_t f) {
  const double *const x[3] = {w.mesh.x, w.mesh.y, w.mesh.z};
  const double n[3] = {w.mesh.nx[f], w.mesh.ny[f], w.mesh.nz[f]};
  for (size_t axis = 0; axis < 3; axis++) {
    const double at = x[axis][w.mesh.vertex[w.mesh.start[f]]];
    bool across = std::fabs(n[axis]) > w.mesh.n_error[f];
    for (uint32_t k = w.mesh.start[f]; k < w.mesh.start[f + 1] && across; k++)
      across = x[axis][w.mesh.vertex[k]] == at;
    if (across)
      return {axis, at, n[axis] > 0 ? 1 : -1};
  }
  return {0, 0, 0};
}

// --- Corners in homogeneous numbers -----------------------------------------

// The corner of the edge from a to b with a plane. It is the same numbers
// whichever way the edge runs.
template <class T>
Homogeneous<T> meet(const hsr_world *w, uint32_t a, uint32_t b,
                    const FacePlane<T> &plane) {
  const Vector3<T> from = point<T>(w, std::min(a, b)),
                   to = point<T>(w, std::max(a, b));
  const T h_from = plane.height(from), h_to = plane.height(to);
  return {h_from * to - h_to * from, h_from - h_to};
}

// Cramer's rule on k N . P = N . S.
template <class T>
Homogeneous<T> meet(const FacePlane<T> &f, const FacePlane<T> &g,
                    const FacePlane<T> &h) {
  const Vector3<T> n = f.k * f.normal, o = g.k * g.normal, p = h.k * h.normal;
  const Vector3<T> gh = CGAL::cross_product(o, p);
  return {f.offset * gh + g.offset * CGAL::cross_product(p, n) +
              h.offset * CGAL::cross_product(n, o),
          n * gh};
}

// Whether a vertex is known to lie in the plane of face f.
bool is_on(const hsr_world &w, uint32_t f, uint32_t v) {
  const uint32_t *first = w.mesh.vertex + w.mesh.start[f],
                 *last = w.mesh.vertex + w.mesh.start[f + 1];
  return w.mesh.deviation[f] == 0 && std::find(first, last, v) != last;
}

// The two sides that meet in corner k.
struct Meeting {
  const Corner &before, &after;
  Meeting(const Convex &piece, size_t k)
      : before(piece.corners[k ? k - 1 : piece.corners.size() - 1]),
        after(piece.corners[k]) {}
  bool is_vertex() const {
    return before.b != NO_VERTEX && after.b != NO_VERTEX;
  }
};

template <class T>
int side_of(const Homogeneous<T> &corner, const FacePlane<T> &plane) {
  const T height =
      plane.k * (plane.normal * corner.p) - plane.offset * corner.w;
  const CGAL::Sign h = CGAL::sign(height), w = CGAL::sign(corner.w);
  return int(h) * int(w);
}

} // namespace

namespace hsr {

Convex_pieces::Convex_pieces(const hsr_world &world)
    : world_(world), whole_(whole_of(world)),
      tables_(std::make_shared<Tables>()) {
  face_of_.resize(whole_.mesh.n_planes, UINT32_MAX);
  turned_.resize(whole_.n_faces);
  reach_.resize(whole_.n_faces);
  level_.resize(whole_.mesh.n_planes);
  for (uint32_t f = 0; f < whole_.n_faces; f++) {
    uint32_t &first = face_of_[whole_.mesh.plane[f]];
    if (first == UINT32_MAX) {
      first = f;
      level_[whole_.mesh.plane[f]] = level_of(whole_, f);
    }
    turned_[f] = first == f || same_way(whole_, first, f) ? 1 : -1;
    if (whole_.mesh.deviation[f] == 0)
      continue;
    // Any number will do: whether what is seen is within it is asked for each
    // eye (hsr_grazes). It may be infinite or not a number where the normal is
    // too small for doubles, and must not be 0, which says that a face is flat.
    const double off = whole_.mesh.deviation[f] / largest_normal(whole_, f);
    reach_[f] = std::fmax(std::sqrt(off * size_of(whole_, f)), TINY);
  }
}

Convex_pieces::Convex_pieces(const Convex_pieces &other)
    : world_(other.world_), whole_(other.whole_), tables_(other.tables_) {}

// --- Exact corners ----------------------------------------------------------

template <class T> FacePlane<T> Convex_pieces::plane_of(uint32_t plane) const {
  const Level &level = level_[plane];
  return level.front ? FacePlane<T>(level.axis, level.at, level.front)
                     : FacePlane<T>(&whole_, face_of_[plane]);
}

const FacePlane<Exact> &Convex_pieces::exact_plane(uint32_t plane) const {
  const auto known = exact_.find(plane);
  return known != exact_.end()
             ? known->second
             : exact_.emplace(plane, plane_of<Exact>(plane)).first->second;
}

template <class T>
Homogeneous<T> Convex_pieces::corner_of(const Convex &piece, size_t k) const {
  const Meeting m(piece, k);
  const auto plane = [&](uint32_t p) -> decltype(auto) {
    if constexpr (std::is_same_v<T, Exact>)
      return exact_plane(p);
    else
      return plane_of<T>(p);
  };
  if (m.before.b != NO_VERTEX)
    return meet<T>(&whole_, m.before.a, m.before.b, plane(m.after.a));
  if (m.after.b != NO_VERTEX)
    return meet<T>(&whole_, m.after.a, m.after.b, plane(m.before.a));
  return meet<T>(plane(piece.plane), plane(std::min(m.before.a, m.after.a)),
                 plane(std::max(m.before.a, m.after.a)));
}

const Homogeneous<Exact> &Convex_pieces::exact_corner(const Convex &piece,
                                                      size_t k) const {
  const Corner &corner = piece.corners[k];
  if (!corner.exact)
    corner.exact =
        std::make_shared<const Homogeneous<Exact>>(corner_of<Exact>(piece, k));
  return *corner.exact;
}

// --- On which side ----------------------------------------------------------

hsr_rounded_plane Convex_pieces::rounded(uint32_t plane) const {
  const hsr_mesh &mesh = whole_.mesh;
  const uint32_t g = face_of_[plane];
  return {{mesh.nx[g], mesh.ny[g], mesh.nz[g]},
          {mesh.px[g], mesh.py[g], mesh.pz[g]},
          mesh.n_error[g],
          mesh.anchor_error[g]};
}

// The height of a corner over a plane, and a bound of its error: that of
// order.c, and the corner's own. Over a plane across an axis the sign is exact
// but for the corner's own error.
double Convex_pieces::height(uint32_t plane, const Corner &corner,
                             double &error) const {
  const Level &level = level_[plane];
  if (level.front) {
    error = corner.error;
    return level.front * (corner.at[level.axis] - level.at);
  }
  const hsr_rounded_plane over = rounded(plane);
  return hsr_height_over(&over, corner.at[0], corner.at[1], corner.at[2],
                         corner.error, &error);
}

// Whether a side is known to lie in a plane.
bool Convex_pieces::is_within(const Corner &side, uint32_t plane) const {
  const Level &level = level_[plane];
  if (side.b == NO_VERTEX) {
    const Level &other = level_[side.a];
    return side.a == plane ||
           (level.front && other.front && level.axis == other.axis &&
            level.at == other.at);
  }
  if (!level.front)
    return is_on(whole_, face_of_[plane], side.a) &&
           is_on(whole_, face_of_[plane], side.b);
  return point_of(whole_, side.a)[level.axis] == level.at &&
         point_of(whole_, side.b)[level.axis] == level.at;
}

int Convex_pieces::exact_side(const Convex &piece, size_t k,
                              uint32_t plane) const {
  const Meeting m(piece, k);
  if (is_within(m.before, plane) || is_within(m.after, plane))
    return 0;
  if (m.after.error == 0) { // a vertex, and the plane is none across an axis
    const uint32_t g = face_of_[plane];
    if (m.is_vertex() && is_on(whole_, g, m.after.a))
      return 0;
    bool out_of_memory = false;
    const int side = hsr_exact_plane_side(hsr_face_loop(&whole_, g),
                                          m.after.at.data(), &out_of_memory);
    if (out_of_memory)
      throw std::bad_alloc();
    return side;
  }
  try {
    CGAL::Protect_FPU_rounding<true> upwards;
    return side_of(corner_of<Interval>(piece, k), plane_of<Interval>(plane));
  } catch (const CGAL::Uncertain_conversion_exception &) {
    // Below, with the rounding mode restored.
  }
  const std::lock_guard<std::mutex> guard(has_exact_);
  return side_of(exact_corner(piece, k), exact_plane(plane));
}

// -1, 0 or +1: corner k behind a plane, on it, or in front; of a piece that is
// not flat, 0 and not sure if it may be on either side.
int Convex_pieces::side(const Convex &piece, size_t k, uint32_t plane,
                        bool &sure) const {
  double error;
  const double h = height(plane, piece.corners[k], error);
  if (std::fabs(h) > error)
    return h > 0 ? 1 : -1;
  if (error == 0)
    return 0;
  if (is_flat(piece))
    return exact_side(piece, k, plane);
  sure = false;
  return 0;
}

unsigned Convex_pieces::about(const Convex &piece, uint32_t plane) const {
  if (piece.plane == plane)
    return 0;
  for (const hsr_cut &cut : piece.cuts)
    if (cut.face == plane)
      return cut.side > 0 ? FRONT : BEHIND;
  unsigned where = 0;
  bool sure = true;
  for (size_t k = 0; k < piece.corners.size(); k++) {
    const int s = side(piece, k, plane, sure);
    where |= s > 0 ? FRONT : s < 0 ? BEHIND : 0u;
  }
  return sure || where == BOTH ? where : where | UNSURE;
}

// --- Of many pieces ---------------------------------------------------------

void Convex_pieces::clear(Columns &columns) const {
  for (std::vector<double> *column :
       {&columns.at[0], &columns.at[1], &columns.at[2], &columns.error})
    column->clear();
  columns.vertex.clear();
  columns.first.assign(1, 0);
  columns.plane.clear();
  columns.is_flat.clear();
}

void Convex_pieces::add(const Convex &piece, Columns &columns) const {
  for (size_t k = 0; k < piece.corners.size(); k++) {
    const Corner &corner = piece.corners[k];
    for (size_t c = 0; c < 3; c++)
      columns.at[c].push_back(corner.at[c]);
    columns.error.push_back(corner.error);
    columns.vertex.push_back(Meeting(piece, k).is_vertex()
                                 ? int64_t(corner.a)
                                 : HSR_NO_CORNER_VERTEX);
  }
  columns.first.push_back(columns.error.size());
  columns.plane.push_back(piece.plane);
  columns.is_flat.push_back(is_flat(piece));
}

void Convex_pieces::look(Columns &columns, uint32_t plane) const {
  const size_t n = columns.error.size();
  const Level &level = level_[plane];
  columns.known.resize(n);
  if (level.front) {
    hsr_look_at_levels(level.at, level.front, columns.at[level.axis].data(),
                       columns.error.data(), n, columns.known.data());
    return;
  }
  const uint32_t g = face_of_[plane];
  const uint32_t *vertex = whole_.mesh.vertex + whole_.mesh.start[g];
  const hsr_rounded_plane over = rounded(plane);
  const hsr_corner_columns corners = {
      columns.at[0].data(), columns.at[1].data(),  columns.at[2].data(),
      columns.error.data(), columns.vertex.data(), n};
  int64_t on[3];
  for (size_t k = 0; k < 3; k++)
    on[k] = whole_.mesh.deviation[g] == 0 ? vertex[k] : UINT32_MAX;
  hsr_look_at_heights(&over, on, &corners, columns.known.data());
}

unsigned Convex_pieces::closely_about(const Convex &piece,
                                      const Columns &columns, size_t k,
                                      uint32_t plane) const {
  if (!is_flat(piece))
    return about(piece, plane);
  unsigned where = 0;
  for (size_t c = 0; c < piece.corners.size(); c++) {
    const int64_t known = columns.known[columns.first[k] + c];
    const int s = known == HSR_IS_CLOSE ? exact_side(piece, c, plane) : 0;
    where |= s > 0 ? FRONT : s < 0 ? BEHIND : unsigned(known) & BOTH;
  }
  return where;
}

// --- Division ---------------------------------------------------------------

// The coordinates of corner k, which is no vertex.
void Convex_pieces::locate(const Convex &piece, size_t k,
                           Corner &corner) const {
  corner.error = TINY;
  corner.exact.reset();
  // In intervals: a sum of doubles would depend on the mode of rounding.
  const auto set = [&](size_t c, const Interval &lo, const Interval &hi) {
    const Interval at = (lo + Interval((hi - lo).sup() / 2)).sup();
    corner.at[c] = at.sup();
    corner.error =
        std::fmax(corner.error, std::fmax((at - lo).sup(), (hi - at).sup()));
  };
  {
    CGAL::Protect_FPU_rounding<true> upwards;
    const Homogeneous<Interval> h = corner_of<Interval>(piece, k);
    if (h.w.inf() > 0 || h.w.sup() < 0) {
      for (int c = 0; c < 3; c++) {
        const Interval x = h.p[c] / h.w;
        set(size_t(c), x.inf(), x.sup());
      }
      return;
    }
  }
  const std::lock_guard<std::mutex> guard(has_exact_);
  const Homogeneous<Exact> &h = exact_corner(piece, k);
  for (int c = 0; c < 3; c++) {
    const Safe_interval x = quotient(h.p[c], h.w);
    CGAL::Protect_FPU_rounding<true> upwards;
    set(size_t(c), x.inf(), x.sup());
  }
}

void Convex_pieces::clip(Convex &piece, uint32_t plane, int keep) const {
  const size_t n = piece.corners.size();
  std::vector<int> sides(n);
  bool sure = true;
  for (size_t k = 0; k < n; k++)
    sides[k] = keep * side(piece, k, plane, sure);
  std::vector<Corner> kept;
  std::vector<size_t> fresh;
  for (size_t k = 0; k < n; k++) {
    const size_t l = k + 1 < n ? k + 1 : 0;
    if (sides[k] >= 0)
      kept.push_back(piece.corners[k]);
    if (sides[k] > 0 && sides[l] < 0) {
      fresh.push_back(kept.size());
      kept.push_back({piece.corners[l].at, 0, plane, NO_VERTEX});
    } else if (sides[k] == 0 && sides[l] < 0) {
      kept.back().a = plane;
      kept.back().b = NO_VERTEX;
    } else if (sides[k] < 0 && sides[l] > 0) {
      fresh.push_back(kept.size());
      kept.push_back(piece.corners[k]);
    }
  }
  piece.corners = std::move(kept);
  for (size_t k : fresh)
    locate(piece, k, piece.corners[k]);
}

Convex Convex_pieces::part(const Convex &piece, uint32_t plane,
                           int side) const {
  Convex part = piece;
  part.cuts.push_back({plane, side});
  if (is_flat(piece))
    clip(part, plane, side);
  return part;
}

// All but where the piece is from.
bool Convex_pieces::make(const Piece &given, Convex &piece) const {
  const double reach = reach_[given.parent];
  piece = {0, given.parent, whole_.mesh.plane[given.parent], {}, {}};
  for (size_t k = 0, n = given.loop.size(); k < n; k++)
    piece.corners.push_back({point_of(whole_, given.loop[k]), reach,
                             given.loop[k], given.loop[(k + 1) % n]});
  for (const hsr_cut &cut : given.cuts) {
    const uint32_t plane = whole_.mesh.plane[cut.face];
    const int side = cut.side * turned_[cut.face];
    const unsigned where = about(piece, plane);
    if (!(where & UNSURE) && !(where & (side > 0 ? FRONT : BEHIND)))
      return false;
    if (!is_flat(piece) || (where & (side > 0 ? BEHIND : FRONT)))
      piece = part(piece, plane, side);
  }
  return true;
}

bool Convex_pieces::make(uint32_t f, Convex &piece) const {
  const bool has_points = make(piece_of(world_, f), piece);
  piece.from = f;
  return has_points;
}

bool Convex_pieces::may_cross(const Piece &given, uint32_t g) const {
  Convex piece;
  if (!make(given, piece))
    return false;
  const unsigned where = about(piece, whole_.mesh.plane[g]);
  return where & UNSURE || where == (FRONT | BEHIND);
}

// A flat piece keeps only the cuts that it has a side on.
Piece Convex_pieces::finished(const Convex &piece, bool &with_outline) const {
  Piece made = piece_of(world_, piece.from);
  made.cuts.clear();
  made.outline.clear();
  double largest = 0, error = 0;
  for (const Corner &corner : piece.corners) {
    made.outline.push_back(corner.at);
    error = std::fmax(error, corner.error);
    for (double c : corner.at)
      largest = std::fmax(largest, std::fabs(c));
  }
  for (const hsr_cut &cut : piece.cuts) {
    bool counts = !is_flat(piece);
    for (const Corner &corner : piece.corners)
      counts |= corner.b == NO_VERTEX && corner.a == cut.face;
    if (counts)
      made.cuts.push_back({face_of_[cut.face], cut.side});
  }
  // As exact as an outline of a world of pieces must be (pieces.c).
  with_outline =
      is_flat(piece) && !made.cuts.empty() && error <= 0x1p-44 * largest;
  return made;
}

} // namespace hsr
