/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/judge/areas/cells.h"

#include <algorithm>
#include <cmath>

namespace areas {

namespace {

/* A face that may be seen in a cell. */
struct candidate {
  shape *f;
  std::vector<uint32_t> edges; /* whose boundaries may meet the inside */
  bool odd;                    /* the parity, of the whole inside */
  bool covers;                 /* all of the cell */
  line *bound;                 /* a bound in depth that crosses the cell */
};

/* The signs of a function at the corners of a cell. */
struct signs {
  bool any_below = false, any_above = false;

  void add(int sign) {
    any_below = any_below || sign < 0;
    any_above = any_above || sign > 0;
  }
  bool crosses() const { return any_below && any_above; }
};

signs signs_in(line &f, const cell &in) {
  signs found;
  for (point *corner : in.corner) {
    found.add(sign_at(f, *corner));
    if (found.crosses())
      break;
  }
  return found;
}

box box_of(const cell &in) {
  box all = {in.corner[0]->x.inf(), in.corner[0]->x.sup(),
             in.corner[0]->y.inf(), in.corner[0]->y.sup()};
  for (const point *corner : in.corner) {
    all.x0 = std::min(all.x0, corner->x.inf());
    all.x1 = std::max(all.x1, corner->x.sup());
    all.y0 = std::min(all.y0, corner->y.inf());
    all.y1 = std::max(all.y1, corner->y.sup());
  }
  return all;
}

bool is_apart(const box &a, const box &b) {
  return a.x1 <= b.x0 || b.x1 <= a.x0 || a.y1 <= b.y0 || b.y1 <= a.y0;
}

class cutter {
public:
  explicit cutter(sink &to) : to_(to) {}
  void begin(const halves &rectangle, const std::vector<shape *> &faces);

private:
  sink &to_;
  std::deque<point> points_;
  std::deque<line> lines_;

  line *grid_line(int k, long a, long b, long c);
  point *grid_point(int x, int y);
  bool meets(shape &f, uint32_t edge, const cell &in, const box &around);
  point inner_point(const cell &in) const;
  bool may_be_seen(candidate *c, const cell &in, const box &around,
                   point &inner);
  bool drop_behind_first(const cell &in, std::vector<candidate> *all,
                         line **cut);
  void solve(const cell &in, std::vector<candidate> all);
  void split(const cell &in, line *by, cell *below, cell *above);
};

line *cutter::grid_line(int k, long a, long b, long c) {
  lines_.push_back(
      {GRID_LINE,
       {Interval(double(a)), Interval(double(b)), Interval(double(c))},
       nullptr,
       nullptr,
       nullptr,
       k,
       {mpz_class(a), mpz_class(b), mpz_class(c)}});
  return &lines_.back();
}

point *cutter::grid_point(int x, int y) {
  points_.emplace_back();
  place(&points_.back(), x, y, 2);
  return &points_.back();
}

/* ---- Boundaries ---- */

/* The segment in which the line of the edge meets the cell has its ends in pq.
 * Both functions of the edge are affine along it. On its inside they have
 * different signs somewhere, unless all four signs at the ends are >= 0, or all
 * <= 0: they cannot be zero at one point both. */
bool cutter::meets(shape &f, uint32_t k, const cell &in, const box &around) {
  if (f.by[k] == NO_BOUNDARY || is_apart(f.edge_box[k], around))
    return false;
  line &boundary = f.boundary(k);
  const size_t n = in.corner.size();
  std::vector<int> s(n);
  signs at_corners;
  for (size_t i = 0; i < n; i++)
    at_corners.add(s[i] = sign_at(boundary, *in.corner[i]));
  if (!at_corners.crosses())
    return false;
  if (f.by[k] == ALL_OF_ROW || f.by[k] == ALL_OF_NEXT_ROW)
    return true;

  signs at_ends;
  const auto look = [&](point &end) {
    at_ends.add(sign_at(f.from(k), end));
    at_ends.add(sign_at(f.to(k), end));
  };
  for (size_t i = 0; i < n && !at_ends.crosses(); i++) {
    const size_t j = i + 1 == n ? 0 : i + 1;
    if (s[i] == 0)
      look(*in.corner[i]);
    if (s[i] * s[j] < 0) {
      point end;
      meet(&end, &boundary, in.side[i]);
      look(end);
    }
  }
  return at_ends.crosses();
}

/* ---- Inner points ---- */

/* Whether (x, y) is certainly inside. */
bool is_inside(const cell &in, const Interval &x, const Interval &y) {
  for (size_t i = 0; i < in.corner.size(); i++) {
    const point &a = *in.corner[i],
                &b = *in.corner[i + 1 == in.corner.size() ? 0 : i + 1];
    const Interval turn = (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
    if (!(turn.inf() > 0))
      return false;
  }
  return true;
}

/* The middle of three corners, which are not on a line; or a point near it that
 * has few digits. */
point cutter::inner_point(const cell &in) const {
  const size_t n = in.corner.size();
  point *const corner[3] = {in.corner[0], in.corner[n / 3],
                            in.corner[2 * n / 3]};
  double x = 0, y = 0;
  for (const point *c : corner) {
    x += c->x.inf() / 3;
    y += c->y.inf() / 3;
  }
  point middle;
  constexpr double fine = 0x1p40;
  place(&middle, std::rint(x * fine), std::rint(y * fine), fine);
  if (is_inside(in, middle.x, middle.y))
    return middle;
  for (point *c : corner)
    c->make_exact();
  const mpz_class &u = corner[0]->W, &v = corner[1]->W, &w = corner[2]->W;
  middle.X = corner[0]->X * v * w + corner[1]->X * u * w + corner[2]->X * u * v;
  middle.Y = corner[0]->Y * v * w + corner[1]->Y * u * w + corner[2]->Y * u * v;
  middle.W = 3 * u * v * w;
  const Interval third = Interval(1) / Interval(3);
  middle.x = third * (corner[0]->x + corner[1]->x + corner[2]->x);
  middle.y = third * (corner[0]->y + corner[1]->y + corner[2]->y);
  return middle;
}

/* ---- Candidates ---- */

/* Finds out whether the face may be seen in the cell, and whether it covers it.
 */
bool cutter::may_be_seen(candidate *c, const cell &in, const box &around,
                         point &inner) {
  if (c->covers)
    return true;
  shape &f = *c->f;
  const signs ahead =
      f.on.view.parallel ? signs{false, true} : signs_in(f.s, in);
  const signs beyond = signs_in(f.near, in);
  if (!ahead.any_above || !beyond.any_above)
    return false;
  if (!c->odd) {
    const auto misses = [&](uint32_t k) { return !meets(f, k, in, around); };
    c->edges.erase(std::remove_if(c->edges.begin(), c->edges.end(), misses),
                   c->edges.end());
    if (!c->edges.empty())
      return true;
    c->odd = f.is_odd_at(inner);
    if (!c->odd)
      return false;
  }
  c->bound = ahead.any_below ? &f.s : beyond.any_below ? &f.near : nullptr;
  c->covers = !c->bound;
  return true;
}

double rough_depth(const shape &f, const point &at) {
  const Interval q =
      (f.s.rough.a * at.x + f.s.rough.b * at.y + f.s.rough.c) / f.c;
  return q.inf() / 2 + q.sup() / 2;
}

enum relation { BEHIND, BEFORE, MEETS };

/* How c lies to a face that covers the cell; of equal planes that of the lower
 * id is before. *difference becomes their line. */
relation relation_to(const shape &front, const shape &c, const cell &in,
                     line *difference) {
  compare_depths(front, c, difference);
  const signs found = signs_in(*difference, in);
  if (found.crosses())
    return MEETS;
  if (found.any_above || found.any_below)
    return found.any_above ? BEHIND : BEFORE;
  return front.id < c.id ? BEHIND : BEFORE;
}

/* Puts the face that covers the cell, and is probably the nearest of those at
 * the inner point, at the head of the list. False if none covers it. */
bool bring_forward(std::vector<candidate> *all, const point &inner) {
  candidate *front = nullptr;
  double nearest = 0;
  for (candidate &c : *all) {
    const double depth = c.covers ? rough_depth(*c.f, inner) : 0;
    if (c.covers && (!front || depth > nearest)) {
      front = &c;
      nearest = depth;
    }
  }
  if (front)
    std::swap(*front, all->front());
  return front;
}

/* Drops what is hidden by the face at the head of the list, or that face, if it
 * is hidden: then false. *cut becomes the line in which another face that covers
 * the cell meets it, or NULL. */
bool cutter::drop_behind_first(const cell &in, std::vector<candidate> *all,
                               line **cut) {
  const shape &front = *all->front().f;
  size_t kept = 1;
  *cut = nullptr;
  for (size_t i = 1; i < all->size(); i++) {
    candidate &c = (*all)[i];
    line difference;
    const relation found = relation_to(front, *c.f, in, &difference);
    if (found == BEHIND)
      continue;
    if (found == BEFORE && c.covers) {
      all->erase(all->begin() + long(kept), all->begin() + long(i));
      all->erase(all->begin());
      return false;
    }
    if (c.covers) {
      lines_.push_back(std::move(difference));
      *cut = &lines_.back();
    }
    if (kept != i)
      (*all)[kept] = std::move(c);
    kept++;
  }
  all->erase(all->begin() + long(kept), all->end());
  return true;
}

/* ---- Cutting ---- */

/* The cell has corners on both sides of the line. */
void cutter::split(const cell &in, line *by, cell *below, cell *above) {
  const size_t n = in.corner.size();
  std::vector<int> s;
  for (point *corner : in.corner)
    s.push_back(sign_at(*by, *corner));
  const auto keep = [](cell *part, point *corner, line *side) {
    part->corner.push_back(corner);
    part->side.push_back(side);
  };
  for (size_t i = 0; i < n; i++) {
    const int here = s[i], there = s[i + 1 == n ? 0 : i + 1];
    if (here >= 0)
      keep(above, in.corner[i], here == 0 && there < 0 ? by : in.side[i]);
    if (here <= 0)
      keep(below, in.corner[i], here == 0 && there > 0 ? by : in.side[i]);
    if (here * there >= 0)
      continue;
    points_.emplace_back();
    point *made = &points_.back();
    meet(made, by, in.side[i]);
    keep(above, made, here > 0 ? by : in.side[i]);
    keep(below, made, here < 0 ? by : in.side[i]);
  }
}

/* The line that cuts the cell for the sake of the face that is probably the
 * nearest of those that do not cover it; NULL if all do. The edge comes off the
 * list. */
line *next_boundary(std::vector<candidate> *all, const point &inner) {
  candidate *first = nullptr;
  double nearest = 0;
  for (candidate &c : *all) {
    const double depth = c.covers ? 0 : rough_depth(*c.f, inner);
    if (!c.covers && (!first || depth > nearest)) {
      first = &c;
      nearest = depth;
    }
  }
  if (!first)
    return nullptr;
  if (first->edges.empty())
    return first->bound;
  const uint32_t k = first->edges.back();
  first->edges.pop_back();
  return &first->f->boundary(k);
}

void cutter::solve(const cell &in, std::vector<candidate> all) {
  const box around = box_of(in);
  point inner = inner_point(in);
  const auto is_out = [&](candidate &c) {
    return !may_be_seen(&c, in, around, inner);
  };
  all.erase(std::remove_if(all.begin(), all.end(), is_out), all.end());
  line *by = nullptr;
  while (bring_forward(&all, inner) && !drop_behind_first(in, &all, &by))
    ;
  if (line *boundary = next_boundary(&all, inner))
    by = boundary;
  if (!by) {
    to_.take(in, all.empty() ? nullptr : all.front().f);
    return;
  }
  cell below, above;
  split(in, by, &below, &above);
  solve(below, all);
  solve(above, std::move(all));
}

void cutter::begin(const halves &r, const std::vector<shape *> &faces) {
  cell whole;
  whole.side = {grid_line(0, 0, 2, -r.y0), grid_line(1, 2, 0, -r.x1),
                grid_line(2, 0, 2, -r.y1), grid_line(3, 2, 0, -r.x0)};
  whole.corner = {grid_point(r.x0, r.y0), grid_point(r.x1, r.y0),
                  grid_point(r.x1, r.y1), grid_point(r.x0, r.y1)};
  std::vector<candidate> all;
  for (shape *f : faces) {
    all.push_back({f, {}, false, false, nullptr});
    for (uint32_t k = 0; k < f->n; k++)
      all.back().edges.push_back(k);
  }
  solve(whole, std::move(all));
}

} // namespace

void cut(const halves &rectangle, const std::vector<shape *> &faces, sink &to) {
  cutter(to).begin(rectangle, faces);
}

/* ---- Rectangles, by intervals alone ---- */

namespace {

struct corners {
  Interval x[4], y[4];

  explicit corners(const halves &r) {
    const int at[4][2] = {
        {r.x0, r.y0}, {r.x1, r.y0}, {r.x1, r.y1}, {r.x0, r.y1}};
    for (int i = 0; i < 4; i++) {
      x[i] = Interval(at[i][0] / 2.0);
      y[i] = Interval(at[i][1] / 2.0);
    }
  }

  /* The sign of the function all over the rectangle; UNSURE if it may have
   * more than one. */
  int sign(const affine<Interval> &f) const {
    const int first = sign_of(f.a * x[0] + f.b * y[0] + f.c);
    for (int i = 1; i < 4; i++)
      if (first == 0 || sign_of(f.a * x[i] + f.b * y[i] + f.c) != first)
        return UNSURE;
    return first;
  }
};

} // namespace

enum cover cover_of(shape &f, const halves &r) {
  const box around = {r.x0 / 2.0, r.x1 / 2.0, r.y0 / 2.0, r.y1 / 2.0};
  if (is_apart(f.bounds, around))
    return NOT_THERE;
  const corners at(r);
  const int ahead = f.on.view.parallel ? 1 : at.sign(f.s.rough),
            beyond = at.sign(f.near.rough);
  if (ahead < 0 || beyond < 0)
    return NOT_THERE;
  for (uint32_t k = 0; k < f.n; k++)
    if (f.by[k] != NO_BOUNDARY && !is_apart(f.edge_box[k], around) &&
        at.sign(f.boundary(k).rough) == UNSURE)
      return MAYBE;
  point middle;
  place(&middle, r.x0 + r.x1, r.y0 + r.y1, 4);
  if (!f.is_odd_at(middle))
    return NOT_THERE;
  return ahead == 1 && beyond == 1 ? COVERS : MAYBE;
}

bool is_nearer_in(const shape &f, const shape &g, const halves &rectangle) {
  line difference;
  compare_depths(f, g, &difference);
  return corners(rectangle).sign(difference.rough) == 1;
}

} // namespace areas
