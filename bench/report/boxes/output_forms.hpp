// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/pair.hpp>
#include <boxstream/span.hpp>

#include "peers/pair_hash.hpp"

namespace boxstream::report {

/// Two frames, the pairs of the second, and the changes.
struct TwoFrames {
  double share;  ///< of all pairs, that touch
  std::vector<Aabb> before, now;
  std::uint64_t count = 0, begun = 0, ended = 0;
  bench::PairSummary pairs, changes;
  std::uint64_t sum = 0;  ///< of the keys of the expected pairs
};

/// A form of the output. `run` is called for the frame before, which is not timed, and then timed for the second one;
/// `agrees` tells whether its result was right.
struct OutputForm {
  std::function<void(const std::vector<Aabb>& boxes)> run;
  std::function<bool(const TwoFrames& input)> agrees;
};

/// What a stream adds up: the least work that reads each pair.
inline std::uint64_t key_of(Pair pair) {
  return (std::uint64_t{pair.a} << 32 | pair.b) + 1;
}

/// Of pairs that began and pairs that ended; distinguishes the two.
bench::PairSummary changes_of(Span<const Pair> begun, Span<const Pair> ended);

/// "counted", "streamed", "listed", "sorted", "changes, merged" (two sorted lists), "changes, world", or a peer's name.
/// Throws std::invalid_argument for another.
OutputForm make_output_form(const std::string& name);

}  // namespace boxstream::report
