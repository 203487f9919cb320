/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/exact/pair.h"

#include <string.h>

uint32_t hsr_largest_face(const struct hsr_scene *scene) {
  uint32_t largest = 3;
  for (uint32_t o = 0; o < scene->n_objects; o++) {
    const struct hsr_object *object = &scene->objects[o];
    for (uint32_t f = 0; f < object->n_faces; f++)
      if (largest < object->start[f + 1] - object->start[f])
        largest = object->start[f + 1] - object->start[f];
  }
  return largest;
}

enum hsr_status hsr_pair_init(struct hsr_pair *pair,
                              const struct hsr_world *scene,
                              const struct hsr_view *view,
                              struct hsr_arena *arena) {
  uint32_t corners = 2 * hsr_largest_face(scene->roster.scene);
  memset(pair->planes, 0, sizeof pair->planes);
  pair->id[0] = pair->id[1] = HSR_NO_ID;
  pair->world = (struct hsr_world){.roster.scene = scene->roster.scene,
                                   .mesh.n_vertices = corners,
                                   .n_faces = 2,
                                   .mesh.n_corners = corners,
                                   .roster.first = scene->roster.first,
                                   .id = pair->id};
  return hsr_world_allocate(&pair->world, arena) ||
                 hsr_screen_init(&pair->screen, &pair->world, view, arena)
             ? HSR_E_NOMEM
             : HSR_OK;
}

bool hsr_pair_nearer(struct hsr_pair *pair, uint32_t f, uint32_t g, int i,
                     int j, struct hsr_tally *tally) {
  return hsr_pair_nearer_at(pair, f, g, hsr_sample_x(pair->screen.view, i),
                            hsr_sample_y(pair->screen.view, j), tally);
}

/* Two faces are often compared at several places in turn. */
static void lay_out(struct hsr_pair *pair, uint32_t f, uint32_t g) {
  const uint32_t low = f < g ? f : g, high = f < g ? g : f;
  if (pair->id[0] == low && pair->id[1] == high)
    return;
  pair->id[0] = low;
  pair->id[1] = high;
  pair->has_planes = false;
  pair->world.mesh.start[0] = 0;
  for (uint32_t k = 0; k < 2; k++)
    hsr_world_lay_out(&pair->world, k);
}

static void find_planes(struct hsr_pair *pair, struct hsr_tally *tally) {
  for (uint32_t k = 0; k < 2 && !pair->has_planes; k++) {
    hsr_world_find_plane(&pair->world, k, &tally->out_of_memory);
    pair->world.mesh.plane[k] = k; /* equal planes are found out below */
    hsr_screen_plane(&pair->screen, k);
  }
  pair->has_planes = true;
}

/* The place of what is known of the planes of f < g. */
static struct hsr_pair_planes *planes_of(struct hsr_pair *pair, uint32_t f,
                                         uint32_t g) {
  uint32_t mixed = (f * UINT32_C(0x9e3779b1)) ^ (g * UINT32_C(0x85ebca77));
  return &pair->planes[(mixed >> 16) % HSR_PAIRS_KEPT];
}

bool hsr_pair_nearer_at(struct hsr_pair *pair, uint32_t f, uint32_t g,
                        double sx, double sy, struct hsr_tally *tally) {
  const uint32_t low = f < g ? f : g, high = f < g ? g : f;
  struct hsr_pair_planes *planes = planes_of(pair, low, high);
  const bool known = planes->f == low && planes->g == high;
  if (known && planes->same)
    return f < g;
  lay_out(pair, f, g);
  find_planes(pair, tally);
  /* If the planes are equal neither is nearer, and the lower id wins. */
  const uint64_t before = tally->exact[HSR_ASK_DEPTH];
  bool higher = hsr_nearer_at(&pair->screen, 1, 0, sx, sy, tally);
  if (!known && tally->exact[HSR_ASK_DEPTH] != before)
    *planes = (struct hsr_pair_planes){low, high,
                                       hsr_pair_same_plane(pair, f, g, tally)};
  return higher == (f > g);
}

bool hsr_pair_same_plane(struct hsr_pair *pair, uint32_t f, uint32_t g,
                         struct hsr_tally *tally) {
  lay_out(pair, f, g);
  tally->exact[HSR_ASK_DEPTH]++;
  return hsr_exact_same_plane(hsr_face_loop(&pair->world, 0),
                              hsr_face_loop(&pair->world, 1),
                              &tally->out_of_memory);
}
