// SPDX-License-Identifier: GPL-3.0-or-later
// Mesh files, by their suffixes. Each format has its reader, mesh_*.cc;
// common/files/vtk has that of .vtp.
//
// Memory      the file and the object at once; what else a reader takes, it
//             says
#include "common/files/mesh/exchange.h"
#include "common/files/mesh/mesh_file.h"

#include <cctype>
#include <cstring>
#include <exception>
#include <new>
#include <utility>

namespace {

using hsr::Mesh_builder;
using hsr::Mesh_file;
using hsr::Refused;

/* ---- By suffix ---- */

struct Suffix {
  const char *text;
  void (*reader)(Mesh_file &, Mesh_builder &);
};

constexpr Suffix SUFFIXES[] = {{".off", hsr::off_read},
                               {".obj", hsr::obj_read},
                               {".ply", hsr::ply_read},
                               {".stl", hsr::stl_read},
                               {".vtp", hsr::vtp_read}};

const char *file_name(const char *path) {
  const char *slash = std::strrchr(path, '/');
  return slash ? slash + 1 : path;
}

/* Where the suffix of a file name starts: its last dot, or its end. */
const char *suffix_of(const char *name) {
  const char *dot = std::strrchr(name, '.');
  return dot ? dot : name + std::strlen(name);
}

const Suffix &find_suffix(const Mesh_file &file) {
  std::string text = suffix_of(file_name(file.path));
  for (char &c : text)
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const Suffix &suffix : SUFFIXES)
    if (text == suffix.text)
      return suffix;
  file.refuse(0,
              "'%s' is not the suffix of a mesh file (.off .obj .ply .stl "
              ".vtp)",
              hsr::shown_word(text).c_str());
}

/* ---- The new object ---- */

/* A scene of one object, which is made here and then moved, so that a failure
 * leaves the caller's scene as it was. */
class Workshop {
public:
  explicit Workshop(const std::string &name) : scene_(hsr_scene_new("")) {
    object = scene_ ? hsr_scene_object(scene_, name.c_str()) : nullptr;
    if (!object) {
      hsr_scene_delete(scene_);
      throw std::bad_alloc();
    }
  }
  ~Workshop() { hsr_scene_delete(scene_); }
  Workshop(const Workshop &) = delete;
  Workshop &operator=(const Workshop &) = delete;

  void deliver(struct hsr_scene *scene) {
    struct hsr_object *place = hsr_scene_object(scene, "");
    if (!place)
      throw std::bad_alloc();
    std::swap(*place, *object);
  }

  struct hsr_object *object;

private:
  struct hsr_scene *scene_;
};

void add_note(struct hsr_import *import, const std::string &line) {
  const size_t used = std::strlen(import->notes);
  if (used + line.size() < sizeof import->notes)
    std::memcpy(import->notes + used, line.c_str(), line.size() + 1);
}

void mesh_read(struct hsr_scene *scene, const char *path,
               struct hsr_import *import) {
  const bool strict = import && import->strict;
  const Suffix &suffix = find_suffix({path, nullptr, nullptr, nullptr});
  Mesh_file file = hsr::load_mesh_file(path);
  const char *name = file_name(path);
  Workshop workshop(std::string(name, suffix_of(name)));
  Mesh_builder builder(workshop.object, path, strict,
                       import ? import->threads : 1);
  suffix.reader(file, builder);
  file.memory.reset();
  if (!builder.n_given())
    file.refuse(0, "holds no face");
  builder.settle_unused();
  builder.leave_out_flat();
  if (!workshop.object->n_faces)
    file.refuse(0, "none of its %llu faces has an area",
                static_cast<unsigned long long>(builder.n_given()));
  bool solid = builder.one_sided();
  if (!builder.says_sides() &&
      hsr_object_is_solid(workshop.object, builder.threads(), &solid))
    throw std::bad_alloc();
  workshop.object->one_sided = solid && !(import && import->two_sided);
  workshop.deliver(scene);
  if (!import)
    return;
  import->n_dropped = builder.n_dropped();
  for (const std::string &note : builder.notes())
    add_note(import, std::string(hsr::shown_path(path)) + ": " + note + "\n");
}

/* Runs `body`; what it throws becomes a status. */
template <class Body>
enum hsr_status guarded(const char *path, struct hsr_error *err,
                        const Body &body) noexcept {
  try {
    body();
    return HSR_OK;
  } catch (const Refused &refused) {
    if (err)
      *err = refused.error;
    return refused.error.status;
  } catch (const std::bad_alloc &) {
    return hsr_fail_nomem(err);
  } catch (const std::exception &fault) {
    return hsr_fail(err, HSR_E_INTERNAL, "%s: %.150s", hsr::shown_path(path),
                    fault.what());
  } catch (...) {
    return hsr_fail(err, HSR_E_INTERNAL, "%s: a reader failed",
                    hsr::shown_path(path));
  }
}

} // namespace

enum hsr_status hsr_mesh_read(struct hsr_scene *scene, const char *path,
                              struct hsr_import *import,
                              struct hsr_error *err) {
  if (import)
    import->n_dropped = 0;
  return guarded(path, err, [&] { mesh_read(scene, path, import); });
}
