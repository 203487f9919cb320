/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr render --tiles: pictures larger than memory.
 *
 * Beside FILE.exr a folder FILE.exr.tiles holds a file of each tile that is
 * done, and the file `plan`, which says what picture they are of. A tile's file
 * exists whole or not at all. So whenever a run ends, the folder is good, and
 * the same command goes on from there. When all tiles are there, they are
 * joined to FILE.exr, and the folder is removed.
 *
 * Several ranks take tiles from one queue, and each writes its own. They see
 * one folder. */
#include "config.h"

#include "bench/options/words.h"
#include "bench/render/render.h"
#include "bench/ranks/ranks.h"
#include "bench/terminal/terminal.h"
#include "common/base/clock.h"
#include "common/files/colour_tiles.h"
#include "common/files/whole_file.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

enum { MOST_PLAN = 4096, MOST_EXPOSED = 1024 };

struct tiles {
  struct render *render;
  const char *path; /* of the picture */
  struct hsr_tile_grid tiling;
  long all, found; /* those there were before */
  char name[MOST_FILE_NAME];
  struct progress progress;
};

/* --- The folder ----------------------------------------------------------- */

static const char *name_of_tile(struct tiles *t, long k) {
  snprintf(t->name, sizeof t->name, "%s.tiles/%06ld.exr", t->path, k);
  return t->name;
}

static const char *name_of_plan(struct tiles *t) {
  snprintf(t->name, sizeof t->name, "%s.tiles/plan", t->path);
  return t->name;
}

static const char *name_of_folder(struct tiles *t) {
  snprintf(t->name, sizeof t->name, "%s.tiles", t->path);
  return t->name;
}

static enum hsr_status fail_by_name(const char *name, struct hsr_error *err) {
  return hsr_fail(err, HSR_E_INPUT, "%s: cannot be written: %s", name,
                  strerror(errno));
}

static unsigned long checksum_of(const struct hsr_mesh *mesh) {
  const double *place[] = {mesh->x, mesh->y, mesh->z};
  uLong sum = crc32_z(0, NULL, 0);
  for (int a = 0; a < 3; a++)
    sum = crc32_z(sum, (const Bytef *)place[a],
                  mesh->n_vertices * sizeof *place[a]);
  return crc32_z(sum, (const Bytef *)mesh->vertex,
                 mesh->n_corners * sizeof *mesh->vertex);
}

static const struct hsr_camera *camera_of(const struct render *r) {
  return &r->scene->views[r->options->view.view - 1];
}

/* What the picture is of, by all that decides its samples. */
static void say_plan(const struct tiles *t, char plan[MOST_PLAN]) {
  const struct render *r = t->render;
  const struct hsr_camera *c = camera_of(r);
  snprintf(plan, MOST_PLAN,
           "hsr %s tiles of %s\nscene %.1500s, %u faces, checksum %08lx\n"
           "algorithm %.500s\nsamples %d x %d, tile %d\neye %a %a %a\n"
           "at %a %a %a\nup %a %a %a\nfov %a near %a parallel %a\n",
           PACKAGE_VERSION, r->kind->name, r->options->scene.name,
           r->world.n_faces, checksum_of(&r->world.mesh), r->options->algorithm,
           t->tiling.m, t->tiling.n, t->tiling.side, c->eye[0], c->eye[1],
           c->eye[2], c->at[0], c->at[1], c->at[2], c->up[0], c->up[1],
           c->up[2], c->fov, c->near, c->parallel);
}

static enum hsr_status write_plan(struct tiles *t, const char *plan,
                                  struct hsr_error *err) {
  struct hsr_whole_file file;
  enum hsr_status status = hsr_whole_file_open(&file, name_of_plan(t), err);
  if (status)
    return status;
  fputs(plan, file.stream);
  return hsr_whole_file_close(&file, HSR_OK, err);
}

static bool is_there(struct tiles *t, long k) {
  return !access(name_of_tile(t, k), F_OK);
}

/* Makes the folder, or finds it with tiles of the same picture. */
static enum hsr_status open_folder(struct tiles *t, struct hsr_error *err) {
  char plan[MOST_PLAN], there[MOST_PLAN] = "";
  say_plan(t, plan);
  if (mkdir(name_of_folder(t), 0777) && errno != EEXIST)
    return fail_by_name(t->name, err);
  FILE *file = fopen(name_of_plan(t), "r");
  if (!file)
    return errno == ENOENT ? write_plan(t, plan, err)
                           : fail_by_name(t->name, err);
  there[fread(there, 1, sizeof there - 1, file)] = '\0';
  fclose(file);
  if (strcmp(plan, there))
    return hsr_fail(err, HSR_E_INPUT,
                    "%s: holds tiles of another picture; remove it to begin "
                    "anew",
                    name_of_folder(t));
  for (long k = 0; k < t->all; k++)
    t->found += is_there(t, k);
  return HSR_OK;
}

static void remove_folder(struct tiles *t) {
  for (long k = 0; k < t->all; k++) {
    unlink(name_of_tile(t, k));
    hsr_whole_file_forget(t->name);
  }
  unlink(name_of_plan(t));
  rmdir(name_of_folder(t));
}

/* --- Drawing -------------------------------------------------------------- */

/* Of a kind that has no tiles of its own, the colours. */
enum { RGB = 3 };
static enum hsr_status write_colours(struct tiles *t, long k,
                                     struct hsr_error *err) {
  struct render *r = t->render;
  struct hsr_showing showing = showing_of(r);
  hsr_shaded_free(&r->shaded);
  enum hsr_status status =
      r->kind->shade(&r->answer, &showing, &r->shaded, err);
  return status ? status
                : hsr_image_write_colour_tile(name_of_tile(t, k), &t->tiling, k,
                                              RGB, r->shaded.rgb, NULL, err);
}

static enum hsr_status draw_tile(struct tiles *t, long k,
                                 struct hsr_error *err) {
  struct render *r = t->render;
  struct hsr_window window = hsr_tile_window(&t->tiling, k);
  int m = r->view.m, n = r->view.n; /* of the last tile */
  enum hsr_status status = hsr_view_init_tile(
      &r->view, camera_of(r), t->tiling.m, t->tiling.n, &window, err);
  if (status)
    return status;
  if (r->view.m != m || r->view.n != n)
    hsr_answer_free(&r->answer);
  status = draw_picture(r, err);
  double begin = hsr_seconds_now();
  if (!status)
    status = r->kind->write_tile
                 ? r->kind->write_tile(&r->answer, &t->tiling, k, NULL,
                                       name_of_tile(t, k), err)
                 : write_colours(t, k, err);
  r->write += hsr_seconds_now() - begin;
  return status;
}

/* Draws what is not there yet. */
static enum hsr_status draw_tiles(struct tiles *t, struct hsr_error *err) {
  struct render *r = t->render;
  enum hsr_status status = HSR_OK;
  struct queue queue;
  queue_open(&queue, t->all, true);
  for (long k; !status && (k = queue_take(&queue)) >= 0;) {
    if (is_there(t, k))
      continue;
    progress_tell(&t->progress, (size_t)(k > t->found ? k - t->found : 0),
                  (size_t)(t->all - t->found), "tiles", r->options->scene.name);
    status = draw_tile(t, k, err);
    r->n_pictures++;
  }
  return status;
}

/* --- Joining -------------------------------------------------------------- */

static const char *tell_and_name(void *whom, long k) {
  struct tiles *t = whom;
  progress_tell(&t->progress, (size_t)k, (size_t)t->all, "tiles joined",
                t->render->options->scene.name);
  return name_of_tile(t, k);
}

static enum hsr_status join(struct tiles *t, struct hsr_error *err) {
  struct render *r = t->render;
  double begin = hsr_seconds_now();
  char text[300];
  snprintf(text, sizeof text, "Software=hsr\nScene=%.100s\nAlgorithm=%s\n",
           r->options->scene.name, r->setup.algorithm->name);
  enum hsr_status status =
      r->kind->join_tiles
          ? r->kind->join_tiles(t->path, &t->tiling, tell_and_name, t, text,
                                err)
          : hsr_image_join_colour_tiles(t->path, &t->tiling, RGB, tell_and_name,
                                        t, text, err);
  r->write += hsr_seconds_now() - begin;
  if (!status)
    remove_folder(t);
  return status;
}

/* All tiles have one exposure. A picture of at most MOST_EXPOSED pixels a side, of
 * all that the tiles show, tells which. */
static enum hsr_status expose(struct tiles *t, struct hsr_error *err) {
  struct render *r = t->render;
  int m = t->tiling.m, n = t->tiling.n, most = m > n ? m : n;
  double by = most > MOST_EXPOSED ? (double)MOST_EXPOSED / most : 1;
  int width = (int)ceil(m * by), height = (int)ceil(n * by);
  enum hsr_status status =
      hsr_view_init(&r->view, camera_of(r), width, height, err);
  return status ? status : choose_exposure(r, err);
}

enum hsr_status make_tiles(struct render *r, struct hsr_error *err) {
  const struct render_options *o = r->options;
  struct tiles t = {.render = r,
                    .path = o->output[0],
                    .tiling = {o->view.m, o->view.n, (int)o->tile}};
  t.all = hsr_tile_count(&t.tiling);
  /* Rank 0 opens the folder before all others begin, and joins the tiles when
   * all have ended. */
  enum hsr_status status = ranks_own() ? HSR_OK : open_folder(&t, err);
  if (status)
    return status;
  ranks_wait();
  status = expose(&t, err);
  if (status)
    return status;
  t.progress = progress_begin(stderr);
  status = draw_tiles(&t, err);
  progress_end(&t.progress);
  if (status)
    return status;
  ranks_wait();
  t.progress = progress_begin(stderr);
  if (!ranks_own())
    status = join(&t, err);
  progress_end(&t.progress);
  r->n_tiles = t.all;
  r->n_found = t.found;
  return status;
}
