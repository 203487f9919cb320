// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer target for files of cameras.
#include "common/files/json/scene_json.h"
#include "tests/fuzz/fuzz_reader.h"

/* A scene that the views belong to; without one it could not be finished. */
static void add_triangle(struct hsr_scene *scene) {
  struct hsr_object *object = hsr_scene_object(scene, "triangle");
  const uint32_t corners[] = {0, 1, 2};
  if (!object || hsr_object_vertex(object, 0, 0, 0, nullptr) ||
      hsr_object_vertex(object, 1, 0, 0, nullptr) ||
      hsr_object_vertex(object, 0, 1, 0, nullptr) ||
      hsr_object_face(object, corners, 3, nullptr))
    std::abort();
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static const std::string path = fuzz_path("cameras.json");
  fuzz_reader(
      path, data, size,
      [](struct hsr_scene *scene, const char *name, struct hsr_error *err) {
        add_triangle(scene);
        return hsr_cameras_json_read(scene, name, err);
      });
  return 0;
}
