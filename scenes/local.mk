# SPDX-License-Identifier: GPL-3.0-or-later
libcore_a_SOURCES += %D%/scenes.h
libcore_a_SOURCES += \
  %D%/builders.h \
  %D%/cameras.c \
  %D%/cameras.h \
  %D%/mesh_faces.c \
  %D%/meshes.c \
  %D%/meshes.h \
  %D%/registry.c \
  %D%/failures/edges.c \
  %D%/failures/eye.c \
  %D%/failures/holes.c \
  %D%/failures/order.c \
  %D%/parts/lots.c \
  %D%/parts/lots.h \
  %D%/parts/module.c \
  %D%/parts/module.h \
  %D%/parts/shapes.c \
  %D%/parts/shapes.h \
  %D%/sheets/crossings.c \
  %D%/sheets/crossings.h \
  %D%/sheets/outline.c \
  %D%/sheets/outline.h \
  %D%/sheets/sheets.c \
  %D%/sheets/sheets.h \
  %D%/worlds/cells.c \
  %D%/worlds/greenhouse.c \
  %D%/worlds/house.c \
  %D%/worlds/office.c \
  %D%/worlds/random.c \
  %D%/worlds/rooms.c \
  %D%/worlds/solids.c \
  %D%/worlds/terrain.c \
  %D%/worlds/tower.c \
  %D%/worlds/town.c \
  %D%/worlds/traffic.c \
  %D%/worlds/volumes.c
EXTRA_DIST += %D%/README.md
