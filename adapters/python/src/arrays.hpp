// SPDX-License-Identifier: MIT
// NumPy's arrays as the library's spans and back. What cannot be used where it lies is refused: TypeError for the type,
// ValueError for all else, with what was expected and what was given.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <boxstream/boxstream.hpp>
#include <boxstream/detail/float_environment.hpp>

#include "arguments.hpp"
#include "unlocked.hpp"

namespace boxstream::python {

enum class Scalar { float32, float64 };

template <class S>
constexpr Scalar scalar_of = sizeof(S) == sizeof(float) ? Scalar::float32 : Scalar::float64;

/// Calls `use(float{})` or `use(double{})`.
template <class Use>
auto with_scalar(Scalar scalar, Use use) {
  return scalar == Scalar::float32 ? use(float{}) : use(double{});
}

py::dtype dtype_of(Scalar scalar);

/// The shape of one element of an array whose first axis counts the elements: {6} is (n, 6).
using Element = std::initializer_list<py::ssize_t>;

/// An array of float32 or float64 in C order, which stays alive and is used where it lies.
class Floats {
 public:
  Floats(py::handle given, const char* name, std::initializer_list<Element> elements);

  Scalar scalar() const { return scalar_; }
  std::size_t size() const { return static_cast<std::size_t>(array_.shape(0)); }
  py::ssize_t dimensions() const { return array_.ndim(); }
  py::ssize_t columns() const { return array_.shape(1); }

  /// TypeError unless the elements are of this type, which is that of `owner`.
  void require(Scalar scalar, const char* owner) const;

  template <class S>
  const S* data() const {
    return static_cast<const S*>(array_.data());
  }

 private:
  py::array array_;
  Scalar scalar_;
  std::string name_;
};

/// Boxes of the shape (n, 6) or (n, 2, 3). With `Invalid::raise` all are valid.
class Boxes {
 public:
  Boxes(py::handle given, const char* name, Invalid invalid);

  const Floats& floats() const { return floats_; }
  Scalar scalar() const { return floats_.scalar(); }
  std::size_t size() const { return floats_.size(); }

  template <class S>
  Span<const BasicAabb<S>> as() const {
    return {reinterpret_cast<const BasicAabb<S>*>(floats_.data<S>()), size()};
  }

 private:
  Floats floats_;
};

/// ValueError that counts invalid elements and names the first one, if there are any.
template <class T, class IsValid>
void require_valid(Span<const T> elements, const char* name, const char* why, IsValid is_valid) {
  std::size_t invalid = 0, first = 0;
  without_lock([&](const Unlocked&) {
    const boxstream::detail::DefaultFloatEnvironment environment;  // to compare a NaN may be a trap of the caller's
    for (std::size_t i = elements.size(); i-- > 0;)
      if (!is_valid(elements[i])) {
        ++invalid;
        first = i;
      }
  });
  if (invalid != 0)
    throw py::value_error(std::string(name) + ": expected none that is invalid (" + why + "), got " +
                          std::to_string(invalid) + " of " + std::to_string(elements.size()) + "; the first is " +
                          name + "[" + std::to_string(first) + "]");
}

/// A one-dimensional array of unsigned integers in C order. Keep `owner` while the span is used.
template <class T>
Span<const T> integers(py::handle given, const char* name, std::size_t size, py::array& owner);

/// Offsets of many sets of boxes, from an array of int64 or uint64 of shape (m + 1,). Copied, as all that says where
/// other things lie: another thread may change the array.
std::vector<std::uint64_t> offsets_of(py::handle given, const char* name);

/// The filters of `size` boxes, from arrays of uint32 or None for the default of all; empty if both are None.
std::vector<Filter> filters_of(py::handle groups, py::handle masks, std::size_t size, const std::string& which);

/// Ids are uint64 in Python: the slot in the lower half, the generation in the upper one; 0 is null. Copied, as offsets
/// are.
std::vector<ProxyId> ids_of(py::handle given, const char* name);

/// An array over the memory of `values`, which it owns from now on. `T` consists of `Item`s.
template <class Item, class T>
py::array array_of(std::vector<T>&& values, std::vector<py::ssize_t> shape) {
  auto owned = std::make_unique<std::vector<T>>(std::move(values));
  const auto* const items = reinterpret_cast<const Item*>(owned->data());
  const py::capsule owner(owned.get(), [](void* vector) { delete static_cast<std::vector<T>*>(vector); });
  owned.release();
  return py::array_t<Item>(std::move(shape), items, owner);
}

template <class Item, class T>
py::array array_of(std::vector<T>&& values) {
  const auto size = static_cast<py::ssize_t>(values.size());
  constexpr auto columns = static_cast<py::ssize_t>(sizeof(T) / sizeof(Item));
  if constexpr (columns == 1) return array_of<Item>(std::move(values), {size});
  return array_of<Item>(std::move(values), {size, columns});
}

}  // namespace boxstream::python
