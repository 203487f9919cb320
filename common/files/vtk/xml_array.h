// SPDX-License-Identifier: GPL-3.0-or-later
// The arrays of VTK's XML formats: numbers as text, or as bytes, raw or in
// base64, compressed by zlib or not.
#ifndef HSR_COMMON_XML_ARRAY_H
#define HSR_COMMON_XML_ARRAY_H

#include "common/files/vtk/xml_markup.h"

namespace hsr {

/* The most values of an array. VTK counts the values of a text in int, and
 * doubles the room for them. */
constexpr size_t MOST_VALUES = size_t{1} << 30;

struct Array_type : Number_type {
  Word name;
};

/* Returns the type with this name in files, "Int8" to "Float64"; NULL: none. */
const Array_type *find_array_type(Word name);

/* An array of a file: what is expected of it, and what is found. */
struct Array {
  static constexpr size_t ANY = SIZE_MAX;
  /* RISING: no value is less than the one before. ASCENDING: each value is
   * greater than the one before. */
  enum Order { ANY_ORDER, RISING, ASCENDING };

  const char *what;   /* "points", "connectivity", "offsets" */
  const char *place;  /* where its tag is, for messages */
  size_t n_expected;  /* the number of values; ANY: any number but 0 */
  double least, most; /* the range of values */
  Order order;

  bool can_be_nan = false; /* values may be NaN */
  const Array_type *type = nullptr;
  enum { TEXT, BINARY, APPENDED } format = TEXT;
  bool is_base64 = true; /* of formats that are not TEXT */
  size_t offset = 0;     /* of APPENDED */
  Word data = {};        /* its bytes in the file */
  size_t n = 0; /* values found so far. Unless ANY_ORDER, `least` follows the
                   last one */
  bool is_kept = false;            /* the values are kept */
  std::vector<double> values = {}; /* the values, if is_kept */
};

/* How a file encodes arrays that are not TEXT. */
struct Array_encoding {
  bool is_compressed = false;
  bool is_big_endian = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__;
  Number_type header = {4, false, 0, UINT32_MAX};
};

class Array_checker {
public:
  Array_checker(const Markup &markup, const Array_encoding &encoding)
      : markup_(markup), encoding_(encoding) {}

  /* Decodes and checks all of an array, and returns where its data end. Throws
   * Refused at the first fault. Only zlib takes memory, and `values` if they
   * are kept. */
  const char *check(Array &array);

private:
  class Bytes;
  struct Inflater;

  void text(Array &array);
  void plain(Array &array, Bytes &bytes);
  void compressed(Array &array, Bytes &bytes);
  void block(Array &array, Bytes &bytes, Inflater &inflater, size_t packed_size,
             size_t size);
  void read(const Array &array, Bytes &bytes, void *to, size_t n) const;
  size_t header(const Array &array, Bytes &bytes) const;
  void check_number(const Array &array, size_t n) const;
  void check_size(const Array &array, size_t n_bytes) const;
  void values(Array &array, size_t n_bytes) const;
  void value(Array &array, const char *place, double value) const;

  static constexpr size_t BUFFER = size_t{1}
                                   << 15; /* a multiple of all sizes */

  const Markup &markup_;
  const Array_encoding &encoding_;
  Number_reader number_;
  unsigned char packed_[BUFFER], buffer_[BUFFER];
};

} // namespace hsr

#endif
