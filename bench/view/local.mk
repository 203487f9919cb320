# SPDX-License-Identifier: GPL-3.0-or-later
libbench_a_SOURCES += \
  %D%/command.c \
  %D%/frame.c \
  %D%/frozen.c \
  %D%/keys.c \
  %D%/line_keys.c \
  %D%/panel.c \
  %D%/pick.c \
  %D%/play.c \
  %D%/player.c \
  %D%/view.h \
  %D%/window.h
if WITH_WINDOW
# Loaded by hsr when a window is opened.
pkglibexec_PROGRAMS += hsr-window.so
hsr_window_so_SOURCES = %D%/window.h %D%/window_text.h %D%/window_text.c \
  %D%/window_vtk.cc common/base/status.c
hsr_window_so_CPPFLAGS = $(AM_CPPFLAGS) $(VTK_CPPFLAGS)
hsr_window_so_CFLAGS = $(AM_CFLAGS) -fvisibility=default
hsr_window_so_CXXFLAGS = $(AM_CXXFLAGS) -fvisibility=default
hsr_window_so_LDFLAGS = -shared
hsr_window_so_LDADD = $(VTK_WINDOW_LIBS) $(CAIRO_LIBS)
endif
