/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the files that make a report's pictures share: pictures.c chooses the
 * scenes and views, drawings.c draws one of them, probe.c writes its pixels. */
#ifndef HSR_BENCH_REPORT_PICTURES_H
#define HSR_BENCH_REPORT_PICTURES_H

#include "algorithms/algorithm.h"
#include "bench/report/report.h"
#include "bench/run/stage.h"

/* A scene and view of the results. All borrowed. */
struct subject {
  const json_t *view; /* its record, of any size */
  json_t *cells;      /* algorithm -> its cell that has a picture */
  json_t *twins;      /* the names of other scenes that are the same */
  double faces;       /* in the scene; INFINITY if that is not known */
  int number;         /* from 0; names its files */
};

/* Whether a page can show what the algorithm makes. */
bool is_shown(const struct hsr_algorithm *algorithm);

/* What all algorithms drew of one scene and view. */
struct pixels {
  const struct stage *stage;
  const uint32_t *ids; /* the oracle's */
  const float *depth;  /* of these */
  json_t *differences; /* by algorithm: [sample, id, depth], ... */
};

/* Draws the scene and view, by the oracle and by each algorithm that has a
 * cell, at most `seconds` in all. Writes the pictures into the report's folder.
 * Writes to `out` an empty line after each drawing, and in the end the page's
 * entry, as JSON. To be called in a process of its own. Fails if the scene
 * cannot be opened or its oracle does not draw it in time; with HSR_E_INPUT, if
 * a file cannot be written; with HSR_E_NOMEM. */
enum hsr_status subject_draw(const struct report *report,
                             const struct subject *subject, double seconds,
                             FILE *out, struct hsr_error *err);

/* Writes the pixels, as a call of hsrProbe(key, ...), into folder/name. Fails
 * as report_write. */
enum hsr_status probe_write(const struct report *report,
                            const struct pixels *pixels, const char *key,
                            const char *name, struct hsr_error *err);

#endif
