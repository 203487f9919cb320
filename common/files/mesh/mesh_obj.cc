// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/files/mesh/mesh_obj.h"

#include <algorithm>
#include <iterator>

namespace hsr {
namespace {

/* CGAL knows some of them. */
constexpr Word PASSED_OVER[] = {
    "vt",        "vn",       "vp",     "p",      "l",      "curv",
    "curv2",     "surf",     "cstype", "deg",    "bmat",   "step",
    "parm",      "trim",     "hole",   "scrv",   "sp",     "end",
    "con",       "g",        "s",      "mg",     "o",      "bevel",
    "c_interp",  "d_interp", "lod",    "usemap", "maplib", "shadow_obj",
    "trace_obj", "ctech",    "stech",  "call",   "csh",    "bsp",
    "bzp",       "cdc",      "cdp",    "res"};

} // namespace

bool Passed_over::takes(Word name) {
  if (std::find(std::begin(PASSED_OVER), std::end(PASSED_OVER), name) ==
      std::end(PASSED_OVER))
    return false;
  n_lines += name == "l";
  n_points += name == "p";
  n_free_forms += name == "surf" || name == "curv" || name == "curv2";
  return true;
}

void Passed_over::add(const Passed_over &more) {
  n_lines += more.n_lines;
  n_points += more.n_points;
  n_free_forms += more.n_free_forms;
}

void Passed_over::note(std::vector<std::string> &notes) const {
  const auto add = [&notes](size_t n, const char *statement, const char *what) {
    if (n)
      notes.push_back(std::to_string(n) + " statement" + (n > 1 ? "s" : "") +
                      " '" + statement + "' passed over: " + what +
                      " are not read");
  };
  add(n_lines, "l", "lines");
  add(n_points, "p", "points");
  add(n_free_forms, "curv' or 'surf", "free-form curves and surfaces");
}

std::vector<float> obj_colours(const std::vector<double> &rgb, size_t n) {
  std::vector<float> linear;
  if (rgb.empty() || rgb.size() != 3 * n)
    return linear;
  const double most = *std::max_element(rgb.begin(), rgb.end()) > 1 ? 255 : 1;
  linear.reserve(rgb.size());
  for (size_t k = 0; k < rgb.size(); k += 3) {
    const double encoded[3] = {rgb[k] / most, rgb[k + 1] / most,
                               rgb[k + 2] / most};
    const Rgb colour = rgb_of_file(encoded);
    linear.insert(linear.end(), colour.begin(), colour.end());
  }
  return linear;
}

} // namespace hsr
