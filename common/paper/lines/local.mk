# SPDX-License-Identifier: GPL-3.0-or-later
libcore_a_SOURCES += \
  %D%/cells.h \
  %D%/line_class.c \
  %D%/line_class.h \
  %D%/line_faces.cc \
  %D%/line_faces.h \
  %D%/line_style.c \
  %D%/line_style.h \
  %D%/line_style_json.c \
  %D%/lines.cc \
  %D%/lines.h \
  %D%/nodes.cc \
  %D%/nodes.h \
  %D%/places.cc \
  %D%/places.h
