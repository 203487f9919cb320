/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The words that follow the name of a volume (volume.h). */
#ifndef HSR_COMMON_FILES_VOLUME_WORDS_H
#define HSR_COMMON_FILES_VOLUME_WORDS_H

#include "common/files/volume/volume_data.h"
#include "common/scene/scene.h"

/* The type of samples in bytes without a header. */
struct hsr_raw_type {
  const char *name;
  int bytes;
  bool is_signed, is_real, is_big_endian;
};

struct hsr_volume_words {
  double least, most, gradient; /* least NaN: the default */
  bool all_sides;
  uint32_t size[3]; /* all 0: the file has a header */
  struct hsr_raw_type type;
  uint64_t offset;
  double spacing[3];
  uint32_t levels;
  char photograph[256]; /* of a height map; "": there is none */
};

/* Returns the length of a name without the words that follow it. */
size_t hsr_name_before_words(const char *name);

/* Fills an empty scene from a picture of heights. Errors as hsr_volume_read. */
enum hsr_status hsr_heights_read(struct hsr_scene *scene, const char *path,
                                 const struct hsr_volume_words *words,
                                 struct hsr_error *err);

/* Reads the words that follow a name. *words is written in full. HSR_E_INPUT if
 * a word is unknown or has a wrong value. */
enum hsr_status hsr_volume_words_read(struct hsr_volume_words *words,
                                      const char *name, struct hsr_error *err);

#endif
