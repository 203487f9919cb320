// SPDX-License-Identifier: GPL-3.0-or-later
// The encodings in which VTK's writers write.
#ifndef HSR_TESTS_UNIT_FILES_VTK_WAYS_H
#define HSR_TESTS_UNIT_FILES_VTK_WAYS_H

#include <vtkNew.h>
#include <vtkXMLWriter.h>

#include <cstdlib>
#include <string>

struct Encoding {
  enum Mode { TEXT, BINARY, RAW, BASE64 } mode;
  bool compressed, long_headers, big_endian;
};
constexpr const char *mode_names[] = {"text", "binary", "appended raw",
                                      "appended base64"};

/* What VTK writes of the data, in blocks of so many bytes. */
template <class Writer, class Data>
std::string write_by_vtk(Data *data, const Encoding &way, size_t block) {
  vtkNew<Writer> writer;
  writer->SetInputData(data);
  writer->WriteToOutputStringOn();
  writer->SetBlockSize(block);
  if (way.compressed)
    writer->SetCompressorTypeToZLib();
  else
    writer->SetCompressorTypeToNone();
  if (way.long_headers)
    writer->SetHeaderTypeToUInt64();
  else
    writer->SetHeaderTypeToUInt32();
  if (way.big_endian)
    writer->SetByteOrderToBigEndian();
  else
    writer->SetByteOrderToLittleEndian();
  writer->SetDataMode(way.mode == Encoding::TEXT     ? vtkXMLWriter::Ascii
                      : way.mode == Encoding::BINARY ? vtkXMLWriter::Binary
                                                     : vtkXMLWriter::Appended);
  writer->SetEncodeAppendedData(way.mode == Encoding::BASE64);
  if (!writer->Write())
    std::exit(99);
  return writer->GetOutputString();
}

#endif
