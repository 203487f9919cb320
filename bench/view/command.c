/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr view: look around in a scene, as algorithms draw it. */
#include "config.h"

#include "bench/modules/variant.h"
#include "bench/options/command.h"
#include "bench/options/picture.h"
#include "bench/view/view.h"

#include "bench/terminal/terminal.h"
#include "common/base/clock.h"
#include "common/files/image.h"
#include "common/files/library.h"
#include "common/files/srgb.h"
#include "common/files/suffix.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

enum { KEYS = 0x200, SCREENSHOT };

struct options {
  struct option_base base;
  struct view_options view;
  struct scene_options scene;
  const char *algorithms, *keys, *screenshot;
  struct line_options lines;
  long threads;
};

static error_t parse(int key, char *arg, struct argp_state *state) {
  struct options *o = state->input;
  error_t unknown;
  switch (key) {
  case 'a':
    o->algorithms = arg;
    return 0;
  case 'J':
    return parse_threads(&o->scene, &o->threads, arg, &o->base);
  case KEYS:
    o->keys = arg;
    return 0;
  case SCREENSHOT:
    o->screenshot = arg;
    return 0;
  default:
    unknown = parse_line_option(&o->lines, key, arg, &o->base);
    if (unknown != ARGP_ERR_UNKNOWN)
      return unknown;
    unknown =
        parse_place_option(&o->scene, &o->view, key, arg, "view", &o->base);
    return !unknown && light_option(&o->view.camera)
               ? option_fail(&o->base,
                             "%s: shadows are drawn by hsr render, not by view",
                             light_option(&o->view.camera))
               : unknown;
  }
}

static const struct argp_option entries[] = {
    {"algorithm", 'a', "A[,B]", 0,
     "the algorithm, and another to compare it with (standard: "
     "zbuffer-fast,watkins)",
     0},
    THREADS_ARGP_OPTION,
    {"keys", KEYS, "LIST", 0,
     "press these keys: n,w,... and drag:X:Y:X:Y (also pan, zoom), click:X:Y, "
     "wheel:N, wait:MS, shot:FILE",
     0},
    {"screenshot", SCREENSHOT, "FILE", 0,
     "then write what the window shows, and end", 0},
    SCENE_ARGP_OPTIONS,
    VIEW_ARGP_OPTIONS_OF("1280x720"),
    {NULL, 0, NULL, 0, "Where lines are drawn:", 3},
    LINE_ARGP_OPTIONS(3),
    {0}};

static const struct argp argp = {
    entries,
    parse,
    "SCENE",
    "Shows a scene in a window, as an algorithm draws it. The mouse turns the "
    "camera; the key h tells the keys.\v"
    "  hsr view house\n"
    "  hsr view mesh:elephant -a hzbuffer,watkins\n"
    "  hsr view house --keys w,shot:work.png,l --screenshot lines.png",
    NULL,
    NULL,
    NULL};

/* --- Showing -------------------------------------------------------------- */

void viewer_say(struct viewer *v, const char *format, ...) {
  va_list args;
  va_start(args, format);
  vsnprintf(v->message, sizeof v->message, format, args);
  va_end(args);
  puts(v->message);
  fflush(stdout);
}

void viewer_show_panel(struct viewer *v) {
  /* While the camera moves, numbers that change are read now and then. */
  bool is_time = !v->moving || v->n_moving % 8 == 0;
  char *text = is_time ? malloc(MOST_PANEL) : NULL;
  if (text) {
    panel_write(v, text);
    v->library->panel(v->window, text);
  }
  free(text);
  v->library->show(v->window);
}

/* What the frame took beside drawing and shading. */
static void note_times(struct viewer *v, double begin) {
  const double all = 1e3 * (hsr_seconds_now() - begin);
  double inside = 0;
  for (int k = 0; k < 2; k++)
    if (k == 0 ? v->comparison != COMPARE_BLINK || !v->blink : v->comparison)
      inside += v->player[k]->draw_ms + v->player[k]->shade_ms;
  v->outside_ms = all - inside;
  if (!v->n_frames++)
    v->first_ms = 1e3 * (hsr_seconds_now() - v->begin);
  if (!v->moving)
    return;
  v->n_moving++;
  v->sum_outside += v->outside_ms;
  v->sum_draw += v->player[0]->draw_ms;
  v->sum_shade += v->player[0]->shade_ms;
  v->sum_coarse += v->moving;
  v->moving_seconds += 1e-3 * all;
  /* coarser if frames are late, finer again if there is time */
  if (all > 50 && v->moving < MOST_COARSE)
    v->moving *= 2;
  else if (all < 10 && v->moving > v->coarse)
    v->moving /= 2;
}

void viewer_show(struct viewer *v) {
  struct hsr_error err = {HSR_OK, ""};
  const double begin = hsr_seconds_now();
  if (!v->frozen && frame_draw(v, &err))
    viewer_say(v, "%s", err.text);
  if (!v->frozen)
    v->library->picture(v->window, v->m, v->n, v->rgb);
  viewer_show_panel(v);
  if (!v->frozen)
    note_times(v, begin);
}

enum hsr_status viewer_save(struct viewer *v, const unsigned char *bytes,
                            const char *path, struct hsr_error *err) {
  const size_t n = 3 * (size_t)v->m * (size_t)v->n;
  float *rgb = malloc(n * sizeof *rgb);
  if (!rgb)
    return hsr_fail_nomem(err);
  for (size_t k = 0; k < n; k++)
    rgb[k] = hsr_srgb_decode((float)bytes[k] / 255);
  const struct hsr_picture picture = {.m = v->m, .n = v->n, .rgb = rgb};
  enum hsr_status status = hsr_image_write(path, &picture, NULL, err);
  free(rgb);
  return status;
}

enum hsr_status viewer_screenshot(struct viewer *v, const char *path,
                                  struct hsr_error *err) {
  unsigned char *bytes = malloc(3 * (size_t)v->m * (size_t)v->n);
  enum hsr_status status = HSR_OK;
  if (!bytes)
    return hsr_fail_nomem(err);
  if (!v->library->pixels(v->window, v->m, v->n, bytes))
    status = hsr_fail(err, HSR_E_NOMEM,
                      "view: not all of the window is on the screen");
  if (!status)
    status = viewer_save(v, bytes, path, err);
  free(bytes);
  return status;
}

/* --- Algorithms and scenes ------------------------------------------------ */

bool viewer_choose(struct viewer *v, const char *name) {
  struct hsr_error err = {HSR_OK, ""};
  struct player *player = calloc(1, sizeof *player);
  char full[HSR_MOST_VARIANT + 16];
  snprintf(full, sizeof full, "%s%s", name, v->filtered ? ":filter=box" : "");
  enum hsr_status status =
      player ? player_open(player, full, PLAYER_PLAIN, v, &err)
             : hsr_fail_nomem(&err);
  if (status) {
    viewer_say(v, "%s", err.text);
    free(player);
    return false;
  }
  player_close(v->player[0]);
  free(v->player[0]);
  v->player[0] = player;
  if (name != v->first)
    snprintf(v->first, sizeof v->first, "%s", name);
  return true;
}

static void close_players(struct viewer *v) {
  for (int k = 0; k < 2; k++)
    if (v->player[k])
      player_close(v->player[k]);
  player_close(&v->counter);
  player_close(&v->lines);
}

void viewer_reload(struct viewer *v) {
  struct hsr_error err = {HSR_OK, ""};
  struct hsr_scene *scene, *before = v->scene;
  if (open_scene(v->scene_name, v->import, &scene, &err)) {
    viewer_say(v, "%s", err.text);
    return;
  }
  if (v->frozen)
    frozen_end(v);
  close_players(v);
  v->scene = scene;
  if (!viewer_choose(v, v->first)) {
    v->scene = before;
    hsr_scene_delete(scene);
    if (!viewer_choose(v, v->first))
      v->library->stop(v->window);
    return;
  }
  hsr_scene_delete(before);
  v->view = v->view < scene->n_views ? v->view : 0;
}

/* --- Events --------------------------------------------------------------- */

static void turn(void *viewer, const struct hsr_camera *camera, bool moving) {
  struct viewer *v = viewer;
  if (!v->frozen) {
    const struct hsr_camera before = v->camera;
    v->camera = *camera;
    v->camera.near = before.near;
    v->camera.fov = before.fov;
    if (!(before.parallel > 0))
      v->camera.parallel = 0;
    v->moving = !moving ? 0 : v->moving ? v->moving : v->coarse;
    *v->picked = '\0';
  }
  viewer_show(v);
}

static void click(void *viewer, int x, int y) {
  struct viewer *v = viewer;
  if (v->frozen)
    return;
  pick(v, x, y);
  viewer_show_panel(v);
}

static bool make_room(struct viewer *v, int m, int n) {
  const size_t size = 3 * (size_t)m * (size_t)n;
  free(v->rgb);
  free(v->other);
  v->rgb = malloc(size);
  v->other = malloc(size);
  v->m = m;
  v->n = n;
  return v->rgb && v->other;
}

static void resize(void *viewer, int m, int n) {
  struct viewer *v = viewer;
  if (m < 1 || n < 1 || m > HSR_MAX_SIZE || n > HSR_MAX_SIZE ||
      (m == v->m && n == v->n) || !v->window)
    return;
  if (make_room(v, m, n)) {
    viewer_show(v);
    return;
  }
  v->status = hsr_fail_nomem(&v->err);
  v->library->stop(v->window);
}

static void tick(void *viewer) {
  struct viewer *v = viewer;
  if (v->comparison == COMPARE_BLINK)
    v->blink = !v->blink;
  else if (v->walking)
    keys_press(v, "v");
  else
    return;
  if (!v->walking)
    viewer_show(v);
}

/* --- The command ---------------------------------------------------------- */

/* "A" or "A,B"; the second is one that is not the first. */
static enum hsr_status name_players(struct viewer *v, const char *algorithms,
                                    struct hsr_error *err) {
  const size_t n = strcspn(algorithms, ",");
  const char *second = algorithms[n] ? algorithms + n + 1
                       : strncmp(algorithms, "zbuffer-fast", 12)
                           ? "zbuffer-fast"
                           : "watkins";
  struct hsr_variant variant;
  if (strchr(second, ','))
    return hsr_fail(err, HSR_E_USAGE, "view: at most two algorithms");
  snprintf(v->first, sizeof v->first, "%.*s", (int)n, algorithms);
  snprintf(v->second, sizeof v->second, "%s", second);
  enum hsr_status status = hsr_variant_parse(v->first, &variant, err);
  return status ? status : hsr_variant_parse(v->second, &variant, err);
}

static void print_times(const struct viewer *v) {
  printf("first picture after %.0f ms; %u pictures", v->first_ms, v->n_frames);
  puts("");
  if (v->n_moving)
    printf("%u while moving, %.1f a second, %.1f pixels a sample; ms: draw "
           "%.2f, shade %.2f, the rest %.2f\n",
           v->n_moving, v->n_moving / v->moving_seconds,
           v->sum_coarse / v->n_moving, v->sum_draw / v->n_moving,
           v->sum_shade / v->n_moving, v->sum_outside / v->n_moving);
}

static enum hsr_status show_all(struct viewer *v, const struct options *o,
                                struct hsr_error *err) {
  const struct window_events events = {v,     keys_press, turn,
                                       click, resize,     tick};
  char name[TERMINAL_NAME], title[TERMINAL_NAME + 8];
  snprintf(title, sizeof title, "hsr: %s",
           terminal_plain(v->scene_name, name, sizeof name));
  v->window = v->library->open(title, v->m, v->n, &events, err);
  if (!v->window)
    return err->status;
  v->library->camera(v->window, &v->camera);
  viewer_show(v);
  enum hsr_status status = o->keys ? play(v, o->keys, err) : HSR_OK;
  if (!status && o->screenshot)
    status = viewer_screenshot(v, o->screenshot, err);
  else if (!status && !v->stopped)
    v->library->run(v->window);
  if (!status && v->status) {
    status = v->status;
    *err = v->err;
  }
  if (!status)
    print_times(v);
  v->library->close(v->window);
  return status;
}

static enum hsr_status open_all(struct viewer *v, struct options *o,
                                struct hsr_error *err) {
  struct hsr_view view;
  enum hsr_status status = open_scene(v->scene_name, v->import, &v->scene, err);
  if (!status)
    say_map(v->scene_name, v->scene);
  if (!status)
    status = choose_view(&o->view, v->scene, 1, &view, err);
  if (status)
    return status;
  v->camera = view.camera;
  v->view = (uint32_t)o->view.view - 1;
  if (!make_room(v, o->view.m, o->view.n))
    return hsr_fail_nomem(err);
  for (int k = 0; k < 2; k++)
    v->player[k] = calloc(1, sizeof *v->player[k]);
  if (!v->player[0] || !v->player[1])
    return hsr_fail_nomem(err);
  return player_open(v->player[0], v->first, PLAYER_PLAIN, v, err);
}

enum hsr_status command_view(int argc, char **argv, struct hsr_error *err) {
  struct options o = {.view = {.view = 1, .m = 1280, .n = 720},
                      .algorithms = "zbuffer-fast",
                      .lines = {.hidden = "dashed"},
                      .threads = 1};
  struct viewer *v = calloc(1, sizeof *v);
  if (!v)
    return hsr_fail_nomem(err);
  v->begin = hsr_seconds_now();
  enum hsr_status status = parse_options(&argp, argc, argv, &o, err);
  if (!status)
    status = name_players(v, o.algorithms, err);
  if (!status)
    status = aim_scene(&o.scene, &o.view, err);
  v->scene_name = o.scene.name;
  v->import = o.scene.import;
  v->threads = o.threads;
  v->line_options = o.lines;
  if (o.lines.style && hsr_ends_in(o.lines.style, ".json"))
    v->style_file = o.lines.style;
  if (!status)
    status = line_options_style(&v->line_options, &v->style, err);
  v->coarse = 1;
  v->page = PAGE_TIMES;
#if HSR_HAVE_WINDOW
  if (!status) {
    const void *table;
    status = hsr_library_table("hsr-window.so", "hsr_window", &table, err);
    v->library = table;
  }
#else
  if (!status)
    status =
        hsr_fail(err, HSR_E_INPUT,
                 "view: this build of hsr, without VTK and X, has no window");
#endif
  if (!status)
    status = open_all(v, &o, err);
  if (!status)
    status = show_all(v, &o, err);
  close_players(v);
  hsr_scene_delete(v->scene);
  free(v->player[0]);
  free(v->player[1]);
  free(v->rgb);
  free(v->other);
  free(v);
  return status;
}
