/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/check/candidates.h"
#include "bench/run/crew.h"

#include <stdlib.h>

/* --- Of a part ------------------------------------------------------------ */

/* Whom is asked: the oracle of ids, about the picture of a view. */
struct asking {
  const struct group *of;
  struct hsr_setup oracle;
  struct crew *crew;
  struct hsr_tally tally;
  struct hsr_answer answer;
  const uint32_t *place; /* of the view; NULL: all */
  size_t n_places;
};

static int clip(int x, int most) {
  return x < 0 ? 0 : x > most ? most : x;
}

/* The samples that a place is made of: its own, and of what is folded those of
 * the places around it. */
static struct hsr_window samples_of(const struct asking *a,
                                    const struct hsr_view *picture,
                                    uint32_t place) {
  const struct hsr_view *view = a->of->view;
  int columns = picture->m / view->m, rows = picture->n / view->n;
  int x = (int)(place % (uint32_t)view->m),
      y = (int)(place / (uint32_t)view->m);
  int reach = a->of->form.type->fold != NULL;
  return (struct hsr_window){clip((x - reach) * columns, picture->m),
                             clip((y - reach) * rows, picture->n),
                             clip((x + 1 + reach) * columns, picture->m),
                             clip((y + 1 + reach) * rows, picture->n)};
}

/* Draws a picture, or what is needed of it. */
static enum hsr_status draw(struct asking *a, const struct hsr_view *picture,
                            struct hsr_error *err) {
  struct hsr_view view = *picture;
  enum hsr_status status = HSR_OK;
  for (size_t k = 0; k < (a->place ? a->n_places : 1) && !status; k++) {
    if (a->place)
      view.window = samples_of(a, picture, a->place[k]);
    status =
        crew_render(a->crew, &a->oracle, &view, &a->answer, &a->tally, err);
  }
  return status;
}

static enum hsr_status add(struct loose_faces *candidates, struct asking *a,
                           const struct hsr_view *picture, uint32_t first,
                           struct hsr_error *err) {
  struct hsr_form form = hsr_form_standard(HSR_IDS);
  struct loose_faces more = {.n = 0}, all = {.n = 0};
  enum hsr_status status =
      hsr_answer_make(&a->answer, &form, picture, false, err);
  if (!status)
    status = draw(a, picture, err);
  if (!status && (loose_faces_seen(&more, a->of->world, first,
                                   hsr_answer_ids_of(&a->answer),
                                   (size_t)picture->m * (size_t)picture->n) ||
                  loose_faces_unite(&all, candidates, &more)))
    status = hsr_fail_nomem(err);
  hsr_answer_free(&a->answer);
  loose_faces_free(&more);
  if (status)
    return status;
  loose_faces_free(candidates);
  *candidates = all;
  return HSR_OK;
}

/* All pictures that are drawn for the view. */
static enum hsr_status add_pictures(struct loose_faces *candidates,
                                    struct asking *a, uint32_t first,
                                    struct hsr_error *err) {
  const struct hsr_form *form = &a->of->form;
  const struct hsr_fold *fold = form->type->fold;
  enum hsr_status status = HSR_OK;
  for (long k = 0; k < (fold ? fold->n(form) : 1) && !status; k++) {
    struct hsr_view picture = *a->of->view;
    if (fold)
      status = fold->view(form, a->of->view, k, &picture, err);
    if (!status)
      status = add(candidates, a, &picture, first, err);
  }
  return status;
}

enum hsr_status candidates_add(struct loose_faces *candidates,
                               const struct group *of, uint32_t first,
                               struct hsr_error *err) {
  struct asking a = {.of = of, .crew = crew_new(1)};
  uint32_t *place;
  enum hsr_status status =
      hsr_setup_init(&a.oracle, oracle_of(HSR_IDS), NULL, of->world, err);
  if (choose_places(*of->number, of->view->m, of->view->n, (size_t)of->samples,
                    &place, &a.n_places) ||
      !a.crew)
    status = status ? status : hsr_fail_nomem(err);
  a.place = place;
  if (!status)
    status = add_pictures(candidates, &a, first, err);
  free(place);
  crew_free(a.crew);
  hsr_setup_free(&a.oracle);
  return status;
}

/* --- Of all --------------------------------------------------------------- */

/* The numbers that candidates have among themselves become ids. */
static void name_faces(const struct loose_faces *candidates,
                       const struct wanted *wanted) {
  uint32_t *ids = hsr_answer_ids_of(&wanted->answer);
  for (size_t k = 0; ids && k < wanted->n; k++) {
    size_t at = wanted->sample ? wanted->sample[k] : k;
    if (ids[at] != HSR_BACKGROUND)
      ids[at] = candidates->id[ids[at]];
  }
}

enum hsr_status candidates_ask(const struct loose_faces *candidates,
                               const struct group *of, const char *name,
                               struct wanted *wanted, struct hsr_error *err) {
  struct hsr_scene *scene;
  struct hsr_world world;
  struct group all = *of;
  all.world = &world;
  enum hsr_status status =
      loose_faces_lay_out(candidates, name, &scene, &world, err);
  if (!status)
    status = ask_oracle(&all, oracle_of(of->form.type), wanted, err);
  if (!status)
    name_faces(candidates, wanted);
  hsr_world_free(&world);
  hsr_scene_delete(scene);
  return status;
}
