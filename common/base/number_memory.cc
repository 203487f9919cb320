// SPDX-License-Identifier: GPL-3.0-or-later
// Memory for exact numbers when there is no more. GMP ends the program then, and
// a sum of CGAL's Mpzf would free what it never had. So both have a reserve: they
// ask for little at a time, and what holds many numbers asks for memory of its
// own, which fails soon and is told as HSR_E_NOMEM. If the reserve is used up,
// too, the program ends.
//
// Mpzf takes its digits by new[]. So this file replaces new[] and delete[], in
// libhsr for hsr alone. Blocks are those of malloc.
//
// GMP has one set of functions in a process. It is chosen when this file is
// loaded. If the program has chosen other functions by then, these stay.
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <gmp.h>
#include <mutex>
#include <new>

extern "C" void *__gmp_default_allocate(size_t);

namespace {

constexpr size_t room = 1 << 20, unit = alignof(std::max_align_t);
alignas(unit) char reserve[room];
size_t used, blocks; // of the reserve; blocks that are in use
std::mutex mutex;    // of these two

bool is_reserve(const void *p) {
  return p >= reserve && p < reserve + room;
}

/* A block of the reserve; NULL: it is used up. */
void *take(size_t size) {
  const std::lock_guard<std::mutex> lock(mutex);
  if (size > room - used)
    return nullptr;
  char *p = reserve + used;
  used += (size + unit - 1) / unit * unit;
  blocks++;
  return p;
}

/* Gives a block back. The reserve is whole again when it has them all. */
void give_back() {
  const std::lock_guard<std::mutex> lock(mutex);
  if (--blocks == 0)
    used = 0;
}

void *allocate(size_t size) {
  void *p = std::malloc(size ? size : 1);
  return p ? p : take(size ? size : 1);
}

void release(void *p) {
  if (is_reserve(p))
    give_back();
  else
    std::free(p);
}

/* Ends the program as one does that does not catch a lack of memory. */
[[noreturn]] void end() {
  try {
    throw std::bad_alloc();
  } catch (...) {
    std::terminate();
  }
}

/* --- GMP ------------------------------------------------------------------ */

void *gmp_allocate(size_t size) {
  void *p = allocate(size);
  return p ? p : (end(), nullptr);
}

void *gmp_reallocate(void *p, size_t old_size, size_t size) {
  void *q = is_reserve(p) ? nullptr : std::realloc(p, size);
  if (q)
    return q;
  q = gmp_allocate(size);
  std::memcpy(q, p, old_size < size ? old_size : size);
  release(p);
  return q;
}

void gmp_release(void *p, size_t) {
  release(p);
}

__attribute__((constructor)) void choose_functions() {
  void *(*chosen)(size_t);
  mp_get_memory_functions(&chosen, nullptr, nullptr);
  if (chosen == __gmp_default_allocate)
    mp_set_memory_functions(gmp_allocate, gmp_reallocate, gmp_release);
}

} // namespace

/* --- Mpzf ----------------------------------------------------------------- */

void *operator new[](size_t size) {
  void *p = allocate(size);
  return p ? p : throw std::bad_alloc();
}
void operator delete[](void *p) noexcept {
  release(p);
}
void operator delete[](void *p, size_t) noexcept {
  release(p);
}
