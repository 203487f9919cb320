# SPDX-License-Identifier: GPL-3.0-or-later
libcore_a_SOURCES += \
  %D%/answer.h \
  %D%/filter.h \
  %D%/list.def \
  %D%/on_paper.h \
  %D%/shader.h
libcore_a_SOURCES += \
  %D%/answer.c \
  %D%/coded.c \
  %D%/coded.h \
  %D%/filter.c \
  %D%/list.c \
  %D%/on_paper.c \
  %D%/shader.c
