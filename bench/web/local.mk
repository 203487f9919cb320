# SPDX-License-Identifier: GPL-3.0-or-later
# `make web`: the core as WebAssembly, into web/ of the build. docs/web.md.
EXTRA_DIST += \
  %D%/calls/exports \
  %D%/client.js \
  %D%/core.js \
  %D%/libraries \
  %D%/stand_in/CGAL/FPU.h \
  %D%/stand_in/argp.h \
  %D%/stand_in/charconv \
  %D%/stand_in/config.h \
  %D%/web.mk \
  %D%/worker.js
EXTRA_DIST += $(web_files)
web_files = \
  %D%/calls/drawing.c \
  %D%/calls/judging.c \
  %D%/calls/lists.c \
  %D%/calls/scenes.c \
  %D%/calls/steps.c \
  %D%/calls/survey.c \
  %D%/calls/why.c \
  %D%/check.cc \
  %D%/check.h \
  %D%/hash.c \
  %D%/hash.h \
  %D%/left_out.c \
  %D%/over.cc \
  %D%/over.h \
  %D%/reply.c \
  %D%/request.c \
  %D%/web.h

web:
	$(AM_V_at)$(MKDIR_P) web && $(MAKE) --no-print-directory \
	  -f $(srcdir)/%D%/web.mk srcdir="$(srcdir)" core="$(libcore_a_SOURCES)" \
	  players="$(algorithm_files)" judges="$(oracle_files)" \
	  bench="$(libpublic_a_SOURCES) $(libbench_a_SOURCES)" own="$(web_files)"
.PHONY: web
