/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Built-in scenes: generators, deterministic from their parameters. */
#ifndef HSR_SCENES_SCENES_H
#define HSR_SCENES_SCENES_H

#include "common/files/mesh/exchange.h"
#include "common/scene/part.h"

#ifdef __cplusplus
extern "C" {
#endif

#define HSR_MAX_PARAMETERS 4

struct hsr_builtin {
  const char *name;  /* "soup" */
  const char *usage; /* "soup:N:SEED", or the name where there is no
                           parameter */
  const char *about; /* one sentence; for a failure case: what it breaks */
  bool failure_case; /* one of the hand-made pathological scenes */
  bool only_by_name; /* too large to be in the scenes that are meant when
                           none is named */
  const char *package, *file; /* the Debian package that it needs, and one of
                                 its files; NULL if it needs none */
  int n_parameters;           /* at most HSR_MAX_PARAMETERS */
  long long standard[HSR_MAX_PARAMETERS]; /* defaults */
  long long least[HSR_MAX_PARAMETERS], most[HSR_MAX_PARAMETERS];

  /* Fills an empty scene with objects, instances and, where the scene has
   * favourite places to look from, views. HSR_E_NOMEM, HSR_E_INPUT. */
  enum hsr_status (*build)(struct hsr_scene *scene, const long long *parameter);

  /* The same of one part, without making the rest; sets what *part is to tell.
   * NULL: the scene is made whole, and cut. */
  enum hsr_status (*build_part)(struct hsr_scene *scene,
                                const long long *parameter,
                                struct hsr_scene_part *part);
};

/* All of them, in the order of tables, ended by .name == NULL. */
extern const struct hsr_builtin hsr_builtins[];

/* Whether the package that a scene needs is installed, if it needs one. */
bool hsr_builtin_is_there(const struct hsr_builtin *builtin);

/* Whether this is the name of a built-in scene that needs no files: "soup:9" and
 * "house@eye=9,5,9" are, "mesh:elephant" and "mine.obj" are not. Its parameters
 * are not looked at. */
bool hsr_is_made_by_name(const char *name);

/* Opens, finishes and returns the scene that a user names: a built-in scene
 * with parameters ("harbor", "soup:1000:7"), a real mesh of Debian's
 * libcgal-demo ("mesh:elephant"), a .scene.json, or one of its frames
 * ("carts.scene.json:12"), a mesh file, or a volume with
 * its words (common/files/volume/volume.h); each may have
 * cameras after it ("house@eye=9,5,9", scenes/cameras.h). A tiny scene is
 * enlarged (hsr_scene_enlarge). *scene is the caller's
 * to delete, NULL on failure. HSR_E_INPUT, HSR_E_NOMEM; HSR_E_USAGE for
 * cameras. */
enum hsr_status hsr_scene_open(const char *name, struct hsr_import *import,
                               struct hsr_scene **scene, struct hsr_error *err);

/* The same of one part of a scene (common/scene/part.h). *part says which, and is
 * filled in; it may be used again for another part of the same scene. A scene
 * that has no build_part is opened whole, and cut. */
enum hsr_status hsr_scene_open_part(const char *name, struct hsr_import *import,
                                    struct hsr_scene_part *part,
                                    struct hsr_scene **scene,
                                    struct hsr_error *err);

/* The real meshes that are installed, sorted by name, without suffix. *names is
 * a malloc'ed array of *n malloc'ed strings, the caller's. If no mesh package
 * is installed: HSR_OK and *n == 0. */
enum hsr_status hsr_mesh_names(char ***names, size_t *n, struct hsr_error *err);

/* Writes how many faces each of these n meshes has, as its file says; 0: it does
 * not say. Of .off, .ply and .stl it is the header that is read. HSR_E_INPUT. */
enum hsr_status hsr_mesh_faces(char *const *names, size_t n, uint64_t *faces,
                               struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
