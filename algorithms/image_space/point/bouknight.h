/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bouknight's scan of a picture, for bouknight.c and the files of its options.
 */
#ifndef HSR_ALGORITHMS_BOUKNIGHT_H
#define HSR_ALGORITHMS_BOUKNIGHT_H

#include "algorithms/engines/light/glass.h"
#include "algorithms/engines/scan_line/implied.h"
#include "algorithms/engines/scan_line/regions.h"
#include "algorithms/image_space/point/shadow_pairs.h"

/* The counters of bouknight. */
enum {
  BOUKNIGHT_CULL,
  BOUKNIGHT_SEARCH,
  BOUKNIGHT_DIVISIONS,
  BOUKNIGHT_COMBINED,
  BOUKNIGHT_SPANS,
  BOUKNIGHT_TESTS,
  BOUKNIGHT_ENDINGS,
  BOUKNIGHT_FORECASTS,
  BOUKNIGHT_DECIDED,
  BOUKNIGHT_CARRIED,
  BOUKNIGHT_POINTS,
  BOUKNIGHT_PREDICTED,
  BOUKNIGHT_VERIFIED,
  BOUKNIGHT_FAILED,
  BOUKNIGHT_MOVED
};

/* No place: the visible bit is off. */
#define BOUKNIGHT_NONE UINT32_MAX

/* implied=carried: two faces that penetrate in a region. */
struct bouknight_implied {
  uint32_t first, last; /* the face on the left, and the one on the right */
  int row;              /* the last one on which they were found there */
  struct hsr_implied line;
};

/* depth=list. See bouknight_list.c. */
struct bouknight_list;

struct bouknight {
  struct hsr_scan edges; /* Y buckets and X sort list */
  int j;
  uint32_t *ids;                  /* of the row */
  struct hsr_glass *glass;        /* if the picture is transparent; else NULL */
  struct hsr_shadow_pairs *pairs; /* if it has shadows; else NULL */

  uint32_t *visible, n_visible; /* in a transparent picture, and with
                                   depth=list, by depth; except, in the former,
                                   for the last ones, which are new */
  uint32_t *place;              /* a face: where it stands in visible[] */

  /* The options; NULL: not chosen. */
  struct hsr_regions *regions;
  struct bouknight_implied *implied; /* by the edge at a span's left end */
  struct bouknight_list *list;
};

/* Puts face f into visible[]. */
static inline void bouknight_put_at(struct bouknight *s, uint32_t f,
                                    uint32_t place) {
  s->visible[place] = f;
  s->place[f] = place;
}

/* Takes a face out; the others keep their order. */
static inline void bouknight_take_out(struct bouknight *s, uint32_t f) {
  for (uint32_t k = s->place[f] + 1; k < s->n_visible; k++)
    bouknight_put_at(s, s->visible[k], k - 1);
  s->n_visible--;
  s->place[f] = BOUKNIGHT_NONE;
}

/* The step of an edge of the list at which a visible bit is turned on or off. */
static inline void bouknight_count_bit(struct bouknight *s,
                                       const struct hsr_scan_edge *edge,
                                       bool on, int left) {
  (void)edge, (void)on, (void)left; /* for the trace */
  HSR_STEP(s->edges.tally, BOUKNIGHT_CULL, HSR_FACE(edge->face),
           hsr_scan_subject(edge), HSR_ON(left, s->edges.window->x1, s->j), on);
}

/* Of f and g, is f nearer at sample i of the row? */
static inline bool bouknight_is_nearer(struct bouknight *s, uint32_t f,
                                       uint32_t g, int i) {
  HSR_TOUCH(s->edges.tally, i, s->j);
  bool nearer = hsr_nearer(&s->edges.screen, f, g, i, s->j, s->edges.tally);
  HSR_STEP(s->edges.tally, BOUKNIGHT_SEARCH, HSR_FACE(f), HSR_FACE(g),
           HSR_AT(i, s->j), nearer);
  return nearer;
}

/* The nearest of the visible faces at sample i. `nearest` is one of them. It is
 * known to be nearer than `behind`; BOUKNIGHT_NONE: than none. */
static inline uint32_t bouknight_search(struct bouknight *s, uint32_t nearest,
                                        uint32_t behind, int i) {
  for (uint32_t k = 0; k < s->n_visible; k++) {
    uint32_t f = s->visible[k];
    if (f != nearest && f != behind && bouknight_is_nearer(s, f, nearest, i))
      nearest = f;
  }
  return nearest;
}

/* Writes face `id` to a span. */
void bouknight_write(struct bouknight *s, uint32_t id, int left, int right);

/* regions=carried (bouknight_regions.c). bouknight_begin_regions: *regions is
 * borrowed; memory from job->scratch. HSR_E_NOMEM. bouknight_carry: carries what
 * was decided of the span behind place k of the list to this row, and writes it
 * to [left, right), which may be empty; false if it does not hold here.
 * bouknight_note_region: notes that `first` is visible there, if that holds on
 * the next row. */
enum hsr_status bouknight_begin_regions(struct bouknight *s,
                                        struct hsr_regions *regions);
bool bouknight_carry(struct bouknight *s, uint32_t k, int left, int right);
void bouknight_note_region(struct bouknight *s, uint32_t first, uint32_t k,
                           int left, int right);

/* implied=carried (bouknight_implied.c). bouknight_begin_implied: memory from
 * job->scratch. HSR_E_NOMEM. bouknight_extrapolate: the span [left, right)
 * behind edge e (hsr_regions_before) of the list, if two faces penetrated there
 * on the row before, and do so on this one where their line is expected: writes
 * it and returns true. bouknight_note_implied: notes that they do so here. */
enum hsr_status bouknight_begin_implied(struct bouknight *s);
bool bouknight_extrapolate(struct bouknight *s, uint32_t e, int left,
                           int right);
void bouknight_note_implied(struct bouknight *s, uint32_t e, uint32_t first,
                            uint32_t last);

/* depth=list (bouknight_list.c): begins a picture; solves a row. Memory from
 * job->scratch. HSR_E_NOMEM. */
enum hsr_status bouknight_begin_list(struct bouknight *s);
void bouknight_scan_list(struct bouknight *s);

#endif
