# SPDX-License-Identifier: GPL-3.0-or-later
libbench_a_SOURCES += \
  %D%/answer.c \
  %D%/command.c \
  %D%/header.c \
  %D%/output.c \
  %D%/run.c \
  %D%/trace.h \
  %D%/tracer.c
