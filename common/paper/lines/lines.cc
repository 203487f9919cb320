// SPDX-License-Identifier: GPL-3.0-or-later
// The lines of a drawing, each once.
//
// Straight    Edges lie on one line of the picture if they lie in one plane with
//             the eye.
// Laid over   On a line of several edges, the ends of all intervals are sorted
//             exactly. Between two ends, the best of what lies there is drawn.

#include "common/paper/lines/lines.h"
#include "common/paper/lines/line_faces.h"
#include "common/paper/lines/nodes.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <map>
#include <new>
#include <optional>

using namespace hsr;

namespace {

// The object of the first face that has the edge and exists.
uint32_t object_of(const hsr_world *world, const Sides &all,
                   const hsr_edge_name &name) {
  if (name.implied)
    return world->mesh.object[name.a];
  const auto sides = all.of(name.a, name.b);
  for (const Side *s = sides.first; s != sides.second; s++)
    if (s->facing)
      return world->mesh.object[s->face];
  return sides.first != sides.second ? world->mesh.object[sides.first->face]
                                     : 0;
}

// An end of an interval on a line of several edges.
struct End {
  const Place *at, *lo, *hi; // exact, and its bounds along the line
  const double *point;       // in doubles
  uint32_t named;            // a named place, or NONE
  uint32_t laid;             // its interval
  bool first;                // the interval begins there
};

// An interval on such a line.
struct Laid {
  size_t segment;
  uint32_t edge, space; // of the drawing; of the lines of space at hand
  uint32_t first, last; // stops
};

// A line of space, on which several edges may lie.
struct Space {
  std::vector<uint32_t> lies; // intervals between the two stops at hand
  bool known = false;         // what follows is of these
  hsr_paper_line line;        // without its nodes
};

class Finder {
public:
  Finder(const hsr_drawing *drawing, const hsr_world *world,
         const hsr_view *view, double crease, const hsr_line_pens *pens)
      : drawing_(drawing), world_(world), pens_(pens), eye_(eye_of(view)),
        edges_(world, drawing), nodes_(edges_, eye_, view), sides_(world, view),
        faces_(world, crease) {}

  void find();
  std::vector<hsr_paper_line> lines;
  const std::vector<std::array<double, 2>> &nodes() const { return nodes_.at; }

private:
  using Edges = std::vector<uint32_t>;
  Vector3<Exact> direction(uint32_t e) const;
  hsr_line_class class_of(const Edges &edges);

  void draw_alone(uint32_t e);
  std::vector<uint32_t> find_nodes(uint32_t e,
                                   const std::vector<uint32_t> &pen);
  bool is_near(const double p[3], const double q[3]) const;

  void lay_over(const Edges &edges);
  void choose_aside(uint32_t e);
  void find_spaces(const Edges &edges, std::vector<uint32_t> &space);
  void lay(uint32_t e, uint32_t space);
  End end_of(uint32_t laid, bool to, bool along);
  std::vector<uint32_t> find_stops();
  void walk(const std::vector<uint32_t> &node);
  void learn(Space &space);
  void draw_best(const std::vector<uint32_t> &spaces, uint32_t from,
                 uint32_t to);

  bool is_before(const Place *p, const Place *q) const {
    return p != q && side_of(*p, *q, eye_, *aside_) * turn_ > 0;
  }
  void emit(hsr_paper_line line, uint32_t from, uint32_t to) {
    line.from = from;
    line.to = to;
    line.straight = straight_;
    if (from != to && line.pen != HSR_NO_PEN)
      lines.push_back(line);
  }

  const hsr_drawing *drawing_;
  const hsr_world *world_;
  const hsr_line_pens *pens_;
  const Place eye_;
  Drawn_edges edges_;
  Nodes nodes_;
  Sides sides_;
  Line_faces faces_;

  // The line at hand.
  uint32_t straight_ = 0;      // its number
  std::optional<Place> aside_; // a place not in its plane
  int turn_ = 0;               // of its first edge, seen from there
  std::vector<Laid> laid_;
  std::vector<End> end_;
  std::vector<Space> space_;
  std::deque<Place> place_; // of ends without a name
};

Vector3<Exact> Finder::direction(uint32_t e) const {
  const Row &a = edges_.a(e).exact, &b = edges_.b(e).exact;
  return {b[0] * a[3] - a[0] * b[3], b[1] * a[3] - a[1] * b[3],
          b[2] * a[3] - a[2] * b[3]};
}

// The class of a line of space in which these edges lie.
hsr_line_class Finder::class_of(const Edges &edges) {
  faces_.clear();
  const Vector3<Exact> d = direction(edges[0]);
  for (uint32_t e : edges) {
    const Edge &edge = edges_.edge[e];
    if (edge.name.implied)
      continue;
    const int along = e == edges[0] ? 1 : CGAL::sign(Exact(d * direction(e)));
    const auto sides = sides_.of(edge.name.a, edge.name.b);
    for (const Side *s = sides.first; s != sides.second; s++)
      faces_.add(*s, along);
  }
  return faces_.find(d);
}

// --- Ends that are one -------------------------------------------------------

// Ends whose bounds overlap may be one place. They are taken for one only if
// their images are also within this distance. For a line may be far longer than
// the picture is wide. Then the bounds of its ends reach over the whole picture.
constexpr double NEAR = 0x1p-20; // pixels

bool Finder::is_near(const double p[3], const double q[3]) const {
  const auto a = nodes_.image_of(p), b = nodes_.image_of(q);
  return std::hypot(a[0] - b[0], a[1] - b[1]) <= NEAR;
}

static const double *point_of(const hsr_segment &s, bool to) {
  return to ? s.to : s.from;
}

// --- One edge on a line ------------------------------------------------------

static double bound_of(double t) {
  return t == 1 ? 0 : CHANGE_ERROR * t;
}

// The nodes of the ends of an edge's intervals, two for each. NONE where no
// interval has a pen.
std::vector<uint32_t> Finder::find_nodes(uint32_t e,
                                         const std::vector<uint32_t> &pen) {
  const Edge &edge = edges_.edge[e];
  const hsr_segment *s = drawing_->segment + edge.first;
  const auto t_of = [s](size_t k) { return k % 2 ? s[k / 2].t1 : s[k / 2].t0; };
  const auto point = [s](size_t k) { return point_of(s[k / 2], k % 2); };
  const auto is_one = [&](size_t k) { // with the next
    const double t = t_of(k), u = t_of(k + 1);
    return t == u || (u - t <= bound_of(t) + bound_of(u) &&
                      is_near(point(k), point(k + 1)));
  };
  std::vector<uint32_t> node;
  for (size_t k = 0, n; k < 2 * edge.n; k += n) {
    bool drawn = pen[k / 2] != HSR_NO_PEN;
    for (n = 1; k + n < 2 * edge.n && is_one(k + n - 1); n++)
      drawn |= pen[(k + n) / 2] != HSR_NO_PEN;
    node.insert(node.end(), n,
                !drawn         ? NONE
                : t_of(k) == 0 ? nodes_.of_named(edge.a)
                : t_of(k + n - 1) == 1
                    ? nodes_.of_named(edge.b)
                    : nodes_.of_change(e, t_of(k), point(k)));
  }
  return node;
}

void Finder::draw_alone(uint32_t e) {
  const Edge &edge = edges_.edge[e];
  hsr_paper_line line{};
  line.line_class = class_of({e});
  line.object = object_of(world_, sides_, edge.name);
  const auto invisibility = [&](size_t k) {
    return drawing_->segment[edge.first + k].invisibility;
  };
  std::vector<uint32_t> pen;
  for (size_t k = 0; k < edge.n; k++)
    pen.push_back(
        hsr_line_pen_of(pens_, line.object, line.line_class, invisibility(k)));
  const std::vector<uint32_t> node = find_nodes(e, pen);
  for (size_t k = 0; k < edge.n; k++) {
    line.invisibility = invisibility(k);
    line.pen = pen[k];
    emit(line, node[2 * k], node[2 * k + 1]);
  }
}

// --- Several edges on a line -------------------------------------------------

void Finder::choose_aside(uint32_t e) {
  for (int k = 0; k < 3; k++) {
    aside_ = Place::axis(k);
    turn_ = side_of(edges_.a(e), edges_.b(e), eye_, *aside_);
    if (turn_)
      return;
  }
  throw std::bad_alloc(); // an edge and the eye span a plane
}

// space[k] becomes the number of the line of space of edge k.
void Finder::find_spaces(const Edges &edges, std::vector<uint32_t> &space) {
  Planes planes(edges_, *aside_);
  std::map<uint32_t, uint32_t> place;
  for (uint32_t k = 0; k < edges.size(); k++) {
    planes.add(edges[k]);
    place[edges[k]] = k;
  }
  space_.assign(planes.edges.size(), Space());
  space.resize(edges.size());
  for (uint32_t p = 0; p < planes.edges.size(); p++)
    for (uint32_t e : planes.edges[p])
      space[place[e]] = p;
}

End Finder::end_of(uint32_t laid, bool to, bool along) {
  const uint32_t e = laid_[laid].edge;
  const hsr_segment &s = drawing_->segment[laid_[laid].segment];
  const double t = to ? s.t1 : s.t0;
  End end{nullptr, nullptr, nullptr, point_of(s, to), NONE, laid, to != along};
  if (t == (to ? 1 : 0)) {
    end.named = to ? edges_.edge[e].b : edges_.edge[e].a;
    end.at = end.lo = end.hi = &edges_.place[end.named];
    return end;
  }
  const auto put = [&](double at) {
    place_.push_back(Place::between(edges_.a(e), edges_.b(e), at));
    return &place_.back();
  };
  end.at = put(t);
  end.lo = put(t - CHANGE_ERROR * t);
  end.hi = put(t + CHANGE_ERROR * t);
  if (!along)
    std::swap(end.lo, end.hi);
  return end;
}

// Puts the intervals of an edge, and their ends, to the others.
void Finder::lay(uint32_t e, uint32_t space) {
  const Edge &edge = edges_.edge[e];
  const bool along = side_of(edges_.a(e), edges_.b(e), eye_, *aside_) == turn_;
  for (size_t k = edge.first; k < edge.first + edge.n; k++) {
    laid_.push_back({k, e, space, 0, 0});
    for (const bool to : {false, true})
      end_.push_back(end_of(uint32_t(laid_.size() - 1), to, along));
  }
}

// Sorts the ends. Neighbours are one stop if their bounds overlap and their images
// are near. Returns the nodes of all stops, in the order of the line.
std::vector<uint32_t> Finder::find_stops() {
  std::stable_sort(
      end_.begin(), end_.end(),
      [this](const End &p, const End &q) { return is_before(p.at, q.at); });
  std::vector<uint32_t> node;
  for (size_t k = 0, n; k < end_.size(); k += n) {
    for (n = 1; k + n < end_.size(); n++) {
      const End &p = end_[k + n - 1], &q = end_[k + n];
      if (is_before(p.hi, q.lo) || !is_near(p.point, q.point))
        break;
    }
    const End *named = nullptr;
    for (size_t i = k; i < k + n; i++) {
      Laid &laid = laid_[end_[i].laid];
      (end_[i].first ? laid.first : laid.last) = uint32_t(node.size());
      if (!named && end_[i].named != NONE)
        named = &end_[i];
    }
    node.push_back(named
                       ? nodes_.of_named(named->named)
                       : nodes_.of_change(laid_[end_[k].laid].edge, *end_[k].lo,
                                          *end_[k + n - 1].hi, end_[k].point));
  }
  return node;
}

// What is drawn of a line of space between the stops at hand.
void Finder::learn(Space &space) {
  Edges edges;
  const Laid *least = nullptr;
  for (uint32_t k : space.lies) {
    const Laid &laid = laid_[k];
    edges.push_back(laid.edge);
    if (!least || drawing_->segment[laid.segment].invisibility <
                      drawing_->segment[least->segment].invisibility)
      least = &laid;
  }
  hsr_paper_line &line = space.line;
  line = hsr_paper_line();
  line.line_class = class_of(edges);
  line.object = object_of(world_, sides_, edges_.edge[least->edge].name);
  line.invisibility = drawing_->segment[least->segment].invisibility;
  line.pen =
      hsr_line_pen_of(pens_, line.object, line.line_class, line.invisibility);
  space.known = true;
}

void Finder::draw_best(const std::vector<uint32_t> &spaces, uint32_t from,
                       uint32_t to) {
  const hsr_paper_line *best = nullptr;
  for (uint32_t k : spaces) {
    if (!space_[k].known)
      learn(space_[k]);
    const hsr_paper_line &line = space_[k].line;
    if (line.pen != HSR_NO_PEN &&
        (!best || line.invisibility < best->invisibility ||
         (line.invisibility == best->invisibility &&
          line.line_class < best->line_class)))
      best = &line;
  }
  if (best)
    emit(*best, from, to);
}

// From stop to stop: intervals end, others begin, and the best is drawn.
void Finder::walk(const std::vector<uint32_t> &node) {
  std::vector<std::vector<uint32_t>> begin(node.size()), end(node.size());
  std::vector<uint32_t> active; // lines of space, ascending
  for (uint32_t k = 0; k < laid_.size(); k++)
    if (laid_[k].first < laid_[k].last) {
      begin[laid_[k].first].push_back(k);
      end[laid_[k].last].push_back(k);
    }
  for (size_t stop = 0; stop + 1 < node.size(); stop++) {
    for (uint32_t k : end[stop]) {
      Space &space = space_[laid_[k].space];
      space.lies.erase(std::find(space.lies.begin(), space.lies.end(), k));
      space.known = false;
      if (space.lies.empty())
        active.erase(
            std::lower_bound(active.begin(), active.end(), laid_[k].space));
    }
    for (uint32_t k : begin[stop]) {
      Space &space = space_[laid_[k].space];
      if (space.lies.empty())
        active.insert(
            std::lower_bound(active.begin(), active.end(), laid_[k].space),
            laid_[k].space);
      space.lies.push_back(k);
      space.known = false;
    }
    draw_best(active, node[stop], node[stop + 1]);
  }
}

void Finder::lay_over(const Edges &edges) {
  std::vector<uint32_t> space;
  laid_.clear();
  end_.clear();
  place_.clear();
  choose_aside(edges[0]);
  find_spaces(edges, space);
  for (size_t k = 0; k < edges.size(); k++)
    lay(edges[k], space[k]);
  walk(find_stops());
}

void Finder::find() {
  Planes straights(edges_, eye_);
  for (uint32_t e = 0; e < edges_.edge.size(); e++)
    if (edges_.edge[e].a != NONE)
      straights.add(e);
  for (const Edges &edges : straights.edges) {
    if (edges.size() == 1)
      draw_alone(edges[0]);
    else
      lay_over(edges);
    straight_++;
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
                              double crease, unsigned char *line_class,
                              uint32_t *object, hsr_error *err) {
  try {
    const Sides all(world, view);
    Line_faces faces(world, crease);
    for (size_t k = 0; k < drawing->n; k++) {
      const hsr_edge_name &name = drawing->segment[k].edge;
      if (k && !hsr_edge_name_compare(&name, &drawing->segment[k - 1].edge)) {
        line_class[k] = line_class[k - 1];
        object[k] = object[k - 1];
        continue;
      }
      object[k] = object_of(world, all, name);
      line_class[k] = HSR_LINE_INTERSECTION;
      if (name.implied)
        continue;
      faces.clear();
      const auto sides = all.of(name.a, name.b);
      for (const Side *s = sides.first; s != sides.second; s++)
        faces.add(*s, 1);
      line_class[k] = static_cast<unsigned char>(faces.find(
          point<Exact>(world, name.b) - point<Exact>(world, name.a)));
    }
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
