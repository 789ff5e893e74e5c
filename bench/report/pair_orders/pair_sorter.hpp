// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <LinearMath/btVector3.h>

struct btBroadphaseProxy;

namespace boxstream::report {

/// Orders of pairs that depend on nothing but a world's state.
struct PairOrder {
  enum class By {
    ids,     ///< of the two objects, in order of creation
    low,     ///< the height of the middle of what their boxes share, against gravity
    high,    ///< the same, from above
    curve,   ///< where that middle is on a space-filling curve (Morton's)
    ground,  ///< how many pairs away the two are from what does not move
    random   ///< a hash of their ids and of `seed`
  };
  By by = By::ids;
  std::uint64_t seed = 0;
  bool anew = false;  ///< another seed in each step
};

/// "ids", "low first", "high first", "curve", "ground first", "shuffled" (at random, anew in each step). Throws
/// std::invalid_argument.
PairOrder parse_order(const std::string& name);

/// Puts pairs into an order. Equal ones are ordered by ids.
class PairSorter {
 public:
  PairSorter(const PairOrder& order, const btVector3& gravity) : order_(order), gravity_(gravity) {}

  /// How `count` pairs are to be taken: a permutation, valid until the next call. `pair(i)` gives the two proxies of
  /// the i-th, whose clients are collision objects.
  template <class PairOf>
  const std::vector<std::uint32_t>& sorted(std::size_t count, PairOf pair) {
    begin();
    for (std::size_t i = 0; i < count; ++i) {
      const auto [a, b] = pair(i);
      add(*a, *b);
    }
    return sort();
  }

 private:
  struct Keyed {
    std::uint64_t key, ids;
    std::uint32_t place;
  };

  void begin();
  void add(const btBroadphaseProxy& a, const btBroadphaseProxy& b);
  std::uint64_t key_of(const btBroadphaseProxy& a, const btBroadphaseProxy& b, std::uint64_t ids) const;
  void find_distances();
  const std::vector<std::uint32_t>& sort();

  PairOrder order_;
  btVector3 gravity_;
  std::vector<Keyed> keyed_;
  std::vector<std::pair<const btBroadphaseProxy*, const btBroadphaseProxy*>> pairs_;  ///< only where they are needed
  std::vector<std::uint32_t> permutation_;
};

}  // namespace boxstream::report
