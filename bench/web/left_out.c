/* SPDX-License-Identifier: GPL-3.0-or-later */
/* In place of what a page cannot have: other shared objects and programs, and
 * the formats of other libraries. */
#include "common/files/library.h"
#include "common/paper/plot_files.h"

#include <errno.h>
#include <spawn.h>

enum hsr_status hsr_library_table(const char *file, const char *name,
                                  const void **table, struct hsr_error *err) {
  (void)name;
  (void)table;
  return hsr_fail(err, HSR_E_INPUT, "%s is not in the page", file);
}

static enum hsr_status refuse(const char *path, struct hsr_error *err) {
  return hsr_fail(err, HSR_E_INPUT, "%s: the page does not write such files",
                  path);
}

enum hsr_status hsr_plot_write_page(const struct hsr_plot *plot,
                                    const char *path, bool is_eps,
                                    struct hsr_error *err) {
  (void)plot;
  (void)is_eps;
  return refuse(path, err);
}
enum hsr_status hsr_plot_write_dxf(const struct hsr_plot *plot,
                                   const char *path, struct hsr_error *err) {
  (void)plot;
  return refuse(path, err);
}
enum hsr_status hsr_plot_raster(const struct hsr_plot *plot, float *rgb,
                                struct hsr_error *err) {
  (void)plot;
  (void)rgb;
  return refuse("a drawing", err);
}

/* Programs: scenes of other packages are packed by tar. */
int posix_spawnp(pid_t *restrict child, const char *restrict file,
                 const posix_spawn_file_actions_t *actions,
                 const posix_spawnattr_t *restrict attributes,
                 char *const arguments[restrict],
                 char *const environment[restrict]) {
  (void)child;
  (void)file;
  (void)actions;
  (void)attributes;
  (void)arguments;
  (void)environment;
  return ENOSYS;
}
