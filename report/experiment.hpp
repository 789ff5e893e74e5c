// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace boxstream::report {

/// What is wrong with an experiment, in one line that begins with its file.
class BadExperiment : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A declarative file: what is measured, and where the page shows it. README.md lists the keys.
struct Experiment {
  std::string file;
  std::string id;           ///< "S3"; the file's name without its ending
  std::string title;        ///< one line
  std::string kind;         ///< one of kind_names(): who measures it
  nlohmann::json settings;  ///< block "measure", which that kind understands; in a smoke run merged with block "smoke"
};

/// Throws BadExperiment. `smoke`: the few points that show that everything still runs.
Experiment read_experiment(const std::string& file, bool smoke);

}  // namespace boxstream::report
