// SPDX-License-Identifier: MIT
//
// The leaf of the tree: a sweep over a few hundred to a few thousand boxes of two sets, in cache. Compiled once per
// SIMD target; the best one for the machine is picked at run time.

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "batch/leaf/sweep_cross.cpp"
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

/// The same for two sets: of both, the boxes that begin below a key.
template <Emit emit_a, Emit emit_b>
HWY_ATTR bool sweep_in_strips(Ordered& a, Ordered& b, const SweepPlan& plan, SweepContext& context) {
  using First = SweepPlan::First;
  if (plan.first == First::b) return Sweep<emit_b, false>(b, a, context).run(0, b.size, context.tests);
  Sweep<emit_a, false> from_a(a, b, context);
  if (plan.first == First::a) return from_a.run(0, a.size, context.tests);
  Sweep<emit_b, false> from_b(b, a, context, Ties::dropped);
  const bool is_within = 2 * a.size * b.size + block * (a.size + b.size) <= plan.most_tests;
  if (is_within) return from_a.run(0, a.size, context.tests) && from_b.run(0, b.size, context.tests);

  const Account account(plan, context);
  const Ordered& larger = a.size > b.size ? a : b;
  std::size_t begin_a = 0, begin_b = 0;
  for (std::size_t strip = 1; strip <= strips; ++strip) {
    const bool is_last = strip == strips;
    const std::int32_t key = is_last ? 0 : larger.lo[larger.size * strip / strips];
    const std::size_t end_a = is_last ? a.size : a.begin_of(key), end_b = is_last ? b.size : b.begin_of(key);
    if (from_a.most_tests(begin_a, end_a) + from_b.most_tests(begin_b, end_b) > account.left())
      return (*plan.rest)(from(a, begin_a), from(b, begin_b));
    if (!from_a.run(begin_a, end_a, context.tests) || !from_b.run(begin_b, end_b, context.tests)) return false;
    begin_a = end_a;
    begin_b = end_b;
  }
  return true;
}

HWY_ATTR bool SweepCross(Span<const Record> a, Span<const Record> b, const SweepPlan& plan, SweepContext& context) {
  if (a.size() == 0 || b.size() == 0) return true;
  Arena& arena = context.arena;
  Arena::Frame frame(arena);
  const std::size_t larger = std::max(a.size(), b.size());
  Extent extent;
  Unordered set_a = extract(a, plan.axis, larger, extent, arena);
  Unordered set_b = extract(b, plan.axis, larger, extent, arena);
  Buckets buckets;
  const bool in_buckets =
      !plan.sorted && find_buckets(plan, context, extent.min[plan.axis], extent.max[plan.axis], larger,
                                   (a.size() + b.size()) * thresholds.most_own_bucket_tests, buckets, [&] {
                                     count_buckets(set_a, buckets);
                                     count_buckets(set_b, buckets);
                                     std::uint64_t same_bucket = 0;
                                     for (std::uint32_t i = 0; i < buckets.count(); ++i)
                                       same_bucket += std::uint64_t{set_a.start[i + 1] - set_a.start[i]} *
                                                      (set_b.start[i + 1] - set_b.start[i]);
                                     return same_bucket;
                                   });
  Ordered ordered_a = in_buckets ? order_by_bucket(set_a, buckets, arena) : order_by_sort(set_a, arena);
  Ordered ordered_b = in_buckets ? order_by_bucket(set_b, buckets, arena) : order_by_sort(set_b, arena);
  ordered_a.originals = context.originals.a;
  ordered_b.originals = context.originals.b;
  pack_both(ordered_a, &ordered_b, plan.axis, extent, context);
  const bool go_on = context.order == PairOrder::smaller_first
                         ? sweep_in_strips<Emit::sorted, Emit::sorted>(ordered_a, ordered_b, plan, context)
                         : sweep_in_strips<Emit::set_first, Emit::other_first>(ordered_a, ordered_b, plan, context);
  context.has_doubts = ordered_a.exact != nullptr;
  return go_on;
}

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxstream::detail {

HWY_EXPORT(SweepCross);

bool sweep_cross(Span<const Record> a, Span<const Record> b, const SweepPlan& plan, SweepContext& context) {
  return HWY_DYNAMIC_DISPATCH(SweepCross)(a, b, plan, context);
}

}  // namespace boxstream::detail
#endif
