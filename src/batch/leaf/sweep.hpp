// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <boxstream/function_ref.hpp>
#include <boxstream/span.hpp>

#include "base/arena.hpp"
#include "batch/records/originals.hpp"
#include "batch/records/pair_buffer.hpp"
#include "batch/records/record.hpp"

namespace boxstream::detail {

/// How a leaf is swept.
struct SweepPlan {
  int axis = 0;
  /// Keys between which most low ends lie; outliers beyond share the first and the last bucket.
  std::int32_t typical_min = INT32_MIN;
  std::int32_t typical_max = INT32_MAX;
  /// Put in order by sorting: then what is compared is in proportion to what overlaps on the sweep axis.
  bool sorted = false;
  /// Between two sets: the one of which each box begins before, or with, those of the other that it overlaps.
  enum class First { either, a, b } first = First::either;

  /// What is left of a sweep over budget: boxes of one set, or of both. Does their pairs, and returns what a sweep
  /// does.
  using Rest = FunctionRef<bool(Span<const Record> a, Span<const Record> b)>;
  /// A sweep that is about to compare more than this, and some for each pair it has found, leaves the rest to `rest`.
  std::uint64_t most_tests = UINT64_MAX / 2;
  const Rest* rest = nullptr;
};

/// Which index goes first in an emitted pair.
enum class PairOrder { smaller_first, first_set_first };

struct SweepContext {
  Arena& arena;
  PairBuffer& pairs;
  KeyKind kinds[3];  // per axis, to space buckets evenly in the caller's coordinates
  PairOrder order;
  std::uint64_t tests = 0;
  Originals originals{};
  bool has_doubts =
      false;  // whether the last sweep had many: then the next asks for its originals before it needs them
};

/// Emits the pairs within `records`, or between `a` and `b`, that overlap on all axes and that this region owns.
/// False when the buffer's owner wants to stop. Order of pairs is a function of the arguments only.
bool sweep_self(Span<const Record> records, const SweepPlan& plan, SweepContext& context);
bool sweep_cross(Span<const Record> a, Span<const Record> b, const SweepPlan& plan, SweepContext& context);

}  // namespace boxstream::detail
