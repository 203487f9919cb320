// SPDX-License-Identifier: GPL-3.0-or-later
// DXF of AutoCAD 2000, by dxflib. A stroke is a polyline. Its line type runs on
// through its corners. A program of CAD lays the dashes itself, so they do not
// end at corners as on paper.

#include "common/files/whole_file.h"
#include "common/paper/dashes.h"
#include "common/paper/plot_files.h"

#include <dxflib/dl_dxf.h>

#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <new>
#include <set>
#include <string>
#include <vector>

namespace {

class Dxf {
public:
  Dxf(const hsr_plot *plot, const char *path) : plot_(plot), out_(path) {}
  void write();

private:
  void header();
  void line_types();
  void layers();
  void tables();
  void entities();
  void stroke(const hsr_stroke &stroke, const hsr_line_pen &pen);
  void polyline(const std::vector<double> &xy, bool closed);

  void name_layers();
  std::string type_name(uint32_t pen) const;
  DL_Attributes attributes(size_t layer, uint32_t pen) const;

  const hsr_plot *plot_;
  std::vector<std::string> name_; // of layers
  DL_Dxf dxf_;
  DL_WriterA out_;
  DL_Attributes now_; // of the strokes at hand
  std::vector<double> cut_;
};

// A name as DXF of AutoCAD 2000 takes it: ASCII without some signs. \U+00E9 is a
// character by its number.
std::string name_of(const char *text) {
  std::string name;
  uint32_t code;
  for (int n; *text; text += n ? n : 1) {
    n = hsr_plot_character(text, &code);
    if (n == 0 || code > 0xffff || std::strchr("<>/\\\":;?*|,=`", int(code)))
      name += '_';
    else if (n == 1)
      name += *text;
    else {
      char number[8];
      std::snprintf(number, sizeof number, "\\U+%04X", code);
      name += number;
    }
  }
  return name;
}

std::string small_letters(std::string name) {
  for (char &c : name)
    c = char(std::tolower(static_cast<unsigned char>(c)));
  return name;
}

// Names of layers differ, and not only in small letters and capitals. Layer 0 is
// of the format itself.
void Dxf::name_layers() {
  std::set<std::string> taken{"0"};
  for (size_t k = 0; k < plot_->n_layers; k++) {
    const hsr_plot_layer &layer = plot_->layer[k];
    std::string name =
        name_of(layer.title && *layer.title ? layer.title : layer.id);
    while (!taken.insert(small_letters(name)).second)
      name += std::string(" ") + layer.id;
    name_.push_back(name);
  }
}

// LibreCAD knows these names, and draws such lines by dashes of its own. Those of
// other types are solid there.
std::string Dxf::type_name(uint32_t pen) const {
  static const char *const known[] = {"DASHEDTINY", "DASHED2", "DASHED",
                                      "DASHEDX2"};
  const auto is_dashed = [this](uint32_t k) {
    return plot_->pens.pen[k].dash > 0 && !plot_->cuts_dashes;
  };
  size_t before = 0; // dashed pens
  for (uint32_t k = 0; k < pen; k++)
    before += is_dashed(k);
  return !is_dashed(pen) ? "CONTINUOUS"
         : before < sizeof known / sizeof *known
             ? known[before]
             : "DASHED" + std::to_string(pen);
}

// The nearest width that DXF has, in 1/100 mm.
int width_of(double mm) {
  static const int widths[] = {5,   9,   13,  15,  18,  20,  25, 30,
                               35,  40,  50,  53,  60,  70,  80, 90,
                               100, 106, 120, 140, 158, 200, 211};
  int best = widths[0];
  for (int w : widths)
    if (std::abs(w - 100 * mm) < std::abs(best - 100 * mm))
      best = w;
  return best;
}

// Black is the colour 7: black on white, and white on black.
DL_Attributes Dxf::attributes(size_t layer, uint32_t pen) const {
  const hsr_line_pen &p = plot_->pens.pen[pen];
  const int rgb = p.rgb[0] << 16 | p.rgb[1] << 8 | p.rgb[2];
  return {name_[layer], 7, rgb ? rgb : -1, width_of(p.width), type_name(pen)};
}

void Dxf::header() {
  dxf_.writeHeader(out_);
  out_.dxfString(9, "$INSUNITS"); // millimetres
  out_.dxfInt(70, 4);
  out_.dxfString(9, "$MEASUREMENT"); // metric
  out_.dxfInt(70, 1);
  const double size[2] = {plot_->layout.width / HSR_PIXELS_PER_MM,
                          plot_->layout.height / HSR_PIXELS_PER_MM};
  for (const bool max : {false, true}) {
    out_.dxfString(9, max ? "$EXTMAX" : "$EXTMIN");
    out_.dxfReal(10, max ? size[0] : 0);
    out_.dxfReal(20, max ? size[1] : 0);
    out_.dxfReal(30, 0);
  }
  out_.sectionEnd();
}

void Dxf::line_types() {
  out_.tableLinetypes(3 + int(plot_->pens.n));
  for (const char *name : {"BYBLOCK", "BYLAYER", "CONTINUOUS"})
    dxf_.writeLinetype(out_, DL_LinetypeData(name, name, 0, 0, 0));
  for (uint32_t k = 0; k < plot_->pens.n; k++) {
    const hsr_line_pen &pen = plot_->pens.pen[k];
    double pattern[2] = {pen.dash, -pen.gap};
    if (type_name(k) != "CONTINUOUS")
      dxf_.writeLinetype(out_, DL_LinetypeData(type_name(k), "dashed", 0, 2,
                                               pen.dash + pen.gap, pattern));
  }
  out_.tableEnd();
}

void Dxf::layers() {
  out_.tableLayers(1 + int(plot_->n_layers));
  dxf_.writeLayer(out_, DL_LayerData("0", 0),
                  DL_Attributes("", 7, 25, "CONTINUOUS", 1));
  for (size_t k = 0; k < plot_->n_layers; k++) {
    const hsr_plot_layer &layer = plot_->layer[k];
    DL_Attributes a = attributes(k, plot_->group[layer.first].pen);
    a.setColor24(-1);
    dxf_.writeLayer(out_, DL_LayerData(name_[k], 0), a);
  }
  out_.tableEnd();
}

void Dxf::tables() {
  out_.sectionTables();
  dxf_.writeVPort(out_);
  line_types();
  layers();
  out_.tableStyle(1);
  dxf_.writeStyle(out_,
                  DL_StyleData("Standard", 0, 0, 1, 0, 0, 2.5, "txt", ""));
  out_.tableEnd();
  dxf_.writeView(out_);
  dxf_.writeUcs(out_);
  out_.tableAppid(1);
  dxf_.writeAppid(out_, "ACAD");
  out_.tableEnd();
  dxf_.writeDimStyle(out_, 1, 1, 1, 1, 1);
  dxf_.writeBlockRecord(out_);
  out_.tableEnd();
  out_.sectionEnd();
  out_.sectionBlocks();
  for (const char *name : {"*Model_Space", "*Paper_Space", "*Paper_Space0"}) {
    dxf_.writeBlock(out_, DL_BlockData(name, 0, 0, 0, 0));
    dxf_.writeEndBlock(out_, name);
  }
  out_.sectionEnd();
}

// 128: the line type runs on through the corners.
void Dxf::polyline(const std::vector<double> &xy, bool closed) {
  const int n = int(xy.size() / 2);
  if (n < 2)
    return;
  dxf_.writePolyline(out_, DL_PolylineData(n, 0, 0, 128 | (closed ? 1 : 0)),
                     now_);
  for (size_t k = 0; k < xy.size(); k += 2)
    dxf_.writeVertex(out_, DL_VertexData(xy[k] / HSR_PIXELS_PER_MM,
                                         (plot_->layout.height - xy[k + 1]) /
                                             HSR_PIXELS_PER_MM));
  dxf_.writePolylineEnd(out_);
}

void Dxf::stroke(const hsr_stroke &stroke, const hsr_line_pen &pen) {
  const double(*at)[2] = plot_->strokes.at + stroke.first;
  cut_.clear();
  if (!(pen.dash > 0 && plot_->cuts_dashes)) {
    for (size_t k = 0; k < stroke.n; k++)
      cut_.insert(cut_.end(), at[k], at[k] + 2);
    polyline(cut_, stroke.closed);
    return;
  }
  hsr_dashes dashes{};
  const hsr_status status = hsr_dashes_find(
      &dashes, at, stroke.n, stroke.closed, pen.dash * HSR_PIXELS_PER_MM,
      pen.gap * HSR_PIXELS_PER_MM, nullptr);
  hsr_dashes_cut(
      &dashes, at, stroke.n, stroke.closed, this,
      [](void *on, const double place[2]) {
        Dxf *dxf = static_cast<Dxf *>(on);
        dxf->polyline(dxf->cut_, false);
        dxf->cut_.assign(place, place + 2);
      },
      [](void *on, const double place[2]) {
        Dxf *dxf = static_cast<Dxf *>(on);
        dxf->cut_.insert(dxf->cut_.end(), place, place + 2);
      });
  polyline(cut_, false);
  hsr_dashes_free(&dashes);
  if (status)
    throw std::bad_alloc();
}

void Dxf::entities() {
  out_.sectionEntities();
  for (size_t l = 0; l < plot_->n_layers; l++) {
    const hsr_plot_layer &layer = plot_->layer[l];
    for (size_t g = layer.first; g < layer.first + layer.n; g++) {
      const hsr_plot_group &group = plot_->group[g];
      now_ = attributes(l, group.pen);
      for (size_t k = group.first; k < group.first + group.n; k++)
        stroke(plot_->strokes.stroke[k], plot_->pens.pen[group.pen]);
    }
  }
  out_.sectionEnd();
}

void Dxf::write() {
  name_layers();
  header();
  tables();
  entities();
  dxf_.writeObjects(out_);
  dxf_.writeObjectsEnd(out_);
  out_.dxfEOF();
  out_.close();
}

// dxflib does not say whether its bytes were written; whether its last ones are
// there, says so.
bool is_whole(const char *path) {
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  char end[8] = "";
  if (!in || in.tellg() < 4)
    return false;
  in.seekg(-4, std::ios::end);
  in.read(end, 4);
  return !std::strncmp(end, "EOF\n", 4);
}

} // namespace

hsr_status hsr_plot_write_dxf(const hsr_plot *plot, const char *path,
                              hsr_error *err) {
  hsr_whole_file file;
  hsr_status status = hsr_whole_file_open(&file, path, err);
  if (status)
    return status;
  try {
    Dxf(plot, file.part).write();
    if (!is_whole(file.part))
      status = hsr_fail(err, HSR_E_INPUT, "%s: cannot be written", path);
  } catch (const std::bad_alloc &) {
    status = hsr_fail_nomem(err);
  } catch (...) {
    status = hsr_fail(err, HSR_E_INTERNAL, "%s: writing DXF failed", path);
  }
  return hsr_whole_file_close(&file, status, err);
}
