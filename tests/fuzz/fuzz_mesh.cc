// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer target for a mesh reader. -DHSR_FUZZ_SUFFIX chooses it: '".off"'.
#include "common/files/mesh/exchange.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static const std::string path = fuzz_path("mesh" HSR_FUZZ_SUFFIX);
  struct hsr_import import = {size % 2 == 1, 0};
  fuzz_reader(
      path, data, size,
      [&](struct hsr_scene *scene, const char *name, struct hsr_error *err) {
        return hsr_mesh_read(scene, name, &import, err);
      });
  return 0;
}
