/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scalable Vector Graphics 1.1, to be looked at and to be edited: a <g> a pen,
 * in it a <path> an object, with the object's name. A drawing library would
 * write neither names nor strokes that keep their width when zoomed. */
#include "common/files/json/drawing_json.h"
#include "common/files/plot.h"
#include "common/files/srgb.h"
#include "common/files/whole_file.h"
#include "common/lines/polygons.h"

#include <math.h>
#include <string.h>

/* The bytes of one character of UTF-8 that XML 1.0 allows in a text, or 0. */
static int character(const char *text) {
  const unsigned char *c = (const unsigned char *)text;
  if (*c < 0x80)
    return *c >= ' ' && *c != 0x7f;
  int n = *c >= 0xf0 ? 4 : *c >= 0xe0 ? 3 : 2;
  uint32_t code = *c & (0xffu >> (n + 1));
  for (int k = 1; k < n; k++) {
    if ((c[k] & 0xc0) != 0x80)
      return 0;
    code = code << 6 | (c[k] & 0x3f);
  }
  static const uint32_t least[] = {0, 0, 0xa0, 0x800, 0x10000};
  bool allowed = *c >= 0xc2 && *c < 0xf5 && code >= least[n] &&
                 code <= 0x10ffff && (code < 0xd800 || code > 0xdfff) &&
                 code != 0xfffe && code != 0xffff;
  return allowed ? n : 0;
}

static void put_text(FILE *out, const char *text) {
  while (*text) {
    int n = character(text);
    if (n == 0)
      fputc('?', out);
    else if (*text == '&')
      fputs("&amp;", out);
    else if (*text == '<')
      fputs("&lt;", out);
    else if (*text == '>')
      fputs("&gt;", out);
    else
      fwrite(text, 1, (size_t)n, out);
    text += n ? n : 1;
  }
}

static void put_element(FILE *out, const char *name, const char *text) {
  if (!text)
    return;
  fprintf(out, "<%s>", name);
  put_text(out, text);
  fprintf(out, "</%s>", name);
}

/* Coordinates are whole thousandths of a pixel of the page. */
struct place {
  long x, y;
};

static struct place place_of(const struct hsr_plot *plot, const double at[2]) {
  const double scale = 1000 * hsr_plot_scale(plot);
  return (struct place){lround(scale * at[0]), lround(scale * at[1])};
}

static void put_number(FILE *out, long thousandths) {
  long fraction = thousandths % 1000;
  fprintf(out, "%ld", thousandths / 1000);
  if (fraction == 0)
    return;
  int digits = fraction % 100 == 0 ? 1 : fraction % 10 == 0 ? 2 : 3;
  for (int k = digits; k < 3; k++)
    fraction /= 10;
  fprintf(out, ".%0*ld", digits, fraction);
}

static void put_place(FILE *out, char command, struct place place) {
  fputc(command, out);
  put_number(out, place.x);
  fputc(' ', out);
  put_number(out, place.y);
}

/* Strokes that follow one another are one line. */
static void put_path(FILE *out, const struct hsr_plot *plot, size_t k,
                     size_t n) {
  const struct hsr_stroke *first = &plot->stroke[k];
  fprintf(out, "<path id=\"%s-%u\" vector-effect=\"non-scaling-stroke\" d=\"",
          plot->pen[first->pen].name, first->object);
  struct place at = {-1, -1};
  for (const struct hsr_stroke *s = first; s < first + n; s++) {
    struct place from = place_of(plot, s->from), to = place_of(plot, s->to);
    if (from.x != at.x || from.y != at.y)
      put_place(out, 'M', from);
    put_place(out, 'L', to);
    at = to;
  }
  fputs("\">", out);
  put_element(out, "title", plot->scene->objects[first->object].name);
  fputs("</path>\n", out);
}

static void put_pen(FILE *out, const struct hsr_pen *pen) {
  int grey = (int)lround(255 * pen->grey);
  fprintf(out, "<g id=\"%s\" stroke=\"#%02x%02x%02x\" stroke-width=\"",
          pen->name, grey, grey, grey);
  put_number(out, lround(1000 * pen->width));
  if (pen->dash > 0) {
    fputs("\" stroke-dasharray=\"", out);
    put_number(out, lround(1000 * pen->dash));
  }
  fputs("\">\n", out);
}

/* sRGB, as #rrggbb. */
static void put_colour(FILE *out, const float rgb[3]) {
  fputc('#', out);
  for (int c = 0; c < 3; c++)
    fprintf(out, "%02lx", lround(255 * (double)hsr_srgb_encode(rgb[c])));
}

/* Holes and the outer cycle, by parity. */
static void put_region(FILE *out, const struct hsr_plot *plot, size_t r) {
  const struct hsr_polygons *p = plot->polygons;
  const struct hsr_polygon_region *region = &p->region[r];
  fprintf(out, "<path id=\"face-%u-%zu\" fill=\"", region->face, r);
  put_colour(out, plot->fill[r].rgb);
  fputs("\" d=\"", out);
  for (size_t c = region->first; c < region->first + region->n; c++) {
    const struct hsr_polygon_cycle *cycle = &p->cycle[c];
    for (size_t k = 0; k < cycle->n; k++)
      put_place(out, k ? 'L' : 'M',
                place_of(plot, p->side[cycle->first + k].at));
    fputc('Z', out);
  }
  fputs("\"/>\n", out);
}

static void put_regions(FILE *out, const struct hsr_plot *plot) {
  fputs("<g id=\"faces\" fill-rule=\"evenodd\">\n", out);
  for (size_t r = 0; r < plot->polygons->n_regions; r++)
    put_region(out, plot, r);
  fputs("</g>\n", out);
}

static void put_size(FILE *out, const struct hsr_plot *plot) {
  const struct hsr_page *page = &plot->page;
  const struct place corner = place_of(plot, (double[]){plot->m, plot->n});
  if (page->width > 0)
    fprintf(out, "width=\"%.6g%s\" height=\"%.6g%s\" viewBox=\"0 0 ",
            page->width, page->unit, page->width * plot->n / plot->m,
            page->unit);
  else
    fprintf(out, "width=\"%d\" height=\"%d\" viewBox=\"0 0 ", plot->m, plot->n);
  put_number(out, corner.x);
  fputc(' ', out);
  put_number(out, corner.y);
  fputs("\">\n", out);
}

static void put_plot(FILE *out, const struct hsr_plot *plot) {
  fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" ",
        out);
  put_size(out, plot);
  put_element(out, "title", plot->title);
  put_element(out, "desc", plot->description);
  if (plot->drawing) {
    fputs("\n" HSR_DRAWING_IN_SVG, out);
    hsr_drawing_json_print(out, plot->drawing, plot->m, plot->n);
    fputs(HSR_DRAWING_IN_SVG_END, out);
  }
  fputs("\n<rect id=\"paper\" width=\"100%\" height=\"100%\" fill=\"", out);
  put_colour(out, plot->paper);
  fputs("\"/>\n", out);
  if (plot->polygons)
    put_regions(out, plot);
  fputs("<g id=\"drawing\" fill=\"none\" stroke-linecap=\"round\" "
        "stroke-linejoin=\"round\">\n",
        out);
  for (size_t k = 0, n; k < plot->n_strokes; k += n) {
    const struct hsr_stroke *stroke = &plot->stroke[k];
    n = hsr_plot_run(plot, k);
    if (k == 0 || stroke->pen != stroke[-1].pen)
      put_pen(out, &plot->pen[stroke->pen]);
    put_path(out, plot, k, n);
    if (k + n == plot->n_strokes || stroke->pen != stroke[n].pen)
      fputs("</g>\n", out);
  }
  fputs("</g>\n</svg>\n", out);
}

enum hsr_status hsr_plot_write_svg(const struct hsr_plot *plot,
                                   const char *path, struct hsr_error *err) {
  struct hsr_whole_file file;
  enum hsr_status status = hsr_whole_file_open(&file, path, err);
  if (status)
    return status;
  put_plot(file.stream, plot);
  return hsr_whole_file_close(&file, HSR_OK, err);
}
