/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Programs that take turns by the protocol of docs/programs.md: those of users, and
 * the peers. */
#ifndef HSR_BENCH_SWEEP_PROGRAMS_H
#define HSR_BENCH_SWEEP_PROGRAMS_H

#include "bench/programs/program.h"
#include "bench/sweep/sweep.h"

/* Each of these works on taker->program, which is NULL when there is none, or no
 * longer one. What goes wrong becomes the taker's verdict, and ends the program. */

/* Starts it, waits until it is ready, and draws until all is warm. False if there
 * can be no more processes, which is no failure of the taker. */
bool program_turn_begin(const struct plan *plan, struct turn_taker *taker,
                        int start);

/* One sample of a round: the picture is judged by the listener. */
void program_turn_draw(const struct plan *plan, struct turn_taker *taker,
                       const struct turn_listener *listener, int start,
                       int round);

/* Asks for what it counts, in the first start, and ends it. */
void program_turn_finish(const struct plan *plan, struct turn_taker *taker,
                         int start);

/* Starts it only to ask for its counts. */
void program_turn_count(const struct plan *plan, struct turn_taker *taker);

void program_turn_kill(struct turn_taker *taker);

#endif
