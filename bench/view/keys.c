/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/modules/modules.h"
#include "bench/view/view.h"

#include "bench/terminal/terminal.h"
#include "common/files/json/scene_json.h"
#include "common/scene/part.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* --- Algorithms ----------------------------------------------------------- */

static bool is_offered(const struct hsr_listed *listed) {
  return !(listed->plain->flags & (HSR_JUDGE | HSR_NO_PICTURE)) &&
         (hsr_own_kind(listed->plain)->shade ||
          hsr_own_kind(listed->plain)->lines);
}

/* The algorithm before or after the first player's that takes the scene. */
static void choose_next(struct viewer *v, int step) {
  int n = 0, at = 0;
  for (; hsr_algorithms()[n].plain; n++)
    if (&hsr_algorithms()[n] == v->player[0]->variant.listed)
      at = n;
  for (int k = 1; k < n; k++) {
    const struct hsr_listed *listed =
        &hsr_algorithms()[(at + step * k + n * k) % n];
    if (is_offered(listed) && viewer_choose(v, listed->plain->name))
      return;
  }
}

static void next_algorithm(struct viewer *v) {
  choose_next(v, 1);
}
static void previous_algorithm(struct viewer *v) {
  choose_next(v, -1);
}

static void swap(struct viewer *v) {
  char name[HSR_MOST_VARIANT + 1];
  snprintf(name, sizeof name, "%s", v->first);
  char second[HSR_MOST_VARIANT + 1];
  snprintf(second, sizeof second, "%s", v->second);
  if (viewer_choose(v, second))
    snprintf(v->second, sizeof v->second, "%s", name);
}

static void filter(struct viewer *v) {
  v->filtered = !v->filtered;
  char name[HSR_MOST_VARIANT + 1];
  snprintf(name, sizeof name, "%s", v->first);
  if (!viewer_choose(v, name))
    v->filtered = !v->filtered;
}

/* --- Comparisons and overlays --------------------------------------------- */

static void compare(struct viewer *v, enum comparison how) {
  v->comparison = v->comparison == how ? COMPARE_NONE : how;
  v->library->tick(v->window, v->comparison == COMPARE_BLINK ? 500 : 0);
  v->walking = false;
}
static void side_by_side(struct viewer *v) {
  compare(v, COMPARE_SIDES);
}
static void blink(struct viewer *v) {
  compare(v, COMPARE_BLINK);
}
static void difference(struct viewer *v) {
  compare(v, COMPARE_DIFFERENCE);
}

static void overlay(struct viewer *v, enum overlay what) {
  v->overlay = v->overlay == what ? OVERLAY_NONE : what;
}
static void work(struct viewer *v) {
  overlay(v, OVERLAY_WORK);
}
static void depth(struct viewer *v) {
  overlay(v, OVERLAY_DEPTH);
}
static void edges(struct viewer *v) {
  overlay(v, OVERLAY_EDGES);
}
static void lines(struct viewer *v) {
  v->has_lines = !v->has_lines;
}

/* --- Views ---------------------------------------------------------------- */

static void look_from(struct viewer *v, uint32_t view) {
  v->view = view;
  v->camera = v->scene->views[view];
  v->library->camera(v->window, &v->camera);
}
static void next_view(struct viewer *v) {
  look_from(v, (v->view + 1) % v->scene->n_views);
}
static void previous_view(struct viewer *v) {
  look_from(v, (v->view + v->scene->n_views - 1) % v->scene->n_views);
}

/* Where a direction is up in the scene: the axis that its first view has
 * upmost, and the direction of its front, from which it is looked at. */
static void find_up(const struct viewer *v, double up[3], double front[3]) {
  const double *given = v->scene->views[0].up;
  int axis = 0;
  for (int k = 1; k < 3; k++)
    axis = fabs(given[k]) > fabs(given[axis]) ? k : axis;
  for (int k = 0; k < 3; k++) {
    up[k] = k == axis ? copysign(1, given[k]) : 0;
    front[k] = axis == 2 ? -(k == 1) : k == 2;
  }
}

/* Looks at the whole scene from a side, with this direction up. */
static void look_at_all(struct viewer *v, const double side[3],
                        const double up[3]) {
  const double degree = 3.14159265358979323846 / 180;
  struct hsr_camera *c = &v->camera;
  double centre[3], radius = hsr_scene_sphere(v->scene, centre);
  const double shape = v->m < v->n ? (double)v->m / v->n : 1;
  const double half = atan(shape * tan(c->fov / 2 * degree));
  const double far = radius / sin(half);
  if (!(radius > 0) || !isfinite(far))
    return;
  for (int k = 0; k < 3; k++) {
    c->at[k] = centre[k];
    c->eye[k] = centre[k] + far * side[k];
    c->up[k] = up[k];
  }
  if (c->parallel > 0)
    c->parallel = 2 * radius / shape;
  v->library->camera(v->window, c);
}

static void look_front(struct viewer *v) {
  double up[3], front[3];
  find_up(v, up, front);
  look_at_all(v, front, up);
}
static void look_right(struct viewer *v) {
  double up[3], front[3], right[3];
  find_up(v, up, front);
  for (int k = 0; k < 3; k++) {
    const int l = (k + 1) % 3, m = (k + 2) % 3;
    right[k] = up[l] * front[m] - up[m] * front[l];
  }
  look_at_all(v, right, up);
}
static void look_top(struct viewer *v) {
  double up[3], front[3], back[3];
  find_up(v, up, front);
  for (int k = 0; k < 3; k++)
    back[k] = -front[k];
  look_at_all(v, up, back);
}

/* The direction of the view stays. */
static void fit(struct viewer *v) {
  const struct hsr_camera before = v->camera;
  double side[3], length = 0;
  for (int k = 0; k < 3; k++)
    side[k] = before.eye[k] - before.at[k];
  length = hypot(hypot(side[0], side[1]), side[2]);
  for (int k = 0; k < 3; k++)
    side[k] /= length;
  look_at_all(v, side, before.up);
}

/* What is up in the scene is up in the picture. */
static void level(struct viewer *v) {
  double front[3];
  struct hsr_camera levelled = v->camera;
  find_up(v, levelled.up, front);
  if (hsr_camera_check(&levelled, NULL)) {
    viewer_say(v, "there is no horizon in a view straight up or down");
    return;
  }
  v->camera = levelled;
  v->library->camera(v->window, &v->camera);
}

static void walk(struct viewer *v) {
  v->walking = !v->walking;
  v->comparison = v->comparison == COMPARE_BLINK ? COMPARE_NONE : v->comparison;
  v->library->tick(v->window, v->walking ? 40 : 0);
}

/* As high as what is seen around the point looked at. */
static void project(struct viewer *v) {
  const double degree = 3.14159265358979323846 / 180;
  struct hsr_camera *c = &v->camera;
  double distance = hypot(hypot(c->at[0] - c->eye[0], c->at[1] - c->eye[1]),
                          c->at[2] - c->eye[2]);
  c->parallel = c->parallel > 0 ? 0 : 2 * tan(c->fov / 2 * degree) * distance;
  v->library->camera(v->window, c);
}

static void freeze(struct viewer *v) {
  if (v->frozen)
    frozen_end(v);
  else
    frozen_begin(v);
}

/* --- Resolution and threads ----------------------------------------------- */

static void coarser(struct viewer *v) {
  v->coarse = v->coarse < MOST_COARSE ? 2 * v->coarse : v->coarse;
}
static void finer(struct viewer *v) {
  v->coarse = v->coarse > 1 ? v->coarse / 2 : 1;
}

static void set_threads(struct viewer *v, long threads) {
  if (threads < 1 || threads > 64)
    return;
  v->threads = threads;
  player_close(v->player[1]);
  player_close(&v->counter);
  char name[HSR_MOST_VARIANT + 1];
  snprintf(name, sizeof name, "%s", v->first);
  viewer_choose(v, name);
}
static void more_threads(struct viewer *v) {
  set_threads(v, v->threads + 1);
}
static void fewer_threads(struct viewer *v) {
  set_threads(v, v->threads - 1);
}

/* --- The panel ------------------------------------------------------------ */

static void panel(struct viewer *v) {
  v->page = v->page >= PAGE_TABLE ? PAGE_NONE : v->page + 1;
}
static void help(struct viewer *v) {
  if (v->page != PAGE_HELP)
    v->page_before = v->page;
  v->page = v->page == PAGE_HELP ? v->page_before : PAGE_HELP;
}

/* --- Files ---------------------------------------------------------------- */

/* The first name that there is no file of: "hsr-view-1.json". */
static void new_name(char name[40], const char *suffix) {
  unsigned k = 1;
  do
    snprintf(name, 40, "hsr-view-%u%s", k++, suffix);
  while (!access(name, F_OK));
}

/* The command that draws what the window shows, as a picture or as lines, to a
 * file whose name is that of the camera with this suffix. */
static void command_of(const struct viewer *v, const struct player *player,
                       const char *name, const char *suffix,
                       char text[MOST_COMMAND]) {
  char scene[TERMINAL_NAME], algorithm[TERMINAL_NAME];
  char lines[MOST_LINE_WORDS] = "";
  if (player->render.kind->lines)
    lines_words(&v->line_options, lines);
  snprintf(text, MOST_COMMAND,
           "hsr render %s --camera %s%s%s -a %s%s -s %dx%d -o %.*s%s",
           terminal_word(v->scene_name, scene, sizeof scene), v->camera_file,
           v->import.strict ? " --strict" : "",
           v->import.two_sided ? " --two-sided" : "",
           terminal_word(name, algorithm, sizeof algorithm), lines,
           v->m / v->coarse, v->n / v->coarse, (int)strlen(v->camera_file) - 5,
           v->camera_file, suffix);
}

static void save_camera(struct viewer *v) {
  struct hsr_error err = {HSR_OK, ""};
  char picture[MOST_COMMAND], lines[MOST_COMMAND] = "";
  new_name(v->camera_file, ".json");
  if (hsr_cameras_json_write(&v->camera, 1, v->camera_file, &err)) {
    viewer_say(v, "%s", err.text);
    return;
  }
  command_of(v, v->player[0], v->player[0]->variant.name, ".png", picture);
  if (v->has_lines && v->lines.is_ready)
    command_of(v, &v->lines, LINES_BY, ".svg", lines);
  viewer_say(v, "%s%s%s", picture, *lines ? "\n" : "", lines);
}

static void load_camera(struct viewer *v) {
  struct hsr_error err = {HSR_OK, ""};
  struct hsr_scene *cameras = hsr_scene_new("");
  if (!*v->camera_file)
    viewer_say(v, "no camera was saved: c saves it");
  else if (!cameras || hsr_cameras_json_read(cameras, v->camera_file, &err))
    viewer_say(v, "%s", cameras ? err.text : "out of memory");
  else {
    v->camera = cameras->views[0];
    v->library->camera(v->window, &v->camera);
  }
  hsr_scene_delete(cameras);
}

static void save_picture(struct viewer *v) {
  struct hsr_error err = {HSR_OK, ""};
  char name[40];
  new_name(name, ".png");
  if (v->frozen ? viewer_screenshot(v, name, &err)
                : viewer_save(v, v->rgb, name, &err))
    viewer_say(v, "%s", err.text);
  else
    viewer_say(v, "saved %s", name);
}

static void quit(struct viewer *v) {
  v->stopped = true;
  v->library->stop(v->window);
}

/* --- The table ------------------------------------------------------------ */

static const struct key {
  const char *name, *about; /* NULL: as the key before */
  void (*act)(struct viewer *);
  const char *label; /* what is on the key; NULL: the name */
} keys[] = {{"n", "next algorithm", next_algorithm},
            {"p", "previous algorithm", previous_algorithm},
            {"b", "two algorithms side by side", side_by_side},
            {"B", "  blinking", blink},
            {"x", "  their difference", difference},
            {"Tab", "  swap them", swap},
            {"f", "filtered, or point-sampled", filter},
            {"w", "work: how often samples are touched", work},
            {"d", "depth complexity", depth},
            {"e", "edges of faces", edges},
            {"l", "lines over the picture", lines},
            {"L", "  style: screen, iso, plotter", lines_next_style},
            {"H", "  hidden: none, dashed, thin, all", lines_next_hidden},
            {"period", "  creases: a greater angle", lines_more_crease, "."},
            {"comma", "  a smaller one, or all edges", lines_less_crease, ","},
            {"4", "  silhouettes off, or on", lines_switch_silhouettes},
            {"5", "  boundaries", lines_switch_boundaries},
            {"6", "  intersections", lines_switch_intersections},
            {"7", "  creases", lines_switch_creases},
            {"8", "  lines between colours", lines_switch_colours},
            {"9", "  seams and smooth lines", lines_switch_flat},
            {"v", "next view", next_view},
            {"V", "previous view", previous_view},
            {"space", "walk along the views", walk},
            {"1", "look from the front", look_front},
            {"2", "  from the right", look_right},
            {"3", "  from the top", look_top},
            {"a", "fit all in the window", fit},
            {"u", "level the horizon", level},
            {"o", "parallel, or perspective", project},
            {"z", "freeze, and look from elsewhere", freeze},
            {"bracketleft", "coarser", coarser, "["},
            {"bracketright", "finer", finer, "]"},
            {"plus", "more threads", more_threads, "+"},
            {"minus", "fewer threads", fewer_threads, "-"},
            {"t", "panel: times, steps, Table I, none", panel},
            {"s", "save the picture", save_picture},
            {"c", "save the camera", save_camera},
            {"C", "load that camera", load_camera},
            {"r", "load the scene again", viewer_reload},
            {"h", "help", help},
            {"q", "quit", quit},
            {"Escape", NULL, quit}};
enum { N_KEYS = sizeof keys / sizeof *keys };

static const struct key *find_key(const char *name) {
  for (int k = 0; k < N_KEYS; k++)
    if (!strcmp(keys[k].name, name))
      return &keys[k];
  return NULL;
}

bool keys_know(const char *name) {
  return find_key(name);
}

/* The lines of the help: of a key, or of the mouse. */
struct help_line {
  const char *label, *about;
};
enum { N_MOUSE = 4 };

static size_t list_help(struct help_line line[N_KEYS + N_MOUSE]) {
  static const struct help_line mouse[N_MOUSE] = {
      {"click", "the point and the faces there"},
      {"drag", "turn; with ctrl roll, with shift or"},
      {"", "  the middle button shift"},
      {"wheel", "nearer or farther; so the right button"}};
  size_t n = 0;
  for (int k = 0; k < N_KEYS; k++)
    if (keys[k].about)
      line[n++] = (struct help_line){
          keys[k].label ? keys[k].label : keys[k].name, keys[k].about};
  memcpy(line + n, mouse, sizeof mouse);
  return n + N_MOUSE;
}

void keys_help(char *text, size_t size) {
  struct help_line line[N_KEYS + N_MOUSE];
  const size_t n = list_help(line), rows = (n + 1) / 2;
  size_t used = 0;
  for (size_t k = 0; k < rows && used < size; k++)
    used += (size_t)snprintf(text + used, size - used, "%-6s %-36s %-6s %s\n",
                             line[k].label, line[k].about,
                             k + rows < n ? line[k + rows].label : "",
                             k + rows < n ? line[k + rows].about : "");
}

void keys_press(void *viewer, const char *name) {
  struct viewer *v = viewer;
  const struct key *key = find_key(name);
  if (!key)
    return;
  *v->message = *v->picked = '\0';
  key->act(v);
  if (!v->stopped) /* else there is no window any more */
    viewer_show(v);
}
