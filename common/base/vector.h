/* SPDX-License-Identifier: GPL-3.0-or-later */
/* HSR_VECTOR before a function compiles it several times, also for the wider
 * vector units of x86-64 (AVX2, AVX-512). The program chooses a version when it
 * starts. The source is plain C. Every version rounds alike, since nothing is
 * contracted or reordered. The counting build, which is never timed, has the
 * portable version only. The reason: clang gives the choosing function a global
 * name, and both builds would define it. */
#ifndef HSR_COMMON_VECTOR_H
#define HSR_COMMON_VECTOR_H

#include "config.h"

#include "common/base/count.h"

#if HSR_HAVE_TARGET_CLONES && !HSR_COUNTING
#define HSR_VECTOR __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define HSR_VECTOR
#endif

/* HSR_VECTOR_OF_WORDS(name, (type parameter, ...), (parameter, ...)) { ... }
 * defines a static function that returns nothing, and compiles it for several
 * vector units too. It is for loops over numbers of 8 and 16 bits. For these
 * AVX-512 needs the extension BW, which target_clones of gcc 12 cannot name. */
#if HSR_HAVE_TARGET_CLONES && !HSR_COUNTING
#define HSR_VECTOR_OF_WORDS(name, parameters, arguments)                       \
  static inline __attribute__((always_inline)) void name##_body parameters;    \
  __attribute__((target("avx512bw"))) static void name##_avx512 parameters {   \
    name##_body arguments;                                                     \
  }                                                                            \
  HSR_VECTOR static void name##_narrower parameters {                          \
    name##_body arguments;                                                     \
  }                                                                            \
  static inline void name parameters {                                         \
    if (__builtin_cpu_supports("avx512bw"))                                    \
      name##_avx512 arguments;                                                 \
    else                                                                       \
      name##_narrower arguments;                                               \
  }                                                                            \
  static inline __attribute__((always_inline)) void name##_body parameters
#else
#define HSR_VECTOR_OF_WORDS(name, parameters, arguments)                       \
  static void name parameters
#endif

#endif
