# SPDX-License-Identifier: GPL-3.0-or-later
pkginclude_scenes_HEADERS += %D%/scenes.h
libhsr_a_SOURCES += %D%/builders.h %D%/failures_edges.c %D%/failures_eye.c \
  %D%/failures_order.c %D%/house.c %D%/lots.c %D%/lots.h %D%/meshes.c \
  %D%/meshes.h %D%/module.c %D%/module.h %D%/names.c %D%/office.c \
  %D%/random.c %D%/registry.c %D%/shapes.c %D%/shapes.h %D%/solids.c \
  %D%/terrain.c %D%/tower.c %D%/town.c %D%/traffic.c
EXTRA_DIST += %D%/README.md
