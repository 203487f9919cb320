/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Palettes: files become the integers that docs/palettes.md says, faults are
 * refused at the right place, the schema admits what the reader takes; and
 * those that are built in are sound. */
#include "common/files/json/palette_json.h"
#include "tests/schema.h"
#include "tests/tap.h"

#include <jansson.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define COUNT(array) ((int)(sizeof(array) / sizeof *(array)))
#define HEAD "{\"schema\": \"hsr-palette/1\""

static const char path[] = "palette_test.json";
static json_t *schema;

/* Ends the program if a step that a test needs, but does not test, fails. */
static void must(bool done) {
  if (!done)
    bail("The test cannot be set up.");
}

static void write_bytes(const char *bytes, size_t n) {
  FILE *file = fopen(path, "w");
  must(file && fwrite(bytes, 1, n, file) == n);
  must(!fclose(file));
}

static enum hsr_status read_text(const char *text, struct hsr_palette *palette,
                                 struct hsr_error *err) {
  write_bytes(text, strlen(text));
  *err = (struct hsr_error){HSR_OK, ""};
  return hsr_palette_json_read(path, palette, err);
}

static bool is_admitted(const char *text) {
  json_t *value = json_loads(text, JSON_DECODE_ANY, NULL);
  bool admitted = value && schema_admits(schema, value);
  json_decref(value);
  return admitted;
}

/* The palette of a text that is right. */
static struct hsr_palette good(const char *text) {
  struct hsr_palette palette;
  struct hsr_error err;
  if (read_text(text, &palette, &err) || !is_admitted(text)) {
    printf("# %s: %s\n", text, err.text);
    memset(&palette, 0xaa, sizeof palette);
  }
  return palette;
}

static bool same_palette(const struct hsr_palette *a,
                         const struct hsr_palette *b) {
  return !memcmp(a->opacity, b->opacity, sizeof a->opacity) &&
         !memcmp(a->rgb, b->rgb, sizeof a->rgb) &&
         !memcmp(a->gradient, b->gradient, sizeof a->gradient) &&
         a->own_colours == b->own_colours && a->ambient == b->ambient &&
         a->diffuse == b->diffuse && a->specular == b->specular &&
         a->exponent == b->exponent && a->eye_light == b->eye_light;
}

/* --- What files say ------------------------------------------------------- */

static void check_tables(struct tap *tap) {
  struct hsr_palette p =
      good(HEAD ", \"opacity\": [[0, 0], [80, 0], [120, 0.4], [255, 0.9]],"
                "\"colour\": [[0, \"#000000\"], [255, [1, 0.9, 0.8]]],"
                "\"gradient\": [[0, 0.2], [128, 1]], \"own_colours\": true,"
                "\"light\": [1, 2, 2], \"ambient\": 0.5, \"diffuse\": 0,"
                "\"specular\": 1, \"exponent\": 128}");
  /* 0.9 is 58981.5, and so 58982; (26214 x 55 + 58982 x 80) / 135 = 45632.1 */
  ok(tap,
     p.opacity[0] == 0 && p.opacity[80] == 0 && p.opacity[81] == 655 &&
         p.opacity[100] == 13107 && p.opacity[120] == 26214 &&
         p.opacity[200] == 45632 && p.opacity[255] == 58982,
     "opacity is rounded at points, and down between them");
  ok(tap,
     p.rgb[0][0] == 0 && p.rgb[128][0] == 32896 && p.rgb[128][1] == 29606 &&
         p.rgb[128][2] == 26316 && p.rgb[255][0] == 65535 &&
         p.rgb[255][1] == 58982 && p.rgb[255][2] == 52428,
     "so is colour, channel by channel");
  ok(tap,
     p.gradient[0] == 13107 && p.gradient[1] == 13516 &&
         p.gradient[64] == 39321 && p.gradient[128] == 65535 &&
         p.gradient[255] == 65535,
     "and the factor by gradient, which is constant after the last point");
  ok(tap,
     p.own_colours && !p.eye_light && p.light[0] == 341 && p.light[1] == 683 &&
         p.light[2] == 683,
     "a direction of light is about 1024 long");
  ok(tap,
     p.ambient == 32768 && p.diffuse == 0 && p.specular == 65535 &&
         p.exponent == 128,
     "strengths of light");
}

static void check_standards(struct tap *tap) {
  struct hsr_palette p = good(HEAD "}");
  bool opaque = true;
  for (int k = 0; k < HSR_LEVELS; k++)
    opaque = opaque && p.opacity[k] == 65535 && p.gradient[k] == 65535 &&
             p.rgb[k][0] == 49151 && p.rgb[k][1] == 49151 &&
             p.rgb[k][2] == 49151;
  ok(tap,
     opaque && p.own_colours && p.eye_light && p.ambient == 13107 &&
         p.diffuse == 52428 && p.specular == 13107 && p.exponent == 16,
     "all members but one may be left out");
  p = good(HEAD ", \"light\": \"eye\", \"colour\": [[7, [1, 0, 0]]]}");
  ok(tap,
     !p.own_colours && p.eye_light && p.rgb[0][0] == 65535 &&
         p.rgb[255][0] == 65535 && p.rgb[255][1] == 0,
     "one point is everywhere; a colour is preferred to those of samples");
  p = good(HEAD ", \"light\": [1e300, -1e300, 0]}");
  ok(tap, p.light[0] == 724 && p.light[1] == -724 && p.light[2] == 0,
     "a direction may be long");
  p = good(HEAD ", \"light\": [0, 0, -5e-324]}");
  ok(tap, p.light[0] == 0 && p.light[1] == 0 && p.light[2] == -1024,
     "or short");
}

/* All bytes of sRGB, each against long doubles. */
static void check_srgb(struct tap *tap) {
  char text[HSR_LEVELS * 24 + 80] = HEAD ", \"colour\": [";
  for (int k = 0; k < HSR_LEVELS; k++)
    sprintf(text + strlen(text), "%s[%d, \"#%02x%02X00\"]", k ? "," : "", k, k,
            255 - k);
  strcat(text, "]}");
  struct hsr_palette p = good(text);
  int wrong = 0;
  for (int k = 0; k < HSR_LEVELS; k++) {
    long double e = k / 255.0L, linear;
    linear = e <= 0.04045L ? e / 12.92L : powl((e + 0.055L) / 1.055L, 2.4L);
    wrong += p.rgb[k][0] != lrintl(65535 * linear) ||
             p.rgb[k][0] != p.rgb[255 - k][1] || p.rgb[k][2] != 0;
  }
  ok(tap, !wrong && p.rgb[111][0] == 10417 && p.rgb[188][0] == 32957,
     "colours of sRGB become linear, %d wrong", wrong);
}

/* --- Faults --------------------------------------------------------------- */

/* Whether the schema admits it, too, is in the last column. */
static const struct {
  const char *text, *message;
  bool admitted;
} faults[] = {
    {"", ":1: ", false},
    {"{\"schema\": \"hsr-palette/1\"", ":1: ", false},
    {HEAD ",\n\"ambient\": 1, \"ambient\": 1}", ":2: duplicate", true},
    {"[]", "json: must be an object, not an array", false},
    {"{}", "json: 'schema' is missing: it must be 'hsr-palette/1'", false},
    {"{\"schema\": 1}", "/schema: must be a string, not a number", false},
    {"{\"schema\": \"hsr-scene/1\"}",
     "/schema: must be 'hsr-palette/1', not 'hsr-scene/1'", false},
    {HEAD ", \"color\": []}", "/color: unknown key: did you mean colour?",
     false},
    {HEAD ", \"a\\nb\": []}", "/a?b: unknown key", false},
    {HEAD ", \"opacity\": 1}", "/opacity: must be an array, not a number",
     false},
    {HEAD ", \"gradient\": []}", "/gradient: must have at least one point",
     false},
    {HEAD ", \"opacity\": [0, 1]}",
     "/opacity/0: must be a pair [LEVEL, VALUE], not a number", false},
    {HEAD ", \"opacity\": [[0, 1], [1]]}",
     "/opacity/1: must be a pair [LEVEL, VALUE], not 1 values", false},
    {HEAD ", \"opacity\": [[\"0\", 1]]}",
     "/opacity/0/0: must be a number, not a string", false},
    {HEAD ", \"opacity\": [[256, 1]]}",
     "/opacity/0/0: 256 is no whole number from 0 to 255", false},
    {HEAD ", \"opacity\": [[-1, 1]]}",
     "/opacity/0/0: -1 is no whole number from 0 to 255", false},
    {HEAD ", \"opacity\": [[2.5, 1]]}",
     "/opacity/0/0: 2.5 is no whole number from 0 to 255", false},
    {HEAD ", \"opacity\": [[9, 0], [9, 1]]}",
     "/opacity/1/0: level 9 must be above the one before, 9", true},
    {HEAD ", \"opacity\": [[9, 0], [3, 1]]}",
     "/opacity/1/0: level 3 must be above the one before, 9", true},
    {HEAD ", \"gradient\": [[0, 1.5]]}",
     "/gradient/0/1: 1.5 is not between 0 and 1", false},
    {HEAD ", \"gradient\": [[0, -0.1]]}",
     "/gradient/0/1: -0.1 is not between 0 and 1", false},
    {HEAD ", \"gradient\": [[0, null]]}",
     "/gradient/0/1: must be a number, not null", false},
    {HEAD ", \"colour\": [[0, 1]]}",
     "/colour/0/1: must be a colour, \"#rrggbb\" or [R, G, B], not a number",
     false},
    {HEAD ", \"colour\": [[0, \"red\"]]}", "[R, G, B], not 'red'", false},
    {HEAD ", \"colour\": [[0, \"#12345\"]]}", "not '#12345'", false},
    {HEAD ", \"colour\": [[0, \"#12345g\"]]}", "not '#12345g'", false},
    {HEAD ", \"colour\": [[0, [1, 1]]]}",
     "/colour/0/1: must have 3 numbers, not 2", false},
    {HEAD ", \"colour\": [[0, [1, 1, 2]]]}",
     "/colour/0/1/2: 2 is not between 0 and 1", false},
    {HEAD ", \"own_colours\": 1}",
     "/own_colours: must be true or false, not a number", false},
    {HEAD ", \"light\": \"sun\"}", "[X, Y, Z], not 'sun'", false},
    {HEAD ", \"light\": true}",
     "/light: must be \"eye\" or a direction [X, Y, Z], not a truth value",
     false},
    {HEAD ", \"light\": [1, 2]}", "/light: must have 3 numbers, not 2", false},
    {HEAD ", \"light\": [1, 2, \"3\"]}",
     "/light/2: must be a number, not a string", false},
    {HEAD ", \"light\": [0, -0.0, 0]}", "/light: 0, 0, 0 is no direction",
     true},
    {HEAD ", \"ambient\": 2}", "/ambient: 2 is not between 0 and 1", false},
    {HEAD ", \"diffuse\": \"1\"}", "/diffuse: must be a number, not a string",
     false},
    {HEAD ", \"specular\": 1e400}", ":1: ", false},
    {HEAD ", \"exponent\": 0}", "/exponent: 0 is no whole number from 1 to 128",
     false},
    {HEAD ", \"exponent\": 129}", "/exponent: 129 is no", false},
    {HEAD ", \"exponent\": 1.5}", "/exponent: 1.5 is no", false},
    {HEAD ", \"exponent\": [1]}", "/exponent: must be a number, not an array",
     false},
};

static bool is_refused(int k) {
  struct hsr_palette palette, before;
  struct hsr_error err;
  memset(&before, 0x5a, sizeof before);
  memcpy(&palette, &before, sizeof before);
  bool good = read_text(faults[k].text, &palette, &err) == HSR_E_INPUT &&
              err.status == HSR_E_INPUT && strstr(err.text, path) &&
              strstr(err.text, faults[k].message) &&
              !memcmp(&palette, &before, sizeof before) &&
              is_admitted(faults[k].text) == faults[k].admitted;
  if (!good)
    printf("# %s: %s\n", faults[k].text, err.text);
  return good;
}

static void check_faults(struct tap *tap) {
  for (int k = 0; k < COUNT(faults); k++)
    ok(tap, is_refused(k), "refused: %s", faults[k].message);
  struct hsr_palette palette;
  struct hsr_error err;
  write_bytes(HEAD "}\0", sizeof HEAD + 1);
  ok(tap,
     hsr_palette_json_read(path, &palette, &err) == HSR_E_INPUT &&
         strstr(err.text, "a NUL byte"),
     "a NUL is noticed");
  remove(path);
  ok(tap,
     hsr_palette_json_read(path, &palette, &err) == HSR_E_INPUT &&
         strstr(err.text, "cannot be read"),
     "a file that is not there");
  must(!mkdir(path, 0777));
  ok(tap,
     hsr_palette_json_read(path, &palette, &err) == HSR_E_INPUT &&
         strstr(err.text, "is a directory"),
     "a folder");
  rmdir(path);
}

/* --- Those that are built in ---------------------------------------------- */

static bool is_sound(const struct hsr_palette_name *name) {
  struct hsr_palette p, opened;
  struct hsr_error err;
  bool found = hsr_palette_find(name->name, &p) &&
               !hsr_palette_open(name->name, &opened, &err) &&
               same_palette(&p, &opened);
  uint32_t opacity = 0, gradient = 0, light = 0;
  for (int k = 0; k < HSR_LEVELS && found; k++) {
    opacity += p.opacity[k];
    gradient += p.gradient[k];
  }
  if (found)
    light = (uint32_t)p.ambient + p.diffuse;
  return found && opacity && gradient && light && *name->meaning &&
         p.exponent >= 1 && p.exponent <= 128 && p.eye_light;
}

static void check_built_in(struct tap *tap) {
  bool sound = true;
  int n = 0;
  for (; hsr_palette_names[n].name; n++)
    if (!is_sound(&hsr_palette_names[n])) {
      printf("# %s\n", hsr_palette_names[n].name);
      sound = false;
    }
  ok(tap, sound && n == 8, "%d palettes are built in", n);
  struct hsr_palette p, kept;
  must(hsr_palette_find("haze", &p));
  ok(tap, p.opacity[128] == 4111 && p.opacity[255] == 8191 && !p.own_colours,
     "haze is an eighth opaque at most");
  must(hsr_palette_find("surfaces", &p));
  ok(tap, p.gradient[64] == 32767 && p.gradient[200] == 65535,
     "surfaces are where the density changes");
  kept = p;
  struct hsr_error err;
  ok(tap,
     !hsr_palette_find("bones", &p) &&
         hsr_palette_open("bones", &p, &err) == HSR_E_USAGE &&
         !strcmp(err.text, "there is no palette 'bones': did you mean bone?") &&
         same_palette(&p, &kept),
     "an unknown name is refused");
  ok(tap,
     hsr_palette_open("none.json", &p, &err) == HSR_E_INPUT &&
         hsr_palette_open("", &p, &err) == HSR_E_USAGE,
     "a name that ends in .json is a file's");
}

int main(void) {
  struct tap tap = plan(18 + COUNT(faults));
  schema = schema_open("palette.schema.json");
  char folder[] = "/tmp/hsr-palette-XXXXXX";
  must(mkdtemp(folder) && !chdir(folder));
  check_tables(&tap);
  check_standards(&tap);
  check_srgb(&tap);
  check_faults(&tap);
  check_built_in(&tap);
  must(!chdir("/") && !rmdir(folder));
  json_decref(schema);
  return finish(&tap);
}
