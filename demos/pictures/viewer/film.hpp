// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>

#include "pictures/viewer/film_record.hpp"
#include "pictures/viewer/snapshot.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::view {

/// A run as an animation in glTF 2.0: a node for each object, forms shared, and the poses of whatever moves as
/// keyframes. Soft bodies come as some dozens of still surfaces that are shown one after the other (by their scale,
/// which is the way that glTF has for this), and so move less smoothly. Objects that are out of the world for a time
/// have no size then. Planes end beyond the scene.
class Film {
 public:
  struct Options {
    std::uint64_t steps = 0;  ///< that the run is going to have
    /// Every which step is sampled; 0: as few are left out as it takes to stay below `file_size`.
    std::uint64_t every = 0;
    std::string versions;  ///< a line about what made the run
  };
  static constexpr std::size_t file_size = 1'000'000'000;

  /// Takes the world as it is now for the first sample. `simulation` must outlive the film.
  Film(const scenes::Simulation& simulation, const Options& options);

  /// After each step. Throws as Snapshot::read.
  void add_step();

  /// Every which step is sampled.
  std::uint64_t every() const { return every_; }

  /// The .glb file. Throws std::length_error if it would be too large for the format.
  void write(std::ostream& out) const;

 private:
  void take_frame();
  void take_still(std::uint32_t frame, const SoftPart& part, std::vector<FilmRecord::Still>& list) const;

  const scenes::Simulation& simulation_;
  std::string versions_;
  std::uint64_t every_, still_every_;
  std::uint64_t steps_ = 0;
  std::uint32_t frames_ = 0;
  Snapshot snapshot_;
  std::vector<Pose> latest_;  // of each object, finite
  FilmRecord film_;
};

}  // namespace boxstream::view
