# SPDX-License-Identifier: GPL-3.0-or-later
# The core as WebAssembly: hsr.wasm and hsr.js, of the sources that the Makefile
# above names. GNU make. bench/web/local.mk calls it in the folder of the build:
#
#   srcdir    the tree
#   core      common/, scenes/, the lists of algorithms
#   players   the algorithms, which are compiled twice
#   judges    the oracles
#   bench     the library hsr.h, and the rooms of bench/ that serve it
#   own       bench/web
EMXX = em++
# emcc takes long to start. So files are compiled by the clang that emcc would call,
# with the flags that emcc would give it. Only the linker is started through emcc.
CLANG := $(shell em-config LLVM_ROOT)/clang
CLANGCC := $(CLANG) $(shell emcc --cflags)
CLANGXX := $(CLANG)++ $(shell em++ -fwasm-exceptions --cflags)
WEB = web
LIBRARIES = $(WEB)/libraries
OBJECTS = $(WEB)/objects

# acorn, which emcc calls, is where Debian's node looks; emcc takes paths for
# addresses where node has fetch.
export NODE_PATH := /usr/share/nodejs:$(NODE_PATH)
export NODE_OPTIONS := --no-experimental-fetch

# What no page can have: other programs, files in the formats of other
# libraries. bench/web/left_out.c stands for it.
left_out = common/files/vtk/% common/paper/plot_cairo.c common/paper/plot_dxf.cc \
  bench/%/command.c bench/trace/output.c bench/trace/tracer.c bench/lesson/frame% \
  bench/lesson/page.c bench/lesson/survey.c bench/lesson/tree.c \
  bench/modules/outside.c bench/results/figures.c bench/results/results.c \
  bench/results/times.c bench/run/serve.c bench/run/stage.c bench/run/worker.c
# The rooms of bench/ that serve the library and the lessons. What nothing calls,
# the linker leaves out.
rooms = bench/judge/% bench/lesson/% bench/library/% bench/modules/% \
  bench/ranks/ranks.c bench/results/% bench/run/% bench/trace/%
core_files = $(filter-out $(left_out),$(core) $(filter $(rooms),$(bench))) \
  common/files/vtk/no_vtk.cc
sources = $(filter %.c %.cc,$(1))
objects = $(addprefix $(OBJECTS)/$(1)/,$(addsuffix .o,$(call sources,$(2))))

core_objects = $(call objects,once,$(core_files) $(judges) $(own))
plain_objects = $(call objects,plain,$(players))
counting_objects = $(call objects,counting,$(players))
every_object = $(core_objects) $(plain_objects) $(counting_objects)

# CGAL cannot have the mode of rounding that it asks for: there is but one. It
# widens its intervals instead.
INCLUDES = -I$(srcdir)/bench/web/stand_in -I. -I$(srcdir) \
  -isystem $(LIBRARIES)/include -isystem $(WEB)/headers
DEFINES = -DHSR_LIBEXECDIR='""' -DHSR_REPORT_DIR='""'
WARNINGS = -Wall -Wextra -Wno-missing-field-initializers
COMMON = -msimd128 $(INCLUDES) $(DEFINES) -MMD -MP
CGAL = -DCGAL_ALWAYS_ROUND_TO_NEAREST -DCGAL_DISABLE_ROUNDING_MATH_CHECK \
  -DCGAL_IA_DONT_STOP_CONSTANT_PROPAGATION -DCGAL_NDEBUG \
  -DCGAL_HAS_NO_THREADS -Wno-unused-parameter
EXACT = -ffp-contract=off
C_FLAGS = -O2 -std=gnu11 $(EXACT) -fno-math-errno -fno-trapping-math $(WARNINGS) $(COMMON)
CXX_FLAGS = -Os -std=gnu++17 $(EXACT) $(WARNINGS) $(COMMON) $(CGAL)
EXPORTS = $(srcdir)/bench/web/calls/exports
LINK_FLAGS = -O2 -fwasm-exceptions -sMODULARIZE=1 -sEXPORT_ES6=1 \
  -sEXPORT_NAME=createHsr -sENVIRONMENT=web -sUSE_ES6_IMPORT_META=0 \
  -sALLOW_MEMORY_GROWTH=1 -sMAXIMUM_MEMORY=4GB -sINITIAL_MEMORY=32MB \
  -sTOTAL_STACK=8MB -sEXPORTED_FUNCTIONS=@$(WEB)/exports.json \
  -sEXPORTED_RUNTIME_METHODS=FS,HEAPU8,stackSave,stackRestore \
  -sFORCE_FILESYSTEM=1 -sSTRICT=0 -sNODEJS_CATCH_EXIT=0 \
  -sNODEJS_CATCH_REJECTION=0

.DELETE_ON_ERROR:
all: $(WEB)/hsr.js $(WEB)/core.js $(WEB)/worker.js $(WEB)/client.js

$(WEB)/%.js: $(srcdir)/bench/web/%.js
	cp $< $@

$(WEB)/hsr.js: $(every_object) $(WEB)/exports.json $(WEB)/LINK.flags
	@echo "  LINK     $@"
	@rm -f $(WEB)/hsr.a
	@emar rcs $(WEB)/hsr.a $(every_object)
	@$(EMXX) $(LINK_FLAGS) -o $@ -Wl,--whole-archive $(filter $(OBJECTS)/once/bench/web/%.o,$(core_objects)) \
	  -Wl,--no-whole-archive $(WEB)/hsr.a -L$(LIBRARIES)/lib -ljansson -lmpfr \
	  -lgmp -lz
$(WEB)/exports.json: $(EXPORTS)
	@sed 's/.*/"_&"/' $< | paste -sd, | sed 's/.*/[&]/' >$@

$(WEB)/made: $(srcdir)/bench/web/libraries
	@echo "  LIBRARIES"
	@mkdir -p $(OBJECTS)
	@$(srcdir)/bench/web/libraries $(LIBRARIES) >$(WEB)/libraries.log 2>&1
	@mkdir -p $(WEB)/headers
	@ln -sfn /usr/include/CGAL $(WEB)/headers/CGAL
	@ln -sfn /usr/include/boost $(WEB)/headers/boost
	@: >$@

compile_c = @echo "  EMCC     $<"; mkdir -p $(@D); $(CLANGCC) $(C_FLAGS) $(1) -c -o $@ $<
compile_cxx = @echo "  EMXX     $<"; mkdir -p $(@D); $(CLANGXX) $(CXX_FLAGS) $(1) -c -o $@ $<

# All is compiled anew if the flags are others.
$(WEB)/%.flags: always
	@echo '$($*_FLAGS)' | cmp -s - $@ || echo '$($*_FLAGS)' >$@
.PHONY: all always
# The algorithms in C need none of the libraries. They compile meanwhile.
$(core_objects) $(filter %.cc.o,$(every_object)): | $(WEB)/made
$(filter %.c.o,$(every_object)): $(WEB)/C.flags
# -MMD leaves out headers that a system header includes, as CGAL includes this one.
$(filter %.cc.o,$(every_object)): $(WEB)/CXX.flags \
  $(srcdir)/bench/web/stand_in/CGAL/FPU.h
# over.cc has inline functions of the oracles, and the linker keeps one of each: all
# must count alike.
as_judges = $(judges) bench/web/over.cc
# These files do no work within a frame: they are compiled for size, not for speed.
$(OBJECTS)/once/%.c.o: $(srcdir)/%.c
	$(call compile_c,-DHSR_COUNTING=$(if $(filter $*.c,$(judges)),1,0) \
	  $(if $(filter bench/% scenes/% common/files/%,$*),-Os))
$(OBJECTS)/once/%.cc.o: $(srcdir)/%.cc
	$(call compile_cxx,-DHSR_COUNTING=$(if $(filter $*.cc,$(as_judges)),1,0))
$(OBJECTS)/plain/%.c.o: $(srcdir)/%.c
	$(call compile_c,-DHSR_COUNTING=0)
$(OBJECTS)/plain/%.cc.o: $(srcdir)/%.cc
	$(call compile_cxx,-DHSR_COUNTING=0)
# Nobody times the counting build, so it is compiled for size.
again = -Os -include $(WEB)/counting-names.h -DHSR_COUNTING=1
$(OBJECTS)/counting/%.c.o: $(srcdir)/%.c $(WEB)/counting-names.h
	$(call compile_c,$(again))
$(OBJECTS)/counting/%.cc.o: $(srcdir)/%.cc $(WEB)/counting-names.h
	$(call compile_cxx,$(again))

# The header changes only if a name does.
$(WEB)/counting-names.stamp: $(plain_objects)
	@NM=emnm $(srcdir)/algorithms/names-again _counting $^ >$(WEB)/counting-names.new
	@cmp -s $(WEB)/counting-names.new $(WEB)/counting-names.h || \
	  cp $(WEB)/counting-names.new $(WEB)/counting-names.h
	@: >$@
$(WEB)/counting-names.h: $(WEB)/counting-names.stamp
	@:

-include $(patsubst %.o,%.d,$(every_object))
