// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <boxstream/detector.hpp>

#include "base/keys.hpp"
#include "batch/records/pair_buffer.hpp"

namespace boxstream::detail {

/// The boxes and filters of one search: within a single set, then `b` is the same as `a`, or between two. The caller
/// knows the first box of each by the index `first_a` or `first_b`.
template <class S>
struct Input {
  Span<const BasicAabb<S>> a, b;
  Span<const Filter> filters_a, filters_b;
  bool self;
  std::uint32_t first_a = 0, first_b = 0;
  Method method = Method::planned;
  std::uint32_t cutoff = 0;  // of the hybrid method; 0: by sample
  Faces faces = Faces::closed;
  /// Those of `a` and of `b` if there are any: boxes with the same do not pair.
  Span<const std::uint32_t> ids_a = {}, ids_b = {};
  /// Of keys of floats, which may stand for something else.
  KeyKind float_kind = KeyKind::float32;

  std::size_t boxes() const { return a.size() + (self ? 0 : b.size()); }
};

/// Between the sweep and the caller: drops pairs that only seemed to overlap (double boxes, whose keys are short),
/// pairs of equal ids and pairs that the filters refuse, then passes on what is left by the caller's indices.
template <class S>
class DeliveringBuffer final : public PairBuffer {
 public:
  /// For as long as `input` is there.
  DeliveringBuffer(const Input<S>& input, PairSink sink) : input_(input), sink_(sink) {}

  std::uint64_t delivered() const { return delivered_; }

 protected:
  bool take(Pair* pairs, std::size_t count) override {
    if constexpr (sizeof(S) == 8) count = keep_certain(pairs, count);
    if (!input_.ids_a.empty()) count = keep_of_other_ids(pairs, count);
    if (!input_.filters_a.empty() || !input_.filters_b.empty()) count = keep_accepted(pairs, count);
    if (count == 0) return true;
    delivered_ += count;
    if ((input_.first_a | input_.first_b) != 0)
      for (std::size_t i = 0; i < count; ++i) pairs[i] = {pairs[i].a + input_.first_a, pairs[i].b + input_.first_b};
    return sink_(Span<const Pair>(pairs, count));
  }

 private:
  /// Drops those in doubt that do not overlap.
  std::size_t keep_certain(Pair* pairs, std::size_t count) const {
    std::size_t kept = 0, from = 0;
    const auto keep_up_to = [&](std::size_t end) {
      kept = static_cast<std::size_t>(std::copy(pairs + from, pairs + end, pairs + kept) - pairs);
    };
    for (const std::size_t at : doubts()) {
      if (overlap_exactly(input_.a[pairs[at].a], input_.b[pairs[at].b], input_.faces)) continue;
      keep_up_to(at);
      from = at + 1;
    }
    if (from == 0) return count;
    keep_up_to(count);
    return kept;
  }

  std::size_t keep_of_other_ids(Pair* pairs, std::size_t count) const {
    const std::uint32_t *const ids_a = input_.ids_a.data(), *const ids_b = input_.ids_b.data();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Pair p = pairs[i];
      pairs[kept] = p;
      kept += ids_a[p.a] != ids_b[p.b] ? 1 : 0;
    }
    return kept;
  }

  /// Without a branch on what the filters say, which is unpredictable.
  std::size_t keep_accepted(Pair* pairs, std::size_t count) const {
    // No filters: all boxes have the same.
    const Filter any;
    const std::uint32_t is_one_of_a = input_.filters_a.empty() ? 0 : UINT32_MAX;
    const std::uint32_t is_one_of_b = input_.filters_b.empty() ? 0 : UINT32_MAX;
    const Filter* const of_a = is_one_of_a == 0 ? &any : input_.filters_a.data();
    const Filter* const of_b = is_one_of_b == 0 ? &any : input_.filters_b.data();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Pair p = pairs[i];
      const Filter a = of_a[p.a & is_one_of_a], b = of_b[p.b & is_one_of_b];
      pairs[kept] = p;
      kept += ((a.group & b.mask) != 0 ? 1u : 0u) & ((b.group & a.mask) != 0 ? 1u : 0u);
    }
    return kept;
  }

  const Input<S>& input_;
  PairSink sink_;
  std::uint64_t delivered_ = 0;
};

}  // namespace boxstream::detail
