/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/run/serve.h"

#include "bench/options/words.h"
#include "common/answers/kinds/ids.h"
#include "common/base/clock.h"
#include "common/files/suffix.h"

#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

enum { MOST_ROUNDS = 100000, MOST_VIEW = 2000 };

/* "K", or "K-L": K is the first view of a walk, L its last. */
static bool parse_views(const char *text, long *first, int *walk) {
  long last;
  int length = 0;
  *walk = 1;
  if (parse_count(text, 1, MOST_VIEW, first))
    return true;
  if (sscanf(text, "%7ld-%7ld%n", first, &last, &length) != 2 || text[length] ||
      *first < 1 || *first >= last || last > MOST_VIEW)
    return false;
  *walk = (int)(last - *first) + 1;
  return true;
}

enum hsr_status serve_parse(int argc, char **argv,
                            struct serve_request *request,
                            struct hsr_error *err) {
  *request = (struct serve_request){.name = NULL};
  if (argc < 6 || argc > 7 ||
      !parse_views(argv[3], &request->view, &request->walk) ||
      !parse_size(argv[4], &request->m, &request->n) ||
      !parse_count(argv[5], 1, 64, &request->threads))
    return hsr_fail(err, HSR_E_USAGE,
                    "worker: NAME SCENE VIEW WxH THREADS [IDS-FILE]");
  request->name = argv[1];
  request->scene = argv[2];
  request->ids_file = argv[6]; /* NULL ends argv */
  return HSR_OK;
}

/* --- Memory --------------------------------------------------------------- */

long memory_kb(void) {
  long all = 0, resident = 0;
  FILE *file = fopen("/proc/self/statm", "r");
  if (!file)
    return 0;
  if (fscanf(file, "%ld %ld", &all, &resident) != 2)
    resident = 0;
  fclose(file);
  return resident * (sysconf(_SC_PAGESIZE) / 1024);
}

/* The kernel keeps this number and that of memory_kb separately, and both only
 * roughly. */
static long peak_kb(long before) {
  struct rusage usage;
  long peak = getrusage(RUSAGE_SELF, &usage) ? 0 : usage.ru_maxrss;
  return peak > before ? peak : before;
}

/* --- Frames --------------------------------------------------------------- */

/* How a sample is taken. */
struct pace {
  long rounds;     /* how many are timed together */
  bool has_runner; /* an untimed round comes first and refills the caches, as
                      others have drawn meanwhile; long rounds need none */
};

/* Draws until all is warm. */
static enum hsr_status warm_up(const struct served *served, struct pace *pace,
                               struct hsr_error *err) {
  double begin = hsr_seconds_now(), last = begin, least = -1;
  for (long k = 0; k < SERVE_WARM_ROUNDS ||
                   (last - begin < SERVE_WARM_SECONDS && k < MOST_ROUNDS);
       k++) {
    enum hsr_status status = served->round(served->state, err);
    if (status)
      return status;
    double now = hsr_seconds_now();
    if (least < 0 || now - last < least)
      least = now - last;
    last = now;
  }
  double rounds = SERVE_SAMPLE_SECONDS / (least > 1e-9 ? least : 1e-9);
  pace->rounds = rounds > MOST_ROUNDS ? MOST_ROUNDS : (long)rounds + 1;
  pace->has_runner = least < SERVE_SHORT_SECONDS;
  return HSR_OK;
}

static long frames_of(const struct served *served, const struct pace *pace) {
  return pace->rounds * served->request->walk;
}

static enum hsr_status draw_sample(const struct served *served,
                                   const struct pace *pace,
                                   struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  if (pace->has_runner)
    status = served->round(served->state, err);
  double begin = hsr_seconds_now();
  for (long k = 0; k < pace->rounds && !status; k++)
    status = served->round(served->state, err);
  double seconds =
      (hsr_seconds_now() - begin) / (double)frames_of(served, pace);
  if (!status)
    printf("{\"seconds\": %.9g}\n", seconds);
  return status;
}

static enum hsr_status write_ids(const struct served *served,
                                 struct hsr_error *err) {
  const char *path = served->request->ids_file;
  const uint32_t *ids =
      served->answer ? hsr_answer_ids_of(served->answer) : NULL;
  if (!path || !ids)
    return HSR_OK;
  size_t n = (size_t)served->request->m * (size_t)served->request->n;
  if (hsr_is_array_file(path))
    return hsr_answer_write_ids(served->answer, path, err);
  FILE *file = fopen(path, "wb");
  bool good = file && fwrite(ids, sizeof *ids, n, file) == n;
  if (file && fclose(file))
    good = false;
  return good ? HSR_OK
              : hsr_fail(err, HSR_E_INPUT, "%s: cannot be written", path);
}

/* --- Shading and writing -------------------------------------------------- */

/* Makes a temporary file; false if that fails. */
static bool make_file(char *path, size_t size) {
  static const char suffix[] = ".png";
  const char *folder = getenv("TMPDIR");
  int length = snprintf(path, size, "%s/hsr-XXXXXX%s",
                        folder && *folder ? folder : "/tmp", suffix);
  int file = length < (int)size ? mkstemps(path, sizeof suffix - 1) : -1;
  return file >= 0 && !close(file);
}

/* If there is no room to write the picture, the renderer has not failed. */
static enum hsr_status shade_and_write(const struct served *served,
                                       struct hsr_shaded *shaded,
                                       struct hsr_error *err) {
  const struct hsr_answer_type *kind = served->answer->form.type;
  struct hsr_showing showing = {.world = &served->stage->world,
                                .view = &served->stage->view,
                                .supersamples = 1};
  double begin = hsr_seconds_now();
  enum hsr_status status = kind->shade(served->answer, &showing, shaded, err);
  if (status)
    return status;
  printf("{\"shade\": %.9g, \"write\": ", hsr_seconds_now() - begin);
  char path[4096];
  status = HSR_E_INPUT;
  if (make_file(path, sizeof path)) {
    begin = hsr_seconds_now();
    status = kind->write(served->answer, &showing, shaded, path, err);
    double seconds = hsr_seconds_now() - begin;
    unlink(path);
    if (!status)
      printf("%.9g}\n", seconds);
  }
  if (status == HSR_E_INPUT) {
    puts("null}");
    return HSR_OK;
  }
  return status;
}

/* The two phases after the picture, if there is one. */
static enum hsr_status finish_picture(const struct served *served,
                                      struct hsr_error *err) {
  if (!served->answer || !served->answer->form.type->shade) {
    puts("{\"shade\": null, \"write\": null}");
    return HSR_OK;
  }
  struct hsr_shaded shaded = {.rgb = NULL};
  enum hsr_status status = shade_and_write(served, &shaded, err);
  hsr_shaded_free(&shaded);
  return status;
}

/* --- The conversation ----------------------------------------------------- */

static enum hsr_status answer_byte(const struct served *served, int byte,
                                   const struct pace *pace,
                                   struct hsr_error *err) {
  switch (byte) {
  case 'r':
    return draw_sample(served, pace, err);
  case 'm':
    printf("{\"peak_kb\": %ld}\n", peak_kb(served->before_kb));
    return HSR_OK;
  case 'w':
    return finish_picture(served, err);
  default:
    return hsr_fail(err, HSR_E_USAGE, "worker: no request '%c'", byte);
  }
}

enum hsr_status serve(const struct served *served, struct hsr_error *err) {
  struct pace pace = {.rounds = 1};
  enum hsr_status status = warm_up(served, &pace, err);
  if (!status)
    status = write_ids(served, err);
  if (status)
    return status;
  printf("{\"import\": %.9g, \"adapt\": %.9g, \"prepare\": %.9g, "
         "\"before_kb\": %ld, \"inner\": %ld}\n",
         served->stage->import_seconds, served->adapt_seconds,
         served->prepare_seconds, served->before_kb, frames_of(served, &pace));
  while (!status) {
    if (fflush(stdout))
      return hsr_fail(err, HSR_E_INPUT, "worker: nobody reads its output");
    int byte = getchar();
    if (byte == EOF)
      break;
    status = answer_byte(served, byte, &pace, err);
  }
  return status;
}
