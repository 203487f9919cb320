/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scalable Vector Graphics 1.1, to be looked at and to be edited: a <g> a layer,
 * in it a <g> a pen, in it a <path> a stroke. A drawing library would write no
 * layers. The attributes of layers are those of Inkscape. */
#include "common/files/json/drawing_json.h"
#include "common/files/srgb.h"
#include "common/files/whole_file.h"
#include "common/paper/dashes.h"
#include "common/paper/plot_files.h"

#include <math.h>
#include <string.h>

int hsr_plot_character(const char *text, uint32_t *code) {
  const unsigned char *c = (const unsigned char *)text;
  *code = *c;
  if (*c < 0x80)
    return *c >= ' ' && *c != 0x7f;
  int n = *c >= 0xf0 ? 4 : *c >= 0xe0 ? 3 : 2;
  *code = *c & (0xffu >> (n + 1));
  for (int k = 1; k < n; k++) {
    if ((c[k] & 0xc0) != 0x80)
      return 0;
    *code = *code << 6 | (c[k] & 0x3f);
  }
  static const uint32_t least[] = {0, 0, 0xa0, 0x800, 0x10000};
  bool allowed = *c >= 0xc2 && *c < 0xf5 && *code >= least[n] &&
                 *code <= 0x10ffff && (*code < 0xd800 || *code > 0xdfff) &&
                 *code != 0xfffe && *code != 0xffff;
  return allowed ? n : 0;
}

static void put_text(FILE *out, const char *text) {
  while (*text) {
    uint32_t code;
    int n = hsr_plot_character(text, &code);
    if (n == 0)
      fputc('?', out);
    else if (*text == '&')
      fputs("&amp;", out);
    else if (*text == '<')
      fputs("&lt;", out);
    else if (*text == '>')
      fputs("&gt;", out);
    else if (*text == '"')
      fputs("&quot;", out);
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

static struct place place_at(const double at[2]) {
  return (struct place){lround(1000 * at[0]), lround(1000 * at[1])};
}

/* Of a place of the picture. */
static struct place place_of(const struct hsr_plot *plot, const double at[2]) {
  const struct hsr_layout *l = &plot->layout;
  const double on_page[2] = {l->left + l->scale * at[0],
                             l->top + l->scale * at[1]};
  return place_at(on_page);
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

/* `on` is the stream. */
static void path_move(void *on, const double place[2]) {
  put_place(on, 'M', place_at(place));
}

static void path_line(void *on, const double place[2]) {
  put_place(on, 'L', place_at(place));
}

/* Whether all dashes are alike, and all gaps. */
static bool is_even(const struct hsr_dashes *dashes) {
  for (size_t k = 2; k < dashes->n; k++)
    if (dashes->length[k] != dashes->length[k - 2])
      return false;
  return true;
}

/* To what a list of dashes is rounded, in thousandths of a pixel: 20 of it are no
 * more than the shortest. */
static long step_of(const struct hsr_dashes *dashes) {
  double shortest = dashes->length[0];
  for (size_t k = 1; k < dashes->n; k++)
    shortest = fmin(shortest, dashes->length[k]);
  return shortest >= 2 ? 100 : shortest >= .2 ? 10 : 1;
}

/* A list begins again where it ends: two numbers are enough for dashes that are
 * alike. Else all are there, and their sum is rounded, so that corners are where
 * they ought to be. */
static void put_lengths(FILE *out, const struct hsr_dashes *dashes) {
  fputs("stroke-dasharray=\"", out);
  if (is_even(dashes)) {
    fprintf(out, "%.6g %.6g\" ", dashes->length[0], dashes->length[1]);
    return;
  }
  const long step = step_of(dashes);
  double sum = 0;
  long put = 0;
  for (size_t k = 0; k < dashes->n; k++) {
    sum += 1000 * dashes->length[k];
    const long to =
        k + 1 < dashes->n ? step * lround(sum / (double)step) : lround(sum);
    fputs(k ? " " : "", out);
    put_number(out, to - put);
    put = to;
  }
  /* What is left over of the stroke, by rounding, is ink. */
  if (dashes->n % 2)
    fputs(" 0", out);
  fputs("\" ", out);
}

static enum hsr_status put_stroke(FILE *out, const struct hsr_plot *plot,
                                  const struct hsr_stroke *stroke,
                                  const struct hsr_line_pen *pen,
                                  struct hsr_dashes *dashes,
                                  struct hsr_error *err) {
  const double(*at)[2] = (const double(*)[2])plot->strokes.at + stroke->first;
  enum hsr_status status = HSR_OK;
  fputs("<path ", out);
  if (pen->dash > 0)
    status = hsr_dashes_find(dashes, at, stroke->n, stroke->closed,
                             pen->dash * HSR_PIXELS_PER_MM,
                             pen->gap * HSR_PIXELS_PER_MM, err);
  if (pen->dash > 0 && !plot->cuts_dashes && !status)
    put_lengths(out, dashes);
  fputs("d=\"", out);
  if (pen->dash > 0 && plot->cuts_dashes && !status) {
    hsr_dashes_cut(dashes, at, stroke->n, stroke->closed, out, path_move,
                   path_line);
  } else {
    path_move(out, at[0]);
    for (size_t k = 1; k < stroke->n; k++)
      path_line(out, at[k]);
    if (stroke->closed)
      fputc('Z', out);
  }
  fputs("\"/>\n", out);
  return status;
}

static enum hsr_status put_group(FILE *out, const struct hsr_plot *plot,
                                 const struct hsr_plot_group *group,
                                 struct hsr_dashes *dashes,
                                 struct hsr_error *err) {
  const struct hsr_line_pen *pen = hsr_plot_pen(plot, group);
  fprintf(out, "<g stroke=\"#%02x%02x%02x\" stroke-width=\"", pen->rgb[0],
          pen->rgb[1], pen->rgb[2]);
  put_number(out, lround(1000 * pen->width * HSR_PIXELS_PER_MM));
  fprintf(out, "\" stroke-linecap=\"%s\">\n", pen->dash > 0 ? "butt" : "round");
  enum hsr_status status = HSR_OK;
  for (size_t k = group->first; k < group->first + group->n && !status; k++)
    status = put_stroke(out, plot, &plot->strokes.stroke[k], pen, dashes, err);
  fputs("</g>\n", out);
  return status;
}

static enum hsr_status put_layer(FILE *out, const struct hsr_plot *plot,
                                 const struct hsr_plot_layer *layer,
                                 struct hsr_dashes *dashes,
                                 struct hsr_error *err) {
  fprintf(out, "<g id=\"%s\" inkscape:groupmode=\"layer\" inkscape:label=\"",
          layer->id);
  put_text(out, layer->title ? layer->title : layer->id);
  fputs("\" fill=\"none\" stroke-linejoin=\"round\">\n", out);
  if (layer->title)
    put_element(out, "title", layer->title);
  enum hsr_status status = HSR_OK;
  for (size_t k = layer->first; k < layer->first + layer->n && !status; k++)
    status = put_group(out, plot, &plot->group[k], dashes, err);
  fputs("</g>\n", out);
  return status;
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

/* The hairlines beneath the regions, a path for each region. */
static void put_shared(FILE *out, const struct hsr_plot *plot) {
  const struct hsr_shared_sides *shared = &plot->shared;
  fputs("<g id=\"joints\" fill=\"none\" stroke-width=\"", out);
  put_number(out, 1000 * HSR_HAIRLINE);
  fputs("\">\n", out);
  for (size_t k = 0; k < shared->n;) {
    const size_t region = shared->side[k].region;
    fputs("<path stroke=\"", out);
    put_colour(out, plot->fill[region].rgb);
    fputs("\" d=\"", out);
    for (; k < shared->n && shared->side[k].region == region; k++) {
      put_place(out, 'M', place_of(plot, shared->side[k].from));
      put_place(out, 'L', place_of(plot, shared->side[k].to));
    }
    fputs("\"/>\n", out);
  }
  fputs("</g>\n", out);
}

static void put_regions(FILE *out, const struct hsr_plot *plot) {
  fputs("<g id=\"faces\" fill-rule=\"evenodd\">\n", out);
  for (size_t r = 0; r < plot->polygons->n_regions; r++)
    put_region(out, plot, r);
  fputs("</g>\n", out);
}

static void put_size(FILE *out, const struct hsr_plot *plot) {
  const struct hsr_page *page = &plot->page;
  const double size[2] = {plot->layout.width, plot->layout.height};
  const struct place corner = place_at(size);
  if (page->word)
    fprintf(out, "width=\"%.6g%s\" height=\"%.6g%s\" viewBox=\"0 0 ",
            size[0] / HSR_PIXELS_PER_MM / page->word_size, page->word,
            size[1] / HSR_PIXELS_PER_MM / page->word_size, page->word);
  else
    fprintf(out, "width=\"%.6g\" height=\"%.6g\" viewBox=\"0 0 ", size[0],
            size[1]);
  put_number(out, corner.x);
  fputc(' ', out);
  put_number(out, corner.y);
  fputs("\">\n", out);
}

static enum hsr_status put_plot(FILE *out, const struct hsr_plot *plot,
                                struct hsr_dashes *dashes,
                                struct hsr_error *err) {
  fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" "
        "xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" "
        "version=\"1.1\" ",
        out);
  put_size(out, plot);
  put_element(out, "title", plot->title);
  put_element(out, "desc", plot->description);
  if (plot->drawing) {
    fputs("\n" HSR_DRAWING_IN_SVG, out);
    hsr_drawing_json_print(out, plot->drawing, plot->m, plot->n);
    fputs(HSR_DRAWING_IN_SVG_END, out);
  }
  fputc('\n', out);
  if (plot->has_paper) {
    fputs("<rect id=\"paper\" width=\"100%\" height=\"100%\" fill=\"", out);
    put_colour(out, plot->paper);
    fputs("\"/>\n", out);
  }
  if (plot->polygons) {
    put_shared(out, plot);
    put_regions(out, plot);
  }
  enum hsr_status status = HSR_OK;
  for (size_t k = 0; k < plot->n_layers && !status; k++)
    status = put_layer(out, plot, &plot->layer[k], dashes, err);
  fputs("</svg>\n", out);
  return status;
}

enum hsr_status hsr_plot_write_svg(const struct hsr_plot *plot,
                                   const char *path, struct hsr_error *err) {
  struct hsr_whole_file file;
  struct hsr_dashes dashes = {.n = 0};
  enum hsr_status status = hsr_whole_file_open(&file, path, err);
  if (status)
    return status;
  status = put_plot(file.stream, plot, &dashes, err);
  hsr_dashes_free(&dashes);
  return hsr_whole_file_close(&file, status, err);
}
