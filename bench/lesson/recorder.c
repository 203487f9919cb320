/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/lesson/lesson.h"
#include "common/files/json/json.h"

#include <stdlib.h>

static int64_t id_of(uint32_t id) {
  return id == HSR_NO_ID ? -1 : (int64_t)id;
}

static void put_subject(const struct hsr_subject *subject, int64_t to[4]) {
  to[0] = subject->kind;
  for (int k = 0; k < 3; k++)
    to[k + 1] = subject->kind == HSR_OF_NOTHING ? 0 : id_of(subject->id[k]);
}

/* The place of a shape in the list, from 1. Shapes that are equal have one. */
static int64_t place_of(struct lesson_recorder *recorder, json_t *shape) {
  char *text = shape ? json_dumps(shape, JSON_COMPACT) : NULL;
  json_t *known = text ? json_object_get(recorder->places, text) : NULL;
  if (text && !known) {
    hsr_json_append(&recorder->shapes, json_incref(shape));
    json_object_set_new(
        recorder->places, text,
        json_integer((json_int_t)json_array_size(recorder->shapes)));
    known = json_object_get(recorder->places, text);
  }
  free(text);
  json_decref(shape);
  if (!known) {
    json_decref(recorder->shapes); /* lesson_describe will fail */
    recorder->shapes = NULL;
  }
  return json_integer_value(known);
}

/* The place of the event's part in the list of parts, or in that of shapes if it adds
 * nothing to the answer, from 1; 0: it has none. */
static int64_t put_part(struct lesson_recorder *recorder,
                        const struct hsr_event *event) {
  if (!event->part)
    return 0;
  const struct trace_answer *answer = &recorder->run->answer;
  const struct hsr_algorithm *a = recorder->run->setup.algorithm;
  json_t *part = answer->drawn.form.type->part_json(event->part, answer->view);
  if (a->counters[event->counter].kind != HSR_ACCEPT)
    return place_of(recorder, part);
  hsr_json_append(&recorder->parts, part);
  return (int64_t)json_array_size(recorder->parts);
}

static void keep(struct lesson_recorder *recorder,
                 const struct hsr_event *event) {
  int64_t value[LESSON_N_FIELDS];
  const struct hsr_window *w = &event->window;
  bool is_empty = w->x0 >= w->x1 || w->y0 >= w->y1;
  put_subject(&event->a, &value[LESSON_A_KIND]);
  put_subject(&event->b, &value[LESSON_B_KIND]);
  value[LESSON_X] = is_empty ? 0 : w->x0;
  value[LESSON_Y] = is_empty ? 0 : w->y0;
  value[LESSON_WIDTH] = is_empty ? 0 : w->x1 - w->x0;
  value[LESSON_HEIGHT] = is_empty ? 0 : w->y1 - w->y0;
  value[LESSON_OUTCOME] = event->outcome;
  value[LESSON_PART] = put_part(recorder, event);

  unsigned char counter = (unsigned char)event->counter;
  struct lesson_column *column = &recorder->column[counter];
  lesson_add(&recorder->counters, &counter, 1);
  for (int k = 0; k < LESSON_N_FIELDS; k++) {
    lesson_add_number(&column->field[k], value[k] - column->last[k]);
    column->last[k] = value[k];
  }
  recorder->kept++;
}

void lesson_listen(void *context, const struct hsr_event *event) {
  struct lesson_recorder *recorder = context;
  const struct hsr_algorithm *a = recorder->run->setup.algorithm;
  recorder->events++;
  if (event->counter >= trace_n_counters(a))
    return; /* the command will find a difference */
  recorder->count[event->counter]++;
  if (a->counters[event->counter].kind == HSR_ACCEPT)
    trace_answer_paint(&recorder->run->answer, event);
  if (recorder->has_list)
    lesson_note_list(&recorder->notes, &a->counters[event->counter], event);
  if (recorder->kept < recorder->most)
    keep(recorder, event);
}

void lesson_recorder_free(struct lesson_recorder *recorder) {
  lesson_bytes_free(&recorder->counters);
  lesson_bytes_free(&recorder->notes);
  for (int c = 0; c < HSR_MAX_COUNTERS; c++)
    for (int k = 0; k < LESSON_N_FIELDS; k++)
      lesson_bytes_free(&recorder->column[c].field[k]);
  json_decref(recorder->parts);
  json_decref(recorder->shapes);
  json_decref(recorder->places);
}
