/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/terminal/pixels.h"
#include "bench/terminal/terminal.h"
#include "common/files/srgb.h"

#include <langinfo.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

/* --- What a terminal can do ----------------------------------------------- */

static const char *variable(const char *name) {
  const char *value = getenv(name);
  return value ? value : "";
}

static bool has_one_of(const char *text, const char *const *words) {
  for (; *words; words++)
    if (strstr(text, *words))
      return true;
  return false;
}

enum pixels pixels_known(void) {
  static const char *const sixel[] = {"sixel", "mlterm",  "foot",
                                      "yaft",  "contour", NULL},
                           *const programs[] = {"WezTerm", "mintty", "iTerm",
                                                NULL},
                           *const true_colours[] = {"truecolor", "24bit", NULL};
  const char *term = variable("TERM");
  if (!isatty(STDOUT_FILENO) || *variable("NO_COLOR") || !*term ||
      !strcmp(term, "dumb") || !strncmp(term, "vt", 2))
    return PIXELS_NONE;
  /* screen and tmux pass none on */
  bool passed = strncmp(term, "screen", 6) && strncmp(term, "tmux", 4);
  if (passed && (has_one_of(term, sixel) ||
                 has_one_of(variable("TERM_PROGRAM"), programs)))
    return PIXELS_SIXEL;
  return has_one_of(variable("COLORTERM"), true_colours) ||
                 strstr(term, "-direct")
             ? PIXELS_TRUE
             : PIXELS_256;
}

/* --- Smaller pictures ----------------------------------------------------- */

/* Bytes of w x h colours, each the mean of those of m x n that are under it. NULL:
 * there is no memory. */
static unsigned char *shrink(int m, int n, const float *rgb, int w, int h) {
  unsigned char *small = malloc(3 * (size_t)w * (size_t)h);
  for (int j = 0; small && j < h; j++)
    for (int i = 0; i < w; i++) {
      const int x0 = (int)((long)i * m / w), y0 = (int)((long)j * n / h),
                x1 = (int)((long)(i + 1) * m / w),
                y1 = (int)((long)(j + 1) * n / h);
      const int x_end = x1 > x0 ? x1 : x0 + 1, y_end = y1 > y0 ? y1 : y0 + 1;
      double sum[3] = {0, 0, 0};
      for (int y = y0; y < y_end; y++)
        for (int x = x0; x < x_end; x++)
          for (int c = 0; c < 3; c++)
            sum[c] += (double)
                rgb[3 * ((size_t)y * (size_t)m + (size_t)x) + (size_t)c];
      for (int c = 0; c < 3; c++)
        small[3 * ((size_t)j * (size_t)w + (size_t)i) + (size_t)c] =
            hsr_srgb_byte((float)(sum[c] / (x_end - x0) / (y_end - y0)));
    }
  return small;
}

/* --- Blocks --------------------------------------------------------------- */

/* The nearest of the 6 x 6 x 6 colours and 24 greys. */
static int of_256(const unsigned char *rgb) {
  static const int level[6] = {0, 95, 135, 175, 215, 255};
  int cube[3], far = 0, far_grey = 0;
  int grey = (rgb[0] + rgb[1] + rgb[2]) / 3;
  int step = grey < 3 ? 0 : grey > 233 ? 23 : (grey - 3) / 10;
  for (int c = 0; c < 3; c++) {
    cube[c] = 0;
    for (int k = 1; k < 6; k++)
      if (abs(level[k] - rgb[c]) < abs(level[cube[c]] - rgb[c]))
        cube[c] = k;
    int d = level[cube[c]] - rgb[c], e = 8 + 10 * step - rgb[c];
    far += d * d;
    far_grey += e * e;
  }
  return far_grey < far ? 232 + step
                        : 16 + 36 * cube[0] + 6 * cube[1] + cube[2];
}

static void set_colour(enum pixels how, int ground, const unsigned char *rgb) {
  if (how == PIXELS_TRUE)
    printf("\033[%d;2;%d;%d;%dm", ground, rgb[0], rgb[1], rgb[2]);
  else
    printf("\033[%d;5;%dm", ground, of_256(rgb));
}

/* A row of characters shows `each` rows of the picture: two by upper half blocks,
 * or one by spaces where the locale has no such letter. */
static void show_blocks(enum pixels how, int w, int h, int each,
                        const unsigned char *rgb) {
  for (int j = 0; j + each <= h; j += each) {
    for (int i = 0; i < w; i++) {
      const unsigned char *upper =
          rgb + 3 * ((size_t)j * (size_t)w + (size_t)i);
      if (each == 2)
        set_colour(how, 38, upper);
      set_colour(how, 48, upper + (each == 2 ? 3 * (size_t)w : 0));
      fputs(each == 2 ? "\u2580" : " ", stdout);
    }
    puts("\033[0m");
  }
}

/* --- Sixels --------------------------------------------------------------- */

/* One of 6 x 6 x 6 colours, by an ordered dither. */
static int dithered(const unsigned char *rgb, int i, int j) {
  static const int bayer[4][4] = {
      {0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};
  int colour = 0;
  for (int c = 0; c < 3; c++)
    colour = 6 * colour +
             (rgb[c] * 5 * 16 + 255 * bayer[j % 4][i % 4] + 127) / (255 * 16);
  return colour;
}

/* A band of six rows: for each colour in it, a character a column. */
static void show_band(int w, int h, int j, const unsigned char *rgb) {
  static unsigned char bits[216][1024];
  bool used[216] = {false};
  memset(bits, 0, sizeof bits);
  for (int k = 0; k < 6 && j + k < h; k++)
    for (int i = 0; i < w; i++) {
      int colour = dithered(rgb + 3 * ((size_t)(j + k) * (size_t)w + (size_t)i),
                            i, j + k);
      bits[colour][i] |= (unsigned char)(1 << k);
      used[colour] = true;
    }
  for (int colour = 0; colour < 216; colour++) {
    if (!used[colour])
      continue;
    printf("#%d", colour);
    for (int i = 0; i < w;) {
      int run = 1;
      while (i + run < w && bits[colour][i + run] == bits[colour][i])
        run++;
      printf("!%d%c", run, 63 + bits[colour][i]);
      i += run;
    }
    putchar('$');
  }
  putchar('-');
}

static void show_sixels(int w, int h, const unsigned char *rgb) {
  printf("\033Pq\"1;1;%d;%d", w, h);
  for (int k = 0; k < 216; k++)
    printf("#%d;2;%d;%d;%d", k, k / 36 * 20, k / 6 % 6 * 20, k % 6 * 20);
  for (int j = 0; j < h; j += 6)
    show_band(w, h, j, rgb);
  puts("\033\\");
}

bool pixels_show(enum pixels how, int m, int n, const float *rgb, int spare) {
  struct winsize size = {.ws_row = 0};
  int columns = terminal_columns(stdout), w = m, h = n;
  int rows = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) || !size.ws_row
                 ? 24
                 : size.ws_row;
  const bool halves = !strcmp(nl_langinfo(CODESET), "UTF-8");
  const int each = halves ? 2 : 1;
  if (how == PIXELS_SIXEL) {
    if (w > 800) {
      w = 800;
      h = (int)((long)n * w / m);
    }
  } else {
    rows = rows > spare + 4 ? rows - spare : 4;
    w = (int)(2L * rows * m / n);
    w = w < 1 ? 1 : w > columns ? columns : w;
    rows = (int)((long)w * n / (2L * m));
    h = each * (rows < 1 ? 1 : rows);
  }
  unsigned char *small = shrink(m, n, rgb, w, h > 0 ? h : 1);
  if (!small)
    return false;
  if (how == PIXELS_SIXEL)
    show_sixels(w, h > 0 ? h : 1, small);
  else
    show_blocks(how, w, h, each, small);
  free(small);
  return true;
}
