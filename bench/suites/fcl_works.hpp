// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <boxstream/span.hpp>

#include "inputs/motion.hpp"
#include "peers/fcl_managers.hpp"
#include "peers/fcl_peer.hpp"
#include "peers/pair_hash.hpp"

namespace boxstream::bench {

/// The objects of a manager. They may be in several managers.
struct FclCast {
  std::vector<FclObject<double>> objects;
  std::vector<::fcl::CollisionObject<double>*> pointers, moved;
  MovingBoxes moving;
};

/// As many casts of n objects as a measurable time needs; each from a seed of its own.
class FclScene {
 public:
  /// Every `one_in`-th object moves.
  FclScene(const std::string& batch, std::size_t n, std::uint64_t seed, Motion motion, std::size_t one_in);
  /// How many that is.
  static std::size_t casts_of(std::size_t n);

  FclScene(const FclScene&) = delete;
  FclScene& operator=(const FclScene&) = delete;

  /// Sets the boxes of objects that move; updating managers is part of what is measured.
  void next_frame();

  std::vector<FclCast>& casts() { return casts_; }

 private:
  std::size_t one_in_;
  std::vector<FclCast> casts_;
};

/// The change of a manager before the query.
enum class FclChange { none, made, all_moved, some_moved };
/// The query.
enum class FclQuery { none, self, first };

/// One thing that is timed: a change and a query.
struct FclWork {
  std::string_view name;
  std::string_view description;
  FclChange change;
  FclQuery query;
  Motion motion = Motion::asleep;
  std::size_t one_in = 1;  ///< every such object moves
};

Span<const FclWork> fcl_works();

/// The result: calls of the callback, and pairs that touch.
struct FclAnswer {
  std::uint64_t calls = 0;
  std::uint64_t hits = 0;
  PairSummary pairs;  ///< if asked for
};

/// A manager of one kind at work on one cast.
class FclWorker {
 public:
  FclWorker(const FclManagerKind& kind, const FclWork& work, FclCast& cast)
      : kind_(&kind), work_(&work), cast_(&cast) {}

  /// Fills the manager unless that is the work itself.
  void prepare();
  /// The part that is timed.
  void work(FclAnswer& answer);
  /// The same query with a slower callback that records the pairs.
  void check(FclAnswer& answer) const;
  void release();

 private:
  void fill();
  void ask(FclAnswer& answer, ::fcl::CollisionCallBack<double> on_pair) const;

  const FclManagerKind* kind_;
  const FclWork* work_;
  FclCast* cast_;
  std::unique_ptr<FclManager> manager_;
};

}  // namespace boxstream::bench
