/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/run/table1.h"
#include "bench/modules/modules.h"
#include "bench/run/crew.h"

enum hsr_status measure_table1(const struct hsr_world *world,
                               const struct hsr_view *view,
                               struct hsr_table1 *table,
                               struct hsr_error *err) {
  struct hsr_answer answer = {.body = NULL};
  struct hsr_tally tally = {.out_of_memory = false};
  struct hsr_setup setup = {.algorithm = NULL};
  const struct hsr_listed *zbuffer = hsr_algorithm_find("zbuffer-fast");
  enum hsr_status status =
      hsr_setup_init(&setup, zbuffer->plain, NULL, world, err);
  if (!status)
    status = answer_init(&answer, &setup, view, err);
  if (!status)
    status = render_view(&setup, view, 1, &answer, &tally, NULL, err);
  if (setup.algorithm)
    hsr_setup_free(&setup);
  if (!status)
    status = hsr_statistics_measure(world, view, hsr_answer_ids_of(&answer),
                                    table, err);
  hsr_answer_free(&answer);
  return status;
}
