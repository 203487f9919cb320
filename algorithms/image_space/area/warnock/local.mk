# SPDX-License-Identifier: GPL-3.0-or-later
algorithm_files += \
  %D%/regions.c \
  %D%/regions.h \
  %D%/show.c \
  %D%/show.h \
  %D%/warnock.c \
  %D%/warnock.h \
  %D%/warnock_depth.c \
  %D%/warnock_newell.c \
  %D%/warnock_watkins.c
