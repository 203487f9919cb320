// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer target for .scene.json.
#include "common/files/scene_json.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static const std::string path = fuzz_path("fuzz.scene.json");
  fuzz_reader(
      path, data, size,
      [](struct hsr_scene *scene, const char *name, struct hsr_error *err) {
        return hsr_scene_json_read(scene, name, nullptr, err);
      });
  return 0;
}
