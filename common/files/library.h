/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parts of hsr that need a heavy library. Each is a file of its own, which is
 * loaded when it is first called: what writes no picture loads no
 * OpenImageIO. */
#ifndef HSR_COMMON_LIBRARY_H
#define HSR_COMMON_LIBRARY_H

#include "common/base/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The table of functions `name` in a file, "hsr-images.so": the one beside this
 * program, or else the one that is installed. The file stays loaded. NULL if it
 * cannot be loaded, and *err says why. */
const void *hsr_library_table(const char *file, const char *name,
                              struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
