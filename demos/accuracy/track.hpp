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

/// Where dynamic bodies are, in the order of the scene.
struct Frame {
  std::vector<btVector3> places;
  std::vector<btQuaternion> rotations;
};

/// What a run did: the reference that others are compared with, or one of them.
struct Track {
  std::vector<Frame> frames;  ///< after each step of the scene as it is
  /// Indices of objects that have touched, lower first, and the time when they first did. Touching is what the engine
  /// takes for it: two shapes with contact points.
  std::map<std::pair<int, int>, double> touches;
};

Frame frame_of(const scenes::Simulation& simulation);

/// Puts down who touches now.
void note_touches(scenes::Simulation& simulation, double time, Track& track);
/// The same in every substep from now on, with the time of the step's beginning: contacts may come and go within it.
/// `track` outlives the run.
void note_touches_within(scenes::Simulation& simulation, Track& track);

/// Metres, RMS over the bodies.
double distance(const Frame& a, const Frame& b);
/// Degrees, RMS over the bodies.
double angle(const Frame& a, const Frame& b);

/// The first time when one of the two saw a pair touch that the other did not see within `lag` seconds of it; `end` if
/// there is none.
double parting_time(const Track& a, const Track& b, double lag, double end);

}  // namespace boxstream::accuracy
