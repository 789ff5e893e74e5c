// SPDX-License-Identifier: MIT
//
// What a sweep has compared and found so far, against what it may: its parts may run out of budget.

#if defined(BOXSTREAM_SWEEP_ACCOUNT_INL_HPP_) == defined(HWY_TARGET_TOGGLE)  // once per SIMD target
#ifdef BOXSTREAM_SWEEP_ACCOUNT_INL_HPP_
#undef BOXSTREAM_SWEEP_ACCOUNT_INL_HPP_
#else
#define BOXSTREAM_SWEEP_ACCOUNT_INL_HPP_
#endif

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "base/thresholds.hpp"
#include "batch/leaf/sweep.hpp"
#include "batch/leaf/sweep_order-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

class Account {
 public:
  Account(const SweepPlan& plan, const SweepContext& context)
      : most_tests_(plan.most_tests), context_(context), tests_(context.tests), found_(context.pairs.found()) {}

  /// How many more tests it may make.
  std::uint64_t left() const {
    const std::uint64_t tests = context_.tests - tests_, found = context_.pairs.found() - found_;
    return std::max(most_tests_ + thresholds.tests_per_pair * found, tests) - tests;
  }

 private:
  std::uint64_t most_tests_;
  const SweepContext& context_;
  std::uint64_t tests_, found_;
};

// Parts of a sweep. What a part would compare is known before it begins.
constexpr std::size_t strips = 64;

inline Span<const Record> from(const Ordered& set, std::size_t begin) {
  return {set.records + begin, set.size - begin};
}

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#endif
