# SPDX-License-Identifier: GPL-3.0-or-later
algorithm_files += \
  %D%/roberts.c
