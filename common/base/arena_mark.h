/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Memory of an arena that is given back before all the rest: what a part of some
 * work took, before the next part begins. */
#ifndef HSR_COMMON_ARENA_MARK_H
#define HSR_COMMON_ARENA_MARK_H

#include "common/base/arena.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(protected) /* for modules: hsr-module.h */

/* How much of an arena was taken. Valid until the arena is reset or freed. */
struct hsr_arena_mark {
  struct hsr_arena_block *block; /* the newest, or NULL; owned by the arena */
  size_t used;                   /* bytes of it */
  size_t used_bytes;             /* of the arena */
};

/* Returns how much is taken now. */
struct hsr_arena_mark hsr_arena_mark(const struct hsr_arena *arena);

/* Forgets every array that was taken since the mark, and frees the blocks that
 * were taken for them. The mark stays valid. */
void hsr_arena_return(struct hsr_arena *arena,
                      const struct hsr_arena_mark *mark);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif
#endif
