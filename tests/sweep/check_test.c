/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr check on algorithms that fail on purpose. It finds those that are wrong
 * only after some frames, if they keep a state, in every order of views. With
 * --samples it looks at no other samples. Filtered pictures must be right to
 * the last bit of their sums. */
#include "tests/sweep/sweeping.h"

#include <string.h>

#define SMALL "house --size 64x48 "

/* Whether it is reported as wrong in this view, by one sample. */
static bool is_wrong(const char *name, int view) {
  char line[100];
  snprintf(line, sizeof line, "wrong: %s, view %d, 64x48: 1 sample, (", name,
           view);
  return printed(line);
}

static bool sums_up(long samples, long mismatches) {
  char line[100];
  snprintf(line, sizeof line, "\n%ld samples compared, %ld mismatch%s\n",
           samples, mismatches, mismatches == 1 ? "" : "es");
  return printed(line);
}

/* Some views are wrong: the third one drawn, and all later ones. */
static void test_sequence(struct tap *tap) {
  int status = check(SMALL "-a stale,zbuffer-fast --views 4");
  ok(tap, status == 1 && is_silent(), "what is wrong in the third frame fails");
  ok(tap,
     !is_wrong("stale", 1) && !is_wrong("stale", 2) && is_wrong("stale", 3) &&
         is_wrong("stale", 4) && sums_up(2 * 4 * 64 * 48, 2),
     "and is told from there on");
  check(SMALL "-a stale --views 4 --order reverse");
  ok(tap,
     is_wrong("stale", 1) && is_wrong("stale", 2) && !is_wrong("stale", 3) &&
         !is_wrong("stale", 4),
     "the same with time reversed");
  check(SMALL "-a stale --order 4,1,9,2");
  ok(tap,
     !is_wrong("stale", 4) && !is_wrong("stale", 1) && is_wrong("stale", 9) &&
         is_wrong("stale", 2) && sums_up(4 * 64 * 48, 2),
     "and with cuts");
  check(SMALL "-a stale --order 1,1,1");
  ok(tap, is_wrong("stale", 1) && sums_up(3 * 64 * 48, 1),
     "and of one view again and again");
  check(SMALL "-a stale --views 6 --order shuffle");
  int wrong = 0;
  for (int view = 1; view <= 6; view++)
    wrong += is_wrong("stale", view);
  ok(tap, wrong == 4 && sums_up(6 * 64 * 48, 4), "and in any order");
  status = check(SMALL "-a stale --views 2");
  ok(tap, !status, "two frames of a build are right");
  status = check(SMALL "-a fresh --views 8 --order reverse");
  ok(tap, !status && sums_up(8 * 64 * 48, 0),
     "who keeps no state is prepared for every view");
}

static bool is_frame_wrong(const char *name, int frame) {
  char line[100];
  snprintf(line, sizeof line, "wrong: %s, frame %d, 24x16: 1 sample, (", name,
           frame);
  return printed(line);
}

/* Three frames; where the state of two is kept, the third is wrong. */
static void test_frames(struct tap *tap) {
  FILE *file = fopen("walk.scene.json", "w");
  if (!file)
    abort();
  fputs("{\"schema\": \"hsr-scene/1\", \"name\": \"a walk\", \"objects\": [{"
        "\"name\": \"cart\", \"moves\": true, \"faces\": [[0,2,1],[0,1,3],"
        "[1,2,3],[2,0,3]], \"vertices\": [[0,0,0],[1,0,0],[0,1,0],[0,0,1]]}],"
        "\"instances\": [{\"object\": \"cart\", \"places\": ["
        "{\"frame\": 0, \"translate\": [0,0,0]}, "
        "{\"frame\": 4, \"translate\": [0,0,0]}, "
        "{\"frame\": 8, \"translate\": [2,0,0]}]}],"
        "\"views\": [{\"eye\": [0,1,9], \"at\": [0,0,0]}]}\n",
        file);
  fclose(file);
#define FRAMES " --size 24x16 -a follower,stale,fresh --frames "
  int status = check("walk.scene.json:%%d" FRAMES "5-7");
  ok(tap,
     status == 1 && !is_frame_wrong("follower", 6) &&
         is_frame_wrong("follower", 7) && sums_up(9 * 24 * 16, 1),
     "the state of who follows is kept in a scene that moves");
  check("walk.scene.json:%%d" FRAMES "0-2");
  ok(tap,
     is_frame_wrong("follower", 2) && is_frame_wrong("stale", 2) &&
         is_frame_wrong("fresh", 2) && sums_up(9 * 24 * 16, 3),
     "that of all is kept in one that does not");
  status = check("soup:20:%%d" FRAMES "1-3");
  ok(tap, !status && sums_up(9 * 24 * 16, 0),
     "nobody's is kept in scenes of their own");
}

/* `broken` is wrong at one sample, (0, 0). */
static void test_samples(struct tap *tap) {
  int status = check(SMALL "-a broken,zbuffer-fast --views 1 --samples 20");
  ok(tap, !status && sums_up(40, 0), "what is wrong elsewhere is not seen");
  ok(tap, printed("compared: 20 random samples"),
     "it is told how many there are");
  status = check(SMALL "-a broken --views 1 --samples %d", 64 * 48 - 1);
  ok(tap, status == 1 && is_wrong("broken", 1) && sums_up(64 * 48 - 1, 1),
     "what is wrong at a sample is");
  status = check(SMALL "-a broken --views 1 --samples 9999");
  ok(tap, status == 1 && sums_up(64 * 48, 1), "more than there are: all");
  status = check(SMALL "-a stale --views 4 --samples %d", 64 * 48 - 1);
  ok(tap, status == 1 && is_wrong("stale", 3), "and so of frames in a row");

  status =
      bench(SMALL "-a broken,zbuffer-fast --counts --samples 20 -o s.ndjson");
  struct results r = read_results("s.ndjson");
  ok(tap,
     !status && !strcmp(verdict(&r, "broken"), "ok") &&
         printed("at 20 samples"),
     "a bench judges by some samples likewise");
  results_free(&r);
}

/* Filtered pictures are judged by their sums, each filter by itself. */
static void test_filters(struct tap *tap) {
  int status = check("house --size 24x16 --views 1 -a zbuffer-fast,"
                     "own-filter:filter=cosine:jitter=2,"
                     "zbuffer-fast:filter=cosine:jitter=2,"
                     "off-by-one:filter=cosine:jitter=2,"
                     "own-filter:filter=cosine,watkins:filter=cosine,"
                     "own-filter:filter=box,zbuffer-fast:filter=box,"
                     "zbuffer-fast:filter=box:jitter=16,off-by-one");
  ok(tap,
     status == 1 && is_silent() &&
         printed("off-by-one:filter=cosine:jitter=2, view 1, 24x16: 1 "
                 "pixel, (5, 0): sums "),
     "a sum that is one too large is found");
  ok(tap,
     printed("\n768 samples and 3072 pixels compared, 1 "
             "mismatch\n"),
     "and nothing else: whoever filters, with and without jitter, is right");
  status = check("house --size 24x16 --views 1 --samples 100 -a "
                 "off-by-one:filter=box,zbuffer-fast:filter=cosine:jitter=3,"
                 "own-filter:filter=cosine");
  ok(tap,
     status == 1 && printed("1 pixel, (5, 0)") &&
         printed("compared: 100 random pixels of each picture") &&
         printed("\n300 pixels compared, 1 mismatch\n"),
     "some pixels are judged by the sub-samples that reach them");
  status = check("house --size 24x16 --views 1 --samples 1 -a "
                 "off-by-one:filter=box");
  ok(tap, !status, "what is wrong elsewhere is not seen");
  status = check("house --size 24x16 --views 1 -a broken:filter=box,"
                 "stale:filter=box:jitter=1");
  ok(tap,
     status == 1 && printed("wrong: broken:filter=box, ") &&
         printed("wrong: stale:filter=box:jitter=1, "),
     "what is wrong in a sub-sample is wrong in the sums");
}

int main(void) {
  struct tap tap = plan(8 + 3 + 6 + 5);
  enter_folder();
  test_sequence(&tap);
  test_frames(&tap);
  test_samples(&tap);
  test_filters(&tap);
  return finish(&tap);
}
