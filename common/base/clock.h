/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The clock that all timings are taken from. */
#ifndef HSR_COMMON_BASE_CLOCK_H
#define HSR_COMMON_BASE_CLOCK_H

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the seconds since a fixed but unspecified moment (CLOCK_MONOTONIC).
 * The value never decreases while the system runs. */
double hsr_seconds_now(void);

#ifdef __cplusplus
}
#endif
#endif
