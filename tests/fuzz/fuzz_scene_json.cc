// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer target for .scene.json: as it is, in a frame that its last byte
// says, and from that frame to the next.
#include "common/files/json/scene_json.h"
#include "common/scene/motion.h"
#include "tests/fuzz/fuzz_reader.h"

namespace {

enum hsr_status read_frame(struct hsr_scene *scene, const char *name,
                           long frame, struct hsr_error *err) {
  enum hsr_status status =
      hsr_scene_json_read_frame(scene, name, frame, nullptr, err);
  return status ? status : hsr_scene_finish(scene, err);
}

// Both are of one file: they have the same objects.
void follow(const std::string &path, long frame) {
  struct hsr_scene *scene = hsr_scene_new("fuzz"),
                   *then = hsr_scene_new("fuzz");
  struct hsr_error err = {HSR_OK, ""};
  if (!read_frame(scene, path.c_str(), frame, &err) &&
      !read_frame(then, path.c_str(), frame + 1, &err)) {
    fuzz_check(hsr_scene_follow(scene, then, &err), err);
    if (!hsr_scene_has_objects(scene, then))
      std::abort();
    double lo[3], hi[3];
    for (uint32_t i = 0; i < scene->n_instances; i++)
      hsr_scene_way(scene, i, (double)frame, (double)frame + 1, lo, hi);
  }
  hsr_scene_delete(scene);
  hsr_scene_delete(then);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static const std::string path = fuzz_path("fuzz.scene.json");
  const long frame = size ? (long)data[size - 1] - 16 : 0;
  fuzz_reader(
      path, data, size,
      [](struct hsr_scene *scene, const char *name, struct hsr_error *err) {
        return hsr_scene_json_read(scene, name, nullptr, err);
      });
  follow(path, frame);
  return 0;
}
