/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A line drawing as JSON, for programs:
 *
 *   {"schema": "hsr-drawing/1", "size": [640, 480], "segments": [
 *    {"edge": [3, 7], "t": [0, 0.5], "invisibility": 0},
 *    {"implied": [1, 4, 0], "t": [0, 1], "invisibility": 2}]}
 *
 * Each element is an interval of an edge: of the edge from vertex 3 to vertex
 * 7, or of number 0 of the implied edges of faces 1 and 4. docs/correct-drawing.md
 * says what the numbers mean. An interval may also have a "class": "crease", and
 * an "object": the name of its edge's first face's. */
#ifndef HSR_COMMON_FILES_DRAWING_JSON_H
#define HSR_COMMON_FILES_DRAWING_JSON_H

#include "common/base/status.h"
#include "common/lines/drawing.h"

#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Writes a drawing of m x n pixels, completely or not at all. `facts` may be
 * NULL. HSR_E_INPUT if the file cannot be written; HSR_E_NOMEM. */
enum hsr_status hsr_drawing_json_write(const char *path,
                                       const struct hsr_drawing *drawing,
                                       const struct hsr_drawing_facts *facts,
                                       int m, int n, struct hsr_error *err);

/* The same text without facts, to a stream: it is fit to stand in XML. */
void hsr_drawing_json_print(FILE *out, const struct hsr_drawing *drawing, int m,
                            int n);

/* What it stands between in an .svg file. */
#define HSR_DRAWING_IN_SVG "<metadata id=\"hsr-drawing\">"
#define HSR_DRAWING_IN_SVG_END "</metadata>"

/* Reads a drawing, also from an .svg file that has it so, and sorts it. Intervals may be in any order, and an edge may
 * run from its greater vertex; intervals that continue one another become one.
 * `from` and `to` of the segments are 0. size[] becomes 0, 0 if the file has
 * none. *drawing is freed by hsr_drawing_free, also after a failure.
 * HSR_E_INPUT with the place in the file; HSR_E_NOMEM. */
enum hsr_status hsr_drawing_json_read(const char *path,
                                      struct hsr_drawing *drawing, int size[2],
                                      struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
