// SPDX-License-Identifier: GPL-3.0-or-later
// Mesh files: the same cube in every format, its solidity, and what is dropped.
#include "common/files/mesh/exchange.h"
#include "tests/tap.h"
#include "tests/unit/files/folder.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

/*     7----6
 *    /|   /|     six quadrilaterals, counter-clockwise from outside;
 *   4----5 |     0.1 is not a double, so a reader's rounding shows
 *   | 3--|-2
 *   |/   |/
 *   0----1      */
const double CUBE[8][3] = {{0, 0, 0},       {0.1, 0, 0},  {0.1, 0, 0.1},
                           {0, 0, 0.1},     {0, 0.1, 0},  {0.1, 0.1, 0},
                           {0.1, 0.1, 0.1}, {0, 0.1, 0.1}};
const int FACES[6][4] = {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1},
                         {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}};

std::string numbers(const double *p) {
  char text[100];
  std::snprintf(text, sizeof text, "%.17g %.17g %.17g\n", p[0], p[1], p[2]);
  return text;
}

std::string corners(const int *face, int first) {
  char text[100];
  std::snprintf(text, sizeof text, "%d %d %d %d", face[0] + first,
                face[1] + first, face[2] + first, face[3] + first);
  return text;
}

std::string points() {
  std::string text;
  for (const auto &p : CUBE)
    text += numbers(p);
  return text;
}

std::string cube_off(int n_faces = 6) {
  std::string text = "OFF\n8 " + std::to_string(n_faces) + " 0\n" + points();
  for (int f = 0; f < n_faces; f++)
    text += "4 " + corners(FACES[f], 0) + "\n";
  return text;
}

std::string cube_obj() {
  std::string text;
  for (const auto &p : CUBE)
    text += "v " + numbers(p);
  for (const auto &f : FACES)
    text += "f " + corners(f, 1) + "\n";
  return text;
}

std::string cube_ply() {
  std::string text = "ply\nformat ascii 1.0\nelement vertex 8\n"
                     "property double x\nproperty double y\nproperty double z\n"
                     "element face 6\nproperty list uchar int vertex_indices\n"
                     "end_header\n" +
                     points();
  for (const auto &f : FACES)
    text += "4 " + corners(f, 0) + "\n";
  return text;
}

std::string cube_vtp() {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" "
      "byte_order=\"LittleEndian\"><PolyData><Piece NumberOfPoints=\"8\" "
      "NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
      "NumberOfPolys=\"6\"><Points><DataArray type=\"Float64\" "
      "NumberOfComponents=\"3\" format=\"ascii\">" +
      points() +
      "</DataArray></Points><Polys><DataArray type=\"Int64\" "
      "Name=\"connectivity\" format=\"ascii\">";
  for (const auto &f : FACES)
    text += corners(f, 0) + " ";
  return text + "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" "
                "format=\"ascii\">4 8 12 16 20 24</DataArray></Polys></Piece>"
                "</PolyData></VTKFile>\n";
}

/* Two triangles for each face, with every corner written out. */
std::string cube_stl() {
  std::string text = "solid cube\n";
  for (const auto &f : FACES)
    for (int half = 0; half < 2; half++) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (int k : {0, 1 + half, 2 + half})
        text += "vertex " + numbers(CUBE[f[k]]);
      text += "endloop\nendfacet\n";
    }
  return text + "endsolid cube\n";
}

/* The one object of a file, or NULL. The scene is the caller's. */
struct hsr_object *read(struct hsr_scene *scene, const std::string &path,
                        struct hsr_import *import) {
  struct hsr_error err = {HSR_OK, ""};
  if (hsr_mesh_read(scene, path.c_str(), import, &err)) {
    std::printf("# %s\n", err.text);
    return nullptr;
  }
  return &scene->objects[0];
}

/* Reads the cube as it was written, bit for bit, with polygons as polygons. */
void try_cube(tap *t, const std::string &path) {
  struct hsr_scene *scene = hsr_scene_new("");
  const struct hsr_object *o = read(scene, path, nullptr);
  bool same = o && o->n_vertices == 8 && o->n_faces == 6 &&
              !std::memcmp(o->xyz, CUBE, sizeof CUBE);
  for (uint32_t f = 0; same && f < 6; f++)
    for (uint32_t k = 0; k < 4; k++)
      same = same && o->start[f + 1] - o->start[f] == 4 &&
             o->vertex[o->start[f] + k] == uint32_t(FACES[f][k]);
  ok(t, same, "%s: the cube, bit for bit", path.c_str());
  ok(t, o && o->one_sided, "a solid, so one-sided");
  ok(t, o && !std::strcmp(o->name, "cube"), "named after the file");
  hsr_scene_delete(scene);
}

void try_stl(tap *t) {
  struct hsr_scene *scene = hsr_scene_new("");
  const struct hsr_object *o =
      read(scene, file("cube.stl", cube_stl()), nullptr);
  ok(t, o && o->n_faces == 12 && o->n_vertices == 8,
     "equal corners of an .stl are one vertex");
  ok(t, o && o->one_sided, "so that it is a solid");
  hsr_scene_delete(scene);
}

void try_solidity(tap *t) {
  struct hsr_scene *scene = hsr_scene_new("");
  const struct hsr_object *open =
      read(scene, file("open.off", cube_off(5)), nullptr);
  ok(t, open && !open->one_sided, "an open mesh is two-sided");
  hsr_scene_delete(scene);

  std::string inward = "OFF\n8 6 0\n" + points();
  for (const auto &f : FACES) {
    const int turned[4] = {f[3], f[2], f[1], f[0]};
    inward += "4 " + corners(turned, 0) + "\n";
  }
  scene = hsr_scene_new("");
  const struct hsr_object *inside =
      read(scene, file("inside.off", inward), nullptr);
  ok(t, inside && !inside->one_sided, "a mesh inside out is two-sided");
  hsr_scene_delete(scene);
}

/* Four faces: one repeats a vertex and one has no area. */
void try_degenerate(tap *t) {
  const std::string path =
      file("poor.off", "OFF\n5 4 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 0\n"
                       "3 0 1 2\n3 0 0 2\n3 0 1 4\n4 0 1 2 3\n");
  struct hsr_scene *scene = hsr_scene_new("");
  struct hsr_error err = {HSR_OK, ""};
  struct hsr_import strict = {};
  strict.strict = true;
  ok(t,
     hsr_mesh_read(scene, path.c_str(), &strict, &err) == HSR_E_INPUT &&
         scene->n_objects == 0,
     "degenerate faces are refused, and nothing is left: %s", err.text);
  struct hsr_import import = {};
  const struct hsr_object *o = read(scene, path, &import);
  ok(t, o && o->n_faces == 2 && import.n_dropped == 2,
     "or dropped and counted: %llu", (unsigned long long)import.n_dropped);
  hsr_scene_delete(scene);
}

void try_colours(tap *t) {
  struct hsr_scene *scene = hsr_scene_new("");
  const struct hsr_object *o = read(
      scene,
      file("red.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 255 0 0\n"),
      nullptr);
  ok(t, o && o->rgb && o->rgb[0] == 1 && o->rgb[1] == 0,
     "the colour of a face is kept");
  hsr_scene_delete(scene);
}

bool is_linear(const float *rgb, double r, double g, double b) {
  const double want[3] = {r, g, b};
  for (int k = 0; k < 3; k++) {
    const double light = want[k] <= .04045
                             ? want[k] / 12.92
                             : std::pow((want[k] + .055) / 1.055, 2.4);
    if (!(std::fabs(rgb[k] - light) < 1e-5))
      return false;
  }
  return true;
}

/* The second face of two is of these colours, and the first of the others. */
void try_face_colours(tap *t, const std::string &path, const double first[3],
                      const double second[3], const char *what) {
  struct hsr_scene *scene = hsr_scene_new("");
  const struct hsr_object *o = read(scene, path, nullptr);
  if (!ok(t,
          o && o->rgb && is_linear(o->rgb, first[0], first[1], first[2]) &&
              is_linear(o->rgb + 3, second[0], second[1], second[2]),
          "%s", what) &&
      o && o->rgb)
    std::printf("# %g %g %g, %g %g %g\n", o->rgb[0], o->rgb[1], o->rgb[2],
                o->rgb[3], o->rgb[4], o->rgb[5]);
  hsr_scene_delete(scene);
}

void try_more_colours(tap *t) {
  const double red[3] = {1, 0, 0}, green[3] = {0, 1, 0}, grey[3] = {.5, .5, .5};
  const double none[3] = {.797738, .797738, .797738}; /* linear .6 */
  file("a b.mtl", "# two\nnewmtl red one\nKa 1 1 1\nKd 1 0 0\n"
                  "newmtl grey\nKd 0.5\nnewmtl odd\nKd spectral x.rfl 1\n");
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  struct hsr_scene *scene = hsr_scene_new("");
  const struct hsr_object *o =
      read(scene,
           file("none.obj",
                "mtllib none.mtl\n" + points + "usemtl red one\nf 1 2 3\n"),
           nullptr);
  ok(t, o && !o->rgb, "a library that is not there is passed over");
  hsr_scene_delete(scene);
  try_face_colours(t,
                   file("mtl.obj", "mtllib a b.mtl\n" + points +
                                       "usemtl red one\nf 1 2 3\n"
                                       "usemtl grey\nf 3 2 1\n"),
                   red, grey, "materials colour their faces");
  try_face_colours(t,
                   file("part.obj", "mtllib a b.mtl\n" + points +
                                        "f 1 2 3\nusemtl red one\nf 3 2 1\n"
                                        "usemtl odd\nf 2 3 1\n"),
                   none, red,
                   "a face without material has the object's colour");
  try_face_colours(t,
                   file("v.obj", "v 0 0 0 0 1 0\nv 1 0 0 0 1 0\n"
                                 "v 0 1 0 0 1 0\nf 1 2 3\nf 3 2 1\n"),
                   green, green, "vertices colour their faces in .obj");
  try_face_colours(t,
                   file("w.obj", "v 0 0 0 255 0 0\nv 1 0 0 255 0 0\n"
                                 "v 0 1 0 255 0 0\nf 1 2 3\nf 3 2 1\n"),
                   red, red, "up to 255");
  const std::string head = "ply\nformat ascii 1.0\nelement vertex 3\n"
                           "property float x\nproperty float y\n"
                           "property float z\nproperty uchar red\n"
                           "property uchar green\nproperty uchar blue\n"
                           "element face 2\n"
                           "property list uchar int vertex_indices\n";
  const std::string vertices = "0 0 0 255 0 0\n1 0 0 255 0 0\n0 1 0 255 0 0\n";
  try_face_colours(
      t, file("v.ply", head + "end_header\n" + vertices + "3 0 1 2\n3 2 1 0\n"),
      red, red, "vertices colour their faces in .ply");
  try_face_colours(t,
                   file("f.ply", head +
                                     "property uchar red\n"
                                     "property uchar green\n"
                                     "property uchar blue\nend_header\n" +
                                     vertices +
                                     "3 0 1 2 0 255 0\n3 2 1 0 255 0 0\n"),
                   green, red, "but a face's own colour comes first");
}

bool is_refused(const std::string &name, const std::string &text,
                const char *says) {
  struct hsr_scene *scene = hsr_scene_new("");
  struct hsr_error err = {HSR_OK, ""};
  struct hsr_import strict = {};
  strict.strict = true;
  const bool refused = hsr_mesh_read(scene, file(name, text).c_str(), &strict,
                                     &err) == HSR_E_INPUT &&
                       std::strstr(err.text, says);
  if (!refused)
    std::printf("# %s: %s\n", name.c_str(), err.text);
  hsr_scene_delete(scene);
  return refused;
}

/* Numbers of vertices, one beyond what there is on either side. */
void try_numbers(tap *t) {
  const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const std::string off = "OFF\n4 1 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n";
  struct hsr_scene *scene = hsr_scene_new("");
  const struct hsr_object *o =
      read(scene, file("back.obj", three + "f -3 -2 3\n"), nullptr);
  ok(t, o && o->n_faces == 1 && o->vertex[0] == 0 && o->vertex[2] == 2,
     "an .obj may count from its end, and names its last vertex");
  hsr_scene_delete(scene);
  ok(t,
     is_refused("n.obj", three + "f -4 -2 -1\n", "names vertex -4 of 3") &&
         is_refused("n.obj", three + "f 1 2 4\n", "names vertex 4 of 3") &&
         is_refused("n.obj", three + "f 0 1 2\n", "names vertex 0 of 3") &&
         is_refused("n.off", off + "3 0 1 4\n", "names vertex 4 of 4") &&
         is_refused("n.off", off + "3 -1 1 2\n", "names vertex -1 of 4"),
     "but neither format has others");
  ok(t,
     is_refused("twice.off", off + "4 2 0 1 2\n",
                ":7: face 0 has the same vertex twice"),
     "a vertex is found again wherever it stands");
}

/* One triangle: a header, its number of triangles, 50 bytes. */
/* Plain lines are read in another way than others: the same numbers must come
 * out, to the last bit, and errors must name the same line. */
void try_plain_lines(tap *t) {
  const std::string word[] = {"0.1",
                              "-1e-320",
                              "4.9e-324",
                              "1e22",
                              "123456789012345678901234567890",
                              ".5",
                              "-7.",
                              "8.5E+3",
                              "2.2250738585072011e-308"};
  std::string plain, other;
  for (const auto &x : word)
    for (const auto &y : word) {
      plain += "\t" + x + "  " + y + " 1 \r\n";
      other += x + " " + y + " +1 # not plain\n";
    }
  const std::string header = "OFF\n81 2 0\n", faces = "3 0 9 20\n4 1 2 3 13\n";
  struct hsr_scene *scene = hsr_scene_new("");
  read(scene, file("plain.off", header + plain + faces), nullptr);
  read(scene, file("other.off", header + other + "3 0 9 20 # \n4 1 2 3 13 #"),
       nullptr);
  const struct hsr_object *o = scene->objects;
  ok(t,
     scene->n_objects == 2 && o[0].n_vertices == 81 && o[1].n_vertices == 81 &&
         !std::memcmp(o[0].xyz, o[1].xyz, 81 * 3 * sizeof *o[0].xyz) &&
         o[0].n_faces == 2 && o[1].n_faces == 2 &&
         !std::memcmp(o[0].vertex, o[1].vertex, 7 * sizeof *o[0].vertex),
     "plain lines of an .off and others give the same object");
  hsr_scene_delete(scene);
  ok(t,
     is_refused("twice.off", header + plain + "3 0 9 20\n3 4 5 4\n", ":85") &&
         is_refused(
             "inf.off", "OFF\n3 1 0\n0 0 0\n1 0 inf\n0 1 0\n3 0 1 2\n",
             "vertex 1 is not finite or above 1e30, and face 0 uses it") &&
         is_refused("four.off", "OFF\n3 1 0\n0 0 0\n1 0 0 4\n0 1 0\n3 0 1 2\n",
                    ":4: vertex 1 has 4 numbers"),
     "errors in them name the line");
}

/* Two solids that share an edge: it is run twice in each direction. */
void try_pinched(tap *t) {
  const std::string points = "0 0 0\n0 0 1\n1 0 0\n0 1 0\n-1 0 0\n0 -1 0\n";
  const std::string first = "3 0 2 1\n3 1 3 0\n3 0 3 2\n3 1 2 3\n";
  const std::string second = "3 0 4 1\n3 1 5 0\n3 0 5 4\n3 1 4 5\n";
  struct hsr_scene *scene = hsr_scene_new("");
  for (const auto &one : {first, second})
    read(scene, file("one.off", "OFF\n6 4 0\n" + points + one), nullptr);
  read(scene, file("both.off", "OFF\n6 8 0\n" + points + first + second),
       nullptr);
  const struct hsr_object *o = scene->objects;
  ok(t,
     scene->n_objects == 3 && o[0].one_sided && o[1].one_sided &&
         !o[2].one_sided,
     "each of two solids that share an edge is one; both are not one solid");
  hsr_scene_delete(scene);
}

void try_binary_stl(tap *t) {
  const float corner[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  std::string bytes(84 + 50, '\0');
  bytes[80] = 1;
  std::memcpy(&bytes[84 + 12], corner, sizeof corner);
  struct hsr_scene *scene = hsr_scene_new("");
  const struct hsr_object *o = read(scene, file("one.stl", bytes), nullptr);
  ok(t, o && o->n_faces == 1 && o->n_vertices == 3 && o->xyz[3] == 1,
     "a binary .stl");
  hsr_scene_delete(scene);
  ok(t,
     is_refused("short.stl", bytes.substr(0, 133),
                "1 binary facets take 134 bytes, not 133"),
     "one that is too short is none");
}

/* A fan of n triangles about the first corner, which is (0, 0, 0) or, in every
 * second triangle, (-0, -0, -0). No two triangles share another corner. */
void try_places(tap *t) {
  const uint32_t n = 1000;
  std::string bytes(84 + 50 * size_t{n}, '\0');
  std::memcpy(&bytes[80], &n, sizeof n);
  for (uint32_t f = 0; f < n; f++) {
    const float zero = f % 2 ? -0.0f : 0.0f, x = static_cast<float>(f + 1);
    const float corner[9] = {zero, zero, zero, x, 0, 0, 0, x, 1};
    std::memcpy(&bytes[84 + 50 * size_t{f} + 12], corner, sizeof corner);
  }
  struct hsr_scene *scene = hsr_scene_new("");
  const struct hsr_object *o = read(scene, file("fan.stl", bytes), nullptr);
  ok(t,
     o && o->n_faces == n && o->n_vertices == 2 * n + 1 &&
         o->vertex[3 * (n - 1)] == 0 && o->vertex[3 * n - 1] == 2 * n,
     "0 and -0 are the same place in a binary .stl, other places are others");
  hsr_scene_delete(scene);
}

/* Vertices and faces in either sequence, and elements that are passed over. */
void try_sequence(tap *t) {
  const std::string vertices = "element vertex 3\nproperty float x\n"
                               "property float y\nproperty float z\n",
                    faces = "element face 2\n"
                            "property list uchar int vertex_indices\n"
                            "property uchar r\nproperty uchar g\n"
                            "property uchar b\n",
                    edges = "element edge 1\nproperty int v\n";
  const std::string red_face = "3 0 1 2 255 0 0\n", other = "3 2 1 0 0 255 0\n";
  const double red[3] = {1, 0, 0}, green[3] = {0, 1, 0};
  try_face_colours(t,
                   file("back.ply", "ply\nformat ascii 1.0\n" + faces + edges +
                                        vertices + "end_header\n" + red_face +
                                        other + "7\n0 0 0\n1 0 0\n0 1 0\n"),
                   red, green, "faces may come before the vertices in .ply");
}

} // namespace

int main() {
  if (!make_directory())
    return 99;
  const bool vtk = hsr_exchange_has_vtk();
  struct tap t =
      plan(3 * 3 + (vtk ? 3 : 0) + 2 + 2 + 2 + 1 + 8 + 3 + 3 + 2 + 1 + 1);
  try_cube(&t, file("cube.off", cube_off()));
  try_cube(&t, file("cube.obj", cube_obj()));
  try_cube(&t, file("cube.ply", cube_ply()));
  if (vtk)
    try_cube(&t, file("cube.vtp", cube_vtp()));
  try_stl(&t);
  try_solidity(&t);
  try_degenerate(&t);
  try_colours(&t);
  try_more_colours(&t);
  file("bad.mtl", "newmtl a\nKd 1 x 1\n");
  ok(&t, is_refused("bad.obj", "mtllib bad.mtl\nv 0 0 0\n", "bad.mtl:2"),
     "a material that is malformed is refused");
  try_numbers(&t);
  try_plain_lines(&t);
  try_pinched(&t);
  try_binary_stl(&t);
  try_places(&t);
  try_sequence(&t);
  return finish(&t) | !remove_directory();
}
