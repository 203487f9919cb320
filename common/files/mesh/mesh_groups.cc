// SPDX-License-Identifier: GPL-3.0-or-later
// A mesh whose file names groups of its faces: each becomes an object.
//
// Faces       keep their order. So a name that comes back after another one makes
//             another object.
// Vertices    each object has those that its faces use. hsr_group says which they
//             are in the mesh, so in the world they are those of the file again.
//             Vertices that no face uses go with the first object.
// Cost        proportional to the corners, and sorting them by vertex
#include "common/files/mesh/mesh_groups.h"

#include <algorithm>
#include <new>
#include <cstdlib>
#include <cstring>

namespace hsr {
namespace {

void must(enum hsr_status status) {
  if (status)
    throw std::bad_alloc();
}

class Divider {
public:
  Divider(const struct hsr_object &mesh, struct hsr_scene *to, uint32_t of)
      : mesh_(mesh), to_(to), of_(of), met_(mesh.n_vertices, NONE),
        local_(mesh.n_vertices) {}
  /* Appends the group of the faces from `first` to `end`. */
  void add(const std::string &name, uint32_t first, uint32_t end);

private:
  static constexpr uint32_t NONE = UINT32_MAX;

  void find_vertices(uint32_t first, uint32_t end);
  void add_unused();
  void take(struct hsr_object &object, const std::vector<uint32_t> &vertices);
  void copy_face(struct hsr_object &object, uint32_t f);
  void set_group(struct hsr_object &object) const;

  const struct hsr_object &mesh_;
  struct hsr_scene *const to_;
  const uint32_t of_;
  uint32_t number_ = 0;             /* of the group */
  std::vector<uint32_t> met_;       /* by vertex: the last group that has it */
  std::vector<uint32_t> local_;     /* its number in that group */
  std::vector<uint32_t> own_, old_; /* vertices that no group before this one
                                       has; and the others */
  std::vector<uint32_t> ring_;
};

/* The vertices of the group, ascending. */
void Divider::find_vertices(uint32_t first, uint32_t end) {
  own_.clear();
  old_.clear();
  for (uint32_t k = mesh_.start[first]; k < mesh_.start[end]; k++) {
    const uint32_t v = mesh_.vertex[k];
    if (met_[v] == number_)
      continue;
    (met_[v] == NONE ? own_ : old_).push_back(v);
    met_[v] = number_;
  }
  if (number_ == 0)
    add_unused();
  std::sort(own_.begin(), own_.end());
  std::sort(old_.begin(), old_.end());
}

void Divider::add_unused() {
  std::vector<bool> used(mesh_.n_vertices);
  for (uint32_t k = 0; k < mesh_.start[mesh_.n_faces]; k++)
    used[mesh_.vertex[k]] = true;
  for (uint32_t v = 0; v < mesh_.n_vertices; v++)
    if (!used[v]) {
      own_.push_back(v);
      met_[v] = number_;
    }
}

void Divider::take(struct hsr_object &object,
                   const std::vector<uint32_t> &vertices) {
  for (const uint32_t v : vertices) {
    const double *p = mesh_.xyz + 3 * size_t{v};
    must(hsr_object_vertex(&object, p[0], p[1], p[2], &local_[v]));
  }
}

void Divider::copy_face(struct hsr_object &object, uint32_t f) {
  ring_.clear();
  for (uint32_t k = mesh_.start[f]; k < mesh_.start[f + 1]; k++)
    ring_.push_back(local_[mesh_.vertex[k]]);
  must(hsr_object_face(&object, ring_.data(), ring_.size(),
                       mesh_.rgb ? mesh_.rgb + 3 * size_t{f} : nullptr));
  must(hsr_object_set_opacity(&object, object.n_faces - 1,
                              hsr_face_opacity(&mesh_, f)));
}

void Divider::set_group(struct hsr_object &object) const {
  struct hsr_group &group = object.group;
  group.vertex = static_cast<uint32_t *>(
      malloc((size_t{object.n_vertices} + 1) * sizeof *group.vertex));
  if (!group.vertex)
    throw std::bad_alloc();
  std::copy(old_.begin(), old_.end(),
            std::copy(own_.begin(), own_.end(), group.vertex));
  group.n_own = static_cast<uint32_t>(own_.size());
  group.number = number_;
  group.of = of_;
  group.n_vertices = mesh_.n_vertices;
}

void Divider::add(const std::string &name, uint32_t first, uint32_t end) {
  struct hsr_object *object = hsr_scene_object(to_, name.c_str());
  if (!object)
    throw std::bad_alloc();
  std::copy_n(mesh_.colour, 3, object->colour);
  object->opacity = mesh_.opacity;
  object->one_sided = mesh_.one_sided;
  find_vertices(first, end);
  must(hsr_object_reserve(
      object, static_cast<uint32_t>(own_.size() + old_.size()), end - first));
  take(*object, own_);
  take(*object, old_);
  for (uint32_t f = first; f < end; f++)
    copy_face(*object, f);
  set_group(*object);
  number_++;
}

struct Run {
  const std::string *name;
  uint32_t first, end; /* faces */
};

/* The groups that have faces. Such as follow one another and have one name are
 * one. */
std::vector<Run> find_runs(const Groups &groups, uint32_t n_faces) {
  std::vector<Run> runs;
  for (size_t g = 0; g < groups.name.size(); g++) {
    const uint32_t first = groups.first[g], end = g + 1 < groups.name.size()
                                                      ? groups.first[g + 1]
                                                      : n_faces;
    if (first == end)
      continue;
    if (!runs.empty() && *runs.back().name == groups.name[g])
      runs.back().end = end;
    else
      runs.push_back({&groups.name[g], first, end});
  }
  return runs;
}

} // namespace

Divided divide_mesh(struct hsr_object &mesh, const Groups &groups) {
  const std::vector<Run> runs = find_runs(groups, mesh.n_faces);
  if (runs.empty())
    return nullptr;
  if (runs.size() == 1) {
    char *name = strdup(runs[0].name->c_str());
    if (!name)
      throw std::bad_alloc();
    free(mesh.name);
    mesh.name = name;
    return nullptr;
  }
  Divided scene(hsr_scene_new(""));
  if (!scene)
    throw std::bad_alloc();
  Divider divider(mesh, scene.get(), static_cast<uint32_t>(runs.size()));
  for (const Run &run : runs)
    divider.add(*run.name, run.first, run.end);
  return scene;
}

} // namespace hsr
