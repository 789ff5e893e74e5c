// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <boxstream/pair.hpp>
#include <boxstream/span.hpp>

namespace boxstream::bench {

/// Fingerprint of a set of pairs, whatever their order: equal sets agree; a pair missing, extra or listed twice changes
/// the count or, but for a chance of 2^-64, the hash.
struct PairSummary {
  std::uint64_t count = 0;
  std::uint64_t hash = 0;

  /// The pair {a, b}; which of them is first makes no difference.
  void add(std::uint32_t a, std::uint32_t b);

  friend bool operator==(const PairSummary&, const PairSummary&) = default;
};

PairSummary summarize(Span<const Pair> pairs);

}  // namespace boxstream::bench
