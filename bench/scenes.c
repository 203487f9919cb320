/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr scenes: lists the built-in scenes and the meshes, or tells the cameras of
 * one. */
#include "bench/options/command.h"
#include "bench/scenes_one.h"
#include "bench/options/scene.h"
#include "bench/results/json.h"
#include "bench/terminal/terminal.h"
#include "common/files/json/json.h"
#include "common/files/json/scene_json.h"
#include "scenes/scenes.h"

#include <stdlib.h>
#include <string.h>

struct options {
  struct option_base base;
  const char *cameras; /* the scene whose cameras are printed, or NULL */
  const char *name;    /* the scene that is told of, or NULL */
  bool json;
};

static error_t parse(int key, char *arg, struct argp_state *state) {
  struct options *o = state->input;
  switch (key) {
  case 'j':
    o->json = true;
    return 0;
  case 'c':
    o->cameras = arg;
    return 0;
  case ARGP_KEY_ARG:
    if (o->name)
      return option_fail(&o->base, "scenes: one scene at a time, not '%s' too",
                         arg);
    o->name = arg;
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static const struct argp argp = {
    (const struct argp_option[]){
        {"cameras", 'c', "SCENE", 0,
         "print instead the cameras of a scene, built-in or in a file, as the "
         "file that --camera reads",
         0},
        JSON_ARGP_OPTION,
        {0}},
    parse,
    "[SCENE]",
    "Lists the built-in scenes with their standard parameters, the number of "
    "faces and views that these give, and what each is for; and the real "
    "meshes of Debian's libcgal-demo with their faces, if that is installed. "
    "With a SCENE it tells all of that one: its parameters, cameras, and Table "
    "I.\v"
    "  hsr scenes house\n"
    "  hsr scenes --cameras house > house.json\n"
    "  hsr render house --camera house.json --view 2 -o house.png",
    NULL,
    NULL,
    NULL};

/* Faces and views of a built-in scene with its standard parameters; 0 if its
 * package is missing. */
static enum hsr_status measure(const struct hsr_builtin *builtin,
                               uint64_t *n_faces, uint32_t *n_views,
                               struct hsr_error *err) {
  struct hsr_scene *scene;
  *n_faces = *n_views = 0;
  if (!hsr_builtin_is_there(builtin))
    return HSR_OK;
  enum hsr_status status = hsr_scene_open(builtin->name, NULL, &scene, err);
  if (status)
    return status;
  *n_faces = hsr_scene_faces(scene);
  *n_views = scene->n_views;
  hsr_scene_delete(scene);
  return HSR_OK;
}

static json_t *parameters_json(const struct hsr_builtin *b) {
  json_t *all = json_array();
  for (int k = 0; k < b->n_parameters; k++)
    hsr_json_append(&all, json_pack("{sI sI sI}", "standard",
                                    (json_int_t)b->standard[k], "least",
                                    (json_int_t)b->least[k], "most",
                                    (json_int_t)b->most[k]));
  return all;
}

/* The meshes at hand, and the faces of each. */
struct meshes {
  char **name;
  uint64_t *faces; /* 0: the file does not say */
  size_t n;
};

static enum hsr_status find_meshes(struct meshes *meshes,
                                   struct hsr_error *err) {
  *meshes = (struct meshes){.n = 0};
  enum hsr_status status = hsr_mesh_names(&meshes->name, &meshes->n, err);
  if (status)
    return status;
  meshes->faces = calloc(meshes->n + 1, sizeof *meshes->faces);
  return meshes->faces
             ? hsr_mesh_faces(meshes->name, meshes->n, meshes->faces, err)
             : hsr_fail_nomem(err);
}

static void free_meshes(struct meshes *meshes) {
  for (size_t k = 0; k < meshes->n; k++)
    free(meshes->name[k]);
  free(meshes->name);
  free(meshes->faces);
}

static enum hsr_status print_json(const struct meshes *meshes,
                                  struct hsr_error *err) {
  json_t *scenes = json_array(), *names = json_array(), *faces = json_array();
  for (const struct hsr_builtin *b = hsr_builtins; b->name; b++) {
    uint64_t n_faces;
    uint32_t n_views;
    enum hsr_status status = measure(b, &n_faces, &n_views, err);
    if (status) {
      json_decref(scenes);
      json_decref(names);
      json_decref(faces);
      return status;
    }
    hsr_json_append(&scenes,
                    json_pack("{ss ss ss sb sI sI so}", "name", b->name,
                              "usage", b->usage, "about", b->about,
                              "failure_case", b->failure_case, "faces",
                              (json_int_t)n_faces, "views", (json_int_t)n_views,
                              "parameters", parameters_json(b)));
  }
  for (size_t k = 0; k < meshes->n; k++) {
    hsr_json_append(&names, json_string(meshes->name[k]));
    hsr_json_append(&faces, json_integer((json_int_t)meshes->faces[k]));
  }
  return json_print(json_pack("{ss so so so}", "schema", "hsr-scenes/1",
                              "scenes", scenes, "meshes", names, "mesh_faces",
                              faces),
                    err);
}

/* In columns: each mesh with its faces. */
static void print_meshes(const struct meshes *meshes) {
  const int columns = terminal_columns(stdout);
  int used = 0;
  for (size_t k = 0; k < meshes->n; k++) {
    char text[160];
    const uint64_t n = meshes->faces[k];
    int width = snprintf(text, sizeof text, n ? "  mesh:%s %llu" : "  mesh:%s",
                         meshes->name[k], (unsigned long long)n);
    if (used && used + width > (columns ? columns : 80)) {
      putchar('\n');
      used = 0;
    }
    used += printf("%s", text);
  }
  putchar('\n');
}

static enum hsr_status print_text(const struct meshes *meshes,
                                  struct hsr_error *err) {
  int wide = 0;
  for (const struct hsr_builtin *b = hsr_builtins; b->name; b++)
    if ((int)strlen(b->usage) > wide)
      wide = (int)strlen(b->usage);
  printf("%-*s %9s %5s  %s\n", wide, "scene", "faces", "views", "about");
  for (const struct hsr_builtin *b = hsr_builtins; b->name; b++) {
    uint64_t n_faces;
    uint32_t n_views;
    enum hsr_status status = measure(b, &n_faces, &n_views, err);
    if (status)
      return status;
    int used = printf("%-*s %9llu %5u  ", wide, b->usage,
                      (unsigned long long)n_faces, n_views);
    terminal_wrap(stdout, used, used, b->about);
  }
  if (meshes->n) {
    printf("\n%zu real meshes, and their faces:\n", meshes->n);
    print_meshes(meshes);
  } else {
    puts("\nno real meshes at hand: on Debian, apt-get install libcgal-demo");
  }
  return HSR_OK;
}

/* The cameras of a scene, each number with all its digits. */
static enum hsr_status print_cameras(const char *name, struct hsr_error *err) {
  struct hsr_scene *scene;
  enum hsr_status status =
      open_scene(name, (struct hsr_import){.strict = false}, &scene, err);
  if (status)
    return status;
  status = hsr_cameras_json_print(scene->views, scene->n_views, stdout, err);
  hsr_scene_delete(scene);
  return status;
}

static enum hsr_status print_scenes(bool json, struct hsr_error *err) {
  struct meshes meshes;
  enum hsr_status status = find_meshes(&meshes, err);
  if (!status)
    status = json ? print_json(&meshes, err) : print_text(&meshes, err);
  free_meshes(&meshes);
  return status;
}

enum hsr_status command_scenes(int argc, char **argv, struct hsr_error *err) {
  struct options o = {.base = {.err = err}};
  enum hsr_status status = parse_options(&argp, argc, argv, &o, err);
  if (status)
    return status;
  if (o.name && (o.cameras || o.json))
    return hsr_fail(err, HSR_E_USAGE, "scenes: '%.200s' does not go with %s",
                    o.name, o.json ? "--json" : "--cameras");
  if (o.name)
    return scenes_one(o.name, err);
  return o.cameras ? print_cameras(o.cameras, err) : print_scenes(o.json, err);
}
