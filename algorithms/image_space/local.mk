# SPDX-License-Identifier: GPL-3.0-or-later
algorithm_files += \
  %D%/area/sorting/area_slots.c \
  %D%/area/sorting/area_slots.h \
  %D%/area/sorting/areas.h \
  %D%/area/sorting/border.c \
  %D%/area/sorting/clipper.c \
  %D%/area/sorting/face_area.c \
  %D%/area/sorting/integrate.c \
  %D%/area/sorting/integrate.h \
  %D%/area/sorting/trace.c \
  %D%/area/sorting/weiler_atherton.c \
  %D%/area/tiling/clip.c \
  %D%/area/tiling/clip.h \
  %D%/area/tiling/frame.c \
  %D%/area/tiling/frame.h \
  %D%/area/tiling/lazy.c \
  %D%/area/tiling/lazy_pyramid.c \
  %D%/area/tiling/lazy_pyramid.h \
  %D%/area/tiling/loose.c \
  %D%/area/tiling/loose.h \
  %D%/area/tiling/merged.c \
  %D%/area/tiling/separate.c \
  %D%/area/tiling/separate.h \
  %D%/area/tiling/tiling.c \
  %D%/area/warnock/regions.c \
  %D%/area/warnock/regions.h \
  %D%/area/warnock/show.c \
  %D%/area/warnock/show.h \
  %D%/area/warnock/surround.c \
  %D%/area/warnock/surround.h \
  %D%/area/warnock/warnock.c \
  %D%/area/warnock/warnock.h \
  %D%/area/warnock/warnock_depth.c \
  %D%/area/warnock/warnock_newell.c \
  %D%/area/warnock/warnock_watkins.c \
  %D%/area/zz_buffer.c \
  %D%/point/a_buffer.c \
  %D%/point/bouknight.c \
  %D%/point/bouknight.h \
  %D%/point/bouknight_implied.c \
  %D%/point/bouknight_list.c \
  %D%/point/bouknight_regions.c \
  %D%/point/romney.c \
  %D%/point/shadow_pairs.c \
  %D%/point/shadow_pairs.h \
  %D%/point/watkins.c \
  %D%/point/watkins.h \
  %D%/point/watkins_regions.c \
  %D%/point/watkins_runs.c \
  %D%/point/watkins_seen.c \
  %D%/point/watkins_z.c \
  %D%/point/yzx.c \
  %D%/point/yzx_list.c \
  %D%/point/yzx_list.h \
  %D%/stages/items.c \
  %D%/stages/items.h \
  %D%/stages/stages.c
# These files count nothing and are compiled once.
libcore_a_SOURCES += \
  %D%/area/tiling/grove.c \
  %D%/area/tiling/grove.h
