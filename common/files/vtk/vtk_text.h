// SPDX-License-Identifier: GPL-3.0-or-later
// Writing files of VTK's XML formats. The text is made in memory first, so that
// all of it is written, or nothing.
#ifndef HSR_COMMON_VTK_TEXT_H
#define HSR_COMMON_VTK_TEXT_H

#include "common/files/whole_file.h"

#include <vtkLogger.h>
#include <vtkNew.h>

#include <new>
#include <string>

namespace hsr {

// Returns the text that a writer of VTK makes from some data; empty if it
// fails.
template <class Writer, class Data> std::string vtk_text(Data *data) {
  vtkNew<Writer> writer;
  writer->SetInputData(data);
  writer->WriteToOutputStringOn();
  return writer->Write() && !writer->GetErrorCode() ? writer->GetOutputString()
                                                    : std::string();
}

// Writes the text that make() returns to a file. HSR_E_INPUT if it cannot be
// written; HSR_E_INTERNAL if VTK fails or the text is empty; HSR_E_NOMEM.
template <class Make>
enum hsr_status write_vtk_text(const char *path, const Make &make,
                               struct hsr_error *err) {
  try {
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    const std::string text = make();
    if (text.empty())
      return hsr_fail(err, HSR_E_INTERNAL, "%s: VTK cannot make it", path);
    hsr_whole_file file;
    const enum hsr_status status = hsr_whole_file_open(&file, path, err);
    if (status)
      return status;
    std::fwrite(text.data(), 1, text.size(), file.stream);
    return hsr_whole_file_close(&file, HSR_OK, err);
  } catch (const std::bad_alloc &) {
    return hsr_fail_nomem(err);
  } catch (const std::exception &e) {
    return hsr_fail(err, HSR_E_INTERNAL, "VTK: %s", e.what());
  } catch (...) {
    return hsr_fail(err, HSR_E_INTERNAL, "VTK: failed");
  }
}

} // namespace hsr

#endif
