# SPDX-License-Identifier: GPL-3.0-or-later
# What serves several modules, or makes a step fast. An engine knows no paper.
# The rooms stand in order: each includes those before it.
algorithm_files += \
  %D%/boxes/box_rows.c \
  %D%/boxes/box_rows.h \
  %D%/boxes/corner_boxes.c \
  %D%/boxes/corner_boxes.h \
  %D%/boxes/near_boxes.c \
  %D%/boxes/near_boxes.h \
  %D%/light/glass.c \
  %D%/light/glass.h \
  %D%/light/shadow.c \
  %D%/light/shadow.h \
  %D%/tiler/tiler.c \
  %D%/tiler/tiler.h \
  %D%/tiler/tiler_avx2.h \
  %D%/tiler/tiler_avx512.h \
  %D%/tiler/tiler_twin.h \
  %D%/pyramid/entries.h \
  %D%/pyramid/maps.c \
  %D%/pyramid/maps.h \
  %D%/pyramid/masked.c \
  %D%/pyramid/masked.h \
  %D%/pyramid/pyramid.c \
  %D%/pyramid/pyramid.h \
  %D%/cubes/cube_frame.c \
  %D%/cubes/cube_frame.h \
  %D%/cubes/cube_list.c \
  %D%/cubes/cube_list.h \
  %D%/cubes/cube_octants.c \
  %D%/cubes/cube_octants.h \
  %D%/bsp/bsp_frame.c \
  %D%/bsp/bsp_frame.h \
  %D%/bsp/bsp_walk.c \
  %D%/bsp/bsp_walk.h \
  %D%/cells/cell_box.c \
  %D%/cells/cell_frame.c \
  %D%/cells/cell_side.c \
  %D%/cells/cells.h \
  %D%/masks/canvas.c \
  %D%/masks/canvas.h \
  %D%/masks/masks.c \
  %D%/masks/masks.h \
  %D%/masks/masks_avx2.h \
  %D%/masks/masks_avx512.h \
  %D%/masks/outline.c \
  %D%/masks/outline.h \
  %D%/masks/polygon.c \
  %D%/masks/polygon.h \
  %D%/masks/silhouette.c \
  %D%/windows/area.c \
  %D%/windows/area.h \
  %D%/windows/quadtree.h \
  %D%/scan_line/implied.c \
  %D%/scan_line/implied.h \
  %D%/scan_line/regions.c \
  %D%/scan_line/regions.h \
  %D%/scan_line/scan_line.c \
  %D%/scan_line/scan_line.h \
  %D%/scan_line/x_list.c \
  %D%/splats/splat_accumulate.c \
  %D%/splats/splat_blur.c \
  %D%/splats/splat_frame.c \
  %D%/splats/splat_kernel.c \
  %D%/splats/splat_length.c \
  %D%/splats/splat_light.c \
  %D%/splats/splat_picture.c \
  %D%/splats/splat_place.c \
  %D%/splats/splat_put.c \
  %D%/splats/splat_put_avx2.c \
  %D%/splats/splat_put_avx512.c \
  %D%/splats/splat_tiles.c \
  %D%/splats/splat_twin.h \
  %D%/splats/splat_weigh.c \
  %D%/splats/splats.h
# These files count nothing and are compiled once.
libcore_a_SOURCES += \
  %D%/cubes/cube_cells.c \
  %D%/cubes/cube_cells.h \
  %D%/cubes/cube_objects.c \
  %D%/cubes/cube_objects.h \
  %D%/cubes/cubes.c \
  %D%/cubes/cubes.h \
  %D%/windows/quadtree.c
