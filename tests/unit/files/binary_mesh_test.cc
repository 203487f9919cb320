// SPDX-License-Identifier: GPL-3.0-or-later
// Binary mesh files with very many triangles, which have readers of their own: the
// same object as by another way, whatever the number of threads; and what is
// wrong is refused in the same words.
#include "tests/tap.h"
#include "tests/unit/files/folder.h"
#include "tests/unit/files/read_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>
#include <vector>

namespace {

template <class Value> void put(std::string &text, Value value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  text.append(bytes, sizeof bytes);
}

using Triangle = std::array<uint32_t, 3>;
using Place = std::array<float, 3>;

/* A strip: many triangles that share corners, which are far apart in the file. */
struct Strip {
  std::vector<Place> place;
  std::vector<Triangle> triangle;

  explicit Strip(uint32_t n) {
    for (uint32_t v = 0; v < n + 2; v++)
      place.push_back({float(v) / 3, float(v % 2), float(v % 7) / 7});
    for (uint32_t k = 0, f = 0; k < n; k++, f = (f + 7919) % n)
      triangle.push_back({f, f + 1 + f % 2, f + 2 - f % 2});
  }
};

/* Records of vertices with a normal, and of triangles. */
template <class Real>
std::string ply(const Strip &strip, const char *type, const char *more = "") {
  const std::string real = std::string("property ") + type + " ";
  std::string text = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                     std::to_string(strip.place.size()) + "\n";
  for (const char *name : {"nx", "x", "z", "y"})
    text += real + name + "\n";
  text += "element face " + std::to_string(strip.triangle.size()) +
          "\nproperty list uchar int vertex_indices\n" + more + "end_header\n";
  for (const Place &p : strip.place)
    for (const Real x : {Real(1), Real(p[0]), Real(p[2]), Real(p[1])})
      put(text, x);
  for (const Triangle &t : strip.triangle) {
    put(text, char{3});
    for (const uint32_t v : t)
      put(text, v);
  }
  return text;
}

/* A file with an empty third element is not plain. */
constexpr char OTHER[] = "element edge 0\nproperty int v\n";

std::string stl(const Strip &strip) {
  std::string text(80, '\0');
  put(text, uint32_t(strip.triangle.size()));
  for (const Triangle &t : strip.triangle) {
    text.append(12, '\0');
    for (const uint32_t v : t)
      for (const float x : strip.place[v])
        put(text, x);
    text.append(2, '\0');
  }
  return text;
}

bool is_strip(const Read &read, const Strip &strip) {
  bool same = read.xyz.size() == 3 * strip.place.size() &&
              read.vertex.size() == 3 * strip.triangle.size();
  for (size_t v = 0; v < strip.place.size() && same; v++)
    for (size_t k = 0; k < 3; k++)
      same &= read.xyz[3 * v + k] == double{strip.place[v][k]};
  for (size_t c = 0; c < read.vertex.size() && same; c++)
    same &= read.vertex[c] == strip.triangle[c / 3][c % 3];
  for (size_t f = 0; f < read.start.size() && same; f++)
    same &= read.start[f] == 3 * f;
  return same;
}

void try_ply(tap *t) {
  const Strip strip(50000);
  const Read plain(file("float.ply", ply<float>(strip, "float")));
  ok(t, is_strip(plain, strip), "a plain .ply of floats");
  ok(t, plain == Read(file("other.ply", ply<float>(strip, "float", OTHER))),
     "the same object as by the other way");
  ok(t, plain == Read(file("double.ply", ply<double>(strip, "double"))),
     "and as from doubles");
  bool same = true;
  for (const int threads : {2, 3, 7, 16})
    same &= plain == Read(directory + "/float.ply", threads);
  ok(t, same, "and by 2, 3, 7 and 16 threads");
}

/* What a plain file must not have, each refused as by the other way. */
void try_bad_ply(tap *t) {
  const auto both = [](const Strip &strip, const char *says) {
    const std::string path = file("bad.ply", ply<float>(strip, "float"));
    const Read plain(path);
    const Read other(file("bad.ply", ply<float>(strip, "float", OTHER)));
    return plain.says(says) && other.says(says) &&
           Read(path, 3).error == plain.error;
  };
  Strip beyond(40000), twice(40000), nan(40000);
  beyond.triangle[39999][1] = 40002;
  twice.triangle[39000][2] = twice.triangle[39000][0];
  nan.place[40001][2] = NAN;
  ok(t, both(beyond, "face 39999 names vertex 40002 of 40002"),
     "a vertex that is not there");
  ok(t, both(twice, "face 39000 has the same vertex twice"),
     "a vertex that is there twice");
  ok(t, both(nan, "vertex 40001 is not finite or above 1e30, and face"),
     "a coordinate that is not finite");
  const Strip good(40);
  std::string normal = ply<float>(good, "float"), longer = normal + "x";
  const float infinite = INFINITY;
  std::memcpy(&normal[normal.find("end_header\n") + 11 + 16 * 5], &infinite, 4);
  const Read whole(file("good.ply", ply<float>(good, "float")));
  ok(t, whole.error.empty() && Read(file("normal.ply", normal)) == whole,
     "a normal that is not finite is of no account");
  ok(t, Read(file("long.ply", longer)).says("1 bytes follow the last element"),
     "a byte too many");
  longer.resize(longer.size() - 2);
  ok(t, Read(file("short.ply", longer)).says("the file ends in face 39 of 40"),
     "a byte too few");
}

/* As long as a file of triangles, but with polygons. */
void try_polygons(tap *t) {
  const Strip strip(4);
  std::string text = ply<float>(strip, "float");
  text.resize(text.size() - 4 * 13);
  for (const std::vector<uint32_t> &face :
       {std::vector<uint32_t>{0, 1, 2}, {2, 1, 3, 5}, {1, 2, 3}, {3, 4, 5}}) {
    put(text, char(face.size()));
    for (const uint32_t v : face)
      put(text, v);
  }
  const Read read(file("quad.ply", text));
  ok(t,
     read.start == std::vector<uint32_t>{0, 3, 7, 10, 13} &&
         read.vertex[6] == 5 && read.xyz.size() == 18,
     "a quadrilateral among triangles");

  /* Two faces as long as two triangles, and with the numbers of some. */
  const Strip two(2);
  text = ply<float>(two, "float");
  text.resize(text.size() - 2 * 13);
  put(text, char{4});
  for (const uint32_t v : {0u, 1u, 3u, 2u})
    put(text, v);
  put(text, char{0});
  for (const uint32_t v : {1u, 2u})
    put(text, v);
  ok(t, Read(file("none.ply", text)).says("face 1"),
     "a face of no corners after a quadrilateral");

  text = ply<float>(two, "float");
  text.resize(text.size() - 2 * 13);
  put(text, char{0});
  put(text, char{3});
  for (const uint32_t v : {0u, 1u, 3u})
    put(text, v);
  const Read dropped(file("first.ply", text), 1, true);
  ok(t,
     dropped.n_dropped == 1 && dropped.vertex == std::vector<uint32_t>{0, 1, 3},
     "a face of no corners is the first, and is dropped");
}

/* Corners are numbered as they are met, whatever the number of threads. */
bool numbers_corners(const Strip &strip) {
  std::map<Place, uint32_t> number;
  const Read read(file("strip.stl", stl(strip)));
  bool same = read.vertex.size() == 3 * strip.triangle.size() &&
              read.xyz.size() == 3 * (strip.place.size() - 1);
  for (size_t c = 0; c < read.vertex.size() && same; c++) {
    const Place &place = strip.place[strip.triangle[c / 3][c % 3]];
    const uint32_t next = uint32_t(number.size());
    const uint32_t v = number.emplace(place, next).first->second;
    same = read.vertex[c] == v;
    for (size_t k = 0; k < 3; k++)
      same &= read.xyz[3 * size_t{v} + k] == double{place[k]};
  }
  for (const int threads : {2, 3, 7, 16})
    same &= read == Read(directory + "/strip.stl", threads);
  return same;
}

void try_corners(tap *t) {
  Strip strip(150000);
  strip.place[0] = {0, -0.0f, 0};
  strip.place[70000] = {0, 0, 0}; /* is at the same place */
  ok(t, numbers_corners(strip), "corners of an .stl that are far from others");
  std::sort(strip.triangle.begin(), strip.triangle.end());
  ok(t, numbers_corners(strip), "and that are near them");
}

void try_stl(tap *t) {
  /* Two places of the same part and tag (mesh_corners.cc). */
  Strip alike(4);
  alike.place[1] = {15278, 0, 0};
  alike.place[3] = {179341, 0, 0};
  ok(t, Read(file("alike.stl", stl(alike))).xyz.size() == 3 * 6,
     "places whose hashes are alike are two vertices");

  Strip twice(3000);
  twice.triangle[2000][2] = twice.triangle[2000][0];
  const std::string path = file("twice.stl", stl(twice));
  ok(t, Read(path).says("face 2000 has the same vertex twice"),
     "a facet with a corner twice is refused");
  Strip ends(30);
  ends.triangle[20][2] = ends.triangle[20][1];
  ok(t, Read(file("ends.stl", stl(ends))).says("face 20 has the same vertex"),
     "whichever corners they are");
  const Read left(path, 1, true);
  ok(t, left.n_dropped == 1 && left.vertex.size() == 3 * 2999, "or is dropped");
  twice.place.push_back({0, NAN, 0});
  twice.triangle[2001][1] = uint32_t(twice.place.size() - 1);
  ok(t, Read(file("both.stl", stl(twice))).says("face 2000 has the same"),
     "of two faults the first is told");
  twice.triangle[2000] = {0, 1, 2};
  ok(t, Read(file("nan.stl", stl(twice))).says("facet 2001 has a coordinate"),
     "a facet that is not finite is refused");
}

} // namespace

int main() {
  if (!make_directory())
    return 99;
  struct tap t = plan(4 + 6 + 3 + 8);
  try_ply(&t);
  try_bad_ply(&t);
  try_polygons(&t);
  try_corners(&t);
  try_stl(&t);
  return finish(&t) | !remove_directory();
}
