# SPDX-License-Identifier: GPL-3.0-or-later
libcore_a_SOURCES += \
  %D%/triage.h \
  %D%/voxels.h
libcore_a_SOURCES += \
  %D%/triage.c \
  %D%/voxels.c
