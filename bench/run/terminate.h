/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef HSR_BENCH_TERMINATE_H
#define HSR_BENCH_TERMINATE_H

#include <sys/types.h>

#ifdef __cplusplus
extern "C" {
#endif

/* From now on, errors that cannot be returned to a caller end the program with
 * one line instead of an abort. An exception that nothing catches ends it with
 * status 4 if it is for lack of memory, and otherwise with status 5. */
void end_in_one_line(void);

/* Ends the process without the destructors of libraries. In a forked process
 * these would wait for threads that a fork does not copy; after a lack of
 * memory they may find their own data broken. In a build with the leak
 * sanitizer it searches for leaks first. Does not return. */
void end_process(int status);

/* To be called first in a forked process. From now on it is killed when its
 * parent, whose id is given, ends for any reason; and it leaves it to the
 * parent to report a lack of memory. */
void end_with_parent(pid_t parent);

#ifdef __cplusplus
}
#endif
#endif
