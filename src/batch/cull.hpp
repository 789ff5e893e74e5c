// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <boxstream/span.hpp>

#include "base/arena.hpp"
#include "base/keys.hpp"
#include "batch/record.hpp"
#include "batch/source.hpp"

namespace boxstream::detail {

/// What is left of two sets without the boxes that cannot meet any of the other set, in the arena.
struct Culled {
  /// A set this much smaller than the other takes little time to mark, so that it is worth a try.
  static constexpr std::size_t much_smaller = 4;
  /// To find out whether it pays takes 10 microseconds then.
  static constexpr std::size_t least_boxes_of_larger = 1536;

  bool worthwhile = false;  ///< otherwise the rest means nothing
  Span<Record> a, b;
  std::uint64_t invalid_a = 0, invalid_b = 0;
};

/// Marks the cells of a coarse grid that one set touches, and keeps those boxes of the other that touch a marked one;
/// then the other way round, unless the first is much smaller. Done only where a sample says that it leaves out many. A
/// function of its arguments alone.
template <class Source>
Culled cull(const Source& a, const Source& b, const KeyKind (&kinds)[3], Arena& arena);

}  // namespace boxstream::detail
