/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/suite/folder.h"
#include "common/files/whole_file.h"

#include <dirent.h>
#include <errno.h>
#include <sha2.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char *const rooms[] = {"scenes", "right"};
enum { N_ROOMS = sizeof rooms / sizeof *rooms };

static enum hsr_status fail(const char *path, struct hsr_error *err) {
  return errno == ENOMEM
             ? hsr_fail_nomem(err)
             : hsr_fail(err, HSR_E_INPUT, "%.300s: cannot be written: %s", path,
                        strerror(errno));
}

/* Whether nothing of this name is in the way. An empty folder is not. */
static enum hsr_status check_free(const char *path, struct hsr_error *err) {
  struct stat is;
  if (stat(path, &is) && errno == ENOENT)
    return HSR_OK;
  DIR *there = opendir(path);
  if (!there)
    return fail(path, err);
  int n = 0;
  while (readdir(there))
    n++;
  closedir(there);
  return n <= 2 ? HSR_OK
                : hsr_fail(err, HSR_E_INPUT,
                           "%.300s: cannot be written: it is not empty", path);
}

static enum hsr_status make_rooms(struct folder *folder,
                                  struct hsr_error *err) {
  char path[4600];
  if (mkdir(folder->part, 0777)) {
    if (errno != EEXIST)
      return fail(folder->path, err);
    return hsr_fail(err, HSR_E_INPUT,
                    "%.300s: another run makes this suite, or one was cut "
                    "off; then remove it",
                    folder->part);
  }
  for (int k = 0; k < N_ROOMS; k++) {
    snprintf(path, sizeof path, "%s/%s", folder->part, rooms[k]);
    if (mkdir(path, 0777))
      return fail(path, err);
  }
  return HSR_OK;
}

static void remove_rooms(const struct folder *folder) {
  char path[4600];
  for (int k = 0; k < N_ROOMS; k++) {
    snprintf(path, sizeof path, "%s/%s", folder->part, rooms[k]);
    rmdir(path);
  }
  rmdir(folder->part);
}

enum hsr_status folder_open(struct folder *folder, const char *path,
                            struct hsr_error *err) {
  *folder = (struct folder){.path = path};
  size_t n = strlen(path);
  while (n > 1 && path[n - 1] == '/')
    n--;
  if (!n || n > 4000)
    return hsr_fail(err, HSR_E_USAGE, "the name of the folder is %s",
                    n ? "too long" : "empty");
  enum hsr_status status = check_free(path, err);
  if (status)
    return status;
  folder->part = malloc(n + sizeof ".part");
  if (!folder->part)
    return hsr_fail_nomem(err);
  memcpy(folder->part, path, n);
  memcpy(folder->part + n, ".part", sizeof ".part");
  status = make_rooms(folder, err);
  if (status) {
    free(folder->part);
    folder->part = NULL;
  }
  return status;
}

const char *folder_file(struct folder *folder, const char *format, ...) {
  const int n =
      snprintf(folder->file, sizeof folder->file, "%s/", folder->part);
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(folder->file + n, sizeof folder->file - (size_t)n, format,
            arguments);
  va_end(arguments);
  const char *name = folder->file + n;
  return hsr_names_add(&folder->files, name, strlen(name)) ? NULL
                                                           : folder->file;
}

const char *folder_name(const struct folder *folder) {
  return folder->files.names[folder->files.n - 1];
}

void folder_forget(struct folder *folder) {
  char path[4600];
  char **last = &folder->files.names[folder->files.n - 1];
  snprintf(path, sizeof path, "%s/%s", folder->part, *last);
  remove(path);
  free(*last);
  folder->files.n--;
}

enum hsr_status folder_json(struct folder *folder, const char *name,
                            json_t *value, struct hsr_error *err) {
  struct hsr_whole_file file;
  const char *path = folder_file(folder, "%s", name);
  enum hsr_status status = value && path ? hsr_whole_file_open(&file, path, err)
                                         : hsr_fail_nomem(err);
  if (!status) {
    const bool bad = json_dumpf(value, file.stream,
                                JSON_INDENT(1) | JSON_REAL_PRECISION(17));
    fputs("\n", file.stream);
    status = bad && !ferror(file.stream) ? hsr_fail_nomem(err) : HSR_OK;
    status = hsr_whole_file_close(&file, status, err);
  }
  json_decref(value);
  return status;
}

/* --- The manifest --------------------------------------------------------- */

static int by_name(const void *a, const void *b) {
  return strcmp(*(char *const *)a, *(char *const *)b);
}

static enum hsr_status list_files(struct folder *folder, json_t **list,
                                  struct hsr_error *err) {
  char path[4600], sum[SHA256_DIGEST_STRING_LENGTH];
  struct stat info;
  qsort(folder->files.names, folder->files.n, sizeof *folder->files.names,
        by_name);
  for (size_t k = 0; k < folder->files.n; k++) {
    const char *name = folder->files.names[k];
    snprintf(path, sizeof path, "%s/%s", folder->part, name);
    if (stat(path, &info) || !SHA256File(path, sum))
      return fail(path, err);
    folder->bytes += (uint64_t)info.st_size;
    json_t *file = json_pack("{ss sI ss}", "name", name, "bytes",
                             (json_int_t)info.st_size, "sha256", sum);
    if (!file || json_array_append_new(*list, file))
      return hsr_fail_nomem(err);
  }
  return HSR_OK;
}

enum hsr_status folder_finish(struct folder *folder, json_t *head,
                              struct hsr_error *err) {
  json_t *list = json_array();
  enum hsr_status status =
      list ? list_files(folder, &list, err) : hsr_fail_nomem(err);
  if (!status && (!head || json_object_set(head, "files", list)))
    status = hsr_fail_nomem(err);
  json_decref(list);
  if (status) {
    json_decref(head);
    return status;
  }
  status = folder_json(folder, "manifest.json", head, err);
  if (!status && rename(folder->part, folder->path))
    status = fail(folder->path, err);
  if (!status) {
    free(folder->part);
    folder->part = NULL;
  }
  return status;
}

void folder_close(struct folder *folder) {
  if (folder->part) {
    while (folder->files.n)
      folder_forget(folder);
    remove_rooms(folder);
  }
  free(folder->part);
  folder->part = NULL;
  hsr_names_free(&folder->files);
}
