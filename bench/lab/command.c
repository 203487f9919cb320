/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr lab: a page in which the algorithms themselves run, on a scene that can be
 * turned and changed. */
#include "bench/lab/lab.h"
#include "bench/modules/variant.h"
#include "bench/options/command.h"
#include "bench/results/page.h"
#include "common/files/whole_file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_ALGORITHMS = 3 };

struct options {
  struct option_base base;
  struct scene_options scene;
  struct view_options view;
  json_t *algorithms;
  const char *output;
};

/* --- Options -------------------------------------------------------------- */

static error_t add_algorithm(struct options *o, const char *name,
                             size_t length) {
  char text[HSR_MOST_VARIANT + 1];
  struct hsr_error err;
  struct hsr_variant variant;
  snprintf(text, sizeof text, "%.*s", (int)length, name);
  if (json_array_size(o->algorithms) == MOST_ALGORITHMS)
    return option_fail(&o->base, "lab: at most %d algorithms",
                       (int)MOST_ALGORITHMS);
  if (hsr_variant_parse(text, &variant, &err))
    return option_fail(&o->base, "%s", err.text);
  return json_array_append_new(o->algorithms, json_string(text)) ? ENOMEM : 0;
}

static error_t add_algorithms(struct options *o, const char *names) {
  error_t error = 0;
  while (!error && *names) {
    size_t length = strcspn(names, ",");
    error = add_algorithm(o, names, length);
    names += length + (names[length] == ',');
  }
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

/* Writes JSON into an element of a page: "<" would end it. */
static enum hsr_status put_asked(const json_t *asked, FILE *out,
                                 struct hsr_error *err) {
  char *text = json_dumps(asked, JSON_COMPACT | JSON_ENSURE_ASCII);
  if (!text)
    return hsr_fail_nomem(err);
  fputs("<script type=\"application/json\" id=\"asked\">", out);
  for (const char *c = text; *c; c++)
    *c == '<' ? fputs("\\u003c", out) : putc(*c, out);
  fputs("</script>\n", out);
  free(text);
  return HSR_OK;
}

static enum hsr_status write_page(const struct options *o, const json_t *asked,
                                  const char *built, FILE *out,
                                  struct hsr_error *err) {
  static const char mark[] = "<!--asked-->";
  const char *here = strstr(built, mark);
  if (!here)
    return hsr_fail(err, HSR_E_INTERNAL, "lab: the page has no '%s'", mark);
  fwrite(built, 1, (size_t)(here - built), out);
  enum hsr_status status = put_asked(asked, out, err);
  fputs(here + strlen(mark), out);
  if (!status && ferror(out))
    status = hsr_fail(err, HSR_E_INPUT, "%s: cannot be written: %s", o->output,
                      strerror(errno));
  return status;
}

static enum hsr_status make_page(struct options *o, const char *built,
                                 struct hsr_error *err) {
  const char *name = o->scene.name; /* without the words of a camera */
  json_t *asked = NULL;
  struct hsr_whole_file file;
  enum hsr_status status = aim_scene(&o->scene, &o->view, err);
  if (!status)
    status = lab_asked(name, &o->scene, &o->view, o->algorithms, &asked, err);
  if (!status)
    status = hsr_whole_file_open(&file, o->output, err);
  if (!status) {
    status = write_page(o, asked, built, file.stream, err);
    status = hsr_whole_file_close(&file, status, err);
  }
  json_decref(asked);
  return status;
}

static enum hsr_status read_page(char **built, struct hsr_error *err) {
  return read_built_page("lab.html", built, err)
             ? hsr_fail(err, HSR_E_USAGE,
                        "lab: built without its page (./quickstart web "
                        "makes it)")
             : HSR_OK;
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
