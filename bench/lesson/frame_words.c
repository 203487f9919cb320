/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The words of a slide: the outline, the step, the counters. */
#include "bench/lesson/frames.h"

#include <ctype.h>
#include <string.h>

/* --- The words ------------------------------------------------------------ */

/* Smaller if it would not fit. */
static void put(struct frames *f, double x, double y, double size, bool bold,
                const char *text) {
  cairo_select_font_face(f->cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD
                              : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(f->cairo, size);
  cairo_text_extents_t extents;
  cairo_text_extents(f->cairo, text, &extents);
  if (extents.x_advance > FRAME_WIDTH - 8 - x)
    cairo_set_font_size(f->cairo,
                        size * (FRAME_WIDTH - 8 - x) / extents.x_advance);
  cairo_move_to(f->cairo, x, y);
  cairo_show_text(f->cairo, text);
}

/* A subject in words: at most `size` bytes. */
static void say(const struct frames *f, const struct hsr_event *event,
                const struct hsr_subject *subject, char *text, size_t size) {
  uint32_t p = subject->id[0], q = subject->id[1];
  *text = '\0';
  if (subject->kind == HSR_OF_NOTHING)
    return;
  if (subject->kind == HSR_OF_FACE || subject->kind == HSR_OF_PIECE) {
    const json_t *face = json_array_get(json_object_get(f->header, "faces"), p);
    const char *name = json_string_value(
        json_array_get(json_object_get(f->header, "objects"),
                       (size_t)json_integer_value(json_array_get(face, 1))));
    if (p == HSR_BACKGROUND)
      snprintf(text, size, "the background");
    else
      snprintf(text, size, "face %u (%.30s)", p, name ? name : "");
  } else if (subject->kind == HSR_OF_EDGE && p != HSR_NO_ID)
    snprintf(text, size, "edge %u-%u", p, q);
  else if (subject->kind == HSR_OF_WINDOW || p == HSR_NO_ID)
    snprintf(text, size, "the %s", hsr_subject_kind_name[subject->kind]);
  else if (subject->kind == HSR_OF_VOLUME && frames_is_of_body(f, event))
    snprintf(text, size, "body %u", p);
  else
    snprintf(text, size, "%s %u", hsr_subject_kind_name[subject->kind], p);
}

void frames_say_outcome(const struct hsr_counter *counter, int outcome,
                        char *text, size_t size) {
  const char *at = counter->outcomes;
  for (int k = 0; at && k < outcome; k++) {
    at = strchr(at, '|');
    at = at ? at + 1 : NULL;
  }
  snprintf(text, size, "%.*s", at ? (int)strcspn(at, "|") : 0, at ? at : "");
}

/* Whether the run comes to line `at` of the outline, or to one within it. */
static bool is_used(const struct frames *f, const struct hsr_line *at) {
  size_t depth = strspn(at->text, " ");
  const struct hsr_line *l = at;
  do {
    for (int r = 0; r < l->n_raises; r++)
      for (int k = 0; k < trace_n_counters(f->run->setup.algorithm); k++)
        if (f->total[k] && hsr_line_of(f->run->setup.algorithm, k) ==
                               (int)(l - f->run->setup.algorithm->outline) + 1)
          return true;
    l++;
  } while (l->text && strspn(l->text, " ") > depth);
  return l == at + 1 && !at->n_raises && strncmp(at->text, "with ", 5) != 0;
}

/* The lines that the run comes to. */
static double put_outline(struct frames *f, int current) {
  double y = 70;
  int number = 0;
  for (const struct hsr_line *l = f->run->setup.algorithm->outline; l->text;
       l++) {
    number++;
    if (!is_used(f, l))
      continue;
    if (number == current) {
      cairo_rectangle(f->cairo, FRAME_LEFT - 6, y - 11,
                      FRAME_WIDTH - FRAME_LEFT, FRAME_LINE);
      frames_set_colour(f->cairo, 0xd0dcef, 1);
      cairo_fill(f->cairo);
    }
    frames_set_colour(f->cairo, 0x1d1f22, 1);
    int indent = (int)strspn(l->text, " ");
    put(f, FRAME_LEFT + 6 * indent, y, 11, number == current, l->text + indent);
    y += FRAME_LINE;
  }
  return y + 8;
}

/* --- The sentence --------------------------------------------------------- */

/* What becomes of the first subject. */
static const char *const verb[HSR_N_STEP_KINDS] = {
    [HSR_SORT] = "put into its place", [HSR_COMPARE] = "compared",
    [HSR_SPLIT] = "divided",           [HSR_SUBDIVIDE] = "divided",
    [HSR_ACTIVATE] = "taken up",       [HSR_RETIRE] = "put aside",
    [HSR_SPAN] = "looked at",          [HSR_SAMPLE] = "looked at",
    [HSR_REJECT] = "rejected",         [HSR_ACCEPT] = "shown"};

static void say_window(const struct frames *f, const struct hsr_window *w,
                       char *text, size_t size) {
  int m = f->run->view.m, n = f->run->view.n;
  int wide = w->x1 - w->x0, high = w->y1 - w->y0;
  if (wide <= 0 || high <= 0 || (wide >= m && high >= n))
    snprintf(text, size, "the whole picture");
  else if (wide == 1 && high == 1)
    snprintf(text, size, "sample %d, %d", w->x0, w->y0);
  else if (high == 1 && wide >= m)
    snprintf(text, size, "row %d", w->y0);
  else if (high == 1)
    snprintf(text, size, "row %d, columns %d to %d", w->y0, w->x0, w->x1 - 1);
  else
    snprintf(text, size, "the window of %d x %d at %d, %d", wide, high, w->x0,
             w->y0);
}

/* Adds to the text, as far as there is room. */
static void append_words(char *text, size_t size, const char *before,
                         const char *words, const char *after) {
  size_t n = strlen(text);
  snprintf(text + n, size - n, "%s%s%s", before, words, after);
}

static bool is_of_lines(const struct frames *f) {
  return f->run->answer.painted.form.type->lines;
}

/* Before a window. */
static const char *place_word(const struct hsr_window *w) {
  if (w->y1 - w->y0 != 1)
    return " in ";
  return w->x1 - w->x0 == 1 ? " at " : " on ";
}

/* Between the two subjects. */
static const char *between(const struct frames *f,
                           const struct hsr_event *event,
                           enum hsr_step_kind kind) {
  const struct hsr_counter *counter =
      &f->run->setup.algorithm->counters[event->counter];
  if (kind == HSR_COMPARE)
    return " against ";
  if (kind == HSR_SPLIT && event->b.kind == HSR_OF_FACE)
    return " is divided by the plane of ";
  if (event->b.kind == HSR_OF_WINDOW)
    return place_word(&event->window);
  if (hsr_outcome_has_key(counter, event->outcome, "behind"))
    return ", behind "; /* the face that is before it comes next */
  return kind == HSR_ACCEPT ? ", not " : ", with ";
}

void frames_say(const struct frames *f, const struct hsr_event *event,
                char *text, size_t size) {
  const struct hsr_counter *counter =
      &f->run->setup.algorithm->counters[event->counter];
  const struct hsr_window *w = &event->window;
  enum hsr_step_kind kind = counter->kind;
  char a[96], b[96], outcome[96], where[96];
  say(f, event, &event->a, a, sizeof a);
  say(f, event, &event->b, b, sizeof b);
  frames_say_outcome(counter, event->outcome, outcome, sizeof outcome);
  say_window(f, w, where, sizeof where);
  bool of_window =
      event->a.kind == HSR_OF_WINDOW || event->b.kind == HSR_OF_WINDOW;
  bool is_shown = kind == HSR_ACCEPT && event->b.kind == HSR_OF_WINDOW;
  if (event->a.kind == HSR_OF_WINDOW)
    snprintf(a, sizeof a, "%s", where);
  if (event->b.kind == HSR_OF_WINDOW)
    snprintf(b, sizeof b, "%s", where);
  *text = '\0';
  append_words(text, size, "", *a ? a : *b ? b : where, "");
  const char *done =
      kind == HSR_ACCEPT && is_of_lines(f) ? "drawn" : verb[kind];
  bool is_divided = kind == HSR_SPLIT && event->b.kind == HSR_OF_FACE && *b;
  if (!*outcome && kind != HSR_COMPARE && !is_divided)
    append_words(text, size, " is ", done, "");
  if (*a && *b && !is_shown)
    append_words(text, size, between(f, event, kind), b, "");
  if (*outcome)
    append_words(text, size, ": ", outcome, "");
  if (f->search.is_shown && f->search.keeps && f->search.is_other)
    append_words(text, size, ", but of ", b, "");
  if (f->search.is_shown && f->search.keeps)
    append_words(text, size, f->search.is_other ? " the " : ": the ",
                 f->search.is_left ? "left" : "right", " half is kept");
  else if (f->search.is_shown)
    append_words(text, size, ": ", "the columns are divided", "");
  if (frames_is_part(f, w) && (!of_window || is_shown) && *a)
    append_words(text, size, " (", where, ")");
  *text = (char)toupper((unsigned char)*text);
}

/* Beneath the picture: the step, and what its counter counts. */
static void put_step(struct frames *f, const struct hsr_event *event) {
  const struct hsr_counter *counter =
      &f->run->setup.algorithm->counters[event->counter];
  double y = FRAME_MARGIN + FRAME_SIDE + 34;
  char text[500];
  frames_say(f, event, text, sizeof text);
  frames_set_colour(f->cairo, frames_colour[counter->kind], 1);
  put(f, FRAME_MARGIN, y, 17, true, text);
  snprintf(text, sizeof text, "%s, %s: %s", hsr_step_kind_name[counter->kind],
           counter->name, counter->meaning);
  frames_set_colour(f->cairo, 0x5d6269, 1);
  put(f, FRAME_MARGIN, y + 20, 11, false, text);
}

static void put_counters(struct frames *f, int raised, double y) {
  const struct hsr_algorithm *a = f->run->setup.algorithm;
  for (int k = 0; k < trace_n_counters(a) && y < FRAME_MARGIN + FRAME_SIDE;
       k++) {
    if (a->counters[k].computed)
      continue;
    char text[24];
    snprintf(text, sizeof text, "%llu", (unsigned long long)f->count[k]);
    frames_set_colour(
        f->cairo, k == raised ? frames_colour[a->counters[k].kind] : 0x1d1f22,
        1);
    put(f, FRAME_LEFT, y, 11, k == raised, a->counters[k].name);
    put(f, FRAME_LEFT + 200, y, 11, k == raised, text);
    y += FRAME_LINE;
  }
}

void frames_draw_words(struct frames *f, const struct hsr_event *event) {
  const struct hsr_algorithm *a = f->run->setup.algorithm;
  char text[80];
  frames_set_colour(f->cairo, 0x1d1f22, 1);
  put(f, FRAME_LEFT, 34, 16, true, a->title);
  snprintf(text, sizeof text, "step %llu of %llu",
           (unsigned long long)event->number + 1, (unsigned long long)f->steps);
  frames_set_colour(f->cairo, 0x5d6269, 1);
  put(f, FRAME_LEFT, 50, 10, false, text);
  double y = put_outline(f, hsr_line_of(a, event->counter));
  put_step(f, event);
  put_counters(f, event->counter, y);
}
