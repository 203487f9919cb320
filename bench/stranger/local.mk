# SPDX-License-Identifier: GPL-3.0-or-later
# hsr judge.
libbench_a_SOURCES += \
  %D%/command.c \
  %D%/kinds.def \
  %D%/lines.c \
  %D%/lines.h \
  %D%/over.c \
  %D%/over.h \
  %D%/parts.h \
  %D%/picture.c \
  %D%/picture.h \
  %D%/samples.c \
  %D%/say.c \
  %D%/say.h \
  %D%/stranger.c \
  %D%/stranger.h \
  %D%/studio.c \
  %D%/suite/cases.c \
  %D%/suite/extras.c \
  %D%/suite/page.c \
  %D%/suite/say.c \
  %D%/suite/suite.h \
  %D%/table.c \
  %D%/table.h \
  %D%/trial.h \
  %D%/whole.c \
  %D%/whole_cameras.c \
  %D%/whole_ids.c
