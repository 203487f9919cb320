/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One face of a scene that is not laid out, laid out by itself: for what only
 * few faces are asked about. */
#ifndef HSR_COMMON_ALONE_H
#define HSR_COMMON_ALONE_H

#include "common/exact/screen.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_alone {
  struct hsr_world world; /* of one face; its plane is not found */
  uint32_t id;            /* which it is, in the scene; HSR_NO_ID: none yet */
  struct hsr_screen screen;
};

/* `scene` is the world that the ids belong to, laid out or an outline. All
 * arguments are borrowed. *alone must not be moved, and lasts as long as the
 * arena's arrays. HSR_E_NOMEM. */
enum hsr_status hsr_alone_init(struct hsr_alone *alone,
                               const struct hsr_world *scene,
                               const struct hsr_view *view,
                               struct hsr_arena *arena);

/* Makes the scene's face `id` face 0 of alone->world, and takes its vertices to
 * the screen. */
void hsr_alone_take(struct hsr_alone *alone, uint32_t id);

#ifdef __cplusplus
}
#endif
#endif
