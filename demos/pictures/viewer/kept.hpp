// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <boxstream/pair.hpp>

#include "simulation/run/simulation.hpp"

namespace boxstream::view {

/// Which objects of a world are recorded. A recording numbers them anew, by their places in `objects`.
struct Kept {
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  std::vector<std::uint32_t> objects;  ///< of the world, ascending
  std::size_t in_world = 0;            ///< objects
  std::size_t landmarks = 0;           ///< of `objects`, those that `choose_kept` took first
  std::size_t nearest = 0;             ///< and next; the others are a sample

  bool is_all() const { return objects.size() == in_world; }
  /// Where `object` is in `objects`; `none` if it is not kept.
  std::uint32_t place_of(std::uint32_t object) const;
  /// Pairs of the world, in the order given, as places; those of which both objects are kept.
  void places_of(const std::vector<Pair>& pairs, std::vector<Pair>& out) const;
};

Kept keep_all(const scenes::Simulation& simulation);

/// All objects if there are at most `most`. Else that many, by the world as it is now:
///   landmarks  what the scene names one by one, what does not move freely, and what is four times as large as most;
///              if these are more than half of `most`, the largest of them
///   nearest    a quarter of the others that there is room for: those nearest to the eye, when the page opens
///   sample     those of the rest whose numbers have the smallest hashes
/// A function of the scene: the broad-phase has no influence.
/// Memory: some 100 bytes for each object of the world until it returns.
Kept choose_kept(const scenes::Simulation& simulation, std::size_t most);

}  // namespace boxstream::view
