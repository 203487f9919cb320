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

#include <stdio.h>

#ifndef HSR_MESH_ARCHIVE
#define HSR_MESH_ARCHIVE "/usr/share/doc/libcgal-dev/data.tar.gz"
#endif

/* Stores the path of a mesh file in *path, malloc'ed and the caller's. The name
 * may have its suffix or not. HSR_E_INPUT: it is no possible name, there is no
 * such mesh, or the mesh cannot be read; HSR_E_NOMEM. */
enum hsr_status hsr_mesh_find(const char *name, char **path,
                              struct hsr_error *err);

/* For mesh_faces.c: the user's folder of meshes, or NULL. */
const char *hsr_mesh_folder(void);

/* The folder in which meshes of the archive are kept, made when needed, ending in
 * a slash; malloc'ed. HSR_E_INPUT, HSR_E_NOMEM. */
enum hsr_status hsr_mesh_cache(char **folder, struct hsr_error *err);

/* Whether a path in the archive is that of a mesh. */
bool hsr_mesh_is_file(const char *path);

/* Lists the archive's meshes, or takes them out one after the other, as tar's
 * `mode` says. The text or the bytes go to `out`, which is rewound then.
 * HSR_E_INPUT. */
enum hsr_status hsr_mesh_tar(const char *mode, FILE *out,
                             struct hsr_error *err);

#endif
