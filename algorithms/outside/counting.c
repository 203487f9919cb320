/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The build of a module that counts. */
#define HSR_COUNTING 1
#define HSR_MODULE_NAME hsr_module_counting
#include "hsr-module.h"

#include HSR_MODULE
