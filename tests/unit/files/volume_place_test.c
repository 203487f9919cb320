/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Volumes lie in the world where their headers say, whatever way their axes
 * run; densities are the data's own. */
#include "common/grids/densities.h"
#include "scenes/scenes.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { X = 5, Y = 4, Z = 3, SAMPLES = X * Y * Z };
static const int N[3] = {X, Y, Z};
static const double SPACING[3] = {1, 2, 0.5}, ORIGIN[3] = {10, -20, 5};

/* From 0 to 59, each once: so each has a level of its own. */
static int number(const int at[3]) {
  return (at[0] + X * (at[1] + Y * at[2])) * 37 % SAMPLES;
}

/* Where a file's samples are: axis f runs along axis[f] of the world, that way
 * or against it. */
struct way {
  int axis[3], sign[3];
};

/* The one of 48. */
static struct way way_of(int k) {
  static const int order[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2},
                                  {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  struct way w;
  memcpy(w.axis, order[k / 8], sizeof w.axis);
  for (int f = 0; f < 3; f++)
    w.sign[f] = k >> f & 1 ? -1 : 1;
  return w;
}

/* Of the direction of axis f, along a. */
static int entry(const struct way *w, int f, int a) {
  return w->axis[f] == a ? w->sign[f] : 0;
}

static int determinant(const struct way *w) {
  int sum = 0;
  for (int a = 0; a < 3; a++) {
    int b = (a + 1) % 3, c = (a + 2) % 3;
    sum += entry(w, 0, a) *
           (entry(w, 1, b) * entry(w, 2, c) - entry(w, 1, c) * entry(w, 2, b));
  }
  return sum;
}

/* --- Writing -------------------------------------------------------------- */

static FILE *create(const char *path) {
  FILE *out = fopen(path, "wb");
  if (!out)
    abort();
  return out;
}

static void put_samples(FILE *out) {
  for (int k = 0; k < SAMPLES; k++)
    fputc(k * 37 % SAMPLES, out);
}

static void set_short(unsigned char *h, int at, int value) {
  h[at] = (unsigned char)value;
  h[at + 1] = (unsigned char)(value >> 8);
}

/* This machine has the low byte first. */
static void set_real(unsigned char *h, int at, double value) {
  float real = (float)value;
  memcpy(h + at, &real, sizeof real);
}

/* A quaternion of a turn, by its greatest component. */
static void set_turn(unsigned char *h, const double r[3][3]) {
  double q[4] = {
      1 + r[0][0] + r[1][1] + r[2][2], 1 + r[0][0] - r[1][1] - r[2][2],
      1 - r[0][0] + r[1][1] - r[2][2], 1 - r[0][0] - r[1][1] + r[2][2]};
  int most = 0;
  for (int k = 1; k < 4; k++)
    most = q[k] > q[most] ? k : most;
  const double sums[4][4] = {
      {q[0], r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]},
      {r[2][1] - r[1][2], q[1], r[1][0] + r[0][1], r[0][2] + r[2][0]},
      {r[0][2] - r[2][0], r[1][0] + r[0][1], q[2], r[2][1] + r[1][2]},
      {r[1][0] - r[0][1], r[0][2] + r[2][0], r[2][1] + r[1][2], q[3]}};
  double length = 2 * sqrt(q[most]);
  double sign = sums[most][0] < 0 ? -1 : 1;
  for (int k = 0; k < 3; k++)
    set_real(h, 256 + 4 * k, sign * sums[most][k + 1] / length);
}

static void begin_nifti(unsigned char h[352]) {
  memset(h, 0, 352);
  set_short(h, 0, 348);
  set_short(h, 40, 3);
  for (int a = 0; a < 3; a++) {
    set_short(h, 42 + 2 * a, N[a]);
    set_real(h, 80 + 4 * a, SPACING[a]);
  }
  set_short(h, 70, 2);
  set_short(h, 72, 8);
  set_real(h, 108, 352);
  memcpy(h + 344, "n+1", 4);
}

static void write_nifti(const char *path, const unsigned char h[352]) {
  FILE *out = create(path);
  fwrite(h, 1, 352, out);
  put_samples(out);
  fclose(out);
}

static void write_sform(const struct way *w, const char *path) {
  unsigned char h[352];
  begin_nifti(h);
  set_short(h, 254, 1);
  for (int a = 0; a < 3; a++) {
    for (int f = 0; f < 3; f++)
      set_real(h, 280 + 16 * a + 4 * f, SPACING[f] * entry(w, f, a));
    set_real(h, 280 + 16 * a + 12, ORIGIN[a]);
  }
  write_nifti(path, h);
}

static void write_qform(const struct way *w, const char *path) {
  unsigned char h[352];
  double turn[3][3];
  int hand = determinant(w);
  begin_nifti(h);
  set_short(h, 252, 1);
  set_real(h, 76, hand);
  for (int a = 0; a < 3; a++) {
    for (int f = 0; f < 3; f++)
      turn[a][f] = entry(w, f, a) * (f == 2 ? hand : 1);
    set_real(h, 268 + 4 * a, ORIGIN[a]);
  }
  set_turn(h, turn);
  write_nifti(path, h);
}

static void write_meta(const struct way *w, const char *path) {
  FILE *out = create(path);
  fprintf(out, "ObjectType = Image\nNDims = 3\nDimSize = 5 4 3\n"
               "ElementSpacing = 1 2 0.5\nOffset = 10 -20 5\n"
               "ElementType = MET_UCHAR\nTransformMatrix =");
  for (int f = 0; f < 3; f++)
    for (int a = 0; a < 3; a++)
      fprintf(out, " %d", entry(w, f, a));
  fprintf(out, "\nElementDataFile = LOCAL\n");
  put_samples(out);
  fclose(out);
}

static void write_nrrd(const struct way *w, const char *path) {
  FILE *out = create(path);
  fprintf(out, "NRRD0004\n# a comment\ntype: uchar\ndimension: 3\n"
               "space: left-posterior-superior\nsizes: 5 4 3\n"
               "space directions:");
  for (int f = 0; f < 3; f++)
    fprintf(out, " (%g,%g,%g)", SPACING[f] * entry(w, f, 0),
            SPACING[f] * entry(w, f, 1), SPACING[f] * entry(w, f, 2));
  fprintf(out, "\nkinds: domain domain domain\nencoding: raw\n"
               "space origin: (10,-20,5)\na key:=a value\n\n");
  put_samples(out);
  fclose(out);
}

static void write_vti(const struct way *w, const char *path) {
  FILE *out = create(path);
  fprintf(out, "<VTKFile type=\"ImageData\">\n<ImageData WholeExtent=\"0 4 0 3 "
               "0 2\" Origin=\"10 -20 5\" Spacing=\"1 2 0.5\" Direction=\"");
  for (int a = 0; a < 3; a++)
    for (int f = 0; f < 3; f++)
      fprintf(out, " %d", entry(w, f, a));
  fprintf(out, "\">\n<Piece Extent=\"0 4 0 3 0 2\">\n<PointData>"
               "<DataArray type=\"UInt8\" Name=\"d\">\n");
  for (int k = 0; k < SAMPLES; k++)
    fprintf(out, "%d\n", k * 37 % SAMPLES);
  fprintf(out, "</DataArray></PointData>\n</Piece>\n</ImageData>\n"
               "</VTKFile>\n");
  fclose(out);
}

/* --- Reading -------------------------------------------------------------- */

/* Index of a position along an axis of the world; -1: no sample is there. */
static int find(const struct hsr_grid *g, int a, double at) {
  for (uint32_t k = 0; k < g->n[a]; k++)
    if (g->at[a][k] == at)
      return (int)k;
  return -1;
}

/* Whether each sample is where the way has it. */
static bool is_so(const char *path, const struct way *w) {
  char name[80];
  struct hsr_scene *scene;
  struct hsr_error err = {.text = ""};
  struct hsr_import import = {.notes = ""};
  snprintf(name, sizeof name, "%s:least=0", path);
  if (hsr_scene_open(name, &import, &scene, &err)) {
    printf("# %s\n", err.text);
    return false;
  }
  const struct hsr_grid *g = scene->grid;
  bool good = g->n_cells == SAMPLES && !*import.notes;
  int at[3];
  for (at[2] = 0; at[2] < Z && good; at[2]++)
    for (at[1] = 0; at[1] < Y && good; at[1]++)
      for (at[0] = 0; at[0] < X && good; at[0]++) {
        uint32_t place[3] = {0, 0, 0};
        for (int f = 0; f < 3; f++) {
          int a = w->axis[f],
              k = find(g, a, ORIGIN[a] + w->sign[f] * SPACING[f] * at[f]);
          good = good && k >= 0;
          place[a] = (uint32_t)k;
        }
        uint32_t cell = good ? hsr_grid_cell(g, place) : UINT32_MAX;
        good = good && cell != UINT32_MAX &&
               g->level[cell] == lrint(255.0 * number(at) / (SAMPLES - 1));
      }
  if (!good)
    printf("# %s: %u cells, notes: %s\n", path, g->n_cells, import.notes);
  hsr_scene_delete(scene);
  return good;
}

static void test_ways(struct tap *tap, bool has_vtk) {
  static const struct {
    bool by_vtk;
    const char *path, *what;
    void (*write)(const struct way *w, const char *path);
  } formats[] = {{true, "s.nii", "NIfTI's sform", write_sform},
                 {true, "q.nii", "NIfTI's qform", write_qform},
                 {false, "m.mha", "MetaImage's TransformMatrix", write_meta},
                 {false, "n.nrrd", "NRRD's space directions", write_nrrd},
                 {true, "v.vti", "VTK's Direction", write_vti}};
  for (size_t k = 0; k < sizeof formats / sizeof *formats; k++) {
    int good = 0;
    if (formats[k].by_vtk && !has_vtk)
      continue;
    for (int way = 0; way < 48; way++) {
      struct way w = way_of(way);
      formats[k].write(&w, formats[k].path);
      good += is_so(formats[k].path, &w);
    }
    ok(tap, good == 48, "%s: all 48 ways that axes can run (%d)",
       formats[k].what, good);
  }
}

/* A frame that is turned about z: the turn is said, the centre stays. */
static void test_oblique(struct tap *tap) {
  unsigned char h[352];
  double c = cos(0.2), s = sin(0.2);
  const double turn[3][3] = {{c, -s, 0}, {s, c, 0}, {0, 0, 1}};
  struct hsr_scene *scene = NULL;
  struct hsr_import import = {.notes = ""};
  begin_nifti(h);
  set_short(h, 252, 1);
  set_turn(h, turn);
  write_nifti("o.nii", h);
  bool opened = !hsr_scene_open("o.nii:least=0", &import, &scene, NULL);
  const struct hsr_grid *g = opened ? scene->grid : NULL;
  double x = c * 2 - s * 3, y = s * 2 + c * 3; /* of the middle: 2, 3, 0.5 */
  ok(tap,
     opened && fabs((g->at[0][0] + g->at[0][X - 1]) / 2 - x) < 1e-6 &&
         fabs((g->at[1][0] + g->at[1][Y - 1]) / 2 - y) < 1e-6 &&
         fabs(g->at[1][1] - g->at[1][0] - 2) < 1e-9 &&
         strstr(import.notes, "a turn of 11.5 degrees is left out"),
     "an oblique frame: %s", import.notes);
  hsr_scene_delete(scene);
}

/* A patient's head is up, and the right side is at the viewer's left. */
static void test_upright(struct tap *tap) {
  const struct way w = way_of(0);
  static const char *const files[] = {"s.nii", "m.mha"};
  write_sform(&w, files[0]);
  write_meta(&w, files[1]);
  for (int k = 0; k < 2; k++) {
    struct hsr_scene *scene = NULL;
    bool opened = !hsr_scene_open(files[k], NULL, &scene, NULL);
    double to_front = 0;
    for (uint32_t v = 0; opened && v < scene->n_views; v += 4)
      to_front += scene->views[v].eye[1] - scene->views[v].at[1];
    ok(tap,
       opened && scene->views[0].up[2] == 1 && scene->views[0].up[1] == 0 &&
           scene->views[0].eye[2] > scene->views[0].at[2] &&
           (k ? to_front < 0 : to_front > 0),
       "%s: z is up, and views begin before the face", files[k]);
    hsr_scene_delete(scene);
  }
}

/* --- Densities ------------------------------------------------------------ */

static const struct hsr_densities *measure(const char *name,
                                           struct hsr_scene **scene) {
  struct hsr_error err = {.text = ""};
  if (!hsr_scene_open(name, NULL, scene, &err))
    return (*scene)->grid->densities;
  printf("# %s\n", err.text);
  *scene = NULL;
  return NULL;
}

static void test_scales(struct tap *tap) {
  static const struct {
    double slope, intercept, least, most;
  } cases[] = {{2, -1024, -1024, -906},
               {0, 7, 0, 59},
               {-0.5, 10, -19.5, 10},
               {NAN, 1, 0, 59}};
  for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
    unsigned char h[352];
    struct hsr_scene *scene;
    begin_nifti(h);
    set_real(h, 112, cases[k].slope);
    set_real(h, 116, cases[k].intercept);
    write_nifti("scaled.nii", h);
    const struct hsr_densities *d = measure("scaled.nii", &scene);
    ok(tap, d && d->least == cases[k].least && d->most == cases[k].most,
       "scl_slope %g and scl_inter %g: from %g to %g", cases[k].slope,
       cases[k].intercept, d ? d->least : NAN, d ? d->most : NAN);
    hsr_scene_delete(scene);
  }
}

enum { SIDE = 40 };

/* A ball of 100 +- 10 in air of -1000 +- 20, and one sample of 1e6. */
static void write_ball(const char *path) {
  FILE *out = create(path);
  unsigned random = 1;
  for (int k = 0; k < SIDE * SIDE * SIDE; k++) {
    int x = k % SIDE - 20, y = k / SIDE % SIDE - 20, z = k / SIDE / SIDE - 20;
    random = random * 1103515245u + 12345u;
    float noise = (float)(random >> 16 & 255) / 128 - 1;
    float density =
        x * x + y * y + z * z < 15 * 15 ? 100 + 10 * noise : -1000 + 20 * noise;
    density = k == 7 ? 1e6f : density;
    fwrite(&density, sizeof density, 1, out);
  }
  fclose(out);
}

static void test_threshold(struct tap *tap) {
  struct hsr_scene *scene;
  write_ball("ball.raw");
  const struct hsr_densities *d =
      measure("ball.raw:type=f32-le:size=40x40x40", &scene);
  uint32_t cells = d ? scene->grid->n_cells : 0;
  ok(tap, d && d->most == 1e6 && d->high < 1300 && cells == 13998,
     "an outlier spoils neither the window nor the threshold: %u cells from %g "
     "on, window %g to %g",
     cells, d ? d->threshold : 0, d ? d->low : 0, d ? d->high : 0);
  ok(tap, d && d->quantile[4] < -980 && d->quantile[6] > 90,
     "the median is air, and the 95th percentile is not");
  hsr_scene_delete(scene);
}

enum { MIXED = 4000 };

/* Two hills that overlap, of 3 : 1. */
static enum hsr_status mixed_slice(void *data, uint32_t k, float *density,
                                   struct hsr_error *err) {
  (void)data, (void)k, (void)err;
  unsigned random = 7;
  for (int c = 0; c < MIXED; c++) {
    float sum = 0;
    for (int n = 0; n < 4; n++) {
      random = random * 1103515245u + 12345u;
      sum += (float)(random >> 16 & 1023) / 1024;
    }
    density[c] = c % 4 ? 100 * sum : 180 + 60 * sum;
  }
  return HSR_OK;
}

/* The sum of the squares of bins from .. to - 1 about their mean. */
static double spread(const struct hsr_densities *d, int from, int to) {
  double n = 0, sum = 0, squares = 0;
  for (int k = from; k < to; k++) {
    n += (double)d->bin[k];
    sum += k * (double)d->bin[k];
  }
  for (int k = from; k < to && n > 0; k++)
    squares += (double)d->bin[k] * (k - sum / n) * (k - sum / n);
  return squares;
}

/* Otsu's threshold is also the one within whose classes the spread is least. */
static void test_otsu(struct tap *tap) {
  struct hsr_densities d;
  int best = 1;
  double least = INFINITY;
  bool measured = !hsr_densities_measure(&d, 1, MIXED, mixed_slice, NULL, NULL);
  for (int k = 1; k < HSR_DENSITY_BINS; k++) {
    double both = spread(&d, 0, k) + spread(&d, k, HSR_DENSITY_BINS);
    if (both < least) {
      least = both;
      best = k;
    }
  }
  double step = (d.high - d.low) / HSR_DENSITY_BINS;
  ok(tap,
     measured && fabs(d.threshold - (d.low + best * step)) < 1e-9 &&
         best > 100 && best < 200,
     "Otsu's threshold of two hills: %g, after bin %d", d.threshold, best);
}

int main(void) {
  char folder[] = "/tmp/hsr-places-XXXXXX";
  if (!mkdtemp(folder) || chdir(folder))
    abort();
  bool has_vtk = hsr_exchange_has_vtk();
  struct tap tap = plan(has_vtk ? 15 : 5);
  test_ways(&tap, has_vtk);
  if (has_vtk) {
    test_oblique(&tap);
    test_upright(&tap);
    test_scales(&tap);
  }
  test_threshold(&tap);
  test_otsu(&tap);
  char clean[80];
  snprintf(clean, sizeof clean, "rm -rf %s", folder);
  return finish(&tap) | (system(clean) != 0);
}
