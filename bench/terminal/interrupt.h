/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Ctrl-C during long work that has something to put in order first. */
#ifndef HSR_BENCH_TERMINAL_INTERRUPT_H
#define HSR_BENCH_TERMINAL_INTERRUPT_H

#include "common/base/status.h"

#include <stdbool.h>

/* From now on Ctrl-C does not end the program at once: the work looks whether
 * it came, and ends in good order. A second one does end it. */
void interrupt_listen(void);
bool interrupt_came(void);

/* HSR_E_STOPPED. */
enum hsr_status interrupt_fail(struct hsr_error *err);

/* Ends the program by the signal, so that a shell sees why. */
void interrupt_end(void);

#endif
