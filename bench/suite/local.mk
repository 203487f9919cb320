# SPDX-License-Identifier: GPL-3.0-or-later
libbench_a_SOURCES += \
  %D%/cameras.c \
  %D%/cameras.h \
  %D%/command.c \
  %D%/exact.c \
  %D%/exact.h \
  %D%/flat.c \
  %D%/flat.h \
  %D%/folder.c \
  %D%/folder.h \
  %D%/readme.c \
  %D%/right.c \
  %D%/right.h \
  %D%/scene.c \
  %D%/suite.def \
  %D%/suite.h
