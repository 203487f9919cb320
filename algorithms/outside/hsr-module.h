/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a module outside of the tree includes, or is compiled with: docs/modules-outside.md.
 *
 * It holds for one version of hsr, and is no promise: hsr refuses a module that was
 * built for another. Who wants a promise writes a program (docs/programs.md) or uses
 * the library (hsr.h). */
#ifndef HSR_MODULE_H
#define HSR_MODULE_H

#include "hsr-module-version.h"

#include "algorithms/algorithm.h"
#include "common/exact/screen.h"

#endif
