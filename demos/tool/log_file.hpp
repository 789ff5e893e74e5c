// SPDX-License-Identifier: MIT
#pragma once

#include <fstream>
#include <string>

#include "output_file.hpp"
#include "record/writer.hpp"
#include "simulation/simulation.hpp"

namespace boxstream::tool {

/// The recording of one world's broad-phase calls, as a file.
class LogFile {
 public:
  /// Throws BadInput as OutputFile does.
  LogFile(const std::string& path, const scenes::Scene& scene, const std::string& broadphase);

  /// For the Simulation to be recorded, of which there is one, and which this must outlive.
  scenes::Simulation::Wrap wrap();
  /// Ends the recording: what the world does later, such as being taken down, is not in it. Throws std::runtime_error
  /// if it could not be written.
  void finish();
  const OutputFile& file() const { return file_; }
  void commit() { file_.commit(); }

 private:
  std::string path_;
  OutputFile file_;
  std::ofstream stream_;
  record::Writer writer_;
};

}  // namespace boxstream::tool
