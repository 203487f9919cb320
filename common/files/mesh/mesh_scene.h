// SPDX-License-Identifier: GPL-3.0-or-later
// What a mesh file adds to a scene. Only for common/files/mesh and
// common/files/gltf.
#ifndef HSR_COMMON_MESH_SCENE_H
#define HSR_COMMON_MESH_SCENE_H

#include "common/files/mesh/exchange.h"
#include "common/files/mesh/mesh_file.h"

#include <functional>
#include <string>
#include <vector>

namespace hsr {

/* The objects, instances and views of one file. They are made in a scene of
 * their own and then moved, so that a failure leaves the caller's scene as it
 * was. Functions throw Refused and std::bad_alloc. */
class Mesh_scene {
public:
  /* `path` and `import` are borrowed. NULL: all is standard. */
  Mesh_scene(const char *path, const struct hsr_import *import);
  ~Mesh_scene() { hsr_scene_delete(scene_); }
  Mesh_scene(const Mesh_scene &) = delete;
  Mesh_scene &operator=(const Mesh_scene &) = delete;

  static constexpr uint32_t NONE = UINT32_MAX;
  /* Makes an object of what `fill` gives to the builder, or one of each group.
   * Returns the number of the last, or NONE if no face has an area. */
  uint32_t object(const std::string &name,
                  const std::function<void(Mesh_builder &)> &fill);
  /* Places an object. Objects must be placed in ascending order. */
  void instance(uint32_t object, const double m[12]);
  /* Adds a view. False, with the reason in *why, if it is no camera. */
  bool view(const struct hsr_camera &camera, struct hsr_error *why);
  /* Adds a line about something in the file that was ignored. */
  void note(const std::string &text) { notes_.push_back(text); }

  /* The number of faces that were given in all. */
  uint64_t n_given() const { return n_given_; }
  /* Moves all of it to the end of a scene. Refuses a file without a face that
   * has an area. `import`, which may be NULL, gets the counts and the notes. */
  void deliver(struct hsr_scene *scene, struct hsr_import *import);

private:
  void find_sides(struct hsr_scene &groups) const;

  const char *path_;
  const bool strict_, two_sided_;
  const double weld_; /* 0: no vertices are joined */
  const int threads_;
  struct hsr_scene *scene_;
  uint64_t n_given_ = 0, n_dropped_ = 0;
  std::vector<std::string> notes_;
};

/* Reads .gltf and .glb (common/files/gltf). Throws as the readers of one
 * object do. */
void gltf_read(Mesh_file &file, Mesh_scene &scene);

} // namespace hsr

#endif
