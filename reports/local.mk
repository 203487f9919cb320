# SPDX-License-Identifier: GPL-3.0-or-later
# The page of `hsr report`: one script made from reports/page/*.js and npm's
# packages. It is built and installed if node and npm are there.
report_sources = \
  %D%/page/address.js \
  %D%/page/algorithm_page.js \
  %D%/page/check_page.js \
  %D%/page/dom.js \
  %D%/page/filters.js \
  %D%/page/format.js \
  %D%/page/index_page.js \
  %D%/page/looks.js \
  %D%/page/main.js \
  %D%/page/model.js \
  %D%/page/plots.js \
  %D%/page/probe_data.js \
  %D%/page/probe_page.js \
  %D%/page/sweeps_page.js \
  %D%/page/symbols.js \
  %D%/page/table.js \
  %D%/page/tables_page.js \
  %D%/page/timings_page.js \
  %D%/page/tree.js
EXTRA_DIST += %D%/peers/README.md %D%/peers/results.ndjson %D%/peers/times.txt \
  %D%/1974/README.md %D%/1974/counts.ndjson %D%/1974/tables.txt \
  %D%/greene/README.md %D%/greene/make %D%/greene/results.ndjson \
  %D%/greene/tables.txt \
  $(report_sources) %D%/build.mjs %D%/package.json \
  %D%/package-lock.json %D%/page/page.html %D%/page/style.css

if WITH_REPORT
reportdir = $(pkgdatadir)/report
nodist_report_DATA = %D%/page/index.html %D%/page/report.css %D%/page/report.js
CLEANFILES += $(nodist_report_DATA)
report_modules = %D%/npm/node_modules

# npm's packages, in the build tree. None of them needs to run scripts.
%D%/npm/installed: %D%/package.json %D%/package-lock.json
	@$(MKDIR_P) %D%/npm
	cp $(srcdir)/%D%/package.json $(srcdir)/%D%/package-lock.json %D%/npm
	cd %D%/npm && $(NPM) ci --ignore-scripts --no-audit --no-fund \
	  --loglevel=error || { echo "hsr: npm cannot fetch the report's" \
	  "packages; ./configure --without-report builds without" >&2; exit 1; }
	touch $@

%D%/page/report.js: $(report_sources) %D%/build.mjs %D%/npm/installed
	@$(MKDIR_P) %D%/page
	$(NODE) $(srcdir)/%D%/build.mjs $(srcdir)/%D%/page $(report_modules) $@

%D%/page/report.css: %D%/page/style.css
	@$(MKDIR_P) %D%/page
	cp $(srcdir)/%D%/page/style.css $@

%D%/page/index.html: %D%/page/page.html
	@$(MKDIR_P) %D%/page
	cp $(srcdir)/%D%/page/page.html $@

distclean-local:
	rm -rf %D%/npm
endif
