// SPDX-License-Identifier: GPL-3.0-or-later
// Reads .off files.
//
// Source      Geomview manual, "OFF: Object File Format"
// Colours     of vertices, 0..1, or 0..255 if any is above 1; of faces, 0..255 if
//             all their numbers are integers, else 0..1. A fourth number is an
//             opacity. One number is an index into a map that is not part of the
//             file: it is passed over, with a note. Two are refused.
// Departures  one vertex or face a line of a text; a header word; no other
//             dimensions than 3.
// Method      where several threads read, the lines of each block of the text
//             are counted, so each knows which of them are vertices, and which.
//             Then all are read at once, and their faces are given in order.
// Memory      4 bytes a corner and a face, and 16 a face or vertex that has a
//             colour, beside the file and the object
#include "common/files/mesh/mesh_blocks.h"
#include "common/files/mesh/mesh_colours.h"
#include "common/files/mesh/mesh_text.h"

#include <algorithm>
#include <array>

namespace hsr {
namespace {

constexpr Text_style STYLE = {'#', false};

/* ---- Header ---- */

struct Header {
  size_t n_vertices = 0, n_faces = 0;
  bool has_texture = false, has_colour = false, has_normal = false;
  bool homogeneous = false, binary = false;

  /* Numbers of a vertex: coordinates; then normal; colour; texture. */
  size_t dimension() const { return homogeneous ? 4 : 3; }
  size_t before_colour() const { return dimension() * (has_normal ? 2 : 1); }
  size_t after_colour() const { return has_texture ? homogeneous ? 3 : 2 : 0; }
};

/* [ST][C][N][4][n]OFF, and perhaps the first number close behind. */
void read_keyword(Text &text, Word word, Header &header, Word &behind) {
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
  if (rest.substr(0, 4) == "nOFF")
    text.refuse("nOFF, of any number of dimensions, is not read");
  const bool is_off = take("OFF");
  behind = rest;
  long long unused;
  if (!is_off || (!behind.empty() && !read_integer(behind, unused)))
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

/* Leaves `text` at the start of the line after the header; of a binary file, at
 * its counts. */
Header read_header(const Mesh_file &file, Text &text) {
  Header header;
  Word first;
  if (!text.next_line())
    file.refuse(0, "holds nothing but white space and comments");
  read_keyword(text, text.word(), header, first);
  if (first.empty()) {
    if (!text.more_in_text())
      text.refuse("the file ends before the number of vertices");
    first = text.word();
  }
  header.binary = first == "BINARY";
  if (header.binary) {
    text.pass_line();
    return header;
  }
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

/* ---- Colours ---- */

/* Of a face: three or four numbers. */
Rgba face_colour(const double *value, size_t n, bool integers) {
  Rgba encoded{0, 0, 0, NO_OPACITY};
  for (size_t k = 0; k < n; k++)
    encoded[k] = static_cast<float>(value[k] / (integers ? 255 : 1));
  return rgba_of_file(encoded);
}

constexpr Rgba NO_COLOUR = {0, 0, 0, NO_OPACITY};

void note_map(Mesh_builder &builder, size_t n, const char *one,
              const char *several) {
  if (n)
    builder.note(std::to_string(n) + (n > 1 ? several : one) +
                 " the number of a colour in a map, which is passed over");
}

void note_maps(Mesh_builder &builder, size_t n_vertices, size_t n_faces) {
  note_map(builder, n_vertices, " vertex has", " vertices have");
  note_map(builder, n_faces, " face has", " faces have");
}

/* ---- The lines of a block ---- */

struct Block {
  const char *begin, *end;
  size_t n_lines = 0, first_line = 0;
  std::vector<uint32_t> corners, sizes; /* of its faces */
  std::vector<Rgba> looks;       /* of its faces up to the last that has one */
  std::vector<Rgba> of_vertices; /* as they stand */
  size_t n_in_map = 0;           /* faces with the number of a colour */
  size_t n_vertices_in_map = 0;
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
  void reserve();
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
  constexpr size_t MOST = 4 + 4 + 4 + 3;
  const size_t before = header_.before_colour();
  const size_t without = before + header_.after_colour();
  std::array<double, MOST> value{};
  size_t n = 0;
  for (; text_.more(); n++) {
    const double number = text_.any_real("vertex", v);
    if (n < MOST)
      value[n] = number;
  }
  /* Those of a colour: none, one of a map, or three or four. */
  const size_t extra = n - without;
  if (n < without ||
      (n > without && (!header_.has_colour || extra == 2 || extra > 4)))
    text_.refuse("vertex %zu has %zu numbers, not %zu", v, n, without);
  for (size_t k = 0; k < 3; k++)
    xyz_[3 * v + k] = value[k] / (header_.homogeneous ? value[3] : 1);
  block_.n_vertices_in_map += extra == 1;
  if (extra < 3)
    return;
  const double *colour = value.data() + before;
  block_.of_vertices.push_back({float(colour[0]), float(colour[1]),
                                float(colour[2]),
                                extra == 4 ? float(colour[3]) : NO_OPACITY});
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

/* The numbers behind the corners. */
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
  block_.n_in_map += n == 1;
  if (n < 3)
    return;
  block_.looks.resize(block_.sizes.size(), NO_COLOUR);
  block_.looks.push_back(face_colour(value.data(), n, integers));
}

/* Room for triangles, in the first block. It may be the whole text. A face takes
 * at least six bytes, so that a wrong header takes no more than a long text. */
void Block_reader::reserve() {
  const auto bytes = static_cast<size_t>(block_.end - block_.begin);
  const size_t n_faces = std::min(header_.n_faces, bytes / 6);
  block_.sizes.reserve(n_faces);
  block_.corners.reserve(3 * n_faces);
}

size_t Block_reader::read() {
  const size_t n_vertices = header_.n_vertices, n_faces = header_.n_faces;
  size_t line = block_.first_line;
  if (line == 0)
    reserve();
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

/* The colours of vertices, if all have one. */
std::vector<Rgba> colours_of(const std::vector<Block> &blocks,
                             size_t n_vertices, Mesh_builder &builder) {
  std::vector<Rgba> all;
  for (const Block &block : blocks)
    all.insert(all.end(), block.of_vertices.begin(), block.of_vertices.end());
  if (!have_colours(all.size(), n_vertices, builder))
    return {};
  decode_all(all);
  return all;
}

/* A face has its own colour, or that of its vertices. */
void give(const std::vector<Block> &blocks, size_t n_vertices,
          Mesh_builder &builder) {
  const std::vector<Rgba> of_vertices = colours_of(blocks, n_vertices, builder);
  size_t n_in_map = 0, n_vertices_in_map = 0;
  for (const Block &block : blocks) {
    const uint32_t *corners = block.corners.data();
    n_in_map += block.n_in_map;
    n_vertices_in_map += block.n_vertices_in_map;
    for (size_t f = 0; f < block.sizes.size(); f++) {
      Rgba mean;
      const bool has_own =
          f < block.looks.size() && block.looks[f][3] != NO_OPACITY;
      builder.face(
          corners, block.sizes[f],
          has_own ? &block.looks[f]
                  : mean_colour(of_vertices, corners, block.sizes[f], &mean));
      corners += block.sizes[f];
    }
  }
  note_maps(builder, n_vertices_in_map, n_in_map);
}

void read_text(const Mesh_file &file, const Text &text, const Header &header,
               Mesh_builder &builder) {
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
  give(blocks, header.n_vertices, builder);
}

/* ---- Binary ---- */

/* Integers and floats of 32 bits, the highest byte first. */
class Binary_reader {
public:
  Binary_reader(const Mesh_file &file, const char *at, const Header &header,
                Mesh_builder &builder)
      : file_(file), at_(at), header_(header), builder_(builder) {}
  void read();

private:
  double number(bool is_real);
  size_t count(const char *what);
  void vertex();
  void face(size_t f);

  const Mesh_file &file_;
  const char *at_;
  Header header_;
  Mesh_builder &builder_;
  std::vector<uint32_t> corners_;
  std::vector<Rgba> of_vertices_;
  size_t n_in_map_ = 0;
};

double Binary_reader::number(bool is_real) {
  const Number_type type = {4, is_real, INT32_MIN, INT32_MAX};
  if (file_.end - at_ < 4)
    file_.refuse(0, "the file ends before its last face");
  at_ += 4;
  return type.of_bytes(at_ - 4, true);
}

size_t Binary_reader::count(const char *what) {
  const double n = number(false);
  if (n < 0 || n > double(file_.end - at_) / 4)
    file_.refuse(0,
                 "%.0f %s are claimed, more than the %zu bytes that follow "
                 "can hold",
                 n, what, static_cast<size_t>(file_.end - at_));
  return static_cast<size_t>(n);
}

void Binary_reader::vertex() {
  double place[4] = {0, 0, 0, 1};
  Rgba look;
  for (size_t k = 0; k < header_.dimension(); k++)
    place[k] = number(true);
  for (size_t k = header_.dimension(); k < header_.before_colour(); k++)
    number(true);
  for (size_t k = 0; k < 4 && header_.has_colour; k++)
    look[k] = static_cast<float>(number(true));
  for (size_t k = 0; k < header_.after_colour(); k++)
    number(true);
  builder_.vertex(place[0] / place[3], place[1] / place[3],
                  place[2] / place[3]);
  if (header_.has_colour)
    of_vertices_.push_back(look);
}

void Binary_reader::face(size_t f) {
  const size_t n = count("corners of a face");
  corners_.clear();
  for (size_t k = 0; k < n; k++) {
    const double v = number(false);
    if (v < 0 || v >= double(header_.n_vertices))
      file_.refuse(0, "face %zu names vertex %.0f of %zu", f, v,
                   header_.n_vertices);
    corners_.push_back(static_cast<uint32_t>(v));
  }
  const size_t n_numbers = count("numbers of a colour");
  if (n_numbers == 2 || n_numbers > 4)
    file_.refuse(0,
                 "face %zu has %zu numbers after its vertices, which are no "
                 "colour",
                 f, n_numbers);
  double value[4];
  for (size_t k = 0; k < n_numbers; k++)
    value[k] = number(n_numbers > 1);
  n_in_map_ += n_numbers == 1;
  Rgba look;
  if (n_numbers >= 3) {
    look = face_colour(value, n_numbers, false);
    builder_.face(corners_.data(), n, &look);
  } else {
    builder_.face(corners_.data(), n,
                  mean_colour(of_vertices_, corners_.data(), n, &look));
  }
}

void Binary_reader::read() {
  header_.n_vertices = count("vertices");
  header_.n_faces = count("faces");
  number(false); /* of edges */
  for (size_t v = 0; v < header_.n_vertices; v++)
    vertex();
  decode_all(of_vertices_);
  for (size_t f = 0; f < header_.n_faces; f++)
    face(f);
  note_maps(builder_, 0, n_in_map_);
  if (at_ != file_.end)
    builder_.note(std::to_string(file_.end - at_) +
                  " bytes after the last face passed over");
}

/* Whether the first line of a file says so. */
bool is_binary(const Mesh_file &file) {
  constexpr Word BINARY = "OFF BINARY";
  const size_t n = std::min(file.size(), size_t{80});
  const Word line(file.begin, static_cast<size_t>(
                                  std::find(file.begin, file.begin + n, '\n') -
                                  file.begin));
  return line.find(BINARY) != Word::npos;
}

} // namespace

void off_read(Mesh_file &file, Mesh_builder &builder) {
  if (!is_binary(file))
    make_plain_text(file);
  Text text(file, STYLE);
  const Header header = read_header(file, text);
  if (header.binary)
    Binary_reader(file, text.at(), header, builder).read();
  else
    read_text(file, text, header, builder);
}

} // namespace hsr
