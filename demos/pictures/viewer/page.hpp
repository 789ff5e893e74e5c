// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "pictures/viewer/frames.hpp"
#include "pictures/viewer/model.hpp"
#include "pictures/viewer/snapshot.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::view {

/// A run as one HTML file that plays it, without anything else, in any browser since 2023.
class Page {
 public:
  struct Options {
    std::uint64_t steps = 0;  ///< that the run is going to have
    /// Every which step becomes a frame; 0: as few are left out as it takes to stay below `page_size`.
    std::uint64_t every = 0;
    std::string versions;  ///< a line about what made the run
  };
  /// More takes browsers long to open.
  static constexpr std::size_t page_size = 60'000'000;

  /// Can pages be made? Only if the viewer was built in.
  static bool is_available();

  /// Takes the world as it is now for the first frame. `simulation` must outlive the page.
  Page(const scenes::Simulation& simulation, const Options& options);

  /// After each step. Throws as Snapshot::read.
  void add_step();

  /// Every which step is a frame.
  std::uint64_t every() const { return every_; }

  /// The page; `results` of all steps. Writes nothing if there is no viewer.
  void write(std::ostream& out, const std::vector<scenes::StepResult>& results);

 private:
  void add_frame(std::uint64_t step);
  void end_block();

  const scenes::Simulation& simulation_;
  std::string versions_;
  Model model_;
  Snapshot snapshot_;
  float unit_;
  std::uint64_t every_;
  std::uint64_t steps_ = 0;
  FrameEncoder encoder_;
  std::vector<std::uint64_t> frame_steps_;
  std::vector<std::string> blocks_;  // in base64
};

}  // namespace boxstream::view
