/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/web/hash.h"

#include <stdio.h>
#include <string.h>

static uint64_t add(uint64_t hash, const void *from, size_t n) {
  const unsigned char *byte = from;
  for (size_t k = 0; k < n; k++)
    hash = (hash ^ byte[k]) * UINT64_C(0x100000001b3);
  return hash;
}

static uint64_t add_sizes(uint64_t hash, const size_t *size, size_t n) {
  for (size_t k = 0; k < n; k++)
    hash = add(hash, &(uint64_t){size[k]}, sizeof(uint64_t));
  return hash;
}

/* The bits of a number. -0 is 0. */
static uint64_t add_doubles(uint64_t hash, const double *x, size_t n) {
  for (size_t k = 0; k < n; k++)
    hash = add(hash, &(double){x[k] + 0.0}, sizeof *x);
  return hash;
}

static uint64_t add_segments(uint64_t hash, const struct lib_segment *s,
                             size_t n) {
  for (; n--; s++) {
    const uint32_t of[] = {s->is_implied, s->a, s->b, s->part, s->invisibility};
    hash = add(hash, of, sizeof of);
    hash = add_doubles(hash, (double[]){s->t0, s->t1}, 2);
    hash = add_doubles(hash, s->from, 3);
    hash = add_doubles(hash, s->to, 3);
  }
  return hash;
}

static uint64_t add_polygons(uint64_t hash,
                             const struct hsr_polygon_arrays *p) {
  hash = add(hash, p->face, p->n_regions * sizeof *p->face);
  hash = add_sizes(hash, p->cycle, p->n_regions + 1);
  hash = add_sizes(hash, p->point, p->n_cycles + 1);
  return add_doubles(hash, p->xy, 2 * p->n_points);
}

static uint64_t add_voxels(uint64_t hash, const struct hsr_voxel_array *v) {
  const size_t n = (size_t)v->n[0] * (size_t)v->n[1] * (size_t)v->n[2];
  hash = add_doubles(hash, v->lo, 3);
  hash = add_doubles(hash, &v->side, 1);
  hash = add(hash, v->n, sizeof v->n);
  return add(hash, v->solid, n * sizeof *v->solid);
}

void hash_answer(const struct lib_answer *answer, char text[HASH_TEXT]) {
  struct hsr_answer_info info = {.size = sizeof info};
  struct hsr_polygon_arrays polygons = {.size = sizeof polygons};
  struct hsr_voxel_array voxels = {.size = sizeof voxels};
  const struct lib_segment *segments;
  const uint32_t *ids, *sums;
  const unsigned char *lit;
  const double *areas;
  const uint16_t *rgba;
  int channels;
  size_t n;
  hsr_get_answer(answer, &info, NULL);
  const size_t places = (size_t)info.m * (size_t)info.n;
  uint64_t hash = UINT64_C(0xcbf29ce484222325);
  hash = add(hash, info.kind_name, strlen(info.kind_name));
  if (!hsr_get_ids(answer, &ids, NULL))
    hash = add(hash, ids, places * sizeof *ids);
  if (!hsr_get_lit(answer, &lit, NULL))
    hash = add(hash, lit, places);
  if (!hsr_get_sums(answer, &sums, NULL))
    hash = add(hash, sums, 3 * places * sizeof *sums);
  if (!hsr_get_areas(answer, &areas, NULL))
    hash = add_doubles(hash, areas, 6 * places);
  if (!hsr_get_rgba(answer, &rgba, &channels, NULL))
    hash = add(hash, rgba, (size_t)channels * places * sizeof *rgba);
  if (!hsr_get_segments(answer, &segments, &n, NULL))
    hash = add_segments(hash, segments, n);
  if (!hsr_get_polygons(answer, &polygons, NULL))
    hash = add_polygons(hash, &polygons);
  if (!hsr_get_voxels(answer, &voxels, NULL))
    hash = add_voxels(hash, &voxels);
  snprintf(text, HASH_TEXT, "%016llx", (unsigned long long)hash);
}
