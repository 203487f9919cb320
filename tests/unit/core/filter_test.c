/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The parts of the filtered picture (docs/filtered-picture.md): weights,
 * jitter, views of sub-samples, colours and sums. */
#include "bench/modules/modules.h"
#include "common/answers/filter.h"
#include "common/view/picture.h"
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BITS = 64, COLUMNS = 11, ROWS = 7, PIXELS = COLUMNS * ROWS };

/* --- Weights -------------------------------------------------------------- */

/* The kernel as one square of 24 x 24 sub-samples around the receiving pixel:
 * sub-samples of the pixel to its left add to the pixel at their own right. */
static uint32_t at(const struct hsr_kernel *kernel, int x, int y) {
  return kernel->weight[2 - y / 8][2 - x / 8][8 * (y % 8) + x % 8];
}

static double hump(int x, int y) {
  double r = hypot(x - 11.5, y - 11.5) / 8;
  return r < 1 ? (1 + cos(3.14159265358979323846 * r)) / 2 : 0;
}

static void test_weights(struct tap *tap, enum hsr_filter filter,
                         const char *name) {
  struct hsr_kernel kernel;
  hsr_kernel_init(&kernel, filter);
  uint64_t sum = 0;
  bool symmetric = true, as_defined = true, rows = true, outside = false;
  double whole = 0, nearest_half = 1;
  for (int k = 0; k < 24 * 24; k++)
    whole += hump(k % 24, k / 24);
  for (int k = 0; k < 24 * 24; k++) {
    int x = k % 24, y = k / 24;
    uint32_t weight = at(&kernel, x, y);
    sum += weight;
    symmetric &= weight == at(&kernel, 23 - x, y) &&
                 weight == at(&kernel, x, 23 - y) &&
                 weight == at(&kernel, y, x);
    bool inside = x / 8 == 1 && y / 8 == 1;
    bool middle = (x == 11 || x == 12) && (y == 11 || y == 12);
    double exact = 65536 * hump(x, y) / whole, rest = exact - floor(exact);
    nearest_half = fmin(nearest_half, fabs(rest - 0.5));
    outside |= !inside && weight;
    as_defined &= filter == HSR_FILTER_BOX
                      ? weight == (inside ? 1024u : 0u)
                      : weight == (uint32_t)lround(exact) + 3u * middle;
  }
  for (int k = 0; k < 9 * 8 * 256; k++) {
    int place = k / 8 / 256, b = k / 256 % 8, byte = k % 256;
    uint32_t few = 0;
    for (int a = 0; a < 8; a++)
      few += (uint32_t)(byte >> a & 1) *
             kernel.weight[place / 3][place % 3][8 * b + a];
    rows &= few == kernel.row[place / 3][place % 3][b][byte];
  }
  ok(tap, sum == HSR_WHOLE_WEIGHT, "%s: all weights are %u", name,
     HSR_WHOLE_WEIGHT);
  ok(tap, symmetric && as_defined && nearest_half > 0.03,
     "%s: they are as defined, symmetric, and none is near a half", name);
  ok(tap, rows && outside == (kernel.reach == 1),
     "%s: bytes of a mask weigh what their bits do", name);
}

/* One field: weights of rows, in lines of half a pixel. */
static void test_field(struct tap *tap) {
  static const uint32_t line[6] = {0, 1, 4, 6, 4, 1};
  struct hsr_kernel kernel;
  bool good = true;
  uint64_t sum = 0;
  hsr_kernel_init(&kernel, HSR_FILTER_FIELD);
  for (int k = 0; k < 24 * 24; k++) {
    int x = k % 24, y = k / 24; /* the middle line has rows 10 to 13 */
    uint32_t weight = at(&kernel, x, y);
    int number = (y + 2) / 4;
    sum += weight;
    good &= weight == (x / 8 == 1 && number < 6 ? 128 * line[number] : 0u);
  }
  ok(tap, good && sum == HSR_WHOLE_WEIGHT && kernel.reach == 1,
     "field: five lines of half a pixel weigh 1 4 6 4 1, in their own column");
}

static void test_box4x4(struct tap *tap) {
  struct hsr_kernel kernel;
  bool good = true;
  hsr_kernel_init(&kernel, HSR_FILTER_BOX_4X4);
  for (int k = 0; k < 24 * 24; k++) {
    int x = k % 24 - 8, y = k / 24 - 8;
    bool inside = x >= 0 && y >= 0 && x < 4 && y < 4;
    good &= at(&kernel, k % 24, k / 24) == (inside ? 4096u : 0u);
  }
  ok(tap,
     good && kernel.columns == 4 && kernel.rows == 4 &&
         kernel.all == UINT64_C(0x0f0f0f0f) && kernel.reach == 0,
     "box4x4: 16 sub-samples of a pixel have one weight");
  struct hsr_view view = {.m = 3, .n = 2},
                  fine = hsr_subsample_view(&view, HSR_FILTER_BOX_4X4, -1, 19);
  ok(tap, fine.offset_x == 3.5 / 4 - .5 && fine.offset_y == 2.5 / 4 - .5,
     "box4x4: a sub-sample is a 16th of a pixel");
}

/* A pixel is 8 x 8 cells, which are the pixels of the box in a picture of 8 m x
 * 8 n. */
static void test_box64x64(struct tap *tap) {
  struct hsr_kernel kernel;
  bool good = true;
  hsr_kernel_init(&kernel, HSR_FILTER_BOX_64X64);
  for (int k = 0; k < 24 * 24; k++) {
    int x = k % 24 - 8, y = k / 24 - 8;
    bool inside = x >= 0 && y >= 0 && x < 8 && y < 8;
    good &= at(&kernel, k % 24, k / 24) == (inside ? 16u : 0u);
  }
  ok(tap,
     good && kernel.cells == 8 && kernel.columns == 8 && kernel.rows == 8 &&
         kernel.all == UINT64_MAX && kernel.reach == 0,
     "box64x64: the sub-samples of 8 x 8 cells have one weight");
}

/* --- Jitter --------------------------------------------------------------- */

static bool is_place(double v) {
  double sixteenth = (v * 32 + 15) / 2;
  return sixteenth == floor(sixteenth) && sixteenth >= 0 && sixteenth < 16;
}

static void test_jitter(struct tap *tap) {
  bool good = true;
  int used[2][16] = {{0}};
  struct hsr_jitter jitter[HSR_MOST_PATTERNS];
  for (int p = 0; p < HSR_MOST_PATTERNS; p++) {
    hsr_jitter_init(&jitter[p], p);
    for (int bit = 0; bit < BITS; bit++) {
      good &= is_place(jitter[p].x[bit]) && is_place(jitter[p].y[bit]);
      used[0][(int)(jitter[p].x[bit] * 16 + 7.5) & 15]++;
      used[1][(int)(jitter[p].y[bit] * 16 + 7.5) & 15]++;
    }
    for (int q = 0; q < p; q++)
      good &= memcmp(&jitter[p], &jitter[q], sizeof jitter[p]) != 0;
  }
  for (int k = 0; k < 32; k++) /* about 64 each */
    good &= used[k / 16][k % 16] > 32 && used[k / 16][k % 16] < 96;
  ok(tap, good, "jitter: odd 32nds within the sub-sample, in 16 patterns");
  ok(tap, jitter[0].x[0] == -1 / 32.0 && jitter[0].y[0] == 13 / 32.0,
     "jitter: the first place is the one of the definition");
}

static void test_patterns(struct tap *tap) {
  enum { SIDE = 400 };
  bool good = true;
  for (int n = 0; n <= HSR_MOST_PATTERNS; n++) {
    struct hsr_filtering filtering = {HSR_FILTER_BOX, n};
    long used[HSR_MOST_PATTERNS] = {0}, same = 0, all = (long)SIDE * SIDE;
    for (int k = 0; k < SIDE * SIDE; k++) {
      int i = k % SIDE, j = k / SIDE;
      int p = hsr_jitter_pattern(&filtering, i, j);
      good &= n ? p >= 0 && p < n : p == -1;
      if (n && p >= 0)
        used[p]++;
      same += p == hsr_jitter_pattern(&filtering, i + 1, j);
      same += p == hsr_jitter_pattern(&filtering, i, j + 1);
    }
    for (int p = 0; p < n; p++) /* within a tenth of the expected number */
      good &= labs(used[p] * n - all) < all / 10;
    good &= n < 2 || labs(same * n - 2 * all) < all / 5;
  }
  ok(tap, good, "jitter: patterns are used alike, by neighbours as by chance");
}

/* --- Views ---------------------------------------------------------------- */

struct stage {
  struct hsr_scene *scene;
  struct hsr_world world, outline;
  struct hsr_view pixels, fine; /* m x n, 8 m x 8 n */
};

static void open_stage(struct stage *stage, const char *name) {
  stage->scene = must_open(name);
  must_world(&stage->world, stage->scene);
  must_roster(&stage->outline, stage->scene);
  must_view(&stage->pixels, &stage->scene->views[0], COLUMNS, ROWS);
  must_view(&stage->fine, &stage->scene->views[0], 8 * COLUMNS, 8 * ROWS);
}

static void close_stage(struct stage *stage) {
  hsr_world_free(&stage->world);
  hsr_world_free(&stage->outline);
  hsr_scene_delete(stage->scene);
}

/* Is x = (2 s - m)/m the same number in both? The products are exact. */
static bool same_place(double s, int m, double fine) {
  return 8 * (2 * s - m) == 2 * fine - 8 * m;
}

static void test_rays(struct tap *tap, const struct stage *stage) {
  const struct hsr_view *fine = &stage->fine;
  bool good = true;
  for (int bit = 0; bit < BITS; bit++) {
    struct hsr_view view =
        hsr_subsample_view(&stage->pixels, HSR_FILTER_BOX, -1, bit);
    good &= !memcmp(view.E, fine->E, sizeof view.E) &&
            !memcmp(view.F, fine->F, sizeof view.F) &&
            !memcmp(view.R, fine->R, sizeof view.R) &&
            !memcmp(view.U, fine->U, sizeof view.U);
    for (int i = 0; i < COLUMNS; i++)
      good &= same_place(hsr_sample_x(&view, i), COLUMNS,
                         hsr_sample_x(fine, 8 * i + bit % 8));
    for (int j = 0; j < ROWS; j++)
      good &= same_place(hsr_sample_y(&view, j), ROWS,
                         hsr_sample_y(fine, 8 * j + bit / 8));
  }
  ok(tap, good, "a sub-sample has the ray of a sample of the finer picture");
}

static void test_offsets(struct tap *tap, const struct stage *stage) {
  bool good = true;
  for (int k = 0; k < HSR_MOST_PATTERNS * BITS; k++) {
    int p = k / BITS, bit = k % BITS;
    struct hsr_jitter jitter;
    hsr_jitter_init(&jitter, p);
    struct hsr_view view =
        hsr_subsample_view(&stage->pixels, HSR_FILTER_BOX, p, bit);
    /* 256 times the offset: an exact integer, in the sub-sample's square. */
    double x = 256 * view.offset_x + 128, y = 256 * view.offset_y + 128;
    good &= x == 32 * (bit % 8) + 16 + 32 * jitter.x[bit] &&
            y == 32 * (bit / 8) + 16 + 32 * jitter.y[bit] && x > 0 && x < 256 &&
            y > 0 && y < 256;
  }
  ok(tap, good, "a jittered sub-sample is exactly where the pattern says");
}

/* --- Colours -------------------------------------------------------------- */

/* The colour of every face is the same from a world laid out, an outline, an
 * extract and, if given, a world of pieces. It is near the colour of the
 * unfiltered picture. */
static void test_colours(struct tap *tap, const struct stage *stage,
                         const struct hsr_world *pieces) {
  const struct hsr_world *world = &stage->world;
  struct hsr_world extract;
  struct hsr_error err = {.text = "out of memory"};
  const uint32_t id[] = {world->n_faces - 1};
  if (hsr_world_extract(&extract, &stage->outline, id, 1, &err))
    bail("extract: %s", err.text);
  const struct hsr_world *others[] = {&stage->outline, &extract, pieces};
  bool same = true, near = true, none = true;
  long different = 0;
  for (uint32_t f = 0; f <= world->n_faces; f++) {
    uint32_t face = f < world->n_faces ? f : HSR_BACKGROUND;
    uint16_t rgb[3], other[3];
    float wanted[3];
    hsr_filter_colour(world, &stage->pixels, world->n_faces + f, rgb);
    none &= !rgb[0] && !rgb[1] && !rgb[2];
    hsr_filter_colour(world, &stage->pixels, face, rgb);
    hsr_picture_colour(world, &stage->pixels, face, HSR_SHADE_LAMBERT, wanted);
    for (int k = 0; k < 3 && others[k]; k++) {
      hsr_filter_colour(others[k], &stage->pixels, face, other);
      same &= !memcmp(rgb, other, sizeof rgb);
    }
    for (int c = 0; c < 3; c++) {
      near &= fabs(rgb[c] - 65535.0 * (double)wanted[c]) <= 0.5;
      different += c && rgb[c] != rgb[0];
    }
  }
  ok(tap, same && near && none && different > 0,
     "%s: %u faces have one colour, however they are held%s",
     stage->scene->name, world->n_faces, pieces ? ", in pieces too" : "");
  hsr_world_free(&extract);
}

static void test_pieces(struct tap *tap) {
  struct stage stage;
  open_stage(&stage, "penetration");
  struct hsr_setup setup;
  must_setup(&setup, hsr_algorithm_find("romney")->plain, NULL, &stage.world);
  if (!setup.world->pieces || setup.world->n_faces <= stage.world.n_faces)
    bail("penetration: nothing is divided");
  test_colours(tap, &stage, setup.world);
  hsr_setup_free(&setup);
  close_stage(&stage);
}

/* --- Pictures ------------------------------------------------------------- */

/* Of the faces in some order, and background: an outline's picture is that of
 * its faces laid out, and every depth is on the plane of the sample's face. */
static void test_pictures(struct tap *tap, const struct stage *stage) {
  enum { SAMPLES = COLUMNS * ROWS };
  static uint32_t ids[SAMPLES];
  static float depth[2][SAMPLES], rgb[2][3 * SAMPLES];
  const struct hsr_world *world = &stage->world;
  const struct hsr_view *view = &stage->pixels;
  struct hsr_error err = {.text = "out of memory"};
  bool same = true, on_plane = true;
  for (uint32_t k = 0; k < SAMPLES; k++)
    ids[k] = k % 7 ? 1000003 * k % world->n_faces : HSR_BACKGROUND;
  for (int shading = 0; shading <= HSR_SHADE_GOURAUD; shading++) {
    if (hsr_picture_finish(world, view, ids, (enum hsr_shading)shading,
                           depth[0], rgb[0], &err) ||
        hsr_picture_finish(&stage->outline, view, ids,
                           (enum hsr_shading)shading, depth[1], rgb[1], &err))
      bail("picture: %s", err.text);
    same &= !memcmp(depth[0], depth[1], sizeof depth[0]) &&
            !memcmp(rgb[0], rgb[1], sizeof rgb[0]);
  }
  for (int k = 0; k < SAMPLES; k++) {
    double off = 0, size = 0;
    uint32_t f = ids[k];
    double sx = hsr_sample_x(view, k % COLUMNS);
    double sy = hsr_sample_y(view, k / COLUMNS);
    for (int a = 0; a < 3 && f != HSR_BACKGROUND; a++) {
      const double *n[] = {world->mesh.nx, world->mesh.ny, world->mesh.nz};
      const double *p[] = {world->mesh.px, world->mesh.py, world->mesh.pz};
      double along =
          (double)depth[0][k] *
          (view->ray[0][a] + sx * view->ray[1][a] + sy * view->ray[2][a]);
      off += n[a][f] * (view->E[a] + along - p[a][f]);
      size += fabs(n[a][f]) * (fabs(view->E[a]) + fabs(along) + fabs(p[a][f]));
    }
    on_plane &= f == HSR_BACKGROUND ? isinf(depth[0][k]) && depth[0][k] > 0
                                    : fabs(off) <= 1e-6 * size;
  }
  ok(tap, same, "%s: an outline's picture is that of its faces",
     stage->scene->name);
  ok(tap, on_plane, "%s: depths are those of the planes", stage->scene->name);
}

/* The sum of s F, u U and the origin. */
static void from(const struct hsr_view *view, const double origin[3], double s,
                 double u, double to[3]) {
  for (int k = 0; k < 3; k++)
    to[k] = (origin ? origin[k] : 0) + s * view->F[k] + u * view->U[k];
}

/* Light falls on the side that is seen, and a face that has its back to it is
 * not black. */
static void test_light(struct tap *tap, const struct stage *stage) {
  const struct hsr_view *view = &stage->pixels;
  double front[3], back[3], below[3], ahead[3], above[3];
  from(view, NULL, -1, 0, front);
  from(view, NULL, 1, 0, back);
  from(view, NULL, 0, -1, below);
  from(view, view->E, 5, 0, ahead);
  from(view, view->E, 5, 10, above);
  float lit = hsr_picture_light(view, front, ahead);
  ok(tap, lit > 0.5f && lit == hsr_picture_light(view, back, ahead),
     "both sides of a face are lit alike");
  ok(tap, hsr_picture_light(view, below, above) == 0.25f,
     "and a quarter of the light is everywhere");
}

/* A face's light in a view of this camera, and the sun of its shadows. */
static float light_of(const struct hsr_camera *camera, int m, int n,
                      double sun[4]) {
  struct hsr_view view;
  must_view(&view, camera, m, n);
  memcpy(sun, view.light, 4 * sizeof *sun);
  return hsr_picture_light(&view, (double[]){-1, 1, 3}, camera->at);
}

/* Neither the angle of view nor the picture's shape changes a colour. */
static void test_lamp(struct tap *tap) {
  struct hsr_camera camera = {
      .eye = {2, 3, 9}, .at = {0, 1, 0}, .up = {0, 1, 0}, .fov = 38};
  double first[4], sun[4];
  float light = light_of(&camera, 40, 30, first);
  ok(tap, light > 0.3f && light < 0.99f, "a face in a slanting light");
  ok(tap,
     light_of(&camera, 90, 20, sun) == light && !memcmp(first, sun, sizeof sun),
     "it has one colour in a wide picture");
  camera.fov = 100;
  ok(tap,
     light_of(&camera, 40, 30, sun) == light && !memcmp(first, sun, sizeof sun),
     "and in a wide angle of view");
  camera.parallel = 300;
  ok(tap,
     light_of(&camera, 40, 30, sun) == light && !memcmp(first, sun, sizeof sun),
     "and in parallel projection");
  camera.up[0] = 1;
  ok(tap, light_of(&camera, 40, 30, sun) != light,
     "the light turns with the eye");
}

/* --- Sums ----------------------------------------------------------------- */

/* A picture of one colour has that colour up to its borders. */
static void test_borders(struct tap *tap, enum hsr_filter filter,
                         const char *name) {
  static const int sizes[][2] = {{1, 1}, {1, 4}, {3, 1}, {5, 4}};
  const uint16_t colour[3] = {65535, 1, 30000};
  struct hsr_kernel kernel;
  hsr_kernel_init(&kernel, filter);
  bool good = true, full = false;
  for (int s = 0; s < 4; s++) {
    int m = sizes[s][0], n = sizes[s][1];
    uint32_t sums[3 * 20] = {0};
    float rgb[3 * 20];
    for (int k = 0; k < m * n; k++)
      hsr_filter_add(&kernel, m, n, k % m, k / m, UINT64_MAX, colour, sums);
    struct hsr_filtering filtering = {filter, 0};
    hsr_filter_finish(&filtering, m, n, sums, rgb);
    for (int k = 0; k < 3 * m * n; k++) {
      good &= rgb[k] == (float)(colour[k % 3] / 65535.0);
      full |= sums[k] == 65535 * HSR_WHOLE_WEIGHT;
    }
  }
  ok(tap, good && full,
     "%s: one colour stays that at the borders, and white does not overflow",
     name);
}

/* The definition, from the receiving pixel. */
static void define_sums(const struct stage *stage, enum hsr_filter filter,
                        const uint32_t *ids, uint32_t *sums) {
  struct hsr_kernel kernel;
  hsr_kernel_init(&kernel, filter);
  memset(sums, 0, 3 * PIXELS * sizeof *sums);
  for (int k = 0; k < 64 * PIXELS; k++) {
    int x = k % (8 * COLUMNS), y = k / (8 * COLUMNS);
    uint16_t rgb[3];
    hsr_filter_colour(&stage->world, &stage->pixels, ids[k], rgb);
    for (int p = 0; p < PIXELS; p++) {
      int u = x - 8 * (p % COLUMNS - 1), v = y - 8 * (p / COLUMNS - 1);
      bool reaches = u >= 0 && u < 24 && v >= 0 && v < 24;
      for (int c = 0; reaches && c < 3; c++)
        sums[3 * p + c] += at(&kernel, u, v) * rgb[c];
    }
  }
}

/* All ways of adding give the sums of the definition. */
static void test_sums(struct tap *tap, const struct stage *stage,
                      enum hsr_filter filter, const char *name) {
  static uint32_t ids[64 * PIXELS], few[PIXELS], defined[3 * PIXELS],
      picture[3 * PIXELS], parts[3 * PIXELS];
  const struct hsr_algorithm *a = hsr_algorithm_find("zbuffer-fast")->plain;
  struct hsr_filtering filtering = {filter, 0};
  struct hsr_kernel kernel;
  hsr_kernel_init(&kernel, filter);
  memset(picture, 0, sizeof picture);
  memset(parts, 0, sizeof parts);
  draw_ids(a, &stage->world, &stage->fine, ids, NULL);
  define_sums(stage, filter, ids, defined);
  hsr_filter_add_picture(&kernel, &stage->outline, &stage->pixels, ids,
                         picture);
  for (int bit = BITS - 1; bit >= 0; bit--) {
    struct hsr_view view =
        hsr_subsample_view(&stage->pixels, HSR_FILTER_BOX, -1, bit);
    draw_ids(a, &stage->world, &view, few, NULL);
    hsr_filter_add_subsample(&kernel, &filtering, &stage->world, &stage->pixels,
                             -1, bit, few, parts);
  }
  ok(tap, !memcmp(picture, defined, sizeof defined),
     "%s: a picture of 8 x 8 samples a pixel gives the sums", name);
  ok(tap, !memcmp(parts, defined, sizeof defined),
     "%s: and so do 64 pictures of one sub-sample each", name);
}

/* Sums of 8 m x 8 n pixels of the box, added up, and the picture that hsr makes
 * of them at once, or of a sub-sample of each cell. */
static void test_cells(struct tap *tap, const struct stage *stage,
                       int patterns) {
  static uint32_t cells[3 * 64 * COLUMNS * ROWS], at_once[3 * COLUMNS * ROWS],
      parts[3 * COLUMNS * ROWS];
  static uint32_t ids[4096 * COLUMNS * ROWS], few[64 * COLUMNS * ROWS];
  struct hsr_filtering box = {HSR_FILTER_BOX, patterns},
                       fine = {HSR_FILTER_BOX_64X64, patterns};
  struct hsr_kernel kernel[2];
  struct hsr_view view = hsr_view_finer(&stage->pixels, 8, 8);
  const struct hsr_algorithm *a = hsr_algorithm_find("zbuffer-fast")->plain;
  hsr_kernel_init(&kernel[0], box.filter);
  hsr_kernel_init(&kernel[1], fine.filter);
  memset(cells, 0, sizeof cells);
  memset(parts, 0, sizeof parts);
  memset(at_once, 0, sizeof at_once);
  for (int p = patterns ? 0 : -1; p < patterns; p++)
    for (int bit = 0; bit < BITS; bit++) {
      struct hsr_view one = hsr_subsample_view(&view, box.filter, p, bit);
      struct hsr_view other =
          hsr_subsample_view(&stage->pixels, fine.filter, p, bit);
      draw_ids(a, &stage->world, &one, few, NULL);
      hsr_filter_add_subsample(&kernel[0], &box, &stage->world, &view, p, bit,
                               few, cells);
      draw_ids(a, &stage->world, &other, few, NULL);
      hsr_filter_add_subsample(&kernel[1], &fine, &stage->world, &stage->pixels,
                               p, bit, few, parts);
    }
  if (!patterns) {
    struct hsr_view whole = hsr_view_finer(&stage->pixels, 64, 64);
    draw_ids(a, &stage->world, &whole, ids, NULL);
    hsr_filter_add_picture(&kernel[1], &stage->world, &stage->pixels, ids,
                           at_once);
  }
  bool good = true;
  for (int k = 0; k < 3 * COLUMNS * ROWS; k++) {
    uint64_t sum = 0;
    for (int cell = 0; cell < 64; cell++) {
      int i = k / 3 % COLUMNS * 8 + cell % 8,
          j = k / 3 / COLUMNS * 8 + cell / 8;
      sum += cells[3 * (j * 8 * COLUMNS + i) + k % 3];
    }
    good &=
        sum == 64 * (uint64_t)parts[k] && (patterns || parts[k] == at_once[k]);
  }
  ok(tap, good, "box64x64: a pixel is the mean of 8 x 8 pixels of the box, %s",
     patterns ? "jittered"
              : "and so is the picture of 64 x 64 samples a pixel");
}

int main(void) {
  struct tap tap = plan(39);
  test_weights(&tap, HSR_FILTER_BOX, "box");
  test_weights(&tap, HSR_FILTER_COSINE, "cosine");
  test_field(&tap);
  test_box4x4(&tap);
  test_box64x64(&tap);
  test_jitter(&tap);
  test_patterns(&tap);
  struct stage stage;
  open_stage(&stage, "house");
  test_rays(&tap, &stage);
  test_offsets(&tap, &stage);
  test_colours(&tap, &stage, NULL);
  test_borders(&tap, HSR_FILTER_BOX, "box");
  test_borders(&tap, HSR_FILTER_COSINE, "cosine");
  test_borders(&tap, HSR_FILTER_FIELD, "field");
  test_sums(&tap, &stage, HSR_FILTER_BOX, "box");
  test_sums(&tap, &stage, HSR_FILTER_COSINE, "cosine");
  test_sums(&tap, &stage, HSR_FILTER_FIELD, "field");
  test_cells(&tap, &stage, 0);
  test_cells(&tap, &stage, 2);
  test_pictures(&tap, &stage);
  test_light(&tap, &stage);
  test_lamp(&tap);
  close_stage(&stage);
  open_stage(&stage, "office:2");
  test_colours(&tap, &stage, NULL);
  close_stage(&stage);
  open_stage(&stage, "non-planar");
  test_colours(&tap, &stage, NULL);
  close_stage(&stage);
  test_pieces(&tap);
  return finish(&tap);
}
