// SPDX-License-Identifier: GPL-3.0-or-later
// The points where named lines cross (common/exact/named_lines.h), against
// fractions that are computed here from the corners and the view. Each point has
// the nearest doubles as its coordinates; two have one number if and only if
// they are equal; and two depths that doubles compare are compared as at the
// line where the planes meet.
#include "common/exact/named_lines.h"
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <CGAL/Gmpq.h>

#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace {

using Fraction = CGAL::Gmpq;
using Vector = std::array<Fraction, 3>;
using Place = std::pair<Fraction, Fraction>;

constexpr int M = 97, N = 61, PAIRS = 3000;

const char *const scenes[] = {"house",        "soup:60",       "lattice:60",
                              "shared-edges", "huge-and-tiny", "sliver",
                              "coplanar",     "grid:3",        "near-plane",
                              "eye-in-plane", "deep-stack",    "sphere:200"};

Vector vector(const double v[3]) {
  return {Fraction(v[0]), Fraction(v[1]), Fraction(v[2])};
}

Vector minus(const Vector &a, const Vector &b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Fraction dot(const Vector &a, const Vector &b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector cross(const Vector &a, const Vector &b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
          a[0] * b[1] - a[1] * b[0]};
}

// The line of an edge in perspective: g . (F + x R + y U) as a function of sx
// and sy, g being normal to the plane of the edge and the eye.
Vector line_of_edge(const hsr_world &world, const hsr_view &view, uint32_t f,
                    uint32_t k) {
  const uint32_t *vertex = world.mesh.vertex + world.mesh.start[f];
  const Vector E = vector(view.E), F = vector(view.F), R = vector(view.R),
               U = vector(view.U);
  Vector end[2];
  for (uint32_t i = 0; i < 2; i++) {
    const uint32_t v = vertex[(k + i) % hsr_face_size(&world, f)];
    const double at[3] = {world.mesh.x[v], world.mesh.y[v], world.mesh.z[v]};
    end[i] = minus(vector(at), E);
  }
  const Vector g = cross(end[0], end[1]);
  return {dot(g, R) * 2 / M, -dot(g, U) * 2 / N,
          dot(g, F) - dot(g, R) + dot(g, U)};
}

struct Drawn {
  uint32_t number;
  Vector line;
};

struct Found {
  long points = 0, far = 0, apart = 0, one = 0, met = 0;
  long told = 0, contrary = 0;
};

// Whether no other double is nearer to x.
bool is_nearest(const Fraction &x, double at) {
  const Fraction half(.5), here(at), below(std::nextafter(at, -INFINITY)),
      above(std::nextafter(at, INFINITY));
  return half * (below + here) <= x && x <= half * (here + above);
}

Drawn draw_edge(hsr_named_lines *lines, const hsr_world &world,
                const hsr_view &view, uint64_t *seed) {
  const uint32_t f = uint32_t(draw_integer(seed, 0, world.n_faces - 1)),
                 k = uint32_t(
                     draw_integer(seed, 0, hsr_face_size(&world, f) - 1));
  int sign;
  return {hsr_line_number(lines, {HSR_LINE_EDGE, f, k}, &sign),
          line_of_edge(world, view, f, k)};
}

Drawn draw_border(hsr_named_lines *lines, uint64_t *seed) {
  const uint32_t side = uint32_t(draw_integer(seed, 0, HSR_N_BORDERS - 1));
  const Fraction none(0), one(1);
  int sign;
  return {hsr_line_number(lines, {HSR_LINE_BORDER, side, 0}, &sign),
          side == HSR_LEFT    ? Vector{one, none, none}
          : side == HSR_TOP   ? Vector{none, one, none}
          : side == HSR_RIGHT ? Vector{-one, none, Fraction(M)}
                              : Vector{none, -one, Fraction(N)}};
}

// Crosses two lines, and puts the point against what was found before.
void cross_two(hsr_named_lines *lines, const Drawn &a, const Drawn &b,
               std::map<Place, uint32_t> &known,
               std::map<uint32_t, Place> &places, Found *found) {
  const Vector p = cross(a.line, b.line);
  if (a.number == HSR_NO_LINE || b.number == HSR_NO_LINE ||
      a.number == b.number)
    return;
  const uint32_t point = hsr_crossing(lines, a.number, b.number);
  if (p[2] == 0 || point == HSR_NO_POINT) {
    found->far += (p[2] == 0) != (point == HSR_NO_POINT);
    return;
  }
  const Place place(p[0] / p[2], p[1] / p[2]);
  double at[2];
  hsr_crossing_at(lines, point, at);
  found->points++;
  found->far +=
      !is_nearest(place.first, at[0]) || !is_nearest(place.second, at[1]);
  const auto before = known.emplace(place, point);
  found->met += !before.second;
  found->apart += before.first->second != point;
  found->one += places.emplace(point, place).first->second != place;
}

// The depths of two faces at a point, in doubles and by the line.
void compare_depths(hsr_named_lines *lines, const hsr_world &world,
                    uint32_t point, uint64_t *seed, Found *found) {
  const uint32_t n = world.n_faces, f = uint32_t(draw_integer(seed, 0, n - 1)),
                 g = uint32_t(draw_integer(seed, 0, n - 1));
  const int nearer = f < g ? hsr_nearer_at(lines, f, g, point) : 0;
  int sign;
  if (!nearer)
    return;
  const uint32_t line = hsr_line_number(lines, {HSR_LINE_MEETING, f, g}, &sign);
  found->told++;
  found->contrary += line == HSR_NO_LINE ||
                     sign * hsr_crossing_side(lines, point, line) != nearer;
}

void test_world(tap *tap, const char *name, const hsr_world &world,
                const hsr_camera &camera) {
  uint64_t seed = 11;
  Found found;
  hsr_view view;
  must_view(&view, &camera, M, N);
  hsr_named_lines *lines = hsr_named_lines_new(&world, &view);
  std::map<Place, uint32_t> known;
  std::map<uint32_t, Place> places;
  for (int k = 0; k < PAIRS; k++) {
    const Drawn a = draw_edge(lines, world, view, &seed),
                b = k % 8 ? draw_edge(lines, world, view, &seed)
                          : draw_border(lines, &seed);
    cross_two(lines, a, b, known, places, &found);
  }
  for (const auto &[point, place] : places)
    for (int k = 0; k < 3; k++)
      compare_depths(lines, world, point, &seed, &found);
  ok(tap, found.points > 100 && !found.far && !found.apart && !found.one,
     "%s: %ld crossings, %ld of them met again: %ld are not at the nearest "
     "doubles, %ld have two numbers, %ld share one",
     name, found.points, found.met, found.far, found.apart, found.one);
  ok(tap, found.told > 30 && !found.contrary,
     "%s: of %ld depths that doubles tell, %ld are contrary to the line", name,
     found.told, found.contrary);
  hsr_named_lines_free(lines);
}

void test_scene(tap *tap, const char *name) {
  both_worlds worlds;
  open_worlds(&worlds, name);
  test_world(tap, name, worlds.world, worlds.scene->views[0]);
  close_worlds(&worlds);
}

// Triangles whose corners are from 1 to 2^-200 before the eye, so that images are
// up to 2^200 pixels away.
void test_far_images(tap *tap) {
  constexpr int FACES = 60;
  uint64_t seed = 7;
  hsr_scene *scene = hsr_scene_new("far images");
  hsr_object *object = hsr_scene_object(scene, "triangles");
  const hsr_camera camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0},   60,
                             0,         0,          {0, 0, 0, 0}};
  for (uint32_t k = 0; k < 3 * FACES; k++) {
    const double x = double(draw_integer(&seed, -999, 999)),
                 y = double(draw_integer(&seed, -999, 999));
    const int by = k % 3 ? int(draw_integer(&seed, 0, 200)) : 0;
    if (hsr_object_vertex(object, x, y, -std::ldexp(1000, -by), nullptr))
      bail("no vertex");
  }
  for (uint32_t f = 0; f < FACES; f++) {
    const uint32_t corner[] = {3 * f, 3 * f + 1, 3 * f + 2};
    if (hsr_object_face(object, corner, 3, nullptr))
      bail("no face");
  }
  if (hsr_scene_view(scene, &camera))
    bail("no view");
  must_finish(scene);
  hsr_world world;
  must_world(&world, scene);
  test_world(tap, "far images", world, camera);
  hsr_world_free(&world);
  hsr_scene_delete(scene);
}

} // namespace

int main() {
  tap tap = plan(2 * int(std::size(scenes)) + 2);
  for (const char *name : scenes)
    test_scene(&tap, name);
  test_far_images(&tap);
  return finish(&tap);
}
