// SPDX-License-Identifier: GPL-3.0-or-later
// Volumes, through VTK. A part of hsr-vtk.so.
//
// Safety      see common/files/volume/volume_check.c: VTK sees only files that
//             passed, and must find in them what was found there.
// Memory      at once: the samples, in the type of the file; of VTK's formats,
//             and of packed ones, the file's bytes, too.

#include "common/files/vtk/vtk_parts.h"
#include "common/files/vtk/xml_reader.h"

#include <vtkCallbackCommand.h>
#include <vtkDataArray.h>
#include <vtkExecutive.h>
#include <vtkImageData.h>
#include <vtkImageReader2.h>
#include <vtkLogger.h>
#include <vtkMetaImageReader.h>
#include <vtkNIFTIImageReader.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPointData.h>
#include <vtkRectilinearGrid.h>
#include <vtkRectilinearGridReader.h>
#include <vtkSmartPointer.h>
#include <vtkStructuredPoints.h>
#include <vtkStructuredPointsReader.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLRectilinearGridReader.h>

#include <cerrno>
#include <cstdlib>
#include <memory>
#include <new>
#include <string>

namespace {

struct Failure {
  std::string text;
};

/* Whether a reader complained. */
struct Listener {
  bool complained = false;
  vtkNew<vtkCallbackCommand> command;

  Listener() {
    command->SetClientData(this);
    command->SetCallback([](vtkObject *, unsigned long, void *data, void *) {
      static_cast<Listener *>(data)->complained = true;
    });
  }
  void listen(vtkAlgorithm *to) {
    to->AddObserver(vtkCommand::ErrorEvent, command);
    to->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, command);
  }
};

/* What VTK read, and its samples. */
struct Samples {
  vtkSmartPointer<vtkDataSet> data;
  vtkSmartPointer<vtkDataArray> values;
};

template <class Reader>
vtkSmartPointer<vtkDataSet> read(Reader *reader, Listener &listener) {
  listener.listen(reader);
  errno = 0; /* where lack of memory shows */
  reader->Update();
  if (errno == ENOMEM)
    throw std::bad_alloc();
  if (listener.complained || reader->GetErrorCode())
    throw Failure{"VTK cannot read it"};
  return reader->GetOutput();
}

template <class Reader> vtkSmartPointer<vtkDataSet> read(Reader *reader) {
  Listener listener;
  return read(reader, listener);
}

template <class Reader>
vtkSmartPointer<vtkDataSet> read_image(const hsr_volume_file &file) {
  vtkNew<Reader> reader;
  reader->SetFileName(file.path);
  return read(reader.Get());
}

template <class Reader>
vtkSmartPointer<vtkDataSet> read_text(const hsr_volume_file &file) {
  vtkNew<Reader> reader;
  reader->ReadFromInputStringOn();
  reader->SetBinaryInputString(file.text, static_cast<int>(file.size));
  return read(reader.Get());
}

template <class Reader>
vtkSmartPointer<vtkDataSet> read_xml(const hsr_volume_file &file) {
  Listener listener;
  vtkNew<hsr::Memory_reader<Reader>> reader;
  reader->SetParserErrorObserver(listener.command);
  reader->AddObserver(vtkCommand::WarningEvent, listener.command);
  reader->set_input(file.text, file.text + file.size);
  return read(reader.Get(), listener);
}

vtkSmartPointer<vtkDataSet> read_file(const hsr_volume_file &file) {
  switch (file.format) {
  case HSR_NIFTI:
    return read_image<vtkNIFTIImageReader>(file);
  case HSR_META_IMAGE:
    return read_image<vtkMetaImageReader>(file);
  case HSR_VTK_IMAGE:
    return read_xml<vtkXMLImageDataReader>(file);
  case HSR_VTK_GRID:
    return read_xml<vtkXMLRectilinearGridReader>(file);
  case HSR_VTK_LEGACY:
    break;
  }
  if (file.size > size_t{INT_MAX})
    throw Failure{"is over 2^31 bytes long, more than VTK reads so"};
  return file.is_rectilinear ? read_text<vtkRectilinearGridReader>(file)
                             : read_text<vtkStructuredPointsReader>(file);
}

/* Of the XML formats, the one array of points is not marked as scalars. */
vtkDataArray *scalars(vtkDataSet *data) {
  vtkDataArray *named = data->GetPointData()->GetScalars();
  return named ? named : data->GetPointData()->GetArray(0);
}

void sizes(vtkDataSet *data, int n[3]) {
  if (auto *image = vtkImageData::SafeDownCast(data))
    image->GetDimensions(n);
  else if (auto *grid = vtkRectilinearGrid::SafeDownCast(data))
    grid->GetDimensions(n);
}

double *positions(vtkDataSet *data, int axis, uint32_t n) {
  auto *at = static_cast<double *>(std::malloc(n * sizeof(double)));
  if (!at)
    throw std::bad_alloc();
  if (auto *image = vtkImageData::SafeDownCast(data)) {
    const double first = image->GetExtent()[2 * axis];
    for (uint32_t k = 0; k < n; k++)
      at[k] =
          image->GetOrigin()[axis] + image->GetSpacing()[axis] * (first + k);
    return at;
  }
  auto *grid = vtkRectilinearGrid::SafeDownCast(data);
  vtkDataArray *from = axis == 0   ? grid->GetXCoordinates()
                       : axis == 1 ? grid->GetYCoordinates()
                                   : grid->GetZCoordinates();
  for (uint32_t k = 0; k < n; k++)
    at[k] = k < from->GetNumberOfTuples() ? from->GetComponent(k, 0) : 0;
  return at;
}

template <class T> void copy(const T *from, size_t n, float *to) {
  for (size_t k = 0; k < n; k++)
    to[k] = static_cast<float>(from[k]);
}

struct Open {
  Samples samples;
  size_t slice; /* samples */
};

enum hsr_status slice(void *data, uint32_t k, float *density,
                      struct hsr_error *) {
  const Open &open = *static_cast<Open *>(data);
  vtkDataArray *values = open.samples.values;
  const auto first = static_cast<vtkIdType>(k * open.slice);
  switch (values->GetDataType()) {
    vtkTemplateMacro(copy(static_cast<VTK_TT *>(values->GetVoidPointer(first)),
                          open.slice, density));
  default:
    break;
  }
  return HSR_OK;
}

void close(void *data) {
  delete static_cast<Open *>(data);
}

void open(hsr_volume *volume, const hsr_volume_file &file) {
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  auto made = std::make_unique<Open>();
  made->samples.data = read_file(file);
  vtkDataSet *data = made->samples.data;
  int n[3] = {0, 0, 0};
  sizes(data, n);
  made->samples.values = scalars(data);
  vtkDataArray *values = made->samples.values;
  made->slice = size_t{file.n[0]} * file.n[1];
  for (int a = 0; a < 3; a++)
    if (n[a] < 0 || static_cast<uint32_t>(n[a]) != file.n[a])
      throw Failure{"VTK does not read what the file holds"};
  if (!values || values->GetNumberOfComponents() != 1 ||
      values->GetNumberOfTuples() != data->GetNumberOfPoints())
    throw Failure{"has not one number a sample"};
  for (int a = 0; a < 3; a++) {
    volume->n[a] = file.n[a];
    volume->position[a] = positions(data, a, file.n[a]);
  }
  volume->slice = slice;
  volume->close = close;
  volume->data = made.release();
}

} // namespace

enum hsr_status hsr::open_volume(struct hsr_volume *volume,
                                 const struct hsr_volume_file *file,
                                 struct hsr_error *err) noexcept {
  *volume = {};
  try {
    open(volume, *file);
    return HSR_OK;
  } catch (const Failure &f) {
    return hsr_fail(err, HSR_E_INPUT, "%.200s: %s", file->path, f.text.c_str());
  } catch (const std::bad_alloc &) {
    return hsr_fail_nomem(err);
  } catch (...) {
    return hsr_fail(err, HSR_E_INTERNAL, "VTK: failed");
  }
}
