/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The words behind a volume's name: see volume.h. */
#ifndef HSR_COMMON_FILES_VOLUME_WORDS_H
#define HSR_COMMON_FILES_VOLUME_WORDS_H

#include "common/files/volume/volume_data.h"

/* Samples as bytes. */
struct hsr_raw_type {
  const char *name;
  int bytes;
  bool is_signed, is_real, is_big_endian;
};

struct hsr_volume_words {
  double least, most, gradient; /* least is not a number: half way */
  bool all_sides;
  uint32_t size[3]; /* 0: the file has a header */
  struct hsr_raw_type type;
  uint64_t offset;
  double spacing[3];
  uint32_t levels;
};

/* The length of a name without the words behind it. */
size_t hsr_name_before_words(const char *name);

/* HSR_E_INPUT: a word that is not known, or whose value cannot be so. */
enum hsr_status hsr_volume_words_read(struct hsr_volume_words *words,
                                      const char *name, struct hsr_error *err);

#endif
