/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How a call that can fail reports its failure. */
#ifndef HSR_COMMON_STATUS_H
#define HSR_COMMON_STATUS_H

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(protected) /* for modules: hsr-module.h */

/* The values are the exit statuses of the command. */
enum hsr_status {
  HSR_OK = 0,
  HSR_E_DIFFERENCE = 1, /* a picture differs, or a check failed */
  HSR_E_USAGE = 2,      /* an argument, of a command or a call, is wrong */
  HSR_E_INPUT = 3,      /* a file or a scene cannot be used as it is */
  HSR_E_NOMEM = 4,      /* memory ran out, or a limit was met */
  HSR_E_INTERNAL = 5,   /* a fault of hsr, or of a library below it */
  HSR_E_REFUSED = 6,    /* the algorithm cannot take this scene; the command
                           then exits with 4, as for a limit */
  HSR_E_STOPPED = 7     /* whoever asked for the work stopped it, for the time
                           that it took or for another reason; the command then
                           exits with 4 */
};

/* One failure, as one line. The caller owns it, and may pass NULL wherever a
 * function takes one. A function writes it only if it fails. `text` has no
 * newline. It is "file:line: what is wrong" if a file is at fault, else "what
 * is wrong". */
struct hsr_error {
  enum hsr_status status;
  char text[480];
};

/* Fills *err (unless NULL) from a printf format and returns `status`. Control
 * characters in the result are replaced by '?', so that it stays one line. A
 * longer text than err->text holds is cut off. */
enum hsr_status hsr_fail(struct hsr_error *err, enum hsr_status status,
                         const char *format, ...)
#if defined __GNUC__
    __attribute__((format(printf, 3, 4)))
#endif
    ;

/* Fills *err (unless NULL) with "out of memory" and returns HSR_E_NOMEM. */
enum hsr_status hsr_fail_nomem(struct hsr_error *err);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif
#endif
