# SPDX-License-Identifier: GPL-3.0-or-later
libbench_a_SOURCES += \
  %D%/asked.c \
  %D%/command.c \
  %D%/first.c \
  %D%/lab.h
