# SPDX-License-Identifier: GPL-3.0-or-later
libcore_a_SOURCES += \
  %D%/sight.h
libcore_a_SOURCES += \
  %D%/sight.c \
  %D%/sight_cgal.cc \
  %D%/sight_events.cc \
  %D%/sight_face.cc \
  %D%/sight_numbers.h \
  %D%/sight_volume.cc
