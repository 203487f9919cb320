/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The files of one scene. The right answers are of the .scene.json file that is
 * in the suite, so they are right for what is there. */
#include "bench/suite/cameras.h"
#include "bench/suite/exact.h"
#include "bench/suite/flat.h"
#include "bench/suite/right.h"
#include "bench/suite/suite.h"
#include "bench/terminal/interrupt.h"
#include "common/files/cells/cells.h"
#include "common/files/json/json.h"
#include "common/files/json/scene_json.h"
#include "common/files/npy.h"
#include "scenes/scenes.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A picture. */
struct picture {
  char name[SUITE_NAME + 40];
  int m, n;
  bool segments;
};

struct made {
  struct folder *folder;
  const struct suite_row *row;
  int n_rows;
  char name[SUITE_NAME];
  struct hsr_scene *flat; /* its views are those of the pictures, in order */
  struct hsr_world world; /* of `flat` */
  struct picture *picture;
  uint32_t n_pictures;
  struct flat_triangles triangles;
  struct right *right, *right_rounded;
};

void suite_name(const char *scene, char name[SUITE_NAME]) {
  snprintf(name, SUITE_NAME, "%s", scene);
  for (char *c = name; *c; c++)
    if (!isalnum((unsigned char)*c) && *c != '_')
      *c = '-';
}

/* --- The scene ------------------------------------------------------------ */

static enum hsr_status add_picture(struct made *made,
                                   const struct suite_row *row, int view,
                                   const struct hsr_camera *camera,
                                   struct hsr_error *err) {
  struct picture *p = &made->picture[made->n_pictures++];
  int n = snprintf(p->name, sizeof p->name, "%s-%d", made->name, view);
  p->m = row->m;
  p->n = row->n;
  p->segments = row->segments;
  /* A second size is in the name. */
  if (row->m != made->row->m || row->n != made->row->n)
    snprintf(p->name + n, sizeof p->name - (size_t)n, "-%dx%d", row->m, row->n);
  return hsr_scene_view(made->flat, camera) ? hsr_fail_nomem(err) : HSR_OK;
}

static enum hsr_status add_pictures(struct made *made,
                                    const struct hsr_scene *scene,
                                    struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  made->picture =
      calloc((size_t)made->n_rows * scene->n_views, sizeof *made->picture);
  if (!made->picture)
    return hsr_fail_nomem(err);
  for (int r = 0; r < made->n_rows && !status; r++) {
    const struct suite_row *row = &made->row[r];
    const int last = row->last ? row->last : (int)scene->n_views;
    if (last > (int)scene->n_views)
      return hsr_fail(err, HSR_E_INTERNAL, "suite.def: %s has no view %d",
                      row->scene, last);
    for (int view = row->first; view <= last && !status; view++)
      status = add_picture(made, row, view, &scene->views[view - 1], err);
  }
  return status;
}

static enum hsr_status open_flat(struct made *made, struct hsr_error *err) {
  struct hsr_import import = {.notes = ""};
  struct hsr_scene *scene = NULL;
  struct hsr_world world;
  enum hsr_status status =
      hsr_scene_open(made->row->scene, &import, &scene, err);
  if (status)
    return status;
  status = hsr_world_init(&world, scene, err);
  if (!status)
    status = flat_make(&world, &made->flat, err);
  hsr_world_free(&world);
  if (!status)
    status = add_pictures(made, scene, err);
  if (!status)
    status = hsr_scene_finish(made->flat, err);
  if (!status)
    status = hsr_world_init(&made->world, made->flat, err);
  if (!status)
    status = flat_triangulate(&made->world, &made->triangles, err);
  hsr_scene_delete(scene);
  return status;
}

/* --- Files of the scene --------------------------------------------------- */

static enum hsr_status write_array(struct made *made, const char *name,
                                   const char *what, struct hsr_npy *array,
                                   struct hsr_error *err) {
  const char *path = folder_file(made->folder, "%s.%s.npy", name, what);
  return path ? hsr_npy_write(path, array, err) : hsr_fail_nomem(err);
}

static enum hsr_status write_triangles(struct made *made,
                                       struct hsr_error *err) {
  char name[SUITE_NAME + 10];
  snprintf(name, sizeof name, "scenes/%s", made->name);
  struct hsr_npy array = {.kind = 'u',
                          .bytes = 4,
                          .n_dimensions = 1,
                          .size = {made->triangles.n},
                          .data = made->triangles.of};
  return write_array(made, name, "triangles", &array, err);
}

/* Writes a scene in one format. */
static enum hsr_status write_scene(struct made *made, const char *suffix,
                                   struct hsr_error *err) {
  const char *path =
      folder_file(made->folder, "scenes/%s.%s", made->name, suffix);
  if (!path)
    return hsr_fail_nomem(err);
  switch (*suffix) {
  case 's':
    return hsr_scene_json_write(made->flat, path, err);
  case 'p':
    return hsr_world_write_ply(&made->world, path, err);
  case 'o':
    return hsr_world_write_obj(&made->world, path, err);
  default:
    return hsr_scene_write_glb(
        made->flat, (struct hsr_glb_frame){.metres = 1, .plain = true}, path,
        NULL, err);
  }
}

static enum hsr_status open_right(struct made *made, const char *format,
                                  const struct hsr_scene *scene,
                                  struct right **right, struct hsr_error *err) {
  const char *path = folder_file(made->folder, format, made->name);
  if (!path)
    return hsr_fail_nomem(err);
  enum hsr_status status =
      scene ? hsr_scene_json_write(scene, path, err) : HSR_OK;
  return status ? status : right_open(path, right, err);
}

/* The triangles of the .glb, as a scene of their own, whose file is not kept. */
static enum hsr_status open_rounded(struct made *made, struct hsr_error *err) {
  struct hsr_scene *rounded = made->triangles.rounded;
  enum hsr_status status = HSR_OK;
  if (!rounded)
    return HSR_OK;
  for (uint32_t v = 0; v < made->flat->n_views && !status; v++)
    status = hsr_scene_view(rounded, &made->flat->views[v]);
  if (status)
    return hsr_fail_nomem(err);
  status = hsr_scene_finish(rounded, err);
  if (!status) {
    status = open_right(made, "scenes/%s.floats.scene.json", rounded,
                        &made->right_rounded, err);
    folder_forget(made->folder);
  }
  return status;
}

static enum hsr_status write_files(struct made *made, struct hsr_error *err) {
  static const char *const suffixes[] = {"obj", "ply", "glb"};
  enum hsr_status status = HSR_OK;
  /* hsr_world_write_obj writes this one, too. */
  if (!folder_file(made->folder, "scenes/%s.mtl", made->name))
    status = hsr_fail_nomem(err);
  for (size_t k = 0; k < sizeof suffixes / sizeof *suffixes && !status; k++)
    status = write_scene(made, suffixes[k], err);
  if (!status)
    status = write_triangles(made, err);
  if (!status)
    status =
        open_right(made, "scenes/%s.scene.json", made->flat, &made->right, err);
  return status;
}

static json_t *one_sided_json(const struct hsr_world *world) {
  const bool *one_sided = world->mesh.one_sided;
  json_t *runs = json_array();
  for (uint32_t f = 0; f < world->n_faces;) {
    const uint32_t first = f;
    while (f < world->n_faces && one_sided[f] == one_sided[first])
      f++;
    if (one_sided[first])
      hsr_json_append(&runs,
                      json_pack("[II]", (json_int_t)first, (json_int_t)f));
  }
  return runs;
}

static const char *about(const char *scene) {
  const size_t n = strcspn(scene, ":@");
  for (const struct hsr_builtin *b = hsr_builtins; b->name; b++)
    if (strlen(b->name) == n && !strncmp(b->name, scene, n))
      return b->about;
  return "a mesh of libcgal-demo";
}

static json_t *scene_json(const struct made *made) {
  const struct hsr_world *world = &made->world;
  json_int_t bent = 0;
  for (uint32_t f = 0; f < world->n_faces; f++)
    bent += world->mesh.deviation[f] > 0;
  return json_pack(
      "{ss ss ss ss sI sI sI so sI sb sI}", "name", made->name, "group",
      made->row->group, "hsr", made->row->scene, "about",
      about(made->row->scene), "faces", (json_int_t)world->n_faces, "vertices",
      (json_int_t)world->mesh.n_vertices, "triangles",
      (json_int_t)made->triangles.n, "one_sided", one_sided_json(world),
      "faces_not_flat", bent, "floats_and_triangles", !made->triangles.rounded,
      "triangles_without_area", (json_int_t)made->triangles.n_without_area);
}

/* --- Pictures ------------------------------------------------------------- */

/* The ids for the triangles with rounded coordinates, if they are others. */
static enum hsr_status add_rounded(struct made *made, uint32_t number,
                                   const uint32_t *ids, json_t *about,
                                   struct hsr_error *err) {
  const struct picture *p = &made->picture[number];
  const size_t n = (size_t)p->m * (size_t)p->n;
  char name[SUITE_NAME + 50];
  size_t differing = 0;
  uint32_t *found = malloc(n * sizeof *found);
  if (!found)
    return hsr_fail_nomem(err);
  enum hsr_status status =
      right_ids(made->right_rounded, number, p->m, p->n, found, err);
  for (size_t k = 0; k < n && !status; k++) {
    if (found[k] != HSR_BACKGROUND)
      found[k] = made->triangles.of_rounded[found[k]];
    differing += found[k] != ids[k];
  }
  if (!status && differing) {
    struct hsr_npy array = {.kind = 'u',
                            .bytes = 4,
                            .n_dimensions = 2,
                            .size = {(uint64_t)p->n, (uint64_t)p->m},
                            .data = found};
    snprintf(name, sizeof name, "right/%s", p->name);
    status = write_array(made, name, "floats", &array, err);
  }
  free(found);
  if (!status && json_object_set_new(about, "differing_by_floats",
                                     json_integer((json_int_t)differing)))
    status = hsr_fail_nomem(err);
  return status;
}

static enum hsr_status add_segments(struct made *made, uint32_t number,
                                    struct hsr_error *err) {
  const struct picture *p = &made->picture[number];
  char name[SUITE_NAME + 50];
  double *row = NULL;
  size_t n;
  if (!p->segments)
    return HSR_OK;
  snprintf(name, sizeof name, "right/%s", p->name);
  enum hsr_status status =
      right_segments(made->right, number, p->m, p->n, &row, &n, err);
  if (!status) {
    struct hsr_npy array = {.kind = 'f',
                            .bytes = 8,
                            .n_dimensions = 2,
                            .size = {n, SEGMENT_COLUMNS},
                            .data = row};
    status = write_array(made, name, "segments", &array, err);
  }
  free(row);
  return status;
}

static enum hsr_status write_right(struct made *made, const struct picture *p,
                                   uint32_t *ids, double *depth,
                                   struct hsr_error *err) {
  char name[SUITE_NAME + 50];
  struct hsr_npy array = {.kind = 'u',
                          .bytes = 4,
                          .n_dimensions = 2,
                          .size = {(uint64_t)p->n, (uint64_t)p->m},
                          .data = ids};
  snprintf(name, sizeof name, "right/%s", p->name);
  enum hsr_status status = write_array(made, name, "ids", &array, err);
  if (status)
    return status;
  array.kind = 'f';
  array.bytes = 8;
  array.data = depth;
  return write_array(made, name, "depths", &array, err);
}

/* Draws picture `number`, and adds it to the cases. */
static enum hsr_status make_picture(struct made *made, uint32_t number,
                                    uint32_t *ids, double *depth,
                                    json_t **cases, struct hsr_error *err) {
  const struct picture *p = &made->picture[number];
  struct hsr_view view;
  json_t *case_ =
      json_pack("{ss ss ss sI si si sb}", "name", p->name, "scene", made->name,
                "group", made->row->group, "view", (json_int_t)number + 1,
                "width", p->m, "height", p->n, "segments", (int)p->segments);
  enum hsr_status status = case_ ? HSR_OK : hsr_fail_nomem(err);
  if (!status)
    status = hsr_view_init(&view, &made->flat->views[number], p->m, p->n, err);
  if (!status)
    status = right_ids(made->right, number, p->m, p->n, ids, err);
  if (!status)
    status = exact_depths(&made->world, &view, ids, depth, err);
  if (!status)
    status = write_right(made, p, ids, depth, err);
  if (!status && !add_camera(case_, &made->world, &view, depth))
    status = hsr_fail_nomem(err);
  if (!status && made->right_rounded)
    status = add_rounded(made, number, ids, case_, err);
  if (!status)
    status = add_segments(made, number, err);
  hsr_json_append(cases, case_);
  return status;
}

static enum hsr_status make_pictures(struct made *made, json_t **cases,
                                     struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  for (uint32_t k = 0; k < made->n_pictures && !status; k++) {
    const struct picture *p = &made->picture[k];
    const size_t n = (size_t)p->m * (size_t)p->n;
    uint32_t *ids = malloc(n * sizeof *ids);
    double *depth = malloc(n * sizeof *depth);
    if (interrupt_came())
      status = interrupt_fail(err);
    else
      status = ids && depth ? make_picture(made, k, ids, depth, cases, err)
                            : hsr_fail_nomem(err);
    free(ids);
    free(depth);
  }
  return status;
}

enum hsr_status suite_add_scene(struct folder *folder,
                                const struct suite_row *row, int n_rows,
                                json_t **scenes, json_t **cases,
                                struct hsr_error *err) {
  struct made made = {.folder = folder, .row = row, .n_rows = n_rows};
  suite_name(row->scene, made.name);
  enum hsr_status status = open_flat(&made, err);
  if (!status)
    status = write_files(&made, err);
  if (!status)
    status = open_rounded(&made, err);
  if (!status) {
    hsr_json_append(scenes, scene_json(&made));
    status = make_pictures(&made, cases, err);
  }
  right_close(made.right);
  right_close(made.right_rounded);
  flat_free(&made.triangles);
  hsr_world_free(&made.world);
  hsr_scene_delete(made.flat);
  free(made.picture);
  return status;
}
