/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a sweep asks hsr-peers (bench/peers/shared/peers.h). That is a separate
 * program, so that hsr needs none of the peers' libraries. */
#include "config.h"

#include "bench/sweep/sweep.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

/* Finds hsr-peers: in the build tree beside this program, or installed. */
static char *find_program(void) {
  char self[4096];
  ssize_t length = readlink("/proc/self/exe", self, sizeof self - 64);
  if (length < 0)
    return NULL;
  self[length] = '\0';
  strcpy(strrchr(self, '/'), "/bench/peers/hsr-peers");
  return strdup(access(self, X_OK) ? HSR_LIBEXECDIR "/hsr/hsr-peers" : self);
}

/* Runs in the new process. */
static void become(const char *program, const char *const *words, int out,
                   long timeout) {
  int nowhere = open("/dev/null", O_RDWR);
  if (nowhere < 0 || dup2(nowhere, STDIN_FILENO) < 0 ||
      dup2(nowhere, STDERR_FILENO) < 0 || dup2(out, STDOUT_FILENO) < 0)
    _exit(HSR_E_INTERNAL);
  alarm((unsigned)timeout); /* outlives the exec */
  execv(program, (char *const *)words);
  _exit(HSR_E_INTERNAL);
}

/* The program's answer, as JSON; NULL if it gives none in time. */
static json_t *ask(const char *program, const char *const *words,
                   long timeout) {
  int out[2];
  if (pipe2(out, O_CLOEXEC))
    return NULL;
  fflush(NULL);
  pid_t child = fork();
  if (child == 0)
    become(program, words, out[1], timeout);
  close(out[1]);
  FILE *pipe = fdopen(out[0], "r");
  json_t *answer =
      pipe && child > 0 ? json_loadf(pipe, JSON_DISABLE_EOF_CHECK, NULL) : NULL;
  if (pipe)
    fclose(pipe);
  else
    close(out[0]);
  while (child > 0 && waitpid(child, NULL, 0) < 0 && errno == EINTR) {
  }
  return answer;
}

enum hsr_status peers_open(struct plan *plan, struct hsr_error *err) {
  plan->peers_program = find_program();
  if (!plan->peers_program)
    return hsr_fail_nomem(err);
  plan->peers = ask(plan->peers_program,
                    (const char *const[]){"hsr-peers", "list", NULL}, 60);
  if (json_is_array(plan->peers))
    return HSR_OK;
  return hsr_fail(err, HSR_E_USAGE,
                  "--peers: hsr was built without them (configure "
                  "--with-peers)");
}

void peers_judge(const struct plan *plan, const struct place *place,
                 const char *name, struct cell *cell) {
  char view[16], size[32];
  snprintf(view, sizeof view, "%d", place->view);
  snprintf(size, sizeof size, "%dx%d", place->m, place->n);
  json_t *answer = ask(plan->peers_program,
                       (const char *const[]){"hsr-peers", "judge", name,
                                             place->scene, view, size, NULL},
                       2 * plan->options->timeout);
  cell->compared = (uint64_t)results_number(answer, "compared");
  cell->mismatches = (uint64_t)results_number(answer, "mismatches");
  json_decref(answer);
}
