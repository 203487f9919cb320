// SPDX-License-Identifier: GPL-3.0-or-later
// Source      "VTK XML Formats", docs.vtk.org; what it leaves open, from
//             vtkXMLReader and vtkXMLDataParser of VTK 9.1
#include "common/files/vtk/xml_scan.h"

#include <algorithm>

namespace hsr {

size_t Xml_scan::count(Tag &tag, const char *name, size_t most) const {
  const Word *word = markup_.attribute(tag, name);
  if (!word)
    return 0;
  long long number;
  if (!read_integer(*word, number) || number < 0)
    markup_.refuse(word->data(), "%s is '%s', not a number from 0 on", name,
                   shown_word(*word).c_str());
  if (static_cast<size_t>(number) > most)
    markup_.refuse(word->data(), "%s is %lld, more than %zu bytes can hold",
                   name, number, file_.size());
  return static_cast<size_t>(number);
}

void Xml_scan::attributes_of_root(Tag &tag) {
  const char *place = tag.text.data();
  const auto refuse = [&](const Word &word, const char *what) {
    markup_.refuse(place, "'%s' is not %s", shown_word(word).c_str(), what);
  };
  const Word *type = markup_.attribute(tag, "type");
  if (!type || *type != kind_.name)
    markup_.refuse(place, "holds no %s", kind_.words);
  const Word *version = markup_.attribute(tag, "version");
  if (version &&
      (version->size() != 3 || (*version)[0] < '0' || (*version)[0] > '2' ||
       (*version)[1] != '.' || (*version)[2] < '0' || (*version)[2] > '9'))
    refuse(*version, "a version from 0.1 to 2.9");
  if (const Word *order = markup_.attribute(tag, "byte_order")) {
    encoding_.is_big_endian = *order == "BigEndian";
    if (!encoding_.is_big_endian && *order != "LittleEndian")
      refuse(*order, "a byte order");
  }
  if (const Word *header = markup_.attribute(tag, "header_type")) {
    if (*header == "UInt64")
      encoding_.header = {8, false, 0, 0x1p64};
    else if (*header != "UInt32")
      refuse(*header, "a type of headers");
  }
  if (const Word *compressor = markup_.attribute(tag, "compressor")) {
    encoding_.is_compressed = true;
    if (*compressor != "vtkZLibDataCompressor")
      refuse(*compressor, "a compressor that is read (vtkZLibDataCompressor)");
  }
  markup_.blank_others(tag);
}

void Xml_scan::scan_root() {
  Tag tag = markup_.tag();
  if (tag.kind == Tag::END || tag.name != "VTKFile")
    markup_.refuse(tag.text.data(), "is no VTK XML file");
  file_.begin += tag.text.data() - file_.begin;
  attributes_of_root(tag);
  bool has_data = false;
  for (Tag child; markup_.child(tag, child);) {
    if (child.name == "AppendedData") {
      appended_data(child);
    } else if (child.name != kind_.name) {
      markup_.skip(child);
    } else if (has_data) {
      markup_.refuse(child.text.data(), "a second element '%s'",
                     kind_.name.data());
    } else {
      has_data = true;
      scan_data(child);
    }
  }
  const Word rest = trimmed(markup_.rest());
  if (!rest.empty())
    markup_.refuse(rest.data(), "the file goes on after its last element");
}

/* VTK takes what follows the first '_', and looks no further for tags. */
void Xml_scan::appended_data(Tag &tag) {
  const Word *encoding = markup_.attribute(tag, "encoding");
  if (!encoding || (*encoding != "raw" && *encoding != "base64"))
    markup_.refuse(tag.text.data(), "appended data neither raw nor base64");
  is_appended_base64_ = *encoding == "base64";
  markup_.blank_others(tag);
  const Word rest = markup_.rest();
  const size_t start = rest.find_first_not_of(" \t\r\n");
  const size_t end = rest.rfind("</AppendedData");
  if (tag.kind != Tag::START || end == Word::npos || start == end ||
      rest[start] != '_')
    markup_.refuse(tag.text.data(),
                   "appended data without their '_' or their end");
  appended_ = rest.substr(start + 1, end - start - 1);
  markup_.go_to(rest.data() + end);
  Tag child;
  markup_.child(tag, child);
}

void Xml_scan::add_array(Tag &tag, Array array) {
  if (array.n_expected != Array::ANY && array.n_expected > MOST_VALUES)
    markup_.refuse(array.place, "%zu values are more than can be read",
                   array.n_expected);
  const Word *type = markup_.attribute(tag, "type");
  array.type = type ? find_array_type(*type) : nullptr;
  if (!array.type)
    markup_.refuse(array.place, "'%s' is not a type of numbers",
                   type ? shown_word(*type).c_str() : "");
  format(tag, array);
  markup_.blank_others(tag);
  content(tag, array);
  arrays_.push_back(array);
}

void Xml_scan::format(Tag &tag, Array &array) const {
  const Word *format = markup_.attribute(tag, "format");
  const Word *offset = markup_.attribute(tag, "offset");
  if (!format || *format == "ascii")
    array.format = Array::TEXT;
  else if (*format == "binary")
    array.format = Array::BINARY;
  else if (*format == "appended")
    array.format = Array::APPENDED;
  else
    markup_.refuse(array.place, "'%s' is not a format",
                   shown_word(*format).c_str());
  if ((array.format == Array::APPENDED) != (offset != nullptr))
    markup_.refuse(array.place, "an array is appended without an offset, or "
                                "has one though it is not");
  if (offset)
    array.offset = count(tag, "offset", file_.size());
}

/* What is between the tags of an array; elements in it are blanked. */
void Xml_scan::content(const Tag &tag, Array &array) {
  const char *start = markup_.at();
  if (tag.kind == Tag::START) {
    Tag child;
    while (markup_.child_or_text(tag, child))
      markup_.skip(child);
    array.data = trimmed(between(start, child.text.data()));
  }
  if (array.data.empty() != (array.format == Array::APPENDED))
    markup_.refuse(array.place, array.data.empty()
                                    ? "an array has no values"
                                    : "an appended array has values");
}

void Xml_scan::place_appended(Array &array) const {
  if (array.offset >= appended_.size())
    markup_.refuse(array.place, "has its %s at %zu of %zu appended bytes",
                   array.what, array.offset, appended_.size());
  array.data = appended_.substr(array.offset);
  array.is_base64 = is_appended_base64_;
}

/* No two arrays share bytes, so that the work is bounded by the file's size. */
void Xml_scan::check_arrays() {
  std::vector<Array *> by_place;
  for (Array &array : arrays_) {
    if (array.format == Array::APPENDED)
      place_appended(array);
    by_place.push_back(&array);
  }
  std::sort(by_place.begin(), by_place.end(),
            [](Array *a, Array *b) { return a->data.data() < b->data.data(); });
  Array_checker checker(markup_, encoding_);
  const char *end = file_.begin;
  for (Array *array : by_place) {
    if (array->data.data() < end)
      markup_.refuse(array->place, "has its %s where another array is",
                     array->what);
    end = checker.check(*array);
  }
}

} // namespace hsr
