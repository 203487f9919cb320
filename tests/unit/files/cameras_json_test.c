/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files of cameras: docs/schemas/camera.schema.json admits what hsr writes, and
 * what hsr refuses it does not. */
#ifndef _POSIX_C_SOURCE
#define _POSIX_C_SOURCE 200809L
#endif

#include "common/files/json/scene_json.h"
#include "tests/schema.h"
#include "tests/tap.h"

#include <string.h>
#include <unistd.h>

#define VIEW "\"eye\": [1, 2, 3], \"at\": [0, 0, 0]"
#define FILE_OF(view) "{\"schema\": \"hsr-camera/1\", \"views\": [{" view "}]}"

static const struct {
  const char *text;
  bool good;
} files[] = {
    {FILE_OF(VIEW), true},
    {FILE_OF(VIEW ", \"up\": [0, 0, 1], \"fov\": 30, \"near\": 1"), true},
    {FILE_OF(VIEW ", \"parallel\": 4, \"light\": [1, 2, 3]"), true},
    {FILE_OF(VIEW ", \"sun\": [1, 2, 3]"), true},
    {"{\"schema\": \"hsr-camera/1\", \"views\": []}", false},
    {"{\"schema\": \"hsr-camera/1\"}", false},
    {"{\"schema\": \"hsr-camera/2\", \"views\": [{" VIEW "}]}", false},
    {"{\"views\": [{" VIEW "}]}", false},
    {FILE_OF("\"eye\": [1, 2, 3]"), false},
    {FILE_OF("\"eye\": [1, 2], \"at\": [0, 0, 0]"), false},
    {FILE_OF(VIEW ", \"fov\": 180"), false},
    {FILE_OF(VIEW ", \"near\": -1"), false},
    {FILE_OF(VIEW ", \"zoom\": 2"), false},
};
enum { N_FILES = sizeof files / sizeof *files };

/* Whether hsr reads what is in cameras.json. */
static bool is_read(void) {
  struct hsr_scene *scene = hsr_scene_new("");
  const bool good =
      scene && !hsr_cameras_json_read(scene, "cameras.json", NULL);
  hsr_scene_delete(scene);
  return good;
}

static bool is_admitted(const json_t *schema) {
  json_t *value = json_load_file("cameras.json", 0, NULL);
  const bool good = value && schema_admits(schema, value);
  json_decref(value);
  return good;
}

static void write_text(const char *text) {
  FILE *file = fopen("cameras.json", "w");
  if (!file || fputs(text, file) < 0 || fclose(file))
    bail("cameras.json: cannot be written");
}

int main(void) {
  struct tap tap = plan(N_FILES + 1);
  json_t *schema = schema_open("camera.schema.json");
  char folder[] = "/tmp/hsr-cameras-XXXXXX";
  if (!mkdtemp(folder) || chdir(folder))
    bail("no folder");
  for (int k = 0; k < N_FILES; k++) {
    write_text(files[k].text);
    ok(&tap, is_read() == files[k].good && is_admitted(schema) == files[k].good,
       "%s: %s", files[k].good ? "read" : "refused", files[k].text);
  }
  const struct hsr_camera views[] = {
      {.eye = {1, 2, 3}, .up = {0, 1, 0}, .fov = 45, .near = .5},
      {.eye = {1, 2, 3}, .up = {0, 1, 0}, .parallel = 4, .light = {1, 1, 1, 1}},
      {.eye = {1, 2, 3}, .up = {0, 1, 0}, .fov = 45, .light = {1, 1, 1, 0}}};
  ok(&tap,
     !hsr_cameras_json_write(views, 3, "cameras.json", NULL) && is_read() &&
         is_admitted(schema),
     "what hsr writes");
  if (remove("cameras.json") || chdir("/") || rmdir(folder))
    bail("%s: cannot be removed", folder);
  json_decref(schema);
  return finish(&tap);
}
