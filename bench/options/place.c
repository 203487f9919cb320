/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/options/place.h"

enum hsr_status place_open(struct place *place, struct scene_options *scene,
                           struct view_options *view, const char *command,
                           struct hsr_error *err) {
  *place = (struct place){.scene = NULL};
  enum hsr_status status = aim_scene(scene, view, err);
  if (!status)
    status = open_scene(scene->name, scene->import, &place->scene, err);
  if (!status)
    status = choose_view(view, place->scene, 1, &place->view, err);
  if (!status)
    status =
        hsr_world_open(&place->world, place->scene, HSR_MOST_LAID_OUT, err);
  if (!status && hsr_is_roster(&place->world))
    status =
        hsr_fail(err, HSR_E_NOMEM, "%s: %u faces are too many to be laid out",
                 command, place->world.n_faces);
  return status;
}

void place_close(struct place *place) {
  hsr_world_free(&place->world);
  hsr_scene_delete(place->scene);
}
