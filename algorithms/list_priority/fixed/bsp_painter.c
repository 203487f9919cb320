/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A BSP tree, and a frame buffer, which is painted over from back to front, or
 * filled from front to back, each sample once.
 *
 * Source      H. Fuchs, Z. Kedem and B. Naylor, "On Visible Surface Generation
 *             by A Priori Tree Structures", SIGGRAPH 1980; from front to back:
 *             J. Foley, A. van Dam, S. Feiner and J. Hughes, "Computer
 *             Graphics: Principles and Practice", 2nd edition, 1990, 15.5.2;
 *             both as N. Greene measured them, "Hierarchical Polygon Tiling
 *             with Coverage Masks", SIGGRAPH 1996, 6.
 * Notation    vacant -> HSR_BACKGROUND
 * Invariant   the nearest face so far at a sample is the last one painted
 *             there, or the first one filled in
 * Ties        pieces in one plane: the lowest face is painted last, or first
 * Glass       a transparent face is combined with what it is painted over
 *             (docs/transparent-picture.md)
 * Departures  faces for which the tree has no place are compared in depth
 *             (bsp_frame.h)
 * Cost        samples of all faces: written, or looked at */
#include "algorithms/engines/bsp/bsp_frame.h"
#include "common/answers/kinds/transparent.h"

enum { OVERWRITES };
enum { TAKEN };

/* --- Samples -------------------------------------------------------------- */

/* `row` is row j of the ids; NULL in a transparent picture. */
static void paint(const struct hsr_bsp_frame *frame, uint32_t f, uint32_t *row,
                  int i, int j) {
  uint32_t *id = &row[i];
  struct hsr_tally *tally = frame->job->tally;
  HSR_TOUCH(tally, i, j);
  HSR_STEP(tally, HSR_BSP_SAMPLES, HSR_FACE(f), HSR_THE_WINDOW, HSR_AT(i, j),
           0);
  if (HSR_COUNTING && *id != HSR_BACKGROUND)
    HSR_STEP(tally, OVERWRITES, HSR_FACE(*id), HSR_FACE(f), HSR_AT(i, j), 0);
  *id = f;
}

/* Puts a transparent face, or an opaque one, over what is there. */
static void paint_glass(const struct hsr_bsp_frame *frame, uint32_t f,
                        uint32_t *row, int i, int j) {
  (void)row;
  struct hsr_tally *tally = frame->job->tally;
  uint16_t *rgb = hsr_glass_at(frame->glass, i, j);
  HSR_TOUCH(tally, i, j);
  hsr_glass_over(frame->glass, f, rgb);
  HSR_ACCEPTED(tally, HSR_BSP_SAMPLES, HSR_FACE(f), HSR_THE_WINDOW,
               HSR_AT(i, j), rgb);
}

static void fill(const struct hsr_bsp_frame *frame, uint32_t f, uint32_t *row,
                 int i, int j) {
  uint32_t *id = &row[i];
  struct hsr_tally *tally = frame->job->tally;
  HSR_TOUCH(tally, i, j);
  if (*id != HSR_BACKGROUND) {
    HSR_STEP(tally, TAKEN, HSR_FACE(f), HSR_FACE(*id), HSR_AT(i, j), 0);
    return;
  }
  HSR_STEP(tally, HSR_BSP_SAMPLES, HSR_FACE(f), HSR_THE_WINDOW, HSR_AT(i, j),
           0);
  *id = f;
}

/* --- Pieces --------------------------------------------------------------- */

typedef void write_sample(const struct hsr_bsp_frame *frame, uint32_t f,
                          uint32_t *row, int i, int j);

/* Scan-converts a piece by its spans, row by row. Inlined once for each way to
 * write a sample. */
static inline __attribute__((always_inline)) void
convert(struct hsr_bsp_frame *frame, const struct hsr_bsp_piece *given,
        write_sample *write) {
  struct hsr_piece piece;
  if (!hsr_bsp_frame_piece(frame, given, &piece))
    return;
  const struct hsr_bounds *b = &piece.bounds;
  struct hsr_face_rows rows;
  hsr_face_rows_begin(&rows, &frame->screen, piece.face, frame->job->tally);
  for (int j = b->y0; j < b->y1; j++) {
    uint32_t *row = frame->glass ? NULL : hsr_bsp_frame_row(frame, j);
    int n = hsr_piece_rows_spans(&rows, piece.cuts, piece.n_cuts, j,
                                 frame->columns, frame->job->tally);
    for (int c = 0; c < n; c += 2) {
      int x0 = frame->columns[c] > b->x0 ? frame->columns[c] : b->x0;
      int x1 = frame->columns[c + 1] < b->x1 ? frame->columns[c + 1] : b->x1;
      for (int i = x0; i < x1; i++)
        write(frame, piece.face, row, i, j);
    }
  }
}

static void paint_piece(void *context, const struct hsr_bsp_piece *piece,
                        int facing) {
  (void)facing;
  convert(context, piece, paint);
}

static void paint_glass_piece(void *context, const struct hsr_bsp_piece *piece,
                              int facing) {
  (void)facing;
  convert(context, piece, paint_glass);
}

static void fill_piece(void *context, const struct hsr_bsp_piece *piece,
                       int facing) {
  (void)facing;
  convert(context, piece, fill);
}

static enum hsr_status render_glass(struct hsr_bsp_frame *frame,
                                    struct hsr_error *err) {
  struct hsr_glass glass;
  if (hsr_glass_begin(&glass, frame->job) ||
      hsr_glass_allow_disputes(&glass, &frame->screen))
    return hsr_fail_nomem(err);
  frame->glass = &glass;
  hsr_bsp_frame_walk(frame, true, frame, paint_glass_piece);
  hsr_bsp_frame_finish(frame);
  hsr_glass_settle(&glass, HSR_BSP_THICKNESS, HSR_BSP_SAMPLES);
  return HSR_OK;
}

static enum hsr_status render_painter(const struct hsr_job *job,
                                      struct hsr_error *err) {
  struct hsr_bsp_frame frame;
  if (hsr_bsp_frame_begin(&frame, job))
    return hsr_fail_nomem(err);
  if (hsr_answer_colours_of(job->answer))
    return render_glass(&frame, err);
  hsr_bsp_frame_walk(&frame, true, &frame, paint_piece);
  hsr_bsp_frame_finish(&frame);
  return HSR_OK;
}

static enum hsr_status render_front(const struct hsr_job *job,
                                    struct hsr_error *err) {
  struct hsr_bsp_frame frame;
  if (hsr_bsp_frame_begin(&frame, job))
    return hsr_fail_nomem(err);
  hsr_bsp_frame_walk(&frame, false, &frame, fill_piece);
  hsr_bsp_frame_finish(&frame);
  return HSR_OK;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use painter_uses[] = {{&hsr_bsp_part}, {NULL}};

static const struct hsr_counter painter_counters[] = {
    [OVERWRITES] = {"overwrites", "of these, over another face", HSR_RETIRE,
                    HSR_OF_FACE, HSR_OF_FACE},
    {NULL}};

static const struct hsr_use front_uses[] = {{&hsr_bsp_part}, {NULL}};

static const struct hsr_counter front_counters[] = {
    [TAKEN] = {"samples taken", "samples looked at that were not vacant",
               HSR_REJECT, HSR_OF_FACE, HSR_OF_FACE},
    {NULL}};

static const struct hsr_line painter_outline[] = {
    {"walk the tree from back to front"},
    {"  at a node: go to the side of its plane without the eye"},
    {"  then take the pieces in its plane", HSR_RAISES(HSR_BSP_PIECES)},
    {"    for each sample of a piece"},
    {"      paint it", HSR_RAISES(HSR_BSP_SAMPLES)},
    {"      this hides the face painted there", HSR_RAISES(OVERWRITES)},
    {"  then go to the eye's side"},
    {"for each face without a place in the tree"},
    {"  for each sample: paint it if it is nearer",
     HSR_RAISES(HSR_BSP_THICKNESS)},
    {NULL}};

static const struct hsr_line front_outline[] = {
    {"walk the tree from front to back"},
    {"  at a node: go to the eye's side of its plane"},
    {"  then take the pieces in its plane", HSR_RAISES(HSR_BSP_PIECES)},
    {"    for each sample of a piece"},
    {"      is it taken? a nearer face hides it", HSR_RAISES(TAKEN)},
    {"      it is vacant: fill it", HSR_RAISES(HSR_BSP_SAMPLES)},
    {"  then go to the side without the eye"},
    {"for each face without a place in the tree"},
    {"  for each sample: fill it if it is nearer",
     HSR_RAISES(HSR_BSP_THICKNESS)},
    {NULL}};

static const struct hsr_sort painter_sorts[] = {
    {"faces", "Z", "BSP tree", "once for all frames"},
    {"pieces", "Z", "walk of the tree, from back to front", "once a frame"},
    {"samples", "XY", "frame buffer", "once a piece"},
    {NULL}};

static const struct hsr_sort front_sorts[] = {
    {"faces", "Z", "BSP tree", "once for all frames"},
    {"pieces", "Z", "walk of the tree, from front to back", "once a frame"},
    {"samples", "XY", "frame buffer", "once a piece"},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(bsp_painter) = {
    .taxonomy = HSR_LIST_PRIORITY_FIXED,
    .sort_order = "Z(XY)",
    .coherence = "frame",
    .restrictions = HSR_CF,
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_IDS}, {HSR_TRANSPARENT}},
    .prepare = hsr_bsp_prepare,
    .show = hsr_bsp_show,
    .release = hsr_bsp_release,
    .name = "bsp-painter",
    .title = "A BSP tree, painted from back to front",
    .authors = "H. Fuchs, Z. Kedem, B. Naylor",
    .year = 1980,
    .source = "Fuchs et al., On Visible Surface Generation by A Priori Tree "
              "Structures, SIGGRAPH 1980",
    .sorts = painter_sorts,
    .parts = painter_uses,
    .counters = painter_counters,
    .outline = painter_outline,
    .render = render_painter};

const struct hsr_algorithm HSR_ALGORITHM(bsp_front) = {
    .taxonomy = HSR_LIST_PRIORITY_FIXED,
    .sort_order = "Z(XY)",
    .coherence = "frame",
    .restrictions = HSR_CF,
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_IDS}},
    .prepare = hsr_bsp_prepare,
    .show = hsr_bsp_show,
    .release = hsr_bsp_release,
    .name = "bsp-front",
    .title = "A BSP tree, from front to back where samples are vacant",
    .authors = "J. Foley, A. van Dam, S. Feiner, J. Hughes",
    .year = 1990,
    .source = "Foley et al., Computer Graphics: Principles and Practice, 2nd "
              "edition, 1990, 15.5.2",
    .sorts = front_sorts,
    .parts = front_uses,
    .counters = front_counters,
    .outline = front_outline,
    .render = render_front};
