/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How far filters are from the truth: what hsr errors --json printed, with its
 * pictures of where the errors are. A file comes from anywhere, so its pictures
 * are taken only from the folder that it is in. */
#include "bench/report/report.h"

#include "bench/results/json.h"
#include "common/files/json/json_read.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

enum { PATH = 4400, NAME = 64 };

static const char *last_part(const char *path) {
  const char *slash = strrchr(path, '/');
  return slash ? slash + 1 : path;
}

/* Copies the picture into the report, and sets "where" to its place there, or to
 * null if there is none. */
static enum hsr_status copy_picture(const struct report *report,
                                    const char *file, json_t *picture,
                                    int number, size_t k,
                                    struct hsr_error *err) {
  const char *where = json_string_value(json_object_get(picture, "where"));
  char from[PATH], name[NAME];
  const char *path = from;
  size_t folder = (size_t)(last_part(file) - file);
  snprintf(from, sizeof from, "%.*s%.255s", (int)folder, file,
           where ? last_part(where) : "");
  snprintf(name, sizeof name, "errors/%d-%zu.png", number + 1, k + 1);
  bool there = where && folder < PATH - NAME && !access(from, R_OK);
  enum hsr_status status =
      there ? report_join(&path, 1, report->folder, name, err) : HSR_OK;
  if (!status && json_object_set_new(picture, "where",
                                     there ? json_string(name) : json_null()))
    return hsr_fail_nomem(err);
  return status;
}

static size_t read_bytes(void *bytes, size_t most, void *file) {
  return fread(bytes, 1, most, file);
}

static enum hsr_status parse(const char *path, FILE *file, json_t **errors,
                             struct hsr_error *err) {
  bool out_of_memory;
  json_error_t error;
  *errors = hsr_json_read(read_bytes, file, 0, &out_of_memory, &error);
  const char *schema = json_string_value(json_object_get(*errors, "schema"));
  if (!*errors && out_of_memory)
    return hsr_fail_nomem(err);
  return *errors && schema && !strcmp(schema, "hsr-errors/1")
             ? HSR_OK
             : hsr_fail(err, HSR_E_INPUT,
                        "%.200s: not what hsr errors --json prints", path);
}

static enum hsr_status read_file(const char *path, json_t **errors,
                                 struct hsr_error *err) {
  FILE *file = fopen(path, "rb");
  if (!file)
    return hsr_fail(err, HSR_E_INPUT, "%.200s: %s", path, strerror(errno));
  enum hsr_status status = parse(path, file, errors, err);
  fclose(file);
  return status;
}

static enum hsr_status add_file(const struct report *report, int number,
                                json_t **all, struct hsr_error *err) {
  const char *file = report->errors[number];
  json_t *errors = NULL, *picture;
  size_t k;
  enum hsr_status status = read_file(file, &errors, err);
  json_array_foreach(json_object_get(errors, "pictures"), k, picture) {
    if (!status)
      status = copy_picture(report, file, picture, number, k, err);
  }
  if (status)
    json_decref(errors);
  else
    hsr_json_append(all, errors);
  return status;
}

enum hsr_status report_errors(const struct report *report, json_t *data,
                              struct hsr_error *err) {
  json_t *all = json_array();
  enum hsr_status status = HSR_OK;
  for (int k = 0; k < report->n_errors && !status; k++)
    status = add_file(report, k, &all, err);
  if (!status && json_object_set_new(data, "errors", all))
    return hsr_fail_nomem(err);
  if (status)
    json_decref(all);
  return status;
}
