// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/detail/export.hpp>
#include <boxstream/function_ref.hpp>
#include <boxstream/pair.hpp>
#include <boxstream/plane.hpp>
#include <boxstream/ray.hpp>
#include <boxstream/span.hpp>

namespace boxstream {

/// Called with the index of each box found, in no particular order. False stops the query.
using BoxVisitor = FunctionRef<bool(std::uint32_t box)>;

/// As RayVisitor, of boxes: returns the new length of the ray, negative to stop.
template <class S>
using BoxRayVisitor = FunctionRef<S(std::uint32_t box, S enter, S length)>;

/// As NearVisitor, of boxes: returns the new limit; zero, a negative value or NaN stops the query.
template <class S>
using NearBoxVisitor = FunctionRef<S(std::uint32_t box, S distance)>;

/// Boxes that do not change: built once, asked often, stored.
///
/// @par Answers
/// Those of a World that has these boxes, by their indices in the array. Touching counts; nothing is rounded but where
/// the contracts there say so. Invalid boxes are found by no query.
///
/// @par Order
/// A function of the boxes, with the same C++ standard library.
///
/// @par Memory
/// 32 bytes a float box, 60 a double one, and 16 kB, at most; twice that while it is built. Boxes are copied.
///
/// @par Threads
/// Any number may ask at once.
///
/// @par Bytes
/// Read on all machines; an index that is loaded is the one that was saved. Whatever they are, `load` throws
/// std::runtime_error, in one line, or returns an index that answers.
///
/// @par Floating point
/// Neither rounding mode, flushing of denormals nor traps matter.
///
/// @par Errors
/// std::bad_alloc, and std::length_error beyond 2^32 - 2 boxes. Outputs are then empty.
///
/// Where boxes come and go: World. For all pairs of a set: Detector, which takes less time than building this.
template <class S>
class BOXSTREAM_API BasicBoxIndex {
 public:
  using Box = BasicAabb<S>;

  explicit BasicBoxIndex(Span<const Box> boxes = {});
  ~BasicBoxIndex();
  BasicBoxIndex(BasicBoxIndex&&) noexcept;
  BasicBoxIndex& operator=(BasicBoxIndex&&) noexcept;

  /// Boxes, invalid ones included.
  std::size_t size() const;

  /// A box that contains all valid ones; invalid (min > max) if there are none.
  Box bounds() const;

  /// Boxes that overlap or touch `box`.
  void query_box(const Box& box, BoxVisitor visit) const;

  /// The same for many, several times as fast: `a` is the index in `boxes`, `b` that of a box found. `found` is cleared
  /// first; in no particular order.
  void query_boxes(Span<const Box> boxes, std::vector<Pair>& found) const;

  /// As World::query_planes, but that it allocates.
  void query_planes(Span<const BasicPlane<S>> planes, BoxVisitor visit) const;

  /// As World::query_ray.
  void query_ray(const BasicRay<S>& ray, BoxRayVisitor<S> visit) const;

  /// As World::query_nearest: nearest first, ties by index.
  std::size_t query_nearest(const S (&point)[3], Span<std::uint32_t> out) const;

  /// As World::query_nearest_box.
  void query_nearest_box(const Box& box, S limit, NearBoxVisitor<S> visit) const;

  /// The index as bytes: 40 and, for each box, 28 (of doubles 52), or 4 if it is invalid.
  std::vector<std::uint8_t> save() const;

  /// Of these; those of another version of their format are refused, too. Nothing refers to them afterwards. Takes a
  /// fraction of the time of building.
  static BasicBoxIndex load(Span<const std::uint8_t> bytes);

 private:
  struct BOXSTREAM_LOCAL Impl;
  std::unique_ptr<Impl> impl_;
};

using BoxIndex = BasicBoxIndex<float>;
using BoxIndex64 = BasicBoxIndex<double>;

}  // namespace boxstream
