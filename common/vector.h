/* SPDX-License-Identifier: GPL-3.0-or-later */
/* HSR_VECTOR before a function: compile it also for the wider vector units of
 * x86-64, and choose when the program starts. The source is plain C, the
 * portable twin; every version rounds alike, since nothing is contracted or
 * reordered. */
#ifndef HSR_COMMON_VECTOR_H
#define HSR_COMMON_VECTOR_H

#include "config.h"

#if HSR_HAVE_TARGET_CLONES
#define HSR_VECTOR                                                             \
  __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define HSR_VECTOR
#endif

#endif
