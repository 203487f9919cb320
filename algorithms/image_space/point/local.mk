# SPDX-License-Identifier: GPL-3.0-or-later
algorithm_files += \
  %D%/a_buffer.c \
  %D%/bouknight.c \
  %D%/romney.c \
  %D%/scan_line.c \
  %D%/scan_line.h \
  %D%/shadow_pairs.c \
  %D%/shadow_pairs.h \
  %D%/watkins.c \
  %D%/watkins.h \
  %D%/watkins_runs.c \
  %D%/watkins_z.c \
  %D%/x_list.c \
  %D%/yzx.c
