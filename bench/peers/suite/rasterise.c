/* SPDX-License-Identifier: GPL-3.0-or-later */
/* rasterise SUITE RESULTS: draws the pictures of a suite by OpenGL, on EGL's
 * surfaceless platform. It knows nothing of hsr but the suite's README.md, and
 * neither includes nor links any of it.
 *
 * Scene       the .glb file: floats, triangles. Materials say which are
 *             one-sided.
 * Depth       24 bits, as most programs have. */
#define GL_GLEXT_PROTOTYPES 1
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <GL/glext.h>
#include <jansson.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static void fail(const char *what, const char *name) {
  fprintf(stderr, "rasterise: %s%s\n", name, what);
  exit(3);
}

/* --- Files ---------------------------------------------------------------- */

static const char *path_in(const char *folder, const char *room,
                           const char *name, const char *suffix) {
  static char path[4096];
  snprintf(path, sizeof path, "%s/%s%s%s", folder, room, name, suffix);
  return path;
}

static unsigned char *read_file(const char *path, size_t *size) {
  FILE *in = fopen(path, "rb");
  if (!in || fseek(in, 0, SEEK_END))
    fail(": cannot be read", path);
  *size = (size_t)ftell(in);
  rewind(in);
  unsigned char *bytes = malloc(*size + 1);
  if (!bytes || fread(bytes, 1, *size, in) != *size)
    fail(": cannot be read", path);
  fclose(in);
  return bytes;
}

static void write_ids(const char *path, const uint32_t *ids, int m, int n) {
  char header[129];
  int used = snprintf(header, sizeof header,
                      "\x93NUMPY\x01%c\x76%c{'descr': '<u4', 'fortran_order': "
                      "False, 'shape': (%d, %d), }",
                      0, 0, n, m);
  memset(header + used, ' ', 127 - (size_t)used);
  header[127] = '\n';
  FILE *out = fopen(path, "wb");
  if (!out)
    fail(": cannot be written", path);
  fwrite(header, 1, 128, out);
  for (int j = n - 1; j >= 0; j--) /* OpenGL's first row is the lowest */
    fwrite(ids + (size_t)j * (size_t)m, 4, (size_t)m, out);
  if (fclose(out))
    fail(": cannot be written", path);
}

/* --- Scenes --------------------------------------------------------------- */

struct vertex {
  float xyz[3];
  uint32_t id;
};

struct scene {
  char name[200];
  struct vertex *vertex[2]; /* of two-sided faces, of one-sided ones */
  GLsizei n[2];
};

static size_t number(const json_t *object, const char *key) {
  return (size_t)json_integer_value(json_object_get(object, key));
}

static const json_t *item(const json_t *all, const char *list, size_t k) {
  return json_array_get(json_object_get(all, list), k);
}

/* The elements of an accessor, which are *n. */
static const void *elements(const json_t *glb, const unsigned char *bin,
                            size_t accessor, size_t *n) {
  const json_t *a = item(glb, "accessors", accessor);
  *n = number(a, "count");
  return bin + number(item(glb, "bufferViews", number(a, "bufferView")),
                      "byteOffset");
}

/* One primitive, whose first triangle has this number. */
static size_t add_primitive(struct scene *scene, const json_t *glb,
                            const unsigned char *bin, const json_t *primitive,
                            const uint32_t *face) {
  size_t n_places, n;
  const float *xyz = elements(
      glb, bin, number(json_object_get(primitive, "attributes"), "POSITION"),
      &n_places);
  const uint32_t *corner = elements(glb, bin, number(primitive, "indices"), &n);
  const int side = !json_is_true(json_object_get(
      item(glb, "materials", number(primitive, "material")), "doubleSided"));
  const size_t old = (size_t)scene->n[side];
  scene->vertex[side] =
      realloc(scene->vertex[side], (old + n) * sizeof(struct vertex));
  if (!scene->vertex[side])
    fail("out of memory", "");
  for (size_t k = 0; k < n; k++) {
    struct vertex *v = &scene->vertex[side][old + k];
    if (corner[k] >= n_places)
      fail(": names a vertex that is not there", scene->name);
    memcpy(v->xyz, xyz + 3 * corner[k], sizeof v->xyz);
    v->id = face[k / 3];
  }
  scene->n[side] += (GLsizei)n;
  return n / 3;
}

static void read_scene(const char *suite, const char *name,
                       struct scene *scene) {
  size_t size, k, p, n = 0;
  const json_t *node, *primitive;
  for (int side = 0; side < 2; side++)
    free(scene->vertex[side]);
  memset(scene, 0, sizeof *scene);
  snprintf(scene->name, sizeof scene->name, "%s", name);
  unsigned char *table =
      read_file(path_in(suite, "scenes/", name, ".triangles.npy"), &size);
  const uint32_t *face =
      (const uint32_t *)(const void *)(table + 10 + table[8] + 256 * table[9]);
  unsigned char *file =
      read_file(path_in(suite, "scenes/", name, ".glb"), &size);
  uint32_t length;
  memcpy(&length, file + 12, sizeof length);
  json_t *glb = json_loadb((const char *)file + 20, length, 0, NULL);
  if (!glb)
    fail(".glb: is no JSON", name);
  json_array_foreach(json_object_get(glb, "nodes"), k, node) {
    if (!json_object_get(node, "mesh"))
      continue; /* a camera */
    const json_t *list = json_object_get(
        item(glb, "meshes", number(node, "mesh")), "primitives");
    json_array_foreach(list, p, primitive) n +=
        add_primitive(scene, glb, file + 28 + length, primitive, face + n);
  }
  json_decref(glb);
  free(file);
  free(table);
}

/* --- OpenGL --------------------------------------------------------------- */

static void make_context(void) {
  static const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION, 3,
                                  EGL_CONTEXT_MINOR_VERSION, 3, EGL_NONE};
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 0);
  setenv("EGL_LOG_LEVEL", "fatal", 0);
  EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA,
                                             EGL_DEFAULT_DISPLAY, NULL);
  if (!eglInitialize(display, NULL, NULL) || !eglBindAPI(EGL_OPENGL_API))
    fail("EGL has no display without a surface", "");
  EGLContext context =
      eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
  if (!context ||
      !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
    fail("EGL makes no context of OpenGL 3.3", "");
}

static GLuint shader(GLenum kind, const char *text) {
  GLuint made = glCreateShader(kind);
  glShaderSource(made, 1, &text, NULL);
  glCompileShader(made);
  return made;
}

static GLint make_program(void) {
  GLuint program = glCreateProgram(), array, buffer;
  glAttachShader(program, shader(GL_VERTEX_SHADER,
                                 "#version 330 core\n"
                                 "layout(location = 0) in vec3 position;\n"
                                 "layout(location = 1) in uint face;\n"
                                 "uniform mat4 matrix;\n"
                                 "flat out uint id;\n"
                                 "void main() {\n"
                                 "  gl_Position = matrix * vec4(position, 1);\n"
                                 "  id = face;\n"
                                 "}\n"));
  glAttachShader(program,
                 shader(GL_FRAGMENT_SHADER, "#version 330 core\n"
                                            "flat in uint id;\n"
                                            "out uint shown;\n"
                                            "void main() { shown = id; }\n"));
  glLinkProgram(program);
  GLint linked;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  if (!linked)
    fail("the shaders do not link", "");
  glUseProgram(program);
  glGenVertexArrays(1, &array);
  glBindVertexArray(array);
  glGenBuffers(1, &buffer);
  glBindBuffer(GL_ARRAY_BUFFER, buffer);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(struct vertex), NULL);
  glVertexAttribIPointer(1, 1, GL_UNSIGNED_INT, sizeof(struct vertex),
                         (const void *)offsetof(struct vertex, id));
  glEnableVertexAttribArray(0);
  glEnableVertexAttribArray(1);
  glEnable(GL_DEPTH_TEST);
  return glGetUniformLocation(program, "matrix");
}

static void make_raster(int m, int n) {
  static GLuint frame, buffer[2];
  static const GLenum format[2] = {GL_R32UI, GL_DEPTH_COMPONENT24},
                      place[2] = {GL_COLOR_ATTACHMENT0, GL_DEPTH_ATTACHMENT};
  if (!frame) {
    glGenFramebuffers(1, &frame);
    glGenRenderbuffers(2, buffer);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, frame);
  for (int k = 0; k < 2; k++) {
    glBindRenderbuffer(GL_RENDERBUFFER, buffer[k]);
    glRenderbufferStorage(GL_RENDERBUFFER, format[k], m, n);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, place[k], GL_RENDERBUFFER,
                              buffer[k]);
  }
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    fail("there is no such raster", "");
  glViewport(0, 0, m, n);
}

static void draw_case(const struct scene *scene, const json_t *case_,
                      GLint place, const char *results) {
  const int m = (int)number(case_, "width"), n = (int)number(case_, "height");
  const GLuint nothing[4] = {UINT32_MAX, UINT32_MAX, UINT32_MAX, UINT32_MAX};
  const json_t *matrix =
      json_object_get(json_object_get(case_, "opengl"), "matrix");
  float rounded[16];
  for (size_t k = 0; k < 16; k++)
    rounded[k] = (float)json_number_value(json_array_get(matrix, k));
  make_raster(m, n);
  glUniformMatrix4fv(place, 1, GL_FALSE, rounded);
  glClearBufferuiv(GL_COLOR, 0, nothing);
  glClear(GL_DEPTH_BUFFER_BIT);
  for (int side = 0; side < 2; side++) {
    if (side)
      glEnable(GL_CULL_FACE);
    else
      glDisable(GL_CULL_FACE);
    glBufferData(GL_ARRAY_BUFFER,
                 (GLsizeiptr)((size_t)scene->n[side] * sizeof(struct vertex)),
                 scene->vertex[side], GL_STREAM_DRAW);
    glDrawArrays(GL_TRIANGLES, 0, scene->n[side]);
  }
  uint32_t *ids = malloc((size_t)m * (size_t)n * sizeof *ids);
  if (!ids)
    fail("out of memory", "");
  glReadPixels(0, 0, m, n, GL_RED_INTEGER, GL_UNSIGNED_INT, ids);
  if (glGetError() != GL_NO_ERROR)
    fail("drawing failed", "");
  write_ids(path_in(results, "",
                    json_string_value(json_object_get(case_, "name")), ".npy"),
            ids, m, n);
  free(ids);
}

int main(int argc, char **argv) {
  if (argc != 3)
    fail("usage: rasterise SUITE RESULTS", "");
  json_t *all = json_load_file(path_in(argv[1], "", "cases", ".json"), 0, NULL);
  if (!all)
    fail("/cases.json: cannot be read", argv[1]);
  mkdir(argv[2], 0777);
  make_context();
  const GLint place = make_program();
  struct scene scene = {.name = ""};
  const json_t *case_;
  size_t k;
  json_array_foreach(json_object_get(all, "cases"), k, case_) {
    const char *name = json_string_value(json_object_get(case_, "scene"));
    if (strcmp(name, scene.name))
      read_scene(argv[1], name, &scene);
    draw_case(&scene, case_, place, argv[2]);
  }
  for (int side = 0; side < 2; side++)
    free(scene.vertex[side]);
  json_decref(all);
  return 0;
}
