// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/files/gltf/gltf_file.h"
#include "common/files/base64.h"
#include "common/files/mesh/mesh_text.h"

#include <algorithm>
#include <cstring>
#include <new>

namespace hsr {
namespace {

constexpr const char *LISTS[] = {
    "scenes",      "nodes",    "meshes",   "materials", "accessors",
    "bufferViews", "buffers",  "cameras",  "skins",     "animations",
    "images",      "textures", "samplers", nullptr};
static_assert(sizeof LISTS / sizeof *LISTS == GLTF_N_LISTS + 1 &&
              int{GLTF_N_LISTS} <= int{HSR_JSON_MOST_LISTS});

constexpr size_t FLAGS = JSON_REJECT_DUPLICATES | JSON_DECODE_INT_AS_REAL;

/* Parses a part of the text, with those members left out that `levels` says. */
Json_owner parse(const Mesh_file &file, hsr_json_part part, size_t flags,
                 const hsr_json_levels *levels, hsr_json_part *list) {
  bool out_of_memory;
  json_error_t error;
  Json_owner value(hsr_json_read_part(part, FLAGS | flags, levels, list,
                                      &out_of_memory, &error));
  if (out_of_memory)
    throw std::bad_alloc();
  if (!value)
    file.refuse(static_cast<size_t>(error.line), "%s", error.text);
  return value;
}

uint32_t number_at(const char *at) {
  const auto *byte = reinterpret_cast<const unsigned char *>(at);
  return byte[0] | uint32_t{byte[1]} << 8 | uint32_t{byte[2]} << 16 |
         uint32_t{byte[3]} << 24;
}

/* What is drawn does not need it: it is about textures, light and shine. */
bool is_about_looks(const std::string &extension) {
  static const char *const families[] = {"KHR_materials_", "KHR_texture_",
                                         "EXT_texture_", "KHR_lights_",
                                         "EXT_lights_"};
  return std::any_of(
      std::begin(families), std::end(families), [&](const char *family) {
        return !extension.compare(0, std::strlen(family), family);
      });
}

/* The name as messages show it: all of it, if it is like one. */
std::string shown_extension(const std::string &name) {
  const bool is_plain =
      name.size() < 60 &&
      name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_"
                             "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
                             "0123456789") == std::string::npos;
  return is_plain ? name : shown_word(name);
}

bool is_known(const std::string &extension) {
  return extension == "KHR_mesh_quantization" || is_about_looks(extension);
}

} // namespace

Gltf_file::Gltf_file(Mesh_file &file)
    : file_(file), text_{nullptr, 0, 1}, n_bytes_(file.size()) {
  open_container();
  parse_top();
  check_version();
  check_extensions();
}

/* ---- The container ---- */

/* A .glb file is a header of 12 bytes and chunks: JSON, and perhaps BIN and
 * others, which are passed over. Any other file is JSON alone. */
void Gltf_file::open_container() {
  const char *at = file_.begin;
  if (file_.size() < 4 || std::memcmp(at, "glTF", 4)) {
    skip_byte_order_mark(file_);
    text_.text = file_.begin;
    text_.length = file_.size();
    return;
  }
  if (file_.size() < 20)
    file_.refuse(0, "ends in its header");
  if (number_at(at + 4) == 1)
    file_.refuse(0, "is glTF 1.0, which is not read; 2.0 is");
  if (number_at(at + 4) != 2)
    file_.refuse(0, "is version %u of .glb, which is not read; 2 is",
                 number_at(at + 4));
  const size_t length = number_at(at + 8);
  if (length > file_.size() || length < 20)
    file_.refuse(0, "says that it has %zu bytes, but has %zu", length,
                 file_.size());
  if (length < file_.size())
    notes_.push_back(std::to_string(file_.size() - length) +
                     " bytes after its end passed over");
  const char *const end = at + length;
  for (size_t n = 0; (at += n ? 0 : 12) + 8 <= end; n++) {
    const size_t size = number_at(at);
    const bool is_json = !std::memcmp(at + 4, "JSON", 4);
    const bool is_bin = !std::memcmp(at + 4, "BIN\0", 4);
    at += 8;
    if (size > static_cast<size_t>(end - at))
      file_.refuse(0, "chunk %zu is of %zu bytes, but %zu are left", n, size,
                   static_cast<size_t>(end - at));
    if (n == 0 && !is_json)
      file_.refuse(0, "its first chunk is not JSON");
    if (n == 0) {
      text_.text = at;
      text_.length = size;
    } else if (n == 1 && is_bin) {
      bin_ = {at, size};
      has_bin_ = true;
    }
    at += size;
  }
}

/* ---- The text ---- */

void Gltf_file::parse_top() {
  const char *nul = static_cast<const char *>(
      text_.length ? std::memchr(text_.text, 0, text_.length) : nullptr);
  if (nul)
    file_.refuse(1 + static_cast<size_t>(hsr_json_lines(text_.text, nul)),
                 "a NUL byte");
  static const hsr_json_levels levels[] = {LISTS, nullptr};
  hsr_json_part lists[GLTF_N_LISTS];
  top_.reset(new Gltf_element{parse(file_, text_, 0, levels, lists),
                              Gltf_value(file_, nullptr, "")});
  top_->value = Gltf_value(file_, top_->owner.get(), "");
  for (size_t k = 0; k < GLTF_N_LISTS; k++)
    for (hsr_json_part element; hsr_json_next(&lists[k], &element);)
      parts_[k].push_back(element);
}

void Gltf_file::check_version() const {
  const Gltf_value asset = root()["asset"];
  /* glTF 1.0 need not have it, and some files have it as a number. */
  const std::string version =
      asset["version"].is_number() ? "1" : asset["version"].text("1");
  if (version.compare(0, 2, "2.") != 0) {
    if (version.compare(0, 1, "1") == 0)
      file_.refuse(0, "is glTF 1.0, which is not read; 2.0 is");
    asset["version"].refuse("'%.20s' is not read; 2.0 is", version.c_str());
  }
  const std::string least = asset["minVersion"].text("2.0");
  if (least != "2.0")
    asset["minVersion"].refuse("'%.20s' is not read; 2.0 is", least.c_str());
  for (size_t k = 0; k < GLTF_N_LISTS; k++)
    root()[LISTS[k]].size(); /* an array, or not there */
}

void Gltf_file::check_extensions() {
  const Gltf_value required = root()["extensionsRequired"];
  for (size_t k = 0; k < required.size(); k++) {
    const std::string name = required[k].text("");
    if (!is_known(name))
      required[k].refuse("needs the extension %s, which is not read",
                         shown_extension(name).c_str());
  }
  const Gltf_value used = root()["extensionsUsed"];
  std::string passed_over;
  size_t n = 0;
  for (size_t k = 0; k < used.size(); k++) {
    const std::string name = used[k].text("");
    if (is_known(name))
      continue;
    passed_over = n++ ? passed_over : shown_extension(name);
  }
  if (n)
    notes_.push_back("extension " + passed_over +
                     (n > 1 ? " and " + std::to_string(n - 1) + " more" : "") +
                     " passed over");
}

bool Gltf_file::uses(const char *extension) const {
  for (const char *list : {"extensionsUsed", "extensionsRequired"}) {
    const Gltf_value names = root()[list];
    for (size_t k = 0; k < names.size(); k++)
      if (names[k].text("") == extension)
        return true;
  }
  return false;
}

Gltf_element Gltf_file::element(Gltf_list list, size_t index) const {
  static const hsr_json_levels none[] = {nullptr};
  Json_owner owner =
      parse(file_, parts_[list][index], JSON_DECODE_ANY, none, nullptr);
  Gltf_value value(file_, owner.get(),
                   std::string(LISTS[list]) + "/" + std::to_string(index));
  if (!json_is_object(owner.get()))
    value.refuse_kind("an object");
  return {std::move(owner), std::move(value)};
}

Gltf_element Gltf_file::element(Gltf_list list,
                                const Gltf_value &reference) const {
  static const char *const names[] = {"scene",    "node",     "mesh",
                                      "material", "accessor", "bufferView",
                                      "buffer",   "camera"};
  return element(list, reference.index(count(list), names[list]));
}

void Gltf_file::spend(size_t n_elements, const Gltf_value &reader) {
  const size_t most = MOST_SHARED * n_bytes_;
  if (n_elements > most || n_spent_ > most - n_elements)
    reader.refuse("reads the same data so often that they would be %zu times "
                  "as many as the file has bytes",
                  MOST_SHARED);
  n_spent_ += n_elements;
}

/* ---- Buffers ---- */

std::string_view Gltf_file::buffer(const Gltf_value &reference) {
  const size_t index = reference.index(count(GLTF_BUFFERS), "buffer");
  const auto found = buffers_.find(index);
  if (found != buffers_.end())
    return found->second;
  const Gltf_element buffer = element(GLTF_BUFFERS, index);
  std::string_view bytes = load(buffer.value, index);
  if (!buffer["byteLength"].is_there())
    buffer["byteLength"].refuse("is missing");
  const uint64_t size = buffer["byteLength"].whole(0, uint64_t{1} << 53);
  if (size > bytes.size())
    buffer.value.refuse("says that it has %llu bytes, but there are %zu",
                        static_cast<unsigned long long>(size), bytes.size());
  bytes = bytes.substr(0, size);
  buffers_.emplace(index, bytes);
  return bytes;
}

std::string_view Gltf_file::load(const Gltf_value &buffer, size_t index) {
  const Gltf_value uri = buffer["uri"];
  if (!uri.is_there()) {
    if (index || !has_bin_)
      buffer.refuse("has no uri, and the file no bytes for it");
    return bin_;
  }
  const std::string text = uri.text("");
  return text.compare(0, 5, "data:") ? read_beside(uri, text)
                                     : decode(uri, text);
}

/* "data:TYPE;base64,DIGITS". */
std::string_view Gltf_file::decode(const Gltf_value &uri,
                                   std::string_view text) {
  const size_t comma = text.find(',');
  const std::string_view before = text.substr(0, comma);
  const std::string_view mark = ";base64";
  if (comma == std::string_view::npos || before.size() < mark.size() ||
      before.substr(before.size() - mark.size()) != mark)
    uri.refuse("is data that is not in base64");
  const std::string_view digits = text.substr(comma + 1);
  std::vector<char> bytes(digits.size() / 4 * 3);
  size_t n = 0;
  for (size_t at = 0; at < digits.size(); at += 4) {
    unsigned char group[3];
    const size_t n_decoded =
        digits.size() - at < 4 ? 0 : base64_decode(digits.data() + at, group);
    if (!n_decoded || (n_decoded < 3 && at + 4 < digits.size()))
      uri.refuse("its data are no base64");
    std::memcpy(bytes.data() + n, group, n_decoded);
    n += n_decoded;
  }
  decoded_.push_back(std::move(bytes));
  n_bytes_ += n;
  return {decoded_.back().data(), n};
}

namespace {

int hexadecimal(char c) {
  return c >= '0' && c <= '9'   ? c - '0'
         : c >= 'a' && c <= 'f' ? c - 'a' + 10
         : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                : -1;
}

/* A name without its escapes, %20 and the like. */
std::string unescaped(const Gltf_value &uri, std::string_view text) {
  std::string name;
  for (size_t k = 0; k < text.size(); k++) {
    if (text[k] != '%') {
      name += text[k];
      continue;
    }
    const int high = k + 2 < text.size() ? hexadecimal(text[k + 1]) : -1;
    const int low = high < 0 ? -1 : hexadecimal(text[k + 2]);
    if (low < 0)
      uri.refuse("'%s' has a '%%' without two digits",
                 shown_word(text).c_str());
    name += static_cast<char>(16 * high + low);
    k += 2;
  }
  if (name.empty() || name.find('\0') != std::string::npos)
    uri.refuse("'%s' is no file's name", shown_word(text).c_str());
  return name;
}

/* Whether a reference begins with a scheme, as https: does. */
bool has_scheme(std::string_view text) {
  const size_t n = text.find_first_not_of("abcdefghijklmnopqrstuvwxyz"
                                          "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                          "0123456789+-.");
  return n && n != std::string_view::npos && text[n] == ':';
}

} // namespace

std::string_view Gltf_file::read_beside(const Gltf_value &uri,
                                        std::string_view text) {
  if (has_scheme(text) || text.substr(0, 1) == "/")
    uri.refuse("'%s' is not fetched; only files beside this one are read",
               shown_word(text).c_str());
  const std::string name = unescaped(uri, text);
  const std::string own = file_.path;
  const std::string path = own.substr(0, own.rfind('/') + 1) + name;
  auto found = beside_.find(path);
  if (found == beside_.end()) {
    found = beside_.emplace(path, Mesh_file{nullptr, nullptr, nullptr, nullptr})
                .first;
    found->second = load_mesh_file(found->first.c_str());
    n_bytes_ += found->second.size();
  }
  return {found->second.begin, found->second.size()};
}

} // namespace hsr
