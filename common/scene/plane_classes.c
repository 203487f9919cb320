/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which faces of a world lie on equal planes. */
#include "common/base/numbers.h"
#include "common/base/share.h"
#include "common/base/vector.h"
#include "common/scene/planes.h"

#include <float.h>
#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

static const double U = DBL_EPSILON / 2;

/* Faces are shared out in ranges, by their numbers and then in the order of
 * their keys. One thread has one range. */
enum { RANGE = 8192 };

struct sorted_face;
struct open_class;

/* The sections of a range of the sorted faces. No plane before a section may be
 * equal to a plane in it, so each section is swept by itself. */
struct section {
  double highest; /* the greatest upper end of a key in the range; later, in all
                     ranges before it */
  uint32_t begin; /* of the first section that begins in it, or NONE */
  uint32_t end;   /* of that section, which may continue in the next ranges */
  uint32_t n_planes;
  uint32_t first_plane;
};
#define NONE UINT32_MAX

struct classes {
  struct hsr_world *world;
  int threads;
  uint32_t size, n_ranges; /* of ranges */
  double *lo, *hi;         /* a face: its key's ends */
  struct sorted_face *from, *to;
  int shift;
  uint32_t (*start)[256];  /* a range: how many have a digit; then, where they
                              go */
  struct section *section; /* a range */
  struct open_class *open;
  atomic_bool out_of_memory;
};

static struct hsr_range range_of(const struct classes *c, uint32_t k) {
  return hsr_range_of(c->world->n_faces, c->size, k);
}

static void share(struct classes *c, void (*part)(void *, uint32_t, int)) {
  hsr_share(c->threads, c->n_ranges, part, c);
}

/* A number that equal planes share: the absolute value of a fixed linear form
 * in the unit normal and the distance. That of face f lies in [lo[f], hi[f]].
 *
 * Each component of the unit normal is off by at most 2 sqrt(3) n_error/|N| +
 * 4u. The distance is off by that times the anchor's size, plus the anchor's
 * error and three roundings. The form's coefficients are below 1. All is
 * doubled. If the normal is unknown the error is not finite, and the face is
 * compared with all. */
HSR_VECTOR static void find_keys(const struct hsr_mesh *mesh, uint32_t from,
                                 uint32_t to, double *restrict lo,
                                 double *restrict hi) {
  const double *restrict x = mesh->nx, *restrict y = mesh->ny,
                         *restrict z = mesh->nz, *restrict px = mesh->px,
                         *restrict py = mesh->py, *restrict pz = mesh->pz,
                         *restrict n_error = mesh->n_error,
                         *restrict anchor_error = mesh->anchor_error;
  for (uint32_t f = from; f < to; f++) {
    double scale = hsr_max(fabs(x[f]), hsr_max(fabs(y[f]), fabs(z[f])));
    double nx = x[f] / scale, ny = y[f] / scale, nz = z[f] / scale;
    double length = sqrt(nx * nx + ny * ny + nz * nz);
    double reach = fabs(px[f]) + fabs(py[f]) + fabs(pz[f]);
    double d = (nx * px[f] + ny * py[f] + nz * pz[f]) / length;
    double key =
        fabs((0.5432 * nx + 0.8107 * ny + 0.3219 * nz) / length + 0.6173 * d);
    double turn = 4 * (n_error[f] / (scale * length)) + 8 * U;
    double error =
        8 * (turn * (1 + reach) + anchor_error[f]) + 16 * U * (1 + key);
    bool known = error < INFINITY;
    lo[f] = known ? key - error : -INFINITY;
    hi[f] = known ? key + error : INFINITY;
  }
}

/* A face, to be sorted by the lower end of its key. */
struct sorted_face {
  uint64_t lo; /* as a whole number, in the same order */
  uint32_t face;
};

/* The order of whole numbers is that of the doubles: a negative one has all its
 * bits turned, any other one the highest. */
static uint64_t whole_in_order(double x) {
  uint64_t bits;
  memcpy(&bits, &x, sizeof bits);
  return bits >> 63 ? ~bits : bits | UINT64_C(1) << 63;
}

static void begin_range(void *context, uint32_t k, int thread) {
  struct classes *c = context;
  struct hsr_range range = range_of(c, k);
  (void)thread;
  find_keys(&c->world->mesh, range.from, range.to, c->lo, c->hi);
  for (uint32_t f = range.from; f < range.to; f++)
    c->from[f] = (struct sorted_face){whole_in_order(c->lo[f]), f};
}

/* A radix sort, by eight bits at a time. Whoever is equal keeps its order. */
static uint32_t digit_of(const struct classes *c, uint32_t k) {
  return (uint32_t)(c->from[k].lo >> c->shift & 255);
}

static void count_range(void *context, uint32_t k, int thread) {
  struct classes *c = context;
  struct hsr_range range = range_of(c, k);
  (void)thread;
  memset(c->start[k], 0, sizeof c->start[k]);
  for (uint32_t f = range.from; f < range.to; f++)
    c->start[k][digit_of(c, f)]++;
}

static void move_range(void *context, uint32_t k, int thread) {
  struct classes *c = context;
  struct hsr_range range = range_of(c, k);
  (void)thread;
  for (uint32_t f = range.from; f < range.to; f++)
    c->to[c->start[k][digit_of(c, f)]++] = c->from[f];
}

/* Finds where each range puts its faces. False: all have the same digit, and
 * nothing is to be moved. */
static bool place_ranges(struct classes *c) {
  uint32_t sum = 0;
  for (int digit = 0; digit < 256; digit++) {
    uint32_t before = sum;
    for (uint32_t k = 0; k < c->n_ranges; k++) {
      uint32_t n = c->start[k][digit];
      c->start[k][digit] = sum;
      sum += n;
    }
    if (sum - before == c->world->n_faces)
      return false;
  }
  return true;
}

/* Sorts the faces by the lower ends of their keys, then by number. */
static void sort_faces(struct classes *c) {
  for (c->shift = 0; c->shift < 64; c->shift += 8) {
    share(c, count_range);
    if (!place_ranges(c))
      continue;
    share(c, move_range);
    struct sorted_face *moved = c->to;
    c->to = c->from;
    c->from = moved;
  }
}

/* Whether the normals may be parallel: a cheap test. No is certain. */
static bool maybe_parallel(const struct hsr_world *world, uint32_t f,
                           uint32_t g) {
  double a[3] = {world->mesh.nx[f], world->mesh.ny[f], world->mesh.nz[f]};
  double b[3] = {world->mesh.nx[g], world->mesh.ny[g], world->mesh.nz[g]};
  double fa = hsr_largest_normal(&world->mesh, f),
         fb = hsr_largest_normal(&world->mesh, g);
  double error =
      4 * (fa * world->mesh.n_error[g] + fb * world->mesh.n_error[f] +
           world->mesh.n_error[f] * world->mesh.n_error[g]) +
      8 * U * fa * fb;
  for (int i = 0, j = 1; i < 3; i++, j = (j + 1) % 3)
    if (fabs(a[i] * b[j] - a[j] * b[i]) > error)
      return false;
  return true;
}

/* One representative of a class that the sweep has not left behind. */
struct open_class {
  double hi;
  uint32_t face;
  bool is_in_crowd;
};

/* Planes that differ by little more than rounding have keys that overlap. If
 * there are many of them, a plane is not compared with each class. Its class is
 * found by its residue, in a table that is at most half full, the crowd. */
enum { FEW = 16, LEAST_SLOTS = 64 };
struct resident {
  uint64_t residue;
  uint32_t face; /* NONE: the slot is empty */
};
struct crowd {
  struct resident *slot;
  uint32_t n, n_slots; /* a power of two, or 0 */
};

/* The sweep of a section. From time to time, classes whose keys end before all
 * later ones are removed from `open`. */
struct sweep {
  struct hsr_world *world;
  const double *lo, *hi;
  struct open_class *open;
  uint32_t n_open, n_outside; /* of them, not in the crowd */
  uint32_t since_look;        /* faces */
  struct crowd crowd;
  bool out_of_memory;
};

static bool are_equal(struct sweep *s, uint32_t f, uint32_t g) {
  return hsr_exact_same_plane(hsr_face_loop(s->world, f),
                              hsr_face_loop(s->world, g), &s->out_of_memory);
}

static void leave_behind(struct sweep *s, double lo) {
  uint32_t kept = 0;
  for (uint32_t o = 0; o < s->n_open; o++) {
    if (s->open[o].hi < lo)
      s->n_outside -= !s->open[o].is_in_crowd;
    else
      s->open[kept++] = s->open[o];
  }
  s->n_open = kept;
  s->since_look = 0;
}

/* The class of face f among those that are open, or NONE. */
static uint32_t find_among_open(struct sweep *s, uint32_t f) {
  for (uint32_t o = 0; o < s->n_open; o++) {
    uint32_t g = s->open[o].face;
    if (maybe_parallel(s->world, f, g) && are_equal(s, f, g))
      return s->world->mesh.plane[g];
  }
  return NONE;
}

static struct resident *slot_from(const struct crowd *crowd, uint64_t residue) {
  return &crowd->slot[residue & (crowd->n_slots - 1)];
}

static struct resident *slot_after(const struct crowd *crowd,
                                   struct resident *slot) {
  return ++slot == crowd->slot + crowd->n_slots ? crowd->slot : slot;
}

static void settle_in(struct crowd *crowd, struct resident resident) {
  struct resident *slot = slot_from(crowd, resident.residue);
  while (slot->face != NONE)
    slot = slot_after(crowd, slot);
  *slot = resident;
  crowd->n++;
}

/* Makes room for one more. False: out of memory. */
static bool make_room(struct crowd *crowd) {
  if (2 * (crowd->n + 1) <= crowd->n_slots)
    return true;
  struct crowd larger = {.n_slots =
                             crowd->n_slots ? 2 * crowd->n_slots : LEAST_SLOTS};
  larger.slot = malloc(larger.n_slots * sizeof *larger.slot);
  if (!larger.slot)
    return false;
  for (uint32_t k = 0; k < larger.n_slots; k++)
    larger.slot[k].face = NONE;
  for (uint32_t k = 0; k < crowd->n_slots; k++)
    if (crowd->slot[k].face != NONE)
      settle_in(&larger, crowd->slot[k]);
  free(crowd->slot);
  *crowd = larger;
  return true;
}

/* Takes in all classes that are open. */
static void fill_crowd(struct sweep *s) {
  for (uint32_t o = 0; o < s->n_open && s->n_outside; o++) {
    struct open_class *open = &s->open[o];
    if (open->is_in_crowd)
      continue;
    if (!make_room(&s->crowd)) {
      s->out_of_memory = true;
      return;
    }
    uint64_t residue = hsr_plane_residue(hsr_face_loop(s->world, open->face));
    settle_in(&s->crowd, (struct resident){residue, open->face});
    open->is_in_crowd = true;
    s->n_outside--;
  }
}

/* The class of face f among those of the crowd that have this residue. */
static uint32_t find_alike(struct sweep *s, uint32_t f, uint64_t residue) {
  for (struct resident *slot = slot_from(&s->crowd, residue);
       slot->face != NONE; slot = slot_after(&s->crowd, slot))
    if (slot->residue == residue && are_equal(s, f, slot->face))
      return s->world->mesh.plane[slot->face];
  return NONE;
}

/* The same among all. A plane of which nothing is known may be equal to any. */
static uint32_t find_in_crowd(struct sweep *s, uint32_t f) {
  fill_crowd(s);
  uint64_t residue = hsr_plane_residue(hsr_face_loop(s->world, f));
  if (s->out_of_memory || !residue)
    return find_among_open(s, f);
  uint32_t found = find_alike(s, f, residue);
  return found == NONE ? find_alike(s, f, 0) : found;
}

/* The class of face f; *n_planes: how many there are so far. */
static uint32_t find_class(struct sweep *s, uint32_t f, uint32_t *n_planes) {
  if (s->n_open <= FEW || ++s->since_look >= s->n_open)
    leave_behind(s, s->lo[f]);
  uint32_t found =
      s->n_open <= FEW ? find_among_open(s, f) : find_in_crowd(s, f);
  if (found != NONE)
    return found;
  s->open[s->n_open++] = (struct open_class){s->hi[f], f, false};
  s->n_outside++;
  return (*n_planes)++;
}

/* Sweeps over the keys of a section. A plane is compared with the planes whose
 * key intervals overlap its own, one representative of each class. Classes are
 * numbered from 0. */
static void sweep(void *context, uint32_t k, int thread) {
  struct classes *c = context;
  struct section *section = &c->section[k];
  struct sweep s = {.world = c->world,
                    .lo = c->lo,
                    .hi = c->hi,
                    .open = c->open + section->begin};
  (void)thread;
  for (uint32_t i = section->begin; i < section->end && !s.out_of_memory; i++) {
    uint32_t f = c->from[i].face;
    c->world->mesh.plane[f] = find_class(&s, f, &section->n_planes);
  }
  free(s.crowd.slot);
  if (s.out_of_memory)
    atomic_store(&c->out_of_memory, true);
}

/* Of the last range nobody asks. */
static void find_highest(void *context, uint32_t k, int thread) {
  struct classes *c = context;
  struct hsr_range range = range_of(c, k);
  double highest = -INFINITY;
  (void)thread;
  for (uint32_t i = range.from; i < range.to && k + 1 < c->n_ranges; i++)
    highest = hsr_max(highest, c->hi[c->from[i].face]);
  c->section[k].highest = highest;
}

static void find_begin(void *context, uint32_t k, int thread) {
  struct classes *c = context;
  struct hsr_range range = range_of(c, k);
  double highest = c->section[k].highest;
  uint32_t i = range.from;
  (void)thread;
  while (i > 0 && i < range.to && !(highest < c->lo[c->from[i].face]))
    highest = hsr_max(highest, c->hi[c->from[i++].face]);
  c->section[k].begin = i < range.to ? i : NONE;
}

static void cut_sections(struct classes *c) {
  double highest = -INFINITY;
  share(c, find_highest);
  for (uint32_t k = 0; k < c->n_ranges; k++) {
    double own = c->section[k].highest;
    c->section[k].highest = highest;
    highest = hsr_max(highest, own);
  }
  share(c, find_begin);
  for (uint32_t k = c->n_ranges, end = c->world->n_faces; k--;) {
    bool begins = c->section[k].begin != NONE;
    if (!begins)
      c->section[k].begin = end; /* an empty one */
    c->section[k].end = end;
    end = c->section[k].begin;
  }
}

/* Numbers the classes of a section as those of the world. */
static void number_section(void *context, uint32_t k, int thread) {
  struct classes *c = context;
  const struct section *section = &c->section[k];
  (void)thread;
  for (uint32_t i = section->begin; section->first_plane && i < section->end;
       i++)
    c->world->mesh.plane[c->from[i].face] += section->first_plane;
}

static void find_classes(struct classes *c) {
  uint32_t n = 0;
  share(c, begin_range);
  sort_faces(c);
  cut_sections(c);
  share(c, sweep);
  for (uint32_t k = 0; k < c->n_ranges; k++) {
    c->section[k].first_plane = n;
    n += c->section[k].n_planes;
  }
  c->world->mesh.n_planes = n;
  share(c, number_section);
}

enum hsr_status hsr_world_classify_planes(struct hsr_world *world) {
  size_t n = world->n_faces;
  struct classes c = {.world = world,
                      .threads = hsr_threads(world->roster.scene->threads)};
  c.size = c.threads > 1 ? RANGE : world->n_faces + (world->n_faces == 0);
  c.n_ranges = hsr_n_ranges(world->n_faces, c.size);
  c.lo = malloc((n + 1) * sizeof *c.lo);
  c.hi = malloc((n + 1) * sizeof *c.hi);
  c.from = malloc((n + 1) * sizeof *c.from);
  c.to = malloc((n + 1) * sizeof *c.to);
  c.start = malloc((c.n_ranges + (size_t)1) * sizeof *c.start);
  c.section = calloc(c.n_ranges + (size_t)1, sizeof *c.section);
  c.open = malloc((n + 1) * sizeof *c.open);
  bool done = c.lo && c.hi && c.from && c.to && c.start && c.section && c.open;
  if (done)
    find_classes(&c);
  free(c.open);
  free(c.section);
  free(c.start);
  free(c.to);
  free(c.from);
  free(c.hi);
  free(c.lo);
  return done && !atomic_load(&c.out_of_memory) ? HSR_OK : HSR_E_NOMEM;
}
