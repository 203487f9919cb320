/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A z-buffer in C, of nothing but the standard library, which hsr judges and
 * times: docs/programs.md.
 *
 *   cc -O2 zbuffer.c -o zbuffer -lm && hsr check house -a ./zbuffer
 *
 * Every quantity of a triangle is c0 + c1 x + c2 y in the coordinates of the
 * screen. Only rows and columns are visited, and nothing is clipped. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
  double x, y, z;
} vec;
typedef struct {
  unsigned corner[3], face, one_sided;
} triangle;
typedef struct {
  vec E, F, R, U;
  double near;
} camera;
typedef struct {
  double c0, c1, c2;
} plane; /* c0 + c1 x + c2 y */

static int m, n, parallel, n_cameras, n_triangles;
static camera *cameras, now;
static vec *V;
static triangle *T;
static uint32_t *ids;
static double *nearest;
static long depth_tests, writes;

static vec sub(vec a, vec b) {
  return (vec){a.x - b.x, a.y - b.y, a.z - b.z};
}
static double dot(vec a, vec b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
static vec cross(vec a, vec b) {
  return (vec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
               a.x * b.y - a.y * b.x};
}
static double at(plane p, double x, double y) {
  return p.c0 + p.c1 * x + p.c2 * y;
}

static void fail(const char *what) {
  fprintf(stderr, "%s\n", what);
  exit(1);
}

static FILE *open_in(const char *folder, const char *name, const char *mode) {
  char path[4096];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  FILE *file = fopen(path, mode);
  if (!file)
    fail(path);
  return file;
}

static void read_job(const char *folder) {
  char answer[16], kind[16];
  int version;
  FILE *file = open_in(folder, "job", "r");
  if (fscanf(file,
             "hsr-program %d answer %15s size %d %d threads %*d cameras %d",
             &version, answer, &m, &n, &n_cameras) != 5 ||
      version != 1)
    fail("job: not understood");
  if (strcmp(answer, "ids"))
    exit(6); /* it declines lines */
  cameras = malloc((size_t)n_cameras * sizeof *cameras);
  for (camera *c = cameras; c < cameras + n_cameras; c++)
    if (fscanf(file,
               " camera %15s eye %lf %lf %lf forward %lf %lf %lf "
               "right %lf %lf %lf up %lf %lf %lf near %lf",
               kind, &c->E.x, &c->E.y, &c->E.z, &c->F.x, &c->F.y, &c->F.z,
               &c->R.x, &c->R.y, &c->R.z, &c->U.x, &c->U.y, &c->U.z,
               &c->near) != 14)
      fail("job: a camera is missing");
  parallel = !strcmp(kind, "parallel");
  fclose(file);
}

static void read_scene(const char *folder) {
  char line[200] = "";
  int n_vertices = 0;
  FILE *file = open_in(folder, "triangles.ply", "r");
  while (strcmp(line, "end_header\n") && fgets(line, sizeof line, file)) {
    sscanf(line, "element vertex %d", &n_vertices);
    sscanf(line, "element face %d", &n_triangles);
  }
  V = malloc((size_t)n_vertices * sizeof *V + 1);
  T = malloc((size_t)n_triangles * sizeof *T + 1);
  for (int k = 0; k < n_vertices; k++)
    if (fscanf(file, "%lf %lf %lf", &V[k].x, &V[k].y, &V[k].z) != 3)
      fail("triangles.ply: a vertex is missing");
  for (triangle *t = T; t < T + n_triangles; t++)
    if (fscanf(file, " 3 %u %u %u %u %u", &t->corner[0], &t->corner[1],
               &t->corner[2], &t->face, &t->one_sided) != 5)
      fail("triangles.ply: a triangle is missing");
  fclose(file);
}

/* det(a, b, ray): on which side of the edge a sample is. */
static plane edge(vec a, vec b) {
  vec c = cross(a, b), d = cross(now.F, sub(b, a));
  return parallel ? (plane){dot(c, now.F), dot(d, now.R), dot(d, now.U)}
                  : (plane){dot(c, now.F), dot(c, now.R), dot(c, now.U)};
}

/* A sample on the edge is a little to the right, and much less down. */
static int side(plane p, double x, double y) {
  double e = at(p, x, y);
  return (e != 0 ? e : p.c1 != 0 ? p.c1 : -p.c2) > 0;
}

static void draw_triangle(const triangle *t) {
  vec a = sub(V[t->corner[0]], now.E), b = sub(V[t->corner[1]], now.E),
      c = sub(V[t->corner[2]], now.E);
  vec N = cross(sub(b, a), sub(c, a));
  double front =
      parallel ? dot(N, now.F) : dot(N, a); /* < 0: seen from its front */
  if (front == 0 || (t->one_sided && front > 0))
    return;
  plane ab = edge(a, b), bc = edge(b, c), ca = edge(c, a);
  /* 1/t or, in parallel projection, -t: the greater is nearer. */
  plane depth = {(parallel ? -dot(N, a) : dot(N, now.F)) / front,
                 dot(N, now.R) / front, dot(N, now.U) / front};
  for (int j = 0; j < n; j++)
    for (int i = 0; i < m; i++) {
      double x = (2. * i + 1 - m) / m, y = (n - 2. * j - 1) / n;
      int s = side(ab, x, y);
      if (s != side(bc, x, y) || s != side(ca, x, y))
        continue;
      double q = at(depth, x, y);
      if (parallel ? -q <= now.near : q <= 0 || q * now.near >= 1)
        continue;
      depth_tests++;
      if (q <= nearest[j * m + i])
        continue;
      writes++;
      nearest[j * m + i] = q;
      ids[j * m + i] = t->face;
    }
}

int main(int argc, char **argv) {
  if (argc != 2)
    fail("which folder?");
  read_job(argv[1]);
  read_scene(argv[1]);
  size_t size = (size_t)m * (size_t)n;
  ids = malloc(size * sizeof *ids);
  nearest = malloc(size * sizeof *nearest);
  FILE *file = open_in(argv[1], "ids", "r+b");
  puts("{}");
  fflush(stdout);
  for (int frame = 0; getchar() != EOF; frame++) {
    now = cameras[frame % n_cameras];
    memset(ids, 0xff, size * sizeof *ids);
    for (size_t s = 0; s < size; s++)
      nearest[s] = -INFINITY;
    depth_tests = writes = 0;
    for (int k = 0; k < n_triangles; k++)
      draw_triangle(&T[k]);
    rewind(file);
    if (fwrite(ids, sizeof *ids, size, file) != size || fflush(file))
      fail("ids: cannot be written");
    printf("{\"counts\": {\"depth tests\": %ld, \"writes\": %ld}}\n",
           depth_tests, writes);
    fflush(stdout);
  }
  return 0;
}
