# SPDX-License-Identifier: GPL-3.0-or-later
algorithm_files += \
  %D%/newell.c \
  %D%/newell.h \
  %D%/newell_watkins.c \
  %D%/painter.c \
  %D%/priority_index.c \
  %D%/priority_list.c \
  %D%/priority_list.h \
  %D%/priority_pieces.h
