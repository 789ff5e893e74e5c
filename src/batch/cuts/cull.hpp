// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <boxstream/span.hpp>

#include "base/arena.hpp"
#include "base/keys.hpp"
#include "batch/records/record.hpp"
#include "batch/records/source.hpp"

namespace boxstream::detail {

/// Two sets without the boxes that cannot overlap the other set, in the arena.
struct Culled {
  bool worthwhile = false;  ///< otherwise the other fields mean nothing
  Span<Record> a, b;
  std::uint64_t invalid_a = 0, invalid_b = 0;
};

/// Marks the cells of a coarse grid that one set touches, and keeps the boxes of the other that touch a marked cell;
/// then the other way round, unless the first is much smaller. Done only if, by a sample, many boxes are left out. A
/// function of its arguments alone.
template <class Source>
Culled cull(const Source& a, const Source& b, const KeyKind (&kinds)[3], Arena& arena);

}  // namespace boxstream::detail
