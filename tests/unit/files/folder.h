// SPDX-License-Identifier: GPL-3.0-or-later
// A folder of a test's own, for the files that it writes and reads.
#ifndef HSR_TESTS_FOLDER_H
#define HSR_TESTS_FOLDER_H

#include <cstdio>
#include <cstdlib>
#include <string>
#include <unistd.h>

namespace {

std::string directory; // that of the test, once it is made

// Makes the folder. False if that cannot be done.
inline bool make_directory() {
  char name[] = "/tmp/hsr-test-XXXXXX";
  if (!mkdtemp(name))
    return false;
  directory = name;
  return true;
}

// Removes it with all that is in it. False if that cannot be done.
inline bool remove_directory() {
  const std::string command = "rm -rf '" + directory + "'";
  return std::system(command.c_str()) == 0;
}

// Writes a file and returns its path. Ends the test if that cannot be done.
inline std::string file(const std::string &name, const std::string &text) {
  const std::string path = directory + "/" + name;
  std::FILE *out = std::fopen(path.c_str(), "wb");
  if (!out || std::fwrite(text.data(), 1, text.size(), out) != text.size() ||
      std::fclose(out))
    std::exit(99);
  return path;
}

} // namespace

#endif
