/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/engines/masks/masks.h"
#include "common/base/bits.h"
#include "common/base/vector.h"

#include <math.h>
#include <string.h>

/* The counting build takes the portable way, so that it counts the same on
 * every machine. */
#if defined __x86_64__ && HSR_HAVE_TARGET_CLONES && !HSR_COUNTING
#define HAVE_TWINS 1
#include <immintrin.h>
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

/* The cell that holds the window's last sample has the greatest number: its
 * digits in base 64 are the greatest, from the first on. */
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

/* Where the samples of a cell lie with regard to a line. Samples that are not
 * jittered are at least half a sample away from the cell's border. */
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

/* The entry of the tables for a line that crosses a cell; -1 unless the places
 * where it crosses the sides are known within half the tables' slack. */
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

/* The active lines of a cell within which a subcell does not surely lie. */
static uint32_t choose(const struct hsr_mask_lines *active, int bit) {
  uint32_t n = 0;
  for (uint32_t k = 0; k < active->n; k++)
    if (!(active->inside[k] >> bit & 1))
      active->list[n++] = active->number[k];
  return n;
}

/* --- Counting ------------------------------------------------------------- */

/* The samples of a cell that are in the window. */
static struct hsr_window window_of(const struct hsr_masks *p,
                                   const struct hsr_mask_cell *cell) {
  const struct hsr_window *w = &p->window;
  int x1 = cell->x + cell->size, y1 = cell->y + cell->size;
  return hsr_window_make(cell->x, cell->y, x1 < w->x1 ? x1 : w->x1,
                         y1 < w->y1 ? y1 : w->y1);
}

/* A cell of one or more pixels touches each of them by its share. */
static void touch(const struct hsr_masks *p, const struct hsr_mask_cell *cell) {
  const struct hsr_tally *tally = p->count.tally;
  struct hsr_window w = window_of(p, cell);
  int pixels = cell->size / p->pixel;
  float share = 1.0f / (float)(pixels * pixels);
  for (int j = w.y0 / p->pixel; j < w.y1 / p->pixel; j++)
    for (int i = w.x0 / p->pixel; i < w.x1 / p->pixel; i++)
      tally->work[(size_t)j * tally->work_stride + (size_t)i] += share;
}

/* A visit to a cell. active: something of the polygon may be visible in it. */
static inline void count_visit(const struct hsr_masks *p,
                               const struct hsr_mask_cell *cell, bool active) {
  const struct hsr_mask_count *c = &p->count;
  if (!HSR_COUNTING)
    return;
  struct hsr_subject at =
      HSR_CELL(cell->level, (cell->x - p->window.x0) / cell->size,
               (cell->y - p->window.y0) / cell->size);
  struct hsr_window window = window_of(p, cell);
  HSR_STEP(c->tally, c->cells, at, c->whom, window, active);
  if (is_finest(p, cell))
    HSR_STEP(c->tally, c->finest, at, HSR_NOTHING, window, active);
  if (cell->size < p->pixel)
    return;
  HSR_STEP(c->tally, c->pixels, at, HSR_NOTHING, window, active);
  if (c->tally->work)
    touch(p, cell);
}

struct task;

/* The steps that are written for every machine, for AVX2 (masks_avx2.h) and for
 * AVX-512 (masks_avx512.h). */
struct hsr_mask_twin {
  uint64_t (*candidates)(const struct hsr_masks *p,
                         const struct hsr_mask_polygon *polygon,
                         const struct hsr_mask_cell *cell, const uint32_t *list,
                         uint32_t n, int pattern, uint64_t *unsure);
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

/* --- The finest level ----------------------------------------------------- */

/* Which samples of a finest cell are surely inside a line, and which are surely
 * outside? f is the line's value at the cell's corner 0. */
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
static inline __attribute__((always_inline)) uint64_t
candidates(const struct hsr_masks *p, const struct hsr_mask_polygon *polygon,
           const struct hsr_mask_cell *cell, const uint32_t *list, uint32_t n,
           int pattern, uint64_t *unsure, splitter by) {
  uint64_t mask = ALL;
  *unsure = 0;
  for (uint32_t k = 0; k < n && mask; k++) {
    const struct hsr_mask_line *line = &polygon->line[list[k]];
    uint64_t inside, outside;
    double f = line->a * cell->x + line->b * cell->y + line->c;
    by(line, f, &p->places[pattern], &inside, &outside);
    mask &= ~outside;
    *unsure |= ~(inside | outside);
  }
  *unsure &= mask;
  return mask;
}

/* The same by the tables: nothing is left unsure, and some samples are wrong.
 * */
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
      return p->twin->candidates(p, polygon, cell, list, n, pattern, unsure);
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
  uint64_t mask = asked & (p->sample_tables ? tabled : p->twin->candidates)(
                              p, polygon, cell, list, n, pattern, &unsure);
  uint64_t ask = mask & (polygon->covers ? ALL : unsure);
  for (; ask; ask &= ask - 1) {
    int bit = hsr_first_bit(ask);
    bool covered =
        is_covered(p, polygon, cell, list, n, pattern, bit, unsure >> bit & 1);
    HSR_STEP(p->count.tally, p->count.unsure, p->count.whom, HSR_THE_WINDOW,
             HSR_AT(cell->x + bit % 8, cell->y + bit / 8), covered);
    if (!covered)
      mask &= ~((uint64_t)1 << bit);
  }
  return mask;
}

/* --- Tiling --------------------------------------------------------------- */

struct task {
  struct hsr_masks *masks;
  const struct hsr_mask_polygon *polygon;
  struct hsr_bounds box;                  /* of its samples */
  const struct hsr_mask_sink *sink;       /* who is told what is tiled, */
  const struct hsr_mask_visitor *visitor; /* or who decides for himself */
  bool at_once; /* subcells of the finest level are tiled together */
};

/* The masks of a cell above the finest level. */
static struct hsr_triage *mask_of(const struct hsr_masks *p,
                                  const struct hsr_mask_cell *cell) {
  return &p->coarse[cell->level][cell->number];
}

static bool tile_finest(const struct task *t, const struct hsr_mask_cell *cell,
                        const uint32_t *list, uint32_t n) {
  uint64_t w = covered_samples(t->masks, t->polygon, cell, list, n,
                               ~t->masks->finest[cell->number]);
  count_visit(t->masks, cell, w);
  if (!w)
    return false;
  t->masks->finest[cell->number] |= w;
  t->sink->samples(t->sink->context, cell->x, cell->y, w);
  return false;
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
    covered = mask_of(p, sub)->c;
    vacant = mask_of(p, sub)->v;
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

/* The loop of listing 1 over the subcells A of a cell, if these are of the
 * finest level. A subcell of which the lines leave samples open goes to
 * tile_finest. */
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
    count_visit(p, &sub, w);
    if (!w)
      continue;
    mask->v &= ~((uint64_t)1 << bit);
    p->finest[sub.number] |= w;
    if (p->finest[sub.number] == ALL)
      mask->c |= (uint64_t)1 << bit;
    t->sink->samples(t->sink->context, sub.x, sub.y, w);
  }
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

/* A twin, which divides finest cells `by` some splitter. `target` has the
 * machine's attribute. */
#define MASK_TWIN(name, target, by, compose)                                   \
  target static uint64_t candidates_##name(                                    \
      const struct hsr_masks *p, const struct hsr_mask_polygon *polygon,       \
      const struct hsr_mask_cell *cell, const uint32_t *list, uint32_t n,      \
      int pattern, uint64_t *unsure) {                                         \
    return candidates(p, polygon, cell, list, n, pattern, unsure, by);         \
  }                                                                            \
  target static void tile_pixels_##name(const struct task *t,                  \
                                        const struct hsr_mask_cell *cell,      \
                                        const struct hsr_mask_lines *active,   \
                                        struct hsr_triage *mask, uint64_t a) { \
    tile_pixels(t, cell, active, mask, a, by);                                 \
  }                                                                            \
  target static bool shows_finest_##name(const struct task *t,                 \
                                         const struct hsr_mask_cell *cell,     \
                                         const uint32_t *list, uint32_t n) {   \
    return shows_finest(t, cell, list, n, by);                                 \
  }                                                                            \
  static const struct hsr_mask_twin name = {                                   \
      candidates_##name, compose, tile_pixels_##name, shows_finest_##name}

MASK_TWIN(portable, , split, compose);

#ifdef HAVE_TWINS
#include "algorithms/engines/masks/masks_avx2.h"
#include "algorithms/engines/masks/masks_avx512.h"
#endif

static const struct hsr_mask_twin *choose_twin(void) {
#ifdef HAVE_TWINS
  if (__builtin_cpu_supports("avx512f"))
    return &avx512;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    return &avx2;
#endif
  return &portable;
}

/* --- Counts of visible samples -------------------------------------------- */

static uint32_t *left_of(const struct hsr_masks *p,
                         const struct hsr_mask_cell *cell) {
  const struct hsr_mask_counts *counts = p->counts;
  bool counted = counts->stamp[cell->level][cell->number] == counts->cube;
  return counted ? &counts->left[cell->level][cell->number] : NULL;
}

/* The subcells of `a`, without those that are known to have no visible sample
 * of the current cube left. */
static uint64_t not_exhausted(const struct hsr_masks *p,
                              const struct hsr_mask_cell *cell, uint64_t a) {
  if (!p->counts || !p->counts->cube)
    return a;
  for (uint64_t rest = a; rest; rest &= rest - 1) {
    int bit = hsr_first_bit(rest);
    struct hsr_mask_cell sub = subcell(cell, bit);
    const uint32_t *left = left_of(p, &sub);
    if (!left || *left)
      continue;
    a &= ~((uint64_t)1 << bit);
    HSR_STEP(p->count.tally, p->count.exhausted,
             HSR_CELL(sub.level, (sub.x - p->window.x0) / sub.size,
                      (sub.y - p->window.y0) / sub.size),
             p->count.whom, window_of(p, &sub), 0);
  }
  return a;
}

void hsr_masks_covered(struct hsr_masks *p, int x, int y, int size,
                       uint32_t n) {
  struct hsr_mask_counts *counts = p->counts;
  struct hsr_mask_cell cell = root_of(p);
  struct hsr_bounds at = {x, y, x + 1, y + 1};
  if (!counts->cube)
    return;
  counts->all -= n < counts->all ? n : counts->all;
  for (;; cell = subcell(&cell, hsr_first_bit(subcells_of(&cell, &at)))) {
    uint32_t *left = left_of(p, &cell);
    if (left)
      *left -= n < *left ? n : *left;
    if (is_finest(p, &cell) || cell.size <= size)
      return;
  }
}

enum hsr_status hsr_masks_counts_init(struct hsr_masks *p,
                                      struct hsr_arena *arena) {
  struct hsr_mask_counts *counts =
      HSR_NEW_ZEROED(arena, struct hsr_mask_counts, 1);
  p->counts = counts;
  for (int level = 0; counts && level < p->n_levels; level++) {
    size_t n = hsr_masks_cells(p, level);
    counts->stamp[level] = HSR_NEW_ZEROED(arena, uint32_t, n);
    counts->left[level] = HSR_NEW(arena, uint32_t, n);
    if (!counts->stamp[level] || !counts->left[level])
      return HSR_E_NOMEM;
  }
  return counts ? HSR_OK : HSR_E_NOMEM;
}

/* --- Listing 1 ------------------------------------------------------------ */

/* What is done in a cell that listing 1 comes to. Each says whether that is
 * enough, and the traversal ends. */
struct purpose {
  bool (*finest)(const struct task *t, const struct hsr_mask_cell *cell,
                 const uint32_t *list, uint32_t n);
  /* Of a cell of which the polygon's masks are known and of which the subcells
   * `in` meet the box: makes W and gives A. */
  bool (*coarse)(const struct task *t, const struct hsr_mask_cell *cell,
                 struct hsr_triage polygon, uint64_t in, uint64_t *a);
  void (*before)(const struct task *t, const struct hsr_mask_cell *cell,
                 const struct hsr_mask_cell *sub);
  void (*after)(const struct task *t, const struct hsr_mask_cell *cell,
                const struct hsr_mask_cell *sub);
  void (*leave)(const struct task *t, const struct hsr_mask_cell *cell,
                uint64_t a);
};

/* Subcells of the finest level that are few are put to all lines at once: then
 * nothing is known of the cell's masks. */
static bool is_few(uint64_t subcells) {
  for (int k = 0; k < FEW; k++)
    subcells &= subcells - 1;
  return !subcells;
}

static void take_all(struct hsr_mask_lines *active, const uint32_t *list,
                     uint32_t n) {
  active->n = n;
  for (uint32_t k = 0; k < n; k++) {
    active->number[k] = list[k];
    active->inside[k] = 0;
  }
}

/* The polygon's masks of a cell, and the active lines; false if it is outside.
 */
static inline bool build_mask(const struct task *t,
                              const struct hsr_mask_cell *cell,
                              const uint32_t *list, uint32_t n, uint64_t in,
                              bool of_pixels, struct hsr_triage *polygon) {
  struct hsr_masks *p = t->masks;
  struct hsr_mask_lines *active = &p->lines[cell->level];
  if (of_pixels && is_few(in)) {
    take_all(active, list, n);
    *polygon = (struct hsr_triage){0, 0};
    return true;
  }
  if (!p->twin->compose(p, t->polygon, cell, list, n, active, polygon))
    return false;
  if (t->polygon->covers)
    polygon->c = 0;
  return true;
}

/* Listing 1, for a purpose: `again` is the same for the subcells. */
static inline __attribute__((always_inline)) bool
tile_poly(const struct task *t, const struct hsr_mask_cell *cell,
          const uint32_t *list, uint32_t n, const struct purpose *purpose,
          bool (*again)(const struct task *, const struct hsr_mask_cell *,
                        const uint32_t *, uint32_t)) {
  struct hsr_masks *p = t->masks;
  struct hsr_mask_lines *active = &p->lines[cell->level];
  struct hsr_triage polygon;
  uint64_t a;
  if (is_finest(p, cell))
    return purpose->finest(t, cell, list, n);
  uint64_t in = subcells_of(cell, &t->box);
  bool of_pixels = t->at_once && cell->level == p->n_levels - 2;
  if (!build_mask(t, cell, list, n, in, of_pixels, &polygon)) {
    count_visit(p, cell, false);
    return false;
  }
  if (purpose->coarse(t, cell, polygon, in, &a))
    return true;
  if (of_pixels) {
    p->twin->tile_pixels(t, cell, active, mask_of(p, cell), a);
    return false;
  }
  for (uint64_t rest = a; rest; rest &= rest - 1) {
    int bit = hsr_first_bit(rest);
    struct hsr_mask_cell sub = subcell(cell, bit);
    purpose->before(t, cell, &sub);
    uint32_t n_sub = choose(active, bit);
    if (again(t, &sub, active->list, n_sub))
      return true;
    purpose->after(t, cell, &sub);
  }
  purpose->leave(t, cell, a);
  return false;
}

/* Lazy clearing. */
static void clear_vacant(const struct task *t, const struct hsr_mask_cell *cell,
                         const struct hsr_mask_cell *sub) {
  if (mask_of(t->masks, cell)->v >> (sub->number & 63) & 1)
    clear(t->masks, sub);
}

static void pass_by(const struct task *t, const struct hsr_mask_cell *cell,
                    const struct hsr_mask_cell *sub) {
  (void)t;
  (void)cell;
  (void)sub;
}

static void go_away(const struct task *t, const struct hsr_mask_cell *cell,
                    uint64_t a) {
  (void)t;
  (void)cell;
  (void)a;
}

/* To tile. */

static inline bool tile_coarse(const struct task *t,
                               const struct hsr_mask_cell *cell,
                               struct hsr_triage polygon, uint64_t in,
                               uint64_t *a) {
  struct hsr_triage *mask = mask_of(t->masks, cell);
  uint64_t w = mask->v & polygon.c;
  mask->c |= w;
  mask->v &= ~w;
  *a = not_exhausted(t->masks, cell, ~(w | polygon.v | mask->c) & in);
  count_visit(t->masks, cell, w | *a);
  write_squares(t, cell, w);
  return false;
}

static inline void go_up(const struct task *t, const struct hsr_mask_cell *cell,
                         const struct hsr_mask_cell *sub) {
  propagate(t->masks, sub, mask_of(t->masks, cell));
}

static bool tile(const struct task *t, const struct hsr_mask_cell *cell,
                 const uint32_t *list, uint32_t n) {
  static const struct purpose tiling = {tile_finest, tile_coarse, clear_vacant,
                                        go_up, go_away};
  return tile_poly(t, cell, list, n, &tiling, tile);
}

/* To ask whether the polygon covers a sample that is not covered. What the
 * lines do not place surely outside counts as inside. */

static bool look_finest(const struct task *t, const struct hsr_mask_cell *cell,
                        const uint32_t *list, uint32_t n) {
  bool shows = t->masks->twin->shows_finest(t, cell, list, n);
  count_visit(t->masks, cell, shows);
  return shows;
}

static inline bool look_coarse(const struct task *t,
                               const struct hsr_mask_cell *cell,
                               struct hsr_triage polygon, uint64_t in,
                               uint64_t *a) {
  uint64_t open = in & ~mask_of(t->masks, cell)->c & ~polygon.v;
  count_visit(t->masks, cell, open);
  *a = open & ~polygon.c;
  return open & polygon.c;
}

static bool shows(const struct task *t, const struct hsr_mask_cell *cell,
                  const uint32_t *list, uint32_t n) {
  static const struct purpose asking = {look_finest, look_coarse, clear_vacant,
                                        pass_by, go_away};
  return tile_poly(t, cell, list, n, &asking, shows);
}

/* To count the samples that the polygon may cover and that are not covered. */

static void begin_count(const struct task *t,
                        const struct hsr_mask_cell *cell) {
  struct hsr_mask_counts *counts = t->masks->counts;
  counts->stamp[cell->level][cell->number] = counts->cube;
  counts->left[cell->level][cell->number] = 0;
}

static bool count_finest(const struct task *t, const struct hsr_mask_cell *cell,
                         const uint32_t *list, uint32_t n) {
  struct hsr_masks *p = t->masks;
  uint64_t unsure;
  uint64_t open = ~p->finest[cell->number] &
                  p->twin->candidates(p, t->polygon, cell, list, n,
                                      pattern_of(p, cell), &unsure);
  p->counts->left[cell->level][cell->number] = (uint32_t)hsr_count_bits(open);
  count_visit(p, cell, open);
  return false;
}

/* Vacant subcells within the polygon are not entered. */
static bool count_coarse(const struct task *t, const struct hsr_mask_cell *cell,
                         struct hsr_triage polygon, uint64_t in, uint64_t *a) {
  struct hsr_masks *p = t->masks;
  const struct hsr_triage *mask = mask_of(p, cell);
  uint64_t open = in & ~mask->c & ~polygon.v;
  uint64_t whole = open & polygon.c & mask->v;
  uint32_t *left = &p->counts->left[cell->level][cell->number];
  count_visit(p, cell, open);
  *a = open & ~whole;
  for (; whole; whole &= whole - 1) {
    struct hsr_mask_cell sub = subcell(cell, hsr_first_bit(whole));
    struct hsr_window w = window_of(p, &sub);
    *left += (uint32_t)((w.x1 - w.x0) * (w.y1 - w.y0));
  }
  return false;
}

static void begin_subcell(const struct task *t,
                          const struct hsr_mask_cell *cell,
                          const struct hsr_mask_cell *sub) {
  clear_vacant(t, cell, sub);
  begin_count(t, sub);
}

static void add_subcell(const struct task *t, const struct hsr_mask_cell *cell,
                        const struct hsr_mask_cell *sub) {
  uint32_t *const *left = t->masks->counts->left;
  left[cell->level][cell->number] += left[sub->level][sub->number];
}

static bool count(const struct task *t, const struct hsr_mask_cell *cell,
                  const uint32_t *list, uint32_t n) {
  static const struct purpose counting = {count_finest, count_coarse,
                                          begin_subcell, add_subcell, go_away};
  return tile_poly(t, cell, list, n, &counting, count);
}

/* To take a visitor along. */

static bool visit_finest(const struct task *t, const struct hsr_mask_cell *cell,
                         const uint32_t *list, uint32_t n) {
  struct hsr_masks *p = t->masks;
  const struct hsr_mask_visitor *visitor = t->visitor;
  struct hsr_triage unknown = {0, 0};
  uint64_t mask = visitor->enter(visitor->context, cell, unknown), unsure;
  count_visit(p, cell, mask);
  if (mask && t->polygon->inside)
    mask = covered_samples(p, t->polygon, cell, list, n, mask);
  else if (mask)
    mask &= p->twin->candidates(p, t->polygon, cell, list, n,
                                pattern_of(p, cell), &unsure);
  if (mask)
    visitor->samples(visitor->context, cell, mask);
  return false;
}

static bool visit_coarse(const struct task *t, const struct hsr_mask_cell *cell,
                         struct hsr_triage polygon, uint64_t in, uint64_t *a) {
  polygon.v |= ~in;
  polygon.c &= ~polygon.v;
  *a = t->visitor->enter(t->visitor->context, cell, polygon);
  count_visit(t->masks, cell, *a);
  return false;
}

static void visit_left(const struct task *t, const struct hsr_mask_cell *cell,
                       uint64_t a) {
  t->visitor->leave(t->visitor->context, cell, a);
}

static bool visit(const struct task *t, const struct hsr_mask_cell *cell,
                  const uint32_t *list, uint32_t n) {
  static const struct purpose visiting = {visit_finest, visit_coarse, pass_by,
                                          pass_by, visit_left};
  return tile_poly(t, cell, list, n, &visiting, visit);
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
    count_visit(p, way, !hidden);
    if (hidden)
      return false;
    way[1] = subcell(way, hsr_first_bit(in));
    if (mask->v & in)
      clear(p, &way[1]);
  }
}

/* Subcells of the finest level can be tiled together where no sample is found
 * by a table, and lines say all. */
static struct task task_of(struct hsr_masks *p,
                           const struct hsr_mask_polygon *polygon,
                           struct hsr_bounds box,
                           const struct hsr_mask_sink *sink) {
  struct task task = {.masks = p,
                      .polygon = polygon,
                      .box = box,
                      .sink = sink,
                      .at_once = !p->sample_tables && !polygon->covers};
  return task;
}

void hsr_masks_tile_found(struct hsr_masks *p,
                          const struct hsr_mask_polygon *polygon,
                          const struct hsr_mask_sink *sink) {
  struct task task = task_of(p, polygon, p->box, sink);
  int k = p->n_way - 1;
  tile(&task, &p->way[k], p->all, polygon->n);
  for (; k > 0; k--)
    propagate(p, &p->way[k], mask_of(p, &p->way[k - 1]));
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
  struct hsr_bounds box = {w->x0, w->y0, w->x1, w->y1};
  struct task task = task_of(p, polygon, box, sink);
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
  struct task task = {.masks = p, .polygon = polygon, .box = p->box};
  return shows(&task, &p->way[p->n_way - 1], p->all, polygon->n);
}

uint32_t hsr_masks_count(struct hsr_masks *p,
                         const struct hsr_mask_polygon *polygon,
                         struct hsr_bounds box) {
  struct hsr_mask_counts *counts = p->counts;
  struct task task = {.masks = p, .polygon = polygon, .box = box};
  counts->cube = 0;
  counts->all = 0;
  if (!hsr_masks_find(p, box))
    return 0;
  const struct hsr_mask_cell *cell = &p->way[p->n_way - 1];
  counts->cube = ++counts->cubes;
  begin_count(&task, cell);
  count(&task, cell, p->all, polygon->n);
  counts->all = counts->left[cell->level][cell->number];
  return counts->all;
}

/* --- For those who go through the pyramid by themselves ------------------- */

bool hsr_masks_visit(struct hsr_masks *p,
                     const struct hsr_mask_polygon *polygon,
                     struct hsr_bounds box,
                     const struct hsr_mask_visitor *visitor) {
  struct task task = {
      .masks = p, .polygon = polygon, .box = box, .visitor = visitor};
  struct hsr_mask_cell way[HSR_MASK_LEVELS];
  uint64_t in[HSR_MASK_LEVELS];
  int k = 0;
  way[0] = root_of(p);
  for (;; k++) {
    in[k] = subcells_of(&way[k], &box);
    if (is_finest(p, &way[k]) || in[k] & (in[k] - 1))
      break;
    struct hsr_triage polygon_there = {0, ~in[k]};
    bool entered = visitor->enter(visitor->context, &way[k], polygon_there);
    count_visit(p, &way[k], entered);
    if (!entered)
      break;
    way[k + 1] = subcell(&way[k], hsr_first_bit(in[k]));
  }
  bool met = is_finest(p, &way[k]) || in[k] & (in[k] - 1);
  if (met)
    visit(&task, &way[k], p->all, polygon->n);
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
