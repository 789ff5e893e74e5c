// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <boxstream/span.hpp>

#include "search/arena.hpp"
#include "search/keys.hpp"
#include "search/record.hpp"
#include "search/source.hpp"

namespace boxstream::detail {

/// What is left of two sets without the boxes that cannot meet any of the other set, in the arena.
struct Culled {
  /// A set this much smaller than the other takes little time to mark, so that it is worth a try.
  static constexpr std::size_t much_smaller = 4;

  bool tried = false;       ///< otherwise the sets are too small to find out whether it is worthwhile
  bool worthwhile = false;  ///< otherwise the rest means nothing
  Span<const Record> a, b;
  std::uint64_t invalid = 0;  ///< boxes of both sets
};

/// Marks the cells of a coarse grid that one set touches, and keeps those boxes of the other that touch a marked one;
/// then the other way round. Done only where a sample says that it leaves out many. A function of its arguments alone.
template <class Source>
Culled cull(const Source& a, const Source& b, const KeyKind (&kinds)[3], Arena& arena);

}  // namespace boxstream::detail
