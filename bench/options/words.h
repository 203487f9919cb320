/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The words of a command line: numbers, sizes, points, names of files. */
#ifndef HSR_BENCH_OPTIONS_WORDS_H
#define HSR_BENCH_OPTIONS_WORDS_H

#include <stdbool.h>
#include <stddef.h>

/* Parse "640x480", or "512", which is 512x512; "x,y,z"; a decimal number; a
 * whole number from `least` to `most`. False if the text is anything else. */
bool parse_size(const char *text, int *m, int *n);
bool parse_size_to(const char *text, int most, int *m, int *n); /* each side */
bool parse_point(const char *text, double point[3]);
bool parse_number(const char *text, double *number);
bool parse_count(const char *text, long least, long most, long *count);

/* "A-B" or "A", of numbers from `least` on, A <= B. */
bool parse_range(const char *text, long least, long *first, long *last);

/* Copies the next of several names, which commas divide, to name[size], cut short
 * if it is longer, and sets *names to what follows it. False: there is no more. */
bool next_name(const char **names, char *name, size_t size);

/* The name of a file of a series: the number in the place of the pattern's only
 * %d, which may have a width, as in f%03d.png; %% stands for one %. False if
 * the pattern has no such place, or several, or the name does not fit. */
enum { MOST_FILE_NAME = 4096 };
bool series_name(const char *pattern, long number, char name[MOST_FILE_NAME]);

#endif
