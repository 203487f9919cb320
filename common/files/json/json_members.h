/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reading the values of a JSON file by tables: each object has a table of its
 * members, which says how each is read and where it goes. */
#ifndef HSR_COMMON_FILES_JSON_MEMBERS_H
#define HSR_COMMON_FILES_JSON_MEMBERS_H

#include "common/base/status.h"
#include "common/files/json/json_read.h"

#include <jansson.h>

#include <stdbool.h>
#include <stddef.h>

/* The file. */
struct hsr_json_input {
  const char *path;
  void *reader; /* of whoever reads it */
  struct hsr_error *err;
};

/* A value, and its place: member `key`, or element `index`, of the one above
 * it. The outermost value is a member of nothing. */
struct hsr_json_node {
  const struct hsr_json_input *input;
  json_t *value; /* NULL: there is none */
  const struct hsr_json_node *up;
  const char *key; /* NULL: element `index` */
  size_t index;
};

struct hsr_json_node hsr_json_member(const struct hsr_json_node *of,
                                     const char *key);
struct hsr_json_node hsr_json_element(const struct hsr_json_node *of,
                                      size_t index);

/* ---- Messages: all return HSR_E_INPUT, but for lack of memory ---- */

/* "FILE: POINTER: text". */
enum hsr_status hsr_json_refuse(const struct hsr_json_node *at,
                                const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* "must be EXPECTED, not ...". */
enum hsr_status hsr_json_wrong_kind(const struct hsr_json_node *at,
                                    const char *expected);

enum hsr_status hsr_json_nomem(const struct hsr_json_node *at);

/* ---- Values ---- */

/* Reads a value of some type into *to, or refuses it. */
typedef enum hsr_status hsr_json_take(const struct hsr_json_node *at, void *to);

hsr_json_take hsr_json_bool;   /* bool */
hsr_json_take hsr_json_string; /* const char *, which lives as the value does */
hsr_json_take hsr_json_number; /* double */
hsr_json_take hsr_json_share;  /* double, from 0 to 1 */
hsr_json_take hsr_json_point;  /* double[3] */
hsr_json_take hsr_json_matrix; /* double[12] */
hsr_json_take hsr_json_array;  /* `to` is not used */

/* An array of n numbers, each of which is read by `take`. */
enum hsr_status hsr_json_numbers(const struct hsr_json_node *at, size_t n,
                                 hsr_json_take *take, double *to);

/* A whole number from `least` to `most`. */
enum hsr_status hsr_json_whole(const struct hsr_json_node *at, int least,
                               int most, int *to);

/* ---- Members and elements ---- */

struct hsr_json_rule {
  const char *key;
  hsr_json_take *take; /* NULL: it is read elsewhere */
  void *to;
  bool required;
  const char *beside[2]; /* members beside which it means nothing */
};

/* Reads an object by a table, which ends with a rule without key, in the order
 * of the table. A member that is not there leaves what it would go to. Refuses
 * unknown members first, then those beside others, then missing ones. */
enum hsr_status hsr_json_object(const struct hsr_json_node *at,
                                const struct hsr_json_rule *rules);

/* Reads each element of an array by `take`, which gets the same `to`. */
enum hsr_status hsr_json_elements(const struct hsr_json_node *at,
                                  hsr_json_take *take, void *to);

/* ---- Files ---- */

/* Loads and parses a file; see hsr_json_load and hsr_json_read_part. The caller
 * releases *text and *root, also after a failure. */
enum hsr_status hsr_json_open(const struct hsr_json_input *input,
                              const hsr_json_levels *levels,
                              struct hsr_json_part *list, char **text,
                              json_t **root);

/* Refuses all but an object whose "schema" is `known`. */
enum hsr_status hsr_json_check_schema(const struct hsr_json_node *root,
                                      const char *known);

/* The next element of a list that is parsed an element at a time; NULL after
 * the last. *value is released first. */
enum hsr_status hsr_json_next_value(const struct hsr_json_input *input,
                                    struct hsr_json_part *elements,
                                    const hsr_json_levels *levels,
                                    struct hsr_json_part *list, json_t **value);

/* Reads an array of which the tree has no elements; they are in such a list.
 * While `take` reads an element, list[] has the lists of that one. */
enum hsr_status hsr_json_list(const struct hsr_json_node *array,
                              struct hsr_json_part elements,
                              const hsr_json_levels *levels,
                              struct hsr_json_part *list, hsr_json_take *take,
                              void *to);

#endif
