// SPDX-License-Identifier: GPL-3.0-or-later
// Fails one allocation. configure --enable-torture links this into hsr. The
// linker's --wrap catches the C functions; operator new is replaced; jansson is
// given these functions. Allocations are counted from 1 after main began.
//
// HSR_FAIL_AT=N      fails the Nth. If the program ends before that, it says so
//                    in the file that HSR_FAIL_LOG names.
// HSR_FAIL_EVERY=N   fails the first, the (N + 1)th, the (2N + 1)th, ... Each
//                    fails in a copy of the process, which is forked at that
//                    point, so that all of them take one run. Only for programs
//                    of one thread that do not fork themselves. The end of each
//                    copy is judged here: it must have status 0, or status 4
//                    with one line in the file HSR_FAIL_WORDS. HSR_FAIL_LOG
//                    then gets what was wrong and, as its last line, how many
//                    were tried.
#include "bench/run/terminate.h"

#include <fcntl.h>
#include <jansson.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

namespace {

std::atomic<long> count{0};
long fail_at = 0;    /* 0: not yet, or never */
long fail_every = 0; /* 0: off */
bool is_copy = false;
long tried = 0;
std::FILE *log_file = nullptr;

/* --- Copies --------------------------------------------------------------- */

/* Continues as a copy, which prints nothing but its words. */
void become_copy() {
  is_copy = true;
  const int null = open("/dev/null", O_WRONLY);
  const int words =
      open(std::getenv("HSR_FAIL_WORDS"), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (null < 0 || words < 0 || dup2(null, STDOUT_FILENO) < 0 ||
      dup2(words, STDERR_FILENO) < 0)
    _exit(99);
}

/* Reads the words of a copy, without those of the leak sanitizer about threads
 * that a fork leaves behind. Returns the number of lines. */
int read_words(char *words, size_t size) {
  int lines = 0;
  size_t used = 0;
  char line[1024];
  if (std::FILE *file = std::fopen(std::getenv("HSR_FAIL_WORDS"), "r")) {
    while (std::fgets(line, sizeof line, file)) {
      if (std::strstr(line, "was not suspended. False leaks"))
        continue;
      lines++;
      if (used + std::strlen(line) < size)
        used += size_t(std::sprintf(words + used, "%s", line));
    }
    std::fclose(file);
  }
  words[used] = '\0';
  return lines;
}

void judge(long number, int end) {
  char words[4096];
  const int lines = read_words(words, sizeof words);
  const bool good = WIFEXITED(end) && (WEXITSTATUS(end) == 0 ||
                                       (WEXITSTATUS(end) == 4 && lines == 1 &&
                                        !std::strncmp(words, "hsr: ", 5)));
  tried++;
  if (!good)
    std::fprintf(log_file, "bad at %ld: end %d\n%s", number, end, words);
}

/* Whether this is the copy in which the allocation fails. */
bool fails_in_copy(long number) {
  if (number % fail_every != 1 % fail_every)
    return false;
  const long every = fail_every;
  fail_every = 0; /* judging allocates as well */
  std::fflush(log_file);
  int end = -1;
  const pid_t copy = fork();
  if (copy == 0) {
    become_copy();
    return true;
  }
  if (copy > 0)
    waitpid(copy, &end, 0);
  judge(number, end);
  fail_every = every;
  return false;
}

bool fails() {
  if (fail_every > 0 ? !fails_in_copy(++count) : !fail_at || ++count != fail_at)
    return false;
  errno = ENOMEM;
  return true;
}

long number_of(const char *variable) {
  const char *value = std::getenv(variable);
  return value ? std::atol(value) : 0;
}

} // namespace

extern "C" {

void *__real_malloc(size_t);
void *__real_calloc(size_t, size_t);
void *__real_realloc(void *, size_t);
void *__real_aligned_alloc(size_t, size_t);
char *__real_strdup(const char *);
int __real_main(int, char **);

void *__wrap_malloc(size_t size) {
  return fails() ? nullptr : __real_malloc(size);
}
void *__wrap_calloc(size_t n, size_t size) {
  return fails() ? nullptr : __real_calloc(n, size);
}
void *__wrap_realloc(void *p, size_t size) {
  return fails() ? nullptr : __real_realloc(p, size);
}
void *__wrap_aligned_alloc(size_t alignment, size_t size) {
  return fails() ? nullptr : __real_aligned_alloc(alignment, size);
}
char *__wrap_strdup(const char *text) {
  return fails() ? nullptr : __real_strdup(text);
}

int __wrap_main(int argc, char **argv) {
  const char *log = std::getenv("HSR_FAIL_LOG");
  json_set_alloc_funcs(__wrap_malloc, std::free);
  if (number_of("HSR_FAIL_EVERY"))
    log_file = std::fopen(log, "w");
  fail_at = number_of("HSR_FAIL_AT");
  fail_every = log_file ? number_of("HSR_FAIL_EVERY") : 0;
  const int status = __real_main(argc, argv);
  if (is_copy)
    end_process(status);
  const long last = count, wanted = fail_at;
  fail_at = fail_every = 0;
  if (log_file) {
    std::fprintf(log_file, "%ld\n", tried);
    std::fclose(log_file);
  } else if (log && last < wanted) {
    if (std::FILE *file = std::fopen(log, "w")) {
      std::fprintf(file, "%ld\n", last);
      std::fclose(file);
    }
  }
  return status;
}

} // extern "C"

/* new[] and delete[] are those of common/base/number_memory.cc. */
void *operator new(size_t size) {
  void *p = fails() ? nullptr : __real_malloc(size ? size : 1);
  if (!p)
    throw std::bad_alloc();
  return p;
}
void *operator new(size_t size, const std::nothrow_t &) noexcept {
  return fails() ? nullptr : __real_malloc(size ? size : 1);
}
void operator delete(void *p) noexcept {
  std::free(p);
}
void operator delete(void *p, size_t) noexcept {
  std::free(p);
}
void operator delete(void *p, const std::nothrow_t &) noexcept {
  std::free(p);
}
