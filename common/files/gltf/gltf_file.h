// SPDX-License-Identifier: GPL-3.0-or-later
// A glTF 2.0 file: the values of its JSON, and the bytes of its buffers. Only for
// common/files/gltf.
//
// Source      The Khronos Group, "glTF 2.0 Specification", 2021: 2 to 4
// Library     jansson, which hsr has already. tinygltf 2.7 was tried: it reads
//             nested brackets by recursion, and a file of 400 kB ends it by a
//             full stack, which no caller can catch; a file of 15 MB made it
//             take 890 MB. assimp and VTK keep matrices or translations as
//             floats.
// Memory      the file, the buffers that are used, and 24 bytes for each element
//             of a top-level array. jansson's tree is of one such element at a
//             time, 20 times its text or, of empty objects, 80 times.
#ifndef HSR_COMMON_GLTF_FILE_H
#define HSR_COMMON_GLTF_FILE_H

#include "common/files/json/json_read.h"
#include "common/files/mesh/mesh_file.h"

#include <array>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace hsr {

struct Json_release {
  void operator()(json_t *value) const { json_decref(value); }
};
using Json_owner = std::unique_ptr<json_t, Json_release>;

/* A value of the JSON text, or the absence of one. It borrows the value. A
 * function that reads it refuses a value of another kind: "path: place: ...". */
class Gltf_value {
public:
  Gltf_value(const Mesh_file &file, json_t *value, std::string place)
      : file_(&file), value_(value), place_(std::move(place)) {}

  bool is_there() const { return value_; }
  bool is_number() const { return json_is_number(value_); }
  /* A member of an object, an element of an array. What is not there has
   * none. */
  Gltf_value operator[](const char *key) const;
  Gltf_value operator[](size_t index) const;
  /* The number of elements of an array, 0 if it is not there. */
  size_t size() const;
  /* The keys of an object. */
  std::vector<std::string> keys() const;

  /* The value, or `standard` if it is not there. */
  bool truth(bool standard) const;
  double number(double standard) const;
  std::string text(const char *standard) const;
  /* A whole number up to `most`, at most 2^53. */
  uint64_t whole(uint64_t standard, uint64_t most) const;
  /* The index of one of n things; it must be there. */
  size_t index(size_t n, const char *what) const;
  /* Reads exactly n numbers into to[]. False: it is not there. */
  bool numbers(double *to, size_t n) const;

  const std::string &place() const { return place_; }
  [[noreturn]] void refuse(const char *format, ...) const
      __attribute__((format(printf, 2, 3)));
  [[noreturn]] void refuse_kind(const char *expected) const;

private:
  const Mesh_file *file_;
  json_t *value_;
  std::string place_;
};

/* A value and the tree that holds it. */
struct Gltf_element {
  Json_owner owner;
  Gltf_value value;
  Gltf_value operator[](const char *key) const { return value[key]; }
};

/* The arrays at the top. */
enum Gltf_list {
  GLTF_SCENES,
  GLTF_NODES,
  GLTF_MESHES,
  GLTF_MATERIALS,
  GLTF_ACCESSORS,
  GLTF_VIEWS,
  GLTF_BUFFERS,
  GLTF_CAMERAS,
  GLTF_SKINS,
  GLTF_ANIMATIONS,
  GLTF_IMAGES,
  GLTF_TEXTURES,
  GLTF_SAMPLERS,
  GLTF_N_LISTS
};

class Gltf_file {
public:
  /* Checks the container, the version and the extensions that are required.
   * `file` is borrowed. Throws Refused and std::bad_alloc. */
  explicit Gltf_file(Mesh_file &file);

  const Mesh_file &file() const { return file_; }
  /* Of the top. Members that are lists are empty arrays in it. */
  const Gltf_value &root() const { return top_->value; }
  size_t count(Gltf_list list) const { return parts_[list].size(); }
  /* Parses an element. `reference` is the value that names it. */
  Gltf_element element(Gltf_list list, size_t index) const;
  Gltf_element element(Gltf_list list, const Gltf_value &reference) const;
  bool uses(const char *extension) const;

  /* The bytes of a buffer, which is loaded when it is first used. */
  std::string_view buffer(const Gltf_value &reference);
  /* The bytes of the file and of all buffers that were used. */
  size_t n_bytes() const { return n_bytes_; }
  /* Counts elements of accessors that `reader` is about to read. Refuses more
   * than MOST_SHARED times as many as there are bytes: accessors may be shared,
   * but a small file must not fill the memory. */
  void spend(size_t n_elements, const Gltf_value &reader);
  static constexpr size_t MOST_SHARED = 16;

  const std::vector<std::string> &notes() const { return notes_; }

private:
  void open_container();
  void parse_top();
  void check_version() const;
  void check_extensions();
  std::string_view load(const Gltf_value &buffer, size_t index);
  std::string_view decode(const Gltf_value &uri, std::string_view text);
  std::string_view read_beside(const Gltf_value &uri, std::string_view text);

  Mesh_file &file_;
  hsr_json_part text_;
  std::string_view bin_;
  bool has_bin_ = false;
  std::unique_ptr<Gltf_element> top_;
  std::array<std::vector<hsr_json_part>, GLTF_N_LISTS> parts_;
  std::map<size_t, std::string_view> buffers_; /* that were loaded */
  std::map<std::string, Mesh_file> beside_;    /* files, by path */
  std::vector<std::vector<char>> decoded_;
  size_t n_bytes_, n_spent_ = 0;
  std::vector<std::string> notes_;
};

} // namespace hsr

#endif
