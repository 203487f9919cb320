// SPDX-License-Identifier: GPL-3.0-or-later
// Source      "VTK XML Formats", docs.vtk.org; what it leaves open, from
//             vtkXMLDataParser of VTK 9.1
#include "common/files/vtk/xml_array.h"
#include "common/files/base64.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <new>

namespace hsr {
namespace {

constexpr Array_type TYPES[] = {{{1, false, INT8_MIN, INT8_MAX}, "Int8"},
                                {{1, false, 0, UINT8_MAX}, "UInt8"},
                                {{2, false, INT16_MIN, INT16_MAX}, "Int16"},
                                {{2, false, 0, UINT16_MAX}, "UInt16"},
                                {{4, false, INT32_MIN, INT32_MAX}, "Int32"},
                                {{4, false, 0, UINT32_MAX}, "UInt32"},
                                {{8, false, -0x1p63, 0x1p63}, "Int64"},
                                {{8, false, 0, 0x1p64}, "UInt64"},
                                {{4, true, 0, 0}, "Float32"},
                                {{8, true, 0, 0}, "Float64"}};

} // namespace

const Array_type *find_array_type(Word name) {
  for (const Array_type &type : TYPES)
    if (name == type.name)
      return &type;
  return nullptr;
}

/* Bytes as they are, or in base64: groups of four digits that stand for three
 * bytes, or, where '=' takes the place of the last digits, for two or one. */
class Array_checker::Bytes {
public:
  Bytes(Word data, bool is_base64)
      : at_(data.data()), end_(at_ + data.size()), is_base64_(is_base64) {}

  /* Takes n bytes; false if there are not so many. */
  bool read(void *to, size_t n);
  bool skip(size_t n);
  bool is_between_groups() const { return !n_left_; }
  /* Drops the rest of a group. Only now may another one follow a short one. */
  void end_group() {
    n_left_ = 0;
    is_short_ = false;
  }
  const char *at() const { return at_; }

private:
  bool decode();

  const char *at_, *end_;
  bool is_base64_, is_short_ = false;
  unsigned char group_[3] = {0, 0, 0};
  size_t n_left_ = 0, next_ = 0; /* bytes of the group */
};

bool Array_checker::Bytes::decode() {
  if (is_short_ || end_ - at_ < 4)
    return false;
  const size_t n = base64_decode(at_, group_);
  n_left_ = n;
  next_ = 0;
  is_short_ = n < 3;
  at_ += 4;
  return n;
}

bool Array_checker::Bytes::read(void *to, size_t n) {
  if (!is_base64_) {
    if (n > static_cast<size_t>(end_ - at_))
      return false;
    std::memcpy(to, at_, n);
    at_ += n;
    return true;
  }
  auto *byte = static_cast<unsigned char *>(to);
  for (; n; n--) {
    if (!n_left_ && !decode())
      return false;
    *byte++ = group_[next_++];
    n_left_--;
  }
  return true;
}

bool Array_checker::Bytes::skip(size_t n) {
  unsigned char skipped[256];
  for (size_t k; n; n -= k) {
    k = std::min(n, sizeof skipped);
    if (!read(skipped, k))
      return false;
  }
  return true;
}

struct Array_checker::Inflater : z_stream {
  Inflater() : z_stream() {
    if (inflateInit(this) != Z_OK)
      throw std::bad_alloc();
  }
  ~Inflater() { inflateEnd(this); }
  Inflater(const Inflater &) = delete;
  Inflater &operator=(const Inflater &) = delete;
};

void Array_checker::value(Array &array, const char *place, double value) const {
  if (!(value >= array.least && value <= array.most) &&
      !(array.can_be_nan && std::isnan(value))) {
    if (array.type->is_real && !std::isfinite(value))
      markup_.refuse(place, "value %zu of the %s is not finite", array.n,
                     array.what);
    if (array.order == Array::ASCENDING)
      markup_.refuse(place, "value %zu of the %s is %g, not more than the last",
                     array.n, array.what, value);
    markup_.refuse(place, "value %zu of the %s is %.0f, not from %.0f to %.0f",
                   array.n, array.what, value, array.least, array.most);
  }
  if (array.order != Array::ANY_ORDER)
    array.least =
        array.order == Array::RISING ? value : std::nextafter(value, INFINITY);
  if (array.is_kept)
    array.values.push_back(value);
  array.n++;
}

void Array_checker::values(Array &array, size_t n_bytes) const {
  const Array_type &type = *array.type;
  for (size_t k = 0; k < n_bytes; k += type.size)
    value(array, array.place,
          type.of_bytes(buffer_ + k, encoding_.is_big_endian));
}

/* By the rules of an istream, which is what VTK reads with. */
void Array_checker::text(Array &array) {
  const Array_type &type = *array.type;
  const char *at = array.data.data();
  const char *end = at + array.data.size();
  for (;;) {
    at = std::find_if_not(at, end, is_xml_space);
    if (at == end)
      break;
    const char *start = at;
    at = std::find_if(at, end, is_xml_space);
    const Word word = between(start, at);
    double number = 0;
    float single = 0;
    long long integer = 0;
    bool is_number;
    if (!type.is_real) {
      is_number = read_integer(word, integer);
      number = static_cast<double>(integer);
      is_number = is_number && number >= type.least && number <= type.most;
    } else if (type.size == 4) {
      is_number = number_(word, single);
      number = double{single};
    } else {
      is_number = number_(word, number);
    }
    if (!is_number)
      markup_.refuse(
          start, "value %zu of the %s: '%s' is not a number of type %s",
          array.n, array.what, shown_word(word).c_str(), type.name.data());
    value(array, start, number);
    if (array.n > MOST_VALUES)
      markup_.refuse(start, "has more %s than can be read", array.what);
  }
}

void Array_checker::read(const Array &array, Bytes &bytes, void *to,
                         size_t n) const {
  if (!bytes.read(to, n))
    markup_.refuse(array.place, "the data of the %s %s after %zu values",
                   array.what,
                   array.is_base64 ? "end, or are no base64," : "end", array.n);
}

/* A number of the header of an array. What is out of all range becomes a number
 * that is, too. */
size_t Array_checker::header(const Array &array, Bytes &bytes) const {
  unsigned char word[8];
  read(array, bytes, word, encoding_.header.size);
  const double number =
      encoding_.header.of_bytes(word, encoding_.is_big_endian);
  return number < 0x1p50 ? static_cast<size_t>(number) : SIZE_MAX;
}

void Array_checker::check_number(const Array &array, size_t n) const {
  if (!n)
    markup_.refuse(array.place, "has no %s", array.what);
  if (array.n_expected != Array::ANY && n != array.n_expected)
    markup_.refuse(array.place, "has %zu values as %s, not %zu", n, array.what,
                   array.n_expected);
}

void Array_checker::check_size(const Array &array, size_t n_bytes) const {
  const size_t n = n_bytes / array.type->size;
  if (n_bytes % array.type->size || n > MOST_VALUES)
    markup_.refuse(array.place, "the %s cannot take %zu bytes", array.what,
                   n_bytes);
  check_number(array, n);
}

/* The number of bytes, and the bytes. Some writers end a group of base64
 * between the two; VTK reads both. */
void Array_checker::plain(Array &array, Bytes &bytes) {
  const size_t size = header(array, bytes);
  if (bytes.is_between_groups())
    bytes.end_group();
  check_size(array, size);
  for (size_t left = size, n; left; left -= n) {
    n = std::min(left, BUFFER);
    read(array, bytes, buffer_, n);
    values(array, n);
  }
}

/* The number of blocks, the size of a block and, unless it is 0, of the last;
 * the packed sizes of the blocks; in a new group, the blocks. */
void Array_checker::compressed(Array &array, Bytes &bytes) {
  const size_t n_blocks = header(array, bytes);
  const size_t size = header(array, bytes);
  const size_t last = header(array, bytes);
  const size_t most = MOST_VALUES * array.type->size;
  if (!n_blocks)
    check_number(array, 0);
  if (!size || size > most || size % array.type->size || last > size ||
      n_blocks - 1 > most / size)
    markup_.refuse(array.place,
                   "the %s cannot be %zu blocks of %zu bytes, the last of %zu",
                   array.what, n_blocks, size, last);
  check_size(array, n_blocks * size - (last ? size - last : 0));
  Bytes sizes = bytes;
  if (!bytes.skip(n_blocks * encoding_.header.size))
    markup_.refuse(array.place,
                   "the sizes of the %zu blocks of the %s are cut off",
                   n_blocks, array.what);
  bytes.end_group();
  Inflater inflater;
  for (size_t b = 0; b < n_blocks; b++)
    block(array, bytes, inflater, header(array, sizes),
          b + 1 < n_blocks || !last ? size : last);
}

void Array_checker::block(Array &array, Bytes &bytes, Inflater &inflater,
                          size_t packed_size, size_t size) {
  inflateReset(&inflater);
  inflater.avail_in = 0;
  size_t left = size, n = 0; /* bytes: to come, in the buffer */
  int status;
  do {
    if (!inflater.avail_in) {
      const size_t n_in = std::min(packed_size, BUFFER);
      read(array, bytes, packed_, n_in);
      packed_size -= n_in;
      inflater.next_in = packed_;
      inflater.avail_in = static_cast<uInt>(n_in);
    }
    inflater.next_out = buffer_ + n;
    inflater.avail_out = static_cast<uInt>(BUFFER - n);
    status = inflate(&inflater, Z_NO_FLUSH);
    if (status == Z_MEM_ERROR)
      throw std::bad_alloc();
    n = BUFFER - inflater.avail_out;
    if (status == Z_STREAM_END ? n != left : n > left)
      break;
    if (status == Z_STREAM_END || n == BUFFER) {
      values(array, n);
      left -= n;
      n = 0;
    }
  } while (status == Z_OK);
  if (status != Z_STREAM_END || left || n || packed_size || inflater.avail_in)
    markup_.refuse(array.place,
                   "after %zu values of the %s, a block does not inflate to "
                   "its %zu bytes",
                   array.n, array.what, size);
}

/* Returns where the data of the array end. */
const char *Array_checker::check(Array &array) {
  const char *end = array.data.data() + array.data.size();
  /* No more than its bytes may hold; of packed ones, more is taken as
   * needed. */
  if (array.is_kept && array.n_expected != Array::ANY)
    array.values.reserve(std::min(array.n_expected, array.data.size()));
  if (array.format == Array::TEXT) {
    text(array);
  } else {
    Bytes bytes(array.data, array.is_base64);
    if (encoding_.is_compressed)
      compressed(array, bytes);
    else
      plain(array, bytes);
    if (array.format == Array::BINARY && bytes.at() != end)
      markup_.refuse(array.place, "the data of the %s go on after their end",
                     array.what);
    end = bytes.at();
  }
  check_number(array, array.n);
  return end;
}

} // namespace hsr
