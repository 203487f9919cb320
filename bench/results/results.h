/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What hsr bench wrote, read back: lines of JSON, of the schema hsr-bench/1
 * (docs/bench.schema.json). Several files are one when put one behind the
 * other. */
#ifndef HSR_BENCH_RESULTS_H
#define HSR_BENCH_RESULTS_H

#include "common/base/status.h"

#include <jansson.h>

/* Arrays of records, in the order of the file; of the records of one view, and
 * of one cell, the last. */
struct results {
  json_t *headers, *views, *cells;
  json_t *places; /* key of a view or cell -> its place in the array */
};

/* Reads a file, adding to what is there; a struct of zeros is empty. A last
 * line that is cut short, as by a process killed, is left out; any other line
 * that is no record is HSR_E_INPUT, with its number. HSR_E_NOMEM. To be freed
 * also after a failure. */
enum hsr_status results_read(struct results *results, const char *path,
                             struct hsr_error *err);
void results_free(struct results *results);

/* Adds one record, of which it takes a reference of its own. HSR_E_INPUT: it is
 * none. HSR_E_NOMEM. */
enum hsr_status results_add(struct results *results, json_t *record,
                            struct hsr_error *err);

/* A field of a record: "" or 0 where it has none. */
const char *results_text(const json_t *record, const char *field);
long results_number(const json_t *record, const char *field);

/* The key of a view or cell record: the text by which two records are of the
 * same. "scene 1 512x512", of a walk over views 1 to 8 "scene 1-8 512x512";
 * and, of a cell, " algorithm 1": its threads. */
enum { RESULTS_KEY = 512, RESULTS_MOST_SCENE = 300, RESULTS_MOST_NAME = 100 };
void results_key(const json_t *record, char key[RESULTS_KEY]);

/* What keys are made of: a view, or `walk` views in a row; the scene's picture,
 * of which it returns the length. */
enum { RESULTS_VIEW = 48 };
void results_view_name(long view, long walk, char name[RESULTS_VIEW]);
int results_picture_key(const char *scene, long view, long walk, long m, long n,
                        char key[RESULTS_KEY]);

/* The record of that key, borrowed; NULL if there is none. */
const json_t *results_view(const struct results *results, const char *key);
const json_t *results_cell(const struct results *results, const char *key);

#endif
