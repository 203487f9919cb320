/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How many faces mesh files say that they have. */
#ifndef _POSIX_C_SOURCE
#define _POSIX_C_SOURCE 200809L
#endif

#include "common/files/whole_file.h"
#include "scenes/meshes.h"

#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* A part of an open file: what is left of it to read. */
struct part {
  FILE *in;
  long long left;
};

/* Reads the next line, or as much of it as has room. False at the end. */
static bool next_line(struct part *part, char *line, int size) {
  if (part->left <= 0 || !fgets(line, size, part->in))
    return false;
  part->left -= (long long)strlen(line);
  return true;
}

/* OFF, or COFF and so on; then, on this line or later ones, the numbers of
 * vertices and faces. */
static uint64_t count_off(struct part *part) {
  char line[256];
  bool begun = false;
  for (int numbers = 0; next_line(part, line, sizeof line);) {
    char *at = line;
    line[strcspn(line, "#")] = '\0';
    char *word = begun ? NULL : strstr(line, "OFF");
    at = word ? word + strlen("OFF") : line;
    begun |= word != NULL;
    for (char *end = at;; at = end) {
      const unsigned long long number = strtoull(at, &end, 10);
      if (end == at)
        break;
      if (++numbers == 2)
        return number;
    }
    if (strstr(at, "BINARY"))
      break;
  }
  return 0;
}

static uint64_t count_ply(struct part *part) {
  char line[256];
  unsigned long long n = 0;
  while (next_line(part, line, sizeof line) &&
         strncmp(line, "end_header", strlen("end_header")) != 0)
    if (sscanf(line, "element face %llu", &n) == 1)
      return n;
  return 0;
}

/* Lines that begin with a word. */
static uint64_t count_lines(struct part *part, const char *word) {
  char line[4096];
  const size_t n = strlen(word);
  uint64_t found = 0;
  for (bool begins = true; next_line(part, line, sizeof line);) {
    const char *at = line + strspn(line, " \t");
    found += begins && !strncmp(at, word, n) && isspace((unsigned char)at[n]);
    begins = strchr(line, '\n');
  }
  return found;
}

/* A binary file has 80 bytes, the number of faces, and 50 bytes for each. */
static uint64_t count_stl(struct part *part) {
  unsigned char head[84];
  const long start = ftell(part->in);
  if (part->left >= (long long)sizeof head &&
      fread(head, sizeof head, 1, part->in) == 1) {
    const uint64_t n = head[80] | (uint64_t)head[81] << 8 |
                       (uint64_t)head[82] << 16 | (uint64_t)head[83] << 24;
    if (part->left == (long long)(sizeof head + 50 * n))
      return n;
  }
  return fseek(part->in, start, SEEK_SET) ? 0 : count_lines(part, "facet");
}

/* The faces of a file, which begins here. 0: it does not say. */
static uint64_t count_faces(const char *file, FILE *in, long long size) {
  struct part part = {in, size};
  const char *suffix = strrchr(file, '.');
  return !suffix                   ? 0
         : !strcmp(suffix, ".off") ? count_off(&part)
         : !strcmp(suffix, ".ply") ? count_ply(&part)
         : !strcmp(suffix, ".stl") ? count_stl(&part)
                                   : count_lines(&part, "f");
}

/* --- In a folder ---------------------------------------------------------- */

static enum hsr_status count_in_folder(char *const *names, size_t n,
                                       uint64_t *faces, struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  for (size_t k = 0; k < n && !status; k++) {
    char *path;
    status = hsr_mesh_find(names[k], &path, err);
    FILE *in = status ? NULL : fopen(path, "rbe");
    if (in && !fseek(in, 0, SEEK_END)) {
      const long size = ftell(in);
      rewind(in);
      faces[k] = count_faces(path, in, size);
    }
    if (in)
      fclose(in);
    free(path);
  }
  return status;
}

/* --- In the archive ------------------------------------------------------- */

static int compare(const void *name, const void *entry) {
  return strcmp(name, *(char *const *)entry);
}

/* A line of tar's list. False: it is none of a file. */
static bool read_member(const char *line, long long *size, const char **path) {
  int at = -1;
  return line[0] == '-' &&
         sscanf(line, "%*s %*s %lld %*s %*s %n", size, &at) == 1 && at >= 0 &&
         *(*path = line + at);
}

/* Takes the members one after the other, as they follow in `all`. */
static void count_members(FILE *list, FILE *all, char *const *names, size_t n,
                          uint64_t *faces) {
  char line[4096];
  long at = 0;
  while (fgets(line, sizeof line, list)) {
    long long size;
    const char *path;
    line[strcspn(line, "\n")] = '\0';
    if (!read_member(line, &size, &path))
      continue;
    char name[sizeof line];
    const char *file = strrchr(path, '/') ? strrchr(path, '/') + 1 : path;
    snprintf(name, sizeof name, "%s", file);
    if (hsr_mesh_is_file(path)) {
      name[strlen(name) - strlen(".off")] = '\0';
      char *const *found = bsearch(name, names, n, sizeof *names, compare);
      /* Of files of one name, .off is the one that is taken. */
      if (found && (!faces[found - names] || strstr(file, ".off")) &&
          !fseek(all, at, SEEK_SET))
        faces[found - names] = count_faces(file, all, size);
    }
    at += (long)size;
  }
}

static enum hsr_status count_in_archive(char *const *names, size_t n,
                                        uint64_t *faces,
                                        struct hsr_error *err) {
  FILE *list = tmpfile(), *all = tmpfile();
  enum hsr_status status = HSR_OK;
  if (!list || !all)
    status =
        hsr_fail(err, HSR_E_INPUT, "no temporary file: %s", strerror(errno));
  if (!status)
    status = hsr_mesh_tar("-tvzf", list, err);
  if (!status)
    status = hsr_mesh_tar("-xzOf", all, err);
  if (!status)
    count_members(list, all, names, n, faces);
  if (list)
    fclose(list);
  if (all)
    fclose(all);
  return status;
}

/* --- Kept ----------------------------------------------------------------- */

/* The file that keeps the counts of the archive, so that it is unpacked once:
 * lines "NAME FACES". malloc'ed; NULL: there is no place for it. */
static char *name_of_kept(void) {
  static const char file[] = "faces.txt";
  char *folder, *path;
  if (hsr_mesh_cache(&folder, NULL))
    return NULL;
  path = realloc(folder, strlen(folder) + sizeof file);
  if (path)
    strcat(path, file);
  else
    free(folder);
  return path;
}

/* Whether the counts of all meshes are kept, and the archive is older. */
static bool find_kept(const char *path, char *const *names, size_t n,
                      uint64_t *faces) {
  struct stat kept, archive;
  char name[128];
  const char *const key = name;
  unsigned long long count;
  size_t found = 0;
  FILE *in = fopen(path, "re");
  if (in && !fstat(fileno(in), &kept) && !stat(HSR_MESH_ARCHIVE, &archive) &&
      kept.st_mtime > archive.st_ctime)
    while (fscanf(in, "%127s %llu", name, &count) == 2) {
      char *const *at = bsearch(key, names, n, sizeof *names, compare);
      if (at)
        faces[at - names] = count;
      found += at != NULL;
    }
  if (in)
    fclose(in);
  return found == n;
}

/* If that fails, the archive is unpacked again the next time. */
static void keep(const char *path, char *const *names, size_t n,
                 const uint64_t *faces) {
  struct hsr_whole_file file;
  if (hsr_whole_file_open(&file, path, NULL))
    return;
  for (size_t k = 0; k < n; k++)
    fprintf(file.stream, "%s %llu\n", names[k], (unsigned long long)faces[k]);
  hsr_whole_file_close(&file, HSR_OK, NULL);
}

static enum hsr_status count_kept(char *const *names, size_t n, uint64_t *faces,
                                  struct hsr_error *err) {
  char *path = name_of_kept();
  enum hsr_status status = HSR_OK;
  if (!path || !find_kept(path, names, n, faces)) {
    memset(faces, 0, n * sizeof *faces);
    status = count_in_archive(names, n, faces, err);
    if (path && !status)
      keep(path, names, n, faces);
  }
  free(path);
  return status;
}

enum hsr_status hsr_mesh_faces(char *const *names, size_t n, uint64_t *faces,
                               struct hsr_error *err) {
  memset(faces, 0, n * sizeof *faces);
  return !n                  ? HSR_OK
         : hsr_mesh_folder() ? count_in_folder(names, n, faces, err)
                             : count_kept(names, n, faces, err);
}
