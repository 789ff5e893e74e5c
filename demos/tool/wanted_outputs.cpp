// SPDX-License-Identifier: MIT
#include "wanted_outputs.hpp"

#include <fmt/format.h>

#include "bad_input.hpp"

namespace boxstream::tool {
namespace {

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
    if (!file.ends_with(".bsrec")) {
      wanted.record.push_back(file);
      continue;
    }
    if (!log.empty())
      throw BadInput(fmt::format("{}: /outputs/record: {} and {}: a run has one log", scene.file, log, file));
    log = file;
  }
  choose(wanted.log, log);
  choose(wanted.view, outputs.view);
  choose(wanted.trace, outputs.trace);
  choose(wanted.csv, outputs.csv);
  outputs.record = wanted.record;
  if (!wanted.log.empty()) outputs.record.push_back(wanted.log);
  return wanted;
}

}  // namespace boxstream::tool
