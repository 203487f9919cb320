/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Other ways of finding the pieces that P may obscure: by groups of faces, and
 * by a lateral sort.
 *
 * Source      Sutherland et al. 1974, chapter IV. "Frame and Object Coherence":
 *             Newell's special sort might compare groups of faces rather than
 *             faces. "Area Coherence": it might sort laterally, where it only
 *             culls the list, and keep what its X and Y tests tell.
 * Notation    group -> the faces of an instance; the boxes of their pieces in
 *             X, Y and Z hold them all. Lateral order -> cells: the window is
 *             divided into rectangles, each with the pieces whose boxes reach
 *             into it
 * Invariants  A piece is in the chain of its group, or in those of its cells.
 *             Chains are by the bucket of the farthest depth, farthest first;
 *             so are groups, by that of their first piece. A piece that
 *             has left the list is removed from a chain when the chain is next
 *             searched. A piece
 *             that P may obscure has a sample where P has one, and so it shares
 *             a cell with P.
 * Ties        any piece that P may obscure may be tried in P's place, not only
 *             the first in the list; so there may be other interchanges
 * Departures  The survey would take Schumacker's clusters, which an adapter
 *             makes by dividing faces; an instance is there already. It does
 *             not say how to sort laterally. Cells are as large as pieces are
 *             in the mean, but so that these are in CELLS_A_PIECE or fewer
 * Cost        one comparison for each group, and for each piece of those that
 *             are not apart from P; or one for each piece in P's cells, and one
 *             more where it is met in a further cell of them */
#include "algorithms/list_priority/per_frame/priority_pieces.h"

enum { CELLS_A_PIECE = 8 };

/* No link. */
static const uint32_t NONE = UINT32_MAX;

struct link {
  uint32_t piece, next;
};

static struct link *link_at(const struct hsr_list_index *index, uint32_t l) {
  return (struct link *)index->links.items + l;
}

/* --- Chains --------------------------------------------------------------- */

/* Puts a piece into a chain, after those that are farther. */
static void put_into_chain(struct hsr_priority_list *s, uint32_t p,
                           uint32_t chain) {
  struct hsr_list_index *index = s->index;
  uint32_t bucket = piece_at(s, p)->bucket, before = NONE;
  uint32_t at = index->chain[chain];
  while (at != NONE &&
         piece_at(s, link_at(index, at)->piece)->bucket < bucket) {
    HSR_STEP(s->tally, index->sort, subject(s, p),
             subject(s, link_at(index, at)->piece), *s->window, 1);
    before = at;
    at = link_at(index, at)->next;
  }
  HSR_STEP(s->tally, index->sort, subject(s, p), HSR_NOTHING, *s->window, 0);
  if (!hsr_arena_grow(s->job->scratch, &index->links, sizeof(struct link))) {
    s->out_of_memory = true;
    return;
  }
  uint32_t l = (uint32_t)index->links.n - 1;
  *link_at(index, l) = (struct link){p, at};
  if (before == NONE)
    index->chain[chain] = l;
  else
    link_at(index, before)->next = l;
}

/* The next link whose piece is still in the list: drops others. */
static uint32_t next_link(const struct hsr_priority_list *s, uint32_t *link) {
  while (*link != NONE && piece_at(s, link_at(s->index, *link)->piece)->gone)
    *link = link_at(s->index, *link)->next;
  return *link;
}

/* A piece of a chain that P may obscure and that P has not met, or NONE. */
static uint32_t find_in_chain(struct hsr_priority_list *s, uint32_t p,
                              uint32_t chain, uint32_t bucket) {
  struct hsr_list_index *index = s->index;
  uint32_t *link = &index->chain[chain];
  for (; next_link(s, link) != NONE; link = &link_at(index, *link)->next) {
    uint32_t q = link_at(index, *link)->piece;
    struct hsr_list_piece *Q = piece_at(s, q);
    if (q == p)
      continue;
    if (Q->bucket > bucket) {
      HSR_STEP(s->tally, HSR_LIST_SPECIAL, subject(s, p), subject(s, q),
               *s->window, HSR_BEYOND_Q_ENDS);
      break;
    }
    if (Q->seen == index->candidate) {
      HSR_STEP(s->tally, index->again, subject(s, p), subject(s, q), *s->window,
               0);
      continue;
    }
    Q->seen = index->candidate;
    if (hsr_list_may_obscure(s, p, q))
      return q;
  }
  return HSR_NO_PIECE;
}

static bool make_chains(struct hsr_priority_list *s, uint32_t n) {
  struct hsr_list_index *index = s->index;
  index->links.n = 0;
  index->n_chains = n;
  index->chain = HSR_NEW(s->job->scratch, uint32_t, n);
  if (!index->chain)
    return false;
  for (uint32_t k = 0; k < n; k++)
    index->chain[k] = NONE;
  return true;
}

/* --- Groups --------------------------------------------------------------- */

static uint32_t group_of(const struct hsr_priority_list *s, uint32_t p) {
  return s->job->world->mesh.instance[piece_at(s, p)->part.face];
}

/* Widens a group's box by a piece. */
static void enclose(struct hsr_list_group *group,
                    const struct hsr_list_piece *piece) {
  const struct hsr_bounds *b = &piece->part.bounds;
  struct hsr_bounds *all = &group->bounds;
  all->x0 = b->x0 < all->x0 ? b->x0 : all->x0;
  all->y0 = b->y0 < all->y0 ? b->y0 : all->y0;
  all->x1 = b->x1 > all->x1 ? b->x1 : all->x1;
  all->y1 = b->y1 > all->y1 ? b->y1 : all->y1;
  group->farthest = fmax(group->farthest, piece->farthest);
}

static bool sort_groups(struct hsr_priority_list *s) {
  struct hsr_list_index *index = s->index;
  uint32_t n = s->job->world->roster.scene->n_instances;
  index->group = HSR_NEW(s->job->scratch, struct hsr_list_group, n);
  index->order = HSR_NEW(s->job->scratch, uint32_t, n);
  if (!make_chains(s, n) || !index->group || !index->order)
    return false;
  index->n_groups = index->first_group = 0;
  for (uint32_t k = 0; k < s->pieces.n; k++) {
    const struct hsr_list_piece *piece = piece_at(s, s->order[k]);
    uint32_t g = group_of(s, s->order[k]);
    if (index->chain[g] == NONE) {
      index->chain[g] = 0; /* met */
      index->order[index->n_groups++] = g;
      index->group[g] = (struct hsr_list_group){.bounds = piece->part.bounds,
                                                .farthest = piece->farthest,
                                                .bucket = piece->bucket};
    }
    enclose(&index->group[g], piece);
  }
  for (uint32_t k = 0; k < index->n_groups; k++)
    index->chain[index->order[k]] = NONE;
  return true;
}

/* How a group lies to P, as the counter names it. */
enum lies { GROUPS_END, APART_IN_Z, APART_IN_X, APART_IN_Y, NEAR };

static enum lies compare_group(const struct hsr_list_piece *P,
                               const struct hsr_list_group *group,
                               uint32_t bucket) {
  const struct hsr_bounds *b = &P->part.bounds, *all = &group->bounds;
  return group->bucket > bucket                 ? GROUPS_END
         : P->nearest > group->farthest         ? APART_IN_Z
         : b->x1 <= all->x0 || all->x1 <= b->x0 ? APART_IN_X
         : b->y1 <= all->y0 || all->y1 <= b->y0 ? APART_IN_Y
                                                : NEAR;
}

static uint32_t find_in_groups(struct hsr_priority_list *s, uint32_t p,
                               uint32_t bucket) {
  struct hsr_list_index *index = s->index;
  while (index->first_group < index->n_groups &&
         next_link(s, &index->chain[index->order[index->first_group]]) == NONE)
    index->first_group++;
  for (uint32_t k = index->first_group; k < index->n_groups; k++) {
    uint32_t g = index->order[k];
    if (next_link(s, &index->chain[g]) == NONE)
      continue;
    enum lies lies = compare_group(piece_at(s, p), &index->group[g], bucket);
    HSR_STEP(s->tally, index->groups, subject(s, p), HSR_VOLUME(g), *s->window,
             (int)lies);
    if (lies == GROUPS_END)
      break;
    uint32_t q = lies == NEAR ? find_in_chain(s, p, g, bucket) : HSR_NO_PIECE;
    if (q != HSR_NO_PIECE)
      return q;
  }
  return HSR_NO_PIECE;
}

/* --- Cells ---------------------------------------------------------------- */

/* The cells that a box reaches into: columns [x0, x1), rows [y0, y1). */
static struct hsr_bounds cells_of(const struct hsr_priority_list *s,
                                  const struct hsr_bounds *b) {
  const struct hsr_list_index *index = s->index;
  return (struct hsr_bounds){(b->x0 - s->window->x0) / index->width,
                             (b->y0 - s->window->y0) / index->height,
                             (b->x1 - 1 - s->window->x0) / index->width + 1,
                             (b->y1 - 1 - s->window->y0) / index->height + 1};
}

/* How many links the cells would take. */
static uint64_t count_links(const struct hsr_priority_list *s) {
  uint64_t n = 0;
  for (uint32_t p = 0; p < s->pieces.n; p++) {
    struct hsr_bounds c = cells_of(s, &piece_at(s, p)->part.bounds);
    n += (uint64_t)(c.x1 - c.x0) * (uint64_t)(c.y1 - c.y0);
  }
  return n;
}

static void choose_cells(struct hsr_priority_list *s) {
  struct hsr_list_index *index = s->index;
  uint64_t n = s->pieces.n, width = 0, height = 0;
  for (uint32_t p = 0; p < n; p++) {
    const struct hsr_bounds *b = &piece_at(s, p)->part.bounds;
    width += (uint64_t)(b->x1 - b->x0);
    height += (uint64_t)(b->y1 - b->y0);
  }
  index->width = n ? (int)((width + n - 1) / n) : 1;
  index->height = n ? (int)((height + n - 1) / n) : 1;
  while (count_links(s) > CELLS_A_PIECE * n) {
    index->width *= 2;
    index->height *= 2;
  }
}

static void put_into_cells(struct hsr_priority_list *s, uint32_t p) {
  const struct hsr_list_index *index = s->index;
  struct hsr_bounds c = cells_of(s, &piece_at(s, p)->part.bounds);
  for (int y = c.y0; y < c.y1; y++)
    for (int x = c.x0; x < c.x1; x++)
      put_into_chain(s, p, (uint32_t)(y * index->columns + x));
}

static bool sort_laterally(struct hsr_priority_list *s) {
  struct hsr_list_index *index = s->index;
  const struct hsr_window *w = s->window;
  choose_cells(s);
  index->columns = (w->x1 - w->x0 - 1) / index->width + 1;
  int rows = (w->y1 - w->y0 - 1) / index->height + 1;
  return make_chains(s, (uint32_t)(index->columns * rows));
}

static uint32_t find_in_cells(struct hsr_priority_list *s, uint32_t p,
                              uint32_t bucket) {
  struct hsr_bounds c = cells_of(s, &piece_at(s, p)->part.bounds);
  for (int y = c.y0; y < c.y1; y++)
    for (int x = c.x0; x < c.x1; x++) {
      uint32_t cell = (uint32_t)(y * s->index->columns + x);
      uint32_t q = find_in_chain(s, p, cell, bucket);
      if (q != HSR_NO_PIECE)
        return q;
    }
  return HSR_NO_PIECE;
}

/* --- Either --------------------------------------------------------------- */

void hsr_index_add(struct hsr_priority_list *s, uint32_t p) {
  if (s->index->by_groups)
    put_into_chain(s, p, group_of(s, p));
  else
    put_into_cells(s, p);
}

/* The nearest piece is put first, so each is put at the head of a chain. */
void hsr_index_sort(struct hsr_priority_list *s) {
  s->index->candidate = 0;
  if (!(s->index->by_groups ? sort_groups : sort_laterally)(s)) {
    s->out_of_memory = true;
    return;
  }
  for (size_t k = s->pieces.n; k-- > 0;)
    hsr_index_add(s, s->order[k]);
}

uint32_t hsr_index_find(struct hsr_priority_list *s, uint32_t p,
                        uint32_t bucket) {
  s->index->candidate++;
  return (s->index->by_groups ? find_in_groups : find_in_cells)(s, p, bucket);
}
