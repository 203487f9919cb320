/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the checks of volume files share; for common/files/volume. */
#ifndef HSR_COMMON_FILES_VOLUME_CHECK_H
#define HSR_COMMON_FILES_VOLUME_CHECK_H

#include "common/files/volume/volume_data.h"

#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Fails with HSR_E_INPUT: the file's path, and why it is refused. */
enum hsr_status hsr_volume_refuse(const struct hsr_volume_file *file,
                                  struct hsr_error *err, const char *why, ...)
    __attribute__((format(printf, 3, 4)));

/* Adds a line to the file's notes. One that does not fit is left out. */
void hsr_volume_note(struct hsr_volume_file *file, const char *what, ...)
    __attribute__((format(printf, 2, 3)));

/* Finds the size of a file in bytes. HSR_E_INPUT if there is none. */
enum hsr_status hsr_volume_size_of(const char *path, uint64_t *size,
                                   struct hsr_error *err);

/* Sets file->n. False if the sizes cannot be those of a grid. */
bool hsr_volume_set_sizes(struct hsr_volume_file *file, const long long n[3]);

/* Returns how many samples the file has. */
double hsr_volume_samples(const struct hsr_volume_file *file);

/* Whether `size` bytes hold the samples, of `bytes` each, behind `before`
 * bytes. */
bool hsr_volume_can_hold(const struct hsr_volume_file *file, uint64_t size,
                         double before, double bytes);

/* Returns the bytes of a number of a type; 0 of HSR_NO_TYPE. */
int hsr_volume_type_bytes(enum hsr_volume_type type);

/* Sets file->place from where the samples are. The axes of a grid are those of
 * the world. So an axis of the file becomes the axis of the world that it is
 * nearest to. If it is turned from that by more than a thousandth of a degree,
 * the turn is left out, a note says so, and the centre stays. HSR_E_INPUT if
 * the frame is none. */
enum hsr_status hsr_volume_settle(struct hsr_volume_file *file,
                                  const struct hsr_volume_frame *frame,
                                  struct hsr_error *err);

/* Sets file->way, when the sizes and perhaps the place are set. */
void hsr_volume_find_way(struct hsr_volume_file *file);

/* Adds a file that has samples. `name` is beside the header if it is not
 * absolute. HSR_E_NOMEM. */
enum hsr_status hsr_volume_add_part(struct hsr_volume_file *file,
                                    const char *name, struct hsr_error *err);

/* Adds the files that the rest of a header names, one a line. No more are read
 * than there are slices, and one. HSR_E_NOMEM. */
enum hsr_status hsr_volume_add_list(struct hsr_volume_file *file, FILE *in,
                                    struct hsr_error *err);

/* Adds one file for each slice: `format` has one %d, perhaps with a width, for
 * the numbers first, first + step, ... last. HSR_E_INPUT, HSR_E_NOMEM. */
enum hsr_status hsr_volume_add_numbered(struct hsr_volume_file *file,
                                        const char *format, long long first,
                                        long long last, long long step,
                                        struct hsr_error *err);

/* Checks that file->bytes.path are one file or one for each slice, and that
 * each holds its samples behind file->bytes.offset bytes; or, if `at_end`, sets
 * the offset, so that the samples end the only file. HSR_E_INPUT. */
enum hsr_status hsr_volume_check_parts(struct hsr_volume_file *file,
                                       bool at_end, struct hsr_error *err);

/* The same of samples that are packed or text, of which there must be one file, with
 * at least `least` bytes. HSR_E_INPUT. */
enum hsr_status hsr_volume_check_coded(struct hsr_volume_file *file,
                                       double least, struct hsr_error *err);

/* The parts of hsr_volume_check for HSR_NIFTI, HSR_META_IMAGE, HSR_NRRD. */
enum hsr_status hsr_volume_check_nifti(struct hsr_volume_file *file,
                                       struct hsr_error *err);
enum hsr_status hsr_volume_check_meta(struct hsr_volume_file *file,
                                      struct hsr_error *err);
enum hsr_status hsr_volume_check_nrrd(struct hsr_volume_file *file,
                                      struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
