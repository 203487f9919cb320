/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr voxels: the solids of a scene as voxels. */
#include "bench/command.h"
#include "bench/results/json.h"
#include "common/grids/voxel_solids.h"

#include <string.h>
#include <strings.h>

struct options {
  struct option_base base;
  struct scene_options scene;
  const char *output;
  long size;
  bool json;
};

static error_t parse(int key, char *arg, struct argp_state *state) {
  struct options *o = state->input;
  switch (key) {
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
        {"size", 's', "N", 0,
         "N voxels along the longest side of the scene's box (standard: 64)",
         0},
        {"output", 'o', "FILE", 0,
         "write them as an image of VTK, .vti, for ParaView: cell data `solid'",
         0},
        {"json", 'j', NULL, 0, "print one JSON object", 0},
        SCENE_ARGP_OPTIONS,
        {0}},
    parse,
    "SCENE",
    "Finds which solid of a scene each voxel of a grid is in: by its centre, "
    "exactly, and so that solids that touch share no voxel and leave out none. "
    "Solids are numbered from 1 in the order of their first faces; where they "
    "overlap, the first has the voxel; 0 is none. All faces must be of closed "
    "solids, convex or not. By Greene's hierarchical tiling, which visits only "
    "cells that faces cross.\v"
    "  hsr voxels color-cube --size 100 -o cubes.vti",
    NULL,
    NULL,
    NULL};

/* The answer, and what is told of it. */
struct found {
  struct hsr_voxel_solids voxels;
  uint64_t set, surface;
  double cells_per_surface, bits_per_voxel;
  double prepare_seconds, tile_seconds; /* to find the solids; to tile them */
};

static void measure(struct found *found) {
  const struct hsr_voxel_solids *v = &found->voxels;
  const int *n = v->grid.n;
  hsr_voxel_solids_count(v, &found->set, &found->surface);
  found->cells_per_surface = (double)v->work.cells / (double)found->surface;
  found->bits_per_voxel = 8.0 * (double)v->pyramid_bytes / n[0] / n[1] / n[2];
}

static enum hsr_status print_json(const char *scene, const struct found *found,
                                  struct hsr_error *err) {
  const struct hsr_voxel_solids *v = &found->voxels;
  const struct hsr_voxel_grid *g = &v->grid;
  const struct hsr_voxel_work *w = &v->work;
  return json_print(
      json_pack(
          "{ss ss s[iii] s[fff] sf sI sI sI sI sI sI sI sI so sf sf sf}",
          "schema", "hsr-voxels/1", "scene", scene, "voxels", g->n[0], g->n[1],
          g->n[2], "origin", g->lo[0], g->lo[1], g->lo[2], "voxel_size",
          g->size, "solids", (json_int_t)v->n_solids, "convex_parts",
          (json_int_t)v->n_volumes, "set", (json_int_t)found->set, "surface",
          (json_int_t)found->surface, "cells", (json_int_t)w->cells,
          "finest_cells", (json_int_t)w->finest, "plane_masks",
          (json_int_t)w->masks, "exact_decisions", (json_int_t)w->exact,
          "cells_per_surface_voxel", number_or_null(found->cells_per_surface),
          "pyramid_bits_per_voxel", found->bits_per_voxel, "prepare_seconds",
          found->prepare_seconds, "tile_seconds", found->tile_seconds),
      err);
}

static void print_count(uint64_t count, const char *what) {
  printf("%12llu  %s\n", (unsigned long long)count, what);
}

static void print_text(const char *scene, const struct found *found) {
  const struct hsr_voxel_solids *v = &found->voxels;
  printf("%s, %d x %d x %d voxels of side %g\n\n", scene, v->grid.n[0],
         v->grid.n[1], v->grid.n[2], v->grid.size);
  print_count(v->n_solids, "solids");
  print_count(v->n_volumes, "convex parts of them");
  print_count(found->set, "voxels set");
  print_count(found->surface, "of them at a surface");
  print_count(v->work.cells, "cells visited");
  print_count(v->work.finest, "of them of the finest level");
  if (found->surface)
    printf("%12.4g  cells visited a voxel at a surface\n",
           found->cells_per_surface);
  print_count(v->work.masks, "masks of planes");
  print_count(v->work.exact, "exact decisions");
  printf("%12.4g  bits a voxel in the pyramid\n", found->bits_per_voxel);
  printf("%12.4g  seconds to find the solids\n", found->prepare_seconds);
  printf("%12.4g  seconds to tile them\n", found->tile_seconds);
}

static enum hsr_status find(const struct options *o,
                            const struct hsr_world *world, struct found *found,
                            struct hsr_error *err) {
  struct hsr_edges edges;
  struct hsr_volumes volumes = {.n = 0};
  double begin = seconds_now();
  enum hsr_status status = hsr_edges_init(&edges, world, err);
  if (!status)
    status = hsr_volumes_init(&volumes, &edges, err);
  found->prepare_seconds = seconds_now() - begin;
  begin = seconds_now();
  if (!status)
    status = hsr_voxel_solids_init(&found->voxels, &volumes, (int)o->size, err);
  found->tile_seconds = seconds_now() - begin;
  hsr_volumes_free(&volumes);
  hsr_edges_free(&edges);
  return status;
}

static enum hsr_status tell(const struct options *o, struct found *found,
                            struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  if (o->output)
    status = hsr_voxels_write_vti(&found->voxels, o->output, err);
  if (status)
    return status;
  measure(found);
  if (o->json)
    return print_json(o->scene.name, found, err);
  print_text(o->scene.name, found);
  return HSR_OK;
}

static enum hsr_status check_output(const char *path, struct hsr_error *err) {
  const char *dot = path ? strrchr(path, '.') : ".vti";
  if (dot && !strcasecmp(dot, ".vti"))
    return HSR_OK;
  return hsr_fail(err, HSR_E_INPUT, "%s: voxels are written as .vti", path);
}

enum hsr_status command_voxels(int argc, char **argv, struct hsr_error *err) {
  struct options options = {.size = 64};
  enum hsr_status status = parse_options(&argp, argc, argv, &options, err);
  if (!status)
    status = check_output(options.output, err);
  if (status)
    return status;
  struct hsr_scene *scene;
  status = open_scene(options.scene.name, options.scene.import, &scene, err);
  if (status)
    return status;
  struct hsr_world world = {.outline.scene = scene};
  status = hsr_world_open(&world, scene, HSR_MOST_LAID_OUT, err);
  if (!status && hsr_is_outline(&world))
    status = hsr_fail(err, HSR_E_NOMEM,
                      "voxels: %u faces are too many to be laid out, as solids "
                      "need them",
                      world.n_faces);
  struct found found = {.voxels = {.solid = NULL}};
  if (!status)
    status = find(&options, &world, &found, err);
  if (!status)
    status = tell(&options, &found, err);
  hsr_voxel_solids_free(&found.voxels);
  hsr_world_free(&world);
  hsr_scene_delete(scene);
  return status;
}
