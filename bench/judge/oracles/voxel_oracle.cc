/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The voxel oracle: the solid that each voxel is in, from the definition alone.
 *
 * Source      docs/solid-voxels.md, in whose words this file is written.
 * Input       the world's vertices, face lists and instances; neither its
 *             approximate planes nor its plane classes, and nothing of those
 *             whom it judges: no convex parts, no tiling.
 * Notation    a column: the voxels of one x and one y.
 * Method      for every face of a solid and every column that the face crosses,
 *             a ray along +z from a voxel of the column meets the face if the
 *             voxel is below it. Those voxels change sides. In a column they
 *             are the first ones, so that the last of them is found by halving.
 *             Every decision is a sign of a determinant, by CGAL's exact
 *             predicates.
 * Ties        the displacement (e, e^2, e^3) decides whatever sign is zero.
 * Departures  none: there is no paper.
 * Cost        six determinants or so for every face and column that it crosses,
 *             and two comparisons for every column of its box and every edge.
 */
#include "algorithms/algorithm.h"
#include "common/answers/kinds/voxels.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <limits>
#include <map>
#include <new>
#include <utility>
#include <vector>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Flat = Kernel::Point_2;

enum { VOXEL_COLUMN, VOXEL_SIDE };

constexpr double infinity = std::numeric_limits<double>::infinity();

struct box {
  std::array<double, 3> lo = {infinity, infinity, infinity};
  std::array<double, 3> hi = {-infinity, -infinity, -infinity};

  void add(const Point &p) {
    for (size_t k = 0; k < 3; k++) {
      lo[k] = std::min(lo[k], p[int(k)]);
      hi[k] = std::max(hi[k], p[int(k)]);
    }
  }
};

/* --- Faces ---------------------------------------------------------------- */

/* A flat face: its corners, and three of them that are not on a line. */
struct side {
  std::vector<Point> corner;
  std::array<Point, 3> plane;
  box extent;
  uint32_t face;

  side(const hsr_world &world, uint32_t f) : face(f) {
    const hsr_mesh &mesh = world.mesh;
    for (uint32_t k = mesh.start[f]; k < mesh.start[f + 1]; k++) {
      const uint32_t v = mesh.vertex[k];
      corner.emplace_back(mesh.x[v], mesh.y[v], mesh.z[v]);
      extent.add(corner.back());
    }
    for (size_t k = 2; k < corner.size(); k++)
      for (size_t l = 1; l < k; l++)
        if (!CGAL::collinear(corner[0], corner[l], corner[k])) {
          plane = {corner[0], corner[l], corner[k]};
          return;
        }
  }

  bool is_flat() const {
    return std::all_of(corner.begin(), corner.end(), [&](const Point &p) {
      return CGAL::coplanar(plane[0], plane[1], plane[2], p);
    });
  }

  /* The sign of the plane's normal along an axis. */
  int normal(int axis) const {
    const auto flat = [&](const Point &p) {
      return Flat(p[(axis + 1) % 3], p[(axis + 2) % 3]);
    };
    return CGAL::orientation(flat(plane[0]), flat(plane[1]), flat(plane[2]));
  }

  /* Whether the line along z through the displaced point (x, y) goes through
   * the face: a ray along +x meets its edges an odd number of times. */
  bool is_crossed(double x, double y) const {
    bool odd = false;
    for (size_t k = 0, l = corner.size() - 1; k < corner.size(); l = k++) {
      const Point *a = &corner[k], *b = &corner[l];
      if ((a->y() > y) == (b->y() > y))
        continue;
      if (a->y() > b->y())
        std::swap(a, b);
      /* A point left of an edge that goes up has it on its ray. One on the
       * edge is displaced to its right. */
      odd ^= CGAL::orientation(Flat(a->x(), a->y()), Flat(b->x(), b->y()),
                               Flat(x, y)) == CGAL::POSITIVE;
    }
    return odd;
  }

  /* Whether the displaced point is below the face, which its line crosses: on
   * the side of the plane to which its normal does not point if that points
   * up. A face that is crossed is not vertical. */
  bool is_above(const Point &p) const {
    int on = CGAL::orientation(plane[0], plane[1], plane[2], p);
    for (int axis = 0; axis < 3 && !on; axis++)
      on = normal(axis);
    return on * normal(2) < 0;
  }
};

/* --- Solids --------------------------------------------------------------- */

/* The faces of each body, in the order of its first. */
using bodies = std::vector<std::vector<side>>;

/* The body of each vertex, by joining the vertices of each face. */
class joined {
  std::vector<uint32_t> up;

public:
  explicit joined(const hsr_world &world) : up(world.mesh.n_vertices) {
    const hsr_mesh &mesh = world.mesh;
    for (uint32_t v = 0; v < mesh.n_vertices; v++)
      up[v] = v;
    for (uint32_t f = 0; f < world.n_faces; f++)
      for (uint32_t k = mesh.start[f] + 1; k < mesh.start[f + 1]; k++)
        up[find(mesh.vertex[k])] = find(mesh.vertex[k - 1]);
  }

  uint32_t find(uint32_t v) {
    while (up[v] != v)
      v = up[v] = up[up[v]];
    return v;
  }
};

bodies bodies_of(const hsr_world &world) {
  bodies all;
  joined vertices(world);
  std::map<uint32_t, size_t> number; /* of a body, by the vertex that it has */
  for (uint32_t f = 0; f < world.n_faces; f++) {
    const uint32_t v = vertices.find(world.mesh.vertex[world.mesh.start[f]]);
    const auto place = number.emplace(v, all.size());
    if (place.second)
      all.emplace_back();
    all[place.first->second].emplace_back(world, f);
  }
  return all;
}

/* The first face of a body that is not flat, or has an edge that is not of two
 * faces; HSR_BACKGROUND if there is none. */
uint32_t open_face(const hsr_world &world, const std::vector<side> &body) {
  const hsr_mesh &mesh = world.mesh;
  std::map<std::pair<uint32_t, uint32_t>, int> uses;
  const auto edge = [&](uint32_t f, uint32_t k) {
    const uint32_t next = k + 1 < mesh.start[f + 1] ? k + 1 : mesh.start[f];
    return std::minmax(mesh.vertex[k], mesh.vertex[next]);
  };
  for (const side &s : body)
    for (uint32_t k = mesh.start[s.face]; k < mesh.start[s.face + 1]; k++)
      uses[edge(s.face, k)]++;
  for (const side &s : body) {
    if (!s.is_flat())
      return s.face;
    for (uint32_t k = mesh.start[s.face]; k < mesh.start[s.face + 1]; k++)
      if (uses[edge(s.face, k)] != 2)
        return s.face;
  }
  return HSR_BACKGROUND;
}

/* --- The grid ------------------------------------------------------------- */

struct grid {
  double lo[3], size;
  int n[3];

  grid(const bodies &all, int most) {
    box whole;
    for (const auto &body : all)
      for (const side &s : body)
        for (const Point &p : s.corner)
          whole.add(p);
    double longest = 0;
    for (size_t k = 0; k < 3; k++)
      longest = std::max(longest, whole.hi[k] - whole.lo[k]);
    size = longest / most;
    for (size_t k = 0; k < 3; k++) {
      lo[k] = whole.lo[k];
      const double voxels = std::ceil((whole.hi[k] - whole.lo[k]) / size);
      n[k] = int(std::clamp(voxels, 1.0, double(most)));
    }
  }

  double centre(int axis, int k) const { return lo[axis] + (k + 0.5) * size; }

  /* Voxels along an axis that may have centres between two coordinates. */
  std::pair<int, int> range(int axis, double from, double to) const {
    const auto place = [&](double x) {
      return int(std::clamp((x - lo[axis]) / size, -4.0, n[axis] + 4.0));
    };
    return {std::max(place(from) - 2, 0), std::min(place(to) + 3, n[axis])};
  }

  size_t number(int x, int y, int z) const {
    return (size_t(z) * size_t(n[1]) + size_t(y)) * size_t(n[0]) + size_t(x);
  }
};

/* --- Judging -------------------------------------------------------------- */

struct judge {
  const grid &g;
  hsr_tally *tally;
  std::vector<bool> odd; /* voxels of the current solid */

  judge(const grid &of, hsr_tally *counts)
      : g(of), tally(counts),
        odd(size_t(g.n[0]) * size_t(g.n[1]) * size_t(g.n[2])) {}

  bool is_below(const side &s, int x, int y, int z) {
    HSR_STEP(tally, VOXEL_SIDE, HSR_FACE(s.face), HSR_NOTHING, HSR_NOWHERE, 0);
    return s.is_above(Point(g.centre(0, x), g.centre(1, y), g.centre(2, z)));
  }

  /* How many of the column's voxels are below the face. */
  int count_below(const side &s, int x, int y) {
    int below = 0, not_below = g.n[2];
    while (below < not_below) {
      const int z = below + (not_below - below) / 2;
      if (is_below(s, x, y, z))
        below = z + 1;
      else
        not_below = z;
    }
    return below;
  }

  void turn(const side &s) {
    const auto columns = g.range(0, s.extent.lo[0], s.extent.hi[0]);
    const auto rows = g.range(1, s.extent.lo[1], s.extent.hi[1]);
    for (int y = rows.first; y < rows.second; y++)
      for (int x = columns.first; x < columns.second; x++) {
        HSR_STEP(tally, VOXEL_COLUMN, HSR_FACE(s.face), HSR_NOTHING,
                 HSR_NOWHERE, 0);
        if (!s.is_crossed(g.centre(0, x), g.centre(1, y)))
          continue;
        const int n = count_below(s, x, y);
        for (int z = 0; z < n; z++) {
          const size_t k = g.number(x, y, z);
          odd[k] = !odd[k];
        }
      }
  }

  /* The voxels of a solid that are in no solid before it. Leaves `odd` as it
   * was: all false. */
  void take(const std::vector<side> &body, uint32_t number, uint32_t *solid) {
    box extent;
    for (const side &s : body) {
      turn(s);
      for (const Point &p : s.corner)
        extent.add(p);
    }
    const auto xs = g.range(0, extent.lo[0], extent.hi[0]);
    const auto ys = g.range(1, extent.lo[1], extent.hi[1]);
    for (int z = 0; z < g.n[2]; z++)
      for (int y = ys.first; y < ys.second; y++)
        for (int x = xs.first; x < xs.second; x++) {
          const size_t k = g.number(x, y, z);
          if (odd[k] && !solid[k])
            solid[k] = number;
          odd[k] = false;
        }
  }
};

/* --- The algorithm -------------------------------------------------------- */

template <class Do> enum hsr_status guarded(struct hsr_error *err, Do &&act) {
  try {
    return act();
  } catch (const std::bad_alloc &) {
    return hsr_fail_nomem(err);
  } catch (const std::exception &e) {
    return hsr_fail(err, HSR_E_INTERNAL, "voxel-oracle: %s", e.what());
  } catch (...) {
    return hsr_fail(err, HSR_E_INTERNAL, "voxel-oracle: an unknown exception");
  }
}

extern "C" {

static enum hsr_status prepare(const struct hsr_world *world, const long *,
                               void **prepared, struct hsr_error *err) {
  return guarded(err, [&] {
    auto *made = new bodies(bodies_of(*world));
    *prepared = made;
    for (const auto &body : *made) {
      const uint32_t face = open_face(*world, body);
      if (face != HSR_BACKGROUND)
        return hsr_fail(err, HSR_E_REFUSED,
                        "%s: face %u is not of a closed solid",
                        hsr_restriction_code(HSR_CC), face);
    }
    return HSR_OK;
  });
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  return guarded(err, [&] {
    const auto &all = *static_cast<const bodies *>(job->prepared);
    const grid g(all, hsr_form_voxels(&job->answer->form));
    hsr_voxel_grid given = {
        {g.lo[0], g.lo[1], g.lo[2]}, g.size, {g.n[0], g.n[1], g.n[2]}};
    hsr_solid_voxels *voxels = hsr_answer_voxels_of(job->answer);
    if (hsr_solid_voxels_open(voxels, &given))
      return hsr_fail_nomem(err);
    judge j(g, job->tally);
    for (size_t b = 0; b < all.size(); b++)
      j.take(all[b], uint32_t(b + 1), voxels->solid);
    return HSR_OK;
  });
}

static void release(void *prepared) {
  delete static_cast<bodies *>(prepared);
}

} /* extern "C" */

constexpr struct hsr_counter counters[] = {
    {"columns", "columns of voxels tested against faces", HSR_COMPARE},
    {"sides", "centres of voxels tested against planes", HSR_COMPARE},
    {nullptr}};

constexpr struct hsr_algorithm describe() {
  struct hsr_algorithm a = {};
  a.name = "voxel-oracle";
  a.title = "Voxel oracle: exact solids in voxels from the definition";
  a.authors = "hsr";
  a.source = "docs/solid-voxels.md";
  a.taxonomy = HSR_YARDSTICK;
  a.subjects = 1 << HSR_FACES;
  a.makes[0].kind = HSR_VOXELS;
  a.flags = HSR_JUDGE;
  a.counters = counters;
  a.prepare = prepare;
  a.render = render;
  a.release = release;
  return a;
}

} /* namespace */

/* Constant-initialised. Declared first: a const is otherwise private to its
 * file in C++. */
extern "C" const struct hsr_algorithm HSR_ALGORITHM(voxel_oracle);
constexpr struct hsr_algorithm description = describe();
const struct hsr_algorithm HSR_ALGORITHM(voxel_oracle) = description;
