/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr bench on algorithms that fail on purpose: each is recorded with its
 * failure and without a time. The times of the others are true. */
#include "tests/sweep/sweeping.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#if defined __SANITIZE_ADDRESS__
#define SANITIZED true /* such a build takes more memory than any limit */
#else
#define SANITIZED false
#endif

#define SMALL "house --size 64x48 --starts 2 "

/* --- Verdicts ------------------------------------------------------------- */

static const struct {
  const char *algorithm, *verdict;
} failing[] = {
    {"broken", "wrong"},         {"crasher", "crash"},
    {"staller", "timeout"},      {"late", "crash"},
    {"last", "crash"},           {"late-staller", "timeout"},
    {"last-staller", "timeout"},
};
enum { N_FAILING = sizeof failing / sizeof *failing };

static void test_verdicts(struct tap *tap) {
  int status = bench(SMALL "-a 'broken,crasher,staller,*la*,zbuffer-fast,null,"
                           "watkins' -t 1 --repetitions 5 -o v.ndjson");
  ok(tap, status == 1, "failures are told by the exit status (%d)", status);
  ok(tap, is_silent(), "and not in words");
  struct results r = read_results("v.ndjson");
  for (int k = 0; k < N_FAILING; k++) {
    const char *name = failing[k].algorithm, *got = verdict(&r, name);
    ok(tap, !strcmp(got, failing[k].verdict), "%s: %s", name, got);
    ok(tap, !has_times(&r, name), "%s has no time", name);
  }
  static const char *const good[] = {"zbuffer-fast", "watkins", "null"};
  for (int k = 0; k < 3; k++)
    ok(tap, !strcmp(verdict(&r, good[k]), "ok") && has_times(&r, good[k]),
       "%s is timed beside them", good[k]);
  double null = median(&r, "null");
  ok(tap, null > 0 && null < 20e-6, "null takes %.3g us", 1e6 * null);
  results_free(&r);
}

static void test_memory(struct tap *tap) {
  if (SANITIZED) {
    ok(tap, true, "too much memory # SKIP sanitized");
    ok(tap, true, "too much memory # SKIP sanitized");
    return;
  }
  int status = bench(SMALL "-a hog,zbuffer-fast --memory 500 --repetitions 1 "
                           "-o m.ndjson");
  struct results r = read_results("m.ndjson");
  ok(tap, status == 1 && !strcmp(verdict(&r, "hog"), "memory"),
     "too much memory: %s", verdict(&r, "hog"));
  ok(tap, !has_times(&r, "hog") && has_times(&r, "zbuffer-fast"),
     "only what has enough is timed");
  results_free(&r);
}

/* Algorithms that are timed on two threads are judged on two. */
static void test_threads(struct tap *tap) {
  bench(SMALL
        "-a zbuffer-fast,banded,still -T 1,2 --repetitions 1 -o t.ndjson");
  struct results r = read_results("t.ndjson");
  ok(tap, json_array_size(r.cells) == 5,
     "threads are cells of their own, where there can be several");
  ok(tap,
     !strcmp(verdict(&r, "banded"), "ok") &&
         !strcmp(json_string_value(json_object_get(
                     results_cell(&r, "house 1 64x48 banded 2"), "status")),
                 "wrong"),
     "one that is wrong on two threads is found out");
  results_free(&r);
}

/* Filtered pictures are timed with their filtering, in the same table. */
static void test_filters(struct tap *tap) {
  int status = bench(SMALL "-a zbuffer-fast,zbuffer-fast:filter=box:jitter=2,"
                           "own-filter:filter=cosine,off-by-one:filter=box "
                           "-T 1,2 --repetitions 1 -o f.ndjson");
  struct results r = read_results("f.ndjson");
  ok(tap,
     status == 1 && !strcmp(verdict(&r, "off-by-one:filter=box"), "wrong") &&
         !has_times(&r, "off-by-one:filter=box") &&
         has_times(&r, "zbuffer-fast:filter=box:jitter=2") &&
         has_times(&r, "own-filter:filter=cosine"),
     "filtered pictures are judged and timed");
  const json_t *cell =
      results_cell(&r, "house 1 64x48 zbuffer-fast:filter=box:jitter=2 2");
  ok(tap,
     json_array_size(r.cells) == 6 &&
         !strcmp(results_text(cell, "kind"), "filtered"),
     "threads draw what is filtered; who filters itself takes one");
  double one = median(&r, "zbuffer-fast"),
         all = median(&r, "zbuffer-fast:filter=box:jitter=2");
  ok(tap, all > 20 * one, "128 pictures take %.3g times as long", all / one);
  results_free(&r);
}

/* --- Walks ---------------------------------------------------------------- */

static json_int_t depth_tests(const struct results *r, const char *key) {
  json_t *counts = json_object_get(results_cell(r, key), "counts");
  return json_integer_value(json_object_get(counts, "depth tests"));
}

/* Whether each line k of the file equals line k - n; *differ: whether no two of
 * the first n are equal. */
static bool repeats(const char *path, int n, bool *differ) {
  char *text = read_text(path), *line[10];
  bool good = true;
  *differ = true;
  int k = 0;
  for (char *word = strtok(text, "\n"); word; word = strtok(NULL, "\n"), k++) {
    for (int i = 0; k < n && i < k; i++)
      *differ &= strcmp(word, line[i]) != 0;
    if (k < n)
      line[k] = word;
    good &= !strcmp(word, line[k % n]);
  }
  free(text);
  return good && k > n && k % n == 0;
}

static void test_walk(struct tap *tap) {
  setenv("HSR_WITNESS", "walk", 1);
  int status = bench(SMALL "-a walker --walk 3 --repetitions 2 -o w.ndjson");
  unsetenv("HSR_WITNESS");
  bool differ;
  ok(tap, !status && repeats("walk", 3, &differ) && differ,
     "a walk: three views in turn, over and over");
  struct results r = read_results("w.ndjson");
  const json_t *cell = results_cell(&r, "house 1-3 64x48 walker 1");
  long inner = results_number(
      json_array_get(json_object_get(cell, "starts"), 0), "inner");
  ok(tap,
     results_number(cell, "walk") == 3 &&
         results_number(cell, "compared") == 3 * 64 * 48 && inner > 0 &&
         inner % 3 == 0,
     "all of it judged, and timed in whole rounds");
  results_free(&r);

  must(!bench(SMALL "-a zbuffer-fast --counts --views 3 -o w.ndjson --resume"));
  must(!bench(SMALL "-a zbuffer-fast --counts --walk 3 -o w.ndjson --resume"));
  r = read_results("w.ndjson");
  ok(tap,
     depth_tests(&r, "house 1 64x48 zbuffer-fast 1") > 0 &&
         depth_tests(&r, "house 1-3 64x48 zbuffer-fast 1") ==
             depth_tests(&r, "house 1 64x48 zbuffer-fast 1") +
                 depth_tests(&r, "house 2 64x48 zbuffer-fast 1") +
                 depth_tests(&r, "house 3 64x48 zbuffer-fast 1"),
     "its counts are those of its views, which are cells beside it");
  results_free(&r);

  bench(SMALL "-a stale --walk 2 --counts -o w2.ndjson");
  bench(SMALL "-a stale --walk 3 --counts -o w3.ndjson");
  struct results two = read_results("w2.ndjson");
  r = read_results("w3.ndjson");
  const json_t *wrong = results_cell(&r, "house 1-3 64x48 stale 1");
  ok(tap,
     !strcmp(
         results_text(results_cell(&two, "house 1-2 64x48 stale 1"), "status"),
         "ok") &&
         !strcmp(results_text(wrong, "status"), "wrong") &&
         results_number(wrong, "mismatches") == 1 &&
         !json_object_get(wrong, "counting_mismatches"),
     "one that goes wrong in the third frame is, in both builds alike");
  results_free(&two);
  results_free(&r);
}

/* Failures that are not the algorithms' fault. */
static void test_surroundings(struct tap *tap) {
  setenv("TMPDIR", "/nowhere", 1);
  int status = bench(SMALL "-a zbuffer-fast --repetitions 1 -o n.ndjson");
  unsetenv("TMPDIR");
  struct results r = read_results("n.ndjson");
  ok(tap, !status && has_times(&r, "zbuffer-fast"),
     "without TMPDIR nothing is written, but all is timed");
  results_free(&r);
  status = bench(SMALL "-a zbuffer-fast --counts -o c.ndjson");
  r = read_results("c.ndjson");
  ok(tap,
     !status && !strcmp(verdict(&r, "zbuffer-fast"), "ok") &&
         !has_times(&r, "zbuffer-fast"),
     "--counts times nothing");
  results_free(&r);
  status = bench(SMALL "-a zbuffer-fast --repetitions 1 --resume -o c.ndjson");
  r = read_results("c.ndjson");
  ok(tap, !status && has_times(&r, "zbuffer-fast"), "which can be made up for");
  results_free(&r);
}

/* --- Times ---------------------------------------------------------------- */

/* The machine may be busy with other things, so there are three tries. */
static void test_sleeper(struct tap *tap) {
  double slept = 0;
  for (int k = 0; k < 3 && fabs(slept - 20e-3) > .05 * 20e-3; k++) {
    bench(SMALL "-a sleeper,zbuffer-fast --repetitions 9 -o s%d.ndjson", k);
    char path[32];
    snprintf(path, sizeof path, "s%d.ndjson", k);
    struct results r = read_results(path);
    slept = median(&r, "sleeper") - median(&r, "zbuffer-fast");
    results_free(&r);
  }
  ok(tap, fabs(slept - 20e-3) <= .05 * 20e-3,
     "a frame that sleeps 20 ms takes %.4g ms longer", 1e3 * slept);
}

/* The names in the witnesses' file; a run of one name counts once. */
static char *read_order(const char *seed) {
  unlink("witness");
  setenv("HSR_WITNESS", "witness", 1);
  must(!bench(SMALL "-a 'witness-*' --repetitions 6 --seed %s", seed));
  unsetenv("HSR_WITNESS");
  char *names = read_text("witness");
  size_t n = 0;
  for (const char *name = names; *name; name++)
    if (*name != '\n' && (!n || names[n - 1] != *name))
      names[n++] = *name;
  names[n] = '\0';
  return names;
}

static void test_orders(struct tap *tap) {
  char *first = read_order("1"), *again = read_order("1"),
       *other = read_order("2");
  printf("# seed 1: %s\n# again:  %s\n# seed 2: %s\n", first, again, other);
  ok(tap, strlen(first) > 12 && !strcmp(first, again),
     "the same seed, the same orders");
  ok(tap, strcmp(first, other) != 0, "another seed, other orders");
  ok(tap, strstr(first, "ac") && strstr(first, "cb") && strstr(first, "ba"),
     "they are not always in turn");
  free(first);
  free(again);
  free(other);
}

/* --- Earlier results ------------------------------------------------------ */

/* Copies results, with all times multiplied and one verdict changed. */
static void doctor(const char *from, const char *to, double factor,
                   const char *algorithm, const char *status) {
  struct results r = read_results(from);
  FILE *file = fopen(to, "w");
  must(file != NULL);
  const json_t *records[] = {r.headers, r.views, r.cells};
  for (int kind = 0; kind < 3; kind++) {
    size_t k, s, i;
    json_t *record, *start, *second;
    json_array_foreach(records[kind], k, record) {
      json_array_foreach(json_object_get(record, "starts"), s, start) {
        json_t *seconds = json_object_get(start, "seconds");
        json_array_foreach(seconds, i, second)
            json_real_set(second, factor * json_real_value(second));
      }
      const char *name =
          json_string_value(json_object_get(record, "algorithm"));
      if (algorithm && name && !strcmp(name, algorithm))
        json_object_set_new(record, "status", json_string(status));
      must(!json_dumpf(record, file, JSON_COMPACT));
      putc('\n', file);
    }
  }
  must(!fclose(file));
  results_free(&r);
}

static void test_baseline(struct tap *tap) {
#define AGAIN                                                                  \
  SMALL "-a sleeper,zbuffer-fast,null --resume -o b.ndjson --baseline "
  must(!bench(SMALL "-a sleeper,zbuffer-fast,null --starts 5 --repetitions 5 "
                    "-o b.ndjson"));
  int status = bench(AGAIN "b.ndjson");
  ok(tap,
     !status && printed("3 cells timed in both: 0 slower, 0 faster") &&
         printed("2 ratios to zbuffer-fast: 0 distinguishable"),
     "nothing has changed from itself");
  doctor("b.ndjson", "faster.ndjson", 1 / 3.0, NULL, NULL);
  status = bench(AGAIN "faster.ndjson");
  ok(tap, status == 1 && printed("sleeper 1: slower, 3 of the time before"),
     "three times slower is told");
  ok(tap, printed("0 distinguishable from before"),
     "where all are, the ratios are the same");
  doctor("b.ndjson", "slower.ndjson", 3, NULL, NULL);
  status = bench(AGAIN "slower.ndjson");
  ok(tap, !status && printed("sleeper 1: faster, 0.333 of the time before"),
     "three times faster is no failure");
  doctor("b.ndjson", "wrong.ndjson", 1, "null", "wrong");
  status = bench(AGAIN "wrong.ndjson");
  ok(tap, !status && printed("null 1: ok, before: wrong"),
     "what is right at last is no failure");
  doctor("b.ndjson", "never.ndjson", 0, NULL, NULL);
  status = bench(AGAIN "never.ndjson");
  ok(tap, !status && printed("0 cells timed in both"),
     "what takes no time was not timed");
  bench(SMALL "-a broken --counts -o d.ndjson");
  doctor("d.ndjson", "right.ndjson", 1, "broken", "ok");
  status = bench(SMALL "-a broken --counts --resume -o d.ndjson --baseline "
                       "right.ndjson");
  ok(tap, status == 1 && printed("1 no longer right"),
     "what is right no longer is one");
  status = bench(SMALL "-a zbuffer-fast -o e.ndjson --baseline none.ndjson");
  ok(tap, status == 3 && says("none.ndjson") && access("e.ndjson", F_OK),
     "a baseline that is not there is missed before all is timed");
}

/* --- Honesty -------------------------------------------------------------- */

static void test_few_starts(struct tap *tap) {
#define PAIR "house --size 64x48 -a null,zbuffer-fast,watkins --repetitions 3 "
  bench(PAIR "--starts 2");
  ok(tap,
     printed("too few starts") && !printed("~") && printed("from three starts"),
     "two starts: the table says that they are too few");
  bench(PAIR "--starts 3 --reference watkins");
  ok(tap, !printed("too few starts"), "three are enough");
  bench("house --size 64x48 -a zbuffer-fast --budget 100 --repetitions 3 "
        "-o g.ndjson");
  struct results r = read_results("g.ndjson");
  size_t starts =
      json_array_size(json_object_get(json_array_get(r.cells, 0), "starts"));
  ok(tap, starts >= 5, "a budget that allows it: five starts (%zu)", starts);
  results_free(&r);
}

static void test_budget(struct tap *tap) {
  bench("house --size 20x14 -a staller -t 3 --counts --budget 1");
  ok(tap, printed("budget: 1 s were asked for"),
     "a budget that is exceeded is said to be");
  bench("house --size 20x14 -a null --counts --budget 50");
  ok(tap, !printed("budget:"), "one that is kept is not");
}

int main(void) {
  struct tap tap =
      plan(3 + 2 + 2 + 2 * N_FAILING + 4 + 2 + 2 + 3 + 4 + 3 + 4 + 8);
  enter_folder();
  test_verdicts(&tap);
  test_memory(&tap);
  test_threads(&tap);
  test_filters(&tap);
  test_walk(&tap);
  test_surroundings(&tap);
  test_sleeper(&tap);
  test_orders(&tap);
  test_baseline(&tap);
  test_few_starts(&tap);
  test_budget(&tap);
  return finish(&tap);
}
