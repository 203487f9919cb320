/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/engines/pyramid/pyramid.h"
#include "common/base/vector.h"

#include <string.h>

/* The counting build counts the reads of the paper's recursion. */
#if defined __x86_64__ && HSR_HAVE_TARGET_CLONES && !HSR_COUNTING
#include <immintrin.h>
#define READS_ROWS 1
#else
#define READS_ROWS 0
#endif
enum { ROW = 8 }; /* entries that are read at once */

static bool reads_rows(void) {
#if READS_ROWS
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") &&
         __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("lzcnt");
#else
  return false;
#endif
}

static int side_of(const struct hsr_pyramid *p, int level) {
  return 1 << (p->n_levels - 1 - level);
}

/* How many entries there are below a level: 4^(n-1) + 4^(n-2) + ... */
static inline int offset_of(int n_levels, int level) {
  return (int)(((1u << 2 * n_levels) - (1u << 2 * (n_levels - level))) / 3);
}

enum hsr_status hsr_pyramid_init(struct hsr_pyramid *p,
                                 const struct hsr_window *window, bool near,
                                 size_t *stride, struct hsr_arena *arena) {
  int width = window->x1 - window->x0, height = window->y1 - window->y0;
  int side = width > height ? width : height;
  *p = (struct hsr_pyramid){
      .window = *window, .n_levels = 1, .reads_rows = reads_rows()};
  while (1 << (p->n_levels - 1) < side)
    p->n_levels++;
  size_t all = (size_t)side_of(p, 0) * (size_t)side_of(p, 0) * 4 / 3 + 1 + ROW;
  float *far = HSR_NEW(arena, float, all), *nearest = NULL;
  if (near)
    nearest = HSR_NEW(arena, float, all);
  if (!far || (near && !nearest))
    return HSR_E_NOMEM;
  for (int level = 0; level < p->n_levels; level++) {
    p->far[level] = far + offset_of(p->n_levels, level);
    if (near)
      p->near[level] = level ? nearest + offset_of(p->n_levels, level) : far;
  }
  *stride = (size_t)side_of(p, 0);
  return HSR_OK;
}

void hsr_pyramid_clear(struct hsr_pyramid *p) {
  int width = p->window.x1 - p->window.x0, height = p->window.y1 - p->window.y0;
  for (int level = 0; level < p->n_levels; level++) {
    int side = side_of(p, level);
    int columns = ((width - 1) >> level) + 1,
        rows = ((height - 1) >> level) + 1;
    for (int y = 0; y < side; y++)
      for (int x = 0; x < side; x++) {
        size_t cell = (size_t)y * (size_t)side + (size_t)x;
        bool inside = x < columns && y < rows;
        p->far[level][cell] = inside ? 0 : HUGE_VALF;
        bool wholly = (x + 1) << level <= width && (y + 1) << level <= height;
        if (p->near[level])
          p->near[level][cell] = wholly ? 0 : HUGE_VALF;
      }
  }
}

/* --- Update --------------------------------------------------------------- */

/* NaN is the background's depth. */
static inline float known(float z) {
  return z > 0 ? z : 0;
}

/* The farthest of two rows' cells, two by two; whether any entry changed. */
static inline int reduce_few(const float *restrict row0,
                             const float *restrict row1, float *restrict to,
                             int n) {
  int changed = 0;
  for (int x = 0; x < n; x++) {
    float a = known(row0[2 * x]), b = known(row0[2 * x + 1]);
    float c = known(row1[2 * x]), d = known(row1[2 * x + 1]);
    a = a < b ? a : b;
    c = c < d ? c : d;
    a = a < c ? a : c;
    changed |= a != to[x];
    to[x] = a;
  }
  return changed;
}

HSR_VECTOR static int reduce_many(const float *restrict row0,
                                  const float *restrict row1,
                                  float *restrict to, int n) {
  return reduce_few(row0, row1, to, n);
}

/* Most boxes are small. */
static int reduce_far(const float *row0, const float *row1, float *to, int n) {
  return n < 8 ? reduce_few(row0, row1, to, n) : reduce_many(row0, row1, to, n);
}

/* NaN, or what is outside, is nearer than anything. */
static int reduce_near(const float *row0, const float *row1, float *to, int n) {
  int changed = 0;
  for (int x = 0; x < n; x++) {
    float nearest = 0;
    const float four[4] = {row0[2 * x], row0[2 * x + 1], row1[2 * x],
                           row1[2 * x + 1]};
    for (int k = 0; k < 4; k++)
      nearest = four[k] <= nearest ? nearest
                : four[k] > 0      ? four[k]
                                   : HUGE_VALF;
    changed |= nearest != to[x];
    to[x] = nearest;
  }
  return changed;
}

void hsr_pyramid_update(struct hsr_pyramid *p, struct hsr_bounds box) {
  int x0 = box.x0 - p->window.x0, y0 = box.y0 - p->window.y0;
  int x1 = box.x1 - p->window.x0 - 1, y1 = box.y1 - p->window.y0 - 1;
  for (int level = 1, changed = 1; level < p->n_levels && changed; level++) {
    size_t side = (size_t)side_of(p, level);
    x0 >>= 1, y0 >>= 1, x1 >>= 1, y1 >>= 1;
    changed = 0;
    for (int y = y0; y <= y1; y++) {
      size_t below = 4 * side * (size_t)y + 2 * (size_t)x0;
      size_t to = side * (size_t)y + (size_t)x0;
      const float *from = p->far[level - 1] + below;
      changed |=
          reduce_far(from, from + 2 * side, p->far[level] + to, x1 - x0 + 1);
      if (p->near[level]) {
        from = p->near[level - 1] + below;
        changed |= reduce_near(from, from + 2 * side, p->near[level] + to,
                               x1 - x0 + 1);
      }
    }
  }
}

/* --- Tests ---------------------------------------------------------------- */

/* The level of the smallest entry that encloses the rectangle. */
static int enclosing_level(const struct hsr_entries *r) {
  unsigned differ = (unsigned)(r->x0 ^ r->x1) | (unsigned)(r->y0 ^ r->y1);
  return differ ? 32 - __builtin_clz(differ) : 0;
}

/* The least level where the rectangle meets at most two by two entries. */
static int covering_level(const struct hsr_entries *r) {
  int width = r->x1 - r->x0, height = r->y1 - r->y0;
  unsigned side = (unsigned)(width > height ? width : height);
  return side > 1 ? 32 - __builtin_clz(side - 1) : 0;
}

static inline void count_read(const struct hsr_pyramid *p, int level, int x,
                              int y, bool decides) {
  if (HSR_COUNTING)
    hsr_entry_step(p->count->tally, p->count->reads, &p->window, level, x, y,
                   p->count->whom, decides);
}

static inline float entry(const struct hsr_pyramid *p, float *const *levels,
                          int level, int x, int y) {
  return levels[level][((size_t)y << (p->n_levels - 1 - level)) + (size_t)x];
}

/* Is depth q, HSR_CLEAR times, farther than an entry? */
static inline bool is_behind(const struct hsr_pyramid *p, int level, int x,
                             int y, float q) {
  bool behind = q < entry(p, p->far, level, x, y);
  count_read(p, level, x, y, behind);
  return behind;
}

bool hsr_pyramid_basic(struct hsr_pyramid *p, struct hsr_bounds box, float q) {
  struct hsr_entries r = hsr_entries_of(&p->window, box, 0);
  int level = enclosing_level(&r);
  return is_behind(p, level, r.x0 >> level, r.y0 >> level, q * HSR_CLEAR);
}

/* The part of a rectangle that an entry of a level covers, in entries of that
 * below, which are `level`. */
static inline struct hsr_entries below(const struct hsr_entries *r, int level,
                                       int x, int y) {
  int x0 = r->x0 >> level, y0 = r->y0 >> level;
  int x1 = r->x1 >> level, y1 = r->y1 >> level;
  return (struct hsr_entries){2 * x > x0 ? 2 * x : x0, 2 * y > y0 ? 2 * y : y0,
                              2 * x + 1 < x1 ? 2 * x + 1 : x1,
                              2 * y + 1 < y1 ? 2 * y + 1 : y1};
}

/* Do entries `e` of the level hide what of the rectangle r is in them? Those
 * that do not by themselves, by those below. q is the depth, HSR_CLEAR times.
 */
static bool hide(struct hsr_pyramid *p, const struct hsr_entries *r, float q,
                 int level, struct hsr_entries e) {
  for (int y = e.y0; y <= e.y1; y++)
    for (int x = e.x0; x <= e.x1; x++)
      if (!is_behind(p, level, x, y, q) &&
          (!level || !hide(p, r, q, level - 1, below(r, level - 1, x, y))))
        return false;
  return true;
}

static inline struct hsr_entries entries(const struct hsr_entries *r,
                                         int level) {
  return (struct hsr_entries){r->x0 >> level, r->y0 >> level, r->x1 >> level,
                              r->y1 >> level};
}

static bool hide_by_recursion(struct hsr_pyramid *p,
                              const struct hsr_entries *r, float q) {
  int level = covering_level(r);
  return hide(p, r, q, level, entries(r, level));
}

#if READS_ROWS

#define AVX2 __attribute__((target("avx2,bmi,bmi2,lzcnt")))

/* Which entries of a row are not behind depth q, of so many. */
AVX2 static inline unsigned open_in_row(const float *from, __m256 q,
                                        unsigned wanted) {
  __m256 open = _mm256_cmp_ps(q, _mm256_loadu_ps(from), _CMP_NLT_UQ);
  return (unsigned)_mm256_movemask_ps(open) & wanted;
}

/* Of eight by eight bits, those of rows y0 to y1 - 1 and columns x0 to x1 - 1. */
AVX2 static inline uint64_t bits_within(int x0, int y0, int x1, int y1) {
  if (x0 >= x1 || y0 >= y1)
    return 0;
  uint64_t row = (1u << x1) - (1u << x0);
  uint64_t rows = row * UINT64_C(0x0101010101010101);
  return rows >> (64 - 8 * (y1 - y0)) << 8 * y0;
}

/* hide_by_recursion of at most eight by eight samples, with the same answer. */
AVX2 static inline bool hide_few(const struct hsr_pyramid *p,
                                 const struct hsr_entries *r, float q) {
  size_t stride = (size_t)1 << (p->n_levels - 1);
  const float *from = p->far[0] + (size_t)r->y0 * stride + (size_t)r->x0;
  const unsigned wanted = (2u << (r->x1 - r->x0)) - 1;
  const __m256 depth = _mm256_set1_ps(q);
  unsigned open = 0;
  for (int y = r->y0; y <= r->y1; y++, from += stride)
    open |= open_in_row(from, depth, wanted);
  return !open;
}

/* The same of more. The farthest depth of an entry is that of a sample in it.
 * So an entry wholly in the rectangle decides. Of the others, those below do. */
AVX2 static bool hide_many(struct hsr_pyramid *p, const struct hsr_entries *r,
                           float q) {
  const int level = covering_level(r) - 2, side = 1 << level;
  struct hsr_entries e = entries(r, level);
  size_t row = (size_t)(p->n_levels - 1 - level);
  const float *from = p->far[level] + ((size_t)e.y0 << row) + (size_t)e.x0;
  const int columns = e.x1 - e.x0 + 1, rows = e.y1 - e.y0 + 1;
  const unsigned wanted = (1u << columns) - 1;
  const __m256 depth = _mm256_set1_ps(q);
  uint64_t open = 0;
  for (int y = 0; y < rows; y++, from += (size_t)1 << row)
    open |= (uint64_t)open_in_row(from, depth, wanted) << 8 * y;
  if (!open)
    return true;
  int left = (r->x0 & (side - 1)) != 0, top = (r->y0 & (side - 1)) != 0;
  int right = ((r->x1 + 1) & (side - 1)) != 0,
      bottom = ((r->y1 + 1) & (side - 1)) != 0;
  if (open & bits_within(left, top, columns - right, rows - bottom))
    return false;
  for (; open; open &= open - 1) {
    int at = __builtin_ctzll(open), x = e.x0 + at % ROW, y = e.y0 + at / ROW;
    if (!hide(p, r, q, level - 1, below(r, level - 1, x, y)))
      return false;
  }
  return true;
}

AVX2 static bool hide_by_rows(struct hsr_pyramid *p,
                              const struct hsr_entries *r, float q) {
  return r->x1 - r->x0 < ROW && r->y1 - r->y0 < ROW ? hide_few(p, r, q)
                                                    : hide_many(p, r, q);
}

#endif

bool hsr_pyramid_hides(struct hsr_pyramid *p, struct hsr_bounds box, float q) {
  struct hsr_entries r = hsr_entries_of(&p->window, box, 0);
#if READS_ROWS
  if (p->reads_rows)
    return hide_by_rows(p, &r, q * HSR_CLEAR);
#endif
  return hide_by_recursion(p, &r, q * HSR_CLEAR);
}

/* The largest value of e + ex x + ey y over the samples of a box, counted from
 * the triangle's first. */
static float largest(float e, float ex, float ey, const struct hsr_entries *b) {
  return e + ex * (float)(ex > 0 ? b->x1 : b->x0) +
         ey * (float)(ey > 0 ? b->y1 : b->y0);
}

/* Which triangles the four entries hide at which the fast test begins; -1,
 * those that are not to be tiled. */
HSR_VECTOR static void try_four(const struct hsr_pyramid *p, int n,
                                const struct hsr_corners *restrict r,
                                int *restrict hidden) {
  const int n_levels = p->n_levels, wx = p->window.x0, wy = p->window.y0;
  const float *restrict far = p->far[0];
  for (int k = 0; k < n; k++) {
    int x0 = r->x0[k] - wx, x1 = r->x1[k] - wx - 1;
    int y0 = r->y0[k] - wy, y1 = r->y1[k] - wy - 1;
    int width = x1 - x0, height = y1 - y0;
    float side = (float)((width > height ? width : height) - 1);
    int bits; /* of the number, from its exponent as a float */
    memcpy(&bits, &side, sizeof bits);
    int level = side >= 1 ? (bits >> 23) - 126 : 0;
    int row = n_levels - 1 - level;
    x0 >>= level, x1 >>= level, y0 >>= level, y1 >>= level;
    int at = offset_of(n_levels, level);
    float a = known(far[at + (y0 << row) + x0]);
    float b = known(far[at + (y0 << row) + x1]);
    float c = known(far[at + (y1 << row) + x0]);
    float d = known(far[at + (y1 << row) + x1]);
    a = a < b ? a : b;
    c = c < d ? c : d;
    a = a < c ? a : c;
    float q = hsr_nearest_corner(r, k);
    hidden[k] = q * HSR_CLEAR < a;
  }
}

void hsr_pyramid_hides_triangles(struct hsr_pyramid *p, int n,
                                 const struct hsr_corners *r, int *hidden) {
  try_four(p, n, r, hidden);
  for (int k = 0; k < n; k++) {
    if (hidden[k] && !HSR_COUNTING)
      continue;
    float q = hsr_nearest_corner(r, k);
    if (HSR_COUNTING)
      p->count->whom = HSR_FACE(r->id[k]);
    hidden[k] = hsr_pyramid_hides(
        p, (struct hsr_bounds){r->x0[k], r->y0[k], r->x1[k], r->y1[k]}, q);
  }
}

/* No depth q of the triangle in a part of its box is more than (1 + HSR_RHO)
 * times the largest that is computed at the part's corners: common to all the
 * samples in the box are the errors of the gradient and of the sums (tiler.c);
 * at those of the triangle, the snapped plane is that near to the true one. */
static bool hides_triangle(struct hsr_pyramid *p, struct hsr_tiler *t,
                           const struct hsr_triangle *tri,
                           const struct hsr_entries *r, int level, int x,
                           int y) {
  int x0 = x << level, y0 = y << level;
  int x1 = ((x + 1) << level) - 1, y1 = ((y + 1) << level) - 1;
  int dx = p->window.x0 - tri->x0, dy = p->window.y0 - tri->y0;
  struct hsr_entries b = {
      (x0 > r->x0 ? x0 : r->x0) + dx, (y0 > r->y0 ? y0 : r->y0) + dy,
      (x1 < r->x1 ? x1 : r->x1) + dx, (y1 < r->y1 ? y1 : r->y1) + dy};
  if (largest(tri->e0, tri->ex0, tri->ey0, &b) < -tri->bound ||
      largest(tri->e1, tri->ex1, tri->ey1, &b) < -tri->bound ||
      largest(tri->e2, tri->ex2, tri->ey2, &b) < -tri->bound)
    return true; /* it is not there */
  float q = largest(tri->q, tri->qx, tri->qy, &b) * (1 + HSR_RHO);
  if (is_behind(p, level, x, y, q * HSR_CLEAR))
    return true;
  if (!level--)
    return !hsr_tiler_shows(t, tri, x + p->window.x0, y + p->window.y0);
  for (int k = 0; k < 4; k++) {
    int cx = 2 * x + k % 2, cy = 2 * y + k / 2;
    if (cx >= r->x0 >> level && cx <= r->x1 >> level && cy >= r->y0 >> level &&
        cy <= r->y1 >> level && !hides_triangle(p, t, tri, r, level, cx, cy))
      return false;
  }
  return true;
}

bool hsr_pyramid_hides_triangle(struct hsr_pyramid *p, struct hsr_tiler *t,
                                const struct hsr_triangle *tri) {
  struct hsr_entries r = hsr_entries_of(
      &p->window, (struct hsr_bounds){tri->x0, tri->y0, tri->x1, tri->y1}, 0);
  int level = enclosing_level(&r);
  return hides_triangle(p, t, tri, &r, level, r.x0 >> level, r.y0 >> level);
}

bool hsr_pyramid_before(struct hsr_pyramid *p, struct hsr_bounds box, float q) {
  struct hsr_entries r = hsr_entries_of(&p->window, box, 0);
  int level = enclosing_level(&r);
  int x = r.x0 >> level, y = r.y0 >> level;
  bool before = q > HSR_CLEAR * entry(p, p->near, level, x, y);
  count_read(p, level, x, y, before);
  return before;
}
