# SPDX-License-Identifier: GPL-3.0-or-later
# The pages of `hsr report` and `hsr lesson`, made from page/, lesson/ and npm's
# packages. They are built and installed if node and npm are there.
report_sources = \
  %D%/page/main.js \
  %D%/page/data/address.js \
  %D%/page/data/clean.js \
  %D%/page/data/format.js \
  %D%/page/data/looks.js \
  %D%/page/data/model.js \
  %D%/page/data/probe_data.js \
  %D%/page/pages/algorithm.js \
  %D%/page/pages/beside.js \
  %D%/page/pages/check.js \
  %D%/page/pages/errors.js \
  %D%/page/pages/index.js \
  %D%/page/pages/probe.js \
  %D%/page/pages/sweeps.js \
  %D%/page/pages/tables.js \
  %D%/page/pages/timings.js \
  %D%/page/parts/columns.js \
  %D%/page/parts/dom.js \
  %D%/page/parts/filters.js \
  %D%/page/parts/plots.js \
  %D%/page/parts/print.js \
  %D%/page/parts/save.js \
  %D%/page/parts/svg.js \
  %D%/page/parts/symbols.js \
  %D%/page/parts/table.js \
  %D%/page/parts/taxonomy.js \
  %D%/page/parts/tree.js \
  %D%/page/parts/work_scale.js
lesson_sources = \
  %D%/lesson/main.js \
  %D%/lesson/beside/all.js \
  %D%/lesson/beside/board.js \
  %D%/lesson/beside/list.js \
  %D%/lesson/beside/pyramid.js \
  %D%/lesson/beside/row.js \
  %D%/lesson/beside/tree.js \
  %D%/lesson/data/branches.js \
  %D%/lesson/data/fragments.js \
  %D%/lesson/data/grids.js \
  %D%/lesson/data/kinds.js \
  %D%/lesson/data/lists.js \
  %D%/lesson/data/numbers.js \
  %D%/lesson/data/own_words.js \
  %D%/lesson/data/pieces.js \
  %D%/lesson/data/projection.js \
  %D%/lesson/data/pyramids.js \
  %D%/lesson/data/regions.js \
  %D%/lesson/data/run.js \
  %D%/lesson/data/story.js \
  %D%/lesson/data/stretches.js \
  %D%/lesson/data/structure.js \
  %D%/lesson/data/trace.js \
  %D%/lesson/data/trees.js \
  %D%/lesson/data/volumes.js \
  %D%/lesson/data/words.js \
  %D%/lesson/figures/all.js \
  %D%/lesson/figures/drawing.js \
  %D%/lesson/figures/first.js \
  %D%/lesson/figures/image.js \
  %D%/lesson/figures/lists.js \
  %D%/lesson/figures/natures.js \
  %D%/lesson/figures/steps.js \
  %D%/lesson/figures/survivors.js \
  %D%/lesson/kinds/all.js \
  %D%/lesson/kinds/area.js \
  %D%/lesson/kinds/composited.js \
  %D%/lesson/kinds/filtered.js \
  %D%/lesson/kinds/ids.js \
  %D%/lesson/kinds/polygons.js \
  %D%/lesson/kinds/segments.js \
  %D%/lesson/kinds/shadowed.js \
  %D%/lesson/kinds/transparent.js \
  %D%/lesson/kinds/voxels.js \
  %D%/lesson/kinds/shared/channels.js \
  %D%/lesson/kinds/shared/parts.js \
  %D%/lesson/kinds/shared/samples.js \
  %D%/lesson/lessons/all.js \
  %D%/lesson/lessons/areas.js \
  %D%/lesson/lessons/culling.js \
  %D%/lesson/lessons/first.js \
  %D%/lesson/lessons/image.js \
  %D%/lesson/lessons/later.js \
  %D%/lesson/lessons/lists.js \
  %D%/lesson/lessons/object.js \
  %D%/lesson/lessons/stages.js \
  %D%/lesson/lessons/untried.js \
  %D%/lesson/lessons/volumes.js \
  %D%/lesson/looks/all.js \
  %D%/lesson/looks/boxes.js \
  %D%/lesson/looks/clipped.js \
  %D%/lesson/looks/faces.js \
  %D%/lesson/looks/solids.js \
  %D%/lesson/looks/tests.js \
  %D%/lesson/looks/texels.js \
  %D%/lesson/looks/windows.js \
  %D%/lesson/parts/controls.js \
  %D%/lesson/parts/course.js \
  %D%/lesson/parts/edge_strip.js \
  %D%/lesson/parts/lesson.js \
  %D%/lesson/parts/outline.js \
  %D%/lesson/parts/panel.js \
  %D%/lesson/parts/picture.js \
  %D%/lesson/parts/player.js \
  %D%/lesson/parts/quiz.js \
  %D%/lesson/parts/redraw.js \
  %D%/lesson/parts/save_step.js \
  %D%/lesson/parts/sentence.js \
  %D%/lesson/parts/slides.js \
  %D%/lesson/parts/story_list.js \
  %D%/lesson/parts/timeline.js \
  %D%/lesson/telling/figures.js \
  %D%/lesson/telling/glossary.js \
  %D%/lesson/telling/legend.js \
  %D%/lesson/telling/moments.js \
  %D%/lesson/telling/pace.js \
  %D%/lesson/telling/questions.js \
  %D%/lesson/telling/wrong.js
lab_sources = \
  %D%/lab/main.js \
  %D%/lab/core/connect.js \
  %D%/lab/core/seats.js \
  %D%/lab/editing/edits_by_hand.js \
  %D%/lab/editing/hand.js \
  %D%/lab/experiments/chart.js \
  %D%/lab/experiments/ladders.js \
  %D%/lab/experiments/measure.js \
  %D%/lab/experiments/values.js \
  %D%/lab/judge/board.js \
  %D%/lab/judge/decide.js \
  %D%/lab/judge/order.js \
  %D%/lab/judge/over.js \
  %D%/lab/judge/seen.js \
  %D%/lab/parts/choice.js \
  %D%/lab/parts/edit_panel.js \
  %D%/lab/parts/header.js \
  %D%/lab/parts/keys.js \
  %D%/lab/parts/savings.js \
  %D%/lab/parts/scene_panel.js \
  %D%/lab/parts/tries.js \
  %D%/lab/parts/view_bar.js \
  %D%/lab/scene/edits.js \
  %D%/lab/scene/file.js \
  %D%/lab/scene/layers.js \
  %D%/lab/scene/mesh.js \
  %D%/lab/scene/own.js \
  %D%/lab/scene/params.js \
  %D%/lab/scene/pick.js \
  %D%/lab/scene/source.js \
  %D%/lab/state/address.js \
  %D%/lab/state/asked.js \
  %D%/lab/state/history.js \
  %D%/lab/state/lab.js \
  %D%/lab/state/pack.js \
  %D%/lab/steps/steps.js \
  %D%/lab/views/algorithms.js \
  %D%/lab/views/blink.js \
  %D%/lab/views/camera.js \
  %D%/lab/views/compare.js \
  %D%/lab/views/counts.js \
  %D%/lab/views/look.js \
  %D%/lab/views/pace.js \
  %D%/lab/views/paint.js \
  %D%/lab/views/stage.js \
  %D%/lab/views/turning.js \
  %D%/lab/views/under.js \
  %D%/lab/views/work.js
lab_page = %D%/lab/lab.html %D%/lab/lab.css %D%/lab/assemble.mjs
# Figures of Greene's thesis, for reports/greene/make; built by make check.
check_PROGRAMS += %D%/greene/figures
%C%_greene_figures_SOURCES = %D%/greene/figures.c
lesson_page = %D%/lesson/lesson.html %D%/lesson/lesson.css
EXTRA_DIST += %D%/suite/README.md %D%/suite/make %D%/suite/rays.txt \
  %D%/suite/opengl.txt
EXTRA_DIST += %D%/area/README.md %D%/area/make %D%/area/errors.txt \
  %D%/area/passes.txt %D%/area/strict.txt \
  %D%/area/results.ndjson %D%/area/samples-house.txt \
  %D%/area/samples-harbor.txt %D%/area/times.txt \
  %D%/peers/README.md %D%/peers/results.ndjson %D%/peers/times.txt \
  %D%/peers/make %D%/peers/mistakes %D%/peers/mistakes.md \
  %D%/peers/then-and-now %D%/peers/then-and-now.md \
  %D%/peers/drawings %D%/peers/drawings.md %D%/peers/strokes \
  %D%/1974/README.md %D%/1974/coherence %D%/1974/coherence.txt \
  %D%/1974/exponents %D%/1974/exponents.txt %D%/1974/map/map.txt \
  %D%/1974/walks %D%/1974/walks.txt \
  %D%/1974/counts.ndjson %D%/1974/map/make %D%/1974/tables.txt \
  %D%/1974/prices/attribute %D%/1974/prices/comparisons \
  %D%/1974/prices/make %D%/1974/prices/measured.json \
  %D%/1974/prices/prices.txt %D%/1974/prices/summary \
  %D%/1974/prices/verdicts %D%/1974/prices/verdicts.txt \
  %D%/greene/README.md %D%/greene/make %D%/greene/results.ndjson \
  %D%/greene/tables.txt %D%/integral/README.md %D%/integral/make \
  %D%/swan/README.md %D%/swan/make \
  %D%/swan/splats \
  $(report_sources) $(lesson_sources) $(lesson_page) \
  $(lab_sources) $(lab_page) \
  %D%/build.mjs %D%/inline.mjs %D%/package.json \
  %D%/package-lock.json %D%/page/page.html %D%/page/style.css

if WITH_REPORT
reportdir = $(pkgdatadir)/report
nodist_report_DATA = %D%/page/index.html %D%/page/report.css \
  %D%/page/report.js %D%/page/lesson.html
CLEANFILES += $(nodist_report_DATA)
endif
if MAKE_REPORT
report_modules = %D%/npm/node_modules

# npm's packages, in the build tree. None of them needs to run scripts.
%D%/npm/installed: %D%/package.json %D%/package-lock.json
	@$(MKDIR_P) %D%/npm
	cp $(srcdir)/%D%/package.json $(srcdir)/%D%/package-lock.json %D%/npm
	cd %D%/npm && $(NPM) ci --ignore-scripts --no-audit --no-fund \
	  --loglevel=error || { echo "hsr: npm cannot fetch the report's" \
	  "packages; ./configure --without-report builds without" >&2; exit 1; }
	touch $@

%D%/page/report.js: $(report_sources) $(lesson_sources) $(lesson_page) \
  %D%/build.mjs %D%/inline.mjs %D%/npm/installed
	@$(MKDIR_P) %D%/page
	$(NODE) $(srcdir)/%D%/build.mjs $(srcdir)/%D%/page $(report_modules) $@

%D%/page/report.css: %D%/page/style.css
	@$(MKDIR_P) %D%/page
	cp $(srcdir)/%D%/page/style.css $@

%D%/page/index.html: %D%/page/page.html
	@$(MKDIR_P) %D%/page
	cp $(srcdir)/%D%/page/page.html $@

# The page of hsr lesson, which is one file.
%D%/page/lesson.js: $(lesson_sources) $(report_sources) %D%/build.mjs \
  %D%/npm/installed
	@$(MKDIR_P) %D%/page
	$(NODE) $(srcdir)/%D%/build.mjs $(srcdir)/%D%/lesson $(report_modules) $@
CLEANFILES += %D%/page/lesson.js

%D%/page/lesson.html: $(lesson_page) %D%/page/lesson.js %D%/page/style.css \
  %D%/inline.mjs
	$(NODE) $(srcdir)/%D%/inline.mjs $(srcdir)/%D%/lesson/lesson.html \
	  %D%/page/lesson.js $(srcdir)/%D%/page/style.css \
	  $(srcdir)/%D%/lesson/lesson.css $@

# The page of the laboratory, of which the core is a part. `make lab` makes both; `make`
# makes the page if the core is there, as of `make web`.
%D%/page/lab.js: $(lab_sources) $(lesson_sources) $(report_sources) %D%/build.mjs \
  $(srcdir)/bench/web/client.js %D%/npm/installed
	@$(MKDIR_P) %D%/page
	$(NODE) $(srcdir)/%D%/build.mjs $(srcdir)/%D%/lab $(report_modules) $@

%D%/page/lab.html: $(lab_page) %D%/page/lab.js %D%/page/style.css \
  $(srcdir)/%D%/lesson/lesson.css web/hsr.js web/core.js web/worker.js
	$(NODE) $(srcdir)/%D%/lab/assemble.mjs $(report_modules) \
	  $(srcdir)/%D%/lab/lab.html %D%/page/lab.js web \
	  $(srcdir)/%D%/page/style.css $(srcdir)/%D%/lesson/lesson.css \
	  $(srcdir)/%D%/lab/lab.css $@

lab: web
	@$(MAKE) %D%/page/lab.html
all-local: lab-of-tarball
	@test ! -f web/hsr.wasm || $(MAKE) %D%/page/lab.html
CLEANFILES += %D%/page/lab.js

distclean-local:
	rm -rf %D%/npm
else
all-local: lab-of-tarball
if WITH_REPORT
$(nodist_report_DATA):
	@$(MKDIR_P) %D%/page && cp $(srcdir)/%D%/built/$(@F) $@
endif
endif

# A tarball that is made where the pages are carries them, for builds without node and
# without emscripten.
dist-hook:
	@for page in index.html report.css report.js lesson.html lab.html; do \
	  test ! -f %D%/page/$$page || { $(MKDIR_P) "$(distdir)/%D%/built" && \
	  cp %D%/page/$$page "$(distdir)/%D%/built"; } || exit 1; done
lab-of-tarball:
	@test -f web/hsr.wasm || test ! -f $(srcdir)/%D%/built/lab.html || { \
	  $(MKDIR_P) %D%/page && cp $(srcdir)/%D%/built/lab.html %D%/page; }
CLEANFILES += %D%/page/lab.html

# As part of install-data-local of bench/.
install-lab:
	@test ! -f %D%/page/lab.html || { \
	  $(MKDIR_P) "$(DESTDIR)$(pkgdatadir)/report" && \
	  $(INSTALL_DATA) %D%/page/lab.html "$(DESTDIR)$(pkgdatadir)/report"; }
.PHONY: lab install-lab lab-of-tarball
