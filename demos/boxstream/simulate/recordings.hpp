// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "boxstream/simulate/monitor.hpp"
#include "boxstream/simulate/options.hpp"
#include "boxstream/simulate/simulate.hpp"

namespace boxstream::tool {

/// What a run leaves to look at: an animation (--record FILE.glb) of the first world, not of the one it is compared
/// with; a page (--view) and a trace (--trace) of both.
class Recordings {
 public:
  /// Throws BadInput and files::BadFile for what cannot be recorded, before anything is run.
  explicit Recordings(const SimulateOptions& options);
  ~Recordings();

  /// What is to look on while each world runs.
  std::vector<std::vector<Monitor*>> monitors();

  void write(const scenes::Scene& scene, const RunResult& result);
  void commit();

  /// A remark for each file where steps or objects were left out.
  void say_what_is_left_out();

 private:
  struct Files;
  std::unique_ptr<Files> files_;
};

}  // namespace boxstream::tool
