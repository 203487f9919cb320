// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/files/mesh/mesh_scene.h"
#include "common/files/mesh/mesh_groups.h"

#include <cstring>
#include <memory>
#include <new>

namespace hsr {

Mesh_scene::Mesh_scene(const char *path, const struct hsr_import *import)
    : path_(path), strict_(import && import->strict),
      two_sided_(import && import->two_sided), weld_(import ? import->weld : 0),
      threads_(import ? import->threads : 1), scene_(hsr_scene_new("")) {
  if (!scene_)
    throw std::bad_alloc();
}

/* Of groups of a mesh that is not closed, some may be so on their own. */
void Mesh_scene::find_sides(struct hsr_scene &groups) const {
  for (uint32_t g = 0; g < groups.n_objects; g++) {
    bool solid = false;
    if (hsr_object_is_solid(&groups.objects[g], threads_, &solid))
      throw std::bad_alloc();
    groups.objects[g].one_sided = solid && !two_sided_;
  }
}

uint32_t Mesh_scene::object(const std::string &name,
                            const std::function<void(Mesh_builder &)> &fill) {
  const std::unique_ptr<struct hsr_scene, void (*)(struct hsr_scene *)> one(
      hsr_scene_new(""), hsr_scene_delete);
  struct hsr_object *object =
      one ? hsr_scene_object(one.get(), name.c_str()) : nullptr;
  if (!object)
    throw std::bad_alloc();
  Mesh_builder builder(object, path_, strict_, threads_);
  fill(builder);
  builder.settle_unused();
  if (weld_ > 0)
    builder.weld(weld_);
  builder.leave_out_flat();
  n_given_ += builder.n_given();
  n_dropped_ += builder.n_dropped();
  notes_.insert(notes_.end(), builder.notes().begin(), builder.notes().end());
  if (!object->n_faces)
    return NONE;
  bool solid = builder.one_sided();
  if (!builder.says_sides() && hsr_object_is_solid(object, threads_, &solid))
    throw std::bad_alloc();
  object->one_sided = solid && !two_sided_;
  const Divided groups = divide_mesh(*object, builder.groups());
  if (groups && !solid && !builder.says_sides())
    find_sides(*groups);
  if (hsr_scene_take(scene_, groups ? groups.get() : one.get()))
    throw std::bad_alloc();
  return scene_->n_objects - 1;
}

void Mesh_scene::instance(uint32_t object, const double m[12]) {
  switch (hsr_scene_instance(scene_, object, m)) {
  case HSR_OK:
    return;
  case HSR_E_NOMEM:
    throw std::bad_alloc();
  default:
    const Mesh_file file{path_, nullptr, nullptr, nullptr};
    file.refuse(0, "the place of object '%.60s' is not finite",
                scene_->objects[object].name);
  }
}

bool Mesh_scene::view(const struct hsr_camera &camera, struct hsr_error *why) {
  if (hsr_camera_check(&camera, why))
    return false;
  if (hsr_scene_view(scene_, &camera))
    throw std::bad_alloc();
  return true;
}

namespace {

void add_note(struct hsr_import *import, const std::string &line) {
  const size_t used = std::strlen(import->notes);
  if (used + line.size() < sizeof import->notes)
    std::memcpy(import->notes + used, line.c_str(), line.size() + 1);
}

} // namespace

void Mesh_scene::deliver(struct hsr_scene *scene, struct hsr_import *import) {
  const Mesh_file file{path_, nullptr, nullptr, nullptr};
  if (!n_given_)
    file.refuse(0, "holds no face%s%.150s", notes_.empty() ? "" : ": ",
                notes_.empty() ? "" : notes_.back().c_str());
  if (!scene_->n_objects)
    file.refuse(0, "none of its %llu faces has an area",
                static_cast<unsigned long long>(n_given_));
  if (hsr_scene_take(scene, scene_))
    throw std::bad_alloc();
  if (!import)
    return;
  import->n_dropped = n_dropped_;
  for (const std::string &note : notes_)
    add_note(import, std::string(shown_path(path_)) + ": " + note + "\n");
}

} // namespace hsr
