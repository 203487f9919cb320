/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr lab: a page in which the algorithms themselves run, on a scene that can be
 * turned and changed. */
#include "bench/lab/lab.h"
#include "bench/modules/variant.h"
#include "bench/options/command.h"
#include "bench/options/words.h"
#include "bench/results/page.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

struct options {
  struct option_base base;
  struct scene_options scene;
  struct view_options view;
  json_t *algorithms;
  const char *output;
};

/* --- Options -------------------------------------------------------------- */

static error_t add_algorithm(struct options *o, const char *name) {
  struct hsr_error err;
  struct hsr_variant variant;
  if (json_array_size(o->algorithms) == LAB_MOST_ALGORITHMS)
    return option_fail(&o->base, "lab: at most %d algorithms",
                       (int)LAB_MOST_ALGORITHMS);
  if (hsr_variant_parse(name, &variant, &err))
    return option_fail(&o->base, "%s", err.text);
  return json_array_append_new(o->algorithms, json_string(name)) ? ENOMEM : 0;
}

static error_t add_algorithms(struct options *o, const char *names) {
  char name[HSR_MOST_VARIANT + 1];
  error_t error = 0;
  while (!error && next_name(&names, name, sizeof name))
    error = add_algorithm(o, name);
  return error;
}

static error_t parse(int key, char *arg, struct argp_state *state) {
  struct options *o = state->input;
  switch (key) {
  case 'a':
    return add_algorithms(o, arg);
  case 'o':
    if (o->output)
      return option_fail(&o->base, "lab: one -o, not also '%s'", arg);
    o->output = arg;
    return 0;
  case ARGP_KEY_END:
    if (!o->output)
      return option_fail(&o->base, "lab: which file? (-o FILE.html)");
    return parse_scene_option(&o->scene, key, arg, "lab", &o->base);
  default:
    return parse_place_option(&o->scene, &o->view, key, arg, "lab", &o->base);
  }
}

static const struct argp argp = {
    (const struct argp_option[]){
        {"algorithms", 'a', "A,B,C", 0,
         "up to three algorithms that draw at first", 0},
        {"output", 'o', "FILE.html", 0, "write the page here", 0},
        SCENE_ARGP_OPTIONS,
        {"view", 'v', "K", 0,
         "look from the scene's view K, from 1 (standard: 1)", 10},
        CAMERA_ARGP_OPTIONS,
        {0}},
    parse,
    "SCENE",
    "Writes the laboratory: one page in which the algorithms themselves run. "
    "The scene can be turned and changed, and the algorithms watched step by "
    "step, counted and judged. The page opens from disk and needs no "
    "network.\v"
    "  hsr lab house -o lab.html\n"
    "  hsr lab mine.obj -a newell,zbuffer -o lab.html",
    NULL,
    NULL,
    NULL};

/* --- The page ------------------------------------------------------------- */

struct put {
  const struct options *options;
  json_t *asked;
};

static enum hsr_status put_first_and_asked(const void *context, FILE *out,
                                           struct hsr_error *err) {
  const struct put *put = context;
  const struct options *o = put->options;
  lab_put_first(&o->scene, &o->view, o->algorithms, out);
  return put_page_json("asked", json_incref(put->asked), out, err);
}

/* Those of reports/lab/state/lab.js. */
static enum hsr_status choose_algorithms(json_t *algorithms,
                                         struct hsr_error *err) {
  if (json_array_size(algorithms))
    return HSR_OK;
  return json_array_append_new(algorithms, json_string("watkins")) ||
                 json_array_append_new(algorithms, json_string("zbuffer"))
             ? hsr_fail_nomem(err)
             : HSR_OK;
}

static enum hsr_status make_page(struct options *o, const char *built,
                                 struct hsr_error *err) {
  const char *name = o->scene.name; /* without the words of a camera */
  struct put put = {.options = o};
  enum hsr_status status = aim_scene(&o->scene, &o->view, err);
  if (!status)
    status = choose_algorithms(o->algorithms, err);
  if (!status)
    status =
        lab_asked(name, &o->scene, &o->view, o->algorithms, &put.asked, err);
  if (!status)
    status = write_built_page(o->output, built, "<!--asked-->",
                              put_first_and_asked, &put, err);
  json_decref(put.asked);
  return status;
}

static enum hsr_status read_page(char **built, struct hsr_error *err) {
  enum hsr_status status = read_built_page("lab.html", built, err);
  return status == HSR_E_INPUT
             ? hsr_fail(err, HSR_E_USAGE,
                        "lab: built without its page (./quickstart web "
                        "makes it)")
             : status;
}

enum hsr_status command_lab(int argc, char **argv, struct hsr_error *err) {
  struct options o = {.view = VIEW_OPTIONS_STANDARD,
                      .algorithms = json_array()};
  char *built = NULL;
  enum hsr_status status = o.algorithms
                               ? parse_options(&argp, argc, argv, &o, err)
                               : hsr_fail_nomem(err);
  if (!status)
    status = read_page(&built, err);
  if (!status)
    status = make_page(&o, built, err);
  if (!status)
    printf("open %s\n", o.output);
  free(built);
  json_decref(o.algorithms);
  return status;
}
