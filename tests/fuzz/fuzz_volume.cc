// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer target for a reader of volumes. -DHSR_FUZZ_SUFFIX chooses it:
// '".vtk"'.
#include "common/files/volume/volume.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static const std::string path = fuzz_path("volume" HSR_FUZZ_SUFFIX);
  fuzz_reader(
      path, data, size,
      [&](struct hsr_scene *scene, const char *name, struct hsr_error *err) {
        return hsr_volume_read(scene, name, nullptr, err);
      });
  return 0;
}
