/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/image_space/area/tiling/masks/masks.h"
#include "common/base/bits.h"
#include "common/base/vector.h"

#include <math.h>
#include <string.h>

/* The counting build takes the portable way, so that it counts the same on
 * every machine. */
#if defined __x86_64__ && HSR_HAVE_TARGET_CLONES && !HSR_COUNTING
#define HAVE_AVX512_TWIN 1
#endif

static const uint64_t ALL = UINT64_MAX;

enum { FEW = 4 };

static bool is_finest(const struct hsr_masks *p,
                      const struct hsr_mask_cell *cell) {
  return cell->level == p->n_levels - 1;
}

static struct hsr_mask_cell subcell(const struct hsr_mask_cell *cell, int bit) {
  int size = cell->size / 8;
  struct hsr_mask_cell sub = {
      cell->level + 1, cell->number * 64 + (uint32_t)bit,
      cell->x + bit % 8 * size, cell->y + bit / 8 * size, size};
  return sub;
}

static struct hsr_mask_cell root_of(const struct hsr_masks *p) {
  int size = 1;
  for (int k = 0; k < p->n_levels; k++)
    size *= 8;
  struct hsr_mask_cell root = {0, 0, p->window.x0, p->window.y0, size};
  return root;
}

/* --- Clearing ------------------------------------------------------------- */

/* The subcells of columns [c0, c1) and rows [r0, r1), within 0 .. 8. */
static uint64_t rectangle(int c0, int r0, int c1, int r1) {
  if (c0 >= c1 || r0 >= r1)
    return 0;
  uint64_t row = (uint64_t)((1 << c1) - (1 << c0));
  uint64_t rows = (ALL >> (64 - 8 * (r1 - r0))) << (8 * r0);
  return row * 0x0101010101010101u & rows;
}

static int within_8(int k) {
  return k < 0 ? 0 : k > 8 ? 8 : k;
}

/* The subcells of a cell that have samples in the box; size is a power of two,
 * and the shift rounds down. */
static uint64_t subcells_of(const struct hsr_mask_cell *cell,
                            const struct hsr_bounds *box) {
  int size = cell->size / 8;
  int shift = hsr_first_bit((uint64_t)size);
  return rectangle(within_8((box->x0 - cell->x) >> shift),
                   within_8((box->y0 - cell->y) >> shift),
                   within_8(((box->x1 - 1 - cell->x) >> shift) + 1),
                   within_8(((box->y1 - 1 - cell->y) >> shift) + 1));
}

/* The subcells that have samples of the window. */
static uint64_t in_window(const struct hsr_masks *p,
                          const struct hsr_mask_cell *cell) {
  const struct hsr_window *w = &p->window;
  if (cell->x + cell->size <= w->x1 && cell->y + cell->size <= w->y1)
    return ALL;
  struct hsr_bounds box = {w->x0, w->y0, w->x1, w->y1};
  return subcells_of(cell, &box);
}

static void clear(struct hsr_masks *p, const struct hsr_mask_cell *cell) {
  uint64_t vacant = in_window(p, cell);
  if (is_finest(p, cell))
    p->finest[cell->number] = ~vacant;
  else
    p->coarse[cell->level][cell->number] = (struct hsr_triage){~vacant, vacant};
}

static const struct hsr_mask_twin *choose_twin(void);

static bool allocate_lines(struct hsr_mask_lines *lines, uint32_t most,
                           struct hsr_arena *arena) {
  lines->number = HSR_NEW(arena, uint32_t, most);
  lines->inside = HSR_NEW(arena, uint64_t, most);
  lines->list = HSR_NEW(arena, uint32_t, most);
  return lines->number && lines->inside && lines->list;
}

enum hsr_status hsr_masks_room(struct hsr_masks *p, uint32_t most,
                               struct hsr_arena *arena) {
  bool allocated = true;
  for (int k = 0; k < p->n_levels; k++)
    allocated = allocated && allocate_lines(&p->lines[k], most, arena);
  p->all = HSR_NEW(arena, uint32_t, most);
  if (!allocated || !p->all)
    return HSR_E_NOMEM;
  for (uint32_t k = 0; k < most; k++)
    p->all[k] = k;
  return HSR_OK;
}

/* The last one is that of the window's last sample: the greatest digits, in
 * base 64, are there first. */
size_t hsr_masks_cells(const struct hsr_masks *p, int level) {
  struct hsr_mask_cell cell = root_of(p);
  struct hsr_bounds last = {p->window.x1 - 1, p->window.y1 - 1, p->window.x1,
                            p->window.y1};
  while (cell.level < level)
    cell = subcell(&cell, hsr_first_bit(subcells_of(&cell, &last)));
  return (size_t)cell.number + 1;
}

enum hsr_status hsr_masks_init(struct hsr_masks *p,
                               const struct hsr_window *window, uint32_t most,
                               struct hsr_arena *arena) {
  int width = window->x1 - window->x0, height = window->y1 - window->y0;
  p->window = *window;
  p->n_levels = 1;
  p->twin = choose_twin();
  for (int size = 8; size < width || size < height; size *= 8)
    p->n_levels++;
  for (int level = 0; level + 1 < p->n_levels; level++) {
    p->coarse[level] =
        HSR_NEW(arena, struct hsr_triage, hsr_masks_cells(p, level));
    if (!p->coarse[level])
      return HSR_E_NOMEM;
  }
  p->finest = HSR_NEW(arena, uint64_t, hsr_masks_cells(p, p->n_levels - 1));
  if (!p->finest || hsr_masks_room(p, most, arena))
    return HSR_E_NOMEM;
  struct hsr_mask_cell root = root_of(p);
  clear(p, &root);
  return HSR_OK;
}

int hsr_masks_extent(const struct hsr_masks *p) {
  return root_of(p).size;
}

/* --- Lines before cells --------------------------------------------------- */

enum where { OUTSIDE, INSIDE, CROSSING };

/* The samples of a cell about a line. Those that are not jittered keep half a
 * sample away from the cell's border. */
static enum where classify(const struct hsr_masks *p,
                           const struct hsr_mask_line *line,
                           const struct hsr_mask_cell *cell, double *corner) {
  double half = 0.5 * cell->size;
  double middle =
      line->a * (cell->x + half) + line->b * (cell->y + half) + line->c;
  double reach = line->span * (p->anywhere ? half : half - 0.5);
  *corner = middle - (line->a + line->b) * half;
  if (middle + reach < -line->error)
    return OUTSIDE;
  return middle - reach > line->error ? INSIDE : CROSSING;
}

/* A line that crosses a cell, in the tables: -1 unless it crosses the sides at
 * places that are known within half the tables' slack. */
static int entry_of(const struct hsr_masks *p, const struct hsr_mask_line *line,
                    double corner, int size, bool *inside) {
  double side = size, per_side = 1 / side; /* a power of two */
  double step[2] = {line->a * side, line->b * side};
  double per[2] = {line->per_a * per_side, line->per_b * per_side};
  double least = 2 / HSR_TRIAGE_SLACK * line->error;
  bool known[2] = {fabs(step[0]) > least, fabs(step[1]) > least};
  return hsr_triage_entry(p->tables->intervals, corner, step, per, known,
                          inside);
}

static struct hsr_triage look_up(const struct hsr_masks *p,
                                 const struct hsr_mask_line *line,
                                 double corner, int size) {
  bool inside;
  int entry = entry_of(p, line, corner, size, &inside);
  if (entry < 0)
    return (struct hsr_triage){0, 0};
  struct hsr_triage mask = p->tables->mask[entry];
  return inside ? mask : (struct hsr_triage){mask.v, mask.c};
}

/* The lines that cross a cell, of those in list[]: into active[], each with the
 * subcells that it leaves surely inside. The polygon's masks; false if the cell
 * is outside. */
static bool compose(const struct hsr_masks *p,
                    const struct hsr_mask_polygon *polygon,
                    const struct hsr_mask_cell *cell, const uint32_t *list,
                    uint32_t n, struct hsr_mask_lines *active,
                    struct hsr_triage *mask) {
  *mask = (struct hsr_triage){ALL, 0};
  active->n = 0;
  for (uint32_t k = 0; k < n; k++) {
    const struct hsr_mask_line *line = &polygon->line[list[k]];
    double corner;
    enum where where = classify(p, line, cell, &corner);
    if (where == OUTSIDE)
      return false;
    if (where == INSIDE)
      continue;
    struct hsr_triage edge = look_up(p, line, corner, cell->size);
    active->number[active->n] = list[k];
    active->inside[active->n++] = edge.c;
    mask->c &= edge.c;
    mask->v |= edge.v;
  }
  return true;
}

/* Of the active lines of a cell, those that are not surely inside in a subcell.
 */
static uint32_t choose(const struct hsr_mask_lines *active, int bit) {
  uint32_t n = 0;
  for (uint32_t k = 0; k < active->n; k++)
    if (!(active->inside[k] >> bit & 1))
      active->list[n++] = active->number[k];
  return n;
}

/* --- Counting ------------------------------------------------------------- */

#if HSR_COUNTING
static void count_cell(struct hsr_masks *p, const struct hsr_mask_cell *cell) {
  p->work->cells++;
  p->work->finest += is_finest(p, cell);
  if (cell->size < p->pixel)
    return;
  int x0 = cell->x / p->pixel, y0 = cell->y / p->pixel;
  int x1 = x0 + cell->size / p->pixel, y1 = y0 + cell->size / p->pixel;
  int m = p->window.x1 / p->pixel, n = p->window.y1 / p->pixel;
  float share = 1.0f / (float)((x1 - x0) * (y1 - y0));
  p->work->pixels++;
  for (int j = y0; p->touched && j < y1 && j < n; j++)
    for (int i = x0; i < x1 && i < m; i++)
      p->touched[(size_t)j * p->touched_stride + (size_t)i] += share;
}
#else
static void count_cell(const struct hsr_masks *p,
                       const struct hsr_mask_cell *cell) {
  (void)p;
  (void)cell;
}
#endif

/* --- The finest level ----------------------------------------------------- */

/* Of the samples of a finest cell, those surely inside a line that is f at the
 * cell's corner, and those surely outside. */
typedef void (*splitter)(const struct hsr_mask_line *line, double f,
                         const struct hsr_mask_places *places, uint64_t *inside,
                         uint64_t *outside);

static inline void split(const struct hsr_mask_line *line, double f,
                         const struct hsr_mask_places *places, uint64_t *inside,
                         uint64_t *outside) {
  *inside = *outside = 0;
  for (int bit = 0; bit < 64; bit++) {
    double at = f + (line->a * places->x[bit] + line->b * places->y[bit]);
    *inside |= (uint64_t)(at > line->error) << bit;
    *outside |= (uint64_t)(at < -line->error) << bit;
  }
}

static int pattern_of(const struct hsr_masks *p,
                      const struct hsr_mask_cell *cell) {
  return p->filtering
             ? hsr_jitter_pattern(p->filtering, cell->x / 8, cell->y / 8)
             : 0;
}

/* The samples of a finest cell that the polygon may cover, by the lines of the
 * list; *unsure are those of them that are not certain. */
static uint64_t candidates(const struct hsr_masks *p,
                           const struct hsr_mask_polygon *polygon,
                           const struct hsr_mask_cell *cell,
                           const uint32_t *list, uint32_t n, int pattern,
                           uint64_t *unsure) {
  uint64_t mask = ALL;
  *unsure = 0;
  for (uint32_t k = 0; k < n && mask; k++) {
    const struct hsr_mask_line *line = &polygon->line[list[k]];
    uint64_t inside, outside;
    double f = line->a * cell->x + line->b * cell->y + line->c;
    split(line, f, &p->places[pattern], &inside, &outside);
    mask &= ~outside;
    *unsure |= ~(inside | outside);
  }
  *unsure &= mask;
  return mask;
}

/* The same by the tables: certain, and sometimes wrong. */
static uint64_t tabled(const struct hsr_masks *p,
                       const struct hsr_mask_polygon *polygon,
                       const struct hsr_mask_cell *cell, const uint32_t *list,
                       uint32_t n, int pattern, uint64_t *unsure) {
  uint64_t mask = ALL;
  *unsure = 0;
  for (uint32_t k = 0; k < n && mask; k++) {
    const struct hsr_mask_line *line = &polygon->line[list[k]];
    double corner;
    enum where where = classify(p, line, cell, &corner);
    bool inside;
    int entry = entry_of(p, line, corner, cell->size, &inside);
    if (where == OUTSIDE)
      return 0;
    if (where == INSIDE)
      continue;
    if (entry < 0)
      return candidates(p, polygon, cell, list, n, pattern, unsure);
    uint64_t samples = p->sample_tables[pattern][entry];
    mask &= inside ? samples : ~samples;
  }
  return mask;
}

/* Whether the exact predicates have a sample covered. */
static bool is_covered(struct hsr_masks *p,
                       const struct hsr_mask_polygon *polygon,
                       const struct hsr_mask_cell *cell, const uint32_t *list,
                       uint32_t n, int pattern, int bit, bool lines_unsure) {
  const struct hsr_mask_places *places = &p->places[pattern];
  double sx = cell->x + places->x[bit], sy = cell->y + places->y[bit];
  p->unsure++;
  for (uint32_t k = 0; lines_unsure && k < n; k++) {
    const struct hsr_mask_line *line = &polygon->line[list[k]];
    double f = line->a * cell->x + line->b * cell->y + line->c;
    double at = f + (line->a * places->x[bit] + line->b * places->y[bit]);
    if (!(at > line->error) &&
        !polygon->inside(polygon->context, list[k], sx, sy))
      return false;
  }
  return !polygon->covers || polygon->covers(polygon->context, sx, sy);
}

/* The samples of a finest cell that the polygon covers, of those asked for. */
static uint64_t covered_samples(struct hsr_masks *p,
                                const struct hsr_mask_polygon *polygon,
                                const struct hsr_mask_cell *cell,
                                const uint32_t *list, uint32_t n,
                                uint64_t asked) {
  uint64_t unsure;
  int pattern = pattern_of(p, cell);
  uint64_t mask = asked & (p->sample_tables ? tabled : candidates)(
                              p, polygon, cell, list, n, pattern, &unsure);
  uint64_t ask = mask & (polygon->covers ? ALL : unsure);
  for (; ask; ask &= ask - 1) {
    int bit = hsr_first_bit(ask);
    if (!is_covered(p, polygon, cell, list, n, pattern, bit, unsure >> bit & 1))
      mask &= ~((uint64_t)1 << bit);
  }
  return mask;
}

/* --- Tiling --------------------------------------------------------------- */

struct task {
  struct hsr_masks *masks;
  const struct hsr_mask_polygon *polygon;
  const struct hsr_mask_sink *sink;
  struct hsr_bounds box; /* of its samples */
};

/* The steps that are written twice, for every machine and for AVX-512. */
struct hsr_mask_twin {
  bool (*compose)(const struct hsr_masks *p,
                  const struct hsr_mask_polygon *polygon,
                  const struct hsr_mask_cell *cell, const uint32_t *list,
                  uint32_t n, struct hsr_mask_lines *active,
                  struct hsr_triage *mask);
  void (*tile_pixels)(const struct task *t, const struct hsr_mask_cell *cell,
                      const struct hsr_mask_lines *active,
                      struct hsr_triage *mask, uint64_t a);
  bool (*shows_finest)(const struct task *t, const struct hsr_mask_cell *cell,
                       const uint32_t *list, uint32_t n);
};

static void tile_finest(const struct task *t, const struct hsr_mask_cell *cell,
                        const uint32_t *list, uint32_t n) {
  uint64_t w = covered_samples(t->masks, t->polygon, cell, list, n,
                               ~t->masks->finest[cell->number]);
  count_cell(t->masks, cell);
  if (!w)
    return;
  t->masks->finest[cell->number] |= w;
  t->sink->samples(t->sink->context, cell->x, cell->y, w);
}

/* What was tiled in a subcell goes up to its cell. */
static void propagate(const struct hsr_masks *p,
                      const struct hsr_mask_cell *sub,
                      struct hsr_triage *mask) {
  uint64_t bit = (uint64_t)1 << (sub->number & 63);
  uint64_t covered, vacant;
  if (is_finest(p, sub)) {
    covered = p->finest[sub->number];
    vacant = ~covered;
  } else {
    covered = p->coarse[sub->level][sub->number].c;
    vacant = p->coarse[sub->level][sub->number].v;
  }
  if (covered == ALL)
    mask->c |= bit;
  if (vacant != ALL)
    mask->v &= ~bit;
}

static void write_squares(const struct task *t,
                          const struct hsr_mask_cell *cell, uint64_t w) {
  int size = cell->size / 8;
  for (; w; w &= w - 1) {
    int bit = hsr_first_bit(w);
    t->sink->square(t->sink->context, cell->x + bit % 8 * size,
                    cell->y + bit / 8 * size, size);
  }
}

/* The finest subcells a of a cell, as tile_finest has them one by one. What is
 * left open there is left to that. */
static inline __attribute__((always_inline)) void
tile_pixels(const struct task *t, const struct hsr_mask_cell *cell,
            const struct hsr_mask_lines *active, struct hsr_triage *mask,
            uint64_t a, splitter by) {
  struct hsr_masks *p = t->masks;
  for (; a; a &= a - 1) {
    int bit = hsr_first_bit(a);
    struct hsr_mask_cell sub = subcell(cell, bit);
    if (mask->v >> bit & 1)
      clear(p, &sub);
    const struct hsr_mask_places *places = &p->places[pattern_of(p, &sub)];
    uint64_t w = ~p->finest[sub.number], unsure = 0;
    for (uint32_t k = 0; k < active->n && w; k++) {
      if (active->inside[k] >> bit & 1)
        continue;
      const struct hsr_mask_line *line = &t->polygon->line[active->number[k]];
      uint64_t inside, outside;
      by(line, line->a * sub.x + line->b * sub.y + line->c, places, &inside,
         &outside);
      w &= ~outside;
      unsure |= ~inside;
    }
    if (w & unsure) {
      tile_finest(t, &sub, active->list, choose(active, bit));
      propagate(p, &sub, mask);
      continue;
    }
    count_cell(p, &sub);
    if (!w)
      continue;
    mask->v &= ~((uint64_t)1 << bit);
    p->finest[sub.number] |= w;
    if (p->finest[sub.number] == ALL)
      mask->c |= (uint64_t)1 << bit;
    t->sink->samples(t->sink->context, sub.x, sub.y, w);
  }
}

static void tile_pixels_portable(const struct task *t,
                                 const struct hsr_mask_cell *cell,
                                 const struct hsr_mask_lines *active,
                                 struct hsr_triage *mask, uint64_t a) {
  tile_pixels(t, cell, active, mask, a, split);
}

static inline __attribute__((always_inline)) bool
shows_finest(const struct task *t, const struct hsr_mask_cell *cell,
             const uint32_t *list, uint32_t n, splitter by) {
  struct hsr_masks *p = t->masks;
  uint64_t vacant = ~p->finest[cell->number];
  for (uint32_t k = 0; k < n && vacant; k++) {
    const struct hsr_mask_line *line = &t->polygon->line[list[k]];
    uint64_t inside, outside;
    by(line, line->a * cell->x + line->b * cell->y + line->c,
       &p->places[pattern_of(p, cell)], &inside, &outside);
    vacant &= ~outside;
  }
  return vacant;
}

static bool shows_finest_portable(const struct task *t,
                                  const struct hsr_mask_cell *cell,
                                  const uint32_t *list, uint32_t n) {
  return shows_finest(t, cell, list, n, split);
}

static const struct hsr_mask_twin portable = {compose, tile_pixels_portable,
                                              shows_finest_portable};

#ifdef HAVE_AVX512_TWIN
#include "algorithms/image_space/area/tiling/masks/masks_avx512.h"

AVX512 static void tile_pixels_avx512(const struct task *t,
                                      const struct hsr_mask_cell *cell,
                                      const struct hsr_mask_lines *active,
                                      struct hsr_triage *mask, uint64_t a) {
  tile_pixels(t, cell, active, mask, a, split_avx512);
}

AVX512 static bool shows_finest_avx512(const struct task *t,
                                       const struct hsr_mask_cell *cell,
                                       const uint32_t *list, uint32_t n) {
  return shows_finest(t, cell, list, n, split_avx512);
}

static const struct hsr_mask_twin avx512 = {compose_avx512, tile_pixels_avx512,
                                            shows_finest_avx512};
#endif

static const struct hsr_mask_twin *choose_twin(void) {
#ifdef HAVE_AVX512_TWIN
  if (__builtin_cpu_supports("avx512f"))
    return &avx512;
#endif
  return &portable;
}

/* Few enough to be asked about one by one, without the polygon's masks. */
static bool is_few(uint64_t subcells) {
  for (int k = 0; k < FEW; k++)
    subcells &= subcells - 1;
  return !subcells;
}

/* All lines, as far as nothing is known of them. */
static void take_all(struct hsr_mask_lines *active, const uint32_t *list,
                     uint32_t n) {
  active->n = n;
  for (uint32_t k = 0; k < n; k++) {
    active->number[k] = list[k];
    active->inside[k] = 0;
  }
}

/* Listing 1. */
static void tile(const struct task *t, const struct hsr_mask_cell *cell,
                 const uint32_t *list, uint32_t n) {
  struct hsr_masks *p = t->masks;
  if (is_finest(p, cell)) {
    tile_finest(t, cell, list, n);
    return;
  }
  struct hsr_mask_lines *active = &p->lines[cell->level];
  struct hsr_triage *mask = &p->coarse[cell->level][cell->number], polygon;
  uint64_t in = subcells_of(cell, &t->box);
  bool of_finest = cell->level == p->n_levels - 2 && !p->sample_tables &&
                   !t->polygon->covers;
  count_cell(p, cell);
  if (of_finest && in & ~mask->c && is_few(in)) {
    take_all(active, list, n);
    p->twin->tile_pixels(t, cell, active, mask, in & ~mask->c);
    return;
  }
  if (!p->twin->compose(p, t->polygon, cell, list, n, active, &polygon))
    return;
  if (t->polygon->covers)
    polygon.c = 0;
  uint64_t w = mask->v & polygon.c;
  mask->c |= w;
  mask->v &= ~w;
  write_squares(t, cell, w);
  uint64_t a = ~(w | polygon.v | mask->c) & in;
  if (of_finest) {
    p->twin->tile_pixels(t, cell, active, mask, a);
    return;
  }
  for (; a; a &= a - 1) {
    int bit = hsr_first_bit(a);
    struct hsr_mask_cell sub = subcell(cell, bit);
    if (mask->v >> bit & 1)
      clear(p, &sub);
    uint32_t n_sub = choose(active, bit);
    tile(t, &sub, active->list, n_sub);
    propagate(p, &sub, mask);
  }
}

/* Whether the polygon, of which the lines leave open what is not surely
 * outside, covers a sample that is not covered. */
static bool shows(const struct task *t, const struct hsr_mask_cell *cell,
                  const uint32_t *list, uint32_t n) {
  struct hsr_masks *p = t->masks;
  count_cell(p, cell);
  if (is_finest(p, cell))
    return p->twin->shows_finest(t, cell, list, n);
  struct hsr_mask_lines *active = &p->lines[cell->level];
  struct hsr_triage *mask = &p->coarse[cell->level][cell->number], polygon;
  if (!p->twin->compose(p, t->polygon, cell, list, n, active, &polygon))
    return false;
  if (polygon.c & ~mask->c & subcells_of(cell, &t->box))
    return true;
  for (uint64_t a =
           ~(polygon.c | polygon.v | mask->c) & subcells_of(cell, &t->box);
       a; a &= a - 1) {
    int bit = hsr_first_bit(a);
    struct hsr_mask_cell sub = subcell(cell, bit);
    if (mask->v >> bit & 1)
      clear(p, &sub);
    uint32_t n_sub = choose(active, bit);
    if (shows(t, &sub, active->list, n_sub))
      return true;
  }
  return false;
}

/* --- Where to begin ------------------------------------------------------- */

/* Cells on the way are cleared if they are to be. */
bool hsr_masks_find(struct hsr_masks *p, struct hsr_bounds box) {
  struct hsr_mask_cell *way = p->way;
  p->box = box;
  way[0] = root_of(p);
  for (p->n_way = 1;; p->n_way++, way++) {
    uint64_t in = subcells_of(way, &box);
    bool finest = is_finest(p, way);
    struct hsr_triage *mask =
        finest ? NULL : &p->coarse[way->level][way->number];
    bool hidden = !(in & ~(finest ? p->finest[way->number] : mask->c));
    if (!hidden && (finest || in & (in - 1)))
      return true;
    count_cell(p, way);
    if (hidden)
      return false;
    way[1] = subcell(way, hsr_first_bit(in));
    if (mask->v & in)
      clear(p, &way[1]);
  }
}

void hsr_masks_tile_found(struct hsr_masks *p,
                          const struct hsr_mask_polygon *polygon,
                          const struct hsr_mask_sink *sink) {
  struct task task = {p, polygon, sink, p->box};
  int k = p->n_way - 1;
  tile(&task, &p->way[k], p->all, polygon->n);
  for (; k > 0; k--)
    propagate(p, &p->way[k], &p->coarse[k - 1][p->way[k - 1].number]);
}

bool hsr_masks_tile(struct hsr_masks *p, const struct hsr_mask_polygon *polygon,
                    struct hsr_bounds box, const struct hsr_mask_sink *sink) {
  if (!hsr_masks_find(p, box))
    return false;
  hsr_masks_tile_found(p, polygon, sink);
  return true;
}

void hsr_masks_tile_root(struct hsr_masks *p,
                         const struct hsr_mask_polygon *polygon,
                         const struct hsr_mask_sink *sink) {
  const struct hsr_window *w = &p->window;
  struct task task = {p, polygon, sink, {w->x0, w->y0, w->x1, w->y1}};
  struct hsr_mask_cell root = root_of(p);
  tile(&task, &root, p->all, polygon->n);
}

void hsr_masks_tile_rest(struct hsr_masks *p,
                         const struct hsr_mask_sink *sink) {
  struct hsr_mask_polygon all = {NULL, 0, NULL, NULL, NULL};
  hsr_masks_tile_root(p, &all, sink);
}

bool hsr_masks_show(struct hsr_masks *p, const struct hsr_mask_polygon *polygon,
                    struct hsr_bounds box) {
  if (!hsr_masks_find(p, box))
    return false;
  return hsr_masks_show_found(p, polygon);
}

bool hsr_masks_show_found(struct hsr_masks *p,
                          const struct hsr_mask_polygon *polygon) {
  struct task task = {p, polygon, NULL, p->box};
  return shows(&task, &p->way[p->n_way - 1], p->all, polygon->n);
}

/* --- For those who go through the pyramid by themselves ------------------- */

struct visit {
  struct hsr_masks *masks;
  const struct hsr_mask_polygon *polygon;
  const struct hsr_mask_visitor *visitor;
  struct hsr_bounds box;
};

static void visit_finest(const struct visit *v,
                         const struct hsr_mask_cell *cell, const uint32_t *list,
                         uint32_t n) {
  struct hsr_masks *p = v->masks;
  void *context = v->visitor->context;
  struct hsr_triage unknown = {0, 0};
  uint64_t mask = v->visitor->enter(context, cell, unknown), unsure;
  if (mask && v->polygon->inside)
    mask = covered_samples(p, v->polygon, cell, list, n, mask);
  else if (mask)
    mask &=
        candidates(p, v->polygon, cell, list, n, pattern_of(p, cell), &unsure);
  if (mask)
    v->visitor->samples(context, cell, mask);
}

static void visit(const struct visit *v, const struct hsr_mask_cell *cell,
                  const uint32_t *list, uint32_t n) {
  struct hsr_masks *p = v->masks;
  struct hsr_triage polygon;
  count_cell(p, cell);
  if (is_finest(p, cell)) {
    visit_finest(v, cell, list, n);
    return;
  }
  struct hsr_mask_lines *active = &p->lines[cell->level];
  if (!p->twin->compose(p, v->polygon, cell, list, n, active, &polygon))
    return;
  if (v->polygon->covers)
    polygon.c = 0;
  polygon.v |= ~subcells_of(cell, &v->box);
  polygon.c &= ~polygon.v;
  uint64_t entered = v->visitor->enter(v->visitor->context, cell, polygon);
  for (uint64_t a = entered; a; a &= a - 1) {
    int bit = hsr_first_bit(a);
    struct hsr_mask_cell sub = subcell(cell, bit);
    uint32_t n_sub = choose(active, bit);
    visit(v, &sub, active->list, n_sub);
  }
  v->visitor->leave(v->visitor->context, cell, entered);
}

bool hsr_masks_visit(struct hsr_masks *p,
                     const struct hsr_mask_polygon *polygon,
                     struct hsr_bounds box,
                     const struct hsr_mask_visitor *visitor) {
  struct visit v = {p, polygon, visitor, box};
  struct hsr_mask_cell way[HSR_MASK_LEVELS];
  uint64_t in[HSR_MASK_LEVELS];
  int k = 0;
  way[0] = root_of(p);
  for (;; k++) {
    in[k] = subcells_of(&way[k], &box);
    if (is_finest(p, &way[k]) || in[k] & (in[k] - 1))
      break;
    count_cell(p, &way[k]);
    struct hsr_triage polygon_there = {0, ~in[k]};
    if (!visitor->enter(visitor->context, &way[k], polygon_there))
      break;
    way[k + 1] = subcell(&way[k], hsr_first_bit(in[k]));
  }
  bool met = is_finest(p, &way[k]) || in[k] & (in[k] - 1);
  if (met)
    visit(&v, &way[k], p->all, polygon->n);
  for (k--; k >= 0; k--)
    visitor->leave(visitor->context, &way[k], in[k]);
  return met;
}

uint64_t hsr_masks_in_window(const struct hsr_masks *p,
                             const struct hsr_mask_cell *cell) {
  return in_window(p, cell);
}

struct hsr_mask_cell hsr_masks_subcell(const struct hsr_mask_cell *cell,
                                       int bit) {
  return subcell(cell, bit);
}

struct hsr_mask_cell hsr_masks_root(const struct hsr_masks *p) {
  return root_of(p);
}

int hsr_masks_pattern(const struct hsr_masks *p,
                      const struct hsr_mask_cell *cell) {
  return pattern_of(p, cell);
}
