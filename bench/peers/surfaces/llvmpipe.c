/* SPDX-License-Identifier: GPL-3.0-or-later */
/* llvmpipe, Mesa's software renderer, driven as well as we know how.
 *
 * Ids             Four bytes of a vertex, which the shaders pass on as a flat
 *                 colour. gl_PrimitiveID would need no copies of vertices, but
 *                 makes llvmpipe assemble every primitive anew, which takes
 *                 half as long again.
 * Vertices        Two layouts, as neither is the faster one for all scenes.
 *                 Indexed: each triangle has a provoking vertex of its own, the
 *                 corner that it starts from; other triangles share it as one
 *                 of their further corners. Arrays: three vertices a triangle.
 * Sides           One-sided faces come first and are culled; the others are
 *                 not.
 * Depth           24 bits, between the nearest and the farthest corner of the
 *                 world's box; see box_depths if the eye is inside it.
 * Time            Includes the copy of the pixels to memory. */
#define GL_GLEXT_PROTOTYPES 1
#include "bench/peers/shared/offscreen.h"
#include "bench/peers/shared/peers.h"
#include "bench/peers/shared/projection.h"

#include <GL/gl.h>
#include <GL/glext.h>
#include <stdlib.h>
#include <string.h>

enum layout { INDEXED, ARRAYS };

struct llvmpipe {
  struct offscreen offscreen;
  enum layout layout;
  GLint matrix; /* uniform's place */
  struct box box;
  GLsizei n_one_sided, n_corners; /* corners: of one-sided faces, of all */
  uint32_t *ids;
};

/* --- Vertices and triangles ----------------------------------------------- */

struct vertex {
  float xyz[3];
  uint32_t id; /* of the face that starts here */
};

struct mesh {
  struct vertex *vertex;
  uint32_t n_vertices;
  uint32_t *corner; /* three a triangle; NULL: the vertices in order */
  uint32_t *order;  /* the triangles, one-sided ones first */
};

static uint32_t order_faces(const struct hsr_world *world, uint32_t *order) {
  uint32_t n = 0, n_one_sided = 0;
  for (int pass = 0; pass < 2; pass++) {
    for (uint32_t f = 0; f < world->n_faces; f++)
      if (world->mesh.one_sided[f] == !pass)
        order[n++] = f;
    n_one_sided = pass ? n_one_sided : n;
  }
  return n_one_sided;
}

static void put_vertex(struct mesh *mesh, const struct hsr_world *world,
                       uint32_t v, uint32_t f) {
  mesh->vertex[mesh->n_vertices++] =
      (struct vertex){.xyz = {(float)world->mesh.x[v], (float)world->mesh.y[v],
                              (float)world->mesh.z[v]},
                      .id = hsr_world_parent(world, f)};
}

static void lay_out_arrays(struct mesh *mesh, const struct hsr_world *world) {
  for (uint32_t n = 0; n < world->n_faces; n++)
    for (uint32_t k = 0, f = mesh->order[n]; k < 3; k++)
      put_vertex(mesh, world, world->mesh.vertex[world->mesh.start[f] + k], f);
}

/* Turns face f so that it starts from a vertex that has no copy yet, if it has
 * one. Then fewer vertices need a copy of their own. */
static void turn_face(const struct hsr_world *world, uint32_t f,
                      const uint32_t *copy, uint32_t *corner) {
  const uint32_t *vertex = world->mesh.vertex + world->mesh.start[f];
  int first = 0;
  while (first < 3 && copy[vertex[first]] != HSR_BACKGROUND)
    first++;
  for (int k = 0; k < 3; k++)
    corner[k] = vertex[(first + k) % 3];
}

/* copy[v] becomes one of the copies of vertex v. */
static void lay_out_indexed(struct mesh *mesh, const struct hsr_world *world,
                            uint32_t *copy) {
  memset(copy, 0xff, world->mesh.n_vertices * sizeof *copy);
  for (uint32_t n = 0; n < world->n_faces; n++) {
    uint32_t *corner = mesh->corner + 3 * (size_t)n;
    turn_face(world, mesh->order[n], copy, corner);
    copy[corner[0]] = n;
    put_vertex(mesh, world, corner[0], mesh->order[n]);
  }
  for (uint32_t n = 0; n < world->n_faces; n++) {
    uint32_t *corner = mesh->corner + 3 * (size_t)n;
    corner[0] = n;
    for (int k = 1; k < 3; k++) {
      if (copy[corner[k]] == HSR_BACKGROUND) {
        copy[corner[k]] = mesh->n_vertices;
        put_vertex(mesh, world, corner[k], mesh->order[n]);
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
               (GLsizeiptr)(mesh->n_vertices * sizeof *mesh->vertex),
               mesh->vertex, GL_STATIC_DRAW);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof *mesh->vertex, NULL);
  glVertexAttribPointer(1, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof *mesh->vertex,
                        (const void *)offsetof(struct vertex, id));
  glEnableVertexAttribArray(0);
  glEnableVertexAttribArray(1);
  if (!mesh->corner)
    return;
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer[1]);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER,
               (GLsizeiptr)(n_corners * sizeof *mesh->corner), mesh->corner,
               GL_STATIC_DRAW);
}

static enum hsr_status make_mesh(struct llvmpipe *llvmpipe,
                                 const struct hsr_world *world,
                                 struct hsr_error *err) {
  size_t most = (size_t)world->mesh.n_corners + world->mesh.n_vertices;
  struct mesh mesh = {.vertex = malloc(most * sizeof *mesh.vertex),
                      .order = malloc(world->n_faces * sizeof *mesh.order)};
  uint32_t *copy = malloc(world->mesh.n_vertices * sizeof *copy);
  if (llvmpipe->layout == INDEXED)
    mesh.corner = malloc(world->mesh.n_corners * sizeof *mesh.corner);
  enum hsr_status status = HSR_OK;
  if (!mesh.vertex || !mesh.order || !copy ||
      (llvmpipe->layout == INDEXED && !mesh.corner)) {
    status = hsr_fail_nomem(err);
  } else {
    llvmpipe->n_one_sided = (GLsizei)(3 * order_faces(world, mesh.order));
    llvmpipe->n_corners = (GLsizei)world->mesh.n_corners;
    if (llvmpipe->layout == INDEXED)
      lay_out_indexed(&mesh, world, copy);
    else
      lay_out_arrays(&mesh, world);
    send_mesh(&mesh, world->mesh.n_corners);
  }
  free(mesh.vertex);
  free(mesh.corner);
  free(mesh.order);
  free(copy);
  return status;
}

/* --- Shaders -------------------------------------------------------------- */

static GLuint shader(GLenum kind, const char *text) {
  GLuint made = glCreateShader(kind);
  glShaderSource(made, 1, &text, NULL);
  glCompileShader(made);
  return made;
}

static enum hsr_status make_program(struct llvmpipe *llvmpipe,
                                    struct hsr_error *err) {
  static const char vertex_text[] =
      "#version 330 core\n"
      "layout(location = 0) in vec3 position;\n"
      "layout(location = 1) in vec4 bytes;\n"
      "uniform mat4 matrix;\n"
      "flat out vec4 id;\n"
      "void main() {\n"
      "  gl_Position = matrix * vec4(position, 1);\n"
      "  id = bytes;\n"
      "}\n";
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
  llvmpipe->matrix = glGetUniformLocation(program, "matrix");
  return HSR_OK;
}

/* --- Setting up ----------------------------------------------------------- */

static void set_modes(void) {
  glFrontFace(GL_CW);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDisable(GL_DITHER);
  glProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
  glClearColor(1, 1, 1, 1); /* HSR_BACKGROUND */
}

static enum hsr_status llvmpipe_setup(const struct peer *peer,
                                      const struct peer_canvas *canvas,
                                      void **state, struct hsr_error *err) {
  struct llvmpipe *llvmpipe = calloc(1, sizeof *llvmpipe);
  *state = llvmpipe;
  if (!llvmpipe)
    return hsr_fail_nomem(err);
  const struct hsr_world *world = canvas->setup->world;
  if (world->n_faces > INT32_MAX / 3)
    return hsr_fail(err, HSR_E_REFUSED, "llvmpipe: too many faces");
  llvmpipe->layout = *(const enum layout *)peer->flavour;
  llvmpipe->ids = canvas->ids;
  llvmpipe->box = box_of_world(world);
  enum hsr_status status =
      offscreen_open(&llvmpipe->offscreen, false, canvas->threads, err);
  if (!status)
    status = offscreen_raster(canvas->m, canvas->n, err);
  if (!status)
    status = make_program(llvmpipe, err);
  if (!status)
    status = make_mesh(llvmpipe, world, err);
  if (!status)
    set_modes();
  return status;
}

/* --- Drawing -------------------------------------------------------------- */

static void set_matrix(const struct llvmpipe *llvmpipe,
                       const struct hsr_view *view) {
  double nearest, farthest, matrix[16];
  box_depths(&llvmpipe->box, view, &nearest, &farthest);
  clip_matrix(view, nearest, farthest, matrix);
  float rounded[16];
  for (int k = 0; k < 16; k++)
    rounded[k] = (float)matrix[k];
  glUniformMatrix4fv(llvmpipe->matrix, 1, GL_FALSE, rounded);
}

/* Draws the triangles whose corners are [from, to). */
static void draw_triangles(const struct llvmpipe *llvmpipe, GLsizei from,
                           GLsizei to) {
  if (from == to)
    return;
  if (llvmpipe->layout == INDEXED)
    glDrawElements(GL_TRIANGLES, to - from, GL_UNSIGNED_INT,
                   (const void *)(sizeof(uint32_t) * (size_t)from));
  else
    glDrawArrays(GL_TRIANGLES, from, to - from);
}

static enum hsr_status llvmpipe_draw(void *state, const struct hsr_view *view,
                                     struct hsr_error *err) {
  struct llvmpipe *llvmpipe = state;
  set_matrix(llvmpipe, view);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glEnable(GL_CULL_FACE);
  draw_triangles(llvmpipe, 0, llvmpipe->n_one_sided);
  glDisable(GL_CULL_FACE);
  draw_triangles(llvmpipe, llvmpipe->n_one_sided, llvmpipe->n_corners);
  glReadPixels(0, 0, view->m, view->n, GL_RGBA, GL_UNSIGNED_BYTE,
               llvmpipe->ids);
  return glGetError() == GL_NO_ERROR
             ? HSR_OK
             : hsr_fail(err, HSR_E_INTERNAL, "llvmpipe: drawing failed");
}

static void llvmpipe_release(void *state) {
  struct llvmpipe *llvmpipe = state;
  if (llvmpipe)
    offscreen_close(&llvmpipe->offscreen);
  free(llvmpipe);
}

/* --- The peers ------------------------------------------------------------ */

static void llvmpipe_version(char *text) {
  offscreen_version(text, PEER_VERSION);
}

static const enum layout indexed = INDEXED, arrays = ARRAYS;

#define LLVMPIPE(name_, title_, layout_, what_)                                \
  {                                                                            \
    .name = name_, .title = title_,                                            \
    .source = "Mesa 3D, src/gallium/drivers/llvmpipe",                         \
    .what = what_                                                              \
        " A frame clears, draws all triangles with a z-buffer of 24 bits and " \
        "copies the pixels, which are ids, to memory. Set-up, which is not "   \
        "part of a frame, makes the context and the shaders and brings the "   \
        "vertices, as floats, to buffers.",                                    \
    .kind = "ids", .many_threads = true, .flavour = layout_,                   \
    .demands = &takes_triangles, .version = llvmpipe_version,                  \
    .setup = llvmpipe_setup, .draw = llvmpipe_draw,                            \
    .release = llvmpipe_release                                                \
  }
const struct peer peer_llvmpipe =
    LLVMPIPE("llvmpipe", "OpenGL by Mesa's llvmpipe, indexed vertices",
             &indexed, "OpenGL in software, vertices shared by triangles.");
const struct peer peer_llvmpipe_arrays =
    LLVMPIPE("llvmpipe-arrays", "OpenGL by Mesa's llvmpipe, arrays of vertices",
             &arrays, "OpenGL in software, three vertices a triangle.");
