// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer target for .gltf and .glb files: what a file begins with tells which
// it is. A scene has only faces and places that hsr can lay out; reading it
// strictly gives no more.
#include "common/files/mesh/exchange.h"
#include "tests/fuzz/fuzz_reader.h"

namespace {

/* Whether what was read is one scene: faces are of vertices that are there,
 * instances of objects that are there, in ascending order. */
void check_scene(const struct hsr_scene &scene) {
  for (uint32_t o = 0; o < scene.n_objects; o++) {
    const struct hsr_object &object = scene.objects[o];
    if (!object.n_faces)
      std::abort();
    for (uint32_t k = 0; k < object.start[object.n_faces]; k++)
      if (object.vertex[k] >= object.n_vertices)
        std::abort();
  }
  for (uint32_t i = 0; i < scene.n_instances; i++)
    if (scene.instances[i].object >= scene.n_objects ||
        (i && scene.instances[i].object < scene.instances[i - 1].object))
      std::abort();
}

uint64_t read(const std::string &path, const uint8_t *data, size_t size,
              bool strict) {
  uint64_t n_faces = 0;
  fuzz_reader(
      path, data, size,
      [&](struct hsr_scene *scene, const char *name, struct hsr_error *err) {
        struct hsr_import import = {};
        import.strict = strict;
        const enum hsr_status status = hsr_mesh_read(scene, name, &import, err);
        if (status && (scene->n_objects || scene->n_instances))
          std::abort();
        check_scene(*scene);
        n_faces = hsr_scene_faces(scene);
        return status;
      });
  return n_faces;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static const std::string path = fuzz_path("mesh.gltf");
  if (read(path, data, size, true) > read(path, data, size, false))
    std::abort();
  return 0;
}
