// SPDX-License-Identifier: GPL-3.0-or-later
// Reads .obj files.
//
// Source      Wavefront Advanced Visualizer manual, appendix B1
// Departures  of geometry only vertices and faces are read; free-form surfaces,
//             lines and points are passed over. Groups are the objects, "o", of
//             a file that has any, or else its groups, "g". Of materials only the
//             colours and opacities are read. Vertices may have a colour, "v x y
//             z r g b", as many programs write it, and behind it an opacity: 0
//             to 1, or to 255 if any is above 1. A weight, "v x y z w", is
//             passed over.
// Method      first, the vertices of each block of the text are counted, so
//             each knows the number of its first. Then all blocks are read at
//             once. At last, faces are given in order, and materials found for
//             them.
// Memory      4 bytes a corner and a face, beside the file and the object
#include "common/files/mesh/mesh_blocks.h"
#include "common/files/mesh/mesh_colours.h"
#include "common/files/formats/mesh_materials.h"
#include "common/files/mesh/mesh_text.h"

#include <algorithm>
#include <iterator>

namespace hsr {
namespace {

constexpr Text_style STYLE = {'#', true};

/* Statements that are passed over. */
class Passed_over {
public:
  /* Whether a statement is one; if so, it is counted. */
  bool takes(Word name);
  void add(const Passed_over &more);
  /* Gives the builder a note for each sort. */
  void note(Mesh_builder &builder) const;

private:
  size_t n_lines_ = 0, n_points_ = 0, n_free_forms_ = 0;
};

constexpr Word PASSED_OVER[] = {
    "vt",    "vn",     "vp",     "p",          "l",         "curv",
    "curv2", "surf",   "cstype", "deg",        "bmat",      "step",
    "parm",  "trim",   "hole",   "scrv",       "sp",        "end",
    "con",   "s",      "mg",     "bevel",      "c_interp",  "d_interp",
    "lod",   "usemap", "maplib", "shadow_obj", "trace_obj", "ctech",
    "stech", "call",   "csh",    "bsp",        "bzp",       "cdc",
    "cdp",   "res"};

bool Passed_over::takes(Word name) {
  if (std::find(std::begin(PASSED_OVER), std::end(PASSED_OVER), name) ==
      std::end(PASSED_OVER))
    return false;
  n_lines_ += name == "l";
  n_points_ += name == "p";
  n_free_forms_ += name == "surf" || name == "curv" || name == "curv2";
  return true;
}

void Passed_over::add(const Passed_over &more) {
  n_lines_ += more.n_lines_;
  n_points_ += more.n_points_;
  n_free_forms_ += more.n_free_forms_;
}

void Passed_over::note(Mesh_builder &builder) const {
  const auto add = [&](size_t n, const char *statement, const char *what) {
    if (n)
      builder.note(std::to_string(n) + " statement" + (n > 1 ? "s" : "") +
                   " '" + statement + "' passed over: " + what +
                   " are not read");
  };
  add(n_lines_, "l", "lines");
  add(n_points_, "p", "points");
  add(n_free_forms_, "curv' or 'surf", "free-form curves and surfaces");
}

/* How many bytes the character of UTF-8 at `at` has; 0: there is none, or it is
 * a control character. */
size_t character(const std::string &text, size_t at) {
  const auto byte = [&](size_t k) {
    return k < text.size() ? static_cast<unsigned char>(text[k]) : 0u;
  };
  const unsigned first = byte(at);
  const size_t n = first < 0x80   ? 1
                   : first < 0xc2 ? 0
                   : first < 0xe0 ? 2
                   : first < 0xf0 ? 3
                   : first < 0xf5 ? 4
                                  : 0;
  uint32_t code = n > 1 ? first & (0x7fu >> n) : first;
  for (size_t k = 1; k < n; k++) {
    if ((byte(at + k) & 0xc0u) != 0x80)
      return 0;
    code = code << 6 | (byte(at + k) & 0x3fu);
  }
  const bool is_long = (n == 3 && code < 0x800) || (n == 4 && code < 0x10000);
  const bool is_surrogate = code >= 0xd800 && code < 0xe000;
  return code < 0x20 || code == 0x7f || is_long || is_surrogate ||
                 code > 0x10ffff
             ? 0
             : n;
}

/* A name in UTF-8: a byte that is of no character becomes '?'. */
std::string plain_name(std::string name) {
  for (size_t k = 0, n; k < name.size(); k += n) {
    n = character(name, k);
    if (n == 0) {
      name[k] = '?';
      n = 1;
    }
  }
  return name;
}

/* A statement mtllib or usemtl, before a face of its block. */
struct Material_line {
  bool is_library;
  size_t face;
  std::string names;
};

/* A statement o or g, before a face of its block. */
struct Group_line {
  size_t face;
  std::string name;
};

struct Block {
  const char *begin, *end;
  size_t n_vertices = 0, first_vertex = 0;
  std::vector<uint32_t> corners, sizes; /* of its faces */
  std::vector<Rgba> look;               /* of its vertices, as they stand */
  size_t n_opacities = 0;               /* of these */
  std::vector<Material_line> materials;
  std::vector<Group_line> objects, groups; /* by o, and by g */
  Passed_over passed_over;
};

/* ---- The lines of a block ---- */

class Block_reader {
public:
  Block_reader(const Mesh_file &file, Block &block, size_t n_vertices,
               bool strict, double *xyz)
      : text_(file, STYLE, block.begin, block.end), block_(block),
        n_vertices_(n_vertices), strict_(strict), xyz_(xyz) {}
  void read();

private:
  void vertex();
  void face();
  uint32_t corner();
  void group(std::vector<Group_line> &lines);
  void other(Word name);

  Text text_;
  Block &block_;
  const size_t n_vertices_; /* of the file */
  const bool strict_;
  double *const xyz_; /* of all vertices */
  size_t n_ = 0;      /* vertices so far, with those before the block */
};

void Block_reader::vertex() {
  size_t n = 0;
  double value[7];
  for (; text_.more(); n++) {
    const double number =
        n < 4 ? text_.any_real("vertex", n_ + 1) : text_.real("vertex", n_ + 1);
    if (n < 7)
      value[n] = number;
  }
  /* With a weight, with a colour, or with a colour and an opacity. */
  if (n != 3 && n != 4 && n != 6 && n != 7)
    text_.refuse("vertex %zu has %zu numbers, not 3", n_ + 1, n);
  std::copy_n(value, 3, xyz_ + 3 * n_++);
  if (n < 6)
    return;
  block_.look.push_back({float(value[3]), float(value[4]), float(value[5]),
                         n == 7 ? float(value[6]) : NO_OPACITY});
  block_.n_opacities += n == 7;
}

/* Whether a text is the texture and normal of a corner: "/t", "//n" or
 * "/t/n". */
bool are_parts(const char *at, const char *end) {
  for (int k = 0; at < end; k++) {
    if (k == 2 || *at != '/')
      return false;
    long long unused;
    const auto result = std::from_chars(++at, end, unused);
    if (result.ec == std::errc::result_out_of_range)
      return false;
    if (result.ec == std::errc())
      at = result.ptr;
  }
  return true;
}

/* The vertex of a corner, counted from 0. */
uint32_t Block_reader::corner() {
  const Word word = text_.word();
  const char *const end = word.data() + word.size();
  long long v;
  const auto result = std::from_chars(word.data(), end, v);
  if (result.ec != std::errc() || !are_parts(result.ptr, end))
    text_.refuse("face %zu: '%s' is not a corner", block_.sizes.size(),
                 shown_word(word).c_str());
  const auto before = static_cast<long long>(n_);
  const auto all = static_cast<long long>(n_vertices_);
  if (v == 0 || v < -before || v > all)
    text_.refuse("face %zu names vertex %lld of %lld", block_.sizes.size(), v,
                 v > 0 ? all : before);
  return static_cast<uint32_t>(v > 0 ? v - 1 : before + v);
}

void Block_reader::face() {
  const size_t first = block_.corners.size();
  while (text_.more())
    block_.corners.push_back(corner());
  const size_t n = block_.corners.size() - first;
  const char *fault =
      strict_ ? face_fault(block_.corners.data() + first, n) : nullptr;
  if (fault)
    text_.refuse("face %zu %s", block_.sizes.size(), fault);
  block_.sizes.push_back(static_cast<uint32_t>(n));
}

/* Of several such lines before a face, the last one counts. */
void Block_reader::group(std::vector<Group_line> &lines) {
  if (!lines.empty() && lines.back().face == block_.sizes.size())
    lines.pop_back();
  lines.push_back({block_.sizes.size(), text_.rest()});
}

/* A line of materials or groups, or one that is passed over. */
void Block_reader::other(Word name) {
  if (name == "mtllib" || name == "usemtl")
    block_.materials.push_back(
        {name == "mtllib", block_.sizes.size(), text_.rest()});
  else if (name == "o" || name == "g")
    group(name == "o" ? block_.objects : block_.groups);
  else if (!block_.passed_over.takes(name))
    text_.refuse("'%s' is not a statement", shown_word(name).c_str());
}

void Block_reader::read() {
  n_ = block_.first_vertex;
  while (text_.next_line()) {
    const Word name = text_.word();
    if (name == "v")
      vertex();
    else if (name == "f")
      face();
    else
      other(name);
  }
}

/* ---- The file ---- */

class Obj_reader {
public:
  Obj_reader(const Mesh_file &file, Mesh_builder &builder)
      : file_(file), builder_(builder) {}
  void read();

private:
  bool may_start(const char *line) const;
  bool count(std::vector<Block> &blocks);
  void find_colours(const std::vector<Block> &blocks);
  void find_groups(const std::vector<Block> &blocks);
  void begin_group(const std::string &name);
  void give(const Block &block);
  void material(const Material_line &line);
  void face(const uint32_t *corners, size_t n);
  void note(const std::vector<Block> &blocks) const;

  const Mesh_file &file_;
  Mesh_builder &builder_;
  size_t n_vertices_ = 0;
  double *xyz_ = nullptr;
  std::vector<Rgba> of_vertices_; /* or empty */
  bool has_objects_ = false;      /* statements o */
  Materials materials_;
  const Material *material_ = nullptr; /* of the faces that follow */
};

/* Not a line in which the one before it may go on. */
bool Obj_reader::may_start(const char *line) const {
  const char *last = line - 1;
  while (last > file_.begin && is_space(last[-1]))
    last--;
  return last == file_.begin || last[-1] != '\\';
}

bool Obj_reader::count(std::vector<Block> &blocks) {
  share_blocks(builder_.threads(), blocks, [this](Block &block) {
    Text text(file_, STYLE, block.begin, block.end);
    while (text.next_line())
      block.n_vertices += text.word() == "v";
  });
  n_vertices_ = 0;
  for (Block &block : blocks) {
    block.first_vertex = n_vertices_;
    n_vertices_ += block.n_vertices;
  }
  if (n_vertices_ > static_cast<size_t>(MOST_ELEMENTS))
    file_.refuse(0, "%zu vertices are more than can be read", n_vertices_);
  xyz_ = builder_.vertices(n_vertices_);
  return true;
}

/* The colours of vertices, if all have one. */
void Obj_reader::find_colours(const std::vector<Block> &blocks) {
  size_t n = 0, n_opacities = 0;
  for (const Block &block : blocks) {
    n += block.look.size();
    n_opacities += block.n_opacities;
  }
  if (n_opacities)
    builder_.note(std::to_string(n_opacities) +
                  (n_opacities > 1 ? " vertices of seven numbers are"
                                   : " vertex of seven numbers is") +
                  " read as x y z, red green blue, opacity");
  if (!have_colours(n, n_vertices_, builder_))
    return;
  of_vertices_.reserve(n);
  for (const Block &block : blocks)
    of_vertices_.insert(of_vertices_.end(), block.look.begin(),
                        block.look.end());
  decode_all(of_vertices_);
}

void Obj_reader::material(const Material_line &line) {
  if (line.is_library)
    materials_.read(file_.path, line.names);
  else
    material_ = materials_.find(line.names);
}

/* What the material does not say, the vertices may. */
void Obj_reader::face(const uint32_t *corners, size_t n) {
  if (material_ && material_->has_colour) {
    builder_.face(corners, n, &material_->look);
    return;
  }
  Rgba mean;
  builder_.face(corners, n, mean_colour(of_vertices_, corners, n, &mean));
  if (material_ && material_->has_opacity)
    builder_.opacity(material_->look[3]);
}

void Obj_reader::find_groups(const std::vector<Block> &blocks) {
  bool has_groups = false;
  for (const Block &block : blocks) {
    has_objects_ |= !block.objects.empty();
    has_groups |= !block.groups.empty();
  }
  if (has_objects_ || has_groups)
    begin_group("");
}

/* A name that is none is that of the file. */
void Obj_reader::begin_group(const std::string &name) {
  builder_.group(name.empty() ? builder_.name() : plain_name(name));
}

void Obj_reader::give(const Block &block) {
  const uint32_t *corners = block.corners.data();
  const auto &groups = has_objects_ ? block.objects : block.groups;
  auto line = block.materials.begin();
  auto group = groups.begin();
  for (size_t f = 0; f < block.sizes.size(); f++) {
    for (; line != block.materials.end() && line->face == f; ++line)
      material(*line);
    if (group != groups.end() && group->face == f)
      begin_group((group++)->name);
    face(corners, block.sizes[f]);
    corners += block.sizes[f];
  }
  for (; line != block.materials.end(); ++line)
    material(*line);
  if (group != groups.end())
    begin_group(group->name);
}

void Obj_reader::note(const std::vector<Block> &blocks) const {
  Passed_over passed_over;
  for (const Block &block : blocks)
    passed_over.add(block.passed_over);
  for (const std::string &text : materials_.notes())
    builder_.note(text);
  passed_over.note(builder_);
}

void Obj_reader::read() {
  if (file_.begin == file_.end)
    file_.refuse(0, "holds nothing");
  const std::vector<Block> blocks = read_blocks<Block>(
      builder_.threads(), file_.begin, file_.end,
      [this](const char *line, const char *) { return may_start(line); },
      [this](std::vector<Block> &all) { return count(all); },
      [this](Block &block) {
        Block_reader(file_, block, n_vertices_, builder_.strict(), xyz_).read();
      });
  size_t n_faces = 0, n_corners = 0;
  for (const Block &block : blocks) {
    n_faces += block.sizes.size();
    n_corners += block.corners.size();
  }
  if (n_faces > static_cast<size_t>(MOST_ELEMENTS) || n_corners >= UINT32_MAX)
    file_.refuse(0, "%zu faces of %zu corners are more than can be read",
                 n_faces, n_corners);
  builder_.reserve(0, n_faces);
  builder_.took_vertices(n_vertices_);
  find_colours(blocks);
  find_groups(blocks);
  for (const Block &block : blocks)
    give(block);
  note(blocks);
}

} // namespace

void obj_read(Mesh_file &file, Mesh_builder &builder) {
  make_plain_text(file);
  Obj_reader(file, builder).read();
}

} // namespace hsr
