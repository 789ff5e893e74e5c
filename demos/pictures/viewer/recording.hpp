// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pictures/viewer/frames.hpp"
#include "pictures/viewer/model.hpp"
#include "pictures/viewer/snapshot.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::view {

/// A world of a run, as a page keeps it: some of its steps as frames, coded and compressed while the run goes on.
class Recording {
 public:
  struct Options {
    std::uint64_t steps = 0;  ///< that the run is going to have
    /// Every which step becomes a frame; 0: as few are left out as it takes to stay below `size`.
    std::uint64_t every = 0;
    std::size_t size = 60'000'000;  ///< bytes of the page; more takes browsers long to open
    std::size_t bodies = 100'000;   ///< objects that are kept, at most; more take browsers long to draw
  };

  /// Takes the world as it is now for the first frame. `simulation` must outlive the recording.
  Recording(const scenes::Simulation& simulation, const Options& options);
  /// Of the objects `kept`, as when another world of the same objects is on the page.
  Recording(const scenes::Simulation& simulation, const Options& options, Kept kept);

  /// After each step. Throws as Snapshot::read.
  void add_step();
  /// After the last one.
  void finish();

  /// Every which step is a frame.
  std::uint64_t every() const { return every_; }
  const scenes::Simulation& simulation() const { return simulation_; }
  const Model& model() const { return model_; }
  /// Lengths are whole numbers of it; a power of two.
  float unit() const { return unit_; }
  const std::vector<std::uint64_t>& frame_steps() const { return frame_steps_; }
  /// Of each frame: the bounds of what moves, without the outermost 1 %.
  const std::vector<Snapshot::Box>& crowds() const { return crowds_; }
  /// Compressed blocks of frames.
  const std::vector<std::string>& blocks() const { return blocks_; }

 private:
  void add_frame(std::uint64_t step);
  void end_block();

  const scenes::Simulation& simulation_;
  Model model_;
  Snapshot snapshot_;
  float unit_;
  std::uint64_t every_;
  std::uint64_t steps_ = 0;
  FrameEncoder encoder_;
  std::vector<std::uint64_t> frame_steps_;
  std::vector<Snapshot::Box> crowds_;
  std::vector<std::string> blocks_;
};

}  // namespace boxstream::view
