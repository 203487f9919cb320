/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr render: one picture, or one line drawing, by one algorithm. */
#include "bench/command.h"
#include "bench/terminal/terminal.h"
#include "common/files/image.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_OUTPUTS = 16, SHADE = 0x200, WORK, HIDDEN, CREASE };

struct options {
  struct option_base base;
  struct view_options view;
  struct scene_options scene;
  const char *algorithm;
  const char *output[MOST_OUTPUTS];
  int n_outputs;
  const char *work;
  enum hsr_shading shading;
  enum hsr_hidden hidden;
  double crease; /* degrees; negative: all edges */
  /* For each of HSR_SHADING, ...: the last option given that only kinds of
   * answers which take account of it accept; or NULL. */
  const char *given[HSR_N_TAKES];
  long threads, supersamples;
};

/* The index of a word in `words`, which NULL ends; -1 if it is not there. */
static int choose_word(const char *word, const char *const *words) {
  for (int k = 0; words[k]; k++)
    if (!strcmp(word, words[k]))
      return k;
  return -1;
}

/* Options that are for pictures of faces. */
static error_t parse_face_option(struct options *o, int key, char *arg) {
  static const char *const shadings[] = {[HSR_SHADE_LAMBERT] = "lambert",
                                         [HSR_SHADE_FLAT] = "flat",
                                         [HSR_SHADE_IDS] = "ids",
                                         NULL};
  int shading;
  switch (key) {
  case 'S':
    o->given[HSR_SUPERSAMPLES] = "--supersample";
    if (!parse_count(arg, 1, 16, &o->supersamples))
      return option_fail(&o->base, "--supersample %s: must be 1 to 16", arg);
    return 0;
  case SHADE:
    o->given[HSR_SHADING] = "--shade";
    shading = choose_word(arg, shadings);
    if (shading < 0)
      return option_fail(&o->base, "--shade %s: must be lambert, flat or ids",
                         arg);
    o->shading = (enum hsr_shading)shading;
    return 0;
  case WORK:
    o->work = arg;
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

/* Options that are only for line drawings. */
static error_t parse_line_option(struct options *o, int key, char *arg) {
  static const char *const ways[] = {[HSR_HIDDEN_NONE] = "none",
                                     [HSR_HIDDEN_DASHED] = "dashed",
                                     [HSR_HIDDEN_THIN] = "thin",
                                     [HSR_HIDDEN_ALL] = "all",
                                     NULL};
  int way;
  switch (key) {
  case HIDDEN:
    o->given[HSR_LINES] = "--hidden";
    way = choose_word(arg, ways);
    if (way < 0)
      return option_fail(&o->base,
                         "--hidden %s: must be none, dashed, thin or all", arg);
    o->hidden = (enum hsr_hidden)way;
    return 0;
  case CREASE:
    o->given[HSR_LINES] = "--crease";
    if (!parse_number(arg, &o->crease) || o->crease < 0 || o->crease > 180)
      return option_fail(&o->base, "--crease %s: must be degrees, 0 to 180",
                         arg);
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

/* The scene, and where to look from. */
static error_t parse_place_option(struct options *o, int key, char *arg) {
  error_t error = parse_scene_option(&o->scene, key, arg, "render", &o->base);
  return error == ARGP_ERR_UNKNOWN
             ? parse_view_option(&o->view, key, arg, &o->base)
             : error;
}

static error_t parse(int key, char *arg, struct argp_state *state) {
  struct options *o = state->input;
  switch (key) {
  case 'a':
    o->algorithm = arg;
    return 0;
  case 'o':
    if (o->n_outputs == MOST_OUTPUTS)
      return option_fail(&o->base, "render: at most %d output files",
                         (int)MOST_OUTPUTS);
    o->output[o->n_outputs++] = arg;
    return 0;
  case 'J':
    if (!parse_count(arg, 1, 64, &o->threads))
      return option_fail(&o->base, "--jobs %s: must be 1 to 64", arg);
    return 0;
  case 'S':
  case SHADE:
  case WORK:
    return parse_face_option(o, key, arg);
  case HIDDEN:
  case CREASE:
    return parse_line_option(o, key, arg);
  default:
    return parse_place_option(o, key, arg);
  }
}

static const struct argp_option render_options[] = {
    {"algorithm", 'a', "NAME", 0, "the algorithm (standard: zbuffer)", 0},
    {"output", 'o', "FILE", 0,
     "write the picture, by suffix: .exr holds R G B and, unless it is "
     "filtered, depth Z and face id; .png and others the colours; .svg, .pdf "
     "and, in world space, .vtp hold a line "
     "drawing. May be given several times",
     0},
    {"jobs", 'J', "N", 0, "threads (standard: 1)", 0},
    SCENE_ARGP_OPTIONS,
    VIEW_ARGP_OPTIONS,
    {NULL, 0, NULL, 0, "Where the algorithm draws faces:", 2},
    {"work", WORK, "FILE", 0,
     "write the work picture: how often each sample was touched (runs the "
     "counting build); filtered, only where the algorithm filters itself",
     2},
    {"shade", SHADE, "HOW", 0, "lambert (standard), flat, or ids", 2},
    {"supersample", 'S', "N", 0,
     "N x N samples a pixel, averaged (colours only)", 2},
    {NULL, 0, NULL, 0, "Where it draws lines:", 3},
    {"hidden", HIDDEN, "HOW", 0,
     "how hidden lines are drawn: none (standard: left out), dashed, thin "
     "(and lighter the more faces hide them), or all (like visible ones); "
     ".vtp files hold all",
     3},
    {"crease", CREASE, "DEG", 0,
     "leave out edges whose two faces turn by at most DEG degrees, except "
     "contour edges",
     3},
    {0}};

static const struct argp argp = {
    render_options,
    parse,
    "SCENE",
    "Makes a picture, or a line drawing, of SCENE with one algorithm and says "
    "how long each phase "
    "took.\v"
    "SCENE is a built-in name with parameters (house, soup:1000:7), mesh:NAME, "
    "a mesh file, or a .scene.json; see hsr scenes.\n\n"
    "  hsr render house -a watkins -o house.png\n"
    "  hsr render mesh:elephant -a zbuffer -s 1024x1024 -o elephant.exr\n"
    "  hsr render harbor -a watkins --work work.png\n"
    "  hsr render house -a zbuffer:filter=cosine:jitter=4 -o house.png\n"
    "  hsr render house -a line-oracle --hidden dashed -o house.svg",
    NULL,
    NULL,
    NULL};

/* The picture in the making, and its times and counts. */
struct render {
  const struct options *options;
  struct hsr_scene *scene;
  struct hsr_world world;
  struct hsr_setup setup;
  struct hsr_view view; /* of the answer's m x n */
  const struct hsr_answer_type *kind;
  struct hsr_answer answer;
  struct hsr_shaded shaded;
  float *rgb, *face_rgb, *work;
  struct hsr_paint paint; /* of an algorithm that draws transparency */
  struct hsr_tally tally;
  double import, build, draw, shade, write; /* seconds */
};

static enum hsr_status open_place(struct render *r,
                                  const struct hsr_algorithm *a,
                                  struct hsr_error *err) {
  const struct options *o = r->options;
  double begin = seconds_now();
  enum hsr_status status =
      open_scene(o->scene.name, o->scene.import, &r->scene, err);
  if (status)
    return status;
  r->import = seconds_now() - begin;

  begin = seconds_now();
  status = choose_view(&o->view, r->scene, (int)o->supersamples, &r->view, err);
  if (!status)
    status = hsr_setup_world(&r->world, a, r->scene, err);
  r->build = seconds_now() - begin;
  return status;
}

static bool is_transparent(const struct hsr_scene *scene) {
  for (uint32_t o = 0; o < scene->n_objects; o++)
    if (scene->objects[o].opacity < 1)
      return true;
  return false;
}

/* Lets the algorithm draw the colours: only it knows what lies behind a
 * transparent face. */
static enum hsr_status ask_for_colours(struct render *r,
                                       struct hsr_error *err) {
  size_t n = (size_t)r->view.m * (size_t)r->view.n;
  uint32_t n_faces = r->world.n_faces;
  enum hsr_shading shading = r->options->shading;
  r->rgb = malloc(3 * n * sizeof *r->rgb);
  r->face_rgb = malloc(3 * (size_t)n_faces * sizeof *r->face_rgb);
  if (!r->rgb || !r->face_rgb)
    return hsr_fail_nomem(err);
  for (uint32_t f = 0; f < n_faces; f++)
    hsr_picture_colour(&r->world, &r->view, f, shading,
                       r->face_rgb + 3 * (size_t)f);
  r->paint = (struct hsr_paint){.face = r->face_rgb, .rgb = r->rgb};
  hsr_picture_colour(&r->world, &r->view, HSR_BACKGROUND, shading,
                     r->paint.background);
  r->setup.paint = &r->paint;
  return HSR_OK;
}

static enum hsr_status draw(struct render *r, const struct hsr_algorithm *a,
                            const struct hsr_choice *choice,
                            struct hsr_error *err) {
  if (r->options->work) {
    size_t n = (size_t)r->view.m * (size_t)r->view.n;
    r->work = calloc(n, sizeof *r->work);
    if (!r->work)
      return hsr_fail_nomem(err);
    r->tally.work = r->work;
    r->tally.work_stride = (size_t)r->view.m;
  }
  enum hsr_status status = hsr_setup_init(&r->setup, a, choice, &r->world, err);
  if (!status)
    status = answer_init(&r->answer, &r->setup, &r->view, err);
  if (!status && r->kind == a->kind && a->flags & HSR_TRANSPARENCY &&
      is_transparent(r->scene))
    status = ask_for_colours(r, err);
  if (!status)
    status = render_view(&r->setup, &r->view, r->options->threads, &r->answer,
                         &r->tally, &r->draw, err);
  return status;
}

/* --- Showing and writing -------------------------------------------------- */

static struct hsr_showing showing_of(const struct render *r) {
  const struct options *o = r->options;
  return (struct hsr_showing){.world = &r->world,
                              .view = &r->view,
                              .scene = o->scene.name,
                              .shading = o->shading,
                              .depth = true,
                              .rgb = r->rgb,
                              .supersamples = (int)o->supersamples,
                              .hidden = o->hidden,
                              .crease = o->crease};
}

/* Does what comes between drawing and writing. */
static enum hsr_status finish(struct render *r, struct hsr_error *err) {
  struct hsr_showing showing = showing_of(r);
  double begin = seconds_now();
  enum hsr_status status =
      r->kind->trim ? r->kind->trim(&r->answer, &showing, err) : HSR_OK;
  if (!status && r->kind->shade && (r->options->n_outputs || r->options->work))
    status = r->kind->shade(&r->answer, &showing, &r->shaded, err);
  r->shade = seconds_now() - begin;
  return status;
}

static enum hsr_status write_outputs(struct render *r,
                                     const struct hsr_algorithm *a,
                                     struct hsr_error *err) {
  const struct options *o = r->options;
  char text[300], title[200], description[200];
  snprintf(text, sizeof text, "Software=hsr\nScene=%s\nAlgorithm=%s\n",
           o->scene.name, a->name);
  snprintf(title, sizeof title, "%s, view %ld", o->scene.name, o->view.view);
  snprintf(description, sizeof description,
           "A line drawing by hsr " PACKAGE_VERSION ", %s", a->title);
  struct hsr_showing showing = showing_of(r);
  showing.text = text;
  showing.title = title;
  showing.description = description;
  double begin = seconds_now();
  enum hsr_status status = HSR_OK;
  for (int k = 0; k < o->n_outputs && !status; k++)
    status =
        r->kind->write(&r->answer, &showing, &r->shaded, o->output[k], err);
  if (o->work && !status)
    status = hsr_image_write_work(o->work, r->view.m, r->view.n, r->work, err);
  r->write = seconds_now() - begin;
  return status;
}

static void print_report(const struct render *r,
                         const struct hsr_algorithm *a) {
  char name[TERMINAL_NAME];
  printf("%s, view %ld, %d x %d %s, %u faces, by %s: ",
         terminal_plain(r->options->scene.name, name, sizeof name),
         r->options->view.view, r->view.m, r->view.n, r->kind->grains,
         r->world.n_faces, a->name);
  struct hsr_showing showing = showing_of(r);
  r->kind->print(&r->answer, &showing, stdout);
  for (int k = 0; k < r->setup.n_adaptations; k++) {
    const struct hsr_adaptation *adaptation = &r->setup.adaptation[k];
    printf("adapted: %s, %u faces, %.1f ms\n", adaptation->name,
           adaptation->n_faces, 1e3 * adaptation->seconds);
  }
  char times[300];
  snprintf(times, sizeof times,
           "ms: import %.1f, build %.1f, adapt %.1f, prepare %.1f, render "
           "%.2f, shade %.1f, write %.1f",
           1e3 * r->import, 1e3 * r->build, 1e3 * r->setup.adapt_seconds,
           1e3 * r->setup.prepare_seconds, 1e3 * r->draw, 1e3 * r->shade,
           1e3 * r->write);
  terminal_wrap(stdout, 0, 4, times);
  if (!r->options->n_outputs && !r->options->work)
    puts("nothing was written: -o FILE writes the picture");
  if (!r->options->work)
    return;
  for (int k = 0; a->counters && a->counters[k].name; k++) {
    int used = printf("%-18s %14llu  ", a->counters[k].name,
                      (unsigned long long)r->tally.count[k]);
    terminal_wrap(stdout, used, 35, a->counters[k].meaning);
  }
}

/* Checks that the options fit the kind of answer that the algorithm draws. */
static enum hsr_status check_kind(const struct options *o,
                                  const struct hsr_variant *variant,
                                  struct hsr_error *err) {
  const struct hsr_algorithm *a = variant->listed->plain;
  const struct hsr_answer_type *kind = variant->choice.form.type;
  for (int k = 0; k < HSR_N_TAKES; k++)
    if (o->given[k] && !(kind->takes & 1u << k))
      return hsr_fail(err, HSR_E_USAGE, "%s is not for %s, which %s draws",
                      o->given[k], kind->draws, variant->name);
  if (o->work && (!kind->by_places || hsr_choice_folds(a, &variant->choice)))
    return hsr_fail(err, HSR_E_USAGE,
                    "--work is only for samples drawn in one picture; %s draws "
                    "%s",
                    variant->name, kind->draws);
  for (int k = 0; k < o->n_outputs; k++)
    if (!kind->fits(o->output[k]))
      return hsr_fail(err, HSR_E_USAGE, "%s: cannot hold %s, which %s draws",
                      o->output[k], kind->draws, a->name);
  return HSR_OK;
}

enum hsr_status command_render(int argc, char **argv, struct hsr_error *err) {
  struct options options = {.view = VIEW_OPTIONS_STANDARD,
                            .algorithm = "zbuffer",
                            .crease = -1,
                            .threads = 1,
                            .supersamples = 1};
  enum hsr_status status = parse_options(&argp, argc, argv, &options, err);
  if (status)
    return status;
  options.given[HSR_PALETTE] = options.view.camera.palette ? "--palette" : NULL;
  struct hsr_variant variant;
  status = hsr_variant_parse(options.algorithm, &variant, err);
  if (!status)
    status = aim_scene(&options.scene, &options.view, err);
  if (!status)
    status = check_kind(&options, &variant, err);
  if (status)
    return status;
  const struct hsr_algorithm *a =
      options.work ? variant.listed->counting : variant.listed->plain;

  struct render r = {.options = &options, .kind = variant.choice.form.type};
  status = open_place(&r, a, err);
  if (!status)
    status = draw(&r, a, &variant.choice, err);
  if (!status)
    status = finish(&r, err);
  if (!status)
    status = write_outputs(&r, a, err);
  if (!status)
    print_report(&r, a);
  if (r.setup.algorithm)
    hsr_setup_free(&r.setup);
  hsr_world_free(&r.world);
  hsr_scene_delete(r.scene);
  hsr_answer_free(&r.answer);
  hsr_shaded_free(&r.shaded);
  free(r.rgb);
  free(r.face_rgb);
  free(r.work);
  return status;
}
