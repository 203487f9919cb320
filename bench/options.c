/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/command.h"
#include "common/base/names.h"
#include "common/files/json/palette_json.h"
#include "common/files/json/scene_json.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

error_t option_fail(struct option_base *base, const char *format, ...) {
  char text[400];
  va_list args;
  va_start(args, format);
  vsnprintf(text, sizeof text, format, args);
  va_end(args);
  hsr_fail(base->err, HSR_E_USAGE, "%s", text);
  base->failed = true;
  return EINVAL;
}

/* --- The words of a command line ------------------------------------------ */

/* A command line whose words are checked, one by one, before argp parses it:
 * argp does not tell which word it cannot read. */
struct words {
  const struct argp *argp;
  const char *command;
  int argc;
  char **argv;
  struct hsr_error *err;
};

static bool is_option(const struct argp_option *o) {
  return o->name || o->key || o->doc;
}

/* "--size MxN,..." of an option that has a long name, as all have. */
static enum hsr_status lacks_value(const struct words *words,
                                   const struct argp_option *o) {
  return hsr_fail(words->err, HSR_E_USAGE, "%s: --%s needs a value: --%s %s",
                  words->command, o->name, o->name, o->arg);
}

static enum hsr_status no_option(const struct words *words, const char *word) {
  struct hsr_names list = {0};
  char hint[256] = "", name[64], see[64];
  snprintf(name, sizeof name, "%.*s", (int)strcspn(word, "="), word);
  for (const struct argp_option *o = words->argp->options; is_option(o); o++)
    if (o->name && hsr_names_add(&list, o->name, strlen(o->name)))
      break; /* there is no hint without memory */
  if (!strncmp(name, "--", 2))
    hsr_names_like(&list, name + 2, hint, sizeof hint);
  hsr_names_free(&list);
  snprintf(see, sizeof see, " (see hsr help %s)", words->command);
  return hsr_fail(words->err, HSR_E_USAGE, "%s: there is no option '%s'%s",
                  words->command, name, *hint ? hint : see);
}

/* The option with this long name, or the only one that begins so. NULL: there
 * is none, or several. */
static const struct argp_option *find_long(const struct argp *argp,
                                           const char *name, size_t n) {
  const struct argp_option *found = NULL;
  int several = 0;
  for (const struct argp_option *o = argp->options; is_option(o); o++) {
    if (!o->name || strncmp(o->name, name, n))
      continue;
    if (strlen(o->name) == n)
      return o;
    found = o;
    several++;
  }
  return several == 1 ? found : NULL;
}

static const struct argp_option *find_short(const struct argp *argp, char key) {
  for (const struct argp_option *o = argp->options; is_option(o); o++)
    if (o->name && o->key == key)
      return o;
  return NULL;
}

/* --NAME, --NAME=VALUE or --NAME VALUE. *k is the last word that is read. */
static enum hsr_status check_long(const struct words *words, int *k) {
  const char *word = words->argv[*k];
  size_t n = strcspn(word + 2, "=");
  const struct argp_option *o = find_long(words->argp, word + 2, n);
  if (!o)
    return no_option(words, word);
  bool has_value = word[2 + n] == '=';
  if (!o->arg && has_value)
    return hsr_fail(words->err, HSR_E_USAGE, "%s: --%s takes no value",
                    words->command, o->name);
  if (!o->arg || has_value)
    return HSR_OK;
  return ++*k < words->argc ? HSR_OK : lacks_value(words, o);
}

/* -x, -xVALUE, -x VALUE, or several letters at once. */
static enum hsr_status check_short(const struct words *words, int *k) {
  for (const char *c = words->argv[*k] + 1; *c; c++) {
    const struct argp_option *o = find_short(words->argp, *c);
    if (!o)
      return no_option(words, (char[]){'-', *c, '\0'});
    if (!o->arg)
      continue;
    if (c[1] || ++*k < words->argc)
      return HSR_OK;
    return lacks_value(words, o);
  }
  return HSR_OK;
}

static enum hsr_status check_words(const struct words *words) {
  enum hsr_status status = HSR_OK;
  for (int k = 1; k < words->argc && !status; k++) {
    const char *word = words->argv[k];
    if (!strcmp(word, "--"))
      break;
    if (!strncmp(word, "--", 2))
      status = check_long(words, &k);
    else if (word[0] == '-' && word[1])
      status = check_short(words, &k);
  }
  return status;
}

/* Prints the help and ends the program, if the command line asks for it. */
static void help_if_asked(const struct argp *argp, int argc, char **argv,
                          char *name) {
  for (int k = 1; k < argc && strcmp(argv[k], "--"); k++)
    if (!strcmp(argv[k], "--help") || !strcmp(argv[k], "-h") ||
        !strcmp(argv[k], "-?")) {
      argp_help(argp, stdout, ARGP_HELP_STD_HELP & ~ARGP_HELP_EXIT_OK, name);
      exit(fflush(stdout) ? HSR_E_INPUT : 0);
    }
}

enum hsr_status parse_options(const struct argp *argp, int argc, char **argv,
                              void *input, struct hsr_error *err) {
  struct option_base *base = input;
  base->err = err;
  base->failed = false;
  char name[32], *first = argv[0];
  snprintf(name, sizeof name, "hsr %s", first);
  help_if_asked(argp, argc, argv, name);
  struct words words = {argp, first, argc, argv, err};
  if (check_words(&words))
    return HSR_E_USAGE;
  argv[0] = name;
  /* We print the errors. An argp that prints none prints no help either. */
  error_t failed =
      argp_parse(argp, argc, argv, ARGP_NO_ERRS | ARGP_NO_HELP, NULL, input);
  argv[0] = first;
  if (!failed)
    return HSR_OK;
  if (failed == ENOMEM)
    return hsr_fail_nomem(err);
  if (base->failed)
    return HSR_E_USAGE;
  return hsr_fail(err, HSR_E_USAGE, "%s: see hsr help %s", first, first);
}

struct json_options {
  struct option_base base;
  const char *command;
  bool *json;
};

static error_t parse_json(int key, char *arg, struct argp_state *state) {
  struct json_options *options = state->input;
  if (key == ARGP_KEY_ARG)
    return option_fail(&options->base, "%s: takes no scene or file, not '%s'",
                       options->command, arg);
  if (key != 'j')
    return ARGP_ERR_UNKNOWN;
  *options->json = true;
  return 0;
}

enum hsr_status parse_json_option(int argc, char **argv, const char *about,
                                  bool *json, struct hsr_error *err) {
  const struct argp_option entries[] = {
      {"json", 'j', NULL, 0, "print one JSON object", 0}, {0}};
  const struct argp argp = {entries, parse_json, NULL, about, NULL, NULL, NULL};
  struct json_options options = {.command = argv[0], .json = json};
  *json = false;
  return parse_options(&argp, argc, argv, &options, err);
}

bool parse_number(const char *text, double *number) {
  char *end;
  errno = 0;
  *number = strtod(text, &end);
  return end != text && !*end && isfinite(*number);
}

bool parse_count(const char *text, long least, long most, long *count) {
  char *end;
  errno = 0;
  *count = strtol(text, &end, 10);
  return end != text && !*end && !errno && *count >= least && *count <= most;
}

error_t parse_area_filter(enum hsr_area_filter *filter, const char *arg,
                          struct option_base *base) {
  for (int k = 0; hsr_area_filters[k].name; k++)
    if (!strcmp(hsr_area_filters[k].name, arg)) {
      *filter = (enum hsr_area_filter)k;
      return 0;
    }
  return option_fail(base, "--filter %s: must be box, tent, quadratic or cubic",
                     arg);
}

error_t parse_crease(double *degrees, const char *arg,
                     struct option_base *base) {
  return parse_number(arg, degrees) && *degrees >= 0 && *degrees <= 180
             ? 0
             : option_fail(base, "--crease %s: must be degrees, 0 to 180", arg);
}

bool parse_size(const char *text, int *m, int *n) {
  return parse_size_to(text, HSR_MAX_SIZE, m, n);
}

bool parse_size_to(const char *text, int most, int *m, int *n) {
  char *end;
  errno = 0;
  long width = strtol(text, &end, 10), height = width;
  if (end == text)
    return false;
  if (*end == 'x') {
    const char *second = end + 1;
    height = strtol(second, &end, 10);
    if (end == second)
      return false;
  }
  if (*end || errno || width < 1 || height < 1 || width > most || height > most)
    return false;
  *m = (int)width;
  *n = (int)height;
  return true;
}

bool parse_point(const char *text, double point[3]) {
  for (int k = 0; k < 3; k++) {
    char *end;
    point[k] = strtod(text, &end);
    if (end == text || *end != (k < 2 ? ',' : '\0') || !isfinite(point[k]))
      return false;
    text = end + 1;
  }
  return true;
}

static const char *const camera_keys[CAMERA_WORDS] = {
    "eye", "at", "up", "fov", "near", "parallel", "light", "sun"};
enum { PARALLEL = 5, LIGHT };

error_t parse_camera_option(struct camera_options *o, int key, char *arg,
                            struct option_base *base) {
  if (key == CAMERA_FILE) {
    o->file = arg;
    return 0;
  }
  if (key == PALETTE) {
    o->palette = arg;
    return 0;
  }
  int k = key - CAMERA_EYE;
  if (k < 0 || k >= CAMERA_WORDS)
    return ARGP_ERR_UNKNOWN;
  double number[3];
  bool is_fit = k == PARALLEL && !strcmp(arg, "fit");
  bool is_point = k < CAMERA_PLACES || k >= LIGHT;
  if (!is_fit &&
      (is_point ? !parse_point(arg, number) : !parse_number(arg, number)))
    return option_fail(base, "--%s %s: must be %s", camera_keys[k], arg,
                       is_point        ? "a point, X,Y,Z"
                       : k == PARALLEL ? "a number, or fit"
                                       : "a number");
  o->word[k] = arg;
  return 0;
}

const char *light_option(const struct camera_options *o) {
  return o->word[LIGHT] ? "--light" : o->word[LIGHT + 1] ? "--sun" : NULL;
}

static bool has_any(const struct camera_options *o, int n) {
  for (int k = 0; k < n; k++)
    if (o->word[k])
      return true;
  return false;
}

bool has_camera_words(const struct camera_options *o) {
  return has_any(o, CAMERA_WORDS);
}

bool names_a_place(const struct camera_options *o) {
  return has_any(o, CAMERA_PLACES);
}

enum hsr_status count_views(const struct camera_options *o, long standard,
                            long most, long *n, struct hsr_error *err) {
  *n = names_a_place(o) ? 1 : standard;
  if (!o->file || names_a_place(o))
    return HSR_OK;
  struct hsr_scene *scene = hsr_scene_new("");
  if (!scene)
    return hsr_fail_nomem(err);
  enum hsr_status status = hsr_cameras_json_read(scene, o->file, err);
  *n = scene->n_views < most ? (long)scene->n_views : most;
  hsr_scene_delete(scene);
  return status;
}

/* Whether the palette can be had, before a scene is opened, which may take
 * long. */
static enum hsr_status check_palette(const char *name, struct hsr_error *err) {
  struct hsr_palette palette;
  if (strchr(name, '@'))
    return hsr_fail(err, HSR_E_USAGE,
                    "--palette %.200s: must be without an '@', which divides "
                    "the names of scenes",
                    name);
  return hsr_palette_open(name, &palette, err);
}

enum hsr_status aim_name(const struct camera_options *o, long view,
                         const char *scene, char aimed[MOST_AIMED_NAME],
                         struct hsr_error *err) {
  size_t size = MOST_AIMED_NAME;
  enum hsr_status status = o->palette ? check_palette(o->palette, err) : HSR_OK;
  if (status)
    return status;
  size_t n = (size_t)snprintf(aimed, size, "%s%s%s", scene, o->file ? "@" : "",
                              o->file ? o->file : "");
  char between = '@';
  if (view > 1 && has_camera_words(o) && n < size) {
    n += (size_t)snprintf(aimed + n, size - n, "@view=%ld", view);
    between = ':';
  }
  for (int k = 0; k < CAMERA_WORDS && n < size; k++) {
    if (!o->word[k])
      continue;
    n += (size_t)snprintf(aimed + n, size - n, "%c%s=%s", between,
                          camera_keys[k], o->word[k]);
    between = ':';
  }
  if (o->palette && n < size)
    n += (size_t)snprintf(aimed + n, size - n, "@palette=%s", o->palette);
  return n < size ? HSR_OK
                  : hsr_fail(err, HSR_E_USAGE,
                             "%.100s...: the name is longer than %d bytes",
                             scene, MOST_AIMED_NAME - 1);
}

bool parse_import_option(struct hsr_import *import, int key) {
  import->drop_degenerate |= key == DROP_DEGENERATE;
  import->two_sided |= key == TWO_SIDED;
  return key == DROP_DEGENERATE || key == TWO_SIDED;
}

error_t parse_scene_option(struct scene_options *o, int key, char *arg,
                           const char *command, struct option_base *base) {
  switch (key) {
  case DROP_DEGENERATE:
  case TWO_SIDED:
    parse_import_option(&o->import, key);
    return 0;
  case ARGP_KEY_ARG:
    if (o->name)
      return option_fail(base, "%s: one scene at a time, not also '%s'",
                         command, arg);
    o->name = arg;
    return 0;
  case ARGP_KEY_END:
    if (!o->name)
      return option_fail(base, "%s: which scene? (see hsr %s --help)", command,
                         command);
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

enum hsr_status open_scene(const char *name, struct hsr_import import,
                           struct hsr_scene **scene, struct hsr_error *err) {
  enum hsr_status status = hsr_scene_open(name, &import, scene, err);
  for (const char *note = import.notes; !status && *note;) {
    const int length = (int)strcspn(note, "\n");
    fprintf(stderr, "hsr: %.*s\n", length, note);
    note += length + (note[length] == '\n');
  }
  if (!status && import.n_dropped)
    fprintf(stderr, "hsr: %s: %llu degenerate faces left out\n", name,
            (unsigned long long)import.n_dropped);
  if (!status && (*scene)->enlarged)
    fprintf(stderr,
            "hsr: %s: too small to compute with, so it is drawn 2^%d times as "
            "large; depths and coordinates are those of the larger scene\n",
            name, (*scene)->enlarged);
  return status;
}

bool parse_range(const char *text, long least, long *first, long *last) {
  char start[32];
  size_t n = strcspn(text, "-");
  if (n >= sizeof start)
    return false;
  snprintf(start, sizeof start, "%.*s", (int)n, text);
  return parse_count(start, least, INT_MAX, first) &&
         parse_count(text[n] ? text + n + 1 : start, *first, INT_MAX, last);
}

bool series_name(const char *pattern, long number, char name[MOST_FILE_NAME]) {
  size_t n = 0;
  int places = 0;
  for (const char *c = pattern; *c && n + 1 < MOST_FILE_NAME; c++) {
    if (*c != '%' || c[1] == '%') {
      c += *c == '%';
      name[n++] = *c;
      continue;
    }
    bool zeros = c[1] == '0';
    int width = 0;
    for (c++; *c >= '0' && *c <= '9' && width < 20; c++)
      width = 10 * width + (*c - '0');
    if (*c != 'd' || width > 20)
      return false;
    places++;
    int used = snprintf(name + n, MOST_FILE_NAME - n, zeros ? "%0*ld" : "%*ld",
                        width, number);
    n += (size_t)used;
  }
  if (n + 1 >= MOST_FILE_NAME)
    return false;
  name[n] = '\0';
  return places == 1;
}

error_t parse_view_option(struct view_options *o, int key, char *arg,
                          struct option_base *base) {
  switch (key) {
  case 'v':
    if (!parse_count(arg, 1, INT_MAX, &o->view))
      return option_fail(base, "--view %s: must be 1 or more", arg);
    return 0;
  case 's':
    if (!parse_size(arg, &o->m, &o->n))
      return option_fail(base, "--size %s: must be MxN or N, each 1 to %d", arg,
                         HSR_MAX_SIZE);
    return 0;
  default:
    return parse_camera_option(&o->camera, key, arg, base);
  }
}

enum hsr_status aim_scene(struct scene_options *scene,
                          struct view_options *view, struct hsr_error *err) {
  enum hsr_status status =
      aim_name(&view->camera, view->view, scene->name, scene->aimed, err);
  scene->name = scene->aimed;
  if (has_camera_words(&view->camera))
    view->view = 1;
  return status;
}

enum hsr_status choose_view(const struct view_options *o,
                            const struct hsr_scene *scene, int samples,
                            struct hsr_view *view, struct hsr_error *err) {
  if (o->view > (long)scene->n_views)
    return hsr_fail(err, HSR_E_USAGE, "%s has %u views; there is no view %ld",
                    scene->name, scene->n_views, o->view);
  return hsr_view_init_of(view, scene, (uint32_t)o->view - 1, samples * o->m,
                          samples * o->n, err);
}
