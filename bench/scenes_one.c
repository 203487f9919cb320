/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr scenes NAME: what a scene shows, its parameters, cameras and statistics. */
#include "bench/scenes_one.h"
#include "bench/options/scene.h"
#include "bench/run/table1.h"
#include "bench/terminal/terminal.h"
#include "common/scene/world.h"

#include <math.h>
#include <string.h>

enum { SIDE = 256, MOST_MEASURED = 1 << 20, MOST_CAMERAS = 12 };

static const struct hsr_builtin *find(const char *name) {
  const size_t n = strcspn(name, ":@");
  for (const struct hsr_builtin *b = hsr_builtins; b->name; b++)
    if (strlen(b->name) == n && !strncmp(b->name, name, n))
      return b;
  return NULL;
}

static void say(const char *what, const char *text) {
  int used = printf("  %-12s", what);
  terminal_wrap(stdout, used, 14, text);
}

/* Its parameters are named in `usage`: "soup:N:SEED". */
static void say_parameters(const struct hsr_builtin *b) {
  const char *name = strchr(b->usage, ':');
  for (int k = 0; k < b->n_parameters && name; k++) {
    char text[160];
    name++;
    int n = (int)strcspn(name, ":[]");
    snprintf(text, sizeof text, "%.*s: %lld to %lld (standard: %lld)", n, name,
             b->least[k], b->most[k], b->standard[k]);
    say(k ? "" : "parameters", text);
    name = strchr(name, ':');
  }
}

static void say_size(const struct hsr_scene *scene) {
  char text[200], faces[TERMINAL_NUMBER], objects[TERMINAL_NUMBER],
      instances[TERMINAL_NUMBER], views[TERMINAL_NUMBER];
  snprintf(text, sizeof text, "%s, %s, %s%s",
           terminal_number(hsr_scene_faces(scene), "faces", faces),
           terminal_number(scene->n_objects, "objects", objects),
           terminal_number(scene->n_instances, "instances", instances),
           scene->grid ? "; a grid, whose cells have these faces" : "");
  say("holds", text);
  say("", terminal_number(scene->n_views, "views", views));
}

static void say_cameras(const struct hsr_scene *scene, const char *name) {
  char word[TERMINAL_NAME];
  puts("\ncameras:");
  for (uint32_t k = 0; k < scene->n_views && k < MOST_CAMERAS; k++) {
    const struct hsr_camera *c = &scene->views[k];
    char text[300];
    int n =
        snprintf(text, sizeof text, "from %.5g,%.5g,%.5g to %.5g,%.5g,%.5g",
                 c->eye[0], c->eye[1], c->eye[2], c->at[0], c->at[1], c->at[2]);
    if (c->parallel > 0)
      snprintf(text + n, sizeof text - (size_t)n, ", parallel, %.5g high",
               c->parallel);
    else
      snprintf(text + n, sizeof text - (size_t)n, ", %.5g degrees", c->fov);
    int used = printf("  --view %-5u", k + 1);
    terminal_wrap(stdout, used, 14, text);
  }
  if (scene->n_views > MOST_CAMERAS)
    printf("  and %u more\n", scene->n_views - MOST_CAMERAS);
  printf("  all digits: hsr scenes --cameras %s\n",
         terminal_word(name, word, sizeof word));
}

static void say_table1(const struct hsr_table1 *table) {
  static const struct {
    const char *symbol, *meaning;
    size_t offset;
  } rows[] = {
#define X(field, symbol, meaning)                                              \
  {symbol, meaning, offsetof(struct hsr_table1, field)},
      HSR_TABLE1(X)
#undef X
  };
  printf("\nTable I of the survey, view 1, %d x %d samples:\n", SIDE, SIDE);
  for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
    double x = *(const double *)((const char *)table + rows[k].offset);
    if (isnan(x))
      continue;
    int used = printf("  %-5s %10.5g  ", rows[k].symbol, x);
    terminal_wrap(stdout, used, used, rows[k].meaning);
  }
}

/* The box around all corners of faces, in units of the scene. */
static void say_box(const struct hsr_mesh *mesh) {
  double lo[3] = {INFINITY, INFINITY, INFINITY},
         hi[3] = {-INFINITY, -INFINITY, -INFINITY};
  const double *const at[3] = {mesh->x, mesh->y, mesh->z};
  for (size_t k = 0; k < mesh->n_corners; k++)
    for (int c = 0; c < 3; c++) {
      lo[c] = fmin(lo[c], at[c][mesh->vertex[k]]);
      hi[c] = fmax(hi[c], at[c][mesh->vertex[k]]);
    }
  if (mesh->n_corners)
    printf("\nbox: from %.5g,%.5g,%.5g to %.5g,%.5g,%.5g: %.5g x %.5g x %.5g "
           "units\n",
           lo[0], lo[1], lo[2], hi[0], hi[1], hi[2], hi[0] - lo[0],
           hi[1] - lo[1], hi[2] - lo[2]);
}

static enum hsr_status say_statistics(struct hsr_scene *scene,
                                      struct hsr_error *err) {
  if (hsr_scene_faces(scene) > MOST_MEASURED) {
    printf(
        "\nTable I: hsr stats measures it; of so many faces it takes long\n");
    return HSR_OK;
  }
  struct hsr_world world = {.n_faces = 0};
  struct hsr_view view;
  struct hsr_table1 table;
  enum hsr_status status = hsr_world_open(&world, scene, MOST_MEASURED, err);
  if (!status)
    say_box(&world.mesh);
  if (!status)
    status = hsr_view_init(&view, &scene->views[0], SIDE, SIDE, err);
  if (!status)
    status = measure_table1(&world, &view, &table, err);
  if (!status)
    say_table1(&table);
  hsr_world_free(&world);
  return status;
}

enum hsr_status scenes_one(const char *name, struct hsr_error *err) {
  const struct hsr_builtin *b = find(name);
  struct hsr_scene *scene;
  enum hsr_status status =
      open_scene(name, (struct hsr_import){.strict = false}, &scene, err);
  if (status)
    return status;
  char plain[TERMINAL_NAME];
  int used = printf("%s: ", terminal_plain(name, plain, sizeof plain));
  terminal_wrap(stdout, used, 2, b ? b->about : "a scene of a file");
  if (b && b->failure_case)
    say("", "one of the failure cases: made to break algorithms");
  if (b && b->n_parameters) {
    say("usage", b->usage);
    say_parameters(b);
  }
  say_size(scene);
  say_cameras(scene, name);
  status = say_statistics(scene, err);
  hsr_scene_delete(scene);
  return status;
}
