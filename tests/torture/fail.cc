// SPDX-License-Identifier: GPL-3.0-or-later
// Fails one allocation: the one whose number HSR_FAIL_AT gives, counted from 1
// after main began. Linked into hsr by configure --enable-torture, with the
// linker's --wrap for the C functions; operator new is replaced, and jansson is
// given these functions. When the program ends without having come to that
// number, it says so in the file that HSR_FAIL_LOG names.

#include <jansson.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

namespace {

std::atomic<long> count{0};
long fail_at = 0; /* 0: not yet, or never */

bool fails() {
  if (!fail_at || ++count != fail_at)
    return false;
  errno = ENOMEM;
  return true;
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
  const char *at = std::getenv("HSR_FAIL_AT");
  json_set_alloc_funcs(__wrap_malloc, std::free);
  fail_at = at ? std::atol(at) : 0;
  int status = __real_main(argc, argv);
  long last = count;
  long wanted = fail_at;
  fail_at = 0;
  const char *log = std::getenv("HSR_FAIL_LOG");
  if (log && last < wanted)
    if (std::FILE *file = std::fopen(log, "w")) {
      std::fprintf(file, "%ld\n", last);
      std::fclose(file);
    }
  return status;
}

} // extern "C"

void *operator new(size_t size) {
  void *p = fails() ? nullptr : __real_malloc(size ? size : 1);
  if (!p)
    throw std::bad_alloc();
  return p;
}
void *operator new[](size_t size) { return operator new(size); }
void *operator new(size_t size, const std::nothrow_t &) noexcept {
  return fails() ? nullptr : __real_malloc(size ? size : 1);
}
void operator delete(void *p) noexcept { std::free(p); }
void operator delete[](void *p) noexcept { std::free(p); }
void operator delete(void *p, size_t) noexcept { std::free(p); }
void operator delete[](void *p, size_t) noexcept { std::free(p); }
void operator delete(void *p, const std::nothrow_t &) noexcept { std::free(p); }
