/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The real meshes of Debian's libcgal-demo.
 *
 * The package ships them in one archive. A mesh is taken out of it when it is
 * first asked for, and kept in $XDG_CACHE_HOME/hsr/meshes or
 * $HOME/.cache/hsr/meshes. If HSR_MESH_DIR is set, that folder is used instead
 * of both. */
#ifndef HSR_SCENES_MESHES_H
#define HSR_SCENES_MESHES_H

#include "common/base/names.h"
#include "scenes/scenes.h"

/* Stores the path of a mesh file in *path, malloc'ed and the caller's. The name
 * may have its suffix or not. HSR_E_INPUT: it is no possible name, there is no
 * such mesh, or the mesh cannot be read; HSR_E_NOMEM. */
enum hsr_status hsr_mesh_find(const char *name, char **path,
                              struct hsr_error *err);

#endif
