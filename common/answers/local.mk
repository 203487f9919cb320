# SPDX-License-Identifier: GPL-3.0-or-later
nobase_pkginclude_HEADERS += \
  %D%/filter.h \
  %D%/picture.h
libhsr_a_SOURCES += \
  %D%/filter.c \
  %D%/picture.c
