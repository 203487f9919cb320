# SPDX-License-Identifier: GPL-3.0-or-later
nobase_pkginclude_HEADERS += \
  %D%/statistics.h
libhsr_a_SOURCES += \
  %D%/penetration.cc \
  %D%/penetration.h \
  %D%/statistics.c
