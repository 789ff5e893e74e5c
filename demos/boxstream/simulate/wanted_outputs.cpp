// SPDX-License-Identifier: MIT
#include "boxstream/simulate/wanted_outputs.hpp"

#include <fmt/format.h>

#include "base/is_below.hpp"
#include "boxstream/shared/bad_input.hpp"

namespace boxstream::tool {
namespace {

/// A scene may be from anywhere, and must not choose files of its user's to be replaced.
void check_is_here(const SimulateOptions& options, const scenes::Scene& scene, const std::string& file) {
  if (file.empty() || options.outputs_anywhere || files::is_below(".", file)) return;
  throw BadInput(fmt::format(
      "{}: /outputs: {} is not below the current folder, as outputs that a scene names must be; --outputs-anywhere "
      "allows it",
      scene.file, file));
}

void choose(std::string& option, std::string& output) {
  if (option.empty())
    option = output;
  else
    output = option;
}

}  // namespace

SimulateOptions with_outputs(const SimulateOptions& options, scenes::Scene& scene) {
  SimulateOptions wanted = options;
  scenes::Outputs& outputs = scene.outputs;
  std::string log;
  for (const std::string& file : outputs.record) {
    check_is_here(options, scene, file);
    if (!file.ends_with(".bsrec")) {
      wanted.record.push_back(file);
      continue;
    }
    if (!log.empty())
      throw BadInput(fmt::format("{}: /outputs/record: {} and {}: a run has one log", scene.file, log, file));
    log = file;
  }
  // What the command line says instead is the user's own choice.
  if (options.view.empty()) check_is_here(options, scene, outputs.view);
  if (options.trace.empty()) check_is_here(options, scene, outputs.trace);
  if (options.csv.empty()) check_is_here(options, scene, outputs.csv);
  choose(wanted.log, log);
  choose(wanted.view, outputs.view);
  choose(wanted.trace, outputs.trace);
  choose(wanted.csv, outputs.csv);
  outputs.record = wanted.record;
  if (!wanted.log.empty()) outputs.record.push_back(wanted.log);
  return wanted;
}

}  // namespace boxstream::tool
