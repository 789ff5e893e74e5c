// SPDX-License-Identifier: MIT
#include "arrays.hpp"

#include <bit>

namespace boxstream::python {

static_assert(sizeof(Aabb) == 6 * sizeof(float) && sizeof(Aabb64) == 6 * sizeof(double));
static_assert(sizeof(ProxyId) == sizeof(std::uint64_t) && std::endian::native == std::endian::little);

namespace {

std::string shape_text(const char* first, Element element) {
  std::string text = std::string("(") + first;
  for (const py::ssize_t length : element) text += ", " + std::to_string(length);
  return text + (element.size() == 0 ? ",)" : ")");
}

/// What the caller has to give, for messages.
std::string wanted(const char* name, const char* dtypes, std::initializer_list<Element> elements) {
  std::string text = std::string(name) + ": expected a C-ordered array of " + dtypes + " of shape ";
  bool first = true;
  for (const Element& element : elements) {
    text += (first ? "" : " or ") + shape_text("n", element);
    first = false;
  }
  return text + ", got ";
}

bool has_shape(const py::array& array, Element element) {
  if (array.ndim() != static_cast<py::ssize_t>(element.size()) + 1) return false;
  py::ssize_t axis = 1;
  for (const py::ssize_t length : element)
    if (array.shape(axis++) != length) return false;
  return true;
}

py::array require_array(py::handle given, const std::string& expected) {
  if (!py::isinstance<py::array>(given)) throw py::type_error(expected + "an object of type " + type_of(given));
  return py::reinterpret_borrow<py::array>(given);
}

bool has_dtype(const py::array& array, const py::dtype& dtype) {
  return array.dtype().equal(dtype);
}

/// Shape, order and alignment; the type has been checked.
void require_layout(const py::array& array, std::initializer_list<Element> elements, const std::string& expected) {
  const auto dtype = [&] { return text_of(array.dtype()); };  // imports modules, which may be gone at the end
  bool fits = false;
  for (const Element& element : elements) fits = fits || has_shape(array, element);
  if (!fits) throw py::value_error(expected + dtype() + " of shape " + text_of(array.attr("shape")));
  if ((array.flags() & py::array::c_style) == 0)
    throw py::value_error(expected + dtype() + " with strides " + text_of(array.attr("strides")) +
                          ": numpy.ascontiguousarray makes a copy in C order");
  if ((array.flags() & py::detail::npy_api::NPY_ARRAY_ALIGNED_) == 0)
    throw py::value_error(expected + dtype() +
                          " that is not aligned: numpy.require(array, requirements='CA') copies it");
}

template <class T>
constexpr const char* dtype_name = sizeof(T) == sizeof(std::uint32_t) ? "uint32" : "uint64";

void require_size(const char* name, std::size_t size, std::size_t given) {
  if (given != size)
    throw py::value_error(std::string(name) + ": expected " + std::to_string(size) + " elements, got " +
                          std::to_string(given));
}

template <class T>
Span<const T> any_integers(py::handle given, const char* name, py::array& owner) {
  const std::string expected = wanted(name, dtype_name<T>, {{}});
  owner = require_array(given, expected);
  if (!has_dtype(owner, py::dtype::of<T>())) throw py::type_error(expected + text_of(owner.dtype()));
  require_layout(owner, {{}}, expected);
  return {static_cast<const T*>(owner.data()), static_cast<std::size_t>(owner.shape(0))};
}

}  // namespace

py::dtype dtype_of(Scalar scalar) {
  return scalar == Scalar::float32 ? py::dtype::of<float>() : py::dtype::of<double>();
}

Floats::Floats(py::handle given, const char* name, std::initializer_list<Element> elements) : name_(name) {
  const std::string expected = wanted(name, "float32 or float64", elements);
  array_ = require_array(given, expected);
  const bool is_double = has_dtype(array_, py::dtype::of<double>());
  if (!is_double && !has_dtype(array_, py::dtype::of<float>()))
    throw py::type_error(expected + text_of(array_.dtype()));
  scalar_ = is_double ? Scalar::float64 : Scalar::float32;
  require_layout(array_, elements, expected);
}

void Floats::require(Scalar scalar, const char* owner) const {
  if (scalar_ != scalar)
    throw py::type_error(name_ + ": expected " + text_of(dtype_of(scalar)) + ", as " + owner + ", got " +
                         text_of(dtype_of(scalar_)));
}

Boxes::Boxes(py::handle given, const char* name, Invalid invalid) : floats_(given, name, {{6}, {2, 3}}) {
  if (invalid == Invalid::skip) return;
  with_scalar(scalar(), [&](auto s) {
    using S = decltype(s);
    require_valid(as<S>(), name, "a NaN, or min > max", [](const BasicAabb<S>& box) { return is_valid(box); });
  });
}

template <class T>
Span<const T> integers(py::handle given, const char* name, std::size_t size, py::array& owner) {
  const Span<const T> values = any_integers<T>(given, name, owner);
  require_size(name, size, values.size());
  return values;
}

template Span<const std::uint32_t> integers(py::handle, const char*, std::size_t, py::array&);
template Span<const std::uint64_t> integers(py::handle, const char*, std::size_t, py::array&);

std::vector<std::uint64_t> offsets_of(py::handle given, const char* name) {
  const std::string expected = wanted(name, "int64 or uint64", {{}});
  const py::array owner = require_array(given, expected);
  if (!has_dtype(owner, py::dtype::of<std::int64_t>()) && !has_dtype(owner, py::dtype::of<std::uint64_t>()))
    throw py::type_error(expected + text_of(owner.dtype()));
  require_layout(owner, {{}}, expected);
  // One below zero becomes larger than any number of boxes.
  const auto* const offsets = static_cast<const std::uint64_t*>(owner.data());
  return {offsets, offsets + owner.shape(0)};
}

std::vector<Filter> filters_of(py::handle groups, py::handle masks, std::size_t size, const std::string& which) {
  std::vector<Filter> filters;
  if (groups.is_none() && masks.is_none()) return filters;
  filters.resize(size);
  const auto fill = [&](py::handle given, const std::string& name, std::uint32_t Filter::*member) {
    if (given.is_none()) return;
    py::array owner;
    const Span<const std::uint32_t> values = integers<std::uint32_t>(given, name.c_str(), size, owner);
    for (std::size_t i = 0; i < size; ++i) filters[i].*member = values[i];
  };
  fill(groups, "groups" + which, &Filter::group);
  fill(masks, "masks" + which, &Filter::mask);
  return filters;
}

std::vector<ProxyId> ids_of(py::handle given, const char* name) {
  py::array owner;
  const Span<const std::uint64_t> given_ids = any_integers<std::uint64_t>(given, name, owner);
  const auto* const ids = reinterpret_cast<const ProxyId*>(given_ids.data());
  return {ids, ids + given_ids.size()};
}

}  // namespace boxstream::python
