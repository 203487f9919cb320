// SPDX-License-Identifier: GPL-3.0-or-later
// Stands before the plain readers, which `run` has compiled under other names.
#include "tests/fuzz/plain.h"
#include "common/files/mesh/mesh_obj.h"
#include "common/files/mesh/mesh_ply_header.h"
#include "common/files/mesh/mesh_text.h"

bool fuzz_plain = true;
uint64_t fuzz_n_plain = 0;

namespace {

bool counted(bool read) {
  fuzz_n_plain += read;
  return read;
}

} // namespace

namespace hsr {

bool obj_read_plain_itself(const Mesh_file &, Mesh_builder &);
bool off_read_plain_itself(const char *, const char *, size_t, size_t,
                           Mesh_builder &);
bool text_stl_read_plain_itself(const Mesh_file &, Mesh_builder &);

bool obj_read_plain(const Mesh_file &file, Mesh_builder &builder) {
  return fuzz_plain && counted(obj_read_plain_itself(file, builder));
}

bool off_read_plain(const char *begin, const char *end, size_t n_vertices,
                    size_t n_faces, Mesh_builder &builder) {
  return fuzz_plain && counted(off_read_plain_itself(begin, end, n_vertices,
                                                     n_faces, builder));
}

bool text_stl_read_plain(const Mesh_file &file, Mesh_builder &builder) {
  return fuzz_plain && counted(text_stl_read_plain_itself(file, builder));
}

namespace ply {

bool read_plain_itself(const Header &, const char *, const char *,
                       Mesh_builder &);

bool read_plain(const Header &header, const char *begin, const char *end,
                Mesh_builder &builder) {
  return fuzz_plain && counted(read_plain_itself(header, begin, end, builder));
}

} // namespace ply
} // namespace hsr
