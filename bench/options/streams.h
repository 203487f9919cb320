/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The name "-": standard input in the place of a file that is read, and standard
 * output in the place of one that is written. Libraries read and write files, of
 * which they know the format by the name. So the bytes pass through a file with
 * such a name, in a folder of their own, which streams_end removes. */
#ifndef HSR_BENCH_OPTIONS_STREAMS_H
#define HSR_BENCH_OPTIONS_STREAMS_H

#include "common/base/status.h"

#include <stdbool.h>
#include <stddef.h>

/* Whether a name stands for standard input or output: "-", or "-.png" with the
 * suffix of a format. */
bool is_stream(const char *name);

/* Copies standard input to a file with this suffix, "obj" or ".obj", and returns
 * the path of the file. The path is valid until streams_end. NULL: it cannot be
 * read or written, and errno says why; EBUSY: it was read already. */
const char *stream_input(const char *suffix);

/* Returns the path of a file to write, of which streams_end copies the bytes to
 * standard output. Its suffix is that of `name`, or else `suffix`, ".png". From
 * now on, all that the program prints goes to standard error. It is valid until
 * streams_end. NULL: errno says why; EBUSY: another file goes there. */
const char *stream_output(const char *name, const char *suffix);

/* Writes a text that may have the paths of such files: "standard input" and
 * "standard output" take their place. Of another file in their folder, which a file
 * on standard input names, its name is left. What does not fit in `size` bytes is
 * cut. Returns `told`. */
const char *streams_tell(const char *text, char *told, size_t size);

/* Ends the streams, and what *err says is as by streams_tell. If `status` is HSR_OK, the output is copied. A pipe that its
 * reader has closed is no error. HSR_E_INPUT: standard output cannot be
 * written. */
enum hsr_status streams_end(enum hsr_status status, struct hsr_error *err);

#endif
