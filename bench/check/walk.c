/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr check --frames: a scene for each frame. Frames of one scene whose objects
 * move are a walk; others are judged one by one. */
#include "bench/check/check.h"
#include "bench/options/scene.h"
#include "bench/options/words.h"
#include "common/scene/motion.h"

#include <stdlib.h>

static enum hsr_status open_frame(const struct scene_run *run, long frame,
                                  struct hsr_scene **scene,
                                  struct hsr_error *err) {
  char name[MOST_FILE_NAME];
  if (!series_name(run->name, frame, name))
    return hsr_fail(err, HSR_E_USAGE,
                    "%.200s: of several frames, SCENE must have one %%d in the "
                    "place of the number, as in traffic:20:%%d",
                    run->name);
  return open_scene(name, run->options->import, scene, err);
}

/* With --views N, frames are seen from the first N views in turn. */
static uint32_t view_of(const struct check_options *o, int k) {
  return (uint32_t)(k % (o->first_views ? o->first_views : 1));
}

static enum hsr_status add_views(struct hsr_scene *scene, uint32_t view,
                                 struct hsr_error *err) {
  return scene->n_views <= view &&
                 hsr_scene_add_orbit(scene, view + 1 - scene->n_views)
             ? hsr_fail_nomem(err)
             : HSR_OK;
}

static enum hsr_status make_views(struct scene_run *run,
                                  struct hsr_error *err) {
  const struct check_options *o = run->options;
  enum hsr_status status = HSR_OK;
  run->view = calloc((size_t)(o->n_sizes * o->n_views), sizeof *run->view);
  if (!run->view)
    return hsr_fail_nomem(err);
  for (int k = 0; k < o->n_sizes * o->n_views && !status; k++) {
    int frame = k % o->n_views, size = k / o->n_views;
    struct hsr_scene *scene = run->walk.frame[frame];
    uint32_t view = view_of(o, frame);
    status = add_views(scene, view, err);
    if (!status)
      status = hsr_view_init_of(&run->view[k], scene, view, o->m[size],
                                o->n[size], err);
  }
  return status;
}

/* Whether the frames are of one scene that moves. */
static bool is_walk(const struct walk *walk) {
  bool one = hsr_scene_moves(walk->frame[0]);
  for (int k = 1; k < walk->n; k++)
    one = one && hsr_scene_has_frame(walk->frame[0], walk->frame[k]);
  return one;
}

/* Opens the follower, and tries its way. */
static enum hsr_status open_follower(struct scene_run *run,
                                     struct hsr_error *err) {
  struct walk *walk = &run->walk;
  long first = run->options->first_frame;
  if (!is_walk(walk))
    return HSR_OK;
  enum hsr_status status = open_frame(run, first, &walk->follower, err);
  for (int k = 0; k <= walk->n && !status; k++) {
    struct hsr_error why;
    status = hsr_scene_follow(walk->follower, walk->frame[k % walk->n], &why);
    if (status)
      return hsr_fail(err, status, "%.150s, frame %ld: %.300s", run->name,
                      first + k % walk->n, why.text);
  }
  return status;
}

enum hsr_status open_walk(struct scene_run *run, struct hsr_error *err) {
  const struct check_options *o = run->options;
  struct walk *walk = &run->walk;
  enum hsr_status status = HSR_OK;
  walk->frame = calloc((size_t)o->n_views, sizeof *walk->frame);
  if (!walk->frame)
    return hsr_fail_nomem(err);
  for (; walk->n < o->n_views && !status; walk->n += !status)
    status =
        open_frame(run, o->first_frame + walk->n, &walk->frame[walk->n], err);
  if (status)
    return status;
  run->scene = walk->frame[0];
  status = open_follower(run, err);
  return status ? status : make_views(run, err);
}

void close_walk(struct scene_run *run) {
  for (int k = 0; k < run->walk.n; k++)
    hsr_scene_delete(run->walk.frame[k]);
  hsr_scene_delete(run->walk.follower);
  free(run->walk.frame);
  if (run->walk.n)
    run->scene = NULL;
}
