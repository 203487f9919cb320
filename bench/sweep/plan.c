/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which cells a sweep has: scenes x views x sizes x algorithms x threads. */
#include "bench/modules/variant.h"
#include "bench/programs/module.h"
#include "bench/sweep/sweep.h"
#include "scenes/scenes.h"

#include <ctype.h>
#include <fnmatch.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* --- Scenes --------------------------------------------------------------- */

/* The name of a file may look like a pattern. */
static bool is_pattern(const char *text) {
  return strpbrk(text, "*?[") && access(text, F_OK);
}

/* Whether records, and the lines of --list, can hold the name. */
static enum hsr_status check_scene_name(const char *name,
                                        struct hsr_error *err) {
  if (strlen(name) > RESULTS_MOST_SCENE)
    return hsr_fail(err, HSR_E_USAGE,
                    "%.100s...: the name is longer than %d bytes", name,
                    (int)RESULTS_MOST_SCENE);
  for (const char *c = name; *c; c++)
    if (iscntrl((unsigned char)*c))
      return hsr_fail(err, HSR_E_USAGE,
                      "%s: the name holds a control character", name);
  json_error_t error;
  json_t *text = json_pack_ex(&error, 0, "s", name);
  json_decref(text);
  if (text)
    return HSR_OK;
  return json_error_code(&error) == json_error_invalid_utf8
             ? hsr_fail(err, HSR_E_USAGE, "%s: the name is not UTF-8", name)
             : hsr_fail_nomem(err);
}

static enum hsr_status add_scene(struct plan *plan, const char *plain,
                                 struct hsr_error *err) {
  char name[MOST_AIMED_NAME];
  enum hsr_status status =
      aim_name(&plan->options->camera, 1, plan->options->m[0],
               plan->options->n[0], plain, name, err);
  if (!status)
    status = check_scene_name(name, err);
  if (status)
    return status;
  for (size_t k = 0; k < plan->n_scenes; k++)
    if (!strcmp(plan->scene[k], name))
      return HSR_OK;
  char **scene = realloc(plan->scene, (plan->n_scenes + 1) * sizeof *scene);
  if (!scene)
    return hsr_fail_nomem(err);
  plan->scene = scene;
  scene[plan->n_scenes] = strdup(name);
  if (!scene[plan->n_scenes])
    return hsr_fail_nomem(err);
  plan->n_scenes++;
  return HSR_OK;
}

/* The built-in scenes that match, and the meshes as mesh:NAME. */
static enum hsr_status add_matching(struct plan *plan, const char *pattern,
                                    struct hsr_error *err) {
  size_t n, found = 0;
  char **mesh;
  enum hsr_status status = hsr_mesh_names(&mesh, &n, err);
  if (status)
    return status;
  for (const struct hsr_builtin *b = hsr_builtins; b->name && !status; b++)
    if (!fnmatch(pattern, b->name, 0)) {
      found++;
      status = add_scene(plan, b->name, err);
    }
  for (size_t k = 0; k < n; k++) {
    char name[300];
    snprintf(name, sizeof name, "mesh:%s", mesh[k]);
    if (!status && !fnmatch(pattern, name, 0)) {
      found++;
      status = add_scene(plan, name, err);
    }
    free(mesh[k]);
  }
  free(mesh);
  if (!status && !found)
    return hsr_fail(err, HSR_E_USAGE, "no scene matches '%.200s'", pattern);
  return status;
}

static enum hsr_status add_scenes(struct plan *plan, struct hsr_error *err) {
  const struct sweep_options *o = plan->options;
  enum hsr_status status = HSR_OK;
  for (int k = 0; k < o->n_scenes && !status; k++)
    status = is_pattern(o->scene[k]) ? add_matching(plan, o->scene[k], err)
                                     : add_scene(plan, o->scene[k], err);
  return status;
}

/* --- Entrants ------------------------------------------------------------- */

static bool is_there(const struct plan *plan, const char *name, long threads) {
  for (int k = 0; k < plan->n_entrants; k++)
    if (!strcmp(plan->entrant[k].name, name) &&
        plan->entrant[k].threads == threads)
      return true;
  return false;
}

/* Adds an entrant for each number of threads; only for one thread if it cannot
 * use more. */
static enum hsr_status add_entrant(struct plan *plan, const char *name,
                                   const struct hsr_variant *variant,
                                   const char *kind, bool single,
                                   struct hsr_error *err) {
  const struct sweep_options *o = plan->options;
  for (int t = 0; t < o->n_threads; t++) {
    long threads = single ? 1 : o->threads[t];
    if (is_there(plan, name, threads))
      continue;
    if (plan->n_entrants == SWEEP_MOST_ENTRANTS)
      return hsr_fail(err, HSR_E_USAGE, "bench: at most %d algorithms",
                      (int)SWEEP_MOST_ENTRANTS);
    struct entrant *entrant = &plan->entrant[plan->n_entrants++];
    *entrant = (struct entrant){.name = name, .kind = kind, .threads = threads};
    if (variant) {
      entrant->listed = variant->listed;
      entrant->choice = variant->choice;
    }
  }
  return HSR_OK;
}

static enum hsr_status add_algorithm(struct plan *plan, const char *name,
                                     const struct hsr_variant *variant,
                                     struct hsr_error *err) {
  const struct hsr_algorithm *a = variant->listed->plain;
  unsigned flags = hsr_choice_flags(a, &variant->choice);
  const struct hsr_answer_type *kind = variant->choice.form.type;
  bool single = (flags & HSR_FRAME_STATE && !program_is(a)) ||
                !(kind->by_windows || hsr_choice_folds(a, &variant->choice));
  return add_entrant(plan, name, variant,
                     flags & HSR_NO_PICTURE ? "none" : kind->name, single, err);
}

static enum hsr_status add_standard(struct plan *plan,
                                    const struct hsr_listed *listed,
                                    struct hsr_error *err) {
  struct hsr_variant variant = hsr_variant_standard(listed);
  return add_algorithm(plan, listed->plain->name, &variant, err);
}

/* One algorithm, with its options, or a program. */
static enum hsr_status add_named(void *plan, const char *name,
                                 struct hsr_error *err) {
  struct hsr_variant variant;
  enum hsr_status status = program_variant_parse(name, &variant, err);
  return status ? status : add_algorithm(plan, name, &variant, err);
}

/* Adds the algorithms whose names match, or one with options. Judges take part
 * only if they are named. */
static enum hsr_status add_algorithms(struct plan *plan, const char *pattern,
                                      struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  bool found = false;
  for (const struct hsr_listed *a = hsr_algorithms(); a->plain && !status; a++)
    if (!fnmatch(pattern, a->plain->name, 0)) {
      found = true;
      status = add_standard(plan, a, err);
    }
  if (status || found)
    return status;
  return program_each(pattern, add_named, plan, err);
}

static enum hsr_status add_peers(struct plan *plan, const char *pattern,
                                 struct hsr_error *err) {
  size_t k, found = 0;
  const json_t *peer;
  enum hsr_status status = HSR_OK;
  json_array_foreach(plan->peers, k, peer) {
    const char *name = json_string_value(json_object_get(peer, "name"));
    if (!name || fnmatch(pattern, name, 0) || status)
      continue;
    found++;
    status = add_entrant(plan, name, NULL, results_text(peer, "kind"),
                         !json_is_true(json_object_get(peer, "threads")), err);
  }
  if (!status && !found)
    return hsr_fail(err, HSR_E_USAGE, "no peer '%.100s'", pattern);
  return status;
}

static enum hsr_status add_entrants(struct plan *plan, struct hsr_error *err) {
  const struct sweep_options *o = plan->options;
  enum hsr_status status = HSR_OK;
  for (int k = 0; k < o->n_algorithms && !status; k++)
    status = add_algorithms(plan, o->algorithm[k], err);
  for (const struct hsr_listed *a = hsr_algorithms();
       !o->n_algorithms && a->plain && !status; a++)
    if (!(a->plain->flags & HSR_JUDGE) && a->plain->subjects & 1u << HSR_FACES)
      status = add_standard(plan, a, err);
  if (status || !o->n_peers)
    return status;
  status = peers_open(plan, err);
  for (int k = 0; k < o->n_peers && !status; k++)
    status = add_peers(plan, o->peer[k], err);
  return status;
}

/* The reference must take part, or be an algorithm that earlier results may
 * hold. */
static enum hsr_status check_reference(const struct plan *plan,
                                       struct hsr_error *err) {
  const char *name = plan->options->reference;
  struct hsr_variant variant;
  for (int k = 0; k < plan->n_entrants; k++)
    if (!strcmp(plan->entrant[k].name, name))
      return HSR_OK;
  return program_variant_parse(name, &variant, err);
}

/* --- The plan ------------------------------------------------------------- */

enum hsr_status plan_init(struct plan *plan,
                          const struct sweep_options *options,
                          struct hsr_error *err) {
  *plan = (struct plan){.options = options};
  program_set_limit((double)options->timeout);
  enum hsr_status status = add_scenes(plan, err);
  if (!status)
    status = add_entrants(plan, err);
  if (!status)
    status = check_reference(plan, err);
  return status;
}

void plan_free(struct plan *plan) {
  for (size_t k = 0; k < plan->n_scenes; k++)
    free(plan->scene[k]);
  free(plan->scene);
  free(plan->peers_program);
  json_decref(plan->peers);
}

size_t plan_places(const struct plan *plan) {
  return plan->n_scenes * (size_t)plan->options->views *
         (size_t)plan->options->n_sizes;
}

struct place plan_place(const struct plan *plan, size_t k) {
  const struct sweep_options *o = plan->options;
  size_t size = k % (size_t)o->n_sizes, rest = k / (size_t)o->n_sizes;
  return (struct place){.scene = plan->scene[rest / (size_t)o->views],
                        .view = 1 + (int)(rest % (size_t)o->views),
                        .walk = (int)o->walk,
                        .m = o->m[size],
                        .n = o->n[size]};
}

void plan_key(const struct place *place, const struct entrant *entrant,
              char key[RESULTS_KEY]) {
  int length = results_picture_key(place->scene, place->view, place->walk,
                                   place->m, place->n, key);
  if (entrant)
    snprintf(key + length, (size_t)(RESULTS_KEY - length), " %.*s %ld",
             (int)RESULTS_MOST_NAME, entrant->name, entrant->threads);
}

bool plan_wants(const struct plan *plan, size_t place,
                const struct entrant *entrant) {
  const struct sweep_options *o = plan->options;
  if ((long)(place % (size_t)o->shards) != o->shard - 1)
    return false;
  if (o->counts && !entrant->listed) /* peers count nothing */
    return false;
  if (!o->only)
    return true;
  struct place at = plan_place(plan, place);
  char key[RESULTS_KEY];
  plan_key(&at, entrant, key);
  return !fnmatch(o->only, key, 0);
}
