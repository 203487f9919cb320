/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The real meshes of Debian's libcgal-demo.
 *
 * The package ships them in one archive, from which a mesh is taken when it is
 * first asked for and kept in $XDG_CACHE_HOME/hsr/meshes, or
 * $HOME/.cache/hsr/meshes. If HSR_MESH_DIR is set, that folder is used as it
 * is, and the archive is not looked at. */
#ifndef HSR_SCENES_MESHES_H
#define HSR_SCENES_MESHES_H

#include "scenes/scenes.h"

/* Stores the path of a mesh file, malloc'ed, for a name without or with its
 * suffix. HSR_E_INPUT: a name that cannot be one, no such mesh, or no way to
 * get at it; HSR_E_NOMEM. */
enum hsr_status hsr_mesh_find(const char *name, char **path,
                              struct hsr_error *err);

/* A list of names that grows; .names as hsr_mesh_names has it. */
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
