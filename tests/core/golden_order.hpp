// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <boxstream/detector.hpp>

namespace boxstream::tests {

/// One line for each box set, scalar and kind of search: its name, the number of pairs, and a hash of the pairs in the
/// order in which they come. The lines must be those of golden_order.txt, whatever the executor and SIMD target.
std::vector<std::string> golden_order(Detector& detector);

/// FNV-1a over the pairs in their order.
std::uint64_t order_hash(Span<const Pair> pairs);

}  // namespace boxstream::tests
