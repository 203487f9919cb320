/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr voxels: the solids of a scene as voxels. */
#include "bench/modules/variant.h"
#include "bench/options/command.h"
#include "bench/options/scene.h"
#include "bench/options/words.h"
#include "bench/run/crew.h"
#include "bench/terminal/terminal.h"
#include "bench/results/json.h"
#include "common/answers/kinds/voxels.h"

#include <stdlib.h>

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
  struct hsr_scene *scene;
  struct hsr_world world;
  struct hsr_answer answer;
  struct hsr_tally tally; /* of the counting build */
  uint64_t solids, set, surface;
  double prepare_seconds, find_seconds; /* of the build that does not count */
};

/* By one build of the algorithm. */
static enum hsr_status run(struct found *found,
                           const struct hsr_algorithm *algorithm,
                           const struct hsr_choice *choice,
                           struct hsr_tally *tally, struct hsr_error *err) {
  struct hsr_setup setup;
  struct hsr_view view; /* of no account */
  enum hsr_status status =
      hsr_view_init(&view, &found->scene->views[0], 1, 1, err);
  if (status)
    return status;
  status = hsr_setup_init(&setup, algorithm, choice, &found->world, err);
  found->prepare_seconds = setup.prepare_seconds;
  if (!status)
    status = answer_init(&found->answer, &setup, &view, err);
  if (!status)
    status = render_view(&setup, &view, 1, &found->answer, tally,
                         &found->find_seconds, err);
  hsr_setup_free(&setup);
  return status;
}

static enum hsr_status find(struct found *found,
                            const struct hsr_variant *variant,
                            struct hsr_error *err) {
  struct hsr_tally none = {.out_of_memory = false};
  const struct hsr_listed *listed = variant->listed;
  enum hsr_status status =
      run(found, listed->counting, &variant->choice, &found->tally, err);
  if (status)
    return status;
  hsr_answer_free(&found->answer);
  return run(found, listed->plain, &variant->choice, &none, err);
}

/* Solids that have voxels. */
static enum hsr_status count_solids(const struct hsr_solid_voxels *voxels,
                                    uint64_t *solids, struct hsr_error *err) {
  size_t n = hsr_voxel_count(&voxels->grid);
  uint32_t most = 0;
  for (size_t k = 0; k < n; k++)
    most = voxels->solid[k] > most ? voxels->solid[k] : most;
  bool *has = calloc((size_t)most + 1, sizeof *has);
  if (!has)
    return hsr_fail_nomem(err);
  *solids = 0;
  for (size_t k = 0; k < n; k++) {
    uint32_t solid = voxels->solid[k];
    *solids += solid && !has[solid];
    has[solid] = true;
  }
  free(has);
  return HSR_OK;
}

static enum hsr_status measure(struct found *found, struct hsr_error *err) {
  const struct hsr_solid_voxels *v = hsr_answer_voxels_of(&found->answer);
  hsr_solid_voxels_count(v, &found->set, &found->surface);
  return count_solids(v, &found->solids, err);
}

static json_t *counts_json(const struct hsr_algorithm *a,
                           const struct hsr_tally *tally) {
  json_t *counts = json_object();
  for (int k = 0; a->counters && a->counters[k].name; k++)
    json_object_set_new(counts, a->counters[k].name,
                        json_integer((json_int_t)tally->count[k]));
  return counts;
}

static enum hsr_status print_json(const struct hsr_algorithm *a,
                                  const struct found *found,
                                  struct hsr_error *err) {
  const struct hsr_voxel_grid *g = &hsr_answer_voxels_of(&found->answer)->grid;
  return json_print(
      json_pack("{ss ss ss s[iii] s[fff] sf sI sI sI so sf sf}", "schema",
                "hsr-voxels/2", "scene", found->options->scene.name,
                "algorithm", a->name, "voxels", g->n[0], g->n[1], g->n[2],
                "origin", g->lo[0], g->lo[1], g->lo[2], "voxel_size", g->size,
                "solids", (json_int_t)found->solids, "set",
                (json_int_t)found->set, "surface", (json_int_t)found->surface,
                "counts", counts_json(a, &found->tally), "prepare_seconds",
                found->prepare_seconds, "find_seconds", found->find_seconds),
      err);
}

static void print_count(uint64_t count, const char *what) {
  printf("%12llu  %s\n", (unsigned long long)count, what);
}

static void print_text(const struct hsr_algorithm *a,
                       const struct found *found) {
  const struct hsr_voxel_grid *g = &hsr_answer_voxels_of(&found->answer)->grid;
  char name[TERMINAL_NAME];
  printf("%s, %d x %d x %d voxels of side %g, by %s\n\n",
         terminal_plain(found->options->scene.name, name, sizeof name), g->n[0],
         g->n[1], g->n[2], g->size, a->name);
  print_count(found->solids, "solids that have voxels");
  print_count(found->set, "voxels set");
  print_count(found->surface, "of them at a surface");
  for (int k = 0; a->counters && a->counters[k].name; k++)
    print_count(found->tally.count[k], a->counters[k].meaning);
  printf("%12.4g  seconds to prepare\n", found->prepare_seconds);
  printf("%12.4g  seconds to find the voxels\n", found->find_seconds);
}

static enum hsr_status tell(const struct hsr_algorithm *a, struct found *found,
                            struct hsr_error *err) {
  const struct options *o = found->options;
  struct hsr_showing showing = {.world = &found->world, .scene = o->scene.name};
  enum hsr_status status = HSR_OK;
  if (o->output)
    status = HSR_VOXELS->write(&found->answer, &showing, NULL, o->output, err);
  if (!status)
    status = measure(found, err);
  if (status)
    return status;
  if (o->json)
    return print_json(a, found, err);
  print_text(a, found);
  return HSR_OK;
}

static enum hsr_status check_output(const char *path, struct hsr_error *err) {
  if (!path || HSR_VOXELS->fits(path))
    return HSR_OK;
  return hsr_fail(err, HSR_E_INPUT, "%s: voxels are written as .vti", path);
}

static enum hsr_status choose(const struct options *o,
                              struct hsr_variant *variant,
                              struct hsr_error *err) {
  enum hsr_status status = hsr_variant_parse(o->algorithm, variant, err);
  struct hsr_form *form = &variant->choice.form;
  if (!status && !hsr_makes(variant->listed->plain, HSR_VOXELS))
    return hsr_fail(err, HSR_E_USAGE, "%s: makes %s, not voxels", o->algorithm,
                    form->type->name);
  if (!status && o->size)
    form->values.option[0] = o->size;
  return status;
}

enum hsr_status command_voxels(int argc, char **argv, struct hsr_error *err) {
  struct options options = {.algorithm = "tiling-solids"};
  struct hsr_variant variant;
  enum hsr_status status = parse_options(&argp, argc, argv, &options, err);
  if (!status)
    status = check_output(options.output, err);
  if (!status)
    status = choose(&options, &variant, err);
  if (status)
    return status;
  struct found found = {.options = &options};
  status =
      open_scene(options.scene.name, options.scene.import, &found.scene, err);
  if (!status)
    status = hsr_world_open(&found.world, found.scene, HSR_MOST_LAID_OUT, err);
  if (!status)
    status = find(&found, &variant, err);
  if (!status)
    status = tell(variant.listed->counting, &found, err);
  hsr_answer_free(&found.answer);
  hsr_world_free(&found.world);
  hsr_scene_delete(found.scene);
  return status;
}
