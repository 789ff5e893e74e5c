// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>

#include <boxstream/aabb.hpp>
#include <boxstream/detail/export.hpp>
#include <boxstream/function_ref.hpp>
#include <boxstream/span.hpp>

namespace boxstream {

/// Whether a box, one of `boxes` of a set, is in the sample from which a decomposition into `parts` is made: each with
/// the same chance, so that there are about 512 for each part, or all. A function of its arguments. `id` is any number
/// that no other box of the set has.
BOXSTREAM_API bool is_sampled(std::uint64_t id, std::uint64_t boxes, std::size_t parts);

/// Space divided into parts that about equally many boxes of a set touch, so that machines or processes can find the
/// pairs of the set together: boxstream/mpi.hpp does that.
///
/// @par Use
/// Each process finds the pairs of the boxes that touch its part and keeps those with `(before(a) & before(b)) == 0`.
/// Then each pair of the set is found once.
///
/// @par Method
/// A k-d tree over a sample, which is a function of the boxes in it, not of their order. Coordinates are compared and
/// never computed with: processes with the same sample have the same parts, and boxes may be infinite.
///
/// @par Balance
/// Of the boxes that touch each part, as far as the sample tells. Boxes that are cut count in each part.
///
/// @par Threads
/// Const calls may come from any number of threads.
template <class S>
class BOXSTREAM_API BasicDecomposition {
 public:
  /// Invalid boxes of the sample are passed over. May throw std::bad_alloc.
  BasicDecomposition(Span<const BasicAabb<S>> sample, std::size_t parts);
  ~BasicDecomposition();
  BasicDecomposition(BasicDecomposition&&) noexcept;
  BasicDecomposition& operator=(BasicDecomposition&&) noexcept;

  /// At least one, at most as many as were asked for: fewer where no cut leaves enough boxes out of either side.
  std::size_t size() const;

  /// The box that a part fills. Sides without an end are infinite; parts share faces.
  BasicAabb<S> bounds(std::size_t part) const;

  /// Calls `visit(part)` for each part that the box touches; for none if the box is invalid.
  void for_each_touched(const BasicAabb<S>& box, FunctionRef<void(std::size_t)> visit) const;

  /// On which axes (bit d) the box begins before the part. Two boxes that overlap or touch, and that both touch the
  /// part, are a pair of this part if they have no bit in common: then it has the low corner of what they share. Of
  /// exactly one part is that true.
  std::uint8_t before(std::size_t part, const BasicAabb<S>& box) const;

 private:
  struct BOXSTREAM_LOCAL Impl;
  std::unique_ptr<Impl> impl_;
};

using Decomposition = BasicDecomposition<float>;
using Decomposition64 = BasicDecomposition<double>;

extern template class BasicDecomposition<float>;
extern template class BasicDecomposition<double>;

}  // namespace boxstream
