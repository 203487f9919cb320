/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The files of a program's folder: docs/programs.md describes them. */
#ifndef HSR_BENCH_PROGRAMS_FILES_H
#define HSR_BENCH_PROGRAMS_FILES_H

#include "bench/programs/program.h"

/* Makes a folder, whose path it writes into folder[PROGRAM_PATH - 32], and all
 * files in it. HSR_E_INPUT; the folder is removed then. */
enum hsr_status files_make(const struct program_job *job, char *folder,
                           struct hsr_error *err);

/* Whether the answer is a file of ids, of faces or of cells. */
bool program_has_ids(const struct program_job *job);

/* Removes a folder and all in it. */
void files_remove(const char *folder);

#endif
