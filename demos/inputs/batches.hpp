// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/span.hpp>

/// Box batches for tests and benchmarks: each a pure function of (name, n, seed), the same bits on every platform.
namespace boxstream::batches {

struct Batch {
  std::string_view name;
  std::string_view description;

  /// Pairs grow as n^2: think before asking for 10^5 of them.
  bool quadratic;

  /// Bounds on pairs per box, for every seed, for n in 1000 .. 10^6 (quadratic ones: on pairs / (n (n - 1) / 2)).
  double density_low;
  double density_high;
};

/// All batches, in the order in which tables show them.
Span<const Batch> all();

/// The batch of that name; throws std::invalid_argument, with the names there are, if there is none.
const Batch& find(std::string_view name);

/// `n` valid boxes, shuffled where the construction has an order. Throws std::invalid_argument for an unknown name.
std::vector<Aabb> make(std::string_view name, std::size_t n, std::uint64_t seed);

/// The same boxes before they are rounded to float.
std::vector<Aabb64> make64(std::string_view name, std::size_t n, std::uint64_t seed);

}  // namespace boxstream::batches
