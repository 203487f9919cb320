/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/base/arena.h"
#include "common/base/arena_mark.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#ifdef __linux__
#include <sys/mman.h>
#endif

enum { ALIGNMENT = 64, SMALLEST_BLOCK = 1 << 16, HUGE_PAGE = 1 << 21 };

struct hsr_arena_block {
  struct hsr_arena_block *next;
  size_t size, used; /* bytes of `memory` */
  unsigned char *memory;
};

void hsr_huge_pages(void *memory, size_t size) {
#ifdef MADV_HUGEPAGE
  enum { PAGE = 1 << 16 }; /* or less */
  size_t before = (PAGE - (uintptr_t)memory % PAGE) % PAGE;
  if (memory && size >= 2 * HUGE_PAGE)
    madvise((char *)memory + before, (size - before) / PAGE * PAGE,
            MADV_HUGEPAGE);
#else
  (void)memory, (void)size;
#endif
}

/* Large blocks lie on huge pages. A picture's rows are far apart. */
static unsigned char *block_memory(size_t size) {
  if (size < 2 * HUGE_PAGE)
    return aligned_alloc(ALIGNMENT, size);
  size_t rounded = (size + HUGE_PAGE - 1) / HUGE_PAGE * HUGE_PAGE;
  unsigned char *memory = aligned_alloc(HUGE_PAGE, rounded);
  hsr_huge_pages(memory, rounded);
  return memory;
}

static struct hsr_arena_block *block_new(struct hsr_arena *arena, size_t size) {
  struct hsr_arena_block *block = malloc(sizeof *block);
  if (!block)
    return NULL;
  block->memory = block_memory(size);
  if (!block->memory) {
    free(block);
    return NULL;
  }
  block->size = size;
  block->used = 0;
  block->next = arena->blocks;
  arena->blocks = block;
  arena->n_blocks_taken++;
  return block;
}

void *hsr_arena_array(struct hsr_arena *arena, size_t n, size_t size) {
  if (size && n > (SIZE_MAX / 2) / size)
    return NULL;
  size_t bytes = (n * size + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
  struct hsr_arena_block *block = arena->blocks;
  if (!block || block->size - block->used < bytes) {
    /* By doubling, the number of blocks is logarithmic in their total size. */
    size_t wanted = block ? 2 * block->size : SMALLEST_BLOCK;
    if (wanted < bytes)
      wanted = bytes;
    block = block_new(arena, wanted);
    if (!block && wanted > bytes && bytes)
      block = block_new(arena, bytes);
    if (!block)
      return NULL;
  }
  void *array = block->memory + block->used;
  block->used += bytes;
  arena->used_bytes += bytes;
  if (arena->peak_bytes < arena->used_bytes)
    arena->peak_bytes = arena->used_bytes;
  return array;
}

void *hsr_arena_zeroed(struct hsr_arena *arena, size_t n, size_t size) {
  void *array = hsr_arena_array(arena, n, size);
  if (array)
    memset(array, 0, n * size);
  return array;
}

bool hsr_arena_grow(struct hsr_arena *arena, struct hsr_growing *array,
                    size_t size) {
  if (array->n == array->room) {
    size_t room = array->room ? 2 * array->room : 1024;
    void *items = hsr_arena_array(arena, room, size);
    if (!items)
      return false;
    if (array->n)
      memcpy(items, array->items, array->n * size);
    array->items = items;
    array->room = room;
  }
  array->n++;
  return true;
}

/* Frees the blocks that are newer than `last`; NULL: all. */
static void free_blocks(struct hsr_arena *arena, struct hsr_arena_block *last) {
  for (struct hsr_arena_block *block = arena->blocks, *next; block != last;
       block = next) {
    next = block->next;
    free(block->memory);
    free(block);
  }
  arena->blocks = last;
}

void hsr_arena_reset(struct hsr_arena *arena) {
  if (arena->blocks && arena->blocks->next) {
    size_t used = arena->used_bytes;
    free_blocks(arena, NULL);
    block_new(arena, used);
  }
  if (arena->blocks)
    arena->blocks->used = 0;
  arena->used_bytes = 0;
}

void hsr_arena_free(struct hsr_arena *arena) {
  free_blocks(arena, NULL);
  arena->used_bytes = 0;
}

struct hsr_arena_mark hsr_arena_mark(const struct hsr_arena *arena) {
  return (struct hsr_arena_mark){arena->blocks,
                                 arena->blocks ? arena->blocks->used : 0,
                                 arena->used_bytes};
}

void hsr_arena_return(struct hsr_arena *arena,
                      const struct hsr_arena_mark *mark) {
  free_blocks(arena, mark->block);
  if (mark->block)
    mark->block->used = mark->used;
  arena->used_bytes = mark->used_bytes;
}
