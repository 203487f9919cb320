/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A validator of those keywords of JSON Schema, draft 2020-12, that the schemas
 * in docs/ use; one that is not known here stops the test. */
#ifndef HSR_TESTS_SCHEMA_H
#define HSR_TESTS_SCHEMA_H

#include <jansson.h>
#include <stdbool.h>

/* The schema docs/NAME, which the caller frees; stops the test if there is
 * none. */
json_t *schema_open(const char *name);

/* Whether the value is as the schema says. */
bool schema_admits(const json_t *schema, const json_t *value);

/* Whether the record is valid, and none without any one of its fields, with a
 * field of another type, or with one more. Gives up the caller's reference. */
bool schema_needs_all(const json_t *schema, json_t *record);

#endif
