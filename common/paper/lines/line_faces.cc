// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/paper/lines/line_faces.h"
#include "common/exact/predicates.h"
#include "common/scene/pieces.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace hsr {

// --- The sides of edges ------------------------------------------------------

namespace {

auto key(const Side &s) {
  return std::make_tuple(s.a, s.b, s.face);
}

void add_sides(std::vector<Side> &sides, const hsr_world *world, uint32_t f,
               int facing) {
  const uint32_t *vertex = world->mesh.vertex + world->mesh.start[f];
  const uint32_t n = hsr_face_size(world, f);
  for (uint32_t k = 0; k < n; k++) {
    const uint32_t p = vertex[k], q = vertex[k + 1 < n ? k + 1 : 0];
    sides.push_back(
        {std::min(p, q), std::max(p, q), f, p < q ? 1 : -1, facing});
  }
}

// A face that has an edge an even number of times runs along a bridge there; of
// an odd number of times, one is kept.
void drop_bridges(std::vector<Side> &sides) {
  size_t kept = 0;
  for (size_t k = 0, n = 0; k < sides.size(); k++) {
    n++;
    if (k + 1 < sides.size() && key(sides[k]) == key(sides[k + 1]))
      continue;
    if (n % 2)
      sides[kept++] = sides[k];
    n = 0;
  }
  sides.resize(kept);
}

} // namespace

Sides::Sides(const hsr_world *world, const hsr_view *view) {
  bool out_of_memory = false;
  for (uint32_t f = 0; f < world->n_faces; f++) {
    const int facing =
        hsr_exact_eye_side(view, hsr_plane_loop(world, f), &out_of_memory);
    const bool exists = facing > 0 || !world->mesh.one_sided[f];
    add_sides(side_, world, f, exists ? facing : 0);
  }
  if (out_of_memory)
    throw std::bad_alloc();
  std::sort(side_.begin(), side_.end(),
            [](const Side &s, const Side &t) { return key(s) < key(t); });
  drop_bridges(side_);
}

std::pair<const Side *, const Side *> Sides::of(uint32_t a, uint32_t b) const {
  const auto first = std::lower_bound(
      side_.begin(), side_.end(), std::make_pair(a, b),
      [](const Side &s, const std::pair<uint32_t, uint32_t> &edge) {
        return std::make_pair(s.a, s.b) < edge;
      });
  auto last = first;
  while (last != side_.end() && last->a == a && last->b == b)
    ++last;
  return {side_.data() + (first - side_.begin()),
          side_.data() + (last - side_.begin())};
}

// --- The class of a line -----------------------------------------------------

Line_faces::Line_faces(const hsr_world *world, double crease)
    : world_(world),
      least_cosine_(std::cos(std::max(crease, 0.0) * (M_PI / 180))) {}

void Line_faces::add(const Side &side, int along) {
  if (side.facing)
    side_.push_back({side.face, side.facing, side.along * along});
  else
    n_absent_++;
}

// Whether face g, on the same side of the line as f, is behind f, seen from the
// eye. The inside of g lies in the direction N x d from the line, or against it.
bool Line_faces::is_behind(const Beside &f, const Beside &g,
                           const Vector3<Exact> &d) const {
  if (world_->mesh.plane[f.face] == world_->mesh.plane[g.face])
    return false;
  const FacePlane<Exact> plane_f(world_, f.face), plane_g(world_, g.face);
  const int side =
      CGAL::sign(plane_f.normal * CGAL::cross_product(plane_g.normal, d));
  return side * g.along * f.facing < 0;
}

// The nearest face on one side of the line; NULL: there is none.
const Line_faces::Beside *Line_faces::nearest(bool left,
                                              const Vector3<Exact> &d) const {
  const Beside *best = nullptr;
  for (const Beside &s : side_)
    if (s.left() == left && (!best || is_behind(s, *best, d)))
      best = &s;
  return best;
}

hsr_line_class Line_faces::between(const Beside &f, const Beside &g) const {
  const hsr_mesh &mesh = world_->mesh;
  const double *const normal[3] = {mesh.nx, mesh.ny, mesh.nz};
  double ff = 0, gg = 0, fg = 0;
  for (const double *n : normal) {
    ff += n[f.face] * n[f.face];
    gg += n[g.face] * n[g.face];
    fg += n[f.face] * n[g.face] * f.facing * g.facing;
  }
  if (mesh.plane[f.face] != mesh.plane[g.face] &&
      fg / std::sqrt(ff) / std::sqrt(gg) < least_cosine_)
    return HSR_LINE_CREASE;
  const hsr_place p = hsr_place_of(world_, f.face),
                  q = hsr_place_of(world_, g.face);
  if (!std::equal(hsr_face_rgb(p.object, p.face),
                  hsr_face_rgb(p.object, p.face) + 3,
                  hsr_face_rgb(q.object, q.face)) ||
      hsr_face_opacity(p.object, p.face) != hsr_face_opacity(q.object, q.face))
    return HSR_LINE_COLOUR;
  return mesh.instance[f.face] != mesh.instance[g.face] ? HSR_LINE_SEAM
                                                        : HSR_LINE_SMOOTH;
}

hsr_line_class Line_faces::find(const Vector3<Exact> &d) const {
  const Beside *left = nearest(true, d), *right = nearest(false, d);
  if (left && right)
    return between(*left, *right);
  if (side_.empty())
    return HSR_LINE_INTERSECTION;
  return side_.size() + n_absent_ == 1 ? HSR_LINE_BOUNDARY
                                       : HSR_LINE_SILHOUETTE;
}

} // namespace hsr
