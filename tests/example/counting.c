/* SPDX-License-Identifier: GPL-3.0-or-later */
#define HSR_COUNTING 1
#include "algorithms/EXAMPLE.c"
