/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The real meshes of Debian's libcgal-demo.
 *
 * The package ships them in one archive. A mesh is taken out of it when it is
 * first asked for, and kept in $XDG_CACHE_HOME/hsr/meshes or
 * $HOME/.cache/hsr/meshes. If HSR_MESH_DIR is set, that folder is used instead
 * of both. */
#ifndef HSR_SCENES_MESHES_H
#define HSR_SCENES_MESHES_H

#include "scenes/scenes.h"

/* Stores the path of a mesh file in *path, malloc'ed and the caller's. The name
 * may have its suffix or not. HSR_E_INPUT: it is no possible name, there is no
 * such mesh, or the mesh cannot be read; HSR_E_NOMEM. */
enum hsr_status hsr_mesh_find(const char *name, char **path,
                              struct hsr_error *err);

/* A list of names that grows; .names is as in hsr_mesh_names. */
struct hsr_names {
  char **names;
  size_t n, cap;
};

/* Appends a copy of the first `length` characters. */
enum hsr_status hsr_names_add(struct hsr_names *list, const char *name,
                              size_t length);
void hsr_names_free(struct hsr_names *list);

/* Appends to `text`, which holds size bytes, the names that resemble `word`:
 * ": did you mean a, b?", or nothing. */
void hsr_names_like(const struct hsr_names *list, const char *word, char *text,
                    size_t size);

#endif
