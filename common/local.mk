# SPDX-License-Identifier: GPL-3.0-or-later
# The core, folder by folder. README.md says what may be included from where.
include %D%/base/local.mk
include %D%/grids/local.mk
include %D%/polygon/local.mk
include %D%/scene/local.mk
include %D%/view/local.mk
include %D%/exact/local.mk
include %D%/statistics/local.mk
include %D%/adapt/local.mk
include %D%/trees/local.mk
include %D%/lines/local.mk
include %D%/lines/sight/local.mk
include %D%/voxels/local.mk
include %D%/paper/local.mk
include %D%/paper/lines/local.mk
include %D%/answers/local.mk
include %D%/answers/kinds/local.mk
include %D%/files/local.mk
include %D%/files/json/local.mk
include %D%/files/cells/local.mk
include %D%/files/formats/local.mk
include %D%/files/gltf/local.mk
include %D%/files/mesh/local.mk
include %D%/files/volume/local.mk
include %D%/files/vtk/local.mk
