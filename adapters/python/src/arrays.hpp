// SPDX-License-Identifier: MIT
// NumPy's arrays, and what NumPy makes arrays of, as the library's spans and back. What has no such meaning is refused:
// TypeError for the type, ValueError for all else, with what was expected, what was given, and what helps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <boxstream/boxstream.hpp>
#include <boxstream/detail/float_environment.hpp>

#include "arguments.hpp"
#include "unlocked.hpp"

namespace boxstream::python {

enum class Scalar { float32, float64, int32, int64 };

template <class S>
constexpr Scalar scalar_of = std::is_same_v<S, float>          ? Scalar::float32
                             : std::is_same_v<S, double>       ? Scalar::float64
                             : std::is_same_v<S, std::int32_t> ? Scalar::int32
                                                               : Scalar::int64;

/// Calls `use(float{})` or `use(double{})`.
template <class Use>
auto with_float(Scalar scalar, Use use) {
  return scalar == Scalar::float32 ? use(float{}) : use(double{});
}

/// The same with integers, too.
template <class Use>
auto with_scalar(Scalar scalar, Use use) {
  if (scalar == Scalar::int32) return use(std::int32_t{});
  if (scalar == Scalar::int64) return use(std::int64_t{});
  return with_float(scalar, use);
}

py::dtype dtype_of(Scalar scalar);

/// The shape of one element of an array whose first axis counts the elements: {6} is (n, 6).
using Element = std::vector<py::ssize_t>;

/// Which numbers are wanted, and whether what has others, or does not lie in C order, may be copied. A copy is made
/// only where it has the same numbers.
struct Wanted {
  std::vector<Element> elements;
  /// Of one type, that of `owner`; null: of any float type, and integers where that is said.
  const char* owner = nullptr;
  Scalar scalar = Scalar::float32;
  bool integers = false;
  bool may_copy = true;
};

/// Numbers in C order of a type that the library reads. They are used where they lie, and stay alive, if they can be.
class Numbers {
 public:
  Numbers(py::handle given, const char* name, const Wanted& wanted);

  const py::array& array() const { return array_; }
  Scalar scalar() const { return scalar_; }
  std::size_t size() const { return static_cast<std::size_t>(array_.shape(0)); }

  template <class S>
  const S* data() const {
    return static_cast<const S*>(array_.data());
  }

 private:
  py::array array_;
  Scalar scalar_;
};

/// How a caller describes boxes.
struct BoxFormat {
  int dimensions = 3;  // 1 to 3: minima, then maxima, of so many coordinates
  bool may_copy = true;
  Invalid invalid = Invalid::skip;
};

/// Boxes of the shape (n, 6) or (n, 2, 3), or of fewer dimensions. With `Invalid::raise` all are valid.
class Boxes {
 public:
  /// Of any type.
  Boxes(py::handle given, const char* name, const BoxFormat& format);
  /// Of the type of `owner`. Those of fewer dimensions are copied in any case.
  Boxes(py::handle given, const char* name, Invalid invalid, Scalar scalar, const char* owner, int dimensions = 3,
        bool may_copy = true);

  const py::array& array() const { return numbers_.array(); }
  std::size_t size() const { return numbers_.size(); }

  template <class S>
  Span<const BasicAabb<S>> as() const {
    const void* const data = padded_.empty() ? numbers_.data<S>() : static_cast<const void*>(padded_.data());
    return {static_cast<const BasicAabb<S>*>(data), size()};
  }
  Scalar scalar() const { return numbers_.scalar(); }
  BoxSpan span() const {
    return with_scalar(numbers_.scalar(), [this](auto s) { return BoxSpan(as<decltype(s)>()); });
  }

 private:
  void pad(int dimensions);
  void check(const char* name, Invalid invalid) const;

  Numbers numbers_;
  std::vector<std::uint64_t> padded_;  // memory of boxes that had fewer dimensions, each from 0 to 1 in the others
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

/// The bytes of an object that has some: bytes, bytearray, memoryview, mmap, arrays.
py::bytes bytes_of(py::handle given, const char* name);

/// A one-dimensional array of integers of any type. Copied, as all that says where other things lie: another thread may
/// change the array. ValueError, which ends with `fix`, for one that `T` does not have, and for a size that is not
/// `size`.
constexpr std::size_t any_size = SIZE_MAX;
template <class T>
std::vector<T> integers_of(py::handle given, const char* name, std::size_t size = any_size, const char* fix = "");

/// The filters of `size` boxes, from integers or None for the default of all; empty if both are None.
std::vector<Filter> filters_of(py::handle groups, py::handle masks, std::size_t size, const std::string& which);

/// Ids are uint64 in Python: the slot in the lower half, the generation in the upper one; 0 is null.
std::vector<ProxyId> ids_of(py::handle given, const char* name);

/// The type of indices that a caller gets.
enum class Indices { int32, int64, uint32 };

/// 'int64', 'int32' or 'uint32', or anything that NumPy takes for one of them.
Indices indices_of(py::handle dtype);

/// Indices below 2^32 as an array of `columns` columns (0: one axis). Of 32 bits it has the memory of `values`.
template <class T>
py::array index_array(std::vector<T>&& values, Indices type, py::ssize_t columns);

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

template <class T>
py::array index_array(std::vector<T>&& values, Indices type, py::ssize_t columns) {
  const auto count = static_cast<py::ssize_t>(values.size() * sizeof(T) / sizeof(std::uint32_t));
  std::vector<py::ssize_t> shape{columns == 0 ? count : count / columns};
  if (columns != 0) shape.push_back(columns);
  if (type == Indices::uint32) return array_of<std::uint32_t>(std::move(values), std::move(shape));
  if (type == Indices::int32) return array_of<std::int32_t>(std::move(values), std::move(shape));
  const auto* const from = reinterpret_cast<const std::uint32_t*>(values.data());
  std::vector<std::int64_t> wide(from, from + count);
  return array_of<std::int64_t>(std::move(wide), std::move(shape));
}

}  // namespace boxstream::python
