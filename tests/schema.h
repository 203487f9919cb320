/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A validator for the keywords of JSON Schema, draft 2020-12, that the schemas
 * in docs/ use. A keyword that it does not know stops the test. */
#ifndef HSR_TESTS_SCHEMA_H
#define HSR_TESTS_SCHEMA_H

#include <jansson.h>
#include <stdbool.h>

/* The schema docs/NAME, which the caller frees; stops the test if there is
 * none. */
json_t *schema_open(const char *name);

/* Whether the value is valid. */
bool schema_admits(const json_t *schema, const json_t *value);

/* Whether the record is valid, but not if any field is missing or has another
 * type, or if there is one more field. Takes the caller's reference. */
bool schema_needs_all(const json_t *schema, json_t *record);

#endif
