/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which options of hsr render go with which, and with what is drawn. */
#include "bench/library/library.h"
#include "bench/modules/variant.h"
#include "bench/options/words.h"
#include "bench/ranks/ranks.h"
#include "bench/render/render.h"
#include "common/files/suffix.h"

#include <string.h>

/* Checks that the options fit the kind of answer that the algorithm draws. */
static enum hsr_status check_kind(const struct render_options *o,
                                  const struct hsr_variant *variant,
                                  struct hsr_error *err) {
  const struct hsr_algorithm *a = variant->listed->plain;
  const struct hsr_answer_type *kind = variant->choice.form.type;
  char hint[MOST_HINT];
  for (int k = 0; k < HSR_N_TAKES; k++) {
    if (!o->given[k] || kind->takes & 1u << k || (k == HSR_SHADING && o->fill))
      continue;
    hint_taker(variant, k, hint);
    return hsr_fail(err, HSR_E_USAGE, "%s is not for %s, which %s draws%s",
                    o->given[k], kind->draws, variant->name, hint);
  }
  if (o->hatch && kind->takes & 1u << HSR_LINES && !o->fill)
    return hsr_fail(err, HSR_E_USAGE,
                    "--hatch is for faces; --fill draws them under the lines");
  enum hsr_status status = o->work ? lib_check_work(variant, err) : HSR_OK;
  if (status)
    return status;
  if (o->work && ranks_count() > 1)
    return hsr_fail(err, HSR_E_USAGE, "--work is for one rank, not for %d",
                    ranks_count());
  for (int k = 0; k < o->n_outputs; k++) {
    if (kind->fits(o->output[k]))
      continue;
    hint_writer(variant, o->output[k], hint);
    return hsr_fail(err, HSR_E_USAGE,
                    "%.200s: cannot hold %s, which %s draws%s", o->output[k],
                    kind->draws, a->name, hint);
  }
  return HSR_OK;
}

/* Checks that each picture of a series has a file of its own. */
static enum hsr_status check_series(const struct render_options *o,
                                    struct hsr_error *err) {
  if (o->first && o->orbit)
    return hsr_fail(err, HSR_E_USAGE,
                    "render: --views or --orbit, not both at once");
  char name[MOST_FILE_NAME];
  if (o->last_frame >= 0 && (o->orbit || o->last > o->first))
    return hsr_fail(err, HSR_E_USAGE,
                    "render: --frames goes with one view, or with the first of "
                    "a walk");
  if (o->last_frame >= 0 && !series_name(o->scene.name, 0, name))
    return hsr_fail(err, HSR_E_USAGE,
                    "%.200s: of several frames, SCENE must have one %%d in the "
                    "place of the number, as in traffic:20:%%d",
                    o->scene.name);
  for (int k = 0; k <= o->n_outputs && is_series(o); k++) {
    const char *file = k < o->n_outputs ? o->output[k] : o->work;
    if (file && !series_name(file, 1, name))
      return hsr_fail(err, HSR_E_USAGE,
                      "%.200s: of several views, a name must have one %%d in "
                      "the place of the number, as in f%%03d.png",
                      file);
  }
  return HSR_OK;
}

static bool is_exr(const char *path) {
  return hsr_ends_in(path, ".exr");
}

/* Checks that each file can be what is asked for. */
static enum hsr_status check_files(const struct render_options *o,
                                   struct hsr_error *err) {
  for (int k = 0; k < o->n_outputs; k++) {
    if (o->no_background && !hsr_can_be_clear(o->output[k]))
      return hsr_fail(err, HSR_E_USAGE,
                      "%.200s: --background none is for .png, .exr and "
                      ".rgb.npy files",
                      o->output[k]);
    if (o->page_option && !hsr_is_paper_file(o->output[k]))
      return hsr_fail(err, HSR_E_USAGE,
                      "%.200s: %s is for .svg, .pdf, .eps and .dxf files; "
                      "--size is the pixels of others",
                      o->output[k], o->page_option);
    if (o->supersamples > 1 && !hsr_is_colour_file(o->output[k]))
      return hsr_fail(err, HSR_E_USAGE,
                      "%.200s: holds %s, which are not averaged; leave out "
                      "--supersample, or make --size larger",
                      o->output[k],
                      hsr_is_depth_file(o->output[k]) ? "depths" : "face ids");
  }
  return HSR_OK;
}

/* Whether a tile of the picture can be made alone: ids, and colours that do not
 * depend on what is drawn at once. */
static bool has_tiles(const struct hsr_variant *variant) {
  const struct hsr_answer_type *kind = variant->choice.form.type;
  return kind->write_tile || ((kind->by_windows || kind->fold) && kind->shade &&
                              !kind->uncertainty);
}

/* Checks that --tiles is there if it is needed, and that nothing else is asked
 * for that is not made by tiles. */
static enum hsr_status check_tiles(const struct render_options *o,
                                   const struct hsr_variant *variant,
                                   struct hsr_error *err) {
  if (!o->tile)
    return o->view.m <= HSR_MAX_SIZE && o->view.n <= HSR_MAX_SIZE
               ? HSR_OK
               : hsr_fail(err, HSR_E_USAGE,
                          "--size %dx%d: a side above %d needs --tiles",
                          o->view.m, o->view.n, HSR_MAX_SIZE);
  const struct hsr_answer_type *kind = variant->choice.form.type;
  if (!has_tiles(variant))
    return hsr_fail(err, HSR_E_USAGE, "--tiles is not for %s, which %s draws",
                    kind->draws, variant->name);
  const char *why =
      kind->not_by_tiles ? kind->not_by_tiles(&variant->choice.form) : NULL;
  if (why)
    return hsr_fail(err, HSR_E_USAGE, "--tiles %s", why);
  if (o->n_outputs != 1 || !is_exr(o->output[0]))
    return hsr_fail(err, HSR_E_USAGE, "--tiles needs one -o FILE.exr");
  if (is_series(o) || o->work || o->given[HSR_SHADING] || o->supersamples > 1 ||
      o->has_background)
    return hsr_fail(
        err, HSR_E_USAGE,
        "--tiles makes the picture of one view; it does not go with "
        "--views, --orbit, --frames, --work, --shade, --supersample or "
        "--background");
  return HSR_OK;
}

/* Checks that --sheet goes with the rest. */
static enum hsr_status check_sheet(const struct render_options *o,
                                   struct hsr_error *err) {
  if (!o->sheet)
    return HSR_OK;
  if (is_series(o) || o->tile || o->sort_last || o->passes || o->page.crop ||
      (o->fill && !o->hatch))
    return hsr_fail(err, HSR_E_USAGE,
                    "--sheet makes one drawing of lines; it does not go with "
                    "--views, --orbit, --frames, --tiles, --sort-last, "
                    "--passes, --crop, or --fill without --hatch");
  if (o->view.camera.look)
    return hsr_fail(err, HSR_E_USAGE,
                    "--sheet names the views itself, as in "
                    "--sheet=front,top,%s; --%s is for a drawing of one",
                    o->view.camera.look, o->view.camera.look);
  for (int k = 0; k < o->n_outputs; k++)
    if (!hsr_is_paper_file(o->output[k]))
      return hsr_fail(err, HSR_E_USAGE,
                      "%.200s: --sheet is for .svg, .pdf, .eps and .dxf files",
                      o->output[k]);
  return HSR_OK;
}

/* Checks that --sort-last goes with the rest. */
static enum hsr_status check_parts(const struct render_options *o,
                                   const struct hsr_variant *variant,
                                   struct hsr_error *err) {
  const struct hsr_answer_type *kind = variant->choice.form.type;
  if (!o->sort_last)
    return HSR_OK;
  bool adds = kind->summing && kind->summing->fits(&variant->choice.form) &&
              hsr_makes_how(variant->listed->plain, kind) & HSR_SUMS;
  if (!hsr_choice_composes(variant->listed->plain, &variant->choice) && !adds)
    return hsr_fail(err, HSR_E_USAGE,
                    "--sort-last is not for %s, which %s draws: those of parts "
                    "do not make up that of the scene",
                    kind->draws, variant->name);
  if (is_series(o) || o->tile || o->work || o->has_background ||
      o->shading == HSR_SHADE_GOURAUD)
    return hsr_fail(err, HSR_E_USAGE,
                    "--sort-last makes one picture; it does not go with "
                    "--views, --orbit, --frames, --tiles, --work, "
                    "--background or --shade gouraud");
  return HSR_OK;
}

enum hsr_status check_options(const struct render_options *o,
                              const struct hsr_variant *variant,
                              struct hsr_error *err) {
  enum hsr_status status = check_series(o, err);
  if (!status)
    status = check_kind(o, variant, err);
  if (!status)
    status = check_files(o, err);
  if (!status)
    status = check_tiles(o, variant, err);
  if (!status)
    status = check_passes(o, variant, err);
  if (!status)
    status = check_sheet(o, err);
  return status ? status : check_parts(o, variant, err);
}
