# SPDX-License-Identifier: GPL-3.0-or-later
libcore_a_SOURCES += \
  %D%/depth.h \
  %D%/statistics.h
libcore_a_SOURCES += \
  %D%/depth.c \
  %D%/penetration.cc \
  %D%/penetration.h \
  %D%/statistics.c
