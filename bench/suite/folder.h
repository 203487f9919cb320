/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The folder of a suite, which exists completely or not at all. It is made
 * under another name, "DIR.part", and renamed at the end. The manifest, which
 * has a checksum of each file, is written last. */
#ifndef HSR_BENCH_SUITE_FOLDER_H
#define HSR_BENCH_SUITE_FOLDER_H

#include "common/base/names.h"

#include <jansson.h>
#include <stdint.h>

struct folder {
  const char *path; /* where it will be; borrowed */
  char *part;       /* where it is made */
  struct hsr_names files;
  char file[4600]; /* the last one that was named */
  uint64_t bytes;  /* of all, once it is finished */
};

/* Makes the folder. HSR_E_INPUT if there is one that is not empty, if another
 * run makes it, or if it cannot be made; HSR_E_NOMEM. To be closed if it was
 * made. */
enum hsr_status folder_open(struct folder *folder, const char *path,
                            struct hsr_error *err);

/* Notes a file of the suite, "right/house-1.ids.npy", and returns the path under
 * which the caller then writes it, valid until the next call. NULL if memory
 * runs out. */
const char *folder_file(struct folder *folder, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* The name of the last file within the suite. */
const char *folder_name(const struct folder *folder);

/* Removes the last file, which is noted no more. */
void folder_forget(struct folder *folder);

/* Writes a value as JSON. It takes over the value. */
enum hsr_status folder_json(struct folder *folder, const char *name,
                            json_t *value, struct hsr_error *err);

/* Writes the manifest, which is *head with the files added, and puts the folder
 * in its place. It takes over the head. */
enum hsr_status folder_finish(struct folder *folder, json_t *head,
                              struct hsr_error *err);

/* Frees what the folder holds. If it is not in its place, its files are
 * removed. */
void folder_close(struct folder *folder);

#endif
