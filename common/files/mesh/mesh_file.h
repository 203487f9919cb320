// SPDX-License-Identifier: GPL-3.0-or-later
// What the importers of mesh files share; only for common/files/mesh and
// common/files/vtk.
//
// CGAL's and VTK's readers trust their input: they allocate what a header
// claims, and some stop at the first thing they do not understand as if the
// file ended there. So a file is read into memory once, its grammar is checked
// from first to last byte (hsr::scan_obj and its like), and only a text that
// passed is given to them. The check of an .off or .ply file, or of a binary .stl
// file, finds all that there is to read, so these are read by it alone. A failure
// is thrown as hsr::Refused and caught in hsr_mesh_read.
#ifndef HSR_COMMON_MESH_FILE_H
#define HSR_COMMON_MESH_FILE_H

#include "common/scene/scene.h"

#include <cstdarg>
#include <cstddef>
#include <memory>
#include <streambuf>
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

/* Of a face. */
constexpr char TWICE[] =
    "has the same vertex twice; --drop-degenerate leaves such faces out";

/* A stream over bytes in memory. */
class Memory_buffer : public std::streambuf {
public:
  Memory_buffer(char *begin, char *end) { setg(begin, begin, end); }

protected:
  pos_type seekoff(off_type offset, std::ios_base::seekdir from,
                   std::ios_base::openmode) override {
    const off_type size = egptr() - eback();
    if (from == std::ios_base::cur)
      offset += gptr() - eback();
    else if (from == std::ios_base::end)
      offset += size;
    if (offset < 0 || offset > size)
      return pos_type(off_type(-1));
    setg(eback(), eback() + offset, egptr());
    return pos_type(offset);
  }
  pos_type seekpos(pos_type position, std::ios_base::openmode which) override {
    return seekoff(off_type(position), std::ios_base::beg, which);
  }
};

/* The mean of the colours of n corners, in rgb; NULL if vertices have none. */
const float *mean_colour(const std::vector<float> &vertex_rgb,
                         const uint32_t *corners, size_t n, float rgb[3]);

/* What a scan found in a file; the reader must find exactly the same. */
struct Mesh_extent {
  size_t n_vertices = 0, n_faces = 0, n_corners = 0;
  std::vector<float> rgb; /* 3 * n_faces, linear; or empty. A face without a
                             colour has NO_COLOUR */
  std::vector<float> vertex_rgb; /* 3 * n_vertices, linear; or empty */
  static constexpr float NO_COLOUR = -1;
  std::vector<std::string> notes; /* what was passed over */
};

/* Each checks a whole file and throws Refused at the first thing that is wrong
 * with it. Correct text that CGAL's or VTK's reader would stumble over
 * (comments, tabs, names, statements it does not know) is blanked, and
 * file.begin may be moved. Faces that are degenerate by their vertex numbers
 * are refused unless `drop`. */
Mesh_extent scan_obj(Mesh_file &file, bool drop);
Mesh_extent scan_stl(Mesh_file &file);
Mesh_extent scan_vtp(Mesh_file &file); /* in a build with VTK */

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
   * else it calls give_faces_again(), as it does if the builder drops() some. */
  uint32_t *triangles(size_t n);
  /* Takes all faces away, and looks at each as if it were given by face(). None
   * has a colour. */
  void give_faces_again();
  bool drops() const { return drop_; }
  /* Takes away all that was given. */
  void forget();
  /* Takes away the colours given so far. No more will be given. */
  void forget_colours();
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

/* Each reads a file of its kind; throws as above. */
void off_read(Mesh_file &file, bool drop, Mesh_builder &builder);
void ply_read(Mesh_file &file, bool drop, Mesh_builder &builder);

/* Reads an .stl file if it is binary; if not, returns false. Corners at the same
 * place are one vertex. Throws as above. */
bool binary_stl_read(Mesh_file &file, Mesh_builder &builder);

/* Reads an .stl file that is a text, if nothing is wrong with it and each facet
 * begins a line (mesh_stl_plain.cc). If not, returns false, and nothing is given.
 * Throws as above. */
bool text_stl_read_plain(const Mesh_file &file, Mesh_builder &builder);

/* Throws what is wrong with an .stl file that is neither binary nor a text. */
[[noreturn]] void refuse_stl(const Mesh_file &file);

/* Reads a .vtp file; throws as above. In common/files/vtk/vtk.cc, or, in a
 * build without VTK, exchange_no_vtk.cc, where it always throws. */
void vtp_read(Mesh_file &file, Mesh_builder &builder);

} // namespace hsr

#endif
