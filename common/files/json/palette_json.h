/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Palette files, through jansson. The format is docs/palette.schema.json;
 * docs/palettes.md says which integers its numbers become. */
#ifndef HSR_COMMON_FILES_PALETTE_JSON_H
#define HSR_COMMON_FILES_PALETTE_JSON_H

#include "common/grids/palette.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Reads a palette file. *palette is not touched after a failure. HSR_E_INPUT
 * with file and line, or the JSON pointer of the offending value; HSR_E_NOMEM.
 */
enum hsr_status hsr_palette_json_read(const char *path,
                                      struct hsr_palette *palette,
                                      struct hsr_error *err);

/* The palette that a user names: that of a file if the name ends in .json, or
 * else one that is built in. HSR_E_USAGE if there is none of that name, with
 * those that resemble it; for a file, the errors of hsr_palette_json_read.
 * *palette is not touched after a failure. */
enum hsr_status hsr_palette_open(const char *name, struct hsr_palette *palette,
                                 struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
