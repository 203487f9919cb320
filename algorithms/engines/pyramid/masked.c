/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/engines/pyramid/masked.h"
#include "common/base/numbers.h"
#include "common/base/vector.h"

enum { SIDE = HSR_MASKED_SIDE, BITS = HSR_MASKED_BITS, TILE = SIDE * SIDE };
static const uint64_t FULL = UINT64_MAX;

/* The bits of columns x0 to x1 - 1 and rows y0 to y1 - 1 of a tile, none of
 * which are empty. */
static uint64_t bits_of(int x0, int y0, int x1, int y1) {
  uint64_t row = (UINT64_C(0xff) >> (SIDE - (x1 - x0))) << x0;
  uint64_t rows = FULL >> SIDE * (SIDE - (y1 - y0)) << SIDE * y0;
  return rows & row * UINT64_C(0x0101010101010101);
}

/* --- Tiles ---------------------------------------------------------------- */

/* The samples of a box that are in a tile, and their bits in it. */
struct common {
  struct hsr_bounds box;
  uint64_t bits;
};

static struct common common_of(const struct hsr_masked *m, int x, int y,
                               struct hsr_bounds box) {
  int i = m->window.x0 + x * SIDE, j = m->window.y0 + y * SIDE;
  struct hsr_bounds b = {hsr_max_int(box.x0, i), hsr_max_int(box.y0, j),
                         hsr_min_int(box.x1, i + SIDE),
                         hsr_min_int(box.y1, j + SIDE)};
  return (struct common){b, bits_of(b.x0 - i, b.y0 - j, b.x1 - i, b.y1 - j)};
}

static struct hsr_masked_tile *tile_at(const struct hsr_masked *m, int x,
                                       int y) {
  return &m->tile[(size_t)y * (size_t)m->columns + (size_t)x];
}

/* The bits of samples that are not in the window. */
static uint64_t outside(const struct hsr_masked *m, int x, int y) {
  const struct hsr_window *w = &m->window;
  return ~common_of(m, x, y, (struct hsr_bounds){w->x0, w->y0, w->x1, w->y1})
              .bits;
}

enum hsr_status hsr_masked_init(struct hsr_masked *m,
                                const struct hsr_window *window,
                                struct hsr_arena *arena) {
  *m = (struct hsr_masked){.window = *window};
  m->columns = (window->x1 - window->x0 + SIDE - 1) >> BITS;
  m->rows = (window->y1 - window->y0 + SIDE - 1) >> BITS;
  m->tile = HSR_NEW(arena, struct hsr_masked_tile,
                    (size_t)m->columns * (size_t)m->rows);
  if (!m->tile)
    return HSR_E_NOMEM;
  for (int y = 0; y < m->rows; y++)
    for (int x = 0; x < m->columns; x++)
      *tile_at(m, x, y) =
          (struct hsr_masked_tile){outside(m, x, y), 0, HUGE_VALF};
  return HSR_OK;
}

/* --- Update --------------------------------------------------------------- */

enum { BEHIND, ADDED, DROPPED, IS_FULL }; /* HSR_MASKED_UPDATE_OUTCOMES */

/* Merges some samples of a tile, nowhere farther than depth `far`. If they are
 * far before the working layer, they would lose their depth in it. So that layer
 * is dropped if its distance to them is more than its distance to the reference
 * layer. */
static int merge(const struct hsr_masked *m, int x, int y, uint64_t samples,
                 float far) {
  struct hsr_masked_tile *t = tile_at(m, x, y);
  int outcome = ADDED;
  if (!(far > t->reference))
    return BEHIND;
  if (far - t->working > t->working - t->reference) {
    t->working = HUGE_VALF;
    t->in_working = outside(m, x, y);
    outcome = DROPPED;
  }
  t->working = far < t->working ? far : t->working;
  t->in_working |= samples;
  if (t->in_working != FULL)
    return outcome;
  *t = (struct hsr_masked_tile){outside(m, x, y), t->working, HUGE_VALF};
  return IS_FULL;
}

static void update(struct hsr_masked *m, int x, int y, uint64_t samples,
                   float far, uint32_t id) {
  int outcome = merge(m, x, y, samples, far);
  if (HSR_COUNTING)
    hsr_entry_step(m->count->tally, m->updates, &m->window, BITS, x, y,
                   HSR_FACE(id), outcome);
}

/* Is the least of the three edge functions at each sample of a tile more than
 * `limit`? */
HSR_VECTOR static void find_inside(const struct hsr_triangle *restrict t,
                                   float right, float down, float limit,
                                   unsigned char *restrict inside) {
  for (int k = 0; k < TILE; k++) {
    float x = right + (float)(k & (SIDE - 1)), y = down + (float)(k >> BITS);
    float d0 = t->e0 + t->ey0 * y + t->ex0 * x,
          d1 = t->e1 + t->ey1 * y + t->ex1 * x,
          d2 = t->e2 + t->ey2 * y + t->ex2 * x;
    float d = d0 < d1 ? d0 : d1;
    d = d < d2 ? d : d2;
    inside[k] = d > limit;
  }
}

/* Bit k of the result is byte k, which is 0 or 1: the product has it in its
 * highest byte. */
static uint64_t bits_of_bytes(const unsigned char *byte) {
  uint64_t all = 0;
  for (int k = 0; k < SIDE; k++)
    all |= (uint64_t)byte[k] << 8 * k;
  return all * UINT64_C(0x0102040810204080) >> 56;
}

/* The samples of a tile, within a triangle's box, where its edge functions are
 * more than `limit`. */
static uint64_t covered(const struct hsr_masked *m,
                        const struct hsr_triangle *t, int x, int y,
                        const struct common *c, float limit) {
  unsigned char inside[TILE];
  uint64_t bits = 0;
  find_inside(t, (float)(m->window.x0 + x * SIDE - t->x0),
              (float)(m->window.y0 + y * SIDE - t->y0), limit, inside);
  for (int row = 0; row < SIDE; row++)
    bits |= bits_of_bytes(inside + SIDE * row) << SIDE * row;
  return bits & c->bits;
}

/* The depth of the triangle's plane at a corner of a box of samples: where it is
 * the nearest, or the farthest. */
static float depth_at(const struct hsr_triangle *t, const struct hsr_bounds *b,
                      bool nearest) {
  int i = (t->qx > 0) == nearest ? b->x1 - 1 : b->x0;
  int j = (t->qy > 0) == nearest ? b->y1 - 1 : b->y0;
  return t->q + t->qy * (float)(j - t->y0) + t->qx * (float)(i - t->x0);
}

static struct hsr_bounds box_of(const struct hsr_triangle *t) {
  return (struct hsr_bounds){t->x0, t->y0, t->x1, t->y1};
}

/* At its own samples no depth of the triangle is less than (1 - HSR_RHO) times
 * the least that is computed at the corners of its box in the tile: see
 * hides_triangle in pyramid.c. HSR_CLEAR has room for that, as for the depths of
 * a z-buffer. */
void hsr_masked_put(struct hsr_masked *m, const struct hsr_triangle *t,
                    float farthest) {
  struct hsr_entries tiles = hsr_entries_of(&m->window, box_of(t), BITS);
  for (int y = tiles.y0; y <= tiles.y1; y++)
    for (int x = tiles.x0; x <= tiles.x1; x++) {
      struct common c = common_of(m, x, y, box_of(t));
      float far = depth_at(t, &c.box, false);
      far = far > farthest ? far : farthest;
      if (!(far > tile_at(m, x, y)->reference))
        update(m, x, y, 0, far, t->id);
      else if ((c.bits = covered(m, t, x, y, &c, t->bound)))
        update(m, x, y, c.bits, far, t->id);
    }
}

/* Of the samples that a box and a tile have in common, those that show face
 * `id`, in shown->bits, and the farthest depth of these. An unknown depth is
 * NaN: such a sample is left out. */
static float find_shown(const struct hsr_masked *m, const struct hsr_tiler *t,
                        uint32_t id, struct common *shown) {
  const struct hsr_bounds *b = &shown->box;
  float far = HUGE_VALF;
  shown->bits = 0;
  for (int j = b->y0; j < b->y1; j++)
    for (int i = b->x0; i < b->x1; i++) {
      size_t column = (size_t)(i - t->part.x0), row = (size_t)(j - t->part.y0);
      float q = t->z[row * t->z_stride + column];
      if (t->ids[row * t->ids_stride + column] != id || !(q > 0))
        continue;
      int at = (j - m->window.y0) % SIDE * SIDE + (i - m->window.x0) % SIDE;
      shown->bits |= UINT64_C(1) << at;
      far = q < far ? q : far;
    }
  return far;
}

void hsr_masked_put_shown(struct hsr_masked *m, const struct hsr_tiler *t,
                          uint32_t id, struct hsr_bounds box) {
  struct hsr_entries tiles = hsr_entries_of(&m->window, box, BITS);
  for (int y = tiles.y0; y <= tiles.y1; y++)
    for (int x = tiles.x0; x <= tiles.x1; x++) {
      struct common c = common_of(m, x, y, box);
      float far = find_shown(m, t, id, &c);
      if (c.bits)
        update(m, x, y, c.bits, far, id);
    }
}

/* --- Tests ---------------------------------------------------------------- */

/* Is depth q farther than the reference layer of a tile? */
static bool is_behind(struct hsr_masked *m, int x, int y, float q) {
  bool behind = q * HSR_CLEAR < tile_at(m, x, y)->reference;
  if (HSR_COUNTING)
    hsr_entry_step(m->count->tally, m->count->reads, &m->window, BITS, x, y,
                   m->count->whom, behind);
  return behind;
}

bool hsr_masked_hides(struct hsr_masked *m, struct hsr_bounds box, float q) {
  struct hsr_entries tiles = hsr_entries_of(&m->window, box, BITS);
  for (int y = tiles.y0; y <= tiles.y1; y++)
    for (int x = tiles.x0; x <= tiles.x1; x++)
      if (!is_behind(m, x, y, q))
        return false;
  return true;
}

/* At its own samples no depth of the triangle is more than (1 + HSR_RHO) times
 * the largest at the corners. It covers no
 * sample where an edge function is less than -bound. The limit is twice that,
 * since covered() leaves out the limit itself. */
bool hsr_masked_hides_triangle(struct hsr_masked *m,
                               const struct hsr_triangle *t) {
  struct hsr_entries tiles = hsr_entries_of(&m->window, box_of(t), BITS);
  for (int y = tiles.y0; y <= tiles.y1; y++)
    for (int x = tiles.x0; x <= tiles.x1; x++) {
      struct common c = common_of(m, x, y, box_of(t));
      float q = depth_at(t, &c.box, true) * (1 + HSR_RHO);
      if (covered(m, t, x, y, &c, -2 * t->bound) && !is_behind(m, x, y, q))
        return false;
    }
  return true;
}
