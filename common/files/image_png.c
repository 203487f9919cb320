/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pictures as .png files, through libpng. This file is hsr-png.so. OpenImageIO
 * would write them as well, but it takes several times as long to load as most
 * pictures take to draw. */
#include "common/files/image_library.h"
#include "common/files/srgb.h"
#include "common/files/whole_file.h"

#include <math.h>
#include <png.h>
#include <stdlib.h>
#include <string.h>

/* What is to be written, and what libpng says if it fails. */
struct sheet {
  const struct hsr_picture *picture;
  char *text; /* lines "key=value", whose ends have become 0 */
  png_text *entry;
  int n_entries;
  unsigned char *row;
  char message[200];
};

static void fail(png_structp png, png_const_charp message) {
  struct sheet *sheet = png_get_error_ptr(png);
  strncpy(sheet->message, message, sizeof sheet->message - 1);
  png_longjmp(png, 1);
}

static void overhear(png_structp png, png_const_charp message) {
  (void)png;
  (void)message;
}

/* Divides the text into the entries of the file's metadata. */
static void divide_text(struct sheet *sheet) {
  for (char *line = sheet->text; line && *line;) {
    char *end = strchr(line, '\n'), *equals = strchr(line, '=');
    if (end)
      *end = 0;
    if (equals && (!end || equals < end)) {
      *equals = 0;
      sheet->entry[sheet->n_entries++] =
          (png_text){.compression = PNG_TEXT_COMPRESSION_NONE,
                     .key = line,
                     .text = equals + 1,
                     .text_length = strlen(equals + 1)};
    }
    line = end ? end + 1 : NULL;
  }
}

static enum hsr_status begin(struct sheet *sheet,
                             const struct hsr_picture *picture,
                             const char *text) {
  size_t n = 1;
  for (const char *c = text ? text : ""; *c; c++)
    n += *c == '\n';
  *sheet = (struct sheet){.picture = picture,
                          .text = strdup(text ? text : ""),
                          .entry = calloc(n, sizeof *sheet->entry),
                          .row = malloc(4 * (size_t)picture->m)};
  if (!sheet->text || !sheet->entry || !sheet->row)
    return HSR_E_NOMEM;
  divide_text(sheet);
  return HSR_OK;
}

static void end(struct sheet *sheet) {
  free(sheet->text);
  free(sheet->entry);
  free(sheet->row);
}

static unsigned char byte_of(float encoded) {
  return (unsigned char)fminf(255, fmaxf(0, encoded * 255 + 0.5f));
}

/* Row j in 8 bits a channel, sRGB-encoded. Colours are divided by the alpha, if
 * there is one. */
static void fill_row(const struct sheet *sheet, int j) {
  const struct hsr_picture *p = sheet->picture;
  unsigned char *to = sheet->row;
  for (int i = 0; i < p->m; i++) {
    size_t k = (size_t)j * (size_t)p->m + (size_t)i;
    float alpha = p->alpha ? p->alpha[k] : 1;
    for (int c = 0; c < 3; c++) {
      float x = p->rgb[3 * k + (size_t)c];
      if (p->alpha)
        x = alpha > 0 ? fminf(1, x / alpha) : 0;
      *to++ = byte_of(hsr_srgb_encode(x));
    }
    if (p->alpha)
      *to++ = byte_of(alpha);
  }
}

/* False: libpng has failed, and sheet->message says why. */
static bool put(struct sheet *sheet, png_structp png, png_infop info,
                FILE *stream) {
  const struct hsr_picture *p = sheet->picture;
  if (setjmp(png_jmpbuf(png)))
    return false;
  png_init_io(png, stream);
  png_set_compression_level(png, 6);
  png_set_filter(png, 0, PNG_NO_FILTERS);
  png_set_IHDR(png, info, (png_uint_32)p->m, (png_uint_32)p->n, 8,
               p->alpha ? PNG_COLOR_TYPE_RGBA : PNG_COLOR_TYPE_RGB,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_BASE,
               PNG_FILTER_TYPE_BASE);
  png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_ABSOLUTE);
  png_set_text(png, info, sheet->entry, sheet->n_entries);
  png_write_info(png, info);
  for (int j = 0; j < p->n; j++) {
    fill_row(sheet, j);
    png_write_row(png, sheet->row);
  }
  png_write_end(png, info);
  return true;
}

static enum hsr_status write_sheet(struct sheet *sheet, const char *path,
                                   struct hsr_error *err) {
  struct hsr_whole_file file;
  png_structp png =
      png_create_write_struct(PNG_LIBPNG_VER_STRING, sheet, fail, overhear);
  png_infop info = png ? png_create_info_struct(png) : NULL;
  enum hsr_status status =
      info ? hsr_whole_file_open(&file, path, err) : hsr_fail_nomem(err);
  if (!status) {
    bool good = put(sheet, png, info, file.stream);
    /* What the file itself cannot hold is said by hsr_whole_file_close. */
    if (!good && !ferror(file.stream))
      status = hsr_fail(err, HSR_E_INPUT, "%s: cannot be written: %s", path,
                        sheet->message);
    status = hsr_whole_file_close(&file, status, err);
  }
  png_destroy_write_struct(&png, &info);
  return status;
}

static enum hsr_status write_png(const char *path,
                                 const struct hsr_picture *picture,
                                 const char *text, struct hsr_error *err) {
  struct sheet sheet;
  enum hsr_status status = begin(&sheet, picture, text);
  status = status ? hsr_fail_nomem(err) : write_sheet(&sheet, path, err);
  end(&sheet);
  return status;
}

extern const struct hsr_image_library hsr_png;
const struct hsr_image_library hsr_png = {.write = write_png};
