# SPDX-License-Identifier: GPL-3.0-or-later
# libhsr: libhsr.so.1, and libhsr.a of the same objects in one. Both show only the
# functions of hsr.h.
include_HEADERS = %D%/hsr.h
noinst_LIBRARIES += libpublic.a
libpublic_a_SOURCES = \
  %D%/arrays.c \
  %D%/draw.c \
  %D%/geometry.c \
  %D%/judge.c \
  %D%/library.h \
  %D%/lists.c \
  %D%/polygons.c \
  %D%/read.c \
  %D%/ready.c \
  %D%/scenes.c \
  %D%/structs.c \
  %D%/twins.c \
  %D%/within.h \
  %D%/write.c

hsrlibdir = $(libdir)
hsrlib_DATA = libhsr.a libhsr.so.1
pkgconfigdir = $(libdir)/pkgconfig
pkgconfig_DATA = %D%/hsr.pc
CLEANFILES += libhsr.a libhsr.so libhsr.so.1 %D%/whole.o %D%/names %D%/names.map

# The functions that hsr.h declares, one a line, and the same for the linker.
%D%/names: %D%/hsr.h
	$(AM_V_GEN)$(MKDIR_P) %D% && tr '\n' ' ' <$(srcdir)/%D%/hsr.h | \
	  grep -o 'HSR_API [^;(]*(' | \
	  sed -n 's/.*[ *]\(hsr_[a-z_]*\)($$/\1/p' | LC_ALL=C sort -u >$@
%D%/names.map: %D%/names
	$(AM_V_GEN)sed '1s/^/{ global: /;s/$$/;/;$$s/$$/ local: *; };/' %D%/names >$@

# It stays loaded: jansson calls it when the program allocates by jansson
# (common/files/json/json_read.c).
library_parts = $(libpublic_a_OBJECTS) libbench.a libcore.a
libhsr.so.1: $(library_parts) %D%/names.map
	$(AM_V_CXXLD)$(CXX) $(CXXFLAGS) $(LDFLAGS) -shared -Wl,-soname,$@ \
	  -Wl,--version-script=%D%/names.map $(NO_UNDEFINED) -Wl,-z,nodelete \
	  -o $@ $(libpublic_a_OBJECTS) libbench.a $(HSR_LIBS) $(LIBS)
	$(AM_V_at)rm -f libhsr.so && $(LN_S) $@ libhsr.so

# Groups of sections are resolved here: else the linker of a program might take
# a template from one of its own groups, and miss a name that is hidden by now.
libhsr.a: $(library_parts) %D%/names
	$(AM_V_GEN)$(CXX) -nostdlib -no-pie -r -Wl,--force-group-allocation \
	  -o %D%/whole.o $(libpublic_a_OBJECTS) libbench.a libcore.a && \
	$(OBJCOPY) --keep-global-symbols=%D%/names %D%/whole.o && \
	rm -f $@ && $(AR) $(ARFLAGS) $@ %D%/whole.o && rm -f %D%/whole.o

# What is installed carries no symbols for a debugger: STRIP=true keeps them.
install-exec-hook:
	$(STRIP) --strip-unneeded \
	  "$(DESTDIR)$(bindir)/`echo hsr | sed '$(transform)'`" && \
	  find "$(DESTDIR)$(libexecdir)/hsr" -type f -exec $(STRIP) --strip-unneeded {} +
install-data-hook:
	cd "$(DESTDIR)$(libdir)" && $(STRIP) --strip-unneeded libhsr.a libhsr.so.1 && \
	  $(RANLIB) libhsr.a && rm -f libhsr.so && $(LN_S) libhsr.so.1 libhsr.so
uninstall-hook:
	rm -f "$(DESTDIR)$(libdir)/libhsr.so"
