/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An algorithm with its options chosen, as a user writes it:
 *
 *   NAME[:OPTION=VALUE]...     hzbuffer:cubes=sides:window=64
 *
 * The options are those of the algorithm's descriptor, and some that are not
 * its own. Every algorithm that draws faces has `window`: the picture is drawn
 * in squares of so many samples, each a job of its own. Or else it has `filter`
 * and `jitter`: what is drawn is the filtered picture, as in
 * zbuffer-fast:filter=box:jitter=4. `mix` asks for a transparent picture, and
 * `shadows` for one with shadows, of those algorithms that make one. */
#ifndef HSR_BENCH_VARIANT_H
#define HSR_BENCH_VARIANT_H

#include "bench/modules/modules.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Bytes of its text: more than all options of an algorithm take. */
#define HSR_MOST_VARIANT 1000

struct hsr_variant {
  const struct hsr_listed *listed;
  struct hsr_choice choice;
  char name[HSR_MOST_VARIANT + 1]; /* as the user wrote it */
};

/* HSR_E_USAGE: no such algorithm, option or value; an option twice; a window of
 * what cannot be drawn in parts; jitter without a filter; the text is too long.
 */
enum hsr_status hsr_variant_parse(const char *text, struct hsr_variant *variant,
                                  struct hsr_error *err);

/* The algorithm with its standard options. */
struct hsr_variant hsr_variant_standard(const struct hsr_listed *listed);

/* The same of the kind hsr_makes_besides(algorithm, k): newell:mix=linear. */
struct hsr_variant hsr_variant_also(const struct hsr_listed *listed, int k);

#ifdef __cplusplus
}
#endif
#endif
