/* SPDX-License-Identifier: GPL-3.0-or-later */
/* In place of what a page cannot have: other shared objects, and the formats of
 * other libraries. */
#include "common/files/library.h"
#include "common/paper/plot_files.h"

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

enum hsr_status hsr_plot_write_pdf(const struct hsr_plot *plot,
                                   const char *path, struct hsr_error *err) {
  (void)plot;
  return refuse(path, err);
}
enum hsr_status hsr_plot_write_eps(const struct hsr_plot *plot,
                                   const char *path, struct hsr_error *err) {
  (void)plot;
  return refuse(path, err);
}
enum hsr_status hsr_plot_write_dxf(const struct hsr_plot *plot,
                                   const char *path, struct hsr_error *err) {
  (void)plot;
  return refuse(path, err);
}
