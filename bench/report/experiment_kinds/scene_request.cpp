// SPDX-License-Identifier: MIT
#include "experiment_kinds/scene_request.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "references/simbody.hpp"

namespace boxstream::report {
namespace {

using nlohmann::json;

/// By method of text, in which a fraction is a number.
json value_of(const std::string& name, const json& value) {
  return value.is_string() ? accuracy::parse_knob(name + "=" + value.get<std::string>()).values.at(0) : value;
}

accuracy::Knob knob_of(const std::string& name, const json& values) {
  accuracy::Knob knob = accuracy::parse_knob(name + "=0");
  knob.values.clear();
  for (const json& value : values) knob.values.push_back(value_of(name, value));
  return knob;
}

}  // namespace

std::vector<accuracy::Knob> knobs_of(const json& description) {
  std::vector<accuracy::Knob> knobs;
  if (description.is_object()) {
    for (const auto& [name, values] : description.items()) knobs.push_back(knob_of(name, values));
    return knobs;
  }
  for (const json& item : description) {
    const std::string name = item.at("name").get<std::string>();
    accuracy::Knob knob = knob_of(item.value("at", name), item.at("values"));
    knob.name = name;
    knob.labels = item.value("labels", std::vector<std::string>{});
    if (!knob.labels.empty() && knob.labels.size() != knob.values.size())
      throw accuracy::BadKnob(name + ": not as many labels as values");
    knobs.push_back(std::move(knob));
  }
  return knobs;
}

accuracy::Request request_of(const Experiment& experiment, const std::string& scene, int repeats) {
  const json& settings = experiment.settings;
  accuracy::Request request;
  request.file = scene;
  std::ifstream stream(scene);
  if (!stream) throw BadExperiment(experiment.file + ": " + scene + ": no such scene");
  request.scene = json::parse(stream);
  request.knobs = knobs_of(settings.at("knobs"));
  for (const json& metric : settings.value("metrics", json::array()))
    request.measures.push_back(accuracy::parse_measure(metric.get<std::string>()));
  request.most_product = settings.value("most_product", HUGE_VAL);
  request.steps = settings.value("steps", std::uint64_t{0});
  request.repeats = repeats;
  const std::string reference = settings.value("reference", "fine");
  if (reference == "simbody")
    request.reference = simbody_trajectory;
  else if (reference != "fine")
    throw BadExperiment(experiment.file + ": reference \"" + reference + "\" is neither fine nor simbody");
  // Runs of 128 substeps that no metric is compared with would take longer than all others.
  if (std::none_of(request.measures.begin(), request.measures.end(), accuracy::needs_reference))
    request.reference = [](const scenes::Scene&, std::uint64_t) { return accuracy::Trajectory{}; };
  if (settings.contains("expected")) {
    const json& expected = settings["expected"].at(request.scene.at("meta").at("name").get<std::string>());
    request.expected = {expected.at("body").get<std::size_t>(), expected.at("velocity").get<std::array<double, 3>>()};
  }
  if (settings.contains("settle"))
    request.settling = {settings["settle"].value("change", json::object()),
                        settings["settle"].at("steps").get<std::uint64_t>()};
  request.keep_values = settings.contains("curves");
  return request;
}

}  // namespace boxstream::report
