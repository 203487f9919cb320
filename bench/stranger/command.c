/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr judge: anybody's picture beside the right one. */
#include "bench/client/client.h"
#include "bench/options/command.h"
#include "bench/options/view.h"
#include "bench/options/words.h"
#include "bench/stranger/lines.h"
#include "bench/stranger/picture.h"
#include "bench/stranger/say.h"
#include "bench/stranger/suite/suite.h"
#include "bench/terminal/terminal.h"
#include "common/files/json/drawing_json.h"
#include "common/files/suffix.h"
#include "common/files/whole_input.h"

#include <stdlib.h>
#include <string.h>

enum { COLOURS = 0x200, TRIANGLES, CHANNEL, NONE, SUITE };

struct options {
  struct option_base base;
  struct scene_options scene;
  struct view_options view;
  struct picture_format picture;
  const char *output, *suite;
  bool json;
};

static bool is_page(const char *path) {
  return hsr_ends_in(path, ".html");
}

static bool is_drawing(const char *path) {
  return hsr_ends_in(path, ".json") || hsr_ends_in(path, ".svg");
}

/* With --suite the one argument, which was taken for a scene, is a folder. */
static error_t check_suite(struct options *o) {
  const struct picture_format *p = &o->picture;
  if (!o->scene.name)
    return option_fail(
        &o->base, "judge: which folder of results? (see hsr judge --help)");
  if (p->path)
    return option_fail(&o->base, "judge: one folder of results, not also '%s'",
                       p->path);
  const char *other = p->colours     ? "--colours"
                      : p->triangles ? "--triangles"
                      : p->channel   ? "--channel"
                      : p->has_none  ? "--none"
                      : o->view.m    ? "--size"
                                     : NULL;
  if (other)
    return option_fail(
        &o->base,
        "%s is not for a --suite: its pictures are .npy files of "
        "ids, of their own size",
        other);
  if (o->output && !is_page(o->output))
    return option_fail(&o->base,
                       "--output %s: of a suite, a page is written, "
                       ".html",
                       o->output);
  return 0;
}

/* What only a suite has. */
static error_t check_picture(struct options *o) {
  if (o->output && is_page(o->output))
    return option_fail(&o->base,
                       "--output %s: a page is of a --suite; the "
                       "kinds are colours, as in a .png",
                       o->output);
  if (o->scene.name && !o->picture.path)
    return option_fail(&o->base,
                       "judge: which picture? (see hsr judge --help)");
  const struct picture_format *p = &o->picture;
  if (p->path && is_drawing(p->path) &&
      (o->output || p->colours || p->triangles || p->channel || p->has_none))
    return option_fail(&o->base,
                       "judge: of a drawing of lines, there is no --output, "
                       "--colours, --triangles, --channel or --none");
  return 0;
}

static error_t parse_argument(struct options *o, char *arg,
                              struct argp_state *state) {
  if (!o->scene.name)
    return parse_place_option(&o->scene, &o->view, ARGP_KEY_ARG, arg, "judge",
                              &o->base);
  if (o->picture.path)
    return option_fail(&o->base, "judge: one picture at a time, not also '%s'",
                       arg);
  (void)state;
  o->picture.path = arg;
  return 0;
}

static error_t parse(int key, char *arg, struct argp_state *state) {
  struct options *o = state->input;
  switch (key) {
  case 'o':
    if (!is_page(arg) && (hsr_ends_in(arg, ".exr") || !hsr_is_colour_file(arg)))
      return option_fail(
          &o->base, "--output %s: the kinds are colours, as in a .png", arg);
    o->output = arg;
    return 0;
  case 'j':
    o->json = true;
    return 0;
  case SUITE:
    o->suite = arg;
    return 0;
  case COLOURS:
    o->picture.colours = arg;
    return 0;
  case TRIANGLES:
    o->picture.triangles = arg;
    return 0;
  case CHANNEL:
    o->picture.channel = arg;
    return 0;
  case NONE:
    o->picture.has_none = true;
    if (!parse_count(arg, -0x7fffffffL, 0xffffffffL, &o->picture.none))
      return option_fail(
          &o->base, "--none %s: must be a whole number up to 4294967295", arg);
    return 0;
  case ARGP_KEY_ARG:
    return parse_argument(o, arg, state);
  case ARGP_KEY_END:
    if (o->suite ? check_suite(o) : check_picture(o))
      return EINVAL;
    break;
  default:
    break;
  }
  return parse_place_option(&o->scene, &o->view, key, arg, "judge", &o->base);
}

static const struct argp argp = {
    (const struct argp_option[]){
        {"output", 'o', "FILE", 0,
         "write a picture of the kinds of faults, .png; what is printed says "
         "which colour is which kind",
         0},
        JSON_ARGP_OPTION,
        {"suite", SUITE, "DIR", 0,
         "judge all pictures of a suite (hsr suite): the argument is the "
         "folder "
         "of NAME.npy files; -o writes a page, .html",
         0},
        {"colours", COLOURS, "FILE", 0,
         "of a picture in colours: a text file with a line \"r g b face\" for "
         "each colour; the word none is no face",
         0},
        {"triangles", TRIANGLES, "FILE", 0,
         "the numbers are of triangles: a text file, or .npy, that has the "
         "face of each triangle, in order",
         0},
        {"channel", CHANNEL, "NAME", 0,
         "of an .exr file: the channel that has the ids (standard: id)", 0},
        {"none", NONE, "ID", 0,
         "this number is no face, beside -1 and 4294967295", 0},
        SCENE_ARGP_OPTIONS,
        VIEW_ARGP_OPTIONS_OF("that of PICTURE"),
        {0}},
    parse,
    "SCENE PICTURE\n--suite DIR RESULTS",
    "Judges anybody's picture of SCENE: a face id for each sample, by rows "
    "from the top. It says how many samples are wrong, where, and of what "
    "kind the faults are, the most likely one first.\v"
    "PICTURE is an array of ids (.npy), an .exr with a channel of ids, 32-bit "
    "numbers and nothing else (.raw, with --size), a picture in colours with "
    "--colours, or a drawing of lines (.json, as hsr render writes it, or .svg "
    "with --hidden=all). Exit "
    "status: 0 all samples are right, 1 some are "
    "wrong.\n\n"
    "  hsr judge house mine.npy\n"
    "  hsr judge house mine.npy --view 3 -o kinds.png\n"
    "  hsr judge mesh:elephant mine.raw -s 640x480 --json\n"
    "  hsr judge house mine.png --colours table.txt\n"
    "  hsr judge house mine.json\n"
    "  hsr judge --suite suite results -o page.html",
    NULL,
    NULL,
    NULL};

/* --- Judging -------------------------------------------------------------- */

/* The work of the oracle and of the search for reasons, for who waits at a
 * terminal. */
struct waiting {
  struct progress progress;
  int n; /* rows */
};

static int tell_rows(void *whom, double share) {
  struct waiting *w = whom;
  progress_tell(&w->progress, (size_t)(share * w->n), (size_t)w->n,
                "rows of the right picture", "judge");
  return 1;
}

static void tell_kinds(void *whom, int done, int all) {
  struct waiting *w = whom;
  progress_tell(&w->progress, (size_t)done, (size_t)all,
                "kinds of reasons tried", "judge");
}

/* A picture whose sides are exchanged is one with rows and columns exchanged, or
 * of another size. */
static enum hsr_status check_sides(const struct options *o,
                                   const struct id_picture *picture,
                                   const struct stranger_verdict *verdict,
                                   struct hsr_error *err) {
  for (int k = 0; k < verdict->n_whole; k++)
    if (verdict->whole[k].kind == STRANGER_TRANSPOSED)
      return HSR_OK;
  return picture->is_exchanged
             ? hsr_fail(err, HSR_E_INPUT,
                        "%s: has %d x %d samples (columns x rows), not %d x %d",
                        hsr_path_shown(o->picture.path), picture->m, picture->n,
                        picture->n, picture->m)
             : HSR_OK;
}

static enum hsr_status judge(const struct options *o, struct lib_scene *scene,
                             const struct lib_scene *own,
                             const struct id_picture *picture,
                             struct stranger_verdict *verdict,
                             struct hsr_error *err) {
  struct waiting waiting = {progress_begin(stderr), picture->n};
  struct hsr_request request = client_request(&o->view, NULL, 1);
  request.m = picture->m;
  request.n = picture->n;
  request.progress = tell_rows;
  request.context = &waiting;
  const struct stranger_question question = {.scene = scene,
                                             .request = &request,
                                             .ids = picture->ids,
                                             .own = own,
                                             .tell = tell_kinds};
  const struct judged judged = {.scene = o->scene.name,
                                .picture = o->picture.path,
                                .view = o->view.view,
                                .verdict = verdict};
  enum hsr_status status = stranger_judge(&question, verdict, err);
  progress_end(&waiting.progress);
  if (!status)
    status = check_sides(o, picture, verdict, err);
  if (!status && o->output)
    status = say_picture(&judged, o->output, err);
  if (status)
    return status;
  if (o->json)
    status = say_json(&judged, err);
  else
    say_text(&judged, o->output);
  return status || !verdict->differing ? status : HSR_E_DIFFERENCE;
}

/* A line drawing. Its size is that of the options, else that of the file. */
static enum hsr_status judge_drawing(const struct options *o,
                                     struct lib_scene *scene,
                                     struct hsr_error *err) {
  struct hsr_drawing drawing;
  struct line_verdict verdict;
  int size[2];
  struct hsr_request request = client_request(&o->view, NULL, 1);
  enum hsr_status status =
      hsr_drawing_json_read(o->picture.path, &drawing, size, err);
  if (!status && !o->view.m && !size[0])
    status = hsr_fail(err, HSR_E_USAGE,
                      "%s: has no size; --size gives it, as the shape of the "
                      "picture matters",
                      hsr_path_shown(o->picture.path));
  if (!status && !o->view.m) {
    request.m = size[0];
    request.n = size[1];
  }
  struct progress progress = progress_begin(stderr);
  progress_tell(&progress, 0, 1, "right drawings", "judge");
  if (!status)
    status = lines_judge(scene, &request, &drawing, &verdict, err);
  progress_end(&progress);
  hsr_drawing_free(&drawing);
  if (status)
    return status;
  const struct judged judged = {
      .scene = o->scene.name, .picture = o->picture.path, .view = o->view.view};
  if (o->json)
    status = say_lines_json(&judged, &verdict, request.m, request.n, err);
  else
    say_lines(&judged, &verdict, request.m, request.n);
  return status || !verdict.differing ? status : HSR_E_DIFFERENCE;
}

/* The scene with its own cameras, if options have put others in their place. */
static enum hsr_status open_own(const struct options *o, const char *name,
                                struct lib_scene **own, struct hsr_error *err) {
  const struct hsr_open_options options = {.size = sizeof options,
                                           .strict = o->scene.import.strict,
                                           .two_sided =
                                               o->scene.import.two_sided};
  *own = NULL;
  return has_camera_words(&o->view.camera) || o->view.camera.file
             ? hsr_open(name, &options, own, err)
             : HSR_OK;
}

static enum hsr_status judge_file(const struct options *o, const char *name,
                                  struct lib_scene *scene,
                                  struct hsr_error *err) {
  struct lib_scene *own;
  struct hsr_scene_info info = {.size = sizeof info};
  struct id_picture picture = {.ids = NULL};
  struct stranger_verdict verdict = {.kind = NULL};
  enum hsr_status status = hsr_get_scene(scene, &info, err);
  if (!status)
    status = picture_read(&o->picture, (uint32_t)info.n_faces, &picture, err);
  if (!status)
    status = open_own(o, name, &own, err);
  if (!status) {
    status = judge(o, scene, own, &picture, &verdict, err);
    hsr_close(own);
  }
  free(picture.ids);
  stranger_free(&verdict);
  return status;
}

static enum hsr_status judge_suite(const struct options *o,
                                   struct hsr_error *err) {
  struct suite_judgement judgement;
  enum hsr_status status =
      suite_judge(&judgement, o->suite, o->scene.name, err);
  if (!status && o->output)
    status = suite_write_page(&judgement, o->output, err);
  if (!status && o->json)
    status = suite_say_json(&judgement, err);
  else if (!status)
    suite_say_text(&judgement);
  const bool right = suite_is_right(&judgement);
  suite_free(&judgement);
  return status || right ? status : HSR_E_DIFFERENCE;
}

enum hsr_status command_judge(int argc, char **argv, struct hsr_error *err) {
  struct options o = {.base = {.err = err}, .view = VIEW_OPTIONS_STANDARD};
  struct lib_scene *scene = NULL;
  o.view.m = o.view.n = 0; /* the picture's */
  enum hsr_status status = parse_options(&argp, argc, argv, &o, err);
  const char *name = o.scene.name;
  if (!status && o.suite)
    return judge_suite(&o, err);
  if (!status)
    status = aim_scene(&o.scene, &o.view, err);
  o.picture.m = o.view.m;
  o.picture.n = o.view.n;
  if (!status)
    status = client_open(&o.scene, &o.view, &scene, err);
  if (!status)
    status = is_drawing(o.picture.path) ? judge_drawing(&o, scene, err)
                                        : judge_file(&o, name, scene, err);
  hsr_close(scene);
  return status;
}
