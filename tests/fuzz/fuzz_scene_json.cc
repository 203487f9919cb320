// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer target for .scene.json: any bytes must give a scene or one line.

#include "common/scene_json.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <unistd.h>

namespace {

const std::string &path() {
  static const std::string name = [] {
    char directory[] = "/tmp/hsr-fuzz-XXXXXX";
    if (!mkdtemp(directory))
      std::abort();
    return std::string(directory) + "/fuzz.scene.json";
  }();
  return name;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  std::FILE *file = std::fopen(path().c_str(), "wb");
  if (!file || std::fwrite(data, 1, size, file) != size || std::fclose(file))
    std::abort();
  struct hsr_scene *scene = hsr_scene_new("fuzz");
  struct hsr_error err = {HSR_OK, ""};
  if (!scene)
    return 0;
  enum hsr_status status =
      hsr_scene_json_read(scene, path().c_str(), nullptr, &err);
  if (status == HSR_OK)
    status = hsr_scene_finish(scene, &err);
  if (status != HSR_OK && (!err.text[0] || std::strchr(err.text, '\n')))
    std::abort();
  if (status == HSR_E_INTERNAL)
    std::abort();
  hsr_scene_delete(scene);
  return 0;
}
