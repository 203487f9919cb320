// SPDX-License-Identifier: GPL-3.0-or-later
// .vtp files, through VTK.

#include "common/exchange.h"
#include "common/mesh_file.h"

#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkExecutive.h>
#include <vtkIdList.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <cctype>
#include <cerrno>
#include <limits>
#include <new>

namespace hsr {

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
    while (!self.text.empty() &&
           std::isspace(static_cast<unsigned char>(self.text.back())))
      self.text.pop_back();
  }
};

size_t line_of(const Mesh_file &file, const char *at) {
  size_t line = 1;
  for (const char *c = file.begin; c < at; c++)
    line += *c == '\n';
  return line;
}

/* VTK allocates what the attributes NumberOf... claim. A number takes at least
 * a byte of a file that is not compressed, and deflate makes nothing more than
 * 1032 times as small. */
void check_claims(const Mesh_file &file) {
  const std::string_view text(file.begin, file.size());
  const bool packed = text.find("compressor=") != std::string_view::npos;
  const size_t most = packed ? 1032 * file.size() : file.size();
  constexpr std::string_view name = "NumberOf";
  for (size_t at = text.find(name); at != std::string_view::npos;
       at = text.find(name, at + 1)) {
    const size_t quote = text.find_first_of("\"'>", at);
    if (quote == std::string_view::npos || text[quote] == '>')
      continue;
    size_t number = 0, k = quote + 1;
    for (; k < text.size() && std::isdigit(static_cast<unsigned char>(text[k]));
         k++)
      if (number <= most)
        number = 10 * number + size_t(text[k] - '0');
    if (number > most)
      file.refuse(line_of(file, file.begin + at),
                  "claims more than a file of %zu bytes can hold", file.size());
  }
}

/* VTK loses memory over points of other than three components. */
void check_points(const Mesh_file &file) {
  const std::string_view text(file.begin, file.size());
  constexpr std::string_view name = " NumberOfComponents";
  for (size_t at = text.find("<Points"); at != std::string_view::npos;
       at = text.find("<Points", at + 1)) {
    const size_t tag = text.find("<DataArray", at);
    if (tag == std::string_view::npos)
      continue;
    const std::string_view array = text.substr(tag, text.find('>', tag) - tag);
    const size_t number = array.find(name);
    const std::string_view value = number == std::string_view::npos
                                       ? std::string_view()
                                       : array.substr(number + name.size());
    if (value.substr(0, 4) != "=\"3\"" && value.substr(0, 4) != "='3'")
      file.refuse(line_of(file, array.data()),
                  "has points of other than 3 coordinates");
  }
}

void add_cells(vtkCellArray *cells, bool strips, Mesh_builder &builder) {
  vtkNew<vtkIdList> ids;
  std::vector<uint32_t> corners;
  for (vtkIdType c = 0; c < cells->GetNumberOfCells(); c++) {
    cells->GetCellAtId(c, ids);
    corners.clear();
    for (vtkIdType k = 0; k < ids->GetNumberOfIds(); k++) {
      const vtkIdType id = ids->GetId(k);
      corners.push_back(id < 0 || id > std::numeric_limits<uint32_t>::max()
                            ? std::numeric_limits<uint32_t>::max()
                            : static_cast<uint32_t>(id));
    }
    if (!strips) {
      builder.face(corners.data(), corners.size(), nullptr);
      continue;
    }
    /* Every second triangle of a strip is wound the other way round. */
    for (size_t k = 2; k < corners.size(); k++) {
      const uint32_t triangle[3] = {corners[k - 2], corners[k - 1 + k % 2],
                                    corners[k - k % 2]};
      builder.face(triangle, 3, nullptr);
    }
  }
}

void build(const Mesh_file &file, vtkPolyData *data, Mesh_builder &builder) {
  if (data->GetVerts()->GetNumberOfCells() ||
      data->GetLines()->GetNumberOfCells())
    file.refuse(0, "holds vertices or lines as cells; only polygons and "
                   "triangle strips make faces");
  vtkPoints *points = data->GetPoints();
  const vtkIdType n = points ? points->GetNumberOfPoints() : 0;
  for (vtkIdType v = 0; v < n; v++) {
    double p[3];
    points->GetPoint(v, p);
    builder.vertex(p[0], p[1], p[2]);
  }
  add_cells(data->GetPolys(), false, builder);
  add_cells(data->GetStrips(), true, builder);
}

} // namespace

void vtp_read(Mesh_file &file, Mesh_builder &builder) {
  const std::string_view text(file.begin, file.size());
  const size_t tag = text.find("<VTKFile");
  if (tag == std::string_view::npos)
    file.refuse(1, "is no VTK XML file");
  const std::string_view head = text.substr(tag, text.find('>', tag) - tag);
  if (head.find("PolyData") == std::string_view::npos)
    file.refuse(line_of(file, head.data()), "holds no polygonal data");
  check_claims(file);
  check_points(file);

  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  Complaint complaint;
  vtkNew<vtkCallbackCommand> listener;
  listener->SetClientData(&complaint);
  listener->SetCallback(Complaint::note);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->AddObserver(vtkCommand::ErrorEvent, listener);
  reader->AddObserver(vtkCommand::WarningEvent, listener);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, listener);
  reader->SetReaderErrorObserver(listener);
  reader->SetParserErrorObserver(listener);
  reader->ReadFromInputStringOn();
  reader->SetInputString(std::string(text));
  errno = 0;
  reader->Update();
  if (!complaint.text.empty() || reader->GetErrorCode()) {
    if (errno == ENOMEM)
      throw std::bad_alloc();
    file.refuse(0, "%.200s",
                complaint.text.empty() ? "VTK cannot read it"
                                       : complaint.text.c_str());
  }
  vtkPolyData *data = reader->GetOutput();
  if (!data)
    file.refuse(0, "holds no polygonal data");
  build(file, data, builder);
}

} // namespace hsr

bool hsr_exchange_has_vtk(void) {
  return true;
}
