// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/files/mesh/mesh_colours.h"
#include "common/files/srgb.h"

#include <algorithm>

namespace hsr {

Rgba rgba_of_file(const Rgba &encoded) {
  Rgba rgba;
  for (size_t k = 0; k < 4; k++)
    rgba[k] = std::min(std::max(encoded[k], 0.0f), 1.0f);
  for (size_t k = 0; k < 3; k++)
    rgba[k] = hsr_srgb_decode(rgba[k]);
  if (encoded[3] == NO_OPACITY)
    rgba[3] = 1;
  return rgba;
}

void decode_all(std::vector<Rgba> &colours) {
  const bool bytes =
      std::any_of(colours.begin(), colours.end(), [](const Rgba &c) {
        return std::any_of(c.begin(), c.end(), [](float v) { return v > 1; });
      });
  for (Rgba &colour : colours) {
    for (float &value : colour)
      if (bytes && value != NO_OPACITY)
        value /= 255;
    colour = rgba_of_file(colour);
  }
}

bool have_colours(size_t n, size_t n_vertices, Mesh_builder &builder) {
  if (n && n < n_vertices)
    builder.note("colours of vertices are passed over: " + std::to_string(n) +
                 " of " + std::to_string(n_vertices) + " have one");
  return n == n_vertices;
}

const Rgba *mean_colour(const std::vector<Rgba> &of_vertices,
                        const uint32_t *corners, size_t n, Rgba *mean) {
  if (of_vertices.empty() || !n)
    return nullptr;
  for (size_t k = 0; k < 4; k++) {
    double sum = 0;
    for (size_t i = 0; i < n; i++)
      sum += double{of_vertices[corners[i]][k]};
    (*mean)[k] = static_cast<float>(sum / static_cast<double>(n));
  }
  return mean;
}

} // namespace hsr
