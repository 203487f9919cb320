# SPDX-License-Identifier: GPL-3.0-or-later
nobase_pkginclude_HEADERS += \
  %D%/depth.h \
  %D%/statistics.h
libhsr_a_SOURCES += \
  %D%/depth.c \
  %D%/penetration.cc \
  %D%/penetration.h \
  %D%/statistics.c
