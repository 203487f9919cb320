/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Memory of a frame: arrays that are aligned and apart, what is given back at a
 * mark, and one block after a reset. */
#include "common/base/arena.h"
#include "common/base/arena_mark.h"
#include "tests/tap.h"

#include <stdint.h>
#include <string.h>

enum { SOME = 1000, MUCH = 1 << 20 }; /* bytes: within a block, beyond one */

static bool is_filled(const unsigned char *array, size_t n, int with) {
  for (size_t k = 0; k < n; k++)
    if (array[k] != with)
      return false;
  return true;
}

static unsigned char *filled(struct hsr_arena *arena, size_t n, int with) {
  unsigned char *array = hsr_arena_array(arena, n, 1);
  if (array)
    memset(array, with, n);
  return array;
}

static void test_arrays(struct tap *tap) {
  static const size_t sizes[] = {1, 63, 64, 65, SOME, MUCH, 7, 3 * MUCH};
  enum { N = sizeof sizes / sizeof *sizes };
  struct hsr_arena arena = HSR_ARENA_EMPTY;
  unsigned char *array[N];
  bool aligned = true, whole = true;
  for (int k = 0; k < N; k++) {
    array[k] = filled(&arena, sizes[k], k + 1);
    aligned &= array[k] && (uintptr_t)array[k] % 64 == 0;
  }
  for (int k = 0; k < N; k++)
    whole &= array[k] && is_filled(array[k], sizes[k], k + 1);
  ok(tap, aligned, "arrays begin at multiples of 64 bytes");
  ok(tap, whole, "no two of them share a byte");
  ok(tap, !hsr_arena_array(&arena, SIZE_MAX / 2, 4),
     "none is too large to count");
  unsigned char *zeroed = hsr_arena_zeroed(&arena, SOME, 4);
  ok(tap, zeroed && is_filled(zeroed, 4 * SOME, 0), "zeroed ones are zero");
  hsr_arena_free(&arena);
}

static void test_mark(struct tap *tap) {
  struct hsr_arena arena = HSR_ARENA_EMPTY;
  const struct hsr_arena_mark none = hsr_arena_mark(&arena);
  unsigned char *kept = filled(&arena, SOME, 1);
  const size_t used = arena.used_bytes;
  const struct hsr_arena_mark mark = hsr_arena_mark(&arena);
  unsigned char *first = filled(&arena, SOME, 2);
  hsr_arena_return(&arena, &mark);
  ok(tap, kept && arena.used_bytes == used && filled(&arena, SOME, 3) == first,
     "what follows a mark in its block is taken again");
  bool large = filled(&arena, MUCH, 4) && filled(&arena, 3 * MUCH, 5);
  hsr_arena_return(&arena, &mark);
  ok(tap, large && arena.used_bytes == used && arena.blocks == mark.block,
     "blocks that follow it are freed");
  ok(tap, filled(&arena, SOME, 6) == first && is_filled(kept, SOME, 1),
     "the mark stays valid, and so does what precedes it");
  hsr_arena_return(&arena, &none);
  ok(tap, !arena.blocks && arena.used_bytes == 0,
     "of a mark before all, no block is left");
  hsr_arena_free(&arena);
}

static void test_reset(struct tap *tap) {
  struct hsr_arena arena = HSR_ARENA_EMPTY;
  bool taken = true;
  for (int frame = 0; frame < 3; frame++) {
    for (size_t k = 0; k < 5; k++)
      taken &= filled(&arena, (size_t)MUCH << k, 1) != NULL;
    if (frame < 2)
      hsr_arena_reset(&arena);
  }
  const long blocks = (long)arena.n_blocks_taken;
  hsr_arena_reset(&arena);
  for (size_t k = 0; k < 5; k++)
    taken &= filled(&arena, (size_t)MUCH << k, 1) != NULL;
  ok(tap, taken && (long)arena.n_blocks_taken == blocks,
     "a frame like the one before takes no new block");
  hsr_arena_free(&arena);
}

int main(void) {
  struct tap tap = plan(4 + 4 + 1);
  test_arrays(&tap);
  test_mark(&tap);
  test_reset(&tap);
  return finish(&tap);
}
