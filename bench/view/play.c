/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/view/view.h"

#include <stdlib.h>
#include <string.h>

/* Moves of the mouse: "drag:X:Y:X:Y:STEPS", ... */
static const struct {
  const char *name;
  int button, least, most; /* how many numbers */
} drags[] = {
    {"drag", 1, 4, 5}, {"pan", 2, 4, 5}, {"zoom", 3, 4, 5}, {"click", 1, 2, 2}};
enum { N_DRAGS = sizeof drags / sizeof *drags, STEPS = 10, MOST_NUMBERS = 5 };

/* The numbers after a name, each with a colon before it; -1: something else. */
static int read_numbers(const char *text, int number[MOST_NUMBERS]) {
  int n = 0;
  while (*text == ':' && n < MOST_NUMBERS) {
    char *end;
    number[n++] = (int)strtol(text + 1, &end, 10);
    if (end == text + 1)
      return -1;
    text = end;
  }
  return *text ? -1 : n;
}

static bool play_mouse(struct viewer *v, const char *word) {
  int number[MOST_NUMBERS];
  const size_t length = strcspn(word, ":");
  const int n = read_numbers(word + length, number);
  for (int k = 0; k < N_DRAGS; k++) {
    if (strlen(drags[k].name) != length ||
        strncmp(drags[k].name, word, length) != 0)
      continue;
    if (n < drags[k].least || n > drags[k].most)
      return false;
    const int steps = n == 5 ? number[4] : n == 2 ? 0 : STEPS;
    v->library->drag(v->window, drags[k].button, number,
                     n == 2 ? number : number + 2, steps);
    return true;
  }
  if (n == 1 && !strncmp(word, "wheel:", 6))
    v->library->wheel(v->window, number[0]);
  else if (n == 1 && !strncmp(word, "wait:", 5))
    v->library->wait(v->window, number[0]);
  else
    return false;
  return true;
}

static enum hsr_status play_word(struct viewer *v, const char *word,
                                 struct hsr_error *err) {
  if (!strncmp(word, "shot:", 5))
    return viewer_screenshot(v, word + 5, err);
  if (keys_know(word))
    v->library->press(v->window, word);
  else if (!play_mouse(v, word))
    return hsr_fail(err, HSR_E_USAGE,
                    "--keys: '%.100s' is neither a key nor drag:X:Y:X:Y, pan, "
                    "zoom, click:X:Y, wheel:N, wait:MS or shot:FILE",
                    word);
  return HSR_OK;
}

enum hsr_status play(struct viewer *v, const char *list,
                     struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  while (*list && !status) {
    const size_t n = strcspn(list, ",");
    char word[400];
    snprintf(word, sizeof word, "%.*s", (int)n, list);
    status = play_word(v, word, err);
    list += n + (list[n] == ',');
  }
  return status;
}
