// SPDX-License-Identifier: GPL-3.0-or-later
// .vtp files, through VTK. A part of hsr-vtk.so.
//
// Safety      see common/files/vtk/mesh_scan_vtp.cc: VTK sees what the scan
//             passes, and must find in it what the scan found.
// Memory      at once: the file, what VTK makes of one piece, and the object.

#include "common/files/mesh/mesh_file.h"
#include "common/files/vtk/vtk_library.h"
#include "common/files/vtk/vtk_parts.h"
#include "common/files/vtk/xml_reader.h"

#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkExecutive.h>
#include <vtkIdList.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <new>

using hsr::Mesh_extent;

namespace {

/* The first complaint of a reader or its parser, on one line. */
struct Complaint {
  std::string text;

  static void note(vtkObject *, unsigned long, void *data, void *message) {
    Complaint &self = *static_cast<Complaint *>(data);
    if (!self.text.empty() || !message)
      return;
    /* "ERROR: In file, line N\nvtkClass (0x...): what is wrong\n\n" */
    std::string text = static_cast<const char *>(message);
    const size_t colon = text.find("): ");
    self.text = colon == std::string::npos ? text : text.substr(colon + 3);
    self.text.resize(std::min(self.text.find('\n'), self.text.size()));
    while (!self.text.empty() &&
           std::isspace(static_cast<unsigned char>(self.text.back())))
      self.text.pop_back();
  }
};

/* What VTK reads, piece by piece, must be what the scan found. */
class Piece_builder {
public:
  explicit Piece_builder(hsr::Vtk_sink &sink) : sink_(sink) {}
  void add(vtkPolyData *data);
  void check(const Mesh_extent &extent) const;

private:
  void add_cells(vtkCellArray *cells, bool strips, const unsigned char *rgb);
  void add_strip();
  void refuse() const { /* throws */
    sink_.refuse("VTK does not read what the file holds");
  }

  hsr::Vtk_sink &sink_;
  Mesh_extent found_;
  size_t first_ = 0; /* vertex of the piece */
  std::vector<uint32_t> corners_;
};

void Piece_builder::add(vtkPolyData *data) {
  first_ = found_.n_vertices;
  vtkPoints *points = data->GetPoints();
  const vtkIdType n = points ? points->GetNumberOfPoints() : 0;
  for (vtkIdType v = 0; v < n; v++) {
    double p[3];
    points->GetPoint(v, p);
    sink_.vertex(p);
    found_.n_vertices++;
  }
  auto *colours = vtkUnsignedCharArray::SafeDownCast(
      data->GetCellData()->GetArray("colour"));
  const vtkIdType n_polys = data->GetNumberOfPolys();
  if (colours && (colours->GetNumberOfComponents() != 3 ||
                  colours->GetNumberOfTuples() != n_polys ||
                  data->GetNumberOfCells() != n_polys))
    refuse();
  add_cells(data->GetPolys(), false,
            colours ? colours->GetPointer(0) : nullptr);
  add_cells(data->GetStrips(), true, nullptr);
}

/* rgb: 3 bytes a cell, or NULL */
void Piece_builder::add_cells(vtkCellArray *cells, bool strips,
                              const unsigned char *rgb) {
  vtkNew<vtkIdList> ids;
  vtkIdType left = cells->GetNumberOfConnectivityIds();
  for (vtkIdType c = 0; c < cells->GetNumberOfCells(); c++) {
    const vtkIdType size = cells->GetCellSize(c);
    if (size < 0 || size > left)
      refuse();
    left -= size;
    cells->GetCellAtId(c, ids);
    corners_.clear();
    for (vtkIdType k = 0; k < size; k++) {
      const size_t vertex = first_ + static_cast<size_t>(ids->GetId(k));
      if (vertex < first_ || vertex >= found_.n_vertices)
        refuse();
      corners_.push_back(static_cast<uint32_t>(vertex));
    }
    found_.n_faces++;
    found_.n_corners += corners_.size();
    if (strips)
      add_strip();
    else
      sink_.face(corners_.data(), corners_.size(), rgb ? rgb + 3 * c : nullptr);
  }
}

/* Every second triangle of a strip is wound the other way round. */
void Piece_builder::add_strip() {
  for (size_t k = 2; k < corners_.size(); k++) {
    const uint32_t triangle[3] = {corners_[k - 2], corners_[k - 1 + k % 2],
                                  corners_[k - k % 2]};
    sink_.face(triangle, 3, nullptr);
  }
}

void Piece_builder::check(const Mesh_extent &extent) const {
  if (found_.n_vertices != extent.n_vertices ||
      found_.n_faces != extent.n_faces || found_.n_corners != extent.n_corners)
    refuse();
}

} // namespace

/* A piece at a time: VTK 9.1 numbers the corners of a piece's faces wrongly if
 * it is the first that has faces of the kind, but not the first piece. */
void hsr::read_vtp(char *begin, char *end, const Mesh_extent &extent,
                   Vtk_sink &sink) {
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  Complaint complaint;
  vtkNew<vtkCallbackCommand> listener;
  listener->SetClientData(&complaint);
  listener->SetCallback(Complaint::note);
  vtkNew<hsr::Memory_reader<vtkXMLPolyDataReader>> reader;
  reader->AddObserver(vtkCommand::ErrorEvent, listener);
  reader->AddObserver(vtkCommand::WarningEvent, listener);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, listener);
  reader->SetReaderErrorObserver(listener);
  reader->SetParserErrorObserver(listener);
  reader->set_input(begin, end);
  const auto check = [&] {
    if (complaint.text.empty() && !reader->GetErrorCode())
      return;
    if (errno == ENOMEM)
      throw std::bad_alloc();
    sink.refuse(complaint.text.empty() ? "VTK cannot read it"
                                       : complaint.text.c_str());
  };
  errno = 0; /* where lack of memory shows */
  reader->UpdateInformation();
  check();
  Piece_builder pieces(sink);
  const int n_pieces = static_cast<int>(reader->GetNumberOfPieces());
  for (int piece = 0; piece < n_pieces; piece++) {
    reader->UpdatePiece(piece, n_pieces, 0);
    check();
    pieces.add(reader->GetOutput());
  }
  pieces.check(extent);
}

extern "C" {
extern const struct hsr_vtk_library hsr_vtk;
const struct hsr_vtk_library hsr_vtk = {hsr::read_vtp, hsr::write_vtp,
                                        hsr::write_polygons, hsr::write_vti,
                                        hsr::open_volume};
}
