/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One volume in every format gives one grid; words choose what is kept. */
#include "common/files/volume/volume.h"
#include "common/files/image.h"
#include "common/files/mesh/exchange.h"
#include "scenes/scenes.h"
#include "tests/tap.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <zlib.h>

enum { X = 5, Y = 4, Z = 3, SAMPLES = X * Y * Z };

/* From 0 to 59, each once. */
static unsigned density(int k) {
  return (unsigned)(k * 37 % SAMPLES);
}

static FILE *create(const char *path) {
  FILE *out = fopen(path, "wb");
  if (!out)
    abort();
  return out;
}

/* Samples as bytes, or as two of them, the lower first or last. */
static void put_samples(FILE *out, int bytes, bool high_first) {
  for (int k = 0; k < SAMPLES; k++) {
    int low = (int)density(k);
    if (bytes == 2 && high_first)
      fputc(0, out);
    fputc(low, out);
    if (bytes == 2 && !high_first)
      fputc(0, out);
  }
}

static void write_raw(const char *path, int before, int bytes,
                      bool high_first) {
  FILE *out = create(path);
  for (int k = 0; k < before; k++)
    fputc('?', out);
  put_samples(out, bytes, high_first);
  fclose(out);
}

static void write_vtk(const char *path, bool ascii, bool rectilinear) {
  FILE *out = create(path);
  fprintf(out, "# vtk DataFile Version 3.0\na title\n%s\nDATASET %s\n",
          ascii ? "ASCII" : "BINARY",
          rectilinear ? "RECTILINEAR_GRID" : "STRUCTURED_POINTS");
  fprintf(out, "DIMENSIONS %d %d %d\n", X, Y, Z);
  if (rectilinear)
    fprintf(out,
            "X_COORDINATES %d float\n0 1 2 3 4\nY_COORDINATES %d "
            "float\n0 2 4 6\nZ_COORDINATES %d double\n0 1 10\n",
            X, Y, Z);
  else
    fprintf(out, "SPACING 1 2 0.5\nORIGIN 0 0 0\n");
  fprintf(out,
          "POINT_DATA %d\nSCALARS d unsigned_char 1\nLOOKUP_TABLE "
          "default\n",
          SAMPLES);
  for (int k = 0; k < SAMPLES && ascii; k++)
    fprintf(out, "%u\n", density(k));
  if (!ascii)
    put_samples(out, 1, false);
  fclose(out);
}

/* The same as VTK's XML: an image, or a rectilinear grid. */
static void write_xml(const char *path, bool rectilinear) {
  const char *kind = rectilinear ? "RectilinearGrid" : "ImageData";
  FILE *out = create(path);
  fprintf(out, "<VTKFile type=\"%s\">\n<%s WholeExtent=\"0 %d 0 %d 0 %d\"",
          kind, kind, X - 1, Y - 1, Z - 1);
  fprintf(out, " Spacing=\"1 2 0.5\">\n<Piece Extent=\"0 %d 0 %d 0 %d\">\n",
          X - 1, Y - 1, Z - 1);
  fprintf(out, "<PointData><DataArray type=\"UInt8\" Name=\"d\">\n");
  for (int k = 0; k < SAMPLES; k++)
    fprintf(out, "%u\n", density(k));
  fprintf(out, "</DataArray></PointData>\n");
  if (rectilinear)
    fprintf(out, "<Coordinates>\n"
                 "<DataArray type=\"Float32\">0 1 2 3 4</DataArray>\n"
                 "<DataArray type=\"Int8\">0 2 4 6</DataArray>\n"
                 "<DataArray type=\"Float64\">0 0.5 10</DataArray>\n"
                 "</Coordinates>\n");
  fprintf(out, "</Piece>\n</%s>\n</VTKFile>\n", kind);
  fclose(out);
}

static void write_mhd(const char *path, const char *data) {
  FILE *out = create(path);
  fprintf(out,
          "ObjectType = Image\nNDims = 3\nBinaryData = True\n"
          "ElementSpacing = 1 2 0.5\nDimSize = %d %d %d\n"
          "ElementType = MET_UCHAR\nElementDataFile = %s\n",
          X, Y, Z, data);
  if (!strcmp(data, "LOCAL"))
    put_samples(out, 1, false);
  fclose(out);
}

static void set_short(unsigned char *at, int value) {
  at[0] = (unsigned char)value;
  at[1] = (unsigned char)(value >> 8);
}

static void write_nifti(const char *path) {
  unsigned char h[352] = {0x5c, 1};
  const float numbers[] = {1, 1, 2, 0.5f}, offset = 352;
  const int sizes[] = {3, X, Y, Z, 1, 1, 1, 1};
  for (int k = 0; k < 8; k++)
    set_short(h + 40 + 2 * k, sizes[k]);
  set_short(h + 70, 2);
  set_short(h + 72, 8);
  memcpy(h + 76, numbers, sizeof numbers); /* this machine has them low first */
  memcpy(h + 108, &offset, sizeof offset);
  memcpy(h + 344, "n+1", 4);
  bool packed = strstr(path, ".gz");
  gzFile out = gzopen(path, packed ? "wb" : "wbT");
  if (!out || gzwrite(out, h, sizeof h) != sizeof h)
    abort();
  for (int k = 0; k < SAMPLES; k++)
    gzputc(out, (int)density(k));
  gzclose(out);
}

/* The kept samples are those from `least` to `most`, at these spacings. */
static bool holds(const char *name, unsigned least, unsigned most, double y,
                  double z) {
  struct hsr_scene *scene;
  struct hsr_error err = {.text = "out of memory"};
  if (hsr_scene_open(name, NULL, &scene, &err)) {
    printf("# %s: %s\n", name, err.text);
    return false;
  }
  const struct hsr_grid *g = scene->grid;
  bool good = g && g->n[0] == X && g->n[1] == Y && g->n[2] == Z;
  for (uint32_t k = 0; k < SAMPLES && good; k++) {
    const uint32_t at[3] = {k % X, k / X % Y, k / (X * Y)};
    bool kept = density((int)k) >= least && density((int)k) <= most;
    good = (hsr_grid_cell(g, at) != UINT32_MAX) == kept;
  }
  good = good && g->bound[0][1] == 0.5 && g->bound[1][1] == y / 2 &&
         g->bound[2][1] == z / 2;
  hsr_scene_delete(scene);
  return good;
}

static bool is_refused(const char *name, const char *words) {
  struct hsr_scene *scene;
  struct hsr_error err = {.text = ""};
  enum hsr_status status = hsr_scene_open(name, NULL, &scene, &err);
  bool good = status == HSR_E_INPUT && !scene && strstr(err.text, words);
  if (!good)
    printf("# %s: status %d, %s\n", name, (int)status, err.text);
  hsr_scene_delete(scene);
  return good;
}

static void test_raw(struct tap *tap) {
  write_raw("a.raw", 0, 1, false);
  write_raw("b.raw", 7, 2, false);
  write_raw("c.raw", 9, 2, true);
  ok(tap, holds("a.raw:size=5x4x3", 30, 59, 1, 1),
     "without a word, samples from half way up are kept");
  ok(tap, holds("a.raw:size=5x4x3:least=7:most=11:spacing=1x2x3", 7, 11, 2, 3),
     "least, most and spacing");
  ok(tap,
     holds("b.raw:offset=7:type=u16-le:size=5x4x3:least=7", 7, 59, 1, 1) &&
         holds("c.raw:offset=9:type=i16-be:size=5x4x3:least=7", 7, 59, 1, 1),
     "types and offsets");
  ok(tap, is_refused("a.raw:size=5x4x4", "too short"), "a size too large");
  ok(tap, is_refused("a.raw:size=5x4", "the word \"size=5x4\""), "two sizes");
  ok(tap,
     is_refused("a.raw:size=5x4x3:least=", "the word") &&
         is_refused("a.raw:size=5x4x3:lest=4", "the word") &&
         is_refused("a.raw:size=5x4x3:type=u12", "the word") &&
         is_refused("a.raw:size=0x4x3", "the word"),
     "words that are none");
  ok(tap, is_refused("a.raw:size=5x4x3:least=60", "densities are from 0 to 59"),
     "nothing kept");
  ok(tap, is_refused("nowhere.raw:size=5x4x3", "nowhere.raw"), "no file");
}

static void test_formats(struct tap *tap) {
  static const char *const files[] = {"ascii.vtk", "bytes.vtk", "head.mhd",
                                      "whole.mha", "plain.nii", "packed.nii.gz",
                                      "image.vti", "grid.vtr"};
  write_vtk("ascii.vtk", true, false);
  write_vtk("bytes.vtk", false, false);
  write_vtk("grid.vtk", true, true);
  write_xml("image.vti", false);
  write_xml("grid.vtr", true);
  write_mhd("head.mhd", "a.raw");
  write_mhd("whole.mha", "LOCAL");
  write_nifti("plain.nii");
  write_nifti("packed.nii.gz");
  for (size_t k = 0; k < sizeof files / sizeof *files; k++) {
    char name[80];
    snprintf(name, sizeof name, "%s:least=20:most=50", files[k]);
    ok(tap, holds(name, 20, 50, 2, 0.5), "%s", files[k]);
  }
  struct hsr_scene *scene = NULL;
  bool opened = !hsr_scene_open("grid.vtk:least=0", NULL, &scene, NULL);
  ok(tap,
     opened && scene->grid->bound[2][2] == 5.5 &&
         scene->grid->n_cells == SAMPLES && scene->grid->n_faces == 94,
     "a rectilinear grid");
  hsr_scene_delete(scene);
  opened = !hsr_scene_open("grid.vtk:least=0:sides=all", NULL, &scene, NULL);
  ok(tap, opened && scene->grid->n_faces == 6 * SAMPLES, "with all sides");
  hsr_scene_delete(scene);
}

/* In a build without VTK. */
static void test_refusals(struct tap *tap) {
  write_xml("image.vti", false);
  write_xml("grid.vtr", true);
  ok(tap,
     is_refused("image.vti", "without VTK") &&
         is_refused("grid.vtr:least=3", "without VTK"),
     "without VTK, its formats are refused");
}

/* A map of 4 x 3 columns: one peak of level 9 on a plain of level 0. */
static void test_heights(struct tap *tap) {
  float rgb[3 * 12] = {0};
  rgb[3 * 5] = rgb[3 * 5 + 1] = rgb[3 * 5 + 2] = 1;
  const struct hsr_picture picture = {.m = 4, .n = 3, .rgb = rgb};
  struct hsr_scene *scene = NULL;
  struct hsr_error err = {.text = ""};
  bool opened =
      !hsr_image_write("peak.png", &picture, NULL, &err) &&
      !hsr_scene_open("heights-of:peak.png:levels=10", NULL, &scene, &err);
  const uint32_t top[3] = {1, 9, 1}, foot[3] = {1, 1, 1}, none[3] = {1, 0, 1};
  ok(tap,
     opened && scene->grid->n_cells == 11 + 9 &&
         hsr_grid_cell(scene->grid, top) != UINT32_MAX &&
         hsr_grid_cell(scene->grid, foot) != UINT32_MAX &&
         hsr_grid_cell(scene->grid, none) == UINT32_MAX,
     "a height map fills columns from above their lowest neighbour: %s",
     err.text);
  hsr_scene_delete(scene);
  ok(tap, is_refused("heights-of:a.raw", "a.raw: cannot be read"),
     "a height map that is no picture");
}

int main(void) {
  char folder[] = "/tmp/hsr-volumes-XXXXXX";
  if (!mkdtemp(folder) || chdir(folder))
    abort();
  bool has_vtk = hsr_exchange_has_vtk();
  struct tap tap = plan(has_vtk ? 20 : 11);
  test_raw(&tap);
  if (has_vtk)
    test_formats(&tap);
  else
    test_refusals(&tap);
  test_heights(&tap);
  char clean[80];
  snprintf(clean, sizeof clean, "rm -rf %s", folder);
  return finish(&tap) | (system(clean) != 0);
}
