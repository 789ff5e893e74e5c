// SPDX-License-Identifier: MIT
#include "peers/pair_hash.hpp"

#include <algorithm>

namespace boxstream::bench {

void PairSummary::add(std::uint32_t a, std::uint32_t b) {
  std::uint64_t key = (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
  // The finalizer of SplitMix64; a sum, unlike an exclusive or, notices a pair that comes twice.
  key += 0x9e3779b97f4a7c15u;
  key = (key ^ (key >> 30)) * 0xbf58476d1ce4e5b9u;
  key = (key ^ (key >> 27)) * 0x94d049bb133111ebu;
  hash += key ^ (key >> 31);
  ++count;
}

PairSummary summarize(Span<const Pair> pairs) {
  PairSummary summary;
  for (const Pair& pair : pairs) summary.add(pair.a, pair.b);
  return summary;
}

}  // namespace boxstream::bench
