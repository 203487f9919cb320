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
#pragma GCC visibility push(protected) /* for modules: hsr-module.h */

struct hsr_arena {
  struct hsr_arena_block *blocks; /* newest first; NULL when empty */
  size_t used_bytes;              /* handed out since the last reset */
  size_t peak_bytes;              /* the most ever handed out */
  size_t n_blocks_taken;          /* calls of malloc over the arena's life */
};

/* The initialiser of an empty arena, which is all zero. */
#define HSR_ARENA_EMPTY                                                        \
  { 0 }

/* Returns an array of n elements of `size` bytes, aligned to 64 bytes for any
 * vector register. Its content is undefined. The arena owns it until the next
 * hsr_arena_reset or hsr_arena_free. NULL: memory ran out, or n * size
 * overflows. For n = 0 the pointer is not NULL. */
void *hsr_arena_array(struct hsr_arena *arena, size_t n, size_t size);

/* The same, with all bytes zero. */
void *hsr_arena_zeroed(struct hsr_arena *arena, size_t n, size_t size);

/* Forgets every array and keeps the memory. Several blocks are replaced by one
 * that is as large as all that was in use. If there is no memory for that one,
 * the arena is left without any block. */
void hsr_arena_reset(struct hsr_arena *arena);

/* Frees all memory. The arena is empty afterwards and may be used again. Its
 * peak_bytes and n_blocks_taken are kept. */
void hsr_arena_free(struct hsr_arena *arena);

/* An array that grows in an arena, by doubling. It is empty if it is all zero.
 * When it moves, the old copy stays in the arena until hsr_arena_reset. */
struct hsr_growing {
  void *items;    /* owned by the arena; NULL when room is 0 */
  size_t n, room; /* items in use, and items that there is room for */
};

/* Appends an item of `size` bytes, items[n - 1] of the new n, whose content is
 * undefined. All items of an array have the same size. False: memory ran out,
 * and the array is as it was. */
bool hsr_arena_grow(struct hsr_arena *arena, struct hsr_growing *array,
                    size_t size);

/* Asks the system to put `size` bytes of malloc'ed memory on huge pages. It
 * does so only if there are 4 MB or more, and only on Linux. With larger pages
 * there are fewer page faults and fewer misses in the processor's page tables.
 * It is a hint: nothing can fail. `memory` may be NULL. */
void hsr_huge_pages(void *memory, size_t size);

/* HSR_NEW(arena, T, n) is hsr_arena_array for n elements of type T.
 * HSR_NEW_ZEROED is hsr_arena_zeroed. */
#define HSR_NEW(arena, type, n)                                                \
  ((type *)hsr_arena_array((arena), (n), sizeof(type)))
#define HSR_NEW_ZEROED(arena, type, n)                                         \
  ((type *)hsr_arena_zeroed((arena), (n), sizeof(type)))

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif
#endif
