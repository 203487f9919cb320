/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What hsr.h defines once more is what hsr itself has. Here the compiler checks
 * it; there is no code. */
#define hsr_status public_status
#define hsr_error public_error
#define HSR_OK PUBLIC_OK
#define HSR_E_DIFFERENCE PUBLIC_E_DIFFERENCE
#define HSR_E_USAGE PUBLIC_E_USAGE
#define HSR_E_INPUT PUBLIC_E_INPUT
#define HSR_E_NOMEM PUBLIC_E_NOMEM
#define HSR_E_INTERNAL PUBLIC_E_INTERNAL
#define HSR_E_REFUSED PUBLIC_E_REFUSED
#define HSR_E_STOPPED PUBLIC_E_STOPPED
#define hsr_segment public_segment
#define hsr_camera public_camera
#define hsr_answer public_answer
#define hsr_scene public_scene
#define hsr_event public_event
#define hsr_subject public_subject
#include "bench/library/hsr.h"
#undef hsr_status
#undef hsr_error
#undef HSR_OK
#undef HSR_E_DIFFERENCE
#undef HSR_E_USAGE
#undef HSR_E_INPUT
#undef HSR_E_NOMEM
#undef HSR_E_INTERNAL
#undef HSR_E_REFUSED
#undef HSR_E_STOPPED
#undef hsr_segment
#undef hsr_camera
#undef hsr_answer
#undef hsr_scene
#undef hsr_event
#undef hsr_subject

#include "common/answers/answer.h"
#include "common/answers/kinds/area.h"

#define SAME(public, own)                                                      \
  _Static_assert((int)(public) == (int)(own), #public " is not " #own)
#define SAME_STATUS(name) SAME(PUBLIC_##name, HSR_##name)

SAME_STATUS(OK);
SAME_STATUS(E_DIFFERENCE);
SAME_STATUS(E_USAGE);
SAME_STATUS(E_INPUT);
SAME_STATUS(E_NOMEM);
SAME_STATUS(E_INTERNAL);
SAME_STATUS(E_REFUSED);
SAME_STATUS(E_STOPPED);
SAME(sizeof(struct public_error), sizeof(struct hsr_error));
SAME(offsetof(struct public_error, text), offsetof(struct hsr_error, text));
SAME(sizeof(((struct public_error *)0)->text),
     sizeof(((struct hsr_error *)0)->text));

SAME(HSR_COLOUR_LAMBERT, HSR_SHADE_LAMBERT);
SAME(HSR_COLOUR_FLAT, HSR_SHADE_FLAT);
SAME(HSR_COLOUR_IDS, HSR_SHADE_IDS);
SAME(HSR_COLOUR_GOURAUD, HSR_SHADE_GOURAUD);
SAME(HSR_LINES_LEFT_OUT, HSR_HIDDEN_NONE);
SAME(HSR_LINES_DASHED, HSR_HIDDEN_DASHED);
SAME(HSR_LINES_THIN, HSR_HIDDEN_THIN);
SAME(HSR_LINES_ALL, HSR_HIDDEN_ALL);
_Static_assert(HSR_NO_FACE == HSR_BACKGROUND, "HSR_NO_FACE");
_Static_assert(HSR_NO_FACE == HSR_NO_ID, "HSR_NO_FACE");

#define SAME_PLACE(member, own)                                                \
  SAME(offsetof(struct public_segment, member),                                \
       offsetof(struct hsr_segment, own))
SAME(sizeof(struct public_segment), sizeof(struct hsr_segment));
SAME_PLACE(is_implied, edge.implied);
SAME_PLACE(a, edge.a);
SAME_PLACE(b, edge.b);
SAME_PLACE(part, edge.part);
SAME_PLACE(invisibility, invisibility);
SAME_PLACE(t0, t0);
SAME_PLACE(t1, t1);
SAME_PLACE(from, from);
SAME_PLACE(to, to);
_Static_assert(sizeof(bool) == 1, "a bool is a byte");
SAME(sizeof(struct hsr_area_bounds), 2 * sizeof(double));
