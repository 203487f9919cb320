/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "config.h"

#include "common/files/library.h"

#include <dlfcn.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { PATH = 1024 };

/* Only the linker's words tell why it failed: that the file is not there, not
 * one that it needs; or that there is no memory. */
static bool is_missing(const char *file, const char *why) {
  return why && !strncmp(why, file, strlen(file)) &&
         strstr(why, "cannot open shared object");
}
static bool lacks_memory(const char *why) {
  return !why || strstr(why, "memory") || strstr(why, "failed to map");
}

/* The folder of the program or the library that this code is a part of, with a
 * slash at its end; "" if that is not known. Of a program the system says only
 * how it was called. */
static void own_folder(char folder[PATH]) {
  Dl_info info;
  folder[0] = '\0';
  if (dladdr((const void *)&hsr_library_table, &info) && info.dli_fname &&
      info.dli_fname[0] == '/')
    snprintf(folder, PATH, "%s", info.dli_fname);
  else {
    ssize_t n = readlink("/proc/self/exe", folder, PATH - 1);
    folder[n > 0 ? n : 0] = '\0';
  }
  char *slash = strrchr(folder, '/');
  if (slash)
    slash[1] = '\0';
  else
    folder[0] = '\0';
}

/* Where a file is looked for, in this order: in the run path, which is the
 * folder of the program or that of the build; beside the program or library,
 * and where `make install` puts it as seen from there, so that all may be moved
 * together; where it was installed. */
static const char *const places[] = {"",
                                     "%",
                                     "%hsr/",
                                     "%../libexec/hsr/",
                                     "%../../libexec/hsr/",
                                     HSR_LIBEXECDIR "/hsr/"};

/* Opens the file in the first place where it is. NULL: *why says why not. */
static void *open_library(const char *file, const char **why) {
  char path[2 * PATH], folder[PATH];
  void *library = NULL;
  own_folder(folder);
  for (size_t k = 0; k < sizeof places / sizeof *places; k++) {
    const bool is_relative = places[k][0] == '%';
    if (is_relative && !*folder)
      continue;
    snprintf(path, sizeof path, "%s%s%s", is_relative ? folder : "",
             places[k] + is_relative, file);
    library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    *why = library ? NULL : dlerror();
    if (!is_missing(path, *why))
      break;
  }
  return library;
}

enum hsr_status hsr_library_table(const char *file, const char *name,
                                  const void **table, struct hsr_error *err) {
  const char *why = NULL;
  void *library = open_library(file, &why);
  *table = library ? dlsym(library, name) : NULL;
  if (*table)
    return HSR_OK;
  if (library)
    why = dlerror();
  return lacks_memory(why) ? hsr_fail_nomem(err)
                           : hsr_fail(err, HSR_E_INPUT,
                                      "%s: cannot be loaded: %s", file, why);
}
