// SPDX-License-Identifier: GPL-3.0-or-later
// Code that the importers of mesh files share; only for common/files/mesh,
// formats, gltf and vtk.
//
// A file is read into memory once. Each format has one reader, which checks
// every byte that it reads. A failure is thrown as hsr::Refused and caught in
// hsr_mesh_read.
#ifndef HSR_COMMON_MESH_FILE_H
#define HSR_COMMON_MESH_FILE_H

#include "common/scene/flat.h"
#include "common/scene/scene.h"

#include <array>
#include <cstdarg>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace hsr {

/* Thrown for a file that cannot be used. */
struct Refused {
  struct hsr_error error;
};

/* The bytes of a file, which may be overwritten. `path` is borrowed. */
struct Mesh_file {
  const char *path;
  std::unique_ptr<char[]> memory;
  char *begin, *end; /* the bytes, in `memory` */

  size_t size() const { return static_cast<size_t>(end - begin); }
  /* Throws Refused with HSR_E_INPUT: "path:line: ...", or "path: ..." if line
   * is 0. */
  [[noreturn]] void refuse(size_t line, const char *format, ...) const
      __attribute__((format(printf, 3, 4)));
};

/* Reads a file, and inflates it if it is compressed by gzip. Throws Refused if it
 * cannot be read, is not a regular file, is empty or damaged; std::bad_alloc. */
Mesh_file load_mesh_file(const char *path);

/* Returns the path as messages show it: all of it, or its last part if it is
 * too long. The result is a part of `path`. */
const char *shown_path(const char *path);

/* Returns at most 24 printable characters of a word, for a message. */
std::string shown_word(std::string_view word);

/* Returns what is wrong with the n vertex numbers of a face, for a strict
 * reader: they are fewer than 3, or one follows itself. NULL: nothing. */
const char *face_fault(const uint32_t *vertices, size_t n);

/* A colour, linear, and an opacity, all 0..1. */
using Rgba = std::array<float, 4>;

/* The opacity of a colour that is none, or, while it is encoded as in its file,
 * that has no opacity there. */
constexpr float NO_OPACITY = -1;

/* Named groups of the faces of a mesh: group g has the faces from first[g] to
 * first[g + 1] or, if it is the last one, to the end. */
struct Groups {
  std::vector<std::string> name;
  std::vector<uint32_t> first;
};

/* Builds one object and checks what it is given. The vertices of a face must be
 * given before the face. Functions throw Refused and std::bad_alloc. */
class Mesh_builder {
public:
  /* `object`, which is empty, and `path` are borrowed. `strict`: faces without
   * area are refused, not left out. */
  Mesh_builder(struct hsr_object *object, const char *path, bool strict,
               int threads)
      : object_(object), path_(path), strict_(strict), threads_(threads) {}
  /* The name of the object. */
  std::string name() const { return object_->name; }
  /* How many threads may read the file (common/base/share.h). */
  int threads() const { return threads_; }
  /* Makes room. The caller has checked that the file can hold so many. */
  void reserve(size_t n_vertices, size_t n_faces);
  /* Appends a vertex. Its coordinates may be anything until settle_unused(). */
  void vertex(double x, double y, double z);
  /* Returns room for the first n vertices, three numbers each, for the caller
   * to fill. Then took_vertices() says how many of them there are. */
  double *vertices(size_t n);
  void took_vertices(size_t n) { object_->n_vertices = uint32_t(n); }
  /* Appends a face of n vertices. rgb is its colour, or NULL. */
  void face(const uint32_t *vertices, size_t n, const float *rgb);
  /* The same, with a colour and an opacity, or with NULL. */
  void face(const uint32_t *vertices, size_t n, const Rgba *look) {
    face(vertices, n, look ? look->data() : nullptr);
    if (look)
      opacity((*look)[3]);
  }
  void face(const uint32_t *vertices, size_t n) {
    face(vertices, n, static_cast<const float *>(nullptr));
  }
  /* Gives the face that was given last an opacity of its own, 0..1, unless it
   * was left out. */
  void opacity(float opacity);
  /* The faces that follow are of a group with this name. A file without groups
   * is one object; else all its faces are in a group. */
  void group(const std::string &name);
  const Groups &groups() const { return groups_; }
  /* The colour and opacity of all faces that have none of their own. */
  void set_look(const float rgb[3], float opacity);
  /* Appends n triangles without colours, and returns the room for their 3 n
   * corners. The caller fills it with numbers of vertices. If a triangle does
   * not have three different vertices that are there, it then calls
   * give_faces_again(). */
  uint32_t *triangles(size_t n);
  /* Removes all faces, which have no colours, and gives each of them to face(),
   * with its own of `looks`; or with none, if that is NULL or has NO_OPACITY. */
  void give_faces_again(const std::vector<Rgba> *looks = nullptr);
  bool strict() const { return strict_; }
  /* What the file says of its faces: all are seen from their front alone, or
   * from both sides. Otherwise the mesh is looked at. */
  void set_one_sided(bool one_sided) {
    says_sides_ = true;
    one_sided_ = one_sided;
  }
  bool says_sides() const { return says_sides_; }
  bool one_sided() const { return one_sided_; }
  /* Leaves out the faces without area that are still there, unless it is
   * strict. */
  void leave_out_flat();
  /* Passes over vertices that are not finite, if no face uses them. */
  void settle_unused();
  /* Joins vertices that are no farther from one another than this (mesh_weld.cc),
   * and notes how many. */
  void weld(double distance);
  /* Removes everything that was given. */
  void forget();
  /* Adds a line about something in the file that was ignored. */
  void note(const std::string &text) { notes_.push_back(text); }
  const std::vector<std::string> &notes() const { return notes_; }
  /* The numbers of faces that were left out, and that were given in all. */
  uint64_t n_dropped() const { return n_dropped_; }
  uint64_t n_given() const { return n_given_; }

private:
  void give(uint64_t number, const uint32_t *vertices, size_t n,
            const float *rgb);

  struct hsr_object *object_;
  const char *path_;
  bool strict_, says_sides_ = false, one_sided_ = false;
  int threads_;
  uint64_t n_given_ = 0, n_dropped_ = 0;
  bool is_last_there_ = false; /* the face that was given last */
  std::vector<uint32_t> ring_; /* of a face, without repeats */
  struct hsr_face_marks marks() {
    return {groups_.first.data(), groups_.first.size()};
  }

  Groups groups_;
  std::vector<std::string> notes_;
};

/* The readers, one for each format. They throw Refused and std::bad_alloc. In a
 * build without VTK, vtp_read refuses every file (no_vtk.cc). */
void obj_read(Mesh_file &file, Mesh_builder &builder);
void off_read(Mesh_file &file, Mesh_builder &builder);
void ply_read(Mesh_file &file, Mesh_builder &builder);
void stl_read(Mesh_file &file, Mesh_builder &builder);
void vtp_read(Mesh_file &file, Mesh_builder &builder);

} // namespace hsr

#endif
