/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/options/streams.h"

#include <dirent.h>
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Messages cut a path that is longer than 180 bytes; it would not be known again. */
enum { MOST_FOLDER = 120, MOST_SUFFIX = 40, MOST_PATH = 180 };

/* Of the whole program, as standard input and output are. */
static struct {
  char folder[MOST_FOLDER]; /* "": none is made yet */
  char input[MOST_PATH], output[MOST_PATH];
  int standard_output; /* once output[] is not empty */
} streams;

bool is_stream(const char *name) {
  return name[0] == '-' && (!name[1] || name[1] == '.');
}

static void remove_all(void) {
  if (*streams.input)
    remove(streams.input);
  if (*streams.output)
    remove(streams.output);
  if (*streams.folder)
    rmdir(streams.folder);
  *streams.input = *streams.output = *streams.folder = '\0';
}

/* A format of two files, such as .obj with its .mtl, has only one place. */
static void leave_out_others(void) {
  DIR *folder = *streams.folder ? opendir(streams.folder) : NULL;
  for (struct dirent *entry; folder && (entry = readdir(folder));) {
    char path[MOST_FOLDER + sizeof entry->d_name + 1];
    snprintf(path, sizeof path, "%s/%s", streams.folder, entry->d_name);
    if (*entry->d_name == '.' || !strcmp(path, streams.input) ||
        !strcmp(path, streams.output))
      continue;
    fprintf(stderr,
            "hsr: standard output has no place for '%s', which is left out\n",
            entry->d_name);
    remove(path);
  }
  if (folder)
    closedir(folder);
}

/* Ends as the signal would, with nothing left behind. */
static void leave(int number) {
  remove_all();
  signal(number, SIG_DFL);
  raise(number);
}

static bool make_folder(void) {
  if (*streams.folder)
    return true;
  const char *above = getenv("TMPDIR");
  int n = snprintf(streams.folder, MOST_FOLDER, "%s/hsr-XXXXXX",
                   above && *above ? above : "/tmp");
  if (n >= MOST_FOLDER)
    errno = ENAMETOOLONG;
  if (n >= MOST_FOLDER || !mkdtemp(streams.folder)) {
    *streams.folder = '\0';
    return false;
  }
  signal(SIGINT, leave);
  signal(SIGTERM, leave);
  return true;
}

static bool name_file(char path[MOST_PATH], const char *name,
                      const char *suffix) {
  if (strlen(suffix) > MOST_SUFFIX || strchr(suffix, '/')) {
    errno = EINVAL;
    return false;
  }
  if (!make_folder())
    return false;
  snprintf(path, MOST_PATH, "%s/%s.%s", streams.folder, name,
           suffix + (*suffix == '.'));
  return true;
}

/* Whether a text begins with a path; *text is moved behind it. */
static bool pass(const char **text, const char *path) {
  size_t n = strlen(path);
  bool is = n && !strncmp(*text, path, n);
  *text += is ? n : 0;
  return is;
}

const char *streams_tell(const char *text, char *told, size_t size) {
  size_t used = 0;
  while (*text && used + 1 < size) {
    const char *words = NULL;
    if (pass(&text, streams.input))
      words = "standard input";
    else if (pass(&text, streams.output))
      words = "standard output";
    else if (pass(&text, streams.folder))
      text += *text == '/';
    else
      told[used++] = *text++;
    for (; words && *words && used + 1 < size; words++)
      told[used++] = *words;
  }
  told[used] = '\0';
  return told;
}

static bool copy(FILE *from, FILE *to) {
  char bytes[1 << 16];
  for (size_t n; (n = fread(bytes, 1, sizeof bytes, from)) > 0;)
    if (fwrite(bytes, 1, n, to) != n)
      return false;
  return !ferror(from) && !fflush(to);
}

const char *stream_input(const char *suffix) {
  if (*streams.input) {
    errno = EBUSY;
    return NULL;
  }
  if (!name_file(streams.input, "stdin", suffix))
    return NULL;
  FILE *file = fopen(streams.input, "wb");
  bool good = file && copy(stdin, file);
  int why = errno;
  if (file && fclose(file) && good) {
    good = false;
    why = errno;
  }
  errno = why;
  return good ? streams.input : NULL;
}

const char *stream_output(const char *name, const char *suffix) {
  if (*streams.output) {
    errno = EBUSY;
    return NULL;
  }
  if (!name_file(streams.output, "stdout", name[1] ? name + 1 : suffix))
    return NULL;
  fflush(stdout);
  streams.standard_output = dup(STDOUT_FILENO);
  bool good =
      streams.standard_output >= 0 && dup2(STDERR_FILENO, STDOUT_FILENO) >= 0;
  return good ? streams.output : NULL;
}

/* Copies the output that was asked for. A pipe that is closed is told by errno,
 * not by a signal, which would leave the files. */
static bool deliver(void) {
  signal(SIGPIPE, SIG_IGN);
  FILE *file = fopen(streams.output, "rb"),
       *to = fdopen(streams.standard_output, "wb");
  bool good = file && to && copy(file, to);
  int why = errno;
  if (file)
    fclose(file);
  if (to)
    fclose(to);
  errno = why;
  return good;
}

/* While the paths are known. */
static void tell_error(struct hsr_error *err) {
  char told[sizeof err->text];
  streams_tell(err->text, told, sizeof told);
  memcpy(err->text, told, sizeof told);
}

enum hsr_status streams_end(enum hsr_status status, struct hsr_error *err) {
  bool good = status || !*streams.output || deliver() || errno == EPIPE;
  int why = errno;
  leave_out_others();
  if (!good)
    status = hsr_fail(err, HSR_E_INPUT,
                      "standard output: cannot be written: %s", strerror(why));
  else if (status)
    tell_error(err);
  remove_all();
  return status;
}
