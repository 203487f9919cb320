// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer target for palette files.
#include "common/files/json/palette_json.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static const std::string path = fuzz_path("palette.json");
  fuzz_write(path, data, size);
  struct hsr_palette palette;
  struct hsr_error err = {HSR_OK, ""};
  enum hsr_status status = hsr_palette_json_read(path.c_str(), &palette, &err);
  fuzz_check(status, err);
  if (status)
    return 0;
  long length = 0;
  for (int a = 0; a < 3; a++)
    length += (long)palette.light[a] * palette.light[a];
  if (palette.exponent < 1 || palette.exponent > 128 ||
      (!palette.eye_light && (length < 1000000 || length > 1100000)))
    std::abort();
  return 0;
}
