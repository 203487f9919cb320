/* SPDX-License-Identifier: GPL-3.0-or-later */
#define _XOPEN_SOURCE 700 /* nftw */
#include "bench/programs/files.h"
#include "common/scene/pieces.h"

#include <errno.h>
#include <ftw.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* --- The job -------------------------------------------------------------- */

static void write_vector(FILE *file, const char *name, const double *v) {
  fprintf(file, "%s %.17g %.17g %.17g\n", name, v[0], v[1], v[2]);
}

static void write_camera(FILE *file, const struct hsr_view *view) {
  fprintf(file, "camera %s\n", view->parallel ? "parallel" : "perspective");
  write_vector(file, "eye", view->E);
  write_vector(file, "forward", view->F);
  write_vector(file, "right", view->R);
  write_vector(file, "up", view->U);
  fprintf(file, "near %.17g\n", view->near);
}

static void write_job(FILE *file, const struct program_job *job) {
  fprintf(file, "hsr-program 1\nanswer %s\nsize %d %d\nthreads %ld\n",
          job->answer, job->view->m, job->view->n, job->threads);
  fprintf(file, "cameras %d\n", job->n_views);
  for (int k = 0; k < job->n_views; k++)
    write_camera(file, &job->view[k]);
  fprintf(file, "view %ld\nscene %s\n", job->number, job->scene);
}

/* --- The scene ------------------------------------------------------------ */

static void write_header(FILE *file, uint32_t n_vertices, uint32_t n_faces) {
  fprintf(file,
          "ply\nformat ascii 1.0\nelement vertex %u\nproperty double x\n"
          "property double y\nproperty double z\nelement face %u\n"
          "property list uint uint vertex_indices\nproperty uint face\n"
          "property uchar one_sided\nend_header\n",
          n_vertices, n_faces);
}

/* The vertices of the world that was divided come first in one of pieces, and are
 * all that its loops use. */
static void write_scene(FILE *file, const struct hsr_world *whole,
                        const struct hsr_world *world) {
  const struct hsr_mesh *mesh = &world->mesh;
  write_header(file, whole->mesh.n_vertices, world->n_faces);
  for (uint32_t v = 0; v < whole->mesh.n_vertices; v++)
    fprintf(file, "%.17g %.17g %.17g\n", mesh->x[v], mesh->y[v], mesh->z[v]);
  for (uint32_t f = 0; f < world->n_faces; f++) {
    fprintf(file, "%u", hsr_face_size(world, f));
    for (uint32_t k = mesh->start[f]; k < mesh->start[f + 1]; k++)
      fprintf(file, " %u", mesh->vertex[k]);
    fprintf(file, " %u %d\n", world->pieces ? world->pieces->parent[f] : f,
            mesh->one_sided[f]);
  }
}

/* --- The folder ----------------------------------------------------------- */

static FILE *open_file(const char *folder, const char *name) {
  char path[PROGRAM_PATH];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  return fopen(path, "wbe");
}

/* Closes a file that was written; false if it could not be. */
static bool close_file(FILE *file) {
  bool good = file && !ferror(file);
  return file && !fclose(file) && good;
}

static bool make_job(const struct program_job *job, const char *folder) {
  FILE *file = open_file(folder, "job");
  if (file)
    write_job(file, job);
  return close_file(file);
}

static bool make_scene(const struct program_job *job, const char *folder,
                       const char *name, const struct hsr_world *world) {
  FILE *file = open_file(folder, name);
  if (file)
    write_scene(file, job->world, world);
  return close_file(file);
}

bool program_has_ids(const struct program_job *job) {
  return !strcmp(job->answer, "ids") || !strcmp(job->answer, "cells");
}

/* A file of zeros, as long as the picture. */
static bool make_ids(const struct program_job *job, const char *folder) {
  char path[PROGRAM_PATH];
  snprintf(path, sizeof path, "%s/ids", folder);
  return close_file(open_file(folder, "ids")) &&
         !truncate(path, (off_t)job->view->m * job->view->n *
                             (off_t)sizeof(uint32_t));
}

static bool make_files(const struct program_job *job, const char *folder) {
  return make_job(job, folder) &&
         (!job->world ||
          (make_scene(job, folder, "triangles.ply", job->triangles) &&
           make_scene(job, folder, "polygons.ply", job->world))) &&
         (!program_has_ids(job) || make_ids(job, folder));
}

enum hsr_status files_make(const struct program_job *job, char *folder,
                           struct hsr_error *err) {
  const char *above = getenv("TMPDIR");
  snprintf(folder, PROGRAM_PATH - 32, "%.200s/hsr-XXXXXX",
           above && *above ? above : "/tmp");
  if (!mkdtemp(folder))
    return hsr_fail(err, HSR_E_INPUT, "%s: %s", folder, strerror(errno));
  if (make_files(job, folder))
    return HSR_OK;
  hsr_fail(err, HSR_E_INPUT, "%s: %s", folder, strerror(errno));
  files_remove(folder);
  return HSR_E_INPUT;
}

static int remove_one(const char *path, const struct stat *about, int kind,
                      struct FTW *place) {
  (void)about;
  (void)place;
  return kind == FTW_DP ? rmdir(path) : unlink(path);
}

void files_remove(const char *folder) {
  nftw(folder, remove_one, 8, FTW_DEPTH | FTW_PHYS);
}
