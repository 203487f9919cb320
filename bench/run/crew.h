/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Running an algorithm over a view, on one thread or several. */
#ifndef HSR_BENCH_RUN_CREW_H
#define HSR_BENCH_RUN_CREW_H

#include "algorithms/setup.h"

long processors(void); /* available to this process; at least 1 */

/* Makes an answer of the form that the setup chooses, in which nothing is
 * drawn. It is to be freed with hsr_answer_free also after a failure.
 * HSR_E_NOMEM; HSR_E_REFUSED if a picture to be folded would be too large. */
enum hsr_status answer_init(struct hsr_answer *answer,
                            const struct hsr_setup *setup,
                            const struct hsr_view *view, struct hsr_error *err);

/* Threads, each with its own memory, which lasts from frame to frame. At least
 * one and at most 64. NULL for lack of memory. */
struct crew *crew_new(long threads);
void crew_free(struct crew *crew); /* NULL is allowed */

/* From now on the crews of all ranks (bench/ranks/ranks.h) draw every picture
 * together. Each rank has to call crew_render for the same pictures; only in
 * rank 0 the answer is complete then. An answer that is made as a whole, rank 0
 * makes alone. */
void crew_join_ranks(struct crew *crew);

/* Who watches a crew. `tell` gets the share of the picture that is drawn, from
 * 0 to 1, before each part and at the end. One thread of the crew at a time
 * calls it. If it returns false the crew stops, and crew_render returns
 * HSR_E_STOPPED. */
struct crew_watch {
  bool (*tell)(void *whom, double share);
  void *whom;
  int parts; /* a picture that may be drawn in bands is drawn in at least so
                many */
};

/* From now on the pictures of the crew are watched. *watch is copied. */
void crew_watch(struct crew *crew, const struct crew_watch *watch);

/* What a crew has done in this rank so far. */
struct crew_work {
  double seconds;         /* of processors, drawing */
  double bytes, messages; /* sent to rank 0 */
  double parts;           /* drawn, of pictures that ranks share */
};
struct crew_work crew_work(const struct crew *crew);

/* Renders the view's whole window with an algorithm that is prepared, and adds
 * its counts to *tally. The whole crew makes an answer that can be made by
 * windows: each thread takes a band of rows at a time, or a square if the
 * setup's choice says so. One thread makes it alone if the algorithm keeps
 * frame state, if the kind of answer is made as a whole, or if somebody
 * listens. If the answer is folded from pictures, the crew draws these and one
 * thread folds them. */
enum hsr_status crew_render(struct crew *crew, const struct hsr_setup *setup,
                            const struct hsr_view *view,
                            struct hsr_answer *answer, struct hsr_tally *tally,
                            struct hsr_error *err);

/* The same, by a crew that is made for this one frame. *seconds, unless NULL,
 * becomes the time of the rendering alone. */
enum hsr_status render_view(const struct hsr_setup *setup,
                            const struct hsr_view *view, long threads,
                            struct hsr_answer *answer, struct hsr_tally *tally,
                            double *seconds, struct hsr_error *err);

#endif
