// SPDX-License-Identifier: GPL-3.0-or-later
// Groups of .obj files: which objects they become, and that these share the
// vertices of the file.
#include "common/files/cells/cells.h"
#include "common/lines/edges.h"
#include "scenes/scenes.h"
#include "tests/tap.h"
#include "tests/unit/files/folder.h"

#include <cstring>

namespace {

/* A scene that is laid out. */
struct Laid_out {
  struct hsr_scene *scene = nullptr;
  struct hsr_world world {};
  struct hsr_error err {};

  explicit Laid_out(const std::string &path) {
    struct hsr_import import {};
    if (hsr_scene_open(path.c_str(), &import, &scene, &err) ||
        hsr_world_init(&world, scene, &err)) {
      std::fprintf(stderr, "%s\n", err.text);
      std::exit(99);
    }
  }
  ~Laid_out() {
    hsr_world_free(&world);
    hsr_scene_delete(scene);
  }
  Laid_out(const Laid_out &) = delete;
  Laid_out &operator=(const Laid_out &) = delete;

  /* The names of the objects, each with its number of faces. */
  std::string objects() const {
    std::string text;
    for (uint32_t o = 0; o < scene->n_objects; o++)
      text += std::string(o ? ", " : "") + scene->objects[o].name + " " +
              std::to_string(scene->objects[o].n_faces);
    return text;
  }
  /* How many edges have n sides. */
  int edges_of(uint32_t n) const {
    struct hsr_edges edges;
    int found = 0;
    if (hsr_edges_init(&edges, &world, nullptr))
      std::exit(99);
    for (uint32_t e = 0; e < edges.n_real; e++)
      found += edges.side_start[e + 1] - edges.side_start[e] == n;
    hsr_edges_free(&edges);
    return found;
  }
  /* The first corner of face f, from 1, as .obj has it. */
  uint32_t corner(uint32_t f) const {
    return world.mesh.vertex[world.mesh.start[f]] + 1;
  }
};

const std::string VERTICES = "v 9 9 9\n" // which no face uses
                             "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                             "v 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
const std::string CUBE = VERTICES + "g ends\nf 5 4 3 2\nf 6 7 8 9\n"
                                    "g sides\nf 2 3 7 6\nf 3 4 8 7\n"
                                    "g ends\nf 4 5 9 8\nf 5 2 6 9\n";

std::string objects_of(const std::string &text) {
  return Laid_out(file("some.obj", text)).objects();
}

void check_names(tap *t) {
  const std::string f = "f 2 3 4\n";
  ok(t, objects_of(VERTICES + f) == "some 1",
     "a file without any is one object");
  ok(t, objects_of(VERTICES + "o a\n" + f + "o b\n" + f + f) == "a 1, b 2",
     "o");
  ok(t, objects_of(VERTICES + "g a b\n" + f + "g c\n" + f) == "a b 1, c 1",
     "g; a group with two names has both");
  ok(t,
     objects_of(VERTICES + "g a\no m\n" + f + "g b\n" + f + "o n\n" + f) ==
         "m 2, n 1",
     "o wins over g");
  ok(t, objects_of(VERTICES + f + "o a\n" + f) == "some 1, a 1",
     "faces before the first name");
  ok(t, objects_of(VERTICES + "o a\n" + f) == "a 1", "one object has its name");
  ok(t, objects_of(VERTICES + "o a\no b\n" + f + "o c\n") == "b 1",
     "one without faces makes none");
  ok(t,
     objects_of(VERTICES + "o a\nf 2 2 3\no b\n" + f + "o c\n" + f) ==
         "b 1, c 1",
     "nor does one of faces without area");
  ok(t,
     objects_of(VERTICES + "g a\n" + f + "g a\n" + f + "g b\n" + f + "g a\n" +
                f) == "a 2, b 1, a 1",
     "a name that goes on, and one that comes back");
  ok(t,
     objects_of(VERTICES + "g \xc3\xa4\n" + f + "g x\xe4\x01y\n" + f) ==
         "\xc3\xa4 1, x??y 1",
     "UTF-8, and what is not");
}

void check_sharing(tap *t) {
  const Laid_out cube(file("cube.obj", CUBE));
  ok(t, cube.objects() == "ends 2, sides 2, ends 2", "a cube of three groups");
  ok(t,
     cube.world.mesh.n_vertices == 9 && cube.corner(0) == 5 &&
         cube.corner(1) == 6 && cube.corner(3) == 3 && cube.corner(5) == 5,
     "faces and vertices have the numbers of the file");
  ok(t, cube.edges_of(2) == 12 && cube.edges_of(1) == 0,
     "its edges are those of one cube");
  ok(t,
     cube.scene->objects[0].one_sided && cube.scene->objects[1].one_sided &&
         cube.scene->objects[2].one_sided,
     "together they are closed");
}

void check_sides(tap *t) {
  std::string faces = CUBE.substr(VERTICES.size());
  const Laid_out two(
      file("two.obj", VERTICES + "o cube\n" + faces + "o sheet\nf 2 3 4\n"));
  ok(t,
     two.objects() == "cube 6, sheet 1" && two.scene->objects[0].one_sided &&
         !two.scene->objects[1].one_sided,
     "of a file that is not closed, a group may be so");
}

void check_round_trip(tap *t) {
  const Laid_out cube(file("cube.obj", CUBE));
  const std::string path = directory + "/again.obj";
  ok(t, !hsr_world_write_obj(&cube.world, path.c_str(), nullptr),
     "it is written");
  const Laid_out again(path);
  ok(t,
     again.objects() == cube.objects() && again.world.mesh.n_vertices == 9 &&
         !std::memcmp(again.world.mesh.vertex, cube.world.mesh.vertex,
                      24 * sizeof(uint32_t)),
     "and read again as the same");
}

void check_places(tap *t) {
  file("cube.obj", CUBE);
  const std::string two = R"({"schema": "hsr-scene/1", "objects": [
    {"name": "c", "file": "cube.obj"}, {"name": "d", "file": "cube.obj"}],
    "instances": [{"object": "c"}, {"object": "c", "translate": [3, 0, 0]},
                  {"object": "d", "translate": [0, 3, 0]}]})";
  const Laid_out scene(file("two.scene.json", two));
  ok(t,
     scene.world.mesh.n_vertices == 27 && scene.edges_of(2) == 36 &&
         scene.edges_of(1) == 0,
     "each copy shares its own vertices");
}

} // namespace

int main() {
  tap t = plan(18);
  if (!make_directory())
    return 99;
  check_names(&t);
  check_sharing(&t);
  check_sides(&t);
  check_round_trip(&t);
  check_places(&t);
  return remove_directory() ? finish(&t) : 99;
}
