/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/options/command.h"
#include "bench/options/parser.h"
#include "bench/suite/suite.h"
#include "bench/terminal/interrupt.h"
#include "bench/terminal/terminal.h"
#include "common/files/json/json.h"
#include "config.h"
#include "scenes/meshes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SUITE(group, scene, first, last, m, n, segments)                       \
  {#group, scene, first, last, m, n, segments},
const struct suite_row suite_rows[] = {
#include "bench/suite/suite.def"
    {NULL, NULL, 0, 0, 0, 0, false}};

enum { SCENES = 0x200, LIST };

struct options {
  struct option_base base;
  const char *output, *scenes;
  bool list;
};

static error_t parse(int key, char *arg, struct argp_state *state) {
  struct options *o = state->input;
  switch (key) {
  case 'o':
    if (o->output)
      return option_fail(&o->base, "suite: one -o, not also '%s'", arg);
    o->output = arg;
    return 0;
  case SCENES:
    o->scenes = arg;
    return 0;
  case LIST:
    o->list = true;
    return 0;
  case ARGP_KEY_ARG:
    return option_fail(&o->base, "suite: '%s' is not an option", arg);
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static const struct argp argp = {
    (const struct argp_option[]){
        {"output", 'o', "DIR", 0, "the folder to make", 0},
        {"scenes", SCENES, "NAME,...", 0,
         "only these scenes or groups, as --list names them", 0},
        {"list", LIST, NULL, 0, "print the scenes, and make nothing", 0},
        {0}},
    parse,
    NULL,
    "Makes a folder that any renderer can be tested with: scenes as .obj, .ply "
    "and .glb, cameras as JSON with matrices for OpenGL and Vulkan and rays, "
    "and the right ids, depths and segments as .npy. Its README.md says what "
    "to do.\v"
    "  hsr suite -o suite\n"
    "  hsr suite -o ties --scenes coplanar,ties",
    NULL,
    NULL,
    NULL};

/* --- Which scenes --------------------------------------------------------- */

/* How many rows from this one on are of its scene. */
static int rows_of_scene(const struct suite_row *row) {
  int n = 1;
  while (row[n].scene && !strcmp(row[n].scene, row->scene))
    n++;
  return n;
}

static bool is_word(const char *word, size_t length, const char *name) {
  return strlen(name) == length && !strncmp(word, name, length);
}

/* Whether a word of a list, with commas between them, means the scene. */
static bool is_wanted(const char *list, const struct suite_row *row) {
  char name[SUITE_NAME];
  if (!list)
    return true;
  suite_name(row->scene, name);
  for (size_t n; n = strcspn(list, ","), true; list += n + 1) {
    if (is_word(list, n, name) || is_word(list, n, row->scene) ||
        is_word(list, n, row->group))
      return true;
    if (!list[n])
      return false;
  }
}

/* Whether each word means some scene. */
static enum hsr_status check_words(const char *list, struct hsr_error *err) {
  char word[SUITE_NAME];
  while (list && *list) {
    const size_t n = strcspn(list, ",");
    snprintf(word, sizeof word, "%.*s", (int)(n < 60 ? n : 60), list);
    bool means = false;
    for (const struct suite_row *row = suite_rows; row->scene; row++)
      means |= is_wanted(word, row);
    if (!means)
      return hsr_fail(err, HSR_E_USAGE,
                      "suite: no scene or group '%s' (see hsr suite --list)",
                      word);
    list += list[n] ? n + 1 : n;
  }
  return HSR_OK;
}

static void print_list(const char *scenes) {
  char name[SUITE_NAME];
  for (const struct suite_row *row = suite_rows; row->scene;
       row += rows_of_scene(row)) {
    suite_name(row->scene, name);
    if (is_wanted(scenes, row))
      printf("%-26s %-9s %s\n", name, row->group, row->scene);
  }
}

/* --- Making --------------------------------------------------------------- */

struct making {
  const struct options *options;
  struct folder folder;
  json_t *scenes, *cases, *left_out;
  size_t n, n_wanted;
  bool has_meshes;
  struct progress progress;
};

static enum hsr_status find_meshes(bool *has, struct hsr_error *err) {
  char **names;
  size_t n;
  enum hsr_status status = hsr_mesh_names(&names, &n, err);
  if (status)
    return status;
  *has = n > 0;
  while (n--)
    free(names[n]);
  free(names);
  return HSR_OK;
}

static enum hsr_status add_scenes(struct making *m, struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  for (const struct suite_row *row = suite_rows; row->scene && !status;
       row += rows_of_scene(row)) {
    if (!is_wanted(m->options->scenes, row))
      continue;
    progress_tell(&m->progress, m->n++, m->n_wanted, "scenes", row->scene);
    if (!strncmp(row->scene, "mesh:", 5) && !m->has_meshes)
      hsr_json_append(&m->left_out, json_pack("{ss ss}", "scene", row->scene,
                                              "package", "libcgal-demo"));
    else
      status = suite_add_scene(&m->folder, row, rows_of_scene(row), &m->scenes,
                               &m->cases, err);
  }
  return status;
}

static enum hsr_status write_rest(struct making *m, struct hsr_error *err) {
  json_t *all = json_pack("{ss sO sO}", "schema", "hsr-suite/1", "scenes",
                          m->scenes, "cases", m->cases);
  enum hsr_status status = folder_json(&m->folder, "cases.json", all, err);
  if (!status)
    status = suite_write_readme(&m->folder, err);
  if (status)
    return status;
  json_t *head =
      json_pack("{ss ss ss* sI sI sO}", "schema", "hsr-suite-manifest/1", "hsr",
                PACKAGE_VERSION, "only", m->options->scenes, "scenes",
                (json_int_t)json_array_size(m->scenes), "cases",
                (json_int_t)json_array_size(m->cases), "left_out", m->left_out);
  return folder_finish(&m->folder, head, err);
}

static void print_made(const struct making *m) {
  char scenes[TERMINAL_NUMBER], pictures[TERMINAL_NUMBER], name[TERMINAL_NAME];
  const size_t n_out = json_array_size(m->left_out);
  printf("%s: %s, %s, %.1f MB\n",
         terminal_plain(m->options->output, name, sizeof name),
         terminal_number(json_array_size(m->scenes), "scenes", scenes),
         terminal_number(json_array_size(m->cases), "pictures", pictures),
         (double)m->folder.bytes / 1e6);
  if (n_out)
    printf("%s left out: libcgal-demo is not installed\n",
           terminal_number(n_out, "scenes", scenes));
}

static enum hsr_status make(struct making *m, struct hsr_error *err) {
  for (const struct suite_row *row = suite_rows; row->scene;
       row += rows_of_scene(row))
    m->n_wanted += is_wanted(m->options->scenes, row);
  m->progress = progress_begin(stderr);
  enum hsr_status status = find_meshes(&m->has_meshes, err);
  if (!status)
    status = add_scenes(m, err);
  if (!status && !json_array_size(m->scenes))
    status = hsr_fail(err, HSR_E_INPUT,
                      "suite: these scenes need libcgal-demo, which is not "
                      "installed");
  if (!status && interrupt_came())
    status = interrupt_fail(err);
  if (!status)
    status = write_rest(m, err);
  progress_end(&m->progress);
  return status;
}

enum hsr_status command_suite(int argc, char **argv, struct hsr_error *err) {
  struct options o = {.output = NULL};
  enum hsr_status status = parse_options(&argp, argc, argv, &o, err);
  if (!status)
    status = check_words(o.scenes, err);
  if (!status && o.list) {
    print_list(o.scenes);
    return HSR_OK;
  }
  if (!status && !o.output)
    status = hsr_fail(err, HSR_E_USAGE, "suite: -o DIR is missing");
  if (status)
    return status;
  struct making m = {.options = &o,
                     .scenes = json_array(),
                     .cases = json_array(),
                     .left_out = json_array()};
  status = folder_open(&m.folder, o.output, err);
  interrupt_listen();
  if (!status) {
    status = make(&m, err);
    if (!status)
      print_made(&m);
    folder_close(&m.folder);
  }
  json_decref(m.scenes);
  json_decref(m.cases);
  json_decref(m.left_out);
  if (status == HSR_E_STOPPED)
    interrupt_end();
  return status;
}
