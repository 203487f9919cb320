# SPDX-License-Identifier: GPL-3.0-or-later
bin_PROGRAMS += hsr
hsr_SOURCES = %D%/hsr.c
hsr_LDADD = libbench.a $(HSR_LIBS)

# Everything but main, for programs that run other algorithms than those listed.
noinst_LIBRARIES += libbench.a
libbench_a_SOURCES = %D%/check.c %D%/check.h %D%/check_report.c %D%/command.h \
  %D%/json.c %D%/json.h %D%/judge.c %D%/judge.h %D%/lines.c %D%/lines.h %D%/list.c \
  %D%/options.c %D%/render.c %D%/results.c %D%/results.h %D%/run.c \
  %D%/scenes_command.c %D%/serve.c %D%/serve.h %D%/stage.c %D%/stage.h \
  %D%/stats.c %D%/steps.c %D%/terminate.cc %D%/terminate.h %D%/worker.c
nodist_EXTRA_hsr_SOURCES = force_cxx_link.cc
if TORTURE
hsr_SOURCES += tests/torture/fail.cc
hsr_LDFLAGS = -Wl,--wrap=malloc,--wrap=calloc,--wrap=realloc \
  -Wl,--wrap=aligned_alloc,--wrap=strdup,--wrap=main
endif
dist_man_MANS += %D%/hsr.1
