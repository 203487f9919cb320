/* SPDX-License-Identifier: GPL-3.0-or-later */
/* .obj files, with their materials: VTK's writer knows no colours.
 *
 * Source      Wavefront Advanced Visualizer manual, appendices B1 and "Material
 *             library file"
 * Departures  Kd is written in sRGB, as mesh_materials.cc reads it. */
#include "common/files/cells/cells.h"
#include "common/files/srgb.h"
#include "common/files/whole_file.h"

#include <stdlib.h>
#include <string.h>

/* In the fewest digits that read back as the same double. */
static void print_real(double x, FILE *out) {
  char text[40];
  int digits = 15;
  do
    snprintf(text, sizeof text, "%.*g", digits++, x);
  while (digits <= 17 && strtod(text, NULL) != x);
  fprintf(out, " %s", text);
}

/* A linear colour in sRGB, in the fewest digits that read back as the same. */
static void print_colour(float linear, FILE *out) {
  const double encoded = hsr_srgb_encode_real((double)linear);
  char text[40];
  int digits = 1;
  do
    snprintf(text, sizeof text, "%.*g", digits++, encoded);
  while (digits <= 17 &&
         (float)hsr_srgb_decode_real(strtod(text, NULL)) != linear);
  fprintf(out, " %s", text);
}

/* An opacity, in the fewest digits that read back as the same. */
static void print_share(float share, FILE *out) {
  char text[40];
  int digits = 1;
  do
    snprintf(text, sizeof text, "%.*g", digits++, (double)share);
  while (digits <= 9 && (float)strtod(text, NULL) != share);
  fprintf(out, " %s", text);
}

static void print_materials(const struct hsr_colours *colours, FILE *out) {
  for (uint32_t k = 0; k < colours->n; k++) {
    const float *rgba = colours->rgba + 4 * (size_t)k;
    fprintf(out, "newmtl colour%u\nKd", k);
    for (int c = 0; c < 3; c++)
      print_colour(rgba[c], out);
    fputs("\n", out);
    if (rgba[3] < 1) {
      fputs("d", out);
      print_share(rgba[3], out);
      fputs("\n", out);
    }
  }
}

/* A name, which is the rest of its line. What would end it, or begin a comment,
 * becomes '_'. */
static void print_name(const char *name, FILE *out) {
  for (; *name; name++) {
    const unsigned char c = (unsigned char)*name;
    fputc(c < ' ' || c == '#' || c == '\\' || c == 127 ? '_' : c, out);
  }
}

static const char *name_of(const struct hsr_scene *scene, uint32_t instance) {
  return scene->objects[scene->instances[instance].object].name;
}

/* Whether the instances before and after this one are of objects with other
 * names. Those of an object follow one another. A reader takes neighbours of one
 * name for one object. */
static bool is_alone(const struct hsr_scene *scene, uint32_t instance) {
  const char *name = name_of(scene, instance);
  return (!instance || strcmp(name_of(scene, instance - 1), name) != 0) &&
         (instance + 1 == scene->n_instances ||
          strcmp(name_of(scene, instance + 1), name) != 0);
}

/* The faces of one instance. `of` are the colours of its object's faces. */
static void print_instance(const struct hsr_world *world, uint32_t instance,
                           const uint32_t *of, FILE *out) {
  const struct hsr_scene *scene = world->roster.scene;
  const uint32_t *first = world->roster.first + instance;
  fputs("o ", out);
  print_name(name_of(scene, instance), out);
  if (is_alone(scene, instance))
    fputs("\n", out);
  else
    fprintf(out, "-%u\n", instance);
  for (uint32_t f = first[0]; f < first[1]; f++) {
    if (f == first[0] || of[f - first[0]] != of[f - first[0] - 1])
      fprintf(out, "usemtl colour%u\n", of[f - first[0]]);
    fputs("f", out);
    for (uint32_t k = world->mesh.start[f]; k < world->mesh.start[f + 1]; k++)
      fprintf(out, " %u", world->mesh.vertex[k] + 1);
    fputs("\n", out);
  }
}

static void print_mesh(const struct hsr_world *world, const char *materials,
                       const struct hsr_colours *colours, FILE *out) {
  const struct hsr_scene *scene = world->roster.scene;
  const struct hsr_mesh *mesh = &world->mesh;
  fprintf(out, "mtllib %s\n", materials);
  for (uint32_t v = 0; v < mesh->n_vertices; v++) {
    fputs("v", out);
    print_real(mesh->x[v], out);
    print_real(mesh->y[v], out);
    print_real(mesh->z[v], out);
    fputs("\n", out);
  }
  const uint32_t *of = colours->of;
  for (uint32_t o = 0, i = 0; o < scene->n_objects; o++) {
    for (; i < scene->n_instances && scene->instances[i].object == o; i++)
      print_instance(world, i, of, out);
    of += scene->objects[o].n_faces;
  }
}

/* The name of the file of materials: the suffix replaced. */
static char *name_materials(const char *path) {
  size_t n = strlen(path) - strlen(".obj");
  char *name = malloc(n + sizeof ".mtl");
  if (name) {
    memcpy(name, path, n);
    memcpy(name + n, ".mtl", sizeof ".mtl");
  }
  return name;
}

static enum hsr_status write_both(const struct hsr_world *world,
                                  const char *path, const char *materials,
                                  const struct hsr_colours *colours,
                                  struct hsr_error *err) {
  const char *slash = strrchr(materials, '/');
  struct hsr_whole_file file;
  enum hsr_status status = hsr_whole_file_open(&file, materials, err);
  if (status)
    return status;
  print_materials(colours, file.stream);
  status = hsr_whole_file_close(&file, HSR_OK, err);
  if (!status)
    status = hsr_whole_file_open(&file, path, err);
  if (status)
    return status;
  print_mesh(world, slash ? slash + 1 : materials, colours, file.stream);
  return hsr_whole_file_close(&file, HSR_OK, err);
}

enum hsr_status hsr_world_write_obj(const struct hsr_world *world,
                                    const char *path, struct hsr_error *err) {
  const struct hsr_scene *scene = world->roster.scene;
  struct hsr_colours colours;
  enum hsr_status status =
      hsr_colours_of(&colours, scene->objects, scene->n_objects, err);
  char *materials = name_materials(path);
  if (!status && !materials)
    status = hsr_fail_nomem(err);
  if (!status)
    status = write_both(world, path, materials, &colours, err);
  free(materials);
  hsr_colours_free(&colours);
  return status;
}
