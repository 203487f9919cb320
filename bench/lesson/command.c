/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr lesson: algorithms at work on one view, step by step, as one page. */
#include "config.h"

#include "bench/modules/variant.h"
#include "bench/lesson/lesson.h"
#include "bench/options/command.h"
#include "bench/options/words.h"
#include "common/files/suffix.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define STANDARD_SIZE "128x128"
enum { MOST_ALGORITHMS = 48, MOST_SIDE = 1024 };
enum { EVENTS = 0x200, SURVEY, FRAMES, FRAME_COUNT, STEPS, PNG, LAB };
enum { MOST_STEPS = 1000 };

struct options {
  struct option_base base;
  struct view_options view;
  struct scene_options scene;
  int n;
  struct hsr_variant variant[MOST_ALGORITHMS];
  const char *output;
  long events;
  bool survey;
  const char *lab;
  struct lesson_slides slides; /* .folder is NULL without them */
  uint64_t step[MOST_STEPS];
};

/* --- Options -------------------------------------------------------------- */

static error_t add_algorithm(struct options *o, const char *name) {
  if (o->n == MOST_ALGORITHMS)
    return option_fail(&o->base, "lesson: at most %d algorithms",
                       (int)MOST_ALGORITHMS);
  struct hsr_error err;
  struct hsr_variant *variant = &o->variant[o->n++];
  enum hsr_status status = hsr_variant_parse(name, variant, &err);
  if (!status)
    status = lib_check_trace(variant, &err);
  return status ? option_fail(&o->base, "%s", err.text) : 0;
}

static error_t add_algorithms(struct options *o, const char *names) {
  char name[HSR_MOST_VARIANT + 1];
  error_t error = 0;
  while (!error && next_name(&names, name, sizeof name))
    error = add_algorithm(o, name);
  return error;
}

static bool is_pdf(const struct options *o) {
  const char *end = strrchr(o->slides.folder, '.');
  return end && !strcmp(end, ".pdf");
}

/* Whether a name is that of slides or of a picture, which a page is not. */
static bool is_no_page(const char *name) {
  return hsr_ends_in(name, ".pdf") || hsr_ends_in(name, ".svg") ||
         hsr_ends_in(name, ".png") || hsr_ends_in(name, ".pptx");
}

/* Whether the survey's tree is wanted, not its lessons. */
static bool is_tree(const struct options *o) {
  return o->survey && o->output && hsr_ends_in(o->output, ".svg");
}

static error_t check_output(struct options *o) {
  if (o->output && is_no_page(o->output) && !is_tree(o))
    return option_fail(&o->base,
                       "lesson: -o %s: a page is .html; --frames FILE.pdf or "
                       "--frames DIR makes slides",
                       o->output);
  if (o->survey && o->slides.folder)
    return option_fail(&o->base, "lesson: --survey makes a page, no slides");
  return o->output || o->slides.folder
             ? 0
             : option_fail(&o->base, "lesson: which file? (-o FILE.html)");
}

static error_t check_options(struct options *o) {
  if (o->survey && (o->n || o->scene.name))
    return option_fail(&o->base, "lesson: --survey has scenes and algorithms "
                                 "of its own");
  if (o->survey)
    return check_output(o);
  error_t error =
      parse_scene_option(&o->scene, ARGP_KEY_END, NULL, "lesson", &o->base);
  if (error && error != ARGP_ERR_UNKNOWN)
    return error;
  if (!o->n)
    return option_fail(&o->base, "lesson: which algorithms? (-a A,B,...)");
  if (o->view.m > MOST_SIDE || o->view.n > MOST_SIDE)
    return option_fail(&o->base, "lesson: a page shows %d x %d samples at most",
                       (int)MOST_SIDE, (int)MOST_SIDE);
  if (o->slides.folder && o->slides.png && is_pdf(o))
    return option_fail(&o->base, "lesson: --png or a file of PDF, not both");
  return check_output(o);
}

/* "1,40,2074": ascending numbers. */
static error_t parse_steps(struct options *o, const char *list) {
  long n = 0;
  for (const char *at = list; *at; n++) {
    char *end;
    unsigned long long step = strtoull(at, &end, 10);
    bool good = end != at && ((*end == ',' && end[1]) || !*end) && *at >= '1' &&
                *at <= '9' && n < MOST_STEPS && (!n || step > o->step[n - 1]);
    if (!good)
      return option_fail(&o->base,
                         "--steps %s: must be ascending numbers from 1, with "
                         "commas, at most %d",
                         list, (int)MOST_STEPS);
    o->step[n] = step;
    at = end + (*end == ',');
  }
  if (!n)
    return option_fail(&o->base, "--steps: which ones?");
  o->slides.step = o->step;
  o->slides.n = n;
  return 0;
}

/* Steps as pictures. */
static error_t parse_frame_option(struct options *o, int key, char *arg) {
  switch (key) {
  case FRAMES:
    o->slides.folder = arg;
    return 0;
  case FRAME_COUNT:
    if (!parse_count(arg, 1, 9999, &o->slides.n))
      return option_fail(&o->base, "--frame-count %s: must be 1 to 9999", arg);
    return 0;
  case STEPS:
    return parse_steps(o, arg);
  case PNG:
    o->slides.png = true;
    return 0;
  default:
    return parse_place_option(&o->scene, &o->view, key, arg, "lesson",
                              &o->base);
  }
}

static error_t parse(int key, char *arg, struct argp_state *state) {
  struct options *o = state->input;
  switch (key) {
  case 'a':
    return add_algorithms(o, arg);
  case 'o':
    if (o->output)
      return option_fail(&o->base, "lesson: one -o, not also '%s'", arg);
    o->output = arg;
    return 0;
  case EVENTS:
    if (!parse_count(arg, 1, 10000000, &o->events))
      return option_fail(&o->base, "--events %s: must be 1 to 10000000", arg);
    return 0;
  case SURVEY:
    o->survey = true;
    return 0;
  case LAB:
    o->lab = arg;
    return 0;
  case ARGP_KEY_END:
    return check_options(o);
  default:
    return parse_frame_option(o, key, arg);
  }
}

static const struct argp argp = {
    (const struct argp_option[]){
        {"algorithms", 'a', "A,B,...", 0,
         "the algorithms, in the order of the page", 0},
        {"output", 'o', "FILE.html", 0, "write the page here", 0},
        {"events", EVENTS, "N", 0,
         "of an algorithm of more steps, only the first N can be stepped "
         "through (standard: 2000000)",
         0},
        {"survey", SURVEY, NULL, 0,
         "instead of SCENE and -a: lessons through the survey, each algorithm "
         "on a scene that shows its idea. -o FILE.svg: the tree of its figure "
         "13 with its ten algorithms, as a drawing",
         0},
        {"lab", LAB, "ADDRESS", 0,
         "where the laboratory is: each lesson leads to its scene there. For a "
         "scene of a file, the page that hsr lab has made of this file",
         0},
        {"frames", FRAMES, "DIR|FILE.pdf", 0,
         "also, or instead of -o: steps as pictures for slides, "
         "DIR/NAME-0001.svg and so on; DIR is made if need be. FILE.pdf: all "
         "of "
         "them in one file, a page for each step, its sentence beneath",
         0},
        {"frame-count", FRAME_COUNT, "N", 0,
         "N steps of each algorithm, evenly over its run (standard: 24)", 0},
        {"steps", STEPS, "K,K,...", 0,
         "instead: these steps of each algorithm, counted from 1; the page has "
         "a list of its key moments",
         0},
        {"png", PNG, NULL, 0, "these pictures as .png, not .svg", 0},
        SCENE_ARGP_OPTIONS,
        VIEW_ARGP_OPTIONS_OF(STANDARD_SIZE),
        {0}},
    parse,
    "SCENE\n--survey",
    "Makes one page on which algorithms can be watched at work on a scene, "
    "step "
    "by step, forward and back, beside their pseudocode and their counts. The "
    "page holds everything: it opens from disk and needs no network.\v"
    "  hsr lesson house -a watkins -o watkins.html\n"
    "  hsr lesson house -a bouknight,watkins,warnock -o three.html\n"
    "  hsr lesson house -a watkins --frames slides --png\n"
    "  hsr lesson house -a watkins --frames slides.pdf\n"
    "  hsr lesson house -a roberts --frames slides --steps 36,16428,16651\n"
    "  hsr lesson --survey --lab lab.html -o lessons.html\n"
    "  hsr lesson --survey -o figure13.svg\n"
    "  hsr lesson cyclic-overlap -a newell -s 64x64 -o newell.html",
    NULL,
    NULL,
    NULL};

/* --- The page ------------------------------------------------------------- */

static enum hsr_status make_page(const struct options *o,
                                 struct hsr_error *err) {
  struct lesson_subject subject[MOST_ALGORITHMS];
  for (int k = 0; k < o->n; k++)
    subject[k] = (struct lesson_subject){&o->scene, &o->view, &o->variant[k]};
  return lesson_write(
      &(struct lesson_page){.path = o->output,
                            .subject = subject,
                            .n = o->n,
                            .lab = o->lab,
                            .limits = {LESSON_MOST_FACES, o->events}},
      err);
}

static enum hsr_status make_folder(const char *folder, struct hsr_error *err) {
  struct stat there;
  return mkdir(folder, 0777) && (errno != EEXIST || stat(folder, &there) ||
                                 !S_ISDIR(there.st_mode))
             ? hsr_fail(err, HSR_E_INPUT, "%s: %s", folder, strerror(errno))
             : HSR_OK;
}

static enum hsr_status make_pdf(const struct options *o,
                                struct hsr_error *err) {
  struct lesson_subject subject[MOST_ALGORITHMS];
  for (int k = 0; k < o->n; k++)
    subject[k] = (struct lesson_subject){&o->scene, &o->view, &o->variant[k]};
  return lesson_pdf(subject, o->n, &o->slides, err);
}

static enum hsr_status make_frames(const struct options *o,
                                   struct hsr_error *err) {
  if (is_pdf(o))
    return make_pdf(o, err);
  enum hsr_status status = make_folder(o->slides.folder, err);
  for (int k = 0; k < o->n && !status; k++) {
    struct lesson_subject subject = {&o->scene, &o->view, &o->variant[k]};
    status = lesson_frames(&subject, &o->slides, err);
  }
  return status;
}

enum hsr_status command_lesson(int argc, char **argv, struct hsr_error *err) {
  struct options *o = calloc(1, sizeof *o);
  if (!o)
    return hsr_fail_nomem(err);
  o->view = (struct view_options)VIEW_OPTIONS_STANDARD;
  o->slides.n = 24;
  o->events = LESSON_STANDARD_EVENTS;
  parse_size(STANDARD_SIZE, &o->view.m, &o->view.n);
  enum hsr_status status = parse_options(&argp, argc, argv, o, err);
  if (!status && !HSR_HAVE_REPORT && !is_tree(o))
    status = hsr_fail(err, HSR_E_USAGE,
                      "lesson: built without its page (configure needs node "
                      "and npm)");
  if (!status && is_tree(o))
    status = lesson_tree(o->output, err);
  else if (!status && o->survey)
    status = lesson_survey(o->output, o->events, o->lab, err);
  else if (!status)
    status = aim_scene(&o->scene, &o->view, err);
  if (!status && !o->survey && o->slides.folder)
    status = make_frames(o, err);
  if (!status && !o->survey && o->output)
    status = make_page(o, err);
  if (!status && o->output)
    printf("open %s\n", o->output);
  if (!status && o->slides.folder)
    printf("slides in %s\n", o->slides.folder);
  free(o);
  return status;
}
