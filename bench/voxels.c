/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr voxels: the solids of a scene as voxels. */
#include "bench/client/client.h"
#include "bench/options/command.h"
#include "bench/options/words.h"
#include "bench/results/json.h"
#include "bench/terminal/terminal.h"
#include "common/answers/kinds/voxels.h"

#include <stdlib.h>
#include <string.h>

struct options {
  struct option_base base;
  struct scene_options scene;
  const char *output, *algorithm;
  long size;
  bool json;
};

static error_t parse(int key, char *arg, struct argp_state *state) {
  struct options *o = state->input;
  switch (key) {
  case 'a':
    o->algorithm = arg;
    return 0;
  case 'j':
    o->json = true;
    return 0;
  case 's':
    if (!parse_count(arg, 1, HSR_VOXELS_MOST, &o->size))
      return option_fail(&o->base, "--size %s: must be 1 to %d voxels", arg,
                         HSR_VOXELS_MOST);
    return 0;
  case 'o':
    if (o->output)
      return option_fail(&o->base, "voxels: one -o, not also '%s'", arg);
    o->output = arg;
    return 0;
  default:
    return parse_scene_option(&o->scene, key, arg, "voxels", &o->base);
  }
}

static const struct argp argp = {
    (const struct argp_option[]){
        {"algorithm", 'a', "A", 0,
         "by this algorithm (standard: tiling-solids)", 0},
        {"size", 's', "N", 0,
         "N voxels along the longest side of the scene's box (standard: 64)",
         0},
        {"output", 'o', "FILE", 0,
         "write them as an image of VTK, .vti, for ParaView: cell data `solid'",
         0},
        JSON_ARGP_OPTION,
        SCENE_ARGP_OPTIONS,
        {0}},
    parse,
    "SCENE",
    "Finds which solid of a scene each voxel of a grid is in: by its centre, "
    "exactly, and so that solids that touch share no voxel and leave out none. "
    "Solids are numbered from 1 in the order of their first faces; where they "
    "overlap, the first has the voxel; 0 is none. All faces must be of closed "
    "solids, convex or not.\v"
    "  hsr voxels color-cube --size 100 -o cubes.vti\n"
    "  hsr check color-cube -a tiling-solids:side=100",
    NULL,
    NULL,
    NULL};

/* The answer, and what is told of it. */
struct found {
  const struct options *options;
  struct lib_scene *scene;
  struct lib_answer *counted, *timed; /* by the build that counts, and not */
  struct hsr_answer_info info;        /* of `timed` */
  struct hsr_algorithm_info algorithm;
  struct hsr_voxel_array voxels;
  const uint64_t *count;
  size_t n_counts;
  uint64_t solids, set, surface;
};

static enum hsr_status draw(struct found *found, const char *algorithm,
                            struct hsr_error *err) {
  /* The view is of no account. */
  struct hsr_request request = {
      .size = sizeof request, .algorithm = algorithm, .m = 1, .n = 1};
  enum hsr_status status = hsr_draw(found->scene, &request, &found->timed, err);
  request.counts = 1;
  return status ? status
                : hsr_draw(found->scene, &request, &found->counted, err);
}

static enum hsr_status read(struct found *found, struct hsr_error *err) {
  found->info.size = sizeof found->info;
  found->algorithm.size = sizeof found->algorithm;
  found->voxels.size = sizeof found->voxels;
  enum hsr_status status = hsr_get_answer(found->timed, &found->info, err);
  if (!status)
    status =
        hsr_get_algorithm(found->info.algorithm_number, &found->algorithm, err);
  if (!status)
    status = hsr_get_voxels(found->timed, &found->voxels, err);
  return status ? status
                : hsr_get_counts(found->counted, &found->count,
                                 &found->n_counts, err);
}

/* --- Figures -------------------------------------------------------------- */

/* Solids that have voxels. */
static enum hsr_status count_solids(struct found *found, size_t n,
                                    struct hsr_error *err) {
  const uint32_t *solid = found->voxels.solid;
  uint32_t most = 0;
  for (size_t k = 0; k < n; k++)
    most = solid[k] > most ? solid[k] : most;
  bool *has = calloc((size_t)most + 1, sizeof *has);
  if (!has)
    return hsr_fail_nomem(err);
  for (size_t k = 0; k < n; k++) {
    found->solids += solid[k] && !has[solid[k]];
    has[solid[k]] = true;
  }
  free(has);
  return HSR_OK;
}

static enum hsr_status measure(struct found *found, struct hsr_error *err) {
  const struct hsr_voxel_array *v = &found->voxels;
  struct hsr_solid_voxels voxels = {.grid.n = {v->n[0], v->n[1], v->n[2]},
                                    .solid = (uint32_t *)v->solid};
  hsr_solid_voxels_count(&voxels, &found->set, &found->surface);
  return count_solids(found, hsr_voxel_count(&voxels.grid), err);
}

/* --- Output --------------------------------------------------------------- */

static struct hsr_counter_info counter(const struct found *found, size_t k) {
  struct hsr_counter_info info = {.size = sizeof info};
  hsr_get_counter(found->info.algorithm_number, k, &info, NULL);
  return info;
}

static json_t *counts_json(const struct found *found) {
  json_t *counts = json_object();
  for (size_t k = 0; k < found->n_counts; k++)
    json_object_set_new(counts, counter(found, k).name,
                        json_integer((json_int_t)found->count[k]));
  return counts;
}

static enum hsr_status print_json(const struct found *found,
                                  struct hsr_error *err) {
  const struct hsr_voxel_array *v = &found->voxels;
  return json_print(
      json_pack("{ss ss ss s[iii] s[fff] sf sI sI sI so sf sf}", "schema",
                "hsr-voxels/2", "scene", found->options->scene.name,
                "algorithm", found->algorithm.name, "voxels", v->n[0], v->n[1],
                v->n[2], "origin", v->lo[0], v->lo[1], v->lo[2], "voxel_size",
                v->side, "solids", (json_int_t)found->solids, "set",
                (json_int_t)found->set, "surface", (json_int_t)found->surface,
                "counts", counts_json(found), "prepare_seconds",
                found->info.prepare_seconds, "find_seconds",
                found->info.draw_seconds),
      err);
}

static void print_count(uint64_t count, const char *what) {
  printf("%12llu  %s\n", (unsigned long long)count, what);
}

static void print_text(const struct found *found) {
  const struct hsr_voxel_array *v = &found->voxels;
  char name[TERMINAL_NAME];
  printf("%s, %d x %d x %d voxels of side %g, by %s\n\n",
         terminal_plain(found->options->scene.name, name, sizeof name), v->n[0],
         v->n[1], v->n[2], v->side, found->algorithm.name);
  print_count(found->solids, "solids that have voxels");
  print_count(found->set, "voxels set");
  print_count(found->surface, "of them at a surface");
  for (size_t k = 0; k < found->n_counts; k++)
    print_count(found->count[k], counter(found, k).meaning);
  printf("%12.4g  seconds to prepare\n", found->info.prepare_seconds);
  printf("%12.4g  seconds to find the voxels\n", found->info.draw_seconds);
}

/* --- The command ---------------------------------------------------------- */

static enum hsr_status check(const struct options *o, struct hsr_error *err) {
  struct hsr_algorithm_info info = {.size = sizeof info};
  struct hsr_kind_info kind = {.size = sizeof kind};
  size_t k, length = strcspn(o->algorithm, ":");
  char name[60];
  if (o->output && !HSR_VOXELS->fits(o->output))
    return hsr_fail(err, HSR_E_INPUT, "%s: voxels are written as .vti",
                    o->output);
  snprintf(name, sizeof name, "%.*s", (int)length, o->algorithm);
  enum hsr_status status = hsr_find_algorithm(name, &k, err);
  if (!status)
    status = hsr_get_algorithm(k, &info, err);
  if (!status)
    status = hsr_get_kind(info.kind, &kind, err);
  if (!status && strcmp(kind.name, "voxels") != 0)
    return hsr_fail(err, HSR_E_USAGE, "%s: makes %s, not voxels", o->algorithm,
                    kind.name);
  return status;
}

static enum hsr_status find(struct found *found, struct hsr_error *err) {
  const struct options *o = found->options;
  char algorithm[300];
  int length = o->size
                   ? snprintf(algorithm, sizeof algorithm, "%s:side=%ld",
                              o->algorithm, o->size)
                   : snprintf(algorithm, sizeof algorithm, "%s", o->algorithm);
  if (length >= (int)sizeof algorithm)
    return hsr_fail(err, HSR_E_USAGE, "--algorithm %.40s...: is too long",
                    o->algorithm);
  enum hsr_status status = client_open(&o->scene, NULL, &found->scene, err);
  if (!status)
    status = draw(found, algorithm, err);
  if (!status)
    status = read(found, err);
  if (!status && o->output)
    status = hsr_write(found->timed, o->output, NULL, err);
  return status ? status : measure(found, err);
}

enum hsr_status command_voxels(int argc, char **argv, struct hsr_error *err) {
  struct options options = {.algorithm = "tiling-solids"};
  enum hsr_status status = parse_options(&argp, argc, argv, &options, err);
  if (!status)
    status = check(&options, err);
  if (status)
    return status;
  struct found found = {.options = &options};
  status = find(&found, err);
  if (!status && options.json)
    status = print_json(&found, err);
  else if (!status)
    print_text(&found);
  hsr_free(found.counted);
  hsr_free(found.timed);
  hsr_close(found.scene);
  return status;
}
