/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/options/complete.h"
#include "bench/modules/modules.h"
#include "common/grids/palette.h"
#include "scenes/scenes.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_WORD = 400 };

/* The unfinished word: what of it stays, and what is offered for the rest. */
struct begun {
  char stays[MOST_WORD]; /* "watkins," of "watkins,rom" */
  const char *rest;      /* "rom" */
};

static void divide(const char *word, size_t n, struct begun *begun) {
  snprintf(begun->stays, sizeof begun->stays, "%.*s", (int)n, word);
  begun->rest = word + n;
}

/* Offers a word of n letters in the place of the rest. */
static void offer(const struct begun *begun, const char *word, size_t n) {
  size_t length = strlen(begun->rest);
  if (n >= length && !strncmp(word, begun->rest, length))
    printf("%s%.*s\n", begun->stays, (int)n, word);
}

void complete_offer(const char *begun, const char *word) {
  struct begun whole;
  divide(begun, 0, &whole);
  offer(&whole, word, strlen(word));
}

/* Makes what comes before the last comma stay. */
static void keep_list(struct begun *begun) {
  const char *comma = strrchr(begun->rest, ',');
  if (!comma)
    return;
  size_t used = strlen(begun->stays);
  snprintf(begun->stays + used, sizeof begun->stays - used, "%.*s",
           (int)(comma + 1 - begun->rest), begun->rest);
  begun->rest = comma + 1;
}

/* --- Values --------------------------------------------------------------- */

/* Meshes lie in an archive, which takes a while to read: only a word that begins
 * so asks for their names. */
static void offer_scenes(const struct begun *begun) {
  static const char of_meshes[] = "mesh:";
  for (const struct hsr_builtin *b = hsr_builtins; b->name; b++)
    offer(begun, b->name, strlen(b->name));
  if (strncmp(begun->rest, of_meshes, sizeof of_meshes - 1) != 0) {
    offer(begun, of_meshes, sizeof of_meshes - 1);
    return;
  }
  char **name = NULL, mesh[MOST_WORD];
  size_t n = 0;
  struct hsr_error err;
  if (hsr_mesh_names(&name, &n, &err))
    return;
  for (size_t k = 0; k < n; k++) {
    snprintf(mesh, sizeof mesh, "mesh:%s", name[k]);
    offer(begun, mesh, strlen(mesh));
    free(name[k]);
  }
  free(name);
}

/* "x-list=tree", and of a number "window=". */
static void offer_option(const struct begun *begun,
                         const struct hsr_option *option) {
  char word[MOST_WORD];
  if (!option->words) {
    snprintf(word, sizeof word, "%s=", option->name);
    offer(begun, word, strlen(word));
  }
  for (const struct hsr_word *w = option->words; w && w->name; w++) {
    snprintf(word, sizeof word, "%s=%s", option->name, w->name);
    offer(begun, word, strlen(word));
  }
}

static void offer_options(const struct begun *begun,
                          const struct hsr_algorithm *a) {
  for (const struct hsr_option *o = a->options; o && o->name; o++)
    offer_option(begun, o);
  if (hsr_own_kind(a)->by_windows)
    offer(begun, "window=", strlen("window="));
  for (int k = 0; hsr_answer_types[k]; k++)
    if (hsr_can_draw(a, hsr_answer_types[k]))
      for (const struct hsr_option *o = hsr_answer_types[k]->options;
           o && o->name; o++)
        offer_option(begun, o);
}

/* An algorithm, or after its name and a colon, an option. */
static void offer_algorithms(const struct begun *begun) {
  const size_t n = strcspn(begun->rest, ":");
  for (const struct hsr_listed *l = hsr_algorithms(); l->plain; l++) {
    const char *name = l->plain->name;
    if (!begun->rest[n]) {
      offer(begun, name, strlen(name));
    } else if (strlen(name) == n && !strncmp(name, begun->rest, n)) {
      const char *last = strrchr(begun->rest, ':');
      struct begun option = {.rest = last + 1};
      snprintf(option.stays, sizeof option.stays, "%.200s%.*s", begun->stays,
               (int)(last + 1 - begun->rest), begun->rest);
      offer_options(&option, l->plain);
    }
  }
}

/* WORD|WORD|...: the words that are written small. */
static void offer_words(const struct begun *begun, const char *words) {
  while (*words) {
    size_t n = strcspn(words, "|");
    if (islower((unsigned char)*words))
      offer(begun, words, strcspn(words, "|,"));
    words += n + (words[n] == '|');
  }
}

static bool is_one_of(const char *name, const char *const *names) {
  for (; *names; names++)
    if (!strcmp(name, *names))
      return true;
  return false;
}

/* The value of an option. */
static void offer_value(const struct argp_option *o, struct begun *begun) {
  static const char *const of_algorithms[] = {"algorithm", "algorithms", "fill",
                                              "reference", NULL};
  if (!o->arg)
    return;
  if (strchr(o->arg, ','))
    keep_list(begun);
  if (is_one_of(o->name, of_algorithms)) {
    offer_algorithms(begun);
  } else if (!strcmp(o->name, "palette")) {
    for (const struct hsr_palette_name *p = hsr_palette_names; p->name; p++)
      offer(begun, p->name, strlen(p->name));
    puts(":files .json");
  } else if (!strcmp(o->arg, "SCENE")) {
    offer_scenes(begun);
    puts(":files");
  } else {
    offer_words(begun, o->arg);
    if (strstr(o->arg, "FILE") || strstr(o->arg, "DIR"))
      puts(":files");
  }
}

/* --- Options -------------------------------------------------------------- */

static bool is_option(const struct argp_option *o) {
  return o->name || o->key || o->doc;
}

/* The option --NAME of n letters, or -K. */
static const struct argp_option *find(const struct argp *argp, const char *name,
                                      size_t n, int key) {
  for (const struct argp_option *o = argp->options; is_option(o); o++)
    if (o->name && (key ? o->key == key
                        : strlen(o->name) == n && !strncmp(o->name, name, n)))
      return o;
  return NULL;
}

/* The option whose value follows this word, or NULL. */
static const struct argp_option *asks_for_value(const struct argp *argp,
                                                const char *word) {
  const struct argp_option *o = NULL;
  if (!strncmp(word, "--", 2) && !strchr(word, '='))
    o = find(argp, word + 2, strlen(word + 2), 0);
  else if (word[0] == '-' && word[1] && word[1] != '-' && !word[2])
    o = find(argp, NULL, 0, word[1]);
  return o && o->arg && !(o->flags & OPTION_ARG_OPTIONAL) ? o : NULL;
}

static void offer_names(const struct argp *argp, const char *word) {
  char name[80];
  for (const struct argp_option *o = argp->options; is_option(o); o++) {
    if (!o->name || o->flags & OPTION_HIDDEN)
      continue;
    snprintf(name, sizeof name, "--%s", o->name);
    complete_offer(word, name);
  }
  complete_offer(word, "--help");
}

static void offer_argument(const struct argp *argp, const char *word) {
  const char *takes = argp->args_doc;
  struct begun begun;
  divide(word, 0, &begun);
  if (!takes)
    return;
  if (strstr(takes, "SCENE"))
    offer_scenes(&begun);
  if (strstr(takes, "ALGORITHM"))
    offer_algorithms(&begun);
  else
    puts(":files");
}

void complete_words(const struct argp *argp, int n, char *const *words) {
  const char *word = words[n - 1];
  const struct argp_option *before = NULL;
  for (int k = 1; k < n - 1; k++) /* a value is no option */
    before = before ? NULL : asks_for_value(argp, words[k]);
  struct begun begun;
  const size_t name = strcspn(word, "=");
  if (before) {
    divide(word, 0, &begun);
    offer_value(before, &begun);
  } else if (!strncmp(word, "--", 2) && word[name]) {
    const struct argp_option *o = find(argp, word + 2, name - 2, 0);
    divide(word, name + 1, &begun);
    if (o)
      offer_value(o, &begun);
  } else if (word[0] == '-') {
    offer_names(argp, word);
  } else {
    offer_argument(argp, word);
  }
}
