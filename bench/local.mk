# SPDX-License-Identifier: GPL-3.0-or-later
bin_PROGRAMS += hsr
hsr_SOURCES = %D%/hsr.c
hsr_LDADD = $(BENCH_LIBS)
# For all that loads a library in this process: an address sanitizer does it from
# a library of its own, for which DT_RUNPATH does not hold.
hsr_LDFLAGS = -Wl,--disable-new-dtags,-rpath,'$$ORIGIN'
# For modules outside of the tree, which find here what they call.
hsr_LDFLAGS += -Wl,--dynamic-list=$(srcdir)/algorithms/outside/names.list
# What hsr loads is there when hsr is.
EXTRA_hsr_DEPENDENCIES = $(pkglibexec_PROGRAMS)

# Loaded by hsr when mpirun starts it.
if WITH_MPI
pkglibexec_PROGRAMS += hsr-ranks.so
hsr_ranks_so_SOURCES = \
  %D%/ranks/ranks_library.h \
  %D%/ranks/ranks_mpi.c \
  common/base/status.c
hsr_ranks_so_CPPFLAGS = $(AM_CPPFLAGS) $(MPI_CPPFLAGS)
hsr_ranks_so_CFLAGS = $(AM_CFLAGS) -fvisibility=default
hsr_ranks_so_LDFLAGS = -shared
hsr_ranks_so_LDADD = $(MPI_LIBS)
endif

# Everything but main, for programs that have another list of algorithms.
noinst_LIBRARIES += libbench.a
# The library calls the rooms below it, and commands call the library.
BENCH_LIBS = libbench.a libpublic.a libbench.a $(HSR_LIBS) $(GSL_LIBS) \
  $(HWLOC_LIBS) $(ZLIB_LIBS) $(MD_LIBS)
libbench_a_SOURCES = \
  %D%/areas.c \
  %D%/errors.c \
  %D%/errors.h \
  %D%/errors_of_grid.c \
  %D%/list.c \
  %D%/list.h \
  %D%/list_one.c \
  %D%/scenes.c \
  %D%/scenes_one.c \
  %D%/scenes_one.h \
  %D%/densities.c \
  %D%/densities.h \
  %D%/stats.c \
  %D%/voxels.c \
  %D%/check/candidates.c \
  %D%/check/candidates.h \
  %D%/check/check.h \
  %D%/check/command.c \
  %D%/check/json.c \
  %D%/check/matrix.c \
  %D%/check/report.c \
  %D%/check/scenes.c \
  %D%/check/sort_last.c \
  %D%/check/sort_last_sums.c \
  %D%/check/walk.c \
  %D%/client/client.c \
  %D%/client/client.h \
  %D%/export/command.c \
  %D%/generate/command.c \
  %D%/judge/differences.c \
  %D%/judge/differences.h \
  %D%/judge/folded.def \
  %D%/judge/judge.c \
  %D%/judge/judge.h \
  %D%/judge/judge_filtered.c \
  %D%/judge/judge_filtered.h \
  %D%/judge/wanted.c \
  %D%/judge/wanted.h \
  %D%/modules/outside.c \
  %D%/modules/outside.h \
  %D%/options/camera.c \
  %D%/options/camera.h \
  %D%/options/command.h \
  %D%/options/complete.c \
  %D%/options/complete.h \
  %D%/options/lines.c \
  %D%/options/lines.h \
  %D%/options/page.c \
  %D%/options/page.h \
  %D%/options/parser.c \
  %D%/options/parser.h \
  %D%/options/picture.c \
  %D%/options/picture.h \
  %D%/options/place.c \
  %D%/options/place.h \
  %D%/options/scene.c \
  %D%/options/scene.h \
  %D%/options/streams.c \
  %D%/options/streams.h \
  %D%/options/view.c \
  %D%/options/view.h \
  %D%/options/words.c \
  %D%/options/words.h \
  %D%/programs/files.c \
  %D%/programs/files.h \
  %D%/programs/ids.c \
  %D%/programs/keeper.c \
  %D%/programs/keeper.h \
  %D%/programs/module.c \
  %D%/programs/module.h \
  %D%/programs/program.c \
  %D%/programs/program.h \
  %D%/programs/segments.c \
  %D%/ranks/composite.c \
  %D%/ranks/composite.h \
  %D%/ranks/loose_faces.c \
  %D%/ranks/loose_faces.h \
  %D%/ranks/ranks.c \
  %D%/ranks/ranks.h \
  %D%/ranks/ranks_library.h \
  %D%/ranks/sums.c \
  %D%/ranks/sums.h \
  %D%/render/check.c \
  %D%/render/command.c \
  %D%/render/exposure.c \
  %D%/render/fill.c \
  %D%/render/hint.c \
  %D%/render/notes.c \
  %D%/render/options.c \
  %D%/render/passes.c \
  %D%/render/picture.c \
  %D%/render/render.h \
  %D%/render/sheet.c \
  %D%/render/sort_last.c \
  %D%/render/tiles.c \
  %D%/report/cells.c \
  %D%/report/command.c \
  %D%/report/data.c \
  %D%/report/data.h \
  %D%/report/drawings.c \
  %D%/report/errors.c \
  %D%/report/laboratory.c \
  %D%/report/ladders.c \
  %D%/report/lessons.c \
  %D%/report/pictures.c \
  %D%/report/pictures.h \
  %D%/report/probe.c \
  %D%/report/report.h \
  %D%/results/descriptor.c \
  %D%/results/descriptor.h \
  %D%/results/figures.c \
  %D%/results/figures.h \
  %D%/results/json.c \
  %D%/results/json.h \
  %D%/results/page.c \
  %D%/results/page.h \
  %D%/results/results.c \
  %D%/results/results.h \
  %D%/results/times.c \
  %D%/results/times.h \
  %D%/run/crew.c \
  %D%/run/crew.h \
  %D%/run/serve.c \
  %D%/run/serve.h \
  %D%/run/stage.c \
  %D%/run/stage.h \
  %D%/run/table1.c \
  %D%/run/table1.h \
  %D%/run/terminate.cc \
  %D%/run/terminate.h \
  %D%/run/worker.c \
  %D%/shapes/list.c \
  %D%/shapes/octree.c \
  %D%/shapes/partition.c \
  %D%/shapes/shapes.h \
  %D%/shapes/views.c \
  %D%/sweep/changes.c \
  %D%/sweep/command.c \
  %D%/sweep/group.c \
  %D%/sweep/journal.c \
  %D%/sweep/journal.h \
  %D%/sweep/machine.c \
  %D%/sweep/merge.c \
  %D%/sweep/peers.c \
  %D%/sweep/plan.c \
  %D%/sweep/programs.c \
  %D%/sweep/programs.h \
  %D%/sweep/sweep.h \
  %D%/sweep/turns.c \
  %D%/tables/claims.c \
  %D%/tables/claims.def \
  %D%/tables/claims.h \
  %D%/tables/command.c \
  %D%/tables/compute.c \
  %D%/tables/greene.c \
  %D%/tables/greene.def \
  %D%/tables/greene.h \
  %D%/tables/growth.c \
  %D%/tables/growth.h \
  %D%/tables/json.c \
  %D%/tables/map.c \
  %D%/tables/map.h \
  %D%/tables/paper_1974.c \
  %D%/tables/paper_1974.h \
  %D%/tables/prices.c \
  %D%/tables/prices.h \
  %D%/tables/sorts.c \
  %D%/tables/sorts.h \
  %D%/tables/tables.h \
  %D%/tables/text.c \
  %D%/terminal/interrupt.c \
  %D%/terminal/interrupt.h \
  %D%/terminal/pager.c \
  %D%/terminal/pager.h \
  %D%/terminal/pixels.c \
  %D%/terminal/pixels.h \
  %D%/terminal/terminal.c \
  %D%/terminal/terminal.h \
  %D%/times/command.c \
  %D%/times/files.c \
  %D%/times/latex.c \
  %D%/times/plot.c \
  %D%/times/rows.c \
  %D%/times/rows.h \
  %D%/times/table.c
nodist_libbench_a_SOURCES = %D%/sweep/commit.h

# The commit that is built. The file is rewritten only if the commit changes.
%D%/sweep/machine.$(OBJEXT): %D%/sweep/commit.h
CLEANFILES += %D%/sweep/commit.h
%D%/sweep/commit.h: commit-always
	@mkdir -p %D%/sweep; \
	commit=`git -C $(srcdir) describe --always --dirty --match= 2>/dev/null`; \
	echo "#define HSR_COMMIT \"$$commit\"" >$@.new; \
	if cmp -s $@.new $@; then rm $@.new; else mv $@.new $@; fi
.PHONY: commit-always
if TORTURE
hsr_SOURCES += tests/torture/fail.cc
hsr_LDFLAGS += -Wl,--wrap=malloc,--wrap=calloc,--wrap=realloc \
  -Wl,--wrap=aligned_alloc,--wrap=strdup,--wrap=main
endif

# The man page has the help of the commands, so hsr is run to make it. It is in the
# tarball: whoever builds from that runs nothing. Where hsr cannot be run, because
# it is built for another machine, the page has only what is written by hand.
dist_man_MANS += %D%/hsr.1
MAINTAINERCLEANFILES += %D%/hsr.1
CLEANFILES += %D%/hsr.1.new
EXTRA_DIST += %D%/man/hsr.1.in %D%/man/make
if CROSS_COMPILING
told_by =
else
told_by = hsr$(EXEEXT)
endif
%D%/hsr.1: %D%/man/hsr.1.in %D%/man/make %D%/hsr.c $(libbench_a_SOURCES) | $(told_by)
	$(AM_V_GEN)$(MKDIR_P) %D% && $(srcdir)/bench/man/make \
	  $(srcdir)/bench/man/hsr.1.in $(told_by:%=./%) >$@.new && mv $@.new $@

# The man page of the library, from its header.
dist_man_MANS += %D%/hsr.3
MAINTAINERCLEANFILES += %D%/hsr.3
EXTRA_DIST += %D%/man/make-library
%D%/hsr.3: %D%/man/make-library %D%/library/hsr.h
	$(AM_V_GEN)$(MKDIR_P) %D% && $(srcdir)/bench/man/make-library \
	  $(srcdir)/bench/library/hsr.h $(PACKAGE_VERSION) >$@.new && mv $@.new $@

# Completion for shells.
bashcompletiondir = $(datadir)/bash-completion/completions
zshcompletiondir = $(datadir)/zsh/site-functions
dist_zshcompletion_DATA = %D%/completion/_hsr
EXTRA_DIST += %D%/completion/hsr.bash
EXTRA_DIST += %D%/programs/examples/zbuffer.c %D%/programs/examples/zbuffer.mjs \
  %D%/programs/examples/zbuffer.py
install-data-local: install-lab
	$(MKDIR_P) "$(DESTDIR)$(bashcompletiondir)"
	$(INSTALL_DATA) $(srcdir)/bench/completion/hsr.bash \
	  "$(DESTDIR)$(bashcompletiondir)/hsr"
uninstall-local:
	rm -f "$(DESTDIR)$(pkgdatadir)/report/lab.html"
	rm -f "$(DESTDIR)$(bashcompletiondir)/hsr"
