/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "config.h"

#include "bench/programs/files.h"
#include "bench/programs/keeper.h"
#include "common/base/clock.h"
#include "common/files/json/json_read.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

enum { MOST_LINE = 1 << 16 };

struct program {
  char name[200], folder[PROGRAM_PATH - 32];
  struct program_picture picture;
  bool has_ids, has_segments, late;
  bool (*stopped)(void);
  pid_t keeper;
  int in, out, control; /* this end of the pipes */
  struct fate *fate;    /* shared */
  long frames;          /* drawn */
  size_t length;        /* of what is read and not yet used */
  char line[MOST_LINE];
};

/* --- Starting ------------------------------------------------------------- */

/* Three pipes; all closed, if they cannot be had. */
static bool open_pipes(int pipes[3][2]) {
  int n = 0;
  while (n < 3 && !pipe2(pipes[n], O_CLOEXEC))
    n++;
  for (int k = 0; n < 3 && k < n; k++)
    close(pipes[k][0]), close(pipes[k][1]);
  return n == 3;
}

static bool fork_keeper(struct program *p, const struct program_job *job) {
  int pipes[3][2]; /* to the program, from it, to the keeper */
  if (!open_pipes(pipes))
    return false;
  fflush(NULL);
  p->keeper = fork();
  if (p->keeper == 0)
    keep(&(struct keeping){.job = job,
                           .folder = p->folder,
                           .fate = p->fate,
                           .control = pipes[2][0],
                           .in = pipes[0][0],
                           .out = pipes[1][1]});
  close(pipes[0][0]), close(pipes[1][1]), close(pipes[2][0]);
  p->in = pipes[0][1];
  p->out = pipes[1][0];
  p->control = pipes[2][1];
  if (p->keeper > 0)
    return true;
  close(p->in), close(p->out), close(p->control);
  return false;
}

static void free_program(struct program *p) {
  if (p->fate)
    munmap(p->fate, sizeof *p->fate);
  free(p);
}

enum hsr_status program_start(const struct program_job *job,
                              struct program **program, struct hsr_error *err) {
  struct program *p = calloc(1, sizeof *p);
  *program = NULL;
  if (!p)
    return hsr_fail_nomem(err);
  snprintf(p->name, sizeof p->name, "%s", job->name);
  p->picture = (struct program_picture){job->view->m, job->view->n,
                                        job->world ? job->world->n_faces : 0};
  p->has_ids = program_has_ids(job);
  p->has_segments = job->world && !p->has_ids;
  p->stopped = job->stopped;
  void *shared = mmap(NULL, sizeof *p->fate, PROT_READ | PROT_WRITE,
                      MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  p->fate = shared == MAP_FAILED ? NULL : shared;
  enum hsr_status status =
      p->fate ? files_make(job, p->folder, err) : hsr_fail_nomem(err);
  if (!status && !fork_keeper(p, job)) {
    status = hsr_fail_nomem(err);
    files_remove(p->folder);
  }
  if (status)
    free_program(p);
  else
    *program = p;
  return status;
}

/* --- Its end -------------------------------------------------------------- */

/* Lets the keeper do its work: at once, or when the program has had the time to
 * end by itself. */
static struct fate stop(struct program *p, bool by_itself) {
  close(p->in);
  if (by_itself && write(p->control, "e", 1) != 1)
    by_itself = false; /* the keeper is gone */
  if (!by_itself)
    close(p->control);
  while (waitpid(p->keeper, NULL, 0) < 0 && errno == EINTR) {
  }
  if (by_itself)
    close(p->control);
  close(p->out);
  p->keeper = 0;
  return *p->fate;
}

static const char *when(const struct program *p, char text[64]) {
  if (!p->frames)
    return "before it was ready";
  snprintf(text, 64, "in frame %ld", p->frames);
  return text;
}

/* Says how it ended. */
static enum hsr_status say_end(const struct program *p, const struct fate *fate,
                               const char *when, struct hsr_error *err) {
  int status = fate->status;
  if (WIFSIGNALED(status))
    return hsr_fail(err, HSR_E_INPUT, "%s: signal %d, %s, ended it %s%s",
                    p->name, WTERMSIG(status), strsignal(WTERMSIG(status)),
                    when, fate->words);
  int code = WEXITSTATUS(status);
  bool declines = code == HSR_E_REFUSED && !p->frames;
  return hsr_fail(err, declines ? HSR_E_REFUSED : HSR_E_INPUT,
                  "%s: it ended %s, with status %d%s", p->name, when, code,
                  fate->words);
}

/* Its output has ended. */
static enum hsr_status fail_for_end(struct program *p, struct hsr_error *err) {
  char text[64];
  struct fate fate = stop(p, true);
  if (!fate.ended)
    return hsr_fail(err, HSR_E_INPUT, "%s: it closed its standard output %s%s",
                    p->name, when(p, text), fate.words);
  return say_end(p, &fate, when(p, text), err);
}

/* --- Lines ---------------------------------------------------------------- */

/* Waits until there is more to read. False if that takes until
 * hsr_seconds_now() is `end`, or if it is to be stopped. */
static bool is_ready(const struct program *p, double end) {
  for (;;) {
    double left = p->stopped && p->stopped() ? 0 : end - hsr_seconds_now();
    struct pollfd ready = {.fd = p->out, .events = POLLIN};
    int n =
        left > 0 ? poll(&ready, 1, left < 1e6 ? (int)(left * 1e3) + 1 : -1) : 0;
    if (n >= 0 || errno != EINTR)
      return n > 0;
  }
}

static enum hsr_status fail_for_time(struct program *p, double seconds,
                                     struct hsr_error *err) {
  char text[64];
  bool stopped = p->stopped && p->stopped();
  struct fate fate = stop(p, false);
  if (stopped)
    return hsr_fail(err, HSR_E_STOPPED, "stopped");
  p->late = true;
  return hsr_fail(err, HSR_E_STOPPED,
                  "%s: it took longer than %.0f s %s, in which no line came%s",
                  p->name, seconds, when(p, text), fate.words);
}

static enum hsr_status fail_for_line(struct program *p, const char *line,
                                     size_t n, struct hsr_error *err) {
  char text[64];
  stop(p, false);
  return hsr_fail(err, HSR_E_INPUT,
                  "%s: it printed '%.*s%s' %s, where a line {...} of JSON is "
                  "wanted",
                  p->name, (int)(n < 60 ? n : 60), line, n < 60 ? "" : "...",
                  when(p, text));
}

/* Appends what there is to read. */
static enum hsr_status read_more(struct program *p, double end, double seconds,
                                 struct hsr_error *err) {
  if (!is_ready(p, end))
    return fail_for_time(p, seconds, err);
  ssize_t got = read(p->out, p->line + p->length, sizeof p->line - p->length);
  if (got <= 0)
    return fail_for_end(p, err);
  p->length += (size_t)got;
  return HSR_OK;
}

/* Waits for a line, which begins p->line then; *length is without its end. */
static enum hsr_status wait_for_line(struct program *p, double seconds,
                                     size_t *length, struct hsr_error *err) {
  double end = hsr_seconds_now() + seconds;
  const char *newline;
  while (!(newline = memchr(p->line, '\n', p->length))) {
    if (p->length == sizeof p->line)
      return fail_for_line(p, p->line, 60, err);
    enum hsr_status status = read_more(p, end, seconds, err);
    if (status)
      return status;
  }
  *length = (size_t)(newline - p->line);
  return *p->line == '{' ? HSR_OK : fail_for_line(p, p->line, *length, err);
}

static void drop_line(struct program *p, size_t length) {
  p->length -= length + 1;
  memmove(p->line, p->line + length + 1, p->length);
}

static enum hsr_status parse_line(struct program *p, size_t length,
                                  json_t **json, struct hsr_error *err) {
  bool starved = false;
  json_error_t error;
  *json = hsr_json_read_text(p->line, length, 0, &starved, &error);
  if (*json)
    return HSR_OK;
  if (!starved)
    return fail_for_line(p, p->line, length, err);
  stop(p, false);
  return hsr_fail_nomem(err);
}

/* --- What a line says ----------------------------------------------------- */

static enum hsr_status fail_for_value(struct program *p, const char *name,
                                      const json_t *value, const char *wanted,
                                      struct hsr_error *err) {
  char text[300], *said = json_dumps(value, JSON_ENCODE_ANY | JSON_COMPACT);
  snprintf(text, sizeof text, "it said %.40s of '%.60s', where %s is wanted",
           said ? said : "something", name, wanted);
  free(said);
  return program_fail(p, text, err);
}

/* *number becomes what it says of a phase, or -1 if that is nothing. */
static enum hsr_status read_number(struct program *p, const json_t *line,
                                   const char *name, double *number,
                                   struct hsr_error *err) {
  const json_t *value = json_object_get(line, name);
  *number = json_is_number(value) ? json_number_value(value) : -1;
  return value && !json_is_null(value) && !(*number >= 0)
             ? fail_for_value(p, name, value, "a number from 0", err)
             : HSR_OK;
}

static enum hsr_status check_counts(struct program *p, json_t *line,
                                    struct hsr_error *err) {
  json_t *counts = json_object_get(line, "counts"), *value;
  const char *name;
  if (counts && !json_is_object(counts))
    return fail_for_value(p, "counts", counts, "{NAME: NUMBER, ...}", err);
  json_object_foreach(counts, name, value) {
    double n = json_is_number(value) ? json_number_value(value) : -1;
    if (!(n >= 0 && n <= 0x1p53) || n != floor(n))
      return fail_for_value(p, name, value, "a whole number from 0 to 2^53",
                            err);
  }
  return HSR_OK;
}

static enum hsr_status read_phases(struct program *p, const json_t *line,
                                   struct program_phases *phases,
                                   struct hsr_error *err) {
  double kb = -1;
  enum hsr_status status = read_number(p, line, "import", &phases->import, err);
  if (!status)
    status = read_number(p, line, "adapt", &phases->adapt, err);
  if (!status)
    status = read_number(p, line, "prepare", &phases->prepare, err);
  if (!status)
    status = read_number(p, line, "before_kb", &kb, err);
  phases->before_kb = kb < 0x1p53 ? (long)kb : -1;
  return status;
}

enum hsr_status program_ready(struct program *p, double seconds,
                              struct program_phases *phases,
                              struct hsr_error *err) {
  size_t length;
  json_t *json;
  enum hsr_status status = wait_for_line(p, seconds, &length, err);
  if (!status)
    status = parse_line(p, length, &json, err);
  if (status)
    return status;
  drop_line(p, length);
  status = read_phases(p, json, phases, err);
  json_decref(json);
  return status;
}

/* --- Frames --------------------------------------------------------------- */

/* A program that has ended does not end this one, too. */
static bool write_bytes(const struct program *p, char byte, long n) {
  struct sigaction ignore = {.sa_handler = SIG_IGN}, before;
  char bytes[PROGRAM_MOST_FRAMES];
  memset(bytes, byte, (size_t)n);
  sigaction(SIGPIPE, &ignore, &before);
  bool good = write(p->in, bytes, (size_t)n) == n;
  sigaction(SIGPIPE, &before, NULL);
  return good;
}

enum hsr_status program_draw(struct program *p, char byte, long n,
                             double seconds, double *spent, json_t **line,
                             struct hsr_error *err) {
  double begin = hsr_seconds_now();
  size_t length;
  p->frames++;
  if (!write_bytes(p, byte, n))
    return fail_for_end(p, err);
  for (long k = 1;; k++) {
    enum hsr_status status = wait_for_line(p, seconds, &length, err);
    if (status)
      return status;
    if (k == n)
      break;
    drop_line(p, length);
    p->frames++;
  }
  if (spent)
    *spent = hsr_seconds_now() - begin;
  json_t *last;
  enum hsr_status status = parse_line(p, length, &last, err);
  if (status)
    return status;
  drop_line(p, length);
  status = p->length ? fail_for_line(p, p->line, p->length, err)
                     : check_counts(p, last, err);
  if (line && !status)
    *line = last;
  else
    json_decref(last);
  return status;
}

/* --- What it has made ----------------------------------------------------- */

void program_file(const struct program *p, const char *name, char *path) {
  snprintf(path, PROGRAM_PATH, "%s/%s", p->folder, name);
}

enum hsr_status program_fail(struct program *p, const char *what,
                             struct hsr_error *err) {
  stop(p, false);
  return hsr_fail(err, HSR_E_INPUT, "%s: %s", p->name, what);
}

struct program_picture program_picture(const struct program *p) {
  return p->picture;
}

enum hsr_status program_unset(struct program *p, struct hsr_error *err) {
  return p->has_ids        ? program_unset_ids(p, err)
         : p->has_segments ? program_unset_segments(p, err)
                           : HSR_OK;
}

/* --- The end -------------------------------------------------------------- */

bool program_was_late(const struct program *p) {
  return p && p->late;
}

long program_peak_kb(const struct program *p) {
  char path[64], line[200];
  long peak = 0;
  snprintf(path, sizeof path, "/proc/%ld/status", (long)p->fate->program);
  FILE *file = fopen(path, "re");
  while (file && fgets(line, sizeof line, file))
    if (sscanf(line, "VmHWM: %ld", &peak) == 1)
      break;
  if (file)
    fclose(file);
  return peak;
}

enum hsr_status program_end(struct program *p, struct hsr_error *err) {
  if (!p)
    return HSR_OK;
  enum hsr_status status = HSR_OK;
  if (p->keeper) {
    struct fate fate = stop(p, true);
    if (!fate.ended)
      status = hsr_fail(
          err, HSR_E_INPUT,
          "%s: it did not end within 2 s when its input had ended", p->name);
    else if (fate.status)
      status = say_end(p, &fate, "when its input had ended", err);
  }
  free_program(p);
  return status;
}

void program_kill(struct program *p) {
  if (p && p->keeper)
    stop(p, false);
  if (p)
    free_program(p);
}
