// SPDX-License-Identifier: GPL-3.0-or-later
// What the importers of mesh files share; only for common/files/mesh and
// common/files/vtk.
//
// A file is read into memory once, by one reader for each format, which
// believes nothing: it checks all that it reads, from the first to the last
// byte. A failure is thrown as hsr::Refused and caught in hsr_mesh_read.
#ifndef HSR_COMMON_MESH_FILE_H
#define HSR_COMMON_MESH_FILE_H

#include "common/scene/scene.h"

#include <cstdarg>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace hsr {

struct Refused {
  struct hsr_error error;
};

/* A file's bytes, which may be overwritten. `path` is borrowed. */
struct Mesh_file {
  const char *path;
  std::unique_ptr<char[]> memory;
  char *begin, *end;

  size_t size() const { return static_cast<size_t>(end - begin); }
  /* Throws Refused: "path:line: ...", or "path: ..." if line is 0. */
  [[noreturn]] void refuse(size_t line, const char *format, ...) const
      __attribute__((format(printf, 3, 4)));
};

/* Throws Refused if the file cannot be read, is no regular file, or is empty;
 * std::bad_alloc. */
Mesh_file load_mesh_file(const char *path);

/* The last part of a path that is too long to leave room for a message. */
const char *shown_path(const char *path);

/* At most 24 printable characters of a word, for a message. */
std::string shown_word(std::string_view word);

/* What is wrong with the vertex numbers of a face; NULL: nothing. */
const char *face_fault(const uint32_t *vertices, size_t n);

/* The mean of the colours of n corners, in rgb; NULL if vertices have none. */
const float *mean_colour(const std::vector<float> &vertex_rgb,
                         const uint32_t *corners, size_t n, float rgb[3]);

/* Builds one object and checks what it is given. The vertices of a face come
 * before it. */
class Mesh_builder {
public:
  Mesh_builder(struct hsr_object *object, const char *path, bool drop,
               int threads)
      : object_(object), path_(path), drop_(drop), threads_(threads) {}
  /* By so many a file may be read (common/base/share.h). */
  int threads() const { return threads_; }
  /* Room for so many; the numbers are checked by the caller. */
  void reserve(size_t n_vertices, size_t n_faces);
  void vertex(double x, double y, double z);
  /* Room for n vertices, which are the first; and so many of them are there. */
  double *vertices(size_t n);
  void took_vertices(size_t n) { object_->n_vertices = uint32_t(n); }
  void face(const uint32_t *vertices, size_t n, const float *rgb);
  /* The 3 n corners of n triangles, which are the next faces, without colours.
   * The caller writes them: vertices that are there, three different ones each;
   * else it calls give_faces_again(), as it does if the builder drops()
   * some. */
  uint32_t *triangles(size_t n);
  /* Takes all faces away, and looks at each as if it were given by face(). None
   * has a colour. */
  void give_faces_again();
  bool drops() const { return drop_; }
  /* Takes away all that was given. */
  void forget();
  /* Keeps a line about what was passed over in the file. */
  void note(const std::string &text) { notes_.push_back(text); }
  const std::vector<std::string> &notes() const { return notes_; }
  uint64_t n_dropped() const { return n_dropped_; }
  uint64_t n_given() const { return n_given_; }

private:
  bool usable(const uint32_t *vertices, size_t n) const;

  struct hsr_object *object_;
  const char *path_;
  bool drop_;
  int threads_;
  uint64_t n_given_ = 0, n_dropped_ = 0;
  std::vector<std::string> notes_;
};

/* Each reads a file of its kind, and throws Refused; std::bad_alloc. In a build
 * without VTK, vtp_read refuses all (no_vtk.cc). */
void obj_read(Mesh_file &file, Mesh_builder &builder);
void off_read(Mesh_file &file, Mesh_builder &builder);
void ply_read(Mesh_file &file, Mesh_builder &builder);
void stl_read(Mesh_file &file, Mesh_builder &builder);
void vtp_read(Mesh_file &file, Mesh_builder &builder);

} // namespace hsr

#endif
