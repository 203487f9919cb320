/* SPDX-License-Identifier: GPL-3.0-or-later */
/* config.h of the build, but for what WebAssembly has not. */
#ifndef HSR_WEB_CONFIG_H
#define HSR_WEB_CONFIG_H

#include_next <config.h>

#undef HSR_HAVE_TARGET_CLONES
#define HSR_HAVE_TARGET_CLONES 0
#undef HSR_HAVE_VTK
#define HSR_HAVE_VTK 0
#undef HSR_HAVE_WINDOW
#define HSR_HAVE_WINDOW 0
#undef HSR_HAVE_MPI
#define HSR_HAVE_MPI 0
#undef HSR_HAVE_REPORT
#define HSR_HAVE_REPORT 0
#undef HSR_COMPILER
#define HSR_COMPILER "emcc " __VERSION__
#undef HSR_FLAGS
#define HSR_FLAGS "-O3 -msimd128"

#endif
