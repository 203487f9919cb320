// SPDX-License-Identifier: GPL-3.0-or-later
// What the grammars of VTK's XML formats have in common: the root, arrays, and
// data that are appended. Those of the formats are classes derived from this.
#ifndef HSR_COMMON_XML_SCAN_H
#define HSR_COMMON_XML_SCAN_H

#include "common/files/vtk/xml_array.h"

namespace hsr {

class Xml_scan {
public:
  Xml_scan(const Xml_scan &) = delete;
  Xml_scan &operator=(const Xml_scan &) = delete;

protected:
  /* What a file holds: the type that its root names, which is also the name of
   * the element with the data; and words for it in a message. */
  struct Kind {
    Word name;
    const char *words;
  };

  Xml_scan(Mesh_file &file, const Kind &kind)
      : file_(file), markup_(file), kind_(kind) {}
  ~Xml_scan() = default;

  /* Goes over the whole file, and blanks what is not known. file.begin becomes
   * the start of the root. This and all below throw Refused. */
  void scan_root();
  /* Goes over the element of the data. Called once at most. */
  virtual void scan_data(Tag &tag) = 0;
  /* Decodes and checks the arrays, once the whole file was gone over. */
  void check_arrays();

  /* The value of an attribute, 0 if there is none. */
  size_t count(Tag &tag, const char *name, size_t most) const;
  /* Goes over an array of which `what` to `can_be_nan` are set; it becomes the
   * last of arrays_. */
  void add_array(Tag &tag, Array array);

  Mesh_file &file_;
  Markup markup_;
  Array_encoding encoding_;
  std::vector<Array> arrays_;

private:
  void attributes_of_root(Tag &tag);
  void appended_data(Tag &tag);
  void format(Tag &tag, Array &array) const;
  void content(const Tag &tag, Array &array);
  void place_appended(Array &array) const;

  const Kind kind_;
  Word appended_;
  bool is_appended_base64_ = false;
};

} // namespace hsr

#endif
