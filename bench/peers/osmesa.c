/* SPDX-License-Identifier: GPL-3.0-or-later */
/* llvmpipe, Mesa's software renderer, through OSMesa.
 *
 * One thread      LP_NUM_THREADS=0: no rasteriser threads beside the caller.
 * Ids             a flat output of the vertex shader, four bytes of colour.
 *                 gl_PrimitiveID would need no copies of vertices, but makes
 *                 llvmpipe assemble every primitive anew: half as long again.
 * Vertices        two layouts, as neither is the faster one for all scenes.
 *                 Indexed: a vertex for each face, a corner of it that it
 *                 starts from (the provoking vertex) and that other faces share
 *                 as a corner of theirs; so the face's id is the vertex's
 *                 number. Arrays: three vertices a face.
 * Depth           24 bits, between the nearest and the farthest corner of the
 *                 box of the world, as far as the eye is outside of it.
 * Rows            OpenGL's first row of pixels is the lowest; here it is the
 *                 top one, which the matrix turns over, so that fronts run
 *                 clockwise.
 * Time            includes glFinish, by which OSMesa delivers the pixels. */
#define GL_GLEXT_PROTOTYPES 1
#include "bench/peers/peers.h"

#include <GL/osmesa.h>
#include <GL/glext.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum layout { INDEXED, ARRAYS };

struct mesa {
  OSMesaContext context;
  enum layout layout;
  GLint matrix;           /* uniform's place */
  double low[3], high[3]; /* box of the world */
  int m, n;
  uint32_t n_faces, *ids;
};

/* --- Vertices and faces ----------------------------------------------------
 */

struct mesh {
  float *xyz; /* 3 * n_vertices */
  uint32_t n_vertices;
  uint32_t *corner; /* three a face; NULL: the vertices in order */
};

static void put_vertex(struct mesh *mesh, const struct hsr_world *world,
                       uint32_t v) {
  float *xyz = mesh->xyz + 3 * (size_t)mesh->n_vertices++;
  xyz[0] = (float)world->x[v];
  xyz[1] = (float)world->y[v];
  xyz[2] = (float)world->z[v];
}

static void lay_out_arrays(struct mesh *mesh, const struct hsr_world *world) {
  for (uint32_t k = 0; k < world->n_corners; k++)
    put_vertex(mesh, world, world->vertex[k]);
}

/* Turns face f so that it starts from a vertex that has no copy yet, if it can:
 * the fewer vertices are left over. */
static void turn_face(const struct hsr_world *world, uint32_t f,
                      const uint32_t *copy, uint32_t *corner) {
  const uint32_t *vertex = world->vertex + 3 * (size_t)f;
  int first = 0;
  while (first < 3 && copy[vertex[first]] != HSR_BACKGROUND)
    first++;
  for (int k = 0; k < 3; k++)
    corner[k] = vertex[(first + k) % 3];
}

/* copy[v] is any one of the copies of vertex v. */
static void lay_out_indexed(struct mesh *mesh, const struct hsr_world *world,
                            uint32_t *copy) {
  memset(copy, 0xff, world->n_vertices * sizeof *copy);
  for (uint32_t f = 0; f < world->n_faces; f++) {
    uint32_t *corner = mesh->corner + 3 * (size_t)f;
    turn_face(world, f, copy, corner);
    copy[corner[0]] = f;
    put_vertex(mesh, world, corner[0]);
  }
  for (uint32_t f = 0; f < world->n_faces; f++) {
    uint32_t *corner = mesh->corner + 3 * (size_t)f;
    corner[0] = f;
    for (int k = 1; k < 3; k++) {
      if (copy[corner[k]] == HSR_BACKGROUND) {
        copy[corner[k]] = mesh->n_vertices;
        put_vertex(mesh, world, corner[k]);
      }
      corner[k] = copy[corner[k]];
    }
  }
}

static void send_mesh(const struct mesh *mesh, uint32_t n_corners) {
  GLuint array, buffer[2];
  glGenVertexArrays(1, &array);
  glBindVertexArray(array);
  glGenBuffers(2, buffer);
  glBindBuffer(GL_ARRAY_BUFFER, buffer[0]);
  glBufferData(GL_ARRAY_BUFFER,
               (GLsizeiptr)(3 * mesh->n_vertices * sizeof *mesh->xyz),
               mesh->xyz, GL_STATIC_DRAW);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 3 * sizeof *mesh->xyz, NULL);
  glEnableVertexAttribArray(0);
  if (!mesh->corner)
    return;
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer[1]);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER,
               (GLsizeiptr)(n_corners * sizeof *mesh->corner), mesh->corner,
               GL_STATIC_DRAW);
}

static enum hsr_status make_mesh(enum layout layout,
                                 const struct hsr_world *world,
                                 struct hsr_error *err) {
  size_t most = (size_t)world->n_corners + world->n_vertices;
  struct mesh mesh = {.xyz = malloc(3 * most * sizeof *mesh.xyz)};
  uint32_t *copy = malloc(world->n_vertices * sizeof *copy);
  if (layout == INDEXED)
    mesh.corner = malloc(world->n_corners * sizeof *mesh.corner);
  enum hsr_status status = HSR_OK;
  if (!mesh.xyz || !copy || (layout == INDEXED && !mesh.corner)) {
    status = hsr_fail_nomem(err);
  } else {
    if (layout == INDEXED)
      lay_out_indexed(&mesh, world, copy);
    else
      lay_out_arrays(&mesh, world);
    send_mesh(&mesh, world->n_corners);
  }
  free(mesh.xyz);
  free(mesh.corner);
  free(copy);
  return status;
}

/* --- Shaders ---------------------------------------------------------------
 */

static GLuint shader(GLenum kind, const char *text) {
  GLuint made = glCreateShader(kind);
  glShaderSource(made, 1, &text, NULL);
  glCompileShader(made);
  return made;
}

static enum hsr_status make_program(struct mesa *mesa, struct hsr_error *err) {
  char vertex_text[600];
  snprintf(vertex_text, sizeof vertex_text,
           "#version 330 core\n"
           "layout(location = 0) in vec3 position;\n"
           "uniform mat4 matrix;\n"
           "flat out vec4 id;\n"
           "void main() {\n"
           "  gl_Position = matrix * vec4(position, 1);\n"
           "  uint k = uint(gl_VertexID) / %uu;\n"
           "  id = vec4(k & 255u, k >> 8 & 255u, k >> 16 & 255u, k >> 24)\n"
           "       / 255.0;\n"
           "}\n",
           mesa->layout == INDEXED ? 1u : 3u);
  static const char fragment_text[] = "#version 330 core\n"
                                      "flat in vec4 id;\n"
                                      "out vec4 colour;\n"
                                      "void main() { colour = id; }\n";
  GLuint program = glCreateProgram();
  glAttachShader(program, shader(GL_VERTEX_SHADER, vertex_text));
  glAttachShader(program, shader(GL_FRAGMENT_SHADER, fragment_text));
  glLinkProgram(program);
  GLint linked;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  if (!linked)
    return hsr_fail(err, HSR_E_INTERNAL, "llvmpipe: the shaders do not link");
  glUseProgram(program);
  mesa->matrix = glGetUniformLocation(program, "matrix");
  return HSR_OK;
}

/* --- Setting up ------------------------------------------------------------
 */

static enum hsr_status use_context(const struct mesa *mesa,
                                   struct hsr_error *err) {
  return OSMesaMakeCurrent(mesa->context, mesa->ids, GL_UNSIGNED_BYTE, mesa->m,
                           mesa->n)
             ? HSR_OK
             : hsr_fail(err, HSR_E_INTERNAL, "llvmpipe: no %d x %d buffer",
                        mesa->m, mesa->n);
}

static enum hsr_status make_context(struct mesa *mesa, struct hsr_error *err) {
  static const int wanted[] = {OSMESA_FORMAT,
                               OSMESA_RGBA,
                               OSMESA_DEPTH_BITS,
                               24,
                               OSMESA_PROFILE,
                               OSMESA_CORE_PROFILE,
                               OSMESA_CONTEXT_MAJOR_VERSION,
                               3,
                               OSMESA_CONTEXT_MINOR_VERSION,
                               3,
                               0};
  if (setenv("LP_NUM_THREADS", "0", 1) ||
      setenv("GALLIUM_DRIVER", "llvmpipe", 1))
    return hsr_fail_nomem(err);
  mesa->context = OSMesaCreateContextAttribs(wanted, NULL);
  if (!mesa->context)
    return hsr_fail(err, HSR_E_INTERNAL, "OSMesa has no OpenGL 3.3");
  enum hsr_status status = use_context(mesa, err);
  if (status)
    return status;
  const char *renderer = (const char *)glGetString(GL_RENDERER);
  return renderer && !strncmp(renderer, "llvmpipe", 8)
             ? HSR_OK
             : hsr_fail(err, HSR_E_INTERNAL, "OSMesa draws by %.60s",
                        renderer ? renderer : "nothing");
}

static void set_modes(const struct hsr_world *world) {
  bool one_sided = true;
  for (uint32_t f = 0; f < world->n_faces; f++)
    one_sided &= world->one_sided[f];
  if (one_sided)
    glEnable(GL_CULL_FACE);
  glFrontFace(GL_CW);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDisable(GL_DITHER);
  glProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
  glClearColor(1, 1, 1, 1); /* HSR_BACKGROUND */
}

static void find_box(struct mesa *mesa, const struct hsr_world *world) {
  const double *const axis[3] = {world->x, world->y, world->z};
  for (int k = 0; k < 3; k++) {
    mesa->low[k] = INFINITY;
    mesa->high[k] = -INFINITY;
    for (uint32_t v = 0; v < world->n_vertices; v++) {
      mesa->low[k] = fmin(mesa->low[k], axis[k][v]);
      mesa->high[k] = fmax(mesa->high[k], axis[k][v]);
    }
  }
}

static enum hsr_status mesa_setup(const struct peer *peer,
                                  const struct hsr_world *world, int m, int n,
                                  uint32_t *ids, void **state,
                                  struct hsr_error *err) {
  struct mesa *mesa = calloc(1, sizeof *mesa);
  *state = mesa;
  if (!mesa)
    return hsr_fail_nomem(err);
  if (world->n_faces > INT32_MAX / 3)
    return hsr_fail(err, HSR_E_NOMEM, "llvmpipe: too many faces");
  mesa->layout = *(const enum layout *)peer->flavour;
  mesa->m = m;
  mesa->n = n;
  mesa->ids = ids;
  mesa->n_faces = world->n_faces;
  find_box(mesa, world);
  enum hsr_status status = make_context(mesa, err);
  if (!status)
    status = make_program(mesa, err);
  if (!status)
    status = make_mesh(mesa->layout, world, err);
  if (!status)
    set_modes(world);
  return status;
}

/* --- Drawing ---------------------------------------------------------------
 */

/* The least and the greatest depth t of the box, both positive. */
static void depth_range(const struct mesa *mesa, const struct hsr_view *view,
                        double *nearest, double *farthest) {
  *nearest = INFINITY;
  *farthest = 0;
  for (int corner = 0; corner < 8; corner++) {
    double t = 0;
    for (int k = 0; k < 3; k++) {
      double at = corner >> k & 1 ? mesa->high[k] : mesa->low[k];
      t += view->screen[2][k] * (at - view->E[k]);
    }
    *nearest = fmin(*nearest, t);
    *farthest = fmax(*farthest, t);
  }
  *farthest = fmax(1.001 * *farthest, 0x1p-100);
  *nearest = fmax(0.999 * *nearest, 0x1p-12 * *farthest);
  *nearest = fmin(fmax(*nearest, view->near), 0.999 * *farthest);
}

/* World to clip coordinates, by columns. */
static void make_matrix(const struct mesa *mesa, const struct hsr_view *view,
                        float matrix[16]) {
  double nearest, farthest;
  depth_range(mesa, view, &nearest, &farthest);
  double row[4][4] = {{0}};
  for (int k = 0; k < 3; k++) {
    double w = view->screen[2][k];
    row[0][k] = 2 * view->screen[0][k] / view->m - w;
    row[1][k] = 2 * view->screen[1][k] / view->n - w;
    row[2][k] = (farthest + nearest) / (farthest - nearest) * w;
    row[3][k] = w;
  }
  row[2][3] = -2 * farthest * nearest / (farthest - nearest);
  for (int r = 0; r < 4; r++) {
    for (int k = 0; k < 3; k++)
      row[r][3] -= row[r][k] * view->E[k];
    for (int k = 0; k < 4; k++)
      matrix[4 * k + r] = (float)row[r][k];
  }
}

static enum hsr_status mesa_draw(void *state, const struct hsr_view *view,
                                 struct hsr_error *err) {
  struct mesa *mesa = state;
  enum hsr_status status = use_context(mesa, err);
  if (status)
    return status;
  float matrix[16];
  make_matrix(mesa, view, matrix);
  glUniformMatrix4fv(mesa->matrix, 1, GL_FALSE, matrix);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  GLsizei n_corners = (GLsizei)(3 * mesa->n_faces);
  if (mesa->layout == INDEXED)
    glDrawElements(GL_TRIANGLES, n_corners, GL_UNSIGNED_INT, NULL);
  else
    glDrawArrays(GL_TRIANGLES, 0, n_corners);
  glFinish();
  return glGetError() == GL_NO_ERROR
             ? HSR_OK
             : hsr_fail(err, HSR_E_INTERNAL, "llvmpipe: drawing failed");
}

static void mesa_release(void *state) {
  struct mesa *mesa = state;
  if (mesa && mesa->context)
    OSMesaDestroyContext(mesa->context);
  free(mesa);
}

static const enum layout indexed = INDEXED, arrays = ARRAYS;

#define LLVMPIPE(name_, layout_)                                               \
  {                                                                            \
    .name = name_, .draws = true, .flavour = layout_, .setup = mesa_setup,     \
    .draw = mesa_draw, .release = mesa_release                                 \
  }
const struct peer peer_llvmpipe_indexed = LLVMPIPE("llvmpipe", &indexed);
const struct peer peer_llvmpipe_arrays = LLVMPIPE("llvmpipe-arrays", &arrays);
