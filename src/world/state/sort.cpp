// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cassert>

#include "base/thresholds.hpp"
#include "world/state/pairs.hpp"

namespace boxstream::detail {

/// Least significant digit first. Ranks have few significant bits, and only those make digits: a digit is a field of
/// one of the two ranks, never of both.
void PairSorter::sort(Span<const Pair> pairs, std::size_t ranks, std::vector<PairKey>& out) {
  assert(std::all_of(pairs.begin(), pairs.end(), [=](Pair p) { return p.a < p.b && p.b < ranks; }));
  const std::size_t n = pairs.size();
  out.resize(n);
  if (n < thresholds.few_keys) {
    std::transform(pairs.begin(), pairs.end(), out.begin(), [](Pair p) { return pair_key(p.a, p.b); });
    std::sort(out.begin(), out.end());
    return;
  }
  const auto rank_bits = static_cast<unsigned>(std::bit_width(ranks - 1));
  const unsigned digits = (rank_bits + thresholds.most_digit_bits - 1) / thresholds.most_digit_bits;  // of each rank
  const unsigned bits = (rank_bits + digits - 1) / digits;
  const std::size_t values = std::size_t{1} << bits;
  const std::size_t mask = values - 1;
  const auto shift = [=](unsigned pass) { return (pass < digits ? 0 : 32) + pass % digits * bits; };

  scratch_.resize(n);
  counts_.assign(2 * digits * values, 0);
  for (const Pair p : pairs)
    for (unsigned d = 0; d < digits; ++d) {
      ++counts_[d * values + (p.b >> d * bits & mask)];
      ++counts_[(digits + d) * values + (p.a >> d * bits & mask)];
    }

  // An even number of passes, so the last one writes to `out`.
  PairKey* to = scratch_.data();
  PairKey* from = out.data();
  for (unsigned pass = 0; pass < 2 * digits; ++pass) {
    std::size_t* const place = counts_.data() + pass * values;
    std::size_t sum = 0;
    for (std::size_t v = 0; v < values; ++v) {
      const std::size_t count = place[v];
      place[v] = sum;
      sum += count;
    }
    const unsigned down = shift(pass);
    if (pass == 0) {
      for (const Pair p : pairs) to[place[p.b & mask]++] = pair_key(p.a, p.b);
    } else {
      for (std::size_t i = 0; i < n; ++i) to[place[from[i] >> down & mask]++] = from[i];
    }
    std::swap(from, to);
  }
}

}  // namespace boxstream::detail
