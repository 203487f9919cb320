// SPDX-License-Identifier: GPL-3.0-or-later
// Reads binary .stl files.
//
// Source      3D Systems, "StereoLithography Interface Specification"
// Vertices    a file has no vertex numbers; mesh_corners.cc finds which corners are
//             one vertex
#include "common/base/share.h"
#include "common/files/mesh/mesh_corners.h"
#include "common/files/mesh/mesh_text.h"

#include <cstring>

namespace hsr {
namespace {

constexpr size_t HEADER = 80, COUNT = 4, TRIANGLE = 50, NORMAL = 12;
constexpr uint32_t RANGE = 16384; /* facets for a thread at a time */

uint32_t little_endian(const char *bytes) {
  unsigned char byte[4];
  std::memcpy(byte, bytes, sizeof byte);
  return uint32_t{byte[0]} | uint32_t{byte[1]} << 8 | uint32_t{byte[2]} << 16 |
         uint32_t{byte[3]} << 24;
}

/* The first facet from `from` that is not finite, or `to`. */
uint32_t find_infinite(void *context, uint32_t from, uint32_t to) {
  const char *const first = static_cast<const char *>(context);
  for (uint32_t f = from; f < to; f++)
    for (size_t k = 0; k < 9; k++) {
      constexpr uint32_t EXPONENT = 0x7f800000;
      const char *at = first + TRIANGLE * f + 4 * k;
      if ((little_endian(at) & EXPONENT) == EXPONENT)
        return f;
    }
  return to;
}

} // namespace

void refuse_stl(const Mesh_file &file) {
  if (file.size() < HEADER + COUNT)
    file.refuse(0,
                "is no STL: it neither starts with 'solid' nor has the %zu "
                "bytes of a binary header",
                HEADER + COUNT);
  const size_t n = little_endian(file.begin + HEADER);
  file.refuse(0,
              "is no STL: it does not start with 'solid', and %zu binary "
              "facets take %zu bytes, not %zu",
              n, HEADER + COUNT + TRIANGLE * n, file.size());
}

bool binary_stl_read(Mesh_file &file, Mesh_builder &builder) {
  if (file.size() < HEADER + COUNT)
    return false;
  const size_t n = little_endian(file.begin + HEADER);
  if (file.size() != HEADER + COUNT + TRIANGLE * n)
    return false;
  if (n > static_cast<size_t>(MOST_ELEMENTS))
    file.refuse(0, "%zu facets are more than can be read", n);
  char *const first = file.begin + HEADER + COUNT + NORMAL;
  const uint32_t finite = hsr_share_search(builder.threads(), uint32_t(n),
                                           RANGE, find_infinite, first);
  builder.reserve(0, finite);
  give_loose_triangles<float>({first, TRIANGLE, finite}, builder);
  if (finite < n)
    file.refuse(0, "facet %u has a coordinate that is not finite", finite);
  return true;
}

} // namespace hsr
