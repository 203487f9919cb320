/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is found about the cells of a place before the place is recorded. All
 * cells of a place are timed in turn, so they are done at the same time. If the
 * sweep is killed before that, --resume goes on from the journal: what was
 * judged is not judged again, and only the starts under way are timed again.
 *
 * The journal is a file beside the results, FILE.part, for this build of hsr
 * alone. It is removed when the sweep has come to its end. */
#ifndef HSR_BENCH_SWEEP_JOURNAL_H
#define HSR_BENCH_SWEEP_JOURNAL_H

#include "bench/sweep/sweep.h"

/* Opens the journal of a results file. Its notes are kept only if `resume` is
 * set and they were written by the build with the hash `code`. HSR_E_INPUT: it
 * cannot be written; HSR_E_NOMEM. */
enum hsr_status journal_open(struct journal *journal, const char *output,
                             const char *code, bool resume,
                             struct hsr_error *err);

/* Removes the notes: the place is recorded. */
void journal_clear(struct journal *journal);

/* Closes the journal, and removes it if the sweep has come to its `end`, or if
 * it has no notes. */
void journal_close(struct journal *journal, bool end);

/* Note that a cell, by its key, is judged; that one of its starts is timed. The
 * scene's hash is noted, since the scene may be a file that changes. False if
 * the note cannot be written. */
bool journal_judged(struct journal *journal, const char *key,
                    const char *scene_hash, const struct cell *cell);
bool journal_timed(struct journal *journal, const char *key,
                   const char *scene_hash, int start,
                   const struct start *times);

/* One note. */
struct note {
  char key[RESULTS_KEY], scene_hash[17];
  int start; /* -1: the cell is judged */
  union {
    struct cell cell;
    struct start times;
  };
};

/* Reads the next note of an open journal; the first, after journal_rewind.
 * False if there are no more. */
void journal_rewind(struct journal *journal);
bool journal_next(struct journal *journal, struct note *note);

#endif
