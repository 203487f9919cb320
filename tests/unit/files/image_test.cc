// SPDX-License-Identifier: GPL-3.0-or-later
// Image files, written and read back.
#include "common/files/image.h"
#include "tests/tap.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imageio.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>
#include <unistd.h>

namespace {

/*   3 x 2 pixels:   0 1 background
 *                   ids with all bits in use      */
constexpr int M = 3, N = 2;
const uint32_t IDS[M * N] = {0,          1,          HSR_BACKGROUND,
                             0x80000000, 0x01020304, 0xfffffffe};
const float DEPTH[M * N] = {1, 2.5f, INFINITY, 1e-30f, 3e30f, 7};
const float RGB[3 * M * N] = {0, 0, 0, 1,    1,    1,    0.5f, 0.25f, 0.125f,
                              1, 0, 0, 0.2f, 0.4f, 0.6f, 2,    -1,    0.01f};

std::string directory() {
  char name[] = "/tmp/hsr-image-XXXXXX";
  return mkdtemp(name) ? name : "";
}

void try_exr(tap *t, const std::string &dir) {
  const std::string path = dir + "/a.exr";
  const hsr_picture picture = {M, N, IDS, DEPTH, RGB, nullptr};
  hsr_error err;
  ok(t, !hsr_image_write(path.c_str(), &picture, "Scene=a b\n", &err),
     "an .exr is written");
  auto in = OIIO::ImageInput::open(path);
  bool good = in && in->spec().nchannels == 5;
  ok(t, good, "it has five channels");
  if (!good)
    return;
  const OIIO::ImageSpec &spec = in->spec();
  ok(t, spec.width == M && spec.height == N, "its size is right");
  ok(t, spec.get_string_attribute("Scene") == "a b", "its text is there");
  const int z = spec.channelindex("Z"), id = spec.channelindex("id");
  ok(t, z >= 0 && id >= 0 && spec.channelformat(id) == OIIO::TypeDesc::UINT32,
     "Z and id are there, id as 32-bit unsigned");
  uint32_t ids[M * N];
  float depth[M * N], red[M * N];
  in->read_image(0, 0, id, id + 1, OIIO::TypeDesc::UINT32, ids);
  in->read_image(0, 0, z, z + 1, OIIO::TypeDesc::FLOAT, depth);
  const int r = spec.channelindex("R");
  in->read_image(0, 0, r, r + 1, OIIO::TypeDesc::FLOAT, red);
  ok(t, !std::memcmp(ids, IDS, sizeof ids), "every bit of the ids survives");
  ok(t, !std::memcmp(depth, DEPTH, sizeof depth), "so do the depths");
  ok(t, red[1] == 1 && red[2] == 0.5f && red[5] == 2, "and the colours");
}

void try_png(tap *t, const std::string &dir) {
  const std::string path = dir + "/a.png";
  const hsr_picture picture = {M, N, IDS, DEPTH, RGB, nullptr};
  hsr_error err;
  ok(t, !hsr_image_write(path.c_str(), &picture, nullptr, &err),
     "a .png is written");
  unsigned char bytes[3 * M * N] = {0};
  auto in = OIIO::ImageInput::open(path);
  ok(t, in && in->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, bytes),
     "and read back");
  /* 0.5, 0.25, 0.125 encoded: 188, 137, 99 of 255. */
  ok(t,
     bytes[0] == 0 && bytes[3] == 255 && bytes[6] == 188 && bytes[7] == 137 &&
         bytes[8] == 99,
     "its colours are sRGB: %d %d %d", bytes[6], bytes[7], bytes[8]);
  ok(t, bytes[15] == 255 && bytes[16] == 0, "out of range is clamped");
}

void try_work(tap *t, const std::string &dir) {
  const float work[M * N] = {0, 1, 2, 3, 4, 5};
  hsr_error err;
  ok(t, !hsr_image_write_work((dir + "/w.exr").c_str(), M, N, work, &err),
     "a work picture as .exr");
  float read[M * N] = {0};
  auto in = OIIO::ImageInput::open(dir + "/w.exr");
  ok(t,
     in && in->read_image(0, 0, 0, 1, OIIO::TypeDesc::FLOAT, read) &&
         !std::memcmp(read, work, sizeof read),
     "holds the numbers");
  ok(t, !hsr_image_write_work((dir + "/w.png").c_str(), M, N, work, &err),
     "a work picture as .png");
  unsigned char bytes[3 * M * N] = {0};
  auto png = OIIO::ImageInput::open(dir + "/w.png");
  bool rising =
      png && png->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, bytes);
  for (int k = 1; k < M * N; k++)
    rising =
        rising && bytes[3 * k] + bytes[3 * k + 1] + bytes[3 * k + 2] >
                      bytes[3 * k - 3] + bytes[3 * k - 2] + bytes[3 * k - 1];
  ok(t, rising, "gets brighter with the work");
  const float half[M * N] = {0.5};
  ok(t, !hsr_image_write_ramp((dir + "/r.png").c_str(), M, N, half, &err),
     "a ramp as .png");
  auto ramp = OIIO::ImageInput::open(dir + "/r.png");
  ok(t,
     ramp && ramp->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, bytes) &&
         bytes[0] == 188 && bytes[1] == 55 && bytes[2] == 84,
     "its middle is inferno's #bc3754: %d %d %d", bytes[0], bytes[1], bytes[2]);
}

void try_failures(tap *t, const std::string &dir) {
  const hsr_picture picture = {M, N, IDS, DEPTH, RGB, nullptr};
  const char *const names[] = {"/a.xyz", "/a", "/none/a.png", "/none/a.exr"};
  for (const char *name : names) {
    hsr_error err = {HSR_OK, ""};
    const std::string path = dir + name;
    const hsr_status status =
        hsr_image_write(path.c_str(), &picture, nullptr, &err);
    ok(t,
       status == HSR_E_INPUT &&
           !std::strncmp(err.text, path.c_str(), path.size()),
       "%s is refused: %s", name, err.text);
  }
}

} // namespace

int main() {
  struct tap t = plan(22);
  const std::string dir = directory();
  try_exr(&t, dir);
  try_png(&t, dir);
  try_work(&t, dir);
  try_failures(&t, dir);
  const std::string clean = "rm -rf '" + dir + "'";
  return finish(&t) | (std::system(clean.c_str()) != 0);
}
