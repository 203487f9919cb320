/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Warnock's area subdivision: a window that is not homogeneous is divided into
 * four.
 *
 * Source      J. E. Warnock, "A hidden-surface algorithm for computer-generated
 *             halftone pictures", University of Utah, TR 4-15, 1969; as
 *             described by Sutherland et al. 1974, "J. E. Warnock", figures 25
 *             and 26, and appendix B. The early end of the search in Z order is
 *             theirs too, under "Sorting".
 * Notation    window -> struct hsr_area; surrounder, intersecter, disjoint ->
 *             enum hsr_relation, which area.c proves; ancestral information ->
 *             struct listed, and the window's part of list[]; depths of
 *             the critical surrounder -> struct hsr_area_depths
 * Invariants  when examine() begins, and when it ends, list[0, n) holds in Z
 *             order the faces that the enclosing window leaves open: they are
 *             neither disjoint from it nor hidden by one of its surrounders. A
 *             face of these surrounds an enclosing window if and only if its
 *             `since` is less than the level of the window examined.
 * Ties        by hsr_nearer at a sample; over a window, faces of one plane by
 *             the lower id, all else by depths farther apart than their errors
 * Departures  the corners of a window are samples, and the raster element is a
 *             sample, since the picture is one of samples;
 *             a face that is behind a surrounder is hidden in all sub-windows
 *             too: it is left out of them, as a disjoint one is;
 *             a window one sample wide or high is divided into two
 * Options     output=raster puts the windows out in the order of a raster
 *             display, as Cohen's scheme does (show.h); regions=64 and 256
 *             begin with windows whose faces are known from the last frame
 *             ("Frame and Object Coherence", regions.h); surround=sides,
 *             crossings and angles make the surround test in each of the ways of
 *             figure 8 (surround.h). The survey does not compare them.
 *             Measured, cost of sides, crossings, angles, beside the rest of
 *             the cull: house 76K, 530K, 212K beside 3.54M; harbor 209K, 1.43M,
 *             534K beside 13.0M; big-harbor 539K, 3.51M, 1.36M beside 41.9M.
 *             All their faces are known to be convex. The test by sides is the
 *             cheapest, and ends early; an intersection costs ten
 * Cost        Z sort 2 F_r, Warnock special 100 L_v D_c, depth search L_v D_c
 */
#include "algorithms/engines/windows/area.h"
#include "algorithms/image_space/area/warnock/regions.h"
#include "algorithms/image_space/area/warnock/show.h"
#include "algorithms/image_space/area/warnock/surround.h"
#include "algorithms/image_space/area/warnock/warnock.h"

#include <float.h>
#include <string.h>

/* Of the option that puts out rows; of the variant that divides at vertices. */
enum {
  RASTER_SORT,
  RASTER_MERGE,
  RASTER_ROWS,
  RANGES,
  ENTERED,
  LEFT,
  REGION_SORT,
  AT_VERTEX = 0
};

enum { OUTPUT, REGIONS, SURROUND }; /* options */
enum { WINDOWS, RASTER };
static const struct hsr_word outputs[] = {
    [WINDOWS] = {"windows", "a window at a time, as they are decided", 0},
    [RASTER] = {"raster", "a row at a time, after a sort by Y and X", 0},
    {NULL}};
enum { NO_REGIONS, BY_64, BY_256 };
static const struct hsr_word kept_regions[] = {
    [NO_REGIONS] = {"none", "nothing is kept: the picture is the first window",
                    0},
    [BY_64] = {"64", "each of 8 x 8 keeps its faces",
               HSR_FRAME_STATE | HSR_FOLLOWS},
    [BY_256] = {"256", "each of 16 x 16 keeps its faces",
                HSR_FRAME_STATE | HSR_FOLLOWS},
    {NULL}};
enum { BY_COVER, BY_SIDES, BY_CROSSINGS, BY_ANGLES };
static const struct hsr_word surround_tests[] = {
    [BY_COVER] = {"cover",
                  "whether the face covers a sample; not counted apart", 0},
    [BY_SIDES] = {"sides", "the sides of a convex face's edges", 0},
    [BY_CROSSINGS] = {"crossings", "edges that cross a semi-infinite line", 0},
    [BY_ANGLES] = {"angles", "the sum of the angles of the edges", 0},
    {NULL}};
static const struct hsr_option options[] = {
    [OUTPUT] = {"output", "in what order the picture is put out", outputs, 0,
                RASTER, WINDOWS},
    [REGIONS] = {"regions", "what is kept from the last frame", kept_regions, 0,
                 BY_256, NO_REGIONS},
    [SURROUND] = {"surround", "how a face is found to surround a point",
                  surround_tests, 0, BY_ANGLES, BY_COVER},
    {NULL}};

/* The Z sort: two passes of 9 bits. */
enum { DIGIT_BITS = 9, RADIX = 1 << DIGIT_BITS };

/* No more than 14 subdivisions at the centre lead down to a sample. At vertices
 * they may do worse, and so end at a level. */
enum { LAST_VERTEX_LEVEL = 28, NEVER = 255 };

_Static_assert(HSR_MAX_SIZE <= INT16_MAX, "bounds of struct listed");

/* hsr_relation; and a face that lies behind a surrounder. */
enum {
  DISJOINT = HSR_DISJOINT,
  INTERSECTER = HSR_INTERSECTER,
  SURROUNDER = HSR_SURROUNDER,
  HIDDEN
};

/* A face in the list of a window. */
struct listed {
  uint32_t id;
  uint32_t z;             /* no sample of the face is nearer, as z_key() */
  int16_t x0, y0, x1, y1; /* its bounds */
  uint8_t relation;       /* to the window examined last */
  uint8_t since;          /* level of the largest window it is known to
                             surround; NEVER */
};

struct state {
  const struct hsr_job *job;
  struct hsr_tally *tally;
  const struct hsr_screen *screen;
  bool at_vertices;                    /* subdivide at vertices */
  const struct hsr_finisher *finisher; /* NULL: there is none */
  struct hsr_show show;
  struct hsr_surround *surround; /* NULL: by hsr_covers */

  struct listed *list;  /* the relevant faces */
  struct listed *aside; /* as many, for sorting and setting aside */
  uint32_t *open;       /* the finisher's: ids of a window's faces */
  uint32_t n_disjoint;  /* faces left out of list[0, n), being disjoint */
  uint32_t n_hidden;    /* or hidden */
};

/* --- Z sort --------------------------------------------------------------- */

/* q as a number of 18 bits, whose order it keeps: of 1/t from 0 up, and in
 * parallel of -t down from 0. */
static uint32_t z_key(const struct hsr_view *view, double q) {
  double size = view->parallel ? -q : q;
  float value = size > 0 ? (float)fmin(size, FLT_MAX) : 0;
  uint32_t bits;
  memcpy(&bits, &value, sizeof bits);
  bits >>= 31 - 2 * DIGIT_BITS;
  return view->parallel ? (1u << 2 * DIGIT_BITS) - 1 - bits : bits;
}

/* The key of the nearest that any sample of face f may be. */
static uint32_t nearest_key(const struct hsr_screen *screen, uint32_t f) {
  const struct hsr_bounds *b = &screen->bounds[f];
  double nearest = -INFINITY;
  for (int corner = 0; corner < 4; corner++) {
    double q = hsr_depth(screen, f, corner & 1 ? b->x1 - 1 : b->x0,
                         corner & 2 ? b->y1 - 1 : b->y0);
    nearest = q > nearest ? q : nearest;
  }
  return z_key(screen->view, nearest + 2 * screen->plane[f].error);
}

static struct listed list_face(const struct hsr_screen *screen, uint32_t f,
                               uint32_t z) {
  const struct hsr_bounds *b = &screen->bounds[f];
  return (struct listed){.id = f,
                         .z = z,
                         .x0 = (int16_t)b->x0,
                         .y0 = (int16_t)b->y0,
                         .x1 = (int16_t)b->x1,
                         .y1 = (int16_t)b->y1,
                         .since = NEVER};
}

/* One pass of the sort: by one digit of z, the greatest first. */
static void sort_by_digit(struct state *s, const struct listed *from,
                          struct listed *to, int shift) {
  uint32_t n = s->screen->n_relevant, start[RADIX + 1] = {0};
  for (uint32_t k = 0; k < n; k++)
    start[RADIX - (from[k].z >> shift) % RADIX]++;
  for (int digit = 0; digit < RADIX; digit++)
    start[digit + 1] += start[digit];
  for (uint32_t k = 0; k < n; k++) {
    to[start[RADIX - 1 - (from[k].z >> shift) % RADIX]++] = from[k];
    HSR_STEP(s->tally, HSR_WARNOCK_Z_SORT, HSR_FACE(from[k].id), HSR_NOTHING,
             hsr_window_make(from[k].x0, from[k].y0, from[k].x1, from[k].y1),
             0);
  }
}

static void sort_z(struct state *s) {
  for (uint32_t r = 0; r < s->screen->n_relevant; r++) {
    uint32_t f = s->screen->relevant[r];
    s->list[r] = list_face(s->screen, f, nearest_key(s->screen, f));
  }
  sort_by_digit(s, s->list, s->aside, 0);
  sort_by_digit(s, s->aside, s->list, DIGIT_BITS);
}

/* --- Warnock special: a face against a window ----------------------------- */

static enum hsr_relation relate(const struct state *s, const struct listed *f,
                                const struct hsr_area *w) {
  bool reaches_over, asks = false;
  struct hsr_bounds bounds = {f->x0, f->y0, f->x1, f->y1};
  enum hsr_relation relation;
  if (hsr_area_box_decides(bounds, w, &relation, &reaches_over)) {
    HSR_STEP(s->tally, HSR_WARNOCK_MINIMAX, HSR_FACE(f->id), HSR_THE_WINDOW,
             hsr_area_samples(w), (int)relation);
    return relation;
  }
  if (!s->surround)
    return hsr_area_relate_edges(s->screen, f->id, w, reaches_over, s->tally);
  relation = hsr_area_relate_but_surround(s->screen, f->id, w, reaches_over,
                                          &asks, s->tally);
  return asks && hsr_surrounds(s->surround, f->id, w->x0, w->y0)
             ? HSR_SURROUNDER
             : relation;
}

/* The z_key of the farthest sample of surrounder f in the window. */
static uint32_t farthest(const struct state *s, uint32_t f,
                         const struct hsr_area *w) {
  struct hsr_area_depths depths = hsr_area_depths(s->screen, f, w);
  double q = depths.q[0];
  for (int corner = 1; corner < 4; corner++)
    q = depths.q[corner] < q ? depths.q[corner] : q;
  return z_key(s->job->view, q - 2 * depths.error);
}

/* Finds the relations of the faces in list[0, n) to the window. Stops at the
 * first face in Z order that is behind all of a surrounder, since all later
 * ones are too. Returns the place of that face, or n. */
static uint32_t cull(struct state *s, const struct hsr_area *w, uint32_t n) {
  uint32_t z_end = 0, k;
  for (k = 0; k < n && s->list[k].z >= z_end; k++) {
    struct listed *f = &s->list[k];
    if (f->since < w->level) {
      HSR_STEP(s->tally, HSR_WARNOCK_OLD_SURROUNDERS, HSR_FACE(f->id),
               HSR_THE_WINDOW, hsr_area_samples(w), 0);
      f->relation = SURROUNDER;
    } else {
      f->relation = (uint8_t)relate(s, f, w);
      f->since = f->relation == SURROUNDER ? (uint8_t)w->level : NEVER;
      HSR_STEP(s->tally, HSR_WARNOCK_SPECIAL, HSR_FACE(f->id), HSR_THE_WINDOW,
               hsr_area_samples(w), f->relation);
    }
    if (f->relation == SURROUNDER) {
      uint32_t z = farthest(s, f->id, w);
      z_end = z > z_end ? z : z_end;
    }
  }
  HSR_COMPUTED(s->tally, HSR_WARNOCK_OLD_DISJOINTS, s->n_disjoint);
  HSR_COMPUTED(s->tally, HSR_WARNOCK_HIDDEN_FACES, s->n_hidden + n - k);
  return k;
}

/* --- Depth search --------------------------------------------------------- */

/* Outcomes of a comparison in depth with a surrounder, as
 * HSR_WARNOCK_DEPTH_SEARCH names them. */
enum { UNDECIDED, BEHIND, IN_FRONT };

/* The surrounder that is nearest at the first corner: no other can be the
 * critical one. NULL: there is none. */
static struct listed *nearest_surrounder(struct state *s,
                                         const struct hsr_area *w, uint32_t n) {
  struct listed *nearest = NULL;
  for (uint32_t k = 0; k < n; k++) {
    struct listed *f = &s->list[k];
    if (f->relation != SURROUNDER)
      continue;
    if (nearest) {
      bool nearer =
          hsr_nearer(s->screen, f->id, nearest->id, w->x0, w->y0, s->tally);
      HSR_STEP(s->tally, HSR_WARNOCK_DEPTH_SEARCH, HSR_FACE(f->id),
               HSR_FACE(nearest->id), hsr_area_samples(w),
               nearer ? IN_FRONT : BEHIND);
      if (!nearer)
        continue;
    }
    nearest = f;
  }
  return nearest;
}

/* Which of a window's faces may be visible. */
struct remains {
  const struct listed *surrounder; /* the nearest; NULL: none */
  const struct listed *other;      /* one of the others; NULL: none */
  uint32_t n_others;               /* not hidden by the surrounder */
  int order;                       /* of surrounder and `other`, in depth */
};

static struct remains search_depth(struct state *s, const struct hsr_area *w,
                                   uint32_t n) {
  struct remains remains = {.surrounder = nearest_surrounder(s, w, n)};
  struct hsr_area_depths critical = {.id = HSR_BACKGROUND};
  if (remains.surrounder)
    critical = hsr_area_depths(s->screen, remains.surrounder->id, w);
  for (uint32_t k = 0; k < n; k++) {
    struct listed *f = &s->list[k];
    if (f->relation == DISJOINT || f == remains.surrounder)
      continue;
    int order = -1;
    if (remains.surrounder) {
      struct hsr_area_depths depths = hsr_area_depths(s->screen, f->id, w);
      order = hsr_area_order(s->screen, &critical, &depths);
      HSR_STEP(s->tally, HSR_WARNOCK_DEPTH_SEARCH, HSR_FACE(f->id),
               HSR_FACE(critical.id), hsr_area_samples(w),
               order > 0   ? BEHIND
               : order < 0 ? IN_FRONT
                           : UNDECIDED);
    }
    if (order > 0) {
      f->relation = HIDDEN;
      continue;
    }
    remains.other = f;
    remains.order = order;
    remains.n_others++;
  }
  return remains;
}

/* --- Decisions ------------------------------------------------------------ */

/* Work picture: n faces were looked at in the window. Each of its samples gets
 * an equal share. */
static void touch(struct state *s, const struct hsr_area *w, uint32_t n) {
  float *work = s->tally->work;
  if (!HSR_COUNTING || !work)
    return;
  float share = (float)n / ((float)(w->x1 - w->x0) * (float)(w->y1 - w->y0));
  for (int j = w->y0; j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++)
      work[(size_t)j * s->tally->work_stride + (size_t)i] += share;
}

/* Paints the window if it is homogeneous, or if one intersecter is left, alone
 * or in front of the critical surrounder. A window of one sample has no
 * intersecters and so is always homogeneous. */
static bool decide(struct state *s, const struct hsr_area *w,
                   const struct remains *remains) {
  uint32_t id = remains->surrounder ? remains->surrounder->id : HSR_BACKGROUND;
  bool one = remains->n_others == 1 && remains->order < 0 &&
             remains->other->relation == INTERSECTER;
  int counter;
  if (hsr_area_is_sample(w))
    counter = HSR_WARNOCK_SAMPLES;
  else if (!remains->n_others)
    counter = remains->surrounder ? HSR_WARNOCK_HOMOGENEOUS : HSR_WARNOCK_EMPTY;
  else if (one)
    counter =
        remains->surrounder ? HSR_WARNOCK_ONE_IN_FRONT : HSR_WARNOCK_ONE_FACE;
  else
    return false;
  HSR_STEP(s->tally, counter, HSR_FACE(id),
           one ? HSR_FACE(remains->other->id) : HSR_THE_WINDOW,
           hsr_area_samples(w), 0);
  hsr_show_window(&s->show, hsr_area_samples(w), id,
                  one ? remains->other->id : HSR_BACKGROUND);
  return true;
}

/* --- Subdivision ---------------------------------------------------------- */

/* Moves the faces of list[0, n) that stay open to the front, in order, and the
 * others behind them, in order too. Returns how many stay. */
static uint32_t set_aside(struct state *s, uint32_t n) {
  uint32_t n_kept = 0, n_aside = 0;
  for (uint32_t k = 0; k < n; k++) {
    const struct listed *f = &s->list[k];
    s->n_disjoint += f->relation == DISJOINT;
    s->n_hidden += f->relation == HIDDEN;
    if (f->relation == DISJOINT || f->relation == HIDDEN)
      s->aside[n_aside++] = *f;
    else
      s->list[n_kept++] = *f;
  }
  memcpy(s->list + n_kept, s->aside, n_aside * sizeof *s->aside);
  return n_kept;
}

/* Undoes set_aside: merges the two parts of list[0, n) by Z. */
static void take_back(struct state *s, uint32_t n_kept, uint32_t n) {
  uint32_t n_aside = n - n_kept;
  memcpy(s->aside, s->list + n_kept, n_aside * sizeof *s->aside);
  for (uint32_t to = n; n_aside;) {
    const struct listed *f = &s->aside[n_aside - 1];
    if (n_kept && s->list[n_kept - 1].z < f->z) {
      s->list[--to] = s->list[--n_kept];
      continue;
    }
    s->n_disjoint -= f->relation == DISJOINT;
    s->n_hidden -= f->relation == HIDDEN;
    s->list[--to] = *f;
    n_aside--;
  }
}

/* A division of a window: `column` and `row` are the first of its right and
 * lower parts. */
struct division {
  int column, row;
  uint32_t vertex; /* where it is divided; HSR_NO_ID: at the centre */
};

static struct division at_centre(const struct hsr_area *w) {
  return (struct division){w->x0 + (w->x1 - w->x0 + 1) / 2,
                           w->y0 + (w->y1 - w->y0 + 1) / 2, HSR_NO_ID};
}

/* Finds the vertex of list[0, n) among the window's samples that is nearest to
 * the centre. False if there is none. (To take the first in Z order instead
 * makes a quarter more windows in house and harbor, in twice the levels.) */
static bool at_vertex(const struct state *s, const struct hsr_area *w,
                      uint32_t n, struct division *at) {
  const struct hsr_world *world = s->job->world;
  double first_x = hsr_sample_x(s->job->view, 0);
  double first_y = hsr_sample_y(s->job->view, 0);
  struct division centre = at_centre(w);
  double least = INFINITY;
  for (uint32_t k = 0; k < n; k++) {
    uint32_t f = s->list[k].id;
    for (uint32_t c = world->mesh.start[f]; c < world->mesh.start[f + 1]; c++) {
      double column = ceil(s->screen->sx[world->mesh.vertex[c]] - first_x);
      double row = ceil(s->screen->sy[world->mesh.vertex[c]] - first_y);
      if (!(column > w->x0 && column < w->x1 && row > w->y0 && row < w->y1))
        continue;
      double away = fmax(fabs(column - centre.column), fabs(row - centre.row));
      if (away < least) {
        least = away;
        *at = (struct division){(int)column, (int)row, world->mesh.vertex[c]};
      }
    }
  }
  return least < INFINITY;
}

static void examine(struct state *s, struct hsr_window samples, int level,
                    uint32_t n);

/* Divides a window into four, or into two if it is one sample wide or high. */
static void subdivide(struct state *s, const struct hsr_area *w, uint32_t n) {
  struct division at = at_centre(w);
  if (s->at_vertices && w->level < LAST_VERTEX_LEVEL && at_vertex(s, w, n, &at))
    HSR_STEP(s->tally, AT_VERTEX, HSR_THE_WINDOW, HSR_VERTEX(at.vertex),
             hsr_area_samples(w), 0);
  HSR_STEP(s->tally, HSR_WARNOCK_SUBDIVISIONS, HSR_THE_WINDOW, HSR_NOTHING,
           hsr_area_samples(w), 0);
  for (int quarter = 0; quarter < 4; quarter++) {
    struct hsr_window part = {w->x0, w->y0, w->x1, w->y1};
    *(quarter & 1 ? &part.x0 : &part.x1) = at.column;
    *(quarter & 2 ? &part.y0 : &part.y1) = at.row;
    if (part.x0 < part.x1 && part.y0 < part.y1)
      examine(s, part, w->level + 1, n);
  }
}

/* Does the finisher have room for list[0, n)? */
static bool are_few(const struct state *s, uint32_t n) {
  const struct hsr_finisher *finisher = s->finisher;
  if (!finisher || n > finisher->most_faces)
    return false;
  uint32_t n_corners = 0;
  for (uint32_t k = 0; k < n; k++)
    n_corners += hsr_face_size(s->job->world, s->list[k].id);
  return n_corners <= finisher->most_corners;
}

static void finish(struct state *s, const struct hsr_area *w, uint32_t n) {
  struct hsr_window window = hsr_area_samples(w);
  HSR_STEP(s->tally, HSR_WARNOCK_FINISHED, HSR_THE_WINDOW, HSR_NOTHING, window,
           0);
  for (uint32_t k = 0; k < n; k++)
    s->open[k] = s->list[k].id;
  s->finisher->finish(s->finisher->context, &window, s->open, n);
}

/* A window that is neither homogeneous nor simple, and whose surrounders and
 * intersecters are list[0, n), in Z order. */
static void solve(struct state *s, const struct hsr_area *w, uint32_t n) {
  if (are_few(s, n))
    finish(s, w, n);
  else
    subdivide(s, w, n);
}

/* One window. list[0, n): the faces that the enclosing window leaves open. */
static void examine(struct state *s, struct hsr_window samples, int level,
                    uint32_t n) {
  HSR_STEP(s->tally, HSR_WARNOCK_WINDOWS, HSR_THE_WINDOW, HSR_NOTHING, samples,
           0);
  struct hsr_area w = hsr_area_make(s->job->view, samples);
  w.level = level;
  uint32_t n_reached = cull(s, &w, n);
  touch(s, &w, n_reached);
  struct remains remains = search_depth(s, &w, n_reached);
  if (decide(s, &w, &remains))
    return;

  s->n_hidden += n - n_reached;
  uint32_t n_kept = set_aside(s, n_reached);
  solve(s, &w, n_kept);
  take_back(s, n_kept, n_reached);
  s->n_hidden -= n - n_reached;
}

/* --- The algorithm -------------------------------------------------------- */

static enum hsr_status allocate(struct state *s) {
  struct hsr_arena *arena = s->job->scratch;
  uint32_t n = s->screen->n_relevant;
  s->list = HSR_NEW(arena, struct listed, n);
  s->aside = HSR_NEW(arena, struct listed, n);
  s->open = HSR_NEW(arena, uint32_t, s->finisher ? s->finisher->most_faces : 0);
  return s->list && s->aside && s->open ? HSR_OK : HSR_E_NOMEM;
}

/* The windows of the principal regions, with their faces as they were kept from
 * the last frame and brought up to date. */
static enum hsr_status examine_regions(struct state *s,
                                       struct hsr_regions *regions) {
  static const struct hsr_region_counters counted = {
      .ranges = RANGES, .enter = ENTERED, .leave = LEFT, .sort = REGION_SORT};
  uint32_t *key = HSR_NEW(s->job->scratch, uint32_t, s->job->world->n_faces);
  if (!key)
    return HSR_E_NOMEM;
  for (uint32_t r = 0; r < s->screen->n_relevant; r++)
    key[s->screen->relevant[r]] =
        nearest_key(s->screen, s->screen->relevant[r]);
  if (hsr_regions_update(regions, s->job, s->screen, key, &counted))
    return HSR_E_NOMEM;
  for (int r = 0; r < 1 << regions->level; r++)
    for (int c = 0; c < 1 << regions->level; c++) {
      struct hsr_window window = hsr_region_window(regions, c, r);
      if (window.x0 == window.x1 || window.y0 == window.y1)
        continue;
      size_t n;
      const uint32_t *faces = hsr_region_faces(regions, c, r, &n);
      for (size_t k = 0; k < n; k++)
        s->list[k] = list_face(s->screen, faces[k], key[faces[k]]);
      examine(s, window, regions->level, (uint32_t)n);
    }
  return HSR_OK;
}

/* What differs between the variants; all zero: none of it. */
struct ways {
  bool at_vertices;
  const struct hsr_finisher *finisher;
  const struct hsr_raster_counters *raster;
  struct hsr_regions *regions;
  struct hsr_surround *surround;
};

static enum hsr_status run(const struct hsr_job *job,
                           const struct hsr_screen *screen, struct ways ways) {
  struct state s = {.job = job,
                    .tally = job->tally,
                    .screen = screen,
                    .at_vertices = ways.at_vertices,
                    .finisher = ways.finisher,
                    .surround = ways.surround};
  if (allocate(&s) ||
      hsr_show_init(&s.show, job, screen, HSR_WARNOCK_RUNS, ways.raster))
    return HSR_E_NOMEM;
  if (ways.regions) {
    if (examine_regions(&s, ways.regions))
      return HSR_E_NOMEM;
  } else {
    sort_z(&s);
    examine(&s, job->view->window, 0, screen->n_relevant);
  }
  if (ways.raster &&
      (s.show.out_of_memory || hsr_show_raster(&s.show, ways.raster)))
    return HSR_E_NOMEM;
  return HSR_OK;
}

enum hsr_status hsr_warnock_run(const struct hsr_job *job,
                                const struct hsr_screen *screen,
                                const struct hsr_finisher *finisher) {
  return run(job, screen, (struct ways){.finisher = finisher});
}

static enum hsr_status make_screen(struct hsr_screen *screen,
                                   const struct hsr_job *job) {
  return hsr_screen_make(screen, job->world, job->view, job->scratch,
                         job->tally);
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  static const struct hsr_raster_counters raster = {
      .sort = RASTER_SORT, .merge = RASTER_MERGE, .rows = RASTER_ROWS};
  static const enum hsr_surround_way way[] = {
      [BY_SIDES] = HSR_SURROUND_SIDES,
      [BY_CROSSINGS] = HSR_SURROUND_CROSSINGS,
      [BY_ANGLES] = HSR_SURROUND_ANGLES};
  struct hsr_screen screen;
  struct hsr_surround surround;
  struct ways ways = {.raster = job->option[OUTPUT] == RASTER ? &raster : NULL,
                      .regions = job->prepared};
  if (make_screen(&screen, job))
    return hsr_fail_nomem(err);
  if (job->option[SURROUND] != BY_COVER) {
    ways.surround = &surround;
    if (hsr_surround_init(&surround, &screen, way[job->option[SURROUND]],
                          job->scratch, job->tally))
      return hsr_fail_nomem(err);
  }
  return run(job, &screen, ways) ? hsr_fail_nomem(err) : HSR_OK;
}

static enum hsr_status render_at_vertices(const struct hsr_job *job,
                                          struct hsr_error *err) {
  struct hsr_screen screen;
  return make_screen(&screen, job) ||
                 run(job, &screen, (struct ways){.at_vertices = true})
             ? hsr_fail_nomem(err)
             : HSR_OK;
}

/* The lists of the regions, kept from frame to frame. */
static enum hsr_status prepare(const struct hsr_world *world,
                               const long *option, void **prepared,
                               struct hsr_error *err) {
  static const int level[] = {[BY_64] = 3, [BY_256] = 4};
  if (option[REGIONS] == NO_REGIONS)
    return HSR_OK;
  *prepared = hsr_regions_new(level[option[REGIONS]], world->n_faces);
  return *prepared ? HSR_OK : hsr_fail_nomem(err);
}

static void release(void *prepared) {
  hsr_regions_free(prepared);
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {
    {&hsr_warnock_part}, {&hsr_surround_part}, {NULL}};

static const struct hsr_counter counters[] = {
    [RASTER_SORT] = {"raster sort",
                     "decided windows put into buckets, in each of two passes",
                     HSR_SORT, HSR_OF_WINDOW, HSR_OF_NOTHING, "by X|by Y"},
    [RASTER_MERGE] = {"raster merge",
                      "comparisons to merge windows into those of a row",
                      HSR_COMPARE, HSR_OF_WINDOW, HSR_OF_WINDOW, "right|left"},
    [RASTER_ROWS] = {"raster rows", "parts of windows put out, a row each",
                     HSR_RETIRE, HSR_OF_WINDOW, HSR_OF_NOTHING},
    [RANGES] = {"ranges",
                "faces whose regions are compared with the last frame's",
                HSR_COMPARE, HSR_OF_FACE, HSR_OF_NOTHING, "others|the same"},
    [ENTERED] = {"entered", "faces put into the list of a region", HSR_ACTIVATE,
                 HSR_OF_FACE, HSR_OF_WINDOW},
    [LEFT] = {"left", "faces taken from the list of a region", HSR_RETIRE,
              HSR_OF_FACE, HSR_OF_WINDOW},
    [REGION_SORT] = {"region sort", "comparisons of the Z sort of the lists",
                     HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE,
                     "in order|out of order"},
    {NULL}};

static const struct hsr_line outline[] = {
    {"", .part = &hsr_warnock_part},
    {"", .part = &hsr_warnock_part, .group = HSR_DIVIDE_LINES},
    {"with a raster: sort the decided windows by X and by Y",
     HSR_RAISES(RASTER_SORT)},
    {"  on each row, merge those that begin into those that go on",
     HSR_RAISES(RASTER_MERGE)},
    {"  put them out from left to right", HSR_RAISES(RASTER_ROWS)},
    {"", .part = &hsr_surround_part},
    {"with regions: find those of each face; are they the last frame's?",
     HSR_RAISES(RANGES)},
    {"  where not, change the lists of the regions", HSR_RAISES(ENTERED, LEFT)},
    {"  sort each list by Z, from the last frame's order on",
     HSR_RAISES(REGION_SORT)},
    {NULL}};

static const struct hsr_step steps[] = {{"region lists",
                                         RANGES,
                                         HSR_KIND_NUMBERS,
                                         NULL,
                                         NULL,
                                         {{ENTERED, HSR_KIND_BUCKET},
                                          {LEFT, HSR_KIND_BUCKET},
                                          {REGION_SORT, HSR_KIND_NUMBERS}}},
                                        {"raster sort",
                                         RASTER_SORT,
                                         HSR_KIND_BUCKET,
                                         NULL,
                                         NULL,
                                         {{RASTER_MERGE, HSR_KIND_LIST}}},
                                        {NULL}};

static const struct hsr_use uses_at_vertices[] = {{&hsr_warnock_part}, {NULL}};

static const struct hsr_counter counters_at_vertices[] = {
    [AT_VERTEX] = {"at vertices", "windows divided at a vertex", HSR_SUBDIVIDE,
                   HSR_OF_WINDOW, HSR_OF_VERTEX},
    {NULL}};

static const struct hsr_line outline_at_vertices[] = {
    {"", .part = &hsr_warnock_part},
    {"", .part = &hsr_warnock_part, .group = HSR_DIVIDE_LINES},
    {"    at the vertex nearest to its centre, if one is in the window",
     HSR_RAISES(AT_VERTEX)},
    {NULL}};

static const struct hsr_sort sorts[] = {{.part = &hsr_warnock_part}, {NULL}};

static const struct hsr_counter warnock_counters[] = {
    {"Z sort", "faces put into buckets, in each of two passes", HSR_SORT,
     HSR_OF_FACE},
    {"Warnock special", "faces tested against a window", HSR_COMPARE,
     HSR_OF_FACE, HSR_OF_WINDOW, "disjoint|intersecter|surrounder",
     .key = "window-test"},
    {"depth search", "faces compared in depth with a surrounder", HSR_COMPARE,
     HSR_OF_FACE, HSR_OF_FACE, "undecided|behind|in front",
     .outcome_keys = "undecided"},
    {"windows", "windows examined", HSR_ACTIVATE, HSR_OF_WINDOW},
    {"subdivisions", "windows divided into smaller ones", HSR_SUBDIVIDE,
     HSR_OF_WINDOW, .key = "subdivision"},
    {"minimax culls", "faces tested that their boxes decided", HSR_COMPARE,
     HSR_OF_FACE, HSR_OF_WINDOW, "disjoint|intersecter",
     .outcome_keys = "boxes|boxes"},
    {"inherited surrounders",
     "faces not tested: surrounders of a larger window", HSR_ACTIVATE,
     HSR_OF_FACE, HSR_OF_WINDOW},
    {"inherited disjoints",
     "faces not tested, since they are disjoint from a larger window",
     HSR_REJECT, HSR_OF_FACE, HSR_OF_WINDOW, NULL, true},
    {"hidden faces", "faces not tested, since a surrounder hides them",
     HSR_REJECT, HSR_OF_FACE, HSR_OF_WINDOW, NULL, true},
    {"empty windows", "decided: no face in them", HSR_ACCEPT, HSR_OF_FACE,
     HSR_OF_WINDOW, .key = "empty-window"},
    {"homogeneous windows", "decided: a critical surrounder", HSR_ACCEPT,
     HSR_OF_FACE, HSR_OF_WINDOW, .key = "homogeneous-window"},
    {"one face", "decided: no surrounder and one intersecter", HSR_ACCEPT,
     HSR_OF_FACE, HSR_OF_FACE, .outcome_keys = "behind"},
    {"one in front", "decided: one intersecter before the critical surrounder",
     HSR_ACCEPT, HSR_OF_FACE, HSR_OF_FACE, .outcome_keys = "behind"},
    {"samples", "decided: windows of a single sample", HSR_ACCEPT, HSR_OF_FACE,
     HSR_OF_WINDOW, .key = "sample"},
    {"runs", "runs of samples of the one intersecter", HSR_ACCEPT, HSR_OF_FACE,
     HSR_OF_WINDOW},
    {NULL}};

static double predict_z_sort(const struct hsr_table1 *t) {
  return 2 * t->F_r;
}
static double predict_special(const struct hsr_table1 *t) {
  return 100 * t->L_v * t->D_c;
}
static double predict_depth_search(const struct hsr_table1 *t) {
  return t->L_v * t->D_c;
}

static const struct hsr_step warnock_steps[] = {
    {"Z sort", HSR_WARNOCK_Z_SORT, HSR_KIND_BUCKET, "2 F_r", predict_z_sort},
    /* Every face meets a window by its box first; most are decided by that. */
    {"Warnock special",
     HSR_WARNOCK_SPECIAL,
     HSR_KIND_FACE_WINDOW,
     "100 L_v D_c",
     predict_special,
     {{HSR_WARNOCK_MINIMAX, HSR_KIND_FACE_WINDOW, .less = true},
      {HSR_WARNOCK_SPECIAL, HSR_KIND_BOX}}},
    {"depth search", HSR_WARNOCK_DEPTH_SEARCH, HSR_KIND_SURROUNDER, "L_v D_c",
     predict_depth_search},
    {NULL}};

/* Figure 29b being lost, the sorts are reconstructed from the text. */
static const struct hsr_sort warnock_sorts[] = {
    {"faces", "Z", "radix 512 Quicksort, two passes", "once a frame"},
    {"faces", "(XY)", "radix 4 Quicksort: cull and subdivision",
     "once a window"},
    {"surrounders and intersecters", "Z", "exhaustive search at the corners",
     "once a window"},
    {NULL}};

static const struct hsr_line window_lines[] = {
    {"Z sort: put the faces into buckets by depth, in two passes",
     HSR_RAISES(HSR_WARNOCK_Z_SORT)},
    {"for each window, of which the picture is the first",
     HSR_RAISES(HSR_WARNOCK_WINDOWS)},
    {"  for each face, in Z order: disjoint, an intersecter, a surrounder?",
     HSR_RAISES(HSR_WARNOCK_SPECIAL, HSR_WARNOCK_MINIMAX)},
    {"    inherit what is known from a larger window",
     HSR_RAISES(HSR_WARNOCK_OLD_SURROUNDERS, HSR_WARNOCK_OLD_DISJOINTS)},
    {"    stop at the first face that is behind all of a surrounder",
     HSR_RAISES(HSR_WARNOCK_HIDDEN_FACES)},
    {"  find the critical surrounder; which faces are behind it?",
     HSR_RAISES(HSR_WARNOCK_DEPTH_SEARCH)},
    {"  if the window is homogeneous, show the surrounder or the background",
     HSR_RAISES(HSR_WARNOCK_EMPTY, HSR_WARNOCK_HOMOGENEOUS)},
    {"  if it is a single sample, show the face that is nearest there",
     HSR_RAISES(HSR_WARNOCK_SAMPLES)},
    {"  if one intersecter is left, show what is behind it",
     HSR_RAISES(HSR_WARNOCK_ONE_FACE, HSR_WARNOCK_ONE_IN_FRONT)},
    {"    and then the intersecter", HSR_RAISES(HSR_WARNOCK_RUNS)},
    {NULL}};

static const struct hsr_line divide_lines[] = {
    {"  else divide the window into four",
     HSR_RAISES(HSR_WARNOCK_SUBDIVISIONS)},
    {NULL}};

const struct hsr_part hsr_warnock_part = {HSR_PART_WARNOCK,
                                          warnock_counters,
                                          warnock_steps,
                                          warnock_sorts,
                                          {window_lines, divide_lines}};

static const struct hsr_counter finished_counters[] = {
    {"finished windows", "left to the other algorithm", HSR_RETIRE,
     HSR_OF_WINDOW},
    {NULL}};

static const struct hsr_line finish_lines[] = {
    {"  else divide the window into four; but leave few faces to the other "
     "algorithm:",
     HSR_RAISES(HSR_WARNOCK_SUBDIVISIONS, HSR_WARNOCK_FINISHED)},
    {NULL}};

const struct hsr_part hsr_finished_part = {HSR_PART_FINISHED,
                                           finished_counters,
                                           NULL,
                                           NULL,
                                           {window_lines, finish_lines}};

/* Figure 29b is lost: the restrictions are reconstructed from the text. */
const struct hsr_algorithm HSR_ALGORITHM(warnock) = {
    .name = "warnock",
    .title = "Warnock's area subdivision",
    .parts = uses,
    .counters = counters,
    .outline = outline,
    .steps = steps,
    .options = options,
    .prepare = prepare,
    .render = render,
    .release = release,
    .authors = "J. E. Warnock",
    .year = 1969,
    .source = "TR 4-15, University of Utah, 1969; Sutherland et al., Computing "
              "Surveys 6(1), 1974, \"J. E. Warnock\"",
    .taxonomy = HSR_IMAGE_SPACE_AREA,
    .sort_order = "(XY)Z",
    .coherence = "area",
    .restrictions = 0,
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_IDS}},
    .sorts = sorts};

const struct hsr_algorithm HSR_ALGORITHM(warnock_vertices) = {
    .name = "warnock-vertices",
    .title = "Warnock's area subdivision, at vertices",
    .parts = uses_at_vertices,
    .counters = counters_at_vertices,
    .outline = outline_at_vertices,
    .render = render_at_vertices,
    .authors = "J. E. Warnock",
    .year = 1969,
    .source = "TR 4-15, University of Utah, 1969; Sutherland et al., Computing "
              "Surveys 6(1), 1974, \"J. E. Warnock\"",
    .taxonomy = HSR_IMAGE_SPACE_AREA,
    .sort_order = "(XY)Z",
    .coherence = "area",
    .restrictions = 0,
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_IDS}},
    .sorts = sorts};
