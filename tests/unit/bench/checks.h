/* SPDX-License-Identifier: GPL-3.0-or-later */
/* For the tests of the oracles: test points that are counted as they come, and
 * allocations that fail. One source of a program includes it. */
#ifndef HSR_TESTS_UNIT_BENCH_CHECKS_H
#define HSR_TESTS_UNIT_BENCH_CHECKS_H

#include "algorithms/algorithm.h"

#include <cstdio>
#include <cstdlib>
#include <new>
#include <string>

inline int n_tests, n_failed;

inline void ok(bool good, const std::string &what) {
  std::printf("%s %d - %s\n", good ? "ok" : "not ok", ++n_tests, what.c_str());
  std::fflush(stdout);
  n_failed += !good;
}

/* The exit status; after the last test point. */
inline int finish() {
  std::printf("1..%d\n", n_tests);
  return n_failed ? 1 : 0;
}

/* Allocations left until one fails; negative: none fails. */
inline long allocations_left = -1;

/* Not inlined: the compiler would take new and free for a mismatch. */
[[gnu::noinline]] void *operator new(size_t size) {
  if (allocations_left == 0)
    throw std::bad_alloc();
  if (allocations_left > 0)
    allocations_left--;
  if (void *p = std::malloc(size ? size : 1))
    return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void *p) noexcept {
  std::free(p);
}
[[gnu::noinline]] void operator delete(void *p, size_t) noexcept {
  std::free(p);
}

/* Whether the operator new above is the one in use: valgrind has its own. */
inline bool can_fail_allocations() {
  allocations_left = 0;
  bool can = false;
  try {
    ::operator delete(::operator new(1));
  } catch (const std::bad_alloc &) {
    can = true;
  }
  allocations_left = -1;
  return can;
}

/* An oracle's picture, again and again, with the k-th allocation failing: for
 * all k, or in longer and longer steps. `job` is complete but for what is
 * prepared; `begin` is called before each. */
template <class Begin>
void ok_without_memory(const struct hsr_algorithm &oracle, struct hsr_job job,
                       bool all, const Begin &begin) {
  const char *const what = "each failed allocation is told by HSR_E_NOMEM";
  if (!can_fail_allocations()) {
    ok(true, std::string(what) + " # SKIP allocations cannot be made to fail");
    return;
  }
  bool good = true;
  int n_failures = 0;
  for (long k = 0;; k += all ? 1 : 1 + k / 64) {
    struct hsr_error err = {};
    job.prepared = nullptr;
    begin();
    allocations_left = k;
    enum hsr_status status =
        oracle.prepare ? oracle.prepare(job.world, nullptr, &job.prepared, &err)
                       : HSR_OK;
    if (status == HSR_OK)
      status = oracle.render(&job, &err);
    allocations_left = -1;
    if (oracle.release)
      oracle.release(job.prepared);
    if (status == HSR_OK)
      break;
    n_failures++;
    good = good && status == HSR_E_NOMEM && err.status == HSR_E_NOMEM;
  }
  ok(good && n_failures > 10, what);
}

#endif
