# SPDX-License-Identifier: GPL-3.0-or-later
libcore_a_SOURCES += \
  %D%/palette_json.h \
  %D%/scene_json.h
libcore_a_SOURCES += \
  %D%/drawing_json.c \
  %D%/drawing_json.h \
  %D%/json.c \
  %D%/json.h \
  %D%/json_file.c \
  %D%/json_file.h \
  %D%/json_members.c \
  %D%/json_members.h \
  %D%/json_read.c \
  %D%/json_read.h \
  %D%/palette_json.c \
  %D%/scene_json.c \
  %D%/scene_json_meshes.c \
  %D%/scene_json_places.c \
  %D%/scene_json_reader.h \
  %D%/scene_json_shared.h \
  %D%/scene_json_write.c
