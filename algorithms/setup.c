/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/setup.h"
#include "common/base/clock.h"

/* Applies one adapter to what there is. */
static enum hsr_status apply(struct hsr_setup *setup,
                             const struct hsr_adapter *adapter,
                             struct hsr_error *err) {
  struct hsr_world out = {.roster.scene = NULL};
  bool changed = false;
  double begin = hsr_seconds_now();
  bool follows = setup->flags & HSR_FOLLOWS && adapter->follow;
  if (follows && !setup->kept && !(setup->kept = hsr_kept_priorities_new()))
    return hsr_fail_nomem(err);
  enum hsr_status status =
      follows ? adapter->follow(setup->world, setup->kept, &out, &changed, err)
              : adapter->adapt(setup->world, &out, &changed, err);
  double seconds = hsr_seconds_now() - begin;
  setup->adapt_seconds += seconds;
  if (!changed) /* it may have failed before it made anything */
    return status;
  hsr_world_free(&setup->adapted);
  setup->adapted = out;
  setup->world = &setup->adapted;
  setup->adaptation[setup->n_adaptations++] =
      (struct hsr_adaptation){adapter->name, out.n_faces, seconds};
  return status;
}

static enum hsr_status too_many_faces(const struct hsr_world *world,
                                      struct hsr_error *err) {
  return hsr_fail(err, HSR_E_REFUSED,
                  "%u faces are too many to be laid out, as it needs them",
                  world->n_faces);
}

static bool takes(const struct hsr_algorithm *algorithm,
                  enum hsr_scene_subject subject) {
  return algorithm->subjects & 1u << subject;
}

enum hsr_status hsr_setup_world(struct hsr_world *world,
                                const struct hsr_algorithm *algorithm,
                                const struct hsr_choice *choice,
                                struct hsr_scene *scene,
                                struct hsr_error *err) {
  return scene->grid && takes(algorithm, HSR_GRID)
             ? hsr_world_roster(world, scene, err)
             : hsr_world_open(world, scene,
                              hsr_most_laid_out(algorithm, choice), err);
}

/* Whether the scene is of what the algorithm takes. A grid has faces, too. */
static enum hsr_status check_subject(const struct hsr_algorithm *algorithm,
                                     const struct hsr_world *world,
                                     struct hsr_error *err) {
  const struct hsr_scene *scene = world->roster.scene;
  enum hsr_scene_subject subject = scene->subject;
  if (takes(algorithm, subject))
    return HSR_OK;
  if (subject == HSR_GRID && takes(algorithm, HSR_FACES))
    return hsr_scene_lacks_faces(scene) ? too_many_faces(world, err) : HSR_OK;
  return hsr_fail(err, HSR_E_REFUSED, "the scene is %s, which %s does not take",
                  hsr_scene_subject_name[subject], algorithm->name);
}

static bool takes_it(const struct hsr_setup *setup,
                     const struct hsr_world *world) {
  if (!hsr_is_roster(world))
    return true;
  return hsr_choice_takes_roster(setup->algorithm, &setup->choice) &&
         (!(setup->flags & HSR_LAID_OUT_UNLESS_LARGE) ||
          world->n_faces <= HSR_MOST_LAID_OUT);
}

/* Makes the world that the algorithm gets. */
static enum hsr_status adapt(struct hsr_setup *setup,
                             const struct hsr_world *world,
                             struct hsr_error *err) {
  const struct hsr_algorithm *algorithm = setup->algorithm;
  setup->world = world;
  enum hsr_status status = check_subject(algorithm, world, err);
  if (status)
    return status;
  if (!takes_it(setup, world))
    return too_many_faces(world, err);
  for (const struct hsr_adapter *a = hsr_adapters; a->name && !status; a++)
    if (!hsr_is_roster(world) &&
        (algorithm->restrictions & a->mends) == a->mends)
      status = apply(setup, a, err);
  return status;
}

static enum hsr_status prepare(struct hsr_setup *setup, struct hsr_error *err) {
  const struct hsr_algorithm *algorithm = setup->algorithm;
  setup->n_prepared = setup->world->n_faces;
  if (!algorithm->prepare)
    return HSR_OK;
  double begin = hsr_seconds_now();
  enum hsr_status status = algorithm->prepare(
      setup->world, setup->choice.values.option, &setup->prepared, err);
  setup->prepare_seconds += hsr_seconds_now() - begin;
  return status;
}

enum hsr_status hsr_setup_init(struct hsr_setup *setup,
                               const struct hsr_algorithm *algorithm,
                               const struct hsr_choice *choice,
                               const struct hsr_world *world,
                               struct hsr_error *err) {
  *setup = (struct hsr_setup){.algorithm = algorithm};
  setup->choice = choice ? *choice : hsr_choice_standard(algorithm);
  setup->flags = hsr_choice_flags(algorithm, &setup->choice);
  enum hsr_status status = adapt(setup, world, err);
  return status ? status : prepare(setup, err);
}

static void release(struct hsr_setup *setup) {
  if (setup->algorithm->release && setup->prepared)
    setup->algorithm->release(setup->prepared);
  setup->prepared = NULL;
}

enum hsr_status hsr_setup_rebuild(struct hsr_setup *setup,
                                  const struct hsr_algorithm *build,
                                  struct hsr_error *err) {
  release(setup);
  setup->algorithm = build;
  return prepare(setup, err);
}

enum hsr_status hsr_setup_follow(struct hsr_setup *setup,
                                 const struct hsr_world *world, bool *kept,
                                 struct hsr_error *err) {
  hsr_world_free(&setup->adapted);
  setup->adapted = (struct hsr_world){.n_faces = 0};
  setup->n_adaptations = 0;
  enum hsr_status status = adapt(setup, world, err);
  *kept = !status && setup->flags & HSR_FOLLOWS &&
          setup->world->n_faces == setup->n_prepared;
  if (status || *kept)
    return status;
  release(setup);
  return prepare(setup, err);
}

/* From pieces to the faces of the scene. */
static void name_parents(const struct hsr_pieces *pieces,
                         const struct hsr_job *job) {
  const struct hsr_window *w = &job->view->window;
  for (int j = w->y0; j < w->y1; j++) {
    uint32_t *row = job->answer->ids + (size_t)j * (size_t)job->answer->m;
    for (int i = w->x0; i < w->x1; i++)
      if (row[i] != HSR_BACKGROUND)
        row[i] = pieces->parent[row[i]];
  }
}

static void name_parent(const struct hsr_world *world, uint32_t *face) {
  if (*face != HSR_BACKGROUND)
    *face = hsr_world_parent(world, *face);
}

/* The faces of a step that is traced. A vertex of a face has the number that it
 * has in the scene laid out. */
static void name_subject(const struct hsr_world *world,
                         struct hsr_subject *subject) {
  switch (subject->kind) {
  case HSR_OF_FACE:
  case HSR_OF_PIECE:
    name_parent(world, &subject->id[0]);
    break;
  case HSR_OF_EDGE:
    name_parent(world, &subject->id[2]);
    break;
  case HSR_OF_IMPLIED:
    name_parent(world, &subject->id[0]);
    name_parent(world, &subject->id[1]);
    break;
  default:
    break;
  }
}

static void name_subjects(const void *names, struct hsr_event *event) {
  name_subject(names, &event->a);
  name_subject(names, &event->b);
}

enum hsr_status hsr_setup_render(const struct hsr_setup *setup,
                                 struct hsr_job *job, struct hsr_error *err) {
  job->world = setup->world;
  job->prepared = setup->prepared;
  job->option = setup->choice.values.option;
  job->real = setup->choice.values.real;
  if (!job->passes)
    job->passes = setup->passes;
  hsr_tally_begin(job->tally, setup->algorithm);
  if (job->tally->trace) {
    job->tally->trace->name = name_subjects;
    job->tally->trace->names = setup->world;
  }
  enum hsr_status status = setup->algorithm->render(job, err);
  if (!status && job->tally->out_of_memory)
    status = hsr_fail_nomem(err);
  if (!status && setup->world->pieces && job->answer->ids)
    name_parents(setup->world->pieces, job);
  return status;
}

struct hsr_shown hsr_setup_show(const struct hsr_setup *setup) {
  struct hsr_shown shown = {.octree = NULL};
  if (setup->algorithm->show)
    setup->algorithm->show(setup->prepared, &shown);
  return shown;
}

void hsr_setup_free(struct hsr_setup *setup) {
  release(setup);
  hsr_world_free(&setup->adapted);
  hsr_kept_priorities_free(setup->kept);
}
