// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "motion.hpp"
#include "peers/fcl_peer.hpp"

namespace boxstream::bench {

/// What one manager, or two, are filled with and asked about. Objects exist already, and may sit in several managers.
struct FclCast {
  std::vector<FclObject<double>> objects;
  std::vector<FclObject<double>> others;   ///< few and large, for a second manager
  std::vector<FclObject<double>> queries;  ///< in no manager
  std::vector<::fcl::CollisionObject<double>*> pointers, other_pointers, moved;
  MovingBoxes moving;
};

/// As many casts of n objects as it takes to have something to measure; each from a seed of its own.
class FclScene {
 public:
  static constexpr std::size_t others = 10;
  static constexpr std::size_t queries = 500;

  /// `one_in`: that many objects move, evenly spread. `apart`: boxes have a tenth of their sides, so that few touch.
  FclScene(const std::string& batch, std::size_t n, std::uint64_t seed, Motion motion, std::size_t one_in, bool apart);
  /// How many that is.
  static std::size_t casts_of(std::size_t n);

  FclScene(const FclScene&) = delete;
  FclScene& operator=(const FclScene&) = delete;

  /// Sets the boxes of objects that move. Managers are told by those who measure them.
  void next_frame();

  std::vector<FclCast>& casts() { return casts_; }

 private:
  std::size_t one_in_;
  std::vector<FclCast> casts_;
};

}  // namespace boxstream::bench
