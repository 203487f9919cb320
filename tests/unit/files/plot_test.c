/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Line drawings on paper: the strokes, the contents of files, the edges that
 * are creases.
 *
 * The eye is the origin and looks along -z with a field of 90 degrees, so that
 * in a picture of 32 x 32 the point at depth d seen at the pixel (x, y) is
 * ((x - 16) d/16, (16 - y) d/16, -d). */
#include "common/lines/crease.h"
#include "common/files/plot.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char directory[] = "/tmp/hsr-plot-XXXXXX";

static void must(bool good) {
  if (good)
    return;
  bail("a scene could not be set up");
}

/* ---- A scene: two triangles ---- */

struct setting {
  struct hsr_scene *scene;
  struct hsr_world world;
  struct hsr_view view;
  struct hsr_drawing drawing;
};

static void at(double x, double y, double depth, double point[3]) {
  point[0] = (x - 16) * depth / 16;
  point[1] = (16 - y) * depth / 16;
  point[2] = -depth;
}

static void add_object(struct setting *s, const char *name, size_t n_vertices,
                       const double (*xyz)[3], size_t n_faces,
                       const uint32_t (*triangle)[3], bool one_sided) {
  struct hsr_object *object = hsr_scene_object(s->scene, name);
  must(object);
  object->one_sided = one_sided;
  for (size_t k = 0; k < n_vertices; k++)
    must(!hsr_object_vertex(object, xyz[k][0], xyz[k][1], xyz[k][2], NULL));
  for (size_t k = 0; k < n_faces; k++)
    must(!hsr_object_face(object, triangle[k], 3, NULL));
}

static void complete(struct setting *s) {
  const struct hsr_camera camera = {
      .at = {0, 0, -1}, .up = {0, 1, 0}, .fov = 90};
  must(!hsr_scene_view(s->scene, &camera));
  must(!hsr_scene_finish(s->scene, NULL));
  must(!hsr_world_init(&s->world, s->scene, NULL));
  must(!hsr_view_init(&s->view, &camera, 32, 32, NULL));
}

static void free_setting(struct setting *s) {
  hsr_drawing_free(&s->drawing);
  hsr_world_free(&s->world);
  hsr_scene_delete(s->scene);
}

static void add(struct setting *s, struct hsr_edge_name edge,
                uint32_t invisibility, double x0, double y0, double x1,
                double y1) {
  struct hsr_segment segment = {
      .edge = edge, .invisibility = invisibility, .t0 = 0, .t1 = 1};
  at(x0, y0, 3, segment.from);
  at(x1, y1, 5, segment.to);
  must(!hsr_drawing_add(&s->drawing, &segment));
}

#define ODD_NAME "a<b> & \"c\" \xff\x01 \xc3\xa9"

static void set_triangles(struct setting *s) {
  *s = (struct setting){.scene = hsr_scene_new("triangles")};
  must(s->scene);
  static const uint32_t triangle[1][3] = {{0, 1, 2}};
  static const double near[3][3] = {{0, 0, -3}, {1, 0, -3}, {0, 1, -3}};
  static const double far[3][3] = {{0, 0, -4}, {1, 0, -4}, {0, 1, -4}};
  add_object(s, ODD_NAME, 3, near, 1, triangle, false);
  add_object(s, "far", 3, far, 1, triangle, false);
  complete(s);
  add(s, (struct hsr_edge_name){false, 0, 1, 0}, 0, 4, 4, 8.5, 4);
  add(s, (struct hsr_edge_name){false, 0, 2, 0}, 0, 8.5, 4, 8.25, 12.125);
  add(s, (struct hsr_edge_name){false, 3, 4, 0}, 1, 20, 4, 20, 20);
  add(s, (struct hsr_edge_name){false, 3, 5, 0}, 7, 4, 20, 20, 20);
  add(s, (struct hsr_edge_name){true, 1, 2, 0}, 0, 30, 30, 10, 30);
}

/* ---- Strokes ---- */

static bool lies(const double got[2], double x, double y) {
  return fabs(got[0] - x) < 1e-9 && fabs(got[1] - y) < 1e-9;
}

static void try_strokes(struct tap *t) {
  struct setting s;
  struct hsr_plot plot;
  set_triangles(&s);
  must(!hsr_plot_init(&plot, &s.drawing, &s.world, &s.view, HSR_HIDDEN_NONE,
                      NULL));
  ok(t, plot.n_strokes == 3 && plot.n_pens == 1, "none: only what is visible");
  ok(t,
     lies(plot.stroke[0].from, 4, 4) && lies(plot.stroke[0].to, 8.5, 4) &&
         lies(plot.stroke[1].to, 8.25, 12.125),
     "strokes end where the intervals are seen");
  ok(t,
     plot.stroke[0].object == 0 && plot.stroke[2].object == 1 &&
         hsr_plot_run(&plot, 0) == 2 && hsr_plot_run(&plot, 2) == 1,
     "they are by object; an implied edge is its first face's");
  hsr_plot_free(&plot);

  must(!hsr_plot_init(&plot, &s.drawing, &s.world, &s.view, HSR_HIDDEN_ALL,
                      NULL));
  ok(t, plot.n_strokes == 5 && plot.stroke[4].pen == 0, "all: all, one pen");
  hsr_plot_free(&plot);
  must(!hsr_plot_init(&plot, &s.drawing, &s.world, &s.view, HSR_HIDDEN_DASHED,
                      NULL));
  ok(t,
     plot.n_strokes == 5 && plot.stroke[0].pen == 1 && plot.stroke[1].pen == 1,
     "dashed: hidden ones first");
  ok(t, plot.pen[0].dash == 0 && plot.pen[1].dash > 0, "and only they dashed");
  hsr_plot_free(&plot);
  must(!hsr_plot_init(&plot, &s.drawing, &s.world, &s.view, HSR_HIDDEN_THIN,
                      NULL));
  ok(t,
     plot.stroke[0].pen == plot.n_pens - 1 && plot.stroke[1].pen == 1 &&
         plot.stroke[2].pen == 0,
     "thin: the most hidden first");
  bool thinner = true;
  for (uint32_t k = 1; k < plot.n_pens; k++)
    thinner = thinner && plot.pen[k].width < plot.pen[k - 1].width &&
              plot.pen[k].grey > plot.pen[k - 1].grey;
  ok(t, thinner, "its pens grow thinner and lighter");
  hsr_plot_free(&plot);

  double where[2];
  const double behind[3] = {0, 0, 1};
  ok(t, !hsr_plot_point(&s.view, behind, where),
     "what is behind the eye is nowhere");
  free_setting(&s);
}

/* ---- Files ---- */

static const char *path_of(const char *name) {
  static char path[100];
  snprintf(path, sizeof path, "%s/%s", directory, name);
  return path;
}

/* A file's text, to be freed. */
static char *text_of(const char *path) {
  FILE *in = fopen(path, "rb");
  char *text = calloc(1, 100000);
  must(in && text && fread(text, 1, 99999, in) > 0);
  fclose(in);
  return text;
}

/* Whether all elements end in the right order, all attributes are quoted, and
 * every & begins one of XML's entities. */
static bool is_well_formed(const char *text) {
  char open[16][16];
  int depth = 0;
  if (strncmp(text, "<?xml ", 6) != 0)
    return false;
  for (const char *c = strchr(text, '\n'); *c; c++) {
    if (*c == '&' && strncmp(c, "&amp;", 5) && strncmp(c, "&lt;", 4) &&
        strncmp(c, "&gt;", 4))
      return false;
    if ((unsigned char)*c < ' ' && *c != '\n')
      return false;
    if (*c != '<')
      continue;
    bool ends = c[1] == '/', quoted = false;
    c += 1 + ends;
    size_t length = strspn(c, "abcdefghijklmnopqrstuvwxyz");
    if (length == 0 || length > 15 || depth == 15)
      return false;
    const char *name = c;
    for (c += length; *c && (quoted || *c != '>'); c++)
      quoted ^= *c == '"';
    if (!*c || quoted)
      return false;
    if (ends) {
      if (--depth < 0 || strlen(open[depth]) != length ||
          strncmp(open[depth], name, length) != 0)
        return false;
    } else if (c[-1] != '/') {
      memcpy(open[depth], name, length);
      open[depth++][length] = '\0';
    }
  }
  return depth == 0;
}

static int count(const char *text, const char *part) {
  int n = 0;
  for (; (text = strstr(text, part)); text++)
    n++;
  return n;
}

static void try_svg(struct tap *t) {
  struct setting s;
  struct hsr_plot plot;
  set_triangles(&s);
  must(!hsr_plot_init(&plot, &s.drawing, &s.world, &s.view, HSR_HIDDEN_DASHED,
                      NULL));
  plot.title = "a & b";
  plot.description = "what it is";
  ok(t, !hsr_plot_write_svg(&plot, path_of("a.svg"), NULL), ".svg is written");
  char *text = text_of(path_of("a.svg"));
  ok(t, is_well_formed(text), "it is well-formed");
  ok(t, strstr(text, "viewBox=\"0 0 32 32\""), "it shows the picture's pixels");
  ok(t, strstr(text, "<title>a &amp; b</title>"), "it has its title");
  ok(t, strstr(text, "<title>a&lt;b&gt; &amp; \"c\" ?? \xc3\xa9</title>"),
     "names are made fit for XML");
  ok(t,
     count(text, "<path ") == 3 && count(text, "id=\"visible-0\"") == 1 &&
         count(text, "id=\"visible-1\"") == 1 &&
         count(text, "id=\"hidden-1\"") == 1,
     "a path an object and pen");
  ok(t,
     count(text, "stroke-dasharray") == 1 &&
         count(text, "non-scaling-stroke") == 3,
     "hidden ones are dashed, all keep their width");
  ok(t, strstr(text, "d=\"M4 4L8.5 4L8.25 12.125\""),
     "numbers are short, lines go on");
  free(text);
  s.drawing.n = 0;
  hsr_plot_free(&plot);
  must(!hsr_plot_init(&plot, &s.drawing, &s.world, &s.view, HSR_HIDDEN_NONE,
                      NULL));
  must(!hsr_plot_write_svg(&plot, path_of("a.svg"), NULL));
  text = text_of(path_of("a.svg"));
  ok(t, is_well_formed(text) && !strstr(text, "<path"),
     "an empty drawing is an empty sheet");
  free(text);
  hsr_plot_free(&plot);
  free_setting(&s);
}

static void try_pdf(struct tap *t) {
  struct setting s;
  struct hsr_plot plot;
  set_triangles(&s);
  must(!hsr_plot_init(&plot, &s.drawing, &s.world, &s.view, HSR_HIDDEN_THIN,
                      NULL));
  plot.title = "a & b";
  ok(t, !hsr_plot_write_pdf(&plot, path_of("a.pdf"), NULL), ".pdf is written");
  char *text = text_of(path_of("a.pdf"));
  ok(t, !strncmp(text, "%PDF-", 5), "it is one");
  free(text);
  struct hsr_error err = {.status = HSR_OK};
  ok(t,
     hsr_plot_write_pdf(&plot, path_of("none/a.pdf"), &err) == HSR_E_INPUT &&
         strstr(err.text, "none/a.pdf"),
     "a folder that is not there is named");
  ok(t, hsr_plot_write_svg(&plot, path_of("none/a.svg"), &err) == HSR_E_INPUT,
     "also for .svg");
  hsr_plot_free(&plot);
  free_setting(&s);
}

static void try_raster(struct tap *t) {
  static float rgb[3 * 32 * 32];
#define GREY(i, j) ((double)rgb[3 * ((j)*32 + (i))])
  struct setting s;
  struct hsr_plot plot;
  set_triangles(&s);
  must(!hsr_plot_init(&plot, &s.drawing, &s.world, &s.view, HSR_HIDDEN_NONE,
                      NULL));
  ok(t, !hsr_plot_raster(&plot, rgb, NULL), "pixels are drawn");
  ok(t, GREY(0, 0) == 1 && GREY(20, 12) == 1,
     "paper is white, hidden lines are not drawn");
  ok(t, GREY(6, 3) < 0.5 && GREY(6, 4) < 0.5 && GREY(6, 6) == 1,
     "a line is dark on both sides of its middle");
  hsr_plot_free(&plot);
  must(!hsr_plot_init(&plot, &s.drawing, &s.world, &s.view, HSR_HIDDEN_THIN,
                      NULL));
  must(!hsr_plot_raster(&plot, rgb, NULL));
  ok(t, GREY(20, 12) < 1 && GREY(20, 12) > GREY(6, 4),
     "thin lines are lighter");
  ok(t, GREY(12, 20) > GREY(20, 12), "the more hidden, the lighter");
  hsr_plot_free(&plot);
  free_setting(&s);
}

/* ---- Creases ---- */

/* A roof of two triangles over the edge from vertex 0 to 1, seen from above.
 * Its sides slope by `slope` degrees; if `turned`, the second one is turned
 * round. The drawing has the ridge, and 1 to 2, a border. Returns which of them
 * are left: 1 for the ridge, 2 for the border. */
static int edges_left(double slope, bool turned, bool one_sided,
                      double degrees) {
  const double fall = tan(slope * 3.14159265358979323846 / 180);
  const double xyz[4][3] = {
      {0, 0, -5}, {0, 1, -5}, {-1, 0, -5 - fall}, {1, 0, -5 - fall}};
  const uint32_t straight[2][3] = {{0, 1, 2}, {1, 0, 3}};
  const uint32_t other[2][3] = {{0, 1, 2}, {0, 1, 3}};
  struct setting s = {.scene = hsr_scene_new("roof")};
  must(s.scene);
  add_object(&s, "roof", 4, xyz, 2, turned ? other : straight, one_sided);
  complete(&s);
  add(&s, (struct hsr_edge_name){false, 0, 1, 0}, 0, 1, 1, 2, 2);
  add(&s, (struct hsr_edge_name){false, 1, 2, 0}, 0, 2, 2, 3, 3);
  must(!hsr_drawing_crease(&s.drawing, &s.world, &s.view, degrees, NULL));
  int left = 0;
  for (size_t k = 0; k < s.drawing.n; k++)
    left |= s.drawing.segment[k].edge.a == 0 ? 1 : 2;
  free_setting(&s);
  return left;
}

static void try_creases(struct tap *t) {
  ok(t, edges_left(20, false, false, 39) == 3, "a ridge of 40 degrees is one");
  ok(t, edges_left(20, false, false, 41) == 2,
     "but not if 41 are asked for; the border stays");
  ok(t,
     edges_left(20, true, false, 39) == 3 &&
         edges_left(20, true, false, 41) == 2,
     "whichever way round the faces are");
  ok(t, edges_left(0, false, false, 0) == 2, "a flat seam never is");
  ok(t, edges_left(85, false, false, 180) == 2, "180 leaves no crease");
  ok(t, edges_left(-85, false, false, 180) == 2, "nor a valley");
  /* If turned and one-sided, one of the two faces does not exist. */
  ok(t, edges_left(20, true, true, 180) & 1,
     "beside a face that does not exist, an edge is a contour");
}

/* A seam in two intervals, and a border. */
static void try_count(struct tap *t) {
  const double xyz[4][3] = {{0, 0, -5}, {0, 1, -5}, {-1, 0, -5}, {1, 0, -5}};
  const uint32_t triangle[2][3] = {{0, 1, 2}, {1, 0, 3}};
  struct setting s = {.scene = hsr_scene_new("flat")};
  struct hsr_edge_counts counts;
  must(s.scene);
  add_object(&s, "flat", 4, xyz, 2, triangle, false);
  complete(&s);
  add(&s, (struct hsr_edge_name){false, 0, 1, 0}, 0, 1, 1, 2, 2);
  add(&s, (struct hsr_edge_name){false, 0, 1, 0}, 1, 2, 2, 3, 3);
  add(&s, (struct hsr_edge_name){false, 1, 2, 0}, 0, 2, 2, 3, 3);
  must(!hsr_drawing_count_edges(&s.drawing, &s.world, &s.view, 1, &counts,
                                NULL));
  ok(t,
     counts.seams == 1 && counts.edges == 2 && counts.borders == 1 &&
         s.drawing.n == 3,
     "%zu of %zu edges would be left out; %zu is a border", counts.seams,
     counts.edges, counts.borders);
  free_setting(&s);
}

static void try_contour(struct tap *t) {
  /* The eye sees the first face from its front, the second, folded under it,
   * from its back. */
  const double xyz[4][3] = {{0, 0, -5}, {0, 1, -5}, {-1, 0, -5}, {-1, 0, -6}};
  const uint32_t triangle[2][3] = {{0, 1, 2}, {1, 0, 3}};
  struct setting s = {.scene = hsr_scene_new("wedge")};
  must(s.scene);
  add_object(&s, "wedge", 4, xyz, 2, triangle, false);
  complete(&s);
  add(&s, (struct hsr_edge_name){false, 0, 1, 0}, 0, 1, 1, 2, 2);
  must(!hsr_drawing_crease(&s.drawing, &s.world, &s.view, 180, NULL));
  ok(t, s.drawing.n == 1, "where a surface turns away its edge is a contour");
  s.drawing.n = 0;
  add(&s, (struct hsr_edge_name){true, 0, 1, 0}, 0, 1, 1, 2, 2);
  must(!hsr_drawing_crease(&s.drawing, &s.world, &s.view, 180, NULL));
  ok(t, s.drawing.n == 1, "implied edges stay");
  free_setting(&s);
}

/* Two triangles in one plane, and a third one that stands on their seam. */
static void try_three(struct tap *t) {
  const double xyz[5][3] = {
      {0, 0, -5}, {0, 1, -5}, {-1, 0, -5}, {1, 0, -5}, {1, 0, -4}};
  const uint32_t triangle[3][3] = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
  struct setting s = {.scene = hsr_scene_new("fin")};
  must(s.scene);
  add_object(&s, "fin", 5, xyz, 3, triangle, false);
  complete(&s);
  add(&s, (struct hsr_edge_name){false, 0, 1, 0}, 0, 1, 1, 2, 2);
  must(!hsr_drawing_crease(&s.drawing, &s.world, &s.view, 180, NULL));
  ok(t, s.drawing.n == 1, "an edge of three faces stays");
  free_setting(&s);
}

int main(void) {
  struct tap t = plan(38);
  must(mkdtemp(directory));
  try_strokes(&t);
  try_svg(&t);
  try_pdf(&t);
  try_raster(&t);
  try_creases(&t);
  try_count(&t);
  try_contour(&t);
  try_three(&t);
  remove(path_of("a.svg"));
  remove(path_of("a.pdf"));
  rmdir(directory);
  return finish(&t);
}
