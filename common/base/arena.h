/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Memory that is given back all at once.
 *
 * An arena is a list of blocks from which arrays are cut one after another.
 * `hsr_arena_reset` forgets the arrays but keeps the memory, as one block large
 * enough for all that was in use. So a module that asks for the same arrays
 * every frame calls malloc in its first frames only. */
#ifndef HSR_COMMON_ARENA_H
#define HSR_COMMON_ARENA_H

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_arena {
  struct hsr_arena_block *blocks; /* newest first; NULL when empty */
  size_t used_bytes;              /* handed out since the last reset */
  size_t peak_bytes;              /* the most ever handed out */
  size_t n_blocks_taken;          /* calls of malloc over the arena's life */
};

/* An empty arena is all zero. */
#define HSR_ARENA_EMPTY                                                        \
  { 0 }

/* An array of n elements of `size` bytes, aligned to 64 bytes for any vector
 * register. Its content is undefined; the arena owns it. NULL if memory ran out
 * or n * size overflows; never NULL otherwise, not even for n = 0. */
void *hsr_arena_array(struct hsr_arena *arena, size_t n, size_t size);

/* The same, with all bytes zero. */
void *hsr_arena_zeroed(struct hsr_arena *arena, size_t n, size_t size);

/* Forgets every array and keeps the memory. Several blocks are replaced by one;
 * if that fails, they are only freed. */
void hsr_arena_reset(struct hsr_arena *arena);

/* Gives all memory back. The arena is empty afterwards and may be used again.
 */
void hsr_arena_free(struct hsr_arena *arena);

/* An array that grows in an arena, by doubling. All zero is an empty one. After
 * it has moved, the old copy stays in the arena until the reset. */
struct hsr_growing {
  void *items;
  size_t n, room;
};

/* Appends an item of `size` bytes, its content undefined. False if memory ran
 * out. */
bool hsr_arena_grow(struct hsr_arena *arena, struct hsr_growing *array,
                    size_t size);

/* Asks the system for huge pages where memory of malloc is large: there are fewer
 * pages to make, and the processor's tables, which hold few, reach further. */
void hsr_huge_pages(void *memory, size_t size);

/* HSR_NEW(arena, T, n): an array of n T. */
#define HSR_NEW(arena, type, n)                                                \
  ((type *)hsr_arena_array((arena), (n), sizeof(type)))
#define HSR_NEW_ZEROED(arena, type, n)                                         \
  ((type *)hsr_arena_zeroed((arena), (n), sizeof(type)))

#ifdef __cplusplus
}
#endif
#endif
