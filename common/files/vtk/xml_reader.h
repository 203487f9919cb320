// SPDX-License-Identifier: GPL-3.0-or-later
// VTK's XML readers, for bytes in memory. Only for hsr-vtk.so.
#ifndef HSR_COMMON_XML_READER_H
#define HSR_COMMON_XML_READER_H

#include "common/files/mesh/mesh_file.h"

#include <vtkObjectFactory.h>
#include <vtkXMLDataParser.h>

#include <istream>
#include <memory>

namespace hsr {

/* A reader of VTK's that makes no copy of the bytes that it reads. They are
 * borrowed, and must outlive it. */
template <class Reader> class Memory_reader : public Reader {
public:
  vtkTypeMacro(Memory_reader, Reader);
  static Memory_reader *New() { VTK_STANDARD_NEW_BODY(Memory_reader); }
  void set_input(char *begin, char *end) {
    buffer_ = std::make_unique<Memory_buffer>(begin, end);
    stream_.rdbuf(buffer_.get());
  }

protected:
  int OpenStream() override {
    stream_.clear();
    stream_.seekg(0);
    this->Stream = &stream_;
    return 1;
  }
  /* Or VTK would keep a second copy of all arrays that are text. */
  void CreateXMLParser() override {
    this->Superclass::CreateXMLParser();
    this->XMLParser->SetIgnoreCharacterData(1);
  }

private:
  std::unique_ptr<Memory_buffer> buffer_;
  std::istream stream_{nullptr};
};

} // namespace hsr

#endif
