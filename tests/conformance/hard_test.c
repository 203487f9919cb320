/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Algorithms against the oracles, on random scenes that are hard on floating
 * point numbers (hard_scene.h), in pictures from 1 x 1 on. Options of the
 * algorithms are chosen at random, too.
 *
 * usage: hard_test [SCENES [SEED [SHARE [FILE]]]]
 *
 * Standard: 300 scenes, seed 1, and of every SHARE = 6 algorithms one in each
 * scene; then the scenes of check_found(). Scene k of a run is made from the seed SEED + k - 1 alone. If FILE is
 * given, the last scene is written to it, for hsr check. */
#include "bench/modules/modules.h"
#include "algorithms/setup.h"
#include "scenes/scenes.h"
#include "tests/conformance/hard_scene.h"
#include "tests/draw.h"
#include "tests/tap.h"
#include "common/answers/kinds/polygons.h"
#include "common/answers/kinds/segments.h"

#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

enum { MOST_SIDE = 32, MOST_SECONDS = 20 };

static void make_view(uint64_t *seed, const struct hsr_camera *camera,
                      struct hsr_view *view, struct hsr_error *err) {
  int most = draw_integer(seed, 0, 2) ? 12 : MOST_SIDE;
  int columns = (int)draw_integer(seed, 1, most);
  int rows = (int)draw_integer(seed, 1, most);
  if (hsr_view_init(view, camera, columns, rows, err)) {
    view->m = 0;
    return;
  }
  draw_part(seed, view);
}

static void write_scene(FILE *file, const struct hsr_scene *scene) {
  const struct hsr_camera *c = &scene->views[0];
  fprintf(file, "{\"schema\": \"hsr-scene/1\", \"objects\": [");
  for (uint32_t o = 0; o < scene->n_objects; o++) {
    const struct hsr_object *object = &scene->objects[o];
    fprintf(file, "%s\n{\"name\": \"o%u\", \"one_sided\": %s, \"vertices\": [",
            o ? "," : "", o, object->one_sided ? "true" : "false");
    for (uint32_t v = 0; v < object->n_vertices; v++)
      fprintf(file, "%s[%.17g, %.17g, %.17g]", v ? ", " : "",
              object->xyz[3 * v], object->xyz[3 * v + 1],
              object->xyz[3 * v + 2]);
    fprintf(file, "], \"faces\": [");
    for (uint32_t f = 0; f < object->n_faces; f++)
      for (uint32_t k = object->start[f]; k < object->start[f + 1]; k++)
        fprintf(file, "%s%u%s",
                k > object->start[f] ? ", "
                : f                  ? ", ["
                                     : "[",
                object->vertex[k], k + 1 < object->start[f + 1] ? "" : "]");
    fprintf(file, "]}");
  }
  fprintf(file, "], \"instances\": [");
  for (uint32_t i = 0; i < scene->n_instances; i++) {
    fprintf(file, "%s\n{\"object\": %u, \"matrix\": [", i ? "," : "",
            scene->instances[i].object);
    for (int k = 0; k < 12; k++)
      fprintf(file, "%s%.17g", k ? ", " : "", scene->instances[i].m[k]);
    fprintf(file, "]}");
  }
  fprintf(file,
          "], \"views\": [\n{\"eye\": [%.17g, %.17g, %.17g], \"at\": [%.17g, "
          "%.17g, %.17g], \"up\": [%g, %g, %g], \"fov\": %.17g, \"near\": "
          "%.17g, \"parallel\": %.17g}]}\n",
          c->eye[0], c->eye[1], c->eye[2], c->at[0], c->at[1], c->at[2],
          c->up[0], c->up[1], c->up[2], c->fov, c->near, c->parallel);
}

/* --- Pictures ------------------------------------------------------------- */

struct comparison {
  uint64_t scene_seed, seed;
  int share;
  const struct hsr_world *world;
  const struct hsr_view *view;
  char name[160];
  uint32_t wanted[MOST_SIDE * MOST_SIDE], got[MOST_SIDE * MOST_SIDE];
  struct hsr_drawing wanted_lines, got_lines;
  long compared, wrong, refused, slow;
  double slowest;
};

/* What is drawn at the moment, for the limit. */
static char at_work[200];

/* A limit of processor time, whatever else the machine does; 0: none. */
static void limit(long seconds) {
  struct itimerval timer = {.it_value = {.tv_sec = seconds}};
  setitimer(ITIMER_PROF, &timer, NULL);
}

static void ring(int signal) {
  (void)signal;
  static const char text[] = "Bail out! it takes too long: ";
  if (write(STDOUT_FILENO, text, sizeof text - 1) < 0 ||
      write(STDOUT_FILENO, at_work, strlen(at_work)) < 0)
    _exit(98);
  _exit(99);
}

static struct hsr_choice choose(struct comparison *c,
                                const struct hsr_algorithm *a) {
  struct hsr_choice choice = hsr_choice_standard(a);
  for (int k = 0; a->options && a->options[k].name; k++) {
    const struct hsr_option *o = &a->options[k];
    int words = 0;
    while (o->words && o->words[words].name)
      words++;
    long most = 2 * o->standard + 8 < o->most ? 2 * o->standard + 8 : o->most;
    if (draw_integer(&c->seed, 0, 1))
      continue;
    if (o->real)
      choice.values.real[k] =
          o->real_least + (o->real_most - o->real_least) *
                              (double)draw_integer(&c->seed, 0, 64) / 64;
    else
      choice.values.option[k] =
          o->words ? (long)draw_integer(&c->seed, 0, words - 1)
                   : (long)draw_integer(&c->seed, o->least, most);
  }
  return choice;
}

static void tell(const struct comparison *c, const struct hsr_algorithm *a,
                 const struct hsr_choice *choice, const char *what) {
  printf("# %s: %s", c->name, a->name);
  for (int k = 0; a->options && a->options[k].name; k++) {
    const struct hsr_option *o = &a->options[k];
    long value = choice->values.option[k];
    if (o->real)
      printf(":%s=%g", o->name, choice->values.real[k]);
    else if (value != o->standard && o->words)
      printf(":%s=%s", o->name, o->words[value].name);
    else if (value != o->standard)
      printf(":%s=%ld", o->name, value);
  }
  printf(" %s\n", what);
  fflush(stdout);
}

/* Visible polygons are sampled. */
static enum hsr_status draw_polygons(const struct hsr_setup *setup,
                                     struct hsr_job *job, uint32_t *ids,
                                     struct hsr_error *err) {
  struct hsr_answer answer;
  enum hsr_status status =
      hsr_answer_make(&answer, &setup->choice.form, job->view, false, err);
  job->answer = &answer;
  if (!status)
    status = hsr_setup_render(setup, job, err);
  if (!status)
    status =
        hsr_polygons_ids(hsr_answer_polygons_of(&answer), job->view, ids, err);
  hsr_answer_free(&answer);
  return status;
}

/* Draws with these options. False if the scene is refused. */
static bool draw(struct comparison *c, const struct hsr_algorithm *a,
                 const struct hsr_choice *choice, bool lines, uint32_t *ids,
                 struct hsr_drawing *drawing) {
  struct hsr_error err = {.text = ""};
  struct hsr_arena scratch = HSR_ARENA_EMPTY;
  struct hsr_tally tally = {.out_of_memory = false};
  struct hsr_setup setup;
  struct hsr_answer answer =
      lines ? hsr_answer_of_drawing(drawing, c->view->m, c->view->n)
            : hsr_answer_of_ids(ids, c->view->m, c->view->n);
  struct hsr_job job = {
      .view = c->view, .scratch = &scratch, .tally = &tally, .answer = &answer};
  if (lines)
    hsr_drawing_clear(drawing);
  else
    memset(ids, 0xfe, sizeof c->got);
  snprintf(at_work, sizeof at_work, "%s, %s\n", c->name, a->name);
  limit(6L * MOST_SECONDS);
  clock_t from = clock();
  enum hsr_status status = hsr_setup_init(&setup, a, choice, c->world, &err);
  if (!status)
    status = hsr_own_kind(a) == HSR_POLYGONS
                 ? draw_polygons(&setup, &job, ids, &err)
                 : hsr_setup_render(&setup, &job, &err);
  double seconds = (double)(clock() - from) / CLOCKS_PER_SEC;
  limit(0);
  if (seconds > c->slowest)
    c->slowest = seconds;
  if (seconds > MOST_SECONDS) {
    c->slow++;
    tell(c, a, choice, "is slow");
  }
  if (status && status != HSR_E_REFUSED) {
    tell(c, a, choice, err.text);
    c->wrong++;
  }
  hsr_setup_free(&setup);
  hsr_arena_free(&scratch);
  c->refused += status == HSR_E_REFUSED;
  return !status;
}

static void compare(struct comparison *c, const struct hsr_algorithm *a,
                    bool lines) {
  if (draw_integer(&c->seed, 1, c->share) != 1)
    return;
  struct hsr_choice choice = choose(c, a);
  if (hsr_choice_flags(a, &choice) & (HSR_KNOWN_WRONG | HSR_NO_PICTURE))
    choice = hsr_choice_standard(a);
  if (hsr_choice_flags(a, &choice) &
          (HSR_KNOWN_WRONG | HSR_NO_PICTURE | HSR_JUDGE) ||
      !draw(c, a, &choice, lines, c->got, &c->got_lines))
    return;
  long differing;
  if (lines) {
    struct hsr_drawing_difference difference;
    hsr_drawing_compare(&c->got_lines, &c->wanted_lines,
                        hsr_makes_how(a, HSR_SEGMENTS) & HSR_VISIBLE_ONLY,
                        &difference);
    differing = (long)difference.differing;
  } else {
    differing = count_differences(c->view, c->got, c->wanted);
  }
  c->compared++;
  c->wrong += differing > 0;
  if (differing)
    tell(c, a, &choice, "is wrong");
}

/* All but the scene itself, which FILE holds. */
static void name(struct comparison *c, enum hard_scale scale) {
  const struct hsr_view *v = c->view;
  snprintf(c->name, sizeof c->name,
           "seed %llu (%s, %u faces), %d x %d, columns %d to %d, rows %d to %d "
           "(%g, %g)",
           (unsigned long long)c->scene_seed, hard_scale_name[scale],
           c->world->n_faces, v->m, v->n, v->window.x0, v->window.x1,
           v->window.y0, v->window.y1, v->offset_x, v->offset_y);
}

/* Both oracles, and then the algorithms. False if the scene is not valid. */
static bool check_scene(struct comparison *c, const char *file) {
  struct hsr_camera camera;
  enum hard_scale scale;
  struct hsr_scene *scene = hard_scene(c->scene_seed, &camera, &scale);
  if (!scene)
    return false;
  if (file) {
    FILE *out = fopen(file, "w");
    if (!out)
      bail("cannot write the scene");
    write_scene(out, scene);
    fclose(out);
  }
  struct hsr_error err;
  struct hsr_world world;
  struct hsr_view view;
  c->seed = c->scene_seed;
  make_view(&c->seed, &camera, &view, &err);
  bool valid = !hsr_world_init(&world, scene, &err) && view.m;
  if (valid) {
    const char *const oracle[2] = {"oracle", "line-oracle"};
    c->world = &world;
    c->view = &view;
    name(c, scale);
    for (int lines = 0; lines < 2; lines++) {
      const struct hsr_algorithm *judge =
          hsr_algorithm_find(oracle[lines])->plain;
      struct hsr_choice standard = hsr_choice_standard(judge);
      if (!draw(c, judge, &standard, lines, c->wanted, &c->wanted_lines))
        continue;
      for (const struct hsr_listed *l = hsr_algorithms(); l->plain; l++)
        if ((hsr_own_kind(l->plain) == (lines ? HSR_SEGMENTS : HSR_IDS) ||
             (!lines && hsr_own_kind(l->plain) == HSR_POLYGONS)) &&
            !(l->plain->flags & HSR_JUDGE))
          compare(c, draw_integer(&c->seed, 0, 1) ? l->plain : l->counting,
                  lines);
    }
  }
  hsr_world_free(&world);
  hsr_scene_delete(scene);
  return valid;
}

/* Scenes that took some algorithm minutes once, by all algorithms. */
static void check_found(struct comparison *c, struct tap *tap) {
  static const uint64_t found[] = {363, 500398, 509257};
  c->share = 1;
  c->wrong = c->slow = 0;
  for (size_t k = 0; k < sizeof found / sizeof *found; k++) {
    c->scene_seed = found[k];
    check_scene(c, NULL);
  }
  ok(tap, !c->wrong && !c->slow, "scenes once found: %ld wrong, %ld slow",
     c->wrong, c->slow);
}

int main(int argc, char **argv) {
  static struct comparison c;
  long n = argc > 1 ? atol(argv[1]) : 300, done = 0;
  uint64_t seed = argc > 2 ? strtoull(argv[2], NULL, 10) : 1;
  c.share = argc > 3 ? atoi(argv[3]) : 6;
  enum { PARTS = 10 };
  struct tap tap = plan(PARTS + (argc == 1));
  if (n < 1 || c.share < 1)
    bail("usage: hard_test [SCENES [SEED [SHARE [FILE]]]]");
  signal(SIGPROF, ring);
  for (long part = 0, k = 0; part < PARTS; part++) {
    long first = k;
    c.wrong = c.slow = 0;
    for (; k < n * (part + 1) / PARTS; k++) {
      c.scene_seed = seed + (uint64_t)k;
      done += check_scene(&c, k + 1 == n && argc > 4 ? argv[4] : NULL);
    }
    ok(&tap, !c.wrong && !c.slow, "seeds %llu to %llu: %ld wrong, %ld slow",
       (unsigned long long)seed + (unsigned long long)first,
       (unsigned long long)seed + (unsigned long long)k - 1, c.wrong, c.slow);
  }
  if (argc == 1)
    check_found(&c, &tap);
  hsr_drawing_free(&c.wanted_lines);
  hsr_drawing_free(&c.got_lines);
  printf("# %ld of %ld scenes valid, %ld answers compared, %ld refused, the "
         "slowest %.1f s\n",
         done, n, c.compared, c.refused, c.slowest);
  return finish(&tap);
}
