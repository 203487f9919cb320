/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Watkins' algorithm as other algorithms use it: on the faces of a window, on
 * pieces of faces, and with another last step than the search in depth. See
 * watkins.c. */
#ifndef HSR_ALGORITHMS_WATKINS_H
#define HSR_ALGORITHMS_WATKINS_H

#include "algorithms/engines/scan_line/scan_line.h"
#include "common/adapt/surfaces.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Samples [x0, x1) of a face or piece on the current row. */
struct hsr_watkins_segment {
  uint32_t face, piece; /* as in struct hsr_scan_edge */
  int x0, x1;
};

/* Runs of segments, joined where they share an edge: see watkins_runs.c. */
struct hsr_watkins_runs {
  const struct hsr_surfaces *surfaces; /* borrowed */
  int counter;                         /* of segments looked at */
  uint32_t *shared;                    /* by scan edge, as in hsr_surfaces */

  /* Of the row: its segments, the scan edges at both ends of each, and the next
   * one in its run. By shared
   * edge: the segment that ends there, if row_of[] is the row. By run: the
   * first segment, and the one that was looked at last. */
  struct hsr_watkins_segment *part;
  uint32_t n_parts, *left, *right, *next;
  uint32_t *ends_there, *run_of, *first, *last_seen;
  int *row_of;
};

struct hsr_watkins {
  struct hsr_scan edges;   /* Y buckets and X sort list */
  struct hsr_tally *tally; /* theirs */

  uint32_t *open; /* a piece: its segment without right end */
  struct hsr_watkins_segment *segment; /* of the row, by ascending x0 */
  uint32_t n_segments;
  uint32_t *under, n_under; /* segments that reach over the span's left end */
  bool layer;               /* paint over what is there: show no background */

  /* Z buckets, or NULL: the buckets of each face's nearest and farthest point,
   * the nearest first. A comparison of them is a step of z_counter. */
  uint16_t *z_nearest, *z_farthest;
  int z_counter;

  struct hsr_watkins_runs *runs; /* which segment[] holds then; or NULL */

  /* The last step: is f nearer than g at the first sample of [l, r), where both
   * are? The answer is true for [l, *end). NULL: by a search in depth. */
  bool (*is_nearer)(void *context, const struct hsr_watkins_segment *f,
                    const struct hsr_watkins_segment *g, int l, int r, int j,
                    int *end);
  void *context;
};

/* Memory from job->scratch for windows that need no more than `room`, of pieces
 * with numbers less than n_pieces. HSR_E_NOMEM. */
enum hsr_status hsr_watkins_reserve(struct hsr_watkins *watkins,
                                    const struct hsr_job *job,
                                    const struct hsr_screen *screen,
                                    struct hsr_scan_room room, size_t n_pieces);

/* The rows of the window that watkins->edges was opened with, all edges being
 * added. */
void hsr_watkins_scan(struct hsr_watkins *watkins);

/* A window, which lies within the view's, and of whose samples no face covers
 * one but these n. */
void hsr_watkins_solve(struct hsr_watkins *watkins,
                       const struct hsr_window *window, const uint32_t *faces,
                       uint32_t n);

/* Shows the background in all of a window, for layers to be painted over. */
void hsr_watkins_clear(struct hsr_watkins *watkins,
                       const struct hsr_window *window);

/* Puts all relevant faces into Z buckets, each a step of `sort`, so that only
 * segments of faces that share a bucket are compared in depth. Steps of
 * `compare` tell the others apart. Memory from job->scratch. HSR_E_NOMEM. */
enum hsr_status hsr_watkins_sort_z(struct hsr_watkins *watkins, int sort,
                                   int compare);

/* Joins segments into runs from now on, all edges being added; each segment
 * looked at is a step of `counter`. *runs and *surfaces, which are those of the
 * world, are borrowed. Memory from job->scratch. HSR_E_NOMEM. */
enum hsr_status hsr_watkins_use_runs(struct hsr_watkins *watkins,
                                     struct hsr_watkins_runs *runs,
                                     const struct hsr_surfaces *surfaces,
                                     int counter);

/* What watkins.c takes from watkins_runs.c. hsr_watkins_join: makes runs of
 * segment[]. hsr_watkins_part: the segment of a run at column x, which is in
 * it. */
void hsr_watkins_join(struct hsr_watkins *watkins, int j);
const struct hsr_watkins_segment *
hsr_watkins_part(const struct hsr_watkins *watkins,
                 const struct hsr_watkins_segment *run, int x);

/* What these count: the spans; and the last step, where it is the search in depth.
 * The groups of lines of the spans: before the last step, whose lines are four
 * blanks deep, and after it. */
extern const struct hsr_part hsr_spans_part, hsr_depth_search_part;
enum { HSR_SPAN_CULL = HSR_FIRST_OF(HSR_PART_SPANS), HSR_SPANS };
enum {
  HSR_DEPTH_SEARCH = HSR_FIRST_OF(HSR_PART_DEPTH_SEARCH),
  HSR_DEPTH_DIVISIONS
};
enum { HSR_LINES_BEFORE_SEARCH, HSR_LINES_AFTER_SEARCH };

#ifdef __cplusplus
}
#endif
#endif
