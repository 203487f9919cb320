/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Arrays of numbers in .npy files, as numpy writes them.
 *
 * Source      "NEP 1: A simple file format for NumPy arrays", and numpy's page
 *             numpy.lib.format: versions 1.0, 2.0 and 3.0.
 * Read        whole numbers of 1, 2, 4 or 8 bytes, signed or not, and floats of
 *             4 or 8 bytes; of either byte order; by rows (C) or by columns
 *             (Fortran).
 * Written     by rows, the least significant byte first. So the bytes of a file
 *             are the same on every machine. */
#ifndef HSR_COMMON_FILES_NPY_H
#define HSR_COMMON_FILES_NPY_H

#include "common/base/status.h"

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { HSR_NPY_MOST_DIMENSIONS = 8 };

struct hsr_npy {
  char kind; /* 'u': unsigned, 'i': signed, 'f': floats */
  int bytes; /* of a number: 1, 2, 4, 8; of floats 4, 8 */
  int n_dimensions;
  uint64_t size[HSR_NPY_MOST_DIMENSIONS]; /* the last one varies fastest */
  void *data; /* in this machine's byte order, by rows */
};

/* Returns how many numbers the array has. */
size_t hsr_npy_count(const struct hsr_npy *array);

/* Reads a file. No more memory is taken than a few times the file's size,
 * whatever its header says. The caller frees *array by hsr_npy_free, which it
 * may also do after a failure. HSR_E_INPUT, with one line that names the file,
 * if it cannot be read, is no .npy file, holds other types, or has too few or
 * too many bytes; HSR_E_NOMEM. */
enum hsr_status hsr_npy_read(const char *path, struct hsr_npy *array,
                             struct hsr_error *err);

/* Frees array->data. */
void hsr_npy_free(struct hsr_npy *array);

/* Writes a file, completely or not at all. The array is the caller's.
 * HSR_E_INPUT if it cannot be written; HSR_E_NOMEM. */
enum hsr_status hsr_npy_write(const char *path, const struct hsr_npy *array,
                              struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
