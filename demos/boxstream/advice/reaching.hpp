// SPDX-License-Identifier: MIT
#pragma once

#include <LinearMath/btVector3.h>
#include <cstddef>
#include <vector>

#include "simulation/effects/effect.hpp"

namespace boxstream::tool {

/// Of each body, in kg; 0 of what is not dynamic. Throws SceneError for a shape that cannot be built.
std::vector<double> masses_of(const effects::Subject& subject);

/// Where the centre of mass of each body is at the start; of what is not dynamic, its place. Throws likewise.
std::vector<scenes::Vec3> centres_of(const effects::Subject& subject);

/// Where the bodies of a scene are at the start, and what they may come to.
class Reaching {
 public:
  /// `subject` has to outlive it. Throws SceneError for a shape that cannot be built.
  explicit Reaching(const effects::Subject& subject);

  /// Whether the boxes of two bodies are closer to each other than a twentieth of the smaller one.
  bool touch(std::size_t a, std::size_t b) const;
  /// Whether `upper` may come to rest on `lower`: it starts above that one's middle, and either of them can move aside
  /// as far as they are apart. Where something pushes bodies about, they get everywhere.
  bool can_stack(std::size_t upper, std::size_t lower) const;
  /// The mean extent of a body's box.
  double size(std::size_t body) const;

 private:
  struct Box {
    btVector3 low{0, 0, 0}, high{0, 0, 0};
  };
  double way(std::size_t body, double fall) const;

  const effects::Subject& subject_;
  std::vector<Box> boxes_;
  btVector3 up_{0, 0, 0};
  double seconds_;
  bool everywhere_;
};

}  // namespace boxstream::tool
