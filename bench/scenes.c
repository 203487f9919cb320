/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr scenes: lists the built-in scenes and the meshes. */
#include "bench/command.h"
#include "bench/results/json.h"
#include "bench/terminal/terminal.h"

#include <stdlib.h>

static const char about[] =
    "Lists the built-in scenes with their standard parameters, the number of "
    "faces and views that these give, and what each is for; and the real "
    "meshes of Debian's libcgal-demo, if that is installed.";

/* Faces and views of a built-in scene with its standard parameters. */
static enum hsr_status measure(const char *name, uint64_t *n_faces,
                               uint32_t *n_views, struct hsr_error *err) {
  struct hsr_scene *scene;
  enum hsr_status status = hsr_scene_open(name, NULL, &scene, err);
  if (status)
    return status;
  *n_faces = 0;
  for (uint32_t i = 0; i < scene->n_instances; i++)
    *n_faces += scene->objects[scene->instances[i].object].n_faces;
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

static enum hsr_status print_json(char **meshes, size_t n_meshes,
                                  struct hsr_error *err) {
  json_t *scenes = json_array(), *names = json_array();
  for (const struct hsr_builtin *b = hsr_builtins; b->name; b++) {
    uint64_t n_faces;
    uint32_t n_views;
    enum hsr_status status = measure(b->name, &n_faces, &n_views, err);
    if (status) {
      json_decref(scenes);
      json_decref(names);
      return status;
    }
    hsr_json_append(&scenes,
                    json_pack("{ss ss ss sb sI sI so}", "name", b->name,
                              "usage", b->usage, "about", b->about,
                              "failure_case", b->failure_case, "faces",
                              (json_int_t)n_faces, "views", (json_int_t)n_views,
                              "parameters", parameters_json(b)));
  }
  for (size_t k = 0; k < n_meshes; k++)
    hsr_json_append(&names, json_string(meshes[k]));
  return json_print(json_pack("{ss so so}", "schema", "hsr-scenes/1", "scenes",
                              scenes, "meshes", names),
                    err);
}

static enum hsr_status print_text(char **meshes, size_t n_meshes,
                                  struct hsr_error *err) {
  printf("%-18s %8s %5s  %s\n", "scene", "faces", "views", "about");
  for (const struct hsr_builtin *b = hsr_builtins; b->name; b++) {
    uint64_t n_faces;
    uint32_t n_views;
    enum hsr_status status = measure(b->name, &n_faces, &n_views, err);
    if (status)
      return status;
    int used = printf("%-18s %8llu %5u  ", b->usage,
                      (unsigned long long)n_faces, n_views);
    terminal_wrap(stdout, used, 35, b->about);
  }
  if (!n_meshes)
    puts("\nno real meshes at hand: on Debian, apt-get install libcgal-demo");
  else
    printf("\n%zu real meshes:\n", n_meshes);
  int column = 0;
  for (size_t k = 0; k < n_meshes; k++) {
    int width = printf("  mesh:%s", meshes[k]);
    column += width;
    if (column > 50 || k + 1 == n_meshes) {
      putchar('\n');
      column = 0;
    }
  }
  return HSR_OK;
}

enum hsr_status command_scenes(int argc, char **argv, struct hsr_error *err) {
  bool json;
  enum hsr_status status = parse_json_option(argc, argv, about, &json, err);
  if (status)
    return status;
  char **meshes;
  size_t n_meshes;
  status = hsr_mesh_names(&meshes, &n_meshes, err);
  if (status)
    return status;
  status = json ? print_json(meshes, n_meshes, err)
                : print_text(meshes, n_meshes, err);
  for (size_t k = 0; k < n_meshes; k++)
    free(meshes[k]);
  free(meshes);
  return status;
}
