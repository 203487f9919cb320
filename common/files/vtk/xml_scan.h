// SPDX-License-Identifier: GPL-3.0-or-later
// The part of the grammar that VTK's XML formats share: the root element,
// arrays, and appended data. Each format has a class derived from this.
#ifndef HSR_COMMON_XML_SCAN_H
#define HSR_COMMON_XML_SCAN_H

#include "common/files/vtk/xml_array.h"

namespace hsr {

class Xml_scan {
public:
  Xml_scan(const Xml_scan &) = delete;
  Xml_scan &operator=(const Xml_scan &) = delete;

protected:
  /* The kind of a file. */
  struct Kind {
    Word name;         /* the type in its root, which is also the name of the
                          element with the data */
    const char *words; /* what it is called in messages */
  };

  Xml_scan(Mesh_file &file, const Kind &kind)
      : file_(file), markup_(file), kind_(kind) {}
  ~Xml_scan() = default;

  /* These functions throw Refused. */

  /* Scans the whole file, and blanks elements and attributes that are not
   * known. file.begin becomes the start of the root. */
  void scan_root();
  /* Scans the element with the data. It is called at most once. */
  virtual void scan_data(Tag &tag) = 0;
  /* Decodes and checks the arrays, after the whole file was scanned. */
  void check_arrays();

  /* Returns the value of an attribute, a whole number of at most `most`; 0 if
   * there is no such attribute. */
  size_t count(Tag &tag, const char *name, size_t most) const;
  /* Scans an array, whose members `what` to `can_be_nan` are set, and appends
   * it to arrays_. */
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
