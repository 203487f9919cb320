/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the tests of hsr bench, check and trace share: running hsr-fixtures of
 * the test's own folder, whose algorithms fail on purpose, in a folder of their
 * own, and reading what it wrote. */
#ifndef HSR_TESTS_SWEEP_SWEEPING_H
#define HSR_TESTS_SWEEP_SWEEPING_H

#include "bench/results/results.h"
#include "tests/tap.h"

#include <sys/types.h>

/* For what a test needs and does not test: bails out unless done. */
void must(bool done);

/* Makes a folder that is removed when the process ends, and goes there. */
void enter_folder(void);

/* Runs "hsr-fixtures bench WORDS", the words as a shell takes them, its output
 * in the files out and err; returns the exit status, or 128 + the signal that
 * ended it. */
int bench(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* The same of "hsr-fixtures check WORDS". */
int check(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* The same of "hsr-fixtures trace WORDS". */
int trace(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* The same, but does not wait: a process that leads a group of its own. */
pid_t bench_begin(const char *format, ...)
    __attribute__((format(printf, 1, 2)));
pid_t trace_begin(const char *format, ...)
    __attribute__((format(printf, 1, 2)));
int bench_end(pid_t id);

/* Whether no process of the group is left, within a few seconds. */
bool is_group_gone(pid_t id);

/* Whether the file err holds one line that begins with "hsr: " and contains
 * the text; what it holds otherwise is shown. */
bool says(const char *text);
bool is_silent(void);

/* A whole file as a string, malloc'ed; lines of a file, 0 if there is none;
 * whether the file `out` contains the text. */
char *read_text(const char *path);
long count_lines(const char *path);
bool printed(const char *text);

/* The results in a file, which must be good. */
struct results read_results(const char *path);

/* Of a cell on the house, of 64x48 samples: "ok", "wrong" ..., "" if it is not
 * there; whether it has times, and their median in seconds. */
const char *verdict(const struct results *results, const char *algorithm);
bool has_times(const struct results *results, const char *algorithm);
double median(const struct results *results, const char *algorithm);

#endif
