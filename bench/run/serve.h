/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The timed end of a cell: a process that draws a frame whenever it is told to,
 * so that many renderers can take turns.
 *
 * It is started as
 *   PROGRAM worker NAME SCENE VIEW WxH THREADS [IDS-FILE]
 * where VIEW is K, or K-L for a walk, of which a round is a frame of each view
 * from K to L, in their order; else it is one frame. It speaks lines of JSON on
 * its standard output. When it is ready:
 *   {"import": s, "adapt": s, "prepare": s, "before_kb": n, "inner": k}
 * import, adapt, prepare: seconds of these phases; before_kb: the memory that
 * it held before the last two; inner: frames a sample, whole rounds. Then it
 * answers every byte that comes on its standard input, until that ends:
 *   'r'  it draws `inner` frames:          {"seconds": s}, the mean of one by
 *                                          the clock on the wall
 *   'm'  the most memory it ever held:     {"peak_kb": n}
 *   'w'  it shades and writes the picture: {"shade": s, "write": s}, both null
 *                                          where there is none, the second one
 *                                          where it cannot be written
 * A failure is one line on the standard error and the exit status. */
#ifndef HSR_BENCH_SERVE_H
#define HSR_BENCH_SERVE_H

#include "bench/run/stage.h"

#include "common/answers/answer.h"

/* What the command line asked for. Strings are borrowed from argv. */
struct serve_request {
  const char *name, *scene;
  long view, threads;
  int walk; /* views of a round */
  int m, n;
  const char *ids_file; /* or NULL */
};

/* argv[0] is "worker". HSR_E_USAGE. */
enum hsr_status serve_parse(int argc, char **argv,
                            struct serve_request *request,
                            struct hsr_error *err);

/* A renderer made ready. All borrowed. */
struct served {
  const struct serve_request *request;
  const struct stage *stage;
  double adapt_seconds, prepare_seconds;
  long before_kb;

  /* A round of whole frames. */
  enum hsr_status (*round)(void *state, struct hsr_error *err);
  void *state;
  const struct hsr_answer *answer; /* the last one, once a round is drawn; NULL:
                                      it makes none */
};

long memory_kb(void); /* that this process holds now */

/* Warms up, and serves until the end of the input. Whatever frame fails with;
 * HSR_E_INPUT if the other end is gone. */
enum hsr_status serve(const struct served *served, struct hsr_error *err);

#endif
