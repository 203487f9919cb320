# SPDX-License-Identifier: GPL-3.0-or-later
algorithm_files += \
  %D%/clip.c \
  %D%/clip.h \
  %D%/frame.c \
  %D%/frame.h \
  %D%/lazy.c \
  %D%/lazy_pyramid.c \
  %D%/lazy_pyramid.h \
  %D%/loose.c \
  %D%/loose.h \
  %D%/merged.c \
  %D%/separate.c \
  %D%/separate.h \
  %D%/tiling.c
# These files count nothing and are compiled once.
libhsr_a_SOURCES += \
  %D%/grove.c \
  %D%/grove.h
