// SPDX-License-Identifier: GPL-3.0-or-later
// Reads .off files.
//
// Source      Geomview manual, "OFF: Object File Format"
// Departures  one vertex or face a line, a header word, and neither the binary
//             form nor other dimensions than 3.
// Method      where several threads read, the lines of each block of the text
//             are counted, so each knows which of them are vertices, and which.
//             Then all are read at once, and their faces are given in order.
// Memory      4 bytes a corner and a face, and 12 a face that has a colour,
//             beside the file and the object
#include "common/files/mesh/mesh_blocks.h"
#include "common/files/mesh/mesh_text.h"
#include "common/files/srgb.h"

#include <algorithm>
#include <array>

namespace hsr {
namespace {

constexpr Text_style STYLE = {'#', false};

/* ---- Header ---- */

struct Header {
  size_t n_vertices = 0, n_faces = 0;
  bool has_texture = false, has_colour = false, has_normal = false;
  bool homogeneous = false;
};

/* [ST][C][N][4]OFF */
void read_keyword(Text &text, Header &header) {
  const Word word = text.word();
  Word rest = word;
  const auto take = [&rest](Word prefix) {
    const bool there = rest.substr(0, prefix.size()) == prefix;
    if (there)
      rest.remove_prefix(prefix.size());
    return there;
  };
  header.has_texture = take("ST");
  header.has_colour = take("C");
  header.has_normal = take("N");
  header.homogeneous = take("4");
  if (rest == "nOFF")
    text.refuse("nOFF, of any number of dimensions, is not read");
  if (rest != "OFF")
    text.refuse("the file starts with '%s', not with OFF",
                shown_word(word).c_str());
}

size_t read_count(const Text &text, Word word, const char *what) {
  long long n;
  if (!read_integer(word, n) || n < 0)
    text.refuse("'%s' is not a number of %s", shown_word(word).c_str(), what);
  if (n > MOST_ELEMENTS)
    text.refuse("%lld %s are more than can be read", n, what);
  return static_cast<size_t>(n);
}

/* Leaves `text` at the start of the line after the header. */
Header read_header(const Mesh_file &file, Text &text) {
  Header header;
  if (!text.next_line())
    file.refuse(0, "holds nothing but white space and comments");
  read_keyword(text, header);
  if (!text.more_in_text())
    text.refuse("the file ends before the number of vertices");
  const Word first = text.word();
  if (first == "BINARY")
    text.refuse("binary OFF is not read");
  header.n_vertices = read_count(text, first, "vertices");
  header.n_faces = read_count(text, text.word(), "faces");
  if (text.more())
    read_count(text, text.word(), "edges");
  if (text.more())
    text.refuse("the header has more than three numbers");
  text.pass_line();
  /* The shortest vertex is "0 0 0", the shortest face "0". */
  const size_t left = static_cast<size_t>(file.end - text.at());
  if (6 * header.n_vertices + 2 * header.n_faces > left + 1)
    text.refuse("%zu vertices and %zu faces are claimed, more than the %zu "
                "bytes that follow can hold",
                header.n_vertices, header.n_faces, left);
  return header;
}

/* ---- The lines of a block ---- */

struct Block {
  const char *begin, *end;
  size_t n_lines = 0, first_line = 0;
  std::vector<uint32_t> corners, sizes; /* of its faces */
  std::vector<float> rgb;               /* of its first faces that have one */
};

class Block_reader {
public:
  Block_reader(const Mesh_file &file, const Header &header, Block &block,
               bool strict, double *xyz)
      : text_(file, STYLE, block.begin, block.end), header_(header),
        block_(block), strict_(strict), xyz_(xyz) {}
  /* Reads all lines; the number of the one after them. */
  size_t read();
  void refuse_end(size_t line) const;

private:
  void vertex(size_t v);
  void face(size_t f);
  uint32_t corner(size_t f);
  void colour(size_t f);

  Text text_;
  const Header &header_;
  Block &block_;
  const bool strict_;
  double *const xyz_; /* of all vertices */
};

void Block_reader::vertex(size_t v) {
  const size_t h = header_.homogeneous, dimension = 3 + h;
  std::array<double, 4> coordinate{0, 0, 0, 1};
  size_t n = 0;
  for (; text_.more(); n++) {
    const double value = text_.any_real("vertex", v);
    if (n < dimension)
      coordinate[n] = value;
  }
  const size_t least = dimension + (header_.has_normal ? 3 + h : 0) +
                       (header_.has_texture ? 2 + h : 0);
  if (n != least && !(header_.has_colour && n > least && n <= least + 4))
    text_.refuse("vertex %zu has %zu numbers, not %zu", v, n, least);
  for (size_t k = 0; k < 3; k++) {
    if (h)
      coordinate[k] /= coordinate[3];
    xyz_[3 * v + k] = coordinate[k];
  }
}

uint32_t Block_reader::corner(size_t f) {
  Word word;
  long long v;
  if (!text_.integer(v, word))
    text_.refuse("face %zu: '%s' is not a vertex number", f,
                 shown_word(word).c_str());
  if (v < 0 || v >= static_cast<long long>(header_.n_vertices))
    text_.refuse("face %zu names vertex %lld of %zu", f, v, header_.n_vertices);
  return static_cast<uint32_t>(v);
}

void Block_reader::face(size_t f) {
  const size_t first = block_.corners.size();
  Word word;
  long long n;
  if (!text_.integer(n, word) || n < 0)
    text_.refuse("face %zu: '%s' is not a number of vertices", f,
                 shown_word(word).c_str());
  for (long long k = 0; k < n; k++) {
    if (!text_.more())
      text_.refuse("face %zu has %lld vertices, not %lld", f, k, n);
    block_.corners.push_back(corner(f));
  }
  colour(f);
  const char *fault =
      strict_ ? face_fault(block_.corners.data() + first, size_t(n)) : nullptr;
  if (fault)
    text_.refuse("face %zu %s", f, fault);
  block_.sizes.push_back(static_cast<uint32_t>(n));
}

/* Three or four numbers, 0..255 if all are integers, else 0..1; one number is
 * an index into a map that is not part of the file. Colours are kept if all
 * faces have one. */
void Block_reader::colour(size_t f) {
  std::array<double, 4> value{};
  size_t n = 0;
  bool integers = true;
  for (; text_.more(); n++) {
    const char *start = text_.at();
    const double number = text_.real("face", f);
    if (n < value.size())
      value[n] = number;
    long long integer;
    integers =
        integers &&
        read_integer(Word(start, static_cast<size_t>(text_.at() - start)),
                     integer);
  }
  if (n == 2 || n > value.size())
    text_.refuse("face %zu has %zu numbers after its vertices, which are no "
                 "colour",
                 f, n);
  if (n < 3 || block_.rgb.size() != 3 * block_.sizes.size())
    return;
  for (size_t k = 0; k < 3; k++) {
    const double encoded = value[k] / (integers ? 255 : 1);
    block_.rgb.push_back(hsr_srgb_decode(
        static_cast<float>(std::min(std::max(encoded, 0.0), 1.0))));
  }
}

size_t Block_reader::read() {
  const size_t n_vertices = header_.n_vertices, n_faces = header_.n_faces;
  size_t line = block_.first_line;
  for (; text_.next_line(); line++) {
    if (line < n_vertices)
      vertex(line);
    else if (line < n_vertices + n_faces)
      face(line - n_vertices);
    else
      text_.refuse("the file goes on after the last of %zu faces", n_faces);
  }
  return line;
}

/* If there are fewer lines than the header claims. */
void Block_reader::refuse_end(size_t line) const {
  const size_t n_vertices = header_.n_vertices, n_faces = header_.n_faces;
  if (line < n_vertices)
    text_.refuse("the file ends after %zu of %zu vertices", line, n_vertices);
  if (line < n_vertices + n_faces)
    text_.refuse("the file ends after %zu of %zu faces", line - n_vertices,
                 n_faces);
}

/* ---- The file ---- */

/* Whether the text is of so many lines as the header claims; of one block, that
 * is found when it is read. */
bool count_lines(const Mesh_file &file, const Header &header, int threads,
                 std::vector<Block> &blocks) {
  if (blocks.size() == 1)
    return true;
  share_blocks(threads, blocks, [&file](Block &block) {
    Text text(file, STYLE, block.begin, block.end);
    while (text.next_line())
      block.n_lines++;
  });
  size_t n_lines = 0;
  for (Block &block : blocks) {
    block.first_line = n_lines;
    n_lines += block.n_lines;
  }
  return n_lines == header.n_vertices + header.n_faces;
}

void give(const std::vector<Block> &blocks, Mesh_builder &builder) {
  bool coloured = true;
  for (const Block &block : blocks)
    coloured = coloured && block.rgb.size() == 3 * block.sizes.size();
  for (const Block &block : blocks) {
    const uint32_t *corners = block.corners.data();
    for (size_t f = 0; f < block.sizes.size(); f++) {
      builder.face(corners, block.sizes[f],
                   coloured ? &block.rgb[3 * f] : nullptr);
      corners += block.sizes[f];
    }
  }
}

} // namespace

void off_read(Mesh_file &file, Mesh_builder &builder) {
  make_plain_text(file);
  Text text(file, STYLE);
  const Header header = read_header(file, text);
  builder.reserve(header.n_vertices, header.n_faces);
  double *const xyz = builder.vertices(header.n_vertices);
  const auto read = [&](Block &block) {
    Block_reader reader(file, header, block, builder.strict(), xyz);
    const size_t line = reader.read();
    if (block.end == file.end)
      reader.refuse_end(line);
  };
  const std::vector<Block> blocks = read_blocks<Block>(
      builder.threads(), text.at(), file.end,
      [](const char *, const char *) { return true; },
      [&](std::vector<Block> &all) {
        return count_lines(file, header, builder.threads(), all);
      },
      read);
  builder.took_vertices(header.n_vertices);
  give(blocks, builder);
}

} // namespace hsr
