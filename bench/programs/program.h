/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A program in any language that draws: docs/programs.md has the protocol.
 *
 * Folder      what the program reads and writes is in a folder of its own: the
 *             job, the scene, the picture. It is gone when the program is.
 * Keeper      between this process and the program stands a process that
 *             outlives both, and does nothing but this: when one of them ends, it
 *             kills what the program has started, and removes the folder. So
 *             nothing is left however this process ends.
 * Time        a frame begins when its byte is written, and ends when its line has
 *             come. Bytes for several frames may be written at once. */
#ifndef HSR_BENCH_PROGRAMS_PROGRAM_H
#define HSR_BENCH_PROGRAMS_PROGRAM_H

#include "common/scene/world.h"
#include "common/view/view.h"

#include <jansson.h>
#include <sys/types.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What a program is started for. All borrowed. */
struct program_job {
  const char *path;   /* of the file that is run */
  const char *name;   /* by which errors call it */
  const char *word;   /* before the folder, on its command line; or NULL */
  const char *answer; /* the name of the kind of answer */
  const struct hsr_world *world; /* laid out; NULL: there are no files of the
                                    scene, which the program knows by name */
  const struct hsr_world *triangles; /* the same, or pieces of it */
  const char *scene;                 /* its name */
  long number;                       /* of the first view, from 1; 0: unknown */
  const struct hsr_view *view; /* n_views of one size, all whole pictures */
  int n_views;
  long threads;
  long memory_mb;        /* of data that it may hold; 0: any */
  bool (*stopped)(void); /* whether to give up waiting; or NULL */
};

/* What it says when it is ready: -1 where it says nothing. */
struct program_phases {
  double import, adapt, prepare;
  long before_kb; /* memory that it held before it prepared */
};

struct program;

/* Whether it has failed because it took too long. */
bool program_was_late(const struct program *program);

/* Writes the folder and starts the program. HSR_E_NOMEM; HSR_E_INPUT if the
 * folder cannot be written. *program is NULL after a failure. */
enum hsr_status program_start(const struct program_job *job,
                              struct program **program, struct hsr_error *err);

/* Waits for its first line. A failure here and below is HSR_E_INPUT: it ended, or
 * printed what is no line of the protocol. HSR_E_STOPPED if it took more than
 * `seconds`, which program_was_late() tells, or if `stopped` said so;
 * HSR_E_REFUSED if it ended with that status. */
enum hsr_status program_ready(struct program *program, double seconds,
                              struct program_phases *phases,
                              struct hsr_error *err);

/* Frames at a time at most. */
enum { PROGRAM_MOST_FRAMES = 4096 };

/* Has it draw n frames, by this byte: 'f', or 'c' to count. *spent, unless NULL,
 * becomes the time of all. *line, unless NULL, becomes what it said of the last
 * one, a new reference. */
enum hsr_status program_draw(struct program *program, char byte, long n,
                             double seconds, double *spent, json_t **line,
                             struct hsr_error *err);

/* Makes its file one of which nothing is written, so that what a frame does not
 * write shows. */
enum hsr_status program_unset(struct program *program, struct hsr_error *err);
enum hsr_status program_unset_ids(struct program *program,
                                  struct hsr_error *err);
enum hsr_status program_unset_segments(struct program *program,
                                       struct hsr_error *err);

/* The size of its picture. */
struct program_picture {
  int m, n;
  uint32_t n_faces; /* of the scene; 0: nobody knows */
};
struct program_picture program_picture(const struct program *program);

/* Says what is wrong with what it has drawn, and ends it. HSR_E_INPUT. */
enum hsr_status program_fail(struct program *program, const char *what,
                             struct hsr_error *err);

/* Reads m * n ids. HSR_E_INPUT if there are fewer or more, or one was not written
 * or is no face of the scene. */
enum hsr_status program_read_ids(struct program *program, uint32_t *ids,
                                 struct hsr_error *err);

/* Reads the intervals of edges, sorted. Their ends in space are left 0 unless there
 * are `edges`; an edge that is none of these is HSR_E_INPUT, too. */
struct hsr_edges;
struct hsr_drawing;
enum hsr_status program_read_segments(struct program *program,
                                      const struct hsr_edges *edges,
                                      struct hsr_drawing *drawing,
                                      struct hsr_error *err);

/* The path of a file in its folder; `path` has PROGRAM_PATH bytes. */
enum { PROGRAM_PATH = 320 };
void program_file(const struct program *program, const char *name, char *path);

/* The most memory that it has held so far; 0: unknown. */
long program_peak_kb(const struct program *program);

/* Ends its input and waits for its end. It fails if the program does not end, or
 * with another status than 0. Frees all in any case. NULL is allowed. */
enum hsr_status program_end(struct program *program, struct hsr_error *err);

/* The same for one that has failed: it is killed. */
void program_kill(struct program *program);

#ifdef __cplusplus
}
#endif
#endif
