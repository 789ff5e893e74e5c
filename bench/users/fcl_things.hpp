// SPDX-License-Identifier: MIT
#pragma once

#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision_object.h>

#include <cstdint>
#include <deque>
#include <random>
#include <vector>

#include "peers/pair_hash.hpp"

namespace boxstream::bench {

using FclVector = ::fcl::Vector3<double>;

/// An object whose shape, for the distances of callbacks, is the largest ball in the middle of its box, or the ground.
class FclThing : public ::fcl::CollisionObject<double> {
 public:
  /// A box with these half sides and `reach` more on all sides.
  FclThing(std::uint32_t index, const FclVector& at, const FclVector& half, double reach = 0);
  /// All below z = 0.
  explicit FclThing(std::uint32_t index);

  void place(const FclVector& at);
  const FclVector& home() const { return home_; }
  std::uint32_t index() const { return index_; }

  friend double distance_of(const FclThing& a, const FclThing& b);

 private:
  std::uint32_t index_;
  FclVector home_, at_, half_;
  double radius_ = 0;
  bool is_ground_ = false;
};

/// Things and the pointers by which managers know them; things stay where they are.
struct FclThings {
  std::deque<FclThing> all;
  std::vector<::fcl::CollisionObject<double>*> pointers;

  template <class... Arguments>
  void add(Arguments&&... arguments) {
    all.emplace_back(static_cast<std::uint32_t>(all.size()), arguments...);
    pointers.push_back(&all.back());
  }
  /// Each goes round its home, `reach` far on each axis, at a pace of its own.
  void sway(int frame, double reach);
};

/// What came of the questions of one frame. Calls may differ between managers, all else may not.
struct FclFindings {
  std::uint64_t calls = 0;
  std::uint64_t hits = 0;
  PairSummary pairs;
  std::uint64_t distances = 0;  ///< a hash of the least ones

  bool operator==(const FclFindings& other) const {
    return hits == other.hits && pairs == other.pairs && distances == other.distances;
  }
};

/// What callbacks get.
struct FclAsked {
  FclFindings& found;
  std::uint32_t groups = 0;  ///< added to the first index of pairs, so that those of other questions are others
  bool names_pairs = false;
  double least = 1e300;

  void note(const FclThing& a, const FclThing& b);
  /// After a query for the least distance.
  void note_least();
};

/// Goes on.
bool on_contact(::fcl::CollisionObject<double>* x, ::fcl::CollisionObject<double>* y, void* asked);
/// The first will do.
bool on_first_contact(::fcl::CollisionObject<double>* x, ::fcl::CollisionObject<double>* y, void* asked);
/// Neighbours on a chain are allowed to touch.
bool on_contact_of_links(::fcl::CollisionObject<double>* x, ::fcl::CollisionObject<double>* y, void* asked);

/// As FCL's own function does: the limit is the least one so far, and none is less than 0.
bool on_distance(::fcl::CollisionObject<double>* x, ::fcl::CollisionObject<double>* y, void* asked, double& limit);
bool on_distance_of_links(::fcl::CollisionObject<double>* x, ::fcl::CollisionObject<double>* y, void* asked,
                          double& limit);
/// Keeps the least one and leaves the limit alone.
bool on_distance_without_limit(::fcl::CollisionObject<double>* x, ::fcl::CollisionObject<double>* y, void* asked,
                               double& limit);
/// All that are nearer than 0.1.
bool on_distance_up_to_constant(::fcl::CollisionObject<double>* x, ::fcl::CollisionObject<double>* y, void* asked,
                                double& limit);

}  // namespace boxstream::bench
