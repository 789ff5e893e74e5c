// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "formats/scene_model/scene.hpp"
#include "pictures/viewer/model.hpp"
#include "pictures/viewer/snapshot.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::view {

/// A value through time, as the keyframes that it takes to give back every sample exactly by interpolation: those in
/// the middle of a time in which nothing changes are left out. A value that never changes has none.
template <std::size_t components>
class Trajectory {
 public:
  using Value = std::array<float, components>;

  /// Frames come in order.
  void add(std::uint32_t frame, const Value& value) {
    if (!has_value_ || value == last_) {
      if (!has_value_) last_ = value;
      has_value_ = true;
      last_is_key_ = false;
    } else {
      if (!last_is_key_) push(last_frame_);
      last_ = value;
      push(frame);
      last_is_key_ = true;
    }
    last_frame_ = frame;
  }

  const std::vector<std::uint32_t>& frames() const { return frames_; }
  /// `components` floats for each of `frames()`.
  const std::vector<float>& values() const { return values_; }

 private:
  void push(std::uint32_t frame) {
    frames_.push_back(frame);
    values_.insert(values_.end(), last_.begin(), last_.end());
  }

  std::vector<std::uint32_t> frames_;
  std::vector<float> values_;
  Value last_{};
  std::uint32_t last_frame_ = 0;
  bool has_value_ = false;
  bool last_is_key_ = false;
};

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
