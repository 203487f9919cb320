/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tests/sweep/sweeping.h"
#include "tests/tap.h"

#include "bench/results/figures.h"

#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static char folder[] = "/tmp/hsr-sweep-XXXXXX";
static char fixtures[4096]; /* the path of hsr-fixtures */

void must(bool done) {
  if (!done)
    bail("The test cannot be set up: %s", strerror(errno));
}

/* --- The folder ----------------------------------------------------------- */

static void remove_folder(void) {
  char command[64];
  snprintf(command, sizeof command, "rm -rf %s", folder);
  must(!chdir("/"));
  must(!system(command));
}

void enter_folder(void) {
  ssize_t length = readlink("/proc/self/exe", fixtures, sizeof fixtures - 32);
  must(length > 0);
  fixtures[length] = '\0';
  strcpy(strrchr(fixtures, '/'), "/hsr-fixtures");
  must(!access(fixtures, X_OK));
  must(mkdtemp(folder) != NULL);
  must(!atexit(remove_folder));
  must(!chdir(folder));
  /* A process whose parent ends becomes a child of the test, which can then
   * wait for it. */
  must(!prctl(PR_SET_CHILD_SUBREAPER, 1));
}

/* --- The command ---------------------------------------------------------- */

static pid_t begin(const char *subcommand, const char *format, va_list words) {
  char command[8192];
  int length =
      snprintf(command, sizeof command, "exec '%s' %s >out 2>err </dev/null ",
               fixtures, subcommand);
  vsnprintf(command + length, sizeof command - (size_t)length, format, words);
  fflush(NULL);
  pid_t id = fork();
  must(id >= 0);
  if (id == 0) {
    setpgid(0, 0);
    signal(SIGINT, SIG_DFL); /* a shell ignores it in background jobs */
    execl("/bin/sh", "sh", "-c", command, (char *)NULL);
    _exit(127);
  }
  setpgid(id, id);
  return id;
}

pid_t bench_begin(const char *format, ...) {
  va_list words;
  va_start(words, format);
  pid_t id = begin("bench", format, words);
  va_end(words);
  return id;
}

int bench_end(pid_t id) {
  int end;
  must(waitpid(id, &end, 0) == id);
  return WIFEXITED(end) ? WEXITSTATUS(end) : 128 + WTERMSIG(end);
}

int check(const char *format, ...) {
  va_list words;
  va_start(words, format);
  pid_t id = begin("check", format, words);
  va_end(words);
  return bench_end(id);
}

pid_t trace_begin(const char *format, ...) {
  va_list words;
  va_start(words, format);
  pid_t id = begin("trace", format, words);
  va_end(words);
  return id;
}

int trace(const char *format, ...) {
  va_list words;
  va_start(words, format);
  pid_t id = begin("trace", format, words);
  va_end(words);
  return bench_end(id);
}

int bench(const char *format, ...) {
  va_list words;
  va_start(words, format);
  pid_t id = begin("bench", format, words);
  va_end(words);
  return bench_end(id);
}

bool is_group_gone(pid_t id) {
  for (int k = 0; k < 500; k++) {
    pid_t ended;
    while ((ended = waitpid(-id, NULL, WNOHANG)) > 0) {
    }
    if (ended < 0)
      return errno == ECHILD;
    nanosleep(&(struct timespec){.tv_nsec = 10000000}, NULL);
  }
  kill(-id, SIGKILL);
  return false;
}

/* --- What it says --------------------------------------------------------- */

char *read_text(const char *path) {
  FILE *file = fopen(path, "r");
  must(file != NULL);
  char *text = NULL;
  size_t size = 0;
  FILE *memory = open_memstream(&text, &size);
  must(memory != NULL);
  for (int c; (c = getc(file)) != EOF;)
    putc(c, memory);
  fclose(file);
  must(!fclose(memory));
  return text;
}

long count_lines(const char *path) {
  FILE *file = fopen(path, "r");
  long lines = 0;
  for (int c; file && (c = getc(file)) != EOF;)
    lines += c == '\n';
  if (file)
    fclose(file);
  return lines;
}

bool printed(const char *text) {
  char *out = read_text("out");
  bool found = strstr(out, text) != NULL;
  free(out);
  return found;
}

/* What it printed on standard error, without the sanitizers' words about
 * threads that a fork leaves behind and about CGAL's own shifts. */
static char *read_words(void) {
  must(!system("sed -i -e '/was not suspended. False leaks/d' "
               "-e '/CGAL.*runtime error: left shift/d' err"));
  return read_text("err");
}

bool says(const char *text) {
  char *err = read_words();
  bool good = !strncmp(err, "hsr: ", 5) && strstr(err, text) &&
              strchr(err, '\n') == err + strlen(err) - 1;
  if (!good)
    printf("# it says '%s', not '%s'\n", err, text);
  free(err);
  return good;
}

bool is_silent(void) {
  char *err = read_words();
  bool good = !*err;
  if (!good)
    printf("# it says '%s'\n", err);
  free(err);
  return good;
}

/* --- What it wrote -------------------------------------------------------- */

struct results read_results(const char *path) {
  struct results results = {.headers = NULL};
  struct hsr_error err;
  if (results_read(&results, path, &err))
    bail("%s", err.text);
  return results;
}

static const json_t *cell_of(const struct results *results,
                             const char *algorithm) {
  char key[RESULTS_KEY];
  snprintf(key, sizeof key, "house 1 64x48 %s 1", algorithm);
  return results_cell(results, key);
}

const char *verdict(const struct results *results, const char *algorithm) {
  const char *status =
      json_string_value(json_object_get(cell_of(results, algorithm), "status"));
  return status ? status : "";
}

bool has_times(const struct results *results, const char *algorithm) {
  return json_array_size(
             json_object_get(cell_of(results, algorithm), "starts")) > 0;
}

double median(const struct results *results, const char *algorithm) {
  const json_t *starts = json_object_get(cell_of(results, algorithm), "starts");
  double seconds[1000];
  int n = 0;
  size_t k, i;
  const json_t *start, *second;
  json_array_foreach(starts, k, start)
      json_array_foreach(json_object_get(start, "seconds"), i, second)
          seconds[n++] = json_number_value(second);
  struct samples samples = {seconds, 1, n};
  struct figure figure;
  must(n && figure_median(&samples, &figure));
  return figure.value;
}
