/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/modules/variant.h"
#include "bench/lesson/lesson.h"
#include "common/files/json/json.h"

#include <stdlib.h>

static const struct {
  const char *algorithm, *scene;
  int size;
} lessons[] = {
#define LESSON(algorithm, scene, size) {algorithm, scene, size},
#include "bench/lesson/survey.def"
#undef LESSON
};
enum { N_LESSONS = sizeof lessons / sizeof *lessons };

/* What the subjects borrow. */
struct stand {
  struct lesson_subject subject[N_LESSONS];
  struct scene_options scene[N_LESSONS];
  struct view_options view[N_LESSONS];
  struct hsr_variant variant[N_LESSONS];
};

static void set_up(struct stand *stand, int n, int lesson) {
  stand->scene[n] = (struct scene_options){.name = lessons[lesson].scene};
  stand->view[n] = (struct view_options)VIEW_OPTIONS_STANDARD;
  stand->view[n].m = stand->view[n].n = lessons[lesson].size;
  stand->variant[n] =
      hsr_variant_standard(hsr_algorithm_find(lessons[lesson].algorithm));
  stand->subject[n] = (struct lesson_subject){&stand->scene[n], &stand->view[n],
                                              &stand->variant[n]};
}

json_t *lesson_survey_names(void) {
  json_t *names = json_array();
  for (int k = 0; k < N_LESSONS; k++)
    if (hsr_algorithm_find(lessons[k].algorithm))
      hsr_json_append(&names, json_string(lessons[k].algorithm));
  return names;
}

enum hsr_status lesson_survey(const char *path, long events, const char *lab,
                              struct hsr_error *err) {
  struct stand *stand = calloc(1, sizeof *stand);
  if (!stand)
    return hsr_fail_nomem(err);
  int n = 0;
  for (int k = 0; k < N_LESSONS; k++)
    if (hsr_algorithm_find(lessons[k].algorithm))
      set_up(stand, n++, k);
  enum hsr_status status =
      lesson_write(&(struct lesson_page){.path = path,
                                         .subject = stand->subject,
                                         .n = n,
                                         .limits = {LESSON_MOST_FACES, events},
                                         .is_survey = true,
                                         .lab = lab},
                   err);
  free(stand);
  return status;
}
