# SPDX-License-Identifier: GPL-3.0-or-later
# Programs that print TAP; the scripts among them end in .test.
tap_programs = \
  %D%/unit/adapt_test \
  %D%/unit/box_test \
  %D%/unit/bsp_test \
  %D%/unit/cubes_test \
  %D%/unit/drawing_test \
  %D%/unit/exchange_test \
  %D%/unit/figures_test \
  %D%/unit/filter_test \
  %D%/unit/image_test \
  %D%/unit/grove_test \
  %D%/unit/line_oracle_test \
  %D%/unit/masks_test \
  %D%/unit/octree_test \
  %D%/unit/oracle_test \
  %D%/unit/outline_test \
  %D%/unit/plot_test \
  %D%/unit/pyramid_test \
  %D%/unit/scene_json_test \
  %D%/unit/scenes_test \
  %D%/unit/screen_test \
  %D%/unit/statistics_test \
  %D%/unit/tables_test \
  %D%/unit/triage_test \
  %D%/unit/variant_test \
  %D%/unit/world_test \
  %D%/conformance/lattice_test \
  %D%/conformance/line_lattice_test \
  %D%/properties/baselines_test \
  %D%/properties/boxes_test \
  %D%/properties/combinations_test \
  %D%/properties/edges_test \
  %D%/properties/hzbuffer_options_test \
  %D%/properties/movers_test \
  %D%/properties/hzbuffer_test \
  %D%/properties/lazy_test \
  %D%/properties/lines_and_surfaces_test \
  %D%/properties/merged_test \
  %D%/properties/metamorphic_test \
  %D%/properties/newell_test \
  %D%/properties/roberts_test \
  %D%/properties/romney_test \
  %D%/properties/scan_line_test \
  %D%/properties/schumacker_test \
  %D%/properties/voxels_test \
  %D%/properties/tiling_test \
  %D%/properties/warnock_test \
  %D%/sweep/check_test \
  %D%/sweep/resume_test \
  %D%/sweep/schema_test \
  %D%/sweep/sweep_test
tap_scripts = \
  %D%/command.test \
  %D%/peers.test \
  %D%/bad/bad_input.test \
  %D%/bad/memory.test \
  %D%/report/made.test \
  %D%/report/report.test \
  %D%/torture/torture.test

if WITH_VTK
tap_programs += %D%/unit/vtp_test
endif

check_PROGRAMS += $(tap_programs) %D%/sweep/hsr-fixtures
dist_check_SCRIPTS += $(tap_scripts)
TESTS += $(tap_programs) $(tap_scripts)

noinst_LIBRARIES += libdraw.a
libdraw_a_SOURCES = %D%/draw.c %D%/draw.h %D%/tap.h
LDADD = libdraw.a $(HSR_LIBS)
%C%_unit_adapt_test_SOURCES = %D%/unit/adapt_test.c
nodist_EXTRA_%C%_unit_adapt_test_SOURCES = force_cxx_link.cc
%C%_unit_box_test_SOURCES = %D%/unit/box_test.c
nodist_EXTRA_%C%_unit_box_test_SOURCES = force_cxx_link.cc
%C%_unit_bsp_test_SOURCES = %D%/unit/bsp_test.c
nodist_EXTRA_%C%_unit_bsp_test_SOURCES = force_cxx_link.cc
%C%_unit_cubes_test_SOURCES = %D%/unit/cubes_test.c
nodist_EXTRA_%C%_unit_cubes_test_SOURCES = force_cxx_link.cc
%C%_unit_drawing_test_SOURCES = %D%/unit/drawing_test.c
nodist_EXTRA_%C%_unit_drawing_test_SOURCES = force_cxx_link.cc
%C%_unit_exchange_test_SOURCES = %D%/unit/exchange_test.cc
%C%_unit_filter_test_SOURCES = %D%/unit/filter_test.c
nodist_EXTRA_%C%_unit_filter_test_SOURCES = force_cxx_link.cc
%C%_unit_grove_test_SOURCES = %D%/unit/grove_test.c
nodist_EXTRA_%C%_unit_grove_test_SOURCES = force_cxx_link.cc
%C%_unit_image_test_SOURCES = %D%/unit/image_test.cc
%C%_unit_line_oracle_test_SOURCES = %D%/unit/line_oracle_test.cc
%C%_unit_masks_test_SOURCES = %D%/unit/masks_test.c
nodist_EXTRA_%C%_unit_masks_test_SOURCES = force_cxx_link.cc
%C%_unit_oracle_test_SOURCES = %D%/unit/oracle_test.cc
%C%_unit_outline_test_SOURCES = %D%/unit/outline_test.c
nodist_EXTRA_%C%_unit_outline_test_SOURCES = force_cxx_link.cc
%C%_unit_octree_test_SOURCES = %D%/unit/octree_test.c
nodist_EXTRA_%C%_unit_octree_test_SOURCES = force_cxx_link.cc
%C%_unit_plot_test_SOURCES = %D%/unit/plot_test.c
nodist_EXTRA_%C%_unit_plot_test_SOURCES = force_cxx_link.cc
%C%_unit_pyramid_test_SOURCES = %D%/unit/pyramid_test.c
nodist_EXTRA_%C%_unit_pyramid_test_SOURCES = force_cxx_link.cc
%C%_unit_scene_json_test_SOURCES = %D%/unit/scene_json_test.c
nodist_EXTRA_%C%_unit_scene_json_test_SOURCES = force_cxx_link.cc
%C%_unit_scenes_test_SOURCES = %D%/unit/scenes_test.c
nodist_EXTRA_%C%_unit_scenes_test_SOURCES = force_cxx_link.cc
%C%_unit_screen_test_SOURCES = %D%/unit/screen_test.c
nodist_EXTRA_%C%_unit_screen_test_SOURCES = force_cxx_link.cc
%C%_unit_statistics_test_SOURCES = %D%/unit/statistics_test.c
nodist_EXTRA_%C%_unit_statistics_test_SOURCES = force_cxx_link.cc
%C%_unit_tables_test_SOURCES = %D%/unit/tables_test.c
%C%_unit_tables_test_LDADD = $(BENCH_LIBS)
nodist_EXTRA_%C%_unit_tables_test_SOURCES = force_cxx_link.cc
%C%_unit_triage_test_SOURCES = %D%/unit/triage_test.c
nodist_EXTRA_%C%_unit_triage_test_SOURCES = force_cxx_link.cc
%C%_unit_variant_test_SOURCES = %D%/unit/variant_test.c
nodist_EXTRA_%C%_unit_variant_test_SOURCES = force_cxx_link.cc
%C%_unit_world_test_SOURCES = %D%/unit/world_test.c
nodist_EXTRA_%C%_unit_world_test_SOURCES = force_cxx_link.cc
%C%_unit_vtp_test_SOURCES = %D%/unit/vtp_test.cc
%C%_unit_vtp_test_CPPFLAGS = $(AM_CPPFLAGS) $(VTK_CPPFLAGS)
%C%_conformance_lattice_test_SOURCES = %D%/conformance/lattice_test.c
nodist_EXTRA_%C%_conformance_lattice_test_SOURCES = force_cxx_link.cc
%C%_conformance_line_lattice_test_SOURCES = %D%/conformance/line_lattice_test.c
nodist_EXTRA_%C%_conformance_line_lattice_test_SOURCES = force_cxx_link.cc
%C%_properties_baselines_test_SOURCES = %D%/properties/baselines_test.c
nodist_EXTRA_%C%_properties_baselines_test_SOURCES = force_cxx_link.cc
%C%_properties_boxes_test_SOURCES = %D%/properties/boxes_test.cc
%C%_properties_edges_test_SOURCES = %D%/properties/edges_test.c
nodist_EXTRA_%C%_properties_edges_test_SOURCES = force_cxx_link.cc
%C%_properties_hzbuffer_options_test_SOURCES = %D%/properties/hzbuffer_options_test.c
nodist_EXTRA_%C%_properties_hzbuffer_options_test_SOURCES = force_cxx_link.cc
%C%_properties_movers_test_SOURCES = %D%/properties/movers_test.c
nodist_EXTRA_%C%_properties_movers_test_SOURCES = force_cxx_link.cc
%C%_properties_hzbuffer_test_SOURCES = %D%/properties/hzbuffer_test.c
nodist_EXTRA_%C%_properties_hzbuffer_test_SOURCES = force_cxx_link.cc
%C%_properties_combinations_test_SOURCES = %D%/properties/combinations_test.c
nodist_EXTRA_%C%_properties_combinations_test_SOURCES = force_cxx_link.cc
%C%_properties_lazy_test_SOURCES = %D%/properties/lazy_test.c
nodist_EXTRA_%C%_properties_lazy_test_SOURCES = force_cxx_link.cc
%C%_properties_lines_and_surfaces_test_SOURCES = %D%/properties/lines_and_surfaces_test.c
nodist_EXTRA_%C%_properties_lines_and_surfaces_test_SOURCES = force_cxx_link.cc
%C%_properties_merged_test_SOURCES = %D%/properties/merged_test.c
nodist_EXTRA_%C%_properties_merged_test_SOURCES = force_cxx_link.cc
%C%_properties_metamorphic_test_SOURCES = %D%/properties/metamorphic_test.c
nodist_EXTRA_%C%_properties_metamorphic_test_SOURCES = force_cxx_link.cc
%C%_properties_roberts_test_SOURCES = %D%/properties/roberts_test.c
nodist_EXTRA_%C%_properties_roberts_test_SOURCES = force_cxx_link.cc
%C%_properties_romney_test_SOURCES = %D%/properties/romney_test.c
nodist_EXTRA_%C%_properties_romney_test_SOURCES = force_cxx_link.cc
%C%_properties_schumacker_test_SOURCES = %D%/properties/schumacker_test.c
nodist_EXTRA_%C%_properties_schumacker_test_SOURCES = force_cxx_link.cc
%C%_properties_voxels_test_SOURCES = %D%/properties/voxels_test.cc
%C%_properties_tiling_test_SOURCES = %D%/properties/tiling_test.c
%C%_properties_tiling_test_LDADD = libdraw.a $(BENCH_LIBS)
nodist_EXTRA_%C%_properties_tiling_test_SOURCES = force_cxx_link.cc
%C%_properties_warnock_test_SOURCES = %D%/properties/warnock_test.c
nodist_EXTRA_%C%_properties_warnock_test_SOURCES = force_cxx_link.cc
%C%_properties_newell_test_SOURCES = %D%/properties/newell_test.c
nodist_EXTRA_%C%_properties_newell_test_SOURCES = force_cxx_link.cc
%C%_properties_scan_line_test_SOURCES = %D%/properties/scan_line_test.c
nodist_EXTRA_%C%_properties_scan_line_test_SOURCES = force_cxx_link.cc

%C%_unit_figures_test_SOURCES = %D%/unit/figures_test.c
%C%_unit_figures_test_LDADD = $(BENCH_LIBS)
nodist_EXTRA_%C%_unit_figures_test_SOURCES = force_cxx_link.cc

# The command with a list of its own: algorithms that fail on purpose.
%C%_sweep_hsr_fixtures_SOURCES = bench/hsr.c %D%/sweep/fixtures.c
%C%_sweep_hsr_fixtures_LDADD = $(BENCH_LIBS)
nodist_EXTRA_%C%_sweep_hsr_fixtures_SOURCES = force_cxx_link.cc
sweeping = %D%/sweep/sweeping.c %D%/sweep/sweeping.h
%C%_sweep_check_test_SOURCES = %D%/sweep/check_test.c $(sweeping)
%C%_sweep_check_test_LDADD = $(BENCH_LIBS)
nodist_EXTRA_%C%_sweep_check_test_SOURCES = force_cxx_link.cc
%C%_sweep_resume_test_SOURCES = %D%/sweep/resume_test.c $(sweeping)
%C%_sweep_resume_test_LDADD = $(BENCH_LIBS)
nodist_EXTRA_%C%_sweep_resume_test_SOURCES = force_cxx_link.cc
%C%_sweep_schema_test_SOURCES = %D%/sweep/schema_test.c $(sweeping)
%C%_sweep_schema_test_LDADD = $(BENCH_LIBS)
nodist_EXTRA_%C%_sweep_schema_test_SOURCES = force_cxx_link.cc
%C%_sweep_sweep_test_SOURCES = %D%/sweep/sweep_test.c $(sweeping)
%C%_sweep_sweep_test_LDADD = $(BENCH_LIBS)
nodist_EXTRA_%C%_sweep_sweep_test_SOURCES = force_cxx_link.cc

EXTRA_DIST += %D%/README.md %D%/conformance/fresh %D%/torture/fail.cc %D%/torture/leaks.supp %D%/report/browse.mjs %D%/report/sample.mjs %D%/bad/make-bad-inputs %D%/fuzz/run %D%/valgrind/run %D%/valgrind/libraries.supp %D%/fuzz/fuzz_mesh.cc %D%/fuzz/fuzz_reader.h %D%/fuzz/fuzz_scene_json.cc %D%/fuzz/vtp.dict
