/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bouknight with regions=carried: which of several faces is visible in a span is
 * decided once, for all rows up to which no edge troubles it.
 *
 * Source      as of watkins_regions.c, which says what was measured
 * Notation    regions.h, which has the proof. A region is what lies between an
 *             edge of the list and the next one.
 * Departures  A span with a single face or none is not searched, and so not
 *             carried. One that is divided where two faces penetrate is decided
 *             on each row. */
#include "algorithms/image_space/point/bouknight.h"

#include <limits.h>

enum hsr_status bouknight_begin_regions(struct bouknight *s,
                                        struct hsr_regions *carried) {
  s->regions = carried;
  return hsr_regions_begin(carried, &s->edges, s->edges.job->world->n_faces,
                           (struct hsr_regions_counters){BOUKNIGHT_TESTS,
                                                         BOUKNIGHT_ENDINGS,
                                                         BOUKNIGHT_FORECASTS});
}

void bouknight_note_region(struct bouknight *s, uint32_t first, uint32_t k,
                           int left, int right) {
  struct hsr_regions *r = s->regions;
  int until = INT_MAX;
  (void)left, (void)right; /* for the trace */
  HSR_STEP(s->edges.tally, BOUKNIGHT_DECIDED, HSR_FACE(first), HSR_THE_WINDOW,
           HSR_ON(left, right, s->j), 0);
  if (!hsr_regions_go_on(r, k, k + 1))
    return;
  for (uint32_t n = 0; n < s->n_visible && until > s->j + 1; n++)
    if (s->visible[n] != first)
      until =
          hsr_regions_foresee(r, first, s->visible[n], hsr_regions_before(r, k),
                              hsr_regions_after(r, k), until);
  if (until > s->j + 1)
    hsr_regions_note(r, k, k, first, until);
}

bool bouknight_carry(struct bouknight *s, uint32_t k, int left, int right) {
  uint32_t end;
  const struct hsr_region *region =
      s->n_visible > 1 ? hsr_regions_carried(s->regions, k, &end) : NULL;
  if (!region || left >= right)
    return region;
  HSR_STEP(s->edges.tally, BOUKNIGHT_CARRIED, HSR_FACE(region->face),
           HSR_THE_WINDOW, HSR_ON(left, right, s->j), 0);
  bouknight_write(s, region->face, left, right);
  return true;
}
