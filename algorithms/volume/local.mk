# SPDX-License-Identifier: GPL-3.0-or-later
algorithm_files += \
  %D%/solid_pyramid.c \
  %D%/solid_pyramid.h \
  %D%/tiling_solids.c
# These files count nothing and are compiled once.
libhsr_a_SOURCES += \
  %D%/solid_triage.c \
  %D%/solid_triage.h
