/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Watkins with z=buckets: faces are put into Z buckets, which are compared
 * before the search in depth.
 *
 * Source      Sutherland et al. 1974, chapter IV, "Other Combinations of
 *             Sorting": why not sort by Z, too, as by X and by Y, on the first
 *             9 bits of the key?
 * Notation    Z -> q, 1/t or in parallel -t, which is linear on the screen
 * Invariant   no sample of face f is in a bucket before z_nearest[f] or behind
 *             z_farthest[f]
 * Departures  The buckets divide evenly the range of depths of the relevant
 *             faces. The survey counts on clipping to spread the depths well
 *             over the range of Z.
 * Cost        a step for each face; for each pair of segments one comparison,
 *             and only if that is undecided a comparison in depth, which costs
 *             30 */
#include "algorithms/image_space/point/watkins.h"

enum { BUCKETS = 512 };

struct range {
  double least, most;
};

/* The range of q on the samples of a face. q is linear, so it is within those
 * at the corners of the face's box. */
static struct range range_of(const struct hsr_screen *screen, uint32_t f) {
  const struct hsr_bounds *b = &screen->bounds[f];
  struct range range = {INFINITY, -INFINITY};
  for (int corner = 0; corner < 4; corner++) {
    double q = hsr_depth(screen, f, corner & 1 ? b->x1 - 1 : b->x0,
                         corner & 2 ? b->y1 - 1 : b->y0);
    range.least = fmin(range.least, q);
    range.most = fmax(range.most, q);
  }
  double error = 2 * screen->plane[f].error;
  return (struct range){range.least - error, range.most + error};
}

/* The bucket of q; bucket 0 is the nearest. */
static uint16_t bucket_of(struct range all, double q) {
  double place = (all.most - q) / (all.most - all.least) * BUCKETS;
  return (uint16_t)(place > 0 ? fmin(place, BUCKETS - 1) : 0);
}

static bool is_finite(struct range range) {
  return isfinite(range.least) && isfinite(range.most);
}

enum hsr_status hsr_watkins_sort_z(struct hsr_watkins *s, int sort,
                                   int compare) {
  const struct hsr_screen *screen = &s->edges.screen;
  struct hsr_arena *arena = s->edges.job->scratch;
  size_t n = screen->world->n_faces;
  s->z_nearest = HSR_NEW(arena, uint16_t, n);
  s->z_farthest = HSR_NEW(arena, uint16_t, n);
  s->z_counter = compare;
  if (!s->z_nearest || !s->z_farthest)
    return HSR_E_NOMEM;
  struct range all = {INFINITY, -INFINITY};
  for (uint32_t r = 0; r < screen->n_relevant; r++) {
    struct range range = range_of(screen, screen->relevant[r]);
    if (is_finite(range)) {
      all.least = fmin(all.least, range.least);
      all.most = fmax(all.most, range.most);
    }
  }
  for (uint32_t r = 0; r < screen->n_relevant; r++) {
    uint32_t f = screen->relevant[r];
    struct range range = range_of(screen, f);
    bool known = is_finite(range) && all.most > all.least;
    s->z_nearest[f] = known ? bucket_of(all, range.most) : 0;
    s->z_farthest[f] = known ? bucket_of(all, range.least) : BUCKETS - 1;
    HSR_STEP(s->tally, sort, HSR_FACE(f), HSR_NOTHING, HSR_NOWHERE, 0);
  }
  return HSR_OK;
}
