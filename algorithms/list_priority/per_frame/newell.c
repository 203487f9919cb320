/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Newell, Newell and Sancha's algorithm: the priority of faces computed anew
 * for every frame, and faces painted over one another in its order.
 *
 * Source      M. E. Newell, R. G. Newell, T. L. Sancha, "A solution to the
 *             hidden surface problem", Proc. ACM Annual Conference, 1972; as
 *             described by Sutherland et al. 1974, "List-Priority Algorithms",
 *             figures 21 to 23; figure 29 reconstructed from the text.
 * Notation    the list, its Z sort and special sort -> priority_list.h; bead ->
 *             the samples [x0, x1) of a row
 * Invariant   at every sample the last one painted is the nearest of those
 *             painted so far
 * Ties        those of priority_list.h
 * Glass       Partial overwriting: a transparent face is combined with what it
 *             is painted over. Beads end where colours change
 *             (docs/transparent-picture.md).
 * Departures  Those of priority_list.h. Where one thick face is painted over
 *             another, depths at the samples decide as a bead is merged; these
 *             comparisons are counted apart. The picture is written at the end,
 *             bead by bead; without beads, segment by segment.
 * Options     special=groups, special=lateral: what the survey proposes for the
 *             special sort (priority_index.c)
 * Cost        segments 10 F_r H_f, X merge F_r H_f S_v / 4, and those of
 *             priority_list.h */
#include "algorithms/list_priority/per_frame/newell.h"
#include "algorithms/list_priority/per_frame/kept_order.h"
#include "common/answers/kinds/transparent.h"

#include <stdlib.h>
#include <string.h>

/* Of the survey's ways to find what P may obscure. */
enum { INDEX_SORT, GROUPS, AGAIN };

enum { SPECIAL }; /* option */
enum { ALONG_THE_LIST, BY_GROUPS, LATERAL };
static const struct hsr_word specials[] = {
    [ALONG_THE_LIST] = {"list", "along the list", 0},
    [BY_GROUPS] = {"groups", "by groups of faces: instances", 0},
    [LATERAL] = {"lateral", "laterally sorted, into cells of the picture", 0},
    {NULL}};
static const struct hsr_option options[] = {
    [SPECIAL] = {"special", "how the special sort finds {Q}", specials, 0,
                 LATERAL, ALONG_THE_LIST},
    {NULL}};

/* No bead. */
static const uint32_t NONE = UINT32_MAX;

struct bead {
  int x0, x1;
  uint32_t face, next;
  uint16_t rgb[3]; /* in a transparent picture */
};

static struct bead *bead_at(const struct hsr_newell *s, uint32_t b) {
  return (struct bead *)s->beads.items + b;
}

/* --- Beads ---------------------------------------------------------------- */

static uint32_t new_bead(struct hsr_newell *s, struct bead bead) {
  uint32_t b = s->free_bead;
  if (b != NONE)
    s->free_bead = bead_at(s, b)->next;
  else if (hsr_arena_grow(s->job->scratch, &s->beads, sizeof bead))
    b = (uint32_t)s->beads.n - 1;
  else
    s->list.out_of_memory = true;
  if (b != NONE)
    *bead_at(s, b) = bead;
  return b;
}

static void drop_bead(struct hsr_newell *s, uint32_t b) {
  bead_at(s, b)->next = s->free_bead;
  s->free_bead = b;
}

static void set_next(struct hsr_newell *s, int j, uint32_t bead,
                     uint32_t next) {
  if (bead == NONE)
    s->row[j - s->window->y0] = next;
  else
    bead_at(s, bead)->next = next;
}

static void tell_bead(const struct hsr_newell *s, uint32_t b, int j,
                      int covered) {
  const struct bead *bead = bead_at(s, b);
  HSR_STEP(s->tally, HSR_BEAD_MERGE, HSR_FACE(bead->face), HSR_THE_WINDOW,
           HSR_ON(bead->x0, bead->x1, j), covered);
}

/* The beads of row j around column x: the first that ends after it, and the one
 * before that. */
static uint32_t find_bead(struct hsr_newell *s, int j, int x,
                          uint32_t *before) {
  uint32_t b = s->row[j - s->window->y0];
  *before = NONE;
  while (b != NONE && bead_at(s, b)->x1 <= x) {
    tell_bead(s, b, j, 0);
    *before = b;
    b = bead_at(s, b)->next;
  }
  return b;
}

/* Makes the samples [x0, x1) of row j a bead, which overwrites what was there.
 */
static void merge_bead(struct hsr_newell *s, struct bead new, int j) {
  int x0 = new.x0, x1 = new.x1;
  uint32_t before, b = find_bead(s, j, x0, &before);
  uint32_t bead = new_bead(s, new);
  if (bead == NONE)
    return;
  if (b != NONE && bead_at(s, b)->x0 < x0) {
    struct bead left = *bead_at(s, b);
    left.x1 = x0;
    uint32_t l = new_bead(s, left);
    if (l == NONE)
      return;
    set_next(s, j, before, l);
    before = l;
    bead_at(s, b)->x0 = x0;
  }
  while (b != NONE && bead_at(s, b)->x1 <= x1) {
    uint32_t next = bead_at(s, b)->next;
    tell_bead(s, b, j, 1);
    drop_bead(s, b);
    b = next;
  }
  if (b != NONE && bead_at(s, b)->x0 < x1)
    bead_at(s, b)->x0 = x1;
  bead_at(s, bead)->next = b;
  set_next(s, j, before, bead);
}

static void write_samples(struct hsr_newell *s, struct bead new, int j) {
  if (new.x0 < new.x1)
    HSR_ACCEPTED(s->tally, HSR_NEWELL_WRITTEN, HSR_FACE(new.face),
                 HSR_THE_WINDOW, HSR_ON(new.x0, new.x1, j),
                 s->glass ? new.rgb : NULL);
  for (int i = new.x0; s->ids &&i < new.x1; i++)
    s->ids[(size_t)j * s->ids_stride + (size_t)i] = new.face;
  for (int i = new.x0; s->glass &&i < new.x1; i++)
    memcpy(hsr_glass_at(s->glass, i, j), new.rgb, sizeof new.rgb);
}

static void overwrite_opaque(struct hsr_newell *s, struct bead new, int j) {
  if (s->frame_buffer)
    write_samples(s, new, j);
  else
    merge_bead(s, new, j);
}

static struct bead on_frame_buffer(const struct hsr_newell *s, int i, int j,
                                   int most) {
  const uint32_t *ids = s->ids + (size_t)j * s->ids_stride;
  struct bead there = {i, i + 1, ids[i], NONE, {0}};
  if (s->glass)
    memcpy(there.rgb, hsr_glass_at(s->glass, i, j), sizeof there.rgb);
  while (there.x1 < most && ids[there.x1] == ids[i] &&
         (!s->glass || !memcmp(hsr_glass_at(s->glass, there.x1, j), there.rgb,
                               sizeof there.rgb)))
    there.x1++;
  return there;
}

/* What is painted at (i, j), as a bead that ends at `most` or before. Where
 * nothing is painted, its face is the background. */
static struct bead painted(struct hsr_newell *s, int i, int j, int most) {
  struct bead there = {i, most, HSR_BACKGROUND, NONE, {0}};
  if (s->glass)
    memcpy(there.rgb, s->glass->background.rgb, sizeof there.rgb);
  if (s->frame_buffer)
    return on_frame_buffer(s, i, j, most);
  uint32_t before, b = find_bead(s, j, i, &before);
  if (b == NONE)
    return there;
  const struct bead *bead = bead_at(s, b);
  int end = bead->x0 > i ? bead->x0 : bead->x1;
  if (bead->x0 <= i) {
    there.face = bead->face;
    memcpy(there.rgb, bead->rgb, sizeof there.rgb);
  }
  there.x1 = end < most ? end : most;
  return there;
}

/* Partial overwriting: a transparent face is combined with what lies under
 * it. */
static void overwrite_partly(struct hsr_newell *s, struct bead new, int j) {
  for (int i = new.x0, end = new.x1; i < end; i = new.x1) {
    struct bead under = painted(s, i, j, end);
    new.x0 = i;
    new.x1 = under.x1;
    memcpy(new.rgb, under.rgb, sizeof new.rgb);
    hsr_glass_over(s->glass, new.face, new.rgb);
    overwrite_opaque(s, new, j);
  }
}

static void overwrite(struct hsr_newell *s, uint32_t f, int x0, int x1, int j) {
  struct bead new = {x0, x1, f, NONE, {0}};
  if (s->glass)
    memcpy(new.rgb, hsr_glass_tint(s->glass, f)->rgb, sizeof new.rgb);
  if (s->glass && hsr_is_glass(s->glass, f))
    overwrite_partly(s, new, j);
  else
    overwrite_opaque(s, new, j);
}

/* Leaves out f, which is behind g at these samples. If g is transparent, f is
 * seen through it, in a place that what is painted no longer has. */
static void leave_out(struct hsr_newell *s, uint32_t g, int x0, int x1, int j) {
  if (s->glass && hsr_is_glass(s->glass, g))
    hsr_glass_dispute(s->glass, x0, x1, j);
}

static bool is_thick(const struct hsr_newell *s, uint32_t f) {
  return s->ask_all || s->list.thick[f];
}

/* Whether f is nearer than g at (i, j). */
static bool ask_sample(struct hsr_newell *s, uint32_t f, uint32_t g, int i,
                       int j) {
  bool nearer = f == g || hsr_nearer(s->list.screen, f, g, i, j, s->tally);
  HSR_STEP(s->tally, HSR_NEWELL_THICKNESS, HSR_FACE(f), HSR_FACE(g),
           HSR_AT(i, j), nearer);
  return nearer;
}

/* Overwrites those of the samples at which f is not behind what is there.
 * Depths are compared only with faces that are thick, too. */
static void overwrite_thick(struct hsr_newell *s, uint32_t f, int x0, int x1,
                            int j) {
  for (int i = x0, end; i < x1; i = end) {
    struct bead there = painted(s, i, j, x1);
    uint32_t g = there.face;
    end = there.x1;
    if (g == HSR_BACKGROUND || !is_thick(s, g)) {
      overwrite(s, f, i, end, j);
      continue;
    }
    bool first = ask_sample(s, f, g, i, j);
    int lo = i, hi = end - 1; /* the order of two planes changes once */
    if (ask_sample(s, f, g, hi, j) == first)
      lo = end;
    else
      for (lo++; lo < hi;) {
        int middle = lo + (hi - lo) / 2;
        if (ask_sample(s, f, g, middle, j) == first)
          lo = middle + 1;
        else
          hi = middle;
      }
    if (first)
      overwrite(s, f, i, lo, j);
    else
      leave_out(s, g, i, lo, j);
    if (first)
      leave_out(s, g, lo, end, j);
    else if (lo < end)
      overwrite(s, f, lo, end, j);
  }
}

static void paint(struct hsr_newell *s, const struct hsr_piece *piece) {
  uint32_t f = piece->face;
  const struct hsr_bounds *b = &piece->bounds;
  const struct hsr_window *w = s->window;
  int *columns = s->list.columns;
  struct hsr_face_rows rows;
  hsr_face_rows_begin(&rows, s->list.screen, f, s->tally);
  for (int j = b->y0; j < b->y1; j++) {
    int n = hsr_piece_rows_spans(&rows, piece->cuts, piece->n_cuts, j, columns,
                                 s->tally);
    for (int k = 0; k < n; k += 2) {
      int x0 = columns[k] > w->x0 ? columns[k] : w->x0;
      int x1 = columns[k + 1] < w->x1 ? columns[k + 1] : w->x1;
      if (x0 >= x1)
        continue;
      HSR_STEP(s->tally, HSR_NEWELL_SEGMENTS, HSR_FACE(f), HSR_THE_WINDOW,
               HSR_ON(x0, x1, j), 0);
      HSR_TOUCH_SPAN(s->tally, x0, x1, j);
      if (is_thick(s, f))
        overwrite_thick(s, f, x0, x1, j);
      else
        overwrite(s, f, x0, x1, j);
    }
  }
}

static void show_beads(struct hsr_newell *s) {
  const struct hsr_window *w = s->window;
  for (int j = w->y0; j < w->y1; j++) {
    struct bead gap = {w->x0, w->x0, HSR_BACKGROUND, NONE, {0}};
    if (s->glass)
      memcpy(gap.rgb, s->glass->background.rgb, sizeof gap.rgb);
    for (uint32_t b = s->row[j - w->y0]; b != NONE; b = bead_at(s, b)->next) {
      const struct bead *bead = bead_at(s, b);
      gap.x1 = bead->x0;
      write_samples(s, gap, j);
      write_samples(s, *bead, j);
      gap.x0 = bead->x1;
    }
    gap.x1 = w->x1;
    write_samples(s, gap, j);
  }
}

/* --- The algorithm -------------------------------------------------------- */

enum hsr_status hsr_newell_reserve(struct hsr_newell *s,
                                   const struct hsr_job *job,
                                   const struct hsr_screen *screen,
                                   struct hsr_keeper *keeper,
                                   size_t most_faces) {
  const struct hsr_window *w = &job->view->window;
  *s = (struct hsr_newell){.job = job,
                           .tally = job->tally,
                           .ids = job->answer->ids,
                           .ids_stride = (size_t)job->answer->m};
  s->row = HSR_NEW(job->scratch, uint32_t, (size_t)(w->y1 - w->y0));
  return s->row ? hsr_list_reserve(&s->list, job, screen, keeper, most_faces)
                : HSR_E_NOMEM;
}

void hsr_newell_open(struct hsr_newell *s, const struct hsr_window *window) {
  s->window = window;
  s->beads.n = 0;
  s->free_bead = NONE;
  for (int j = window->y0; j < window->y1; j++)
    s->row[j - window->y0] = NONE;
  if (s->frame_buffer)
    show_beads(s); /* there are none, so this writes the background */
}

void hsr_newell_paint(struct hsr_newell *s, const uint32_t *faces, uint32_t n) {
  hsr_list_sort(&s->list, s->window, faces, n);
  for (const struct hsr_piece *piece; (piece = hsr_list_next(&s->list));)
    paint(s, piece);
}

void hsr_newell_paint_unordered(struct hsr_newell *s, uint32_t f) {
  struct hsr_piece whole = hsr_uncut_face(s->list.screen, f);
  s->ask_all = true;
  paint(s, &whole);
  s->ask_all = false;
}

void hsr_newell_show(struct hsr_newell *s) {
  if (!s->frame_buffer)
    show_beads(s);
}

void hsr_newell_solve(struct hsr_newell *s, const struct hsr_window *window,
                      const uint32_t *faces, uint32_t n) {
  hsr_newell_open(s, window);
  hsr_newell_paint(s, faces, n);
  hsr_newell_show(s);
}

/* A frame buffer tells which face was painted last; a transparent picture does
 * not. */
static enum hsr_status reserve_glass(struct hsr_newell *s,
                                     struct hsr_glass *glass,
                                     const struct hsr_screen *screen) {
  const struct hsr_view *view = s->job->view;
  s->glass = glass;
  if (s->frame_buffer) {
    s->ids_stride = (size_t)view->m;
    s->ids = HSR_NEW(s->job->scratch, uint32_t,
                     s->ids_stride * (size_t)view->window.y1);
    if (!s->ids)
      return HSR_E_NOMEM;
  }
  enum hsr_status status = hsr_glass_begin(glass, s->job);
  return status ? status : hsr_glass_allow_disputes(glass, screen);
}

static enum hsr_status run(const struct hsr_job *job, bool frame_buffer,
                           struct hsr_keeper *keeper,
                           struct hsr_list_index *index,
                           struct hsr_error *err) {
  struct hsr_screen screen;
  struct hsr_newell newell;
  struct hsr_glass glass;
  if (hsr_screen_make(&screen, job->world, job->view, job->scratch,
                      job->tally) ||
      (keeper && hsr_keeper_begin(keeper, job, &screen)) ||
      hsr_newell_reserve(&newell, job, &screen, keeper, screen.n_relevant))
    return hsr_fail_nomem(err);
  newell.frame_buffer = frame_buffer;
  newell.list.index = index;
  if (hsr_answer_colours_of(job->answer) &&
      reserve_glass(&newell, &glass, &screen))
    return hsr_fail_nomem(err);
  hsr_newell_solve(&newell, &job->view->window, screen.relevant,
                   screen.n_relevant);
  if (hsr_answer_colours_of(job->answer))
    hsr_glass_settle(&glass, HSR_NEWELL_THICKNESS, HSR_NEWELL_WRITTEN);
  if (newell.list.out_of_memory)
    return hsr_fail_nomem(err);
  if (keeper)
    hsr_keeper_end(keeper);
  return HSR_OK;
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  long special = job->option[SPECIAL];
  struct hsr_list_index index = {.by_groups = special == BY_GROUPS,
                                 .sort = INDEX_SORT,
                                 .groups = GROUPS,
                                 .again = AGAIN};
  return run(job, false, NULL, special == ALONG_THE_LIST ? NULL : &index, err);
}

static enum hsr_status render_frame_buffer(const struct hsr_job *job,
                                           struct hsr_error *err) {
  return run(job, true, NULL, NULL, err);
}

/* --- From the previous frame's order -------------------------------------- */

static enum hsr_status prepare_previous(const struct hsr_world *world,
                                        const long *option, void **prepared,
                                        struct hsr_error *err) {
  (void)option;
  *prepared = hsr_keeper_new(world, 1);
  return *prepared ? HSR_OK : hsr_fail_nomem(err);
}

static enum hsr_status render_previous(const struct hsr_job *job,
                                       struct hsr_error *err) {
  return run(job, false, job->prepared, NULL, err);
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {
    {&hsr_list_part}, {&hsr_painting_part}, {&hsr_beads_part}, {NULL}};

static const struct hsr_counter counters[] = {
    [INDEX_SORT] = {"index sort",
                    "pieces put into a group or a cell; those passed on the "
                    "way to their places",
                    HSR_SORT, HSR_OF_PIECE, HSR_OF_PIECE, "put|passed"},
    [GROUPS] = {"group tests", "groups of faces compared with P", HSR_COMPARE,
                HSR_OF_PIECE, HSR_OF_VOLUME,
                "end of the groups|apart in Z|apart in X|apart in Y|near",
                .outcome_keys = "|extents|boxes|boxes"},
    [AGAIN] = {"met again", "pieces that P met in another cell before",
               HSR_COMPARE, HSR_OF_PIECE, HSR_OF_PIECE},
    {NULL}};

static const struct hsr_use uses_previous[] = {{&hsr_list_part},
                                               {&hsr_painting_part},
                                               {&hsr_beads_part},
                                               {&hsr_kept_order_part},
                                               {NULL}};

static const struct hsr_use uses_frame_buffer[] = {
    {&hsr_list_part}, {&hsr_painting_part}, {NULL}};

static const struct hsr_line outline[] = {
    {"with groups, or laterally sorted: sort the pieces into groups, or cells",
     HSR_RAISES(INDEX_SORT)},
    {"  find {Q} in the groups that are not apart from P, or in P's cells",
     HSR_RAISES(GROUPS, AGAIN)},
    {"", .part = &hsr_list_part},
    {"", .part = &hsr_painting_part},
    {"", .part = &hsr_beads_part},
    {NULL}};

static const struct hsr_line outline_previous[] = {
    {"", .part = &hsr_kept_order_part},
    {"", .part = &hsr_kept_order_part, .group = HSR_KEPT_LIST_LINES},
    {"", .part = &hsr_list_part},
    {"", .part = &hsr_painting_part},
    {"", .part = &hsr_beads_part},
    {NULL}};

static const struct hsr_line outline_frame_buffer[] = {
    {"", .part = &hsr_list_part},
    {"", .part = &hsr_painting_part},
    {"", .part = &hsr_painting_part, .group = HSR_FRAME_BUFFER_LINES},
    {NULL}};

static const struct hsr_step steps[] = {
    {"Newell special",
     INDEX_SORT,
     HSR_KIND_BUCKET,
     NULL,
     NULL,
     {{GROUPS, HSR_KIND_BOX}, {AGAIN, HSR_KIND_NUMBERS}}},
    {NULL}};

static const struct hsr_sort sorts[] = {
    {.part = &hsr_list_part}, {.part = &hsr_beads_part}, {NULL}};

static const struct hsr_sort sorts_frame_buffer[] = {
    {.part = &hsr_list_part},
    {"samples", "XY", "frame buffer", "once a segment"},
    {NULL}};

static const struct hsr_sort sorts_previous[] = {{.part = &hsr_list_part},
                                                 {.part = &hsr_kept_order_part},
                                                 {.part = &hsr_beads_part},
                                                 {NULL}};

static const struct hsr_counter painting_counters[] = {
    {"segments", "segments generated", HSR_SPAN, HSR_OF_FACE, HSR_OF_WINDOW,
     .key = "list-segment"},
    {"thickness checks",
     "comparisons in depth where faces that are not flat touch", HSR_COMPARE,
     HSR_OF_FACE, HSR_OF_FACE, "farther|nearer"},
    {"spans written", "runs of samples of one face written to the picture",
     HSR_ACCEPT, HSR_OF_FACE, HSR_OF_WINDOW, .key = "span-written"},
    {NULL}};

static double predict_segments(const struct hsr_table1 *t) {
  return 10 * t->F_r * t->H_f;
}

static const struct hsr_step painting_steps[] = {
    {"segment generator, Y sort", HSR_NEWELL_SEGMENTS, HSR_KIND_SEGMENT,
     "10 F_r H_f", predict_segments},
    {"writes", HSR_NEWELL_WRITTEN, HSR_KIND_WRITE},
    {NULL}};

static const struct hsr_line segment_lines[] = {
    {"  generate the segments of P", HSR_RAISES(HSR_NEWELL_SEGMENTS)},
    {"    of thick faces: is P nearer than what is there?",
     HSR_RAISES(HSR_NEWELL_THICKNESS)},
    {NULL}};

static const struct hsr_line frame_buffer_lines[] = {
    {"    paint the segment on the frame buffer",
     HSR_RAISES(HSR_NEWELL_WRITTEN)},
    {NULL}};

const struct hsr_part hsr_painting_part = {HSR_PART_PAINTING,
                                           painting_counters,
                                           painting_steps,
                                           NULL,
                                           {segment_lines, frame_buffer_lines}};

static const struct hsr_counter bead_counters[] = {
    {"X merge", "beads passed to find the place of a segment, or covered by it",
     HSR_COMPARE, HSR_OF_FACE, HSR_OF_WINDOW, "passed|covered",
     .key = "bead-merge"},
    {NULL}};

static double predict_bead_merge(const struct hsr_table1 *t) {
  return t->F_r * t->H_f * t->S_v / 4;
}

static const struct hsr_step bead_steps[] = {{"X merge", HSR_BEAD_MERGE,
                                              HSR_KIND_LIST, "F_r H_f S_v / 4",
                                              predict_bead_merge},
                                             {NULL}};

static const struct hsr_sort bead_sorts[] = {
    {"segments", "Y", "bucket sort", "once a frame"},
    {"beads", "X", "merge", "once a segment"},
    {NULL}};

static const struct hsr_line bead_lines[] = {
    {"    merge it among the beads of its scan line: it overwrites them",
     HSR_RAISES(HSR_BEAD_MERGE)},
    {"show the beads of every scan line", HSR_RAISES(HSR_NEWELL_WRITTEN)},
    {NULL}};

const struct hsr_part hsr_beads_part = {
    HSR_PART_BEADS, bead_counters, bead_steps, bead_sorts, {bead_lines}};

const struct hsr_algorithm HSR_ALGORITHM(newell) = {
    .authors = "M. E. Newell, R. G. Newell, T. L. Sancha",
    .source = "Proc. ACM Annual Conference, 1972, 443-450; Sutherland et al., "
              "Computing Surveys 6(1), 1974, \"List-Priority Algorithms\"",
    .taxonomy = HSR_LIST_PRIORITY_PER_FRAME,
    .restrictions = 0,
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_IDS}, {HSR_TRANSPARENT}},
    .name = "newell",
    .title = "Newell, Newell and Sancha's priority list, with beads",
    .year = 1972,
    .sort_order = "ZYX",
    .coherence = "depth",
    .sorts = sorts,
    .parts = uses,
    .counters = counters,
    .steps = steps,
    .outline = outline,
    .options = options,
    .render = render};

const struct hsr_algorithm HSR_ALGORITHM(newell_frame_buffer) = {
    .authors = "M. E. Newell, R. G. Newell, T. L. Sancha",
    .source = "Proc. ACM Annual Conference, 1972, 443-450; Sutherland et al., "
              "Computing Surveys 6(1), 1974, \"List-Priority Algorithms\"",
    .taxonomy = HSR_LIST_PRIORITY_PER_FRAME,
    .restrictions = 0,
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_IDS}, {HSR_TRANSPARENT}},
    .name = "newell-frame-buffer",
    .title = "Newell, Newell and Sancha's priority list on a frame buffer",
    .year = 1974,
    .sort_order = "Z(XY)",
    .coherence = "depth",
    .sorts = sorts_frame_buffer,
    .parts = uses_frame_buffer,
    .outline = outline_frame_buffer,
    .render = render_frame_buffer};

const struct hsr_algorithm HSR_ALGORITHM(newell_previous) = {
    .authors = "M. E. Newell, R. G. Newell, T. L. Sancha",
    .source = "Proc. ACM Annual Conference, 1972, 443-450; Sutherland et al., "
              "Computing Surveys 6(1), 1974, \"List-Priority Algorithms\"",
    .taxonomy = HSR_LIST_PRIORITY_PER_FRAME,
    .restrictions = 0,
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_IDS}, {HSR_TRANSPARENT}},
    .name = "newell-previous",
    .title = "Newell, Newell and Sancha's, from the previous frame's order",
    .year = 1974,
    .sort_order = "ZYX",
    .coherence = "depth, frame",
    .flags = HSR_FRAME_STATE | HSR_FOLLOWS,
    .sorts = sorts_previous,
    .parts = uses_previous,
    .outline = outline_previous,
    .prepare = prepare_previous,
    .render = render_previous,
    .release = hsr_keeper_free};
