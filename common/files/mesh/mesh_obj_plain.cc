// SPDX-License-Identifier: GPL-3.0-or-later
// Reads .obj files of plain lines, by several threads: no line goes on in the next,
// and no comment stands behind a statement.
//
// Method      the text is cut into blocks, at starts of lines. First, the vertices
//             of each block are counted, so each knows the number of its first.
//             Then all blocks are read at once. At last, faces are given in order,
//             and materials found for them.
// Same        whether a file is plain does not depend on the blocks. One that is
//             not is read by mesh_scan_obj.cc, which can say what is wrong.
#include "common/files/mesh/mesh_blocks.h"
#include "common/files/mesh/mesh_obj.h"

namespace hsr {
namespace {

constexpr size_t MOST_CORNERS = 64; /* of a face */

/* A statement mtllib or usemtl, before a face of its block. */
struct Material_line {
  bool is_library;
  size_t face;
  Word names;
};

struct Block {
  const char *begin, *end;
  size_t n_vertices = 0, first_vertex = 0;
  std::vector<uint32_t> corners;    /* of its faces */
  std::vector<unsigned char> sizes; /* a face */
  std::vector<double> rgb;          /* of its vertices, as they stand */
  std::vector<Material_line> materials;
  Passed_over passed_over;
};

const char *end_of_line(const char *at, const char *end) {
  return std::find(at, end, '\n');
}

/* Of a line, from its first word on. */
bool is_vertex(const char *at, const char *end) {
  return end - at > 1 && at[0] == 'v' && is_space(at[1]);
}

/* The lines of a block. */
class Block_reader {
public:
  Block_reader(Block &block, size_t n_vertices, bool drop, double *xyz)
      : block_(block), n_vertices_(n_vertices), drop_(drop), xyz_(xyz),
        at_(block.begin) {}
  bool read();

private:
  bool line();
  bool vertex();
  bool face();
  bool corner(uint32_t &vertex);
  bool is_degenerate(const uint32_t *vertex, size_t n) const;
  bool other();

  Block &block_;
  const size_t n_vertices_; /* of the file */
  const bool drop_;
  double *const xyz_; /* of the block's first vertex */
  const char *at_;
  size_t n_ = 0; /* vertices so far, of the block */
};

bool Block_reader::vertex() {
  double number[7];
  size_t n;
  at_ = past_plain_numbers(at_, block_.end, number, n, 7);
  if (!at_ || (n != 3 && n != 4 && n != 6 && n != 7))
    return false;
  std::copy_n(number, 3, xyz_ + 3 * n_++);
  if (n >= 6)
    block_.rgb.insert(block_.rgb.end(), number + n - 3, number + n);
  return true;
}

/* "v", "v/t", "v//n" or "v/t/n" */
bool Block_reader::corner(uint32_t &vertex) {
  const char *const end = block_.end;
  long long number, unused;
  auto result = std::from_chars(at_, end, number);
  if (result.ec != std::errc())
    return false;
  for (int k = 0; k < 2 && result.ptr < end && *result.ptr == '/'; k++) {
    const char *const part = result.ptr + 1;
    result = std::from_chars(part, end, unused);
    if (result.ec == std::errc::result_out_of_range)
      return false;
    if (result.ec != std::errc())
      result.ptr = part;
  }
  at_ = result.ptr;
  if (at_ < end && !is_space(*at_) && *at_ != '\n')
    return false;
  const auto before = static_cast<long long>(block_.first_vertex + n_);
  if (number < 0)
    number += before + 1;
  vertex = static_cast<uint32_t>(number - 1);
  return number >= 1 && number <= static_cast<long long>(n_vertices_);
}

bool Block_reader::is_degenerate(const uint32_t *vertex, size_t n) const {
  for (size_t k = 1; k < n; k++)
    if (std::find(vertex, vertex + k, vertex[k]) != vertex + k)
      return true;
  return n < 3;
}

bool Block_reader::face() {
  uint32_t vertex[MOST_CORNERS];
  size_t n = 0;
  while ((at_ = past_spaces(at_, block_.end)) < block_.end && *at_ != '\n')
    if (n == MOST_CORNERS || !corner(vertex[n++]))
      return false;
  if (!drop_ && is_degenerate(vertex, n))
    return false;
  at_ += at_ < block_.end;
  block_.corners.insert(block_.corners.end(), vertex, vertex + n);
  block_.sizes.push_back(static_cast<unsigned char>(n));
  return true;
}

/* A line of materials, or one that is passed over. */
bool Block_reader::other() {
  const char *const start = at_;
  const char *end = end_of_line(at_, block_.end);
  at_ = end + (end < block_.end);
  if (start == end || *start == '#')
    return true;
  while (end > start && is_space(end[-1]))
    end--;
  const char *const stop =
      std::find_if(start, end, [](char c) { return is_space(c); });
  const Word name(start, static_cast<size_t>(stop - start));
  if (end[-1] == '\\')
    return false;
  if (name != "mtllib" && name != "usemtl")
    return block_.passed_over.takes(name);
  const char *const names = past_spaces(stop, end);
  block_.materials.push_back({name == "mtllib", block_.sizes.size(),
                              Word(names, static_cast<size_t>(end - names))});
  return std::find(names, end, '#') == end;
}

bool Block_reader::line() {
  at_ = past_spaces(at_, block_.end);
  if (is_vertex(at_, block_.end))
    return at_++, vertex();
  if (block_.end - at_ > 1 && *at_ == 'f' && is_space(at_[1]))
    return at_++, face();
  return other();
}

bool Block_reader::read() {
  while (at_ < block_.end)
    if (!line())
      return false;
  return true;
}

class Plain_reader {
public:
  Plain_reader(const char *begin, const char *end, const Mesh_file &file,
               Mesh_builder &builder)
      : path_(file.path), builder_(builder),
        blocks_(cut_text<Block>(
            begin, end, [](const char *, const char *) { return true; })) {}
  bool read();

private:
  static bool count(Block &block);
  bool vertices();
  bool lines();
  void colours();
  void give();
  void material(const Material_line &line);
  void face(const uint32_t *corners, size_t n);
  void note() const;

  const char *path_;
  Mesh_builder &builder_;
  std::vector<Block> blocks_;
  size_t n_vertices_ = 0;
  std::vector<float> vertex_rgb_; /* or empty */
  Materials materials_;
  const Rgb *material_ = nullptr; /* of the faces that follow */
};

bool Plain_reader::count(Block &block) {
  for (const char *at = block.begin; at < block.end;) {
    at = past_spaces(at, block.end);
    block.n_vertices += is_vertex(at, block.end);
    at = end_of_line(at, block.end);
    at += at < block.end;
  }
  return true;
}

bool Plain_reader::vertices() {
  share_blocks(builder_.threads(), blocks_, count);
  for (Block &block : blocks_) {
    block.first_vertex = n_vertices_;
    n_vertices_ += block.n_vertices;
  }
  return n_vertices_ && n_vertices_ <= static_cast<size_t>(MOST_ELEMENTS);
}

bool Plain_reader::lines() {
  double *const xyz = builder_.vertices(n_vertices_);
  const bool drop = builder_.drops();
  if (!share_blocks(builder_.threads(), blocks_,
                    [this, xyz, drop](Block &block) {
                      return Block_reader(block, n_vertices_, drop,
                                          xyz + 3 * block.first_vertex)
                          .read();
                    }))
    return false;
  size_t n_faces = 0, n_corners = 0;
  for (const Block &block : blocks_) {
    n_faces += block.sizes.size();
    n_corners += block.corners.size();
  }
  builder_.reserve(0, n_faces);
  return n_faces && n_faces <= static_cast<size_t>(MOST_ELEMENTS) &&
         n_corners < UINT32_MAX;
}

void Plain_reader::colours() {
  std::vector<double> rgb;
  for (const Block &block : blocks_)
    rgb.insert(rgb.end(), block.rgb.begin(), block.rgb.end());
  vertex_rgb_ = obj_colours(rgb, n_vertices_);
}

void Plain_reader::material(const Material_line &line) {
  std::string names(line.names);
  std::replace_if(names.begin(), names.end(), is_space, ' ');
  if (line.is_library)
    materials_.read(path_, names);
  else
    material_ = materials_.find(names);
}

void Plain_reader::face(const uint32_t *corners, size_t n) {
  float rgb[3];
  builder_.face(corners, n,
                material_ ? material_->data()
                          : mean_colour(vertex_rgb_, corners, n, rgb));
}

void Plain_reader::give() {
  for (const Block &block : blocks_) {
    const uint32_t *corners = block.corners.data();
    auto line = block.materials.begin();
    for (size_t f = 0; f < block.sizes.size(); f++) {
      for (; line != block.materials.end() && line->face == f; ++line)
        material(*line);
      face(corners, block.sizes[f]);
      corners += block.sizes[f];
    }
    for (; line != block.materials.end(); ++line)
      material(*line);
  }
}

void Plain_reader::note() const {
  Passed_over passed_over;
  for (const Block &block : blocks_)
    passed_over.add(block.passed_over);
  std::vector<std::string> notes = materials_.notes();
  passed_over.note(notes);
  for (const std::string &text : notes)
    builder_.note(text);
}

bool Plain_reader::read() {
  if (!vertices() || !lines())
    return false;
  builder_.took_vertices(n_vertices_);
  colours();
  give();
  note();
  return true;
}

} // namespace

bool obj_read_plain(const Mesh_file &file, Mesh_builder &builder) {
  Mesh_file text{file.path, nullptr, file.begin, file.end};
  skip_byte_order_mark(text);
  return Plain_reader(text.begin, text.end, file, builder).read();
}

} // namespace hsr
