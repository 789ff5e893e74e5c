// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <boxstream/detail/rounded_up.hpp>

#include "arrays.hpp"

namespace boxstream::python {

/// The numbers that something takes: their type, what it is called in messages, and of how many coordinates.
struct Taken {
  Scalar scalar;
  const char* owner;
  int dimensions = 3;

  Wanted wanted(Element element) const {
    Wanted wanted{{std::move(element)}};
    wanted.owner = owner;
    wanted.scalar = scalar;
    return wanted;
  }
};

/// Points or directions as the caller gave them; coordinates that are not there are 0.
class Points {
 public:
  Points(py::handle given, const char* name, const Taken& taken)
      : numbers_(given, name, taken.wanted({taken.dimensions})), dimensions_(taken.dimensions) {}

  std::size_t size() const { return numbers_.size(); }

  template <class S>
  std::array<S, 3> point(std::size_t i) const {
    std::array<S, 3> point{};
    std::copy_n(numbers_.data<S>() + i * static_cast<std::size_t>(dimensions_), dimensions_, point.begin());
    return point;
  }

 private:
  Numbers numbers_;
  int dimensions_;
};

/// Rays as the caller gave them.
class Rays {
 public:
  Rays(py::handle origins, py::handle directions, py::handle lengths, const Taken& taken)
      : origins_(origins, "origins", taken), directions_(directions, "directions", taken) {
    require_as_many(directions_.size(), "directions");
    if (lengths.is_none()) return;
    if (is_one_number(lengths)) {
      length_ = number_of(lengths, "lengths");
      return;
    }
    lengths_.emplace(lengths, "lengths", taken.wanted({}));
    require_as_many(lengths_->size(), "lengths");
  }

  std::size_t size() const { return origins_.size(); }

  template <class S>
  BasicRay<S> ray(std::size_t i) const {
    const boxstream::detail::DefaultFloatEnvironment environment;  // it is made here, not in the library
    const auto o = origins_.point<S>(i), d = directions_.point<S>(i);
    return BasicRay<S>::along({o[0], o[1], o[2]}, {d[0], d[1], d[2]},
                              lengths_ ? lengths_->data<S>()[i] : boxstream::detail::limit_of<S>(length_));
  }

 private:
  void require_as_many(std::size_t given, const char* name) const {
    if (given != size())
      throw py::value_error(std::string(name) + ": expected one for each of " + std::to_string(size()) +
                            " origins, got " + std::to_string(given));
  }

  Points origins_, directions_;
  std::optional<Numbers> lengths_;
  double length_ = std::numeric_limits<double>::infinity();
};

/// ValueError if there are too many answers for any memory.
inline void require_room(std::size_t points, std::size_t count) {
  if (count > std::vector<std::uint64_t>().max_size() / std::max<std::size_t>(points, 1))
    throw py::value_error("count: too many for " + std::to_string(points) + " points, got " + std::to_string(count));
}

}  // namespace boxstream::python
