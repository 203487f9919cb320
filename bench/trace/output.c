/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/trace/trace.h"

#include <errno.h>
#include <signal.h>
#include <string.h>
#include <unistd.h>

/* --- Signals -------------------------------------------------------------- */

/* The unfinished file, which the handler removes. */
static const char *volatile unfinished;

static void remove_unfinished(int number) {
  if (unfinished)
    unlink(unfinished);
  signal(number, SIG_DFL);
  raise(number);
}

/* Sets a handler. A signal that is ignored, as under nohup, stays ignored. */
static void handle(int number, void (*handler)(int)) {
  struct sigaction before, now = {.sa_handler = handler};
  if (!sigaction(number, NULL, &before) && before.sa_handler == SIG_DFL)
    sigaction(number, &now, NULL);
}

static void handle_signals(void) {
  handle(SIGPIPE, SIG_IGN);
  handle(SIGXFSZ, SIG_IGN);
  handle(SIGINT, remove_unfinished);
  handle(SIGTERM, remove_unfinished);
  handle(SIGHUP, remove_unfinished);
}

/* --- Files ---------------------------------------------------------------- */

static bool ends_in_gz(const char *path) {
  size_t length = strlen(path);
  return length > 3 && !strcmp(path + length - 3, ".gz");
}

/* The compressed stream has a descriptor of its own, which it closes. */
static gzFile open_zipped(FILE *stream) {
  int file = dup(fileno(stream));
  gzFile zipped = file < 0 ? NULL : gzdopen(file, "wb");
  if (!zipped && file >= 0)
    close(file);
  return zipped;
}

enum hsr_status trace_output_open(struct trace_output *output, const char *path,
                                  struct hsr_error *err) {
  *output = (struct trace_output){.path = path};
  if (!strcmp(path, "-")) {
    output->stream = stdout;
    handle_signals();
    return HSR_OK;
  }
  enum hsr_status status = hsr_whole_file_open(&output->file, path, err);
  if (status)
    return status;
  output->stream = output->file.stream;
  unfinished = output->file.part;
  handle_signals();
  if (!ends_in_gz(path))
    return HSR_OK;
  output->zipped = open_zipped(output->stream);
  return output->zipped ? HSR_OK
                        : trace_output_close(output, hsr_fail_nomem(err), err);
}

/* --- Lines ---------------------------------------------------------------- */

/* `code` is zlib's; with Z_ERRNO, errno has the cause. */
static void fail(struct trace_output *output, int code) {
  output->why = errno;
  output->status =
      code == Z_MEM_ERROR || output->why == ENOMEM ? HSR_E_NOMEM : HSR_E_INPUT;
}

/* The state of the compressed stream, if there is one. */
static int code_of(const struct trace_output *output) {
  int code = Z_ERRNO, why = errno;
  if (output->zipped)
    gzerror(output->zipped, &code);
  errno = why;
  return code;
}

/* Writes a piece of a line, for jansson, which stops if this returns -1. */
static int write_piece(const char *text, size_t size, void *context) {
  struct trace_output *output = context;
  if (!size)
    return 0;
  bool written = output->zipped
                     ? gzwrite(output->zipped, text, (unsigned)size) > 0
                     : fwrite(text, 1, size, output->stream) == size;
  if (!written)
    fail(output, code_of(output));
  output->bytes += size;
  return written ? 0 : -1;
}

void trace_output_line(struct trace_output *output, json_t *line) {
  enum { FLAGS = JSON_COMPACT | JSON_ENSURE_ASCII };
  if (!output->status && !line)
    output->status = HSR_E_NOMEM;
  if (!output->status && json_dump_callback(line, write_piece, output, FLAGS) &&
      !output->status)
    output->status = HSR_E_NOMEM; /* every piece was written: jansson failed */
  if (!output->status)
    write_piece("\n", 1, output);
  json_decref(line);
}

/* --- The end -------------------------------------------------------------- */

/* Passes everything that was written to the system. */
static void finish(struct trace_output *output) {
  int code = Z_OK;
  if (output->zipped)
    code = gzclose(output->zipped);
  else if (fflush(output->stream) || ferror(output->stream))
    code = Z_ERRNO;
  output->zipped = NULL;
  if (code != Z_OK && !output->status)
    fail(output, code);
}

static enum hsr_status tell(const struct trace_output *output,
                            struct hsr_error *err) {
  if (output->status == HSR_E_NOMEM)
    return hsr_fail_nomem(err);
  return hsr_fail(err, output->status, "%s: cannot be written: %s",
                  output->file.part ? output->path : "standard output",
                  strerror(output->why));
}

enum hsr_status trace_output_close(struct trace_output *output,
                                   enum hsr_status status,
                                   struct hsr_error *err) {
  finish(output);
  bool keeps = !status || status == HSR_E_DIFFERENCE;
  if (keeps && output->status)
    status = tell(output, err);
  if (!output->file.part)
    return status;
  unfinished = NULL;
  enum hsr_status closed = hsr_whole_file_close(
      &output->file, status == HSR_E_DIFFERENCE ? HSR_OK : status, err);
  return closed ? closed : status;
}
