// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/pair.hpp>
#include <cstdint>
#include <optional>
#include <vector>

namespace boxstream::record {

/// Number and hash of a set of pairs, the same for any order of adding them. The hash distinguishes sets that differ by
/// accident; it is no protection against a search for two sets with the same one.
struct PairDigest {
  std::uint64_t count = 0;
  std::uint64_t hash = 0;  // sum of `hash_of` over all pairs, modulo 2^64

  void add(Pair pair);

  friend bool operator==(const PairDigest&, const PairDigest&) = default;
};

/// The finaliser of splitmix64, on a << 32 | b: one to one, so that a difference of one pair can be read off.
std::uint64_t hash_of(Pair pair);

PairDigest digest_of(const std::vector<Pair>& pairs);

/// The one pair that the set behind `more` has and the one behind `less` has not, if that is all the difference;
/// nothing if the digests differ.
std::optional<Pair> single_difference(const PairDigest& more, const PairDigest& less);

}  // namespace boxstream::record
