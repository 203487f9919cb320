/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which algorithms would do what this one does not: for errors of hsr render. */
#include "bench/modules/variant.h"
#include "bench/render/render.h"
#include "common/files/suffix.h"

enum { MOST_NAMED = 5 };

/* What is wanted of a kind of answer. */
struct wish {
  int takes;        /* HSR_SHADING, ...; or -1: that it fits `path` */
  const char *path; /* of a drawing */
};

static bool grants(const struct hsr_answer_type *kind,
                   const struct wish *wish) {
  return wish->takes >= 0 ? kind->takes >> wish->takes & 1
                          : kind->fits(wish->path);
}

/* Names of algorithms that draw the kind, with commas between them: the first
 * few. */
static void list_names(const struct hsr_answer_type *kind, char *names,
                       size_t size) {
  size_t used = 0;
  int n = 0;
  for (const struct hsr_listed *l = hsr_algorithms(); l->plain; l++) {
    if (l->plain->flags & HSR_NO_PICTURE)
      continue;
    struct hsr_variant variant = hsr_variant_standard(l);
    for (int k = 0;
         variant.choice.form.type != kind && hsr_makes_besides(l->plain, k);
         k++)
      variant = hsr_variant_also(l, k);
    if (variant.choice.form.type != kind || n++ >= MOST_NAMED || used >= size)
      continue;
    used += (size_t)snprintf(names + used, size - used, "%s%s",
                             n > 1 ? ", " : "", variant.name);
  }
  if (n > MOST_NAMED && used < size)
    snprintf(names + used, size - used, ", ...");
}

static void hint(const struct hsr_variant *variant, const struct wish *wish,
                 char text[MOST_HINT]) {
  const struct hsr_algorithm *a = variant->listed->plain;
  *text = '\0';
  for (int k = 0; hsr_makes_besides(a, k); k++)
    if (grants(hsr_makes_besides(a, k), wish)) {
      snprintf(text, MOST_HINT, "; it is for %s: -a %.150s",
               hsr_makes_besides(a, k)->draws,
               hsr_variant_also(variant->listed, k).name);
      return;
    }
  for (int k = 0; hsr_answer_types[k]; k++) {
    const struct hsr_answer_type *kind = hsr_answer_types[k];
    char names[MOST_HINT - 60] = "";
    if (grants(kind, wish))
      list_names(kind, names, sizeof names);
    if (!*names)
      continue;
    snprintf(text, MOST_HINT, "; it is for %s: -a %s", kind->draws, names);
    return;
  }
}

void hint_taker(const struct hsr_variant *variant, int takes,
                char text[MOST_HINT]) {
  hint(variant, &(struct wish){takes, NULL}, text);
}

void hint_writer(const struct hsr_variant *variant, const char *path,
                 char text[MOST_HINT]) {
  *text = '\0';
  if (hsr_is_line_file(path))
    hint(variant, &(struct wish){-1, path}, text);
}
