/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/options/view.h"
#include "bench/options/words.h"

#include <limits.h>

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

error_t parse_place_option(struct scene_options *scene,
                           struct view_options *view, int key, char *arg,
                           const char *command, struct option_base *base) {
  error_t error = parse_scene_option(scene, key, arg, command, base);
  return error == ARGP_ERR_UNKNOWN ? parse_view_option(view, key, arg, base)
                                   : error;
}

enum hsr_status aim_scene(struct scene_options *scene,
                          struct view_options *view, struct hsr_error *err) {
  enum hsr_status status = aim_name(&view->camera, view->view, view->m, view->n,
                                    scene->name, scene->aimed, err);
  scene->name = scene->aimed;
  if (has_camera_words(&view->camera))
    view->view = 1;
  return status;
}

enum hsr_status check_view(const struct hsr_scene *scene, long view,
                           struct hsr_error *err) {
  if (view <= (long)scene->n_views)
    return HSR_OK;
  return hsr_fail(err, HSR_E_USAGE, "%s has %u views; there is no view %ld",
                  scene->name, scene->n_views, view);
}

enum hsr_status choose_view(const struct view_options *o,
                            const struct hsr_scene *scene, int samples,
                            struct hsr_view *view, struct hsr_error *err) {
  enum hsr_status status = check_view(scene, o->view, err);
  if (status)
    return status;
  return hsr_view_init_of(view, scene, (uint32_t)o->view - 1, samples * o->m,
                          samples * o->n, err);
}
