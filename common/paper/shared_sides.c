/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/paper/shared_sides.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* A side of a region, with its line: the ends of an edge in space, the lesser
 * first; or two numbers. */
struct side {
  double line[7];
  size_t region;
  double from[2], to[2];
  double low, high; /* along the line, pixels */
  bool ahead;       /* it runs the way in which these ascend */
};

static int compare(const double *a, const double *b, size_t n) {
  for (size_t k = 0; k < n; k++)
    if (a[k] != b[k])
      return a[k] < b[k] ? -1 : 1;
  return 0;
}

/* Sides of one line together, by where they begin. */
static int by_line(const void *a, const void *b) {
  const struct side *s = a, *t = b;
  const int order = compare(s->line, t->line, 7);
  return order ? order : (s->low > t->low) - (s->low < t->low);
}

static void find_line(struct side *side, const struct hsr_world *world,
                      const struct hsr_line_name *name) {
  side->line[0] = name->kind;
  if (name->kind != HSR_LINE_EDGE) {
    side->line[1] = name->a;
    side->line[2] = name->b;
    return;
  }
  const struct hsr_mesh *mesh = &world->mesh;
  const uint32_t first = mesh->start[name->a], end = mesh->start[name->a + 1],
                 k = first + name->b;
  const uint32_t v[2] = {mesh->vertex[k],
                         mesh->vertex[k + 1 < end ? k + 1 : first]};
  double place[2][3];
  for (int i = 0; i < 2; i++) {
    place[i][0] = mesh->x[v[i]];
    place[i][1] = mesh->y[v[i]];
    place[i][2] = mesh->z[v[i]];
  }
  const bool turned = compare(place[0], place[1], 3) > 0;
  memcpy(side->line + 1, place[turned], sizeof *place);
  memcpy(side->line + 4, place[!turned], sizeof *place);
}

/* Along x, or y where the side is steep. */
static void find_extent(struct side *side) {
  const int axis =
      fabs(side->to[0] - side->from[0]) < fabs(side->to[1] - side->from[1]);
  side->ahead = side->from[axis] < side->to[axis];
  side->low = fmin(side->from[axis], side->to[axis]);
  side->high = fmax(side->from[axis], side->to[axis]);
}

static void list_sides(struct side *side, const struct hsr_polygons *p) {
  size_t n = 0;
  for (size_t r = 0; r < p->n_regions; r++)
    for (size_t c = p->region[r].first; c < p->region[r].first + p->region[r].n;
         c++) {
      const struct hsr_polygon_cycle *cycle = &p->cycle[c];
      for (size_t k = 0; k < cycle->n; k++) {
        const struct hsr_polygon_side
            *from = &p->side[cycle->first + k],
            *to = &p->side[cycle->first + (k + 1) % cycle->n];
        struct side *s = &side[n++];
        *s = (struct side){.region = r};
        memcpy(s->from, from->at, sizeof s->from);
        memcpy(s->to, to->at, sizeof s->to);
        find_line(s, p->world, &from->line);
        find_extent(s);
      }
    }
  qsort(side, n, sizeof *side, by_line);
}

/* The part that two sides share; false: none. */
static bool share(const struct side *s, const struct side *t,
                  struct hsr_shared_side *shared) {
  const double low = fmax(s->low, t->low), high = fmin(s->high, t->high);
  const double length = s->high - s->low;
  if (s->ahead == t->ahead || !(low < high) || !(length > 0))
    return false;
  const struct side *first = s->region < t->region ? s : t;
  shared->region = first->region;
  for (int c = 0; c < 2; c++) {
    const double *begin = s->ahead ? s->from : s->to,
                 *end = s->ahead ? s->to : s->from;
    shared->from[c] = begin[c] + (low - s->low) / length * (end[c] - begin[c]);
    shared->to[c] = begin[c] + (high - s->low) / length * (end[c] - begin[c]);
  }
  return true;
}

static bool append(struct hsr_shared_sides *shared, size_t *room,
                   const struct hsr_shared_side *side) {
  if (shared->n == *room) {
    const size_t more = 2 * *room + 64;
    struct hsr_shared_side *array = realloc(shared->side, more * sizeof *array);
    if (!array)
      return false;
    shared->side = array;
    *room = more;
  }
  shared->side[shared->n++] = *side;
  return true;
}

static int by_region(const void *a, const void *b) {
  const struct hsr_shared_side *s = a, *t = b;
  if (s->region != t->region)
    return s->region < t->region ? -1 : 1;
  const int order = compare(s->from, t->from, 2);
  return order ? order : compare(s->to, t->to, 2);
}

enum hsr_status hsr_shared_sides_find(struct hsr_shared_sides *shared,
                                      const struct hsr_polygons *polygons,
                                      struct hsr_error *err) {
  struct side *side = malloc((polygons->n_sides + 1) * sizeof *side);
  size_t room = 0;
  bool good = side;
  *shared = (struct hsr_shared_sides){.n = 0};
  if (good)
    list_sides(side, polygons);
  for (size_t k = 0; k < polygons->n_sides && good; k++)
    for (size_t i = k + 1; i < polygons->n_sides && good; i++) {
      struct hsr_shared_side found;
      if (compare(side[k].line, side[i].line, 7) || side[i].low >= side[k].high)
        break;
      if (share(&side[k], &side[i], &found))
        good = append(shared, &room, &found);
    }
  free(side);
  if (!good)
    return hsr_fail_nomem(err);
  if (shared->n)
    qsort(shared->side, shared->n, sizeof *shared->side, by_region);
  return HSR_OK;
}

void hsr_shared_sides_free(struct hsr_shared_sides *shared) {
  free(shared->side);
  *shared = (struct hsr_shared_sides){.n = 0};
}
