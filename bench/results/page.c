/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/results/page.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

void find_page(const char *file, char folder[PAGE_FOLDER]) {
  static const char beside[] = "/reports/page";
  ssize_t length =
      readlink("/proc/self/exe", folder, PAGE_FOLDER - sizeof beside);
  folder[length > 0 ? length : 0] = '\0';
  char *slash = strrchr(folder, '/');
  if (slash)
    strcpy(slash, beside);
  char path[PAGE_FOLDER + 64];
  snprintf(path, sizeof path, "%s/%.60s", folder, file);
  if (access(path, R_OK))
    snprintf(folder, PAGE_FOLDER, "%s", HSR_REPORT_DIR);
}

char *base64_text(const void *bytes, size_t n) {
  static const char digit[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const unsigned char *byte = bytes;
  char *text = malloc((n + 2) / 3 * 4 + 1), *at = text;
  if (!text)
    return NULL;
  for (size_t k = 0; k < n; k += 3) {
    size_t left = n - k;
    unsigned group = (unsigned)byte[k] << 16 |
                     (left > 1 ? (unsigned)byte[k + 1] << 8 : 0) |
                     (left > 2 ? (unsigned)byte[k + 2] : 0);
    *at++ = digit[group >> 18];
    *at++ = digit[group >> 12 & 63];
    *at++ = left > 1 ? digit[group >> 6 & 63] : '=';
    *at++ = left > 2 ? digit[group & 63] : '=';
  }
  *at = '\0';
  return text;
}
