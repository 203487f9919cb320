/* SPDX-License-Identifier: GPL-3.0-or-later */
/* write SCENE ALGORITHM MxN FILE: draws a scene's first view, writes it, and prints
 * its summary. */
#include "tests/library/public.h"

int main(int argc, char **argv) {
  int m, n;
  char text[200];
  struct hsr_error err = {.text = "usage: write SCENE ALGORITHM MxN FILE"};
  struct hsr_scene *scene = NULL;
  struct hsr_answer *answer = NULL;
  enum hsr_status status = HSR_E_USAGE;
  if (argc == 5 && sscanf(argv[3], "%dx%d", &m, &n) == 2) {
    struct hsr_request request = request_of(argv[2], m, n);
    status = hsr_open(argv[1], NULL, &scene, &err);
    if (!status)
      status = hsr_draw(scene, &request, &answer, &err);
    if (!status)
      status = hsr_write(answer, argv[4], NULL, &err);
    if (!status)
      status = hsr_get_summary(answer, text, sizeof text, &err);
    if (!status)
      puts(text);
  }
  if (status)
    fprintf(stderr, "write: %s\n", err.text);
  hsr_free(answer);
  hsr_close(scene);
  return (int)status;
}
