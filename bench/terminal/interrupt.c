/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/terminal/interrupt.h"

#include <signal.h>
#include <stddef.h>

static volatile sig_atomic_t interrupted;

/* The second one ends the program at once. */
static void note_interrupt(int number) {
  interrupted = 1;
  signal(number, SIG_DFL);
}

/* A signal that is ignored, as in the background of a shell, stays ignored. */
void interrupt_listen(void) {
  struct sigaction before, note = {.sa_handler = note_interrupt};
  if (!sigaction(SIGINT, NULL, &before) && before.sa_handler == SIG_DFL)
    sigaction(SIGINT, &note, NULL); /* without SA_RESTART: waiting ends */
}

bool interrupt_came(void) {
  return interrupted;
}

enum hsr_status interrupt_fail(struct hsr_error *err) {
  return hsr_fail(err, HSR_E_STOPPED, "interrupted");
}

void interrupt_end(void) {
  signal(SIGINT, SIG_DFL);
  raise(SIGINT);
}
