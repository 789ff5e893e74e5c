// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/pair.hpp>
#include <boxstream/span.hpp>

#include "pair_hash.hpp"

namespace boxstream::report {

/// Two frames, what there is in the second, and what changed.
struct TwoFrames {
  double share;  ///< of all pairs, that touch
  std::vector<Aabb> before, now;
  std::uint64_t count = 0, begun = 0, ended = 0;
  bench::PairSummary pairs, changes;
  std::uint64_t sum = 0;  ///< of the keys of the pairs there are
};

/// A form of the answer. `first` sees the frame before, and is not timed; `run` is.
class OutputForm {
 public:
  virtual ~OutputForm() = default;
  virtual void first(const std::vector<Aabb>& boxes) { run(boxes); }
  virtual void run(const std::vector<Aabb>& boxes) = 0;
  /// Whether the last run was right.
  virtual bool agrees(const TwoFrames& input) const = 0;
};

/// What a stream adds up: looking at each pair costs next to nothing then, and no other work is in the price.
inline std::uint64_t key_of(Pair pair) {
  return (std::uint64_t{pair.a} << 32 | pair.b) + 1;
}

/// Of pairs that began and pairs that ended, which are told apart.
bench::PairSummary changes_of(Span<const Pair> begun, Span<const Pair> ended);

/// "counted", "streamed", "listed", "sorted", "changes, merged" (two sorted lists), "changes, world", or a peer's name.
/// Throws std::invalid_argument for another.
std::unique_ptr<OutputForm> make_output_form(const std::string& name);

}  // namespace boxstream::report
