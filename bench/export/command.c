/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr export: a scene, or what an algorithm makes of it, for other programs. */
#include "bench/modules/variant.h"
#include "bench/options/command.h"
#include "bench/options/streams.h"
#include "bench/options/view.h"
#include "bench/shapes/shapes.h"
#include "bench/terminal/terminal.h"

#include "common/files/srgb.h"
#include "common/files/suffix.h"
#include "common/scene/pieces.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WHAT = 0x200, VISIBLE, WORK, UNIT, Z_UP };

/* What is exported: faces, or a shape. */
struct shape {
  const char *name;
  enum hsr_status (*make)(const struct shape_source *source,
                          struct cell_list *list, struct hsr_error *err);
  enum hsr_cell_kind solid; /* of a .vtu file; a .vtp file holds polygons */
  const char *algorithm;    /* the standard one */
};
static const struct shape shapes[] = {
    {"faces", NULL, HSR_CELL_POLYGON, "zbuffer-fast"},
    {"octree", shape_octree, HSR_CELL_BOX, "hzbuffer"},
    {"bsp", shape_bsp, HSR_CELL_POLYHEDRON, "bsp-painter"},
    {"separators", shape_separators, HSR_CELL_POLYHEDRON, "schumacker"},
    {"frustum", shape_frustum, HSR_CELL_POLYHEDRON, "zbuffer-fast"},
    {"spans", shape_spans, HSR_CELL_POLYGON, "watkins"}};
enum { N_SHAPES = sizeof shapes / sizeof *shapes };

struct options {
  struct option_base base;
  struct view_options view;
  struct scene_options scene;
  const struct shape *shape;
  const char *algorithm, *output;
  bool visible, work;
  const char *for_glb; /* the last option that is only for .glb, or NULL */
  struct hsr_glb_frame frame;
};

static error_t choose_unit(struct options *o, const char *name) {
  static const struct {
    const char *name;
    double metres;
  } units[] = {{"mm", 0.001}, {"cm", 0.01}, {"m", 1}, {"in", 0.0254}};
  o->for_glb = "--unit";
  for (size_t k = 0; k < sizeof units / sizeof *units; k++)
    if (!strcmp(units[k].name, name)) {
      o->frame.metres = units[k].metres;
      return 0;
    }
  return option_fail(&o->base, "--unit %s: must be mm, cm, m or in", name);
}

static error_t choose_shape(struct options *o, const char *name) {
  for (int k = 0; k < N_SHAPES; k++)
    if (!strcmp(shapes[k].name, name)) {
      o->shape = &shapes[k];
      return 0;
    }
  return option_fail(&o->base,
                     "--what %s: must be faces, octree, bsp, separators, "
                     "frustum or spans",
                     name);
}

static error_t parse(int key, char *arg, struct argp_state *state) {
  struct options *o = state->input;
  switch (key) {
  case 'a':
    o->algorithm = arg;
    return 0;
  case 'o':
    if (o->output)
      return option_fail(&o->base, "export: one output file");
    return parse_output(arg, NULL, "export", &o->base, &o->output);
  case WHAT:
    return choose_shape(o, arg);
  case VISIBLE:
    o->visible = true;
    return 0;
  case WORK:
    o->work = true;
    return 0;
  case UNIT:
    return choose_unit(o, arg);
  case Z_UP:
    o->for_glb = "--z-up";
    o->frame.z_up = true;
    return 0;
  default:
    return parse_place_option(&o->scene, &o->view, key, arg, "export",
                              &o->base);
  }
}

static const struct argp_option entries[] = {
    {"output", 'o', "FILE", 0,
     "the file, by suffix: .vtp and .vtu with all data; .obj with its "
     "materials; .ply with colours; .stl; .glb, which hsr reads again as the "
     "same scene",
     0},
    {"what", WHAT, "faces|octree|bsp|separators|frustum|spans", 0,
     "faces (standard); octree, bsp (its cells in .vtu, its planes in .vtp), "
     "separators, frustum or spans, as .vtp or .vtu",
     0},
    {"algorithm", 'a', "NAME", 0,
     "whose octree, spans, visible faces and work (standard: as fits)", 0},
    SCENE_ARGP_OPTIONS,
    VIEW_ARGP_OPTIONS,
    {NULL, 0, NULL, 0, "With the faces, in .vtp and .vtu files:", 2},
    {"visible", VISIBLE, NULL, 0, "of each, the visible samples in the view",
     2},
    {"work", WORK, NULL, 0, "of each, the algorithm's steps that are about it",
     2},
    {NULL, 0, NULL, 0,
     "In .glb files, which are in metres and have y up (else coordinates are "
     "written as they are, here and in all other files):",
     3},
    {"unit", UNIT, "mm|cm|m|in", 0,
     "one unit of the scene is one mm, cm, m (standard) or in: coordinates are "
     "written in metres",
     3},
    {"z-up", Z_UP, NULL, 0, "z is up in the scene", 3},
    {0}};

static const struct argp argp = {
    entries,
    parse,
    "SCENE",
    "Writes a scene for ParaView, Blender and other programs; or what an "
    "algorithm works with.\v"
    "  hsr export house -o house.glb\n"
    "  hsr export harbor -a watkins --visible --work -o harbor.vtp\n"
    "  hsr export house --what octree -o cubes.vtu\n"
    "  hsr export house --what spans -a bouknight -s 64x48 -o spans.vtp",
    NULL,
    NULL,
    NULL};

/* --- Faces ---------------------------------------------------------------- */

struct export {
  const struct options *options;
  struct hsr_scene *scene;
  struct hsr_world world;
  struct hsr_setup setup;
  struct hsr_view view;
  struct hsr_arena arena; /* of values of cells */
  double change;          /* of a coordinate, in a format of single precision */
};

/* Counts the steps about faces. */
struct steps {
  uint32_t n_faces, *of;
};

static void count_step(void *context, const struct hsr_event *event) {
  struct steps *steps = context;
  const struct hsr_subject *both[] = {&event->a, &event->b};
  for (int k = 0; k < 2; k++)
    if ((both[k]->kind == HSR_OF_FACE || both[k]->kind == HSR_OF_PIECE) &&
        both[k]->id[0] < steps->n_faces)
      steps->of[both[k]->id[0]]++;
}

static void add_data(struct hsr_cells *cells, const char *name,
                     enum hsr_cell_type type, const void *value) {
  cells->data[cells->n_data++] = (struct hsr_cell_data){name, type, value};
}

/* Draws the view, and adds what is asked for about it. */
static enum hsr_status add_view(struct export *e, struct hsr_cells *cells,
                                struct hsr_error *err) {
  const struct options *o = e->options;
  const size_t n = (size_t)e->view.m * (size_t)e->view.n;
  const struct shape_source source = {&e->setup, &e->view, &e->world};
  struct steps steps = {e->world.n_faces,
                        HSR_NEW_ZEROED(&e->arena, uint32_t, e->world.n_faces)};
  uint32_t *seen = HSR_NEW_ZEROED(&e->arena, uint32_t, e->world.n_faces);
  if (!steps.of || !seen)
    return hsr_fail_nomem(err);
  struct hsr_tally tally = {.out_of_memory = false};
  struct hsr_answer answer = {.body = NULL};
  enum hsr_status status =
      hear_run(&source, &answer, &tally, count_step, &steps, err);
  const uint32_t *ids = status ? NULL : hsr_answer_ids_of(&answer);
  for (size_t k = 0; k < n && ids; k++)
    if (ids[k] != HSR_BACKGROUND)
      seen[ids[k]]++;
  if (o->visible)
    add_data(cells, "visible_samples", HSR_CELL_NUMBERS, seen);
  if (o->work)
    add_data(cells, "work", HSR_CELL_NUMBERS, steps.of);
  hsr_answer_free(&answer);
  return status;
}

static enum hsr_status add_points(struct export *e,
                                  const struct hsr_world *world,
                                  struct hsr_cells *cells,
                                  struct hsr_error *err) {
  const struct hsr_mesh *mesh = &world->mesh;
  double *xyz = HSR_NEW(&e->arena, double, 3 * (size_t)mesh->n_vertices);
  if (!xyz)
    return hsr_fail_nomem(err);
  for (size_t v = 0; v < mesh->n_vertices; v++) {
    xyz[3 * v] = mesh->x[v];
    xyz[3 * v + 1] = mesh->y[v];
    xyz[3 * v + 2] = mesh->z[v];
  }
  *cells = (struct hsr_cells){.kind = HSR_CELL_POLYGON,
                              .n_points = mesh->n_vertices,
                              .n = world->n_faces,
                              .xyz = xyz,
                              .start = mesh->start,
                              .point = mesh->vertex};
  return HSR_OK;
}

/* Of a world of pieces, all is said of their parents. */
static enum hsr_status add_faces(struct export *e,
                                 const struct hsr_world *world,
                                 struct hsr_cells *cells,
                                 struct hsr_error *err) {
  const size_t n = world->n_faces;
  uint32_t *id = HSR_NEW(&e->arena, uint32_t, n);
  uint32_t *object = HSR_NEW(&e->arena, uint32_t, n);
  uint32_t *instance = HSR_NEW(&e->arena, uint32_t, n);
  unsigned char *bytes = HSR_NEW(&e->arena, unsigned char, 3 * n);
  float *rgb = HSR_NEW(&e->arena, float, 3 * n);
  double *opacity = HSR_NEW(&e->arena, double, n);
  if (!id || !object || !instance || !bytes || !rgb || !opacity)
    return hsr_fail_nomem(err);
  for (uint32_t f = 0; f < n; f++) {
    id[f] = hsr_world_parent(world, f);
    const struct hsr_place place = hsr_place_of(world, id[f]);
    const float *colour = hsr_face_rgb(place.object, place.face);
    instance[f] = place.instance;
    object[f] = e->scene->instances[place.instance].object;
    opacity[f] = (double)hsr_face_opacity(place.object, place.face);
    for (size_t k = 0; k < 3; k++)
      bytes[3 * f + k] = hsr_srgb_byte(rgb[3 * f + k] = colour[k]);
  }
  add_data(cells, "id", HSR_CELL_NUMBERS, id);
  add_data(cells, "object", HSR_CELL_NUMBERS, object);
  add_data(cells, "instance", HSR_CELL_NUMBERS, instance);
  add_data(cells, "colour", HSR_CELL_COLOURS, bytes);
  add_data(cells, "rgb", HSR_CELL_RGB, rgb);
  add_data(cells, "opacity", HSR_CELL_REALS, opacity);
  return HSR_OK;
}

static enum hsr_status write_faces(struct export *e, struct hsr_error *err) {
  const struct options *o = e->options;
  struct hsr_world triangles;
  struct hsr_cells cells;
  bool changed = false;
  enum hsr_status status = HSR_OK;
  if (hsr_ends_in(o->output, ".stl"))
    status = hsr_world_triangulate(&e->world, &triangles, &changed, err);
  const struct hsr_world *world = changed ? &triangles : &e->world;
  if (!status)
    status = add_points(e, world, &cells, err);
  if (!status)
    status = add_faces(e, world, &cells, err);
  if (!status && (o->visible || o->work))
    status = add_view(e, &cells, err);
  if (!status)
    status = hsr_cells_write(&cells, o->output, err);
  if (changed)
    hsr_world_free(&triangles);
  return status;
}

/* --- All that is exported ------------------------------------------------- */

static enum hsr_status write_shape(struct export *e, struct hsr_error *err) {
  const struct options *o = e->options;
  const struct shape_source source = {&e->setup, &e->view, &e->world};
  struct cell_list list = {.kind = hsr_ends_in(o->output, ".vtu")
                                       ? o->shape->solid
                                       : HSR_CELL_POLYGON};
  struct hsr_cells cells;
  char text[TERMINAL_NUMBER], told[TERMINAL_NAME];
  enum hsr_status status = o->shape->make(&source, &list, err);
  if (!status)
    status = cell_list_cells(&list, &cells, err);
  if (!status)
    status = hsr_cells_write(&cells, o->output, err);
  if (!status)
    printf("%s: %s\n", streams_tell(o->output, told, sizeof told),
           terminal_number(cells.n, "cells", text));
  cell_list_free(&list);
  return status;
}

static bool is_scene_file(const char *path) {
  return hsr_ends_in(path, ".obj") || hsr_ends_in(path, ".ply") ||
         hsr_ends_in(path, ".glb");
}

static enum hsr_status check(const struct options *o, struct hsr_error *err) {
  const char *out = o->output;
  if (!out)
    return hsr_fail(err, HSR_E_USAGE, "export: -o FILE is missing");
  bool faces = !o->shape->make;
  bool fits =
      faces && (is_scene_file(out) || hsr_cells_fit(HSR_CELL_POLYGON, out));
  if (!fits && !hsr_cells_keep_data(out))
    return hsr_fail(err, HSR_E_USAGE, "%.200s: must end in %s", out,
                    faces ? ".vtp, .vtu, .obj, .ply, .stl or .glb"
                          : ".vtp or .vtu");
  if (o->for_glb && !(faces && hsr_ends_in(out, ".glb")))
    return hsr_fail(err, HSR_E_USAGE, "%s is for .glb files", o->for_glb);
  if ((o->visible || o->work) && (!faces || !hsr_cells_keep_data(out)))
    return hsr_fail(err, HSR_E_USAGE,
                    "--visible and --work are for faces in .vtp and .vtu "
                    "files");
  return HSR_OK;
}

/* Lays the scene out, and makes the algorithm ready if it has something to
 * say. */
static enum hsr_status open_world(struct export *e,
                                  const struct hsr_variant *variant,
                                  struct hsr_error *err) {
  const struct options *o = e->options;
  enum hsr_status status =
      hsr_world_open(&e->world, e->scene, HSR_MOST_LAID_OUT, err);
  if (!status && hsr_is_roster(&e->world))
    return hsr_fail(err, HSR_E_NOMEM,
                    "%u faces are more than %u; .glb files keep instances",
                    e->world.n_faces, HSR_MOST_LAID_OUT);
  if (!status && (o->shape->make || o->visible || o->work))
    status = hsr_setup_init(&e->setup, variant->listed->counting,
                            &variant->choice, &e->world, err);
  return status;
}

/* The most by which a coordinate changes that becomes a float. */
static double float_change(const struct hsr_mesh *mesh) {
  double most = 0;
  for (uint32_t v = 0; v < mesh->n_vertices; v++) {
    most = fmax(most, fabs(mesh->x[v] - (double)(float)mesh->x[v]));
    most = fmax(most, fabs(mesh->y[v] - (double)(float)mesh->y[v]));
    most = fmax(most, fabs(mesh->z[v] - (double)(float)mesh->z[v]));
  }
  return most;
}

static enum hsr_status write_all(struct export *e,
                                 const struct hsr_variant *variant,
                                 struct hsr_error *err) {
  const struct options *o = e->options;
  if (hsr_ends_in(o->output, ".glb"))
    return hsr_scene_write_glb(e->scene, o->frame, o->output, &e->change, err);
  enum hsr_status status = open_world(e, variant, err);
  if (status)
    return status;
  if (o->shape->make)
    return write_shape(e, err);
  if (hsr_ends_in(o->output, ".stl"))
    e->change = float_change(&e->world.mesh);
  if (hsr_ends_in(o->output, ".obj"))
    return hsr_world_write_obj(&e->world, o->output, err);
  return hsr_ends_in(o->output, ".ply")
             ? hsr_world_write_ply(&e->world, o->output, err)
             : write_faces(e, err);
}

/* --- What was kept -------------------------------------------------------- */

/* What a scene may have that not every format holds. */
enum part {
  OBJECTS,
  NAMES,
  INSTANCES,
  SIDES,
  SHARED,
  COLOURS,
  OPACITIES,
  POLYGONS,
  VIEWS
};
static const char *const part_name[] = {[OBJECTS] = "objects",
                                        [NAMES] = "names",
                                        [INSTANCES] = "instances",
                                        [SIDES] = "one-sidedness",
                                        [SHARED] = "shared vertices",
                                        [COLOURS] = "colours",
                                        [OPACITIES] = "opacities",
                                        [POLYGONS] = "polygons",
                                        [VIEWS] = "views"};
enum { N_PARTS = VIEWS + 1 };

/* The parts that each format holds. Views are asked for by no other option. */
static unsigned parts_of(const char *path) {
  const unsigned looks =
      1u << COLOURS | 1u << OPACITIES | 1u << POLYGONS | 1u << SHARED;
  if (hsr_ends_in(path, ".glb"))
    return ~(1u << SHARED);
  if (hsr_ends_in(path, ".obj"))
    return looks | 1u << OBJECTS | 1u << NAMES;
  if (hsr_ends_in(path, ".stl"))
    return 0;
  return hsr_ends_in(path, ".ply") ? looks | 1u << SIDES
                                   : looks | 1u << OBJECTS | 1u << INSTANCES;
}

/* The parts that a scene has. */
static unsigned parts_in(const struct hsr_scene *scene) {
  unsigned parts = 1u << VIEWS;
  parts |= scene->n_instances > 1 ? 1u << OBJECTS : 0;
  parts |= scene->n_instances > scene->n_objects ? 1u << INSTANCES : 0;
  parts |= hsr_scene_has_colours(scene) ? 1u << COLOURS : 0;
  parts |= hsr_scene_is_transparent(scene) ? 1u << OPACITIES : 0;
  for (uint32_t o = 0; o < scene->n_objects; o++) {
    const struct hsr_object *object = &scene->objects[o];
    parts |= parts & 1u << OBJECTS && object->name[0] ? 1u << NAMES : 0;
    parts |= object->one_sided ? 1u << SIDES : 0;
    parts |= object->group.vertex && object->group.n_own < object->n_vertices
                 ? 1u << SHARED
                 : 0;
    parts |= object->start[object->n_faces] != 3 * object->n_faces
                 ? 1u << POLYGONS
                 : 0;
  }
  return parts;
}

/* By how much a byte changes a channel, which is linear; of sRGB from 0 to 1. */
static double channel_change(float linear) {
  const unsigned char byte = hsr_srgb_byte(linear);
  const float back = hsr_srgb_decode((float)byte / 255.0f);
  return memcmp(&back, &linear, sizeof back)
             ? fabs(hsr_srgb_encode_real((double)linear) - byte / 255.0)
             : 0;
}

static double opacity_change(float opacity) {
  const float back = (float)lrintf(255 * opacity) / 255.0f;
  return fabs((double)opacity - (double)back);
}

/* Where a file has colours and opacities as bytes. */
static void tell_of_bytes(const struct hsr_scene *scene, const char *told) {
  double most = 0;
  for (uint32_t o = 0; o < scene->n_objects; o++)
    for (uint32_t f = 0; f < scene->objects[o].n_faces; f++) {
      const float *rgb = hsr_face_rgb(&scene->objects[o], f);
      for (int k = 0; k < 3; k++)
        most = fmax(most, channel_change(rgb[k]));
      most =
          fmax(most, opacity_change(hsr_face_opacity(&scene->objects[o], f)));
    }
  if (most > 0)
    fprintf(stderr,
            "hsr: %s: %s are rounded to bytes, which changes them by up to "
            "%.2g; .obj, .vtp and .glb keep them\n",
            told,
            hsr_scene_is_transparent(scene) ? "colours and opacities"
                                            : "colours",
            most);
}

/* The counts; and what of the scene the file does not have. */
static void print_counts(const struct export *e) {
  const char *path = e->options->output;
  const unsigned lost = parts_in(e->scene) & ~parts_of(path);
  char faces[TERMINAL_NUMBER], objects[TERMINAL_NUMBER],
      instances[TERMINAL_NUMBER], told[TERMINAL_NAME];
  streams_tell(path, told, sizeof told);
  printf("%s: %s, %s, %s", told,
         terminal_number(hsr_scene_faces(e->scene), "faces", faces),
         terminal_number(e->scene->n_objects, "objects", objects),
         terminal_number(e->scene->n_instances, "instances", instances));
  const char *before = "; without its ";
  for (int part = 0; part < N_PARTS; part++)
    if (lost & 1u << part) {
      printf("%s%s", before, part_name[part]);
      before = ", ";
    }
  printf("\n");
  if (e->change > 0)
    fprintf(stderr,
            "hsr: %s: coordinates are rounded to floats, which changes them by "
            "up to %.2g%s\n",
            told, e->change,
            hsr_ends_in(path, ".stl") ? "; .obj, .ply and .vtp keep them" : "");
  if (hsr_ends_in(path, ".ply") &&
      parts_in(e->scene) & (1u << COLOURS | 1u << OPACITIES))
    tell_of_bytes(e->scene, told);
}

enum hsr_status command_export(int argc, char **argv, struct hsr_error *err) {
  struct options o = {
      .view = VIEW_OPTIONS_STANDARD, .shape = &shapes[0], .frame.metres = 1};
  enum hsr_status status = parse_options(&argp, argc, argv, &o, err);
  struct hsr_variant variant;
  if (!status)
    status = hsr_variant_parse(o.algorithm ? o.algorithm : o.shape->algorithm,
                               &variant, err);
  if (!status)
    status = check(&o, err);
  if (!status && !variant.choice.form.type->by_faces)
    status = hsr_fail(err, HSR_E_USAGE, "%s: must draw faces", variant.name);
  if (!status)
    status = aim_scene(&o.scene, &o.view, err);
  if (status)
    return status;
  struct export e = {.options = &o};
  status = open_scene(o.scene.name, o.scene.import, &e.scene, err);
  if (!status)
    status = choose_view(&o.view, e.scene, 1, &e.view, err);
  if (!status)
    status = write_all(&e, &variant, err);
  if (!status && !o.shape->make)
    print_counts(&e);
  if (e.setup.algorithm)
    hsr_setup_free(&e.setup);
  hsr_world_free(&e.world);
  hsr_scene_delete(e.scene);
  hsr_arena_free(&e.arena);
  return status;
}
