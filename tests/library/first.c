/* Draws the house by Watkins' algorithm, and has it judged: as it is, and with one
 * sample changed. */
#include <hsr.h>
#include <stdio.h>
#include <string.h>

static int fail(const struct hsr_error *err) {
  fprintf(stderr, "%s\n", err->text);
  return 1;
}

int main(void) {
  struct hsr_error err;
  struct hsr_scene *scene;
  struct hsr_answer *answer;
  struct hsr_request request = {sizeof request};
  struct hsr_verdict verdict = {sizeof verdict};
  const uint32_t *ids;
  uint32_t changed[320 * 240];
  request.algorithm = "watkins";
  request.m = 320;
  request.n = 240;
  request.threads = 2;
  if (hsr_open("house", NULL, &scene, &err))
    return fail(&err);
  if (hsr_draw(scene, &request, &answer, &err) ||
      hsr_get_ids(answer, &ids, &err) || hsr_judge(answer, &verdict, &err))
    return fail(&err);
  printf("face %u is in the middle\n", ids[120 * 320 + 160]);
  printf("%lu samples, %lu differ\n", (unsigned long)verdict.compared,
         (unsigned long)verdict.differing);
  memcpy(changed, ids, sizeof changed);
  changed[0] = 7;
  if (hsr_judge_ids(scene, &request, changed, &verdict, &err))
    return fail(&err);
  printf("with one changed, %lu: %s\n", (unsigned long)verdict.differing,
         verdict.first);
  hsr_free(answer);
  hsr_close(scene);
  return 0;
}
