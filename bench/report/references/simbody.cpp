// SPDX-License-Identifier: MIT
#include "references/simbody.hpp"

#include <utility>

#include "format/experiment.hpp"
#include "witnesses/witness.hpp"

namespace boxstream::report {

bool simbody_is_built() {
  return witnesses::simbody_is_built();
}

accuracy::Trajectory simbody_trajectory(const scenes::Scene& scene, std::uint64_t steps) {
  const auto number = [](double value) { return static_cast<btScalar>(value); };
  accuracy::Trajectory trajectory;
  bool at_the_start = true;
  try {
    for (const witnesses::Frame& from : witnesses::run_simbody(scene, steps)) {
      if (std::exchange(at_the_start, false)) continue;
      accuracy::Frame& frame = trajectory.frames.emplace_back();
      for (const witnesses::Moving& body : from.bodies) {
        const auto& [p, q] = std::pair(body.position, body.rotation);
        frame.positions.emplace_back(number(p[0]), number(p[1]), number(p[2]));
        frame.rotations.emplace_back(number(q[0]), number(q[1]), number(q[2]), number(q[3]));
      }
    }
  } catch (const witnesses::Unknown& reason) {
    throw BadExperiment(scene.file + ": no reference by Simbody: " + reason.what());
  }
  return trajectory;
}

}  // namespace boxstream::report
