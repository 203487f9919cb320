// SPDX-License-Identifier: GPL-3.0-or-later
// The adapters, over CGAL.
//
// Triangles   A convex polygon becomes a fan of triangles. Any other goes
//             through CGAL's constrained Delaunay triangulation, whose
//             predicates are exact, on the coordinate plane that it faces most.
//             The triangles inside the polygon by parity are kept.
// Not flat    If a polygon is not flat, corners may fall together on that
//             coordinate plane, or sides cross there. If the triangles would
//             then cover other samples than the polygon does, it becomes a fan
//             too, whose triangles overlap. Whether it is convex depends on the
//             eye, so it is not divided to be convex.
// Penetration Of every pair of faces whose interiors meet (penetration.cc), one
//             is cut by the plane of the other, wherever that plane passes
//             through it near the other.
// Outlines    A piece's outline is clipped by its cuts, moved outwards by a
//             margin well above every rounding, so that it holds the piece. A
//             plane that misses the outline by more than the margin misses the
//             piece; of any other plane the exact piece is asked (convex.h). If
//             a face is not flat, the place where its plane is seen before a
//             vertex depends on the eye. So the outlines of its pieces are not
//             handed on; they are divided as if the face lay on its plane.

#include "common/adapt/adapt.h"
#include "common/adapt/convex.h"
#include "common/adapt/division.h"
#include "common/exact/exact_plane.h"
#include "common/statistics/penetration.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <set>
#include <utility>
#include <vector>

namespace {

using namespace hsr;
using Triangle = std::array<uint32_t, 3>;

// --- Polygons into triangles -----------------------------------------------

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Flat_point = Kernel::Point_2;

// The corners of face f on the coordinate plane that it faces most, which is
// turned as the face is: counterclockwise stays counterclockwise.
std::vector<Flat_point> flatten(const hsr_world &world, uint32_t f) {
  const Projection along = projection_of(&world, f);
  const size_t drop = size_t(along.axis);
  const size_t right = (drop + (along.sign > 0 ? 1 : 2)) % 3;
  std::vector<Flat_point> points;
  for (uint32_t k = world.mesh.start[f]; k < world.mesh.start[f + 1]; k++) {
    const Point p = point_of(world, world.mesh.vertex[k]);
    points.emplace_back(p[right], p[3 - drop - right]);
  }
  return points;
}

// Whether a polygon is convex: it turns to one side only, and once around.
bool is_convex(const std::vector<Flat_point> &p) {
  const size_t n = p.size();
  bool left = false, right = false;
  int changes = 0;
  CGAL::Comparison_result last = CGAL::EQUAL, first = CGAL::EQUAL;
  for (size_t k = 0; k < n; k++) {
    const Flat_point &a = p[k], &b = p[(k + 1) % n], &c = p[(k + 2) % n];
    const CGAL::Orientation turn = CGAL::orientation(a, b, c);
    left |= turn == CGAL::LEFT_TURN;
    right |= turn == CGAL::RIGHT_TURN;
    /* The orientation does not show where it turns back on itself. */
    if (turn == CGAL::COLLINEAR && CGAL::angle(a, b, c) == CGAL::ACUTE)
      return false;
    const CGAL::Comparison_result way = CGAL::compare_xy(a, b);
    if (way == CGAL::EQUAL)
      return false;
    if (first == CGAL::EQUAL)
      first = way;
    changes += last != CGAL::EQUAL && way != last;
    last = way;
  }
  changes += last != first;
  return !(left && right) && changes == 2;
}

using Vertex_base =
    CGAL::Triangulation_vertex_base_with_info_2<uint32_t, Kernel>;
using Face_base = CGAL::Constrained_triangulation_face_base_2<
    Kernel, CGAL::Triangulation_face_base_with_info_2<int, Kernel>>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<Vertex_base, Face_base>,
    CGAL::No_constraint_intersection_requiring_constructions_tag>;

void add_triangle(const Piece &whole, const Triangle &corners, List &list) {
  Piece piece = whole;
  piece.loop.assign(corners.begin(), corners.end());
  list.add(piece, false);
}

void add_fan(const Piece &whole, List &list) {
  for (size_t k = 2; k < whole.loop.size(); k++)
    add_triangle(whole, {whole.loop[0], whole.loop[k - 1], whole.loop[k]},
                 list);
}

// Whether every side of the loop belongs to an odd number of triangles, and any
// other side to an even number. Then the triangles cover by parity what the
// loop covers, seen from anywhere.
bool border(const std::vector<Triangle> &triangles,
            const std::vector<uint32_t> &loop) {
  std::set<std::pair<uint32_t, uint32_t>> odd;
  const auto toggle = [&](uint32_t a, uint32_t b) {
    const auto side = std::minmax(a, b);
    if (a != b && !odd.erase(side))
      odd.insert(side);
  };
  for (const Triangle &t : triangles)
    for (size_t k = 0; k < 3; k++)
      toggle(t[k], t[(k + 1) % 3]);
  for (size_t k = 0; k < loop.size(); k++)
    toggle(loop[k], loop[(k + 1) % loop.size()]);
  return odd.empty();
}

using Vertex = Triangulation::Vertex_handle;

// Edges of a triangulation on which an odd number of a polygon's sides lie.
class Odd_edges {
public:
  void add_side(const Triangulation &triangulation, Vertex from, Vertex to) {
    while (from != to) {
      Vertex next;
      Triangulation::Face_handle face;
      int opposite;
      triangulation.includes_edge(from, to, next, face, opposite);
      const auto edge = std::minmax(from, next);
      if (!edges_.erase(edge))
        edges_.insert(edge);
      from = next;
    }
  }
  bool has(Vertex a, Vertex b) const { return edges_.count(std::minmax(a, b)); }

private:
  std::set<std::pair<Vertex, Vertex>> edges_;
};

// Sets each triangle's info to whether it is inside by parity: from one to the
// next over an odd edge, that changes.
enum : int { OUTSIDE, INSIDE, UNKNOWN };
void find_inside(Triangulation &triangulation, const Odd_edges &odd) {
  for (auto t = triangulation.all_faces_begin();
       t != triangulation.all_faces_end(); ++t)
    t->info() = UNKNOWN;
  triangulation.infinite_face()->info() = OUTSIDE;
  std::vector<Triangulation::Face_handle> found{triangulation.infinite_face()};
  while (!found.empty()) {
    const Triangulation::Face_handle t = found.back();
    found.pop_back();
    for (int k = 0; k < 3; k++) {
      const Triangulation::Face_handle next = t->neighbor(k);
      if (next->info() != UNKNOWN)
        continue;
      const bool change =
          odd.has(t->vertex((k + 1) % 3), t->vertex((k + 2) % 3));
      next->info() = change ? INSIDE + OUTSIDE - t->info() : t->info();
      found.push_back(next);
    }
  }
}

// Finds the triangles of a polygon, from its corners on a coordinate plane.
// False if it crosses itself there.
bool triangulate_loop(const std::vector<uint32_t> &loop,
                      const std::vector<Flat_point> &corners,
                      std::vector<Triangle> &triangles) {
  Triangulation triangulation;
  std::vector<Vertex> at;
  for (size_t k = 0; k < corners.size(); k++) {
    at.push_back(triangulation.insert(corners[k]));
    at.back()->info() = loop[k];
  }
  try {
    for (size_t k = 0, l = at.size() - 1; k < at.size(); l = k++)
      if (at[k] != at[l])
        triangulation.insert_constraint(at[l], at[k]);
  } catch (const Triangulation::Intersection_of_constraints_exception &) {
    return false;
  }
  Odd_edges odd;
  for (size_t k = 0, l = at.size() - 1; k < at.size(); l = k++)
    odd.add_side(triangulation, at[l], at[k]);
  find_inside(triangulation, odd);
  for (auto t = triangulation.finite_faces_begin();
       t != triangulation.finite_faces_end(); ++t)
    if (t->info() == INSIDE)
      triangles.push_back(
          {t->vertex(0)->info(), t->vertex(1)->info(), t->vertex(2)->info()});
  return true;
}

// Adds the triangles of face f, which is not convex.
void add_triangulation(const hsr_world &world, uint32_t f, const Piece &whole,
                       const std::vector<Flat_point> &corners, List &list) {
  std::vector<Triangle> triangles;
  const bool simple = triangulate_loop(whole.loop, corners, triangles);
  if (world.mesh.deviation[f] > 0 &&
      !(simple && border(triangles, whole.loop))) {
    add_fan(whole, list);
    return;
  }
  if (!simple)
    throw Not_adapted{HSR_CF, hsr_world_parent(&world, f), "crosses itself"};
  for (const Triangle &t : triangles)
    add_triangle(whole, t, list);
}

// Divides all polygons that are not triangles, or, if keep_convex, only those
// that are not convex.
hsr_status divide_polygons(const hsr_world *in, bool keep_convex,
                           hsr_world *out, bool *changed, hsr_error *err) {
  return guarded(err, [&]() -> hsr_status {
    *changed = false;
    if (in->roster.all_triangles)
      return HSR_OK;
    List list;
    for (uint32_t f = 0; f < in->n_faces; f++) {
      const Piece whole = piece_of(*in, f);
      if (whole.loop.size() == 3) {
        list.add(whole, true);
        continue;
      }
      const std::vector<Flat_point> corners = flatten(*in, f);
      const bool convex = is_convex(corners);
      const bool keep = keep_convex && (convex || in->mesh.deviation[f] > 0);
      const size_t before = list.size();
      if (keep)
        list.add(whole, true);
      else if (convex)
        add_fan(whole, list);
      else
        add_triangulation(*in, f, whole, corners, list);
      *changed |= !keep;
      if (list.size() == before) /* it has no inside, but must have a piece */
        list.add(whole, true);
    }
    return *changed ? list.make(out, whole_of(*in), err) : HSR_OK;
  });
}

hsr_status triangulate(const hsr_world *in, hsr_world *out, bool *changed,
                       hsr_error *err) {
  return divide_polygons(in, false, out, changed, err);
}

hsr_status make_convex(const hsr_world *in, hsr_world *out, bool *changed,
                       hsr_error *err) {
  return divide_polygons(in, true, out, changed, err);
}

// --- Division at penetrations ------------------------------------------------

// A scene that would have more pieces than this is refused.
const size_t MOST_PIECES = 4000000;

// Covers what underflows in a height, as in common/exact/order.c.
const double TINY = 0x1p-960;

// The plane of a face in doubles. The margin is above every rounding of it, and
// above the distance by which the vertices of the face that it cuts are out of
// their plane.
struct Cutter {
  uint32_t face;
  Point n, p;
  double margin;
  double reach = 0; // the largest coordinate of both faces

  Cutter(const hsr_world &world, uint32_t g, uint32_t cut_face)
      : face(g), n{world.mesh.nx[g], world.mesh.ny[g], world.mesh.nz[g]},
        p{world.mesh.px[g], world.mesh.py[g], world.mesh.pz[g]} {
    const double n1 = std::fabs(n[0]) + std::fabs(n[1]) + std::fabs(n[2]);
    for (uint32_t h : {g, cut_face})
      for (uint32_t k = world.mesh.start[h]; k < world.mesh.start[h + 1]; k++)
        for (double c : point_of(world, world.mesh.vertex[k]))
          reach = std::fmax(reach, std::fabs(c));
    const double scale =
        std::fmax(std::fabs(world.mesh.nx[cut_face]),
                  std::fmax(std::fabs(world.mesh.ny[cut_face]),
                            std::fabs(world.mesh.nz[cut_face])));
    margin = 4 * (world.mesh.n_error[g] * 6 * reach +
                  world.mesh.anchor_error[g] * n1) +
             0x1p-40 * n1 * reach + 2 * world.mesh.deviation[g] + TINY;
    // Infinite where the normal is too small for doubles.
    if (world.mesh.deviation[cut_face] > 0)
      margin += 2 * n1 * (world.mesh.deviation[cut_face] / scale);
  }

  double height(const Point &v) const {
    return n[0] * (v[0] - p[0]) + n[1] * (v[1] - p[1]) + n[2] * (v[2] - p[2]);
  }
};

// The part of an outline on one side of the plane, or within the margin on the
// other.
std::vector<Point> clip(const std::vector<Point> &outline, const Cutter &plane,
                        int side) {
  std::vector<Point> kept;
  for (size_t k = 0, l = outline.size() - 1; k < outline.size(); l = k++) {
    const Point &a = outline[l], &b = outline[k];
    const double ha = side * plane.height(a) + plane.margin;
    const double hb = side * plane.height(b) + plane.margin;
    if ((ha >= 0) != (hb >= 0)) {
      const double t = ha / (ha - hb);
      kept.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]),
                      a[2] + t * (b[2] - a[2])});
    }
    if (hb >= 0)
      kept.push_back(b);
  }
  return kept;
}

// Whether the plane may pass through what an outline holds.
bool reaches_both_sides(const std::vector<Point> &outline,
                        const Cutter &plane) {
  bool front = false, behind = false;
  for (const Point &p : outline) {
    const double h = plane.height(p);
    front |= h > -plane.margin;
    behind |= h < plane.margin;
  }
  return front && behind;
}

// Whether the boxes of an outline and of face g meet, with some room: an
// outline's point is off by a few roundings of the largest coordinate, `reach`,
// of the vertices that it lies between.
bool near_face(const std::vector<Point> &outline, const hsr_world &world,
               uint32_t g, double reach) {
  for (size_t c = 0; c < 3; c++) {
    double lo = INFINITY, hi = -INFINITY, from = INFINITY, to = -INFINITY;
    for (const Point &p : outline) {
      lo = std::fmin(lo, p[c]);
      hi = std::fmax(hi, p[c]);
    }
    for (uint32_t k = world.mesh.start[g]; k < world.mesh.start[g + 1]; k++) {
      const double v = point_of(world, world.mesh.vertex[k])[c];
      from = std::fmin(from, v);
      to = std::fmax(to, v);
    }
    const double room = 0x1p-40 * reach;
    if (lo > to + room || from > hi + room)
      return false;
  }
  return true;
}

// Replaces every piece that the plane of g passes through, near g, by two.
void cut_pieces(const hsr_world &whole, uint32_t g, const Convex_pieces &shapes,
                std::vector<Piece> &pieces) {
  const size_t n = pieces.size();
  for (size_t k = 0; k < n; k++) {
    const Cutter plane(whole, g, pieces[k].parent);
    if (!reaches_both_sides(pieces[k].outline, plane) ||
        !near_face(pieces[k].outline, whole, g, plane.reach) ||
        !shapes.may_cross(pieces[k], g))
      continue;
    Piece behind = pieces[k];
    behind.outline = clip(pieces[k].outline, plane, -1);
    behind.cuts.push_back({g, -1});
    pieces[k].outline = clip(pieces[k].outline, plane, +1);
    pieces[k].cuts.push_back({g, +1});
    pieces.push_back(std::move(behind));
  }
}

// Chooses which face of each pair that penetrates is cut by the plane of the
// other: the one that has fewer cuts so far. Returns the cutting faces of each
// face.
std::vector<std::vector<uint32_t>> choose_cuts(const hsr_world &whole,
                                               bool *any) {
  std::vector<uint32_t> faces(whole.n_faces);
  for (uint32_t f = 0; f < whole.n_faces; f++)
    faces[f] = f;
  std::vector<std::vector<uint32_t>> cuts(whole.n_faces);
  hsr::for_each_penetration(&whole, faces.data(), faces.size(),
                            [&](uint32_t f, uint32_t g) {
                              if (cuts[f].size() > cuts[g].size())
                                std::swap(f, g);
                              cuts[f].push_back(g);
                              *any = true;
                            });
  return cuts;
}

hsr_status divide(const hsr_world *in, hsr_world *out, bool *changed,
                  hsr_error *err) {
  return guarded(err, [&]() -> hsr_status {
    const hsr_world &whole = whole_of(*in);
    *changed = false;
    const std::vector<std::vector<uint32_t>> cuts = choose_cuts(whole, changed);
    if (!*changed)
      return HSR_OK;
    const Convex_pieces shapes(*in);
    List list;
    std::vector<Piece> pieces;
    for (uint32_t f = 0; f < in->n_faces; f++) {
      pieces.assign(1, piece_of(*in, f));
      const uint32_t parent = pieces[0].parent;
      const bool known = !pieces[0].outline.empty();
      if (!known)
        for (uint32_t v : pieces[0].loop)
          pieces[0].outline.push_back(point_of(whole, v));
      for (uint32_t g : cuts[parent]) {
        cut_pieces(whole, g, shapes, pieces);
        if (list.size() + pieces.size() > MOST_PIECES)
          throw Not_adapted{HSR_NP, parent, "is penetrated by too many others"};
      }
      const bool divided = pieces.size() > 1 || known;
      for (const Piece &piece : pieces)
        list.add(piece, divided && whole.mesh.deviation[parent] == 0);
    }
    return list.make(out, whole, err);
  });
}

} // namespace

std::vector<std::vector<uint32_t>> hsr::convex_loops(const hsr_world &world,
                                                     uint32_t f) {
  const Piece whole = piece_of(world, f);
  if (whole.loop.size() == 3)
    return {whole.loop};
  const std::vector<Flat_point> corners = flatten(world, f);
  if (is_convex(corners))
    return {whole.loop};
  std::vector<Triangle> triangles;
  std::vector<std::vector<uint32_t>> loops;
  triangulate_loop(whole.loop, corners, triangles);
  for (const Triangle &t : triangles)
    loops.emplace_back(t.begin(), t.end());
  return loops;
}

const struct hsr_adapter hsr_adapters[] = {
    {"triangulate", HSR_TR, "divides polygons into triangles", triangulate,
     nullptr},
    {"convex-parts", HSR_CF, "divides polygons that are not convex",
     make_convex, nullptr},
    {"divide", HSR_NP, "divides faces where they penetrate", divide, nullptr},
    {"cluster", HSR_LS,
     "makes clusters of faces, with planes that separate them", cluster,
     nullptr},
    {"priorities", HSR_LS | HSR_TP,
     "gives the faces of a cluster priorities that hold from everywhere",
     give_priorities, keep_priorities},
    {nullptr, 0, nullptr, nullptr, nullptr}};

const char *hsr_restriction_code(unsigned restriction) {
  static const char *const code[] = {"CC", "CF", "TR", "LS", "NP",
                                     "TP", "PF", "OF", "BE"};
  for (unsigned k = 0; k < sizeof code / sizeof *code; k++)
    if (restriction == 1u << k)
      return code[k];
  return "";
}

enum hsr_status hsr_check_unadapted(const struct hsr_world *world,
                                    const char *what, struct hsr_error *err) {
  hsr_world parts = {};
  bool divided = false;
  hsr_status status = make_convex(world, &parts, &divided, err);
  if (divided)
    hsr_world_free(&parts);
  if (status || divided)
    return status ? status
                  : hsr_fail(err, HSR_E_REFUSED,
                             "CF: %s, which is not laid out, has faces that "
                             "are not convex",
                             what);
  for (uint32_t f = 0; f < world->n_faces; f++)
    if (world->mesh.deviation[f] > 0)
      return hsr_fail(err, HSR_E_REFUSED,
                      "PF: %s, which is not laid out, has faces that are not "
                      "flat",
                      what);
  return HSR_OK;
}
