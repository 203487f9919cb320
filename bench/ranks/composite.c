/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/ranks/composite.h"
#include "bench/ranks/ranks.h"
#include "common/exact/screen.h"

#include <stdlib.h>
#include <string.h>

static size_t samples_of(const struct composite *c) {
  return (size_t)c->view.m * (size_t)c->view.n;
}

static void clear(uint32_t *ids, size_t n) {
  for (size_t k = 0; k < n; k++)
    ids[k] = HSR_BACKGROUND;
}

enum hsr_status composite_init(struct composite *c, const struct hsr_view *view,
                               struct hsr_error *err) {
  *c = (struct composite){.view = *view};
  c->ids = malloc(samples_of(c) * sizeof *c->ids);
  if (!c->ids)
    return hsr_fail_nomem(err);
  clear(c->ids, samples_of(c));
  return HSR_OK;
}

void composite_free(struct composite *c) {
  free(c->ids);
  loose_faces_free(&c->faces);
}

/* --- The nearer of two faces ---------------------------------------------- */

/* Faces laid out, to be compared at samples of a view. */
struct comparer {
  const struct loose_faces *faces;
  struct hsr_scene *scene;
  struct hsr_world world;
  struct hsr_screen screen;
  struct hsr_arena arena;
  struct hsr_tally tally;
  double compared;
  uint32_t f, g; /* the places of the last two faces */
};

static enum hsr_status comparer_init(struct comparer *c,
                                     const struct loose_faces *faces,
                                     const struct hsr_view *view,
                                     struct hsr_error *err) {
  *c = (struct comparer){.faces = faces};
  enum hsr_status status =
      loose_faces_lay_out(faces, "seen", &c->scene, &c->world, err);
  if (status)
    return status;
  if (hsr_screen_init(&c->screen, &c->world, view, &c->arena))
    return hsr_fail_nomem(err);
  hsr_screen_planes(&c->screen);
  return HSR_OK;
}

static void comparer_free(struct comparer *c) {
  hsr_arena_free(&c->arena);
  hsr_world_free(&c->world);
  hsr_scene_delete(c->scene);
}

static uint32_t place_of(const struct comparer *c, uint32_t id, uint32_t last) {
  return c->faces->id[last] == id ? last : loose_faces_find(c->faces, id);
}

static bool is_nearer(void *whom, uint32_t f, uint32_t g, uint32_t sample) {
  struct comparer *c = whom;
  uint32_t m = (uint32_t)c->screen.view->m;
  c->f = place_of(c, f, c->f);
  c->g = place_of(c, g, c->g);
  c->compared++;
  return hsr_nearer(&c->screen, c->f, c->g, (int)(sample % m),
                    (int)(sample / m), &c->tally);
}

/* --- Merging -------------------------------------------------------------- */

/* Samples with their faces, as they are sent. */
struct fragments {
  struct ranks_seen *seen;
  size_t n;
  struct loose_faces faces;
};

static void fragments_free(struct fragments *fragments) {
  free(fragments->seen);
  loose_faces_free(&fragments->faces);
}

/* Whether two faces meet at any sample. */
static bool has_conflict(const struct composite *c,
                         const struct fragments *with) {
  for (size_t k = 0; k < with->n; k++) {
    uint32_t own = c->ids[with->seen[k].sample];
    if (own != HSR_BACKGROUND && own != with->seen[k].id)
      return true;
  }
  return false;
}

static void write_nearer(struct composite *c, const struct fragments *with,
                         struct ranks_seen *own,
                         const struct ranks_order *order) {
  for (size_t k = 0; k < with->n; k++)
    own[k] =
        (struct ranks_seen){with->seen[k].sample, c->ids[with->seen[k].sample]};
  ranks_reduce(with->seen, own, with->n, order);
  for (size_t k = 0; k < with->n; k++)
    c->ids[own[k].sample] = own[k].id;
}

/* Both have faces of their own; `all` has those of both. */
static enum hsr_status compare(struct composite *c,
                               const struct fragments *with,
                               const struct loose_faces *all,
                               struct hsr_error *err) {
  struct comparer comparer = {.faces = NULL};
  bool conflict = has_conflict(c, with);
  enum hsr_status status =
      conflict ? comparer_init(&comparer, all, &c->view, err) : HSR_OK;
  struct ranks_seen *own = malloc((with->n + 1) * sizeof *own);
  if (!status && !own)
    status = hsr_fail_nomem(err);
  if (!status)
    write_nearer(c, with, own, &(struct ranks_order){is_nearer, &comparer});
  free(own);
  c->compared += comparer.compared;
  if (!status && comparer.tally.out_of_memory)
    status = hsr_fail_nomem(err);
  comparer_free(&comparer);
  return status;
}

static enum hsr_status merge(struct composite *c, const struct fragments *with,
                             struct hsr_error *err) {
  struct loose_faces all;
  if (loose_faces_unite(&all, &c->faces, &with->faces))
    return hsr_fail_nomem(err);
  enum hsr_status status = compare(c, with, &all, err);
  loose_faces_free(&c->faces);
  c->faces = all;
  return status;
}

/* Forgets the faces that are not seen from sample `begin` to `end`. */
static enum hsr_status forget_hidden(struct composite *c, size_t begin,
                                     size_t end, struct hsr_error *err) {
  struct loose_faces seen;
  if (loose_faces_select(&seen, &c->faces, c->ids + begin, end - begin))
    return hsr_fail_nomem(err);
  loose_faces_free(&c->faces);
  c->faces = seen;
  return HSR_OK;
}

/* The samples from `begin` to `end` of a picture that show a face. */
static enum hsr_status list_covered(struct fragments *f,
                                    const uint32_t *picture, uint32_t first,
                                    size_t begin, size_t end) {
  size_t n = 0;
  for (size_t k = begin; k < end; k++)
    n += picture[k] != HSR_BACKGROUND;
  f->n = 0;
  f->seen = malloc((n + 1) * sizeof *f->seen);
  if (!f->seen)
    return HSR_E_NOMEM;
  for (size_t k = begin; k < end; k++)
    if (picture[k] != HSR_BACKGROUND)
      f->seen[f->n++] = (struct ranks_seen){(uint32_t)k, first + picture[k]};
  return HSR_OK;
}

enum hsr_status composite_add(struct composite *c,
                              const struct hsr_world *world, uint32_t first,
                              const uint32_t *picture, struct hsr_error *err) {
  struct fragments part = {.seen = NULL};
  size_t n = samples_of(c);
  enum hsr_status status =
      loose_faces_seen(&part.faces, world, first, picture, n) ||
              list_covered(&part, picture, first, 0, n)
          ? hsr_fail_nomem(err)
          : merge(c, &part, err);
  fragments_free(&part);
  return status ? status : forget_hidden(c, 0, n, err);
}

/* --- Between ranks -------------------------------------------------------- */

/* How much comes: samples, and bytes of faces. */
enum { SAMPLES, FACES, N_SIZES };

static enum hsr_status pack(const struct loose_faces *faces, char **bytes,
                            uint64_t *size) {
  *size = loose_faces_bytes(faces);
  *bytes = malloc(*size);
  if (*bytes)
    loose_faces_pack(faces, *bytes);
  return *bytes ? HSR_OK : HSR_E_NOMEM;
}

static void count_sent(struct composite *c, size_t bytes) {
  c->bytes += (double)bytes;
  c->messages += bytes > 0;
}

/* Sends what `out` has, and receives what the partner has. */
static enum hsr_status swap_with(struct composite *c, int partner,
                                 const struct fragments *out,
                                 struct fragments *in) {
  char *own = NULL, *other = NULL;
  uint64_t n_out[N_SIZES] = {out->n}, n_in[N_SIZES];
  if (pack(&out->faces, &own, &n_out[FACES]))
    return HSR_E_NOMEM;
  size_t own_seen = out->n * sizeof *out->seen;
  ranks_exchange(partner, n_out, sizeof n_out, n_in, sizeof n_in);
  in->n = n_in[SAMPLES];
  in->seen = malloc((in->n + 1) * sizeof *in->seen);
  other = malloc(n_in[FACES]);
  enum hsr_status status = in->seen && other ? HSR_OK : HSR_E_NOMEM;
  if (!status) {
    ranks_exchange(partner, out->seen, own_seen, in->seen,
                   in->n * sizeof *in->seen);
    ranks_exchange(partner, own, n_out[FACES], other, n_in[FACES]);
    status = loose_faces_unpack(&in->faces, other);
    count_sent(c, sizeof n_out);
    count_sent(c, own_seen);
    count_sent(c, n_out[FACES]);
  }
  free(own);
  free(other);
  return status;
}

/* Gives away the samples from `begin` to `end`, which are background then, and
 * takes in what the partner gives. */
static enum hsr_status trade(struct composite *c, int partner, size_t begin,
                             size_t end, struct hsr_error *err) {
  struct fragments out = {.seen = NULL}, in = {.seen = NULL};
  enum hsr_status status =
      loose_faces_select(&out.faces, &c->faces, c->ids + begin, end - begin) ||
              list_covered(&out, c->ids, 0, begin, end) ||
              swap_with(c, partner, &out, &in)
          ? hsr_fail_nomem(err)
          : HSR_OK;
  clear(c->ids + begin, end - begin);
  if (!status)
    status = merge(c, &in, err);
  fragments_free(&out);
  fragments_free(&in);
  return status;
}

/* The ranks 0 to `power` - 1 swap halves, then halves of these, and so on. A
 * rank's own samples are those from *begin to *end then. */
static enum hsr_status swap_halves(struct composite *c, int power,
                                   size_t *begin, size_t *end,
                                   struct hsr_error *err) {
  int own = ranks_own();
  enum hsr_status status = HSR_OK;
  for (int bit = power / 2; bit && !status; bit /= 2) {
    size_t middle = *begin + (*end - *begin) / 2;
    bool upper = own & bit;
    status = trade(c, own ^ bit, upper ? *begin : middle, upper ? middle : *end,
                   err);
    *(upper ? begin : end) = middle;
    if (!status)
      status = forget_hidden(c, *begin, *end, err);
  }
  return status;
}

enum hsr_status composite_gather(struct composite *c, struct hsr_error *err) {
  int n = ranks_count(), own = ranks_own(), power = 1;
  size_t begin = 0, end = samples_of(c);
  while (2 * power <= n)
    power *= 2;
  enum hsr_status status = HSR_OK;
  if (own >= power) /* has no partner to swap with */
    return trade(c, own - power, begin, end, err);
  if (own + power < n)
    status = trade(c, own + power, 0, 0, err);
  if (!status)
    status = swap_halves(c, power, &begin, &end, err);
  if (own)
    return status ? status : trade(c, 0, begin, end, err);
  for (int k = 1; k < power && !status; k++)
    status = trade(c, k, 0, 0, err);
  return status ? status : forget_hidden(c, 0, samples_of(c), err);
}

enum hsr_status composite_lay_out(const struct composite *c, const char *name,
                                  struct hsr_scene **scene,
                                  struct hsr_world *world, uint32_t *ids,
                                  struct hsr_error *err) {
  enum hsr_status status =
      loose_faces_lay_out(&c->faces, name, scene, world, err);
  for (size_t k = 0; k < samples_of(c) && !status; k++)
    ids[k] = c->ids[k] == HSR_BACKGROUND
                 ? HSR_BACKGROUND
                 : loose_faces_find(&c->faces, c->ids[k]);
  return status;
}

/* --- Faces alone ---------------------------------------------------------- */

static enum hsr_status send_faces(const struct loose_faces *faces) {
  char *bytes;
  uint64_t size;
  if (pack(faces, &bytes, &size))
    return HSR_E_NOMEM;
  ranks_exchange(0, &size, sizeof size, NULL, 0);
  ranks_exchange(0, bytes, size, NULL, 0);
  free(bytes);
  return HSR_OK;
}

static enum hsr_status receive_faces(struct loose_faces *faces, int from) {
  uint64_t size;
  struct loose_faces more, all;
  ranks_exchange(from, NULL, 0, &size, sizeof size);
  char *bytes = malloc(size);
  if (!bytes)
    return HSR_E_NOMEM;
  ranks_exchange(from, NULL, 0, bytes, size);
  enum hsr_status status = loose_faces_unpack(&more, bytes);
  free(bytes);
  if (status)
    return status;
  status = loose_faces_unite(&all, faces, &more);
  loose_faces_free(&more);
  if (status)
    return status;
  loose_faces_free(faces);
  *faces = all;
  return HSR_OK;
}

enum hsr_status composite_gather_faces(struct loose_faces *faces,
                                       struct hsr_error *err) {
  enum hsr_status status = ranks_own() ? send_faces(faces) : HSR_OK;
  for (int k = 1; k < ranks_count() && !ranks_own() && !status; k++)
    status = receive_faces(faces, k);
  return status ? hsr_fail_nomem(err) : HSR_OK;
}
