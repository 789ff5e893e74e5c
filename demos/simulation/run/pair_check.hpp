// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/pair.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class btBroadphaseInterface;

namespace boxstream::scenes {

/// The pairs that a broad-phase holds, as indices of objects (the user index of each proxy's client), lower first,
/// sorted.
void list_pairs(const btBroadphaseInterface& broadphase, std::vector<Pair>& out);

/// How many elements of sorted `list` are not in sorted `other`.
std::uint64_t count_missing(const std::vector<Pair>& list, const std::vector<Pair>& other);

class Simulation;

/// The pairs there must be: objects whose last-passed boxes overlap (closed) and whose filters accept, found with
/// a sort along one axis. Indices of objects, sorted. Filters are taken as they are now: no scene changes
/// them in mid-run. Only meaningful where boxes and pairs agree: see Simulation::set_after_pairs.
std::vector<Pair> expected_pairs(const Simulation& simulation);

/// What the broad-phase of `simulation` holds now, as indices of objects, sorted.
std::vector<Pair> held_pairs(const Simulation& simulation);

/// Those of `pairs` whose boxes overlap.
std::vector<Pair> overlapping_only(const Simulation& simulation, const std::vector<Pair>& pairs);

/// Empty if the broad-phase is right, otherwise the first difference. "simple" must hold exactly the expected pairs;
/// "boxstream" and "hybrid" may hold more as far as contacts of wide shapes reach, and the others any more, provided a
/// test of the boxes leaves exactly the expected ones.
std::string check_pairs(const Simulation& simulation);

/// The same for the lists of ghosts.
std::string check_ghosts(const Simulation& simulation);

/// A second broad-phase that is fed, step for step, with the boxes of a running Simulation: the way to compare the
/// pairs of two broad-phases on the same world, which two separate runs cannot do (pair order changes trajectories).
class Shadow {
 public:
  Shadow(const Simulation& simulation, const std::string& broadphase);
  ~Shadow();
  Shadow(const Shadow&) = delete;
  Shadow& operator=(const Shadow&) = delete;

  /// Passes on the boxes as they are now and calculates. Call it where set_after_pairs calls.
  void follow();

  /// What it holds, as indices of objects, sorted.
  std::vector<Pair> pairs() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace boxstream::scenes
