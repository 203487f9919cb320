/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A scene that is open and laid out, and one view of it. */
#ifndef HSR_BENCH_OPTIONS_PLACE_H
#define HSR_BENCH_OPTIONS_PLACE_H

#include "bench/options/view.h"
#include "common/scene/world.h"

struct place {
  struct hsr_scene *scene;
  struct hsr_world world;
  struct hsr_view view;
};

/* Adds the cameras to the scene's name, and opens what the options name for a
 * subcommand. To be closed also after a failure. HSR_E_NOMEM also if there are
 * too many faces to be laid out; else as aim_scene, open_scene and
 * choose_view. */
enum hsr_status place_open(struct place *place, struct scene_options *scene,
                           struct view_options *view, const char *command,
                           struct hsr_error *err);
void place_close(struct place *place);

#endif
