// SPDX-License-Identifier: GPL-3.0-or-later
// Making VTK's XML readers read bytes in memory. Only for hsr-vtk.so.
#ifndef HSR_COMMON_XML_READER_H
#define HSR_COMMON_XML_READER_H

#include <vtkObjectFactory.h>
#include <vtkXMLDataParser.h>

#include <istream>
#include <memory>
#include <streambuf>

namespace hsr {

/* A stream over bytes in memory. */
class Memory_buffer : public std::streambuf {
public:
  Memory_buffer(char *begin, char *end) { setg(begin, begin, end); }

protected:
  pos_type seekoff(off_type offset, std::ios_base::seekdir from,
                   std::ios_base::openmode) override {
    const off_type size = egptr() - eback();
    if (from == std::ios_base::cur)
      offset += gptr() - eback();
    else if (from == std::ios_base::end)
      offset += size;
    if (offset < 0 || offset > size)
      return pos_type(off_type(-1));
    setg(eback(), eback() + offset, egptr());
    return pos_type(offset);
  }
  pos_type seekpos(pos_type position, std::ios_base::openmode which) override {
    return seekoff(off_type(position), std::ios_base::beg, which);
  }
};

/* A reader of VTK that reads bytes in memory without a copy. They are borrowed,
 * and must outlive it. */
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
  /* Without this, VTK would keep a second copy of all arrays that are text. */
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
