/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Text that is longer than the screen goes through a pager. */
#ifndef HSR_BENCH_TERMINAL_PAGER_H
#define HSR_BENCH_TERMINAL_PAGER_H

/* From now on standard output is kept, if it is a terminal and $PAGER is neither
 * empty nor "cat". When the program ends it is shown: by $PAGER, or `less -FRX`, if
 * it has more lines than the screen. terminal_columns() still knows the screen. */
void pager_begin(void);

#endif
