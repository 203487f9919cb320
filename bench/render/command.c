/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr render: pictures, or line drawings, by one algorithm. */
#include "bench/modules/variant.h"
#include "bench/options/command.h"
#include "bench/options/words.h"
#include "bench/render/render.h"
#include "bench/ranks/ranks.h"
#include "bench/run/crew.h"
#include "bench/terminal/pixels.h"
#include "bench/terminal/terminal.h"
#include "common/base/clock.h"
#include "common/files/suffix.h"
#include "common/scene/motion.h"
#include "scenes/cameras.h"

#include <stdlib.h>
#include <sys/resource.h>

/* Opens the scene, of several frames the current one. */
static enum hsr_status open_named(struct render *r, struct hsr_scene **scene,
                                  struct hsr_error *err) {
  const struct render_options *o = r->options;
  double begin = hsr_seconds_now();
  char frame[MOST_FILE_NAME];
  const char *name = o->scene.name;
  if (o->last_frame >= 0 && series_name(name, r->frame, frame))
    name = frame;
  enum hsr_status status = open_scene(name, o->scene.import, scene, err);
  if (!status && r->frame == o->first_frame)
    say_map(name, *scene);
  r->import += hsr_seconds_now() - begin;
  return status;
}

/* Chooses the view of a scene. */
static enum hsr_status choose_place(struct render *r, struct hsr_scene *scene,
                                    struct hsr_error *err) {
  const struct render_options *o = r->options;
  struct view_options place = o->view;
  if (o->tile)
    place.m = place.n = 1; /* each tile has a view of its own */
  if (o->last_frame >= 0 && o->first)
    place.view = o->first + r->frame - o->first_frame;
  r->view_number = o->last_frame < 0 ? o->view.view : r->frame;
  return choose_view(&place, scene, (int)o->supersamples, &r->view, err);
}

/* Chooses the view of a scene that is open, and opens its world. */
static enum hsr_status open_place(struct render *r,
                                  const struct hsr_algorithm *a,
                                  const struct hsr_choice *choice,
                                  struct hsr_error *err) {
  const struct render_options *o = r->options;
  double begin = hsr_seconds_now();
  enum hsr_status status = choose_place(r, r->scene, err);
  if (!status && o->orbit)
    status = hsr_scene_turn(r->scene, (uint32_t)o->view.view - 1,
                            (uint32_t)o->orbit, err);
  if (!status)
    status = hsr_setup_world(&r->world, a, choice, r->scene, err);
  r->build += hsr_seconds_now() - begin;
  return status;
}

/* "view 3", "views 1-153", "72 views of a turn" or "4 views". */
static void print_views(const struct render *r, char *text, size_t size) {
  const struct render_options *o = r->options;
  if (o->last_frame >= 0)
    snprintf(text, size, "frames %ld-%ld", o->first_frame, o->last_frame);
  else if (o->first)
    snprintf(text, size, "views %ld-%ld", o->first, o->last);
  else if (o->orbit)
    snprintf(text, size, "a turn from view %ld", o->view.view);
  else if (r->n_on_sheet)
    snprintf(text, size, "%zu views", r->n_on_sheet);
  else
    snprintf(text, size, "view %ld", o->view.view);
}

/* "512 x 512 samples", "512 x 512 pixels of 4 x 4 samples", or "a sheet of 190 x
 * 110 mm". */
static void print_size(const struct render *r, char *text, size_t size) {
  const struct render_options *o = r->options;
  const int m = r->n_tiles ? o->view.m : r->view.m,
            n = r->n_tiles ? o->view.n : r->view.n, s = (int)o->supersamples;
  if (r->n_on_sheet)
    snprintf(text, size, "a sheet of %.0f x %.0f mm", r->sheet_mm[0],
             r->sheet_mm[1]);
  else if (s > 1)
    snprintf(text, size, "%d x %d pixels of %d x %d %s", m / s, n / s, s, s,
             r->kind->grains);
  else
    snprintf(text, size, "%d x %d %s", m, n, r->kind->grains);
}

/* A picture that goes to no file, and is alone, is shown on a terminal. */
static bool wants_showing(const struct render_options *o) {
  return !o->n_outputs && !o->work && !o->tile && !o->sort_last && !o->sheet &&
         !is_series(o) && pixels_known() != PIXELS_NONE;
}

static void show_on_terminal(struct render *r) {
  const int report = 6; /* lines below it */
  if (r->shows && r->shaded.rgb)
    r->shows = pixels_show(pixels_known(), r->view.m, r->view.n, r->shaded.rgb,
                           report);
}

static void print_report(struct render *r, const struct hsr_algorithm *a) {
  char name[TERMINAL_NAME];
  char views[100], size[100];
  print_views(r, views, sizeof views);
  print_size(r, size, sizeof size);
  printf("%s, %s, %s, %u faces, by %s: ",
         terminal_plain(r->options->scene.name, name, sizeof name), views, size,
         r->options->sort_last ? r->n_faces : r->world.n_faces, a->name);
  struct hsr_showing showing = showing_of(r);
  showing.drawn = &r->drawn;
  if (r->n_tiles)
    printf("%ld tiles, of which %ld were there\n", r->n_tiles, r->n_found);
  else if (is_series(r->options))
    printf("%ld pictures\n", r->n_pictures);
  else
    r->kind->print(&r->answer, &showing, stdout);
  if (r->exposure > 0)
    printf("its brightest pixel was made white, by exposure=%.6g\n",
           r->exposure);
  for (int k = 0; k < r->setup.n_adaptations; k++) {
    const struct hsr_adaptation *adaptation = &r->setup.adaptation[k];
    printf("adapted: %s, %u faces, %.1f ms\n", adaptation->name,
           adaptation->n_faces, 1e3 * adaptation->seconds);
  }
  if (r->options->last_frame >= 0 && r->setup.flags & HSR_FRAME_STATE)
    printf("what it keeps from frame to frame was kept %ld of %ld times\n",
           r->n_kept, r->options->last_frame - r->options->first_frame);
  if (hsr_scene_is_transparent(r->scene) && !r->kind->sees_through)
    printf("the scene has transparent faces; they are drawn as opaque ones\n");
  if (r->setup.flags & HSR_KNOWN_WRONG)
    printf("%s is known to be wrong; hsr judge tells of a picture where\n",
           a->name);
  char times[300];
  if (r->options->sort_last)
    snprintf(times, sizeof times,
             "ms: import %.1f, build %.1f, render %.2f, compose %.1f, shade "
             "%.1f, write %.1f",
             1e3 * r->import, 1e3 * r->build, 1e3 * r->draw, 1e3 * r->compose,
             1e3 * r->shade, 1e3 * r->write);
  else
    snprintf(times, sizeof times,
             "ms: import %.1f, build %.1f, adapt %.1f, prepare %.1f, render "
             "%.2f, shade %.1f, write %.1f",
             1e3 * r->import, 1e3 * r->build, 1e3 * r->setup.adapt_seconds,
             1e3 * r->setup.prepare_seconds, 1e3 * r->draw, 1e3 * r->shade,
             1e3 * r->write);
  terminal_wrap(stdout, 0, 4, times);
  if (!r->options->n_outputs && !r->options->work)
    puts(r->shaded.rgb && r->shows
             ? "-o FILE writes the picture"
             : "nothing was written: -o FILE writes the picture");
  if (!r->options->work)
    return;
  for (int k = 0; a->counters && a->counters[k].name; k++) {
    int used = printf("%-18s %14llu  ", a->counters[k].name,
                      (unsigned long long)r->tally.count[k]);
    terminal_wrap(stdout, used, 35, a->counters[k].meaning);
  }
}

/* What each rank tells rank 0 of its work. */
enum { SECONDS, PARTS, MESSAGES, BYTES, MEMORY, COMPARED, N_FIGURES };

/* The largest of n ranks' shares over their mean. */
static double largest_share(const double (*of)[N_FIGURES], int n, int figure) {
  double sum = 0, most = 0;
  for (int k = 0; k < n; k++) {
    sum += of[k][figure];
    most = of[k][figure] > most ? of[k][figure] : most;
  }
  return sum > 0 ? most * n / sum : 1;
}

static double sum_of(const double (*of)[N_FIGURES], int n, int figure) {
  double sum = 0;
  for (int k = 0; k < n; k++)
    sum += of[k][figure];
  return sum;
}

/* How the work was shared out, if there are several ranks. All of them call
 * this. */
static enum hsr_status print_ranks(const struct render *r,
                                   struct hsr_error *err) {
  int n = ranks_count();
  const char *parts = r->n_tiles ? "tiles" : r->n_drawn ? "parts" : "windows";
  if (n == 1)
    return HSR_OK;
  double(*of)[N_FIGURES] = calloc((size_t)n, sizeof *of);
  if (!of)
    return hsr_fail_nomem(err);
  struct crew_work work = crew_work(r->crew);
  struct rusage usage = {.ru_maxrss = 0};
  getrusage(RUSAGE_SELF, &usage);
  const double own[N_FIGURES] = {[SECONDS] = work.seconds,
                                 [PARTS] = r->n_tiles   ? (double)r->n_pictures
                                           : r->n_drawn ? (double)r->n_drawn
                                                        : work.parts,
                                 [MESSAGES] = work.messages + r->sent_messages,
                                 [BYTES] = work.bytes + r->sent_bytes,
                                 [MEMORY] = (double)usage.ru_maxrss / 1024,
                                 [COMPARED] = r->compared};
  ranks_gather(own, N_FIGURES, of[0]);
  char text[400];
  double memory = 0;
  for (int k = 0; k < n; k++)
    memory = of[k][MEMORY] > memory ? of[k][MEMORY] : memory;
  int length = snprintf(
      text, sizeof text,
      "%d ranks: %.0f %s; largest share over the mean: %.2f of the seconds, "
      "%.2f of the %s; %.0f messages, %.0f bytes; at most %.0f MB a rank",
      n, sum_of(of, n, PARTS), parts, largest_share(of, n, SECONDS),
      largest_share(of, n, PARTS), parts, sum_of(of, n, MESSAGES),
      sum_of(of, n, BYTES), memory);
  if (r->n_drawn)
    snprintf(text + length, sizeof text - (size_t)length,
             "; %.0f times two faces compared", sum_of(of, n, COMPARED));
  free(of);
  terminal_wrap(stdout, 0, 4, text);
  return HSR_OK;
}

/* Makes the pictures of several views, or of a turn. */
static enum hsr_status make_series(struct render *r, struct hsr_error *err) {
  const struct render_options *o = r->options;
  const long first = o->orbit ? 1 : o->first,
             last = o->orbit ? o->orbit : o->last;
  struct view_options place = o->view;
  struct progress progress = progress_begin(stderr);
  enum hsr_status status = check_view(r->scene, last, err);
  for (long k = first; k <= last && !status; k++) {
    progress_tell(&progress, (size_t)(k - first), (size_t)(last - first + 1),
                  "pictures", o->scene.name);
    r->view_number = place.view = k;
    status = choose_view(&place, r->scene, (int)o->supersamples, &r->view, err);
    if (!status)
      status = make_picture(r, err);
  }
  progress_end(&progress);
  return status;
}

/* Whether face ids or their depths are asked for. */
static bool wants_ids(const struct render_options *o) {
  for (int k = 0; k < o->n_outputs; k++)
    if (hsr_is_depth_file(o->output[k]) ||
        (hsr_is_array_file(o->output[k]) && !hsr_is_colour_array(o->output[k])))
      return true;
  return false;
}

/* A scene with transparent faces is drawn transparent, if the algorithm can do
 * that and nothing else was asked for. */
static void ask_for_transparency(const struct render *r,
                                 struct hsr_variant *variant) {
  const struct render_options *o = r->options;
  const struct hsr_algorithm *a = variant->listed->plain;
  if (variant->choice.form.type != hsr_own_kind(a) ||
      !hsr_scene_is_transparent(r->scene) || o->given[HSR_SHADING] ||
      o->given[HSR_SUPERSAMPLES] || wants_ids(o))
    return;
  for (int k = 0; hsr_makes_besides(a, k); k++)
    if (hsr_makes_besides(a, k)->sees_through)
      variant->choice.form = hsr_form_standard(hsr_makes_besides(a, k));
}

/* Makes ready for the scene, which is open. */
static enum hsr_status prepare(struct render *r, const struct hsr_algorithm *a,
                               struct hsr_variant *variant,
                               struct hsr_error *err) {
  ask_for_transparency(r, variant);
  enum hsr_status status = open_place(r, a, &variant->choice, err);
  if (status)
    return status;
  r->kind = variant->choice.form.type;
  return hsr_setup_init(&r->setup, a, &variant->choice, &r->world, err);
}

static enum hsr_status open_and_prepare(struct render *r,
                                        const struct hsr_algorithm *a,
                                        struct hsr_variant *variant,
                                        struct hsr_error *err) {
  enum hsr_status status = open_named(r, &r->scene, err);
  return status ? status : prepare(r, a, variant, err);
}

/* Moves what moves to where it is in a frame. */
static enum hsr_status follow(struct render *r, const struct hsr_scene *then,
                              struct hsr_error *err) {
  struct hsr_error why;
  if (!hsr_scene_follow(r->scene, then, &why))
    return HSR_OK;
  return hsr_fail(err, why.status, "%.150s, frame %ld: %.300s",
                  r->options->scene.name, r->frame, why.text);
}

/* Lays a frame out in the place of the last one. *kept: what was prepared is
 * kept. */
static enum hsr_status lay_out(struct render *r, const struct hsr_algorithm *a,
                               struct hsr_scene *then, bool *kept,
                               struct hsr_error *err) {
  double begin = hsr_seconds_now();
  hsr_world_free(&r->world);
  r->world = (struct hsr_world){.n_faces = 0};
  hsr_scene_delete(r->scene);
  r->scene = then;
  enum hsr_status status = choose_place(r, then, err);
  if (!status)
    status = hsr_setup_world(&r->world, a, &r->setup.choice, then, err);
  r->build += hsr_seconds_now() - begin;
  return status ? status : hsr_setup_follow(&r->setup, &r->world, kept, err);
}

/* Whether a frame that is laid out may be followed. */
static bool may_follow(const struct render *r, const struct hsr_scene *then) {
  return r->setup.flags & HSR_FOLLOWS && hsr_scene_has_objects(r->scene, then);
}

/* Goes on to the current frame. What is prepared is kept if nothing moves; or if
 * objects move, and the algorithm takes them as a roster, or follows. If not,
 * all is made anew. */
static enum hsr_status go_on(struct render *r, const struct hsr_algorithm *a,
                             struct hsr_variant *variant,
                             struct hsr_error *err) {
  struct hsr_scene *then = NULL;
  enum hsr_status status = open_named(r, &then, err);
  if (status)
    return status;
  bool roster = hsr_is_roster(&r->world), kept = true;
  bool stays = hsr_scene_is_same(r->scene, then);
  bool moves = roster && hsr_scene_moves(r->scene) &&
               hsr_scene_has_frame(r->scene, then);
  if (stays || moves) {
    status = choose_place(r, then, err);
    if (!status && moves)
      status = follow(r, then, err);
    hsr_scene_delete(then);
  } else if (!roster && may_follow(r, then)) {
    status = lay_out(r, a, then, &kept, err);
  } else {
    kept = false;
    render_forget_scene(r);
    r->scene = then;
    status = prepare(r, a, variant, err);
  }
  r->n_kept += kept;
  return status;
}

/* Makes the pictures of a scene's frames; only the last one stays in *r. */
static enum hsr_status make_frames(struct render *r,
                                   const struct hsr_algorithm *a,
                                   struct hsr_variant *variant,
                                   struct hsr_error *err) {
  const struct render_options *o = r->options;
  struct progress progress = progress_begin(stderr);
  enum hsr_status status = HSR_OK;
  for (long k = o->first_frame; k <= o->last_frame && !status; k++) {
    progress_tell(&progress, (size_t)(k - o->first_frame),
                  (size_t)(o->last_frame - o->first_frame + 1), "frames",
                  o->scene.name);
    r->frame = k;
    status = k > o->first_frame ? go_on(r, a, variant, err)
                                : open_and_prepare(r, a, variant, err);
    if (!status)
      status = make_picture(r, err);
  }
  progress_end(&progress);
  return status;
}

enum hsr_status command_render(int argc, char **argv, struct hsr_error *err) {
  struct render_options options;
  struct hsr_variant variant;
  enum hsr_status status = render_parse(argc, argv, &options, &variant, err);
  if (status)
    return status;
  const struct hsr_algorithm *a =
      options.work ? variant.listed->counting : variant.listed->plain;

  struct render r = {.options = &options,
                     .crew = crew_new(options.threads),
                     .shows = wants_showing(&options)};
  status = r.crew ? HSR_OK : hsr_fail_nomem(err);
  if (!status && !options.tile && !options.sort_last)
    crew_join_ranks(r.crew);
  /* Parts and frames are opened one by one, as they are drawn. */
  bool one_by_one = options.sort_last || options.last_frame >= 0;
  if (!status && !one_by_one)
    status = open_and_prepare(&r, a, &variant, err);
  if (!status)
    status = options.sort_last         ? make_sort_last(&r, a, &variant, err)
             : options.last_frame >= 0 ? make_frames(&r, a, &variant, err)
             : options.tile            ? make_tiles(&r, err)
             : options.sheet           ? make_sheet(&r, err)
             : is_series(&options)     ? make_series(&r, err)
                                       : make_picture(&r, err);
  if (!status && !ranks_own()) {
    show_on_terminal(&r);
    print_report(&r, a);
  }
  if (!status && !ranks_own())
    status = say_notes(&r, err);
  if (!status)
    status = print_ranks(&r, err);
  render_close(&r);
  hsr_scene_delete(r.scene);
  return status;
}
