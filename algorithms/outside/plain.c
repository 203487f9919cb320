/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The build of a module that is timed, and its version. */
#define HSR_COUNTING 0
#define HSR_MODULE_NAME hsr_module_plain
#include "hsr-module.h"

#include HSR_MODULE

extern const char hsr_module_version[];
const char hsr_module_version[] = HSR_MODULE_VERSION;
