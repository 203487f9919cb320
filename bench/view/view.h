/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr view: what its files share. A window shows the samples that an algorithm
 * draws, again and again as the camera moves.
 *
 * window.h    the window, through VTK
 * player.c    one algorithm, made ready, and its picture as bytes
 * frame.c     the picture of the window: players side by side, overlays, lines
 * panel.c     the text over it
 * pick.c      the faces under a pixel
 * frozen.c    the camera seen from elsewhere
 * keys.c      what each key does
 * line_keys.c what those of lines do
 * play.c      a list of keys and moves, played
 * command.c   the command line, the scene, and the events */
#ifndef HSR_BENCH_VIEW_H
#define HSR_BENCH_VIEW_H

#include "bench/modules/variant.h"
#include "bench/render/render.h"
#include "bench/terminal/terminal.h"
#include "bench/view/window.h"

/* --- Players -------------------------------------------------------------- */

/* Which build, and whether it makes a work picture. */
enum player_sort { PLAYER_PLAIN, PLAYER_COUNTS, PLAYER_WORKS };

struct viewer;

/* One algorithm that draws the scene. All zero: none is chosen. */
struct player {
  struct hsr_variant variant;
  enum player_sort sort;
  struct render_options options; /* of render */
  struct render render;
  bool is_ready;
  struct hsr_world laid_out; /* for colours, if render's world is a roster of
                                not too many faces */
  uint32_t *stamp; /* a face: the picture in which its colour was made */
  unsigned char *face_rgb;
  uint32_t n_pictures;      /* so far */
  double draw_ms, shade_ms; /* of the last picture */
};

/* Makes an algorithm ready for the viewer's scene, which is borrowed, with its
 * threads and style: the plain build, the counting one, or that with a work
 * picture. Closes what the player was before.
 * HSR_E_USAGE, also if the algorithm makes no picture, or no work picture;
 * HSR_E_REFUSED; HSR_E_NOMEM; HSR_E_INPUT. */
enum hsr_status player_open(struct player *player, const char *name,
                            enum player_sort sort, const struct viewer *viewer,
                            struct hsr_error *err);
void player_close(struct player *player);

/* Draws a view, m x n samples, as sRGB bytes: the picture that hsr render
 * writes. rgb has 3 m n bytes. HSR_E_NOMEM, and whatever the algorithm fails
 * with. */
enum hsr_status player_draw(struct player *player, const struct hsr_view *view,
                            unsigned char *rgb, struct hsr_error *err);

/* Draws the lines of a view, which the player's algorithm makes, over m x n
 * pixels, as they would be on paper of these colours. Fails likewise. */
enum hsr_status player_draw_over(struct player *player,
                                 const struct hsr_view *view,
                                 unsigned char *rgb, struct hsr_error *err);

/* The colour of a face, or of the background, as bytes. */
void player_colour(const struct hsr_world *world, const struct hsr_view *view,
                   uint32_t id, unsigned char rgb[3]);

/* The ids of the last picture; NULL if it is of another kind. */
const uint32_t *player_ids(const struct player *player);

/* --- The viewer ----------------------------------------------------------- */

enum overlay { OVERLAY_NONE, OVERLAY_WORK, OVERLAY_DEPTH, OVERLAY_EDGES };
enum comparison {
  COMPARE_NONE, /* the first algorithm alone */
  COMPARE_SIDES,
  COMPARE_BLINK,
  COMPARE_DIFFERENCE
};
enum page { PAGE_NONE, PAGE_TIMES, PAGE_STEPS, PAGE_TABLE, PAGE_HELP, N_PAGES };

/* The options of lines as words; and a command that draws what the window
 * shows. */
enum {
  MOST_LINE_WORDS = MOST_LINE_OPTIONS * (MOST_PEN + 20) + TERMINAL_NAME + 100,
  MOST_COMMAND = 2 * TERMINAL_NAME + MOST_LINE_WORDS + 200
};
enum { MOST_COARSE = 8, MOST_PANEL = 8192 + 2 * MOST_COMMAND };
#define LINES_BY "appel" /* the line drawing over the picture */

struct viewer {
  const struct window_library *library;
  struct window *window;
  const char *scene_name; /* with its cameras; borrowed */
  struct hsr_import import;
  struct line_options line_options;
  struct hsr_line_style style; /* made of line_options */
  const char *style_file;      /* if --style was one; or NULL */
  struct hsr_scene *scene;
  struct player *player[2]; /* the second is for comparisons; owned */
  struct player counter;    /* the first one's counting build; or that of
                               zbuffer-fast */
  struct player lines;      /* the line drawing over the picture */
  /* What the players are called; of the first, without what `filtered` adds. */
  char first[HSR_MOST_VARIANT + 1], second[HSR_MOST_VARIANT + 1];

  struct hsr_camera camera;
  uint32_t view; /* from 0: the scene's view that the camera started from */
  int m, n;      /* of the window */
  int coarse;    /* samples are so many pixels wide and high, at rest */
  int moving;    /* the same while the camera moves; 0: it rests */
  long threads;

  enum overlay overlay;
  enum comparison comparison;
  enum page page, page_before; /* help */
  bool has_lines, filtered, walking, frozen;
  bool blink;             /* the second's turn */
  struct hsr_view culled; /* the view that is frozen */

  unsigned char *rgb, *other; /* 3 m n bytes: of the window, and for a player */
  char message[2 * MOST_COMMAND], picked[2000];
  char camera_file[40];

  bool stopped;
  unsigned n_frames, n_moving;
  double begin, first_ms; /* until the first picture is shown */
  double outside_ms;      /* of the last frame, all but drawing and shading */
  /* Of moving frames. */
  double sum_outside, sum_draw, sum_shade, sum_coarse, moving_seconds;
  enum hsr_status status; /* of what ended the run */
  struct hsr_error err;
};

/* Draws the window's picture again, and the panel, and shows both. */
void viewer_show(struct viewer *viewer);
/* The panel alone. */
void viewer_show_panel(struct viewer *viewer);

/* Says something in the panel, and on standard output. */
void viewer_say(struct viewer *viewer, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* The camera's view for a part of the window that is `width` pixels wide and as
 * high as the window. Its samples are `coarse` x `coarse` pixels. Fails as
 * hsr_view_init. */
enum hsr_status viewer_view(const struct viewer *viewer, int width, int coarse,
                            struct hsr_view *view, struct hsr_error *err);

/* Opens the first player again with another algorithm. If that fails, says why,
 * and the player stays as it was. */
bool viewer_choose(struct viewer *viewer, const char *name);

/* Loads the scene again; the camera stays. */
void viewer_reload(struct viewer *viewer);

/* Draws the window's picture into viewer->rgb. */
enum hsr_status frame_draw(struct viewer *viewer, struct hsr_error *err);

/* The text of the panel. */
void panel_write(struct viewer *viewer, char text[MOST_PANEL]);

/* Says what is under a pixel of the window. */
void pick(struct viewer *viewer, int x, int y);

/* Shows the culling camera as shapes; and ends that. */
void frozen_begin(struct viewer *viewer);
void frozen_end(struct viewer *viewer);

/* Does what a key is for. */
void keys_press(void *viewer, const char *name);
bool keys_know(const char *name);
/* Writes what the keys and the mouse do, in two columns. */
void keys_help(char *text, size_t size);

/* Keys of lines: the next style, and way to draw hidden lines; the angle of
 * creases; classes off and on. */
void lines_next_style(struct viewer *viewer);
void lines_next_hidden(struct viewer *viewer);
void lines_less_crease(struct viewer *viewer);
void lines_more_crease(struct viewer *viewer);
void lines_switch_silhouettes(struct viewer *viewer);
void lines_switch_boundaries(struct viewer *viewer);
void lines_switch_intersections(struct viewer *viewer);
void lines_switch_creases(struct viewer *viewer);
void lines_switch_colours(struct viewer *viewer);
void lines_switch_flat(struct viewer *viewer); /* seams, and smooth lines */
/* Writes one line: how lines are drawn, and which. "": none are shown. */
void lines_say(const struct viewer *viewer, char *text, size_t size);
/* Writes options, each after a space: a command with them draws the same. */
void lines_words(const struct line_options *options,
                 char words[MOST_LINE_WORDS]);

/* Writes what the window shows to a file. */
enum hsr_status viewer_screenshot(struct viewer *viewer, const char *path,
                                  struct hsr_error *err);

/* Writes a picture as large as the window. */
enum hsr_status viewer_save(struct viewer *viewer, const unsigned char *bytes,
                            const char *path, struct hsr_error *err);

/* Plays a list: "n,drag:100:100:300:200,w,shot:a.png". HSR_E_USAGE for a word
 * that is none; whatever writing a picture fails with. */
enum hsr_status play(struct viewer *viewer, const char *list,
                     struct hsr_error *err);

#endif
