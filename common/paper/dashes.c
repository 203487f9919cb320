/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/paper/dashes.h"

#include <math.h>
#include <stdlib.h>

static double way(const double a[2], const double b[2]) {
  return hypot(b[0] - a[0], b[1] - a[1]);
}

/* Whether a stroke turns much on its way from a by b to c. */
static bool is_corner(const double a[2], const double b[2], const double c[2]) {
  const double least = cos(HSR_CORNER_DEGREES * (3.14159265358979323846 / 180));
  const double dot =
      (b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1]);
  return dot < least * way(a, b) * way(b, c);
}

static bool append(struct hsr_dashes *d, double length) {
  if (d->n == d->room) {
    const size_t room = 2 * d->room + 16;
    double *more = realloc(d->length, room * sizeof *more);
    if (!more)
      return false;
    d->length = more;
    d->room = room;
  }
  d->length[d->n++] = length;
  return true;
}

/* The dashes of a run between two corners. Its first dash goes on from the last
 * one of the run before. */
static bool add_run(struct hsr_dashes *d, double length, double dash,
                    double gap) {
  const double wanted = fmax(2, round((length + gap) / (dash + gap)));
  const double stretch = length / (wanted * dash + (wanted - 1) * gap);
  if (d->n)
    d->length[d->n - 1] += stretch * dash;
  else if (!append(d, stretch * dash))
    return false;
  for (double k = 1; k < wanted; k++)
    if (!append(d, stretch * gap) || !append(d, stretch * dash))
      return false;
  return true;
}

/* Those of a closed stroke without a corner: as many gaps as dashes. */
static bool add_round(struct hsr_dashes *d, double length, double dash,
                      double gap) {
  const double n = fmax(2, round(length / (dash + gap)));
  const double stretch = length / (n * (dash + gap));
  for (double k = 0; k < n; k++)
    if (!append(d, stretch * dash) || !append(d, stretch * gap))
      return false;
  return true;
}

static bool find(struct hsr_dashes *d, const double (*at)[2], size_t n,
                 bool closed, double dash, double gap) {
  const double least = 2 * dash + gap; /* of a run */
  const size_t sides = closed ? n : n - 1;
  double left = 0; /* of the stroke */
  for (size_t k = 0; k < sides; k++)
    left += way(at[k], at[(k + 1) % n]);
  double run = 0;
  bool whole = true; /* no corner yet */
  for (size_t k = 0; k < sides; k++) {
    const double *a = at[k], *b = at[(k + 1) % n], *c = at[(k + 2) % n];
    run += way(a, b);
    left -= way(a, b);
    if (k + 1 == sides || run < least || left < least || !is_corner(a, b, c))
      continue;
    if (!add_run(d, run, dash, gap))
      return false;
    whole = false;
    run = 0;
  }
  const bool is_round =
      whole && closed && !is_corner(at[n - 1], at[0], at[1 % n]);
  return is_round ? add_round(d, run, dash, gap) : add_run(d, run, dash, gap);
}

enum hsr_status hsr_dashes_find(struct hsr_dashes *dashes,
                                const double (*at)[2], size_t n, bool closed,
                                double dash, double gap,
                                struct hsr_error *err) {
  dashes->n = 0;
  return find(dashes, at, n, closed, dash, gap) ? HSR_OK : hsr_fail_nomem(err);
}

void hsr_dashes_free(struct hsr_dashes *dashes) {
  free(dashes->length);
  *dashes = (struct hsr_dashes){.n = 0};
}

void hsr_dashes_cut(const struct hsr_dashes *dashes, const double (*at)[2],
                    size_t n, bool closed, void *on,
                    void (*move)(void *on, const double place[2]),
                    void (*line)(void *on, const double place[2])) {
  const size_t sides = closed ? n : n - 1;
  size_t part = 0;
  double left = dashes->n ? dashes->length[0] : 0;
  move(on, at[0]);
  for (size_t k = 0; k < sides; k++) {
    const double *a = at[k], *b = at[(k + 1) % n];
    const double length = way(a, b);
    double done = 0;
    /* The ends of dashes and gaps on this side. */
    while (part + 1 < dashes->n && done + left < length) {
      done += left;
      const double t = done / length;
      const double place[2] = {a[0] + t * (b[0] - a[0]),
                               a[1] + t * (b[1] - a[1])};
      if (part % 2)
        move(on, place);
      else
        line(on, place);
      left = dashes->length[++part];
    }
    left -= length - done;
    if (part % 2 == 0)
      line(on, b);
  }
}
