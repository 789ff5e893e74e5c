// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <boxstream/aabb.hpp>
#include <boxstream/span.hpp>

namespace boxstream {

namespace detail {
/// The coordinate type of the boxes that a Span can be made of, or void.
template <class Boxes>
struct CoordinateOf {
  template <class S>
  static constexpr bool is = std::is_convertible_v<Boxes, Span<const BasicAabb<S>>>;
  using type = std::conditional_t<
      is<float>, float,
      std::conditional_t<is<double>, double,
                         std::conditional_t<is<std::int32_t>, std::int32_t,
                                            std::conditional_t<is<std::int64_t>, std::int64_t, void>>>>;
};
}  // namespace detail

/// A view of boxes that it does not own, of any coordinate type: `Aabb`, `Aabb64`, `IntAabb` or `IntAabb64`. Made of
/// whatever a Span of such boxes can be made of.
class BoxSpan {
 public:
  enum class Coordinates : std::uint8_t { float32, float64, int32, int64 };

  constexpr BoxSpan() = default;

  template <class Boxes, class S = typename detail::CoordinateOf<Boxes>::type,
            class = std::enable_if_t<!std::is_void_v<S>>>
  constexpr BoxSpan(Boxes&& boxes) : BoxSpan(Span<const BasicAabb<S>>(boxes)) {}
  template <class S>
  constexpr BoxSpan(const BasicAabb<S>* boxes, std::size_t size) : BoxSpan(Span<const BasicAabb<S>>(boxes, size)) {}

  constexpr BoxSpan(Span<const Aabb> boxes) : BoxSpan(boxes.data(), boxes.size(), Coordinates::float32) {}
  constexpr BoxSpan(Span<const Aabb64> boxes) : BoxSpan(boxes.data(), boxes.size(), Coordinates::float64) {}
  constexpr BoxSpan(Span<const IntAabb> boxes) : BoxSpan(boxes.data(), boxes.size(), Coordinates::int32) {}
  constexpr BoxSpan(Span<const IntAabb64> boxes) : BoxSpan(boxes.data(), boxes.size(), Coordinates::int64) {}

  constexpr Coordinates coordinates() const { return coordinates_; }
  constexpr std::size_t size() const { return size_; }
  constexpr bool empty() const { return size_ == 0; }

  /// The boxes, which are of this coordinate type.
  template <class S>
  Span<const BasicAabb<S>> of() const {
    return {static_cast<const BasicAabb<S>*>(data_), size_};
  }

 private:
  constexpr BoxSpan(const void* data, std::size_t size, Coordinates coordinates)
      : data_(data), size_(size), coordinates_(coordinates) {}

  const void* data_ = nullptr;
  std::size_t size_ = 0;
  Coordinates coordinates_ = Coordinates::float32;
};

}  // namespace boxstream
