/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The clock by which everything is timed. */
#ifndef HSR_COMMON_BASE_CLOCK_H
#define HSR_COMMON_BASE_CLOCK_H

#ifdef __cplusplus
extern "C" {
#endif

/* Seconds since some moment in the past. The clock never goes back. */
double hsr_seconds_now(void);

#ifdef __cplusplus
}
#endif
#endif
