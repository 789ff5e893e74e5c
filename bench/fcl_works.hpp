// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

#include <boxstream/span.hpp>

#include "fcl_managers.hpp"
#include "fcl_scene.hpp"
#include "pair_hash.hpp"

namespace boxstream::bench {

/// What a manager goes through before it is asked.
enum class FclChange { none, made, all_moved, some_moved };
/// What it is asked.
enum class FclQuery { none, self, object, cross, first, nearest, nearest_object, nearest_cross };

/// One thing that is timed: a change and a query.
struct FclWork {
  std::string_view name;
  std::string_view description;
  FclChange change;
  FclQuery query;
  Motion motion = Motion::asleep;
  std::size_t one_in = 1;  ///< that many objects move
  bool apart = false;      ///< few boxes touch
};

Span<const FclWork> fcl_works();

/// What came of it: calls of the callback, pairs that touch (or queries of distance), and the distances found.
struct FclAnswer {
  std::uint64_t calls = 0;
  std::uint64_t hits = 0;
  PairSummary pairs;          ///< if asked for
  std::uint64_t nearest = 0;  ///< a hash of the least distances
};

inline bool is_distance(FclQuery query) {
  return query >= FclQuery::nearest;
}

/// A manager of one kind at work on one cast.
class FclWorker {
 public:
  FclWorker(const FclManagerKind& kind, const FclWork& work, FclCast& cast)
      : kind_(&kind), work_(&work), cast_(&cast) {}

  /// Fills the manager if that is not the work itself.
  void prepare();
  /// What is timed.
  void work(FclAnswer& answer);
  /// The same query with a slower callback that tells which pairs there are.
  void check(FclAnswer& answer) const;
  void release();

 private:
  void fill();
  void ask(FclAnswer& answer, ::fcl::CollisionCallBack<double> on_pair) const;
  void ask_distance(FclAnswer& answer) const;

  const FclManagerKind* kind_;
  const FclWork* work_;
  FclCast* cast_;
  std::unique_ptr<FclManager> manager_, other_;
};

}  // namespace boxstream::bench
