/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/client/client.h"
#include "bench/lab/lab.h"
#include "bench/results/page.h"
#include "common/files/whole_input.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum { PATH = 300, SECONDS = 10 };

/* A picture, and until when it may be drawn. */
struct first {
  const char *algorithm;
  char *base64; /* of the .png file */
  time_t end;
};

static int has_time(void *context, double share) {
  (void)share;
  return time(NULL) < ((const struct first *)context)->end;
}

/* The bytes of the file of an answer. It lies in a folder of its own. */
static enum hsr_status encode(const struct lib_answer *answer,
                              struct first *first, struct hsr_error *err) {
  char folder[PATH], path[PATH + 16];
  const char *above = getenv("TMPDIR");
  unsigned char *bytes = NULL;
  size_t n = 0;
  snprintf(folder, sizeof folder, "%.200s/hsr-XXXXXX",
           above && *above ? above : "/tmp");
  if (!mkdtemp(folder))
    return hsr_fail(err, HSR_E_INPUT, "%s: no folder can be made", folder);
  snprintf(path, sizeof path, "%s/first.png", folder);
  enum hsr_status status = hsr_write(answer, path, NULL, err);
  if (!status)
    status = hsr_whole_input(path, &bytes, &n, err);
  if (!status && !(first->base64 = base64_text(bytes, n)))
    status = hsr_fail_nomem(err);
  free(bytes);
  unlink(path);
  rmdir(folder);
  return status;
}

static bool is_of_lines(const struct lib_answer *answer) {
  const struct lib_segment *segment;
  size_t n;
  return !hsr_get_segments(answer, &segment, &n, NULL);
}

static enum hsr_status draw(const struct lib_scene *scene,
                            const struct view_options *view,
                            struct first *first, struct hsr_error *err) {
  struct hsr_request request = client_request(view, first->algorithm, 1);
  struct lib_answer *answer = NULL;
  request.m = LAB_FIRST_M;
  request.n = LAB_FIRST_N;
  request.progress = has_time;
  request.context = first;
  enum hsr_status status = hsr_draw(scene, &request, &answer, err);
  if (!status)
    status = is_of_lines(answer)
                 ? hsr_fail(err, HSR_E_USAGE, "the page draws lines itself")
                 : encode(answer, first, err);
  hsr_free(answer);
  return status;
}

/* The frame is that of the page: reports/lab/views/stage.js. */
static void print(const struct first *first, size_t n, FILE *out) {
  fprintf(out,
          "<div class=\"desk first-look\"><div class=\"side\"></div>"
          "<div class=\"work\"><p>Drawn by hsr when this page was written; the "
          "core is starting …</p><div class=\"stages of-%zu\">",
          n);
  for (size_t k = 0; k < n; k++)
    fprintf(out,
            "<div class=\"easel\"><div class=\"frame\"><img class=\"view\" "
            "width=\"%d\" height=\"%d\" alt=\"The picture that %s drew\" "
            "src=\"data:image/png;base64,%s\"></div></div>",
            (int)LAB_FIRST_M, (int)LAB_FIRST_N, first[k].algorithm,
            first[k].base64);
  fputs("</div></div></div>\n", out);
}

void lab_put_first(const struct scene_options *options,
                   const struct view_options *view, const json_t *algorithms,
                   FILE *out) {
  const struct hsr_open_options opening = {.size = sizeof opening,
                                           .threads = options->import.threads,
                                           .strict = options->import.strict,
                                           .two_sided =
                                               options->import.two_sided,
                                           .weld = options->import.weld,
                                           .path = options->import.path};
  struct first first[LAB_MOST_ALGORITHMS] = {{0}};
  struct lib_scene *scene = NULL;
  struct hsr_error err;
  size_t n = json_array_size(algorithms);
  enum hsr_status status = hsr_open(options->name, &opening, &scene, &err);
  for (size_t k = 0; k < n && !status; k++) {
    first[k].algorithm = json_string_value(json_array_get(algorithms, k));
    first[k].end = time(NULL) + SECONDS;
    status = draw(scene, view, &first[k], &err);
  }
  if (!status)
    print(first, n, out);
  for (size_t k = 0; k < n; k++)
    free(first[k].base64);
  hsr_close(scene);
}
