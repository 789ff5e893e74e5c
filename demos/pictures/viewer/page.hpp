// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "pictures/viewer/recording.hpp"

namespace boxstream::view {

/// A recorded world on a page, and what its steps reported.
struct PageWorld {
  const Recording* recording;
  std::string label;  ///< what sets it apart from the other one, such as "substeps=4"
  const std::vector<scenes::StepResult>* results;
};

/// Can pages be made? Only if the viewer was built in.
bool has_pages();

/// One HTML file that plays a run, without anything else, in any browser since 2023: one world, or two of the same
/// objects side by side. `versions` is a line about what made the run. The recordings are finished. Writes nothing if
/// there is no viewer.
void write_page(std::ostream& out, const std::vector<PageWorld>& worlds, const std::string& versions);

/// All of a world but its frames, as JSON, for the viewer: title, about, label, dt, unit, the forms and parts of the
/// model, which objects of the world these are, their names and joints, the step and crowd of each frame. Numbers and
/// times of every step are those of the whole world.
std::string describe(const PageWorld& world, const std::string& versions);

}  // namespace boxstream::view
