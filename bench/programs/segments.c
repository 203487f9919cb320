/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The file of segments that a program writes: docs/programs.md. */
#include "bench/programs/program.h"
#include "common/lines/drawing.h"
#include "common/lines/edges.h"

#include <stdio.h>
#include <string.h>

/* What the file holds that is not written. */
static const char unwritten[] = "unwritten\n";

enum hsr_status program_unset_segments(struct program *program,
                                       struct hsr_error *err) {
  char path[PROGRAM_PATH];
  program_file(program, "segments", path);
  FILE *file = fopen(path, "we");
  bool good = file && fputs(unwritten, file) >= 0;
  if (file && fclose(file))
    good = false;
  return good ? HSR_OK
              : program_fail(program, "its file segments cannot be written",
                             err);
}

/* One interval a line: edge A B T0 T1 INVISIBILITY, or, of an implied edge,
 * implied F G PART T0 T1 INVISIBILITY. */
static bool parse_line(const char *line, struct hsr_segment *s) {
  int length = 0;
  *s = (struct hsr_segment){.invisibility = 0};
  if (sscanf(line, "edge %u %u %lf %lf %u %n", &s->edge.a, &s->edge.b, &s->t0,
             &s->t1, &s->invisibility, &length) == 5 &&
      !line[length])
    return true;
  s->edge.implied = true;
  return sscanf(line, "implied %u %u %u %lf %lf %u %n", &s->edge.a, &s->edge.b,
                &s->edge.part, &s->t0, &s->t1, &s->invisibility,
                &length) == 6 &&
         !line[length];
}

/* Finds where the interval is. False if there is no such edge. */
static bool find_ends(const struct hsr_edges *edges, struct hsr_segment *s) {
  uint32_t low = 0, high = edges->n;
  while (low < high) {
    uint32_t middle = low + (high - low) / 2;
    int order = hsr_edge_name_compare(&edges->name[middle], &s->edge);
    if (!order) {
      hsr_edge_point(edges, middle, s->t0, s->from);
      hsr_edge_point(edges, middle, s->t1, s->to);
      return true;
    }
    if (order < 0)
      low = middle + 1;
    else
      high = middle;
  }
  return false;
}

static enum hsr_status read_all(struct program *program, FILE *file,
                                const struct hsr_edges *edges,
                                struct hsr_drawing *drawing,
                                struct hsr_error *err) {
  char line[400], text[480];
  struct hsr_segment segment;
  for (long number = 1; fgets(line, sizeof line, file); number++) {
    bool good = parse_line(line, &segment);
    if (good && (!edges || find_ends(edges, &segment))) {
      if (hsr_drawing_add(drawing, &segment))
        return hsr_fail_nomem(err);
      continue;
    }
    line[strcspn(line, "\n")] = '\0';
    snprintf(text, sizeof text, "line %ld of its file segments, '%.60s', %s",
             number, line,
             good ? "is of an edge that the scene does not have"
                  : "is no interval");
    return program_fail(program, text, err);
  }
  return hsr_drawing_sort(drawing) ? hsr_fail_nomem(err) : HSR_OK;
}

enum hsr_status program_read_segments(struct program *program,
                                      const struct hsr_edges *edges,
                                      struct hsr_drawing *drawing,
                                      struct hsr_error *err) {
  char path[PROGRAM_PATH], text[480], first[sizeof unwritten];
  hsr_drawing_clear(drawing);
  program_file(program, "segments", path);
  FILE *file = fopen(path, "re");
  if (!file) {
    snprintf(text, sizeof text, "its file segments cannot be read");
    return program_fail(program, text, err);
  }
  enum hsr_status status =
      fgets(first, sizeof first, file) && !strcmp(first, unwritten)
          ? program_fail(program, "it left its file segments unwritten", err)
          : HSR_OK;
  rewind(file);
  if (!status)
    status = read_all(program, file, edges, drawing, err);
  fclose(file);
  return status;
}
