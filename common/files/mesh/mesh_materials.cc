// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/files/mesh/mesh_materials.h"
#include "common/files/mesh/mesh_text.h"
#include "common/files/srgb.h"

#include <algorithm>
#include <sstream>
#include <unistd.h>

namespace hsr {

Rgb rgb_of_file(const double encoded[3]) {
  Rgb rgb;
  for (size_t k = 0; k < 3; k++)
    rgb[k] = hsr_srgb_decode(
        static_cast<float>(std::min(std::max(encoded[k], 0.0), 1.0)));
  return rgb;
}

namespace {

/* Kd r, which stands for r r r, or Kd r g b. False: in other words. */
bool read_diffuse(Text &text, size_t material, Rgb &rgb) {
  double value[3];
  size_t n = 0;
  for (; text.more(); n++) {
    const Word word = text.word();
    if (!n && (word == "spectral" || word == "xyz"))
      return false;
    if (n == 3)
      text.refuse("Kd has more than 3 numbers");
    value[n] = text.real_of(word, "material", material);
  }
  if (n != 1 && n != 3)
    text.refuse("Kd has %zu numbers, not 3", n);
  if (n == 1)
    value[1] = value[2] = value[0];
  rgb = rgb_of_file(value);
  return true;
}

std::string folder_of(const char *path) {
  const std::string text = path;
  const size_t slash = text.rfind('/');
  return slash == std::string::npos ? "" : text.substr(0, slash + 1);
}

bool is_there(const std::string &path) {
  return !access(path.c_str(), F_OK);
}

} // namespace

void Materials::read_file(const std::string &path) {
  Mesh_file file = load_mesh_file(path.c_str());
  make_plain_text(file);
  Text text(file, {'#', true});
  std::string name;
  for (size_t n = 0; text.next_line();) {
    const Word statement = text.word();
    Rgb rgb;
    if (statement == "newmtl") {
      name = text.rest();
      defined_.insert(name);
      n++;
    } else if (statement == "Kd" && read_diffuse(text, n, rgb)) {
      colours_[name] = rgb;
    }
  }
}

/* A name may hold spaces, or there may be several. */
void Materials::read(const char *obj_path, const std::string &names) {
  const std::string folder = folder_of(obj_path);
  if (is_there(folder + names)) {
    read_file(folder + names);
    return;
  }
  std::istringstream words(names);
  for (std::string name; words >> name;)
    if (is_there(folder + name))
      read_file(folder + name);
    else
      missing_files_.insert(name);
}

const Rgb *Materials::find(const std::string &name) {
  const auto found = colours_.find(name);
  if (found != colours_.end())
    return &found->second;
  if (!defined_.count(name) &&
      std::find(unknown_.begin(), unknown_.end(), name) == unknown_.end())
    unknown_.push_back(name);
  return nullptr;
}

namespace {

/* "'a'", or "'a' and 2 more" */
template <class Names> std::string first_of(const Names &names) {
  std::string text = "'" + shown_word(*names.begin()) + "'";
  if (names.size() > 1)
    text += " and " + std::to_string(names.size() - 1) + " more";
  return text;
}

} // namespace

/* Without its file a material cannot be known. */
std::vector<std::string> Materials::notes() const {
  std::vector<std::string> notes;
  if (!missing_files_.empty())
    notes.push_back("there is no file " + first_of(missing_files_) +
                    " of its materials, so faces lack their colours");
  else if (!unknown_.empty())
    notes.push_back("no .mtl file defines material " + first_of(unknown_) +
                    ", so faces lack its colour");
  return notes;
}

} // namespace hsr
