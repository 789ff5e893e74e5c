// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <boxstream/span.hpp>

#include "search/arena.hpp"
#include "search/pair_buffer.hpp"
#include "search/record.hpp"

namespace boxstream::detail {

/// How a leaf is swept.
struct SweepPlan {
  int axis = 0;
  /// Keys between which most low ends lie; outliers beyond share the first and the last bucket.
  std::int32_t typical_min = INT32_MIN;
  std::int32_t typical_max = INT32_MAX;
};

/// Which index goes first in an emitted pair.
enum class PairOrder { smaller_first, first_set_first };

struct SweepContext {
  Arena& arena;
  PairBuffer& pairs;
  KeyKind kinds[3];  // per axis, to space buckets evenly in the caller's coordinates
  PairOrder order;
  std::uint64_t tests = 0;
};

/// Emits the pairs within `records`, or between `a` and `b`, that overlap on all axes and that this region owns.
/// False when the buffer's owner wants to stop. Order of pairs is a function of the arguments only.
bool sweep_self(Span<const Record> records, const SweepPlan& plan, SweepContext& context);
bool sweep_cross(Span<const Record> a, Span<const Record> b, const SweepPlan& plan, SweepContext& context);

}  // namespace boxstream::detail
