/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/base/status.h"

#include <stdarg.h>
#include <stdio.h>

enum hsr_status hsr_fail(struct hsr_error *err, enum hsr_status status,
                         const char *format, ...) {
  if (!err)
    return status;
  err->status = status;
  va_list args;
  va_start(args, format);
  vsnprintf(err->text, sizeof err->text, format, args);
  va_end(args);
  for (char *c = err->text; *c; c++)
    if ((unsigned char)*c < 0x20 || *c == 0x7f)
      *c = '?';
  return status;
}

enum hsr_status hsr_fail_nomem(struct hsr_error *err) {
  return hsr_fail(err, HSR_E_NOMEM, "out of memory");
}
