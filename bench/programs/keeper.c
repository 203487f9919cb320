/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "config.h"

#include "bench/programs/files.h"
#include "bench/programs/keeper.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

/* --- The program's process ------------------------------------------------ */

static void reset_signals(void) {
  static const int all[] = {SIGINT,  SIGQUIT, SIGTERM, SIGHUP,
                            SIGPIPE, SIGCHLD, SIGALRM};
  for (size_t k = 0; k < sizeof all / sizeof *all; k++)
    signal(all[k], SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, NULL);
}

static void limit_memory(long megabytes) {
  rlim_t most = (rlim_t)megabytes << 20;
  if (megabytes)
    setrlimit(RLIMIT_DATA, &(struct rlimit){most, most});
}

/* What it says on standard error is kept, for its last line. */
static int open_log(const char *folder) {
  char path[PROGRAM_PATH];
  snprintf(path, sizeof path, "%s/stderr", folder);
  return open(path, O_WRONLY | O_CREAT | O_TRUNC | O_APPEND, 0600);
}

/* All files but the standard ones are closed by exec. */
static _Noreturn void become(const struct keeping *k) {
  const char *const words[] = {k->job->path,
                               k->job->word ? k->job->word : k->folder,
                               k->job->word ? k->folder : NULL, NULL};
  setpgid(0, 0);
  reset_signals();
  limit_memory(k->job->memory_mb);
  int log = open_log(k->folder);
  if (log < 0 || dup2(k->in, STDIN_FILENO) < 0 ||
      dup2(k->out, STDOUT_FILENO) < 0 || dup2(log, STDERR_FILENO) < 0)
    _exit(127);
  close(log);
  execv(k->job->path, (char *const *)words);
  dprintf(STDERR_FILENO, "it cannot be run: %s\n", strerror(errno));
  _exit(126);
}

/* --- The keeper's process ------------------------------------------------- */

/* Ctrl-C is for hsr, which ends, and that the keeper notices. */
static void hear_nothing(void) {
  signal(SIGINT, SIG_IGN);
  signal(SIGQUIT, SIG_IGN);
  signal(SIGTERM, SIG_IGN);
  signal(SIGHUP, SIG_IGN);
  signal(SIGPIPE, SIG_IGN);
  signal(SIGALRM, SIG_IGN);
  alarm(0);
}

/* Closes what others have opened, so that it stays open for nobody's sake. */
static void close_others(const struct keeping *k) {
  long most = sysconf(_SC_OPEN_MAX);
  int nowhere = open("/dev/null", O_RDWR);
  for (int file = 0; file < most && file < 4096; file++)
    if (file <= STDERR_FILENO)
      dup2(nowhere, file);
    else if (file != k->control && file != k->in && file != k->out)
      close(file);
}

/* Reaps what has ended, and notes how the program did. */
static bool has_ended(struct fate *fate, bool by_itself) {
  int status;
  pid_t ended;
  bool program = false;
  while ((ended = waitpid(-1, &status, WNOHANG)) > 0)
    if (ended == fate->program) {
      fate->status = status;
      fate->ended = by_itself;
      program = true;
    }
  return program;
}

static void sleep_a_little(void) {
  nanosleep(&(struct timespec){0, 1000000}, NULL);
}

/* It has two seconds to end. */
static bool ends_by_itself(struct fate *fate) {
  for (int k = 0; k < 2000; k++) {
    if (has_ended(fate, true))
      return true;
    sleep_a_little();
  }
  return false;
}

/* Kills all children that there are: this process is the parent of those whose
 * parents are gone. False if there are none, or if nobody tells. */
static bool kill_children(void) {
  char path[64];
  snprintf(path, sizeof path, "/proc/self/task/%ld/children", (long)getpid());
  FILE *file = fopen(path, "r");
  long child;
  bool any = false;
  while (file && fscanf(file, "%ld", &child) == 1)
    any = !kill((pid_t)child, SIGKILL) || any;
  if (file)
    fclose(file);
  return any;
}

static void kill_all(struct fate *fate, bool ended) {
  if (!ended)
    kill(fate->program, SIGKILL);
  kill(-fate->program, SIGKILL); /* its group, which outlives it */
  while (kill_children() || !ended) {
    ended = has_ended(fate, false) || ended;
    sleep_a_little();
  }
  has_ended(fate, false);
}

/* Notes its last line on standard error. */
static void note_last_words(const struct keeping *k) {
  char path[PROGRAM_PATH], all[4096];
  snprintf(path, sizeof path, "%s/stderr", k->folder);
  FILE *file = fopen(path, "rbe");
  if (!file)
    return;
  if (!fseek(file, -(long)sizeof all + 1, SEEK_END) || !fseek(file, 0, 0)) {
    size_t n = fread(all, 1, sizeof all - 1, file);
    while (n && strchr("\r\n ", all[n - 1]))
      n--;
    all[n] = '\0';
    const char *last = strrchr(all, '\n');
    last = last ? last + 1 : all;
    if (*last)
      snprintf(k->fate->words, sizeof k->fate->words, ": %.150s", last);
  }
  fclose(file);
}

/* Waits for a byte, or for the end of the input. */
static bool is_told_to_wait(const struct keeping *k) {
  char byte;
  ssize_t n;
  do
    n = read(k->control, &byte, 1);
  while (n < 0 && errno == EINTR);
  return n == 1;
}

_Noreturn void keep(const struct keeping *k) {
  hear_nothing();
  close_others(k);
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  struct fate *fate = k->fate;
  pid_t program = fork();
  if (program == 0)
    become(k);
  fate->program = program;
  close(k->in);
  close(k->out);
  bool ended = false;
  if (is_told_to_wait(k))
    ended = program < 0 || ends_by_itself(fate);
  if (program > 0)
    kill_all(fate, ended);
  note_last_words(k);
  files_remove(k->folder);
  _exit(0);
}
