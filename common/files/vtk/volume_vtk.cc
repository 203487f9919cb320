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
#include <vtkLogger.h>
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
  bool slices_are_turned = false; /* the last slice of the file is the first */
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

/* VTK turns the slices of a left-handed frame round. */
vtkSmartPointer<vtkDataSet> read_nifti(const hsr_volume_file &file,
                                       bool &slices_are_turned) {
  vtkNew<vtkNIFTIImageReader> reader;
  reader->SetFileName(file.path);
  vtkSmartPointer<vtkDataSet> data = read(reader.Get());
  slices_are_turned = reader->GetQFac() < 0;
  return data;
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

vtkSmartPointer<vtkDataSet> read_file(const hsr_volume_file &file,
                                      bool &slices_are_turned) {
  switch (file.format) {
  case HSR_NIFTI:
    return read_nifti(file, slices_are_turned);
  case HSR_VTK_IMAGE:
    return read_xml<vtkXMLImageDataReader>(file);
  case HSR_VTK_GRID:
    return read_xml<vtkXMLRectilinearGridReader>(file);
  case HSR_META_IMAGE:
  case HSR_NRRD:
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

double place(vtkDataSet *data, int axis, uint32_t k) {
  if (auto *image = vtkImageData::SafeDownCast(data))
    return image->GetOrigin()[axis] +
           image->GetSpacing()[axis] *
               (double(image->GetExtent()[2 * axis]) + k);
  auto *grid = vtkRectilinearGrid::SafeDownCast(data);
  vtkDataArray *from = axis == 0   ? grid->GetXCoordinates()
                       : axis == 1 ? grid->GetYCoordinates()
                                   : grid->GetZCoordinates();
  return k < from->GetNumberOfTuples() ? from->GetComponent(k, 0) : 0;
}

double *positions(vtkDataSet *data, int axis, uint32_t n) {
  auto *at = static_cast<double *>(std::malloc(n * sizeof(double)));
  if (!at)
    throw std::bad_alloc();
  for (uint32_t k = 0; k < n; k++)
    at[k] = place(data, axis, k);
  return at;
}

struct Open {
  Samples samples;
  hsr_volume_way way;
  double slope, intercept;
};

template <class T>
void copy(const Open &open, uint32_t k, const T *from, float *to) {
  const hsr_volume_way &way = open.way;
  from += way.first + ptrdiff_t(k) * way.step[2];
  for (uint32_t j = 0; j < way.n[1]; j++, from += way.step[1])
    for (uint32_t i = 0; i < way.n[0]; i++)
      *to++ = static_cast<float>(
          open.slope * static_cast<double>(from[ptrdiff_t(i) * way.step[0]]) +
          open.intercept);
}

enum hsr_status slice(void *data, uint32_t k, float *density,
                      struct hsr_error *) {
  const Open &open = *static_cast<Open *>(data);
  vtkDataArray *values = open.samples.values;
  switch (values->GetDataType()) {
    vtkTemplateMacro(copy(
        open, k, static_cast<VTK_TT *>(values->GetVoidPointer(0)), density));
  default:
    break;
  }
  return HSR_OK;
}

void close(void *data) {
  delete static_cast<Open *>(data);
}

/* Of samples whose slices VTK has turned round. */
void turn_slices(hsr_volume_way &way, const hsr_volume_file &file) {
  for (int a = 0; a < 3; a++)
    if (file.place.axis[a] == 2) {
      way.first += way.step[a] * ptrdiff_t(way.n[a] - 1);
      way.step[a] = -way.step[a];
    }
}

void open(hsr_volume *volume, const hsr_volume_file &file) {
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  auto made = std::make_unique<Open>();
  Samples &samples = made->samples;
  samples.data = read_file(file, samples.slices_are_turned);
  int n[3] = {0, 0, 0};
  sizes(samples.data, n);
  samples.values = scalars(samples.data);
  for (int a = 0; a < 3; a++)
    if (n[a] < 0 || static_cast<uint32_t>(n[a]) != file.n[a])
      throw Failure{"VTK does not read what the file holds"};
  if (!samples.values || samples.values->GetNumberOfComponents() != 1 ||
      samples.values->GetNumberOfTuples() != samples.data->GetNumberOfPoints())
    throw Failure{"has not one number a sample"};
  made->slope = file.slope;
  made->intercept = file.intercept;
  made->way = file.way;
  if (samples.slices_are_turned)
    turn_slices(made->way, file);
  for (int a = 0; a < 3; a++) {
    volume->n[a] = file.way.n[a];
    if (!file.has_place)
      volume->position[a] = positions(samples.data, a, file.n[a]);
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
