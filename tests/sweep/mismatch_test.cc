// SPDX-License-Identifier: GPL-3.0-or-later
// The mismatches that hsr bench records and hsr check prints are those that one
// counts by comparing two picture files: the painter's, which is wrong, and the
// oracle's.
#include "tests/tap.h"

#include <OpenImageIO/imageio.h>
#include <jansson.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <unistd.h>
#include <vector>

namespace {

const char *const scenes[] = {
    "house",      "harbor",    "cyclic-overlap", "penetration", "coplanar",
    "near-plane", "soup:60:3", "lattice:30:2",   "t-junction",  "terrain"};

std::string folder;

/* Runs hsr with its output in `folder`/out; returns its exit status. */
int run(const std::string &words) {
  const std::string command = std::string(std::getenv("HSR")) + " " + words +
                              " >" + folder + "/out 2>" + folder + "/err";
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/* The id of every sample, from a picture by an algorithm. */
std::vector<float> ids_of(const std::string &scene, const char *algorithm) {
  const std::string path = folder + "/picture.exr";
  std::vector<float> all, ids;
  if (run("render " + scene + " -s 64x48 -a " + algorithm + " -o " + path))
    return ids;
  auto file = OIIO::ImageInput::open(path);
  if (!file)
    return ids;
  const OIIO::ImageSpec spec = file->spec();
  const size_t n = static_cast<size_t>(spec.nchannels);
  all.resize(static_cast<size_t>(spec.width * spec.height) * n);
  file->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, all.data());
  for (size_t k = n - 1; k < all.size(); k += n) /* the last channel */
    ids.push_back(all[k]);
  return ids;
}

/* How many samples of two pictures differ; -1: one is missing. */
long count_differences(const std::string &scene) {
  const std::vector<float> got = ids_of(scene, "painter"),
                           wanted = ids_of(scene, "oracle");
  long differing = 0;
  if (got.empty() || got.size() != wanted.size())
    return -1;
  for (size_t k = 0; k < got.size(); k++)
    differing += got[k] != wanted[k];
  return differing;
}

/* What the record of a bench says. */
long recorded(const std::string &scene) {
  const std::string path = folder + "/r.ndjson";
  std::remove(path.c_str());
  run("bench " + scene + " -s 64x48 -a painter --counts -o " + path);
  std::ifstream file(path);
  long mismatches = -1;
  for (std::string line; std::getline(file, line);) {
    json_t *record = json_loads(line.c_str(), 0, nullptr);
    const json_t *number = json_object_get(record, "mismatches");
    if (number)
      mismatches = static_cast<long>(json_integer_value(number));
    json_decref(record);
  }
  return mismatches;
}

/* What hsr check --json says. */
long checked(const std::string &scene) {
  run("check " + scene + " --size 64x48 --views 1 -a painter --json");
  json_t *all = json_load_file((folder + "/out").c_str(), 0, nullptr);
  const json_t *cell = json_array_get(json_object_get(all, "cells"), 0);
  const json_t *number = json_object_get(cell, "mismatches");
  const long mismatches =
      number ? static_cast<long>(json_integer_value(number)) : -1;
  json_decref(all);
  return mismatches;
}

} // namespace

int main() {
  char name[] = "/tmp/hsr-mismatch-XXXXXX";
  struct tap tap = plan(sizeof scenes / sizeof *scenes + 1);
  if (!mkdtemp(name))
    return 99;
  folder = name;
  long sum = 0;
  for (const char *scene : scenes) {
    const long counted = count_differences(scene);
    const long record = recorded(scene), check = checked(scene);
    ok(&tap, counted >= 0 && record == counted && check == counted,
       "%s: %ld samples differ; recorded %ld, checked %ld", scene, counted,
       record, check);
    sum += counted;
  }
  ok(&tap, sum > 0, "the painter is wrong somewhere");
  if (std::system(("rm -rf " + folder).c_str()))
    return 99;
  return finish(&tap);
}
