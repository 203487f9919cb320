/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Between the files of hsr scenes. */
#ifndef HSR_BENCH_SCENES_ONE_H
#define HSR_BENCH_SCENES_ONE_H

#include "common/base/status.h"

/* Tells all of one scene, built-in or in a file: what it is for, its parameters,
 * faces and cameras, and Table I of its first view. Fails as open_scene. */
enum hsr_status scenes_one(const char *name, struct hsr_error *err);

#endif
