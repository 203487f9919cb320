// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer target for the materials of .obj files.
#include "common/files/mesh/exchange.h"
#include "tests/fuzz/fuzz_reader.h"

/* A mesh that uses them, beside them. */
static std::string mesh_beside(const std::string &materials) {
  const std::string path = materials + ".obj";
  std::FILE *file = std::fopen(path.c_str(), "w");
  if (!file ||
      std::fputs("mtllib mesh.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
                 "usemtl a\nf 1 2 3\n",
                 file) < 0 ||
      std::fclose(file))
    std::abort();
  return path;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static const std::string path = fuzz_path("mesh.mtl");
  static const std::string mesh = mesh_beside(path);
  fuzz_reader(path, data, size,
              [](struct hsr_scene *scene, const char *, struct hsr_error *err) {
                return hsr_mesh_read(scene, mesh.c_str(), nullptr, err);
              });
  return 0;
}
