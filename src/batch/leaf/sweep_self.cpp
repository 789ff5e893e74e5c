// SPDX-License-Identifier: MIT
//
// The leaf of the tree: a sweep over a few hundred to a few thousand boxes of one set, in cache. Compiled once per SIMD
// target; the best one for the machine is picked at run time.

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "batch/leaf/sweep_self.cpp"
#include <hwy/foreach_target.h>  // compiles this file again for each target
#include <hwy/highway.h>

#include "batch/leaf/sweep.hpp"
#include "batch/leaf/sweep_account-inl.hpp"
#include "batch/leaf/sweep_emit-inl.hpp"
#include "batch/leaf/sweep_kernel-inl.hpp"
#include "batch/leaf/sweep_order-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

/// Boxes before a strip have been compared with all behind them, so what is left is a set of its own. A strip is as
/// long as it may be if its boxes meet all behind it.
HWY_ATTR bool sweep_in_strips(Ordered& set, const SweepPlan& plan, SweepContext& context) {
  Sweep<Emit::sorted, true> sweep(set, set, context);
  if (set.size * set.size <= plan.most_tests) return sweep.run(0, set.size, context.tests);
  const Account account(plan, context);
  const std::size_t shortest = (set.size / strips / block + 1) * block;
  for (std::size_t begin = 0, end = 0; begin < set.size; begin = end) {
    const std::uint64_t left = account.left(), within = left / (set.size - begin) / block * block;
    end =
        static_cast<std::size_t>(std::min<std::uint64_t>(begin + std::max<std::uint64_t>(shortest, within), set.size));
    if (within < shortest && sweep.most_tests(begin, end) > left) return (*plan.rest)(from(set, begin), {});
    if (!sweep.run(begin, end, context.tests)) return false;
  }
  return true;
}

HWY_ATTR bool SweepSelf(Span<const Record> records, const SweepPlan& plan, SweepContext& context) {
  if (records.size() < 2) return true;
  Arena& arena = context.arena;
  Arena::Frame frame(arena);
  Extent extent;
  Unordered set = extract(records, plan.axis, records.size(), extent, arena);
  Buckets buckets;
  const bool in_buckets =
      !plan.sorted && find_buckets(plan, context, extent.min[plan.axis], extent.max[plan.axis], records.size(),
                                   records.size() * thresholds.most_own_bucket_tests, buckets,
                                   [&] { return count_buckets(set, buckets) / 2; });
  Ordered ordered = in_buckets ? order_by_bucket(set, buckets, arena) : order_by_sort(set, arena);
  ordered.originals = context.originals.a;
  pack_both(ordered, nullptr, plan.axis, extent, context);
  const bool go_on = sweep_in_strips(ordered, plan, context);
  context.has_doubts = ordered.exact != nullptr;
  return go_on;
}

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxstream::detail {

HWY_EXPORT(SweepSelf);

bool sweep_self(Span<const Record> records, const SweepPlan& plan, SweepContext& context) {
  return HWY_DYNAMIC_DISPATCH(SweepSelf)(records, plan, context);
}

}  // namespace boxstream::detail
#endif
