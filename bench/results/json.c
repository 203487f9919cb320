/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/results/json.h"
#include "bench/judge/judge.h"
#include "common/files/json/json.h"

#include <math.h>
#include <stdio.h>

json_t *number_or_null(double x) {
  return isfinite(x) ? json_real(x) : json_null();
}

enum hsr_status json_print(json_t *value, struct hsr_error *err) {
  if (!value)
    return hsr_fail_nomem(err);
  int failed = json_dumpf(value, stdout, JSON_INDENT(1) | JSON_ENSURE_ASCII);
  json_decref(value);
  if (failed)
    return ferror(stdout) ? hsr_fail(err, HSR_E_INPUT,
                                     "standard output: cannot be written")
                          : hsr_fail_nomem(err);
  putchar('\n');
  return HSR_OK;
}

json_t *adapted_json(const struct cell *cell) {
  json_t *names = json_array();
  for (int k = 0; k < cell->n_adaptations; k++)
    hsr_json_append(&names, json_string(cell->adapted[k]));
  return names;
}
