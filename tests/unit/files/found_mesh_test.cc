// SPDX-License-Identifier: GPL-3.0-or-later
// Mesh files as other programs write them: colours and opacities in all their
// forms, strips, binary .off, trailing bytes, paths of another system. What is
// read is right to the face.
#include "tests/tap.h"
#include "tests/unit/files/folder.h"
#include "tests/unit/files/read_mesh.h"

#include <cmath>
#include <cstring>
#include <sys/stat.h>
#include <zlib.h>

namespace {

/* Linear light of a colour as files encode it. */
float linear(double encoded) {
  return float(encoded <= .04045 ? encoded / 12.92
                                 : std::pow((encoded + .055) / 1.055, 2.4));
}

struct Look {
  double r, g, b, opacity;
};
const Look GREY = {.797738, .797738, .797738, 1}; /* linear .6 */

bool is(const std::array<float, 4> &look, const Look &wanted) {
  const float w[4] = {linear(wanted.r), linear(wanted.g), linear(wanted.b),
                      float(wanted.opacity)};
  bool same = true;
  for (size_t k = 0; k < 4; k++)
    same = same && std::fabs(look[k] - w[k]) < 1e-5f;
  return same;
}

/* Whether the faces of a file are of these colours. */
bool has(const Read &read, const std::vector<Look> &wanted,
         const char *notes = "") {
  bool same = read.look.size() == wanted.size();
  for (size_t f = 0; f < wanted.size() && same; f++)
    same = is(read.look[f], wanted[f]);
  same = same && (*notes ? read.notes.find(notes) != std::string::npos
                         : read.notes.empty());
  for (const auto &c : read.look)
    if (!same)
      std::printf("# %g %g %g %g\n", double{c[0]}, double{c[1]}, double{c[2]},
                  double{c[3]});
  if (!same)
    std::printf("# %s%s\n", read.error.c_str(), read.notes.c_str());
  return same;
}

Read read(const std::string &name, const std::string &text) {
  return Read(file(name, text), 1, true);
}

/* ---- .obj ---- */

const std::string POINTS = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

void try_materials(tap *t) {
  file("glass.mtl", "newmtl clear\nKd 1 0 0\nd 0.25\nnewmtl back\nKd 0 1 0\n"
                    "Tr 0.25\nnewmtl both\nTr 1\nd 0.5\nTr 0.9\n"
                    "newmtl halo\nKd 0 0 1\nd -halo 0.75\n");
  ok(t,
     has(read("glass.obj", "mtllib glass.mtl\n" + POINTS +
                               "usemtl clear\nf 1 2 3\nusemtl back\nf 1 2 3\n"
                               "usemtl both\nf 1 2 3\nusemtl halo\nf 1 2 3\n"),
         {{1, 0, 0, .25},
          {0, 1, 0, .75},
          {GREY.r, GREY.g, GREY.b, .5},
          {0, 0, 1, .75}}),
     "d, Tr, which d overrules, and a halo");
  file("drawn.mtl", "newmtl a\nKd 0 0 1\nmap_Kd wood.png\n");
  ok(t,
     has(read("drawn.obj",
              "mtllib drawn.mtl\n" + POINTS + "usemtl a\nf 1 2 3\n"),
         {{0, 0, 1, 1}}, "1 picture of materials passed over"),
     "a texture is noted");
  file("bad_d.mtl", "newmtl a\nd\n");
  ok(t,
     read("bad_d.obj", "mtllib bad_d.mtl\n" + POINTS)
         .says(":2: d has no number"),
     "d without a number");
}

void try_paths(tap *t) {
  mkdir((directory + "/Maps").c_str(), 0777);
  file("Maps/Paint.MTL", "newmtl a\nKd 1 0 0\n");
  const char *const names[] = {"Maps\\Paint.MTL", ".\\maps\\paint.mtl",
                               "MAPS/paint.mtl", "./Maps//Paint.mtl"};
  for (const char *name : names)
    ok(t,
       has(read("away.obj", std::string("mtllib ") + name + "\n" + POINTS +
                                "usemtl a\nf 1 2 3\n"),
           {{1, 0, 0, 1}}),
       "mtllib %s", name);
  file("paint.mtl", "newmtl a\nKd 0 1 0\n");
  ok(t,
     has(read("away.obj", "mtllib C:\\Users\\x\\paint.mtl\n" + POINTS +
                              "usemtl a\nf 1 2 3\n"),
         {{0, 1, 0, 1}}),
     "the file of a path that is not there is looked for beside the .obj");
}

void try_seven_numbers(tap *t) {
  ok(t,
     has(read("seven.obj", "v 0 0 0 1 0 0 .5\nv 1 0 0 1 0 0 .5\n"
                           "v 0 1 0 1 0 0 .5\nf 1 2 3\n"),
         {{1, 0, 0, .5}},
         "3 vertices of seven numbers are read as x y z, red "
         "green blue, opacity"),
     "vertices of seven numbers");
  file("plain.mtl", "newmtl a\nillum 1\n");
  ok(t,
     has(read("said.obj", "mtllib plain.mtl\nv 0 0 0 1 0 0 .5\n"
                          "v 1 0 0 1 0 0 .5\nv 0 1 0 1 0 0 .5\nusemtl a\n"
                          "f 1 2 3\n"),
         {{1, 0, 0, .5}}, "seven numbers"),
     "a material that says no opacity leaves that of the vertices");
  ok(t,
     has(read("six.obj",
              "v 0 0 0 0 255 0\nv 1 0 0 0 255 0\nv 0 1 0\nf 1 2 3\n"),
         {GREY}, "colours of vertices are passed over: 2 of 3 have one"),
     "colours that some vertices lack");
}

/* ---- .ply ---- */

std::string ply(const std::string &elements, const std::string &values) {
  return "ply\nformat ascii 1.0\n" + elements + "end_header\n" + values;
}

const std::string PLACE = "property float x\nproperty float y\n"
                          "property float z\n",
                  FACE = "property list uchar int vertex_indices\n";

std::string colour(const char *type, bool alpha) {
  std::string text;
  for (const char *name : {"red", "green", "blue", "alpha"})
    if (alpha || std::strcmp(name, "alpha") != 0)
      text += std::string("property ") + type + " " + name + "\n";
  return text;
}

void try_ply_colours(tap *t) {
  const std::string head = "element vertex 3\n" + PLACE,
                    points = "0 0 0\n1 0 0\n0 1 0\n";
  ok(t,
     has(read("a.ply",
              ply(head + "element face 2\n" + FACE + colour("uchar", true),
                  points + "3 0 1 2 255 0 0 51\n3 0 1 2 0 0 255 255\n")),
         {{1, 0, 0, .2}, {0, 0, 1, 1}}),
     "faces with alpha");
  ok(t,
     has(read("f.ply",
              ply(head + "element face 1\n" + FACE + colour("float", true),
                  points + "3 0 1 2 0 .5 1 .25\n")),
         {{0, .5, 1, .25}}),
     "colours in real numbers");
  ok(t,
     has(read("w.ply",
              ply(head + "element face 1\n" + FACE + colour("ushort", false),
                  points + "3 0 1 2 65535 0 13107\n")),
         {{1, 0, .2, 1}}),
     "colours in 16 bits");
  ok(t,
     has(read("v.ply",
              ply(head + colour("uchar", true) + "element face 1\n" + FACE,
                  "0 0 0 255 0 0 0\n1 0 0 255 0 0 0\n"
                  "0 1 0 255 0 0 153\n3 0 1 2\n")),
         {{1, 0, 0, .2}}),
     "the mean opacity of vertices");
}

/* Binary, of floats alone: what a reader of plain files would take. */
void try_binary_colours(tap *t) {
  const std::string head =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\n" + PLACE +
      colour("float", false) + "element face 1\n" + FACE + "end_header\n";
  const float numbers[18] = {0, 0, 0, 0, 1, 0, 1, 0, 0,
                             0, 1, 0, 0, 1, 0, 0, 1, 0};
  const int32_t corner[3] = {0, 1, 2};
  std::string body(reinterpret_cast<const char *>(numbers), sizeof numbers);
  body += '\3';
  body.append(reinterpret_cast<const char *>(corner), sizeof corner);
  ok(t, has(read("b.ply", head + body), {{0, 1, 0, 1}}),
     "binary vertices with colours in real numbers");
}

void try_strips(tap *t) {
  const std::string head = "element vertex 6\n" + PLACE +
                           "element tristrips 1\n"
                           "property list int int vertex_indices\n",
                    points = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n1 2 0\n";
  const Read strip =
      read("s.ply", ply(head, points + "11 0 1 2 3 -1 2 3 4 4 5 4\n"));
  const std::vector<uint32_t> wanted = {0, 1, 2, 2, 1, 3, 2, 3, 4};
  ok(t,
     strip.start.size() == 4 && strip.vertex == wanted && !strip.n_dropped &&
         strip.error.empty(),
     "a strip of triangles, divided by -1; joints are no faces");
  ok(t,
     read("s.ply", ply(head, points + "3 0 1 6\n"))
         .says("strip 0 names vertex 6 of 6"),
     "a strip of vertices that are not there");
  const Read both = read("s.ply", ply("element vertex 6\n" + PLACE +
                                          "element face 1\n" + FACE +
                                          "element tristrips 1\n"
                                          "property list int int vertex_index\n"
                                          "element edge 1\nproperty int v\n",
                                      points + "3 3 4 5\n3 0 1 2\n7\n"));
  ok(t,
     both.start.size() == 3 && both.vertex[0] == 3 && both.vertex[3] == 0 &&
         both.notes.find("1 element 'edge' passed over") != std::string::npos,
     "faces and strips; edges are passed over with a note");
  ok(t,
     read("s.ply", ply("element vertex 6\n" + PLACE, points))
         .says("there is no element 'face' or 'tristrips'"),
     "neither");
}

/* ---- .off ---- */

void try_off(tap *t) {
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  ok(t, has(read("o.off", "OFF3 1 0\n" + points + "3 0 1 2\n"), {GREY}),
     "a number close behind OFF");
  ok(t,
     has(read("c.off", "COFF 3 1 0\n0 0 0 0 255 0 255\n1 0 0 0 255 0 255\n"
                       "0 1 0 0 255 0 255\n3 0 1 2\n"),
         {{0, 1, 0, 1}}),
     "colours of vertices, 0..255");
  ok(t,
     has(read("c.off", "COFF 3 1 0\n0 0 0 0 .5 0 .25\n1 0 0 0 .5 0 .25\n"
                       "0 1 0 0 .5 0 .25\n3 0 1 2\n"),
         {{0, .5, 0, .25}}),
     "0..1");
  ok(t,
     has(read("c.off", "STCN4OFF 3 1 0\n0 0 0 2 0 0 1 1 1 0 0 .7 .8 1\n"
                       "2 0 0 2 0 0 1 1 1 0 0 .7 .8 1\n"
                       "0 2 0 2 0 0 1 1 1 0 0 .7 .8 1\n3 0 1 2\n"),
         {{1, 0, 0, 1}}),
     "among normals and textures, of four dimensions");
  ok(t,
     has(read("c.off", "COFF 3 1 0\n0 0 0 1 0 0 1\n1 0 0\n0 1 0 1 0 0 1\n"
                       "3 0 1 2\n"),
         {GREY}, "colours of vertices are passed over: 2 of 3 have one"),
     "colours that some vertices lack, too");
  ok(t,
     has(read("f.off", "OFF 3 4 0\n" + points +
                           "3 0 1 2 255 0 0 51\n3 0 1 2\n3 0 1 2 0 .5 1.0\n"
                           "3 0 1 2 7\n"),
         {{1, 0, 0, .2}, GREY, {0, .5, 1, 1}, GREY},
         "1 face has the number of a colour in a map"),
     "colours of some faces, with alpha");
  ok(t,
     has(read("m.off", "COFF 3 1 0\n0 0 0 5\n1 0 0 7\n0 1 0 5\n3 0 1 2\n"),
         {GREY}, "3 vertices have the number of a colour in a map"),
     "and of vertices");
  const std::string two =
      read("n.off", "COFF 3 1 0\n0 0 0 1 0\n1 0 0\n0 1 0\n3 0 1 2\n").error;
  ok(t, two.find("vertex 0 has 5 numbers, not 3") != std::string::npos,
     "two numbers are no colour");
}

std::string big_endian(const std::vector<uint32_t> &words) {
  std::string text;
  for (uint32_t word : words)
    for (int shift = 24; shift >= 0; shift -= 8)
      text += char(word >> shift);
  return text;
}

uint32_t bits(float number) {
  uint32_t word;
  std::memcpy(&word, &number, sizeof word);
  return word;
}

void try_binary_off(tap *t) {
  const uint32_t one = bits(1), half = bits(.5f);
  std::vector<uint32_t> words = {3, 2, 0, 0, 0, 0, one, 0, 0, 0, one, 0, 3,
                                 0, 1, 2, 0, 3, 2, 1,   0, 4, 0, one, 0, half};
  const std::string body = big_endian(words);
  const Read good = read("b.off", "OFF BINARY\n" + body);
  ok(t,
     has(good, {GREY, {0, 1, 0, .5}}) && good.xyz[3] == 1 &&
         good.vertex[3] == 2,
     "a binary .off, with a colour");
  ok(t,
     has(read("b.off", "OFF BINARY\n" + body + "abc"), {GREY, {0, 1, 0, .5}},
         "3 bytes after the last face passed over"),
     "and bytes behind it");
  bool all = true;
  for (size_t n = 0; n < body.size(); n += 3)
    all =
        all && !read("b.off", "OFF BINARY\n" + body.substr(0, n)).error.empty();
  ok(t, all, "any part of it is refused");
  words[0] = 0x7fffffff;
  ok(t,
     read("b.off", "OFF BINARY\n" + big_endian(words))
         .says("2147483647 vertices are claimed, more than the"),
     "a count that the file cannot hold");
  ok(t,
     read("n.off", "nOFF\n4\n3 1 0\n")
         .says("nOFF, of any number of dimensions"),
     "nOFF is refused by name");
}

/* ---- .stl ---- */

/* Two facets with these last bytes. */
std::string stl(std::string header, uint16_t first, uint16_t second) {
  header.resize(80, ' ');
  std::string text = header + std::string("\2\0\0\0", 4);
  for (const uint16_t bits : {first, second}) {
    const float numbers[12] = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0};
    text.append(reinterpret_cast<const char *>(numbers), sizeof numbers);
    text += char(bits & 255);
    text += char(bits >> 8);
  }
  return text;
}

void try_stl(tap *t) {
  const char *viscam = "colours are read as VisCAM writes them";
  const char *magics = "colours are read as Magics writes them";
  const std::string common = std::string("x COLOR=\0\377\0\200", 12);
  ok(t,
     has(read("v.stl", stl("made by me", 0xfc00, 0x801f)),
         {{1, 0, 0, 1}, {0, 0, 1, 1}}, viscam),
     "colours of VisCAM: red is high");
  ok(t,
     has(read("v.stl", stl("made by me", 0xfc00, 0x001f)), {{1, 0, 0, 1}, GREY},
         viscam),
     "a facet without one");
  ok(t, has(read("v.stl", stl("made by me", 0x001f, 0)), {GREY, GREY}),
     "bits that are no colour");
  ok(t,
     has(read("m.stl", stl(common, 0x001f, 0x7c00)),
         {{1, 0, 0, 1}, {0, 0, 1, 1}}, magics),
     "colours of Magics: red is low");
  ok(t,
     has(read("m.stl", stl(common, 0x801f, 0x03e0)),
         {{0, 1, 0, 128 / 255.}, {0, 1, 0, 1}}, magics),
     "a facet with the colour of all, which has an opacity");
  ok(t,
     has(read("m.stl", stl(common, 0, 0)),
         {{0, 1, 0, 128 / 255.}, {0, 1, 0, 128 / 255.}}, magics),
     "no facet has a colour of its own");
  ok(t,
     has(read("s.stl", stl("solid part from cad", 0, 0) + "ab"), {GREY, GREY},
         "2 bytes after the last facet passed over"),
     "a binary file that begins with 'solid', with bytes behind it");
  const std::string whole = stl("solid part from cad", 0, 0);
  ok(t,
     read("s.stl", whole.substr(0, whole.size() - 1))
         .says("2 binary facets take 184 bytes, not 183"),
     "one that is too short");
}

/* ---- .gz ---- */

bool compress(const std::string &path, const std::string &text) {
  gzFile out = gzopen(path.c_str(), "wb");
  const bool good = out && gzwrite(out, text.data(), unsigned(text.size())) ==
                               int(text.size());
  return out && gzclose(out) == Z_OK && good;
}

void try_compressed(tap *t) {
  const std::string off = "COFF 3 1 0\n0 0 0 0 1 0 1\n1 0 0 0 1 0 1\n"
                          "0 1 0 0 1 0 1\n3 0 1 2\n";
  const std::string path = directory + "/packed.off.gz";
  ok(t, compress(path, off) && has(Read(path, 1, true), {{0, 1, 0, 1}}),
     ".off.gz");
  const std::string upper = directory + "/PACKED.STL.GZ";
  ok(t,
     compress(upper, stl("solid", 0xfc00, 0)) &&
         has(Read(upper, 1, true), {{1, 0, 0, 1}, GREY}, "VisCAM"),
     ".STL.GZ");
  std::string zipped(1 << 16, '\0');
  std::FILE *in = std::fopen(path.c_str(), "rb");
  zipped.resize(std::fread(&zipped[0], 1, zipped.size(), in));
  std::fclose(in);
  ok(t,
     read("cut.off.gz", zipped.substr(0, zipped.size() / 2))
         .says("the compressed file ends too early"),
     "a part of a compressed file");
  zipped[zipped.size() / 2] = char(zipped[zipped.size() / 2] ^ 0x55);
  ok(t, read("bad.off.gz", zipped).says("is not a good gzip file"),
     "a compressed file that is damaged");
  ok(t, has(read("plain.off.gz", off), {{0, 1, 0, 1}}),
     "one that is not compressed at all");
}

} // namespace

int main() {
  if (!make_directory())
    return 99;
  struct tap t = plan(3 + 5 + 3 + 4 + 1 + 4 + 8 + 5 + 8 + 5);
  try_materials(&t);
  try_paths(&t);
  try_seven_numbers(&t);
  try_ply_colours(&t);
  try_binary_colours(&t);
  try_strips(&t);
  try_off(&t);
  try_binary_off(&t);
  try_stl(&t);
  try_compressed(&t);
  return finish(&t) | !remove_directory();
}
