/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The plain readers of mesh files, which a fuzz target can do without. */
#ifndef HSR_TESTS_FUZZ_PLAIN_H
#define HSR_TESTS_FUZZ_PLAIN_H

#include <cstdint>

/* Whether files are offered to them; if not, the general readers read all. */
extern bool fuzz_plain;

/* How many files they have read. */
extern uint64_t fuzz_n_plain;

#endif
