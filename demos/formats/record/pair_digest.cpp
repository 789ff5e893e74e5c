// SPDX-License-Identifier: MIT
#include "formats/record/pair_digest.hpp"

namespace boxstream::record {
namespace {

constexpr std::uint64_t first_factor = 0xbf58476d1ce4e5b9, second_factor = 0x94d049bb133111eb;

/// The number whose product with odd `factor` is 1 modulo 2^64, by Newton's method: each round doubles the right bits.
constexpr std::uint64_t inverse(std::uint64_t factor) {
  std::uint64_t x = factor;  // right in the lowest three bits
  for (int i = 0; i < 5; ++i) x *= 2 - factor * x;
  return x;
}
static_assert(first_factor * inverse(first_factor) == 1 && second_factor * inverse(second_factor) == 1);

/// Undoes x ^= x >> shift.
std::uint64_t unshifted(std::uint64_t x, int shift) {
  std::uint64_t result = x;
  for (int done = shift; done < 64; done += shift) result = x ^ result >> shift;
  return result;
}

}  // namespace

std::uint64_t hash_of(Pair pair) {
  std::uint64_t x = std::uint64_t{pair.a} << 32 | pair.b;
  x = (x ^ x >> 30) * first_factor;
  x = (x ^ x >> 27) * second_factor;
  return x ^ x >> 31;
}

void PairDigest::add(Pair pair) {
  ++count;
  hash += hash_of(pair);
}

PairDigest digest_of(const std::vector<Pair>& pairs) {
  PairDigest digest;
  for (const Pair pair : pairs) digest.add(pair);
  return digest;
}

std::optional<Pair> single_difference(const PairDigest& more, const PairDigest& less) {
  if (more.count != less.count + 1) return std::nullopt;
  std::uint64_t x = unshifted(more.hash - less.hash, 31) * inverse(second_factor);
  x = unshifted(x, 27) * inverse(first_factor);
  x = unshifted(x, 30);
  const Pair pair{static_cast<std::uint32_t>(x >> 32), static_cast<std::uint32_t>(x)};
  if (pair.a < pair.b) return pair;
  return std::nullopt;
}

}  // namespace boxstream::record
