// SPDX-License-Identifier: GPL-3.0-or-later
// The lines of a drawing, each once.
//
// Straight    An edge and the eye span a plane, whose normal is found in
//             intervals. Edges whose normals may be parallel are neighbours in a
//             table, and are compared exactly. An edge so short that its normal
//             is not known to 2^-14 is laid over no other.
// Laid over   On a line of several edges, the ends of all intervals are sorted
//             exactly. Between two ends, the best of what lies there is drawn.

#include "common/paper/lines.h"
#include "common/paper/cells.h"
#include "common/paper/line_faces.h"
#include "common/paper/places.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <new>
#include <optional>

using namespace hsr;

namespace {

constexpr uint32_t NONE = 0xffffffffu;

// An edge of the drawing, with its intervals.
struct Edge {
  hsr_edge_name name;
  uint32_t a, b; // its ends, named places
  size_t first, n;
};

// --- The places of a drawing -------------------------------------------------

class Places {
public:
  Places(const hsr_world *world, const hsr_drawing *drawing);
  std::vector<Edge> edge;
  std::vector<Place> place; // of vertices, then of ends of implied edges
  size_t n_vertices;        // how many are of vertices

private:
  uint32_t of_vertex(const hsr_world *world, uint32_t v);
  void find_implied(const hsr_world *world);
  std::vector<uint32_t> of_;
};

uint32_t Places::of_vertex(const hsr_world *world, uint32_t v) {
  if (of_[v] == NONE) {
    of_[v] = uint32_t(place.size());
    place.push_back(Place::vertex(world, v));
  }
  return of_[v];
}

// The implied edges of the pairs of faces that the drawing names.
void Places::find_implied(const hsr_world *world) {
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

Places::Places(const hsr_world *world, const hsr_drawing *drawing)
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
  n_vertices = place.size();
  find_implied(world);
}

// --- Straight lines of the picture -------------------------------------------

class Straights {
public:
  Straights(const Places &places, const Place &eye);
  std::vector<std::vector<uint32_t>> edges; // of each line

private:
  void add(uint32_t e);
  bool is_on(uint32_t e, uint32_t line) const;
  const Places &places_;
  const Place &eye_;
  Cells cells_{0x1p-20};
};

bool Straights::is_on(uint32_t e, uint32_t line) const {
  const Edge &first = places_.edge[edges[line].front()],
             &edge = places_.edge[e];
  const Place &a = places_.place[first.a], &b = places_.place[first.b];
  return !side_of(a, b, eye_, places_.place[edge.a]) &&
         !side_of(a, b, eye_, places_.place[edge.b]);
}

// The normal of the plane of two places and the eye.
void find_normal(const Place &a, const Place &b, const Place &eye,
                 Safe_interval n[3]) {
  const Rough_row &p = a.rough, &q = b.rough, &c = eye.rough;
  const auto relative = [&](const Rough_row &row, size_t k) {
    return CGAL::is_zero(c[3].sup()) ? row[k] : row[k] - c[k] * row[3];
  };
  for (size_t k = 0; k < 3; k++) {
    const size_t u = (k + 1) % 3, v = (k + 2) % 3;
    if (c[3].sup() > 0) // from the eye
      n[k] = relative(p, u) * relative(q, v) - relative(p, v) * relative(q, u);
    else // along the rays
      n[k] = (q[u] * p[3] - p[u] * q[3]) * c[v] -
             (q[v] * p[3] - p[v] * q[3]) * c[u];
  }
}

void Straights::add(uint32_t e) {
  const Edge &edge = places_.edge[e];
  Safe_interval n[3];
  find_normal(places_.place[edge.a], places_.place[edge.b], eye_, n);
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
    if (const std::vector<uint32_t> *lines = cells_.at(cell))
      for (uint32_t line : *lines)
        if (is_on(e, line)) {
          edges[line].push_back(e);
          return;
        }
  if (known)
    for (const Cells::Cell &cell : reached)
      cells_.put(cell, uint32_t(edges.size()));
  edges.push_back({e});
}

Straights::Straights(const Places &places, const Place &eye)
    : places_(places), eye_(eye) {
  for (uint32_t e = 0; e < places.edge.size(); e++)
    if (places.edge[e].a != NONE)
      add(e);
}

// --- Nodes -------------------------------------------------------------------

class Nodes {
public:
  Nodes(const Places &places, const Place &eye, const hsr_view *view)
      : places_(places), eye_(eye), view_(view),
        of_(places.place.size(), NONE) {
    for (size_t k = places.n_vertices; k < places.place.size(); k++)
      of_named(uint32_t(k));
  }
  std::vector<std::array<double, 2>> at;

  // The node of a named place.
  uint32_t of_named(uint32_t place);
  // A new node, at a point of the world.
  uint32_t at_point(const double point[3]);
  // The node of a change of visibility on an edge, between two places that bound
  // it: that of an end of an implied edge if one is there, else a new one.
  uint32_t of_change(const Edge &edge, const Place &lo, const Place &hi,
                     const double point[3]);

private:
  uint32_t add(double x, double y) {
    at.push_back({std::min(std::max(x, 0.0), double(view_->m)),
                  std::min(std::max(y, 0.0), double(view_->n))});
    return uint32_t(at.size() - 1);
  }
  const Places &places_;
  const Place &eye_;
  const hsr_view *view_;
  std::vector<uint32_t> of_;
  Cells cells_{0x1p-20}; // of named places, by their images
};

double middle(const Safe_interval &x) {
  return x.inf() + (x.sup() - x.inf()) / 2;
}

uint32_t Nodes::of_named(uint32_t p) {
  if (of_[p] != NONE)
    return of_[p];
  const Place &place = places_.place[p];
  Safe_interval image[2];
  if (!find_image(place, view_, image))
    return of_[p] = add(0, 0); // behind the eye: no line ends there
  std::vector<Cells::Cell> reached;
  cells_.reach(0, image[0], image[1],
               [&](const Cells::Cell &cell) { reached.push_back(cell); });
  for (const Cells::Cell &cell : reached)
    if (const std::vector<uint32_t> *others = cells_.at(cell))
      for (uint32_t q : *others)
        if (at_one_image(place, places_.place[q], eye_))
          return of_[p] = of_[q];
  for (const Cells::Cell &cell : reached)
    cells_.put(cell, p);
  return of_[p] = add(middle(image[0]), middle(image[1]));
}

uint32_t Nodes::at_point(const double point[3]) {
  double image[3];
  hsr_view_project(view_, point, image);
  const double w = hsr_view_w(view_, image);
  return add(image[0] / w, image[1] / w);
}

// Whether the image of x is between those of lo and hi, on one line with them.
bool is_between(const Place &lo, const Place &x, const Place &hi,
                const Place &eye) {
  for (int axis = 0; axis < 3; axis++) {
    const Place aside = Place::axis(axis);
    if (side_of(lo, hi, eye, aside))
      return side_of(lo, x, eye, aside) * side_of(x, hi, eye, aside) >= 0;
  }
  return false;
}

uint32_t Nodes::of_change(const Edge &edge, const Place &lo, const Place &hi,
                          const double point[3]) {
  Safe_interval from[2], to[2];
  uint32_t found = NONE;
  if (places_.n_vertices < places_.place.size() &&
      find_image(lo, view_, from) && find_image(hi, view_, to))
    cells_.reach(0,
                 CGAL::Interval_nt<true>(std::min(from[0].inf(), to[0].inf()),
                                         std::max(from[0].sup(), to[0].sup())),
                 CGAL::Interval_nt<true>(std::min(from[1].inf(), to[1].inf()),
                                         std::max(from[1].sup(), to[1].sup())),
                 [&](const Cells::Cell &cell) {
                   const std::vector<uint32_t> *others = cells_.at(cell);
                   for (size_t k = 0; others && k < others->size(); k++) {
                     const uint32_t q = (*others)[k];
                     const Place &a = places_.place[edge.a],
                                 &b = places_.place[edge.b],
                                 &x = places_.place[q];
                     if (q < places_.n_vertices || side_of(a, b, eye_, x))
                       continue;
                     if (is_between(lo, x, hi, eye_))
                       found = of_[q];
                   }
                 });
  return found != NONE ? found : at_point(point);
}

// --- Laying over one another -------------------------------------------------

// An end of an interval.
struct End {
  std::optional<Place> at, lo, hi; // exact, and its bounds; set where there are
                                   // several edges on a line
  uint32_t named = NONE;           // a named place
  size_t segment;
  uint32_t edge;
  bool first; // the interval begins there, in the direction of the line
  const double *point;
};

class Finder {
public:
  Finder(const hsr_drawing *drawing, const hsr_world *world,
         const hsr_view *view, double crease, const hsr_line_pens *pens)
      : drawing_(drawing), world_(world), pens_(pens), eye_(eye_of(view)),
        places_(world, drawing), nodes_(places_, eye_, view),
        sides_(world, view), faces_(world, crease) {}

  void find();
  // By interval of the drawing.
  void classify(hsr_line_class *line_class, uint32_t *object);
  std::vector<hsr_paper_line> lines;
  const std::vector<std::array<double, 2>> &nodes() const { return nodes_.at; }

private:
  void draw_alone(uint32_t straight, uint32_t e);
  void lay_over(uint32_t straight, const std::vector<uint32_t> &edges);

  uint32_t object_of(const Edge &edge) const;
  hsr_line_class class_of(const std::vector<uint32_t> &edges);
  Vector3<Exact> direction(const Edge &edge) const;

  End end_of(uint32_t e, size_t segment, bool to) const;
  void bound(End &end) const;
  uint32_t node_of(const End &first, const End &last);
  bool is_before(const Place &p, const Place &q) const {
    return side_of(p, q, eye_, *aside_) * turn_ > 0;
  }
  void choose_axis(const Edge &edge);
  std::vector<uint32_t> in_space(const std::vector<uint32_t> &edges) const;
  void draw_best(uint32_t straight, uint32_t from, uint32_t to,
                 const std::vector<uint32_t> &active);
  void emit(hsr_paper_line line) {
    if (line.from != line.to)
      lines.push_back(line);
  }

  const hsr_drawing *drawing_;
  const hsr_world *world_;
  const hsr_line_pens *pens_;
  const Place eye_;
  Places places_;
  Nodes nodes_;
  Sides sides_;
  Line_faces faces_;

  // Of the line at hand.
  std::optional<Place> aside_; // a place not in its plane
  int turn_ = 0;               // of its first edge, seen from there
  std::vector<End> ends_;
  struct Laid {
    size_t segment;
    uint32_t edge, space; // space: edges of one number lie on one line of space
    uint32_t first, last; // stops
  };
  std::vector<Laid> laid_;
};

// The first face that has the edge and exists.
uint32_t Finder::object_of(const Edge &edge) const {
  if (edge.name.implied)
    return world_->mesh.object[edge.name.a];
  const auto sides = sides_.of(edge.name.a, edge.name.b);
  for (const Side *s = sides.first; s != sides.second; s++)
    if (s->facing)
      return world_->mesh.object[s->face];
  return sides.first != sides.second ? world_->mesh.object[sides.first->face]
                                     : 0;
}

Vector3<Exact> Finder::direction(const Edge &edge) const {
  const Row &a = places_.place[edge.a].exact, &b = places_.place[edge.b].exact;
  return {b[0] * a[3] - a[0] * b[3], b[1] * a[3] - a[1] * b[3],
          b[2] * a[3] - a[2] * b[3]};
}

// The class of a line of space in which these edges lie.
hsr_line_class Finder::class_of(const std::vector<uint32_t> &edges) {
  faces_.clear();
  const Vector3<Exact> d = direction(places_.edge[edges[0]]);
  for (uint32_t e : edges) {
    const Edge &edge = places_.edge[e];
    if (edge.name.implied)
      continue;
    const int along =
        e == edges[0] ? 1 : CGAL::sign(Exact(d * direction(edge)));
    const auto sides = sides_.of(edge.name.a, edge.name.b);
    for (const Side *s = sides.first; s != sides.second; s++)
      faces_.add(*s, along);
  }
  return faces_.find(d);
}

End Finder::end_of(uint32_t e, size_t segment, bool to) const {
  const Edge &edge = places_.edge[e];
  const hsr_segment &s = drawing_->segment[segment];
  End end;
  end.segment = segment;
  end.edge = e;
  end.point = to ? s.to : s.from;
  if (to ? s.t1 == 1 : s.t0 == 0)
    end.named = to ? edge.b : edge.a;
  return end;
}

// docs/correct-drawing.md: parameters have a relative error of 1e-12.
void Finder::bound(End &end) const {
  const Edge &edge = places_.edge[end.edge];
  const hsr_segment &s = drawing_->segment[end.segment];
  const Place &a = places_.place[edge.a], &b = places_.place[edge.b];
  if (end.named != NONE) {
    end.at = end.lo = end.hi = places_.place[end.named];
    return;
  }
  const double t = end.point == s.to ? s.t1 : s.t0;
  end.at = Place::between(a, b, t);
  end.lo = Place::between(a, b, t - 2e-12 * t);
  end.hi = Place::between(a, b, t + 2e-12 * t);
}

uint32_t Finder::node_of(const End &first, const End &last) {
  const Edge &edge = places_.edge[first.edge];
  if (first.named != NONE)
    return nodes_.of_named(first.named);
  if (places_.n_vertices == places_.place.size())
    return nodes_.at_point(first.point); // there are no implied edges
  End bounded = first;
  if (!bounded.at)
    bound(bounded);
  return nodes_.of_change(edge, *bounded.lo, last.hi ? *last.hi : *bounded.hi,
                          first.point);
}

// --- One edge on a line ------------------------------------------------------

void Finder::draw_alone(uint32_t straight, uint32_t e) {
  const Edge &edge = places_.edge[e];
  const hsr_line_class line_class = class_of({e});
  const uint32_t object = object_of(edge);
  uint32_t before = NONE; // the node in which the last interval ends
  for (size_t k = edge.first; k < edge.first + edge.n; k++) {
    const hsr_segment &s = drawing_->segment[k];
    const End from = end_of(e, k, false), to = end_of(e, k, true);
    const uint32_t pen =
        hsr_line_pen_of(pens_, object, line_class, s.invisibility);
    const bool goes_on =
        before != NONE && k > edge.first && drawing_->segment[k - 1].t1 == s.t0;
    const uint32_t p = goes_on ? before : node_of(from, from);
    // Doubles cannot tell ends apart that are so near to one another.
    const bool is_empty = s.t1 - s.t0 <= 0x1p-50 * s.t1;
    const uint32_t q = is_empty && to.named == NONE ? p : node_of(to, to);
    before = q;
    if (pen != HSR_NO_PEN)
      emit({p, q, straight, object, s.invisibility, pen, line_class});
  }
}

// --- Several edges on a line -------------------------------------------------

void Finder::choose_axis(const Edge &edge) {
  for (int k = 0; k < 3; k++) {
    aside_ = Place::axis(k);
    turn_ =
        side_of(places_.place[edge.a], places_.place[edge.b], eye_, *aside_);
    if (turn_)
      return;
  }
  throw std::bad_alloc(); // an edge and the eye span a plane
}

// For each edge a number: edges of one number lie on one line of space.
std::vector<uint32_t>
Finder::in_space(const std::vector<uint32_t> &edges) const {
  std::vector<uint32_t> number, first;
  for (uint32_t e : edges) {
    const Edge &edge = places_.edge[e];
    uint32_t k = 0;
    for (; k < first.size(); k++) {
      const Edge &f = places_.edge[first[k]];
      const Place &a = places_.place[f.a], &b = places_.place[f.b];
      if (!side_of(a, b, places_.place[edge.a], *aside_) &&
          !side_of(a, b, places_.place[edge.b], *aside_))
        break;
    }
    if (k == first.size())
      first.push_back(e);
    number.push_back(k);
  }
  return number;
}

// Draws the best of the intervals that lie between two nodes.
void Finder::draw_best(uint32_t straight, uint32_t from, uint32_t to,
                       const std::vector<uint32_t> &active) {
  std::map<uint32_t, std::vector<uint32_t>> spaces;
  for (uint32_t k : active)
    spaces[laid_[k].space].push_back(k);
  hsr_paper_line best{};
  best.pen = HSR_NO_PEN;
  for (const auto &space : spaces) {
    std::vector<uint32_t> edges;
    const Laid *least = nullptr;
    for (uint32_t k : space.second) {
      edges.push_back(laid_[k].edge);
      if (!least || drawing_->segment[laid_[k].segment].invisibility <
                        drawing_->segment[least->segment].invisibility)
        least = &laid_[k];
    }
    const hsr_line_class line_class = class_of(edges);
    const uint32_t object = object_of(places_.edge[least->edge]);
    const uint32_t hidden = drawing_->segment[least->segment].invisibility;
    const uint32_t pen = hsr_line_pen_of(pens_, object, line_class, hidden);
    if (pen != HSR_NO_PEN &&
        (best.pen == HSR_NO_PEN || hidden < best.invisibility ||
         (hidden == best.invisibility && line_class < best.line_class)))
      best = {from, to, straight, object, hidden, pen, line_class};
  }
  if (best.pen != HSR_NO_PEN)
    emit(best);
}

void Finder::lay_over(uint32_t straight, const std::vector<uint32_t> &edges) {
  choose_axis(places_.edge[edges[0]]);
  const std::vector<uint32_t> space = in_space(edges);
  laid_.clear();
  ends_.clear();
  // The ends of all intervals, in the direction of the line.
  for (size_t i = 0; i < edges.size(); i++) {
    const Edge &edge = places_.edge[edges[i]];
    const bool along = side_of(places_.place[edge.a], places_.place[edge.b],
                               eye_, *aside_) == turn_;
    for (size_t k = edge.first; k < edge.first + edge.n; k++) {
      laid_.push_back({k, edges[i], space[i], 0, 0});
      for (const bool to : {false, true}) {
        End end = end_of(edges[i], k, to);
        bound(end);
        if (!along)
          std::swap(end.lo, end.hi);
        end.first = to != along;
        end.segment = laid_.size() - 1;
        ends_.push_back(end);
      }
    }
  }
  std::stable_sort(
      ends_.begin(), ends_.end(),
      [this](const End &p, const End &q) { return is_before(*p.at, *q.at); });
  // Ends whose bounds overlap are one stop.
  std::vector<uint32_t> node;
  for (size_t k = 0, n; k < ends_.size(); k += n) {
    for (n = 1; k + n < ends_.size() &&
                !is_before(*ends_[k + n - 1].hi, *ends_[k + n].lo);)
      n++;
    const End *chosen = &ends_[k];
    for (size_t i = k; i < k + n; i++) {
      if (chosen->named == NONE && ends_[i].named != NONE)
        chosen = &ends_[i];
      Laid &laid = laid_[ends_[i].segment];
      (ends_[i].first ? laid.first : laid.last) = uint32_t(node.size());
    }
    node.push_back(node_of(*chosen, ends_[k + n - 1]));
  }
  // What lies between two stops.
  std::vector<uint32_t> order(laid_.size()), active;
  for (uint32_t k = 0; k < order.size(); k++)
    order[k] = k;
  std::sort(order.begin(), order.end(), [this](uint32_t i, uint32_t j) {
    return laid_[i].first != laid_[j].first ? laid_[i].first < laid_[j].first
                                            : i < j;
  });
  for (size_t stop = 0, next = 0; stop + 1 < node.size(); stop++) {
    active.erase(
        std::remove_if(active.begin(), active.end(),
                       [&](uint32_t k) { return laid_[k].last <= stop; }),
        active.end());
    for (; next < order.size() && laid_[order[next]].first <= stop; next++)
      if (laid_[order[next]].last > stop)
        active.push_back(order[next]);
    if (!active.empty())
      draw_best(straight, node[stop], node[stop + 1], active);
  }
}

void Finder::find() {
  const Straights straights(places_, eye_);
  for (uint32_t k = 0; k < straights.edges.size(); k++)
    if (straights.edges[k].size() == 1)
      draw_alone(k, straights.edges[k][0]);
    else
      lay_over(k, straights.edges[k]);
}

void Finder::classify(hsr_line_class *line_class, uint32_t *object) {
  for (uint32_t e = 0; e < places_.edge.size(); e++) {
    const Edge &edge = places_.edge[e];
    std::fill_n(line_class + edge.first, edge.n,
                edge.a == NONE ? HSR_LINE_INTERSECTION : class_of({e}));
    std::fill_n(object + edge.first, edge.n, object_of(edge));
  }
}

// --- For C -------------------------------------------------------------------

template <class T> T *copy_of(const T *items, size_t n) {
  T *copy = static_cast<T *>(malloc((n + 1) * sizeof(T)));
  if (!copy)
    throw std::bad_alloc();
  std::copy(items, items + n, copy);
  return copy;
}

void keep(const Finder &found, hsr_paper_lines *lines) {
  lines->line = copy_of(found.lines.data(), found.lines.size());
  lines->n = found.lines.size();
  lines->n_nodes = found.nodes().size();
  lines->node = static_cast<double(*)[2]>(
      malloc((lines->n_nodes + 1) * sizeof(double[2])));
  if (!lines->node)
    throw std::bad_alloc();
  for (size_t k = 0; k < lines->n_nodes; k++)
    for (size_t c = 0; c < 2; c++)
      lines->node[k][c] = found.nodes()[k][c];
}

hsr_status caught(hsr_error *err) {
  try {
    throw;
  } catch (const std::bad_alloc &) {
    return hsr_fail_nomem(err);
  } catch (...) {
    return hsr_fail(err, HSR_E_INTERNAL, "finding the lines failed");
  }
}

} // namespace

hsr_status hsr_lines_find(hsr_paper_lines *lines, const hsr_drawing *drawing,
                          const hsr_world *world, const hsr_view *view,
                          double crease, const hsr_line_pens *pens,
                          hsr_error *err) {
  *lines = hsr_paper_lines();
  try {
    Finder finder(drawing, world, view, crease, pens);
    finder.find();
    keep(finder, lines);
    return HSR_OK;
  } catch (...) {
    return caught(err);
  }
}

hsr_status hsr_lines_classify(const hsr_drawing *drawing,
                              const hsr_world *world, const hsr_view *view,
                              double crease, hsr_line_class *line_class,
                              uint32_t *object, hsr_error *err) {
  try {
    Finder(drawing, world, view, crease, nullptr).classify(line_class, object);
    return HSR_OK;
  } catch (...) {
    return caught(err);
  }
}

void hsr_lines_free(hsr_paper_lines *lines) {
  free(lines->line);
  free(lines->node);
  *lines = hsr_paper_lines();
}
