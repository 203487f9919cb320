/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reading the values of a JSON file by tables. For each object there is a table
 * of its members, which says how each member is read and where its value is
 * put. */
#ifndef HSR_COMMON_FILES_JSON_MEMBERS_H
#define HSR_COMMON_FILES_JSON_MEMBERS_H

#include "common/base/status.h"
#include "common/files/json/json_read.h"

#include <jansson.h>

#include <stdbool.h>
#include <stddef.h>

/* A file that is read. All pointers are borrowed. */
struct hsr_json_input {
  const char *path;
  void *reader;            /* the caller's data, for its own hsr_json_takes */
  struct hsr_error *err;   /* where errors go; may be NULL */
  const char *begin, *end; /* the text stands between these two, where they come
                              first; NULL: it is the whole file */
};

/* A value and its place in the file: it is member `key` or element `index` of
 * the value `up`. All pointers are borrowed. */
struct hsr_json_node {
  const struct hsr_json_input *input;
  json_t *value;                  /* NULL: the file has no such value */
  const struct hsr_json_node *up; /* NULL: it is the outermost value */
  const char *key;                /* NULL: it is element `index` */
  size_t index;
};

/* Return a member of an object, or an element of an array. The result borrows
 * *of, which must outlive it. */
struct hsr_json_node hsr_json_member(const struct hsr_json_node *of,
                                     const char *key);
struct hsr_json_node hsr_json_element(const struct hsr_json_node *of,
                                      size_t index);

/* ---- Messages. They fill input->err and return the status ---- */

/* HSR_E_INPUT: "FILE: POINTER: text". POINTER is the JSON pointer of the value,
 * and the text is a printf format. */
enum hsr_status hsr_json_refuse(const struct hsr_json_node *at,
                                const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* The same with the text "must be EXPECTED, not " and the value's kind. */
enum hsr_status hsr_json_wrong_kind(const struct hsr_json_node *at,
                                    const char *expected);

/* HSR_E_NOMEM: out of memory. */
enum hsr_status hsr_json_nomem(const struct hsr_json_node *at);

/* ---- Values ---- */

/* Reads a value into *to, whose type depends on the function. HSR_E_INPUT, with
 * a message, if the value is of another kind or out of range. */
typedef enum hsr_status hsr_json_take(const struct hsr_json_node *at, void *to);

hsr_json_take hsr_json_bool;   /* to: bool */
hsr_json_take hsr_json_string; /* const char *, which the value owns */
hsr_json_take hsr_json_number; /* double */
hsr_json_take hsr_json_share;  /* double, from 0 to 1 */
hsr_json_take hsr_json_point;  /* double[3] */
hsr_json_take hsr_json_matrix; /* double[12] */
hsr_json_take hsr_json_array;  /* checks the kind only; `to` is not used */

/* Reads an array of exactly n numbers into to[0 .. n-1], each by `take`. */
enum hsr_status hsr_json_numbers(const struct hsr_json_node *at, size_t n,
                                 hsr_json_take *take, double *to);

/* Reads a whole number from `least` to `most`. */
enum hsr_status hsr_json_whole(const struct hsr_json_node *at, int least,
                               int most, int *to);

/* ---- Members and elements ---- */

/* How one member of an object is read. */
struct hsr_json_rule {
  const char *key;     /* NULL ends a table */
  hsr_json_take *take; /* NULL: it is allowed, and read elsewhere */
  void *to;            /* the argument of `take` */
  bool required;
  const char *beside[2]; /* members that it must not be used with; NULL: none */
};

/* Reads an object by a table, in the order of the table. If a member is absent,
 * its `to` is not written. HSR_E_INPUT for an unknown member, for a member that
 * must not be used with another, for a missing member that is required, in this
 * order; or the error of `take`. */
enum hsr_status hsr_json_object(const struct hsr_json_node *at,
                                const struct hsr_json_rule *rules);

/* Reads each element of an array by take(element, to), with the same `to`. */
enum hsr_status hsr_json_elements(const struct hsr_json_node *at,
                                  hsr_json_take *take, void *to);

/* ---- Files ---- */

/* Loads and parses a file, as hsr_json_load and hsr_json_read_part do. The
 * caller frees *text and releases *root, also after a failure. HSR_E_INPUT,
 * HSR_E_NOMEM.
 */
enum hsr_status hsr_json_open(const struct hsr_json_input *input,
                              const hsr_json_levels *levels,
                              struct hsr_json_part *list, char **text,
                              json_t **root);

/* Checks that the value is an object whose "schema" is `known`. HSR_E_INPUT if
 * not. */
enum hsr_status hsr_json_check_schema(const struct hsr_json_node *root,
                                      const char *known);

/* Parses the next element of a list into *value; NULL after the last one. The
 * old *value is released first. list[] gets the lists of the element, as in
 * hsr_json_read_part. HSR_E_INPUT, HSR_E_NOMEM. */
enum hsr_status hsr_json_next_value(const struct hsr_json_input *input,
                                    struct hsr_json_part *elements,
                                    const hsr_json_levels *levels,
                                    struct hsr_json_part *list, json_t **value);

/* Reads an array whose elements are not in the tree but in the list `elements`.
 * Calls take(element, to) for each. During the call, list[] has the lists of
 * that element. */
enum hsr_status hsr_json_list(const struct hsr_json_node *array,
                              struct hsr_json_part elements,
                              const hsr_json_levels *levels,
                              struct hsr_json_part *list, hsr_json_take *take,
                              void *to);

#endif
