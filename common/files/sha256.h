/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The checksum of a file that `sha256sum` prints.
 *
 * Source      NIST, FIPS 180-4, "Secure Hash Standard", 2015: 5.1.1, 5.3.3 and
 *             6.2 */
#ifndef HSR_COMMON_FILES_SHA256_H
#define HSR_COMMON_FILES_SHA256_H

#include "common/base/status.h"

#include <stdint.h>

/* 64 hexadecimal digits and a NUL. */
enum { HSR_SHA256_TEXT = 65 };

/* Writes the checksum and the number of bytes of a file. HSR_E_INPUT if it
 * cannot be read. */
enum hsr_status hsr_sha256_of_file(const char *path, char text[HSR_SHA256_TEXT],
                                   uint64_t *bytes, struct hsr_error *err);

#endif
