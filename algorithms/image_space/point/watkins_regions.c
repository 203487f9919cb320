/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Watkins with regions=carried: what is visible in a sample span is decided
 * once, for all rows up to which no edge troubles its region.
 *
 * Source      Sutherland et al. 1974, chapter IV, "Existing Uses of Coherence":
 *             Romney's observation, that the segments of one scan line are
 *             visible on the next too if no edge has come between, was more
 *             powerful than his use of it, which was for whole lines and for
 *             their left parts. He could have kept the sequence of visible
 *             segments in any region that no edge crosses. "Scan-Line
 *             Coherence" hopes for the same in the other algorithms.
 * Notation    Region: regions.h, which has the proof. That of a sample span
 *             reaches from the last edge at its left end or to the left of it, to
 *             the first edge at its right end.
 * Departures  - Faces may penetrate. Romney's may not. So the decision is
 *             carried only as long as no plane of another face in the region
 *             meets that of the visible one there. This is predicted once.
 *             - A span that ends where two faces penetrate has no edge at its
 *             end. It is decided on each line; so is one that is bounded by an
 *             end of a cut face.
 * Cost        one comparison for each edge on a row, which tells that it is in
 *             its place; one for each edge of a span that is decided, which
 *             tells whether it goes on; then two predictions or more, at 10,
 *             for each other segment in it
 * Measured    Span cull and depth search together, at the survey's prices, on
 *             500 lines of 500 samples, in thousands, without the option and
 *             with it:
 *               house         799     265   5,103 of 6,252 spans are carried
 *               harbor      3,864   3,541  12,315 of 26,613
 *               big-harbor  9,200  10,686   6,082 of 57,201
 *             and bouknight:regions=carried, where a span is shorter:
 *               house       1,664     397
 *               harbor      8,077   6,462
 *               big-harbor 12,900  15,125
 *             So the survey's hope is borne out where a face is many lines tall
 *             (73 and 16), and not where it is two or three: there an edge
 *             begins or ends in most regions, and the test of each edge costs
 *             more than it saves. */
#include "algorithms/image_space/point/watkins.h"

#include <limits.h>

enum hsr_status hsr_watkins_use_regions(struct hsr_watkins *s,
                                        struct hsr_watkins_regions *regions,
                                        size_t n_pieces,
                                        struct hsr_regions_counters counters) {
  s->regions = regions;
  return hsr_watkins_find_ends(s) ||
                 hsr_regions_begin(&regions->of, &s->edges, n_pieces, counters)
             ? HSR_E_NOMEM
             : HSR_OK;
}

/* The column of the edge behind place k, as far as the window's right side. */
static int column_at(const struct hsr_watkins *s, uint32_t k) {
  uint32_t e = hsr_regions_after(&s->regions->of, k);
  int x1 = s->edges.window->x1;
  return e == HSR_NO_ID || s->edges.edge[e].column > x1
             ? x1
             : s->edges.edge[e].column;
}

/* The first place from k on at which the column is `right` or more. */
static uint32_t place_of(const struct hsr_watkins *s, uint32_t k, int right) {
  while (k < s->regions->of.n_list && column_at(s, k) < right)
    k++;
  return k;
}

/* Up to which row the visible segment is nearer than another one of the region
 * between two edges. */
static int foresee(struct hsr_watkins *s, uint32_t f, uint32_t other,
                   uint32_t first, uint32_t last, int left, int right,
                   int until) {
  const struct hsr_watkins_segment *g = &s->segment[other];
  return hsr_regions_foresee(&s->regions->of, f, g->face,
                             g->x0 > left ? s->left[other] : first,
                             g->x1 < right ? s->right[other] : last, until);
}

/* Notes what has been decided of the span [left, right), which begins at place
 * k. `next`: the first segment that begins to the right of `left`. */
static void note(struct hsr_watkins *s,
                 const struct hsr_watkins_segment *visible, uint32_t k,
                 uint32_t next, int left, int right, int j) {
  struct hsr_regions *regions = &s->regions->of;
  uint32_t end = place_of(s, k, right);
  if (column_at(s, end) != right || !hsr_regions_go_on(regions, k, end + 1))
    return;
  uint32_t first = hsr_regions_before(regions, k);
  uint32_t last = hsr_regions_after(regions, end);
  int until = INT_MAX;
  for (uint32_t n = 0; n < s->n_under && until > j + 1; n++)
    if (&s->segment[s->under[n]] != visible)
      until = foresee(s, visible->face, s->under[n], first, last, left, right,
                      until);
  for (; next < s->n_segments && s->segment[next].x0 < right && until > j + 1;
       next++)
    until = visible ? foresee(s, visible->face, next, first, last, left, right,
                              until)
                    : j;
  if (until > j + 1)
    hsr_regions_note(regions, k, end, visible ? visible->face : HSR_BACKGROUND,
                     until);
}

void hsr_watkins_carry(struct hsr_watkins *s, int j) {
  const struct hsr_window *w = s->edges.window;
  struct hsr_regions *regions = &s->regions->of;
  uint32_t k = 0, end, next = 0;
  s->n_under = 0;
  hsr_regions_open(regions, j);
  for (int left = w->x0, right; left < w->x1;) {
    const struct hsr_region *region = hsr_regions_carried(regions, k, &end);
    if (region) {
      right = column_at(s, end);
      if (left < right) {
        HSR_STEP(s->tally, s->regions->carried, HSR_FACE(region->face),
                 HSR_THE_WINDOW, HSR_ON(left, right, j), 0);
        hsr_watkins_show(s, region->face, left, right, j);
        left = right;
      }
      k = end + 1;
    } else if (k < regions->n_list && column_at(s, k) <= left) {
      k++;
    } else {
      const struct hsr_watkins_segment *visible =
          hsr_watkins_decide(s, left, &right, &next, j);
      uint32_t id = visible ? visible->face : HSR_BACKGROUND;
      HSR_STEP(s->tally, s->regions->decided, HSR_FACE(id), HSR_THE_WINDOW,
               HSR_ON(left, right, j), 0);
      hsr_watkins_show(s, id, left, right, j);
      note(s, visible, k, next, left, right, j);
      left = right;
    }
  }
  hsr_regions_close(regions);
}
