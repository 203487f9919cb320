/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The process that stands between hsr and a program: program.h. */
#ifndef HSR_BENCH_PROGRAMS_KEEPER_H
#define HSR_BENCH_PROGRAMS_KEEPER_H

#include "bench/programs/program.h"

/* How the program ended, in memory that is shared with the keeper. */
struct fate {
  bool ended; /* by itself, before it was killed */
  int status; /* as of waitpid */
  pid_t program;
  char words[200]; /* its last line on standard error, after ": "; "": none */
};

/* What the keeper works with: its ends of three pipes. */
struct keeping {
  const struct program_job *job;
  const char *folder;
  struct fate *fate;
  int control; /* 'e': the program should end by itself, so wait for that. End of
                  input: kill it */
  int in, out; /* of the program */
};

/* To be called in a forked process. Runs the program to its end, and does not
 * return. */
_Noreturn void keep(const struct keeping *keeping);

#endif
