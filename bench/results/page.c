/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/results/page.h"
#include "common/files/whole_file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Where pages are as seen from the command: in the tree that it was built in;
 * where `make install` puts them, so that all may be moved together. */
static const char *const places[] = {"/reports/page", "/../share/hsr/report"};

void find_page(const char *file, char folder[PAGE_FOLDER]) {
  char self[PAGE_FOLDER / 2], path[PAGE_FOLDER + 64];
  ssize_t length = readlink("/proc/self/exe", self, sizeof self - 1);
  self[length > 0 ? length : 0] = '\0';
  char *slash = strrchr(self, '/');
  for (size_t k = 0; slash && k < sizeof places / sizeof *places; k++) {
    *slash = '\0';
    snprintf(folder, PAGE_FOLDER, "%s%s", self, places[k]);
    snprintf(path, sizeof path, "%s/%.60s", folder, file);
    if (!access(path, R_OK))
      return;
  }
  snprintf(folder, PAGE_FOLDER, "%s", HSR_REPORT_DIR);
}

/* Reads all of an open file, and ends it by 0. */
static enum hsr_status read_text(FILE *file, const char *path, char **text,
                                 struct hsr_error *err) {
  long size = fseek(file, 0, SEEK_END) ? -1 : ftell(file);
  rewind(file);
  *text = size < 0 ? NULL : malloc((size_t)size + 1);
  if (size >= 0 && !*text)
    return hsr_fail_nomem(err);
  if (size < 0 || fread(*text, 1, (size_t)size, file) != (size_t)size) {
    free(*text);
    *text = NULL;
    return hsr_fail(err, HSR_E_INPUT, "%.400s: cannot be read", path);
  }
  (*text)[size] = '\0';
  return HSR_OK;
}

enum hsr_status read_built_page(const char *name, char **page,
                                struct hsr_error *err) {
  char folder[PAGE_FOLDER], path[PAGE_FOLDER + 64];
  *page = NULL;
  find_page(name, folder);
  snprintf(path, sizeof path, "%s/%.60s", folder, name);
  FILE *file = fopen(path, "rb");
  if (!file)
    return hsr_fail(err, HSR_E_INPUT,
                    "the page is missing; a build with npm makes it: %.400s: "
                    "%s",
                    path, strerror(errno));
  enum hsr_status status = read_text(file, path, page, err);
  fclose(file);
  return status;
}

enum hsr_status
write_built_page(const char *path, const char *page, const char *mark,
                 enum hsr_status (*put)(const void *context, FILE *out,
                                        struct hsr_error *err),
                 const void *context, struct hsr_error *err) {
  struct hsr_whole_file file;
  const char *here = strstr(page, mark);
  if (!here)
    return hsr_fail(err, HSR_E_INTERNAL, "the page has no '%s'", mark);
  enum hsr_status status = hsr_whole_file_open(&file, path, err);
  if (status)
    return status;
  fwrite(page, 1, (size_t)(here - page), file.stream);
  status = put(context, file.stream, err);
  fputs(here + strlen(mark), file.stream);
  return hsr_whole_file_close(&file, status, err);
}

/* "<" would end the script. */
enum hsr_status put_page_json(const char *id, json_t *value, FILE *out,
                              struct hsr_error *err) {
  char *text =
      value ? json_dumps(value, JSON_COMPACT | JSON_ENSURE_ASCII) : NULL;
  json_decref(value);
  if (!text)
    return hsr_fail_nomem(err);
  fprintf(out, "<script type=\"application/json\" id=\"%s\">", id);
  for (const char *c = text; *c; c++)
    *c == '<' ? fputs("\\u003c", out) : putc(*c, out);
  fputs("</script>\n", out);
  free(text);
  return HSR_OK;
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
