// SPDX-License-Identifier: GPL-3.0-or-later
// The convex volumes of a world, over CGAL.
//
// Solids      Two faces are joined if they share an edge that no third face
//             has. A set of joined faces is a solid if all its edges are such,
//             and it meets itself nowhere else: no edge touches another face of
//             the solid. Those that an edge may touch (common/lines/edges.h)
//             are tested by CGAL's exact predicates.
// Convex      A solid is convex if no corner is outside any plane, and some are
//             strictly inside each. The faces then lie on the convex hull; they
//             have no border, so they cover all of it.
// Division    A tree of planes divides the solid (W. C. Thibault, B. F. Naylor,
//             "Set operations on polyhedra using binary space partitioning
//             trees", SIGGRAPH 1987), but a cell is divided only while some
//             piece of the surface in it is outside the plane of another. When
//             none is, the part in the cell is locally convex everywhere, and
//             so it is convex: in the cell, and inside the planes of all
//             pieces.
// Planes      The planes of a part are those of its pieces and of its cell. So
//             all of them are planes of faces, and exact. Two of them have a
//             rim if more than a point of their line is inside all others.

#include "common/adapt/convex.h"
#include "common/exact/exact_plane.h"
#include "common/lines/volumes.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <map>
#include <new>
#include <numeric>
#include <optional>
#include <vector>

namespace {

using namespace hsr;

// A solid of more faces, or of more parts than faces, is taken face by face:
// that costs less.
const size_t LARGEST_DIVIDED = 1024;
size_t most_parts(size_t n_faces) {
  return std::max<size_t>(16, n_faces);
}

struct Volume {
  std::vector<hsr_cut> planes;
  std::vector<hsr_rim> rims; // of planes of the volume
  std::vector<hsr_sight_line> lines;
  hsr_space space = {{INFINITY, INFINITY, INFINITY},
                     {-INFINITY, -INFINITY, -INFINITY}}; // of solids

  void extend(size_t axis, double lo, double hi) {
    space.lo[axis] = std::fmin(space.lo[axis], lo);
    space.hi[axis] = std::fmax(space.hi[axis], hi);
  }
  void add_rim(uint32_t plane, uint32_t other, const hsr_sight_line &line) {
    rims.push_back({plane, other});
    lines.push_back(line);
  }
};

// --- Sets of faces ----------------------------------------------------------

// Sets of items that are joined two by two.
class Sets {
public:
  explicit Sets(uint32_t n) : parent_(n) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  uint32_t find(uint32_t k) {
    while (parent_[k] != k)
      k = parent_[k] = parent_[parent_[k]];
    return k;
  }
  void join(uint32_t k, uint32_t l) { parent_[find(l)] = find(k); }

private:
  std::vector<uint32_t> parent_;
};

// --- Whether an edge touches a face -----------------------------------------

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Flat_point = Kernel::Point_2;

// A simple face on the coordinate plane that it faces most.
class Flat {
public:
  Flat(const hsr_world *world, uint32_t f) : world_(world), f_(f) {
    drop_ = projection_of(world, f).axis;
    for (uint32_t k = world->mesh.start[f]; k < world->mesh.start[f + 1]; k++)
      polygon_.push_back(at(world->mesh.vertex[k]));
  }

  // Whether the edge from a to b, which is not a side of the face, meets the
  // face elsewhere than in one common vertex.
  bool touches(uint32_t a, uint32_t b) const {
    const int side_a = side_of_plane(world_, f_, a);
    const int side_b = side_of_plane(world_, f_, b);
    if (side_a && side_b)
      return side_a != side_b && is_pierced(a, b);
    if (side_a || side_b) {
      const uint32_t on = side_a ? b : a;
      return !is_corner(on) && holds(on);
    }
    const bool corner_a = is_corner(a), corner_b = is_corner(b);
    if (corner_a && corner_b)
      return true; // it may
    if (corner_b)
      std::swap(a, b);
    if (holds(b) || (!corner_a && !corner_b && holds(a)))
      return true;
    const bool shares = corner_a || corner_b; // in a
    for (size_t k = 0, l = polygon_.size() - 1; k < polygon_.size(); l = k++) {
      const bool from = shares && corner(l) == a, to = shares && corner(k) == a;
      if (from || to) {
        const Flat_point &other = polygon_[from ? k : l];
        if (CGAL::collinear(at(a), at(b), other) &&
            CGAL::angle(at(b), at(a), other) == CGAL::ACUTE)
          return true;
      } else if (CGAL::do_intersect(Kernel::Segment_2(polygon_[l], polygon_[k]),
                                    Kernel::Segment_2(at(a), at(b)))) {
        return true;
      }
    }
    return false;
  }

private:
  const hsr_world *world_;
  uint32_t f_;
  int drop_;
  std::vector<Flat_point> polygon_;

  Flat_point at(uint32_t v) const {
    const double *c[3] = {world_->mesh.x, world_->mesh.y, world_->mesh.z};
    return {c[(drop_ + 1) % 3][v], c[(drop_ + 2) % 3][v]};
  }
  uint32_t corner(size_t k) const {
    return world_->mesh.vertex[world_->mesh.start[f_] + k];
  }
  // Whether the edge goes through the face or its border. Its ends are on
  // different sides of the face; it does if it passes all sides of some convex
  // part of the face on one side.
  bool is_pierced(uint32_t a, uint32_t b) const {
    const auto place = [&](uint32_t v) {
      return Kernel::Point_3(world_->mesh.x[v], world_->mesh.y[v],
                             world_->mesh.z[v]);
    };
    for (const std::vector<uint32_t> &loop : convex_loops(*world_, f_)) {
      bool left = false, right = false;
      for (size_t k = 0, l = loop.size() - 1; k < loop.size(); l = k++) {
        const auto turn = CGAL::orientation(place(a), place(b), place(loop[l]),
                                            place(loop[k]));
        left |= turn == CGAL::POSITIVE;
        right |= turn == CGAL::NEGATIVE;
      }
      if (!(left && right))
        return true;
    }
    return false;
  }
  bool is_corner(uint32_t v) const {
    for (size_t k = 0; k < polygon_.size(); k++)
      if (corner(k) == v)
        return true;
    return false;
  }
  bool holds(uint32_t v) const {
    return CGAL::bounded_side_2(polygon_.begin(), polygon_.end(), at(v),
                                Kernel()) != CGAL::ON_UNBOUNDED_SIDE;
  }
};

// --- Solids -----------------------------------------------------------------

struct Body {
  std::vector<uint32_t> faces, corners;
  bool closed;
};

class Finder {
public:
  explicit Finder(const hsr_edges *edges)
      : edges_(edges), world_(edges->world), shapes_(*edges->world) {}

  std::vector<Body> bodies;
  std::vector<std::vector<Volume>> solids; // a body
  uint32_t n_convex = 0, n_parts = 0, n_too_large = 0;

  void find() {
    find_bodies();
    solids.resize(bodies.size());
    body_of_.resize(world_->n_faces);
    for (uint32_t b = 0; b < bodies.size(); b++)
      for (uint32_t f : bodies[b].faces)
        body_of_[f] = b;
    find_touching();
    for (uint32_t b = 0; b < bodies.size(); b++)
      if (bodies[b].closed)
        find_volumes(bodies[b], solids[b]);
  }

  // A face as volumes without thickness.
  std::vector<Volume> flat(uint32_t f) const {
    std::vector<Volume> volumes;
    if (!edges_->simple[f])
      return volumes;
    // Exact, and as long in the making as the face has corners: made once.
    std::optional<Vector3<Exact>> normal;
    for (const std::vector<uint32_t> &loop : convex_loops(*world_, f)) {
      Volume volume;
      volume.planes = {{f, -1}, {f, +1}};
      bool forwards = true;
      if (loop.size() == 3 && hsr_face_size(world_, f) > 3) {
        if (!normal)
          normal = FacePlane<Exact>(world_, f).normal;
        forwards = runs_forwards(*normal, loop);
      }
      for (size_t k = 0, l = loop.size() - 1; k < loop.size(); l = k++)
        volume.add_rim(0, 1,
                       {false, forwards ? loop[l] : loop[k],
                        forwards ? loop[k] : loop[l]});
      volumes.push_back(volume);
    }
    return volumes;
  }

private:
  const hsr_edges *edges_;
  const hsr_world *world_;
  Convex_pieces shapes_;
  std::vector<uint32_t> body_of_;                      // a face
  std::map<uint32_t, std::vector<uint32_t>> on_plane_; // of the solid that is
                                                       // divided: its vertices

  // Whether a triangle of a face with this normal runs around as the face does.
  bool runs_forwards(const Vector3<Exact> &face_normal,
                     const std::vector<uint32_t> &loop) const {
    const Vector3<Exact> a = point<Exact>(world_, loop[0]);
    const Vector3<Exact> normal = CGAL::cross_product(
        point<Exact>(world_, loop[1]) - a, point<Exact>(world_, loop[2]) - a);
    return CGAL::sign(normal * face_normal) > 0;
  }

  // Whether an edge has exactly two faces, both simple, which run along it in
  // opposite directions.
  bool is_seam(uint32_t e) const {
    const uint32_t s = edges_->side_start[e];
    return edges_->side_start[e + 1] - s == 2 &&
           edges_->side[s].turn == -edges_->side[s + 1].turn &&
           edges_->simple[edges_->side[s].face] &&
           edges_->simple[edges_->side[s + 1].face];
  }

  // Closed sets of faces, and the rest of each instance.
  void find_bodies() {
    const uint32_t n = world_->n_faces;
    Sets sets(n);
    std::vector<uint32_t> seams(n, 0);
    for (uint32_t e = 0; e < edges_->n_real; e++)
      if (is_seam(e)) {
        const hsr_side *side = edges_->side + edges_->side_start[e];
        sets.join(side[0].face, side[1].face);
        seams[side[0].face]++;
        seams[side[1].face]++;
      }
    std::vector<bool> closed(n, true);
    for (uint32_t f = 0; f < n; f++)
      if (seams[f] != hsr_face_size(world_, f))
        closed[sets.find(f)] = false;
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> number;
    for (uint32_t f = 0; f < n; f++) {
      const uint32_t set = sets.find(f);
      const auto key = closed[set]
                           ? std::make_pair(set, uint32_t{1})
                           : std::make_pair(world_->mesh.instance[f], 0u);
      const auto found = number.insert({key, uint32_t(bodies.size())});
      if (found.second)
        bodies.push_back({{}, {}, closed[set]});
      Body &body = bodies[found.first->second];
      body.faces.push_back(f);
      body.corners.insert(body.corners.end(),
                          world_->mesh.vertex + world_->mesh.start[f],
                          world_->mesh.vertex + world_->mesh.start[f + 1]);
    }
    for (Body &body : bodies) {
      std::sort(body.corners.begin(), body.corners.end());
      body.corners.erase(std::unique(body.corners.begin(), body.corners.end()),
                         body.corners.end());
    }
  }

  // Finds the bodies that touch themselves: these are no solids.
  void find_touching() {
    for (uint32_t e = 0; e < edges_->n; e++) {
      const uint32_t s = edges_->side_start[e];
      const uint32_t b = body_of_[edges_->side[s].face];
      if (!bodies[b].closed)
        continue;
      if (edges_->name[e].implied) {
        bodies[b].closed = b != body_of_[edges_->side[s + 1].face];
        continue;
      }
      for (uint32_t k = edges_->touch_start[e]; k < edges_->touch_start[e + 1];
           k++) {
        const uint32_t f = edges_->touch[k].face;
        if (body_of_[f] == b && bodies[b].closed)
          bodies[b].closed =
              !Flat(world_, f).touches(edges_->a[e], edges_->b[e]);
      }
    }
  }

  // Six times the volume that the faces enclose.
  template <class T> T enclosed(const Body &body) const {
    const Vector3<T> origin = point<T>(world_, body.corners[0]);
    T sum(0);
    for (uint32_t f : body.faces) {
      const uint32_t *v = world_->mesh.vertex + world_->mesh.start[f];
      const Vector3<T> a = point<T>(world_, v[0]) - origin;
      for (uint32_t k = 2; k < hsr_face_size(world_, f); k++)
        sum = sum + a * CGAL::cross_product(point<T>(world_, v[k - 1]) - origin,
                                            point<T>(world_, v[k]) - origin);
    }
    return sum;
  }

  // +1 if the fronts of its faces are outside, -1 if they are inside.
  int outward(const Body &body) const {
    {
      CGAL::Protect_FPU_rounding<true> upwards;
      const Interval volume = enclosed<Interval>(body);
      if (volume.inf() > 0)
        return 1;
      if (volume.sup() < 0)
        return -1;
    }
    return CGAL::sign(enclosed<Exact>(body));
  }

  void find_volumes(const Body &body, std::vector<Volume> &volumes) {
    const int out = outward(body);
    if (!out || (out < 0 && world_->mesh.one_sided[body.faces[0]]))
      return;
    volumes.resize(1);
    if (make_convex(body, out, volumes[0])) {
      n_convex++;
      return;
    }
    volumes.clear();
    if (body.faces.size() > LARGEST_DIVIDED || !divide(body, out, volumes)) {
      volumes.clear();
      n_too_large++;
    }
    n_parts += uint32_t(volumes.size());
  }

  // --- Convex solids ---

  bool make_convex(const Body &body, int out, Volume &volume) const {
    std::map<uint32_t, uint32_t> number; // of a plane class in the volume
    for (uint32_t f : body.faces) {
      const hsr_cut half = {f, -out};
      const auto found = number.insert(
          {world_->mesh.plane[f], uint32_t(volume.planes.size())});
      if (!found.second) {
        const uint32_t first = volume.planes[found.first->second].face;
        if (shapes_.turned(first) != shapes_.turned(f))
          return false;
        continue;
      }
      volume.planes.push_back(half);
    }
    for (const hsr_cut &half : volume.planes) {
      bool inside = false;
      for (uint32_t v : body.corners) {
        const int side = side_of_plane(world_, half.face, v) * half.side;
        if (side < 0)
          return false;
        inside |= side > 0;
      }
      if (!inside)
        return false;
    }
    for (uint32_t f : body.faces)
      add_rims(f, out, number, volume);
    for (uint32_t v : body.corners)
      for (size_t c = 0; c < 3; c++)
        volume.extend(c, place(v)[c], place(v)[c]);
    return true;
  }

  // The rims at those edges of a convex solid that begin in a corner of face f
  // and go on along it.
  void add_rims(uint32_t f, int out, const std::map<uint32_t, uint32_t> &number,
                Volume &volume) const {
    uint32_t p = world_->mesh.vertex[world_->mesh.start[f + 1] - 1];
    for (uint32_t k = world_->mesh.start[f]; k < world_->mesh.start[f + 1];
         k++) {
      const uint32_t q = world_->mesh.vertex[k];
      const uint32_t g = p < q ? across(p, q, f) : f; // each edge once
      if (world_->mesh.plane[f] != world_->mesh.plane[g])
        volume.add_rim(number.at(world_->mesh.plane[f]),
                       number.at(world_->mesh.plane[g]),
                       {false, out > 0 ? p : q, out > 0 ? q : p});
      p = q;
    }
  }

  // The other face at the edge of f from p to q.
  uint32_t across(uint32_t p, uint32_t q, uint32_t f) const {
    for (uint32_t k = edges_->end_start[p]; k < edges_->end_start[p + 1]; k++) {
      const uint32_t e = edges_->end[k];
      if (edges_->a[e] != q && edges_->b[e] != q)
        continue;
      const hsr_side *side = edges_->side + edges_->side_start[e];
      return side[0].face == f ? side[1].face : side[0].face;
    }
    return f;
  }

  // --- Division of others ---

  using Pieces = std::vector<Convex>;
  using Path = std::vector<hsr_cut>; // by plane classes

  // Which sides of a plane pieces have, and have the outside of the solid.
  struct About {
    size_t front = 0, behind = 0, split = 0;
    bool up = false, down = false; // pieces in it, with the solid behind it, or
                                   // before it
    bool divides() const {
      return (up && (down || front || split)) || (down && (behind || split));
    }
    // What a division by it costs.
    size_t price() const {
      return 8 * split + (front > behind ? front - behind : behind - front);
    }
  };

  bool divide(const Body &body, int out, std::vector<Volume> &parts) {
    Pieces pieces;
    on_plane_.clear();
    for (uint32_t f : body.faces) {
      std::vector<uint32_t> &on = on_plane_[world_->mesh.plane[f]];
      on.insert(on.end(), world_->mesh.vertex + world_->mesh.start[f],
                world_->mesh.vertex + world_->mesh.start[f + 1]);
      for (const std::vector<uint32_t> &loop : convex_loops(*world_, f)) {
        Convex piece = {f, f, world_->mesh.plane[f], {}, {}};
        for (size_t k = 0, n = loop.size(); k < n; k++)
          piece.corners.push_back(
              {point_of(*world_, loop[k]), 0, loop[k], loop[(k + 1) % n]});
        pieces.push_back(piece);
      }
    }
    for (auto &on : on_plane_)
      std::sort(on.second.begin(), on.second.end());
    return divide(Path(), pieces, out, most_parts(body.faces.size()), parts);
  }

  // Where the pieces lie about the plane of one of them.
  About about(const Pieces &pieces, uint32_t plane, int out) const {
    About found;
    for (const Convex &piece : pieces) {
      if (piece.plane == plane) {
        const bool up = shapes_.turned(piece.parent) * out > 0;
        (up ? found.up : found.down) = true;
        continue;
      }
      const unsigned where = shapes_.about(piece, plane);
      found.front += where == FRONT;
      found.behind += where == BEHIND;
      found.split += where == (FRONT | BEHIND);
    }
    return found;
  }

  // Divides the part of a solid in a cell, whose surface there is these pieces.
  // False if there would be too many parts.
  bool divide(const Path &path, const Pieces &pieces, int out, size_t most,
              std::vector<Volume> &parts) const {
    std::vector<uint32_t> planes;
    for (const Convex &piece : pieces)
      planes.push_back(piece.plane);
    std::sort(planes.begin(), planes.end());
    planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
    About best;
    uint32_t chosen = UINT32_MAX;
    for (uint32_t plane : planes) {
      const About here = about(pieces, plane, out);
      if (here.divides() &&
          (chosen == UINT32_MAX || here.price() < best.price())) {
        best = here;
        chosen = plane;
      }
    }
    if (chosen == UINT32_MAX) {
      Path all = path;
      for (const Convex &piece : pieces)
        all.push_back({piece.plane, shapes_.turned(piece.parent) * -out});
      return add_part(all, most, parts);
    }
    return divide_side(path, pieces, chosen, +1, best.down, out, most, parts) &&
           divide_side(path, pieces, chosen, -1, best.up, out, most, parts);
  }

  // Divides one side of a plane. If there is no surface there, the solid is all
  // of that side or nothing.
  bool divide_side(Path path, const Pieces &pieces, uint32_t plane, int side,
                   bool is_solid, int out, size_t most,
                   std::vector<Volume> &parts) const {
    const unsigned wanted = side > 0 ? FRONT : BEHIND;
    Pieces here;
    for (const Convex &piece : pieces) {
      const unsigned where = shapes_.about(piece, plane);
      if (where == (FRONT | BEHIND))
        here.push_back(shapes_.part(piece, plane, side));
      else if (where == wanted)
        here.push_back(piece);
    }
    path.push_back({plane, side});
    if (here.empty())
      return !is_solid || add_part(path, most, parts);
    return divide(path, here, out, most, parts);
  }

  // The part inside all of these half spaces, of plane classes.
  bool add_part(const Path &all, size_t most,
                std::vector<Volume> &parts) const {
    if (parts.size() >= most)
      return false;
    Path planes;
    for (const hsr_cut &half : all)
      if (std::none_of(planes.begin(), planes.end(), [&](const auto &other) {
            return other.face == half.face;
          }))
        planes.push_back(half);
    parts.push_back(Part(*this, planes).volume());
    return true;
  }

  // A part in the making: which of its planes meet in an edge of it.
  class Part {
  public:
    Part(const Finder &finder, const Path &planes)
        : finder_(finder), planes_(planes) {
      for (const hsr_cut &half : planes) {
        const uint32_t f = finder.shapes_.face_of(half.face);
        exact_.emplace_back(finder.world_, f);
        CGAL::Protect_FPU_rounding<true> upwards;
        rough_.emplace_back(finder.world_, f);
      }
    }

    // Planes that have no rim bound the part nowhere.
    Volume volume() const {
      Volume made;
      std::vector<uint32_t> number(planes_.size(), UINT32_MAX);
      const auto add = [&](uint32_t k) {
        if (number[k] == UINT32_MAX) {
          number[k] = uint32_t(made.planes.size());
          made.planes.push_back(
              {finder_.shapes_.face_of(planes_[k].face), planes_[k].side});
        }
        return number[k];
      };
      for (uint32_t k = 0; k < planes_.size(); k++)
        for (uint32_t l = 0; l < k; l++)
          if (meet(k, l, made)) {
            const uint32_t plane = add(k), other = add(l);
            made.add_rim(plane, other, line(k, l));
          }
      return made;
    }

  private:
    const Finder &finder_;
    const Path &planes_;
    std::vector<FacePlane<Interval>> rough_;
    std::vector<FacePlane<Exact>> exact_;

    // Whether two planes meet in an edge, within which the space then is too.
    bool meet(uint32_t k, uint32_t l, Volume &made) const {
      try {
        CGAL::Protect_FPU_rounding<true> upwards;
        return meet(rough_, k, l, made);
      } catch (const CGAL::Uncertain_conversion_exception &) {
        // Below, with the rounding mode restored.
      }
      return meet(exact_, k, l, made);
    }

    // A point P of the line of two planes, times w, and the line's direction.
    template <class T> struct Line {
      Vector3<T> P, d;
      T w;
      Line(const FacePlane<T> &a, const FacePlane<T> &b)
          : P(T(0), T(0), T(0)),
            d(CGAL::cross_product(a.k * a.normal, b.k * b.normal)), w(d * d) {
        P = a.offset * CGAL::cross_product(b.k * b.normal, d) +
            b.offset * CGAL::cross_product(d, a.k * a.normal);
      }
    };

    // Where a line meets a plane.
    template <class T> struct Bound {
      bool is = false;
      T value = T(0), slope = T(1);
    };

    template <class T>
    static void extend(Volume &made, const Line<T> &line, const Bound<T> &at) {
      const Vector3<T> P = at.slope * line.P - at.value * line.d;
      const T w = at.slope * line.w;
      for (int c = 0; c < 3; c++) {
        const auto x = quotient(P[c], w);
        made.extend(size_t(c), x.inf(), x.sup());
      }
    }

    // Whether more than a point of the line is in the part: inside or on each
    // other plane. P + t d is on plane m at t = -value / slope.
    template <class T>
    bool meet(const std::vector<FacePlane<T>> &planes, uint32_t k, uint32_t l,
              Volume &made) const {
      const Line<T> line(planes[k], planes[l]);
      if (CGAL::Sign(CGAL::sign(line.w)) == CGAL::ZERO)
        return false;
      Bound<T> least, greatest;
      const auto is_less = [](const Bound<T> &a, const Bound<T> &b) {
        const CGAL::Sign s = CGAL::sign(b.value * a.slope - a.value * b.slope);
        return s == CGAL::NEGATIVE;
      };
      for (uint32_t m = 0; m < planes.size(); m++) {
        if (m == k || m == l)
          continue;
        const T side(planes_[m].side);
        const FacePlane<T> &plane = planes[m];
        Bound<T> bound = {
            true,
            side * (plane.k * (plane.normal * line.P) - plane.offset * line.w),
            side * (plane.k * (plane.normal * line.d))};
        const CGAL::Sign slope = CGAL::sign(bound.slope);
        if (slope == CGAL::ZERO) {
          const CGAL::Sign value = CGAL::sign(bound.value);
          if (value == CGAL::NEGATIVE)
            return false;
        } else if (slope == CGAL::POSITIVE) {
          if (!least.is || is_less(least, bound))
            least = bound;
        } else {
          bound.value = -bound.value;
          bound.slope = -bound.slope;
          if (!greatest.is || is_less(bound, greatest))
            greatest = bound;
        }
      }
      if (!is_less(least, greatest))
        return false;
      extend(made, line, least);
      extend(made, line, greatest);
      return true;
    }

    // By two vertices if there are any on both planes.
    hsr_sight_line line(uint32_t k, uint32_t l) const {
      const uint32_t f = finder_.shapes_.face_of(planes_[k].face);
      const uint32_t g = finder_.shapes_.face_of(planes_[l].face);
      const bool alike = planes_[k].side == planes_[l].side;
      uint32_t a, b;
      if (!finder_.find_common(planes_[k].face, planes_[l].face, a, b))
        return {true, alike ? f : g, alike ? g : f};
      // Seen from outside of plane k, it is on the left of the line.
      const hsr_world *w = finder_.world_;
      const Line<Exact> exact(exact_[k], exact_[l]);
      const bool along =
          CGAL::sign(exact.d * (point<Exact>(w, b) - point<Exact>(w, a))) > 0;
      return {false, along == alike ? a : b, along == alike ? b : a};
    }
  };

  // Two vertices of a solid at different places that are corners of faces in
  // one plane, and of faces in another.
  bool find_common(uint32_t plane, uint32_t other, uint32_t &a,
                   uint32_t &b) const {
    const std::vector<uint32_t> &on = on_plane_.at(plane);
    const std::vector<uint32_t> &on_other = on_plane_.at(other);
    bool found = false;
    for (uint32_t v : on) {
      if (!std::binary_search(on_other.begin(), on_other.end(), v))
        continue;
      if (found && place(v) != place(a)) {
        b = v;
        return true;
      }
      found = true;
      a = v;
    }
    return false;
  }

  Point place(uint32_t v) const { return point_of(*world_, v); }
};

// --- Storing ----------------------------------------------------------------

template <class T> T *store(hsr_volumes *volumes, const std::vector<T> &items) {
  T *array = static_cast<T *>(
      hsr_arena_array(&volumes->arena, items.size(), sizeof(T)));
  if (!array)
    throw std::bad_alloc();
  std::copy(items.begin(), items.end(), array);
  return array;
}

// Lists one after another.
template <class T> struct Lists {
  std::vector<uint32_t> start{0};
  std::vector<T> items;

  void end_one() { start.push_back(uint32_t(items.size())); }
};

struct Stored_volumes {
  Lists<hsr_cut> planes;
  Lists<hsr_rim> rims;
  std::vector<hsr_sight_line> lines;

  void add(const Volume &volume) {
    const uint32_t first = uint32_t(planes.items.size());
    planes.items.insert(planes.items.end(), volume.planes.begin(),
                        volume.planes.end());
    planes.end_one();
    for (const hsr_rim &rim : volume.rims)
      rims.items.push_back({first + rim.plane, first + rim.other});
    rims.end_one();
    lines.insert(lines.end(), volume.lines.begin(), volume.lines.end());
  }
  uint32_t size() const { return uint32_t(planes.start.size() - 1); }
};

void make(hsr_volumes *volumes) {
  const hsr_world *world = volumes->edges->world;
  Finder finder(volumes->edges);
  finder.find();
  Stored_volumes all;
  std::vector<uint32_t> flat{0};
  std::vector<hsr_space> space;
  for (uint32_t f = 0; f < world->n_faces; f++) {
    for (const Volume &volume : finder.flat(f))
      all.add(volume);
    flat.push_back(all.size());
  }
  Lists<uint32_t> faces, corners;
  std::vector<uint32_t> solid_start{all.size()};
  for (uint32_t b = 0; b < finder.bodies.size(); b++) {
    const Body &body = finder.bodies[b];
    faces.items.insert(faces.items.end(), body.faces.begin(), body.faces.end());
    faces.end_one();
    corners.items.insert(corners.items.end(), body.corners.begin(),
                         body.corners.end());
    corners.end_one();
    for (const Volume &volume : finder.solids[b]) {
      all.add(volume);
      space.push_back(volume.space);
    }
    solid_start.push_back(all.size());
    volumes->n_solids += !finder.solids[b].empty();
  }
  volumes->n = all.size();
  volumes->plane_start = store(volumes, all.planes.start);
  volumes->plane = store(volumes, all.planes.items);
  volumes->rim_start = store(volumes, all.rims.start);
  volumes->rim = store(volumes, all.rims.items);
  volumes->line = store(volumes, all.lines);
  volumes->flat = store(volumes, flat);
  volumes->space = store(volumes, space);
  volumes->n_bodies = uint32_t(finder.bodies.size());
  volumes->face_start = store(volumes, faces.start);
  volumes->face = store(volumes, faces.items);
  volumes->corner_start = store(volumes, corners.start);
  volumes->corner = store(volumes, corners.items);
  volumes->solid_start = store(volumes, solid_start);
  volumes->n_convex = finder.n_convex;
  volumes->n_parts = finder.n_parts;
  volumes->n_too_large = finder.n_too_large;
}

} // namespace

enum hsr_status hsr_volumes_init(struct hsr_volumes *volumes,
                                 const struct hsr_edges *edges,
                                 struct hsr_error *err) {
  *volumes = hsr_volumes();
  volumes->edges = edges;
  try {
    make(volumes);
    return HSR_OK;
  } catch (const std::bad_alloc &) {
    return hsr_fail_nomem(err);
  } catch (...) {
    return hsr_fail(err, HSR_E_INTERNAL, "finding the volumes failed");
  }
}

void hsr_volumes_free(struct hsr_volumes *volumes) {
  hsr_arena_free(&volumes->arena);
}
