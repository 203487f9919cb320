/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/trace/trace.h"
#include "common/answers/coded.h"
#include "common/base/clock.h"
#include "common/files/json/json.h"

#include <unistd.h>

/* --- Which events --------------------------------------------------------- */

static bool is_empty(const struct hsr_window *w) {
  return w->x0 >= w->x1 || w->y0 >= w->y1;
}

static bool do_meet(const struct hsr_window *a, const struct hsr_window *b) {
  return a->x0 < b->x1 && b->x0 < a->x1 && a->y0 < b->y1 && b->y0 < a->y1;
}

/* Whether the event adds a part to the answer. */
static bool adds_part(const struct tracer *tracer,
                      const struct hsr_event *event) {
  return event->part &&
         tracer->algorithm->counters[event->counter].kind == HSR_ACCEPT;
}

/* Why an event is left out. An accepted event of a line drawing is always kept:
 * a line may reach into the window from anywhere. */
static enum trace_reason choose(struct tracer *tracer,
                                const struct hsr_event *event) {
  const struct trace_filter *filter = tracer->filter;
  if (adds_part(tracer, event))
    return TRACE_KEPT;
  if (filter->has_window && !is_empty(&event->window) &&
      !do_meet(&filter->window, &event->window))
    return TRACE_WINDOW;
  if (tracer->algorithm->counters[event->counter].kind == HSR_ACCEPT)
    return TRACE_KEPT;
  if (filter->has_counters && !(filter->counters >> event->counter & 1))
    return TRACE_COUNTERS;
  return tracer->candidates++ % (uint64_t)filter->every ? TRACE_EVERY
                                                        : TRACE_KEPT;
}

/* --- Events --------------------------------------------------------------- */

static json_t *window_json(const struct hsr_window *w) {
  if (is_empty(w))
    return json_null();
  json_t *window = json_array();
  hsr_json_append(&window, json_integer(w->x0));
  hsr_json_append(&window, json_integer(w->y0));
  hsr_json_append(&window, json_integer(w->x1));
  hsr_json_append(&window, json_integer(w->y1));
  return window;
}

static const struct hsr_answer_type *kind_of(const struct tracer *tracer) {
  return tracer->answer->drawn.form.type;
}

static json_t *answer_json(const struct tracer *tracer,
                           const struct hsr_answer *answer) {
  return kind_of(tracer)->json(answer, tracer->answer->view);
}

/* The event as an array, without the nulls at its end. */
static json_t *event_json(const struct tracer *tracer,
                          const struct hsr_event *event) {
  const struct hsr_counter *counter =
      &tracer->algorithm->counters[event->counter];
  json_t *line = json_array();
  hsr_json_append(&line, json_integer((json_int_t)event->number));
  hsr_json_append(&line, json_integer(event->counter));
  hsr_json_append(&line, hsr_subject_json(event->a));
  hsr_json_append(&line, hsr_subject_json(event->b));
  hsr_json_append(&line, window_json(&event->window));
  hsr_json_append(&line, counter->outcomes ? json_integer(event->outcome)
                                           : json_null());
  hsr_json_append(
      &line, adds_part(tracer, event)
                 ? kind_of(tracer)->part_json(event->part, tracer->answer->view)
                 : json_null());
  for (size_t n = json_array_size(line);
       n && json_is_null(json_array_get(line, n - 1)); n--)
    json_array_remove(line, n - 1);
  return line;
}

static void show_progress(struct tracer *tracer) {
  double now = hsr_seconds_now();
  if (tracer->shown <= 0)
    tracer->shown = now;
  if (now - tracer->shown < 0.5)
    return;
  tracer->shown = now;
  fprintf(stderr, "\r\033[K%llu events, %.1f MB",
          (unsigned long long)tracer->events,
          1e-6 * (double)tracer->output->bytes);
  fflush(stderr);
}

/* A keyframe is not due before the events since the last one take as much room
 * as that one did. So keyframes never take more than half of a file, however
 * much was drawn. */
static bool is_keyframe_due(const struct tracer *tracer) {
  return tracer->since >= tracer->filter->keyframe &&
         tracer->output->bytes - tracer->keyframe_end >=
             tracer->keyframe_end - tracer->keyframe_begin;
}

void tracer_listen(void *context, const struct hsr_event *event) {
  struct tracer *tracer = context;
  if (is_keyframe_due(tracer))
    tracer_keyframe(tracer, event->number);
  tracer->events++;
  if (tracer->shows_progress && tracer->events % 8192 == 0)
    show_progress(tracer);
  if (event->counter >= trace_n_counters(tracer->algorithm))
    return; /* tracer_end will find a difference */
  tracer->count[event->counter]++;
  if (tracer->algorithm->counters[event->counter].kind == HSR_ACCEPT)
    trace_answer_paint(tracer->answer, event);
  enum trace_reason reason = choose(tracer, event);
  if (reason != TRACE_KEPT) {
    tracer->left_out[reason]++;
    return;
  }
  tracer->written++;
  tracer->since++;
  if (!tracer->output->status)
    trace_output_line(tracer->output, event_json(tracer, event));
}

/* --- Keyframes ------------------------------------------------------------ */

/* Counters that are computed have no value before the end. */
static json_t *counts_json(const struct hsr_algorithm *algorithm,
                           const uint64_t *count, bool is_end) {
  json_t *counts = json_array();
  for (int k = 0; k < trace_n_counters(algorithm); k++)
    hsr_json_append(&counts, algorithm->counters[k].computed && !is_end
                                 ? json_null()
                                 : json_integer((json_int_t)count[k]));
  return counts;
}

void tracer_keyframe(struct tracer *tracer, uint64_t next) {
  tracer->since = 0;
  if (tracer->output->status)
    return;
  tracer->keyframes++;
  tracer->keyframe_begin = tracer->output->bytes;
  trace_output_line(
      tracer->output,
      json_pack("{ss sI so so}", "record", "keyframe", "next", (json_int_t)next,
                "counts", counts_json(tracer->algorithm, tracer->count, false),
                kind_of(tracer)->name,
                answer_json(tracer, &tracer->answer->painted)));
  tracer->keyframe_end = tracer->output->bytes;
}

/* --- The end -------------------------------------------------------------- */

/* The comparison of the events with the counts and the answer. */
struct findings {
  bool counted;   /* each counter has as many events as it counted */
  bool rebuilt;   /* the accepted events repainted the answer */
  char text[300]; /* the first difference */
};

static void check_counts(const struct tracer *tracer,
                         const struct hsr_tally *tally,
                         struct findings *found) {
  const struct hsr_algorithm *a = tracer->algorithm;
  uint64_t described = 0;
  found->counted = true;
  for (int k = 0; k < trace_n_counters(a); k++) {
    described += tracer->count[k];
    uint64_t wanted = a->counters[k].computed ? 0 : tally->count[k];
    if (found->counted && tracer->count[k] != wanted)
      snprintf(found->text, sizeof found->text,
               "%s: %llu counted, but %llu events", a->counters[k].name,
               (unsigned long long)wanted,
               (unsigned long long)tracer->count[k]);
    found->counted &= tracer->count[k] == wanted;
  }
  if (found->counted && described != tracer->events)
    snprintf(found->text, sizeof found->text,
             "%llu events of counters that it does not describe",
             (unsigned long long)(tracer->events - described));
  found->counted &= described == tracer->events;
}

static enum hsr_status check_answer(const struct tracer *tracer,
                                    struct findings *found) {
  char text[240];
  enum hsr_status status =
      trace_answer_compare(tracer->answer, text, sizeof text);
  found->rebuilt = !status;
  if (status == HSR_E_DIFFERENCE && found->counted)
    snprintf(found->text, sizeof found->text,
             "its accepted events do not rebuild its answer: %s", text);
  return status == HSR_E_NOMEM ? status : HSR_OK;
}

static json_t *end_json(const struct tracer *tracer,
                        const struct hsr_tally *tally,
                        const struct findings *found) {
  const uint64_t *left_out = tracer->left_out;
  return json_pack(
      "{ss sI sI s{sI sI sI} so sb sb so}", "record", "end", "events",
      (json_int_t)tracer->events, "written", (json_int_t)tracer->written,
      "left_out", "window", (json_int_t)left_out[TRACE_WINDOW], "counters",
      (json_int_t)left_out[TRACE_COUNTERS], "every",
      (json_int_t)left_out[TRACE_EVERY], "counts",
      counts_json(tracer->algorithm, tally->count, true), "counted",
      found->counted, "rebuilt", found->rebuilt, kind_of(tracer)->name,
      answer_json(tracer, &tracer->answer->drawn));
}

enum hsr_status tracer_end(struct tracer *tracer, const struct hsr_tally *tally,
                           struct hsr_error *err) {
  if (tracer->shown > 0)
    fprintf(stderr, "\r\033[K");
  if (tracer->output->status) /* trace_output_close returns it */
    return HSR_OK;
  struct findings found;
  check_counts(tracer, tally, &found);
  if (check_answer(tracer, &found))
    return hsr_fail_nomem(err);
  trace_output_line(tracer->output, end_json(tracer, tally, &found));
  if (found.counted && found.rebuilt)
    return HSR_OK;
  fprintf(stderr, "hsr: %s: %s\n", tracer->algorithm->name, found.text);
  return HSR_E_DIFFERENCE;
}
