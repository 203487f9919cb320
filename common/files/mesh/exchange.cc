// SPDX-License-Identifier: GPL-3.0-or-later
// Mesh files, by their suffixes. The readers are in common/files/formats and gltf;
// common/files/vtk has that of .vtp.
//
// Memory      the file and its objects at once; what else a reader takes, it
//             says
#include "common/files/mesh/exchange.h"
#include "common/files/mesh/mesh_scene.h"

#include <algorithm>
#include <cstring>
#include <exception>
#include <new>
#include <strings.h>

namespace {

using hsr::Mesh_builder;
using hsr::Mesh_file;
using hsr::Mesh_scene;
using hsr::Refused;

/* ---- By suffix ---- */

const char *file_name(const char *path) {
  const char *slash = std::strrchr(path, '/');
  return slash ? slash + 1 : path;
}

/* A file name without the suffix .gz, by which a compressed file is known. */
std::string plain_name(const char *path) {
  constexpr size_t GZ = 3;
  const std::string name = file_name(path);
  const size_t n = name.size();
  return n > GZ && !strcasecmp(name.c_str() + n - GZ, ".gz")
             ? name.substr(0, n - GZ)
             : name;
}

/* Where the suffix of such a name starts: its last dot, or its end. */
size_t suffix_of(const std::string &name) {
  return std::min(name.rfind('.'), name.size());
}

/* A reader of a format whose files hold one object, named after the file. The
 * file's bytes are not needed once the object is filled. */
template <void read(Mesh_file &, Mesh_builder &)>
void one_object(Mesh_file &file, Mesh_scene &scene) {
  const std::string name = plain_name(file.path);
  scene.object(name.substr(0, suffix_of(name)), [&](Mesh_builder &builder) {
    read(file, builder);
    file.memory.reset();
  });
}

struct Suffix {
  const char *text;
  void (*reader)(Mesh_file &, Mesh_scene &);
};

constexpr Suffix SUFFIXES[] = {{".off", one_object<hsr::off_read>},
                               {".obj", one_object<hsr::obj_read>},
                               {".ply", one_object<hsr::ply_read>},
                               {".stl", one_object<hsr::stl_read>},
                               {".vtp", one_object<hsr::vtp_read>},
                               {".gltf", hsr::gltf_read},
                               {".glb", hsr::gltf_read}};

/* NULL: it is none of a mesh file. */
const Suffix *find_suffix(const std::string &name) {
  for (const Suffix &suffix : SUFFIXES)
    if (!strcasecmp(name.c_str() + suffix_of(name), suffix.text))
      return &suffix;
  return nullptr;
}

void mesh_read(struct hsr_scene *scene, const char *path,
               struct hsr_import *import) {
  const std::string name = plain_name(path);
  const Suffix *suffix = find_suffix(name);
  if (!suffix) {
    const Mesh_file file{path, nullptr, nullptr, nullptr};
    file.refuse(0,
                "'%s' is not the suffix of a mesh file (.off .obj .ply .stl "
                ".vtp .gltf .glb)",
                hsr::shown_word(name.substr(suffix_of(name))).c_str());
  }
  Mesh_file file = hsr::load_mesh_file(path);
  Mesh_scene read(path, import);
  suffix->reader(file, read);
  read.deliver(scene, import);
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

bool hsr_is_mesh_name(const char *path) {
  return find_suffix(plain_name(path));
}

enum hsr_status hsr_mesh_read(struct hsr_scene *scene, const char *path,
                              struct hsr_import *import,
                              struct hsr_error *err) {
  if (import)
    import->n_dropped = 0;
  return guarded(path, err, [&] { mesh_read(scene, path, import); });
}
