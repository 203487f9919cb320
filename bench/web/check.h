/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef HSR_BENCH_WEB_CHECK_H
#define HSR_BENCH_WEB_CHECK_H

#ifdef __cplusplus
extern "C"
#endif
    /* Says what is wrong with the machine's arithmetic; NULL: nothing is. */
    const char *
    check_numbers(void);

#endif
