/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The files of hsr trace obey docs/schemas/trace.schema.json. They can be read from the
 * start and from every keyframe on. They hold what was asked for. A file is
 * complete, or not there.
 */
#include "tests/schema.h"
#include "tests/sweep/sweeping.h"

#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>
#include <zlib.h>

static json_t *schema;

/* --- Reading -------------------------------------------------------------- */

enum { MOST_COUNTERS = 48, MOST_LINE = 1 << 22 };

/* The next line of a file, compressed or not; NULL at its end. */
static json_t *read_line(gzFile file) {
  static char line[MOST_LINE];
  if (!gzgets(file, line, sizeof line))
    return NULL;
  must(strchr(line, '\n') != NULL);
  json_t *value = json_loads(line, JSON_REJECT_DUPLICATES, NULL);
  must(value != NULL);
  return value;
}

static json_int_t number(const json_t *record, const char *field) {
  const json_t *value = json_object_get(record, field);
  must(json_is_integer(value));
  return json_integer_value(value);
}

static const char *kind(const json_t *line) {
  return json_is_array(line)
             ? "event"
             : json_string_value(json_object_get(line, "record"));
}

static bool is(const json_t *line, const char *wanted) {
  return !strcmp(kind(line), wanted);
}

/* The first or, if `last`, the last line of a kind. */
static json_t *find_line(const char *path, const char *wanted, bool last) {
  gzFile file = gzopen(path, "rb");
  must(file != NULL);
  json_t *line, *found = NULL;
  while ((line = read_line(file))) {
    if (is(line, wanted) && (last || !found)) {
      json_decref(found);
      found = json_incref(line);
    }
    json_decref(line);
  }
  gzclose(file);
  must(found != NULL);
  return found;
}

/* A window, [x0, y0, x1, y1]; the whole picture if it is null. */
struct window {
  json_int_t at[4];
};

static struct window window_of(const json_t *window, json_int_t m,
                               json_int_t n) {
  struct window w = {{0, 0, m, n}};
  for (size_t k = 0; k < 4 && json_is_array(window); k++)
    w.at[k] = json_integer_value(json_array_get(window, k));
  return w;
}

/* --- How a run stands ----------------------------------------------------- */

struct state {
  const json_t *counters; /* of the header */
  json_int_t m, n;
  json_int_t next;
  json_int_t count[MOST_COUNTERS];
  json_t *ids;          /* m * n ids or nulls; NULL for other kinds */
  json_t *segments;     /* of a line drawing; NULL for other kinds */
  json_t *solids;       /* of each voxel, x fastest; NULL for other kinds */
  json_int_t voxels[3]; /* how many along each axis */
  json_t *channels;     /* of each pixel; NULL for other kinds */
  const char *kind;     /* of those: their name, and how many of a pixel */
  size_t n_channels;
};

/* Only the end has the numbers of voxels along each axis. */
static void begin_voxels(struct state *s, const json_t *end) {
  const json_t *n = json_object_get(json_object_get(end, "voxels"), "n");
  s->solids = json_array();
  for (size_t k = 0; k < 3; k++)
    s->voxels[k] = json_integer_value(json_array_get(n, k));
  for (json_int_t k = s->voxels[0] * s->voxels[1] * s->voxels[2]; k; k--)
    json_array_append_new(s->solids, json_integer(0));
}

static void begin_channels(struct state *s, const char *kind, size_t n) {
  s->channels = json_array();
  s->kind = kind;
  s->n_channels = n;
}

static struct state state_new(const char *path, const json_t *header) {
  const json_t *view = json_object_get(header, "view"),
               *algorithm = json_object_get(header, "algorithm");
  struct state s = {.counters = json_object_get(header, "counters"),
                    .m = number(view, "width"),
                    .n = number(view, "height")};
  must(json_array_size(s.counters) <= MOST_COUNTERS);
  const char *answer = json_string_value(json_object_get(algorithm, "answer"));
  if (!strcmp(answer, "ids"))
    s.ids = json_array();
  else if (!strcmp(answer, "segments"))
    s.segments = json_array();
  else if (!strcmp(answer, "composited"))
    begin_channels(&s, "composited", 4);
  else if (!strcmp(answer, "transparent"))
    begin_channels(&s, "transparent", 3);
  else {
    json_t *end = find_line(path, "end", true);
    begin_voxels(&s, end);
    json_decref(end);
  }
  return s;
}

static void state_free(struct state *s) {
  json_decref(s->ids);
  json_decref(s->segments);
  json_decref(s->solids);
  json_decref(s->channels);
}

static bool is_accepted(const struct state *s, json_int_t counter) {
  const json_t *c = json_array_get(s->counters, (size_t)counter);
  return !strcmp(json_string_value(json_object_get(c, "kind")), "accept");
}

/* Unfolds runs into all samples of a picture, or all voxels. */
static json_t *unfold(const json_t *runs) {
  json_t *ids = json_array();
  for (size_t k = 0; k + 1 < json_array_size(runs); k += 2)
    for (json_int_t i = json_integer_value(json_array_get(runs, k + 1)); i; i--)
      json_array_append(ids, json_array_get(runs, k));
  return ids;
}

static void add_segment(json_t *segments, json_t *segment) {
  enum { EDGE, INVISIBILITY, T0, T1, FROM, TO, IMAGE_FROM, IMAGE_TO };
  size_t n = json_array_size(segments);
  json_t *last = n ? json_array_get(segments, n - 1) : NULL;
  if (last &&
      json_equal(json_array_get(last, EDGE), json_array_get(segment, EDGE)) &&
      json_equal(json_array_get(last, INVISIBILITY),
                 json_array_get(segment, INVISIBILITY)) &&
      json_equal(json_array_get(last, T1), json_array_get(segment, T0))) {
    json_array_set(last, T1, json_array_get(segment, T1));
    json_array_set(last, TO, json_array_get(segment, TO));
    json_array_set(last, IMAGE_TO, json_array_get(segment, IMAGE_TO));
    return;
  }
  json_array_append_new(segments, json_deep_copy(segment));
}

static void set_solid(struct state *s, json_int_t x, json_int_t y, json_int_t z,
                      json_t *solid) {
  const json_int_t *n = s->voxels;
  if (x < n[0] && y < n[1] && z < n[2])
    json_array_set(s->solids, (size_t)((z * n[1] + y) * n[0] + x), solid);
}

static void add_cubes(struct state *s, const json_t *cubes) {
  enum { SOLID, CORNER, SIZE, LOW, HIGH };
  json_int_t c[3], size = json_integer_value(json_array_get(cubes, SIZE));
  for (size_t k = 0; k < 3; k++)
    c[k] = json_integer_value(json_array_get(json_array_get(cubes, CORNER), k));
  for (int bit = 0; bit < 64; bit++) {
    json_int_t half =
        json_integer_value(json_array_get(cubes, bit < 32 ? LOW : HIGH));
    json_int_t x = c[0] + bit % 4 * size, y = c[1] + bit / 4 % 4 * size,
               z = c[2] + bit / 16 * size;
    for (json_int_t v = 0; half >> bit % 32 & 1 && v < size * size * size; v++)
      set_solid(s, x + v % size, y + v / size % size, z + v / size / size,
                json_array_get(cubes, SOLID));
  }
}

static void apply_event(struct state *s, const json_t *event) {
  enum { NUMBER, COUNTER, A, B, WINDOW, OUTCOME, PART };
  json_int_t counter = json_integer_value(json_array_get(event, COUNTER));
  s->next = json_integer_value(json_array_get(event, NUMBER)) + 1;
  s->count[counter]++;
  if (!is_accepted(s, counter))
    return;
  if (s->segments) {
    add_segment(s->segments, json_array_get(event, PART));
    return;
  }
  if (s->solids) {
    add_cubes(s, json_array_get(event, PART));
    return;
  }
  struct window w = window_of(json_array_get(event, WINDOW), 0, 0);
  for (json_int_t j = w.at[1]; j < w.at[3]; j++)
    for (json_int_t i = w.at[0]; i < w.at[2]; i++) {
      size_t k = (size_t)(j * s->m + i);
      if (s->ids)
        json_array_set(s->ids, k, json_array_get(json_array_get(event, A), 1));
      for (size_t c = 0; c < s->n_channels; c++)
        json_array_set(s->channels, s->n_channels * k + c,
                       json_array_get(json_array_get(event, PART), c));
    }
}

static void take_keyframe(struct state *s, const json_t *keyframe) {
  s->next = number(keyframe, "next");
  size_t k;
  const json_t *count;
  json_array_foreach(json_object_get(keyframe, "counts"), k, count) {
    s->count[k] = json_integer_value(count); /* 0 for null */
  }
  const json_t *runs =
      json_object_get(json_object_get(keyframe, "voxels"), "solids");
  if (s->solids && !json_array_size(runs)) /* before the first cubes */
    return;
  state_free(s);
  if (s->ids)
    s->ids = unfold(json_object_get(keyframe, "ids"));
  else if (s->solids)
    s->solids = unfold(runs);
  else if (s->channels)
    s->channels = json_deep_copy(json_object_get(keyframe, s->kind));
  else
    s->segments = json_deep_copy(json_object_get(keyframe, "segments"));
}

static bool is_computed(const struct state *s, size_t k) {
  return json_is_true(
      json_object_get(json_array_get(s->counters, k), "computed"));
}

/* Whether the counts so far are those of a keyframe, or of the end. Counters
 * that are computed have no events. */
static bool are_counts(const struct state *s, const json_t *record) {
  size_t k;
  const json_t *count;
  bool good = true;
  json_array_foreach(json_object_get(record, "counts"), k, count) {
    good &= is_computed(s, k) ? s->count[k] == 0
                              : s->count[k] == json_integer_value(count);
  }
  return good && k == json_array_size(s->counters);
}

/* The order of a drawing: edges of faces by their vertices, then implied edges,
 * which have the higher code. Parts of one edge stay in order. */
static bool is_before(const json_t *a, const json_t *b) {
  const json_t *e = json_array_get(a, 0), *f = json_array_get(b, 0);
  for (size_t k = 0; k < 4; k++) {
    json_int_t x = json_integer_value(json_array_get(e, k)),
               y = json_integer_value(json_array_get(f, k));
    if (x != y)
      return x < y;
  }
  return false;
}

static json_t *sort(const json_t *segments) {
  json_t *sorted = json_array();
  size_t k, place;
  json_t *segment;
  json_array_foreach(segments, k, segment) {
    for (place = json_array_size(sorted);
         place && is_before(segment, json_array_get(sorted, place - 1));)
      place--;
    json_array_insert(sorted, place, segment);
  }
  return sorted;
}

static bool are_voxels(const struct state *s, const json_t *record) {
  json_t *wanted =
      unfold(json_object_get(json_object_get(record, "voxels"), "solids"));
  bool none = is(record, "keyframe") && !json_array_size(wanted);
  bool good = none || json_equal(s->solids, wanted);
  json_decref(wanted);
  return good;
}

static bool is_answer(const struct state *s, const json_t *record) {
  if (s->solids)
    return are_voxels(s, record);
  if (s->channels)
    return json_equal(s->channels, json_object_get(record, s->kind));
  bool is_end = is(record, "end");
  json_t *got = s->ids   ? json_incref(s->ids)
                : is_end ? sort(s->segments)
                         : json_incref(s->segments);
  json_t *wanted = s->ids ? unfold(json_object_get(record, "ids"))
                          : json_incref(json_object_get(record, "segments"));
  bool good = json_equal(got, wanted) &&
              (s->segments || json_array_size(got) == (size_t)(s->m * s->n));
  json_decref(got);
  json_decref(wanted);
  return good;
}

/* --- A whole trace -------------------------------------------------------- */

/* Whether all lines are valid and in order, and each keyframe and the end agree
 * with the lines before them. */
static bool is_whole(const char *path) {
  gzFile file = gzopen(path, "rb");
  must(file != NULL);
  json_t *header = read_line(file), *line;
  bool good = header && schema_admits(schema, header) && is(header, "header"),
       ended = false;
  struct state s = state_new(path, header);
  json_int_t since = 0, events = 0;
  for (bool first = true; (line = read_line(file)); first = false) {
    good &= schema_admits(schema, line) && !ended;
    if (is(line, "event")) {
      good &= json_integer_value(json_array_get(line, 0)) == s.next;
      apply_event(&s, line);
      since++;
      events++;
    } else {
      if (first)
        take_keyframe(&s, line);
      bool stands = are_counts(&s, line) && is_answer(&s, line);
      bool in_place =
          is(line, "end") || first ||
          (is(line, "keyframe") && since >= number(header, "keyframe") &&
           s.next == number(line, "next"));
      if (!stands || !in_place)
        printf("# %s before event %lld: stands %d, in its place %d\n",
               kind(line), (long long)s.next, stands, in_place);
      good &= stands && in_place;
      since = 0;
      ended = is(line, "end");
    }
    if (ended)
      good &= number(line, "events") == events &&
              number(line, "written") == events &&
              json_is_true(json_object_get(line, "counted")) &&
              json_is_true(json_object_get(line, "rebuilt"));
    json_decref(line);
  }
  state_free(&s);
  json_decref(header);
  gzclose(file);
  return good && ended;
}

/* Whether a reader who starts at the nth keyframe reaches the same end. */
static bool is_whole_from(const char *path, int n) {
  gzFile file = gzopen(path, "rb");
  must(file != NULL);
  json_t *header = read_line(file), *line;
  struct state s = state_new(path, header);
  bool good = false;
  while ((line = read_line(file))) {
    if (is(line, "keyframe") && !n--)
      take_keyframe(&s, line);
    else if (is(line, "event") && n < 0)
      apply_event(&s, line);
    else if (is(line, "end"))
      good = n < 0 && are_counts(&s, line) && is_answer(&s, line);
    json_decref(line);
  }
  state_free(&s);
  json_decref(header);
  gzclose(file);
  return good;
}

/* --- Parts of a trace ----------------------------------------------------- */

/* Whether totals and answer are the same, although events are left out. */
static bool have_same_end(const char *path, const char *other) {
  json_t *a = find_line(path, "end", true), *b = find_line(other, "end", true);
  json_t *left_out = json_object_get(a, "left_out");
  bool good = number(a, "events") ==
              number(a, "written") + number(left_out, "window") +
                  number(left_out, "counters") + number(left_out, "every");
  static const char *const fields[] = {"events", "counts", "counted", "rebuilt",
                                       "ids"};
  for (int k = 0; k < 5; k++)
    good &= json_equal(json_object_get(a, fields[k]),
                       json_object_get(b, fields[k]));
  json_decref(a);
  json_decref(b);
  return good;
}

/* The number of events of a counter, or of all counters if it is -1; *bad
 * becomes the number of those that do not meet the window. */
static json_int_t count_events(const char *path, json_int_t counter,
                               struct window window, json_int_t *bad) {
  gzFile file = gzopen(path, "rb");
  must(file != NULL);
  json_t *line;
  json_int_t n = 0;
  *bad = 0;
  while ((line = read_line(file))) {
    must(schema_admits(schema, line));
    if (is(line, "event") && (counter < 0 || json_integer_value(json_array_get(
                                                 line, 1)) == counter)) {
      struct window w = window_of(json_array_get(line, 4), 9999, 9999);
      n++;
      *bad += w.at[0] >= window.at[2] || window.at[0] >= w.at[2] ||
              w.at[1] >= window.at[3] || window.at[1] >= w.at[3];
    }
    json_decref(line);
  }
  gzclose(file);
  return n;
}

static json_int_t count_of(const char *path, const char *field, size_t k) {
  json_t *end = find_line(path, "end", true);
  json_t *of = json_object_get(end, field);
  json_int_t n =
      json_integer_value(json_is_array(of) ? json_array_get(of, k) : of);
  json_decref(end);
  return n;
}

/* Whether the events repaint the window, beginning with an empty picture. */
static bool is_repainted(const char *path, struct window w) {
  gzFile file = gzopen(path, "rb");
  must(file != NULL);
  json_t *header = read_line(file), *line;
  struct state s = state_new(path, header);
  json_t *wanted = NULL;
  bool first = true;
  while ((line = read_line(file))) {
    if (is(line, "keyframe") && first)
      take_keyframe(&s, line);
    else if (is(line, "event"))
      apply_event(&s, line);
    else if (is(line, "end"))
      wanted = unfold(json_object_get(line, "ids"));
    first = false;
    json_decref(line);
  }
  must(wanted != NULL);
  bool good = true;
  for (json_int_t j = w.at[1]; j < w.at[3]; j++)
    for (json_int_t i = w.at[0]; i < w.at[2]; i++)
      good &= json_equal(json_array_get(wanted, (size_t)(j * s.m + i)),
                         json_array_get(s.ids, (size_t)(j * s.m + i)));
  json_decref(wanted);
  state_free(&s);
  json_decref(header);
  gzclose(file);
  return good;
}

/* --- Tests ---------------------------------------------------------------- */

static void test_lines(struct tap *tap) {
  ok(tap, trace("house -a raycast -s 20x14 -o r.ndjson") == 0 && is_silent(),
     "raycast is traced");
  ok(tap, is_whole("r.ndjson"),
     "valid, in order; events come to counts and keyframes, and to the answer");
  ok(tap, is_whole_from("r.ndjson", 7), "so they do from a keyframe on");
  ok(tap, trace("house -a plotter -s 20x14 --keyframe 100 -o p.ndjson") == 0,
     "a line drawing is traced");
  ok(tap, is_whole("p.ndjson"), "whole, with subjects of every kind");
  ok(tap, is_whole_from("p.ndjson", 5), "from a keyframe on, too");
  ok(tap, count_of("p.ndjson", "counts", 5) == 17 * 231,
     "what is computed is in the totals");
  ok(tap,
     trace("color-cube:2 -a tiling-solids:side=70 --keyframe 60 "
           "-o v.ndjson") == 0,
     "voxels are traced");
  ok(tap, is_whole("v.ndjson"), "whole, with cubes of several sizes");
  ok(tap, is_whole_from("v.ndjson", 2), "from a keyframe on, too");
  ok(tap,
     trace("checker-cube:4 -a splat -s 20x14 --keyframe 100 -o s.ndjson") == 0,
     "splats are traced");
  ok(tap, is_whole("s.ndjson"), "whole, with the channels of all pixels");
  ok(tap, is_whole_from("s.ndjson", 2), "from a keyframe on, too");
  ok(tap,
     trace("greenhouse -a zbuffer-fast:mix=newell -s 20x14 --keyframe 300 "
           "-o g.ndjson") == 0,
     "transparent faces are traced");
  ok(tap, is_whole("g.ndjson"), "whole, with the colours of all samples");
  ok(tap, is_whole_from("g.ndjson", 2), "from a keyframe on, too");
  ok(tap,
     trace("house -a raycast:window=9 -s 20x14 -o w.ndjson") == 0 &&
         is_whole("w.ndjson"),
     "drawn in squares");
  ok(tap,
     trace("near-plane -a raycast -s 9x7 -o n.ndjson --near 2") == 0 &&
         is_whole("n.ndjson"),
     "with faces that reach behind the eye");
}

static void test_schema(struct tap *tap) {
  static const char *const kinds[] = {"header", "keyframe", "end"};
  for (int k = 0; k < 3; k++)
    ok(tap,
       schema_needs_all(schema, find_line("r.ndjson", kinds[k], false)) &&
           schema_needs_all(schema, find_line("p.ndjson", kinds[k], true)),
       "every field of the %s is needed", kinds[k]);
  json_t *event = find_line("p.ndjson", "event", true);
  bool good = schema_admits(schema, event) && json_array_size(event) == 7;
  for (size_t k = 0; k < 7; k++) {
    json_t *spoilt = json_deep_copy(event);
    json_array_set_new(spoilt, k, json_string("word"));
    good &= !schema_admits(schema, spoilt);
    json_decref(spoilt);
  }
  json_array_append_new(event, json_null());
  ok(tap, good && !schema_admits(schema, event),
     "each place of an event has its type, and there are seven");
  json_decref(event);
}

/* The numbers of raycast's counters, after those of shadows. */
enum { MINIMAX = 3, SURROUND, DEPTH, SHOWN };

static void test_filters(struct tap *tap) {
  static const struct window all = {{0, 0, 9999, 9999}}, rows = {{0, 5, 20, 7}},
                             few = {{3, 6, 8, 7}};
  json_int_t bad, whole = count_events("r.ndjson", -1, all, &bad), n;
  ok(tap,
     trace("house -a raycast -s 20x14 --rows 5-6 -o f.ndjson") == 0 &&
         have_same_end("f.ndjson", "r.ndjson"),
     "--rows: the totals are those of all");
  n = count_events("f.ndjson", -1, rows, &bad);
  ok(tap, n > 100 && n < whole && !bad, "no event of other rows: %lld",
     (long long)n);
  ok(tap, is_repainted("f.ndjson", rows), "these rows are repainted");
  ok(tap,
     trace("house -a raycast -s 20x14 --rows 6-9 --window 3,2,8,7 --every 10 "
           "--counters 'surround tests,depth tests' -o f.ndjson") == 0 &&
         have_same_end("f.ndjson", "r.ndjson"),
     "all filters at once");
  ok(tap,
     !count_events("f.ndjson", MINIMAX, few, &bad) &&
         count_events("f.ndjson", SURROUND, few, &bad) && !bad &&
         is_repainted("f.ndjson", few),
     "no minimax test, and the window is repainted");
  trace("house -a raycast -s 20x14 --every 10 -o f.ndjson");
  json_int_t shown = count_of("f.ndjson", "counts", SHOWN);
  ok(tap,
     have_same_end("f.ndjson", "r.ndjson") &&
         count_events("f.ndjson", SHOWN, all, &bad) == shown &&
         count_events("f.ndjson", -1, all, &bad) ==
             shown + (whole - shown + 9) / 10,
     "--every: each tenth, and all that are accepted");
  trace("house -a plotter -s 20x14 --window 0,0,1,1 --every 1000 -o g.ndjson");
  ok(tap, count_events("g.ndjson", 6, all, &bad) == 3 * 231,
     "all parts of a line drawing stay");
}

/* Whether hsr refuses, by its status and one line with the text. */
static bool refuses(int status, const char *text, const char *words) {
  return trace("%s -o no.ndjson", words) == status && says(text) &&
         access("no.ndjson", F_OK) && access("no.ndjson.part", F_OK);
}

static void test_refusals(struct tap *tap) {
  ok(tap, refuses(2, "one thread", "house -a raycast -J 2"), "-J 2");
  ok(tap, refuses(2, "judge", "house -a oracle"), "the oracle");
  ok(tap, refuses(2, "draws nothing", "house -a null"), "null");
  ok(tap, refuses(2, "not traced", "house -a raycast:filter=box"),
     "a filtered picture");
  ok(tap, refuses(2, "no outline", "house -a mute"), "no outline");
  ok(tap,
     refuses(2, "no counter 'tests'",
             "house -a raycast --counters 'depth tests,tests'"),
     "no such counter");
  ok(tap, refuses(2, "--rows", "house -a raycast --rows 48-50"),
     "no row of the picture");
  ok(tap, refuses(2, "--rows", "house -a raycast --rows 5-4"),
     "rows the wrong way round");
  ok(tap, refuses(2, "--rows", "house -a raycast --rows 5 --window 0,0,9,5"),
     "rows outside of the window");
  ok(tap, refuses(2, "--window", "house -a raycast --window 1,2,3"),
     "half a window");
  ok(tap, refuses(2, "--every", "house -a raycast --every 0"), "--every 0");
  ok(tap, refuses(2, "--keyframe", "house -a raycast --keyframe 0"),
     "--keyframe 0");
  ok(tap, refuses(4, "100001 faces", "soup:100001 -a raycast"),
     "too many faces");
  ok(tap, trace("house -a raycast") == 2 && says("-o FILE"), "no file");
  ok(tap, trace("house -o no.ndjson") == 2 && says("-a NAME"), "no algorithm");
}

/* Whether it ends with status 1 and one line, and the trace also says so. */
static bool is_found_out(const char *name, const char *text,
                         const char *field) {
  bool good =
      trace("house -a %s -s 20x14 -o l.ndjson", name) == 1 && says(text);
  json_t *end = find_line("l.ndjson", "end", true);
  good = good && schema_admits(schema, end) &&
         json_is_false(json_object_get(end, field));
  json_decref(end);
  return good;
}

static void test_liars(struct tap *tap) {
  ok(tap, trace("house -a paints -o l.ndjson") == 0 && is_whole("l.ndjson"),
     "one event that paints all");
  ok(tap,
     is_found_out("liar",
                  "1 of 280 samples, the first (1, 1): face 3, not face 4",
                  "rebuilt"),
     "a sample that no event tells of");
  ok(tap,
     is_found_out("plotter2", " edges, the first the implied one", "rebuilt"),
     "an interval that no event tells of");
  ok(tap, is_found_out("bulk", "more: 7 counted, but 1 events", "counted"),
     "counts without events");
  ok(tap, is_found_out("unknown", "does not describe", "counted"),
     "a counter that is not described");
}

/* --- Never a part --------------------------------------------------------- */

static bool shell(const char *words) {
  char command[8192];
  must(snprintf(command, sizeof command, "hsr='%s'; %s", getenv("HSR"), words) <
       (int)sizeof command);
  return !system(command);
}

/* Whether the earlier file, unchanged, is the only one there. */
static bool is_untouched(const char *path) {
  char part[64];
  snprintf(part, sizeof part, "%s.part", path);
  char *text = read_text(path);
  bool good = !strcmp(text, "before") && access(part, F_OK);
  free(text);
  return good;
}

static void lay_before(const char *path) {
  FILE *file = fopen(path, "w");
  must(file && fputs("before", file) >= 0 && !fclose(file));
}

/* Sends the signal once the trace has begun. */
static bool is_ended_by(int signal, const char *path) {
  lay_before(path);
  pid_t id = trace_begin("house -a endless -o %s", path);
  char part[64];
  snprintf(part, sizeof part, "%s.part", path);
  struct stat found = {.st_size = 0};
  for (int k = 0; k < 3000 && found.st_size == 0; k++) {
    nanosleep(&(struct timespec){.tv_nsec = 10000000}, NULL);
    if (stat(part, &found))
      found.st_size = 0;
  }
  must(!kill(id, signal));
  bool good = found.st_size > 0 && bench_end(id) == 128 + signal;
  if (signal == SIGKILL)
    remove(part);
  return good && is_untouched(path);
}

static void test_files(struct tap *tap) {
  ok(tap,
     shell("$hsr trace house -a raycast -s 20x14 -o r.gz >out 2>err && "
           "gzip -t r.gz && gzip -dc r.gz | cmp - r.ndjson") &&
         is_silent(),
     "a compressed trace holds the same");
  ok(tap, is_whole("r.gz"), "and is read like the other");
  ok(tap,
     shell("$hsr trace house -a raycast -s 20x14 -o - 2>err | cmp - r.ndjson"),
     "standard output gets the same");
  lay_before("s.gz");
  ok(tap,
     trace("house -a failing -o s.gz") == 4 && says("memory") &&
         is_untouched("s.gz"),
     "of an algorithm that fails there is no file");
  static const char *const path[] = {"s.gz", "s.ndjson"};
  for (int k = 0; k < 2; k++) {
    char words[200];
    lay_before(path[k]);
    snprintf(words, sizeof words,
             "(ulimit -f 64; $hsr trace house -a raycast -o %s >out 2>err; "
             "[ $? = 3 ])",
             path[k]);
    ok(tap,
       shell(words) && says("cannot be written: File too large") &&
           is_untouched(path[k]),
       "nor where there is no room, %s", path[k]);
    ok(tap, is_ended_by(SIGINT, path[k]), "nor after an interrupt");
    ok(tap, is_ended_by(SIGTERM, path[k]), "nor when it is ended");
    ok(tap, is_ended_by(SIGKILL, path[k]), "nor when it is killed");
  }
  ok(tap,
     shell("[ $({ $hsr trace house -a raycast -o - 2>err; echo $? >status; } | "
           "head -n 1 | wc -l) = 1 ] && [ $(cat status) = 3 ]") &&
         says("standard output: cannot be written: Broken pipe"),
     "a broken pipe is an error");
  ok(tap,
     shell("[ ! -w /dev/full ] || { $hsr trace house -a raycast -o - "
           ">/dev/full 2>err; [ $? = 3 ]; }") &&
         (access("/dev/full", W_OK) || says("No space left")),
     "so is a full disk");
  ok(tap,
     shell("$hsr trace house -a raycast -o none/t.gz >out 2>err; [ $? = 3 ]") &&
         says("none/t.gz"),
     "so is a folder that is not there");
}

int main(void) {
  struct tap tap = plan(15 + 4 + 7 + 18 + 5 + 15);
  must(getenv("HSR") != NULL);
  schema = schema_open("trace.schema.json");
  enter_folder();
  test_lines(&tap);
  test_schema(&tap);
  test_filters(&tap);
  test_refusals(&tap);
  test_liars(&tap);
  test_files(&tap);
  json_decref(schema);
  return finish(&tap);
}
