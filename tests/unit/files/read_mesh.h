// SPDX-License-Identifier: GPL-3.0-or-later
// What a test reads from a mesh file.
#ifndef HSR_TESTS_READ_MESH_H
#define HSR_TESTS_READ_MESH_H

#include "common/files/mesh/exchange.h"

#include <array>
#include <cstdio>
#include <string>
#include <vector>

namespace {

/* An object that is read; empty if it is refused. What is said has no path. */
struct Read {
  std::vector<double> xyz;
  std::vector<float> rgb;                 /* of its faces, if they differ */
  std::vector<std::array<float, 4>> look; /* of each: colour and opacity */
  std::vector<uint32_t> start, vertex;
  uint64_t n_dropped = 0;
  std::string error, notes;

  explicit Read(const std::string &path, int threads = 1, bool drop = false) {
    struct hsr_scene *scene = hsr_scene_new("");
    struct hsr_import import = {};
    struct hsr_error err = {HSR_OK, ""};
    import.threads = threads;
    import.strict = !drop;
    if (hsr_mesh_read(scene, path.c_str(), &import, &err)) {
      error = err.text;
    } else {
      const struct hsr_object &o = scene->objects[0];
      xyz.assign(o.xyz, o.xyz + 3 * size_t{o.n_vertices});
      start.assign(o.start, o.start + o.n_faces + 1);
      vertex.assign(o.vertex, o.vertex + o.start[o.n_faces]);
      if (o.rgb)
        rgb.assign(o.rgb, o.rgb + 3 * size_t{o.n_faces});
      for (uint32_t f = 0; f < o.n_faces; f++) {
        const float *c = hsr_face_rgb(&o, f);
        look.push_back({c[0], c[1], c[2], hsr_face_opacity(&o, f)});
      }
      n_dropped = import.n_dropped;
      notes = import.notes;
    }
    hsr_scene_delete(scene);
    forget(path, error);
    forget(path, notes);
  }
  bool operator==(const Read &other) const {
    return xyz == other.xyz && rgb == other.rgb && look == other.look &&
           start == other.start && vertex == other.vertex &&
           n_dropped == other.n_dropped && error == other.error &&
           notes == other.notes;
  }
  static void forget(const std::string &path, std::string &text) {
    for (size_t at; (at = text.find(path)) != std::string::npos;)
      text.erase(at, path.size());
  }
  bool says(const char *text) const {
    if (error.find(text) == std::string::npos)
      std::printf("# %s\n", error.c_str());
    return error.find(text) != std::string::npos;
  }
};

} // namespace

#endif
