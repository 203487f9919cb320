/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads what hsr bench wrote: lines of JSON, of the schema hsr-bench/1
 * (docs/schemas/bench.schema.json). Several files can be joined end to end into one. */
#ifndef HSR_BENCH_RESULTS_H
#define HSR_BENCH_RESULTS_H

#include "bench/modules/modules.h"
#include "common/base/status.h"

#include <jansson.h>

/* Arrays of records, in the order of the file. Of several records of one view,
 * or of one cell, only the last is kept. */
struct results {
  json_t *headers, *views, *cells;
  json_t *places; /* key of a view or cell -> its place in the array */
};

/* Reads a file and adds its records to *results; a struct of zeros is empty. If
 * the last line is cut short, because the writer was killed, it is left out.
 * Any other line that is no record is HSR_E_INPUT, with its number.
 * HSR_E_NOMEM. *results is to be freed also after a failure. */
enum hsr_status results_read(struct results *results, const char *path,
                             struct hsr_error *err);
void results_free(struct results *results);

/* Adds one record, and takes a new reference to it. HSR_E_INPUT if it is not a
 * record; HSR_E_NOMEM. */
enum hsr_status results_add(struct results *results, json_t *record,
                            struct hsr_error *err);

/* A field of a record; "" or 0 if the record does not have it. */
const char *results_text(const json_t *record, const char *field);
long results_number(const json_t *record, const char *field);

/* The algorithm of a variant, or NULL. */
const struct hsr_listed *results_listed(const char *variant);

/* What a cell counted by the counter of that key of its algorithm; NAN if it has
 * none. */
double results_count(const json_t *cell, const char *key);

/* The key of a view or cell record. Two records with one key are of the same
 * view or cell. A view has "scene 1 512x512"; a walk over views 1 to 8 has
 * "scene 1-8 512x512". A cell adds its algorithm and threads: " algorithm 1".
 */
enum { RESULTS_KEY = 1400, RESULTS_MOST_SCENE = 300, RESULTS_MOST_NAME = 1000 };
void results_key(const json_t *record, char key[RESULTS_KEY]);

/* The parts of keys. results_view_name writes a view, or `walk` views in a row.
 * results_picture_key writes the key of a view, and returns its length. */
enum { RESULTS_VIEW = 48 };
void results_view_name(long view, long walk, char name[RESULTS_VIEW]);
int results_picture_key(const char *scene, long view, long walk, long m, long n,
                        char key[RESULTS_KEY]);

/* The record of that key, borrowed; NULL if there is none. */
const json_t *results_view(const struct results *results, const char *key);
const json_t *results_cell(const struct results *results, const char *key);

#endif
