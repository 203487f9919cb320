/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parts of hsr that need a heavy library. Each part is a shared object of its
 * own, which is loaded when it is first needed. So a command that writes no
 * picture does not load OpenImageIO. */
#ifndef HSR_COMMON_LIBRARY_H
#define HSR_COMMON_LIBRARY_H

#include "common/base/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Loads a shared object, as "hsr-images.so". *table becomes the address of its
 * symbol `name`, which is a table of functions; NULL after an error. The file
 * is the one beside this program or library or, if there is none, the one that
 * is installed. It stays loaded. HSR_E_INPUT if it cannot be loaded;
 * HSR_E_NOMEM. */
enum hsr_status hsr_library_table(const char *file, const char *name,
                                  const void **table, struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
