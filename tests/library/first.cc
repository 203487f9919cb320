/* Draws the house by Watkins' algorithm, and has it judged: as it is, and with one
 * sample changed. */
#include <hsr.h>
#include <cstdio>
#include <vector>

static int fail(const hsr_error *err) {
  std::fprintf(stderr, "%s\n", err->text);
  return 1;
}

int main() {
  hsr_error err;
  hsr_scene *scene;
  hsr_answer *answer;
  hsr_request request{};
  hsr_verdict verdict{};
  const uint32_t *ids;
  request.size = sizeof request;
  verdict.size = sizeof verdict;
  request.algorithm = "watkins";
  request.m = 320;
  request.n = 240;
  request.threads = 2;
  if (hsr_open("house", nullptr, &scene, &err))
    return fail(&err);
  if (hsr_draw(scene, &request, &answer, &err) ||
      hsr_get_ids(answer, &ids, &err) || hsr_judge(answer, &verdict, &err))
    return fail(&err);
  std::printf("face %u is in the middle\n", ids[120 * 320 + 160]);
  std::printf("%lu samples, %lu differ\n", (unsigned long)verdict.compared,
              (unsigned long)verdict.differing);
  std::vector<uint32_t> changed(ids, ids + 320 * 240);
  changed[0] = 7;
  if (hsr_judge_ids(scene, &request, changed.data(), &verdict, &err))
    return fail(&err);
  std::printf("with one changed, %lu: %s\n", (unsigned long)verdict.differing,
              verdict.first);
  hsr_free(answer);
  hsr_close(scene);
  return 0;
}
