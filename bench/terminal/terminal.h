/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Text for people: what fits a terminal, names that cannot harm it, and how far
 * long work has come. */
#ifndef HSR_BENCH_TERMINAL_H
#define HSR_BENCH_TERMINAL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* How many columns a line of `out` has, at least 40; 0 if `out` is no terminal.
 * Then a line may have any length. The variable COLUMNS goes before what the
 * terminal says. */
int terminal_columns(FILE *out);

/* Standard output will be shown on a terminal of so many columns, though it is
 * none itself. */
void terminal_keep(int columns);

/* Prints words, which spaces divide, and a newline. Lines are broken to fit
 * terminal_columns(); those after the first begin with `indent` spaces. `used`
 * columns of the first line are printed already. The text is printed as
 * terminal_plain writes it. */
void terminal_wrap(FILE *out, int used, int indent, const char *text);

/* A name without the bytes that would move a terminal's cursor or start another
 * line: each control character becomes \xNN, in hexadecimal digits. A name that
 * does not fit in `size` bytes is cut. Returns `plain`. */
char *terminal_plain(const char *name, char *plain, size_t size);
enum { TERMINAL_NAME = 1024 };

/* The same as a word for a shell, in quotes if it needs them. */
char *terminal_word(const char *name, char *word, size_t size);

/* "1 sample", "2 samples": `things` is a plural that ends in s; "1 mismatch" of
 * one that ends in hes. Returns `text`. */
enum { TERMINAL_NUMBER = 60 };
char *terminal_number(uint64_t n, const char *things,
                      char text[TERMINAL_NUMBER]);

/* --- Progress ------------------------------------------------------------- */

/* Work of `all` equal steps. */
struct progress {
  FILE *out;          /* stderr */
  bool told;          /* false: it is no terminal, and nobody asks for lines */
  bool rewrites;      /* it is a terminal: one line, which is written again */
  double begin, last; /* seconds: when the work began, and was told of */
};

/* Where `out` is no terminal, work is told of only if the variable HSR_PROGRESS
 * is set: by a line every 8 seconds. */
struct progress progress_begin(FILE *out);

/* Says that `done` of `all` `things` are done, what is done or waited for now, and
 * about how long the rest takes: "house: 3 of 12 pictures, about 5 s left". If `all` is 0,
 * nobody knows how many there will be. */
void progress_tell(struct progress *progress, size_t done, size_t all,
                   const char *things, const char *now);

/* Appends a name to "house (a, b", once: one that is waited for. Of many, the first few
 * are named. The text begins without a bracket, and progress_close ends it. */
enum { PROGRESS_TEXT = 300 };
void progress_add(char text[PROGRESS_TEXT], const char *name);
void progress_close(char text[PROGRESS_TEXT]);

/* Removes the line from a terminal. */
void progress_end(struct progress *progress);

#endif
