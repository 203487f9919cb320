/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One scene, opened by name, and one of its views. */
#ifndef HSR_BENCH_STAGE_H
#define HSR_BENCH_STAGE_H

#include "scenes/scenes.h"

#include "common/view/view.h"
#include "common/scene/world.h"

struct stage {
  struct hsr_scene *scene;
  struct hsr_world world;
  struct hsr_view view;
  double import_seconds;      /* to open the scene and make the world */
  struct hsr_import imported; /* what was left out of it */
};

/* Opens the scene that a user names, and its view number `view`, from 1. A
 * scene that has fewer views gets further ones on an orbit. Its faces are laid
 * out as hsr_world_open says, by so many threads. *stage is to be closed also
 * after a failure. Fails with whatever hsr_scene_open and hsr_view_init fail
 * with. */
enum hsr_status stage_open(struct stage *stage, const char *scene,
                           uint32_t most, long view, int m, int n, long threads,
                           struct hsr_error *err);
void stage_close(struct stage *stage);

/* Makes `n` views of an open stage, from view `first` on, in the size of its
 * own view. The last of them must not come after its own view. Fails with
 * whatever hsr_view_init fails with. */
enum hsr_status stage_walk(const struct stage *stage, long first, int n,
                           struct hsr_view *view, struct hsr_error *err);

#endif
