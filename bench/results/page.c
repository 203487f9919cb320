/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/results/page.h"

#include <errno.h>
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

/* All of an open file, ended by 0; NULL if it cannot be read. */
static char *text_of(FILE *file) {
  long size = fseek(file, 0, SEEK_END) ? -1 : ftell(file);
  char *text = size < 0 ? NULL : malloc((size_t)size + 1);
  rewind(file);
  if (!text || fread(text, 1, (size_t)size, file) != (size_t)size) {
    free(text);
    return NULL;
  }
  text[size] = '\0';
  return text;
}

enum hsr_status read_built_page(const char *name, char **page,
                                struct hsr_error *err) {
  char folder[PAGE_FOLDER], path[PAGE_FOLDER + 64];
  *page = NULL;
  find_page(name, folder);
  snprintf(path, sizeof path, "%s/%.60s", folder, name);
  FILE *file = fopen(path, "rb");
  if (!file)
    return hsr_fail(err, HSR_E_INPUT, "%.400s: %s", path, strerror(errno));
  *page = text_of(file);
  fclose(file);
  return *page ? HSR_OK
               : hsr_fail(err, HSR_E_INPUT, "%.400s: cannot be read", path);
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
