/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Palette files, through jansson. The format is docs/schemas/palette.schema.json;
 * docs/palettes.md says which integers its numbers become. */
#ifndef HSR_COMMON_FILES_PALETTE_JSON_H
#define HSR_COMMON_FILES_PALETTE_JSON_H

#include "common/grids/palette.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Reads a palette file. After a failure *palette is as it was. HSR_E_INPUT,
 * with the file and the line or JSON pointer of the wrong value;
 * HSR_E_NOMEM. */
enum hsr_status hsr_palette_json_read(const char *path,
                                      struct hsr_palette *palette,
                                      struct hsr_error *err);

/* Sets *palette to the one that a user names. A name that ends in .json is that
 * of a file; any other is that of a built-in palette. After a failure *palette
 * is as it was. HSR_E_USAGE if there is no such palette, with similar names in
 * *err; for a file, the errors of hsr_palette_json_read. */
enum hsr_status hsr_palette_open(const char *name, struct hsr_palette *palette,
                                 struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
