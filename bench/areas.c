/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr areas: how much of the picture shows which face, exactly. */
#include "bench/judge/areas/areas.h"
#include "bench/options/command.h"
#include "bench/options/picture.h"
#include "bench/options/place.h"
#include "bench/terminal/terminal.h"
#include "common/answers/kinds/area.h"
#include "common/base/nearest.h"
#include "common/files/suffix.h"
#include "common/files/whole_file.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PER_PIXEL = 0x200, EXACT };

struct options {
  struct option_base base;
  struct scene_options scene;
  struct view_options view;
  enum hsr_area_filter filter;
  const char *output;
  bool per_pixel, exact;
};

static error_t parse(int key, char *arg, struct argp_state *state) {
  struct options *o = state->input;
  switch (key) {
  case 'f':
    return parse_area_filter(&o->filter, arg, &o->base);
  case PER_PIXEL:
    o->per_pixel = true;
    return 0;
  case EXACT:
    o->exact = true;
    return 0;
  case 'o':
    if (o->output)
      return option_fail(&o->base, "areas: one -o, not also '%s'", arg);
    return parse_output(arg, ".csv", "areas", &o->base, &o->output);
  default:
    return parse_place_option(&o->scene, &o->view, key, arg, "areas", &o->base);
  }
}

static const struct argp argp = {
    (const struct argp_option[]){
        {"output", 'o', "FILE", 0, "write them to this file, .csv or .json", 0},
        {"filter", 'f', "box|tent|quadratic|cubic", 0,
         "weigh each pixel's surroundings by a B-spline: box, tent, quadratic, "
         "cubic (standard: box, the pixel itself)",
         0},
        {"per-pixel", PER_PIXEL, NULL, 0,
         "the faces of each pixel: in .csv instead of all of the picture, in "
         ".json as well",
         0},
        {"exact", EXACT, NULL, 0,
         "each number also as a quotient of whole numbers", 0},
        SCENE_ARGP_OPTIONS,
        VIEW_ARGP_OPTIONS_OF("512x512"),
        {0}},
    parse,
    "SCENE",
    "Finds how much of the picture shows which face, exactly: the area of each "
    "visible face in pixels, and its share of the picture. With a filter other "
    "than the box, it is the sum of the face's shares in all pixels.\v"
    "  hsr areas house -o areas.csv\n"
    "  hsr areas harbor -s 256x256 --per-pixel --exact -o pixels.json",
    NULL,
    NULL,
    NULL};

/* --- Sums ----------------------------------------------------------------- */

/* The shares of a face. Sums of 2^k of them are kept apart, as the digits of a
 * binary counter: numbers of like length are added. */
enum { MOST_DIGITS = 30 };
struct sum {
  uint64_t whole; /* shares that are 1 */
  int n;          /* digits; those that are in use are not 0 */
  mpq_t digit[MOST_DIGITS];
};

static void add_share(struct sum *sum, const mpq_t share) {
  mpq_t carry;
  if (mpq_cmp_ui(share, 1, 1) == 0) {
    sum->whole++;
    return;
  }
  mpq_init(carry);
  mpq_set(carry, share);
  int k = 0;
  for (; k < sum->n && mpq_sgn(sum->digit[k]); k++) {
    mpq_add(carry, carry, sum->digit[k]);
    mpq_set_ui(sum->digit[k], 0, 1);
  }
  if (k == sum->n)
    mpq_init(sum->digit[sum->n++]);
  mpq_swap(sum->digit[k], carry);
  mpq_clear(carry);
}

static void total(const struct sum *sum, mpq_t all) {
  mpq_set_ui(all, sum->whole, 1);
  for (int k = 0; k < sum->n; k++)
    mpq_add(all, all, sum->digit[k]);
}

static bool is_seen(const struct sum *sum) {
  return sum->whole || sum->n;
}

/* --- Output --------------------------------------------------------------- */

struct found {
  const struct options *options;
  const struct hsr_world *world;
  const struct hsr_view *view;
  struct sum *sum; /* a face, and one of the background */
  FILE *out;       /* or NULL */
  bool json;
  struct progress progress;
};

static size_t number_of(const struct found *found, uint32_t face) {
  return face == HSR_BACKGROUND ? found->world->n_faces : face;
}

static void put_csv_text(FILE *out, const char *text) {
  putc('"', out);
  for (; *text; text++)
    fprintf(out, *text == '"' ? "\"\"" : "%c", *text);
  putc('"', out);
}

/* "5,"body",0": the face, its object and its instance. */
static void put_csv_face(const struct found *found, uint32_t face) {
  if (face == HSR_BACKGROUND) {
    fputs("background,,", found->out);
    return;
  }
  struct hsr_place place = hsr_place_of(found->world, face);
  fprintf(found->out, "%u,", face);
  put_csv_text(found->out, place.object->name);
  fprintf(found->out, ",%u", place.instance);
}

static void put_exact(const struct found *found, const mpq_t q) {
  fputs(found->json ? ", \"exact\": \"" : ",", found->out);
  mpq_out_str(found->out, 10, q);
  fputs(found->json ? "\"" : "", found->out);
}

static void put_csv_part(const struct found *found, int i, int j,
                         const struct area_part *part) {
  fprintf(found->out, "%d,%d,", i, j);
  put_csv_face(found, part->face);
  fprintf(found->out, ",%.17g", hsr_nearest_double(part->share));
  if (found->options->exact)
    put_exact(found, part->share);
  fputs("\r\n", found->out);
}

static void put_json_face(const struct found *found, uint32_t face) {
  if (face == HSR_BACKGROUND)
    fputs("{\"face\": null", found->out);
  else
    fprintf(found->out, "{\"face\": %u", face);
}

static void put_json_pixel(const struct found *found, int i, int j,
                           const struct area_part *part, size_t n) {
  fprintf(found->out, "%s\n{\"x\": %d, \"y\": %d, \"faces\": [",
          i || j ? "," : "", i, j);
  for (size_t k = 0; k < n; k++) {
    fputs(k ? ", " : "", found->out);
    put_json_face(found, part[k].face);
    fprintf(found->out, ", \"share\": %.17g",
            hsr_nearest_double(part[k].share));
    if (found->options->exact)
      put_exact(found, part[k].share);
    putc('}', found->out);
  }
  fputs("]}", found->out);
}

static enum hsr_status take_pixel(void *to, int i, int j,
                                  const struct area_part *part, size_t n) {
  struct found *found = to;
  for (size_t k = 0; k < n; k++)
    add_share(&found->sum[number_of(found, part[k].face)], part[k].share);
  if (found->out && found->options->per_pixel) {
    for (size_t k = 0; k < n && !found->json; k++)
      put_csv_part(found, i, j, &part[k]);
    if (found->json)
      put_json_pixel(found, i, j, part, n);
  }
  if (i == 0)
    progress_tell(&found->progress, (size_t)j, (size_t)found->view->n, "rows",
                  found->options->scene.name);
  return HSR_OK;
}

/* A string of JSON, which the caller frees; NULL for lack of memory. */
static char *quoted(const char *text) {
  json_t *string = json_string(text);
  char *made = string ? json_dumps(string, JSON_ENCODE_ANY) : NULL;
  json_decref(string);
  return made;
}

static enum hsr_status begin_json(const struct found *found,
                                  struct hsr_error *err) {
  const struct options *o = found->options;
  char *name = quoted(o->scene.name);
  if (!name)
    return hsr_fail_nomem(err);
  fprintf(found->out,
          "{\"schema\": \"hsr-areas/1\", \"scene\": %s, \"view\": %ld, "
          "\"width\": %d, \"height\": %d, \"filter\": \"%s\"",
          name, o->view.view, found->view->m, found->view->n,
          hsr_area_filters[o->filter].name);
  free(name);
  if (o->per_pixel)
    fputs(",\n\"pixels\": [", found->out);
  return HSR_OK;
}

static void begin_csv(const struct found *found) {
  const struct options *o = found->options;
  fprintf(found->out, "%sface,object,instance,%s%s\r\n",
          o->per_pixel ? "x,y," : "", o->per_pixel ? "share" : "area,share",
          o->exact ? ",exact" : "");
}

/* The area of a face in all of the picture. */
static enum hsr_status put_face(const struct found *found, uint32_t face,
                                bool first, struct hsr_error *err) {
  mpq_t area, share;
  mpq_inits(area, share, NULL);
  total(&found->sum[number_of(found, face)], area);
  mpq_set_ui(share,
             (unsigned long)found->view->m * (unsigned long)found->view->n, 1);
  mpq_div(share, area, share);
  char *name = NULL;
  if (!found->json) {
    put_csv_face(found, face);
    fprintf(found->out, ",%.17g,%.17g", hsr_nearest_double(area),
            hsr_nearest_double(share));
  } else {
    fputs(first ? "\n" : ",\n", found->out);
    put_json_face(found, face);
    if (face != HSR_BACKGROUND) {
      struct hsr_place place = hsr_place_of(found->world, face);
      name = quoted(place.object->name);
      fprintf(found->out, ", \"object\": %s, \"instance\": %u",
              name ? name : "", place.instance);
    }
    fprintf(found->out, ", \"area\": %.17g, \"share\": %.17g",
            hsr_nearest_double(area), hsr_nearest_double(share));
  }
  if (found->options->exact)
    put_exact(found, area);
  fputs(found->json ? "}" : "\r\n", found->out);
  bool lacks_memory = found->json && face != HSR_BACKGROUND && !name;
  free(name);
  mpq_clears(area, share, NULL);
  return lacks_memory ? hsr_fail_nomem(err) : HSR_OK;
}

static enum hsr_status put_faces(const struct found *found,
                                 struct hsr_error *err) {
  bool first = true;
  enum hsr_status status = HSR_OK;
  if (found->json)
    fprintf(found->out, "%s,\n\"faces\": [",
            found->options->per_pixel ? "]" : "");
  else if (found->options->per_pixel)
    return HSR_OK;
  for (uint32_t k = 0; k <= found->world->n_faces && !status; k++) {
    if (!is_seen(&found->sum[k]))
      continue;
    status = put_face(found, k < found->world->n_faces ? k : HSR_BACKGROUND,
                      first, err);
    first = false;
  }
  if (found->json)
    fputs("]}\n", found->out);
  return status;
}

/* --- Text ----------------------------------------------------------------- */

enum { MOST_TOLD = 12 };

struct told {
  uint32_t face;
  double area;
};

static int by_area(const void *a, const void *b) {
  const struct told *f = a, *g = b;
  if (f->area != g->area)
    return f->area < g->area ? 1 : -1;
  return (f->face > g->face) - (f->face < g->face);
}

static enum hsr_status print_text(const struct found *found,
                                  struct hsr_error *err) {
  uint32_t n_faces = found->world->n_faces, n = 0;
  struct told *told = malloc(((size_t)n_faces + 1) * sizeof *told);
  if (!told)
    return hsr_fail_nomem(err);
  mpq_t area;
  mpq_init(area);
  for (uint32_t k = 0; k <= n_faces; k++)
    if (is_seen(&found->sum[k])) {
      total(&found->sum[k], area);
      told[n++] = (struct told){k, hsr_nearest_double(area)};
    }
  mpq_clear(area);
  uint32_t visible = n - is_seen(&found->sum[n_faces]);
  qsort(told, n, sizeof *told, by_area);
  char name[TERMINAL_NAME];
  printf("%s, view %ld, %d x %d pixels: %u of %u faces visible\n\n",
         terminal_plain(found->options->scene.name, name, sizeof name),
         found->options->view.view, found->view->m, found->view->n, visible,
         n_faces);
  printf("%12s %18s %10s  %s\n", "face", "pixels", "share", "object");
  double all = (double)found->view->m * found->view->n;
  for (uint32_t k = 0; k < n && k < MOST_TOLD; k++) {
    bool background = told[k].face == n_faces;
    char number[20];
    snprintf(number, sizeof number, "%u", told[k].face);
    printf("%12s %18.6f %9.4f%%  %.36s\n", background ? "background" : number,
           told[k].area, 100 * told[k].area / all,
           background
               ? ""
               : terminal_plain(
                     hsr_place_of(found->world, told[k].face).object->name,
                     name, sizeof name));
  }
  if (n > MOST_TOLD)
    printf("and %u more; -o FILE.csv has all\n", n - MOST_TOLD);
  free(told);
  return HSR_OK;
}

/* --- The command ---------------------------------------------------------- */

static enum hsr_status write_file(struct found *found, struct hsr_error *err) {
  const struct options *o = found->options;
  struct hsr_whole_file file;
  enum hsr_status status = hsr_whole_file_open(&file, o->output, err);
  if (status)
    return status;
  found->out = file.stream;
  if (found->json)
    status = begin_json(found, err);
  else
    begin_csv(found);
  if (!status)
    status = visit_areas(found->world, found->view, o->filter, take_pixel,
                         found, err);
  if (!status)
    status = put_faces(found, err);
  return hsr_whole_file_close(&file, status, err);
}

static enum hsr_status find(const struct options *o,
                            const struct hsr_world *world,
                            const struct hsr_view *view,
                            struct hsr_error *err) {
  struct found found = {.options = o,
                        .world = world,
                        .view = view,
                        .json = o->output && hsr_ends_in(o->output, ".json"),
                        .progress = progress_begin(stderr)};
  found.sum = calloc((size_t)world->n_faces + 1, sizeof *found.sum);
  if (!found.sum)
    return hsr_fail_nomem(err);
  enum hsr_status status =
      o->output ? write_file(&found, err)
                : visit_areas(world, view, o->filter, take_pixel, &found, err);
  progress_end(&found.progress);
  if (!status && !o->output)
    status = print_text(&found, err);
  for (uint32_t k = 0; k <= world->n_faces; k++)
    for (int d = 0; d < found.sum[k].n; d++)
      mpq_clear(found.sum[k].digit[d]);
  free(found.sum);
  return status;
}

static enum hsr_status check_output(const struct options *o,
                                    struct hsr_error *err) {
  if (!o->output && (o->per_pixel || o->exact))
    return hsr_fail(err, HSR_E_USAGE, "areas: %s needs -o",
                    o->per_pixel ? "--per-pixel" : "--exact");
  if (!o->output || hsr_ends_in(o->output, ".csv") ||
      hsr_ends_in(o->output, ".json"))
    return HSR_OK;
  return hsr_fail(err, HSR_E_INPUT, "%s: areas are written as .csv or .json",
                  o->output);
}

enum hsr_status command_areas(int argc, char **argv, struct hsr_error *err) {
  struct options options = {.view = VIEW_OPTIONS_STANDARD};
  struct place place;
  enum hsr_status status = parse_options(&argp, argc, argv, &options, err);
  if (!status)
    status = check_output(&options, err);
  if (status)
    return status;
  status = place_open(&place, &options.scene, &options.view, "areas", err);
  if (!status)
    status = find(&options, &place.world, &place.view, err);
  place_close(&place);
  return status;
}
