/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One face of a scene, laid out by itself. It serves algorithms that ask about
 * few faces of a scene that is not laid out. */
#ifndef HSR_COMMON_ALONE_H
#define HSR_COMMON_ALONE_H

#include "common/exact/screen.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_alone {
  struct hsr_world world; /* has one face, 0, whose plane is not found */
  uint32_t id;            /* the scene's id of that face; HSR_NO_ID: none yet */
  struct hsr_screen screen;
};

/* Makes room for one face. `scene` is the world that the ids belong to, laid
 * out or a roster. The faces of a grid must be made. All arguments are borrowed
 * and must outlive *alone, whose arrays are in the arena. *alone must not be
 * copied or moved. HSR_E_NOMEM. */
enum hsr_status hsr_alone_init(struct hsr_alone *alone,
                               const struct hsr_world *scene,
                               const struct hsr_view *view,
                               struct hsr_arena *arena);

/* Lays out the scene's face `id` as face 0 of alone->world and transforms its
 * vertices to alone->screen. Does nothing if it is that face already. */
void hsr_alone_take(struct hsr_alone *alone, uint32_t id);

#ifdef __cplusplus
}
#endif
#endif
