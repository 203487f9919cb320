/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/files/library.h"

#include <dlfcn.h>
#include <stdio.h>

/* A name without a slash is looked for in the program's run path, which is its
 * own folder or that of the build. */
const void *hsr_library_table(const char *file, const char *name,
                              struct hsr_error *err) {
  char installed[1024];
  snprintf(installed, sizeof installed, "%s/hsr/%s", HSR_LIBEXECDIR, file);
  void *library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
  if (!library)
    library = dlopen(installed, RTLD_NOW | RTLD_LOCAL);
  const void *table = library ? dlsym(library, name) : NULL;
  if (!table)
    hsr_fail(err, HSR_E_INPUT, "%s: cannot be loaded: %s", file, dlerror());
  return table;
}
