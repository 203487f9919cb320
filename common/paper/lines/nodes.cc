// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/paper/lines/nodes.h"

#include <algorithm>

namespace hsr {

// --- The edges of a drawing --------------------------------------------------

uint32_t Drawn_edges::of_vertex(const hsr_world *world, uint32_t v) {
  if (of_[v] == NONE) {
    of_[v] = uint32_t(place.size());
    place.push_back(Place::vertex(world, v));
  }
  return of_[v];
}

// The implied edges of the pairs of faces that the drawing names.
void Drawn_edges::find_implied(const hsr_world *world) {
  size_t k = 0;
  while (k < edge.size() && !edge[k].name.implied)
    k++;
  while (k < edge.size()) {
    const uint32_t f = edge[k].name.a, g = edge[k].name.b;
    uint32_t part = 0;
    for_each_implied_edge(
        world, f, g, [&](const Exact_point &from, const Exact_point &to) {
          if (k < edge.size() && edge[k].name.a == f && edge[k].name.b == g &&
              edge[k].name.part == part) {
            edge[k].a = uint32_t(place.size());
            edge[k].b = edge[k].a + 1;
            place.push_back(Place::of(from));
            place.push_back(Place::of(to));
            k++;
          }
          part++;
        });
    while (k < edge.size() && edge[k].name.a == f && edge[k].name.b == g)
      k++; // not of this world
  }
}

Drawn_edges::Drawn_edges(const hsr_world *world, const hsr_drawing *drawing)
    : of_(world->mesh.n_vertices, NONE) {
  for (size_t k = 0; k < drawing->n; k++) {
    const hsr_edge_name &name = drawing->segment[k].edge;
    if (edge.empty() || hsr_edge_name_compare(&edge.back().name, &name) != 0)
      edge.push_back({name, NONE, NONE, k, 0});
    edge.back().n++;
  }
  for (Edge &e : edge)
    if (!e.name.implied) {
      e.a = of_vertex(world, e.name.a);
      e.b = of_vertex(world, e.name.b);
    }
  find_implied(world);
}

// --- Planes  -------------------------------------------

bool Planes::is_in(uint32_t e, uint32_t plane) const {
  const uint32_t first = edges[plane].front();
  const Place &a = all_.a(first), &b = all_.b(first);
  return !side_of(a, b, centre_, all_.a(e)) &&
         !side_of(a, b, centre_, all_.b(e));
}

// The normal of the plane of two places and the centre.
static void find_normal(const Place &a, const Place &b, const Place &centre,
                        Safe_interval n[3]) {
  const Rough_row &p = a.rough, &q = b.rough, &c = centre.rough;
  const auto relative = [&](const Rough_row &row, size_t k) {
    return CGAL::is_zero(c[3].sup()) ? row[k] : row[k] - c[k] * row[3];
  };
  for (size_t k = 0; k < 3; k++) {
    const size_t u = (k + 1) % 3, v = (k + 2) % 3;
    if (c[3].sup() > 0) // from a point
      n[k] = relative(p, u) * relative(q, v) - relative(p, v) * relative(q, u);
    else // along a direction
      n[k] = (q[u] * p[3] - p[u] * q[3]) * c[v] -
             (q[v] * p[3] - p[v] * q[3]) * c[u];
  }
}

void Planes::add(uint32_t e) {
  Safe_interval n[3];
  find_normal(all_.a(e), all_.b(e), centre_, n);
  std::vector<Cells::Cell> reached;
  bool known = false;
  for (size_t w = 0; w < 3; w++) {
    if (n[w].inf() <= 0 && n[w].sup() >= 0)
      continue;
    const Safe_interval u = n[(w + 1) % 3] / n[w], v = n[(w + 2) % 3] / n[w];
    if (u.inf() > 1 || u.sup() < -1 || v.inf() > 1 || v.sup() < -1)
      continue;
    known |= cells_.reach(int(w), u, v, [&](const Cells::Cell &cell) {
      reached.push_back(cell);
    });
  }
  for (const Cells::Cell &cell : reached)
    if (const std::vector<uint32_t> *planes = cells_.at(cell))
      for (uint32_t plane : *planes)
        if (is_in(e, plane)) {
          edges[plane].push_back(e);
          return;
        }
  if (known)
    for (const Cells::Cell &cell : reached)
      cells_.put(cell, uint32_t(edges.size()));
  edges.push_back({e});
}

Planes::Planes(const Drawn_edges &edges_of, const Place &centre)
    : all_(edges_of), centre_(centre) {}

// --- Nodes -------------------------------------------------------------------

Nodes::Nodes(const Drawn_edges &edges, const Place &eye, const hsr_view *view)
    : edges_(edges), eye_(eye), view_(view), screen_(view),
      of_(edges.place.size(), NONE) {
  for (size_t k = 0; k < edges.place.size(); k++)
    of_named(uint32_t(k));
}

uint32_t Nodes::add(const std::array<double, 2> &image) {
  at.push_back({std::min(std::max(image[0], 0.0), double(view_->m)),
                std::min(std::max(image[1], 0.0), double(view_->n))});
  return uint32_t(at.size() - 1);
}

static double middle(const Safe_interval &x) {
  return x.inf() + (x.sup() - x.inf()) / 2;
}

uint32_t Nodes::of_named(uint32_t p) {
  if (of_[p] != NONE)
    return of_[p];
  const Place &place = edges_.place[p];
  Safe_interval image[2];
  if (!screen_.find(place.rough, image))
    return of_[p] = add({0, 0}); // behind the eye: no line ends there
  std::vector<Cells::Cell> reached;
  cells_.reach(0, image[0], image[1],
               [&](const Cells::Cell &cell) { reached.push_back(cell); });
  for (const Cells::Cell &cell : reached)
    if (const std::vector<uint32_t> *others = cells_.at(cell))
      for (uint32_t q : *others)
        if (at_one_image(place, edges_.place[q], eye_))
          return of_[p] = of_[q];
  for (const Cells::Cell &cell : reached)
    cells_.put(cell, p);
  return of_[p] = add({middle(image[0]), middle(image[1])});
}

std::array<double, 2> Nodes::image_of(const double point[3]) const {
  double p[3];
  hsr_view_project(view_, point, p);
  const double w = hsr_view_w(view_, p);
  return {p[0] / w, p[1] / w};
}

// Whether the image of x is between those of lo and hi, on one line with them.
static bool is_between(const Place &lo, const Place &x, const Place &hi,
                       const Place &eye) {
  for (int axis = 0; axis < 3; axis++) {
    const Place aside = Place::axis(axis);
    if (side_of(lo, hi, eye, aside))
      return side_of(lo, x, eye, aside) * side_of(x, hi, eye, aside) >= 0;
  }
  return false;
}

// The named places whose images lie on the line of an edge, and near a part of the
// picture.
std::vector<uint32_t> Nodes::find_named(uint32_t e,
                                        const Safe_interval box[2]) const {
  std::vector<uint32_t> found;
  cells_.reach(0, box[0], box[1], [&](const Cells::Cell &cell) {
    if (const std::vector<uint32_t> *others = cells_.at(cell))
      for (uint32_t q : *others)
        if (!side_of(edges_.a(e), edges_.b(e), eye_, edges_.place[q]))
          found.push_back(q);
  });
  return found;
}

uint32_t Nodes::of_change(uint32_t e, double t, const double point[3]) {
  const Place &a = edges_.a(e), &b = edges_.b(e);
  const double before = t - CHANGE_ERROR * t, after = t + CHANGE_ERROR * t;
  Safe_interval image[2];
  if (!screen_.find(Place::rough_between(a, b, before, after), image) ||
      find_named(e, image).empty())
    return add(image_of(point));
  return of_change(e, Place::between(a, b, before), Place::between(a, b, after),
                   point);
}

uint32_t Nodes::of_change(uint32_t e, const Place &lo, const Place &hi,
                          const double point[3]) {
  Safe_interval from[2], to[2], box[2];
  if (!screen_.find(lo.rough, from) || !screen_.find(hi.rough, to))
    return add(image_of(point));
  for (int c = 0; c < 2; c++)
    box[c] = CGAL::Interval_nt<true>(std::min(from[c].inf(), to[c].inf()),
                                     std::max(from[c].sup(), to[c].sup()));
  for (uint32_t q : find_named(e, box))
    if (is_between(lo, edges_.place[q], hi, eye_))
      return of_[q];
  return add(image_of(point));
}

} // namespace hsr
