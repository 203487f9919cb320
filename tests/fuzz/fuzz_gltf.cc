// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer target for .gltf and .glb files: what a file begins with tells which
// it is. What is read is one scene, and a failure leaves nothing.
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

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static const std::string path = fuzz_path("mesh.gltf");
  const bool strict = size && data[size / 2] % 4 == 0;
  fuzz_reader(
      path, data, size,
      [&](struct hsr_scene *scene, const char *name, struct hsr_error *err) {
        struct hsr_import import = {};
        import.strict = strict;
        const enum hsr_status status = hsr_mesh_read(scene, name, &import, err);
        if (status && (scene->n_objects || scene->n_instances))
          std::abort();
        check_scene(*scene);
        return status;
      });
  return 0;
}
