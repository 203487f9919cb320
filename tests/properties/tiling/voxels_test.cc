// SPDX-License-Identifier: GPL-3.0-or-later
// Voxels, judged one by one. A voxel is in a solid if a ray from its centre
// meets the solid's faces an odd number of times. CGAL's exact predicates
// decide that on the scene's own corners; the centre is displaced by (e, e^2,
// e^3). The oracle of voxels, which goes by columns, is compared with the same
// judge.
#define HSR_COUNTING 1
#include "bench/modules/modules.h"
#include "algorithms/counting-names.h" // the functions of that build
#include "algorithms/setup.h"
#include "algorithms/volume/solid_pyramid.h"
#include "scenes/scenes.h"
#include "tests/properties/splitmix64.h"
#include "tests/tap.h"
#include "common/answers/kinds/voxels.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Flat = Kernel::Point_2;
using Box = Kernel::Iso_cuboid_3;

// ---- The oracle ----

// A face: its corners, and three of them that are not on a line.
struct Face {
  std::vector<Point> corner;
  std::array<Point, 3> plane;

  explicit Face(const std::vector<Point> &corners) : corner(corners) {
    for (size_t k = 2; k < corner.size(); k++)
      if (!CGAL::collinear(corner[0], corner[1], corner[k]))
        plane = {corner[0], corner[1], corner[k]};
  }

  // The sign of the plane's normal along an axis.
  int normal(int axis) const {
    const auto flat = [&](const Point &p) {
      return Flat(p[(axis + 1) % 3], p[(axis + 2) % 3]);
    };
    return CGAL::orientation(flat(plane[0]), flat(plane[1]), flat(plane[2]));
  }

  // Whether the displaced point is inside the face as seen along z: whether a
  // ray along x meets its sides an odd number of times.
  bool holds(const Point &p) const {
    bool odd = false;
    for (size_t k = 0, l = corner.size() - 1; k < corner.size(); l = k++) {
      const Point *a = &corner[k], *b = &corner[l];
      if ((a->y() > p.y()) == (b->y() > p.y()))
        continue;
      if (a->y() > b->y())
        std::swap(a, b);
      // On its left if the side goes up. A point on it is displaced to the
      // right.
      odd ^= CGAL::orientation(Flat(a->x(), a->y()), Flat(b->x(), b->y()),
                               Flat(p.x(), p.y())) == CGAL::POSITIVE;
    }
    return odd;
  }

  // Whether the displaced point, which the face holds, is below the face.
  bool is_above(const Point &p) const {
    int side = CGAL::orientation(plane[0], plane[1], plane[2], p);
    for (int axis = 0; axis < 3 && !side; axis++)
      side = normal(axis);
    return side * normal(2) < 0;
  }
};

struct Solid {
  std::vector<Face> faces;
  double lo[3] = {INFINITY, INFINITY, INFINITY};
  double hi[3] = {-INFINITY, -INFINITY, -INFINITY};

  void add(const Face &face) {
    faces.push_back(face);
    for (const Point &p : face.corner)
      for (int k = 0; k < 3; k++) {
        lo[k] = std::min(lo[k], p[k]);
        hi[k] = std::max(hi[k], p[k]);
      }
  }
  bool has(const Point &p) const {
    bool odd = false;
    for (int k = 0; k < 3; k++)
      if (p[k] < lo[k] || p[k] > hi[k])
        return false;
    for (const Face &face : faces)
      odd ^= face.holds(p) && face.is_above(p);
    return odd;
  }
};

// Faces that share a vertex are of one solid.
std::vector<Solid> solids_of(const hsr_world &world) {
  std::vector<uint32_t> up(world.mesh.n_vertices),
      number(world.mesh.n_vertices, 0);
  for (uint32_t v = 0; v < world.mesh.n_vertices; v++)
    up[v] = v;
  const auto find = [&](uint32_t v) {
    while (up[v] != v)
      v = up[v] = up[up[v]];
    return v;
  };
  for (uint32_t f = 0; f < world.n_faces; f++)
    for (uint32_t k = world.mesh.start[f] + 1; k < world.mesh.start[f + 1]; k++)
      up[find(world.mesh.vertex[k])] = find(world.mesh.vertex[k - 1]);
  std::vector<Solid> solids;
  for (uint32_t f = 0; f < world.n_faces; f++) {
    std::vector<Point> corners;
    for (uint32_t k = world.mesh.start[f]; k < world.mesh.start[f + 1]; k++) {
      const uint32_t v = world.mesh.vertex[k];
      corners.emplace_back(world.mesh.x[v], world.mesh.y[v], world.mesh.z[v]);
    }
    uint32_t &n = number[find(world.mesh.vertex[world.mesh.start[f]])];
    if (!n) {
      solids.emplace_back();
      n = uint32_t(solids.size());
    }
    solids[n - 1].add(Face(corners));
  }
  return solids;
}

// The grid, from its definition.
struct Grid {
  double lo[3], size;
  int n[3];

  Grid(const std::vector<Solid> &solids, int most) {
    double hi[3], longest = 0;
    for (int k = 0; k < 3; k++) {
      lo[k] = INFINITY;
      hi[k] = -INFINITY;
      for (const Solid &solid : solids) {
        lo[k] = std::min(lo[k], solid.lo[k]);
        hi[k] = std::max(hi[k], solid.hi[k]);
      }
      longest = std::max(longest, hi[k] - lo[k]);
    }
    size = longest / most;
    for (int k = 0; k < 3; k++)
      n[k] = std::min(most, int(std::ceil((hi[k] - lo[k]) / size)));
  }
  double centre(int axis, int k) const { return lo[axis] + (k + .5) * size; }
  size_t number(int x, int y, int z) const {
    return (size_t(z) * size_t(n[1]) + size_t(y)) * size_t(n[0]) + size_t(x);
  }
  size_t all() const { return size_t(n[0]) * size_t(n[1]) * size_t(n[2]); }
};

struct Truth {
  std::vector<uint32_t> solid; // of each voxel
  size_t shared = 0;           // voxels in more than one solid
};

Truth truth_of(const Grid &grid, const std::vector<Solid> &solids) {
  Truth truth;
  truth.solid.assign(grid.all(), 0);
  for (uint32_t s = 0; s < solids.size(); s++) {
    int from[3], to[3];
    for (int k = 0; k < 3; k++) {
      from[k] = int((solids[s].lo[k] - grid.lo[k]) / grid.size) - 1;
      to[k] = int((solids[s].hi[k] - grid.lo[k]) / grid.size) + 2;
      from[k] = std::max(from[k], 0);
      to[k] = std::min(to[k], grid.n[k]);
    }
    for (int z = from[2]; z < to[2]; z++)
      for (int y = from[1]; y < to[1]; y++)
        for (int x = from[0]; x < to[0]; x++) {
          const Point p(grid.centre(0, x), grid.centre(1, y),
                        grid.centre(2, z));
          if (!solids[s].has(p))
            continue;
          uint32_t &answer = truth.solid[grid.number(x, y, z)];
          truth.shared += answer != 0;
          answer = answer ? answer : s + 1;
        }
  }
  return truth;
}

// ---- Scenes ----

struct Stage {
  hsr_scene *scene = nullptr;
  hsr_world world = {};
  hsr_edges edges = {};
  hsr_volumes volumes = {};
  hsr_error err = {HSR_OK, ""};

  explicit Stage(const char *name) {
    hsr_import import = {};
    if (hsr_scene_open(name, &import, &scene, &err))
      stop();
    prepare();
  }
  explicit Stage(hsr_scene *made) : scene(made) {
    if (hsr_scene_finish(scene, &err))
      stop();
    prepare();
  }
  Stage(const Stage &) = delete;
  ~Stage() {
    hsr_volumes_free(&volumes);
    hsr_edges_free(&edges);
    hsr_world_free(&world);
    hsr_scene_delete(scene);
  }

private:
  [[noreturn]] void stop() const { bail("%s", err.text); }
  void prepare() {
    if (hsr_world_init(&world, scene, &err) ||
        hsr_edges_init(&edges, &world, &err) ||
        hsr_volumes_init(&volumes, &edges, &err))
      stop();
  }
};

using Triangles = std::vector<std::array<Point, 3>>;

// The convex hull of random points, of integer coordinates or others; empty if
// it has no inside.
Triangles random_hull(int n, int reach, bool integers) {
  std::vector<Point> points;
  for (int k = 0; k < n; k++) {
    double at[3];
    for (double &x : at)
      x = integers ? integer(0, reach) : real(0, reach);
    points.emplace_back(at[0], at[1], at[2]);
  }
  bool flat = true;
  for (int k = 3; k < n && flat; k++)
    for (int l = 2; l < k && flat; l++)
      flat = CGAL::coplanar(points[0], points[1], points[size_t(l)],
                            points[size_t(k)]);
  Triangles triangles;
  if (flat)
    return triangles;
  CGAL::Surface_mesh<Point> hull;
  CGAL::convex_hull_3(points.begin(), points.end(), hull);
  for (const auto f : hull.faces()) {
    std::array<Point, 3> triangle;
    size_t k = 0;
    for (const auto v : hull.vertices_around_face(hull.halfedge(f)))
      triangle[k++] = hull.point(v);
    triangles.push_back(triangle);
  }
  return triangles;
}

void add_solid(hsr_scene *scene, const Triangles &triangles) {
  hsr_object *object = hsr_scene_object(scene, "solid");
  std::vector<Point> vertices;
  for (const auto &triangle : triangles) {
    uint32_t number[3];
    for (size_t k = 0; k < 3; k++) {
      const auto found =
          std::find(vertices.begin(), vertices.end(), triangle[k]);
      number[k] = uint32_t(found - vertices.begin());
      if (found != vertices.end())
        continue;
      vertices.push_back(triangle[k]);
      hsr_object_vertex(object, triangle[k].x(), triangle[k].y(),
                        triangle[k].z(), nullptr);
    }
    hsr_object_face(object, number, 3, nullptr);
  }
}

// The tetrahedra from a corner of a hull to the triangles that do not meet the
// corner: they touch one another, and fill the hull.
std::vector<Triangles> fan(const Triangles &hull) {
  std::vector<Triangles> all;
  const Point o = hull[0][0];
  for (const auto &t : hull)
    if (!CGAL::coplanar(o, t[0], t[1], t[2]))
      all.push_back({{t[0], t[1], t[2]},
                     {o, t[1], t[0]},
                     {o, t[2], t[1]},
                     {o, t[0], t[2]}});
  return all;
}

// ---- What the pyramid does ----

struct Record {
  const Grid &grid;
  std::vector<uint32_t> solid; // of each voxel
  uint32_t number = 0;         // of the current solid
  size_t twice = 0;            // voxels written a second time

  explicit Record(const Grid &of) : grid(of), solid(of.all(), 0) {}

  static void cubes(void *context, const hsr_voxel_cubes *cubes) {
    Record &self = *static_cast<Record *>(context);
    const int *corner = cubes->corner, size = cubes->size;
    self.number = cubes->solid;
    for (int bit = 0; bit < 64; bit++)
      if (cubes->mask >> bit & 1)
        self.cube(corner[0] + bit % 4 * size, corner[1] + bit / 4 % 4 * size,
                  corner[2] + bit / 16 * size, size);
  }
  void cube(int x0, int y0, int z0, int size) {
    for (int z = z0; z < std::min(z0 + size, grid.n[2]); z++)
      for (int y = y0; y < std::min(y0 + size, grid.n[1]); y++)
        for (int x = x0; x < std::min(x0 + size, grid.n[0]); x++) {
          uint32_t &voxel = solid[grid.number(x, y, z)];
          twice += voxel != 0;
          voxel = number;
        }
  }
};

// Counts subcells, on paths of active ones, whose bits do not agree with the
// cells below.
struct Invariant {
  const hsr_solid_pyramid &voxels;
  const Record &record;
  size_t wrong = 0, checked = 0;

  void walk(int level, const std::array<int, 3> &corner, int size) {
    const hsr_solid_level &here = voxels.level[level];
    const int part = size / 4;
    const size_t k = (size_t(corner[2] / size) * size_t(here.n[1]) +
                      size_t(corner[1] / size)) *
                         size_t(here.n[0]) +
                     size_t(corner[0] / size);
    const uint64_t c = here.coarse ? here.coarse[k].c : here.finest[k];
    const uint64_t v = here.coarse ? here.coarse[k].v : ~c;
    wrong += (c & v) != 0;
    for (int bit = 0; bit < 64; bit++) {
      const std::array<int, 3> at = {corner[0] + bit % 4 * part,
                                     corner[1] + bit / 4 % 4 * part,
                                     corner[2] + bit / 16 * part};
      size_t covered = 0, all = 0;
      for (int z = at[2]; z < std::min(at[2] + part, record.grid.n[2]); z++)
        for (int y = at[1]; y < std::min(at[1] + part, record.grid.n[1]); y++)
          for (int x = at[0]; x < std::min(at[0] + part, record.grid.n[0]);
               x++) {
            covered += record.solid[record.grid.number(x, y, z)] != 0;
            all++;
          }
      checked++;
      wrong += (c >> bit & 1) != (covered == all);
      wrong += (v >> bit & 1) != (covered == 0 && all > 0);
      if (!((c | v) >> bit & 1))
        walk(level + 1, at, part);
    }
  }
};

// The cells of all levels that faces of a solid meet.
struct Crossed {
  const Grid &grid;
  size_t cells = 0;

  double at(int axis, int k) const { return grid.lo[axis] + k * grid.size; }

  void walk(const Triangles &triangles, const std::array<int, 3> &corner,
            int size) {
    for (int k = 0; k < 3; k++)
      if (corner[size_t(k)] >= grid.n[k])
        return;
    const Box box(Point(at(0, corner[0]), at(1, corner[1]), at(2, corner[2])),
                  Point(at(0, corner[0] + size), at(1, corner[1] + size),
                        at(2, corner[2] + size)));
    Triangles here;
    for (const auto &t : triangles)
      if (CGAL::do_intersect(box, Kernel::Triangle_3(t[0], t[1], t[2])))
        here.push_back(t);
    if (here.empty())
      return;
    cells++;
    for (int bit = 0; size > 4 && bit < 64; bit++)
      walk(here,
           {corner[0] + bit % 4 * (size / 4),
            corner[1] + bit / 4 % 4 * (size / 4),
            corner[2] + bit / 16 * (size / 4)},
           size / 4);
  }
};

int root_size(const Grid &grid) {
  int size = 4;
  for (int n : grid.n)
    while (size < n)
      size *= 4;
  return size;
}

size_t crossed_by(const Solid &solid, const Grid &grid) {
  Triangles triangles;
  for (const Face &face : solid.faces)
    for (size_t k = 2; k < face.corner.size(); k++)
      triangles.push_back({face.corner[0], face.corner[k - 1], face.corner[k]});
  Crossed crossed = {grid};
  crossed.walk(triangles, {0, 0, 0}, root_size(grid));
  return crossed.cells;
}

// ---- Sums over many ----

// The most cells that may be visited for each cell that a face meets. It may be
// below 1, since a visit asks about a cell's outermost centres, not its
// corners.
const double MOST_VISITED = 1;

// The most masks of planes in each: of planes that cross the cell above nearby.
const double MOST_PLANES = 10;

struct Sums {
  size_t voxels = 0, set = 0, differing = 0, grids = 0, shared = 0, twice = 0,
         wrong = 0, checked = 0, reordered = 0, exact = 0, misjudged = 0;
  size_t visited = 0, crossed = 0; // cells
};

// A pyramid and the memory that it needs.
struct Pyramid {
  hsr_arena arena = {};
  hsr_solid_pyramid p = {};
  hsr_tally tally = {};

  Pyramid(const Stage &stage, const hsr_voxel_grid &grid) {
    if (hsr_solid_pyramid_init(&p, &grid, &stage.volumes, &arena))
      std::exit(99);
  }
  Pyramid(const Pyramid &) = delete;
  ~Pyramid() { hsr_arena_free(&arena); }

  uint64_t cells() const {
    return tally.count[HSR_SOLID_CELL] + tally.count[HSR_SOLID_FINEST];
  }

  // Tiles the bodies in their order, or in the opposite one.
  void tile(const hsr_volumes &volumes, Record &record, bool backwards) {
    p.cover = Record::cubes;
    p.context = &record;
    const uint32_t n = volumes.n_bodies;
    for (uint32_t k = 0; k < n; k++) {
      const uint32_t b = backwards ? n - 1 - k : k;
      for (uint32_t v = volumes.solid_start[b]; v < volumes.solid_start[b + 1];
           v++)
        hsr_solid_pyramid_tile(&p, v, b + 1, &tally);
    }
  }
};

// An algorithm's answer for a stage.
struct Answer {
  hsr_answer answer = {};
  hsr_setup setup = {};
  hsr_arena scratch = {};
  hsr_tally tally = {};
  hsr_error err = {HSR_OK, ""};
  hsr_status status;

  Answer(const Stage &stage, int most, const char *name = "tiling-solids") {
    const hsr_algorithm *a = hsr_algorithm_find(name)->counting;
    hsr_choice choice = hsr_choice_standard(a);
    hsr_view view;
    choice.form.values.option[0] = most;
    if (hsr_view_init(&view, &stage.scene->views[0], 1, 1, &err))
      std::exit(99);
    status = hsr_setup_init(&setup, a, &choice, &stage.world, &err);
    if (!status)
      status = hsr_answer_make(&answer, &choice.form, &view, false, &err);
    hsr_job job = {};
    job.view = &view;
    job.answer = &answer;
    job.scratch = &scratch;
    job.tally = &tally;
    if (!status)
      status = hsr_setup_render(&setup, &job, &err);
  }
  Answer(const Answer &) = delete;
  ~Answer() {
    hsr_answer_free(&answer);
    hsr_setup_free(&setup);
    hsr_arena_free(&scratch);
  }
  const hsr_solid_voxels &voxels() const {
    return *hsr_answer_voxels_of(&answer);
  }
  uint64_t cells() const {
    return tally.count[HSR_SOLID_CELL] + tally.count[HSR_SOLID_FINEST];
  }
};

void judge(const Stage &stage, int most, Sums &sums) {
  const std::vector<Solid> solids = solids_of(stage.world);
  const Grid grid(solids, most);
  const Truth truth = truth_of(grid, solids);
  const Answer answer(stage, most), oracle(stage, most, "voxel-oracle");
  if (answer.status || oracle.status) {
    std::printf("# %s, %s\n", answer.err.text, oracle.err.text);
    sums.grids++;
    return;
  }
  const hsr_voxel_grid &g = answer.voxels().grid;
  bool same = g.size == grid.size && stage.volumes.n_bodies == solids.size();
  for (int k = 0; k < 3; k++)
    same &= g.lo[k] == grid.lo[k] && g.n[k] == grid.n[k];
  if (!same) {
    sums.grids++;
    return;
  }
  Record forwards(grid), backwards(grid);
  Pyramid first(stage, g), second(stage, g);
  first.tile(stage.volumes, forwards, false);
  Invariant invariant = {first.p, forwards};
  invariant.walk(0, {0, 0, 0}, root_size(grid));
  sums.wrong += invariant.wrong;
  sums.checked += invariant.checked;
  sums.visited += first.cells();
  sums.exact += first.tally.count[HSR_SOLID_EXACT];
  for (const Solid &solid : solids)
    sums.crossed += crossed_by(solid, grid);
  second.tile(stage.volumes, backwards, true);

  uint64_t set, surface;
  hsr_solid_voxels_count(&answer.voxels(), &set, &surface);
  for (size_t k = 0; k < grid.all(); k++) {
    sums.differing += answer.voxels().solid[k] != truth.solid[k] ||
                      forwards.solid[k] != truth.solid[k];
    sums.misjudged += oracle.voxels().solid[k] != truth.solid[k];
    sums.reordered += (backwards.solid[k] != 0) != (truth.solid[k] != 0);
    sums.set += truth.solid[k] != 0;
    set -= truth.solid[k] != 0;
  }
  sums.differing += set != 0;
  sums.voxels += grid.all();
  sums.shared += truth.shared;
  sums.twice += forwards.twice + backwards.twice;
}

void report(tap &t, const char *what, const Sums &s) {
  ok(&t,
     !s.grids && !s.differing && !s.misjudged && !s.reordered && !s.twice &&
         !s.wrong && s.set,
     "%s: %zu voxels, %zu set: %zu differ (%zu in the opposite order), %zu "
     "of the oracle's, %zu written twice, %zu bits of %zu wrong, %zu grids; "
     "%zu exact decisions",
     what, s.voxels, s.set, s.differing, s.reordered, s.misjudged, s.twice,
     s.wrong, s.checked, s.grids, s.exact);
}

// Only cells that faces cross, or nearly cross, are visited.
void report_visited(tap &t, const char *what, size_t visited, size_t crossed) {
  const double ratio = double(visited) / double(crossed);
  ok(&t, ratio <= MOST_VISITED && ratio > .2,
     "%s: %zu cells visited, %zu crossed by faces: %.3f", what, visited,
     crossed, ratio);
}

// ---- Tests ----

const int SIZES[] = {4, 5, 12, 16, 17, 31, 48, 64, 65};

void test_scene(tap &t, const char *name, bool overlap) {
  Stage stage(name);
  Sums sums;
  for (int size : SIZES)
    judge(stage, size, sums);
  report(t, name, sums);
  if (!overlap)
    ok(&t, !sums.shared, "%s: no voxel is in two solids", name);
}

// A leaning prism over a U: it is divided into convex parts.
void test_parts(tap &t) {
  static const int U[8][2] = {{0, 0}, {6, 0}, {6, 6}, {4, 6},
                              {4, 2}, {2, 2}, {2, 6}, {0, 6}};
  hsr_scene *scene = hsr_scene_new("prism");
  hsr_object *object = hsr_scene_object(scene, "prism");
  uint32_t bottom[8], top[8];
  for (uint32_t k = 0; k < 8; k++) {
    hsr_object_vertex(object, U[k][0], U[k][1], 0, &bottom[7 - k]);
    hsr_object_vertex(object, U[k][0] + 2, U[k][1] + 1, 6, &top[k]);
  }
  hsr_object_face(object, bottom, 8, nullptr);
  hsr_object_face(object, top, 8, nullptr);
  for (uint32_t k = 0; k < 8; k++) {
    const uint32_t l = (k + 1) % 8;
    const uint32_t side[4] = {bottom[7 - k], bottom[7 - l], top[l], top[k]};
    hsr_object_face(object, side, 4, nullptr);
  }
  Stage stage(scene);
  Sums sums;
  for (int size : SIZES)
    judge(stage, size, sums);
  report(t, "a prism over a U", sums);
  ok(&t, stage.volumes.n_parts > 1, "it has %u convex parts",
     stage.volumes.n_parts);
}

// Solids of integer corners, in sizes for which centres fall on corners, edges
// and faces. Every second one is made of tetrahedra that touch.
void test_random(tap &t) {
  Sums whole, parts, rough;
  for (int k = 0; k < 600;) {
    const int reach = 2 * integer(2, 12);
    const bool integers = k % 6 != 5, split = integers && k % 2;
    Triangles hull = random_hull(integer(4, 14), reach, integers);
    if (hull.empty())
      continue;
    k++;
    hsr_scene *scene = hsr_scene_new("random");
    if (split)
      for (const Triangles &part : fan(hull))
        add_solid(scene, part);
    else
      add_solid(scene, hull);
    Stage stage(scene);
    const int half = std::max(4, reach / 2);
    Sums &sums = !integers ? rough : split ? parts : whole;
    judge(stage, half, sums);
    judge(stage, integer(4, k % 7 ? 20 : 65), sums);
  }
  report(t, "convex polyhedra of integers", whole);
  report(t, "tetrahedra that fill them", parts);
  ok(&t, !parts.shared, "no voxel is in two of them");
  ok(&t, whole.exact > 2000 && parts.exact > 2000, "ties abound in both");
  report(t, "convex polyhedra of doubles", rough);
  report_visited(t, "integers", whole.visited, whole.crossed);
  report_visited(t, "tetrahedra", parts.visited, parts.crossed);
  report_visited(t, "doubles", rough.visited, rough.crossed);
}

// Together the tetrahedra of a hull have the hull's voxels.
void test_fill(tap &t) {
  size_t differing = 0, set = 0;
  for (int k = 0; k < 100; k++) {
    const Triangles hull = random_hull(integer(5, 12), 16, true);
    if (hull.empty())
      continue;
    hsr_scene *one = hsr_scene_new("hull"), *many = hsr_scene_new("parts");
    add_solid(one, hull);
    for (const Triangles &part : fan(hull))
      add_solid(many, part);
    Stage a(one), b(many);
    const Answer x(a, 8), y(b, 8);
    if (x.status || y.status)
      std::exit(99);
    const size_t n = hsr_voxel_count(&x.voxels().grid);
    for (size_t v = 0; v < n; v++) {
      const bool has = x.voxels().solid[v] != 0;
      differing += has != (y.voxels().solid[v] != 0);
      set += has;
    }
  }
  ok(&t, set && !differing,
     "tetrahedra leave out none of %zu voxels of what they fill: %zu differ",
     set, differing);
}

void test_visited(tap &t, const char *name, int most) {
  Stage stage(name);
  const std::vector<Solid> solids = solids_of(stage.world);
  const Grid grid(solids, most);
  const Answer answer(stage, most);
  if (answer.status)
    std::exit(99);
  size_t crossed = 0;
  for (const Solid &solid : solids)
    crossed += crossed_by(solid, grid);
  const std::string what = std::string(name) + " at " + std::to_string(most);
  report_visited(t, what.c_str(), answer.cells(), crossed);
  const double planes =
      double(answer.tally.count[HSR_SOLID_MASK]) / double(answer.cells());
  ok(&t, planes < MOST_PLANES, "there, %.3f masks of planes a cell", planes);
}

// How many bits a voxel the pyramid of a whole cube takes.
void test_memory(tap &t) {
  Stage stage("color-cube:2");
  for (int most : {16, 64, 256}) {
    hsr_error err;
    hsr_voxel_grid grid;
    if (hsr_voxel_grid_init(&grid, &stage.world, most, &err))
      std::exit(99);
    const Pyramid pyramid(stage, grid);
    const double n = most;
    const double bits = 8. * double(pyramid.p.bytes) / (n * n * n);
    ok(&t, bits >= 1 + 1 / 32. && bits < 1 + 2 / 63.,
       "the pyramid of %d^3 voxels has %.6f bits a voxel", most, bits);
  }
}

// The masks of planes of integers, so that nothing is rounded: exactly the
// cells that are inside or outside are marked as such.
void test_triage(tap &t) {
  size_t wrong = 0, active = 0, n = 0;
  for (int k = 0; k < 20000; k++) {
    const int size = 4 << 2 * integer(0, 2), cell = size / 4;
    const int corner[3] = {size * integer(0, 3), size * integer(0, 3),
                           size * integer(0, 3)};
    const int a[3] = {2 * integer(-9, 9), 2 * integer(-9, 9),
                      2 * integer(-9, 9)};
    int d = 2 * integer(-9, 9);
    for (int i = 0; i < 3; i++)
      d -= a[i] * (corner[i] + integer(0, size));
    const hsr_triage_plane plane = {double(a[0]), double(a[1]), double(a[2]),
                                    double(d), 0};
    const hsr_triage mask = hsr_solid_triage(&plane, corner, size);
    for (int bit = 0; bit < 64; bit++) {
      const int at[3] = {bit % 4, bit / 4 % 4, bit / 16};
      int least = 0, most = 0;
      for (int vertex = 0; vertex < 8; vertex++) {
        int f = d;
        for (int i = 0; i < 3; i++) // at the centre of a voxel at the vertex
          f += a[i] / 2 *
               (2 * (corner[i] + at[i] * cell +
                     (vertex >> i & 1 ? cell - 1 : 0)) +
                1);
        least = vertex ? std::min(least, f) : f;
        most = vertex ? std::max(most, f) : f;
      }
      wrong += (mask.c >> bit & 1) != (least > 0);
      wrong += (mask.v >> bit & 1) != (most < 0);
      active += least <= 0 && most >= 0;
      n++;
    }
  }
  ok(&t, !wrong && active, "triage: %zu wrong of %zu cells, %zu active", wrong,
     n, active);
}

// A cube of 3 x 3 x 3 voxels in the middle of 5 x 5 x 5: all but its own middle
// are at its surface. In the same cube of two solids that meet, all are.
void test_surface(tap &t) {
  const hsr_voxel_grid grid = {{0, 0, 0}, 1, {5, 5, 5}};
  hsr_solid_voxels voxels = {};
  uint64_t set[2], surface[2];
  if (hsr_solid_voxels_open(&voxels, &grid))
    std::exit(99);
  for (int z = 1; z < 4; z++)
    for (int y = 1; y < 4; y++)
      for (int x = 1; x < 4; x++)
        voxels.solid[hsr_voxel_number(&grid, x, y, z)] = 1;
  hsr_solid_voxels_count(&voxels, &set[0], &surface[0]);
  voxels.solid[hsr_voxel_number(&grid, 2, 2, 3)] = 2;
  hsr_solid_voxels_count(&voxels, &set[1], &surface[1]);
  hsr_solid_voxels_free(&voxels);
  ok(&t, set[0] == 27 && surface[0] == 26 && set[1] == 27 && surface[1] == 27,
     "of a cube of 27 voxels 26 are at the surface; of two solids, 27");
}

void test_refused(tap &t) {
  for (const char *name : {"deep-stack", "penetration"}) {
    Stage stage(name);
    const Answer answer(stage, 8);
    ok(&t,
       answer.status == HSR_E_REFUSED &&
           !std::strncmp(answer.err.text, "CC: face 0 ", 11),
       "%s is refused: %s", name, answer.err.text);
  }
}

} // namespace

int main() {
  tap t = plan(34);
  test_triage(t);
  test_scene(t, "color-cube", false);
  test_scene(t, "house", true);
  test_scene(t, "harbor", true);
  test_scene(t, "nested-solids", true);
  test_scene(t, "twist:8", true);
  test_parts(t);
  test_random(t);
  test_fill(t);
  test_visited(t, "color-cube", 64);
  test_visited(t, "color-cube", 65);
  test_visited(t, "sphere:200", 64);
  test_visited(t, "sphere:200", 256);
  test_visited(t, "house", 256);
  test_memory(t);
  test_surface(t);
  test_refused(t);
  return finish(&t);
}
