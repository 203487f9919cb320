/* SPDX-License-Identifier: GPL-3.0-or-later */
/* HSR_VECTOR before a function compiles it also for the wider vector units of
 * x86-64; the version is chosen when the program starts. The source is plain C,
 * the portable twin. Every version rounds alike, since nothing is contracted or
 * reordered. The counting build, which is never timed, has that twin only:
 * clang gives the choice a global name, which would then be defined twice. */
#ifndef HSR_COMMON_VECTOR_H
#define HSR_COMMON_VECTOR_H

#include "config.h"

#include "common/base/count.h"

#if HSR_HAVE_TARGET_CLONES && !HSR_COUNTING
#define HSR_VECTOR __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define HSR_VECTOR
#endif

#endif
