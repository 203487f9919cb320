# SPDX-License-Identifier: GPL-3.0-or-later
# Tests print TAP. Those that are scripts end in .test. Lists are in the order of
# `LC_ALL=C sort`, as tree/table.test checks. What tests which module or file is
# in tests/table.
tap_programs = \
  %D%/areas/cells_test \
  %D%/areas/filters_test \
  %D%/areas/hand_test \
  %D%/areas/polygons_test \
  %D%/areas/samples_test \
  %D%/conformance/glass_test \
  %D%/conformance/hard_test \
  %D%/conformance/lattice_test \
  %D%/conformance/line_lattice_test \
  %D%/conformance/shadow_test \
  %D%/conformance/trace_test \
  %D%/counts/by_hand/appel_test \
  %D%/counts/by_hand/bouknight_test \
  %D%/counts/by_hand/galimberti_test \
  %D%/counts/by_hand/loutrel_test \
  %D%/counts/by_hand/newell_test \
  %D%/counts/by_hand/roberts_test \
  %D%/counts/by_hand/romney_test \
  %D%/counts/by_hand/scan_line_test \
  %D%/counts/by_hand/schumacker_test \
  %D%/counts/by_hand/warnock_test \
  %D%/counts/by_hand/watkins_test \
  %D%/counts/by_hand/zbuffer_test \
  %D%/counts/golden_test \
  %D%/counts/recorded_test \
  %D%/properties/hierarchical/bounded_scenes_test \
  %D%/properties/hierarchical/bounded_test \
  %D%/properties/hierarchical/boxes_test \
  %D%/properties/hierarchical/cell_sets_test \
  %D%/properties/hierarchical/hzbuffer_options_test \
  %D%/properties/hierarchical/hzbuffer_test \
  %D%/properties/hierarchical/lazy_octree_test \
  %D%/properties/hierarchical/meagher_test \
  %D%/properties/hierarchical/movers_test \
  %D%/properties/hierarchical/naylor_test \
  %D%/properties/hierarchical/pvs_test \
  %D%/properties/hierarchical/queries_test \
  %D%/properties/hierarchical/raycast_test \
  %D%/properties/hierarchical/shaders_test \
  %D%/properties/hierarchical/steps_test \
  %D%/properties/hierarchical/zz_buffer_test \
  %D%/properties/lines/edges_test \
  %D%/properties/lines/line_outcomes_test \
  %D%/properties/lines/lines_and_surfaces_test \
  %D%/properties/lines/roberts_test \
  %D%/properties/metamorphic_test \
  %D%/properties/surfaces/a_buffer_test \
  %D%/properties/surfaces/combinations_test \
  %D%/properties/surfaces/glass_claims_test \
  %D%/properties/surfaces/groups_test \
  %D%/properties/surfaces/moving_clusters_test \
  %D%/properties/surfaces/newell_test \
  %D%/properties/surfaces/outcomes_test \
  %D%/properties/surfaces/romney_test \
  %D%/properties/surfaces/scan_line_test \
  %D%/properties/surfaces/schumacker_test \
  %D%/properties/surfaces/shadow_claims_test \
  %D%/properties/surfaces/stream_test \
  %D%/properties/surfaces/warnock_options_test \
  %D%/properties/surfaces/warnock_test \
  %D%/properties/surfaces/weiler_atherton_test \
  %D%/properties/tiles_test \
  %D%/properties/tiling/baselines_test \
  %D%/properties/tiling/counts_test \
  %D%/properties/tiling/lazy_test \
  %D%/properties/tiling/merged_test \
  %D%/properties/tiling/tiling_test \
  %D%/properties/tiling/voxels_test \
  %D%/properties/volume/cells_test \
  %D%/properties/volume/motion_claims_test \
  %D%/properties/volume/orders_test \
  %D%/properties/volume/splat_claims_test \
  %D%/properties/volume/splats_test \
  %D%/properties/volume/texture_claims_test \
  %D%/properties/volume/texture_test \
  %D%/sweep/check_test \
  %D%/sweep/mismatch_test \
  %D%/sweep/resume_test \
  %D%/sweep/schema_test \
  %D%/sweep/sweep_test \
  %D%/trace/file_test \
  %D%/unit/algorithms/cubes_test \
  %D%/unit/algorithms/grove_test \
  %D%/unit/algorithms/maps_test \
  %D%/unit/algorithms/masked_test \
  %D%/unit/algorithms/masks_test \
  %D%/unit/algorithms/octants_test \
  %D%/unit/algorithms/prepare_test \
  %D%/unit/algorithms/pyramid_test \
  %D%/unit/algorithms/setup_test \
  %D%/unit/algorithms/variant_test \
  %D%/unit/bench/crew_test \
  %D%/unit/bench/figures_test \
  %D%/unit/bench/integral_test \
  %D%/unit/bench/judge_schema_test \
  %D%/unit/bench/line_oracle_test \
  %D%/unit/bench/oracle_test \
  %D%/unit/bench/sorts_test \
  %D%/unit/bench/splat_oracle_test \
  %D%/unit/bench/stranger_test \
  %D%/unit/bench/tables_test \
  %D%/unit/core/adapt_test \
  %D%/unit/core/arena_test \
  %D%/unit/core/box_test \
  %D%/unit/core/bsp_test \
  %D%/unit/core/count_test \
  %D%/unit/core/depth_test \
  %D%/unit/core/filter_test \
  %D%/unit/core/gouraud_test \
  %D%/unit/core/grid_test \
  %D%/unit/core/motion_test \
  %D%/unit/core/named_lines_test \
  %D%/unit/core/octree_test \
  %D%/unit/core/outline_test \
  %D%/unit/core/path_test \
  %D%/unit/core/plane_classes_test \
  %D%/unit/core/quotient_test \
  %D%/unit/core/scenes_test \
  %D%/unit/core/screen_test \
  %D%/unit/core/shadow_test \
  %D%/unit/core/share_test \
  %D%/unit/core/sheets_test \
  %D%/unit/core/standard_test \
  %D%/unit/core/statistics_test \
  %D%/unit/core/surfaces_test \
  %D%/unit/core/triage_test \
  %D%/unit/core/world_test \
  %D%/unit/files/binary_mesh_test \
  %D%/unit/files/cameras_json_test \
  %D%/unit/files/drawing_test \
  %D%/unit/files/exchange_test \
  %D%/unit/files/found_mesh_test \
  %D%/unit/files/groups_test \
  %D%/unit/files/image_test \
  %D%/unit/files/npy_test \
  %D%/unit/files/palette_json_test \
  %D%/unit/files/scene_json_test \
  %D%/unit/files/text_mesh_test \
  %D%/unit/files/volume_place_test \
  %D%/unit/files/volume_test \
  %D%/unit/paper/lines_test \
  %D%/unit/paper/page_test \
  %D%/unit/paper/pen_travel_test \
  %D%/unit/paper/strokes_test \
  %D%/unit/peers/line_pixels_test \
  %D%/unit/peers/lines_test \
  %D%/unit/peers/painted_test
tap_scripts = \
  %D%/answers/layers.test \
  %D%/bad/bad_input.test \
  %D%/bad/memory.test \
  %D%/command/cliffs.test \
  %D%/command/cluster.test \
  %D%/command/command.test \
  %D%/command/completion.test \
  %D%/command/densities.test \
  %D%/command/drawings_page.test \
  %D%/command/examples.test \
  %D%/command/exposure.test \
  %D%/command/full.test \
  %D%/command/gallery.test \
  %D%/command/generate.test \
  %D%/command/gltf.test \
  %D%/command/import.test \
  %D%/command/judge.test \
  %D%/command/lab.test \
  %D%/command/looks.test \
  %D%/command/models.test \
  %D%/command/outside.test \
  %D%/command/pages.test \
  %D%/command/peers.test \
  %D%/command/pictures.test \
  %D%/command/programs.test \
  %D%/command/programs_bench.test \
  %D%/command/quickstart.test \
  %D%/command/ranks.test \
  %D%/command/sort_last.test \
  %D%/command/splat_tiles.test \
  %D%/command/streams.test \
  %D%/command/terminal.test \
  %D%/command/tiles.test \
  %D%/command/volume_errors.test \
  %D%/command/volumes.test \
  %D%/command/walk.test \
  %D%/conformance/large_faces.test \
  %D%/conformance/quick_scenes.test \
  %D%/conformance/stages.test \
  %D%/drawings/drawings.test \
  %D%/example/example.test \
  %D%/export/export.test \
  %D%/export/polygons.test \
  %D%/export/round_trips.test \
  %D%/lab/lab.test \
  %D%/lab/links.test \
  %D%/lesson/lesson.test \
  %D%/lesson/slides.test \
  %D%/lesson/wrong.test \
  %D%/report/hostile.test \
  %D%/report/made.test \
  %D%/report/report.test \
  %D%/report/watch.test \
  %D%/suite/judge.test \
  %D%/suite/suite.test \
  %D%/torture/torture.test \
  %D%/tree/arrows.test \
  %D%/tree/files.test \
  %D%/tree/generated.test \
  %D%/tree/keys.test \
  %D%/tree/prices.test \
  %D%/tree/table.test \
  %D%/view/view.test

if WITH_VTK
tap_programs += %D%/unit/files/vtp_test %D%/unit/files/volume_xml_test
check_PROGRAMS += %D%/export/read_cells
endif
if WITH_WINDOW
check_PROGRAMS += %D%/view/close_window
endif

# The quick tests: less than a minute on two cores, once everything is built.
quick_units = \
  %D%/conformance/trace_test \
  %D%/unit/algorithms/cubes_test \
  %D%/unit/algorithms/grove_test \
  %D%/unit/algorithms/maps_test \
  %D%/unit/algorithms/masked_test \
  %D%/unit/algorithms/masks_test \
  %D%/unit/algorithms/octants_test \
  %D%/unit/algorithms/prepare_test \
  %D%/unit/algorithms/pyramid_test \
  %D%/unit/algorithms/setup_test \
  %D%/unit/algorithms/variant_test \
  %D%/unit/bench/crew_test \
  %D%/unit/bench/oracle_test \
  %D%/unit/bench/splat_oracle_test \
  %D%/unit/bench/tables_test \
  %D%/unit/core/adapt_test \
  %D%/unit/core/arena_test \
  %D%/unit/core/box_test \
  %D%/unit/core/filter_test \
  %D%/unit/core/grid_test \
  %D%/unit/core/motion_test \
  %D%/unit/core/named_lines_test \
  %D%/unit/core/octree_test \
  %D%/unit/core/path_test \
  %D%/unit/core/plane_classes_test \
  %D%/unit/core/scenes_test \
  %D%/unit/core/screen_test \
  %D%/unit/core/share_test \
  %D%/unit/core/standard_test \
  %D%/unit/core/statistics_test \
  %D%/unit/core/triage_test \
  %D%/unit/core/world_test \
  %D%/unit/files/cameras_json_test \
  %D%/unit/files/drawing_test \
  %D%/unit/files/npy_test \
  %D%/unit/files/palette_json_test \
  %D%/unit/files/scene_json_test \
  %D%/unit/paper/lines_test \
  %D%/unit/paper/page_test \
  %D%/unit/paper/pen_travel_test \
  %D%/unit/paper/strokes_test
quick_programs = $(quick_units) %D%/counts/golden_test
# For the sanitizers: the quick tests, and those that run the modules at small
# sizes.
sanitized_programs = \
  $(quick_units) \
  %D%/properties/surfaces/newell_test \
  %D%/properties/surfaces/romney_test \
  %D%/properties/surfaces/schumacker_test
quick_scripts = \
  %D%/answers/layers.test \
  %D%/conformance/quick_scenes.test \
  %D%/example/example.test \
  %D%/tree/arrows.test \
  %D%/tree/files.test \
  %D%/tree/keys.test \
  %D%/tree/prices.test \
  %D%/tree/table.test
.PHONY: bench-check check-module check-quick distcheck-sanitized list-tests
# As many jobs as there are processors, unless make was told a number.
quick_jobs = case " $$MAKEFLAGS" in *\ -j*|*--jobserver*) ;; \
  *) echo "-j$$(nproc)" ;; esac
quick_make = $(MAKE) $(AM_MAKEFLAGS) -s `$(quick_jobs)`
check-quick:
	@$(quick_make) hsr $(quick_programs) \
	  %D%/answers/hsr-layers %D%/example/hsr-example
	@$(quick_make) check-TESTS \
	  TESTS="$(quick_programs) $(quick_scripts)" >check-quick.txt 2>&1; \
	status=$$?; grep -E '^(FAIL|ERROR|# [A-Z]+:)' check-quick.txt; exit $$status
CLEANFILES += check-quick.txt

# The tarball, built by a compiler whose sanitizers are on; the variable
# DISTCHECK_CONFIGURE_FLAGS says which.
distcheck-sanitized:
	@HSR_SANITIZED=1 $(quick_make) distcheck \
	  check_PROGRAMS="$(sanitized_programs)" \
	  TESTS="$(sanitized_programs) %D%/conformance/quick_scenes.test"

# One module: make check-module M=watkins, make list-tests M=watkins
check-module:
	@+$(top_srcdir)/%D%/module --build "$(abs_builddir)" "$(M)"
list-tests:
	@$(top_srcdir)/%D%/module --list "$(M)"

# Instructions a frame, against those of tests/instructions/counts.
bench-check:
	@$(top_srcdir)/%D%/instructions/run "$(abs_builddir)/instructions"

check_PROGRAMS += $(tap_programs) %D%/sweep/hsr-fixtures %D%/answers/hsr-layers \
  %D%/drawings/read_dxf \
  %D%/example/hsr-example %D%/export/round_trip %D%/suite/read_back \
  %D%/trace/hsr-fixtures
dist_check_SCRIPTS += $(tap_scripts)
TESTS += $(tap_programs) $(tap_scripts)

# What several programs share, and what only sources include.
noinst_LIBRARIES += libtests.a
libtests_a_SOURCES = \
  %D%/areas/shares.h \
  %D%/conformance/hard_scene.c \
  %D%/conformance/hard_scene.h \
  %D%/counts/by_hand/hand.h \
  %D%/counts/by_hand/lines.h \
  %D%/counts/by_hand/objects.h \
  %D%/counts/by_hand/pixels.h \
  %D%/draw.c \
  %D%/draw.h \
  %D%/properties/hierarchical/claims.c \
  %D%/properties/hierarchical/claims.h \
  %D%/properties/splitmix64.h \
  %D%/properties/volume/boards.c \
  %D%/properties/volume/boards.h \
  %D%/properties/volume/splatting.c \
  %D%/properties/volume/splatting.h \
  %D%/schema.c \
  %D%/schema.h \
  %D%/sweep/sweeping.c \
  %D%/sweep/sweeping.h \
  %D%/tap.h \
  %D%/unit/bench/checks.h \
  %D%/unit/bench/little_world.h \
  %D%/unit/files/folder.h \
  %D%/unit/files/read_mesh.h \
  %D%/unit/files/vtk_ways.h \
  %D%/unit/peers/strip.h
LDADD = libtests.a $(HSR_LIBS)

# These call functions of the counting library by their names there.
%D%/properties/hierarchical/hzbuffer_test.$(OBJEXT) \
%D%/properties/hierarchical/movers_test.$(OBJEXT) \
%D%/properties/tiling/voxels_test.$(OBJEXT) \
%D%/unit/algorithms/cubes_test.$(OBJEXT) \
%D%/unit/algorithms/maps_test.$(OBJEXT) \
%D%/unit/algorithms/masked_test.$(OBJEXT) \
%D%/unit/algorithms/pyramid_test.$(OBJEXT): algorithms/counting-names.h

# hsr-fixtures, hsr-example and hsr-layers are the command with other lists: of
# algorithms that fail on purpose, or whose events are not what they did; with
# algorithms/EXAMPLE.c; and with a kind of answer of its own.
%C%_answers_hsr_layers_LDADD = $(BENCH_LIBS)
%C%_answers_hsr_layers_SOURCES = bench/hsr.c %D%/answers/layers.c \
  %D%/answers/lists.c
%C%_areas_cells_test_SOURCES = %D%/areas/cells_test.cc
%C%_areas_filters_test_SOURCES = %D%/areas/filters_test.cc
%C%_areas_hand_test_SOURCES = %D%/areas/hand_test.cc
%C%_areas_polygons_test_SOURCES = %D%/areas/polygons_test.cc
%C%_areas_samples_test_SOURCES = %D%/areas/samples_test.cc
%C%_counts_recorded_test_LDADD = libtests.a $(BENCH_LIBS)
%C%_example_hsr_example_LDADD = $(BENCH_LIBS)
%C%_example_hsr_example_SOURCES = bench/hsr.c %D%/example/lists.c \
  %D%/example/plain.c %D%/example/counting.c
%C%_export_read_cells_CPPFLAGS = $(AM_CPPFLAGS) $(VTK_CPPFLAGS)
%C%_export_read_cells_LDADD = $(VTK_CELLS_LIBS)
%C%_export_read_cells_SOURCES = %D%/export/read_cells.cc
%C%_export_round_trip_SOURCES = %D%/export/round_trip.c
%C%_properties_hierarchical_boxes_test_SOURCES = \
  %D%/properties/hierarchical/boxes_test.cc
%C%_properties_hierarchical_shaders_test_SOURCES = \
  %D%/properties/hierarchical/shaders_test.cc
%C%_properties_tiling_tiling_test_LDADD = libtests.a $(BENCH_LIBS)
%C%_properties_tiling_voxels_test_SOURCES = %D%/properties/tiling/voxels_test.cc
%C%_suite_read_back_SOURCES = %D%/suite/read_back.c
%C%_sweep_check_test_LDADD = libtests.a $(BENCH_LIBS)
%C%_sweep_hsr_fixtures_LDADD = $(BENCH_LIBS)
%C%_sweep_hsr_fixtures_SOURCES = bench/hsr.c %D%/sweep/fixtures.c
%C%_sweep_mismatch_test_CPPFLAGS = $(AM_CPPFLAGS) $(OIIO_CFLAGS)
%C%_sweep_mismatch_test_LDADD = libtests.a $(HSR_LIBS) $(OIIO_LIBS)
%C%_sweep_mismatch_test_SOURCES = %D%/sweep/mismatch_test.cc
%C%_sweep_resume_test_LDADD = libtests.a $(BENCH_LIBS)
%C%_sweep_schema_test_LDADD = libtests.a $(BENCH_LIBS)
%C%_sweep_sweep_test_LDADD = libtests.a $(BENCH_LIBS)
%C%_trace_file_test_LDADD = libtests.a $(BENCH_LIBS)
%C%_trace_hsr_fixtures_LDADD = $(BENCH_LIBS)
%C%_trace_hsr_fixtures_SOURCES = bench/hsr.c %D%/trace/fixtures.c
%C%_unit_bench_crew_test_LDADD = libtests.a $(BENCH_LIBS)
%C%_unit_bench_figures_test_LDADD = $(BENCH_LIBS)
%C%_unit_bench_integral_test_SOURCES = %D%/unit/bench/integral_test.cc
%C%_unit_bench_line_oracle_test_SOURCES = %D%/unit/bench/line_oracle_test.cc
%C%_unit_bench_oracle_test_SOURCES = %D%/unit/bench/oracle_test.cc
%C%_unit_bench_sorts_test_LDADD = $(BENCH_LIBS)
%C%_unit_bench_splat_oracle_test_SOURCES = %D%/unit/bench/splat_oracle_test.cc
%C%_unit_bench_judge_schema_test_LDADD = libtests.a $(BENCH_LIBS)
%C%_unit_bench_stranger_test_LDADD = libtests.a $(BENCH_LIBS)
%C%_unit_bench_tables_test_LDADD = $(BENCH_LIBS)
%C%_drawings_read_dxf_LDADD = $(DXFLIB_LIBS)
%C%_drawings_read_dxf_SOURCES = %D%/drawings/read_dxf.cc
%C%_unit_core_named_lines_test_SOURCES = %D%/unit/core/named_lines_test.cc
%C%_unit_core_quotient_test_LDADD = $(CGAL_LIBS)
%C%_unit_core_quotient_test_SOURCES = %D%/unit/core/quotient_test.cc
%C%_unit_files_binary_mesh_test_SOURCES = %D%/unit/files/binary_mesh_test.cc
%C%_unit_files_exchange_test_SOURCES = %D%/unit/files/exchange_test.cc
%C%_unit_files_found_mesh_test_SOURCES = %D%/unit/files/found_mesh_test.cc
%C%_unit_files_groups_test_SOURCES = %D%/unit/files/groups_test.cc
%C%_unit_files_image_test_LDADD = libtests.a $(HSR_LIBS) $(OIIO_LIBS)
%C%_unit_files_image_test_SOURCES = %D%/unit/files/image_test.cc
%C%_unit_files_text_mesh_test_SOURCES = %D%/unit/files/text_mesh_test.cc
%C%_unit_files_volume_xml_test_CPPFLAGS = $(AM_CPPFLAGS) $(VTK_CPPFLAGS)
%C%_unit_files_volume_xml_test_LDADD = libtests.a $(HSR_LIBS) $(VTK_LIBS)
%C%_unit_files_volume_xml_test_SOURCES = %D%/unit/files/volume_xml_test.cc
%C%_unit_files_vtp_test_CPPFLAGS = $(AM_CPPFLAGS) $(VTK_CPPFLAGS)
%C%_unit_files_vtp_test_LDADD = libtests.a $(HSR_LIBS) $(VTK_LIBS)
%C%_unit_files_vtp_test_SOURCES = %D%/unit/files/vtp_test.cc
%C%_unit_peers_line_pixels_test_LDADD = $(BENCH_LIBS)
%C%_unit_peers_line_pixels_test_SOURCES = %D%/unit/peers/line_pixels_test.c \
  bench/peers/lines/line_pixels.c bench/peers/lines/line_pixels.h bench/peers/lines/lines.c \
  bench/peers/lines/lines.h
%C%_unit_peers_lines_test_LDADD = $(BENCH_LIBS)
%C%_unit_peers_lines_test_SOURCES = %D%/unit/peers/lines_test.c \
  bench/peers/lines/lines.c bench/peers/lines/lines.h
%C%_unit_peers_painted_test_SOURCES = %D%/unit/peers/painted_test.c \
  bench/peers/surfaces/painted.cc bench/peers/surfaces/painted.h
%C%_view_close_window_LDADD = -lX11
%C%_view_close_window_SOURCES = %D%/view/close_window.c

EXTRA_DIST += \
  %D%/README.md \
  %D%/bad/make-bad-inputs \
  %D%/browser.mjs \
  %D%/command/mpirun.sh \
  %D%/conformance/fresh \
  %D%/counts/golden \
  %D%/counts/rewrite \
  %D%/drawings/overlay.py \
  %D%/drawings/paper.py \
  %D%/fuzz \
  %D%/instructions \
  %D%/lab/edits.mjs \
  %D%/lab/links.mjs \
  %D%/lab/visit.mjs \
  %D%/lesson/figures.mjs \
  %D%/lesson/slides.mjs \
  %D%/lesson/telling.mjs \
  %D%/lesson/watch.mjs \
  %D%/lesson/wrong.mjs \
  %D%/module \
  %D%/mutants \
  %D%/report/browse.mjs \
  %D%/report/hostile.mjs \
  %D%/report/sample.mjs \
  %D%/report/watch.mjs \
  %D%/table \
  %D%/table.pm \
  %D%/tap.sh \
  %D%/threads \
  %D%/torture/fail.cc \
  %D%/torture/leaks.supp \
  %D%/tree/apart \
  %D%/valgrind \
  algorithms/EXAMPLE.c
