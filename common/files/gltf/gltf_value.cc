// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/files/gltf/gltf_file.h"
#include "common/files/json/json_file.h"

#include <cmath>
#include <cstdio>

namespace hsr {
void Gltf_value::refuse(const char *format, ...) const {
  char text[200];
  va_list args;
  va_start(args, format);
  std::vsnprintf(text, sizeof text, format, args);
  va_end(args);
  if (place_.empty())
    file_->refuse(0, "%s", text);
  file_->refuse(0, "%.100s: %s", place_.c_str(), text);
}

void Gltf_value::refuse_kind(const char *expected) const {
  if (!value_)
    refuse("is missing");
  refuse("must be %s, not %s", expected, hsr_json_kind(value_));
}

Gltf_value Gltf_value::operator[](const char *key) const {
  if (value_ && !json_is_object(value_))
    refuse_kind("an object");
  return {*file_, json_object_get(value_, key),
          place_.empty() ? key : place_ + "/" + key};
}

Gltf_value Gltf_value::operator[](size_t index) const {
  if (value_ && !json_is_array(value_))
    refuse_kind("an array");
  return {*file_, json_array_get(value_, index),
          place_ + "/" + std::to_string(index)};
}

size_t Gltf_value::size() const {
  if (value_ && !json_is_array(value_))
    refuse_kind("an array");
  return json_array_size(value_);
}

std::vector<std::string> Gltf_value::keys() const {
  std::vector<std::string> keys;
  const char *key;
  json_t *value;
  if (value_ && !json_is_object(value_))
    refuse_kind("an object");
  json_object_foreach(value_, key, value) keys.push_back(key);
  return keys;
}

bool Gltf_value::truth(bool standard) const {
  if (!value_)
    return standard;
  if (!json_is_boolean(value_))
    refuse_kind("true or false");
  return json_is_true(value_);
}

double Gltf_value::number(double standard) const {
  if (!value_)
    return standard;
  if (!json_is_number(value_))
    refuse_kind("a number");
  return json_number_value(value_);
}

std::string Gltf_value::text(const char *standard) const {
  if (!value_)
    return standard;
  if (!json_is_string(value_))
    refuse_kind("a string");
  return {json_string_value(value_), json_string_length(value_)};
}

uint64_t Gltf_value::whole(uint64_t standard, uint64_t most) const {
  if (!value_)
    return standard;
  const double x = number(0);
  if (!(x >= 0 && x <= static_cast<double>(most)) || x != std::floor(x))
    refuse("%.15g is no whole number from 0 to %llu", x,
           static_cast<unsigned long long>(most));
  return static_cast<uint64_t>(x);
}

size_t Gltf_value::index(size_t n, const char *what) const {
  if (!value_)
    refuse("is missing");
  const double x = number(0);
  if (!(x >= 0 && x < static_cast<double>(n)) || x != std::floor(x))
    refuse("there is no %s %.15g; the file has %zu", what, x, n);
  return static_cast<size_t>(x);
}

bool Gltf_value::numbers(double *to, size_t n) const {
  if (!value_)
    return false;
  if (size() != n)
    refuse("must have %zu numbers, not %zu", n, size());
  for (size_t k = 0; k < n; k++)
    to[k] = (*this)[k].number(0);
  return true;
}

} // namespace hsr
