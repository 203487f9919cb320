/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes: opened by name, described, laid out. */
#include "bench/library/library.h"
#include "common/base/share.h"
#include "scenes/scenes.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { MOST_THREADS = 64 };

/* --- Handles -------------------------------------------------------------- */

struct lib_scene *lib_scene_new(void) {
  struct lib_scene *handle = calloc(1, sizeof *handle);
  if (handle && pthread_rwlock_init(&handle->lock, NULL)) {
    free(handle);
    return NULL;
  }
  if (handle)
    atomic_init(&handle->users, 1);
  return handle;
}

struct lib_scene *lib_scene_share(const struct lib_scene *scene) {
  struct lib_scene *shared = (struct lib_scene *)scene;
  atomic_fetch_add(&shared->users, 1);
  return shared;
}

void hsr_close(struct lib_scene *scene) {
  if (!scene || atomic_fetch_sub(&scene->users, 1) > 1)
    return;
  lib_geometry_free(&scene->geometry);
  if (scene->has_laid_out)
    hsr_world_free(&scene->laid_out);
  if (scene->has_roster)
    hsr_world_free(&scene->roster);
  hsr_scene_delete(scene->scene);
  pthread_rwlock_destroy(&scene->lock);
  free(scene);
}

enum hsr_status lib_open_options(const struct hsr_open_options *from,
                                 struct hsr_open_options *options,
                                 struct hsr_error *err) {
  enum hsr_status status =
      lib_take("options", options, sizeof *options, from, err);
  if (!status && (options->threads < 0 || options->threads > MOST_THREADS))
    status = hsr_fail(err, HSR_E_USAGE, "options: threads must be 0 to %d",
                      MOST_THREADS);
  if (!status && !(options->weld >= 0 && options->weld <= DBL_MAX))
    status =
        hsr_fail(err, HSR_E_USAGE, "options: weld must be a distance, or 0");
  return status;
}

/* --- By name -------------------------------------------------------------- */

static enum hsr_status open_named(const char *name,
                                  const struct hsr_open_options *options,
                                  struct lib_scene *handle,
                                  struct hsr_error *err) {
  struct hsr_import import = {.strict = options->strict,
                              .two_sided = options->two_sided,
                              .weld = options->weld,
                              .path = options->path,
                              .threads = hsr_threads(options->threads)};
  enum hsr_status status = hsr_scene_open(name, &import, &handle->scene, err);
  handle->n_dropped = import.n_dropped;
  memcpy(handle->notes, import.notes, sizeof handle->notes);
  return status;
}

enum hsr_status hsr_open(const char *name,
                         const struct hsr_open_options *options,
                         struct lib_scene **scene, struct hsr_error *err) {
  struct hsr_open_options taken;
  if (scene)
    *scene = NULL;
  if (!name || !scene)
    return lib_null(name ? "scene" : "name", err);
  enum hsr_status status = lib_open_options(options, &taken, err);
  if (status)
    return status;
  struct lib_scene *handle = lib_scene_new();
  if (!handle)
    return hsr_fail_nomem(err);
  status = open_named(name, &taken, handle, err);
  if (status)
    hsr_close(handle);
  else
    *scene = handle;
  return status;
}

/* --- What is known of a scene --------------------------------------------- */

static uint64_t count_vertices(const struct hsr_scene *scene) {
  uint64_t n = 0;
  for (uint32_t k = 0; k < scene->n_instances; k++)
    n += scene->objects[scene->instances[k].object].n_vertices;
  return n;
}

enum hsr_status hsr_get_scene(const struct lib_scene *scene,
                              struct hsr_scene_info *info,
                              struct hsr_error *err) {
  if (!scene)
    return lib_null("scene", err);
  struct lib_scene *handle = (struct lib_scene *)scene;
  const struct hsr_scene *s = handle->scene;
  lib_scene_read(handle);
  struct hsr_scene_info found = {.name = s->name,
                                 .n_faces = hsr_scene_faces(s),
                                 .n_vertices = count_vertices(s),
                                 .n_objects = s->n_objects,
                                 .n_instances = s->n_instances,
                                 .n_views = s->n_views,
                                 .is_grid = s->subject == HSR_GRID,
                                 .is_transparent = hsr_scene_is_transparent(s),
                                 .enlarged = s->enlarged,
                                 .n_dropped = handle->n_dropped,
                                 .notes = handle->notes};
  lib_scene_leave(handle);
  return lib_give("info", info, sizeof found, &found, err);
}

enum hsr_status hsr_get_camera(const struct lib_scene *scene, uint32_t view,
                               struct lib_camera *camera,
                               struct hsr_error *err) {
  if (!scene)
    return lib_null("scene", err);
  const struct hsr_scene *s = scene->scene;
  if (view >= s->n_views)
    return hsr_fail(err, HSR_E_USAGE, "%s has %u views; there is no view %u",
                    s->name, s->n_views, view);
  const struct hsr_camera *own = &s->views[view];
  struct lib_camera found = {
      .fov = own->fov, .near = own->near, .parallel = own->parallel};
  memcpy(found.eye, own->eye, sizeof found.eye);
  memcpy(found.at, own->at, sizeof found.at);
  memcpy(found.up, own->up, sizeof found.up);
  memcpy(found.light, own->light, sizeof found.light);
  return lib_give("camera", camera, sizeof found, &found, err);
}

/* --- Worlds --------------------------------------------------------------- */

void lib_scene_read(struct lib_scene *scene) {
  pthread_rwlock_rdlock(&scene->lock);
}

void lib_scene_leave(struct lib_scene *scene) {
  pthread_rwlock_unlock(&scene->lock);
}

/* The world that suits an algorithm, if it is made; else NULL. It chooses as
 * hsr_setup_world does. */
static const struct hsr_world *find_world(const struct lib_scene *scene,
                                          const struct hsr_algorithm *a,
                                          const struct hsr_choice *choice) {
  const struct hsr_scene *s = scene->scene;
  uint64_t n = hsr_scene_faces(s);
  bool takes_grid = s->grid && a->subjects & 1u << HSR_GRID;
  if (!takes_grid && n <= hsr_most_laid_out(a, choice))
    return scene->has_laid_out ? &scene->laid_out : NULL;
  bool lacks =
      !takes_grid && n <= HSR_MOST_LAID_OUT && hsr_scene_lacks_faces(s);
  return scene->has_roster && !lacks ? &scene->roster : NULL;
}

/* Makes that world, and keeps it. */
static enum hsr_status make_world(struct lib_scene *scene,
                                  const struct hsr_algorithm *a,
                                  const struct hsr_choice *choice,
                                  struct hsr_error *err) {
  struct hsr_world world = {.n_faces = 0};
  enum hsr_status status =
      hsr_setup_world(&world, a, choice, scene->scene, err);
  bool roster = hsr_is_roster(&world);
  bool *has = roster ? &scene->has_roster : &scene->has_laid_out;
  if (status || *has) { /* there it is, and now has its faces */
    hsr_world_free(&world);
    return status;
  }
  *(roster ? &scene->roster : &scene->laid_out) = world;
  *has = true;
  return HSR_OK;
}

enum hsr_status lib_scene_world(struct lib_scene *scene,
                                const struct hsr_algorithm *algorithm,
                                const struct hsr_choice *choice,
                                const struct hsr_world **world,
                                struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  pthread_rwlock_rdlock(&scene->lock);
  *world = find_world(scene, algorithm, choice);
  pthread_rwlock_unlock(&scene->lock);
  if (*world)
    return HSR_OK;
  pthread_rwlock_wrlock(&scene->lock);
  if (!find_world(scene, algorithm, choice))
    status = make_world(scene, algorithm, choice, err);
  if (!status)
    *world = find_world(scene, algorithm, choice);
  pthread_rwlock_unlock(&scene->lock);
  if (!status && !*world)
    status = hsr_fail(err, HSR_E_INTERNAL,
                      "%s: its world is not the one that "
                      "was asked for",
                      algorithm->name);
  return status;
}
