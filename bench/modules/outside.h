/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Modules outside of the tree: a shared object, which is loaded
 * (docs/modules-outside.md). */
#ifndef HSR_BENCH_MODULES_OUTSIDE_H
#define HSR_BENCH_MODULES_OUTSIDE_H

#include "common/base/status.h"

/* Loads a module, whose algorithm joins the list of all. To be called before
 * anybody asks for that list. Processes that this one starts load it as well.
 * HSR_E_INPUT if it cannot be loaded, or is of another version of hsr, or no
 * module; HSR_E_USAGE if its name is taken, or if there are too many. */
enum hsr_status outside_load(const char *path, struct hsr_error *err);

/* The paths of all that is loaded, with a newline between them; "": nothing. */
const char *outside_loaded(void);

/* Loads what the process that has started this one has loaded. */
enum hsr_status outside_inherit(struct hsr_error *err);

#endif
