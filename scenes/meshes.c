/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef _POSIX_C_SOURCE
#define _POSIX_C_SOURCE 200809L
#endif

#include "scenes/meshes.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

#define MEMBERS "data/meshes/"

/* In the order in which they are tried. */
static const char *const suffixes[] = {".off", ".ply", ".stl", ".obj"};
enum { N_SUFFIXES = sizeof suffixes / sizeof *suffixes, LONGEST_NAME = 100 };

static bool is_name(const char *name) {
  static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                "abcdefghijklmnopqrstuvwxyz0123456789_.+^*-";
  size_t length = strlen(name);
  return length && length <= LONGEST_NAME && name[0] != '.' && name[0] != '-' &&
         strspn(name, letters) == length;
}

/* Length of a mesh file's name without its suffix; 0 if it has none. */
static size_t stem(const char *file) {
  size_t length = strlen(file);
  for (int i = 0; i < N_SUFFIXES; i++)
    if (length > 4 && !strcmp(file + length - 4, suffixes[i]))
      return length - 4;
  return 0;
}

/* a and b in one malloc'ed string. */
static char *join(const char *a, const char *b) {
  size_t n = strlen(a), m = strlen(b);
  char *text = malloc(n + m + 1);
  if (text) {
    memcpy(text, a, n);
    memcpy(text + n, b, m + 1);
  }
  return text;
}

static bool is_file(const char *path) {
  struct stat about;
  return !stat(path, &about) && S_ISREG(about.st_mode);
}

const char *hsr_mesh_folder(void) {
  const char *folder = getenv("HSR_MESH_DIR");
  return folder && *folder ? folder : NULL;
}

/* Makes all folders of an absolute path. */
static enum hsr_status make_folders(char *path, struct hsr_error *err) {
  for (char *slash = path + 1; (slash = strchr(slash, '/')); slash++) {
    *slash = '\0';
    int failed = mkdir(path, 0777) && errno != EEXIST;
    int why = errno;
    if (failed)
      hsr_fail(err, HSR_E_INPUT, "%s: cannot make the folder: %s", path,
               strerror(why));
    *slash = '/';
    if (failed)
      return HSR_E_INPUT;
  }
  return HSR_OK;
}

enum hsr_status hsr_mesh_cache(char **folder, struct hsr_error *err) {
  const char *base = getenv("XDG_CACHE_HOME"), *rest = "/hsr/meshes/";
  if (!base || base[0] != '/') {
    base = getenv("HOME");
    rest = "/.cache/hsr/meshes/";
  }
  if (!base || base[0] != '/')
    return hsr_fail(err, HSR_E_INPUT,
                    "nowhere to keep meshes: set HOME, XDG_CACHE_HOME or "
                    "HSR_MESH_DIR");
  *folder = join(base, rest);
  if (!*folder)
    return hsr_fail_nomem(err);
  enum hsr_status status = make_folders(*folder, err);
  if (status) {
    free(*folder);
    *folder = NULL;
  }
  return status;
}

/* Runs tar on the archive, its output going to `out`: tar's exit status, or -1
 * if it could not be run. */
static int run_tar(const char *mode, const char *member, int out) {
  char *arguments[] = {(char *)"tar", (char *)mode,   (char *)HSR_MESH_ARCHIVE,
                       (char *)"--",  (char *)member, NULL};
  posix_spawn_file_actions_t actions;
  if (posix_spawn_file_actions_init(&actions))
    return -1;
  pid_t child = 0;
  int failed =
      posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0) ||
      posix_spawn_file_actions_adddup2(&actions, out, 1) ||
      posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0) ||
      posix_spawnp(&child, "tar", &actions, NULL, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed)
    return -1;
  int status;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR)
      return -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static enum hsr_status no_tar(struct hsr_error *err) {
  return hsr_fail(err, HSR_E_INPUT, "%s: tar could not be run on it",
                  HSR_MESH_ARCHIVE);
}

static enum hsr_status no_archive(struct hsr_error *err) {
  return hsr_fail(err, HSR_E_INPUT,
                  "%s is not there: install libcgal-demo, or set HSR_MESH_DIR "
                  "to a folder of meshes",
                  HSR_MESH_ARCHIVE);
}

/* Writes a member to the open file `out` and closes it. *size is what came out:
 * nothing where there is no such member. False if it came out broken. */
static bool write_member(const char *member, int out, off_t *size, bool *ran) {
  int answer = run_tar("-xzOf", member, out);
  struct stat about = {0};
  bool whole = !fstat(out, &about) && !answer;
  whole = !close(out) && whole;
  *size = about.st_size;
  *ran = answer >= 0;
  return whole || !about.st_size;
}

/* Takes a member out of the archive, under a temporary name at first, so that
 * a file with its proper name is whole. *found tells whether there is one. */
static enum hsr_status extract_to(const char *member, char *temporary,
                                  const char *path, bool *found,
                                  struct hsr_error *err) {
  int out = mkstemp(temporary);
  if (out < 0)
    return hsr_fail(err, HSR_E_INPUT, "%s: cannot write here: %s", path,
                    strerror(errno));
  off_t size;
  bool ran, good = write_member(member, out, &size, &ran);
  *found = ran && good && size && !rename(temporary, path);
  if (!*found)
    unlink(temporary);
  if (!ran)
    return no_tar(err);
  if (size && !*found)
    return hsr_fail(err, HSR_E_INPUT, "%s: could not be written whole", path);
  return HSR_OK;
}

static enum hsr_status extract(const char *file, const char *path, bool *found,
                               struct hsr_error *err) {
  char *member = join(MEMBERS, file), *temporary = join(path, ".XXXXXX");
  enum hsr_status status = member && temporary
                               ? extract_to(member, temporary, path, found, err)
                               : hsr_fail_nomem(err);
  free(member);
  free(temporary);
  return status;
}

/* The names in a folder that are of meshes. */
static enum hsr_status list_folder(struct hsr_names *list, const char *folder,
                                   struct hsr_error *err) {
  DIR *directory = opendir(folder);
  if (!directory)
    return hsr_fail(err, HSR_E_INPUT, "%s: %s", folder, strerror(errno));
  enum hsr_status status = HSR_OK;
  for (struct dirent *entry; !status && (entry = readdir(directory));)
    if (is_name(entry->d_name) && stem(entry->d_name))
      status = hsr_names_add(list, entry->d_name, strlen(entry->d_name));
  closedir(directory);
  return status ? hsr_fail_nomem(err) : HSR_OK;
}

bool hsr_mesh_is_file(const char *path) {
  const char *name = path + strlen(MEMBERS);
  return !strncmp(path, MEMBERS, strlen(MEMBERS)) && is_name(name) &&
         stem(name);
}

enum hsr_status hsr_mesh_tar(const char *mode, FILE *out,
                             struct hsr_error *err) {
  if (run_tar(mode, MEMBERS, fileno(out)))
    return no_tar(err);
  rewind(out);
  return HSR_OK;
}

static enum hsr_status list_lines(struct hsr_names *list, FILE *file) {
  char line[4096];
  enum hsr_status status = HSR_OK;
  while (!status && fgets(line, sizeof line, file)) {
    line[strcspn(line, "\n")] = '\0';
    const char *name = line + strlen(MEMBERS);
    if (hsr_mesh_is_file(line))
      status = hsr_names_add(list, name, strlen(name));
  }
  return status;
}

static enum hsr_status list_archive(struct hsr_names *list,
                                    struct hsr_error *err) {
  FILE *file = tmpfile();
  if (!file)
    return hsr_fail(err, HSR_E_INPUT, "no temporary file: %s", strerror(errno));
  enum hsr_status status = hsr_mesh_tar("-tzf", file, err);
  if (!status && list_lines(list, file))
    status = hsr_fail_nomem(err);
  fclose(file);
  return status;
}

/* The files of all meshes at hand, in any order. */
static enum hsr_status list_files(struct hsr_names *list,
                                  struct hsr_error *err) {
  if (hsr_mesh_folder())
    return list_folder(list, hsr_mesh_folder(), err);
  return is_file(HSR_MESH_ARCHIVE) ? list_archive(list, err) : HSR_OK;
}

static int compare_names(const void *a, const void *b) {
  return strcmp(*(char *const *)a, *(char *const *)b);
}

/* Cuts suffixes off, sorts, and lets each name stand once. */
static void tidy(struct hsr_names *list) {
  size_t n = 0;
  for (size_t i = 0; i < list->n; i++)
    list->names[i][stem(list->names[i])] = '\0';
  if (list->n)
    qsort(list->names, list->n, sizeof *list->names, compare_names);
  for (size_t i = 0; i < list->n; i++)
    if (n && !strcmp(list->names[n - 1], list->names[i]))
      free(list->names[i]);
    else
      list->names[n++] = list->names[i];
  list->n = n;
}

enum hsr_status hsr_mesh_names(char ***names, size_t *n,
                               struct hsr_error *err) {
  struct hsr_names list = {0};
  *names = NULL;
  *n = 0;
  enum hsr_status status = list_files(&list, err);
  if (status) {
    hsr_names_free(&list);
    return status;
  }
  tidy(&list);
  *names = list.names;
  *n = list.n;
  return HSR_OK;
}

static enum hsr_status no_mesh(const char *name, struct hsr_error *err) {
  struct hsr_names list = {0};
  char hint[256] = "";
  enum hsr_status status = list_files(&list, NULL);
  tidy(&list);
  hsr_names_like(&list, name, hint, sizeof hint);
  hsr_names_free(&list);
  if (status == HSR_E_NOMEM)
    return hsr_fail_nomem(err);
  return hsr_fail(err, HSR_E_INPUT, "there is no mesh %s%s%s", name,
                  hsr_mesh_folder() ? " in HSR_MESH_DIR" : "", hint);
}

/* Looks for one file, in the folder and then in the archive. *path is NULL
 * where there is none. */
static enum hsr_status find_file(const char *folder, const char *file,
                                 bool archive, char **path,
                                 struct hsr_error *err) {
  *path = join(folder, file);
  if (!*path)
    return hsr_fail_nomem(err);
  bool found = is_file(*path);
  enum hsr_status status = HSR_OK;
  if (!found && archive)
    status = extract(file, *path, &found, err);
  if (!found) {
    free(*path);
    *path = NULL;
  }
  return status;
}

/* Tries a name as it is and with each suffix. */
static enum hsr_status find_any(const char *folder, const char *name,
                                bool archive, char **path,
                                struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  *path = NULL;
  if (stem(name))
    return find_file(folder, name, archive, path, err);
  for (int i = 0; i < N_SUFFIXES && !status && !*path; i++) {
    char *file = join(name, suffixes[i]);
    if (!file)
      return hsr_fail_nomem(err);
    status = find_file(folder, file, archive, path, err);
    free(file);
  }
  return status;
}

static enum hsr_status find_in(const char *folder, const char *name,
                               bool archive, char **path,
                               struct hsr_error *err) {
  enum hsr_status status = find_any(folder, name, false, path, err);
  if (status || *path || !archive)
    return status;
  return is_file(HSR_MESH_ARCHIVE) ? find_any(folder, name, true, path, err)
                                   : no_archive(err);
}

enum hsr_status hsr_mesh_find(const char *name, char **path,
                              struct hsr_error *err) {
  *path = NULL;
  if (!is_name(name))
    return hsr_fail(err, HSR_E_INPUT,
                    "mesh:%.100s: not the name of a mesh (letters, digits and "
                    "_.+^*- only)",
                    name);
  char *folder = NULL;
  enum hsr_status status = HSR_OK;
  if (hsr_mesh_folder()) {
    folder = join(hsr_mesh_folder(), "/");
    if (!folder)
      return hsr_fail_nomem(err);
  } else {
    status = hsr_mesh_cache(&folder, err);
  }
  if (!status)
    status = find_in(folder, name, !hsr_mesh_folder(), path, err);
  free(folder);
  if (!status && !*path)
    status = no_mesh(name, err);
  return status;
}
