// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer target for a mesh reader. -DHSR_FUZZ_SUFFIX chooses it: '".off"'.
// A file that several threads read must be the same as one thread makes it; and,
// of a .ply file, as the general reader makes it, which reads where faces are to be
// dropped.
#include "common/files/mesh/exchange.h"
#include "tests/fuzz/fuzz_reader.h"
#include "tests/fuzz/mutate_text.h"

#include <array>
#include <map>
#include <numeric>
#include <vector>

namespace {

/* What a file gives. */
struct Mesh {
  struct hsr_error error = {HSR_OK, ""};
  std::vector<double> xyz;
  std::vector<float> rgb; /* of its faces */
  std::vector<uint32_t> start, vertex;
  bool one_sided = false;
  uint64_t n_dropped = 0;
  std::string notes;

  Mesh(const std::string &path, bool drop, int threads) {
    struct hsr_scene *scene = hsr_scene_new("fuzz");
    struct hsr_import import = {};
    if (!scene)
      std::abort();
    import.strict = !drop;
    import.threads = threads;
    enum hsr_status status =
        hsr_mesh_read(scene, path.c_str(), &import, &error);
    if (status == HSR_OK)
      take(scene->objects[0], import);
    if (status == HSR_OK)
      status = hsr_scene_finish(scene, &error);
    fuzz_check(status, error);
    hsr_scene_delete(scene);
  }
  void take(const struct hsr_object &o, const struct hsr_import &import) {
    xyz.assign(o.xyz, o.xyz + 3 * size_t{o.n_vertices});
    start.assign(o.start, o.start + o.n_faces + 1);
    vertex.assign(o.vertex, o.vertex + o.start[o.n_faces]);
    if (o.rgb)
      rgb.assign(o.rgb, o.rgb + 3 * size_t{o.n_faces});
    one_sided = o.one_sided;
    n_dropped = import.n_dropped;
    notes = import.notes;
  }
  bool operator==(const Mesh &other) const {
    return xyz == other.xyz && rgb == other.rgb && start == other.start &&
           vertex == other.vertex && one_sided == other.one_sided &&
           n_dropped == other.n_dropped && notes == other.notes &&
           error.status == other.error.status &&
           !std::strcmp(error.text, other.error.text);
  }
  void print(const char *by) const {
    std::fprintf(stderr,
                 "%s: %zu numbers, %zu corners, %zu colours%s, %llu"
                 " dropped, '%s', notes '%s'\n",
                 by, xyz.size(), vertex.size(), rgb.size() / 3,
                 one_sided ? ", one-sided" : "",
                 static_cast<unsigned long long>(n_dropped), error.text,
                 notes.c_str());
  }
};

void compare(const Mesh &one, const Mesh &other) {
  if (one == other)
    return;
  one.print("one thread");
  other.print("three threads");
  std::abort();
}

/* In an .stl file each corner gives its place. Vertices are numbered as they are
 * met, and no two have the same place. */
void check_corners(const Mesh &mesh) {
  std::map<std::array<double, 3>, uint32_t> places;
  for (const uint32_t v : mesh.vertex) {
    const double *p = &mesh.xyz[3 * size_t{v}];
    const auto next = static_cast<uint32_t>(places.size());
    if (places.insert({{p[0] + 0.0, p[1] + 0.0, p[2] + 0.0}, next})
            .first->second != v)
      std::abort();
  }
  if (3 * places.size() != mesh.xyz.size())
    std::abort();
}

/* The places of the corners are those of a binary file. */
void check_places(const Mesh &mesh, const uint8_t *data) {
  for (size_t c = 0; c < mesh.vertex.size(); c++)
    for (size_t k = 0; k < 3; k++) {
      float number;
      std::memcpy(&number, data + 96 + 50 * (c / 3) + 12 * (c % 3) + 4 * k,
                  sizeof number);
      if (double{number} != mesh.xyz[3 * size_t{mesh.vertex[c]} + k])
        std::abort();
    }
}

bool is_binary_stl(const uint8_t *data, size_t size) {
  uint32_t n = 0;
  if (size >= 84)
    std::memcpy(&n, data + 80, sizeof n);
  return size >= 84 && size - 84 == size_t{50} * n;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static const std::string path = fuzz_path("mesh" HSR_FUZZ_SUFFIX);
  /* Not by the size: that of a plain file of records is not free. */
  const bool drop = std::accumulate(data, data + size, 0u) % 4 == 0;
  fuzz_write(path, data, size);
  const Mesh mesh(path, drop, 3);
  compare(Mesh(path, drop, 1), mesh);
  if (!std::strcmp(HSR_FUZZ_SUFFIX, ".ply") && !drop) {
    const Mesh general(path, true, 1);
    /* A vertex that follows itself is taken once, but not strictly. */
    if (!general.error.status && !general.n_dropped &&
        !std::strstr(mesh.error.text, "has the same vertex twice"))
      compare(general, mesh);
  }
  if (!std::strcmp(HSR_FUZZ_SUFFIX, ".stl") && !drop) {
    check_corners(mesh);
    if (is_binary_stl(data, size))
      check_places(mesh, data);
  }
  return 0;
}
