// SPDX-License-Identifier: MIT
#pragma once

#include <LinearMath/btQuaternion.h>
#include <LinearMath/btVector3.h>

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace boxstream::scenes {
class Simulation;
}

namespace boxstream::accuracy {

/// Where dynamic bodies are, in the order of the scene: as many in each frame of a scene, also of what is frozen or
/// taken out on its way.
struct Frame {
  std::vector<btVector3> positions;
  std::vector<btQuaternion> rotations;
};

/// A run: the reference, or one that is compared with it.
struct Trajectory {
  double size = 0;            ///< m, the mean of the least sides of the dynamic bodies
  std::vector<Frame> frames;  ///< after each step of the scene as it is
  /// Indices of objects that had contact points, lower first, and the time of the first ones.
  std::map<std::pair<int, int>, double> contacts;
};

/// See Trajectory.
double size_of_bodies(const scenes::Simulation& simulation);

Frame frame_of(const scenes::Simulation& simulation);

/// Adds the pairs that have contact points now.
void record_contacts(scenes::Simulation& simulation, double time, Trajectory& trajectory);
/// The same in every substep from now on, with the time of the step's beginning: contacts may come and go within it.
/// `trajectory` outlives the run.
void record_contacts_within(scenes::Simulation& simulation, Trajectory& trajectory);

/// Metres, from corner to corner of the box that their centres are in.
double extent(const Frame& frame);
/// Metres, RMS over the bodies.
double distance(const Frame& a, const Frame& b);
/// Degrees, RMS over the bodies.
double angle(const Frame& a, const Frame& b);

/// The first time at which one of the two has a new contact that the other does not have within `lag` seconds of it;
/// `end` if there is none.
double divergence_time(const Trajectory& a, const Trajectory& b, double lag, double end);

}  // namespace boxstream::accuracy
