/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command line of hsr render. */
#include "bench/modules/variant.h"
#include "bench/programs/module.h"
#include "bench/options/words.h"
#include "bench/render/render.h"
#include "common/files/srgb.h"

#include <stdlib.h>
#include <string.h>

enum {
  SHADE = 0x200,
  WORK,
  VIEWS,
  ORBIT,
  FRAMES,
  PASSES,
  UNCERTAINTY,
  CERTAIN,
  TILES,
  SORT_LAST,
  BACKGROUND,
  FILL,
  HATCH,
  SHEET,
  ANGLE,
  MOST_ORBIT = 100000
};

/* The index of a word in `words`, which NULL ends; -1 if it is not there. */
static int choose_word(const char *word, const char *const *words) {
  for (int k = 0; words[k]; k++)
    if (!strcmp(word, words[k]))
      return k;
  return -1;
}

/* white, none, or R,G,B: 8 bits a channel, sRGB. */
static error_t parse_background(struct render_options *o, const char *arg) {
  double rgb[3] = {255, 255, 255};
  o->given[HSR_BACKDROP] = "--background";
  o->no_background = !strcmp(arg, "none");
  o->given[HSR_NO_BACKDROP] = o->no_background ? "--background none" : NULL;
  o->has_background = true;
  bool good =
      o->no_background || !strcmp(arg, "white") || parse_point(arg, rgb);
  for (int k = 0; k < 3; k++) {
    good &= rgb[k] >= 0 && rgb[k] <= 255;
    o->background[k] =
        o->no_background ? 0 : hsr_srgb_decode((float)(rgb[k] / 255));
  }
  return good ? 0
              : option_fail(&o->base,
                            "--background %s: must be white, none, or R,G,B, "
                            "each 0 to 255",
                            arg);
}

/* Options that are for pictures of faces. */
static error_t parse_face_option(struct render_options *o, int key, char *arg) {
  static const char *const shadings[] = {[HSR_SHADE_LAMBERT] = "lambert",
                                         [HSR_SHADE_FLAT] = "flat",
                                         [HSR_SHADE_IDS] = "ids",
                                         [HSR_SHADE_GOURAUD] = "gouraud",
                                         NULL};
  int shading;
  switch (key) {
  case 'S':
    o->given[HSR_SUPERSAMPLES] = "--supersample";
    if (!parse_count(arg, 1, 16, &o->supersamples))
      return option_fail(&o->base, "--supersample %s: must be 1 to 16", arg);
    return 0;
  case SHADE:
    o->given[HSR_SHADING] = "--shade";
    shading = choose_word(arg, shadings);
    if (shading < 0)
      return option_fail(
          &o->base, "--shade %s: must be lambert, gouraud, flat or ids", arg);
    o->shading = (enum hsr_shading)shading;
    return 0;
  case BACKGROUND:
    return parse_background(o, arg);
  case WORK:
    o->work = arg;
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

/* Options that are only for line drawings, or for pages. */
static error_t parse_paper_option(struct render_options *o, int key,
                                  char *arg) {
  error_t parsed = parse_line_option(&o->lines, key, arg, &o->base);
  if (parsed != ARGP_ERR_UNKNOWN) {
    o->given[HSR_LINES] = line_option_name(key);
    return parsed;
  }
  parsed = parse_page_option(&o->page, key, arg, &o->base);
  if (parsed != ARGP_ERR_UNKNOWN) {
    static const char *const names[] = {"--width", "--height", "--scale",
                                        "--unit",  "--crop",   "--margin"};
    o->page_option = names[key - PAGE_WIDTH];
  }
  return parsed;
}

/* Options for several pictures. */
static error_t parse_series_option(struct render_options *o, int key,
                                   char *arg) {
  if (key == VIEWS && !parse_range(arg, 1, &o->first, &o->last))
    return option_fail(&o->base,
                       "--views %s: must be A-B, each 1 or more, A <= B", arg);
  if (key == FRAMES && !parse_range(arg, 0, &o->first_frame, &o->last_frame))
    return option_fail(&o->base,
                       "--frames %s: must be A-B, each 0 or more, A <= B", arg);
  if (key == ORBIT && !parse_count(arg, 1, MOST_ORBIT, &o->orbit))
    return option_fail(&o->base, "--orbit %s: must be 1 to %d", arg,
                       (int)MOST_ORBIT);
  return 0;
}

/* Options for pictures larger than memory. */
static error_t parse_tile_option(struct render_options *o, int key, char *arg) {
  if (key == TILES) {
    if (!parse_count(arg, HSR_TILE_GRAIN, HSR_MAX_SIZE, &o->tile) ||
        o->tile % HSR_TILE_GRAIN)
      return option_fail(&o->base,
                         "--tiles %s: must be a multiple of %d, at most %d",
                         arg, (int)HSR_TILE_GRAIN, HSR_MAX_SIZE);
    return 0;
  }
  if (!parse_size_to(arg, HSR_MAX_WHOLE, &o->view.m, &o->view.n))
    return option_fail(
        &o->base,
        "--size %s: must be MxN or N, each 1 to %d, or in tiles to "
        "%d",
        arg, HSR_MAX_SIZE, HSR_MAX_WHOLE);
  return 0;
}

/* For scenes larger than memory. */
static error_t parse_parts(struct render_options *o, const char *arg) {
  o->sort_last = true;
  if (arg && !parse_count(arg, 1, MOST_PARTS, &o->parts))
    return option_fail(&o->base, "--sort-last=%s: must be 1 to %d", arg,
                       (int)MOST_PARTS);
  return 0;
}

static error_t parse(int key, char *arg, struct argp_state *state) {
  struct render_options *o = state->input;
  switch (key) {
  case 'a':
    o->algorithm = arg;
    return 0;
  case 'o':
    if (o->n_outputs == MOST_OUTPUTS)
      return option_fail(&o->base, "render: at most %d output files",
                         (int)MOST_OUTPUTS);
    return parse_output(arg, ".png", "render", &o->base,
                        &o->output[o->n_outputs++]);
  case 'J':
    return parse_threads(&o->scene, &o->threads, arg, &o->base);
  case 'S':
  case SHADE:
  case WORK:
  case BACKGROUND:
    return parse_face_option(o, key, arg);
  case PASSES:
    o->passes = arg;
    return 0;
  case UNCERTAINTY:
    o->uncertainty = arg;
    return 0;
  case CERTAIN:
    o->certain = arg;
    return 0;
  case VIEWS:
  case ORBIT:
  case FRAMES:
    return parse_series_option(o, key, arg);
  case TILES:
  case 's':
    return parse_tile_option(o, key, arg);
  case SORT_LAST:
    return parse_parts(o, arg);
  case SHEET:
    o->sheet = arg;
    o->given[HSR_LINES] = "--sheet";
    return 0;
  case ANGLE:
    o->first_angle = !strcmp(arg, "first");
    return o->first_angle || !strcmp(arg, "third")
               ? 0
               : option_fail(&o->base, "--angle %s: must be first or third",
                             arg);
  case FILL:
    o->fill = arg ? arg : "weiler-atherton";
    o->given[HSR_LINES] = "--fill";
    return 0;
  case HATCH:
    o->hatch = true;
    o->given[HSR_HATCH] = "--hatch";
    return arg ? parse_hatch_option(&o->lines, arg, &o->base) : 0;
  default:
    break;
  }
  const error_t parsed = parse_paper_option(o, key, arg);
  return parsed != ARGP_ERR_UNKNOWN
             ? parsed
             : parse_place_option(&o->scene, &o->view, key, arg, "render",
                                  &o->base);
}

static const struct argp_option entries[] = {
    {"algorithm", 'a', "NAME", 0,
     "the algorithm, or, with a slash, a program (standard: zbuffer-fast)", 0},
    {"output", 'o', "FILE", 0,
     "write the picture, by suffix: .exr holds R G B and, unless it is "
     "filtered, depth Z and face id, or, of splats, the opacity A; .npy the "
     "face ids, 4294967295 where there is none, or the splats' R G B A; "
     ".rgb.npy the colours, .depth.npy and .depth.png the depths of faces; "
     ".png and others the colours; .svg, .pdf, .eps "
     "and, in world space, .vtp hold a line "
     "drawing or visible polygons; .dxf a line drawing in layers, in "
     "millimetres; .json a line drawing's intervals, edge by "
     "edge, for programs. May be given several times. Of several "
     "views, FILE has %d in "
     "the place of the number: f%03d.png",
     0},
    THREADS_ARGP_OPTION,
    SCENE_ARGP_OPTIONS,
    VIEW_ARGP_OPTIONS,
    {"tiles", TILES, "N", 0,
     "make a picture larger than memory, by tiles of N x N samples: -o "
     "FILE.exr holds the face ids, or the colours of what is filtered, "
     "transparent, shadowed or composited. Tiles that are done are kept in "
     "FILE.exr.tiles, so that the same command goes on where it was ended",
     0},
    {"sort-last", SORT_LAST, "PARTS", OPTION_ARG_OPTIONAL,
     "draw a scene larger than memory in so many parts, one after the other, "
     "and put their pictures together, or add up the splats of a grid's "
     "parts (standard: as many as mpirun starts "
     "processes, each of which draws its own)",
     0},
    {"views", VIEWS, "A-B", 0, "make a picture of each of these views", 10},
    {"orbit", ORBIT, "N", 0,
     "make N pictures of a full turn around the point looked at, from the view "
     "on",
     10},
    {"frames", FRAMES, "A-B", 0,
     "make a picture of each of these scenes: SCENE has %d in the place of the "
     "number, as in traffic:20:%d; with --views A, view A + K of the K-th",
     10},
    {NULL, 0, NULL, 0, "Where the algorithm draws faces or splats:", 2},
    {"work", WORK, "FILE", 0,
     "write the work picture: how often each sample was touched (runs the "
     "counting build); filtered, only where the algorithm filters itself",
     2},
    {"shade", SHADE, "lambert|gouraud|flat|ids", 0,
     "lambert (standard), gouraud (colours at corners, interpolated), flat, "
     "or ids",
     2},
    {"supersample", 'S', "N", 0,
     "N x N samples a pixel, averaged (colours only)", 2},
    {"background", BACKGROUND, "white|none|R,G,B", 0,
     "white, R,G,B (each 0 to 255), or none: transparent, in .png and .exr "
     "files (standard: a dark blue grey; behind splats, black)",
     2},
    {NULL, 0, NULL, 0, "Where it draws in passes:", 4},
    {"passes", PASSES, "FILE", 0,
     "write the picture after each pass; FILE has %d in the place of the "
     "number",
     4},
    {"uncertainty", UNCERTAINTY, "FILE", 0,
     "write after each pass how uncertain each pixel is; brightest: as "
     "uncertain "
     "as it may be, or more",
     4},
    {"certain", CERTAIN, "FILE", 0,
     "write after each pass the picture, with a pixel that is more uncertain "
     "than it may be in green",
     4},
    {NULL, 0, NULL, 0, "Where it draws lines:", 3},
    LINE_ARGP_OPTIONS(3),
    {NULL, 0, NULL, 0, "On paper:", 5},
    {"sheet", SHEET, "front|back|left|right|top|bottom|iso|dimetric,...", 0,
     "several standard views on one sheet, aligned, to one scale: "
     "--sheet=front,top,left,iso",
     5},
    {"angle", ANGLE, "third|first", 0,
     "third (standard: the top view stands above the front) or first (below "
     "it)",
     5},
    {"fill", FILL, "ALGORITHM", OPTION_ARG_OPTIONAL,
     "faces under the lines, as that algorithm draws visible polygons "
     "(standard: weiler-atherton)",
     5},
    {"hatch", HATCH, "PEN", OPTION_ARG_OPTIONAL,
     "hatch faces by their light instead of filling them, with a pen as "
     ".3mm,#808080 (standard: that of the style)",
     5},
    PAGE_ARGP_OPTIONS(5),
    {0}};

static const struct argp argp = {
    entries,
    parse,
    "SCENE",
    "Makes a picture, or a line drawing, of SCENE with one algorithm and says "
    "how long each phase "
    "took.\v"
    "SCENE is a built-in name with parameters (house, soup:1000:7), mesh:NAME, "
    "a mesh or volume file, or a .scene.json; see hsr scenes.\n\n"
    "  hsr render house -a watkins -o house.png\n"
    "  hsr render mesh:elephant -a zbuffer-fast -s 1024x1024 -o elephant.exr\n"
    "  hsr render harbor -a watkins --work work.png\n"
    "  hsr render house -a zbuffer-fast:filter=cosine:jitter=4 -o house.png\n"
    "  hsr render house -a line-oracle --hidden dashed -o house.svg\n"
    "  hsr render mesh:elephant --orbit 72 -o turn%02d.png\n"
    "  hsr render traffic:20:%d --frames 0-99 -a hzbuffer-moving -o t%02d.png",
    NULL,
    NULL,
    NULL};

enum hsr_status render_parse(int argc, char **argv, struct render_options *o,
                             struct hsr_variant *variant,
                             struct hsr_error *err) {
  *o = (struct render_options){.view = VIEW_OPTIONS_STANDARD,
                               .algorithm = "zbuffer-fast",
                               .last_frame = -1,
                               .threads = 1,
                               .supersamples = 1};
  enum hsr_status status = parse_options(&argp, argc, argv, o, err);
  if (status)
    return status;
  o->given[HSR_PALETTE] = o->view.camera.palette ? "--palette" : NULL;
  o->given[HSR_LIGHTING] = light_option(&o->view.camera);
  status = program_variant_parse(o->algorithm, variant, err);
  if (!status)
    status = line_options_style(&o->lines, &o->style, err);
  if (!status)
    status = aim_scene(&o->scene, &o->view, err);
  return status ? status : check_options(o, variant, err);
}
