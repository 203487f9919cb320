# SPDX-License-Identifier: GPL-3.0-or-later
nobase_pkginclude_HEADERS += \
  %D%/volume.h
libhsr_a_SOURCES += \
  %D%/volume.c \
  %D%/volume_check.c \
  %D%/volume_data.h \
  %D%/volume_words.c \
  %D%/volume_words.h
