// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace boxstream::report {

/// Says in one line, which begins with the file, what is wrong with an experiment.
class BadExperiment : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file that declares what is measured, and how the page shows it. README.md lists the keys.
struct Experiment {
  std::string file;
  std::string id;           ///< "S3"; the file's name without its ending
  std::string title;        ///< one line
  std::string kind;         ///< the name of one of experiment_kinds()
  nlohmann::json settings;  ///< block "measure", read by that kind; in a smoke run merged with block "smoke"
};

/// Throws BadExperiment. `smoke`: the few points that show that everything still runs.
Experiment read_experiment(const std::string& file, bool smoke);

}  // namespace boxstream::report
