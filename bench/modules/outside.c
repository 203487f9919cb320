/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/modules/outside.h"
#include "algorithms/outside/module/hsr-module-version.h"
#include "bench/modules/modules.h"

#include <dlfcn.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Paths, one a line, for the processes that this one starts. */
#define VARIABLE "HSR_MODULES"

/* --- A crash -------------------------------------------------------------- */

static char last_words[1024]; /* what is said then, but for the signal */
static pid_t listener;        /* processes that it forks tell by their status */

/* Tells which modules were loaded, and ends. */
static void tell_crash(int number) {
  char line[] = "hsr: signal NN";
  line[12] = (char)('0' + number / 10);
  line[13] = (char)('0' + number % 10);
  if (getpid() != listener) {
    signal(number, SIG_DFL);
    raise(number);
    return;
  }
  if (write(STDERR_FILENO, line, sizeof line - 1) > 0)
    (void)!write(STDERR_FILENO, last_words, strlen(last_words));
  _exit(HSR_E_INTERNAL);
}

/* A module that crashes takes hsr with it, but not without a word. */
static void listen_for_crash(const char *path) {
  static const int deadly[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
  size_t length = strlen(last_words);
  length -= length > 0; /* the newline */
  snprintf(last_words + length, sizeof last_words - length, "%s %.400s\n",
           length ? "" : ", a crash, with a module from outside:", path);
  listener = getpid();
  for (size_t k = 0; k < sizeof deadly / sizeof *deadly; k++)
    signal(deadly[k], tell_crash);
}

/* --- What may be wrong with it -------------------------------------------- */

static enum hsr_status check_version(void *module, const char *path,
                                     struct hsr_error *err) {
  const char *version = dlsym(module, "hsr_module_version");
  if (!version)
    return hsr_fail(err, HSR_E_INPUT, "%s: not a module of hsr", path);
  return strcmp(version, HSR_MODULE_VERSION)
             ? hsr_fail(err, HSR_E_INPUT,
                        "%s: built for another hsr (%.60s; this is %s): build "
                        "it anew",
                        path, version, HSR_MODULE_VERSION)
             : HSR_OK;
}

/* What its descriptor lacks; NULL: nothing. */
static const char *lack_of(const struct hsr_algorithm *a) {
  return !a                      ? "a descriptor, HSR_ALGORITHM"
         : !a->name || !*a->name ? "a name"
         : !a->title             ? "a title"
         : !a->subjects          ? "subjects"
         : !a->makes[0].kind     ? "what it makes"
         : !a->render            ? "render"
         : a->name[strspn(a->name, "abcdefghijklmnopqrstuvwxyz0123456789-")]
             ? "a name of a to z, 0 to 9 and -"
             : NULL;
}

static enum hsr_status add(const struct hsr_listed *found, const char *path,
                           struct hsr_error *err) {
  const char *lacks = lack_of(found->plain);
  if (!lacks)
    lacks = lack_of(found->counting);
  if (lacks)
    return hsr_fail(err, HSR_E_INPUT, "%s: the module lacks %s", path, lacks);
  switch (hsr_modules_add(found)) {
  case HSR_MODULE_TAKEN:
    return hsr_fail(err, HSR_E_USAGE, "%s: there is a module '%s' already",
                    path, found->plain->name);
  case HSR_MODULE_FULL:
    return hsr_fail(err, HSR_E_USAGE, "%s: at most %d modules are loaded", path,
                    HSR_MOST_OUTSIDE);
  default:
    return HSR_OK;
  }
}

/* --- Loading -------------------------------------------------------------- */

static enum hsr_status load(const char *path, struct hsr_error *err) {
  void *module = dlopen(path, RTLD_NOW | RTLD_LOCAL);
  if (!module)
    return hsr_fail(err, HSR_E_INPUT, "%s", dlerror());
  struct hsr_listed found = {dlsym(module, "hsr_module_plain"),
                             dlsym(module, "hsr_module_counting")};
  enum hsr_status status = check_version(module, path, err);
  if (!status)
    status = add(&found, path, err);
  if (!status)
    listen_for_crash(path);
  return status;
}

/* Tells those that are started later. */
static bool pass_on(const char *path) {
  const char *before = getenv(VARIABLE);
  size_t size = (before ? strlen(before) : 0) + strlen(path) + 2;
  char *all = malloc(size);
  if (!all)
    return false;
  snprintf(all, size, "%s%s%s", before ? before : "", before ? "\n" : "", path);
  bool good = !setenv(VARIABLE, all, 1);
  free(all);
  return good;
}

enum hsr_status outside_load(const char *path, struct hsr_error *err) {
  char *whole = realpath(path, NULL);
  if (!whole)
    return hsr_fail(err, HSR_E_INPUT, "%s: no such file", path);
  enum hsr_status status = load(whole, err);
  if (!status && !pass_on(whole))
    status = hsr_fail_nomem(err);
  free(whole);
  return status;
}

const char *outside_loaded(void) {
  const char *all = getenv(VARIABLE);
  return all ? all : "";
}

enum hsr_status outside_inherit(struct hsr_error *err) {
  const char *before = getenv(VARIABLE);
  char *all = strdup(before ? before : ""), *rest = NULL;
  enum hsr_status status = all ? HSR_OK : hsr_fail_nomem(err);
  for (char *path = all ? strtok_r(all, "\n", &rest) : NULL; path && !status;
       path = strtok_r(NULL, "\n", &rest))
    status = load(path, err);
  free(all);
  return status;
}
