// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <boxstream/executor.hpp>
#include <boxstream/pair.hpp>
#include <boxstream/span.hpp>

namespace boxstream::tests {

/// One line for each box set, scalar and kind of search (one set, two sets, frames of a World): its name, the number of
/// pairs, and a hash of the pairs in the order in which they come. The lines must be those of golden_order.txt,
/// whatever the executor (borrowed during the call, null for none), SIMD target, compiler and optimisation.
std::vector<std::string> golden_order(Executor* executor);

/// FNV-1a over the pairs in their order.
std::uint64_t order_hash(Span<const Pair> pairs);

}  // namespace boxstream::tests
