# SPDX-License-Identifier: GPL-3.0-or-later
libbench_a_SOURCES += \
  %D%/bytes.c \
  %D%/command.c \
  %D%/describe.c \
  %D%/draw.c \
  %D%/frame_boxes.c \
  %D%/frame_cells.c \
  %D%/frame_fragments.c \
  %D%/frame_halves.c \
  %D%/frame_list.c \
  %D%/frame_marks.c \
  %D%/frame_planes.c \
  %D%/frame_rows.c \
  %D%/frame_shapes.c \
  %D%/frame_tests.c \
  %D%/frame_words.c \
  %D%/frames.c \
  %D%/frames.h \
  %D%/grids.c \
  %D%/lesson.h \
  %D%/lists.c \
  %D%/page.c \
  %D%/planes.c \
  %D%/recorder.c \
  %D%/structure.c \
  %D%/survey.c \
  %D%/survey.def \
  %D%/survivors.c \
  %D%/tree.c \
  %D%/volumes.c
