// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/files/gltf/gltf_file.h"
#include "common/files/mesh/mesh_scene.h"

void hsr::gltf_read(Mesh_file &file, Mesh_scene &) {
  Gltf_file(file).file().refuse(0, "is not read yet");
}
