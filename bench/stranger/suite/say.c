/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The judgement of a suite, for people and for programs. */
#include "bench/stranger/suite/suite.h"
#include "bench/terminal/terminal.h"
#include "common/files/json/json.h"

#include <stdlib.h>
#include <string.h>

/* --- Text ----------------------------------------------------------------- */

static void say_sum(const struct suite_judgement *j) {
  char name[TERMINAL_NAME], number[TERMINAL_NUMBER];
  printf("%s: %s: %zu right, %zu wrong, %zu missing, %zu unusable\n",
         terminal_plain(j->results, name, sizeof name),
         terminal_number(j->n, "pictures", number), j->state[SUITE_RIGHT],
         j->state[SUITE_WRONG], j->state[SUITE_MISSING],
         j->state[SUITE_UNUSABLE]);
  if (j->compared)
    printf("%llu of %llu samples are wrong (%.3g %%)\n",
           (unsigned long long)j->differing, (unsigned long long)j->compared,
           100.0 * (double)j->differing / (double)j->compared);
}

/* The picture with the most wrong samples of a kind. */
static const struct suite_result *most_of(const struct suite_judgement *j,
                                          int kind) {
  const struct suite_result *most = &j->result[0];
  for (size_t k = 1; k < j->n; k++)
    if (j->result[k].kind[kind] > most->kind[kind])
      most = &j->result[k];
  return most;
}

/* Each kind has a line of figures and one that explains its name. */
static void say_kinds(const struct suite_judgement *j) {
  uint64_t left[STRANGER_KINDS];
  memcpy(left, j->kind, sizeof left);
  if (!j->differing)
    return;
  printf("\n%-28s %8s %8s  %s\n", "kind of fault", "samples", "pictures",
         "most of them in");
  for (;;) {
    const int kind = (int)suite_worst(left);
    if (!left[kind])
      return;
    const struct suite_result *most = most_of(j, kind);
    printf("%-28s %8llu %8zu  %s (%llu)\n", stranger_kinds[kind].key,
           (unsigned long long)left[kind], j->pictures[kind], most->name,
           (unsigned long long)most->kind[kind]);
    terminal_wrap(stdout, printf("    "), 4, stranger_kinds[kind].words);
    left[kind] = 0;
  }
}

/* Pictures of one scene follow one another. */
static size_t scene_end(const struct suite_judgement *j, size_t first) {
  size_t k = first;
  while (k < j->n && !strcmp(j->result[k].scene, j->result[first].scene))
    k++;
  return k;
}

/* The pictures of one scene, and of those that can be judged what is wrong. */
struct scene_sum {
  uint64_t kind[STRANGER_KINDS], differing, compared;
  size_t right, pictures;
};

static struct scene_sum add_up(const struct suite_judgement *j, size_t first,
                               size_t end) {
  struct scene_sum sum = {.pictures = end - first};
  for (size_t k = first; k < end; k++) {
    const struct suite_result *r = &j->result[k];
    sum.right += r->state == SUITE_RIGHT;
    if (r->state == SUITE_MISSING || r->state == SUITE_UNUSABLE)
      continue;
    sum.differing += r->differing;
    sum.compared += r->compared;
    for (int c = 0; c < STRANGER_KINDS; c++)
      sum.kind[c] += r->kind[c];
  }
  return sum;
}

static void say_scene(const char *name, const struct scene_sum *sum) {
  const enum stranger_kind worst = suite_worst(sum->kind);
  const double all = sum->compared ? (double)sum->compared : 1;
  printf("%-28s %4zu of %-4zu %8llu %8.3g", name, sum->right, sum->pictures,
         (unsigned long long)sum->differing,
         100.0 * (double)sum->differing / all);
  if (sum->kind[worst])
    printf("  %s (%llu)", stranger_kinds[worst].key,
           (unsigned long long)sum->kind[worst]);
  putchar('\n');
}

static void say_group(const char *group) {
  char head[80];
  snprintf(head, sizeof head, "scene (%.30s)", group);
  printf("\n%-28s %12s %8s %8s  %s\n", head, "right", "wrong", "%",
         "most of them");
}

static void say_scenes(const struct suite_judgement *j) {
  const char *group = "";
  char number[TERMINAL_NUMBER];
  size_t right = 0;
  if (j->state[SUITE_RIGHT] == j->n)
    return;
  for (size_t k = 0, end; k < j->n; k = end) {
    end = scene_end(j, k);
    const struct scene_sum sum = add_up(j, k, end);
    if (sum.right == sum.pictures) {
      right++;
      continue;
    }
    if (strcmp(group, j->result[k].group))
      say_group(group = j->result[k].group);
    say_scene(j->result[k].scene, &sum);
  }
  printf("\n%s %s right in all pictures, and not listed\n",
         terminal_number(right, "scenes", number), right == 1 ? "is" : "are");
}

static void say_extras(const struct suite_judgement *j) {
  for (enum suite_extra_kind k = SUITE_DEPTHS; k < SUITE_EXTRAS; k++) {
    const struct suite_extra *e = &j->extra[k];
    char number[TERMINAL_NUMBER];
    if (!e->pictures)
      continue;
    printf("%s of %s: %llu of %llu %s are wrong", suite_extra_name(k),
           terminal_number(e->pictures, "pictures", number),
           (unsigned long long)e->differing, (unsigned long long)e->compared,
           suite_extra_places(k));
    if (k == SUITE_DEPTHS)
      printf("; the largest relative error is %.2g", e->largest);
    printf("%s%s\n", e->first ? "; first in " : "", e->first ? e->first : "");
    if (*e->why)
      printf("%s\n", e->why);
  }
}

static void say_files(const struct suite_judgement *j) {
  enum { MOST_SAID = 5 };
  size_t said = 0;
  for (size_t k = 0; k < j->n; k++) {
    const struct suite_result *r = &j->result[k];
    if (r->state != SUITE_MISSING && r->state != SUITE_UNUSABLE)
      continue;
    if (said++ < MOST_SAID)
      printf("%s%s: %s\n", said == 1 ? "\n" : "", r->name,
             r->state == SUITE_MISSING ? "missing" : r->why);
  }
  if (said > MOST_SAID)
    printf("and %zu more that are missing or unusable\n", said - MOST_SAID);
}

void suite_say_text(const struct suite_judgement *j) {
  say_sum(j);
  say_extras(j);
  say_kinds(j);
  say_scenes(j);
  say_files(j);
}

/* --- JSON ----------------------------------------------------------------- */

static json_t *kinds_json(const uint64_t kind[STRANGER_KINDS]) {
  json_t *kinds = json_object();
  for (int k = 0; k < STRANGER_KINDS && kinds; k++)
    if (kind[k] && json_object_set_new(kinds, stranger_kinds[k].key,
                                       json_integer((json_int_t)kind[k]))) {
      json_decref(kinds);
      kinds = NULL;
    }
  return kinds;
}

static json_t *id_json(uint32_t id) {
  return id == HSR_NO_FACE ? json_null() : json_integer(id);
}

/* What there is beside the ids; {} if that is nothing. */
static json_t *extras_json(const struct suite_extra extra[SUITE_EXTRAS]) {
  json_t *made = json_object();
  for (enum suite_extra_kind k = SUITE_DEPTHS; k < SUITE_EXTRAS && made; k++) {
    const struct suite_extra *e = &extra[k];
    if (!e->pictures)
      continue;
    json_t *one =
        *e->why ? json_pack("{ss}", "why", e->why)
                : json_pack("{sI sI}", "compared", (json_int_t)e->compared,
                            "differing", (json_int_t)e->differing);
    if (k == SUITE_DEPTHS && one && !*e->why)
      json_object_set_new(one, "largest_error", json_real(e->largest));
    if (json_object_set_new(made, suite_extra_name(k), one)) {
      json_decref(made);
      made = NULL;
    }
  }
  return made;
}

static json_t *result_json(const struct suite_result *r) {
  static const char *const state[] = {"right", "wrong", "missing", "unusable"};
  const uint32_t m = (uint32_t)r->m;
  json_t *made = json_pack(
      "{ss ss ss ss sI sI so}", "name", r->name, "scene", r->scene, "group",
      r->group, "state", state[r->state], "compared", (json_int_t)r->compared,
      "differing", (json_int_t)r->differing, "kinds", kinds_json(r->kind));
  json_t *more = r->state == SUITE_WRONG
                     ? json_pack("{s[ii] so so}", "first", (int)(r->place % m),
                                 (int)(r->place / m), "got", id_json(r->got),
                                 "wanted", id_json(r->wanted))
                 : r->state == SUITE_UNUSABLE ? json_pack("{ss}", "why", r->why)
                                              : json_object();
  json_t *extras = extras_json(r->extra);
  if (!made || !more || !extras || json_object_update(made, more) ||
      json_object_update(made, extras)) {
    json_decref(made);
    made = NULL;
  }
  json_decref(extras);
  json_decref(more);
  return made;
}

enum hsr_status suite_say_json(const struct suite_judgement *j,
                               struct hsr_error *err) {
  json_t *results = json_array();
  for (size_t k = 0; k < j->n; k++)
    hsr_json_append(&results, result_json(&j->result[k]));
  json_t *all =
      json_pack("{ss ss ss sI sI sI sI sI sI so so}", "schema",
                "hsr-suite-judgement/1", "suite", j->suite, "results",
                j->results, "right", (json_int_t)j->state[SUITE_RIGHT], "wrong",
                (json_int_t)j->state[SUITE_WRONG], "missing",
                (json_int_t)j->state[SUITE_MISSING], "unusable",
                (json_int_t)j->state[SUITE_UNUSABLE], "compared",
                (json_int_t)j->compared, "differing", (json_int_t)j->differing,
                "kinds", kinds_json(j->kind), "pictures", results);
  const bool good = all && !json_dumpf(all, stdout, JSON_INDENT(1));
  if (good)
    putchar('\n');
  json_decref(all);
  return good || ferror(stdout) ? HSR_OK : hsr_fail_nomem(err);
}
