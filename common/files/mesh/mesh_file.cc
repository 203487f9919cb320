// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/files/mesh/mesh_file.h"
#include "common/base/arena.h"
#include "common/scene/flat.h"
#include "common/scene/unused.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

namespace hsr {

const char *shown_path(const char *path) {
  const size_t most = 256, length = std::strlen(path);
  return length > most ? path + (length - most) : path;
}

std::string shown_word(std::string_view word) {
  const size_t most = 24;
  std::string shown(word.substr(0, most));
  for (char &c : shown)
    if (c < 0x20 || c > 0x7e)
      c = '?';
  return word.size() > most ? shown + "..." : shown;
}

void Mesh_file::refuse(size_t line, const char *format, ...) const {
  char what[200];
  va_list args;
  va_start(args, format);
  std::vsnprintf(what, sizeof what, format, args);
  va_end(args);
  Refused refused;
  if (line)
    hsr_fail(&refused.error, HSR_E_INPUT, "%s:%zu: %s", shown_path(path), line,
             what);
  else
    hsr_fail(&refused.error, HSR_E_INPUT, "%s: %s", shown_path(path), what);
  throw refused;
}

namespace {

class Descriptor {
public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0)
      close(fd_);
  }
  Descriptor(const Descriptor &) = delete;
  Descriptor &operator=(const Descriptor &) = delete;
  int fd() const { return fd_; }

private:
  int fd_;
};

/* Throws for what a failed system call left in errno. */
[[noreturn]] void refuse_errno(const Mesh_file &file) {
  const int reason = errno;
  if (reason == ENOMEM)
    throw std::bad_alloc();
  file.refuse(0, "cannot be read: %s",
              std::generic_category().message(reason).c_str());
}

/* ---- Compressed files ---- */

bool is_compressed(const Mesh_file &file) {
  return file.size() > 2 && file.begin[0] == '\x1f' && file.begin[1] == '\x8b';
}

/* Room that grows, for bytes that are not counted yet. */
struct Room {
  std::unique_ptr<char[]> bytes;
  size_t used = 0, size = 0;

  void grow(size_t least) {
    const size_t larger = std::max(2 * size, least);
    std::unique_ptr<char[]> moved(new char[larger]);
    std::copy_n(bytes.get(), used, moved.get());
    bytes = std::move(moved);
    size = larger;
  }
};

/* Inflates one member of a file after the other, from file.begin on. */
class Inflater {
public:
  explicit Inflater(Mesh_file &file) : file_(file) {
    constexpr int GZIP = 16 + 15; /* its header, and the largest window */
    if (inflateInit2(&stream_, GZIP) != Z_OK)
      throw std::bad_alloc();
    stream_.next_in = reinterpret_cast<unsigned char *>(file.begin);
  }
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(const Inflater &) = delete;
  Inflater &operator=(const Inflater &) = delete;
  void member();
  void deliver();

private:
  size_t left() const {
    return static_cast<size_t>(file_.end -
                               reinterpret_cast<const char *>(stream_.next_in));
  }

  Mesh_file &file_;
  z_stream stream_{};
  Room room_;
};

void Inflater::member() {
  constexpr size_t MOST = size_t{1} << 30; /* at a time */
  int result = inflateReset(&stream_);
  while (result != Z_STREAM_END) {
    if (room_.used == room_.size)
      room_.grow(4 * left() + 1);
    const size_t in = std::min(left(), MOST),
                 out = std::min(room_.size - room_.used, MOST);
    stream_.next_out =
        reinterpret_cast<unsigned char *>(room_.bytes.get() + room_.used);
    stream_.avail_in = static_cast<unsigned>(in);
    stream_.avail_out = static_cast<unsigned>(out);
    result = inflate(&stream_, Z_NO_FLUSH);
    room_.used += out - stream_.avail_out;
    if (result == Z_MEM_ERROR)
      throw std::bad_alloc();
    if (result == Z_BUF_ERROR ||
        (result == Z_OK && !left() && stream_.avail_out))
      file_.refuse(0, "the compressed file ends too early");
    if (result != Z_OK && result != Z_STREAM_END)
      file_.refuse(0, "is not a good gzip file: %s",
                   stream_.msg ? stream_.msg : "its data are damaged");
  }
}

void Inflater::deliver() {
  do
    member();
  while (left());
  file_.memory = std::move(room_.bytes);
  file_.begin = file_.memory.get();
  file_.end = file_.begin + room_.used;
}

} // namespace

/* Makes a compressed file what was compressed. */
static void inflate_file(Mesh_file &file) {
  if (!is_compressed(file))
    return;
  Inflater(file).deliver();
  if (file.begin == file.end)
    file.refuse(0, "is empty");
}

Mesh_file load_mesh_file(const char *path) {
  Mesh_file file{path, nullptr, nullptr, nullptr};
  /* Opening a pipe must not wait for its other end. */
  const Descriptor descriptor(open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat status;
  if (descriptor.fd() < 0 || fstat(descriptor.fd(), &status))
    refuse_errno(file);
  if (S_ISDIR(status.st_mode))
    file.refuse(0, "is a directory");
  if (!S_ISREG(status.st_mode))
    file.refuse(0, "is not a regular file");

  const size_t size = static_cast<size_t>(status.st_size);
  file.memory.reset(new char[size]);
  hsr_huge_pages(file.memory.get(), size);
  file.begin = file.end = file.memory.get();
  while (file.size() < size) {
    const ssize_t n = read(descriptor.fd(), file.end, size - file.size());
    if (n < 0 && errno == EINTR)
      continue;
    if (n < 0)
      refuse_errno(file);
    if (n == 0)
      break;
    file.end += n;
  }
  if (file.begin == file.end)
    file.refuse(0, "is empty");
  inflate_file(file);
  return file;
}

namespace {

[[noreturn]] void refuse_element(const char *path, const char *kind,
                                 uint64_t number, const char *what) {
  Refused refused;
  hsr_fail(&refused.error, HSR_E_INPUT, "%s: %s %llu %s", shown_path(path),
           kind, static_cast<unsigned long long>(number), what);
  throw refused;
}

} // namespace

const char *face_fault(const uint32_t *vertices, size_t n) {
  if (n < 3)
    return "has fewer than 3 vertices";
  const bool twice = vertices[0] == vertices[n - 1] ||
                     std::adjacent_find(vertices, vertices + n) != vertices + n;
  return twice ? "has the same vertex twice" : nullptr;
}

void Mesh_builder::reserve(size_t n_vertices, size_t n_faces) {
  if (n_vertices >= UINT32_MAX || n_faces >= UINT32_MAX)
    return; /* hsr_object_vertex and hsr_object_face say so */
  if (hsr_object_reserve(object_, static_cast<uint32_t>(n_vertices),
                         static_cast<uint32_t>(n_faces)))
    throw std::bad_alloc();
}

double *Mesh_builder::vertices(size_t n) {
  reserve(n, 0);
  return object_->xyz;
}

uint32_t *Mesh_builder::triangles(size_t n) {
  uint32_t *corners =
      n < UINT32_MAX ? hsr_object_triangles(object_, uint32_t(n)) : nullptr;
  if (!corners)
    throw std::bad_alloc();
  n_given_ += n;
  return corners;
}

void Mesh_builder::give_faces_again(const std::vector<Rgba> *looks) {
  const uint32_t n = object_->n_faces, *const start = object_->start;
  const std::vector<uint32_t> starts(start, start + n + 1);
  const std::vector<uint32_t> corners(object_->vertex,
                                      object_->vertex + start[n]);
  object_->n_faces = 0;
  n_given_ = 0;
  for (uint32_t f = 0; f < n; f++)
    face(corners.data() + starts[f], starts[f + 1] - starts[f],
         looks && (*looks)[f][3] != NO_OPACITY ? &(*looks)[f] : nullptr);
}

void Mesh_builder::forget() {
  object_->n_vertices = object_->n_faces = 0;
  n_given_ = n_dropped_ = 0;
}

void Mesh_builder::vertex(double x, double y, double z) {
  switch (hsr_object_vertex(object_, 0, 0, 0, nullptr)) {
  case HSR_OK:
    std::copy_n(std::array<double, 3>{x, y, z}.begin(), 3,
                object_->xyz + 3 * size_t{object_->n_vertices - 1});
    return;
  case HSR_E_NOMEM:
    throw std::bad_alloc();
  default:
    refuse_element(path_, "vertex", object_->n_vertices,
                   "is one more than an object can hold");
  }
}

/* Appends a face, or says what is wrong with it. */
void Mesh_builder::give(uint64_t number, const uint32_t *vertices, size_t n,
                        const float *rgb) {
  switch (hsr_object_face(object_, vertices, n, rgb)) {
  case HSR_OK:
    return;
  case HSR_E_NOMEM:
    throw std::bad_alloc();
  default:
    break;
  }
  for (size_t i = 0; i < n; i++)
    if (vertices[i] >= object_->n_vertices)
      refuse_element(path_, "face", number, "names a vertex that is not there");
  const char *fault = face_fault(vertices, n);
  if (!fault)
    refuse_element(path_, "face", number, "is one more than can be held");
  if (strict_)
    refuse_element(path_, "face", number, fault);
  n_dropped_++; /* two corners are left, or one */
}

void Mesh_builder::face(const uint32_t *vertices, size_t n, const float *rgb) {
  const uint64_t number = n_given_++;
  const uint32_t n_before = object_->n_faces;
  if (strict_ || (n && vertices[0] != vertices[n - 1] &&
                  std::adjacent_find(vertices, vertices + n) == vertices + n)) {
    give(number, vertices, n, rgb);
  } else {
    ring_.assign(vertices, vertices + n);
    give(number, ring_.data(), hsr_ring_tidy(ring_.data(), n), rgb);
  }
  is_last_there_ = object_->n_faces > n_before;
}

void Mesh_builder::opacity(float opacity) {
  if (is_last_there_ &&
      hsr_object_set_opacity(object_, object_->n_faces - 1, opacity))
    throw std::bad_alloc();
}

void Mesh_builder::group(const std::string &name) {
  const bool is_empty =
      !groups_.first.empty() && groups_.first.back() == object_->n_faces;
  if (is_empty) {
    groups_.name.back() = name;
    return;
  }
  groups_.name.push_back(name);
  groups_.first.push_back(object_->n_faces);
}

void Mesh_builder::set_look(const float rgb[3], float opacity) {
  std::copy_n(rgb, 3, object_->colour);
  object_->opacity = opacity;
}

void Mesh_builder::settle_unused() {
  uint32_t n = 0, vertex = 0, face = 0;
  if (hsr_object_settle_unused(object_, threads_, &n, &vertex, &face))
    refuse_element(path_, "vertex", vertex,
                   ("is not finite or above 1e30, and face " +
                    std::to_string(face) + " uses it")
                       .c_str());
  if (n)
    note(std::to_string(n) + (n == 1 ? " vertex" : " vertices") +
         " passed over: not finite or above 1e30, and used by no face");
}

void Mesh_builder::leave_out_flat() {
  uint64_t n = 0;
  if (!strict_ && hsr_object_leave_out_flat(object_, threads_, marks(), &n))
    throw std::bad_alloc();
  n_dropped_ += n;
}

} // namespace hsr
