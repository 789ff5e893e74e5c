// SPDX-License-Identifier: MIT
#pragma once

#include "measure.hpp"

namespace boxstream::scenes {
class Simulation;
}

namespace boxstream::accuracy {

/// A running world and how it was at the start. It only looks.
class Watch {
 public:
  /// Of a world that has not stepped, and lives longer.
  explicit Watch(scenes::Simulation& simulation);

  /// Now, between two steps. Of kinds up to `tunnelled`: the others are no matter of one moment. NaN for
  /// joints where there are none.
  double value(const Measure& measure) const;

  /// Whether a body is ten times as fast as any could be that fell through the whole scene: then numbers mean nothing.
  bool has_exploded() const;

 private:
  struct Momenta {
    double linear[3] = {}, angular[3] = {};
  };
  Momenta momenta() const;
  double top() const;
  bool has_joints() const;

  scenes::Simulation& simulation_;
  Momenta first_;
  double first_energy_, first_top_, base_, speed_limit_;
};

}  // namespace boxstream::accuracy
