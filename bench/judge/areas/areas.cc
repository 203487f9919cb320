/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The exact area picture, by atoms (moments.h).
 *
 * Method      windows of atoms are halved, and the faces that may be seen in a
 *             window are passed down. Intervals decide which faces meet it,
 *             which cover it, and which lie behind one that covers it; what
 *             they leave open is kept. An atom with one face left is *whole*.
 *             Others are *mixed*: they are cut into cells (cells.h).
 * Values      first in fixed point, with a bound of the error. If that leaves
 *             open which doubles are next to the value, in rationals. That is
 *             so where the value itself is a double. */
#include "bench/judge/areas/areas.h"
#include "bench/judge/areas/cells.h"
#include "bench/judge/areas/moments.h"
#include "bench/judge/areas/shaded.h"
#include "common/answers/filter.h"
#include "common/answers/kinds/area.h"
#include "common/base/arena.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <map>
#include <unordered_map>

namespace areas {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/* A face and its integrals in an atom. */
template <class T> struct part {
  const shape *face; /* NULL: the background */
  std::vector<T> integrals;
};

struct mixed_atom {
  int x, y;
  std::vector<shape *> faces;
  std::vector<part<mpz_class>> fixed; /* both empty until they are asked for */
  std::vector<part<mpq_class>> exact;
  unsigned long error;        /* of all in `fixed` */
  std::vector<patch> patches; /* under a shader */
  double slack = 0;           /* of their corners */
};

struct atom {
  const shape *only; /* of a whole one; NULL: the background */
  mixed_atom *mixed; /* NULL: it is whole */
};

/* The sum of each face that is seen in an atom. */
template <class Sum> struct face_sums : sink {
  const mixed_atom &at;
  const int degree;
  std::vector<std::pair<const shape *, Sum>> all;

  face_sums(const mixed_atom &a, int d) : at(a), degree(d) {}
  void take(const cell &c, const shape *seen) override {
    auto face = all.begin();
    while (face != all.end() && face->first != seen)
      ++face;
    if (face == all.end())
      face = all.insert(face, {seen, Sum()});
    face->second.add(c, degree, at.x, at.y);
  }
};

struct colour {
  uint16_t rgb[3];
  hsr_area_bounds bounds[3]; /* of a pixel that shows nothing else */
};

/* By faces, in the order of areas.h. */
struct by_id {
  bool operator()(const shape *f, const shape *g) const {
    return (f ? f->id : HSR_BACKGROUND) < (g ? g->id : HSR_BACKGROUND);
  }
};
using shares = std::map<const shape *, mpq_class, by_id>;

/* Not inlined, so that it is computed after the rounding mode is changed. */
[[gnu::noinline]] void ask_colour(const stage &on, uint32_t face,
                                  uint16_t rgb[3]) {
  const Nearest to_nearest;
  hsr_filter_colour(&on.world, &on.view, face, rgb);
}

hsr_area_bounds tightest(const mpz_class &num, const mpz_class &den) {
  hsr_area_bounds b;
  b.hi =
      down_to_double(num, den, &b.lo) ? b.lo : std::nextafter(b.lo, infinity);
  return b;
}

/* ---- Atoms of a window ---- */

/* A face that may be seen in a window of atoms. */
struct listed {
  shape *f;
  bool covers;
};

/* Columns [x0, x1), rows [y0, y1) of atoms. */
struct block {
  int x0, y0, x1, y1;
};

class picture {
public:
  picture(const hsr_world &world, const hsr_view &view, int degree,
          const std::vector<box> &boxes);

  void open(const hsr_window &pixels);
  void bounds(int i, int j, hsr_area_bounds out[3]);
  void parts(int i, int j, shares *out);
  /* Bounds under a shader, if possible no wider than `width`. */
  void enclose(hsr_shades *by, int i, int j, double width,
               hsr_area_bounds out[3]);

private:
  const stage on_;
  const int degree_;
  const std::vector<box> &boxes_;
  std::unordered_map<uint32_t, std::unique_ptr<shape>> shapes_;
  std::unordered_map<const shape *, colour> colours_;
  std::unordered_map<const shape *, shaded_face> shaded_;
  block open_ = {0, 0, 0, 0};
  std::vector<atom> atoms_;
  std::deque<mixed_atom> mixed_;

  shape *shape_of(uint32_t f);
  const colour &colour_of(const shape *f);
  halves rectangle(const block &b) const;
  void divide(const block &b, const std::vector<listed> &above);
  void settle(const block &b, const std::vector<listed> &all);
  atom &at(int x, int y);
  bool shows_one(int i, int j);
  bool is_decided(int i, int j, hsr_area_bounds out[3]);
  const std::vector<part<mpz_class>> &fixed_of(mixed_atom *a);
  const std::vector<part<mpq_class>> &exact_of(mixed_atom *a);
  long weight_across(int i) const;
  long weight_down(int j) const;
  const shaded_face *shaded_of(hsr_shades *by, const shape *f);
  const std::vector<patch> &patches_of(hsr_shades *by, mixed_atom *a);
  patch whole_patch(hsr_shades *by, const atom &a, int x, int y);

  /* Calls look(atom, piece, its weight if it is whole) for all of a pixel. */
  template <class Look> void for_atoms(int i, int j, Look look);
};

picture::picture(const hsr_world &world, const hsr_view &view, int degree,
                 const std::vector<box> &boxes)
    : on_(world, view), degree_(degree), boxes_(boxes) {}

shape *picture::shape_of(uint32_t f) {
  const auto known = shapes_.find(f);
  if (known != shapes_.end())
    return known->second.get();
  return (shapes_[f] = make_shape(on_, f)).get();
}

const colour &picture::colour_of(const shape *f) {
  const auto known = colours_.find(f);
  if (known != colours_.end())
    return known->second;
  colour &made = colours_[f];
  ask_colour(on_, f ? f->id : HSR_BACKGROUND, made.rgb);
  for (int c = 0; c < 3; c++)
    made.bounds[c] = tightest(made.rgb[c], 65535);
  return made;
}

atom &picture::at(int x, int y) {
  return atoms_[size_t(y - open_.y0) * size_t(open_.x1 - open_.x0) +
                size_t(x - open_.x0)];
}

halves picture::rectangle(const block &b) const {
  const int m = on_.view.m, n = on_.view.n;
  return {atom_span(degree_, m, b.x0).from, atom_span(degree_, n, b.y0).from,
          atom_span(degree_, m, b.x1 - 1).to,
          atom_span(degree_, n, b.y1 - 1).to};
}

/* Of the faces that cover a rectangle, one that is certain to be nearer than
 * the others, if one is; else one that is likely to be. */
const listed *front_of(const std::vector<listed> &all, const halves &in) {
  const listed *front = nullptr;
  for (const listed &c : all)
    if (c.covers && (!front || is_nearer_in(*c.f, *front->f, in)))
      front = &c;
  return front;
}

void picture::settle(const block &b, const std::vector<listed> &all) {
  mixed_atom *mixed = nullptr;
  const bool whole = all.empty() || (all.size() == 1 && all[0].covers);
  for (int y = b.y0; y < b.y1; y++)
    for (int x = b.x0; x < b.x1; x++) {
      if (!whole) { /* one atom */
        mixed_.push_back({x, y, {}, {}, {}, 0, {}, 0});
        mixed = &mixed_.back();
        for (const listed &c : all)
          mixed->faces.push_back(c.f);
      }
      at(x, y) = {whole && !all.empty() ? all[0].f : nullptr, mixed};
    }
}

void picture::divide(const block &b, const std::vector<listed> &above) {
  const halves in = rectangle(b);
  std::vector<listed> all;
  for (const listed &c : above) {
    const cover here = c.covers ? COVERS : cover_of(*c.f, in);
    if (here != NOT_THERE)
      all.push_back({c.f, here == COVERS});
  }
  if (const listed *front = front_of(all, in)) {
    const shape *f = front->f;
    const auto is_behind = [&](const listed &c) {
      return c.f != f && is_nearer_in(*f, *c.f, in);
    };
    all.erase(std::remove_if(all.begin(), all.end(), is_behind), all.end());
  }
  const int width = b.x1 - b.x0, height = b.y1 - b.y0;
  if (all.empty() || (all.size() == 1 && all[0].covers) ||
      (width == 1 && height == 1)) {
    settle(b, all);
    return;
  }
  block one = b, two = b;
  if (width >= height)
    one.x1 = two.x0 = b.x0 + width / 2;
  else
    one.y1 = two.y0 = b.y0 + height / 2;
  divide(one, all);
  divide(two, all);
}

/* The atoms that the pixels of a window reach. */
void picture::open(const hsr_window &w) {
  const int first = first_piece(degree_), last = first + degree_;
  open_ = {std::max(0, w.x0 + first), std::max(0, w.y0 + first),
           std::min(n_atoms(degree_, on_.view.m), w.x1 + last),
           std::min(n_atoms(degree_, on_.view.n), w.y1 + last)};
  atoms_.assign(size_t(open_.x1 - open_.x0) * size_t(open_.y1 - open_.y0),
                {nullptr, nullptr});
  mixed_.clear();
  const halves in = rectangle(open_);
  std::vector<listed> all;
  for (uint32_t f = 0; f < on_.world.n_faces; f++) {
    const box &b = boxes_[f];
    if (b.x1 <= in.x0 / 2.0 || b.x0 >= in.x1 / 2.0 || b.y1 <= in.y0 / 2.0 ||
        b.y0 >= in.y1 / 2.0)
      continue;
    if (shape *made = shape_of(f))
      all.push_back({made, false});
  }
  divide(open_, all);
}

/* ---- Pixels ---- */

const std::vector<part<mpz_class>> &picture::fixed_of(mixed_atom *a) {
  if (!a->fixed.empty())
    return a->fixed;
  face_sums<fixed_sum> sums(*a, degree_);
  cut(rectangle({a->x, a->y, a->x + 1, a->y + 1}), a->faces, sums);
  for (const auto &face : sums.all) {
    a->fixed.push_back({face.first, face.second.integrals(degree_)});
    a->error += face.second.error();
  }
  return a->fixed;
}

const std::vector<part<mpq_class>> &picture::exact_of(mixed_atom *a) {
  if (!a->exact.empty())
    return a->exact;
  face_sums<exact_sum> sums(*a, degree_);
  cut(rectangle({a->x, a->y, a->x + 1, a->y + 1}), a->faces, sums);
  for (const auto &face : sums.all)
    a->exact.push_back({face.first, face.second.integrals(degree_)});
  return a->exact;
}

template <class Look> void picture::for_atoms(int i, int j, Look look) {
  const int first = first_piece(degree_), m = on_.view.m, n = on_.view.n;
  for (int l = 0; l <= degree_; l++)
    for (int k = 0; k <= degree_; k++) {
      const int x = i + first + k, y = j + first + l;
      if (x < 0 || y < 0 || x >= n_atoms(degree_, m) ||
          y >= n_atoms(degree_, n))
        continue;
      look(at(x, y), size_t(k * (degree_ + 1) + l),
           whole_piece(degree_, m, x, k) * whole_piece(degree_, n, y, l));
    }
}

/* The integral of the filter over the screen, one factor, whole_scale() times.
 */
long weight_along(int degree, int n, int i) {
  long sum = 0;
  for (int k = 0; k <= degree; k++) {
    const int at = i + first_piece(degree) + k;
    if (at >= 0 && at < n_atoms(degree, n))
      sum += whole_piece(degree, n, at, k);
  }
  return sum;
}

long picture::weight_across(int i) const {
  return weight_along(degree_, on_.view.m, i);
}
long picture::weight_down(int j) const {
  return weight_along(degree_, on_.view.n, j);
}

/* What the integrals of a mixed atom are to be taken times, so that all are
 * whole_scale() squared times. */
long mixed_scale(int degree) {
  const long one = whole_scale(degree) / factorial[degree];
  return one * one;
}

/* Whether all atoms of a pixel show the same face. */
bool picture::shows_one(int i, int j) {
  const atom *first = nullptr;
  bool same = true;
  for_atoms(i, j, [&](const atom &a, size_t, long) {
    first = first ? first : &a;
    same = same && !a.mixed && a.only == first->only;
  });
  return same;
}

/* In fixed point. False if a double lies so near to the value that it is open
 * whether it is below, equal or above. */
bool picture::is_decided(int i, int j, hsr_area_bounds out[3]) {
  mpz_class whole[3], mixed[3], error;
  for_atoms(i, j, [&](const atom &a, size_t k, long weight) {
    const auto add = [&](const shape *face, mpz_class *sum, const auto &times) {
      const colour &seen = colour_of(face);
      for (int c = 0; c < 3; c++)
        sum[c] += times * seen.rgb[c];
    };
    if (!a.mixed) {
      add(a.only, whole, weight);
      return;
    }
    for (const part<mpz_class> &p : fixed_of(a.mixed))
      add(p.face, mixed, p.integrals[k]);
    error += 65535 * a.mixed->error;
  });
  const long scale = mixed_scale(degree_);
  mpz_class den = weight_across(i) * weight_down(j);
  den = (65535 * den) << FIXED;
  error *= scale;
  for (int c = 0; c < 3; c++) {
    const mpz_class value = (whole[c] << FIXED) + scale * mixed[c];
    if (error == 0) {
      out[c] = tightest(value, den);
      continue;
    }
    const mpz_class below = value - error, above = value + error;
    double high;
    if (below < 0 || down_to_double(below, den, &out[c].lo))
      return false;
    down_to_double(above, den, &high);
    if (high != out[c].lo)
      return false;
    out[c].hi = std::nextafter(high, infinity);
  }
  return true;
}

void picture::bounds(int i, int j, hsr_area_bounds out[3]) {
  if (shows_one(i, j)) {
    const atom *any = nullptr;
    for_atoms(i, j, [&](const atom &a, size_t, long) { any = &a; });
    const colour &only = colour_of(any->only);
    std::copy(only.bounds, only.bounds + 3, out);
    return;
  }
  if (is_decided(i, j, out))
    return;
  shares all;
  parts(i, j, &all);
  for (int c = 0; c < 3; c++) {
    mpq_class value = 0;
    for (const auto &share : all)
      value += share.second * colour_of(share.first).rgb[c];
    value /= 65535;
    out[c] = tightest(value.get_num(), value.get_den());
  }
}

void picture::parts(int i, int j, shares *out) {
  const mpq_class scale = mixed_scale(degree_);
  out->clear();
  for_atoms(i, j, [&](const atom &a, size_t k, long weight) {
    if (!a.mixed) {
      if (weight)
        (*out)[a.only] += weight;
      return;
    }
    for (const part<mpq_class> &p : exact_of(a.mixed))
      (*out)[p.face] += scale * p.integrals[k];
  });
  const mpq_class all = weight_across(i) * weight_down(j);
  for (auto &share : *out)
    share.second /= all;
}

/* ---- Shaders ---- */

[[gnu::noinline]] void ask_face(hsr_shades *by, uint32_t id,
                                hsr_shaded_face *face) {
  const Nearest to_nearest;
  if (!hsr_shades_face(by, id, face))
    throw std::bad_alloc();
}

/* N·(S/k - E), with Newell's N and the sum S of the k vertices, in parallel
 * too.
 */
void find_plane(const stage &on, uint32_t f, shaded_face *to) {
  const hsr_mesh &mesh = on.world.mesh;
  const uint32_t *vertex = mesh.vertex + mesh.start[f];
  const uint32_t k = hsr_face_size(&on.world, f);
  const auto seen = [&](uint32_t v) {
    return judge::lift<Interval>(mesh.x[v], mesh.y[v], mesh.z[v]) - on.rough.E;
  };
  const vec<Interval> first = seen(vertex[0]);
  vec<Interval> N = judge::lift<Interval>(0, 0, 0), sum = first, before = N;
  for (uint32_t i = 1; i < k; i++) {
    const vec<Interval> v = seen(vertex[i]), here = v - first;
    N = N + judge::cross(before, here);
    sum = sum + v;
    before = here;
  }
  to->normal = N;
  to->height = judge::dot(N, sum) / Interval(double(k));
}

const shaded_face *picture::shaded_of(hsr_shades *by, const shape *f) {
  if (!f)
    return nullptr;
  const auto known = shaded_.find(f);
  if (known != shaded_.end())
    return &known->second;
  shaded_face &made = shaded_[f];
  ask_face(by, f->id, &made.surface.face);
  find_plane(on_, f->id, &made);
  const hsr_mesh &mesh = on_.world.mesh;
  for (int k = 0; made.surface.face.by_corners && k < 3; k++) {
    const uint32_t v = mesh.vertex[mesh.start[f->id] + uint32_t(k)];
    made.surface.corner[k][0] = mesh.x[v];
    made.surface.corner[k][1] = mesh.y[v];
    made.surface.corner[k][2] = mesh.z[v];
  }
  return &made;
}

/* Collects the cells of an atom. Their corners may be so far from the truth. */
struct patches : sink {
  std::vector<std::pair<const shape *, patch>> all;
  const double x0, y0;
  double slack = 0;

  patches(double x, double y) : x0(x), y0(y) {}
  double place(const Interval &exact, double origin) {
    const Interval here = exact - Interval(origin);
    slack += 4 * (here.sup() - here.inf());
    return std::min(1., std::max(0., here.inf()));
  }
  void take(const cell &c, const shape *seen) override {
    patch made = {nullptr, {}, {}};
    for (point *corner : c.corner) {
      made.x.push_back(place(corner->x, x0));
      made.y.push_back(place(corner->y, y0));
    }
    all.push_back({seen, made});
  }
};

double origin_of(int degree, int atom) {
  return atom - (degree % 2) / 2.;
}

const std::vector<patch> &picture::patches_of(hsr_shades *by, mixed_atom *a) {
  if (!a->patches.empty())
    return a->patches;
  patches found(origin_of(degree_, a->x), origin_of(degree_, a->y));
  cut(rectangle({a->x, a->y, a->x + 1, a->y + 1}), a->faces, found);
  for (auto &one : found.all) {
    one.second.face = shaded_of(by, one.first);
    a->patches.push_back(one.second);
  }
  a->slack = found.slack;
  return a->patches;
}

patch picture::whole_patch(hsr_shades *by, const atom &a, int x, int y) {
  const halves r = rectangle({x, y, x + 1, y + 1});
  const double x0 = r.x0 / 2. - origin_of(degree_, x),
               x1 = r.x1 / 2. - origin_of(degree_, x),
               y0 = r.y0 / 2. - origin_of(degree_, y),
               y1 = r.y1 / 2. - origin_of(degree_, y);
  return {shaded_of(by, a.only), {x0, x1, x1, x0}, {y0, y0, y1, y1}};
}

void picture::enclose(hsr_shades *by, int i, int j, double width,
                      hsr_area_bounds out[3]) {
  const int first = first_piece(degree_);
  const double whole = double(whole_scale(degree_));
  const Interval weight = Interval(double(weight_across(i))) *
                          Interval(double(weight_down(j))) /
                          Interval(whole * whole);
  double background[3];
  for (int c = 0; c < 3; c++)
    background[c] = colour_of(nullptr).rgb[c];
  shaded_pixel pixel(on_, *by, degree_, background);
  pixel.begin();
  for (int l = 0; l <= degree_; l++)
    for (int k = 0; k <= degree_; k++) {
      const int x = i + first + k, y = j + first + l;
      if (x < 0 || y < 0 || x >= n_atoms(degree_, on_.view.m) ||
          y >= n_atoms(degree_, on_.view.n))
        continue;
      const atom &a = at(x, y);
      if (!a.mixed) {
        pixel.add(whole_patch(by, a, x, y), x, y, k, l);
        continue;
      }
      for (const patch &p : patches_of(by, a.mixed))
        pixel.add(p, x, y, k, l);
      pixel.add_slack(a.mixed->slack);
    }
  constexpr size_t most_triangles = 2000;
  Interval sum[3];
  pixel.enclose(width, most_triangles, sum);
  for (int c = 0; c < 3; c++) {
    const Interval value = sum[c] / weight;
    out[c] = {std::max(0., value.inf()), std::min(1., value.sup())};
  }
}

/* ---- Windows ---- */

/* Freed at the end. */
class kept_arena {
public:
  hsr_arena *get() const { return arena_.get(); }

private:
  struct freed {
    void operator()(hsr_arena *a) const {
      hsr_arena_free(a);
      delete a;
    }
  };
  std::unique_ptr<hsr_arena, freed> arena_{new hsr_arena()};
};

/* Calls look(i, j) for every pixel of a window, row by row. Some rows at a time
 * are opened. */
template <class Look>
void for_pixels(picture *p, const hsr_window &w, Look look) {
  constexpr int rows = 64;
  for (int y = w.y0; y < w.y1; y += rows) {
    const hsr_window band = {w.x0, y, w.x1, std::min(y + rows, w.y1)};
    p->open(band);
    for (int j = band.y0; j < band.y1; j++)
      for (int i = w.x0; i < w.x1; i++)
        look(i, j);
  }
}

} // namespace

std::shared_ptr<const std::vector<box>> find_boxes(const hsr_world &world,
                                                   const hsr_view &view) {
  const Upward upward;
  const stage on(world, view);
  auto made = std::make_shared<std::vector<box>>();
  made->reserve(world.n_faces);
  for (uint32_t f = 0; f < world.n_faces; f++)
    made->push_back(bounds_of(on, f));
  return made;
}

void find_bounds(const hsr_world &world, const hsr_view &view,
                 const hsr_area_form &form, const std::vector<box> &boxes,
                 hsr_area_bounds *bounds) {
  const kept_arena memory;
  hsr_shades shading;
  if (hsr_shades_init(&shading, form.shader, form.side, &world, &view,
                      memory.get()))
    throw std::bad_alloc();
  const Upward upward;
  picture p(world, view, int(form.filter), boxes);
  for_pixels(&p, view.window, [&](int i, int j) {
    hsr_area_bounds *to = bounds + 3 * (size_t(j) * size_t(view.m) + size_t(i));
    if (shading.parts)
      p.enclose(&shading, i, j, form.eps / 16, to);
    else
      p.bounds(i, j, to);
  });
}

namespace {

/* Ends the walk through the pixels. */
struct stopped {
  enum hsr_status status;
};

void visit_parts(picture *p, int i, int j, area_visitor *visit, void *to) {
  shares all;
  p->parts(i, j, &all);
  std::vector<area_part> parts;
  for (auto &share : all)
    if (share.second != 0) {
      area_part made;
      made.face = share.first ? share.first->id : HSR_BACKGROUND;
      made.share[0] = *share.second.get_mpq_t(); /* lent */
      parts.push_back(made);
    }
  const Nearest to_nearest;
  if (const enum hsr_status status =
          visit(to, i, j, parts.data(), parts.size()))
    throw stopped{status};
}

} // namespace

} // namespace areas

extern "C" enum hsr_status visit_areas(const struct hsr_world *world,
                                       const struct hsr_view *view,
                                       enum hsr_area_filter filter,
                                       area_visitor *visit, void *to,
                                       struct hsr_error *err) {
  try {
    if (!judge::is_rounding_honoured())
      return hsr_fail(err, HSR_E_INTERNAL,
                      "areas: directed rounding has no effect here");
    const auto boxes = areas::find_boxes(*world, *view);
    const areas::Upward upward;
    areas::picture p(*world, *view, int(filter), *boxes);
    areas::for_pixels(&p, view->window, [&](int i, int j) {
      areas::visit_parts(&p, i, j, visit, to);
    });
    return HSR_OK;
  } catch (const areas::stopped &end) {
    return end.status;
  } catch (const std::bad_alloc &) {
    return hsr_fail_nomem(err);
  } catch (const std::exception &e) {
    return hsr_fail(err, HSR_E_INTERNAL, "areas: %s", e.what());
  }
}
