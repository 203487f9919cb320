/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/options/parser.h"
#include "common/base/names.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

error_t option_fail(struct option_base *base, const char *format, ...) {
  char text[400];
  va_list args;
  va_start(args, format);
  vsnprintf(text, sizeof text, format, args);
  va_end(args);
  hsr_fail(base->err, HSR_E_USAGE, "%s", text);
  base->failed = true;
  return EINVAL;
}

/* --- The words of a command line ------------------------------------------ */

/* A command line whose words are checked, one by one, before argp parses it:
 * argp does not tell which word it cannot read. */
struct words {
  const struct argp *argp;
  const char *command;
  int argc;
  char **argv;
  struct hsr_error *err;
};

static bool is_option(const struct argp_option *o) {
  return o->name || o->key || o->doc;
}

/* "--size MxN,..." of an option that has a long name, as all have. */
static enum hsr_status lacks_value(const struct words *words,
                                   const struct argp_option *o) {
  return hsr_fail(words->err, HSR_E_USAGE, "%s: --%s needs a value: --%s %s",
                  words->command, o->name, o->name, o->arg);
}

/* Makes "did you mean --eye, --near?" of "did you mean eye, near?". */
static void add_dashes(char *hint, size_t size) {
  const char *before = "did you mean ";
  char *name = strstr(hint, before);
  for (size_t n = name ? strlen(before) : 0; n; n = 2) {
    name += n;
    if (strlen(hint) + 2 >= size)
      return;
    memmove(name + 2, name, strlen(name) + 1);
    memcpy(name, "--", 2);
    name = strstr(name, ", ");
    if (!name)
      return;
  }
}

static enum hsr_status no_option(const struct words *words, const char *word) {
  struct hsr_names list = {0};
  char hint[256] = "", name[64], see[64];
  snprintf(name, sizeof name, "%.*s", (int)strcspn(word, "="), word);
  for (const struct argp_option *o = words->argp->options; is_option(o); o++) {
    if (!o->name || o->flags & OPTION_HIDDEN)
      continue;
    if (hsr_names_add(&list, o->name, strlen(o->name)))
      break; /* there is no hint without memory */
  }
  if (!strncmp(name, "--", 2))
    hsr_names_like(&list, name + 2, hint, sizeof hint);
  add_dashes(hint, sizeof hint);
  hsr_names_free(&list);
  snprintf(see, sizeof see, " (see hsr help %s)", words->command);
  return hsr_fail(words->err, HSR_E_USAGE, "%s: there is no option '%s'%s",
                  words->command, name, *hint ? hint : see);
}

/* The option with this long name, or the only one that begins so. NULL: there
 * is none, or several. */
static const struct argp_option *find_long(const struct argp *argp,
                                           const char *name, size_t n) {
  const struct argp_option *found = NULL;
  int several = 0;
  for (const struct argp_option *o = argp->options; is_option(o); o++) {
    if (!o->name || strncmp(o->name, name, n))
      continue;
    if (strlen(o->name) == n)
      return o;
    found = o;
    several++;
  }
  return several == 1 ? found : NULL;
}

static const struct argp_option *find_short(const struct argp *argp, char key) {
  for (const struct argp_option *o = argp->options; is_option(o); o++)
    if (o->name && o->key == key)
      return o;
  return NULL;
}

/* --NAME, --NAME=VALUE or --NAME VALUE. An optional value has the '='. *k is the last word that is read. */
static enum hsr_status check_long(const struct words *words, int *k) {
  const char *word = words->argv[*k];
  size_t n = strcspn(word + 2, "=");
  const struct argp_option *o = find_long(words->argp, word + 2, n);
  if (!o)
    return no_option(words, word);
  bool has_value = word[2 + n] == '=';
  if (!o->arg && has_value)
    return hsr_fail(words->err, HSR_E_USAGE, "%s: --%s takes no value",
                    words->command, o->name);
  if (!o->arg || has_value || o->flags & OPTION_ARG_OPTIONAL)
    return HSR_OK;
  return ++*k < words->argc ? HSR_OK : lacks_value(words, o);
}

/* -x, -xVALUE, -x VALUE, or several letters at once. */
static enum hsr_status check_short(const struct words *words, int *k) {
  for (const char *c = words->argv[*k] + 1; *c; c++) {
    const struct argp_option *o = find_short(words->argp, *c);
    if (!o)
      return no_option(words, (char[]){'-', *c, '\0'});
    if (!o->arg)
      continue;
    if (c[1] || ++*k < words->argc)
      return HSR_OK;
    return lacks_value(words, o);
  }
  return HSR_OK;
}

static enum hsr_status check_words(const struct words *words) {
  enum hsr_status status = HSR_OK;
  for (int k = 1; k < words->argc && !status; k++) {
    const char *word = words->argv[k];
    if (!strcmp(word, "--"))
      break;
    if (!strncmp(word, "--", 2))
      status = check_long(words, &k);
    else if (word[0] == '-' && word[1])
      status = check_short(words, &k);
  }
  return status;
}

/* Prints the help and ends the program, if the command line asks for it. */
static void help_if_asked(const struct argp *argp, int argc, char **argv,
                          char *name) {
  for (int k = 1; k < argc && strcmp(argv[k], "--"); k++)
    if (!strcmp(argv[k], "--help") || !strcmp(argv[k], "-h") ||
        !strcmp(argv[k], "-?")) {
      argp_help(argp, stdout, ARGP_HELP_STD_HELP & ~ARGP_HELP_EXIT_OK, name);
      exit(fflush(stdout) ? HSR_E_INPUT : 0);
    }
}

static void (*look_instead)(const struct argp *argp, int argc,
                            char *const *argv);

void parse_instead(void (*look)(const struct argp *argp, int argc,
                                char *const *argv)) {
  look_instead = look;
}

enum hsr_status parse_options(const struct argp *argp, int argc, char **argv,
                              void *input, struct hsr_error *err) {
  struct option_base *base = input;
  base->err = err;
  base->failed = false;
  if (look_instead) {
    look_instead(argp, argc, argv);
    exit(fflush(stdout) ? HSR_E_INPUT : 0);
  }
  char name[32], *first = argv[0];
  snprintf(name, sizeof name, "hsr %s", first);
  help_if_asked(argp, argc, argv, name);
  struct words words = {argp, first, argc, argv, err};
  if (check_words(&words))
    return HSR_E_USAGE;
  argv[0] = name;
  /* We print the errors. An argp that prints none prints no help either. */
  error_t failed =
      argp_parse(argp, argc, argv, ARGP_NO_ERRS | ARGP_NO_HELP, NULL, input);
  argv[0] = first;
  if (!failed)
    return HSR_OK;
  if (failed == ENOMEM)
    return hsr_fail_nomem(err);
  if (base->failed)
    return HSR_E_USAGE;
  return hsr_fail(err, HSR_E_USAGE, "%s: see hsr help %s", first, first);
}
