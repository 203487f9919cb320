/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/files/library.h"

#include <dlfcn.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

/* Only the linker's words tell why it failed: that the file is not there, not
 * one that it needs; or that there is no memory. */
static bool is_missing(const char *file, const char *why) {
  return why && !strncmp(why, file, strlen(file)) &&
         strstr(why, "cannot open shared object");
}
static bool lacks_memory(const char *why) {
  return !why || strstr(why, "memory") || strstr(why, "failed to map");
}

/* A name without a slash is looked for in the program's run path, which is its
 * own folder or that of the build. */
const void *hsr_library_table(const char *file, const char *name,
                              struct hsr_error *err) {
  char installed[1024];
  snprintf(installed, sizeof installed, "%s/hsr/%s", HSR_LIBEXECDIR, file);
  void *library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
  const char *why = library ? NULL : dlerror();
  if (is_missing(file, why)) {
    library = dlopen(installed, RTLD_NOW | RTLD_LOCAL);
    why = library ? NULL : dlerror();
  }
  const void *table = library ? dlsym(library, name) : NULL;
  if (table)
    return table;
  if (library)
    why = dlerror();
  if (lacks_memory(why))
    hsr_fail_nomem(err);
  else
    hsr_fail(err, HSR_E_INPUT, "%s: cannot be loaded: %s", file, why);
  return NULL;
}
