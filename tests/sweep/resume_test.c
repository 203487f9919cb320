/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr bench is disturbed: it is killed or interrupted; its file is full, cut
 * short, not its own, or written by two. Records that are there stay, and
 * --resume gives the same results. */
#include "tests/sweep/sweeping.h"

#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#define SWEEP                                                                  \
  "house penetration coplanar t-junction --views 2 --size 24x18 "              \
  "-a zbuffer-fast,watkins,broken,crasher --starts 2 --repetitions 2 "
enum { CELLS = 32 };

static void wait_ms(long ms) {
  nanosleep(&(struct timespec){ms / 1000, ms % 1000 * 1000000}, NULL);
}

static void write_text(const char *path, const char *how, const char *text) {
  FILE *file = fopen(path, how);
  must(file && fputs(text, file) >= 0 && !fclose(file));
}

static bool is_same_text(const char *path, const char *text) {
  char *now = read_text(path);
  bool same = !strcmp(now, text);
  free(now);
  return same;
}

/* Whether each line is a record, including the last one. */
static bool is_whole(const char *path) {
  struct results r = {.headers = NULL};
  struct hsr_error err = {.text = ""};
  bool whole = !results_read(&r, path, &err);
  char *text = read_text(path);
  whole = whole && *text && text[strlen(text) - 1] == '\n';
  if (!whole)
    printf("# %s\n", err.text);
  free(text);
  results_free(&r);
  return whole;
}

/* --- The same in the end -------------------------------------------------- */

static size_t cells_in(const char *path) {
  struct results r = read_results(path);
  size_t n = json_array_size(r.cells);
  results_free(&r);
  return n;
}

/* Whether both files have the same cells, verdicts, mismatches and counts, and
 * times for the same cells. */
static bool is_same(const char *path, const char *other) {
  static const char *const fields[] = {"status", "mismatches", "compared",
                                       "counts", "adapted",    "depths"};
  struct results a = read_results(path), b = read_results(other);
  bool same = json_array_size(a.cells) == json_array_size(b.cells) &&
              json_array_size(a.views) == json_array_size(b.views);
  size_t k;
  const json_t *cell;
  json_array_foreach(a.cells, k, cell) {
    char key[RESULTS_KEY];
    results_key(cell, key);
    const json_t *twin = results_cell(&b, key);
    for (size_t f = 0; f < sizeof fields / sizeof *fields; f++)
      if (!json_equal(json_object_get(cell, fields[f]),
                      json_object_get(twin, fields[f]))) {
        printf("# %s: %s differs\n", key, fields[f]);
        same = false;
      }
    if (json_array_size(json_object_get(cell, "starts")) !=
        json_array_size(json_object_get(twin, "starts")))
      same = false;
  }
  results_free(&a);
  results_free(&b);
  return same;
}

/* It is killed several times, and continues until it ends by itself. */
static void test_kill(struct tap *tap) {
  bool gone = true;
  int killed = 0, between = 0;
  for (int k = 0; k < 5; k++) {
    pid_t id = bench_begin(SWEEP "--resume -o k.ndjson");
    long lines = count_lines("k.ndjson");
    for (int i = 0; i < 3000 && count_lines("k.ndjson") < lines + 3; i++)
      wait_ms(10);
    wait_ms(50 * k); /* while it judges, starts or times */
    kill(id, SIGKILL);
    killed += bench_end(id) == 128 + SIGKILL;
    gone = is_group_gone(id) && gone;
    size_t cells = cells_in("k.ndjson");
    between += cells > 0 && cells < CELLS;
  }
  ok(tap, killed == 5 && between > 1, "killed %d times, %d of them in between",
     killed, between);
  ok(tap, gone, "no process is left behind");
  write_text("k.ndjson", "a", "{\"record\":\"cell\",\"scene\":\"ho");
  int status = bench(SWEEP "--resume -o k.ndjson");
  ok(tap, status == 1 && is_silent(), "--resume brings it to its end");
  ok(tap, is_whole("k.ndjson"), "the line that was cut is gone");
  ok(tap, is_same("k.ndjson", "whole.ndjson"),
     "the cells and verdicts are those of an undisturbed run");
  long lines = count_lines("k.ndjson");
  bench(SWEEP "--resume -o k.ndjson");
  ok(tap, count_lines("k.ndjson") == lines + 1,
     "where all is done, a header is all that is added");
}

static void test_interrupt(struct tap *tap) {
  pid_t id = bench_begin(SWEEP "-o i.ndjson");
  for (int k = 0; k < 3000 && count_lines("i.ndjson") < 4; k++)
    wait_ms(10);
  kill(-id, SIGINT);
  int status = bench_end(id);
  ok(tap, status == 128 + SIGINT, "Ctrl-C ends it");
  ok(tap, is_whole("i.ndjson") && cells_in("i.ndjson") < CELLS,
     "and leaves whole lines");
  ok(tap, is_group_gone(id), "and no process");
}

/* While an algorithm sleeps, others are judged already. */
static void test_interrupt_of_judging(struct tap *tap) {
#define SLOW "house --size 24x18 -a zbuffer-fast,watkins,staller -t 30 "
  pid_t id = bench_begin(SLOW "-o j.ndjson");
  struct stat part = {.st_size = 0};
  for (int k = 0; k < 1000 && part.st_size < 3000; k++) {
    wait_ms(10);
    if (stat("j.ndjson.part", &part))
      part.st_size = 0;
  }
  wait_ms(300);
  kill(-id, SIGINT);
  int status = bench_end(id);
  ok(tap, status == 128 + SIGINT && says("2 cells") && is_group_gone(id),
     "Ctrl-C while an algorithm is judged");
  struct results r = read_results("j.ndjson");
  const json_t *cell = results_cell(&r, "house 1 24x18 watkins 1");
  ok(tap,
     json_array_size(r.cells) == 2 && cell &&
         !strcmp(results_text(cell, "status"), "ok") &&
         json_array_size(json_object_get(cell, "starts")) == 0,
     "the cells that are judged are in the file, without times");
  results_free(&r);
}

static void test_failure(struct tap *tap) {
  int status = bench("none.off -o n.ndjson");
  ok(tap,
     status == 3 && access("n.ndjson", F_OK) && access("n.ndjson.part", F_OK),
     "a run that fails at once leaves no file");
  status = bench("house none.off --size 20x14 -a null --counts -o o.ndjson");
  ok(tap, status == 3 && cells_in("o.ndjson") == 1,
     "one that fails later leaves what it has recorded");
}

/* While the oracle draws, nobody reads a pipe that could show the end. */
static void test_kill_while_judged(struct tap *tap) {
  pid_t id = bench_begin("soup:20000:1 --size 2000x2000 -a zbuffer-fast");
  wait_ms(1500);
  kill(id, SIGKILL);
  bench_end(id);
  ok(tap, is_group_gone(id), "killed while judging, it leaves no process");
}

static void refuses_to_merge(struct tap *tap, const char *files,
                             const char *why, const char *what) {
  int status = bench("merge %s", files);
  char *text = read_text("err");
  ok(tap,
     status == 3 && strstr(text, why) && !strchr(strchr(text, '\n') + 1, '\n'),
     "%s", what);
  free(text);
}

static void test_shards(struct tap *tap) {
  for (int k = 1; k <= 3; k++)
    bench(SWEEP "--shard %d/3 -o shard%d.ndjson", k, k);
  must(!system("cat shard1.ndjson shard2.ndjson shard3.ndjson >all.ndjson"));
  ok(tap,
     cells_in("shard1.ndjson") + cells_in("shard2.ndjson") +
             cells_in("shard3.ndjson") ==
         CELLS,
     "no shard does what another does");
  ok(tap, is_same("all.ndjson", "whole.ndjson"),
     "one behind the other they are the whole");
  ok(tap,
     bench("merge shard3.ndjson shard1.ndjson shard2.ndjson -o m.ndjson") ==
             0 &&
         is_whole("m.ndjson") && is_same("m.ndjson", "whole.ndjson"),
     "so they are if they are merged");
  ok(tap, bench("merge whole.ndjson") == 0, "the whole is one part");
  refuses_to_merge(tap, "shard1.ndjson shard3.ndjson -o n.ndjson",
                   "cells are missing", "a part is missing");
  ok(tap, access("n.ndjson", F_OK) != 0, "then nothing is written");
  refuses_to_merge(tap,
                   "shard1.ndjson shard2.ndjson shard3.ndjson "
                   "shard1.ndjson",
                   "is in shard1.ndjson, too", "a part is there twice");
  refuses_to_merge(tap, "whole.ndjson shard1.ndjson", "is of another sweep",
                   "a part of another number of parts");
  must(!system("sed 's/\"code\":\"./\"code\":\"g/' shard2.ndjson >o.ndjson"));
  refuses_to_merge(tap, "shard1.ndjson o.ndjson shard3.ndjson",
                   "is of another build", "a part of another build");
  must(!system("sed '1{p;s/\"cpu\":\"/&X/;s/\"run\":\"./\"run\":\"x/};"
               "4,$s/\"run\":\"./\"run\":\"x/' shard2.ndjson >o.ndjson"));
  refuses_to_merge(tap, "shard1.ndjson o.ndjson shard3.ndjson",
                   "is of two machines", "a part that moved amid a view");
  refuses_to_merge(tap, "shard1.ndjson none.ndjson",
                   "none.ndjson: ", "a part that is not there");
  ok(tap, bench("merge") == 2, "no parts");
}

/* --- The file ------------------------------------------------------------- */

#define ONE "house --size 20x14 -a zbuffer-fast --starts 2 --repetitions 1 "

static void test_existing(struct tap *tap) {
  char *text = read_text("whole.ndjson");
  int status = bench(SWEEP "-o whole.ndjson");
  ok(tap,
     status == 2 && says("there already") && is_same_text("whole.ndjson", text),
     "a file that is there is not touched without --resume");
  free(text);
  must(!system("sed '1s/\"code\":\"[0-9a-f]*\"/\"code\":\"0\"/' "
               "whole.ndjson >other.ndjson"));
  text = read_text("other.ndjson");
  status = bench(SWEEP "--resume -o other.ndjson");
  ok(tap,
     status == 2 && says("another build") && is_same_text("other.ndjson", text),
     "nor one of another build with it");
  free(text);
  write_text("note", "w", "not a line of JSON, nor whole");
  status = bench(ONE "--resume -o note");
  ok(tap,
     status == 3 && says("note") &&
         is_same_text("note", "not a line of JSON, nor whole"),
     "nor one that holds no results");
  write_text("bad.ndjson", "w", "{\"record\": \"cell\"}\n");
  status = bench(ONE "--resume -o bad.ndjson");
  ok(tap, status == 3 && says("bad.ndjson:1:"), "nor a record without a name");
  write_text("empty.ndjson", "w", "");
  status = bench(ONE "--resume -o empty.ndjson");
  ok(tap, !status && cells_in("empty.ndjson") == 1,
     "an empty one can be gone on with");
}

static void test_unwritable(struct tap *tap) {
  int status = bench(ONE "-o none/a.ndjson");
  ok(tap, status == 3 && says("none/a.ndjson"), "a folder that is not there");
  status = bench(ONE "-o /dev/full");
  ok(tap, status == 3 && says("No space left"), "a full disk");
  status = bench(ONE "--resume -o /dev/zero");
  ok(tap, status == 2 && says("/dev/zero"), "what can only be written to");
  must(!system("mkfifo pipe; cat pipe >piped &"));
  status = bench(ONE "-o pipe");
  for (int k = 0; k < 500 && count_lines("piped") < 3; k++)
    wait_ms(10);
  ok(tap, !status && is_whole("piped") && cells_in("piped") == 1,
     "a pipe can be");
}

static void test_two(struct tap *tap) {
  pid_t id = bench_begin(SWEEP "-o two.ndjson");
  for (int k = 0; k < 1000 && !count_lines("two.ndjson"); k++)
    wait_ms(10);
  int status = bench(SWEEP "--resume -o two.ndjson");
  ok(tap, status == 2 && says("two.ndjson"),
     "two do not write to one file at a time");
  kill(-id, SIGKILL);
  bench_end(id);
  is_group_gone(id);
}

/* Files that it opens must not take the numbers of closed standard files. */
static void test_closed(struct tap *tap) {
  int status = bench(ONE "-o closed.ndjson <&- 2>&-");
  ok(tap,
     !status && is_whole("closed.ndjson") && cells_in("closed.ndjson") == 1,
     "without standard input and error");
  status = bench(ONE "-o silent.ndjson >&-");
  ok(tap, status == 3 && says("standard output") && is_whole("silent.ndjson"),
     "without standard output, the records are there alone");
}

static void test_limit(struct tap *tap) {
#define MANY                                                                   \
  "house --size 20x14 -a 'zbuffer-fast,watkins,null,same-*' --starts 2 "
  struct rlimit limit, few;
  must(!getrlimit(RLIMIT_NOFILE, &limit));
  few = limit;
  few.rlim_cur = 16;
  must(!setrlimit(RLIMIT_NOFILE, &few));
  int status = bench(MANY "-o few.ndjson");
  must(!setrlimit(RLIMIT_NOFILE, &limit));
  ok(tap,
     status == 4 && says("open files") && access("few.ndjson", F_OK) &&
         !access("few.ndjson.part", F_OK),
     "too many processes are nobody's crash");
  status = bench(MANY "--repetitions 1 --resume -o few.ndjson");
  ok(tap, !status && cells_in("few.ndjson") == 7, "and can be made up for");
}

/* --- Scenes --------------------------------------------------------------- */

#define OFF(z) "OFF\n3 1 0\n0 0 " z "\n1 0 0\n0 1 0\n3 0 1 2\n"

static void test_scene_files(struct tap *tap) {
  write_text("a b'\".off", "w", OFF("0"));
  int status = bench("a\\ b\\'\\\".off --size 20x14 -a zbuffer-fast --starts 2 "
                     "--repetitions 1 -o f.ndjson");
  ok(tap, !status && cells_in("f.ndjson") == 1,
     "a file's name may hold blanks and quotes");
  write_text("a b'\".off", "w", OFF("1"));
  status =
      bench("a\\ b\\'\\\".off --size 20x14 -a zbuffer-fast,watkins --starts 2 "
            "--repetitions 1 --resume -o f.ndjson");
  ok(tap, status == 3 && says("another"), "but not another scene meanwhile");
  write_text("x[1],y.off", "w", OFF("0"));
  status = bench("'x[1],y.off' --size 20x14 -a zbuffer-fast --counts");
  ok(tap, !status, "or look like a pattern");
  status = bench("$(printf '%%0400d' 0).off --list");
  ok(tap, status == 2 && says("longer"), "it is no longer than keys can tell");
  status = bench("\"$(printf 'a\\nb.off')\" --list");
  ok(tap, status == 2 && says("a?b.off"), "holds no newline");
  status = bench("\"$(printf 'a\\377b.off')\" --list");
  ok(tap, status == 2 && says("UTF-8"), "and is UTF-8");
  status = bench(ONE "-o \"$(printf 'a\\377b.ndjson')\"");
  ok(tap, !status && is_silent(), "which results need not be");
}

int main(void) {
  struct tap tap = plan(1 + 6 + 3 + 1 + 2 + 2 + 12 + 5 + 4 + 1 + 2 + 2 + 7);
  enter_folder();
  int status = bench(SWEEP "-o whole.ndjson");
  ok(&tap, status == 1 && cells_in("whole.ndjson") == CELLS,
     "an undisturbed run");
  test_kill(&tap);
  test_interrupt(&tap);
  test_interrupt_of_judging(&tap);
  test_failure(&tap);
  test_kill_while_judged(&tap);
  test_shards(&tap);
  test_existing(&tap);
  test_unwritable(&tap);
  test_two(&tap);
  test_closed(&tap);
  test_limit(&tap);
  test_scene_files(&tap);
  return finish(&tap);
}
