# SPDX-License-Identifier: GPL-3.0-or-later
libcore_a_SOURCES += \
  %D%/arena.h \
  %D%/arena_mark.h \
  %D%/count.h \
  %D%/option.h \
  %D%/share.h \
  %D%/status.h \
  %D%/window.h
libcore_a_SOURCES += \
  %D%/arena.c \
  %D%/bits.h \
  %D%/clock.c \
  %D%/clock.h \
  %D%/count.c \
  %D%/exact.h \
  %D%/names.c \
  %D%/names.h \
  %D%/nearest.h \
  %D%/number_memory.cc \
  %D%/numbers.h \
  %D%/option.c \
  %D%/share.c \
  %D%/status.c \
  %D%/vector.h
