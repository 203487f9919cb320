/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr.h for hsr's own sources: the library, and the commands that are its
 * clients.
 *
 * Names       the structs of hsr.h have the names that suit its users. Some are
 *             those of hsr's own structs. So here a public struct hsr_scene is
 *             a struct lib_scene, and so on. The names of structs have no
 *             linkage, so the linker knows nothing of that. */
#ifndef HSR_BENCH_LIBRARY_WITHIN_H
#define HSR_BENCH_LIBRARY_WITHIN_H

#include "common/base/status.h"

#define hsr_answer lib_answer
#define hsr_camera lib_camera
#define hsr_event lib_event
#define hsr_scene lib_scene
#define hsr_segment lib_segment
#define hsr_subject lib_subject
#include "bench/library/hsr.h"
#undef hsr_answer
#undef hsr_camera
#undef hsr_event
#undef hsr_scene
#undef hsr_segment
#undef hsr_subject

#endif
