/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef HSR_BENCH_TERMINATE_H
#define HSR_BENCH_TERMINATE_H

#include <sys/types.h>

#ifdef __cplusplus
extern "C" {
#endif

/* From now on what no caller can be told of ends the program with one line,
 * instead of an abort: an exception that nothing catches, by status 4 if it is
 * for lack of memory, or 5; and a lack of memory inside GMP, on which CGAL's
 * rational numbers stand, by status 4. */
void end_in_one_line(void);

/* Ends the process, after a search for leaks where the leak sanitizer is there,
 * but without the destructors of libraries: in a forked process they wait for
 * threads that a fork does not bring along, and after a lack of memory they may
 * find their own data broken. Does not return. */
void end_process(int status);

/* Called first in a forked process: from now on it is killed when its parent,
 * of that id, ends in whatever way; and leaves it to him to say that memory was
 * lacking. */
void end_with_parent(pid_t parent);

#ifdef __cplusplus
}
#endif
#endif
