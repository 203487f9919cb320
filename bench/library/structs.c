/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Structs that cross the border between the library and a program that may be
 * compiled with another version of hsr.h. */
#include "config.h"

#include "bench/library/library.h"

const char *hsr_version(void) {
  return PACKAGE_VERSION;
}

enum hsr_status lib_null(const char *what, struct hsr_error *err) {
  return hsr_fail(err, HSR_E_USAGE, "%s is NULL", what);
}

/* Version 1 has all that is known, so nothing may be smaller. */
static enum hsr_status check_size(const char *what, size_t size, size_t known,
                                  struct hsr_error *err) {
  return size >= known ? HSR_OK
                       : hsr_fail(err, HSR_E_USAGE,
                                  "%s: size is %zu; it must be %zu or more",
                                  what, size, known);
}

enum hsr_status lib_take(const char *what, void *to, size_t known,
                         const void *from, struct hsr_error *err) {
  size_t size;
  memset(to, 0, known);
  if (!from)
    return HSR_OK;
  memcpy(&size, from, sizeof size);
  enum hsr_status status = check_size(what, size, known, err);
  if (status)
    return status;
  const unsigned char *more = from;
  for (size_t k = known; k < size; k++)
    if (more[k])
      return hsr_fail(
          err, HSR_E_USAGE,
          "%s has members that hsr " PACKAGE_VERSION " does not know", what);
  memcpy(to, from, known);
  return HSR_OK;
}

enum hsr_status lib_give(const char *what, void *to, size_t known,
                         const void *from, struct hsr_error *err) {
  size_t size;
  if (!to)
    return lib_null(what, err);
  memcpy(&size, to, sizeof size);
  enum hsr_status status = check_size(what, size, known, err);
  if (status)
    return status;
  memset((char *)to + sizeof size, 0, size - sizeof size);
  memcpy((char *)to + sizeof size, (const char *)from + sizeof size,
         known - sizeof size);
  return HSR_OK;
}
