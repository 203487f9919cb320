// SPDX-License-Identifier: GPL-3.0-or-later
// Texts of .obj and .stl that threads read in blocks: the same object as of
// other lines that say the same, whatever the number of threads; and what is wrong
// is refused in the same words, at the same line.
#include "tests/tap.h"
#include "tests/unit/files/folder.h"
#include "tests/unit/files/read_mesh.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace {

/* Whether all numbers of threads read what one reads from `other`. */
bool by_all(const std::string &path, const Read &other) {
  for (const int threads : {1, 2, 3, 7, 16})
    if (!(Read(path, threads) == other)) {
      std::printf("# %d threads: %s\n", threads,
                  Read(path, threads).error.c_str());
      return false;
    }
  return !other.vertex.empty();
}

/* Whether all refuse a file and say so. */
bool all_say(const std::string &path, const std::string &says) {
  bool all = true;
  for (const int threads : {1, 2, 3, 7, 16})
    all &= Read(path, threads).says(says.c_str());
  return all;
}

/* ---- .obj ---- */

constexpr int N = 6000; /* vertices; the text is some ten blocks */
constexpr char PLAIN[] = "g a b\n",
               OTHER[] = "g a \\\nf 1 2 3\n"; /* at the end */

std::string place(int v) {
  char text[100];
  std::snprintf(text, sizeof text, "%.17g %d %.9g", v / 7., v % 11, v % 5 / 3.);
  return text;
}

std::string corner(int v, int kind = 0) {
  constexpr const char *MORE[] = {"", "/1", "//3", "/2/-3", "/", "//"};
  return " " + std::to_string(v) + MORE[kind % 6];
}

/* A triangle that counts back, and a face with a vertex that may follow. */
std::string obj_faces(int v) {
  if (v < 4 || v == N / 2 + 1)
    return "";
  if (v == 5)
    return "f -1 -2 -3\nf 1 2 3\n";
  return "f" + corner(-1, v) + corner(-3) + corner(v - 1, v + 1) + "\n  f" +
         corner(v) + corner(N + 1 - v, 2) + corner(v - 1, 3) +
         (v % 7 == 3 ? corner(v - 2) : "") + " \n";
}

/* All that a plain line may hold. */
std::string obj(const std::string &last, const char *more = "") {
  std::string text = "# C:\\a\\\nmtllib two.mtl\n\nvn 0 0 1\nl 1 2\n";
  for (int v = 1; v <= N; v++) {
    text += "v " + place(v) + more + (v % 3 ? "\n" : "\t\r\n");
    if (v % 2 == 0)
      text += "vt 0 " + std::to_string(v) + " # a\n";
    text += v == N / 2     ? "usemtl \tred\tone \nmtllib none.mtl\n"
            : v == N - 100 ? "usemtl no such\n"
                           : "";
    text += obj_faces(v);
  }
  return text + "p 1\np 2\n" + last;
}

void try_obj(tap *t) {
  file("two.mtl", "newmtl red one\nKd 1 0 0\n");
  const Read other(file("other.obj", obj(OTHER)));
  ok(t,
     by_all(file("plain.obj", obj(PLAIN)), other) &&
         other.xyz.size() == 3 * N && other.start.size() == 2 * (N - 4) + 1,
     "an .obj as of other lines");
  ok(t,
     other.rgb.size() == 3 * 2 * (N - 4) && other.rgb[3 * (N - 9)] != 1 &&
         other.rgb[3 * (N - 8)] == 1 && other.rgb[3 * (2 * N - 211)] == 1 &&
         other.rgb[3 * (2 * N - 210)] != 1,
     "with materials");
  ok(t,
     other.notes.find("2 statements 'p'") != std::string::npos &&
         other.notes.find("'none.mtl'") != std::string::npos,
     "and notes");
  for (const char *more : {" 1 .25 .5", " 2 20 0 255", " 1"})
    ok(t,
       by_all(file("more.obj", obj(PLAIN, more)),
              Read(file("other.obj", obj(OTHER, more)))),
       "vertices with '%s' behind them", more);
  ok(t,
     by_all(
         file("mixed.obj", obj(std::string("v 1 1 1 0 1 0\n") + PLAIN)),
         Read(file("other.obj", obj(std::string("v 1 1 1 0 1 0\n") + OTHER)))),
     "one vertex with a colour");
}

/* Vertices in several blocks, and then a face that counts back. */
void try_counting_back(tap *t) {
  std::string text;
  for (int v = 1; v <= N; v++)
    text += "v " + place(v) + "\n";
  text += "f -1 -2 -3\n";
  ok(t, by_all(file("back.obj", text), Read(file("other.obj", text + OTHER))),
     "a face of the last vertices");
}

/* No block may begin with a line in which the one before it goes on. */
void try_lines_that_go_on(tap *t) {
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  for (int k = 0; k < 30000; k++)
    text += "g a \\\nf 1 2 3\n";
  const Read one(file("goes_on.obj", text));
  ok(t, by_all(directory + "/goes_on.obj", one) && one.start.size() == 2,
     "lines that go on in the next");
}

/* A face of many vertices, of which the last is the first once more. */
void try_large_face(tap *t) {
  std::string text = "f 1 2 3\nf";
  for (int v = 1; v <= 20; v++) {
    text = "v " + place(v) + "\n" + text;
    text += " " + std::to_string(v == 20 ? 1 : v);
  }
  ok(t, all_say(file("large.obj", text + "\n"), "face 1 has the same vertex"),
     "a face of 20 vertices that ends where it began");
}

/* The text with `line` put at the start of the line that holds byte `at`. */
std::string with(std::string text, size_t at, const char *line) {
  return text.insert(text.rfind('\n', at) + 1, line);
}
std::string line_of(const std::string &text, size_t at) {
  const size_t start = text.rfind('\n', at) + 1;
  size_t n = 1;
  for (size_t c = 0; c < start; c++)
    n += text[c] == '\n';
  return ":" + std::to_string(n) + ": ";
}

void try_bad_obj(tap *t) {
  const std::string text = obj(PLAIN);
  const size_t late = text.size() - 9000, early = text.size() / 2;
  for (const auto &[line, says] :
       {std::pair{"f 1 2 2\n", "has the same vertex twice"},
        {"f 1 2\n", "has fewer than 3 vertices"},
        {"f 1 2 0\n", "names vertex 0 of"},
        {"f 1 2 -5999\n", "names vertex -5999 of"},
        {"f 1 2 3/4/5/6\n", "is not a corner"},
        {"f 1 2 3x\n", "is not a corner"},
        {"v 1 2\n", "has 2 numbers"},
        {"v 1 2 3 4 5\n", "has 5 numbers"},
        {"v 1 2 x\n", "is not a finite number"},
        {"vq 1 2\n", "is not a statement"}}) {
    const std::string both = with(with(text, late, "f 1\n"), early, line);
    ok(t,
       all_say(file("bad.obj", both), line_of(text, early)) &&
           all_say(directory + "/bad.obj", says) &&
           all_say(file("one.obj", with(text, early, line)), says),
       "the first bad line of an .obj: %.*s", int(std::strlen(line) - 1), line);
  }
  ok(t,
     all_say(file("beyond.obj", with(text, early, "f 1 2 6001\n")),
             "names vertex 6001 of 6000"),
     "a vertex that never comes");
  const char poor[] = "f 1 2 2\nf 1\nf\n";
  file("poor.obj", with(text, early, poor));
  const Read other(file("other.obj", with(obj(OTHER), early, poor)), 1, true);
  ok(t,
     other.n_dropped >= 3 && Read(directory + "/poor.obj", 1, true) == other &&
         Read(directory + "/poor.obj", 7, true) == other,
     "or faces are dropped");
  ok(t, all_say(file("none.obj", "v 1 2 3\n"), "holds no face"),
     "a file without a face");
}

/* ---- .stl ---- */

std::string facet(int a, int b, int c) {
  std::string text = "  facet normal nan 0 1\n    outer loop\n";
  for (const int v : {a, b, c})
    text += "      vertex " + place(v) + "\n";
  return text + "    endloop\n  endfacet\n";
}

/* Two solids. If not plain, there is one more, and a facet of other lines. */
std::string stl(bool plain) {
  const std::string first = facet(1, 2, 3);
  std::string text = "\n SOLID facet\n";
  text += plain ? first
                : "endsolid\nsolid\nFACET normal\n0 0 1" +
                      first.substr(first.find("\n    outer"));
  for (int k = 2; k < 3000; k++) {
    text += facet(k, 3000 + k * 17 % 1500, 1 + (k + 1500) % 3000);
    if (k == 2000)
      text += "endsolid\nsolid\n";
  }
  return text + "EndSolid facet\n";
}

void try_stl(tap *t) {
  std::string one_line = stl(true);
  std::replace(one_line.begin() + 15, one_line.begin() + 60, '\n', ' ');
  const Read other(file("other.stl", stl(false)));
  ok(t,
     by_all(file("plain.stl", stl(true)), other) && other.start.size() == 3000,
     "a text of .stl as of other lines");
  ok(t, by_all(file("lines.stl", one_line), other), "of any lines");
  std::string flush = stl(true);
  for (size_t at; (at = flush.find("  facet")) != std::string::npos;)
    flush.erase(at, 2);
  ok(t, by_all(file("flush.stl", flush), other),
     "with facets at the start of their lines");
}

void try_bad_stl(tap *t) {
  const std::string text = stl(true);
  const size_t at = text.find("  facet", text.size() / 3);
  const size_t late = text.find("  facet", text.size() - 9000);
  const std::string number = text.substr(0, at) +
                             "facet normal 0 0 1 outer loop"
                             " vertex 1 2 3x vertex 2 3 4 vertex 3 4 5 endloop "
                             "endfacet\n" +
                             text.substr(at);
  ok(t, all_say(file("number.stl", number), "'3x' is not a finite number"),
     "one number that is none");
  std::string normal = number;
  normal.replace(normal.find("0 0 1 outer"), 5, "0 x 1");
  normal.replace(normal.find("3x"), 2, "3 ");
  ok(t, all_say(file("normal.stl", normal), "'x' is not a number"),
     "a normal that is none");
  for (const auto &[line, says] :
       {std::pair{"facet normal 0 0 1 outer loop vertex 1 2 inf\n",
                  "is not a finite number"},
        {"facet normal 0 0 1 outer loop vertex 1 2 x\n",
         "is not a finite number"},
        {"facet normal 0 0 x\n", "is not a number"},
        {"facet normal 0 0 1 outer loop endloop\n", "where 'vertex' should"},
        {"solid\n", "where 'facet' or 'endsolid' should be"},
        {"endsolid\n", "where 'solid' should be"}}) {
    const std::string both = with(with(text, late, "x\n"), at, line);
    const bool outside = !std::strcmp(line, "endsolid\n");
    file("bad.stl", both);
    ok(t,
       all_say(directory + "/bad.stl", says) &&
           all_say(directory + "/bad.stl",
                   line_of(text, outside ? text.find('\n', at) + 1 : at)),
       "the first bad line of an .stl: %.*s", int(std::strlen(line) - 1), line);
  }
  ok(t,
     all_say(file("short.stl", text.substr(0, text.size() - 15)),
             "the file ends before 'endsolid', after 2999 facets"),
     "an .stl without its end");
  const std::string poor = facet(4, 5, 4);
  const std::string twice = with(text, at, poor.c_str());
  ok(t, all_say(file("twice.stl", twice), "has the same vertex twice"),
     "a facet with a corner twice");
  std::string slow = stl(false);
  slow.insert(slow.find("  facet", slow.size() / 3), poor);
  const Read other(file("other.stl", slow), 1, true);
  ok(t,
     other.n_dropped == 1 && other == Read(directory + "/twice.stl", 1, true) &&
         other == Read(directory + "/twice.stl", 7, true),
     "or is dropped");
}

} // namespace

int main() {
  if (!make_directory())
    return 99;
  struct tap t = plan(7 + 1 + 2 + 13 + 3 + 11);
  try_obj(&t);
  try_counting_back(&t);
  try_lines_that_go_on(&t);
  try_large_face(&t);
  try_bad_obj(&t);
  try_stl(&t);
  try_bad_stl(&t);
  return finish(&t) | !remove_directory();
}
