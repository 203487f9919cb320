/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The panel's text as pixels, by cairo. Only window_vtk.cc includes this.
 *
 * Font        the one that the system calls "monospace". If it has no font at
 *             all, cairo draws letters of its own. */
#ifndef HSR_BENCH_WINDOW_TEXT_H
#define HSR_BENCH_WINDOW_TEXT_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* White letters on a dark ground, rows from the top. A pixel is opacity, red,
 * green, blue, of 8 bits, from the highest down; colours are multiplied by the
 * opacity. All zero: no text. */
struct window_text {
  uint32_t *pixel; /* m x n */
  int m, n;
};

/* Draws lines of text. `dots` is how many pixels the screen has an inch: at 96,
 * letters are 15 pixels high. They are smaller if the text would not fit in
 * most_m x most_n pixels, but at least 10 pixels; what does not fit then is cut.
 * Bytes that are no UTF-8 become question marks. *text is freed first. There
 * is no text if memory is out. */
void window_text_draw(struct window_text *text, const char *lines, double dots,
                      int most_m, int most_n);
void window_text_free(struct window_text *text);

#ifdef __cplusplus
}
#endif
#endif
