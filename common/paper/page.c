/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/paper/page.h"

#include <math.h>

/* Pixels of the page for one of the picture. `w` and `h` are the size of what
 * is laid out, in pixels of the picture. */
static enum hsr_status choose_scale(const struct hsr_page *page,
                                    const struct hsr_view *view, double w,
                                    double h, double *scale,
                                    struct hsr_error *err) {
  const double across = page->width - 2 * page->margin,
               down = page->height - 2 * page->margin;
  *scale = 1;
  if (page->scale > 0) {
    const double unit = page->unit > 0 ? page->unit : 1;
    double height = 0; /* of a row, in units of the scene */
    for (int k = 0; k < 3; k++)
      height += view->U[k] * view->U[k];
    *scale =
        2 * sqrt(height) / view->n * unit * page->scale * HSR_PIXELS_PER_MM;
  } else if (page->width > 0 || page->height > 0) {
    if ((page->width > 0 && across <= 0) || (page->height > 0 && down <= 0))
      return hsr_fail(err, HSR_E_USAGE,
                      "the margins of %g mm leave no room on the page",
                      page->margin);
    *scale = INFINITY;
    if (page->width > 0)
      *scale = fmin(*scale, across * HSR_PIXELS_PER_MM / fmax(w, 1e-9));
    if (page->height > 0)
      *scale = fmin(*scale, down * HSR_PIXELS_PER_MM / fmax(h, 1e-9));
  }
  return HSR_OK;
}

enum hsr_status hsr_page_lay_out(const struct hsr_page *page,
                                 const struct hsr_view *view,
                                 const double low[2], const double high[2],
                                 struct hsr_layout *layout,
                                 struct hsr_error *err) {
  const bool crop = page->crop && low[0] <= high[0];
  const double from[2] = {crop ? low[0] : 0, crop ? low[1] : 0};
  const double w = crop ? high[0] - low[0] : view->m,
               h = crop ? high[1] - low[1] : view->n;
  if (page->scale > 0 && !view->parallel)
    return hsr_fail(err, HSR_E_USAGE,
                    "--scale is for parallel projection; --parallel HEIGHT, or "
                    "a view as --front, asks for it");
  if (page->scale > 0 && (page->width > 0 || page->height > 0))
    return hsr_fail(err, HSR_E_USAGE,
                    "--scale, or --width and --height, not both");
  enum hsr_status status = choose_scale(page, view, w, h, &layout->scale, err);
  if (status)
    return status;
  const double room[2] = {layout->scale * w, layout->scale * h},
               margin = page->margin * HSR_PIXELS_PER_MM;
  layout->width =
      page->width > 0 ? page->width * HSR_PIXELS_PER_MM : room[0] + 2 * margin;
  layout->height = page->height > 0 ? page->height * HSR_PIXELS_PER_MM
                                    : room[1] + 2 * margin;
  /* What is laid out is in the middle of the page. */
  layout->left = (layout->width - room[0]) / 2 - layout->scale * from[0];
  layout->top = (layout->height - room[1]) / 2 - layout->scale * from[1];
  if (!(layout->width <= 10000 * HSR_PIXELS_PER_MM &&
        layout->height <= 10000 * HSR_PIXELS_PER_MM))
    return hsr_fail(
        err, HSR_E_USAGE, "the page would be %.4g x %.4g mm; at most 10 m",
        layout->width / HSR_PIXELS_PER_MM, layout->height / HSR_PIXELS_PER_MM);
  return HSR_OK;
}
