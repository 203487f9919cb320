/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What commands share that go through hsr.h. */
#ifndef HSR_BENCH_CLIENT_H
#define HSR_BENCH_CLIENT_H

#include "bench/library/within.h"
#include "bench/options/view.h"

/* Opens the scene of a command, which the caller closes by hsr_close, and says
 * on stderr what was left out of it. Errors as hsr_open; HSR_E_USAGE also if it
 * has no such view, unless `view` is NULL. */
enum hsr_status client_open(const struct scene_options *options,
                            const struct view_options *view,
                            struct lib_scene **scene, struct hsr_error *err);

/* A request for the view of a command by an algorithm, which is borrowed, with
 * `samples` x `samples` samples a pixel. */
struct hsr_request client_request(const struct view_options *options,
                                  const char *algorithm, int samples);

#endif
