// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <boxstream/span.hpp>

namespace boxstream::detail {

/// A pair, or a box (`a`) with the one that was asked about.
template <class S>
struct NearCandidate {
  S distance;
  std::uint32_t a;  // ranks, which settle ties
  std::uint32_t b;

  friend bool operator<(const NearCandidate& x, const NearCandidate& y) {
    if (x.distance != y.distance) return x.distance < y.distance;
    return x.a != y.a ? x.a < y.a : x.b < y.b;
  }
};

/// Sorts many candidates by counting them into bins of equal width, and then each bin: distances between two that are
/// close are spread evenly enough for bins of a few.
template <class S>
class NearSorter {
 public:
  using Candidate = NearCandidate<S>;

  /// Valid until `candidates` change or the next call.
  Span<const Candidate> sort(std::vector<Candidate>& candidates) {
    const auto nearer = [](const Candidate& x, const Candidate& y) { return x.distance < y.distance; };
    const auto [nearest, farthest] = std::minmax_element(candidates.begin(), candidates.end(), nearer);
    // Half, because differences may overflow.
    const S low = candidates.empty() ? S(0) : nearest->distance / 2;
    const S width = candidates.empty() ? S(0) : farthest->distance / 2 - low;
    if (candidates.size() < worth_spreading || !(width > 0)) {
      std::sort(candidates.begin(), candidates.end());
      return candidates;
    }
    const std::size_t bins = candidates.size() / mean_in_bin;
    const auto bin_of = [=](const Candidate& c) {
      return static_cast<std::size_t>((c.distance / 2 - low) / width * static_cast<S>(bins - 1));
    };
    starts_.assign(bins + 1, 0);
    for (const Candidate& c : candidates) ++starts_[bin_of(c)];
    std::uint32_t end = 0;
    for (std::uint32_t& start : starts_) start = end += start;
    if (spread_.size() < candidates.size()) {
      spread_.clear();  // nothing to be copied
      spread_.resize(candidates.capacity());
    }
    for (const Candidate& c : candidates) spread_[--starts_[bin_of(c)]] = c;
    for (std::size_t bin = 0; bin < bins; ++bin)
      std::sort(spread_.begin() + starts_[bin], spread_.begin() + starts_[bin + 1]);
    return Span<const Candidate>(spread_.data(), candidates.size());
  }

 private:
  static constexpr std::size_t worth_spreading = 512;
  static constexpr std::size_t mean_in_bin = 8;

  std::vector<Candidate> spread_;
  std::vector<std::uint32_t> starts_;
};

}  // namespace boxstream::detail
