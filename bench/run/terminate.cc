// SPDX-License-Identifier: GPL-3.0-or-later
// Ends a program whose libraries throw although they promise not to:
// OpenImageIO allocates in constructors that are declared noexcept.
#include "bench/run/terminate.h"
#include "common/base/status.h"

#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <sys/prctl.h>
#include <unistd.h>

/* The leak sanitizer's function; NULL in a build without it. */
extern "C" int __lsan_do_recoverable_leak_check(void) __attribute__((weak));

namespace {

/* Prints one line without taking memory, and ends. */
[[noreturn]] void end(const char *line, size_t length, int status) {
  if (write(STDERR_FILENO, line, length) < 0)
    status = HSR_E_INTERNAL;
  _exit(status);
}

/* Whether the parent process reports it, from the status. */
bool parent_tells = false;

[[noreturn]] void end_without_memory() {
  static const char no_memory[] = "hsr: out of memory\n";
  end(no_memory, parent_tells ? 0 : sizeof no_memory - 1, HSR_E_NOMEM);
}

[[noreturn]] void terminate() {
  static const char internal[] = "hsr: a library failed\n";
  try {
    if (std::current_exception())
      throw;
  } catch (const std::bad_alloc &) {
    end_without_memory();
  } catch (...) {
  }
  end(internal, sizeof internal - 1, HSR_E_INTERNAL);
}

} // namespace

void end_process(int status) {
  if (__lsan_do_recoverable_leak_check && __lsan_do_recoverable_leak_check())
    status = HSR_E_INTERNAL;
  std::fflush(nullptr);
  _exit(status);
}

void end_with_parent(pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) /* the parent had already ended */
    _exit(HSR_E_INTERNAL);
  parent_tells = true;
}

void end_in_one_line(void) {
  std::set_terminate(terminate);
}
