/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A worker: the process in which a cell is timed. It draws a frame whenever it
 * is told to, so that many renderers can take turns.
 *
 * It is started as
 *   PROGRAM worker NAME SCENE VIEW WxH THREADS [IDS-FILE]
 * VIEW is K, and then a round is one frame; or it is K-L for a walk, and then a
 * round is a frame of each view from K to L, in order. Before it is ready it
 * draws, and writes the ids of the last frame to IDS-FILE: an array if that ends
 * in .npy, else m n numbers of 32 bits. The worker writes lines
 * of JSON on its standard output. When it is ready:
 *   {"import": s, "adapt": s, "prepare": s, "before_kb": n, "inner": k}
 * import, adapt, prepare: the seconds that these phases took; before_kb: the
 * memory that it held before the last two; inner: frames in a sample, which are
 * whole rounds. Then it answers every byte that comes on its standard input,
 * until that ends:
 *   'r'  it draws `inner` frames:          {"seconds": s}, the mean time of a
 *                                          frame, by the clock on the wall
 *   'm'  the most memory it ever held:     {"peak_kb": n}
 *   'w'  it shades and writes the picture: {"shade": s, "write": s}; both are
 *                                          null if there is no picture, "write"
 *                                          if it cannot be written
 * A failure is one line on standard error and the exit status. */
#ifndef HSR_BENCH_SERVE_H
#define HSR_BENCH_SERVE_H

#include "bench/run/stage.h"

#include "common/answers/answer.h"

/* A sample lasts at least this long, so that the clock's own cost and grain do
 * not matter. A warm-up lasts this long, or for a number of rounds. Where a round is
 * short, an untimed one comes before each sample and refills the caches, as others
 * have drawn meanwhile. */
#define SERVE_SAMPLE_SECONDS 4e-3
#define SERVE_WARM_SECONDS 20e-3
#define SERVE_SHORT_SECONDS 100e-3
enum { SERVE_WARM_ROUNDS = 3 };

/* What the command line asked for. Strings are borrowed from argv. */
struct serve_request {
  const char *name, *scene;
  long view, threads;
  int walk; /* views in a round */
  int m, n;
  const char *ids_file; /* or NULL */
};

/* Parses the command line; argv[0] is "worker". HSR_E_USAGE. */
enum hsr_status serve_parse(int argc, char **argv,
                            struct serve_request *request,
                            struct hsr_error *err);

/* A renderer that is ready to draw. All borrowed. */
struct served {
  const struct serve_request *request;
  const struct stage *stage;
  double adapt_seconds, prepare_seconds;
  long before_kb;

  /* Draws a round of whole frames. */
  enum hsr_status (*round)(void *state, struct hsr_error *err);
  void *state;
  const struct hsr_answer *answer; /* after a round, the last frame's; NULL: it
                                      makes none */
};

long memory_kb(void); /* the memory that this process holds now */

/* Warms up, and serves until the end of the input. Fails with whatever round
 * fails with; HSR_E_INPUT if the other end is gone. */
enum hsr_status serve(const struct served *served, struct hsr_error *err);

#endif
