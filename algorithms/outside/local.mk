# SPDX-License-Identifier: GPL-3.0-or-later
# What modules outside of the tree are built with: the headers that EXAMPLE.c needs,
# without the visibility that they have in hsr itself, and a version, which is of
# all that. It is put into $(libdir)/hsr/module: it belongs to this hsr alone, so it
# is not beside hsr.h.
module_headers = \
  algorithms/algorithm.h \
  algorithms/part.h \
  algorithms/prices.def \
  algorithms/prices.h \
  common/adapt/adapt.h \
  common/answers/answer.h \
  common/answers/kinds/ids.h \
  common/answers/kinds/segments.h \
  common/answers/list.def \
  common/base/arena.h \
  common/base/count.h \
  common/base/option.h \
  common/base/status.h \
  common/base/window.h \
  common/exact/screen.h \
  common/files/image.h \
  common/files/npy.h \
  common/grids/grid.h \
  common/grids/palette.h \
  common/lines/drawing.h \
  common/paper/page.h \
  common/polygon/polygon.h \
  common/scene/clusters.h \
  common/scene/pieces.h \
  common/scene/scene.h \
  common/scene/world.h \
  common/statistics/statistics.h \
  common/view/picture.h \
  common/view/view.h
module_files = %D%/counting.c %D%/hsr-module.h %D%/plain.c
EXTRA_DIST += $(module_files) %D%/names.list

%D%/module/hsr-module-version.h: $(module_headers) $(module_files) %D%/local.mk
	$(AM_V_GEN)rm -rf %D%/module && $(MKDIR_P) %D%/module && \
	for file in $(module_headers); do \
	  $(MKDIR_P) "%D%/module/$${file%/*}" && \
	  sed '/^#pragma GCC visibility/d' "$(srcdir)/$$file" \
	    >"%D%/module/$$file" || exit 1; \
	done && \
	for file in $(module_files); do \
	  cp "$(srcdir)/$$file" %D%/module/ || exit 1; \
	done && \
	version=`find %D%/module -type f | LC_ALL=C sort | xargs cat | cksum` && \
	set -- $$version && \
	echo "#define HSR_MODULE_VERSION \"$(PACKAGE_VERSION) $$1\"" >$@
bench/modules/outside.$(OBJEXT): %D%/module/hsr-module-version.h
pkgconfig_DATA += %D%/hsr-module.pc

install-data-local: install-module
install-module: %D%/module/hsr-module-version.h
	$(MKDIR_P) "$(DESTDIR)$(libdir)/hsr"
	cp -R %D%/module "$(DESTDIR)$(libdir)/hsr/"
uninstall-local: uninstall-module
uninstall-module:
	rm -rf "$(DESTDIR)$(libdir)/hsr/module"
clean-local: clean-module
clean-module:
	rm -rf %D%/module
.PHONY: install-module uninstall-module clean-module
