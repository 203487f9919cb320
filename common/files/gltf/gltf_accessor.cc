// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/files/gltf/gltf_accessor.h"
#include "common/files/mesh/mesh_text.h"

#include <algorithm>

namespace hsr {
namespace {

struct Component {
  unsigned number; /* in the file */
  Number_type type;
};
constexpr Component COMPONENTS[] = {
    {5120, {1, false, -128, 127}},     {5121, {1, false, 0, 255}},
    {5122, {2, false, -32768, 32767}}, {5123, {2, false, 0, 65535}},
    {5125, {4, false, 0, 4294967295}}, {5126, {4, true, 0, 0}}};

const Number_type *find_component(uint64_t number) {
  for (const Component &component : COMPONENTS)
    if (component.number == number)
      return &component.type;
  return nullptr;
}

constexpr struct {
  const char *name;
  size_t n;
} SHAPES[] = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};

constexpr uint64_t MOST = uint64_t{1} << 53;

unsigned component_of(const Gltf_value &value) {
  if (!value.is_there())
    value.refuse("is missing");
  const uint64_t number = value.whole(0, MOST);
  if (!find_component(number))
    value.refuse("%llu is no type of numbers",
                 static_cast<unsigned long long>(number));
  return static_cast<unsigned>(number);
}

size_t shape_of(const Gltf_value &value) {
  const std::string name = value.text("");
  for (const auto &shape : SHAPES)
    if (name == shape.name)
      return shape.n;
  value.refuse("'%s' is not read", shown_word(name).c_str());
}

/* Finds where the elements of `array` are: `owner` names a view and an offset in
 * it. They may only be apart if the array is that of an accessor. */
void find_bytes(Gltf_file &file, const Gltf_value &owner, bool may_be_apart,
                Gltf_array &array) {
  const Gltf_element view = file.element(GLTF_VIEWS, owner["bufferView"]);
  const std::string_view all = file.buffer(view["buffer"]);
  const uint64_t from = view["byteOffset"].whole(0, MOST);
  if (!view["byteLength"].is_there())
    view["byteLength"].refuse("is missing");
  const uint64_t length = view["byteLength"].whole(0, MOST);
  if (from > all.size() || length > all.size() - from)
    view.value.refuse("goes beyond its buffer of %zu bytes", all.size());
  const size_t size = array.n_numbers * find_component(array.type)->size;
  array.stride = size;
  if (may_be_apart && view["byteStride"].is_there()) {
    array.stride = view["byteStride"].whole(0, 252);
    if (array.stride < size)
      view["byteStride"].refuse("%zu is less than an element's %zu bytes",
                                array.stride, size);
  }
  const uint64_t offset = owner["byteOffset"].whole(0, MOST);
  if (offset > length || length - offset < size ||
      (array.n - 1) > (length - offset - size) / array.stride)
    owner.refuse("its %zu elements go beyond their bufferView of %llu bytes",
                 array.n, static_cast<unsigned long long>(length));
  array.first = all.data() + from + offset;
}

} // namespace

bool Gltf_array::is_float() const {
  return type == 5126;
}

void Gltf_array::read(size_t i, double *to) const {
  const Number_type &component = *find_component(type);
  const char *at = first ? first + stride * i : nullptr;
  for (size_t k = 0; k < n_numbers; k++) {
    to[k] = at ? component.of_bytes(at + component.size * k, false) : 0;
    if (is_normalized)
      to[k] = std::max(to[k] / component.most, -1.0);
  }
}

Gltf_accessor::Gltf_accessor(Gltf_file &file, const Gltf_value &reference) {
  const Gltf_element accessor = file.element(GLTF_ACCESSORS, reference);
  place_ = accessor.value.place();
  array_.type = component_of(accessor["componentType"]);
  array_.n_numbers = shape_of(accessor["type"]);
  array_.is_normalized = accessor["normalized"].truth(false);
  array_.n = accessor["count"].whole(0, MOST);
  if (!array_.n)
    accessor["count"].refuse("must be at least 1");
  if (array_.is_normalized && (array_.type == 5125 || array_.is_float()))
    accessor["normalized"].refuse("is for bytes and shorts");
  if (accessor["bufferView"].is_there())
    find_bytes(file, accessor.value, true, array_);
  else if (array_.n > file.n_bytes())
    accessor["count"].refuse("%zu elements without data are more than the file "
                             "has bytes",
                             array_.n);
  const Gltf_value sparse = accessor["sparse"];
  if (!sparse.is_there())
    return;
  values_ = array_;
  replaced_.n = values_.n = sparse["count"].whole(0, array_.n);
  if (!values_.n)
    sparse["count"].refuse("must be at least 1");
  file.spend(values_.n, sparse);
  replaced_.type = component_of(sparse["indices"]["componentType"]);
  if (replaced_.is_float())
    sparse["indices"]["componentType"].refuse("is not of whole numbers");
  find_bytes(file, sparse["indices"], false, replaced_);
  find_bytes(file, sparse["values"], false, values_);
  double last = -1, index;
  for (size_t k = 0; k < replaced_.n; k++, last = index) {
    replaced_.read(k, &index);
    if (!(index > last && index < static_cast<double>(array_.n)))
      sparse["indices"].refuse("element %zu is %.0f: not ascending, or not "
                               "below %zu",
                               k, index, array_.n);
  }
}

/* The first of replaced_ that is not below i; replaced_.n if there is none. */
size_t Gltf_accessor::find_replaced(size_t i) const {
  size_t from = 0, to = replaced_.n;
  while (from < to) {
    const size_t middle = from + (to - from) / 2;
    double index;
    replaced_.read(middle, &index);
    if (index < static_cast<double>(i))
      from = middle + 1;
    else
      to = middle;
  }
  return from;
}

void Gltf_accessor::read(size_t i, double *to) const {
  const size_t k = find_replaced(i);
  double index = -1;
  if (k < replaced_.n)
    replaced_.read(k, &index);
  if (index == static_cast<double>(i))
    values_.read(k, to);
  else
    array_.read(i, to);
}

const Gltf_accessor &Gltf_accessors::operator[](const Gltf_value &reference) {
  const size_t index = reference.index(file_.count(GLTF_ACCESSORS), "accessor");
  const auto found = opened_.find(index);
  return found != opened_.end()
             ? found->second
             : opened_.emplace(index, Gltf_accessor(file_, reference))
                   .first->second;
}

} // namespace hsr
