# SPDX-License-Identifier: GPL-3.0-or-later
libcore_a_SOURCES += \
  %D%/volume.h
libcore_a_SOURCES += \
  %D%/volume.c \
  %D%/volume_bytes.c \
  %D%/volume_check.c \
  %D%/volume_check.h \
  %D%/volume_data.h \
  %D%/volume_fields.c \
  %D%/volume_fields.h \
  %D%/volume_heights.c \
  %D%/volume_meta.c \
  %D%/volume_nifti.c \
  %D%/volume_nrrd.c \
  %D%/volume_place.c \
  %D%/volume_words.c \
  %D%/volume_words.h
