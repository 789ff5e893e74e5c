// SPDX-License-Identifier: MIT
#include "format/experiment.hpp"

#include <filesystem>
#include <fstream>

namespace boxstream::report {
namespace {

using nlohmann::json;

std::string text_at(const json& document, const std::string& key, const std::string& file) {
  if (!document.contains(key) || !document[key].is_string()) throw BadExperiment(file + ": no text \"" + key + "\"");
  return document[key].get<std::string>();
}

}  // namespace

Experiment read_experiment(const std::string& file, bool smoke) {
  std::ifstream stream(file);
  if (!stream) throw BadExperiment(file + ": cannot be read");
  json document;
  try {
    document = json::parse(stream);
  } catch (const json::exception& error) {
    throw BadExperiment(file + ": " + error.what());
  }
  if (!document.is_object()) throw BadExperiment(file + ": not an object");
  Experiment experiment{file, std::filesystem::path(file).stem().string(), text_at(document, "title", file),
                        text_at(document, "kind", file), document.value("measure", json::object())};
  if (!experiment.settings.is_object()) throw BadExperiment(file + ": \"measure\" is not an object");
  if (smoke) {
    if (!document.contains("smoke")) throw BadExperiment(file + ": no block \"smoke\"");
    experiment.settings.merge_patch(document["smoke"]);
  }
  return experiment;
}

}  // namespace boxstream::report
