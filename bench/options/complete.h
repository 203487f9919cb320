/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a shell may offer for an unfinished command line. The words come from
 * where the help has them: the options of argp, whose values are written
 * WORD|WORD|... there, the lists of algorithms, scenes and palettes.
 *
 * Each line of standard output is a word in the place of the unfinished one.
 * ":files" says that files are offered too, ":files .json" that those are. */
#ifndef HSR_BENCH_OPTIONS_COMPLETE_H
#define HSR_BENCH_OPTIONS_COMPLETE_H

#include <argp.h>

/* Offers what may be the last of the words, words[0] being the command. */
void complete_words(const struct argp *argp, int n, char *const *words);

/* Offers `word`, if it goes on as `begun` does. */
void complete_offer(const char *begun, const char *word);

#endif
