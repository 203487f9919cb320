/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which texts for an algorithm with options are valid, and which are not. */
#include "bench/modules/variant.h"
#include "tests/tap.h"
#include "common/answers/kinds/filtered.h"
#include "common/answers/kinds/segments.h"

#include <string.h>

static struct hsr_variant variant;
static struct hsr_error err;

/* Checks that the text is refused with this message. */
static void bad(struct tap *tap, const char *text, const char *says) {
  err.text[0] = '\0';
  enum hsr_status status = hsr_variant_parse(text, &variant, &err);
  ok(tap, status == HSR_E_USAGE && strstr(err.text, says) != NULL,
     "'%.40s' is refused: %s", text, err.text);
}

/* The number chosen for the algorithm's option; -1 if there is no such option.
 */
static long chosen(const char *name) {
  const struct hsr_option *option = variant.listed->plain->options;
  for (int k = 0; option[k].name; k++)
    if (!strcmp(option[k].name, name))
      return variant.choice.values.option[k];
  return -1;
}

static bool parses(const char *text) {
  return !hsr_variant_parse(text, &variant, &err) &&
         !strcmp(variant.name, text);
}

/* Every word of every option of every algorithm is valid, and so are the ends
 * of every number's range. */
static bool all_parse(void) {
  bool good = true;
  for (const struct hsr_listed *a = hsr_algorithms(); a->plain; a++) {
    const struct hsr_option *option = a->plain->options;
    for (int k = 0; option && option[k].name; k++) {
      char text[HSR_MOST_VARIANT + 1];
      for (long w = 0; option[k].words && option[k].words[w].name; w++) {
        snprintf(text, sizeof text, "%s:%s=%s", a->plain->name, option[k].name,
                 option[k].words[w].name);
        good &= parses(text) && variant.listed == a &&
                variant.choice.values.option[k] == w;
      }
      for (int end = 0; !option[k].words && end < 2; end++) {
        long number = end ? option[k].most : option[k].least;
        snprintf(text, sizeof text, "%s:%s=%ld", a->plain->name, option[k].name,
                 number);
        good &= parses(text) && variant.choice.values.option[k] == number;
      }
    }
  }
  return good;
}

static void test_good(struct tap *tap) {
  struct hsr_choice standard;
  ok(tap, parses("zbuffer-fast") && !variant.choice.window, "a name alone");
  ok(tap, parses("hzbuffer"), "a name of one that has options");
  standard = hsr_choice_standard(variant.listed->plain);
  ok(tap, !memcmp(&standard, &variant.choice, sizeof standard),
     "leaves all at its standard");
  ok(tap,
     parses("hzbuffer:cubes=sides:least=7") && chosen("cubes") == 1 &&
         chosen("least") == 7 && chosen("octree") == 1,
     "options are set, the others are not");
  ok(tap, parses("hzbuffer:window=16") && variant.choice.window == 16,
     "a window");
  ok(tap, parses("watkins:window=16384") && variant.choice.window == 16384,
     "a window, of any algorithm that draws faces");
  ok(tap,
     parses("zbuffer-fast:filter=box") &&
         hsr_form_filtering(&variant.choice.form).filter == HSR_FILTER_BOX &&
         !hsr_form_filtering(&variant.choice.form).patterns &&
         variant.choice.form.type == HSR_FILTERED,
     "a filter makes another kind of picture");
  ok(tap,
     parses("hzbuffer:jitter=16:coherence=list:filter=cosine") &&
         hsr_form_filtering(&variant.choice.form).filter == HSR_FILTER_COSINE &&
         hsr_form_filtering(&variant.choice.form).patterns == 16,
     "and jitter, in any order");
  ok(tap,
     parses("zbuffer-fast:jitter=0:filter=box") &&
         !hsr_form_filtering(&variant.choice.form).patterns &&
         parses("roberts") && variant.choice.form.type == HSR_SEGMENTS,
     "or none");
  ok(tap, all_parse(),
     "every word, and the ends of every number, of every "
     "algorithm's options");
  ok(tap,
     parses("hzbuffer:coherence=passes") &&
         hsr_choice_flags(variant.listed->plain, &variant.choice) &
             HSR_FRAME_STATE,
     "a word may add a flag");
}

static void test_bad(struct tap *tap) {
  char longest[HSR_MOST_VARIANT + 2];
  memset(longest, ':', sizeof longest - 1);
  memcpy(longest, "hzbuffer", 8);
  longest[sizeof longest - 1] = '\0';
  bad(tap, "", "no algorithm ''");
  bad(tap, "z-buffer", "no algorithm 'z-buffer'");
  bad(tap, "hzbuffe", "no algorithm");
  bad(tap, ":cubes=sides", "no algorithm ''");
  bad(tap, "hzbuffer=2", "no algorithm");
  bad(tap, longest, "at most 1000 characters");
  bad(tap, "hzbuffer:", "no option ''");
  bad(tap, "hzbuffer::cubes=sides", "no option ''");
  bad(tap, "hzbuffer:=sides", "no option ''");
  bad(tap, "hzbuffer:cube=sides", "no option 'cube'");
  bad(tap, "hzbuffer:cubess=sides", "no option 'cubess'");
  bad(tap, "zbuffer-fast:cubes=sides", "no option 'cubes'");
  bad(tap, "hzbuffer:cubes", "cubes must be one of: rectangle, sides");
  bad(tap, "hzbuffer:cubes=", "cubes must be one of");
  bad(tap, "hzbuffer:cubes=side", "cubes must be one of");
  bad(tap, "hzbuffer:cubes=sidess", "cubes must be one of");
  bad(tap, "hzbuffer:cubes=1", "cubes must be one of");
  bad(tap, "hzbuffer:cubes=sides=", "cubes must be one of");
  bad(tap, "hzbuffer:least", "least must be 1 to 100000");
  bad(tap, "hzbuffer:least=0", "least must be");
  bad(tap, "hzbuffer:least=100001", "least must be");
  bad(tap, "hzbuffer:least=-1", "least must be");
  bad(tap, "hzbuffer:least=+1", "least must be");
  bad(tap, "hzbuffer:least= 1", "least must be");
  bad(tap, "hzbuffer:least=1x", "least must be");
  bad(tap, "hzbuffer:least=0x10", "least must be");
  bad(tap, "hzbuffer:least=99999999999999999999999", "least must be");
  bad(tap, "hzbuffer:least=9223372036854775808", "least must be");
  bad(tap, "hzbuffer:window", "window must be 1 to 16384");
  bad(tap, "hzbuffer:window=0", "window must be");
  bad(tap, "hzbuffer:window=16385", "window must be");
  bad(tap, "hzbuffer:least=3:least=3", "twice");
  bad(tap, "zbuffer-fast:filter", "filter must be one of: box, cosine");
  bad(tap, "zbuffer-fast:filter=boxes", "filter must be one of");
  bad(tap, "zbuffer-fast:filter=box:filter=cosine", "filter is given twice");
  bad(tap, "zbuffer-fast:filter=box:jitter=17", "jitter must be 0 to 16");
  bad(tap, "zbuffer-fast:filter=box:jitter=-1", "jitter must be");
  bad(tap, "zbuffer-fast:filter=box:jitter", "jitter must be");
  bad(tap, "zbuffer-fast:jitter=1", "jitter needs a filter");
  bad(tap, "zbuffer-fast:jitter=0", "jitter needs a filter");
  bad(tap, "zbuffer-fast:filter=box:window=8", "no windows");
  bad(tap, "zbuffer-fast:window=8:filter=box", "no windows");
  bad(tap, "roberts:filter=box", "filter is an option of filtered");
  bad(tap, "hzbuffer:cubes=sides:pyramid=dual:cubes=rectangle", "twice");
  bad(tap, "zbuffer-fast:window=8:window=16", "twice");
  bad(tap, "appel:window=16", "appel does not draw in windows");
  bad(tap, "hzbuffer:coherence=list:window=32", "no windows");
  bad(tap, "hzbuffer:window=32:coherence=passes", "no windows");
}

/* A real number, which no algorithm has yet, from 0.5 to 2. */
static enum hsr_status choose_real(const char *text, double *real) {
  static const struct hsr_option options[] = {
      {"size", "a real number", .real = true, .real_least = .5, .real_most = 2,
       .real_standard = 1},
      {NULL}};
  struct hsr_values values = hsr_values_standard(options);
  *real = values.real[0];
  if (hsr_values_choose(&values, options, 0,
                        (struct hsr_stretch){text, strlen(text)}, "test", &err))
    return HSR_E_USAGE;
  *real = values.real[0];
  return HSR_OK;
}

static void test_real(struct tap *tap) {
  static const char *const bad[] = {"", "2.1", "0.49", "nan", "1x", "-1"};
  double real;
  bool good = !choose_real("0.5", &real) && real == .5 &&
              !choose_real("2", &real) && real == 2 &&
              !choose_real("1.25e0", &real) && real == 1.25;
  for (size_t k = 0; k < sizeof bad / sizeof *bad; k++)
    good &= choose_real(bad[k], &real) && real == 1;
  ok(tap, good, "real numbers, their ends, and what is none of them");
}

int main(void) {
  struct tap tap = plan(12 + 48);
  test_good(&tap);
  test_bad(&tap);
  test_real(&tap);
  return finish(&tap);
}
