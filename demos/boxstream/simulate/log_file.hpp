// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "base/output_file.hpp"
#include "formats/record/writer.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::tool {

/// The recording of one world's broad-phase calls, as a file.
class LogFile {
 public:
  /// Throws as files::OutputFile does.
  LogFile(const std::string& path, const scenes::Scene& scene, const std::string& broadphase);

  /// For the Simulation to be recorded, of which there is one, and which this must outlive.
  scenes::Simulation::Wrap wrap();
  /// Ends the recording: what the world does later, such as being taken down, is not in it.
  void finish();
  void commit() { file_.commit(); }

 private:
  files::OutputFile file_;
  record::Writer writer_;
};

}  // namespace boxstream::tool
