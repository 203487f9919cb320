/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr trace: what the parts of this folder share. docs/schemas/trace.schema.json
 * describes what they write.
 *
 * output.c    a file of lines of JSON, plain or compressed, whole or not there
 * header.c    the first line: the scene, the view, the algorithm
 * answer.c    the answer, both as drawn and as repainted from the events
 * tracer.c    the listener: events, keyframes, the last line
 * run.c       the scene, the view and the algorithm that are traced
 * command.c   the options of hsr trace
 *
 * hsr lesson records the same events in its own form (bench/lesson). */
#ifndef HSR_BENCH_TRACE_H
#define HSR_BENCH_TRACE_H

#include "algorithms/setup.h"
#include "bench/library/library.h"
#include "bench/modules/variant.h"
#include "bench/options/view.h"
#include "common/files/whole_file.h"

#include <jansson.h>
#include <zlib.h>

/* --- Output --------------------------------------------------------------- */

struct trace_output {
  const char *path;           /* "-": standard output; borrowed */
  struct hsr_whole_file file; /* unless it is standard output */
  FILE *stream;
  gzFile zipped;          /* NULL: what is written is not compressed */
  enum hsr_status status; /* of the writing so far */
  int why;                /* errno, where that is HSR_E_INPUT */
  uint64_t bytes;         /* written, before they were compressed */
};

/* Opens a file for writing. It is compressed if its name ends in .gz. From now
 * on a broken pipe and a full disk are errors, not signals. HSR_E_NOMEM;
 * HSR_E_INPUT if the file cannot be written. */
enum hsr_status trace_output_open(struct trace_output *output, const char *path,
                                  struct hsr_error *err);

/* Writes one line, and takes the caller's reference to it. NULL is a value that
 * could not be built for lack of memory. After a line has failed, no further
 * one is written; trace_output_close returns the error. */
void trace_output_line(struct trace_output *output, json_t *line);

/* `status` is the outcome of the run. The file is kept if that is HSR_OK or
 * HSR_E_DIFFERENCE and the whole file was written; otherwise it is removed.
 * Returns `status`, or the error of writing. */
enum hsr_status trace_output_close(struct trace_output *output,
                                   enum hsr_status status,
                                   struct hsr_error *err);

/* --- The answer ----------------------------------------------------------- */

/* Two copies of an answer. */
struct trace_answer {
  const struct hsr_view *view; /* borrowed */
  struct hsr_answer drawn;     /* by the algorithm */
  struct hsr_answer painted;   /* by its accepted events, so far */
  bool out_of_memory;          /* the painting failed */
};

/* Makes both empty. To be freed also after a failure. HSR_E_NOMEM. */
enum hsr_status trace_answer_init(struct trace_answer *answer,
                                  const struct hsr_setup *setup,
                                  const struct hsr_view *view,
                                  struct hsr_error *err);
void trace_answer_free(struct trace_answer *answer);

/* Runs the algorithm on this thread, and adds its counts to *tally. */
enum hsr_status trace_answer_draw(struct trace_answer *answer,
                                  const struct hsr_setup *setup,
                                  struct hsr_tally *tally,
                                  struct hsr_error *err);

/* Paints what an event of kind HSR_ACCEPT adds to the answer. */
void trace_answer_paint(struct trace_answer *answer,
                        const struct hsr_event *event);

/* Compares the painted answer with the drawn one. HSR_E_DIFFERENCE if they
 * differ: `text` then says how much. HSR_E_NOMEM. */
enum hsr_status trace_answer_compare(struct trace_answer *answer, char *text,
                                     size_t size);

/* --- The listener --------------------------------------------------------- */

/* Why an event is left out. An accepted event is left out only if it is outside
 * the window. */
enum trace_reason { TRACE_WINDOW, TRACE_COUNTERS, TRACE_EVERY, TRACE_KEPT };

/* Which events are written. */
struct trace_filter {
  bool has_window;
  struct hsr_window window; /* only events whose window meets it or is empty */
  bool has_counters;
  uint64_t counters; /* only events of these counters: a bit for each */
  long every;        /* of those events, every `every`-th */
  long keyframe;     /* written events from one keyframe to the next */
};

struct tracer {
  const struct hsr_algorithm *algorithm; /* all borrowed */
  const struct trace_filter *filter;
  struct trace_output *output;
  struct trace_answer *answer;

  uint64_t count[HSR_MAX_COUNTERS]; /* events so far */
  uint64_t events, written, candidates, keyframes;
  uint64_t left_out[TRACE_KEPT];
  long since;                            /* events since the last keyframe */
  uint64_t keyframe_begin, keyframe_end; /* the last one's place in the output,
                                            bytes */
  bool shows_progress;
  double shown; /* when progress was last shown */
};

/* Hears one event: the `listen` of a struct hsr_trace. */
void tracer_listen(void *tracer, const struct hsr_event *event);

/* Writes a keyframe before event number `next`. */
void tracer_keyframe(struct tracer *tracer, uint64_t next);

/* Compares the events with the counts and with the answer drawn, and writes the
 * last line. HSR_E_DIFFERENCE if they differ; it then says so on standard
 * error. HSR_E_NOMEM. */
enum hsr_status tracer_end(struct tracer *tracer, const struct hsr_tally *tally,
                           struct hsr_error *err);

/* --- The run -------------------------------------------------------------- */

/* The most faces of a scene that hsr trace describes. */
enum { TRACE_MOST_FACES = 100000 };

/* One algorithm on one view. */
struct trace_run {
  const char *command; /* for messages; borrowed, as the next three */
  const struct scene_options *scene_options;
  const struct view_options *view_options;
  const struct hsr_variant *variant;
  uint32_t most_faces; /* a scene of more is refused */

  struct hsr_scene *scene;
  struct hsr_world laid_out, instanced; /* the algorithm gets one of them */
  struct hsr_view view;
  struct hsr_setup setup;
  struct trace_answer answer;
};

/* Opens the scene, and sets up the view, the algorithm and its answer. To be
 * closed also after a failure. */
enum hsr_status trace_run_open(struct trace_run *run, struct hsr_error *err);
void trace_run_close(struct trace_run *run);

/* The same for a scene and a view that are set already, which stay the caller's.
 * To be ended also after a failure. */
enum hsr_status trace_run_begin(struct trace_run *run, struct hsr_error *err);
void trace_run_end(struct trace_run *run);

/* --- The header ----------------------------------------------------------- */

/* What the first line describes. All borrowed. */
struct trace_header {
  const struct trace_run *run;
  const struct trace_filter *filter;
};

/* A new reference, NULL for lack of memory. */
json_t *trace_header_json(const struct trace_header *header);

/* The image of the part of a polygon that lies beyond `near`, as a list of points
 * in samples: a new reference, NULL for lack of memory. in[]: its n vertices as
 * hsr_view_project has them; out[]: room for n + n/2 + 1. If near is 0, the part
 * ends a millionth of the polygon's depth in front of the eye: on the screen,
 * nearer parts are too far outside. */
json_t *trace_polygon_json(const struct hsr_view *view, const double (*in)[3],
                           int n, double (*out)[3]);

/* How many counters the algorithm describes. */
int trace_n_counters(const struct hsr_algorithm *algorithm);

#endif
