/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the headers of commands name of argp. No command is in the page, so there
 * is no parser. */
#ifndef HSR_WEB_ARGP_H
#define HSR_WEB_ARGP_H

#include <errno.h>
#include <stddef.h>

typedef int error_t;
#define ARGP_ERR_UNKNOWN E2BIG
#define OPTION_HIDDEN 2

struct argp;
struct argp_state;
struct argp_option;

#endif
