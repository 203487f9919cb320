/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the tests of hsr bench, check and trace. They run the hsr-fixtures
 * of the test's own folder, whose algorithms fail on purpose, in a separate
 * folder, and read what it wrote. */
#ifndef HSR_TESTS_SWEEP_SWEEPING_H
#define HSR_TESTS_SWEEP_SWEEPING_H

#include "bench/results/results.h"
#include "tests/tap.h"

#include <sys/types.h>

/* For steps that a test needs but does not test: bails out unless done. */
void must(bool done);

/* Makes a folder and enters it. It is removed when the process ends. */
void enter_folder(void);

/* Runs "hsr-fixtures bench WORDS", where a shell splits the words. Its output
 * goes to the files out and err. Returns the exit status, or 128 + the signal
 * that ended it. */
int bench(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* The same for "hsr-fixtures check WORDS". */
int check(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* The same for "hsr-fixtures trace WORDS". */
int trace(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* The same for "hsr-fixtures bench WORDS", but does not wait. Returns the
 * process, which leads its own group. */
pid_t bench_begin(const char *format, ...)
    __attribute__((format(printf, 1, 2)));
pid_t trace_begin(const char *format, ...)
    __attribute__((format(printf, 1, 2)));
int bench_end(pid_t id);

/* Waits a few seconds; whether no process of the group is then left. */
bool is_group_gone(pid_t id);

/* Whether the file err holds one line that begins with "hsr: " and contains the
 * text. If not, its contents are printed. */
bool says(const char *text);
bool is_silent(void);

/* A whole file as a string, which the caller frees; the number of lines of a
 * file, 0 if there is none; whether the file `out` contains the text. */
char *read_text(const char *path);
long count_lines(const char *path);
bool printed(const char *text);

/* The results in a file, which must be good. */
struct results read_results(const char *path);

/* About a cell on the house, of 64x48 samples: its verdict "ok", "wrong" ...,
 * or "" if there is no such cell; whether it has times; their median in
 * seconds. */
const char *verdict(const struct results *results, const char *algorithm);
bool has_times(const struct results *results, const char *algorithm);
double median(const struct results *results, const char *algorithm);

#endif
