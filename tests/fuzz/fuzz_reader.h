/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the fuzz targets of the readers. They write the bytes to a file;
 * `read` must then give a scene or an error of one line. */
#ifndef HSR_TESTS_FUZZ_READER_H
#define HSR_TESTS_FUZZ_READER_H

#include "common/scene/scene.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <unistd.h>

inline std::string fuzz_folder; /* that fuzz_path made */

/* The path of a file that only this process uses: in memory, if the system has
 * such files. A disk would take most of the time, since a file that is written
 * over goes there at once. The folder is removed at the end. */
inline std::string fuzz_path(const char *name) {
  for (std::string folder :
       {"/dev/shm/hsr-fuzz-XXXXXX", "/tmp/hsr-fuzz-XXXXXX"})
    if (mkdtemp(&folder[0])) {
      fuzz_folder = folder;
      std::atexit([] { std::filesystem::remove_all(fuzz_folder); });
      return folder + "/" + name;
    }
  std::abort();
}

inline void fuzz_write(const std::string &path, const uint8_t *data,
                       size_t size) {
  std::FILE *file = std::fopen(path.c_str(), "wb");
  if (!file || std::fwrite(data, 1, size, file) != size || std::fclose(file))
    std::abort();
}

/* A failure must be one of the input, told in one line. */
inline void fuzz_check(enum hsr_status status, const struct hsr_error &err) {
  if (status != HSR_OK && (!err.text[0] || std::strchr(err.text, '\n')))
    std::abort();
  if (status == HSR_E_INTERNAL)
    std::abort();
}

template <class Read>
void fuzz_reader(const std::string &path, const uint8_t *data, size_t size,
                 const Read &read) {
  fuzz_write(path, data, size);
  struct hsr_scene *scene = hsr_scene_new("fuzz");
  struct hsr_error err = {HSR_OK, ""};
  if (!scene)
    return;
  enum hsr_status status = read(scene, path.c_str(), &err);
  if (status == HSR_OK)
    status = hsr_scene_finish(scene, &err);
  fuzz_check(status, err);
  hsr_scene_delete(scene);
}

#endif
