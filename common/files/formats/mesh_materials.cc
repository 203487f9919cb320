// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/files/formats/mesh_materials.h"
#include "common/files/srgb.h"
#include "common/files/mesh/mesh_text.h"

#include <algorithm>
#include <dirent.h>
#include <sstream>
#include <strings.h>
#include <unistd.h>

namespace hsr {

namespace {

/* Kd r, which stands for r r r, or Kd r g b. False: in other words. */
bool read_diffuse(Text &text, size_t number, Rgba &look) {
  double value[3];
  size_t n = 0;
  for (; text.more(); n++) {
    const Word word = text.word();
    if (!n && (word == "spectral" || word == "xyz"))
      return false;
    if (n == 3)
      text.refuse("Kd has more than 3 numbers");
    value[n] = text.real_of(word, "material", number);
  }
  if (n != 1 && n != 3)
    text.refuse("Kd has %zu numbers, not 3", n);
  if (n == 1)
    value[1] = value[2] = value[0];
  for (size_t k = 0; k < 3; k++)
    look[k] = static_cast<float>(
        hsr_srgb_decode_real(std::min(std::max(value[k], 0.0), 1.0)));
  return true;
}

/* d opacity, d -halo opacity, or Tr transparency. */
float read_opacity(Text &text, size_t number, Word statement) {
  if (!text.more())
    text.refuse("%s has no number", shown_word(statement).c_str());
  Word word = text.word();
  if (word == "-halo" && text.more())
    word = text.word();
  const double value = text.real_of(word, "material", number);
  const double opacity = statement == "Tr" ? 1 - value : value;
  return static_cast<float>(std::min(std::max(opacity, 0.0), 1.0));
}

std::string folder_of(const char *path) {
  const std::string text = path;
  const size_t slash = text.rfind('/');
  return slash == std::string::npos ? "" : text.substr(0, slash + 1);
}

bool is_there(const std::string &path) {
  return !access(path.c_str(), F_OK);
}

/* The name in a folder that is `name` but for the case of its letters: of
 * several, the first in order. Empty: there is none. */
std::string find_in_folder(const std::string &folder, const std::string &name) {
  std::string found;
  DIR *directory = opendir(folder.empty() ? "." : folder.c_str());
  if (!directory)
    return found;
  for (const dirent *entry; (entry = readdir(directory));)
    if (!strcasecmp(entry->d_name, name.c_str()) &&
        (found.empty() || entry->d_name < found))
      found = entry->d_name;
  closedir(directory);
  return found;
}

/* The path of a file that is there, for `name` relative to a folder, each part in
 * any letter case. Empty: there is none. */
std::string find_in_any_case(const std::string &folder,
                             const std::string &name) {
  std::string path = folder;
  std::istringstream parts(name);
  for (std::string part; std::getline(parts, part, '/');) {
    if (part.empty() || part == ".")
      continue;
    const std::string found =
        is_there(path + part) ? part : find_in_folder(path, part);
    if (found.empty())
      return "";
    path += found + "/";
  }
  path.resize(path.size() - (path.size() > folder.size()));
  return path == folder ? "" : path;
}

/* The path of the file that an .obj file names. Empty: there is none. */
std::string find_file(const std::string &folder, std::string name) {
  if (is_there(folder + name))
    return folder + name;
  std::replace(name.begin(), name.end(), '\\', '/');
  if (name[0] == '/' && is_there(name))
    return name;
  const std::string path = find_in_any_case(folder, name);
  const size_t last = name.rfind('/');
  return path.empty() && last != std::string::npos
             ? find_in_any_case(folder, name.substr(last + 1))
             : path;
}

} // namespace

void Materials::read_file(const std::string &path) {
  Mesh_file file = load_mesh_file(path.c_str());
  make_plain_text(file);
  Text text(file, {'#', true});
  Material *material = nullptr;
  for (size_t n = 0; text.next_line();) {
    const Word statement = text.word();
    if (statement == "newmtl") {
      material = &(materials_[text.rest()] = Material());
      n++;
    } else if (!material) {
      continue;
    } else if (statement == "Kd") {
      material->has_colour |= read_diffuse(text, n, material->look);
    } else if (statement == "d" || (statement == "Tr" && !material->has_d)) {
      material->look[3] = read_opacity(text, n, statement);
      material->has_opacity = true;
      material->has_d |= statement == "d";
    } else {
      n_pictures_ += statement == "map_Kd" || statement == "map_d";
    }
  }
}

/* A name may hold spaces, or there may be several. */
void Materials::read(const char *obj_path, const std::string &names) {
  const std::string folder = folder_of(obj_path);
  const std::string whole = find_file(folder, names);
  if (!whole.empty()) {
    read_file(whole);
    return;
  }
  std::istringstream words(names);
  for (std::string name; words >> name;) {
    const std::string path = find_file(folder, name);
    if (path.empty())
      missing_files_.insert(name);
    else
      read_file(path);
  }
}

const Material *Materials::find(const std::string &name) {
  const auto found = materials_.find(name);
  if (found != materials_.end())
    return &found->second;
  if (std::find(unknown_.begin(), unknown_.end(), name) == unknown_.end())
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
  if (n_pictures_)
    notes.push_back(std::to_string(n_pictures_) +
                    (n_pictures_ > 1 ? " pictures" : " picture") +
                    " of materials passed over (map_Kd, map_d): hsr reads no "
                    "textures");
  return notes;
}

} // namespace hsr
