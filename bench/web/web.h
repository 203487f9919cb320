/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The core in a page: what the files of this folder share. bench/web/core.js
 * calls these functions; docs/web.md says how.
 *
 * calls/       what a page calls:
 *   lists.c      what there is: scenes, kinds, algorithms
 *   scenes.c     opening scenes; their geometry
 *   drawing.c    drawing, and an answer as JSON
 *   judging.c    the judge
 *   survey.c     Table I, and the predictions of Table III
 *   steps.c      the steps of a run, as the stepping page reads them
 *   why.c        the faces that lie over a sample
 *   exports      the names of all calls
 * request.c    a request, from JSON
 * reply.c      what a call gives back
 * over.cc      the faces over a sample, for why.c
 * check.cc     whether arithmetic is what it should be
 * hash.c       a number that tells answers apart; also for native programs
 * left_out.c   in place of what a page cannot have
 *
 * Calls       a function returns an enum hsr_status. What it found is a JSON
 *             text, which web_reply gives; if it failed, web_reply gives the
 *             error's text. Both last until the next call.
 * Arrays      where an array belongs in the JSON text, there is its address; or
 *             null. It lasts until the next call, too.
 * Threads     there is one. */
#ifndef HSR_BENCH_WEB_H
#define HSR_BENCH_WEB_H

#include "bench/library/library.h"

#include <jansson.h>

/* Only these functions can be called from outside. */
#define WEB_CALL __attribute__((used, visibility("default")))

/* --- Replies (reply.c) ---------------------------------------------------- */

/* Begins a call: forgets what the last one gave. Returns where its functions
 * write their errors. */
struct hsr_error *web_begin(void);

/* Ends a call. Takes the caller's reference to its reply, which is NULL if
 * there is none, or for lack of memory. Returns the status of the call. */
enum hsr_status web_end(enum hsr_status status, json_t *reply);

/* Keeps memory of malloc until the next call. */
void *web_keep(void *memory);

/* Keeps an answer until the next call. */
void web_keep_answer(struct lib_answer *answer);

/* An array's address as JSON. */
json_t *web_address(const void *array);

/* A text, or null. */
json_t *web_text_or_null(const char *text);

/* --- Requests (request.c) ------------------------------------------------- */

/* A request, and what it points to. */
struct web_request {
  struct hsr_request request;
  struct lib_camera camera;
  json_t *json; /* that it was read from */
};

/* Reads a request: {algorithm, camera or view, m, n, window, counts, offset},
 * where camera is {eye, at, up, fov, near, parallel, light}. Every member may be
 * left out. To be freed also after a failure. HSR_E_USAGE, HSR_E_NOMEM. */
enum hsr_status web_request_read(struct web_request *request, const char *text,
                                 struct hsr_error *err);
void web_request_free(struct web_request *request);

/* --- Answers -------------------------------------------------------------- */

/* An answer as JSON (drawing.c): {kind, m, n, ids, rgba, segments, counts,
 * seconds, adapted, summary, hash}. Fails for lack of memory alone. */
enum hsr_status web_answer_json(struct lib_answer *answer, json_t **json,
                                struct hsr_error *err);

#endif
