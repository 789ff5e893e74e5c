// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "formats/scene_model/scene.hpp"
#include "pictures/viewer/model.hpp"
#include "pictures/viewer/snapshot.hpp"
#include "pictures/viewer/trajectory.hpp"

namespace boxstream::view {

/// What a film is made of.
struct FilmRecord {
  /// A soft body at one moment.
  struct Still {
    std::uint32_t frame;
    std::vector<Point> nodes;
  };

  Model model;
  std::vector<Pose> first;                 ///< of each object, in frame 0
  std::vector<Trajectory<3>> places;       ///< of each object
  std::vector<Trajectory<4>> rotations;    ///< of each object
  std::vector<bool> in_world;              ///< of each object, in frame 0
  std::vector<Trajectory<3>> scales;       ///< of each object: 1 in the world, 0 out of it
  std::vector<std::vector<Still>> stills;  ///< of each soft part
};

/// The film as a .glb file. `frame_seconds` is the time from frame to frame.
/// Throws std::length_error if it would be too large for the format.
void write_glb(std::ostream& out, const FilmRecord& film, const scenes::Scene& scene, double frame_seconds,
               const std::string& versions);

}  // namespace boxstream::view
