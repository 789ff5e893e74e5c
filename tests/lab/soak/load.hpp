// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>

namespace boxstream::soak {

/// An answer that is not the oracle's. `what()` says which and where.
class Wrong : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One kind of work. The object lives as long as the run and keeps what a host would keep from frame to frame.
class Load {
 public:
  virtual ~Load() = default;
  /// A second or less of work that `seed` decides, all of it compared with an oracle; returns how many answers were.
  /// Throws Wrong.
  virtual std::uint64_t round(std::uint64_t seed) = 0;
};

/// Batches of all kinds and sizes through one Detector, against a sweep along one axis.
std::unique_ptr<Load> batch_load();
/// Histories of one World that is cleared between them: pairs, events and queries against a plain look at all boxes.
std::unique_ptr<Load> world_load();
/// Shipped Bullet scenes, built, stepped and destroyed: pairs and lists of ghosts against a sort of their boxes.
std::unique_ptr<Load> bullet_load();
/// Shipped scenes of queries on boxstream::fcl::CollisionManager, against FCL's own tree.
std::unique_ptr<Load> fcl_load();

}  // namespace boxstream::soak
