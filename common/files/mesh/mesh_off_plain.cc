// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the body of an .off file by several threads, if it is plain: every line
// is a vertex or a face, and nothing else.
//
// Method      the text is cut into blocks, at starts of lines. The lines of all
//             blocks are counted, so each block knows which of them are vertices,
//             and which. Then all are read at once, and their faces are given in
//             order.
// Cost        the lines are looked at twice, so one thread reads line by line.
// Same        whether the body is plain does not depend on the blocks. One that
//             is not is read again, line by line, by who can say what is wrong.
#include "common/files/mesh/mesh_blocks.h"
#include "common/files/mesh/mesh_text.h"

#include <cstring>

namespace hsr {
namespace {

constexpr size_t MOST_CORNERS = 8;

struct Block {
  const char *begin, *end;
  size_t n_lines = 0, first_line = 0;
  std::vector<uint32_t> corners;    /* of its faces */
  std::vector<unsigned char> sizes; /* a face */
};

class Plain_reader {
public:
  Plain_reader(const char *begin, const char *end, size_t n_vertices,
               size_t n_faces, Mesh_builder &builder);
  bool read();

private:
  static bool count(Block &block);
  bool face(const char *&at, Block &block) const;
  bool lines(Block &block) const;
  void give();

  size_t n_vertices_, n_faces_;
  Mesh_builder &builder_;
  double *xyz_ = nullptr;
  std::vector<Block> blocks_;
};

Plain_reader::Plain_reader(const char *begin, const char *end,
                           size_t n_vertices, size_t n_faces,
                           Mesh_builder &builder)
    : n_vertices_(n_vertices), n_faces_(n_faces), builder_(builder),
      blocks_(cut_text<Block>(
          begin, end, [](const char *, const char *) { return true; })) {}

bool Plain_reader::count(Block &block) {
  const char *at = block.begin;
  for (; at < block.end; block.n_lines++) {
    const void *stop =
        std::memchr(at, '\n', static_cast<size_t>(block.end - at));
    at = stop ? static_cast<const char *>(stop) + 1 : block.end;
  }
  return true;
}

/* Reads a face that no reader would refuse. */
bool Plain_reader::face(const char *&at, Block &block) const {
  uint32_t vertex[MOST_CORNERS];
  size_t n;
  at = past_plain_list(at, block.end, vertex, n, MOST_CORNERS);
  if (!at || n < 3)
    return false;
  for (size_t k = 0; k < n; k++)
    for (size_t l = 0; l < k; l++)
      if (vertex[l] == vertex[k])
        return false;
  for (size_t k = 0; k < n; k++)
    if (vertex[k] >= n_vertices_)
      return false;
  block.corners.insert(block.corners.end(), vertex, vertex + n);
  block.sizes.push_back(static_cast<unsigned char>(n));
  return true;
}

bool Plain_reader::lines(Block &block) const {
  const char *at = block.begin;
  for (size_t line = block.first_line; at < block.end; line++) {
    if (line < n_vertices_) {
      at = past_plain_line(at, block.end, xyz_ + 3 * line, 3);
      if (!at)
        return false;
    } else if (line - n_vertices_ >= n_faces_ || !face(at, block)) {
      return false;
    }
  }
  return true;
}

void Plain_reader::give() {
  for (const Block &block : blocks_) {
    const uint32_t *corners = block.corners.data();
    for (const size_t n : block.sizes) {
      builder_.face(corners, n, nullptr);
      corners += n;
    }
  }
}

bool Plain_reader::read() {
  share_blocks(builder_.threads(), blocks_, count);
  size_t n_lines = 0;
  for (Block &block : blocks_) {
    block.first_line = n_lines;
    n_lines += block.n_lines;
  }
  if (n_lines != n_vertices_ + n_faces_)
    return false;
  xyz_ = builder_.vertices(n_vertices_);
  if (!share_blocks(builder_.threads(), blocks_,
                    [this](Block &block) { return lines(block); }))
    return false;
  builder_.took_vertices(n_vertices_);
  give();
  return true;
}

} // namespace

bool off_read_plain(const char *begin, const char *end, size_t n_vertices,
                    size_t n_faces, Mesh_builder &builder) {
  return n_vertices && begin < end &&
         Plain_reader(begin, end, n_vertices, n_faces, builder).read();
}

} // namespace hsr
