// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include <LinearMath/btTransform.h>

#include "measure.hpp"
#include "simulation/run/joint_error.hpp"

class btRigidBody;

namespace boxstream::scenes {
class Simulation;
}

namespace boxstream::accuracy {

/// Penetration depths of all contact points, in metres; 0 for those that do not penetrate.
struct Depths {
  double sum_of_squares = 0, deepest = 0, count = 0;

  double mean_square() const { return count == 0 ? 0 : sum_of_squares / count; }
};

Depths contact_depths(scenes::Simulation& simulation);

/// Computes measures of a running world, relative to its start. Never changes the world.
class Monitor {
 public:
  /// Of a world that has not stepped, and lives longer.
  explicit Monitor(scenes::Simulation& simulation);

  /// Now, between two steps. Of kinds up to `tunnelled`; NaN for those that need a whole run, and for joints where
  /// there are none.
  /// `body`: the place among all objects of the one that a measure of one body is of.
  /// `joint`: the place among all joints of the one that measures of joints are of; none: of all.
  double value(const Measure& measure, std::optional<std::size_t> body = {},
               std::optional<std::size_t> joint = {}) const;

  /// Of the top of the dynamic bodies, as a share of its height over their lowest point at the start. Up is against
  /// gravity; y where there is none, and where it tumbles.
  double height_loss() const;

  /// Whether a body is ten times as fast as one that fell through the whole scene could be; then numbers are void.
  /// Never where something else drives bodies: fields, motors, kinematic bodies, conveyors, vehicles, characters.
  bool has_exploded() const;

 private:
  struct Momenta {
    double linear[3] = {}, angular[3] = {};
  };
  Momenta momenta() const;
  std::array<double, 2> heights(const btRigidBody& body) const;
  double top() const;
  double of_body(Measure::Kind kind, std::size_t body) const;
  scenes::JointError joints(std::optional<std::size_t> joint) const;

  scenes::Simulation& simulation_;
  Momenta first_;
  double first_energy_, energy_scale_;
  btTransform upright_;
  double first_top_, base_, speed_limit_;
};

}  // namespace boxstream::accuracy
