/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a scene has where nothing has been said. */
#ifndef HSR_COMMON_SCENE_STANDARD_H
#define HSR_COMMON_SCENE_STANDARD_H

/* The colour of an object; linear. */
#define HSR_STANDARD_COLOUR                                                    \
  { 0.6f, 0.6f, 0.6f }

#endif
