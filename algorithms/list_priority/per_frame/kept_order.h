/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The order of priority, kept from frame to frame.
 *
 * Source      Sutherland et al. 1974, chapter IV, "Frame and Object Coherence":
 *             save the priority order of faces. Penetrations and cyclic
 *             overlaps are resolved in it already.
 * Kept        the pieces that faces were divided into; and of two pieces P and Q
 *             that overlapped, P the earlier, that P does not obscure Q since
 *             one is on one side of the other's plane.
 * Held        Such a relation of P and Q is a fact of space: it holds as long
 *             as neither face moves and the eye stays on the same side of both
 *             planes. So each face is asked about that once a frame, and no
 *             vertex is compared with a plane again.
 * Order       the list starts in the order of depth, but each piece follows
 *             those of which a relation says so
 * Invariant   The special sort tests the list that it is given as it always
 *             does, but for tests 4 to 6 of pairs whose relation holds. So a
 *             frame is right whatever was kept.
 * Departures  - The survey hopes for less effort, and does not say how the saved
 *             order is used. To confirm neighbours in the list does not suffice.
 *             For A, X, B let X be off to one side. If A comes to obscure B,
 *             neither A and X nor X and B tell it. So all of {Q} is tested.
 *             - Pieces without a relation go back into the order of depth. If
 *             the saved order were kept of these, too, it would depart from that
 *             of depth more and more, and {Q} would grow: on a turn around
 *             harbor in 360 frames the special sort would look at 203 million
 *             pairs. Newell's looks at 25 million, this one at 42.
 *             - The Z sort is the radix sort. The survey thinks of a bubble sort
 *             of the last frame's.
 *             - Of a face that is not relevant in a frame nothing is kept.
 *             - If there come to be more than eight pieces a face, all start
 *             anew.
 * Measured    reports/1974/coherence.txt: the cost as the camera's step grows
 * Cost        a comparison for each face, two for each relation, and those
 *             tests of priority_list.h that are made */
#ifndef HSR_ALGORITHMS_KEPT_ORDER_H
#define HSR_ALGORITHMS_KEPT_ORDER_H

#include "algorithms/list_priority/per_frame/priority_list.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What the prepared object of a module keeps: the orders of one list, or of
 * several. */
struct hsr_keeper;

/* Makes a keeper of n_lists lists, without any order. NULL: no memory. */
struct hsr_keeper *hsr_keeper_new(const struct hsr_world *world,
                                  uint32_t n_lists);
void hsr_keeper_free(void *keeper); /* NULL: none */

/* Begins a frame: asks of each relevant face whether what was kept of it holds.
 * The screen is borrowed for the frame, and scratch memory is that of the job.
 * HSR_E_NOMEM. */
enum hsr_status hsr_keeper_begin(struct hsr_keeper *keeper,
                                 const struct hsr_job *job,
                                 const struct hsr_screen *screen);

/* The next list, of hsr_list_sort, is list number n. Without this call it is
 * list 0. */
void hsr_keeper_choose(struct hsr_keeper *keeper, uint32_t n);

/* Ends a frame whose lists are all done: they are what the next frame begins
 * with. A frame that is not ended is not kept, and the next begins anew. */
void hsr_keeper_end(struct hsr_keeper *keeper);

/* The part of the kept order: counters, the step "Newell special", a sort. Groups
 * of lines of the outline: at the beginning of a frame; before each list. */
extern const struct hsr_part hsr_kept_order_part;
enum {
  HSR_KEPT_FACES = HSR_FIRST_OF(HSR_PART_KEPT_ORDER),
  HSR_KEPT_ARRANGED,
  HSR_KEPT_HELD
};
enum { HSR_KEPT_FRAME_LINES, HSR_KEPT_LIST_LINES };

/* For priority_list.c alone, in a list with a keeper. hsr_kept_take: begins a
 * list of n faces; adds the pieces of the last frame's order, and the other
 * faces as they are. hsr_kept_arrange: rearranges order[], which is sorted by
 * depth. hsr_kept_holds: whether P is known not to obscure Q. hsr_kept_note: P
 * was found not to obscure Q, by a plane. hsr_kept_unseen: half of a divided
 * piece has no sample. hsr_kept_leave: p leaves the list. hsr_kept_close: the
 * list is empty. They set list->out_of_memory if memory runs out. */
void hsr_kept_take(struct hsr_priority_list *list, const uint32_t *faces,
                   uint32_t n);
void hsr_kept_arrange(struct hsr_priority_list *list);
bool hsr_kept_holds(struct hsr_priority_list *list, uint32_t p, uint32_t q);
void hsr_kept_note(struct hsr_priority_list *list, uint32_t p, uint32_t q);
void hsr_kept_unseen(struct hsr_priority_list *list,
                     const struct hsr_piece *part, struct hsr_polygon polygon);
void hsr_kept_leave(struct hsr_priority_list *list, uint32_t p);
void hsr_kept_close(struct hsr_priority_list *list);

#ifdef __cplusplus
}
#endif
#endif
