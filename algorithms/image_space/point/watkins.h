/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Watkins' algorithm as other modules use it: on the faces of one window, on
 * pieces of faces, and with another last step than the search in depth. See
 * watkins.c for the algorithm and its source.
 *
 * How it is used: hsr_watkins_reserve, once a frame. Then for each window
 * either hsr_watkins_solve; or hsr_scan_open, hsr_scan_add for each piece, and
 * hsr_watkins_scan (algorithms/engines/scan_line/scan_line.h). Rows and columns
 * are those of samples in the picture. */
#ifndef HSR_ALGORITHMS_WATKINS_H
#define HSR_ALGORITHMS_WATKINS_H

#include "algorithms/engines/scan_line/regions.h"
#include "common/adapt/surfaces.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Samples [x0, x1) of a face or piece on the current row. */
struct hsr_watkins_segment {
  uint32_t face, piece; /* as in struct hsr_scan_edge */
  int x0, x1;
};

/* The option ends=contour: the segments of a row in runs, joined where one ends
 * at the edge where another begins; see watkins_runs.c. */
struct hsr_watkins_runs {
  const struct hsr_surfaces *surfaces; /* borrowed */
  int counter;      /* a step for each segment that is looked at to join it */
  uint32_t *shared; /* by scan edge: its number in hsr_surfaces, or
                       HSR_NOT_SHARED */

  /* By segment of the row: the segment; the next segment of its run, or
   * UINT32_MAX; the run it is in. */
  struct hsr_watkins_segment *part;
  uint32_t n_parts, *next, *run_of;

  /* By run: its first segment; and the one that was asked for last, where the
   * next search in it begins. */
  uint32_t *first, *last_seen;

  /* By shared edge: the segment that ends at it, on row row_of[]. On any other
   * row the entry is stale. */
  uint32_t *ends_there;
  int *row_of;
};

/* The option regions=carried: see watkins_regions.c. */
struct hsr_watkins_regions {
  struct hsr_regions of;
  int carried, decided; /* a step for each sample span */
};

/* The option spans=seen: see watkins_seen.c. */
struct hsr_watkins_seen {
  struct hsr_watkins_shown {
    uint32_t face;
    int right;
  } * above, *now; /* what was shown on the row before, and on this one */
  uint32_t n_above, n_now, at; /* above[at] covers the last span's left end */
  int passed, guesses;         /* counters */
};

struct hsr_watkins {
  struct hsr_scan edges;   /* Y buckets and X sort list */
  struct hsr_tally *tally; /* the job's */

  uint32_t *open; /* by piece: its segment that has no right end yet, or
                     UINT32_MAX */
  struct hsr_watkins_segment *segment; /* of the row, by ascending x0 */
  uint32_t n_segments;
  uint32_t *left, *right;   /* by segment: the scan edges at its ends. NULL: no
                             option needs them */
  uint32_t *under, n_under; /* the segments that cover the sample at the span's
                               left end: indices of segment[] */
  /* Set by the caller: this window is painted over what is there, so no
   * background is shown. */
  bool layer;

  /* The option z=buckets; else NULL. By face: the bucket of its nearest point,
   * and of its farthest. Bucket 0 is the nearest. A comparison of buckets is a
   * step of z_counter. */
  uint16_t *z_nearest, *z_farthest;
  int z_counter;

  struct hsr_watkins_runs *runs; /* ends=contour: segment[] holds runs, `piece`
                                    being their numbers; else NULL */

  struct hsr_watkins_regions *regions; /* regions=carried; else NULL */

  struct hsr_watkins_seen *seen; /* spans=seen; else NULL */

  /* The last step, if the caller sets it: is f nearer than g at sample l of row
   * j? Both cover the samples [l, r). *end is set so that the answer holds for
   * [l, *end), l < *end <= r. NULL: by the search in depth. */
  bool (*is_nearer)(void *context, const struct hsr_watkins_segment *f,
                    const struct hsr_watkins_segment *g, int l, int r, int j,
                    int *end);
  void *context;
};

/* Makes ready for windows that need no more than `room`, and for pieces whose
 * numbers are less than n_pieces. `job` and what *screen points to are
 * borrowed; memory is taken from job->scratch. HSR_E_NOMEM. */
enum hsr_status hsr_watkins_reserve(struct hsr_watkins *watkins,
                                    const struct hsr_job *job,
                                    const struct hsr_screen *screen,
                                    struct hsr_scan_room room, size_t n_pieces);

/* Solves the window that watkins->edges was opened with (hsr_scan_open), row by
 * row, when all edges have been added. */
void hsr_watkins_scan(struct hsr_watkins *watkins);

/* Solves a window, which lies within the view's: writes the visible face of all
 * its samples. These n faces are all that cover a sample of it. */
void hsr_watkins_solve(struct hsr_watkins *watkins,
                       const struct hsr_window *window, const uint32_t *faces,
                       uint32_t n);

/* Writes the background to all samples of a window, before layers are painted
 * (watkins->layer). */
void hsr_watkins_clear(struct hsr_watkins *watkins,
                       const struct hsr_window *window);

/* z=buckets: puts each relevant face into the Z buckets of its depths, a step
 * of the counter `sort`. From now on the buckets of two segments' faces are
 * compared first, a step of `compare`; only if the faces share a bucket are the
 * segments compared in depth. Memory from job->scratch. HSR_E_NOMEM. */
enum hsr_status hsr_watkins_sort_z(struct hsr_watkins *watkins, int sort,
                                   int compare);

/* ends=contour: from now on segments are joined into runs; each segment that is
 * looked at is a step of `counter`. All edges of the window have been added.
 * *runs, and *surfaces of the job's world, are borrowed as long as *watkins.
 * Memory from job->scratch. HSR_E_NOMEM. */
enum hsr_status hsr_watkins_use_runs(struct hsr_watkins *watkins,
                                     struct hsr_watkins_runs *runs,
                                     const struct hsr_surfaces *surfaces,
                                     int counter);

/* regions=carried: from now on what is decided of a sample span is carried to
 * the rows below, where it holds. counters: those of struct hsr_regions.
 * All edges of the window have been added. *regions is borrowed, and its
 * counters are set. Memory from job->scratch. HSR_E_NOMEM. */
enum hsr_status hsr_watkins_use_regions(struct hsr_watkins *watkins,
                                        struct hsr_watkins_regions *regions,
                                        size_t n_pieces,
                                        struct hsr_regions_counters counters);

/* spans=seen: from now on the search of a sample span begins with the face that
 * was visible there on the row before. *seen is borrowed, and its counters are
 * set. Memory from job->scratch. HSR_E_NOMEM. */
enum hsr_status hsr_watkins_use_seen(struct hsr_watkins *watkins,
                                     struct hsr_watkins_seen *seen);

/* For watkins.c alone. hsr_watkins_next_row: begins a row. hsr_watkins_guess:
 * moves the segment that is to be searched first to the front of under[].
 * hsr_watkins_remember: face `id` is shown up to column `right`. */
void hsr_watkins_next_row(struct hsr_watkins *s);
void hsr_watkins_guess(struct hsr_watkins *s, int left, int j);
void hsr_watkins_remember(struct hsr_watkins *s, uint32_t id, int right);

/* For watkins.c and the files of its options alone.
 * hsr_watkins_find_ends: memory for left[] and right[]. HSR_E_NOMEM.
 * hsr_watkins_decide: finds the visible segment of the sample span that begins
 * at `left`, or NULL, and the span's end. *next: the first segment that has not
 * been in under[].
 * hsr_watkins_show: writes a face, or the background, to a span.
 * hsr_watkins_carry: solves row j with regions=carried. */
enum hsr_status hsr_watkins_find_ends(struct hsr_watkins *watkins);
const struct hsr_watkins_segment *hsr_watkins_decide(struct hsr_watkins *s,
                                                     int left, int *right,
                                                     uint32_t *next, int j);
void hsr_watkins_show(struct hsr_watkins *s, uint32_t id, int left, int right,
                      int j);
void hsr_watkins_carry(struct hsr_watkins *s, int j);

/* For watkins.c alone. hsr_watkins_join: makes runs of the segments of row j,
 * in the place of segment[]. hsr_watkins_part: the segment of a run that covers
 * column x, which lies in the run. */
void hsr_watkins_join(struct hsr_watkins *watkins, int j);
const struct hsr_watkins_segment *
hsr_watkins_part(const struct hsr_watkins *watkins,
                 const struct hsr_watkins_segment *run, int x);

/* Two parts: the sample spans; and the search in depth, for modules that have
 * no other last step. Groups of lines of the spans' outline: before the last
 * step and after it. Between them stand the lines of the last step, indented by
 * four blanks. */
extern const struct hsr_part hsr_spans_part, hsr_depth_search_part;
enum { HSR_SPAN_CULL = HSR_FIRST_OF(HSR_PART_SPANS), HSR_SPANS };
enum {
  HSR_DEPTH_SEARCH = HSR_FIRST_OF(HSR_PART_DEPTH_SEARCH),
  HSR_DEPTH_DIVISIONS,
  HSR_DEPTH_DIVIDED,
  HSR_DEPTH_HALVES
};
enum { HSR_LINES_BEFORE_SEARCH, HSR_LINES_AFTER_SEARCH };

#ifdef __cplusplus
}
#endif
#endif
