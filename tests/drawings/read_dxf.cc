// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a .dxf file by dxflib's own reader, for drawings.test.
//
//   read_dxf lengths FILE   mm of line by layer, in the file's order
//   read_dxf tables FILE    the unit; line types with their dashes; layers with
//                           their line types and widths
//
// It ends with 1 if the file cannot be read, or holds what hsr does not write.
#include <dxflib/dl_creationadapter.h>
#include <dxflib/dl_dxf.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

namespace {

class Reader : public DL_CreationAdapter {
public:
  int unit = -1;
  bool strange = false;
  std::vector<std::string> tables; // lines of text
  std::vector<std::string> layers; // with lines
  std::map<std::string, double> length;

  void setVariableInt(const std::string &key, int value, int) override {
    if (key == "$INSUNITS")
      unit = value;
  }
  void addLinetype(const DL_LinetypeData &type) override {
    tables.push_back("type " + type.name + dashes_);
    dashes_.clear();
  }
  void addLinetypeDash(double dash) override {
    char text[40];
    std::snprintf(text, sizeof text, " %g", dash);
    dashes_ += text;
  }
  void addLayer(const DL_LayerData &layer) override {
    tables.push_back("layer " + layer.name + " " + attributes.getLinetype() +
                     " " + std::to_string(attributes.getWidth()));
  }

  void addPolyline(const DL_PolylineData &line) override {
    closed_ = line.flags & 1;
    at_.clear();
  }
  void addVertex(const DL_VertexData &vertex) override {
    strange |= vertex.z != 0 || vertex.bulge != 0;
    at_.push_back({vertex.x, vertex.y});
  }
  void endEntity() override {
    const std::string layer = attributes.getLayer();
    if (at_.empty())
      return;
    if (closed_)
      at_.push_back(at_.front());
    if (!length.count(layer))
      layers.push_back(layer);
    for (size_t k = 1; k < at_.size(); k++)
      length[layer] +=
          std::hypot(at_[k].x - at_[k - 1].x, at_[k].y - at_[k - 1].y);
    at_.clear();
  }

  // hsr writes none of these.
  void addLine(const DL_LineData &) override { strange = true; }
  void addArc(const DL_ArcData &) override { strange = true; }
  void addSpline(const DL_SplineData &) override { strange = true; }
  void addText(const DL_TextData &) override { strange = true; }

private:
  struct Point {
    double x, y;
  };
  std::vector<Point> at_;
  bool closed_ = false;
  std::string dashes_;
};

} // namespace

int main(int argc, char **argv) {
  Reader reader;
  DL_Dxf dxf;
  if (argc != 3 || !dxf.in(argv[2], &reader) || reader.strange)
    return 1;
  if (std::string(argv[1]) == "lengths") {
    for (const std::string &layer : reader.layers)
      std::printf("%s %.1f\n", layer.c_str(), reader.length[layer]);
    return 0;
  }
  std::printf("unit %d\n", reader.unit);
  for (const std::string &line : reader.tables)
    std::puts(line.c_str());
  return 0;
}
