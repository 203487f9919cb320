/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/options/page.h"
#include "bench/options/words.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST_PAGE = 10000 /* millimetres */ };

static const struct unit {
  const char *name;
  double mm;
} units[] = {{"mm", 1},    {"cm", 10},        {"m", 1000},
             {"in", 25.4}, {"pt", 25.4 / 72}, {"px", 25.4 / 96}};

/* A number and a unit. Sets *mm; NULL: it is none. */
static const struct unit *parse_measure(const char *text, double *mm) {
  char number[40];
  const size_t n = strlen(text);
  for (size_t k = 0; k < sizeof units / sizeof *units; k++) {
    const size_t length = strlen(units[k].name);
    if (n <= length || n - length >= sizeof number ||
        strcmp(text + n - length, units[k].name) != 0)
      continue;
    memcpy(number, text, n - length);
    number[n - length] = '\0';
    if (parse_number(number, mm) && *mm > 0 && isfinite(*mm)) {
      *mm *= units[k].mm;
      return &units[k];
    }
  }
  return NULL;
}

bool parse_length(const char *text, double *mm) {
  const struct unit *unit = parse_measure(text, mm);
  return unit && *mm <= MOST_PAGE;
}

/* 1:20 */
static bool parse_scale(const char *text, double *scale) {
  char first[40];
  double a, b;
  const char *colon = strchr(text, ':');
  if (!colon || (size_t)(colon - text) >= sizeof first)
    return false;
  memcpy(first, text, (size_t)(colon - text));
  first[colon - text] = '\0';
  if (!parse_number(first, &a) || !parse_number(colon + 1, &b) || !(a > 0) ||
      !(b > 0))
    return false;
  *scale = a / b;
  return isfinite(*scale) && *scale > 0;
}

/* A side of the page. Its unit is that in which .svg files write sizes. */
static error_t parse_side(struct hsr_page *page, double *side,
                          const char *option, const char *arg,
                          struct option_base *base) {
  const struct unit *unit = parse_measure(arg, side);
  if (!unit || *side > MOST_PAGE || !strcmp(unit->name, "m"))
    return option_fail(base,
                       "%s %s: must be a length in mm, cm, in, pt or px, as "
                       "85mm",
                       option, arg);
  page->word = unit->name;
  page->word_size = unit->mm;
  return 0;
}

error_t parse_page_option(struct hsr_page *page, int key, char *arg,
                          struct option_base *base) {
  switch (key) {
  case PAGE_WIDTH:
    return parse_side(page, &page->width, "--width", arg, base);
  case PAGE_HEIGHT:
    return parse_side(page, &page->height, "--height", arg, base);
  case PAGE_SCALE:
    if (!page->word) {
      page->word = "mm";
      page->word_size = 1;
    }
    return parse_scale(arg, &page->scale)
               ? 0
               : option_fail(base, "--scale %s: must be A:B, as 1:20", arg);
  case PAGE_UNIT:
    return parse_measure(arg, &page->unit)
               ? 0
               : option_fail(base, "--unit %s: must be a length, as 1m", arg);
  case PAGE_CROP:
    page->crop = true;
    return 0;
  case PAGE_MARGIN:
    return parse_length(arg, &page->margin) || !strcmp(arg, "0")
               ? 0
               : option_fail(base, "--margin %s: must be a length, as 5mm",
                             arg);
  default:
    return ARGP_ERR_UNKNOWN;
  }
}
